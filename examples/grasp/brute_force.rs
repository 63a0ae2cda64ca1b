//! Grasps checked again: every face compared with every capsule, without tree, batches and distances of the library.
use crate::closing::{Judged, angles};
use common::blend::Faces;
use geograd::{Capsule3, Vec3};
use std::f64::consts::PI;

/// Turns of the search along an axis; each leaves two thirds of it.
const TURNS: usize = 90;

/// The point of a triangle that is nearest to a point (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
fn foot([a, b, c]: [Vec3<f64>; 3], p: Vec3<f64>) -> Vec3<f64> {
    let (ab, ac) = (b - a, c - a);
    let dots = |v: Vec3<f64>| (ab.dot(p - v), ac.dot(p - v));
    let ((d1, d2), (d3, d4), (d5, d6)) = (dots(a), dots(b), dots(c));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let whole = 1.0 / (va + vb + vc);
    a + ab * (vb * whole) + ac * (vc * whole)
}

/// The solid angle of a triangle seen from a point (van Oosterom and Strackee 1983).
fn solid_angle(corners: [Vec3<f64>; 3], p: Vec3<f64>) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - p);
    let (x, y, z) = (a.length(), b.length(), c.length());
    let rest = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    2.0 * a.dot(b.cross(c)).atan2(rest)
}

/// The least distance of a capsule's axis from a mesh, and where: on the axis and on the mesh. Along a segment the
/// distance from one triangle is convex, so that thirds find its least value.
fn nearest(mesh: &Faces, part: &Capsule3<f64>) -> (f64, [Vec3<f64>; 2]) {
    let at = |t: f64| part.start + (part.end - part.start) * t;
    let axis = part.end - part.start;
    let mut best = (f64::INFINITY, [part.start; 2]);
    for face in &mesh.faces {
        let corners = face.map(|vertex| mesh.vertices[vertex as usize]);
        let center = (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0);
        let size = corners.map(|corner| (corner - center).length());
        let size = size.into_iter().fold(0.0, f64::max);
        // A face that is far from its middle on has no nearer point.
        let along = (center - part.start).dot(axis) / axis.length_squared();
        if (center - at(along.clamp(0.0, 1.0))).length() - size > best.0 {
            continue;
        }
        let way = |t: f64| (foot(corners, at(t)) - at(t)).length();
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..TURNS {
            let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
            if way(a) < way(b) {
                high = b;
            } else {
                low = a;
            }
        }
        let t = 0.5 * (low + high);
        if way(t) < best.0 {
            best = (way(t), [at(t), foot(corners, at(t))]);
        }
    }
    best
}

/// How often the mesh goes around a point.
fn winding(mesh: &Faces, point: Vec3<f64>) -> f64 {
    let angle = |face: &[u32; 3]| {
        let corners = face.map(|vertex| mesh.vertices[vertex as usize]);
        solid_angle(corners, point)
    };
    mesh.faces.iter().map(angle).sum::<f64>() / (4.0 * PI)
}

/// The middle of a closed mesh's inside, by the tetrahedra of its faces and the origin.
fn centroid(mesh: &Faces) -> Vec3<f64> {
    let mut sums = (Vec3::zero(), 0.0);
    for face in &mesh.faces {
        let [a, b, c] = face.map(|vertex| mesh.vertices[vertex as usize]);
        let volume = a.dot(b.cross(c));
        sums.0 += (a + b + c) * (0.25 * volume);
        sums.1 += volume;
    }
    sums.0 * (1.0 / sums.1)
}

/// Judges both fingers and the palm. A capsule whose axis is in the body, or cuts it, has a gap of minus its radius at
/// most.
pub fn judged(mesh: &Faces, parts: [Capsule3<f64>; 3]) -> Judged {
    let found = parts.each_ref().map(|part| {
        let (distance, ends) = nearest(mesh, part);
        let inside = winding(mesh, part.start) > 0.5;
        (if inside { -distance } else { distance }, ends)
    });
    let [left, right] = [0, 1].map(|k| found[k].1);
    let feet = [left[1], right[1]];
    let normals = [left, right].map(|[axis, foot]| axis - foot);
    let line = (feet[1] - feet[0]).normalize_or_zero();
    let level = mesh.vertices.iter().map(|vertex| vertex.z);
    let level = level.fold(f64::INFINITY, f64::min);
    let ends = parts
        .iter()
        .flat_map(|part| [(part.start, part.radius), (part.end, part.radius)]);
    let lowest = ends.map(|(end, radius)| end.z - radius);
    Judged {
        gaps: [0, 1, 2].map(|k| found[k].0 - parts[k].radius),
        height: lowest.fold(f64::INFINITY, f64::min) - level,
        angles: angles(feet, normals),
        lever: (centroid(mesh) - feet[0]).cross(line).length(),
    }
}

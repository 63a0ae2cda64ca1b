//! The face of a hull that faces a direction.
use super::body::{Body, Face};
use super::patch;
use crate::Vec3;

/// The number of roundings by which a corner may be beside the plane of its face.
const FLAT: f64 = 8.0;

/// Returns the corners of the face that faces a direction of length one most, counter-clockwise seen from outside; of a
/// hull without faces its ends, or one point. The points, of a format with a rounding, have coordinates up to about one.
pub(super) fn facing(points: &[Vec3<f64>], toward: Vec3<f64>, rounding: f64) -> Vec<usize> {
    let body = Body::of(points, rounding);
    let known = |face: &&Face| face.normal != Vec3::zero();
    let slope = |face: &Face| face.normal.dot(toward);
    let faces = || body.faces.iter().filter(known);
    let steepest = faces().fold(-1.0, |most: f64, face| most.max(slope(face)));
    // The largest part of a face, which is flat within rounding only, has a normal with the most digits.
    let level = |face: &&Face| slope(face) >= steepest - rounding.sqrt();
    let size = |face: &Face| {
        let [apex, from, to] = face.plane.map(|k| points[k]);
        (from - apex).cross(to - apex).length_squared()
    };
    let largest = faces()
        .filter(level)
        .max_by(|p, q| size(p).total_cmp(&size(q)));
    if let Some(face) = largest {
        let plane = (face.plane[0], face.normal);
        let mut ring = patch::ring(points, &body.corners, plane, FLAT * rounding);
        if ring.len() < 3 {
            ring = face.ring.clone();
        }
        // The first three corners span the plane.
        let n = ring.len();
        let span = |k: &usize| {
            let [a, b, c] = [0, 1, 2].map(|i| points[ring[(k + i) % n]]);
            (b - a).cross(c - a).length_squared()
        };
        let first = (0..n).max_by(|p, q| span(p).total_cmp(&span(q)));
        ring.rotate_left(first.unwrap_or(0));
        return ring;
    }
    match body.edges.first() {
        Some(edge) => {
            let along = body.along(edge);
            let rise = along.dot(toward).abs();
            match rise + rise > along.length() {
                true => Vec::new(),
                false => edge.ends.to_vec(),
            }
        }
        None => body.corners,
    }
}

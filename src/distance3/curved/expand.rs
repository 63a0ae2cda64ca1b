//! Directions in which two solids that overlap part after a short way: a polytope of supports is expanded where it is
//! the nearest to the origin (van den Bergen 2001), coarsely.
use super::super::gjk::PointDifference;
use super::touch::tangents;
use crate::Vec3;

/// A direction, from a to b.
#[derive(Clone, Copy, Debug)]
pub struct Exit {
    /// The direction, of length one.
    pub normal: Vec3<f64>,
    /// The depth along it, or a bound from below.
    pub depth: f64,
}

struct Face {
    corners: [usize; 3],
    normal: Vec3<f64>,
    height: f64,
}

/// The relative gap of both bounds of the depth at which the expansion ends. Ways out of a box and a cylinder that differ by
/// 4 · 10⁻⁶ of the size, a degree apart, have occurred in one pair of ten thousand.
const CLOSE: f64 = 1e-5;
/// The most corners of the polytope. Of cylinders with one axis 60 leave ways out unseen.
const MOST: usize = 120;
/// A thickness below which a polytope is flat, relative to its size.
const FLAT: f64 = 1e-14;
/// The most directions besides the best one.
const OTHERS: usize = 8;
/// How many of them are those with the lowest bounds.
const LOWEST: usize = 5;

/// Lowest points, of which the best direction is kept.
struct Probe<'a> {
    lowest: &'a dyn Fn(Vec3<f64>) -> PointDifference,
    best: Exit,
}

impl Probe<'_> {
    fn low(&mut self, normal: Vec3<f64>) -> PointDifference {
        let found = (self.lowest)(normal);
        let length = normal.length();
        let depth = -normal.dot(found.way) / length;
        if length > 0.0 && depth < self.best.depth {
            self.best = Exit {
                normal: normal * (1.0 / length),
                depth,
            };
        }
        found
    }
}

/// Returns the face through three corners, which are counter-clockwise seen from outside.
fn face(all: &[PointDifference], corners: [usize; 3]) -> Face {
    let [p, q, r] = corners.map(|k| all[k].way);
    let normal = (q - p).cross(r - p);
    let length = normal.length();
    if length <= 1e-30 {
        return Face {
            corners,
            normal: Vec3::zero(),
            height: f64::INFINITY,
        };
    }
    let normal = normal * (1.0 / length);
    let height = normal.dot(p).max(normal.dot(q)).max(normal.dot(r));
    Face {
        corners,
        normal,
        height,
    }
}

/// Returns four corners that span a fat tetrahedron, which need not contain the origin, with the last below the plane of
/// the others, and its size; `None` if all points are in a plane within rounding.
fn fat(probe: &mut Probe<'_>) -> Option<(Vec<PointDifference>, f64)> {
    let axes = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)];
    let (mut all, mut far, mut size) = (Vec::new(), Vec3::zero(), 0.0);
    for (x, y, z) in axes {
        let axis = Vec3::new(x, y, z);
        let (p, q) = (probe.low(axis), probe.low(-axis));
        let length = (p.way - q.way).length();
        if length > size {
            (all, far, size) = (vec![p, q], p.way - q.way, length);
        }
    }
    if size <= 0.0 {
        return None;
    }
    let along = far * (1.0 / size);
    let [x, y] = tangents(along);
    let (mut widest, mut corner) = (-1.0, all[0]);
    for normal in [x, -x, y, -y] {
        let found = probe.low(normal);
        let width = along.cross(found.way - all[0].way).length();
        if width > widest {
            (widest, corner) = (width, found);
        }
    }
    all.push(corner);
    let normal = (all[1].way - all[0].way).cross(all[2].way - all[0].way);
    let length = normal.length();
    if length <= FLAT * size * size {
        probe.low(x);
        return None;
    }
    let normal = normal * (1.0 / length);
    let height = |found: &PointDifference| normal.dot(found.way - all[0].way);
    let both = [probe.low(normal), probe.low(-normal)];
    let [low, high] = [height(&both[0]), height(&both[1])];
    if low.abs().max(high.abs()) <= FLAT * size {
        return None;
    }
    let last = if low.abs() >= high.abs() {
        both[0]
    } else {
        both[1]
    };
    if height(&last) > 0.0 {
        all.swap(1, 2);
    }
    all.push(last);
    Some((all, size))
}

/// Returns the faces that a new corner sees, connected to one of them.
fn seen(
    faces: &[Face],
    all: &[PointDifference],
    first: usize,
    corner: Vec3<f64>,
    slack: f64,
) -> Vec<bool> {
    let (mut seen, mut stack) = (vec![false; faces.len()], vec![first]);
    seen[first] = true;
    while let Some(k) = stack.pop() {
        for edge in edges(faces[k].corners) {
            let beside = |face: &Face| edges(face.corners).contains(&[edge[1], edge[0]]);
            let Some(other) = faces.iter().position(beside) else {
                continue;
            };
            let Face {
                corners, normal, ..
            } = faces[other];
            if !seen[other] && normal.dot(corner - all[corners[0]].way) > slack {
                seen[other] = true;
                stack.push(other);
            }
        }
    }
    seen
}

fn edges([i, j, k]: [usize; 3]) -> [[usize; 2]; 3] {
    [[i, j], [j, k], [k, i]]
}

/// Returns directions along which two solids part, the best first, given the point of b less a that is the lowest along
/// a vector.
pub fn exits(lowest: &dyn Fn(Vec3<f64>) -> PointDifference) -> Vec<Exit> {
    let best = Exit {
        normal: Vec3::new(0.0, 0.0, 1.0),
        depth: f64::INFINITY,
    };
    let mut probe = Probe { lowest, best };
    let Some((mut all, size)) = fat(&mut probe) else {
        return vec![probe.best];
    };
    let mut faces: Vec<Face> = Vec::new();
    for corners in [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] {
        faces.push(face(&all, corners));
    }
    while all.len() <= MOST {
        let lower = |&i: &usize, &j: &usize| faces[i].height.total_cmp(&faces[j].height);
        let Some(first) = (0..faces.len()).min_by(lower) else {
            break;
        };
        let (normal, height) = (faces[first].normal, faces[first].height);
        let found = probe.low(-normal);
        let limit = CLOSE * probe.best.depth.abs().max(1e-3 * size);
        let close = normal.dot(found.way) - height <= limit || probe.best.depth - height <= limit;
        let known = faces[first]
            .corners
            .iter()
            .any(|&k| all[k].way == found.way);
        if close || known {
            break;
        }
        let seen = seen(&faces, &all, first, found.way, 1e-15 * size);
        let mut rim: Vec<[usize; 2]> = Vec::new();
        for (face, _) in faces.iter().zip(&seen).filter(|(_, seen)| **seen) {
            for [i, j] in edges(face.corners) {
                match rim.iter().position(|&edge| edge == [j, i]) {
                    Some(k) => drop(rim.swap_remove(k)),
                    None => rim.push([i, j]),
                }
            }
        }
        let mut hidden = seen.iter().map(|seen| !seen);
        faces.retain(|_| hidden.next().unwrap_or(true));
        all.push(found);
        for [i, j] in rim {
            faces.push(face(&all, [i, j, all.len() - 1]));
        }
    }
    let mut exits = vec![probe.best];
    faces.retain(|face| face.height < probe.best.depth && face.normal.length_squared() >= 0.5);
    faces.sort_by(|p, q| p.height.total_cmp(&q.height));
    // Each face with the largest cosine between its way out and those that are taken.
    let mut left: Vec<(Face, f64)> = faces.into_iter().map(|face| (face, -1.0)).collect();
    for count in 0..OTHERS {
        let taken = exits[count].normal;
        for (face, beside) in &mut left {
            *beside = beside.max(-taken.dot(face.normal));
        }
        let mut new = left.iter().filter(|(_, beside)| *beside <= 0.97);
        // Directions all around may be as good to a part in 10⁵: the later ones are far from the others.
        let next = match count < LOWEST {
            true => new.next(),
            false => new.min_by(|(_, p), (_, q)| p.total_cmp(q)),
        };
        let Some((next, _)) = next else {
            break;
        };
        exits.push(Exit {
            normal: -next.normal,
            depth: next.height,
        });
    }
    exits
}

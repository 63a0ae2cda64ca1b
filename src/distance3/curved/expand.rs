//! Directions in which two solids that overlap part after a short way: a polytope of supports is expanded where it is
//! the nearest to the origin (van den Bergen 2001), coarsely.
use super::super::gjk::CodedDifference;
use super::super::polytope::{Face, Polytope};
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

/// Directions along which two solids part, and where the polytope ended.
pub struct Exits {
    /// The directions, the best first.
    pub all: Vec<Exit>,
    /// The corners of the polytope's lowest face, if nothing is clearly above it.
    pub face: Option<[CodedDifference; 3]>,
}

/// The relative gap of both bounds of the depth at which the expansion ends. Ways out of a box and a cylinder that differ by
/// 4 · 10⁻⁶ of the size, a degree apart, have occurred in one pair of ten thousand.
const CLOSE: f64 = 1e-5;
/// The most corners of the polytope. Of cylinders with one axis 60 leave ways out unseen.
const MOST: usize = 120;
/// The sine below which a face has no normal.
const SLIVER: f64 = 1e-15;
/// A thickness below which a polytope is flat, relative to its size.
const FLAT: f64 = 1e-14;
/// The most directions besides the best one.
const OTHERS: usize = 8;
/// How many of them are those with the lowest bounds.
const LOWEST: usize = 5;

/// Lowest points, of which the best direction is kept.
struct Probe<'a> {
    lowest: &'a dyn Fn(Vec3<f64>) -> CodedDifference,
    best: Exit,
}

impl Probe<'_> {
    fn low(&mut self, normal: Vec3<f64>) -> CodedDifference {
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

/// Returns four corners that span a fat tetrahedron, which need not contain the origin, with the last below the plane of
/// the others, and its size; `None` if all points are in a plane within rounding.
fn fat(probe: &mut Probe<'_>) -> Option<([CodedDifference; 4], f64)> {
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
    let height = |found: &CodedDifference| normal.dot(found.way - all[0].way);
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
    Some(([all[0], all[1], all[2], last], size))
}

/// Returns directions along which two solids part, given the point of b less a that is the lowest along a vector.
pub fn exits(lowest: &dyn Fn(Vec3<f64>) -> CodedDifference) -> Exits {
    let best = Exit {
        normal: Vec3::new(0.0, 0.0, 1.0),
        depth: f64::INFINITY,
    };
    let mut probe = Probe { lowest, best };
    let Some((corners, size)) = fat(&mut probe) else {
        return Exits {
            all: vec![probe.best],
            face: None,
        };
    };
    let mut polytope = Polytope::new(1e-15 * size, SLIVER);
    // The last corner is below the plane of the others.
    polytope.begin(corners, -1.0);
    let (mut last, mut is_whole) = (None, true);
    while polytope.corners.len() <= MOST {
        let Some((first, height)) = polytope.lowest() else {
            break;
        };
        let face = polytope.faces[first];
        let corners = polytope.corners_of(&face);
        let found = probe.low(-face.normal);
        let limit = CLOSE * probe.best.depth.abs().max(1e-3 * size);
        let gap = face.normal.dot(found.way) - height;
        let close = gap <= limit || probe.best.depth - height <= limit;
        let known = corners.iter().any(|corner| corner.way == found.way);
        if close || known {
            last = is_whole.then_some(corners);
            break;
        }
        if !polytope.extend(first, found) {
            polytope.open[first] = f64::INFINITY;
            is_whole = false;
        }
    }
    let mut faces = polytope.faces;
    faces.retain(|face| !face.gone && face.height < probe.best.depth);
    let mut exits = vec![probe.best];
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
    Exits {
        all: exits,
        face: last,
    }
}

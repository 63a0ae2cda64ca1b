//! The planes that part two hulls best: along a face of either, or along an edge of each.
use super::body::{BEYOND, Body, across, is_short};
use super::hull_record::{FeaturePair, HullFeatures};
use crate::Vec3;

/// A sine of two edges below which they have no plane of their own, in roundings.
const PARALLEL: f64 = 50.0 * f64::EPSILON;

/// A plane between two hulls, and what defines it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// The gap of the hulls along the normal; negative where they overlap.
    pub gap: f64,
    /// From a to b, of length one.
    pub normal: Vec3<f64>,
    /// A corner of a in the plane.
    pub on_a: usize,
    /// A corner of b in the plane that is the gap away.
    pub on_b: usize,
    /// The features that define it.
    pub features: HullFeatures,
}

/// The best planes so far.
struct Best {
    all: Vec<Plane>,
    most: f64,
    /// The difference of gaps that is none.
    slack: f64,
}

impl Best {
    fn add(&mut self, plane: Plane) {
        if plane.gap < self.most - self.slack {
            return;
        }
        self.most = self.most.max(plane.gap);
        // Faces and edges that are parallel have one plane.
        let same = |other: &&mut Plane| (other.normal - plane.normal).length_squared() < 1e-12;
        match self.all.iter_mut().find(same) {
            Some(other) if other.gap < plane.gap - self.slack => *other = plane,
            Some(_) => {}
            None => self.all.push(plane),
        }
    }
}

/// Adds the planes along the faces of the first hull.
fn along_faces(first: &Body<'_>, second: &Body<'_>, flipped: bool, best: &mut Best) {
    for face in &first.faces {
        let corner = face.plane[0];
        if face.normal == Vec3::zero() {
            continue;
        }
        let (gap, lowest) = second.lowest(face.normal, first.points[corner]);
        if gap < best.most - best.slack {
            continue;
        }
        let features = HullFeatures::new(FeaturePair::FaceCorner, &face.plane, &[lowest]);
        best.add(match flipped {
            false => Plane {
                gap,
                normal: face.normal,
                on_a: corner,
                on_b: lowest,
                features,
            },
            true => Plane {
                gap,
                normal: -face.normal,
                on_a: lowest,
                on_b: corner,
                features: features.flipped(),
            },
        });
    }
}

/// Adds the planes along an edge of each.
fn along_edges(a: &Body<'_>, b: &Body<'_>, rounding: f64, best: &mut Best) {
    for first in &a.edges {
        let from = a.points[first.ends[0]];
        let u = a.along(first);
        let over_a = first.beside.map(|k| a.points[k] - from);
        for second in &b.edges {
            let to = b.points[second.ends[0]];
            let v = b.along(second);
            let product = u.cross(v);
            let sides_a = over_a.map(|arm| product.dot(arm));
            let sides_b = second.beside.map(|k| product.dot(b.points[k] - to));
            // Neighbours decide about all corners, but rounding about neighbours that are in the plane.
            let slack = BEYOND * product.length();
            let up = sides_a.iter().all(|&h| h <= slack) && sides_b.iter().all(|&h| h >= -slack);
            let down = sides_a.iter().all(|&h| h >= -slack) && sides_b.iter().all(|&h| h <= slack);
            if !up && !down {
                continue;
            }
            let squares = u.length_squared() * v.length_squared();
            let parallel = product.length_squared() <= PARALLEL * PARALLEL * squares;
            if parallel || is_short(product, rounding) {
                continue;
            }
            let unit = across(u, v);
            for (holds, side) in [(up, 1.0), (down, -1.0)] {
                let normal = unit * side;
                let gap = normal.dot(to - from);
                if !holds || gap < best.most - best.slack {
                    continue;
                }
                let beyond_a = a.lowest(-normal, from).0.min(0.0);
                let beyond_b = b.lowest(normal, to).0.min(0.0);
                if beyond_a < -BEYOND || beyond_b < -BEYOND {
                    continue;
                }
                let gap = gap + beyond_a + beyond_b;
                let [start, end] = second.ends;
                let ends = if side > 0.0 {
                    [start, end]
                } else {
                    [end, start]
                };
                best.add(Plane {
                    gap,
                    normal,
                    on_a: first.ends[0],
                    on_b: start,
                    features: HullFeatures::new(FeaturePair::Edges, &first.ends, &ends),
                });
            }
        }
    }
}

/// Returns the planes with the largest gap, within rounding; none for hulls without a face and edges.
pub(super) fn best(a: &Body<'_>, b: &Body<'_>, slack: f64, rounding: f64) -> Vec<Plane> {
    let mut best = Best {
        all: Vec::new(),
        most: f64::NEG_INFINITY,
        slack,
    };
    along_faces(a, b, false, &mut best);
    along_faces(b, a, true, &mut best);
    along_edges(a, b, rounding, &mut best);
    let Best { mut all, most, .. } = best;
    // The first of parallel planes is kept, whose gap is less by as much.
    all.retain(|plane| plane.gap >= most - 2.0 * slack);
    all
}

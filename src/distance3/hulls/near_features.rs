//! The nearest features of two hulls that are apart, by all pairs of features.
use super::body::{Body, across};
use super::hull_record::{FeaturePair, HullFeatures, around};
use crate::Vec3;

/// A sine of two edges below which their ends are as near as their middles, in roundings.
const PARALLEL: f64 = 50.0 * f64::EPSILON;

/// Two features, and how far apart they are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub distance: f64,
    pub features: HullFeatures,
}

/// Returns the length of a vector in units of the hulls' size; zero where its square is below the format.
pub(super) fn long(v: Vec3<f64>) -> f64 {
    v.length_squared().sqrt()
}

/// Returns the distance of a point from the open part of an edge; `None` where an end is nearer.
pub(super) fn from_edge([from, to]: [Vec3<f64>; 2], point: Vec3<f64>) -> Option<f64> {
    let (along, arm, back) = (to - from, point - from, to - point);
    let square = along.length_squared();
    let (ahead, behind) = (along.dot(arm), along.dot(back));
    if ahead <= 0.0 || behind <= 0.0 || square <= 0.0 {
        return None;
    }
    // From the nearer end, whose distance has more digits.
    Some(match ahead <= behind {
        true => long(arm - along * (ahead / square)),
        false => long(along * (behind / square) - back),
    })
}

/// Returns the distance of the open parts of two edges; `None` where an end is nearer, or if they are parallel.
pub(super) fn of_edges(a: [Vec3<f64>; 2], b: [Vec3<f64>; 2]) -> Option<f64> {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], b[0] - a[0]);
    let product = u.cross(v);
    let (square, along) = (product.length_squared(), v.length_squared());
    if square <= PARALLEL * PARALLEL * (u.length_squared() * along) {
        return None;
    }
    let s = w.cross(v).dot(product) / square;
    let t = (u.dot(v) * s - w.dot(v)) / along;
    let open = |x: f64| 0.0 < x && x < 1.0;
    (open(s) && open(t)).then(|| long(w + v * t - u * s))
}

/// Returns the height of a point over a face with a ring of corners, if it is not below it by more than a slack, and
/// inside seen along its normal.
fn over_face(
    points: &[Vec3<f64>],
    ring: &[usize],
    normal: Vec3<f64>,
    point: Vec3<f64>,
    slack: f64,
) -> Option<f64> {
    let height = normal.dot(point - points[ring[0]]);
    let inside = |k: usize| {
        let (from, to) = (points[ring[k]], points[ring[(k + 1) % ring.len()]]);
        normal.dot((to - from).cross(point - from)) >= 0.0
    };
    (height >= -slack && (0..ring.len()).all(inside)).then_some(height.abs())
}

/// The nearest features so far.
struct Best {
    all: Vec<Near>,
    least: f64,
    /// The difference of distances that is none.
    slack: f64,
}

impl Best {
    fn add(&mut self, distance: f64, features: HullFeatures) {
        if distance <= self.least + self.slack {
            self.least = self.least.min(distance);
            self.all.push(Near { distance, features });
        }
    }
}

/// Adds the nearest feature of the first hull to every corner of the second. Returns `true` if one of the corners is
/// inside.
fn of_corners(first: &Body<'_>, second: &Body<'_>, flipped: bool, best: &mut Best) -> bool {
    let mut inside = false;
    for &corner in &second.corners {
        let point = second.points[corner];
        let mut own: Option<Near> = None;
        // Faces come before edges and edges before corners that are equally near.
        let mut take = |distance: f64, pair: FeaturePair, at: &[usize], slack: f64| {
            if own.is_none_or(|own| distance < own.distance - slack) {
                let features = HullFeatures::new(pair, at, &[corner]);
                own = Some(Near { distance, features });
            }
        };
        let mut above = false;
        for face in &first.faces {
            if face.normal == Vec3::zero() {
                continue;
            }
            let height = face.normal.dot(point - first.points[face.plane[0]]);
            above |= height > 0.0;
            if height > best.least + best.slack {
                continue;
            }
            if let Some(height) = over_face(
                first.points,
                &face.ring,
                face.normal,
                point,
                4.0 * best.slack,
            ) {
                let normals = (face.normal, face.normal);
                let mut plane = around(first.points, &face.ring, normals, point);
                // A needle of a face that is flat within rounding may be in another plane.
                let [from, p, q] = plane.map(|k| first.points[k]);
                let own = across(p - from, q - from).dot(point - from);
                if (own.abs() - height).abs() > best.slack {
                    plane = face.plane;
                }
                take(height, FeaturePair::FaceCorner, &plane, 0.0);
            }
        }
        inside |= first.dimension == 3 && !above;
        for edge in &first.edges {
            if let Some(distance) = from_edge(edge.ends.map(|k| first.points[k]), point) {
                take(distance, FeaturePair::EdgeCorner, &edge.ends, best.slack);
            }
        }
        for &other in &first.corners {
            let distance = (point - first.points[other]).length();
            take(distance, FeaturePair::Corners, &[other], best.slack);
        }
        if let Some(Near { distance, features }) = own {
            best.add(
                distance,
                if flipped {
                    features.flipped()
                } else {
                    features
                },
            );
        }
    }
    inside
}

/// Returns the nearest features of two hulls, all that tie within rounding, and their distance; zero where a corner is
/// inside the other hull.
pub(super) fn nearest(a: &Body<'_>, b: &Body<'_>, slack: f64) -> (Vec<Near>, f64) {
    let mut best = Best {
        all: Vec::new(),
        least: f64::INFINITY,
        slack,
    };
    let of_b = of_corners(a, b, false, &mut best);
    let of_a = of_corners(b, a, true, &mut best);
    for first in &a.edges {
        let ends = first.ends.map(|k| a.points[k]);
        for second in &b.edges {
            let others = second.ends.map(|k| b.points[k]);
            if let Some(distance) = of_edges(ends, others) {
                best.add(
                    distance,
                    edges(|k| a.points[k], first.ends, |k| b.points[k], second.ends),
                );
            }
        }
    }
    let Best { mut all, least, .. } = best;
    all.retain(|near| near.distance <= least + slack);
    let inside = of_a || of_b;
    (all, if inside { 0.0 } else { least })
}

/// Returns two edges in the order in which the product of the vectors along them points from a to b.
pub(super) fn edges(
    a: impl Fn(usize) -> Vec3<f64>,
    first: [usize; 2],
    b: impl Fn(usize) -> Vec3<f64>,
    second: [usize; 2],
) -> HullFeatures {
    let (from, to) = (a(first[0]), b(second[0]));
    let product = (a(first[1]) - from).cross(b(second[1]) - to);
    let [start, end] = second;
    let second = match product.dot(to - from) < 0.0 {
        true => [end, start],
        false => [start, end],
    };
    HullFeatures::new(FeaturePair::Edges, &first, &second)
}

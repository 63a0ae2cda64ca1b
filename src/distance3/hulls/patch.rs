//! The parts of two hulls in one plane that parts them: corners over faces, and edges that cross.
use super::body::{BEYOND, Body, across, unit};
use super::hull_record::{FeaturePair, HullFeatures, around};
use super::parting_planes::Plane;
use crate::hull::hull_search;
use crate::{Vec2, Vec3};

/// The part of a hull in a plane: a corner, an edge, or a face with its corners counter-clockwise.
struct Patch {
    corners: Vec<usize>,
    seen: Vec<Vec2<f64>>,
}

/// The corners of a hull that may be in a plane.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    pub points: &'a [Vec3<f64>],
    pub corners: &'a [usize],
}

impl<'a> From<&'a Body<'_>> for Side<'a> {
    fn from(body: &'a Body<'_>) -> Self {
        Side {
            points: body.points,
            corners: &body.corners,
        }
    }
}

/// Returns two directions of length one across a normal and each other.
fn axes(normal: Vec3<f64>) -> [Vec3<f64>; 2] {
    let axis = match normal.x.abs() < 0.6 {
        true => Vec3::new(1.0, 0.0, 0.0),
        false => Vec3::new(0.0, 1.0, 0.0),
    };
    let first = unit(normal.cross(axis));
    [first, normal.cross(first)]
}

/// Returns the corners of the part of a hull in the plane through one of them, counter-clockwise seen from the tip of
/// the normal.
pub(in crate::distance3) fn ring(
    points: &[Vec3<f64>],
    corners: &[usize],
    (corner, normal): (usize, Vec3<f64>),
    slack: f64,
) -> Vec<usize> {
    let view = (points[corner], axes(normal));
    patch(Side { points, corners }, (corner, normal), view, slack).corners
}

/// Returns the part of a hull in the plane through a corner, seen along two axes from a point.
fn patch(
    body: Side<'_>,
    (corner, normal): (usize, Vec3<f64>),
    (from, axes): (Vec3<f64>, [Vec3<f64>; 2]),
    slack: f64,
) -> Patch {
    let points = body.points;
    let in_plane = |&&k: &&usize| normal.dot(points[k] - points[corner]).abs() <= slack;
    let corners: Vec<usize> = body.corners.iter().filter(in_plane).copied().collect();
    let seen: Vec<_> = corners
        .iter()
        .map(|&k| Vec2::new(axes[0].dot(points[k] - from), axes[1].dot(points[k] - from)))
        .collect();
    let mut order = hull_search(&seen);
    // A face as thin as rounding is an edge.
    if let Some(ends) = thin(&seen, &order, slack) {
        order = ends.to_vec();
    }
    Patch {
        corners: order.iter().map(|&k| corners[k]).collect(),
        seen: order.iter().map(|&k| seen[k]).collect(),
    }
}

/// Returns the ends of a ring of more than two corners that is no wider than a slack.
fn thin(seen: &[Vec2<f64>], ring: &[usize], slack: f64) -> Option<[usize; 2]> {
    if ring.len() < 3 {
        return None;
    }
    let (mut ends, mut longest) = ([ring[0]; 2], -1.0);
    for (k, &i) in ring.iter().enumerate() {
        for &j in &ring[k + 1..] {
            let length = (seen[j] - seen[i]).length();
            if length > longest {
                (ends, longest) = ([i, j], length);
            }
        }
    }
    let [from, to] = ends.map(|k| seen[k]);
    let wide = |&k: &usize| (to - from).perp_dot(seen[k] - from).abs() > 4.0 * slack * longest;
    (!ring.iter().any(wide)).then_some(ends)
}

impl Patch {
    fn is_face(&self) -> bool {
        self.corners.len() > 2
    }
    /// Returns the edges, by places in the patch.
    fn edges(&self) -> impl Iterator<Item = [usize; 2]> {
        let n = self.corners.len();
        let count = if n == 2 { 1 } else { n * usize::from(n > 2) };
        (0..count).map(move |k| [k, (k + 1) % n])
    }
    /// Returns an edge for each corner of a face that is on the open part of another patch's one edge, which crosses it
    /// there: of both edges of the corner the one that is farther from parallel.
    fn corners_on(&self, other: &Patch, slack: f64) -> Vec<[usize; 2]> {
        let (true, &[from, to]) = (self.is_face(), &other.seen[..]) else {
            return Vec::new();
        };
        let (along, n) = (to - from, self.corners.len());
        let length = along.length();
        let on = |&k: &usize| {
            let arm = self.seen[k] - from;
            let share = along.dot(arm);
            let beyond = slack * length;
            along.perp_dot(arm).abs() <= beyond
                && share > beyond
                && share < length * length - beyond
        };
        let steep = |[k, l]: [usize; 2]| {
            let side = self.seen[l] - self.seen[k];
            along.perp_dot(side).abs() / side.length()
        };
        let edge = |k: usize| {
            let (before, after) = ([(k + n - 1) % n, k], [k, (k + 1) % n]);
            match steep(before) > steep(after) {
                true => before,
                false => after,
            }
        };
        let slanted = |&side: &[usize; 2]| steep(side) > SLANTED * length;
        (0..n).filter(on).map(edge).filter(slanted).collect()
    }
    /// Returns `true` for a face with a point on it.
    fn covers(&self, point: Vec2<f64>, slack: f64) -> bool {
        let inside = |[k, l]: [usize; 2]| {
            let (from, to) = (self.seen[k], self.seen[l]);
            (to - from).perp_dot(point - from) >= -slack * (to - from).length()
        };
        self.is_face() && self.edges().all(inside)
    }
}

/// Returns `true` if two edges cross between the ends of both.
fn cross([a, b]: [Vec2<f64>; 2], [c, d]: [Vec2<f64>; 2], slack: f64) -> bool {
    let apart = |[p, q]: [Vec2<f64>; 2], x: Vec2<f64>, y: Vec2<f64>| {
        let way = q - p;
        let bound = slack * way.length();
        let (x, y) = (way.perp_dot(x - p), way.perp_dot(y - p));
        (x > bound && y < -bound) || (x < -bound && y > bound)
    };
    apart([a, b], c, d) && apart([c, d], a, b)
}

/// The sine of two edges from which on they have a crossing.
const SLANTED: f64 = 1e-6;

/// Returns two edges, in the order in which the product of the vectors along them points along a normal.
fn crossing(
    (a, first): (&[Vec3<f64>], [usize; 2]),
    (b, second): (&[Vec3<f64>], [usize; 2]),
    normal: Vec3<f64>,
) -> HullFeatures {
    let along = |points: &[Vec3<f64>], [from, to]: [usize; 2]| points[to] - points[from];
    let product = along(a, first).cross(along(b, second));
    let [start, end] = second;
    let second = match product.dot(normal) < 0.0 {
        true => [end, start],
        false => second,
    };
    HullFeatures::new(FeaturePair::Edges, &first, &second)
}

/// Returns the corners of the overlap of both hulls' parts in a plane, as features that define it; the given ones if
/// rounding leaves none.
pub(super) fn features(a: Side<'_>, b: Side<'_>, plane: &Plane, slack: f64) -> Vec<HullFeatures> {
    let normal = plane.normal;
    let slack = slack.max(2.0 * BEYOND);
    let view = (a.points[plane.on_a], axes(normal));
    let of_a = patch(a, (plane.on_a, normal), view, slack);
    let of_b = patch(b, (plane.on_b, normal), view, slack);
    let mut all = Vec::new();
    if of_a.is_face() {
        for (&corner, &at) in of_b.corners.iter().zip(&of_b.seen) {
            if of_a.covers(at, slack) {
                let point = b.points[corner];
                let face = around(a.points, &of_a.corners, (normal, normal), point);
                all.push(HullFeatures::new(FeaturePair::FaceCorner, &face, &[corner]));
            }
        }
    }
    if of_b.is_face() {
        for (&corner, &at) in of_a.corners.iter().zip(&of_a.seen) {
            if of_b.covers(at, slack) {
                let point = a.points[corner];
                let face = around(b.points, &of_b.corners, (normal, -normal), point);
                all.push(HullFeatures::new(FeaturePair::CornerFace, &[corner], &face));
            }
        }
    }
    let on_a = of_b.corners_on(&of_a, slack);
    let on_b = of_a.corners_on(&of_b, slack);
    for [i, j] in of_a.edges() {
        for [k, l] in of_b.edges() {
            let ends = [[of_a.seen[i], of_a.seen[j]], [of_b.seen[k], of_b.seen[l]]];
            let named = on_a.contains(&[k, l]) || on_b.contains(&[i, j]);
            if !named && !cross(ends[0], ends[1], slack) {
                continue;
            }
            all.push(crossing(
                (a.points, [i, j].map(|k| of_a.corners[k])),
                (b.points, [k, l].map(|k| of_b.corners[k])),
                normal,
            ));
        }
    }
    // Needles and edges that are all but parallel may define another plane.
    all.retain(|features| {
        let gap = gap_of(a.points, b.points, features);
        (gap - plane.gap).abs() <= 8.0 * slack
    });
    if all.is_empty() {
        // Edges that meet at an end: of edges on a line the longest, which have the crossing.
        let along = |points: &[Vec3<f64>], [from, to]: [usize; 2]| unit(points[to] - points[from]);
        all.push(match (&of_a.corners[..], &of_b.corners[..]) {
            (&[i, j], &[k, l])
                if along(a.points, [i, j])
                    .cross(along(b.points, [k, l]))
                    .length()
                    > SLANTED =>
            {
                crossing((a.points, [i, j]), (b.points, [k, l]), normal)
            }
            _ => plane.features,
        });
    }
    all
}

/// Returns the gap along the direction that a face or two edges define.
pub(super) fn gap_of(a: &[Vec3<f64>], b: &[Vec3<f64>], features: &HullFeatures) -> f64 {
    let (a, b) = (
        features.a.map(|k| a[usize::from(k)]),
        features.b.map(|k| b[usize::from(k)]),
    );
    let face = |[from, p, q]: [Vec3<f64>; 3]| across(p - from, q - from);
    let normal = match features.pair {
        FeaturePair::FaceCorner => face(a),
        FeaturePair::CornerFace => -face(b),
        _ => across(a[1] - a[0], b[1] - b[0]),
    };
    normal.dot(b[0] - a[0])
}

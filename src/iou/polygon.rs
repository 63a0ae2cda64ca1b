//! Scores of convex polygons, by a search that is recorded.
use super::score;
use super::terms::part;
use crate::clipping::Corner;
use crate::error::Flaw;
use crate::hull::{MergeTrace, merge_replay, merge_search};
use crate::overlap_polygon::{iou_polygons, measure};
use crate::reference::Reference;
use crate::{ConvexPolygon, Scalar, Vec2};

/// Returns the generalised IoU of two convex polygons with the exact convex hull, in `[−1, 1]`, and the record of the
/// hull's vertices. Conventions: see the [module](super).
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, iou::giou_polygons_search};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 1.0, 1.0));
/// let b = ConvexPolygon::from(Aabb2::new(2.0, 0.0, 3.0, 1.0));
/// let (giou, _) = giou_polygons_search::<f64, 4, 4, 8>(&a, &b).unwrap();
/// assert!((giou + 1.0 / 3.0).abs() < 1e-15);
/// ```
///
/// # Errors
///
/// When both have more than `K` vertices together.
pub fn giou_polygons_search<S, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<(S, MergeTrace<K>), Flaw>
where
    S: Scalar<Mask = bool>,
{
    let trace = merge_search(a, b)?;
    Ok((giou_polygons_replay(a, b, &trace), trace))
}

/// Returns the generalised IoU of two convex polygons from both and the record of [`giou_polygons_search`].
#[must_use]
pub fn giou_polygons_replay<S: Scalar, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    trace: &MergeTrace<K>,
) -> S {
    let shared = measure(a, b);
    let [inter, area_a, area_b] = shared.areas;
    // Far from its local origin a polygon has the digits of its distance; without an overlap nothing need agree with
    // the other one's.
    let own = |known: S, vertices: &[Vec2<S>]| {
        S::select(shared.nothing, shared.seen.own_area(vertices), known)
    };
    let (area_a, area_b) = (own(area_a, a.as_slice()), own(area_b, b.as_slice()));
    let hull = merge_replay(a, b, trace);
    let mut twice = S::zero();
    for [start, end] in hull.edges() {
        twice += shared.seen.place(start).perp_dot(shared.seen.place(end));
    }
    let hull = twice.halved();
    // If one polygon is the hull of both, rounding must not separate the hull's area from its own.
    let corners = &trace.corners[..trace.count.min(K)];
    let all_a = trace.count == a.count && corners.iter().all(|c| matches!(c, Corner::A(_)));
    let all_b = trace.count == b.count && corners.iter().all(|c| matches!(c, Corner::B(_)));
    let hull = match (all_a, all_b) {
        (true, _) => hull.with_primal(area_a.primal()),
        (_, true) => hull.with_primal(area_b.primal()),
        _ => hull,
    };
    score(inter, area_a, area_b, hull).canonical()
}

/// The two vertices of two polygons that are farthest apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FarthestCorners {
    /// One of them, a vertex of either polygon.
    pub from: Corner,
    /// The other one.
    pub to: Corner,
}

/// Returns the distance IoU of two convex polygons, in `[−1, 1]`, and the record of the two vertices of the diameter.
/// It is IoU less the square of the distance of the centroids of their areas over the diameter of both together.
/// Compares all pairs of vertices. Conventions: see the [module](super).
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, iou::diou_polygons_search};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 1.0, 1.0));
/// assert_eq!(diou_polygons_search(&a, &a).0, 1.0);
/// ```
#[must_use]
pub fn diou_polygons_search<S: Scalar<Mask = bool>, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> (S, FarthestCorners) {
    let (all_a, all_b) = (a.as_slice(), b.as_slice());
    let corner = |k: usize| match k.checked_sub(all_a.len()) {
        None => (Corner::A(k), a.vertex(k)),
        Some(k) => (Corner::B(k), b.vertex(k)),
    };
    let seen = Reference::of_bounds(a.bounding().join(b.bounding()));
    let mut best = FarthestCorners {
        from: Corner::A(0),
        to: Corner::A(0),
    };
    let mut most = S::Primal::zero();
    for i in 0..all_a.len() + all_b.len() {
        for j in 0..i {
            let ((from, p), (to, q)) = (corner(j), corner(i));
            let found = (seen.place(p) - seen.place(q)).length_squared().primal();
            if found.above(most) {
                most = found;
                best = FarthestCorners { from, to };
            }
        }
    }
    (diou_polygons_replay(a, b, best), best)
}

/// Returns the distance IoU of two convex polygons from both and the record of [`diou_polygons_search`].
#[must_use]
pub fn diou_polygons_replay<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    record: FarthestCorners,
) -> S {
    // Seen from their own bounds: far from the origin a centroid has the digits of the distance.
    let seen = Reference::of_bounds(a.bounding().join(b.bounding()));
    let (a_seen, b_seen) = (placed(a, &seen), placed(b, &seen));
    let at = |corner: Corner| match corner {
        Corner::B(k) => b_seen.vertex(k),
        Corner::A(k) | Corner::Cross { a: k, .. } => a_seen.vertex(k),
    };
    let across = (at(record.to) - at(record.from)).length_squared();
    let way = (b_seen.centroid() - a_seen.centroid()).length_squared();
    (iou_polygons(a, b) - part(way, across)).canonical()
}

/// Returns a polygon in local coordinates.
fn placed<S: Scalar, const N: usize>(
    polygon: &ConvexPolygon<S, N>,
    seen: &Reference<S>,
) -> ConvexPolygon<S, N> {
    ConvexPolygon {
        vertices: polygon.vertices.map(|v| seen.place(v)),
        count: polygon.count,
    }
}

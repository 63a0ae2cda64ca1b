//! A convex polygon clipped to another one.
//!
//! The border of the result changes between both borders only where these meet. The line of every edge of the first
//! polygon enters and leaves the second one. The signs of exact predicates on given vertices decide where: first the
//! vertices farthest left and right of the line (two pointers that move around once), then, by bisection between those,
//! the changes of sign. The meetings are in one cyclic order on both borders, and from each one to the next the result
//! follows the border that turns farther inwards. `O(n log m)`.
use super::meeting::{ConvexRing, meetings};
use super::{ClipTrace, Corner, Side};
use crate::error::Flaw;
use crate::predicate::{Turn, turn_between};
use crate::{ConvexPolygon, Scalar};

/// Returns the record of the intersection of two convex polygons: where every vertex and every side of it is from.
/// Search exactly, `O(n log m)`; the polygons must be valid, or the record is undefined.
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, clipping::{Corner, Side, clip_search}};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
/// let b = ConvexPolygon::from(Aabb2::new(1.0, 1.0, 3.0, 3.0));
/// let trace = clip_search::<_, 4, 4, 8>(&a, &b).unwrap();
/// let cross = |a, b| Corner::Cross { a, b };
/// assert_eq!(trace.corners[..trace.count], [cross(1, 0), Corner::A(2), cross(2, 3), Corner::B(0)]);
/// assert_eq!(trace.sides[..trace.count], [Side::A(1), Side::A(2), Side::B(3), Side::B(0)]);
/// ```
///
/// # Errors
///
/// When the result has more than `K` vertices; `N + M` always suffice.
pub fn clip_search<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<ClipTrace<K>, Flaw> {
    let mut trace = ClipTrace::empty();
    let (a, b) = (ConvexRing(a.as_slice()), ConvexRing(b.as_slice()));
    let (n, m) = (a.len(), b.len());
    if n == 0 || m == 0 {
        return Ok(trace);
    }
    let Some(all) = meetings::<S, K>(a, b)? else {
        return Ok(trace);
    };
    let list = &all.list[..all.count];
    if list.is_empty() {
        if b.contains(a.at(0)) {
            (0..n).try_for_each(|k| trace.push(Corner::A(k), Side::A(k)))?;
        } else if a.contains(b.at(0)) {
            (0..m).try_for_each(|k| trace.push(Corner::B(k), Side::B(k)))?;
        }
        return Ok(trace);
    }
    for (k, from) in list.iter().enumerate() {
        let alone = list.len() == 1;
        let to = list[(k + 1) % list.len()];
        let (edge_a, edge_b) = (from.on_a / 2, from.on_b / 2);
        // Vertices strictly between the two points, on either border.
        let around = if k + 1 == list.len() { 2 * n } else { 0 };
        let chain_a = vertices_between(from.on_a, to.on_a + around);
        let way_b = (to.on_b + 2 * m - from.on_b) % (2 * m);
        let way_b = if alone { 2 * m } else { way_b };
        let chain_b = vertices_between(from.on_b, from.on_b + way_b);
        let inwards = turn_between(a.edge(edge_a), b.edge(edge_b));
        // With fewer than three meetings there may be nothing inside either border.
        let sure = list.len() > 2;
        let (follow_a, follow_b) = match inwards {
            Turn::Left => (false, sure || starts_inside(a, b, chain_b)),
            Turn::Right => (sure || starts_inside(b, a, chain_a), false),
            Turn::Straight => (false, false),
        };
        let side = if inwards == Turn::Left {
            Side::B(edge_b)
        } else {
            Side::A(edge_a)
        };
        trace.push(from.corner, side)?;
        if follow_a {
            for k in chain_a.0..chain_a.1 {
                trace.push(Corner::A(k % n), Side::A(k % n))?;
            }
        }
        if follow_b {
            for k in chain_b.0..chain_b.1 {
                trace.push(Corner::B(k % m), Side::B(k % m))?;
            }
        }
    }
    Ok(trace)
}

/// Returns the numbers of the vertices strictly between two points on a border, the end excluded.
fn vertices_between(from: usize, to: usize) -> (usize, usize) {
    (from / 2 + 1, to.div_ceil(2))
}

/// Returns `true` if the first vertex of a chain of `inner` lies in `outer`.
fn starts_inside<S: Scalar<Mask = bool>>(
    outer: ConvexRing<'_, S>,
    inner: ConvexRing<'_, S>,
    chain: (usize, usize),
) -> bool {
    chain.0 < chain.1 && outer.contains(inner.at(chain.0))
}

/// Returns the intersection of two convex polygons, from both and the record of [`clip_search`]. Derivatives of a
/// crossing are those of the two edges that cross; its own are unbounded as these become parallel, though those of
/// areas are not.
#[must_use]
pub fn clip_replay<S: Scalar, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    trace: &ClipTrace<K>,
) -> ConvexPolygon<S, K> {
    trace.replay(
        |k| [a.vertex(k), a.vertex(k + 1)],
        |k| [b.vertex(k), b.vertex(k + 1)],
    )
}

/// Returns the intersection of two convex polygons: a polygon, a segment (two vertices), a point (one) or nothing
/// (none).
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, Vec2, clipping::clip};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
/// let corner = ConvexPolygon::from(Aabb2::new(2.0, 2.0, 3.0, 3.0));
/// let shared: ConvexPolygon<f64, 8> = clip(&a, &corner).unwrap();
/// assert_eq!(shared.as_slice(), [Vec2::new(2.0, 2.0)]);
/// ```
///
/// # Errors
///
/// When the result has more than `K` vertices; `N + M` always suffice.
pub fn clip<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<ConvexPolygon<S, K>, Flaw> {
    clip_search(a, b).map(|trace| clip_replay(a, b, &trace))
}

impl<S: Scalar<Mask = bool>, const N: usize> ConvexPolygon<S, N> {
    /// Returns `true` if both polygons have a point in common; borders belong to both. Search exactly.
    ///
    /// ```
    /// use geograd::{Aabb2, ConvexPolygon};
    /// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
    /// assert!(a.touches(&ConvexPolygon::from(Aabb2::new(2.0, 2.0, 3.0, 3.0))));
    /// assert!(!a.touches(&ConvexPolygon::from(Aabb2::new(2.5, 2.0, 3.0, 3.0))));
    /// ```
    #[must_use]
    pub fn touches<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> bool {
        // More than there is room for is something, too.
        clip_search::<S, N, M, 1>(self, other).map_or(true, |trace| trace.count > 0)
    }
}

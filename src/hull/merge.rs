//! The joint hull of two convex polygons.
use super::{hull_decided_in, surplus};
use crate::clipping::Corner;
use crate::error::Flaw;
use crate::predicate::same;
use crate::{ConvexPolygon, Scalar, Vec2};

/// The record of a merge: where each vertex of the result is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MergeTrace<const K: usize> {
    /// One entry per vertex; the first `count` matter. Only corners of a and of b occur.
    pub corners: [Corner; K],
    /// The vertex of b that coincides with a vertex of a, for each one. Both share the derivative.
    pub twins: [Option<usize>; K],
    /// The number of vertices of the hull.
    pub count: usize,
}

/// Returns the vertices of two convex polygons that their joint hull has. Takes `O((n + m) log (n + m))`, and `O(n m)`
/// plain comparisons to find vertices that coincide.
///
/// # Errors
///
/// When both have more than `K` vertices together.
pub fn merge_search<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<MergeTrace<K>, Flaw> {
    let (a, b) = (a.as_slice(), b.as_slice());
    let count = a.len() + b.len();
    if count > K {
        return Err(surplus(K));
    }
    let (mut points, mut order) = ([Vec2::zero(); K], [0; K]);
    for (point, &vertex) in points.iter_mut().zip(a.iter().chain(b)) {
        *point = vertex;
    }
    let record = hull_decided_in(&points[..count], &mut order).unwrap_or(&[]);
    let mut trace = MergeTrace {
        corners: [Corner::A(0); K],
        twins: [None; K],
        count: record.len(),
    };
    let entries = trace.corners.iter_mut().zip(&mut trace.twins);
    for ((corner, twin), &k) in entries.zip(record) {
        *corner = match k.checked_sub(a.len()) {
            None => Corner::A(k),
            Some(k) => Corner::B(k),
        };
        if k < a.len() {
            *twin = b.iter().position(|&vertex| same(vertex, a[k]));
        }
    }
    Ok(trace)
}

/// Returns the joint hull from both polygons and the record of [`merge_search`].
#[must_use]
pub fn merge_replay<S: Scalar, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    trace: &MergeTrace<K>,
) -> ConvexPolygon<S, K> {
    let mut twins = trace.twins.iter();
    ConvexPolygon {
        vertices: trace.corners.map(|corner| {
            let twin = twins.next().copied().flatten();
            let vertex = match corner {
                Corner::B(k) => b.vertex(k),
                Corner::A(k) | Corner::Cross { a: k, .. } => a.vertex(k),
            };
            // Both vertices coincide: the point has the mean of both derivatives.
            twin.map_or(vertex, |k| vertex.least(b.vertex(k)))
        }),
        count: trace.count,
    }
}

/// Returns the hull of two convex polygons.
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, hull::merge};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 1.0, 1.0));
/// let b = ConvexPolygon::from(Aabb2::new(2.0, 0.0, 3.0, 1.0));
/// let both: ConvexPolygon<f64, 8> = merge(&a, &b).unwrap();
/// assert_eq!((both.count, both.area()), (4, 3.0));
/// ```
///
/// # Errors
///
/// When both have more than `K` vertices together.
pub fn merge<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<ConvexPolygon<S, K>, Flaw> {
    merge_search(a, b).map(|trace| merge_replay(a, b, &trace))
}

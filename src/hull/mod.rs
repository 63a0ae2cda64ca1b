//! Convex hulls of points and of two convex polygons, and Minkowski sums: by exact decisions, which
//! are recorded.
//!
//! A record says which given vertex each vertex of the result is; `…_replay` builds the result from the given vertices
//! and the record, so duals and adjoints pass through it: derivatives go to the vertices on the hull, points inside
//! have derivative zero. Collinear and repeated points are not on the hull; of coinciding points the first in order of
//! sorting is.
//!
//! Degenerate hulls are represented: a point by one vertex, a segment by two.
mod merge;
mod sum;

use crate::error::{Argument, Error, Flaw, VertexFault};
use crate::predicate::{Turn, left_to_right, same, turn};
use crate::{ConvexPolygon, Scalar, Vec2, ring};
pub use merge::{MergeTrace, merge, merge_replay, merge_search};
pub use sum::{SumTrace, minkowski_sum, minkowski_sum_replay, minkowski_sum_search};

/// Returns the convex hull of points, counter-clockwise from the leftmost one, as indices: written to the front
/// of `order`, and returned. `O(n log n)`, no allocation.
///
/// ```
/// use geograd::{Vec2, hull::hull_decided_in};
/// let points = [(0.0, 0.0), (1.0, 0.5), (2.0, 0.0), (1.0, 0.0), (1.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
/// let mut order = [0; 5];
/// assert_eq!(hull_decided_in(&points, &mut order).unwrap(), [0, 2, 4]);
/// ```
///
/// # Errors
///
/// When `order` is shorter than `points`.
pub fn hull_decided_in<'a, S: Scalar<Mask = bool>>(
    points: &[Vec2<S>],
    order: &'a mut [usize],
) -> Result<&'a [usize], Error> {
    let n = points.len();
    if order.len() < n {
        return Err(Error::Length {
            argument: Argument::Values,
            expected: n,
            found: order.len(),
        });
    }
    let order = &mut order[..n];
    for (k, place) in order.iter_mut().enumerate() {
        *place = k;
    }
    let by_place = |i: &usize, j: &usize| left_to_right(points[*i], points[*j]).then(i.cmp(j));
    order.sort_unstable_by(by_place);
    let (Some(&first), Some(&last)) = (order.first(), order.last()) else {
        return Ok(&[]);
    };
    // Points below the line from the first to the last, from left to right, then those above it in reverse. The highest
    // bit of a number marks a point above, so that each is tested once.
    const ABOVE: usize = !(usize::MAX >> 1);
    for k in order.iter_mut() {
        if turn(points[first], points[last], points[*k]) == Turn::Left {
            *k |= ABOVE;
        }
    }
    order.sort_unstable_by(|i, j| {
        let (p, q) = (i & !ABOVE, j & !ABOVE);
        let order = match (i & ABOVE != 0, j & ABOVE != 0) {
            (false, false) => left_to_right(points[p], points[q]),
            (true, true) => left_to_right(points[q], points[p]),
            (false, true) => std::cmp::Ordering::Less,
            (true, false) => std::cmp::Ordering::Greater,
        };
        order.then(p.cmp(&q))
    });
    let mut count = 0;
    for read in 0..n {
        let next = order[read] & !ABOVE;
        if count > 0 && same(points[order[count - 1]], points[next]) {
            continue;
        }
        while count > 1 && !left(points, order[count - 2], order[count - 1], next) {
            count -= 1;
        }
        order[count] = next;
        count += 1;
    }
    while count > 2 && !left(points, order[count - 2], order[count - 1], order[0]) {
        count -= 1;
    }
    if count == 2 && same(points[order[0]], points[order[1]]) {
        count = 1;
    }
    Ok(&order[..count])
}

fn left<S: Scalar<Mask = bool>>(points: &[Vec2<S>], a: usize, b: usize, c: usize) -> bool {
    turn(points[a], points[b], points[c]) == Turn::Left
}

/// Returns the convex hull of points, counter-clockwise from the leftmost one, as indices. `O(n log n)`.
#[must_use]
pub fn hull_search<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> Vec<usize> {
    let mut order = vec![0; points.len()];
    let count = hull_decided_in(points, &mut order).map_or(0, <[usize]>::len);
    order.truncate(count);
    order
}

/// Returns the hull's vertices from points and record.
///
/// # Panics
///
/// When the record has an index beyond the points.
pub fn hull_replay<'a, S: Copy>(
    points: &'a [Vec2<S>],
    record: &'a [usize],
) -> impl Iterator<Item = Vec2<S>> + 'a {
    record.iter().map(|&k| points[k])
}

/// Returns the convex hull of points as a polygon of up to `K` vertices.
///
/// ```
/// use geograd::{ConvexPolygon, Vec2, hull::hull};
/// let points = [(0.0, 0.0), (1.0, 0.5), (2.0, 0.0), (1.0, 0.0), (1.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
/// let around: ConvexPolygon<f64, 8> = hull(&points).unwrap();
/// assert_eq!(around.as_slice(), [points[0], points[2], points[4]]);
/// ```
///
/// # Errors
///
/// When the hull has more than `K` vertices.
pub fn hull<S: Scalar<Mask = bool>, const K: usize>(
    points: &[Vec2<S>],
) -> Result<ConvexPolygon<S, K>, Flaw> {
    let record = hull_search(points);
    if record.len() > K {
        return Err(surplus(K));
    }
    let mut made = ConvexPolygon {
        vertices: [Vec2::zero(); K],
        count: record.len(),
    };
    for (vertex, from) in made.vertices.iter_mut().zip(hull_replay(points, &record)) {
        *vertex = from;
    }
    Ok(made)
}

/// Returns the area of the convex hull of points, in squared units of length, and its record. Zero for
/// fewer than three points that are not on a line. Derivatives: see [`hull_area_replay`].
#[must_use]
pub fn hull_area_search<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> (S, Vec<usize>) {
    let record = hull_search(points);
    (hull_area_replay(points, &record), record)
}

/// Returns the area of a hull from points and record. Derivatives are those of the vertices on the hull; kinks
/// where a point passes through the hull's border.
///
/// # Panics
///
/// When the record has an index beyond the points.
#[must_use]
pub fn hull_area_replay<S: Scalar>(points: &[Vec2<S>], record: &[usize]) -> S {
    ring::signed_area(&hull_replay(points, record).collect::<Vec<_>>())
}

pub(crate) fn surplus(capacity: usize) -> Flaw {
    Flaw::Vertex {
        index: capacity,
        fault: VertexFault::Surplus,
    }
}

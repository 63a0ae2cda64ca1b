//! Convex hulls of points and of two convex polygons, and Minkowski sums: by exact decisions, which
//! are recorded.
//!
//! A record says which given vertex each vertex of the result is; `…_replay` builds the result from the
//! given vertices and the record, so duals and adjoints pass through it: slopes go to the vertices on
//! the hull, points inside have slope zero. Collinear and repeated points are not on the hull; of
//! points at the same place the first in order of sorting is.
//!
//! Degenerate hulls are represented: a point by one vertex, a segment by two.
use crate::clipping::Corner;
use crate::error::{Argument, Error, Flaw, VertexFault};
use crate::predicate::{Turn, left_to_right, same, turn, turn_between};
use crate::{ConvexPolygon, Scalar, Vec2, ring};

/// The convex hull of points, counter-clockwise from the leftmost one, as indices: written to the front
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
    // Below the line from the first to the last from left to right, then those above it back.
    let above = |k: &usize| turn(points[first], points[last], points[*k]) == Turn::Left;
    order.sort_unstable_by(|i, j| match (above(i), above(j)) {
        (false, false) => by_place(i, j),
        (true, true) => left_to_right(points[*j], points[*i]).then(i.cmp(j)),
        (false, true) => std::cmp::Ordering::Less,
        (true, false) => std::cmp::Ordering::Greater,
    });
    let mut count = 0;
    for read in 0..n {
        let next = order[read];
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

/// The convex hull of points, counter-clockwise from the leftmost one, as indices. `O(n log n)`.
#[must_use]
pub fn hull_decided<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> Vec<usize> {
    let mut order = vec![0; points.len()];
    let count = hull_decided_in(points, &mut order).map_or(0, <[usize]>::len);
    order.truncate(count);
    order
}

/// The hull's vertices from points and record.
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

/// The convex hull of points as a polygon of up to `K` vertices.
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
    let record = hull_decided(points);
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

/// The area of the convex hull of points, in squared units of length, and its record. Zero for
/// fewer than three points that are not on a line. Slopes: see [`hull_area_replay`].
#[must_use]
pub fn hull_area_decided<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> (S, Vec<usize>) {
    let record = hull_decided(points);
    (hull_area_replay(points, &record), record)
}

/// The area of a hull from points and record. Slopes are those of the vertices on the hull; kinks
/// where a point passes through the hull's border.
///
/// # Panics
///
/// When the record has an index beyond the points.
#[must_use]
pub fn hull_area_replay<S: Scalar>(points: &[Vec2<S>], record: &[usize]) -> S {
    ring::signed_area(&hull_replay(points, record).collect::<Vec<_>>())
}

/// What two polygons were made into: where each vertex of the result is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MergeTrace<const K: usize> {
    /// One entry per vertex; the first `count` matter. Only corners of a and of b occur.
    pub corners: [Corner; K],
    /// For corners of a at the place of a vertex of b: which one. Both share the slope.
    pub twins: [Option<usize>; K],
    /// How many vertices the hull has.
    pub count: usize,
}

/// Which vertices of two convex polygons their joint hull has: `O((n + m) log (n + m))`, and `O(n m)`
/// plain comparisons to find vertices that coincide.
///
/// # Errors
///
/// When both have more than `K` vertices together.
pub fn merge_decided<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
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

/// The joint hull from both polygons and the record of [`merge_decided`].
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
            // The same place, with the mean of both slopes.
            twin.map_or(vertex, |k| vertex.least(b.vertex(k)))
        }),
        count: trace.count,
    }
}

/// The hull of two convex polygons.
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
    merge_decided(a, b).map(|trace| merge_replay(a, b, &trace))
}

/// What a Minkowski sum is made of: each vertex is the sum of a vertex of `a` and one of `b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SumTrace<const K: usize> {
    /// A vertex of a and one of b; the first `count` pairs matter.
    pub pairs: [(usize, usize); K],
    /// How many vertices the sum has.
    pub count: usize,
}

/// Which vertices the Minkowski sum of two convex polygons has: their edges in the order of their
/// directions, parallel ones joined. `O(n + m)`.
///
/// # Errors
///
/// When the sum has more than `K` vertices.
pub fn minkowski_sum_decided<S, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<SumTrace<K>, Flaw>
where
    S: Scalar<Mask = bool>,
{
    let (a, b) = (a.as_slice(), b.as_slice());
    let mut trace = SumTrace {
        pairs: [(0, 0); K],
        count: 0,
    };
    if a.is_empty() || b.is_empty() {
        return Ok(trace);
    }
    let lowest = |p: &[Vec2<S>]| {
        let order = |i: &usize, j: &usize| left_to_right(p[*i], p[*j]);
        (0..p.len()).min_by(order).unwrap_or(0)
    };
    let (from_a, from_b) = (lowest(a), lowest(b));
    let edge = |p: &[Vec2<S>], k: usize| [p[k % p.len()], p[(k + 1) % p.len()]];
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let (of_a, of_b) = (edge(a, from_a + i), edge(b, from_b + j));
        // Edges of length zero have no direction.
        if i < a.len() && same(of_a[0], of_a[1]) {
            i += 1;
            continue;
        }
        if j < b.len() && same(of_b[0], of_b[1]) {
            j += 1;
            continue;
        }
        if trace.count == K {
            return Err(surplus(K));
        }
        trace.pairs[trace.count] = ((from_a + i) % a.len(), (from_b + j) % b.len());
        trace.count += 1;
        // From the leftmost vertex on edges first run to the right, then back.
        let back = |e: [Vec2<S>; 2]| left_to_right(e[0], e[1]).is_gt();
        let first = if i == a.len() {
            Turn::Right
        } else if j == b.len() {
            Turn::Left
        } else {
            match (back(of_a), back(of_b)) {
                (false, true) => Turn::Left,
                (true, false) => Turn::Right,
                _ => turn_between(of_a, of_b),
            }
        };
        i += usize::from(first != Turn::Right);
        j += usize::from(first != Turn::Left);
    }
    if trace.count == 0 && K > 0 {
        trace.pairs[0] = (from_a, from_b);
        trace.count = 1;
    }
    Ok(trace)
}

/// The Minkowski sum from both polygons and the record of [`minkowski_sum_decided`].
#[must_use]
pub fn minkowski_sum_replay<S: Scalar, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    trace: &SumTrace<K>,
) -> ConvexPolygon<S, K> {
    ConvexPolygon {
        vertices: trace.pairs.map(|(i, j)| {
            let sum = a.vertex(i) + b.vertex(j);
            Vec2::new(sum.x.saturated(), sum.y.saturated()).canonical()
        }),
        count: trace.count,
    }
}

/// The Minkowski sum of two convex polygons: all sums of a point of one and a point of the other.
/// Coordinates saturate at the largest finite number.
///
/// Kinks: parallel edges, where the sum is smooth but its vertices are not.
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, Vec2, hull::minkowski_sum};
/// let square = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 1.0, 1.0));
/// let triangle = ConvexPolygon::from([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y)));
/// let sum: ConvexPolygon<f64, 7> = minkowski_sum(&square, &triangle).unwrap();
/// assert_eq!((sum.count, sum.area()), (5, 3.5));
/// ```
///
/// # Errors
///
/// When the sum has more than `K` vertices.
pub fn minkowski_sum<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<ConvexPolygon<S, K>, Flaw> {
    minkowski_sum_decided(a, b).map(|trace| minkowski_sum_replay(a, b, &trace))
}

fn surplus(capacity: usize) -> Flaw {
    Flaw::Vertex {
        index: capacity,
        fault: VertexFault::Surplus,
    }
}

//! Minkowski sums of convex polygons.
use super::surplus;
use crate::error::Flaw;
use crate::predicate::{Turn, left_to_right, same, turn_between};
use crate::{ConvexPolygon, Scalar, Vec2};

/// The record of a Minkowski sum: each vertex is the sum of a vertex of `a` and one of `b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SumTrace<const K: usize> {
    /// A vertex of a and one of b; the first `count` pairs matter.
    pub pairs: [(usize, usize); K],
    /// The number of vertices of the sum.
    pub count: usize,
}

/// Returns the vertices of the Minkowski sum of two convex polygons: their edges in the order of their directions,
/// parallel ones joined. Takes `O(n + m)`.
///
/// # Errors
///
/// When the sum has more than `K` vertices.
pub fn minkowski_sum_search<S, const N: usize, const M: usize, const K: usize>(
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

/// Returns the Minkowski sum from both polygons and the record of [`minkowski_sum_search`].
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

/// Returns the Minkowski sum of two convex polygons: all sums of a point of one and a point of the other.
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
    minkowski_sum_search(a, b).map(|trace| minkowski_sum_replay(a, b, &trace))
}

//! A convex polygon cut by a line.
use super::{ClipTrace, Corner, Side};
use crate::error::{Flaw, VertexFault};
use crate::predicate::{Turn, turn};
use crate::{ConvexPolygon, Scalar, Vec2};

/// Returns the part of a convex polygon on the left of the line through two points, as a record: corners of the polygon
/// are `A`, the line is edge 0 of `B`. `O(n)`. The line itself belongs to its left, so a polygon that only touches it
/// leaves a point or a segment. If both points of the line coincide, the result is the whole polygon.
///
/// # Errors
///
/// When more than `K` vertices are left; `N + 1` always suffice.
pub fn half_plane_search<S: Scalar<Mask = bool>, const N: usize, const K: usize>(
    polygon: &ConvexPolygon<S, N>,
    line: [Vec2<S>; 2],
) -> Result<ClipTrace<K>, Flaw> {
    let all = polygon.as_slice();
    let side = |k: usize| turn(line[0], line[1], all[k]);
    let mut trace = ClipTrace::empty();
    for k in 0..all.len() {
        let next = if k + 1 < all.len() { k + 1 } else { 0 };
        let (here, there) = (side(k), side(next));
        if here != Turn::Right {
            let along = (here, there) == (Turn::Straight, Turn::Right);
            let side = if along { Side::B(0) } else { Side::A(k) };
            trace.push(Corner::A(k), side)?;
        }
        if (here, there) == (Turn::Left, Turn::Right) {
            trace.push(Corner::Cross { a: k, b: 0 }, Side::B(0))?;
        }
        if (here, there) == (Turn::Right, Turn::Left) {
            trace.push(Corner::Cross { a: k, b: 0 }, Side::A(k))?;
        }
    }
    Ok(trace)
}

/// Returns the part of a polygon on the left of a line, from both and the record of [`half_plane_search`].
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, Vec2};
/// use geograd::clipping::{half_plane_search, half_plane_replay};
/// let square = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
/// let diagonal = [Vec2::new(0.0, 0.0), Vec2::new(2.0, 2.0)];
/// let trace = half_plane_search::<_, 4, 5>(&square, diagonal).unwrap();
/// assert_eq!(half_plane_replay(&square, diagonal, &trace).area(), 2.0);
/// ```
#[must_use]
pub fn half_plane_replay<S: Scalar, const N: usize, const K: usize>(
    polygon: &ConvexPolygon<S, N>,
    line: [Vec2<S>; 2],
    trace: &ClipTrace<K>,
) -> ConvexPolygon<S, K> {
    trace.replay(|k| [polygon.vertex(k), polygon.vertex(k + 1)], |_| line)
}

impl<const K: usize> ClipTrace<K> {
    /// Returns a record of nothing.
    pub(super) fn empty() -> Self {
        ClipTrace {
            corners: [Corner::A(0); K],
            sides: [Side::A(0); K],
            count: 0,
        }
    }
    /// Appends a vertex and the side that starts there.
    pub(super) fn push(&mut self, corner: Corner, side: Side) -> Result<(), Flaw> {
        if self.count == K {
            return Err(Flaw::Vertex {
                index: K,
                fault: VertexFault::Surplus,
            });
        }
        self.corners[self.count] = corner;
        self.sides[self.count] = side;
        self.count += 1;
        Ok(())
    }
    /// Returns the vertices, from the edges of both.
    pub(super) fn replay<S: Scalar>(
        &self,
        edge_a: impl Fn(usize) -> [Vec2<S>; 2],
        edge_b: impl Fn(usize) -> [Vec2<S>; 2],
    ) -> ConvexPolygon<S, K> {
        let mut vertices = [Vec2::zero(); K];
        for (vertex, &corner) in vertices.iter_mut().zip(&self.corners[..self.count.min(K)]) {
            *vertex = match corner {
                Corner::A(k) => edge_a(k)[0],
                Corner::B(k) => edge_b(k)[0],
                Corner::Cross { a, b } => super::crossing::crossing(edge_a(a), edge_b(b)),
            };
        }
        ConvexPolygon {
            vertices,
            count: self.count,
        }
    }
}

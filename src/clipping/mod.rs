//! Clipping of convex polygons, with the provenance of every vertex and edge.
//!
//! A search decides, with exact predicates on the given vertices only, which corners and crossings the result
//! has: [`clip_search`]. Its record holds no numbers. [`clip_replay`] makes the polygon from the given ones and
//! the record, so duals pass through it; its adjoint replays it likewise. The result of shapes that only touch is
//! a point (one vertex) or a segment (two); that of shapes apart is empty (none).
//!
//! Every vertex has one origin, as the record names it, and all of its derivative is by that: a vertex that both
//! polygons have is the first one's, or the crossing of two edges. So `clip(a, a)` has the derivatives of its first
//! argument alone, where [`overlap_polygon`](crate::overlap_polygon) and [`hull::merge`](crate::hull::merge()) share
//! derivatives between equals.
//!
//! For the area of an intersection nothing need be clipped: see [`overlap_polygon`](crate::overlap_polygon).
mod convex_pair;
pub(crate) mod crossing;
mod half_plane;
mod meeting;

pub use convex_pair::{clip, clip_replay, clip_search};
pub use half_plane::{half_plane_replay, half_plane_search};

/// The origin of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Corner {
    /// A vertex of the first polygon, by number.
    A(usize),
    /// A vertex of the second polygon, by number.
    B(usize),
    /// The crossing of an edge of the first with an edge of the second polygon, each by the number of
    /// its start.
    Cross {
        /// The edge of the first polygon.
        a: usize,
        /// The edge of the second polygon.
        b: usize,
    },
}

/// The edge that a side of a clipped polygon lies on, by the number of its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// An edge of the first polygon.
    A(usize),
    /// An edge of the second polygon.
    B(usize),
}

/// The record of clipping: the provenance of every vertex and edge of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClipTrace<const K: usize> {
    /// The origin of each vertex, counter-clockwise; the first `count` matter.
    pub corners: [Corner; K],
    /// The edge on which the side from each vertex to the next one lies. If edges of both lie along each other,
    /// it is that of the first.
    pub sides: [Side; K],
    /// The number of vertices of the result: 0 when apart, 1 for a point, 2 for a segment.
    pub count: usize,
}

//! Polygons of any kind: with holes, of many parts, as rings of either orientation.
//!
//! [`Polygon`] owns its vertices, [`Rings`] borrows them; functions take everything that converts to [`Rings`]: a slice
//! of vertices (one ring), a slice of slices, a slice of lists, or a reference to a [`Polygon`]. Holes are not marked.
//! They follow from the position of the rings:
//!
//! * [`area`], [`centroid`], [`second_moments`] and the overlap of
//!   [`overlap_polygon::holed`](crate::overlap_polygon::holed) take rings that do not cross, nested to any
//!   depth and each of either orientation. Points that an odd number of rings enclose are inside.
//!   [`Sides`] is that decision, made once and kept.
//! * [`locate`](Rings::locate), [`contains`](Rings::contains), [`depth`](Rings::depth) and
//!   [`boolean`](crate::boolean) take rings of any kind, and a [`Fill`] that says which winding numbers
//!   are inside.
//!
//! The vertices of all rings are numbered one ring after the other: so are their cotangents.
pub(crate) mod box_ends;
pub(crate) mod box_tree;
mod edge_boxes;
mod located;
mod measure;
mod nearest_few;
mod parts;
mod polygon_gap;
mod sides;
pub(crate) mod slabs;

pub use crate::distance::ring::Fill;
pub use edge_boxes::{EdgeBoxes, NearestEdges};
pub use measure::{area, centroid, perimeter, second_moments, signed_area};
pub use parts::{Polygon, Rings};
pub use polygon_gap::{DistanceRoom, distance};
pub use sides::Sides;
pub use slabs::Slabs;

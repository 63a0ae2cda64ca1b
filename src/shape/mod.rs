//! Shapes, a noun a file.
pub mod polygon;

pub use polygon::ConvexPolygon;

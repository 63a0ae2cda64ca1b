//! Shapes, a noun a file.
mod convexity;
pub mod polygon;

pub use polygon::ConvexPolygon;

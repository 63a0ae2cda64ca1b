//! Polygons: rows of tables, and their scores.
mod part;
mod score;
mod simple;

pub use part::Derivatives;
pub use score::score;
pub use simple::Polygon;

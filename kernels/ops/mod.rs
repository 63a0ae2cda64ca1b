//! The rows: every operation of the library, a family a file.
pub mod distance;
pub mod extent;
pub mod fold;
pub mod overlap;
pub mod ring;
pub mod shape;

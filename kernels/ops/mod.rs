//! The rows: every operation of the library, a family a file.
pub mod distance;
pub mod extent;
pub mod fold;
pub mod gaussian;
pub mod iou3;
pub mod overlap;
pub mod overlap3;
pub mod ring;
pub mod shape;

//! The rows: every operation of the library, a family a file.
pub mod class;
pub mod convention;
pub mod distance;
pub mod distance3;
pub mod extent;
pub mod fold;
pub mod gaussian;
pub mod intersection;
pub mod interval;
pub mod iou;
pub mod iou3;
pub mod noun;
pub mod overlap;
pub mod overlap3;
pub mod polygon;
pub mod ring;
mod rows;
pub mod shape;

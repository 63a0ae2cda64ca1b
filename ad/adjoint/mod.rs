//! Adjoints by hand: the hot paths.
pub mod clip;
pub mod clipping;
pub mod iou;
pub mod overlap;
pub mod overlap_polygon;
pub mod ring;
pub mod upright;

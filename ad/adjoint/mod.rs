//! Adjoints by hand, for functions on hot paths. Other functions get their derivatives from duals or recorded programs.
pub mod boolean;
pub mod bounds3;
pub mod clip;
pub mod clipping;
pub mod distance;
pub mod iou;
pub(crate) mod iou3;
pub mod overlap;
pub mod overlap3;
pub mod overlap_mixed;
pub mod overlap_polygon;
pub mod overlap_quad;
pub mod overlap_rings;
pub mod polygon;
pub mod ring;
pub mod suppression;
pub mod upright;

//! Adjoints by hand: the hot paths.
pub mod clip;
pub mod overlap;
pub mod ring;

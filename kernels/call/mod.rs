//! Calls: a function's recording, and the derivative to compute.
mod directions;
pub(crate) mod folding;
pub(crate) mod modes;
mod program;
pub mod recording;
pub(crate) mod replayed;
pub mod search;
pub(crate) mod searched;

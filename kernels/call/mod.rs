//! Calls: what is asked of a function. Its recording, and the derivative that is wanted.
mod directions;
pub(crate) mod folding;
pub(crate) mod modes;
mod program;
pub mod recording;
pub(crate) mod replayed;
pub mod search;

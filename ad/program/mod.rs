//! Programs: generic functions, recorded once.
pub(crate) mod evaluate;
pub(crate) mod graph;
mod simplify;

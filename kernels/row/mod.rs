//! Rows: what a function is. Its shapes as numbers, its formula, what it declares, and its derivatives.
pub(crate) mod bounds;
pub(crate) mod compiled;
pub(crate) mod decision;
pub(crate) mod declares;
pub(crate) mod derivation;
pub(crate) mod derivatives;
pub mod fold;
pub mod item;
pub(crate) mod limits;
pub(crate) mod once;
pub mod op;
mod operation;
pub(crate) mod straight_line;

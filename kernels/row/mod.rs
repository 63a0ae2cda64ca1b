//! Rows: shapes as numbers, formulas, declared properties, and derivatives.
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

//! Block kernels that know nothing of operations: rows into tiles and back, what bounds tell, sums.
//!
//! Compiled in this library only, by the entries in `arch`.
mod bounds;
mod numbers;
mod rows;
mod slopes;

pub(crate) use bounds::{near, search};
pub(crate) use numbers::{
    add_up, all_aabb2, all_finite, all_up_to, all_within, count_above, largest,
};
pub(crate) use rows::{QUAD, bring, gather, scatter, spread, take};
pub(crate) use slopes::{accumulate, accumulate_picked};

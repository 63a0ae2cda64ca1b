//! Block kernels that are independent of operations: transposition of rows and tiles, searches in bounds, sums.
//!
//! Compiled in this library only, by the entries in `arch`.
mod bounds;
mod derivatives;
mod gaps;
mod numbers;
mod rows;

pub(crate) use bounds::{near, search};
pub(crate) use derivatives::{accumulate, accumulate_picked};
pub(crate) use gaps::{SPACE, gaps, reach, widen};
pub(crate) use numbers::{
    add_up, all_aabb2, all_finite, all_up_to, all_within, count_above, largest,
};
pub(crate) use rows::{QUAD, bring, broadcast, gather, scatter, take};

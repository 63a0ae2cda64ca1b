//! Batches on the CPU: SIMD lanes inside, threads outside, the same bits for any number of either.
//!
//! The generic source runs on bundles of lanes. The instruction set is chosen at run time, once
//! per stretch of work, so a default build uses AVX-512 where there is AVX-512; see
//! [`Simd`](simd::Simd). Shapes go in as slices of shapes. Inputs are checked
//! before anything is written: on an error every buffer is as it was.
//!
//! With the feature `parallel` the work is spread over rayon's current thread pool (run inside
//! `pool.install` to choose another). It is cut the same way for any number of threads, and sums
//! are added in a fixed order.
#[forbid(unsafe_code)]
mod aligned;
#[forbid(unsafe_code)]
mod all_pairs;
#[allow(unsafe_code)]
pub(crate) mod arch;
#[forbid(unsafe_code)]
mod blocks;
#[forbid(unsafe_code)]
mod boxes;
#[forbid(unsafe_code)]
pub(crate) mod checked;
#[forbid(unsafe_code)]
mod culling;
#[forbid(unsafe_code)]
mod desk;
#[forbid(unsafe_code)]
pub(crate) mod drivers;
#[forbid(unsafe_code)]
pub(crate) mod lane;
#[forbid(unsafe_code)]
pub(crate) mod pairs;
#[forbid(unsafe_code)]
mod plan;
#[doc(hidden)]
#[forbid(unsafe_code)]
pub mod program;
#[forbid(unsafe_code)]
mod ragged;
#[forbid(unsafe_code)]
mod reductions;
#[forbid(unsafe_code)]
pub(crate) mod rings;
#[forbid(unsafe_code)]
pub mod simd;
#[forbid(unsafe_code)]
pub(crate) mod sweep;
#[forbid(unsafe_code)]
mod tree;
#[forbid(unsafe_code)]
mod work;

use crate::kernels::op::PairOp;

pub use aligned::{
    AlignedGrads, aligned, aligned_grad, aligned_grad_into, aligned_into, aligned_vjp,
    aligned_vjp_into,
};
pub use all_pairs::{
    PairGrads, all_pairs, all_pairs_grad, all_pairs_grad_into, all_pairs_into, all_pairs_vjp,
    all_pairs_vjp_into,
};
pub use culling::cull;
pub(crate) use ragged::check_ragged;
pub use ragged::{RaggedGrads, ragged, ragged_grad, ragged_into, ragged_vjp, ragged_vjp_into};

/// A first shape of a pair operation.
pub type A<O, T> = <O as PairOp>::A<T>;
/// A second shape of a pair operation.
pub type B<O, T> = <O as PairOp>::B<T>;
/// Slopes with respect to every shape of both lists.
pub type Bars<O, T> = (Vec<A<O, T>>, Vec<B<O, T>>);

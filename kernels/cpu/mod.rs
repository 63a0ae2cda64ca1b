//! Batches on the CPU: SIMD lanes inside, threads outside, the same bits for any number of either.
//!
//! Operations with compiled kernels run their generic source on bundles of lanes; all others, and
//! programs, are recorded and interpreted block by block. The instruction set is chosen at run time, once
//! per stretch of work, so a default build uses AVX-512 where there is AVX-512; see
//! [`Simd`](simd::Simd). Inputs are checked before anything is written: on an error every buffer is as
//! it was.
//!
//! With the feature `parallel` the work is spread over rayon's current thread pool (run inside
//! `pool.install` to choose another). It is cut the same way for any number of threads, and sums
//! are added in a fixed order.
#[forbid(unsafe_code)]
pub(crate) mod aligned;
#[forbid(unsafe_code)]
pub(crate) mod all_pairs;
#[allow(unsafe_code)]
pub(crate) mod arch;
#[forbid(unsafe_code)]
mod blocks;
#[forbid(unsafe_code)]
mod boxes;
#[forbid(unsafe_code)]
mod boxes3;
#[forbid(unsafe_code)]
pub(crate) mod checked;
#[forbid(unsafe_code)]
mod desk;
#[forbid(unsafe_code)]
pub(crate) mod drivers;
#[forbid(unsafe_code)]
pub(crate) mod folds;
#[forbid(unsafe_code)]
pub(crate) mod greedy;
#[forbid(unsafe_code)]
pub(crate) mod lane;
#[forbid(unsafe_code)]
pub(crate) mod nearest;
#[forbid(unsafe_code)]
pub(crate) mod pairs;
#[forbid(unsafe_code)]
pub(crate) mod plan;
#[forbid(unsafe_code)]
pub mod polygons;
#[doc(hidden)]
#[forbid(unsafe_code)]
pub mod program;
#[forbid(unsafe_code)]
mod quads;
#[forbid(unsafe_code)]
mod ragged;
#[forbid(unsafe_code)]
mod reductions;
#[forbid(unsafe_code)]
pub(crate) mod rings;
#[forbid(unsafe_code)]
pub mod simd;
#[forbid(unsafe_code)]
mod solids;
#[forbid(unsafe_code)]
pub(crate) mod sweep;
#[forbid(unsafe_code)]
mod table;
#[forbid(unsafe_code)]
mod tree;
#[forbid(unsafe_code)]
pub(crate) mod upright;
#[forbid(unsafe_code)]
pub(crate) mod work;

pub use crate::kernels::row::Single;
#[doc(hidden)]
pub use plan::{Compiled, Face, Want};
pub(crate) use ragged::check_ragged;
pub use table::Table;

/// The processor: all its lanes, and all threads of rayon's current pool.
///
/// ```
/// use geograd::kernels::{Cpu, Op, Iou};
/// use geograd::Obb2;
/// let guesses = [Obb2::new(0.0_f32, 0.0, 2.0, 2.0, 0.0), Obb2::new(4.0, 1.0, 2.0, 1.0, 0.5)];
/// let truths = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(4.0, 1.0, 2.0, 1.0, 0.4)];
/// let cpu = Cpu::new();
/// let iou = cpu.aligned(Iou, (&guesses, &truths))?;
/// let (iou_again, (by_guess, by_truth)) = cpu.aligned(Iou.value_grad(), (&guesses, &truths))?;
/// let matrix = cpu.all_pairs(Iou, &guesses, &truths)?;
/// assert_eq!(iou, iou_again);
/// assert_eq!(matrix.values()[0], iou[0]);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cpu {
    cull: bool,
}

impl Default for Cpu {
    fn default() -> Self {
        Cpu::new()
    }
}

impl Cpu {
    /// With the filter of all-pairs batches on.
    #[must_use]
    pub const fn new() -> Self {
        Cpu { cull: true }
    }
    /// The same with the filter of all-pairs batches on or off.
    ///
    /// The filter compares bounds before anything else is computed. Results are the same bits either
    /// way; where nearly all pairs overlap it costs a few hundredths of the time, which it notices and
    /// saves.
    #[must_use]
    pub const fn culled(self, cull: bool) -> Self {
        Cpu { cull }
    }
}

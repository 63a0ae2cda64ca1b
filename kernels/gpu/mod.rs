//! Batches on a GPU, through whatever wgpu finds: Vulkan, Metal, DX12, GL, or a driver in software.
//!
//! A [`Gpu`] is a context; cloning it is cheap and clones share everything. Shapes are uploaded
//! once ([`Gpu::upload`]), operations run on handles and give handles, and only what is asked for
//! comes back (`download`, or `start_download` without blocking). Handles of another context are
//! refused.
//!
//! Results are the processor's to within rounding, and the same bits on every run: sums are added
//! in a fixed order, without atomics. More than a dispatch, a binding or a buffer may hold is
//! split, so sizes are limited by memory alone.
//!
//! | what | call |
//! | --- | --- |
//! | row i with row i | [`Gpu::aligned`], [`Gpu::aligned_grad`], [`Gpu::aligned_vjp`] |
//! | every row with every row | [`Gpu::all_pairs`], [`Gpu::all_pairs_grad`], [`Gpu::all_pairs_vjp`] |
//! | the same, reduced where it is | [`Gpu::row_max`], [`Gpu::column_max`], [`Gpu::above`], [`Gpu::sum`] |
//! | a loss with its gradient | [`Gpu::sum_grad`], [`Gpu::mean_grad`] |
//! | a matrix that is there already | [`Matrix::row_max`], [`Matrix::above`], [`Matrix::sum`] |
//! | the best match of each | [`Shapes::pick`] |
//! | other shapes in the same buffers | [`Shapes::update`], [`Values::update`], [`Matrix::update`] |
//! | rings | [`Gpu::ragged`], [`Gpu::ragged_vjp`] |
//! | any operation, any program | [`Gpu::programs`]: `aligned`, `all_pairs`, reductions, `fold` |
//! | the same over data that stay | [`Backend::resident`](crate::kernels::Backend::resident) |
//! | suppression, with the processor's result | [`Gpu::programs`]: `suppress` |
//!
//! # Two kinds of kernels
//!
//! Scores of two boxes in the plane and measures of rings have kernels by hand, over handles of shapes that
//! stay on the GPU. Everything else, and these as well, runs by kernels that are *generated* from what an
//! operation was recorded as: [`Gpu::programs`] has the calls of [`Cpu`](crate::kernels::Cpu), with the
//! operation as a value and slices as columns.
//!
//! What searches (clipping, hulls) is decided on the processor, item by item, and replayed here, with its
//! slopes: every record that occurs becomes a list of instructions, and one kernel carries out all of them.
//! Of all pairs that would decide every pair on the processor, and is refused with
//! [`Unrecordable::Search`](crate::Unrecordable::Search).
//!
//! # Rounding
//!
//! WGSL lets a driver fuse a product with a sum, divide and take roots to within two and a half units in the
//! last place, and take numbers below the smallest normal one (1.2·10⁻³⁸) for zero. Of its own sines,
//! exponentials, logarithms and angles it promises so little (an angle may be four thousand units off) that
//! generated kernels have none of them: they compute polynomials, right to about two units, on any driver
//! ([`WGSL`](crate::ad::program::WGSL)). Sines of an angle of one shape come from the processor. So every
//! operation rounds as if its inputs had been moved by a few units in the last place, and a result is as far
//! from the processor's as that moves it: little, but where a function is steep or terms cancel. The harness
//! measures it input by input ([`prove_any_on`](crate::kernels::check::prove_any_on)) and allows no more.
//!
//! ```no_run
//! use geograd::Obb2;
//! use geograd::kernels::{IouObb2, gpu::Gpu};
//! # #[cfg(feature = "gpu")] {
//! let gpu = Gpu::new()?;
//! let boxes = gpu.upload(&[Obb2::new(0.0, 0.0, 4.0, 2.0, 0.3)])?;
//! let best = gpu.row_max(IouObb2, &boxes, &boxes)?.download()?;
//! assert_eq!(best[0].value, 1.0);
//! # }
//! # Ok::<(), geograd::Error>(())
//! ```
#[cfg(feature = "gpu")]
mod device;
#[cfg(not(feature = "gpu"))]
mod none;

#[cfg(feature = "gpu")]
pub use device::*;
#[cfg(not(feature = "gpu"))]
pub use none::*;

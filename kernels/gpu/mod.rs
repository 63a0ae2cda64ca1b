//! Batches on a GPU through wgpu: Vulkan, Metal, DX12, GL, or a software driver.
//!
//! A [`Gpu`] is a context, whose clones share everything and are cheap. It has the calls of every
//! [`Machine`](crate::kernels::Machine), for any operation and any program. Columns are slices, vectors,
//! [`One`](crate::kernels::One), or [arrays](crate::kernels::resident) that stay on the device. Numbers are `f32`;
//! others do not compile:
//!
//! ```compile_fail,E0277
//! use geograd::{Obb2, kernels::{Iou, gpu::Gpu}};
//! let boxes = [Obb2::new(0.0_f64, 0.0, 2.0, 2.0, 0.0)];
//! Gpu::new().unwrap().all_pairs(Iou, &boxes, &boxes); // the device does not compute in `f64`
//! ```
//!
//! [`Backend`](crate::kernels::Backend) chooses the machine at run time.
//!
//! Results equal the CPU's to within rounding, and their bits do not change from run to run: sums are added in a fixed
//! order, without atomics. Data beyond the limits of a dispatch, a binding or a buffer is split, so memory alone limits
//! sizes.
//!
//! | batch | call |
//! | --- | --- |
//! | item i of every column | [`Gpu::aligned`], of [`value_grad`](crate::kernels::Op::value_grad) and [`vjp`](crate::kernels::Op::vjp), too |
//! | every row with every row | [`Gpu::all_pairs`], [`Gpu::all_pairs_vjp`] |
//! | all pairs, reduced on the device | [`Gpu::row_max`], [`Gpu::column_max`], [`Gpu::above`], [`Gpu::count_above`], [`Gpu::sum`] |
//! | pairs within groups such as frames, all groups in one call | [`Gpu::above_grouped`], [`Gpu::row_max_grouped`], [`Gpu::column_max_grouped`] |
//! | a loss with its gradient | [`Gpu::sum_grad`], [`Gpu::mean_grad`] |
//! | paths and rings | [`Gpu::fold`], [`Gpu::fold_vjp`], [`Gpu::ragged`], [`Gpu::ragged_vjp`] |
//! | suppression, with the processor's result | [`Gpu::suppress`] |
//!
//! # Bodies and templates
//!
//! A kernel is a template (all pairs, a reduction, sums of derivatives) around a body. An operation is recorded once,
//! written as a body once, and compiled once per context and template. Areas of intersection, IoU and IoF of boxes in
//! the plane have bodies by hand, which take fewer instructions; so have the measures of rings. Both kinds of body
//! share the templates. Reductions compute the scores that they reduce, and store no matrix.
//!
//! Suppression within groups, assignment and average precision decide item after item, on the CPU alone
//! ([`suppress_grouped`](crate::kernels::Cpu::suppress_grouped),
//! [`greedy_grouped`](crate::kernels::Cpu::greedy_grouped), [`metric`](crate::metric)).
//!
//! Searches (clipping, hulls) are decided on the CPU, item by item, and replayed on the GPU, with their derivatives:
//! every record becomes a list of instructions, and one kernel executes all lists. All pairs of a search would decide
//! every pair on the CPU, so they are refused with [`Unrecordable::Search`](crate::Unrecordable::Search).
//!
//! # Rounding
//!
//! WGSL lets a driver fuse a product with a sum, and add the terms of a sum in another order. Quotients and roots are
//! right to two and a half units in the last place. Numbers below the smallest normal one (1.2·10⁻³⁸) may become zero.
//! Sums that carry the digits which rounding takes away are written so that no driver reorders them: thin boxes need
//! these digits. Its own sines, exponentials, logarithms and angles may be far off (an angle by four thousand units),
//! so generated kernels use none of them: they compute polynomials, right to about two units, on any driver
//! ([`WGSL`](crate::ad::program::WGSL)). Sines of an angle of one shape come from the processor. So every operation
//! rounds as if its inputs were perturbed by a few units in the last place. A result differs from the CPU's
//! accordingly: little, except where a function is steep or terms cancel. The harness measures the difference input by
//! input ([`check_on`](crate::kernels::check::check_on)) and refuses a larger one.
//!
//! Nor does WGSL guarantee infinities and NaN: a driver that finds a divisor to be always zero may put any number for
//! the quotient. A function of one's own guards what it divides by, not the result
//! ([Guards](crate::ad::program#guards)).
//!
//! ```no_run
//! use geograd::kernels::gpu::Gpu;
//! use geograd::kernels::{Distance, Iou, One, Op};
//! use geograd::{Obb2, Segment2, Vec2};
//! let gpu = Gpu::new()?;
//! let boxes = [Obb2::new(0.0, 0.0, 4.0, 2.0, 0.3)];
//! assert_eq!(gpu.row_max(Iou, &boxes, &boxes)?[0].value, 1.0);
//!
//! let points = [Vec2::new(0.0_f32, 1.0), Vec2::new(3.0, 0.0)];
//! let segment = One(Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(2.0, 0.0)));
//! let run = Distance.value_grad();
//! let (distances, (by_point, _)) = gpu.aligned(run, (&points, segment))?;
//! assert_eq!((distances[0], by_point[0]), (1.0, Vec2::new(0.0, 1.0)));
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

//! Batches on the CPU: on all SIMD lanes and threads, with equal bits for any number of either.
//!
//! Operations with compiled kernels run their generic source on bundles of lanes; all others, and
//! programs, are recorded and interpreted block by block. The instruction set is chosen at run time, once
//! per piece of work, so a default build uses AVX-512 where there is AVX-512; see
//! [`Simd`](simd::Simd). Inputs are checked before anything is written: an error leaves every buffer
//! unchanged.
//!
//! With the feature `parallel` the work runs on rayon's current thread pool (run inside `pool.install` to choose
//! another). Its pieces do not depend on the number of threads, and sums are added in a fixed order.
//!
//! # Method
//!
//! *From shapes to numbers.* Rows and columns of shapes become plain numbers, and all code below knows numbers only: it
//! is compiled once, in the library. `plan` decides how each argument is checked and prepared, and which kernel
//! computes blocks. Blocks are made of tiles: sixteen items, field after field (`lane`).
//!
//! *Compiled kernels* serve the scores of boxes in the plane (`overlaps`), boxes in space (`upright_boxes`, `boxes3`),
//! areas of quadrilaterals (`quads`) and measures of rings (`rings`): their generic source on processor vectors, for
//! every format and level (`arch::entry` lists them). A kernel costs a second or two of every build. So a box with yaw
//! goes through the kernel of its ground plan, and its height is a short second stage. Boxes of any rotation have one
//! loop of three rounds in which the axes take turns, so indices are constant and the kernel stays small. Shapes too
//! extreme for a kernel take the scalar code.
//!
//! *The interpreter* (`program`) runs all other rows: `lower`, `fuse` and `slots` make a tape of instructions, and
//! `execute` runs each over a block that fits the innermost cache. For all pairs, `split` computes numbers that depend
//! on one argument once per shape; `skip` leaves out nodes that no item of a block needs. `folds` computes the edges of
//! paths in parallel; `nearest` finds the edges that a distance needs; `polygons` computes rings of two ragged lists.
//! Searches run item by item.
//!
//! *Pairs.* `sweep` walks all pairs for tables (`pairs`) and reductions (`reductions`). If results of shapes apart are
//! zero, bounds are compared first, by a tree (`tree`) where lists are long and few pairs near; boxes in space are
//! filtered by their bounds seen from above (`solids`). The pairs that remain are gathered, computed densely and
//! scattered. Suppression (`greedy`) computes only pairs with a kept shape. Small groups (`grouped`), such as the boxes
//! of a frame, share the lanes of a tile.
//!
//! *The nearest.* `least` searches for least results. `lower_bounds` prepares boxes around shapes by recorded programs, and bounds
//! the results of an item with all others from below; long lists are sorted along a curve. Others of the least bounds
//! are computed first, and then those whose bound is not above the least result.
//!
//! *Meshes.* `mesh_searches` finds the nearest faces of points and the first ones of rays by
//! trees of eight; `mesh_batches` replays them, with derivatives for points, rays and vertices. `mesh_windings` has
//! winding numbers, `mesh_energies` measures and energies, `cloud_batches` clouds of points.
//!
//! *Same bits.* The cut into pieces does not depend on the number of threads, and sums are added in a fixed order. So
//! bits never depend on level, position, threads or filter.
//!
//! *Two measured rules for kernels.* A kernel contains no call: hence loops and `#[inline(always)]` functions, since
//! closures do not inherit instruction sets. It contains no run-time case. `.ci/assembly` reads what the compiler made
//! of them, and `.ci/run memory` runs them under valgrind. `GEOGRAD_SIMD` and [`Simd::limit`](simd::Simd::limit) force
//! a level.
pub(crate) mod aligned;
#[allow(unsafe_code)]
pub(crate) mod arch;
mod blocks;
mod boxes3;
pub(crate) mod checked;
pub mod cloud_batches;
pub(crate) mod folds;
pub(crate) mod formats;
pub(crate) mod greedy;
pub(crate) mod grouped;
mod held;
pub(crate) mod lane;
pub(crate) mod least;
mod lower_bounds;
mod maker;
pub(crate) mod matches;
pub(crate) mod matrix;
pub mod mesh_batches;
pub mod mesh_energies;
mod mesh_orders;
mod mesh_searches;
mod mesh_windings;
pub(crate) mod nearest;
mod overlaps;
pub(crate) mod pairs;
pub(crate) mod plan;
pub mod points;
pub mod polygons;
pub(crate) mod polylines;
mod processor;
#[doc(hidden)]
pub mod program;
pub(crate) mod quads;
mod ragged;
mod reductions;
pub(crate) mod rings;
pub mod simd;
mod solids;
mod stretches;
pub(crate) mod sweep;
mod tree;
pub(crate) mod upright_boxes;
pub(crate) mod winding;
pub(crate) mod work;

use crate::kernels::machine::Machine;

#[doc(hidden)]
pub use plan::Plan;
pub(crate) use ragged::check_ragged;

/// The CPU as a machine: all SIMD lanes, and all threads of rayon's current pool.
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
pub type Cpu = Machine<Processor>;

/// The engine of the CPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processor {
    cull: bool,
}

impl Default for Processor {
    fn default() -> Self {
        Cpu::new().engine
    }
}

impl Machine<Processor> {
    /// Returns the CPU, with culling of all-pairs batches on.
    #[must_use]
    pub const fn new() -> Self {
        let engine = Processor { cull: true };
        Machine { engine }
    }
    /// Returns a CPU with culling of all-pairs batches on or off.
    ///
    /// Culling compares bounds before anything else is computed. It changes no bit of a result. If nearly all pairs
    /// overlap, it costs a few hundredths of the time and stops.
    #[must_use]
    pub const fn culled(self, cull: bool) -> Self {
        let engine = Processor { cull };
        Machine { engine }
    }
}

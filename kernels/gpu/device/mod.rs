//! The device behind [`Gpu`]: buffers, pipelines, batches.
//!
//! # Bodies and templates
//!
//! A kernel is a template around a body. A body is a function of numbers in WGSL: `generated/operation.rs` writes one
//! from a recording, `generated/by_hand.rs` has those by hand. The CPU prepares its inputs: for all pairs the numbers
//! that depend on one shape, otherwise the sines of angles, so that both machines use equal ones. Items lie in tiles as
//! on the CPU.
//!
//! Templates of all pairs are in `wgsl/`: every row with every column (`pairs.wgsl`), reductions (`reduce.wgsl`, with a
//! snippet `take_*`), sums of derivatives of one list (`slopes.wgsl`) or of both at once (`vjp.wgsl`, with a snippet
//! `seed_*`). `generated/template.rs` writes the functions that name a body's numbers. A thread computes a shape of one
//! list (its *own* shape) with shapes of the other list, which it *walks* through; these are copied to workgroup memory
//! (`walked.wgsl`). No reduction stores a matrix. Sums of derivatives are partial sums, which `fold.wgsl` adds in a
//! fixed order. Templates of single items, of suppression and of folds are in `generated/`.
//!
//! Scores of boxes in the plane have bodies by hand, copies of their Rust source, value and adjoint, because they take
//! fewer instructions (BENCHMARKS.md). Such a body gives the derivatives of both shapes at once: a thread keeps sums
//! for its columns; sums for a row are added across the subgroup (or in workgroup memory). Measures of rings have
//! kernels by hand, too: a thread for each ring, a workgroup for a span of a long one. Constants come from Rust, and
//! naga validates every combination in a test without a GPU.
//!
//! A context keeps pipelines as long as their program lives. Searches are decided on the CPU; each record becomes a
//! list of instructions, which one kernel (`replay.wgsl`) executes. For suppression the GPU writes which pairs are
//! certainly above the threshold and which are within 1/256 of it; the CPU computes the latter. Columns on the device
//! (`generated/held`, `generated/columns.rs`) are stored as given, and prepared for each operation that uses them.
mod adapter;
mod block;
mod context;
mod data;
mod download;
mod engine;
mod found;
mod generated;
mod groups;
mod lists;
mod matrix;
mod plans;
mod reduce;
mod reducer;
mod rings;
mod seed;
mod work;
mod written;

pub use adapter::{Adapter, Choice, Options};
pub use context::{Device, Gpu};
#[doc(hidden)]
pub use generated::operation::Generated;
pub use generated::{fold_sources, line_sources, op_sources, replay_source};
pub(crate) use rings::DeviceRings;
pub use written::common_sources;

//! Batches: functions of shapes over many items, on the CPU or a GPU.
//!
//! | batch | arguments | results |
//! | --- | --- | --- |
//! | [`Cpu::aligned`] | item i of every column; [`One`] repeats one shape, [`Indexed`] takes items by indices | one result per item |
//! | [`Cpu::all_pairs`] | every shape of a with every shape of b | a [`Table`] |
//! | [`Cpu::row_max`], [`Cpu::column_max`] | two lists | the best match of every row or column |
//! | [`Cpu::above`], [`Cpu::count_above`] | two lists | the pairs above a threshold |
//! | [`Cpu::row_min`], [`Cpu::nearest`], [`Cpu::below`] | two lists | the nearest of every shape, the nearest pair, the pairs below a limit |
//! | [`Cpu::row_min_grad`], [`Cpu::nearest_grad`] | two lists | these results and their gradient |
//! | [`Cpu::above_grouped`], [`Cpu::row_max_grouped`], [`Cpu::row_min_grouped`] | two lists in [`Groups`] | these results within every group |
//! | [`Cpu::greedy_grouped`], [`Cpu::outcomes_grouped`] | pairs in [`Groups`] | one-to-one pairs, outcomes of detections |
//! | [`Cpu::sum`], [`Cpu::mean`], [`Cpu::sum_grad`] | two lists | a loss, and its gradient |
//! | [`Cpu::squares`] | as `aligned` | the sums of least squares: `JᵀJ`, `Jᵀr` and the cost |
//! | [`Cpu::ragged`], [`Cpu::fold`] | paths as vertices and offsets | one result per path |
//!
//! The function is a value: a [verb](verbs) such as [`Iou`]; its gradient ([`value_grad`](Iou::value_grad)), Jacobian
//! ([`jacobian`](Iou::jacobian)), adjoint ([`vjp`](Iou::vjp)), derivative along a direction ([`jvp`](Iou::jvp)),
//! Hessian ([`hessian`](Iou::hessian)) or Hessian times a direction ([`hvp`](Iou::hvp)); an [operation](op); a
//! [`search`](search::search); a plain generic [`function`]; a [`Program`](crate::Program). Columns are slices, vectors
//! or [`One`]. Calls that end in `_into` write into the caller's memory. [`operation!`](crate::operation) makes a
//! function an operation.
//!
//! # Inputs and results
//!
//! Shapes are checked before anything is computed: an invalid one is an error that names it. Results are not checked.
//! The library's functions of finite shapes are finite; your own function gives infinity or NaN at a pole, and so does
//! its batch, for that item alone.
//!
//! NaN in, NaN out: a verb of shapes with a NaN is NaN in every number of its result, as a method, by `of`, and where a
//! function of your own calls it in a batch; for that item alone. Whole numbers of a result, such as the number of
//! corners, stay what the search found, and a shape with a NaN contains nothing: a comparison with NaN is false.
//! Outside of verbs a comparison may lose it: [`least`](crate::Scalar::least), [`most`](crate::Scalar::most) and
//! [`clamp`](crate::Scalar::clamp) may give the other number, and so may a formula of a module, such as
//! [`giou_obb2`](crate::iou::giou_obb2), or the bounds of a shape. A method sees only what it reads: the area of a box
//! no NaN of its centre. Drivers of a GPU may assume that there is no NaN: there such an item may have any result.
//!
//! Without pairs a sum is 0, a count 0 and a list empty. The mean is 0 with a gradient of zero, as the loss of a step
//! without matches. The maximum or minimum of an empty row is an error:
//! [`Error::NoLargest`](crate::Error::NoLargest).
//!
//! # One call
//!
//! The path of `cpu.all_pairs(Iou, &a, &b)` through the files of `kernels/`. A folder imports those below it, in this
//! order: `row`, `call`, `machine`, `cpu`, `gpu`, `backend`, `verbs`, `ops`, `dynamic`, `check`, `fuzz`.
//!
//! ```text
//! verbs/mod.rs           Iou of two boxes selects its row
//! ops/overlap.rs         the row: a formula, and what it declares   row/op.rs  row/declares.rs
//! call/modes.rs          the row becomes a call                     call/recording.rs
//! machine/all_pairs.rs   columns become numbers for an engine       machine/column.rs  machine/primitives.rs
//! cpu/processor.rs       the engine makes a plan and checks shapes  cpu/plan/mod.rs  cpu/checked.rs
//! cpu/pairs.rs           all pairs are walked, block by block       cpu/sweep.rs
//! cpu/overlaps.rs        the kernel computes a block of pairs       cpu/arch/entry.rs  cpu/lane.rs
//! machine/table.rs       the results
//! ```
//!
//! A row without a compiled kernel is recorded (`row/straight_line.rs`) and interpreted (`cpu/program/`). A GPU writes
//! its recording in WGSL (`gpu/device/generated/`).
//!
//! # GPUs
//!
//! [`gpu`] has the same calls, except all pairs of searches. [`Backend`] has one interface for both machines, and
//! [`resident`] keeps columns and results on the machine between calls.
pub mod backend;
mod call;
#[cfg(feature = "check")]
#[allow(clippy::disallowed_methods)]
pub mod check;
pub mod cpu;
pub mod dynamic;
#[cfg(feature = "check")]
#[allow(clippy::disallowed_methods)]
pub mod fuzz;
pub mod gpu;
pub mod machine;
#[doc(hidden)]
pub mod ops;
mod row;
pub mod verbs;

pub use backend::{Backend, Rings};
pub use call::modes::Function;
pub use call::search::{self, HintedSearch, Search};
pub use cpu::{Cpu, points};
#[cfg(feature = "check")]
pub use fuzz::identities;
#[cfg(feature = "check")]
#[doc(hidden)]
pub use fuzz::tested;
pub use machine::{
    Column, Columns, Groups, IndexOf, Indexed, Machine, One, Robust, Skip, Squares, Table, Targets,
    resident,
};
pub use row::fold::{self, Fold};
pub use row::item::{self, Item, Single, Target};
pub use row::op::{self, Op};
pub use verbs::*;

/// Names that the code of macros uses, as it does those of [`derived`](crate::derived): no part of the interface.
#[doc(hidden)]
pub mod __private {
    pub use crate::kernels::call::modes::Function;
    pub use crate::kernels::call::recording::Call;
    pub use crate::kernels::call::search::Searches;
    pub use crate::kernels::row::declares::argument;
    pub use crate::kernels::row::item::layout::{
        Item, Leaf, Target, leaf, shape_of_row, shape_to_row, target,
    };
    pub use crate::kernels::row::op::{
        Declared, Declares, Derivative, Effect, Extremes, Finite, Hvp, Invariance, Jacobian, Jumps,
        Jvp, LowerBound, Motion, Op, Range, ValueGrad, Vjp,
    };
    pub use crate::kernels::verbs::{Binary, Quaternary, Takes, Ternary, Unary};
    pub use crate::scalar::guard::guarded;
    pub use crate::{Error, Fixed, Mask, Pack, Scalar};
}

/// Results of reductions of all pairs, and reductions of a stored [`Matrix`](reduce::Matrix).
pub mod reduce {
    pub use crate::kernels::cpu::matrix::Matrix;
    pub use crate::kernels::machine::found::{Best, Found};
}

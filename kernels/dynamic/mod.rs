//! Operations without types, for bindings and tools: by name, on columns of plain numbers, and functions of other
//! languages.
//!
//! | access to | by |
//! | --- | --- |
//! | every operation, with the names of its arguments, fields and rules | [`operations`], [`operation`] |
//! | its value, gradient and adjoint on columns of numbers, in every form of a batch | [`Function`] |
//! | folds | [`OnPaths`] |
//! | a function of any arguments and results, recorded call by call | [`Tracing`], [`symbol`] |
//! | its derivatives, and its operations as data | [`Program`], [`Nodes`] |
//! | its check by the harness, and that of any two functions of lists | [`Program::check`], [`Inputs`](crate::kernels::check::Inputs) |
//!
//! Columns are slices of numbers in row-major order ([`Rows`]); results are vectors, or are written to the caller's
//! slices. A wrong argument is an error that names it as the operation does, before anything is written.
//!
//! ```
//! use geograd::kernels::dynamic::{Rows, operation};
//! let iou = operation("iou_obb2").expect("is listed");
//! let boxes = [0.0, 0.0, 2.0, 2.0, 0.0, 5.0, 5.0, 1.0, 3.0, 0.7];
//! let truth = [1.0, 0.0, 2.0, 2.0, 0.0];
//!
//! let value_grad = iou.value_grad::<f64>().expect("its result is one number");
//! let found = value_grad.aligned(&[Rows::new(&boxes, 5), Rows::one(&truth)])?;
//! assert_eq!(found[0], [1.0 / 3.0, 0.0]);
//! assert!((found[1][0] - 4.0 / 9.0).abs() < 1e-15); // by the x of the first box
//!
//! let value = iou.value::<f64>().expect("is of fixed size");
//! assert_eq!(value.row_max(Rows::new(&truth, 5), Rows::new(&boxes, 5))?[0].index, 0);
//! let wrong = value.aligned(&[Rows::new(&[0.0, 0.0, -2.0, 2.0, 0.0], 5), Rows::one(&truth)]);
//! assert_eq!(wrong.unwrap_err().to_string(), "`a` item 0: width is negative");
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! A program that calls [`operations`] or [`operation`] compiles every row in both formats; other programs do not.
mod catalogue;
mod described;
mod fields;
mod forms;
mod grouped;
mod least;
mod machines;
mod names;
mod nodes;
mod paths;
mod program;
mod rows;
pub mod symbol;

pub use crate::ad::sample::Sampler;
pub use crate::kernels::cpu::work::{Interruption, interruptible, on_this_thread};
pub use crate::kernels::row::bounds::Bound;
pub use crate::kernels::row::derivation::Mode;
pub use catalogue::{Operation, Parameter, Sort, operation, operations};
#[doc(hidden)]
pub use catalogue::{fold, search, straight};
pub use described::{Number, Shape};
pub use forms::Function;
pub use names::{Name, Unnamed, named_rows, names};
pub use nodes::{Elementary, Nodes, Step};
pub use paths::OnPaths;
pub use program::{Program, Tracing};
pub use rows::{Layout, Rows};
pub use symbol::{Symbol, Truth};

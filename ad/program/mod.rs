//! Programs: generic functions recorded once, to evaluate, differentiate, print, and run in batches.
//!
//! A [`Program`] is the list of operations that a generic function of shapes performs. [`Program::trace`] calls the
//! function once with shapes of [`Sym`], a scalar that records each operation. A program returns the bits of the
//! function. Its gradient and its products with Jacobian and Hessian are programs again; it has a cost, a printout, and
//! a shader function.
//!
//! ```
//! use geograd::ad::program::{Program, Sym};
//! use geograd::{Obb2, Vec2};
//! let overlap = Program::trace(|(a, b): (Obb2<Sym<f64>>, Obb2<Sym<f64>>)| a.iou(b)).unwrap();
//! let (a, b) = (Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0));
//! let (iou, (by_a, _)) = overlap.value_grad().eval((a, b));
//! assert_eq!(iou, a.iou(b));
//! assert!((by_a.center.x - 4.0 / 9.0).abs() < 1e-15);
//! ```
//!
//! # What can be recorded
//!
//! Straight lines: functions with the bound `S: Scalar` alone. Functions with control flow (`S: Scalar<Mask = bool>`)
//! do not compile with symbols. [`Mask::any`](crate::Mask::any) and [`Mask::all`](crate::Mask::all) compile, but are
//! only hints; a function whose value depends on their result is refused, as is one that uses symbols of another
//! recording or literals that are not finite. Everything else that the function captures becomes a constant.
//!
//! # Guards
//!
//! Replace a forbidden divisor or radicand before the operation: `x.over(select(y == 0, 1, y))`. On the processor a
//! check of the result also works for values, but neither for derivatives nor in WGSL. Its drivers may assume that no
//! number is infinite or NaN: there [`finite`](crate::Scalar::finite) and [`saturated`](crate::Scalar::saturated) of
//! `x / (y − y)` are unreliable.
//!
//! # Derivatives
//!
//! Reverse mode follows the [rules at kinks](crate::scalar): ties share, and the branch that a choice did
//! not take contributes nothing, even if its derivative is infinite. In `f64` its derivatives are those of forward
//! duals to the last digits. In `f32` it may lose some where large cotangents cancel (nearly parallel
//! sides of boxes): there, an adjoint by hand ([`Program::with_adjoint`]) is better.
//!
//! # Method
//!
//! `record` calls the function with symbols; `simplify` keeps the graph in exact normal form as it grows. `reverse` and
//! `forward` append gradients and products with Jacobian and Hessian as further nodes, so these are programs, too. A
//! choice passes its cotangent on together with the path on which it counts, so the branch not taken contributes
//! nothing. `print` writes text; `source` programs in other languages, of which `wgsl`, `c` and
//! `javascript` are dialects.
pub(crate) mod blocks;
pub(crate) mod c;
mod cost;
mod derivative;
pub(crate) mod evaluate;
pub(crate) mod graph;
mod in_progress;
pub(crate) mod javascript;
pub(crate) mod opened;
mod packed;
pub(crate) mod print;
pub(crate) mod record;
pub(crate) mod recorded;
mod reverse;
mod simplify;
pub(crate) mod source;
mod sym;
mod tangent;
mod typed;
pub(crate) mod wgsl;

pub use cost::Cost;
pub use graph::Format;
pub(crate) use sym::Neutral;
pub use sym::{Sym, SymMask};
pub use typed::{Jacobian, Program};
pub use wgsl::WGSL;

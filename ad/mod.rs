//! Derivatives: drivers on dual numbers, and adjoints by hand.
//!
//! # Drivers
//!
//! [`value`], [`jvp`], [`gradient`], [`jacobian`], [`hessian`] and [`hvp`] differentiate any
//! generic function of shapes and give back shapes.
//!
//! # Adjoints
//!
//! An adjoint takes the inputs of its forward function and the slope `out_bar` of some loss with
//! respect to the output, and returns the slopes of the loss with respect to the inputs, one
//! cotangent per argument, in order, of the argument's type. It replays the forward values, pulls
//! backwards, last line first, and returns. Write one where an operation is on a hot path: it costs
//! two to three values for any number of inputs, where duals cost one to two values *per input*.
//! Everywhere else the duals suffice. Adjoints are generic too: run on duals they give second
//! derivatives.
//!
//! # Programs
//!
//! [`program`] records a generic function once, as a list of operations. From it come reverse mode,
//! batches, kernels and a printout, without a line per function.
//!
//! # Verification
//!
//! [`check`] proves derivatives, the library's and anybody's: see there, and
//! [`assert_gradient!`](crate::assert_gradient).
//!
//! `x_bar` is the cotangent of `x`. `…_grad` functions give value and slopes fused.
pub mod adjoint;
pub mod check;
pub mod forward;
pub mod program;

pub use forward::{gradient, hessian, hvp, jacobian, jvp, value};

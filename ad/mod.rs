//! Derivatives of formulas: by dual numbers, by adjoints, by recorded programs.
//!
//! # Drivers
//!
//! [`value`], [`jvp`], [`gradient`], [`jacobian`], [`hessian`] and [`hvp`] differentiate any
//! generic function of shapes by dual numbers and return shapes.
//!
//! # Adjoints
//!
//! An adjoint takes the inputs of its forward function and the cotangent `out_bar` of the output: the derivative of a
//! loss by it. It returns the cotangents of the inputs, one per argument, in order, of the argument's type. It repeats
//! the forward values and goes backwards, last line first. Write one for an operation on a hot path: it costs two to
//! three values for any number of inputs, while duals cost one to two values *per input*. Adjoints are generic, too: on
//! duals they return second derivatives.
//!
//! # Programs
//!
//! [`program`] records a generic function once, as a graph of operations. Reverse mode, batches, shaders and a
//! printout follow from the graph.
//!
//! # Verification
//!
//! [`check`] checks derivatives, the library's and those of a user, as does
//! [`assert_gradient!`](crate::assert_gradient); both need the feature `check`. [`declared`] has the properties that
//! functions declare, [`sample`] draws inputs.
//!
//! `x_bar` is the cotangent of `x`. `…_grad` functions return value and gradient together.
pub mod adjoint;
#[cfg(feature = "check")]
#[allow(clippy::disallowed_methods)]
pub mod check;
pub mod declared;
pub mod forward;
pub mod program;
#[allow(clippy::disallowed_methods)]
pub mod sample;
#[cfg(not(feature = "check"))]
mod unchecked;

pub use forward::{gradient, hessian, hvp, jacobian, jvp, value};

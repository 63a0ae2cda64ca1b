//! The interface of an operation: its formula and its declared properties.
//!
//! ```
//! use geograd::kernels::op::{Declared, Declares, Jumps, Op};
//! use geograd::kernels::Cpu;
//! use geograd::{Scalar, Vec2};
//!
//! /// Distance of two points.
//! #[derive(Clone, Copy, Debug, Default)]
//! struct Distance;
//!
//! impl Declares for Distance {
//!     const DECLARED: Declared = Declared::new("distance", &[], Jumps::Never);
//! }
//!
//! impl Op for Distance {
//!     type In<S: Scalar> = (Vec2<S>, Vec2<S>);
//!     type Out<S: Scalar> = S;
//!     fn eval<S: Scalar>((a, b): (Vec2<S>, Vec2<S>)) -> S {
//!         (a - b).length()
//!     }
//! }
//!
//! let (a, b) = ([Vec2::new(0.0_f64, 0.0)], [Vec2::new(3.0, 4.0)]);
//! assert_eq!(Cpu::new().aligned(Distance, (&a, &b))?, [5.0]);
//! # Ok::<(), geograd::Error>(())
//! ```
pub use crate::ad::declared::{Effect, Invariance, Jumps, Motion};
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Neutral, Program};
use crate::error::Error;
use crate::kernels::row::compiled::Compiled;
pub use crate::kernels::row::declares::{Declared, Declares};
use crate::kernels::row::derivation::Mode;
pub use crate::kernels::row::derivatives::{Hvp, Jacobian, Jvp, ValueGrad, Vjp};
pub use crate::kernels::row::limits::{Derivative, Extremes, Finite, Limits, LowerBound, Range};
use crate::kernels::row::straight_line::Line;
use crate::{Fixed, Pack, Real, Scalar};
use std::any::TypeId;
use std::sync::Arc;

/// A generic function of fixed size.
///
/// A value of the type is the operation: `Cpu::new().aligned(Iou, (&a, &b))`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not an operation",
    label = "not an operation, nor a program",
    note = "`function(f)` runs a plain generic function, `operation!` makes it an operation, `Program::trace` makes a closure a program"
)]
pub trait Op: Declares {
    /// The argument, generic over the scalar: a shape, a number, or a tuple of up to six.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// The result, generic over the scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// Returns the result for an input.
    fn eval<S: Scalar>(input: Self::In<S>) -> Self::Out<S>;
    /// Returns the result and the gradient of `out_bar · result` with respect to the input, by hand; `None` if
    /// derivatives are recorded.
    #[inline(always)]
    fn adjoint<S: Scalar>(
        _input: Self::In<S>,
        _out_bar: Self::Out<S>,
    ) -> Option<(Self::Out<S>, Self::In<S>)> {
        None
    }
    /// Returns the kernels that the library has compiled for it.
    #[doc(hidden)]
    fn compiled() -> Option<Compiled> {
        None
    }
    /// Returns the function as a [`Program`], to print, count, differentiate further, or run on a GPU. It includes an
    /// adjoint by hand of a lone number.
    ///
    /// ```
    /// use geograd::kernels::{Iou, Op};
    /// use geograd::Obb2;
    /// let iou = Iou.row::<(Obb2<f64>, Obb2<f64>)>().program::<f64>()?;
    /// let boxes = (Obb2::new(0.0, 0.0, 2.0, 2.0, 0.1), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.2));
    /// assert_eq!(iou.eval(boxes), boxes.0.iou(boxes.1));
    /// assert_eq!(iou.value_grad().cost().elementary, 4);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The errors of recording it: [`Error::Program`].
    fn program<T: Real>(self) -> Result<Program<Self::In<T>, Self::Out<T>>, Error> {
        let value = program_of::<Self, T>(Mode::Value)?;
        if !matches!(Self::DECLARED.derivative, Derivative::ByHand) || Self::Out::<T>::LEN != 1 {
            return Ok(Program::of((*value).clone()));
        }
        let value_grad = program_of::<Self, T>(Mode::ValueGrad)?;
        Ok(Program::of(value.with_gradient_after_result(&value_grad)))
    }
    /// Returns the operation that returns the result and its gradient; the result is one number.
    fn value_grad(self) -> ValueGrad<Self> {
        ValueGrad(self)
    }
    /// Returns the operation with its Jacobian. As in [`ad::jacobian`](crate::ad::jacobian), a Jacobian has the
    /// result's shape, with a gradient, of the input's shape, in place of every number. Aligned batches run it, on a
    /// GPU where the operation is recorded.
    ///
    /// ```
    /// use geograd::kernels::{ClosestPoints, Cpu, Op};
    /// use geograd::Obb2;
    /// let (a, b) = ([Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)], [Obb2::new(5.0, 0.3, 2.0, 1.0, 0.1)]);
    /// let (points, derivatives) = Cpu::new().aligned(ClosestPoints.jacobian(), (&a, &b))?;
    /// assert_eq!(points[0].on_a.x, 1.0);
    /// let (by_a, by_b) = derivatives[0].on_a.x; // of the point's x, with respect to both boxes
    /// assert_eq!((by_a.center.x, by_a.size.x, by_b.center.x), (1.0, 0.5, 0.0));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    fn jacobian(self) -> Jacobian<Self> {
        Jacobian(self)
    }
    /// Returns the adjoint: the operation that takes the input and a cotangent of the result, and returns the cotangent
    /// of the input.
    fn vjp(self) -> Vjp<Self> {
        Vjp(self)
    }
    /// Returns the operation with its derivative along a direction: takes the input and then a direction of it, and
    /// returns the result and its derivative. A direction is a list of numbers in the shape of the input; a direction
    /// of boxes need not be a valid box.
    ///
    /// ```
    /// use geograd::kernels::Cpu;
    /// use geograd::prelude::*;
    /// let (points, centres) = ([Vec2::new(3.0_f64, 4.0)], [Vec2::new(0.0, 0.0)]);
    /// let (east, still) = ([Vec2::new(1.0, 0.0)], [Vec2::new(0.0, 0.0)]);
    /// let along = ((&points, &centres), (&east, &still));
    /// let (distance, slope) = Cpu::new().aligned(Distance.jvp(), along)?;
    /// assert_eq!((distance[0], slope[0]), (5.0, 0.6));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    fn jvp(self) -> Jvp<Self> {
        Jvp::of(self)
    }
    /// Returns the Hessian times a direction: takes the input and then a direction of it, and returns the derivative of
    /// the gradient along it. The result of the operation is one number.
    ///
    /// ```
    /// use geograd::kernels::Cpu;
    /// use geograd::prelude::*;
    /// let (points, centres) = ([Vec2::new(3.0_f64, 4.0)], [Vec2::new(0.0, 0.0)]);
    /// let (east, still) = ([Vec2::new(1.0, 0.0)], [Vec2::new(0.0, 0.0)]);
    /// let (by_point, by_centre) = Cpu::new().aligned(Distance.hvp(), ((&points, &centres), (&east, &still)))?;
    /// assert!((by_point[0].x - 16.0 / 125.0).abs() < 1e-15);
    /// assert_eq!(by_centre[0], -by_point[0]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    fn hvp(self) -> Hvp<Self> {
        Hvp::of(self)
    }
    /// Returns the operation with its gradient and Hessian: [`value_grad`](Op::value_grad) with its Jacobian.
    fn hessian(self) -> Jacobian<ValueGrad<Self>> {
        ValueGrad(self).jacobian()
    }
}

/// Returns the straight line of an operation.
pub(crate) const fn line_of<O: Op>() -> Line {
    Line {
        id: TypeId::of::<O>,
        derivatives: O::DECLARED.derivative,
        inputs: O::In::<Neutral>::LEN,
        outputs: O::Out::<Neutral>::LEN,
        codes: O::In::<Neutral>::CODES + O::Out::<Neutral>::CODES,
        // Functions, since closures would be compiled twice for every operation.
        eval: eval::<O>,
        adjoint: match O::DECLARED.derivative {
            Derivative::ByHand => adjoint::<O>,
            Derivative::Reverse | Derivative::Forward => nothing,
        },
    }
}

/// Returns the result.
fn eval<O: Op>(input: &[Neutral]) -> Vec<Neutral> {
    O::eval(O::In::<Neutral>::load(input)).scalars()
}
fn nothing(_input: &[Neutral], _out_bar: &[Neutral]) -> Vec<Neutral> {
    Vec::new()
}

/// Returns the result and the derivatives by hand. Without them they are NaN, which no check accepts.
fn adjoint<O: Op>(input: &[Neutral], out_bar: &[Neutral]) -> Vec<Neutral> {
    let out_bar = O::Out::<Neutral>::load(out_bar);
    match O::adjoint(O::In::<Neutral>::load(input), out_bar) {
        Some((value, derivatives)) => [value.scalars(), derivatives.scalars()].concat(),
        None => vec![Neutral::lit(f64::NAN); O::Out::<Neutral>::LEN + O::In::<Neutral>::LEN],
    }
}

/// Returns the program of a mode of an operation.
pub(crate) fn program_of<O: Op, T: Real>(mode: Mode) -> Result<Arc<Recorded>, Error> {
    const { &line_of::<O>() }.program::<T>(mode)
}

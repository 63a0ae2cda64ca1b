//! The contract of an operation: its function, and what the library has to know about it.
//!
//! ```
//! use geograd::kernels::op::{Jumps, Op, Invariance, Derivative};
//! use geograd::kernels::Cpu;
//! use geograd::{Scalar, Vec2};
//!
//! /// Distance of two points.
//! #[derive(Clone, Copy, Debug, Default)]
//! struct Distance;
//!
//! impl Op for Distance {
//!     const NAME: &'static str = "distance";
//!     type In<S: Scalar> = (Vec2<S>, Vec2<S>);
//!     type Out<S: Scalar> = S;
//!     const INVARIANCES: &'static [Invariance] = &[];
//!     const JUMPS: Jumps = Jumps::Never;
//!     const DERIVATIVE: Derivative = Derivative::Reverse;
//!     fn eval<S: Scalar>((a, b): (Vec2<S>, Vec2<S>)) -> S {
//!         (a - b).length()
//!     }
//! }
//!
//! let (a, b) = ([Vec2::new(0.0_f64, 0.0)], [Vec2::new(3.0, 4.0)]);
//! assert_eq!(Cpu::new().aligned(Distance, (&a, &b))?, [5.0]);
//! # Ok::<(), geograd::Error>(())
//! ```
pub use crate::ad::declared::{Answer, Invariance, Jumps, Motion};
pub use crate::ad::program::{Jacobian, OneNumber};
use crate::ad::program::{Plain, Program};
use crate::error::Error;
use crate::kernels::cpu::plan::Compiled;
use crate::kernels::cpu::rings::Measure;
pub use crate::kernels::declared::{Extremes, Finite, Limits, Range};
use crate::kernels::directions::{Hvp, Jvp};
use crate::kernels::item::{Item, Results, WithJacobian};
use crate::kernels::recording::{Call, Mode, Recording, program_of};
use crate::{Fixed, Pack, Scalar, Vec2};
use std::fmt::Debug;

/// The source of an operation's derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivative {
    /// [`Op::adjoint`], written by hand.
    ByHand,
    /// The recorded function, differentiated backwards.
    Reverse,
    /// The recorded function, differentiated forwards, one number of the input after the other. For functions whose
    /// derivatives lose digits backwards, because large terms meet before they cancel.
    Forward,
}

/// A generic function of fixed size, its invariances, and the source of its derivatives.
///
/// A value of the type is the operation: `Cpu::new().aligned(Iou, (&a, &b))`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not an operation",
    label = "not an operation, nor a program",
    note = "`function(f)` runs a plain generic function, `operation!` makes it an operation, `Program::trace` makes a closure a program"
)]
pub trait Op: Copy + Debug + Default + Send + Sync + 'static {
    /// The name of the function, letter for letter.
    const NAME: &'static str;
    /// The argument, made of any scalar: a shape, a number, or a tuple of up to six.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// The result, made of the same scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// Motions of the argument and their effect on the result; `&[]` declares none.
    const INVARIANCES: &'static [Invariance];
    /// Places at which the value may jump.
    const JUMPS: Jumps;
    /// The source of the derivatives.
    const DERIVATIVE: Derivative;
    /// Inputs whose values and derivatives are finite.
    const FINITE: Finite = Finite::Within(Limits::ORDINARY);
    /// The range of every number of the result.
    const RANGE: Range = Range::ANY;
    /// The results of identical shapes and of shapes apart.
    const EXTREMES: Extremes = Extremes::Undeclared;
    /// The domain, in addition to the rules of its shapes; `None` for everywhere. The harness and the fuzzer keep to
    /// it; batches compute outside, too.
    const DOMAIN: Option<fn(Self::In<f64>) -> bool> = None;
    /// The error of values beyond rounding: in the unit of the result, and relative to each of its numbers.
    const RESOLUTION: [f64; 2] = [0.0; 2];
    /// The names of its arguments, one for each; empty without names of their own.
    const ARGUMENTS: &'static [&'static str] = &[];
    /// Documentation in Markdown: the doc comment of its row, empty without one.
    const DOC: &'static str = "";
    /// The function.
    fn eval<S: Scalar>(input: Self::In<S>) -> Self::Out<S>;
    /// The result and the gradient of `out_bar · result` with respect to the input, by hand; `None` if they are
    /// recorded.
    #[inline(always)]
    fn adjoint<S: Scalar>(
        _input: Self::In<S>,
        _out_bar: Self::Out<S>,
    ) -> Option<(Self::Out<S>, Self::In<S>)> {
        None
    }
    /// Kernels that the library has compiled for it.
    #[doc(hidden)]
    fn compiled() -> Option<Compiled> {
        None
    }
    /// The function as a [`Program`], to print, count, differentiate further, or run on a GPU. It includes an adjoint
    /// by hand of a lone number.
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
    fn program<T: Plain>(self) -> Result<Program<Self::In<T>, Self::Out<T>>, Error> {
        let value = program_of::<Self, T>(Mode::Value)?;
        if Self::DERIVATIVE != Derivative::ByHand || Self::Out::<T>::LEN != 1 {
            return Ok(Program::of((*value).clone()));
        }
        let value_grad = program_of::<Self, T>(Mode::ValueGrad)?;
        Ok(Program::of(value.with_gradient_after_result(&value_grad)))
    }
    /// The operation that returns the result and its gradient; the result is one number.
    fn value_grad(self) -> ValueGrad<Self> {
        ValueGrad(self)
    }
    /// The operation whose result is the result with its Jacobian: the result's shape with its gradient, a shape like
    /// the input, in the place of every number, as of [`ad::jacobian`](crate::ad::jacobian). Aligned batches run it,
    /// on a GPU where the operation is recorded.
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
    /// The adjoint: the operation that takes the input and a cotangent of the result, and returns the cotangent of the
    /// input.
    fn vjp(self) -> Vjp<Self> {
        Vjp(self)
    }
    /// The operation with its derivative along a direction: takes the input and then a direction of it, and returns the
    /// result and its derivative. A direction is a list of numbers in the shape of the input; one of boxes need not be a
    /// box.
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
    /// The Hessian times a direction: takes the input and then a direction of it, and returns the derivative of the
    /// gradient along it. The result of the operation is one number.
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
    /// The operation with its gradient and Hessian: [`value_grad`](Op::value_grad) with its Jacobian.
    fn hessian(self) -> Jacobian<ValueGrad<Self>> {
        ValueGrad(self).jacobian()
    }
}

/// An operation with its gradient; see [`Op::value_grad`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ValueGrad<O>(pub(crate) O);

/// The adjoint of an operation; see [`Op::vjp`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vjp<O>(pub(crate) O);

impl<O> ValueGrad<O> {
    /// The same as [`Op::value_grad`], for code that is generic over what runs.
    #[must_use]
    pub const fn of(function: O) -> Self {
        ValueGrad(function)
    }
    /// The value, the gradient, and the Jacobian of both: the gradient again, and the Hessian.
    ///
    /// ```
    /// use geograd::kernels::Cpu;
    /// use geograd::prelude::*;
    /// let points = [Vec2::new(3.0_f64, 4.0)];
    /// let origin = One(Vec2::new(0.0, 0.0));
    /// let (first, second) = Cpu::new().aligned(Distance.value_grad().jacobian(), (&points, origin))?;
    /// let (distance, (by_point, _)) = first;
    /// assert_eq!(distance[0], 5.0);
    /// assert!(by_point[0].distance(Vec2::new(0.6, 0.8)) < 1e-15);
    /// // The Hessian: in the place of every number of the gradient its own gradient.
    /// let (_, (hessian, _)) = second[0];
    /// assert!((hessian.x.0.x - 16.0 / 125.0).abs() < 1e-15);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub const fn jacobian(self) -> Jacobian<Self> {
        Jacobian(self)
    }
    /// The adjoint of the value with its gradient: cotangents of a value of 0 and of a gradient that is a direction give
    /// the Hessian times that direction.
    #[must_use]
    pub const fn vjp(self) -> Vjp<Self> {
        Vjp(self)
    }
}
impl<O> Jacobian<O> {
    /// The same as [`Op::jacobian`], for code that is generic over what runs.
    #[must_use]
    pub const fn of(function: O) -> Self {
        Jacobian(function)
    }
}
impl<O> Vjp<O> {
    /// The same as [`Op::vjp`], for code that is generic over what runs.
    #[must_use]
    pub const fn of(function: O) -> Self {
        Vjp(function)
    }
    /// The adjoint of the adjoint: second derivatives of functions of any result.
    #[must_use]
    pub const fn vjp(self) -> Vjp<Self> {
        Vjp(self)
    }
    /// The cotangents of the arguments with their Jacobian by arguments and cotangents.
    #[must_use]
    pub const fn jacobian(self) -> Jacobian<Self> {
        Jacobian(self)
    }
}

/// A function that a batch runs on items: a verb, its gradient, Jacobian or adjoint, a program.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not run on these columns",
    label = "does not run on items of `{R}`",
    note = "`.value_grad()` needs one number as result; `.jacobian()` gives the gradient of each of several",
    note = "an operation of two shapes takes two columns, `(&a, &b)`, made of its shapes and of one format",
    note = "`search(s)` runs a search (`Search`)"
)]
pub trait Runs<R: Item> {
    /// The result per item.
    type Out: Results<Scalar = R::Scalar>;
    /// The function without its types, and the derivative of it.
    ///
    /// # Errors
    ///
    /// Errors of recording it, as far as that happens here.
    #[doc(hidden)]
    fn call(&self) -> Result<Call<R::Scalar>, Error>;
}

impl<O, R: Item> Runs<R> for O
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Item,
{
    type Out = O::Out<R::Scalar>;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        Ok(Call::of(Recording::of::<O, R>()))
    }
}

impl<F, R: Item> Runs<R> for ValueGrad<F>
where
    F: Runs<R>,
    F::Out: OneNumber,
    R::Scalar: Item<Scalar = R::Scalar>,
{
    type Out = (R::Scalar, R);
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.derived(Mode::ValueGrad)
    }
}

impl<F, R: Item> Runs<R> for Jacobian<F>
where
    F: Runs<R>,
    F::Out: Item<Scalar = R::Scalar> + Pack<With<R>: Send>,
{
    type Out = WithJacobian<F::Out, R>;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.derived(Mode::Jacobian)
    }
}

impl<F, R: Item> Runs<R> for &Jacobian<F>
where
    Jacobian<F>: Runs<R>,
{
    type Out = <Jacobian<F> as Runs<R>>::Out;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        (**self).call()
    }
}

impl<F, R: Item, Y: Item<Scalar = R::Scalar>> Runs<(R, Y)> for Vjp<F>
where
    F: Runs<R, Out = Y>,
{
    type Out = R;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.derived(Mode::Vjp)
    }
}

/// A function of a ring of run-time length, for ragged batches.
pub trait RingOp: Copy + Debug + Default + Send + Sync + 'static {
    /// The name of the function, letter for letter.
    const NAME: &'static str;
    /// The result.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// Motions of the argument and their effect on the result; `&[]` declares none.
    const INVARIANCES: &'static [Invariance];
    /// Places at which the value may jump.
    const JUMPS: Jumps;
    /// Inputs whose values and derivatives are finite.
    const FINITE: Finite = Finite::Within(Limits::ORDINARY);
    /// The range of every number of the result.
    const RANGE: Range = Range::ANY;
    /// Documentation in Markdown: the doc comment of its row, empty without one.
    const DOC: &'static str = "";
    /// The result.
    fn value<S: Scalar>(ring: &[Vec2<S>]) -> Self::Out<S>;
    /// The adjoint, one cotangent per vertex, written into the caller's slice of the same length.
    fn ring_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: Self::Out<S>, ring_bar: &mut [Vec2<S>]);
    /// Kernels that the library has compiled for it.
    #[doc(hidden)]
    fn compiled() -> Option<Measure> {
        None
    }
}

/// The domain of an operation on plain numbers, if it states one.
pub(crate) const fn inside_of<O: Op>() -> Option<fn(&[f64]) -> bool> {
    match O::DOMAIN.is_some() {
        true => Some(|x| {
            let is_whole = x.len() == O::In::<f64>::LEN;
            is_whole && O::DOMAIN.is_none_or(|inside| inside(O::In::<f64>::load(x)))
        }),
        false => None,
    }
}

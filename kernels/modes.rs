//! Functions that batches run ([`Function`]), and their derivatives, which are such functions, too.
use crate::Pack;
pub use crate::ad::program::Jacobian;
use crate::error::Error;
use crate::kernels::item::{Item, Results, WithJacobian};
use crate::kernels::recording::{Call, Mode, Order};
pub use crate::scalar::real::OneNumber;

/// A function that a batch runs on items: a verb, its gradient, Jacobian or adjoint, a program.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not run on these columns",
    label = "does not run on items of `{R}`",
    note = "`.value_grad()` needs one number as result; `.jacobian()` gives the gradient of each of several",
    note = "an operation of two shapes takes two columns, `(&a, &b)`, made of its shapes and of one format",
    note = "`function(f)` takes a function of one to six shapes that is generic over their scalar: `fn f<S: Scalar>(a: A<S>) -> S`, not `fn f(a: A<f64>) -> f64`",
    note = "`search(s)` runs a search (`Search`)"
)]
pub trait Function<R: Item> {
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

/// An operation with its gradient; see [`Op::value_grad`](crate::kernels::Op::value_grad).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ValueGrad<O>(pub(crate) O);

/// The adjoint of an operation; see [`Op::vjp`](crate::kernels::Op::vjp).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vjp<O>(pub(crate) O);

impl<O> ValueGrad<O> {
    /// The same as [`Op::value_grad`](crate::kernels::Op::value_grad), for code that is generic over what runs.
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
    /// The same as [`Op::jacobian`](crate::kernels::Op::jacobian), for code that is generic over what runs.
    #[must_use]
    pub const fn of(function: O) -> Self {
        Jacobian(function)
    }
}
impl<O> Vjp<O> {
    /// The same as [`Op::vjp`](crate::kernels::Op::vjp), for code that is generic over what runs.
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

/// A function with its derivative along a direction; see [`Op::jvp`](crate::kernels::Op::jvp).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jvp<O>(O);

/// The Hessian of a function times a direction; see [`Op::hvp`](crate::kernels::Op::hvp).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hvp<O>(O);

/// Methods that give a further derivative of a function along directions.
macro_rules! derivatives {
    ($($Name:ident: $doc:literal)*) => { $(
        impl<O> $Name<O> {
            #[doc = $doc]
            #[must_use]
            pub const fn of(function: O) -> Self {
                $Name(function)
            }
            /// The adjoint: takes arguments, directions and a cotangent of the result.
            #[must_use]
            pub const fn vjp(self) -> Vjp<Self> {
                Vjp::of(self)
            }
            /// The function with its Jacobian by arguments and directions.
            #[must_use]
            pub const fn jacobian(self) -> Jacobian<Self> {
                Jacobian::of(self)
            }
        }
    )* };
}
derivatives! {
    Jvp: "The same as [`Op::jvp`](crate::kernels::Op::jvp), for code that is generic over what runs."
    Hvp: "The same as [`Op::hvp`](crate::kernels::Op::hvp), for code that is generic over what runs."
}
impl<O> ValueGrad<O> {
    /// The Hessian times a direction; see [`Op::hvp`](crate::kernels::Op::hvp).
    #[must_use]
    pub fn hvp(self) -> Hvp<O> {
        Hvp(self.0)
    }
}

impl<F, R: Item> Function<(R, R)> for Jvp<F>
where
    F: Function<R>,
    F::Out: Item<Scalar = R::Scalar>,
{
    type Out = (F::Out, F::Out);
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.along(Order::First)
    }
}

impl<F, R: Item> Function<(R, R)> for Hvp<F>
where
    F: Function<R>,
    F::Out: OneNumber,
{
    type Out = R;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.along(Order::Second)
    }
}

impl<F, R: Item> Function<R> for ValueGrad<F>
where
    F: Function<R>,
    F::Out: OneNumber,
    R::Scalar: Item<Scalar = R::Scalar>,
{
    type Out = (R::Scalar, R);
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.derived(Mode::ValueGrad)
    }
}

impl<F, R: Item> Function<R> for Jacobian<F>
where
    F: Function<R>,
    F::Out: Item<Scalar = R::Scalar> + Pack<With<R>: Send>,
{
    type Out = WithJacobian<F::Out, R>;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.derived(Mode::Jacobian)
    }
}

impl<F, R: Item> Function<R> for &Jacobian<F>
where
    Jacobian<F>: Function<R>,
{
    type Out = <Jacobian<F> as Function<R>>::Out;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        (**self).call()
    }
}

impl<F, R: Item, Y: Item<Scalar = R::Scalar>> Function<(R, Y)> for Vjp<F>
where
    F: Function<R, Out = Y>,
{
    type Out = R;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.derived(Mode::Vjp)
    }
}

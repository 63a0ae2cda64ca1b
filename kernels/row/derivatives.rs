//! Operations for the derivatives of a function.
pub use crate::ad::program::Jacobian;

/// An operation with its gradient; see [`Op::value_grad`](crate::kernels::Op::value_grad).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ValueGrad<O>(pub(crate) O);

/// The adjoint of an operation; see [`Op::vjp`](crate::kernels::Op::vjp).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vjp<O>(pub(crate) O);

impl<O> ValueGrad<O> {
    /// Creates it as [`Op::value_grad`](crate::kernels::Op::value_grad) does, for code that is generic over the
    /// function.
    #[must_use]
    pub const fn of(function: O) -> Self {
        ValueGrad(function)
    }
    /// Returns the value, the gradient, and the Jacobian of both: the gradient again, and the Hessian.
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
    /// Returns the adjoint of the value with its gradient: cotangents of a value of 0 and of a gradient that is a
    /// direction give the Hessian times that direction.
    #[must_use]
    pub const fn vjp(self) -> Vjp<Self> {
        Vjp(self)
    }
}
impl<O> Jacobian<O> {
    /// Creates it as [`Op::jacobian`](crate::kernels::Op::jacobian) does, for code that is generic over the function.
    #[must_use]
    pub const fn of(function: O) -> Self {
        Jacobian(function)
    }
}
impl<O> Vjp<O> {
    /// Creates it as [`Op::vjp`](crate::kernels::Op::vjp) does, for code that is generic over the function.
    #[must_use]
    pub const fn of(function: O) -> Self {
        Vjp(function)
    }
    /// Returns the adjoint of the adjoint: second derivatives of functions of any result.
    #[must_use]
    pub const fn vjp(self) -> Vjp<Self> {
        Vjp(self)
    }
    /// Returns the cotangents of the arguments with their Jacobian by arguments and cotangents.
    #[must_use]
    pub const fn jacobian(self) -> Jacobian<Self> {
        Jacobian(self)
    }
}

/// A function with its derivative along a direction; see [`Op::jvp`](crate::kernels::Op::jvp).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jvp<O>(pub(crate) O);

/// The Hessian of a function times a direction; see [`Op::hvp`](crate::kernels::Op::hvp).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hvp<O>(pub(crate) O);

/// Defines methods that return further derivatives of a derivative along directions.
macro_rules! derivatives {
    ($($Name:ident: $doc:literal)*) => { $(
        impl<O> $Name<O> {
            #[doc = $doc]
            #[must_use]
            pub const fn of(function: O) -> Self {
                $Name(function)
            }
            /// Returns the adjoint: takes arguments, directions and a cotangent of the result.
            #[must_use]
            pub const fn vjp(self) -> Vjp<Self> {
                Vjp::of(self)
            }
            /// Returns the function with its Jacobian by arguments and directions.
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
    /// Returns the Hessian times a direction; see [`Op::hvp`](crate::kernels::Op::hvp).
    #[must_use]
    pub fn hvp(self) -> Hvp<O> {
        Hvp(self.0)
    }
}

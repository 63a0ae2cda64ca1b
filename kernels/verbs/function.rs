//! Plain generic functions in batches.
use crate::ad::program::record::record;
use crate::ad::program::{Program, Sym};
use crate::error::Error;
use crate::kernels::call::modes::Function;
use crate::kernels::call::recording::{Body, Call, Recording};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::derivatives::{Hvp, Jvp};
use crate::kernels::row::item::{Item, leaves_of, widths};
use crate::kernels::row::limits::LowerBound;
use crate::kernels::row::once::known;
use crate::kernels::row::op::{Jacobian, ValueGrad, Vjp};
use crate::{Fixed, Real};
use std::marker::PhantomData;
use std::sync::Arc;

/// A generic function that batches run; see [`function`].
#[derive(Debug)]
pub struct OwnFunction<F, N>(F, PhantomData<N>);

impl<F: Copy, N> Clone for OwnFunction<F, N> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<F: Copy, N> Copy for OwnFunction<F, N> {}

/// Wraps a generic function of one to six shapes or numbers, so that batches run it without a row.
///
/// The columns determine the shapes and the format in which it is recorded, once. It has no invariances; the harness
/// checks it as a [`Program`]. [`operation!`](crate::operation) gives a function a row with invariances.
///
/// ```
/// use geograd::kernels::function;
/// use geograd::prelude::*;
/// /// The distance of a point from the centre of a box, plus half its width.
/// fn reach<S: Scalar>(point: Vec2<S>, car: Obb2<S>) -> S {
///     (point - car.center).length() + car.size.x.halved()
/// }
/// let points = [Vec2::new(3.0_f64, 4.0), Vec2::new(6.0, 8.0)];
/// let car = One(Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0));
/// let cpu = Cpu::new();
/// assert_eq!(cpu.aligned(function(reach), (&points, car))?, [7.0, 12.0]);
/// let (_, (by_point, _)) = cpu.aligned(function(reach).value_grad(), (&points, car))?;
/// assert!((by_point[0].x - 0.6).abs() < 1e-15);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// A closure names the shapes of its arguments and captures nothing, because its type is the key of the recording.
/// One that captures does not compile: pass the value as a further argument, [`One`](crate::kernels::One). A closure's
/// scalar is inferred, so that `-x`, `2.0` and methods of the scalar in it often do not compile: for a literal or an
/// operator write an `fn` that is generic over `S: Scalar`.
///
/// ```compile_fail
/// # use geograd::kernels::function;
/// # use geograd::prelude::*;
/// let shift = 2.0;
/// let shifted = function(|x: Vec2<_>| x.length() + Scalar::lit(shift));
/// let _ = Cpu::new().aligned(shifted, &[Vec2::new(3.0_f64, 4.0)][..]);
/// ```
///
/// # Errors
///
/// Batches of a function that cannot be recorded are an [`Error::Program`] that says why.
#[must_use]
pub const fn function<F: Copy, N>(function: F) -> OwnFunction<F, N> {
    const {
        assert!(
            size_of::<F>() == 0,
            "the function captures a value or is a pointer: pass a function by its name, and what it captures as an argument"
        );
    }
    OwnFunction(function, PhantomData)
}

impl<F: Copy, N> OwnFunction<F, N> {
    /// Returns the function with its gradient; the result is one number.
    #[must_use]
    pub const fn value_grad(self) -> ValueGrad<Self> {
        ValueGrad::of(self)
    }
    /// Returns the function with its Jacobian: aligned batches return the result, and in its shape the gradient of
    /// every number.
    ///
    /// ```
    /// use geograd::kernels::function;
    /// use geograd::prelude::*;
    /// fn corner<S: Scalar>(car: Obb2<S>) -> Vec2<S> {
    ///     car.corners()[2]
    /// }
    /// let cars = [Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.0)];
    /// let (corners, by_car) = Cpu::new().aligned(function(corner).jacobian(), &cars)?;
    /// assert_eq!((corners[0], by_car[0].y.size.y), (Vec2::new(2.0, 1.0), 0.5));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub const fn jacobian(self) -> Jacobian<Self> {
        Jacobian::of(self)
    }
    /// Returns the adjoint: takes the arguments and a cotangent of the result, returns the cotangents of the arguments.
    #[must_use]
    pub const fn vjp(self) -> Vjp<Self> {
        Vjp::of(self)
    }
    /// Returns the function with its derivative along a direction: batches take the arguments and then as many
    /// directions, and return the result and its derivative.
    #[must_use]
    pub const fn jvp(self) -> Jvp<Self> {
        Jvp::of(self)
    }
    /// Returns the Hessian times a direction: batches take the arguments and then as many directions, and return the
    /// derivative of the gradient along them. The result is one number.
    #[must_use]
    pub const fn hvp(self) -> Hvp<Self> {
        Hvp::of(self)
    }
    /// Returns the function with its gradient and Hessian: [`value_grad`](Self::value_grad) with its Jacobian.
    #[must_use]
    pub const fn hessian(self) -> Jacobian<ValueGrad<Self>> {
        ValueGrad::of(self).jacobian()
    }
    /// Returns the function as a [`Program`], to print, count or differentiate further.
    ///
    /// ```
    /// use geograd::kernels::function;
    /// use geograd::{Program, Scalar, Vec2};
    /// fn product<S: Scalar>(v: Vec2<S>) -> S {
    ///     v.x * v.y
    /// }
    /// let program: Program<Vec2<f64>, f64> = function(product).program()?;
    /// assert_eq!(program.eval(Vec2::new(3.0, 4.0)), 12.0);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Program`] for a function that cannot be recorded.
    pub fn program<In: Item<Scalar: Real>, Out>(self) -> Result<Program<In, Out>, Error>
    where
        Self: Traced<In, Out = Out>,
        Out: Fixed<Scalar = In::Scalar>,
    {
        let value = recording::<In, Self>(self)?.program(Mode::Value)?;
        Ok(Program::of((*value).clone()))
    }
}

/// The number of arguments of an [`OwnFunction`], as a type.
#[derive(Debug)]
pub struct Arguments<const N: usize>;

/// Functions that can be recorded on rows `In`.
#[diagnostic::on_unimplemented(
    message = "this is not a generic function of `{In}`",
    label = "does not take these columns",
    note = "the function is generic over its scalar: `fn f<S: Scalar>(a: A<S>, b: B<S>) -> S` for columns of `A` and `B`, not `fn f(a: A<f64>, b: B<f64>) -> f64`",
    note = "a closure names its shapes, `|a: A<_>, b: B<_>|`, and has no literal or sign first: write an `fn` for those",
    note = "a function takes one to six shapes or numbers; arrays, tuples and derived shapes hold more"
)]
pub trait Traced<In: Item<Scalar: Real>>: Copy + Send + Sync {
    /// The result.
    type Out: Item<Scalar = In::Scalar>;
    /// The key of its recording.
    #[doc(hidden)]
    type Key: 'static;
    /// Records the function.
    ///
    /// # Errors
    ///
    /// [`Error::Program`] for a function that cannot be recorded.
    #[doc(hidden)]
    fn record(self) -> Result<Program<In, Self::Out>, Error>;
}

macro_rules! arities {
    ($($count:literal: $row:ty, [$($A:ident $a:ident),+];)*) => { $(
        // One argument needs none.
        #[allow(unused_parens)]
        impl<T: Real, $($A,)+ Y, F> Traced<$row> for OwnFunction<F, Arguments<$count>>
        where
            $row: Item<Scalar = T>,
            $($A: Fixed<Scalar = T>,)+
            F: Fn($(<$A as Fixed>::Of<Sym<T>>),+) -> Y + Copy + Send + Sync + 'static,
            Y: Fixed<Scalar = Sym<T>>,
            Y::Of<T>: Item<Scalar = T>,
        {
            type Out = Y::Of<T>;
            type Key = F;
            fn record(self) -> Result<Program<$row, Y::Of<T>>, Error> {
                record::<T, ($(<$A as Fixed>::Of<Sym<T>>),+), Y>(|($($a),+)| (self.0)($($a),+))
                    .map(Program::of)
            }
        }
    )* };
}
arities! {
    1: A, [A a];
    2: (A, B), [A a, B b];
    3: (A, B, C), [A a, B b, C c];
    4: (A, B, C, D), [A a, B b, C c, D d];
    5: (A, B, C, D, E), [A a, B b, C c, D d, E e];
    6: (A, B, C, D, E, G), [A a, B b, C c, D d, E e, G g];
}

impl<In: Item<Scalar: Real>, F, N> Function<In> for OwnFunction<F, N>
where
    Self: Traced<In>,
{
    type Out = <Self as Traced<In>>::Out;
    fn call(&self) -> Result<Call<In::Scalar>, Error> {
        Ok(Call::of(recording::<In, Self>(*self)?))
    }
}

/// Returns the recording of a function, which is made once.
fn recording<In: Item<Scalar: Real>, F: Traced<In>>(
    function: F,
) -> Result<Arc<Recording<In::Scalar>>, Error> {
    known::<F::Key, _>(|| {
        let body = Body::Graph(Arc::new(function.record()?.recorded().clone()));
        Ok(Recording::new(
            leaves_of::<In>(),
            widths::<F::Out>(),
            &[],
            body,
        ))
    })
}

/// A function with a lower bound of its result; see [`at_least`].
#[derive(Clone, Copy, Debug)]
pub struct AtLeast<F>(F, LowerBound);

/// Declares a lower bound of a function of two shapes, from axis-aligned boxes around both: searches for the nearest
/// skip pairs by it.
///
/// The shapes are the library's, or derive their boxes by `#[shape(bounding)]`. A bound that does not hold makes
/// results wrong without an error.
///
/// ```
/// use geograd::kernels::op::LowerBound;
/// use geograd::kernels::{at_least, function};
/// use geograd::prelude::*;
/// /// The free way from a point to a box, and half a metre more.
/// fn way<S: Scalar>(point: Vec2<S>, car: Obb2<S>) -> S {
///     car.distance(point) + S::lit(0.5)
/// }
/// let points = [Vec2::new(3.0_f64, 0.0), Vec2::new(0.0, 9.0)];
/// let cars = [Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0), Obb2::new(0.0, 7.0, 4.0, 2.0, 0.0)];
/// let way = at_least(LowerBound::Distance, function(way));
/// let near = Cpu::new().row_min(way, &points, &cars)?;
/// assert_eq!(near[1].value, 1.5);
/// # Ok::<(), geograd::Error>(())
/// ```
#[must_use]
pub const fn at_least<F>(lower: LowerBound, run: F) -> AtLeast<F> {
    AtLeast(run, lower)
}

impl<R: Item, F: Function<R>> Function<R> for AtLeast<F> {
    type Out = F::Out;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        let lower = self.1;
        Ok(Call {
            lower,
            ..self.0.call()?
        })
    }
}

//! Functions that batches run ([`Function`]), and their derivatives, which batches run, too.
use crate::Pack;
use crate::error::Error;
use crate::kernels::call::recording::{Call, LineParts, Recording};
use crate::kernels::row::derivation::{Mode, Order};
use crate::kernels::row::derivatives::{Hvp, Jacobian, Jvp, ValueGrad, Vjp};
use crate::kernels::row::item::{Item, Results, WithJacobian, leaves_of, widths};
use crate::kernels::row::op::Op;
use crate::kernels::row::op::line_of;
use crate::scalar::real::OneNumber;
use std::any::TypeId;
use std::sync::Arc;

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
    /// Returns the untyped function with the derivative to compute.
    ///
    /// # Errors
    ///
    /// The errors of recording it, if it is recorded here.
    #[doc(hidden)]
    fn call(&self) -> Result<Call<R::Scalar>, Error>;
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

impl<O, R: Item> Function<R> for O
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Item,
{
    type Out = O::Out<R::Scalar>;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        Ok(Call::of(recording_of::<O, R>()))
    }
}

/// Returns the recording of an operation, which is made once.
pub(crate) fn recording_of<O, R: Item>() -> Arc<Recording<R::Scalar>>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Item<Scalar = R::Scalar>,
{
    Recording::of_line(
        TypeId::of::<O>(),
        const {
            &LineParts {
                compiled: O::compiled,
                takes: leaves_of::<R>,
                outputs: widths::<O::Out<R::Scalar>>,
                arguments: O::DECLARED.arguments,
                lower: O::DECLARED.lower,
                line: const { &line_of::<O>() },
            }
        },
    )
}

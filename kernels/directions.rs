//! Derivatives along directions: functions of the arguments and of as many directions.
use crate::error::Error;
use crate::kernels::item::Item;
use crate::kernels::op::{Derivative, Jacobian, OneNumber, Runs, ValueGrad, Vjp};
use crate::kernels::real::Real;
use crate::kernels::recording::{Body, Call, Key, Mode, Recording};
use std::sync::Arc;

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

impl<F, R: Item> Runs<(R, R)> for Jvp<F>
where
    F: Runs<R>,
    F::Out: Item<Scalar = R::Scalar>,
{
    type Out = (F::Out, F::Out);
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.along(Order::First)
    }
}

impl<F, R: Item> Runs<(R, R)> for Hvp<F>
where
    F: Runs<R>,
    F::Out: OneNumber,
{
    type Out = R;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        self.0.call()?.along(Order::Second)
    }
}

/// The order of a derivative along a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Order {
    /// The result, and its derivative.
    First,
    /// The derivative of the gradient.
    Second,
}

impl<T: Real> Call<T> {
    /// The derivative of what is called along directions, as a function of arguments and directions.
    fn along(self, order: Order) -> Result<Self, Error> {
        Ok(Call::of(self.function()?.along(order)?))
    }
}

impl<T: Real> Recording<T> {
    fn along(&self, order: Order) -> Result<Arc<Recording<T>>, Error> {
        self.made(Key::Along(order), &|| {
            let value = self.program(Mode::Value)?;
            let is_number = self.outputs == [1];
            // The slopes that the row states, where it states its own.
            let value = match &self.body {
                Body::Map(line) if is_number && line.derivatives == Derivative::ByHand => {
                    Arc::new(value.with_gradient_after_result(&*self.program(Mode::ValueGrad)?))
                }
                _ => value,
            };
            let fields: Vec<usize> = self.takes.iter().map(|leaf| leaf.fields).collect();
            // A direction is a list of numbers: one of boxes need not be a box.
            let directions = fields
                .iter()
                .map(|&n| crate::kernels::item::Leaf::numbers(n));
            let (program, outputs) = match order {
                Order::First => (value.jvp(), [&self.outputs[..], &self.outputs].concat()),
                Order::Second => (value.hvp(), fields.clone()),
            };
            let takes = self.takes.iter().cloned().chain(directions).collect();
            Ok(Recording::new(
                takes,
                outputs,
                &[],
                Body::Graph(Arc::new(program)),
            ))
        })
    }
}

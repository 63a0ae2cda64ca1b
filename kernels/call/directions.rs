//! Derivatives along directions, as functions of the arguments and their directions.
use crate::Real;
use crate::ad::program::recorded::Recorded;
use crate::error::Error;
use crate::kernels::call::recording::{Body, Call, Recording};
use crate::kernels::row::derivation::{DerivativeStep, Mode, Order};
use crate::kernels::row::item::Leaf;
use crate::kernels::row::limits::Derivative;
use crate::kernels::row::once::Key;
use std::sync::Arc;

impl<T: Real> Call<T> {
    /// Returns the derivative of the called function along directions, as a function of arguments and directions.
    pub(crate) fn along(self, order: Order) -> Result<Self, Error> {
        Ok(Call::of(self.function()?.along(order)?))
    }
}

impl<T: Real> Recording<T> {
    fn along(&self, order: Order) -> Result<Arc<Recording<T>>, Error> {
        self.made(Key::Along(order), &|| {
            let body = match &self.body {
                Body::Search(search) => Body::Search(search.then(DerivativeStep::Along(order))),
                _ => Body::Graph(Arc::new(self.program_along(order)?)),
            };
            let fields: Vec<usize> = self.takes.iter().map(|leaf| leaf.fields).collect();
            // A direction is a list of numbers; a direction of boxes need not be a valid box.
            let directions = fields.iter().map(|&n| Leaf::numbers(n));
            let outputs = match order {
                Order::First => [&self.outputs[..], &self.outputs].concat(),
                Order::Second => fields.clone(),
            };
            let takes = self.takes.iter().cloned().chain(directions).collect();
            Ok(Recording::new(takes, outputs, &[], body))
        })
    }
    fn program_along(&self, order: Order) -> Result<Recorded, Error> {
        let value = self.program(Mode::Value)?;
        // The derivatives that the row declares, if it declares any.
        let value = match &self.body {
            Body::Line(line) if self.outputs == [1] && line.derivatives == Derivative::ByHand => {
                Arc::new(value.with_gradient_after_result(&*self.program(Mode::ValueGrad)?))
            }
            _ => value,
        };
        Ok(match order {
            Order::First => value.jvp(),
            Order::Second => value.hvp(),
        })
    }
}

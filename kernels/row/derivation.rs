//! Derivatives as steps from one function to the next, and the replays of a search differentiated by several steps.
use crate::Error;
use crate::ad::program::recorded::Recorded;
use std::sync::Arc;

/// The derivative of a function that a call computes: its mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// The result.
    Value,
    /// The result, one number, and its gradient.
    ValueGrad,
    /// The result and the gradient of each of its numbers.
    Jacobian,
    /// The derivatives times a cotangent of the result.
    Vjp,
}

impl Mode {
    /// Returns the number of scalars of every output shape, from the numbers of arguments and results.
    pub(crate) fn gives(self, takes: &[usize], outputs: &[usize]) -> Vec<usize> {
        match self {
            Mode::Value => outputs.to_vec(),
            Mode::ValueGrad => [outputs, takes].concat(),
            Mode::Jacobian => {
                let all = outputs.iter().sum::<usize>() * takes.iter().sum::<usize>();
                [outputs, &[all]].concat()
            }
            Mode::Vjp => takes.to_vec(),
        }
    }
    /// Returns the number of scalars that its program returns before the wanted ones.
    pub(crate) fn skipped(self, outputs: &[usize]) -> usize {
        match self {
            Mode::Value | Mode::ValueGrad | Mode::Jacobian => 0,
            Mode::Vjp => outputs.iter().sum(),
        }
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

/// A step from a function to one of its derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum DerivativeStep {
    /// A derivative by a mode.
    Mode(Mode),
    /// A derivative along directions.
    Along(Order),
}

/// The untyped replays of a search, differentiated by some steps.
pub(crate) trait Replays<T>: Send + Sync {
    /// Decides an item. `numbers` has its shapes one after another, then directions and cotangents. Returns the program
    /// of its record, and appends the inputs of the program to `taken`.
    ///
    /// # Errors
    ///
    /// The errors of recording it.
    fn decide(&self, numbers: &[T], taken: &mut Vec<T>) -> Result<Arc<Recorded>, Error>;
    /// Returns the number of hints that the search hands over.
    fn hints(&self) -> usize;
    /// Returns the numbers of inputs, hints among them, and of results of a replay.
    fn sizes(&self) -> [usize; 2];
    /// Writes a row of results from the results `found` of a replay.
    fn put(&self, numbers: &[T], found: &[T], row: &mut [T]);
}

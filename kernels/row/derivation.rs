//! Derivatives as steps from one function to the next, and replays of a search that are differentiated by several.
use crate::Error;
use crate::ad::program::recorded::Recorded;
use std::sync::Arc;

/// The derivative that is wanted of a function.
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
    /// Numbers of every shape that comes out, given those of a function's arguments and of its results.
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
    /// Returns how many numbers its program gives before those, for results of so many numbers.
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

/// A derivative of a function as a function of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Step {
    /// By a mode.
    Mode(Mode),
    /// Along directions.
    Along(Order),
}

/// The replays of a search, differentiated by some steps, without its types.
pub(crate) trait Replays<T>: Send + Sync {
    /// Decides an item, given its numbers shape by shape and those of directions and cotangents: the program of its
    /// record, and the numbers that it takes, which are appended.
    ///
    /// # Errors
    ///
    /// The errors of recording it.
    fn decide(&self, numbers: &[T], taken: &mut Vec<T>) -> Result<Arc<Recorded>, Error>;
    /// Returns how many numbers a replay takes, and how many it gives.
    fn sizes(&self) -> [usize; 2];
    /// Makes a row of results of what a replay gave for an item.
    fn put(&self, numbers: &[T], found: &[T], row: &mut [T]);
}

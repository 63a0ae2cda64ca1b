//! A check of an operation that is a value: `Check::of(IouObb2)`.
use crate::ad::check::sample::Sample;
use crate::ad::check::{Check, Plan, Report, SEED};
use crate::kernels::check::prove_with;
use crate::kernels::op::Op;
use crate::kernels::row::Row;
use std::marker::PhantomData;

/// A check of an operation in both formats; see [`Check::of`].
#[derive(Clone, Copy)]
pub struct OfOperation<O> {
    plan: Plan<'static>,
    operation: PhantomData<O>,
}

impl Check<'static, f64> {
    /// A check of an operation, in single and in double precision: at the hard cases of its shapes and at
    /// two hundred random inputs, unless told otherwise.
    ///
    /// ```
    /// use geograd::check::*;
    /// use geograd::{operation, Vec2};
    /// operation! {
    ///     /// How far apart two points are, in squares.
    ///     pub Apart = "apart": (a: Vec2<S>, b: Vec2<S>) -> S {
    ///         (a - b).dot(a - b)
    ///     }
    ///     promises [TranslationX Stays, Rotation Stays, Scaling Power(2), Exchange Stays]
    ///     jumps Never
    ///     slopes Reverse
    /// }
    /// Check::of(Apart).samples(20).prove();
    /// ```
    #[must_use]
    pub fn of<O: Op>(_operation: O) -> OfOperation<O> {
        OfOperation {
            plan: Plan::new(200, SEED),
            operation: PhantomData,
        }
    }
}

impl<O: Op> OfOperation<O>
where
    O::In<f64>: Sample + Row,
    O::Out<f64>: Sample + Row,
    O::In<f32>: Row,
    O::Out<f32>: Row,
{
    /// At so many random inputs.
    #[must_use]
    pub fn samples(mut self, samples: usize) -> Self {
        self.plan.samples = samples;
        self
    }
    /// From another seed.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.plan.seed = seed;
        self
    }
    /// At every so many of the hard cases; at none for zero.
    #[must_use]
    pub fn hard(mut self, every: usize) -> Self {
        self.plan.hard = every;
        self
    }
    /// Judges: a report in single precision, and one in double.
    #[must_use]
    pub fn run(&self) -> [Report; 2] {
        [
            prove_with::<O, f32>(&self.plan),
            prove_with::<O, f64>(&self.plan),
        ]
    }
    /// Judges, and panics with the report when something was refused.
    ///
    /// # Panics
    ///
    /// When something was refused.
    #[track_caller]
    pub fn prove(&self) {
        for report in self.run() {
            assert!(report.passed(), "the operation is refused\n{report}");
        }
    }
}

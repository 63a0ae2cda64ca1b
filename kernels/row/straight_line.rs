//! Straight lines: operations as programs, recorded when they are first needed.
use crate::ad::program::Neutral;
use crate::ad::program::record::{TRIALS, listed};
use crate::ad::program::recorded::Recorded;
use crate::error::Error;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::limits::Derivative;
use crate::kernels::row::once::{Key, RecordingCache, known_by};
use crate::{Real, Scalar, Unrecordable};
use std::any::TypeId;
use std::marker::PhantomData;
use std::sync::Arc;

/// An untyped straight line: functions of lists of symbols, so that the code that records and differentiates is
/// compiled once.
pub(crate) struct Line {
    /// The type of its operation.
    pub(crate) id: fn() -> TypeId,
    /// The source of its derivatives.
    pub(crate) derivatives: Derivative,
    /// The number of scalars of its input.
    pub(crate) inputs: usize,
    /// The number of scalars of its result.
    pub(crate) outputs: usize,
    /// The numbers of codes of both.
    pub(crate) codes: usize,
    /// The function.
    pub(crate) eval: fn(&[Neutral]) -> Vec<Neutral>,
    /// The result and then the derivatives by hand, from the input and the cotangent.
    pub(crate) adjoint: fn(&[Neutral], &[Neutral]) -> Vec<Neutral>,
}

/// Returns the program of a mode, by reverse accumulation; the program of `Vjp` returns the value first.
pub(crate) fn by_reverse(value: &Recorded, mode: Mode) -> Recorded {
    match mode {
        Mode::Value => value.clone(),
        Mode::ValueGrad => value.value_grad(),
        Mode::Jacobian => value.value_jacobian(),
        Mode::Vjp => value.value_vjp(),
    }
}

/// The programs of a straight line in a format.
struct LinePrograms<T>(RecordingCache, PhantomData<fn() -> T>);

impl Line {
    /// Returns the program of a mode, by the declared source of derivatives.
    pub(crate) fn program<T: Real>(&self, mode: Mode) -> Result<Arc<Recorded>, Error> {
        if self.codes > 0 {
            return Err(Error::Program(Unrecordable::Codes));
        }
        let new = || Ok(LinePrograms::<T>(RecordingCache::default(), PhantomData));
        let kept = known_by((self.id)(), &new)?;
        kept.0
            .made(Key::Program(mode), &|| self.recorded::<T>(mode))
    }
    fn recorded<T: Real>(&self, mode: Mode) -> Result<Recorded, Error> {
        let value = || self.program::<T>(Mode::Value);
        Ok(match (self.derivatives, mode) {
            (_, Mode::Value) => listed(T::FORMAT, self.inputs, TRIALS, &self.eval)?,
            (Derivative::ByHand, Mode::Jacobian) => self
                .program::<T>(Mode::Vjp)?
                .value_jacobian_of_vjp(self.outputs),
            (Derivative::ByHand, Mode::Vjp) => {
                let inputs = self.inputs + self.outputs;
                listed(T::FORMAT, inputs, TRIALS, &|numbers| {
                    let (input, out_bar) = numbers.split_at(self.inputs);
                    (self.adjoint)(input, out_bar)
                })?
            }
            (Derivative::ByHand, _) => listed(T::FORMAT, self.inputs, TRIALS, &|input| {
                (self.adjoint)(input, &vec![Neutral::one(); self.outputs])
            })?,
            (Derivative::Reverse, _) => by_reverse(&*value()?, mode),
            (Derivative::Forward, Mode::Jacobian) => value()?.value_jacobian_forwards(),
            (Derivative::Forward, Mode::Vjp) => value()?.value_vjp_forwards(),
            (Derivative::Forward, _) => value()?.value_jacobian_forwards(),
        })
    }
}

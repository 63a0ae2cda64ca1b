//! Straight lines: operations as programs, recorded when they are first needed.
use crate::ad::program::Sym;
use crate::ad::program::record::{TRIALS, listed};
use crate::ad::program::recorded::Recorded;
use crate::error::Error;
use crate::kernels::derivation::Mode;
use crate::kernels::limits::Derivative;
use crate::kernels::once::{Kept, Key, known_by};
use crate::kernels::op::Op;
use crate::{Fixed, Pack, Real, Scalar, Unrecordable};
use std::any::TypeId;
use std::marker::PhantomData;
use std::sync::Arc;

/// A straight line without its types: functions of lists of symbols, so that code that records and differentiates is
/// compiled once.
pub(crate) struct Line<T: 'static> {
    /// The type of its operation.
    pub(crate) id: fn() -> TypeId,
    /// The source of its derivatives.
    pub(crate) derivatives: Derivative,
    /// Numbers of its input.
    pub(crate) inputs: usize,
    /// Numbers of its result.
    pub(crate) outputs: usize,
    /// Codes of both.
    pub(crate) codes: usize,
    /// The function.
    pub(crate) eval: fn(&[Sym<T>]) -> Vec<Sym<T>>,
    /// The result and then the derivatives, by hand, from the input and the cotangent.
    pub(crate) adjoint: fn(&[Sym<T>], &[Sym<T>]) -> Vec<Sym<T>>,
}

/// The program of a mode, by reverse accumulation; that of `Vjp` gives the result first.
pub(crate) fn by_reverse(value: &Recorded, mode: Mode) -> Recorded {
    match mode {
        Mode::Value => value.clone(),
        Mode::ValueGrad => value.value_grad(),
        Mode::Jacobian => value.value_jacobian(),
        Mode::Vjp => value.value_vjp(),
    }
}

/// The programs of a straight line in a format.
struct Programs<T>(Kept, PhantomData<fn() -> T>);

impl<T: Real> Line<T> {
    /// The program of a mode, by the source that the row says.
    pub(crate) fn program(&self, mode: Mode) -> Result<Arc<Recorded>, Error> {
        if self.codes > 0 {
            return Err(Error::Program(Unrecordable::Codes));
        }
        let new = || Ok(Programs::<T>(Kept::default(), PhantomData));
        let kept = known_by((self.id)(), &new)?;
        kept.0.made(Key::Program(mode), &|| self.recorded(mode))
    }
    fn recorded(&self, mode: Mode) -> Result<Recorded, Error> {
        let value = || self.program(Mode::Value);
        Ok(match (self.derivatives, mode) {
            (_, Mode::Value) => listed(self.inputs, TRIALS, &self.eval)?,
            (Derivative::ByHand, Mode::Jacobian) => {
                self.program(Mode::Vjp)?.value_jacobian_of_vjp(self.outputs)
            }
            (Derivative::ByHand, Mode::Vjp) => {
                listed(self.inputs + self.outputs, TRIALS, &|numbers| {
                    let (input, out_bar) = numbers.split_at(self.inputs);
                    (self.adjoint)(input, out_bar)
                })?
            }
            (Derivative::ByHand, _) => listed(self.inputs, TRIALS, &|input| {
                (self.adjoint)(input, &vec![Sym::lit(1.0); self.outputs])
            })?,
            (Derivative::Reverse, _) => by_reverse(&*value()?, mode),
            (Derivative::Forward, Mode::Jacobian) => value()?.value_jacobian_forwards(),
            (Derivative::Forward, Mode::Vjp) => value()?.value_vjp_forwards(),
            (Derivative::Forward, _) => value()?.value_jacobian_forwards(),
        })
    }
}

/// The straight line of an operation.
pub(crate) const fn line_of<O: Op, T: Real>() -> Line<T> {
    Line {
        id: TypeId::of::<O>,
        derivatives: O::DERIVATIVE,
        inputs: O::In::<Sym<T>>::LEN,
        outputs: O::Out::<Sym<T>>::LEN,
        codes: O::In::<Sym<T>>::CODES + O::Out::<Sym<T>>::CODES,
        // Functions and no closures, of which each would be compiled twice for every operation.
        eval: eval::<O, T>,
        adjoint: match O::DERIVATIVE {
            Derivative::ByHand => adjoint::<O, T>,
            Derivative::Reverse | Derivative::Forward => nothing::<T>,
        },
    }
}

/// The result.
fn eval<O: Op, T: Real>(input: &[Sym<T>]) -> Vec<Sym<T>> {
    O::eval(O::In::<Sym<T>>::load(input)).scalars()
}
fn nothing<T>(_input: &[Sym<T>], _out_bar: &[Sym<T>]) -> Vec<Sym<T>> {
    Vec::new()
}

/// The result and the derivatives by hand. Without them they are NaN: the program fails to be finite, which nothing
/// then hides.
fn adjoint<O: Op, T: Real>(input: &[Sym<T>], out_bar: &[Sym<T>]) -> Vec<Sym<T>> {
    let out_bar = O::Out::<Sym<T>>::load(out_bar);
    match O::adjoint(O::In::<Sym<T>>::load(input), out_bar) {
        Some((value, derivatives)) => [value.scalars(), derivatives.scalars()].concat(),
        None => vec![Sym::lit(f64::NAN); O::Out::<Sym<T>>::LEN + O::In::<Sym<T>>::LEN],
    }
}

/// The program of a mode of an operation.
pub(crate) fn program_of<O: Op, T: Real>(mode: Mode) -> Result<Arc<Recorded>, Error> {
    const { &line_of::<O, T>() }.program(mode)
}

//! An operation as a subject of the verification harness: its witnesses and its declared properties.
use crate::ad::check::certificate::Proof;
use crate::ad::check::noise::{Noisy, noisy};
use crate::ad::check::subject::{Conventions, Subject};
use crate::ad::check::trace::{Trace, Traced, num_duals, of_num_duals};
use crate::ad::check::witness::Precision;
use crate::ad::declared::{Invariance, Kind};
use crate::ad::forward::{Along, First};
use crate::ad::sample::Sample;
use crate::ad::sample::drawn::Near;
use crate::kernels::check::jets::{self, moving, nearest, noisy_list, widened};
use crate::kernels::check::with_adjoint::{DecidesIn, WithAdjoint};
use crate::kernels::check::witness::Batch;
use crate::{Fixed, Jet, Pack, Real, Scalar};
use std::fmt;

/// A second computation of an operation's value.
pub type Path<S> = fn(&[S]) -> Vec<S>;
/// The fused computation of an operation's value and derivatives.
pub type Fused<S> = fn(&[S]) -> (Vec<S>, Vec<S>);

/// An operation near an input, in one format.
pub struct OpSubject<'a, S: Real> {
    near: &'a dyn Near,
    code: Box<dyn SourceFunctions<S> + 'a>,
    paths: &'a [Path<S>],
    fused: Option<Fused<S>>,
    batch: Option<&'a Batch<'a>>,
    proof: Option<ProofAt<'a>>,
    stated: SourceProperties,
}

/// A function that proves the value at an input.
pub(crate) type ProofAt<'a> = &'a dyn Fn(&[f64]) -> Option<Proof>;

impl<S: Real> fmt::Debug for OpSubject<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OpSubject").finish_non_exhaustive()
    }
}

/// The declared properties of a source.
#[derive(Clone, Copy)]
struct SourceProperties {
    outputs: usize,
    output_kinds: fn() -> Vec<Kind>,
    invariances: &'static [Invariance],
    conventions: Conventions,
}

/// A source near an input, as untyped functions of every number type of the harness, so that the harness is compiled
/// once.
trait SourceFunctions<S: Real> {
    fn value(&self, x: &[S]) -> Vec<S>;
    fn first(&self, x: &[First<S>]) -> Vec<First<S>>;
    fn jets(&self, x: &[Jet<S, 1>]) -> Vec<Jet<S, 1>>;
    fn second(&self, x: &[Along<S>]) -> Vec<Along<S>>;
    fn traced(&self, x: &[Traced<S>]) -> (Vec<Traced<S>>, Trace);
    fn num_dual(&self, x: &[S::NumDual]) -> Option<Vec<S::NumDual>>;
    fn vjp(&self, x: &[S], y_bar: &[S]) -> Vec<S>;
    fn noisy_vjp(&self, x: &[Noisy<S>], y_bar: &[Noisy<S>]) -> Vec<Noisy<S>>;
    fn jets_vjp(&self, x: &[Jet<S, 1>], y_bar: &[Jet<S, 1>]) -> Vec<Jet<S, 1>>;
    fn noisy_jets_vjp(
        &self,
        x: &[Jet<Noisy<S>, 1>],
        y_bar: &[Jet<Noisy<S>, 1>],
    ) -> Vec<Jet<Noisy<S>, 1>>;
    /// Returns this source in double precision.
    fn wide(&self) -> OpSubject<'_, f64>;
}

/// A source near an input, which fixes the number of scalars.
struct SourceAt<'a, O: WithAdjoint>
where
    O::In<f64>: Sample,
{
    near: &'a O::In<f64>,
    decides: DecidesIn,
}

impl<O: WithAdjoint> SourceAt<'_, O>
where
    O::In<f64>: Sample,
{
    fn made<T: Scalar>(&self, x: &[T]) -> O::In<T> {
        O::made(self.near, x)
    }
    fn eval<T: Scalar<Mask = bool>>(&self, x: &[T]) -> Vec<T> {
        O::eval_as::<T>(self.decides, &self.made(x)).scalars()
    }
    fn pulled<T: Scalar<Mask = bool>>(&self, x: &[T], y_bar: &[T]) -> Vec<T> {
        O::pulled_as::<T>(self.decides, &self.made(x), O::Out::<T>::load(y_bar))
    }
}

impl<O: WithAdjoint, S: Real> SourceFunctions<S> for SourceAt<'_, O>
where
    O::In<f64>: Sample,
    O::Out<f64>: Sample,
{
    fn value(&self, x: &[S]) -> Vec<S> {
        self.eval(x)
    }
    fn first(&self, x: &[First<S>]) -> Vec<First<S>> {
        self.eval(x)
    }
    fn jets(&self, x: &[Jet<S, 1>]) -> Vec<Jet<S, 1>> {
        self.eval(x)
    }
    fn second(&self, x: &[Along<S>]) -> Vec<Along<S>> {
        self.eval(x)
    }
    fn traced(&self, x: &[Traced<S>]) -> (Vec<Traced<S>>, Trace) {
        let (out, trace) = O::traced_as::<S>(self.decides, &self.made(x));
        (out.scalars(), trace)
    }
    fn num_dual(&self, x: &[S::NumDual]) -> Option<Vec<S::NumDual>> {
        Some(O::on_num_dual::<S>(&self.made(x))?.scalars())
    }
    fn vjp(&self, x: &[S], y_bar: &[S]) -> Vec<S> {
        self.pulled(x, y_bar)
    }
    fn noisy_vjp(&self, x: &[Noisy<S>], y_bar: &[Noisy<S>]) -> Vec<Noisy<S>> {
        self.pulled(x, y_bar)
    }
    fn jets_vjp(&self, x: &[Jet<S, 1>], y_bar: &[Jet<S, 1>]) -> Vec<Jet<S, 1>> {
        self.pulled(x, y_bar)
    }
    fn noisy_jets_vjp(
        &self,
        x: &[Jet<Noisy<S>, 1>],
        y_bar: &[Jet<Noisy<S>, 1>],
    ) -> Vec<Jet<Noisy<S>, 1>> {
        self.pulled(x, y_bar)
    }
    fn wide(&self) -> OpSubject<'_, f64> {
        let decides = match O::DECLARED.by_roundings {
            true => DecidesIn::Single,
            false => DecidesIn::Own,
        };
        OpSubject::deciding::<O>(self.near, &[], None, decides)
    }
}

impl<'a, S: Real> OpSubject<'a, S> {
    /// Creates a subject from a source near an input, which fixes the number of scalars.
    #[must_use]
    pub fn of<O: WithAdjoint>(
        near: &'a O::In<f64>,
        paths: &'a [Path<S>],
        fused: Option<Fused<S>>,
    ) -> Self
    where
        O::In<f64>: Sample,
        O::Out<f64>: Sample,
    {
        Self::deciding::<O>(near, paths, fused, DecidesIn::Own)
    }
    /// Creates a subject whose search decides in a format.
    fn deciding<O: WithAdjoint>(
        near: &'a O::In<f64>,
        paths: &'a [Path<S>],
        fused: Option<Fused<S>>,
        decides: DecidesIn,
    ) -> Self
    where
        O::In<f64>: Sample,
        O::Out<f64>: Sample,
    {
        OpSubject {
            near,
            code: Box::new(SourceAt::<O> { near, decides }),
            paths,
            fused,
            batch: None,
            proof: None,
            stated: SourceProperties {
                outputs: O::Out::<S>::LEN,
                output_kinds: || Sample::kinds(&O::Out::<f64>::filled(1.0)),
                invariances: O::DECLARED.invariances,
                conventions: Conventions {
                    flat: true,
                    jumps: O::DECLARED.jumps,
                    shared_ties: false,
                    searches: O::SEARCHES,
                },
            },
        }
    }
    /// Adds a batch as a further witness; a batch computes in `f32`.
    #[must_use]
    pub fn with_batch(mut self, batch: Option<&'a Batch<'a>>) -> Self {
        self.batch = batch;
        self
    }
    /// Adds proofs of the value.
    #[must_use]
    pub(crate) fn with_proof(mut self, proof: Option<ProofAt<'a>>) -> Self {
        self.proof = proof;
        self
    }
}

impl<S: Real> Subject for OpSubject<'_, S> {
    fn precision(&self) -> Precision {
        Precision::of::<S>()
    }
    fn value(&self, x: &[f64]) -> Vec<f64> {
        widened(&self.code.value(&nearest(x)))
    }
    fn other_values(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let list: Vec<S> = nearest(x);
        let paths = self.paths.iter();
        let mut all: Vec<Vec<f64>> = paths.map(|path| widened(&path(&list))).collect();
        all.extend(self.fused.map(|fused| widened(&fused(&list).0)));
        all.push(jets::values_of_jets(x, |x| self.code.first(x)));
        all
    }
    fn adjoint(&self, x: &[f64], y_bar: &[f64]) -> Option<Vec<f64>> {
        Some(widened(&self.code.vjp(&nearest(x), &nearest(y_bar))))
    }
    fn noisy(&self, x: &[f64], y_bar: &[f64], seed: u64) -> Option<Vec<f64>> {
        // Low parts in single precision hold rounding errors; other values would distort them.
        if S::format().is_compensated() {
            return None;
        }
        let derivatives = noisy(seed, || {
            self.code.noisy_vjp(&noisy_list(x), &noisy_list(y_bar))
        });
        Some(derivatives.iter().map(|s| s.0.widen()).collect())
    }
    fn further(&self, x: &[f64], y_bar: &[f64]) -> Vec<Vec<f64>> {
        let fused = self.fused.map(|fused| fused(&nearest(x)).1);
        let scaled = |list: Vec<S>| list.iter().map(|s| s.widen() * y_bar[0]).collect();
        fused.map(scaled).into_iter().collect()
    }
    fn forms(&self) -> usize {
        self.batch.map_or(0, Batch::forms)
    }
    fn batch(&self, form: usize, x: &[f64], y_bar: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let answer = self.batch?.about(form, x)?;
        let derivatives = answer.derivatives(y_bar);
        Some((answer.value, derivatives))
    }
    fn jacobian(&self, x: &[f64]) -> Option<Vec<Vec<f64>>> {
        let eval = |x: &[First<S>]| self.code.first(x);
        Some(jets::jacobian(self.stated.outputs, x, eval))
    }
    fn along(&self, x: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let out = self.code.jets(&moving(x, direction, |x: S| x));
        Some(widened(&jets::slopes(&out)))
    }
    fn num_dual(&self, x: &[f64], direction: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let out = self.code.num_dual(&num_duals::<S>(x, direction))?;
        Some(of_num_duals::<S>(out))
    }
    fn traced(&self, x: &[f64]) -> Option<(Vec<f64>, Trace)> {
        let input: Vec<Traced<S>> = x.iter().map(|&x| Traced(S::nearest(x))).collect();
        let (out, trace) = self.code.traced(&input);
        Some((out.iter().map(|y| y.0.widen()).collect(), trace))
    }
    fn curvature(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let y_bar: Vec<Jet<S, 1>> = y_bar.iter().map(|&y| Scalar::lit(y)).collect();
        let bends = self.code.jets_vjp(&moving(x, direction, |x: S| x), &y_bar);
        Some(widened(&jets::slopes(&bends)))
    }
    fn noisy_curvature(
        &self,
        x: &[f64],
        y_bar: &[f64],
        direction: &[f64],
        seed: u64,
    ) -> Option<Vec<f64>> {
        if S::format().is_compensated() {
            return None;
        }
        let bends = noisy(seed, || {
            let y_bar: Vec<Jet<Noisy<S>, 1>> = y_bar.iter().map(|&y| Scalar::lit(y)).collect();
            self.code
                .noisy_jets_vjp(&moving(x, direction, |x: S| Noisy(x)), &y_bar)
        });
        let bends = bends.iter().map(|jet| jet.derivative[0].0.widen());
        Some(bends.collect())
    }
    fn second_order(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let eval = |x: &[Along<S>]| self.code.second(x);
        Some(jets::second_order(x, y_bar, direction, eval))
    }
    fn wide(&self) -> Option<Box<dyn Subject + '_>> {
        (self.precision() == Precision::F32).then(|| Box::new(self.code.wide()) as Box<dyn Subject>)
    }
    fn proof(&self, x: &[f64]) -> Option<Proof> {
        self.proof.and_then(|proof| proof(x))
    }
    fn inside(&self, x: &[f64]) -> bool {
        self.near.inside(x)
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        self.near.scales(x)
    }
    fn units(&self, x: &[f64]) -> Vec<f64> {
        self.near.units(x)
    }
    fn comparable(&self) -> bool {
        true
    }
    fn rounding(&self, x: &[f64]) -> Vec<f64> {
        jets::rounding(self.near, self.precision(), x)
    }
    fn kinds(&self) -> Vec<Kind> {
        self.near.kinds()
    }
    fn output_kinds(&self) -> Vec<Kind> {
        (self.stated.output_kinds)()
    }
    fn invariances(&self) -> &[Invariance] {
        self.stated.invariances
    }
    fn conventions(&self) -> Conventions {
        self.stated.conventions
    }
}

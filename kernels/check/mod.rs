//! Rows as subjects of the verification harness.
//!
//! ```
//! use geograd::Triangle2;
//! use geograd::kernels::{Area, RowOf, check::check};
//! let report = check::<RowOf<Area, Triangle2<f64>>, f64>(20, 1);
//! assert!(report.passed(), "{report}");
//! ```
//!
//! An invariance is a motion of the input with its effect on the result ([`symmetry`](crate::ad::check::symmetry)): the
//! result stays, grows with a power of the scale, or moves along according to the kinds of its numbers. The harness
//! checks derivatives and invariances, not the formula: a radius off by a factor of two passes, so a formula needs a
//! test of its value, too.
//!
//! An operation is judged by its recording, so that the harness is compiled once, in the library. An adjoint by hand
//! has two further witnesses: reverse derivatives of the recording in double precision, and num-dual's numbers.
//! The adjoint of a search is the recorded pull-back of its replay, with duals of the replay as a witness.
mod dynamic;
mod jets;
mod of;
pub(crate) mod proofs;
pub(crate) mod recorded_subject;
pub(crate) mod subject;
mod with_adjoint;
pub mod witness;

pub use dynamic::Inputs;
pub use of::OfOperation;
pub use subject::{Fused, OpSubject, Path};
use with_adjoint::context_and_path;
pub use with_adjoint::{Folded, Replayed, Straight, WithAdjoint};

use crate::ad::check::candidate::{Candidate, Meet, Untyped};
use crate::ad::check::picture;
use crate::ad::check::subject::Subject;
use crate::ad::check::verdict::Reason;
use crate::ad::check::witness::Precision;
use crate::ad::check::{Report, Sampling, examine};
use crate::ad::declared::Kind;
use crate::ad::sample::Sample;
use crate::ad::sample::drawn::{Drawn, Kinship};
use crate::error::Field;
use crate::kernels::Backend;
use crate::kernels::call::modes::recording_of;
use crate::kernels::call::recording::Recording;
use crate::kernels::call::search::HintedSearch;
use crate::kernels::check::proofs::Proofs;
use crate::kernels::check::recorded_subject::{ByHand, Computations, RecordedSubject};
use crate::kernels::check::subject::ProofAt;
use crate::kernels::check::witness::{
    Batch, ByMachine, ask_any, ask_folds, ask_gradient, ask_pairs,
};
use crate::kernels::dynamic::Function;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::fold::{Fold, edge_by_edge};
use crate::kernels::row::item::{Item, Single};
use crate::kernels::row::op::{Declared, Derivative, Op};
use crate::scalar::real::in_format;
use crate::{Error, Fixed, Pack, Real};
use std::any::Any;
use std::sync::Arc;

/// The parts of the harness that this library compiles with optimisation, for each format. Generic functions would be
/// compiled anew in every crate that checks an operation.
pub(crate) struct Harness<S: Real> {
    /// Passes a recorded operation as a subject to its judge.
    pub(crate) judged: fn(&RecordedSubject<'_, S>, &mut dyn FnMut(&dyn Subject)),
}

static F32: Harness<f32> = Harness {
    judged: |subject, judge| judge(subject),
};
static F64: Harness<f64> = Harness {
    judged: |subject, judge| judge(subject),
};

impl<S: Real> Harness<S> {
    /// Returns the harness of a format.
    pub(crate) fn get() -> &'static Self {
        in_format([&F32, &F64])
    }
}

/// The scalar code of a straight line in one format.
pub(crate) struct ScalarCode<S: Real> {
    /// The function.
    pub(crate) alone: Path<S>,
    /// The result and the derivatives by hand.
    pub(crate) by_hand: ByHand<S>,
    /// The function on num-dual's numbers, if derivatives are by hand.
    pub(crate) num_dual: Option<fn(&[S::NumDual]) -> Vec<S::NumDual>>,
}

impl<S: Real> Clone for ScalarCode<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Real> Copy for ScalarCode<S> {}

impl<S: Real> ScalarCode<S> {
    pub(crate) const fn of<O: Op>() -> Self {
        let is_by_hand = matches!(O::DECLARED.derivative, Derivative::ByHand);
        ScalarCode {
            alone: alone::<O, S>,
            by_hand: match is_by_hand {
                true => by_hand::<O, S>,
                false => nothing::<S>,
            },
            // Compiled only if derivatives are by hand.
            num_dual: match is_by_hand {
                true => Some(on_num_dual::<O, S>),
                false => None,
            },
        }
    }
}

/// A straight line in one format for the harness and the fuzzer: its batches and its scalar code.
pub(crate) struct LineCode<S: Real> {
    pub(crate) recording: Arc<Recording<S>>,
    pub(crate) code: ScalarCode<S>,
}

impl<S: Real> LineCode<S> {
    pub(crate) fn of<O: Op>() -> Self
    where
        O::In<S>: Item<Scalar = S>,
        O::Out<S>: Item<Scalar = S>,
    {
        LineCode {
            recording: recording_of::<O, O::In<S>>(),
            code: const { ScalarCode::of::<O>() },
        }
    }
    /// Returns the computations that the harness compares.
    fn computations(&self, stated: &LineProperties) -> Result<Computations<S>, Error> {
        let value = self.recording.program(Mode::Value)?;
        let is_wide = Precision::of::<S>() == Precision::F64;
        let by_hand_alone = self.code.num_dual.is_some() && is_wide;
        Ok(Computations {
            reversed: by_hand_alone.then(|| value.value_vjp().into()),
            value,
            derivatives: self.recording.program(Mode::Vjp)?,
            source: Some(self.code.alone),
            batch: Function::of_straight(Arc::clone(&self.recording), Mode::Value),
            by_hand: self.code.by_hand,
            num_dual: self.code.num_dual,
            outputs: self.recording.outputs.iter().sum(),
            output_kinds: (stated.output_kinds)(),
            nests: true,
            invariances: stated.declared.invariances,
            jumps: stated.declared.jumps,
        })
    }
}

/// Returns the result.
fn alone<O: Op, S: Real>(x: &[S]) -> Vec<S> {
    O::eval(O::In::<S>::load(x)).scalars()
}

fn nothing<S>(_x: &[S], _out_bar: &[S]) -> Option<(Vec<S>, Vec<S>)> {
    None
}

/// Returns the result and the derivatives by hand.
fn by_hand<O: Op, S: Real>(x: &[S], out_bar: &[S]) -> Option<(Vec<S>, Vec<S>)> {
    let (value, bars) = O::adjoint(O::In::<S>::load(x), O::Out::<S>::load(out_bar))?;
    Some((value.scalars(), bars.scalars()))
}

/// Returns the result on num-dual's numbers.
fn on_num_dual<O: Op, S: Real>(x: &[S::NumDual]) -> Vec<S::NumDual> {
    O::eval(O::In::<S::NumDual>::load(x)).scalars()
}

/// The declared properties of a straight line, and the kinds of its result's numbers.
#[derive(Clone, Copy)]
pub(crate) struct LineProperties {
    pub(crate) declared: &'static Declared,
    pub(crate) output_kinds: fn() -> Vec<Kind>,
}

impl LineProperties {
    const fn of<O: Op>() -> Self
    where
        O::Out<f64>: Sample,
    {
        LineProperties {
            declared: const { &O::DECLARED },
            output_kinds: || O::Out::<f64>::filled(1.0).kinds(),
        }
    }
}

/// Returns the value of a fold, edge by edge.
fn value_by_edges<F: Fold, S: Real>(x: &[S]) -> Vec<S> {
    let (context, path) = context_and_path::<F, S>(x);
    edge_by_edge::<F, S>(context, &path).scalars()
}

/// The largest number of draws for a random input inside the domain.
const ATTEMPTS: usize = 16;
/// The step between the random inputs that lie on a coarse grid.
const LATTICE: usize = 3;

/// The inputs to judge.
struct Cases {
    /// Hard cases, then random inputs, all rounded to a format. Some may be outside the domain.
    all: Vec<Box<dyn Drawn>>,
    /// The number of hard cases.
    random_from: usize,
    /// The number of rejected draws outside the domain.
    outside: u64,
}

impl Cases {
    /// Draws the inputs of a sampling, rounded to a format.
    fn of(kinship: Kinship, sampling: &Sampling<'_>, precision: Precision) -> Self {
        let rounded = |x: Box<dyn Drawn>| {
            let list: Vec<f64> = x.numbers().iter().map(|&x| precision.round(x)).collect();
            x.refilled(&list)
        };
        let cases = kinship.hard_cases();
        let points = sampling.points.iter().filter_map(|point| {
            let like = cases.first()?;
            (like.numbers().len() == point.len()).then(|| like.refilled(point))
        });
        let points: Vec<Box<dyn Drawn>> = points.collect();
        let hard = match sampling.hard {
            0 => Vec::new(),
            every => cases.into_iter().step_by(every).collect(),
        };
        let hard = points.into_iter().chain(hard).map(rounded);
        let mut all: Vec<Box<dyn Drawn>> = hard.filter(|x| x.is_inside()).collect();
        let (random_from, mut outside) = (all.len(), 0);
        for i in 0..sampling.samples {
            let mut draw = sampling.draw(i);
            let mut drawn = || match i % LATTICE {
                0 => rounded(kinship.lattice(&mut draw)),
                _ => rounded(kinship.random(&mut draw)),
            };
            let (mut x, mut attempts) = (drawn(), 1);
            while attempts < ATTEMPTS && sampling.inside.is_some_and(|inside| !inside(&x.numbers()))
            {
                (x, attempts) = (drawn(), attempts + 1);
                outside += 1;
            }
            all.extend(Some(x).filter(|x| x.is_inside()));
        }
        Cases {
            all,
            random_from,
            outside,
        }
    }
}

/// Builds the subjects near an input and passes them to a function.
type With<'a> = &'a dyn Fn(&dyn Drawn, Option<&Batch<'_>>, &mut dyn FnMut(&dyn Subject));

/// Judges an operation at hard cases and random inputs, with batches, if there are any, as further witnesses.
fn judged(
    name: &'static str,
    sampling: &Sampling<'_>,
    inputs: Cases,
    asks: Vec<ByMachine<'_>>,
    with: With<'_>,
) -> Result<Report, Error> {
    let Cases {
        all: inputs,
        random_from,
        outside,
    } = inputs;
    let batch = match asks.is_empty() {
        true => None,
        false => {
            let lists: Vec<Vec<f64>> = inputs.iter().map(|x| x.numbers()).collect();
            Some(Batch::new(asks, &lists)?)
        }
    };
    let batch = batch.as_ref();
    let meet: &Meet<'_> = &|x, judge| with(x, batch, judge);
    let inputs: Vec<Untyped<'_>> = inputs.into_iter().map(|x| Untyped { x, meet }).collect();
    let candidates: Vec<&dyn Candidate<'_>> = inputs.iter().map(|x| x as _).collect();
    let mut report = examine::examined(name, sampling, &candidates, random_from);
    report.outside += outside;
    let worst = inputs.get(report.worst[1].nearest.sample);
    if let Some(Untyped { x, .. }) = worst.filter(|_| sampling.draws) {
        let title = format!("{name}: where adjoint and differences are farthest apart");
        with(&**x, None, &mut |subject| {
            report.picture = Some(picture::drawn(&title, &**x, subject));
        });
    }
    match batch.and_then(Batch::error) {
        Some(error) => Err(error),
        None => Ok(report),
    }
}

/// Casts the input of a subject to its type.
fn typed<X: Sample>(x: &dyn Drawn) -> &X {
    let found = x.as_any().downcast_ref();
    found.unwrap_or_else(|| unreachable!("inputs of one kind are of one type"))
}

/// Runs every check of an operation.
pub fn check<O: Op, S: Real>(samples: usize, seed: u64) -> Report
where
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::In<S>: Item,
    O::Out<S>: Item,
{
    check_with::<O, S>(&Sampling::new(samples, seed))
}

/// Runs every check of an operation at the inputs of a sampling.
pub fn check_with<O: Op, S: Real>(sampling: &Sampling<'_>) -> Report
where
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::In<S>: Item,
    O::Out<S>: Item,
{
    without_batch(straight::<O, S>(sampling, None, false))
}

/// Runs every check in `f32`, with batches on a backend as further witnesses: values, adjoints, and values with
/// gradients. On a GPU these are its [generated](crate::kernels::gpu) kernels.
///
/// A backend rounds differently: a GPU may fuse products and sums, and flush numbers below the smallest normal one to
/// zero. Its quotients are right to two and a half units in the last place. These errors are less than the tolerance,
/// which comes from eight perturbations of the inputs by twice their rounding.
///
/// # Errors
///
/// The errors of the backend.
pub fn check_on<O: Op>(backend: Backend<'_>, sampling: &Sampling<'_>) -> Result<Report, Error>
where
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
{
    straight::<O, f32>(sampling, Some(backend), false)
}

/// Runs every check as [`check_on`], with the kernels of all pairs as one more witness: they differ from the others,
/// and on a GPU those of boxes in the plane are by hand.
///
/// # Errors
///
/// The errors of the backend.
pub fn check_pairs_on<O, A, B>(
    backend: Backend<'_>,
    sampling: &Sampling<'_>,
) -> Result<Report, Error>
where
    O: Op<In<f32> = (A, B), Out<f32> = f32>,
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
{
    straight::<O, f32>(sampling, Some(backend), true)
}

fn straight<O: Op, S: Real>(
    sampling: &Sampling<'_>,
    backend: Option<Backend<'_>>,
    pairs: bool,
) -> Result<Report, Error>
where
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::In<S>: Item,
    O::Out<S>: Item,
{
    let wide = &LineCode::<f64>::of::<O>();
    let own = &LineCode::<S>::of::<O>();
    examined::<S>(
        const { &LineProperties::of::<O>() },
        (const { Kinship::of::<O::In<f64>>() }, O::In::<f64>::name),
        own,
        wide,
        (sampling, backend, pairs),
    )
}

/// Judges a straight line, with batches on a backend as further witnesses of `f32`: aligned values, values with
/// gradients, and all pairs if `pairs` is set.
pub(crate) fn examined<S: Real>(
    stated: &LineProperties,
    (kinship, name): (Kinship, fn(usize) -> Field),
    own: &LineCode<S>,
    wide: &LineCode<f64>,
    (sampling, backend, pairs): (&Sampling<'_>, Option<Backend<'_>>, bool),
) -> Result<Report, Error> {
    let declared = stated.declared;
    let domain = declared
        .domain
        .as_ref()
        .map(|inside| inside as &dyn Fn(&[f64]) -> bool);
    let roundings = declared
        .roundings
        .as_ref()
        .map(|roundings| roundings as &dyn Fn(&[f64]) -> f64);
    let sampling = &Sampling {
        inside: sampling.inside.or(domain),
        resolution: sampling.resolution.or(Some(declared.resolution)),
        roundings: sampling.roundings.or(roundings),
        ..*sampling
    };
    let wide = match Precision::of::<S>() {
        Precision::F32 => wide.computations(stated).ok(),
        Precision::F64 => None,
    };
    let recordings = (own.computations(stated), wide);
    let recording = Arc::clone(&own.recording);
    let scalars = recording.takes.iter().map(|leaf| leaf.fields - leaf.codes);
    let names = names_of(name, scalars.sum(), recording.arguments);
    let single = (recording as Arc<dyn Any + Send + Sync>)
        .downcast::<Recording<f32>>()
        .ok();
    let (any, gradient, all_pairs);
    let mut asks: Vec<ByMachine<'_>> = Vec::new();
    if let (Some(backend), Some(single)) = (backend, &single) {
        any = move |inputs: &[Vec<f32>]| ask_any(backend, single, inputs);
        gradient = move |inputs: &[Vec<f32>]| ask_gradient(backend, single, inputs);
        all_pairs = move |inputs: &[Vec<f32>]| ask_pairs(backend, single, inputs);
        asks.extend([&any as ByMachine<'_>, &gradient]);
        asks.extend(pairs.then_some(&all_pairs as ByMachine<'_>));
    }
    let report = recorded::<S>(declared.name, kinship, sampling, asks, recordings);
    report.map(|report| Report { names, ..report })
}

/// Returns the names of an input's numbers, from those of its arguments: `point.x`.
fn names_of(name: fn(usize) -> Field, count: usize, arguments: &[&str]) -> Vec<String> {
    let named = |i: usize| {
        let field = name(i).to_string();
        let (argument, rest) = match arguments {
            [] => return field,
            [one] => (*one, field.as_str()),
            // The parts of a tuple are numbered.
            several => {
                let digits = field.bytes().take_while(u8::is_ascii_digit).count();
                let part = field[..digits].parse::<usize>().ok();
                match part.and_then(|part| several.get(part)) {
                    Some(argument) => (*argument, &field[digits..]),
                    None => return field,
                }
            }
        };
        match rest.trim_start_matches('.') {
            "" | "value" => argument.to_owned(),
            rest if rest.starts_with('[') => format!("{argument}{rest}"),
            rest => format!("{argument}.{rest}"),
        }
    };
    (0..count).map(named).collect()
}

/// Judges the recording of an operation; refuses the operation without one.
fn recorded<S: Real>(
    name: &'static str,
    kinship: Kinship,
    sampling: &Sampling<'_>,
    asks: Vec<ByMachine<'_>>,
    (recording, wide): (Result<Computations<S>, Error>, Option<Computations<f64>>),
) -> Result<Report, Error> {
    let recording = match recording {
        Ok(recording) => recording,
        Err(Error::Program(why)) => {
            let (precision, reason) = (Precision::of::<S>(), Reason::Unrecordable(why));
            return Ok(Report::refused_whole(
                name,
                sampling.seed,
                precision,
                reason,
            ));
        }
        Err(error) => return Err(error),
    };
    let inputs = Cases::of(kinship, sampling, Precision::of::<S>());
    judged(name, sampling, inputs, asks, &|x, batch, judge| {
        let subject = RecordedSubject {
            near: x.near(),
            recording: &recording,
            wide: wide.as_ref(),
            batch,
        };
        (Harness::<S>::get().judged)(&subject, judge);
    })
}

/// Runs every check of a fold over paths.
pub fn check_fold_with<F: Fold, S: Real>(sampling: &Sampling<'_>) -> Report
where
    (F::Context<f64>, Vec<F::Element<f64>>): Sample,
    F::Out<f64>: Sample,
{
    without_batch(folded::<F, S>(sampling, Vec::new()))
}

/// Runs every check of a fold in `f32`, with batches of measures of rings on a backend as a further witness; see
/// [`check_on`].
///
/// # Errors
///
/// The errors of the backend.
pub fn check_fold_on<F: Fold>(
    backend: Backend<'_>,
    sampling: &Sampling<'_>,
) -> Result<Report, Error>
where
    (F::Context<f64>, Vec<F::Element<f64>>): Sample,
    F::Out<f64>: Sample,
    F::Context<f32>: Item<Scalar = f32>,
{
    let ask = |inputs: &[Vec<f32>]| ask_folds::<F>(backend, inputs);
    let asks: Vec<ByMachine<'_>> = match F::MEASURE {
        Some(_) => vec![&ask],
        None => Vec::new(),
    };
    folded::<F, f32>(sampling, asks)
}

fn folded<F: Fold, S: Real>(
    sampling: &Sampling<'_>,
    asks: Vec<ByMachine<'_>>,
) -> Result<Report, Error>
where
    (F::Context<f64>, Vec<F::Element<f64>>): Sample,
    F::Out<f64>: Sample,
{
    let kinship = const { Kinship::of::<(F::Context<f64>, Vec<F::Element<f64>>)>() };
    let inputs = Cases::of(kinship, sampling, Precision::of::<S>());
    judged(
        F::DECLARED.name,
        sampling,
        inputs,
        asks,
        &|x, batch, judge| {
            // A measure by hand is also checked edge by edge.
            let by_edges: [Path<S>; 1] = [value_by_edges::<F, S>];
            let paths = match F::MEASURE {
                Some(_) => &by_edges[..],
                None => &[],
            };
            judge(&OpSubject::<S>::of::<Folded<F>>(typed(x), paths, None).with_batch(batch));
        },
    )
}

/// Runs every check of an operation with a search.
pub fn check_search_with<D: HintedSearch, S: Real>(sampling: &Sampling<'_>) -> Report
where
    D::In<f64>: Sample,
    D::Out<f64>: Sample,
{
    check_search_proved::<D, S>(sampling, None)
}

/// Runs every check of an operation with a search, with proofs of its values.
pub(crate) fn check_search_proved<D: HintedSearch, S: Real>(
    sampling: &Sampling<'_>,
    proofs: Option<&Proofs<S>>,
) -> Report
where
    D::In<f64>: Sample,
    D::Out<f64>: Sample,
{
    let kinship = const { Kinship::of::<D::In<f64>>() };
    let inputs = Cases::of(kinship, sampling, Precision::of::<S>());
    let report = judged(
        D::DECLARED.name,
        sampling,
        inputs,
        Vec::new(),
        &|x, _, judge| {
            let near: &D::In<f64> = typed(x);
            let proof = |x: &[f64]| proofs?.at(x, &near.codes());
            let proof = proofs.map(|_| &proof as ProofAt<'_>);
            judge(&OpSubject::<S>::of::<Replayed<D>>(near, &[], None).with_proof(proof));
        },
    );
    Report {
        names: names_of(D::In::<f64>::name, D::In::<f64>::LEN, D::DECLARED.arguments),
        ..without_batch(report)
    }
}

fn without_batch(report: Result<Report, Error>) -> Report {
    report.unwrap_or_else(|_| unreachable!("only a batch can fail"))
}

//! Operations as subjects of the verification harness.
//!
//! ```
//! use geograd::kernels::{check::prove, IouObb2};
//! let report = prove::<IouObb2, f64>(20, 1);
//! assert!(report.passed(), "{report}");
//! ```
use crate::ad::check::picture::picture;
use crate::ad::check::sample::{Sample, hard_cases, random};
use crate::ad::check::trace::Number;
use crate::ad::check::{Plan, Report, examine};
use crate::kernels::gpu::{GpuPair, GpuRing};
use crate::kernels::op::{Op, RingOp, Ringed, Slopes, Source, Straight};
use crate::kernels::real::Real;
use crate::kernels::row::{Row, target};
use crate::kernels::witness::{Ask, Batch, ask_pairs, ask_rings};
use crate::kernels::{Backend, Cpu, GpuError};
use crate::{Fixed, Pack, Vec2};

pub use crate::kernels::subject::{Fused, OpSubject, Path};

/// The value by a batch.
fn batch_value<O: Op, S: Number + Real>(x: &[S]) -> Vec<S>
where
    O::In<S>: Row,
    O::Out<S>: Row,
{
    let mut out = [O::Out::<S>::filled(S::zero())];
    let into = target(&mut out);
    match Cpu::new().run_into(O::default(), &[O::In::<S>::load(x)][..], vec![Some(into)]) {
        Ok(()) => out[0].scalars(),
        Err(_) => Vec::new(),
    }
}

/// The value and slopes of one number, fused.
fn fused<O: Op, S: Number>(x: &[S]) -> (Vec<S>, Vec<S>) {
    let one = O::Out::<S>::filled(S::one());
    match O::adjoint(O::In::<S>::load(x), one) {
        Some((value, bars)) => (value.scalars(), bars.scalars()),
        None => Default::default(),
    }
}

/// The value of a ring that is a slice.
fn ring_value<O: RingOp, S: Number>(x: &[S]) -> Vec<S> {
    let ring: Vec<Vec2<S>> = x.chunks(2).map(|p| Vec2::new(p[0], p[1])).collect();
    O::value(&ring).scalars()
}

/// Judges an operation at hard cases and random inputs, all rounded to the format, with a batch as a
/// further witness if there is one to ask.
fn judged<O: Source, S: Number>(
    plan: &Plan<'_>,
    paths: &[Path<S>],
    fused: Option<Fused<S>>,
    ask: Option<Ask<'_>>,
) -> Result<Report, GpuError>
where
    O::In<f64>: Sample,
{
    let rounded = |x: O::In<f64>| {
        let list: Vec<f64> = x.scalars().iter().map(|&x| S::nearest(x).widen()).collect();
        x.refill(&list)
    };
    let hard: Vec<O::In<f64>> = match plan.hard {
        0 => Vec::new(),
        every => hard_cases().into_iter().step_by(every).collect(),
    };
    let mut inputs: Vec<O::In<f64>> = hard
        .into_iter()
        .map(rounded)
        .filter(Sample::inside)
        .collect();
    let random_from = inputs.len();
    let drawn = (0..plan.samples).map(|i| random(&mut plan.draw(i)));
    inputs.extend(drawn.map(rounded).filter(Sample::inside));
    let batch = match ask {
        Some(ask) => {
            let lists: Vec<Vec<f64>> = inputs.iter().map(Pack::scalars).collect();
            Some(Batch::new(ask, &lists)?)
        }
        None => None,
    };
    let batch = batch.as_ref();
    let mut report = examine(O::NAME, plan, &inputs, random_from, |x, judge| {
        judge(&OpSubject::<O, S>::new(x, paths, fused).with_batch(batch));
    });
    let worst = inputs.get(report.worst[1].nearest.sample);
    report.picture = worst.filter(|_| plan.draws).map(|x| {
        let title = format!(
            "{}: where adjoint and differences are farthest apart",
            O::NAME
        );
        picture(&title, x, &OpSubject::<O, S>::new(x, paths, fused))
    });
    match batch.and_then(Batch::error) {
        Some(error) => Err(error),
        None => Ok(report),
    }
}

/// Runs every check of an operation.
pub fn prove<O: Op, S: Number + Real>(samples: usize, seed: u64) -> Report
where
    O::In<f64>: Sample,
    O::In<S>: Row,
    O::Out<S>: Row,
{
    prove_with::<O, S>(&Plan::new(samples, seed))
}

/// The same by a plan.
pub fn prove_with<O: Op, S: Number + Real>(plan: &Plan<'_>) -> Report
where
    O::In<f64>: Sample,
    O::In<S>: Row,
    O::Out<S>: Row,
{
    without_batch(straight::<O, S>(plan, None))
}

/// The same in `f32`, with batches on a backend as a further witness.
///
/// A backend rounds differently: a GPU may fuse products and sums, divides to within two and a half
/// units in the last place, and takes numbers below the smallest normal one for zero. All of it is
/// less than what moving inputs by twice their rounding, eight times over, allows.
///
/// # Errors
///
/// The backend's.
pub fn prove_on<O: GpuPair>(backend: Backend<'_>, plan: &Plan<'_>) -> Result<Report, GpuError>
where
    O::In<f64>: Sample,
{
    straight::<O, f32>(plan, Some(&|inputs| ask_pairs::<O>(backend, inputs)))
}

fn straight<O: Op, S: Number + Real>(
    plan: &Plan<'_>,
    ask: Option<Ask<'_>>,
) -> Result<Report, GpuError>
where
    O::In<f64>: Sample,
    O::In<S>: Row,
    O::Out<S>: Row,
{
    let by_hand = O::SLOPES == Slopes::ByHand;
    let fused = by_hand.then_some(fused::<O, S> as Fused<S>);
    judged::<Straight<O>, S>(plan, &[batch_value::<O, S>], fused, ask)
}

/// Runs every check of an operation of a ring.
pub fn prove_ring<O: RingOp, S: Number + Real>(samples: usize, seed: u64) -> Report {
    prove_ring_with::<O, S>(&Plan::new(samples, seed))
}

/// The same by a plan.
pub fn prove_ring_with<O: RingOp, S: Number + Real>(plan: &Plan<'_>) -> Report {
    without_batch(ring::<O, S>(plan, None))
}

/// The same in `f32`, with batches on a backend as a further witness; see [`prove_on`].
///
/// # Errors
///
/// The backend's.
pub fn prove_ring_on<O: GpuRing>(
    backend: Backend<'_>,
    plan: &Plan<'_>,
) -> Result<Report, GpuError> {
    ring::<O, f32>(plan, Some(&|inputs| ask_rings::<O>(backend, inputs)))
}

fn ring<O: RingOp, S: Number + Real>(
    plan: &Plan<'_>,
    ask: Option<Ask<'_>>,
) -> Result<Report, GpuError> {
    judged::<Ringed<O>, S>(plan, &[ring_value::<O, S>], None, ask)
}

fn without_batch(report: Result<Report, GpuError>) -> Report {
    report.unwrap_or_else(|_| unreachable!("only a batch can fail"))
}

//! Operations as subjects of the verification harness.
//!
//! ```
//! use geograd::kernels::{check::prove_pair, overlap::IouObb2};
//! let report = prove_pair::<IouObb2, f64>(20, 1);
//! assert!(report.passed(), "{report}");
//! ```
use crate::ad::check::picture::picture;
use crate::ad::check::sample::{Sample, hard_cases, random};
use crate::ad::check::trace::Number;
use crate::ad::check::{Plan, Report, examine};
use crate::kernels::cpu;
use crate::kernels::gpu::{GpuPair, GpuRing};
use crate::kernels::op::{Op, PairOp, RingOp};
use crate::kernels::real::Real;
use crate::kernels::witness::{Ask, Batch, ask_pairs, ask_rings};
use crate::kernels::{Backend, GpuError};
use crate::{Fixed, Pack, Vec2};

pub use crate::kernels::subject::{Fused, OpSubject, Path, conventions, promises};

/// A pair's value for boxes of any size.
fn pair_value<O: PairOp, S: Number>(x: &[S]) -> Vec<S> {
    let (a, b) = x.split_at(O::A::<S>::LEN);
    let (a, b) = (
        O::frame_a(O::A::<S>::from_slice(a)),
        O::frame_b(O::B::<S>::from_slice(b)),
    );
    vec![O::value::<S, true>(a, b)]
}

/// A pair's value by the path that batches of ordinary boxes take.
fn pair_ordinary<O: PairOp, S: Number>(x: &[S]) -> Vec<S> {
    let (a, b) = x.split_at(O::A::<S>::LEN);
    let (a, b) = (O::A::<S>::from_slice(a), O::B::<S>::from_slice(b));
    let ordinary = matches!((O::check_a(&a), O::check_b(&b)), (Ok(true), Ok(true)));
    let (a, b) = (O::frame_a(a), O::frame_b(b));
    vec![if ordinary {
        O::value::<S, false>(a, b)
    } else {
        O::value::<S, true>(a, b)
    }]
}

/// A pair's value by a batch.
fn pair_batch<O: PairOp, S: Real>(x: &[S]) -> Vec<S> {
    let (a, b) = x.split_at(O::A::<S>::LEN);
    let (a, b) = (O::A::<S>::from_slice(a), O::B::<S>::from_slice(b));
    cpu::aligned::<O, S>(&[a], &[b]).unwrap_or_default()
}

/// A pair's value and slopes, fused.
fn pair_fused<O: PairOp, S: Number>(x: &[S]) -> (Vec<S>, Vec<S>) {
    let (a, b) = x.split_at(O::A::<S>::LEN);
    let (a, b) = (
        O::frame_a(O::A::<S>::from_slice(a)),
        O::frame_b(O::B::<S>::from_slice(b)),
    );
    let (value, (a_bar, b_bar)) = O::grad::<S, true>(a, b);
    (vec![value], [a_bar.scalars(), b_bar.scalars()].concat())
}

/// The value of a ring that is a slice.
fn ring_value<O: RingOp, S: Number>(x: &[S]) -> Vec<S> {
    let ring: Vec<Vec2<S>> = x.chunks(2).map(|p| Vec2::new(p[0], p[1])).collect();
    O::value(&ring).scalars()
}

/// Judges an operation at hard cases and random inputs, all rounded to the format, with a batch as a
/// further witness if there is one to ask.
fn prove_with<O: Op, S: Number>(
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

/// Runs every check of an operation of two shapes.
pub fn prove_pair<O: PairOp, S: Number + Real>(samples: usize, seed: u64) -> Report
where
    O::In<f64>: Sample,
{
    prove_pair_with::<O, S>(&Plan::new(samples, seed))
}

/// The same by a plan.
pub fn prove_pair_with<O: PairOp, S: Number + Real>(plan: &Plan<'_>) -> Report
where
    O::In<f64>: Sample,
{
    without_batch(pair::<O, S>(plan, None))
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
pub fn prove_pair_on<O: GpuPair>(backend: Backend<'_>, plan: &Plan<'_>) -> Result<Report, GpuError>
where
    O::In<f64>: Sample,
{
    pair::<O, f32>(plan, Some(&|inputs| ask_pairs::<O>(backend, inputs)))
}

fn pair<O: PairOp, S: Number + Real>(
    plan: &Plan<'_>,
    ask: Option<Ask<'_>>,
) -> Result<Report, GpuError>
where
    O::In<f64>: Sample,
{
    let paths: [Path<S>; 3] = [
        pair_value::<O, S>,
        pair_ordinary::<O, S>,
        pair_batch::<O, S>,
    ];
    prove_with::<O, S>(plan, &paths, Some(pair_fused::<O, S>), ask)
}

/// Runs every check of an operation of a ring.
pub fn prove_ring<O: RingOp, S: Number + Real>(samples: usize, seed: u64) -> Report
where
    O::In<f64>: Sample,
{
    prove_ring_with::<O, S>(&Plan::new(samples, seed))
}

/// The same by a plan.
pub fn prove_ring_with<O: RingOp, S: Number + Real>(plan: &Plan<'_>) -> Report
where
    O::In<f64>: Sample,
{
    without_batch(ring::<O, S>(plan, None))
}

/// The same in `f32`, with batches on a backend as a further witness; see [`prove_pair_on`].
///
/// # Errors
///
/// The backend's.
pub fn prove_ring_on<O: GpuRing>(backend: Backend<'_>, plan: &Plan<'_>) -> Result<Report, GpuError>
where
    O::In<f64>: Sample,
{
    ring::<O, f32>(plan, Some(&|inputs| ask_rings::<O>(backend, inputs)))
}

fn ring<O: RingOp, S: Number + Real>(
    plan: &Plan<'_>,
    ask: Option<Ask<'_>>,
) -> Result<Report, GpuError>
where
    O::In<f64>: Sample,
{
    prove_with::<O, S>(plan, &[ring_value::<O, S>], None, ask)
}

fn without_batch(report: Result<Report, GpuError>) -> Report {
    report.unwrap_or_else(|_| unreachable!("only a batch can fail"))
}

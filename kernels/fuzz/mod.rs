//! Tests on very many random inputs: the properties that rows declare for all finite valid inputs.
//!
//! Every input: value and derivatives are [finite](crate::kernels::op::Finite), and the value is in its
//! [range](crate::kernels::op::Range). Pairs: identical shapes and shapes apart score [as
//! declared](crate::kernels::op::Extremes), and a symmetric value changes by a few roundings of the longest aspect when
//! shapes are exchanged. Rows that are always finite: derivatives are finite for upstream derivatives of any size. Some
//! inputs: all levels of instructions, forms of a batch, positions and the scalar code give equal bits, and duals are
//! finite with equal values.
//!
//! Numbers are random bits, moderate numbers, or numbers near the limits of the format. Others are a few values, so
//! that shapes share coordinates, multiples of 45 degrees, and neighbours of these. The distribution is chosen per
//! list, per field, or per number, so that a shape may mix them. Rows with [limits](crate::kernels::op::Limits) receive
//! numbers within them.
//!
//! ```
//! use geograd::Obb2;
//! use geograd::kernels::{Iou, RowOf, fuzz};
//! let fuzzed = fuzz::operation::<RowOf<Iou, (Obb2<f64>, Obb2<f64>)>, f32>(100_000, 1);
//! assert_eq!(fuzzed.broken, None, "{fuzzed}");
//! ```
//!
//! An operation of any sort becomes a job on plain numbers, so that drawing, testing and shrinking are compiled once.
mod arguments;
mod couples;
mod families;
pub mod identities;
mod inputs;
mod job;
mod properties;
mod property;
mod rules;
mod smaller;
pub mod tested;

#[doc(hidden)]
pub use job::Job;
pub(crate) use job::{LineSource, all_numbers, sampled, shown};
pub use property::Property;

use crate::Real;
use crate::ad::sample::{Draw, Sample};
use crate::kernels::call::search::HintedSearch;
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::Item;
use crate::kernels::row::op::Op;
use crate::scalar::real::in_format;
use arguments::InputColumns;
use properties::TestSelection;
use property::Finding;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The number of inputs of one batch, few enough for one thread.
const CHUNK: usize = 2048;

/// An input that breaks a property, made as simple as possible.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// The broken property.
    pub property: Property,
    /// The numbers of the input, one shape after another.
    pub input: Vec<f64>,
    /// Upstream derivatives, one for every number of the result.
    pub upstream: Vec<f64>,
    /// The operation and the input as code.
    pub code: String,
}

/// The result of fuzzing an operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Fuzzed {
    /// The operation.
    pub op: &'static str,
    /// `f32` or `f64`.
    pub format: &'static str,
    /// The number of inputs.
    pub inputs: u64,
    /// The number of rejected draws outside the domain.
    pub outside: u64,
    /// The duration.
    pub time: Duration,
    /// The first broken property, if any.
    pub broken: Option<Broken>,
}

impl fmt::Display for Fuzzed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rate = self.inputs as f64 / self.time.as_secs_f64() / 1e6;
        let Fuzzed {
            op, format, inputs, ..
        } = self;
        write!(
            f,
            "{op:34} {format}  {inputs:>13} inputs, {rate:6.2} million a second: "
        )?;
        let outside = |f: &mut fmt::Formatter<'_>| match self.outside {
            0 => Ok(()),
            n => write!(f, ", {n} draws outside the domain"),
        };
        let Some(broken) = &self.broken else {
            f.write_str("ok")?;
            return outside(f);
        };
        write!(f, "{}", broken.property)?;
        outside(f)?;
        write!(f, "\n    {}", broken.code)?;
        match broken.upstream.iter().all(|&x| x == 1.0) {
            true => Ok(()),
            false => write!(f, "\n    upstream {:?}", broken.upstream),
        }
    }
}

/// A fuzzer of a format.
type Fuzzer<T> = fn(&Job<T>, u64, u64) -> Fuzzed;
static F32: Fuzzer<f32> = run;
static F64: Fuzzer<f64> = run;

/// Returns the fuzzer of a format, which this library compiles with optimisation.
pub(crate) fn fuzzed_in<T: Real>() -> Fuzzer<T> {
    *in_format::<Fuzzer<T>>([&F32, &F64])
}

/// Fuzzes an operation of fixed size on all cores; stops at the first broken property.
#[must_use]
pub fn operation<O: Op, T: Real>(count: u64, seed: u64) -> Fuzzed
where
    O::In<T>: Item<Scalar = T>,
    O::Out<T>: Item<Scalar = T>,
    O::In<f64>: Sample + Item<Scalar = f64>,
{
    fuzzed_in::<T>()(&Job::of_op::<O>(), count, seed)
}

/// Fuzzes an operation with a search.
#[must_use]
pub fn decided<D: HintedSearch, T: Real>(count: u64, seed: u64) -> Fuzzed
where
    D::In<T>: Item<Scalar = T>,
    D::Out<T>: Item<Scalar = T>,
    D::In<f64>: Sample + Item<Scalar = f64>,
{
    fuzzed_in::<T>()(&Job::of_search::<D>(), count, seed)
}

/// Fuzzes a fold over paths.
#[must_use]
pub fn fold<F: Fold, T: Real>(count: u64, seed: u64) -> Fuzzed
where
    F::Context<T>: Item<Scalar = T>,
    F::Context<f64>: Sample + Item<Scalar = f64>,
    F::Element<f64>: Sample,
    Vec<F::Element<f64>>: Sample,
{
    fuzzed_in::<T>()(&Job::of_fold::<F>(), count, seed)
}

/// Returns the name of a format.
pub(crate) fn format<T: Real>() -> &'static str {
    match families::is_wide::<T>() {
        true => "f64",
        false => "f32",
    }
}

/// A costly operation takes one of so many inputs.
const COSTLY: u64 = 256;

/// Runs chunks of inputs on all cores until `count` inputs are tested, a share of them for a costly operation, or one
/// breaks a property. Every thread has its own lists.
pub(crate) fn run<T: Real>(job: &Job<T>, count: u64, seed: u64) -> Fuzzed {
    let start = Instant::now();
    let count = match job.declared.costly {
        true => count.div_ceil(COSTLY),
        false => count,
    };
    let [next, done, outside] = [0; 3].map(AtomicU64::new);
    let broken: Mutex<Option<(u64, Broken)>> = Mutex::new(None);
    let per_chunk = (CHUNK as u64).min(count.max(1));
    let chunks = count.div_ceil(per_chunk);
    let work = || {
        let mut inputs = InputColumns::default();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= chunks {
                return;
            }
            // The seed of a chunk depends on its number alone, not on the thread.
            let mut draw = Draw::new(Draw::new(seed).bits() ^ i << 20);
            let inhabited = job.draw(&mut draw, &mut inputs, per_chunk as usize);
            let bars = job.cotangents(&mut draw, inputs.count);
            let outcome =
                inhabited.and_then(|()| job.judge(&inputs, &bars, TestSelection::some(&mut draw)));
            outside.fetch_add(inputs.outside, Ordering::Relaxed);
            done.fetch_add(per_chunk, Ordering::Relaxed);
            if let Err(Finding { property, at }) = outcome {
                let mut first = broken.lock().unwrap_or_else(PoisonError::into_inner);
                if first.as_ref().is_none_or(|(at, _)| i < *at) {
                    let bars = bars.iter().zip(&job.outputs);
                    let bars = bars.flat_map(|(list, &n)| list[at * n..][..n].to_vec());
                    let found =
                        smaller::shrunk(job, inputs.item(job, at), bars.collect(), property);
                    *first = Some((i, found));
                }
                next.store(chunks, Ordering::Relaxed);
            }
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 1..cores {
            scope.spawn(work);
        }
        work();
    });
    let broken = broken.into_inner().unwrap_or_else(PoisonError::into_inner);
    Fuzzed {
        op: job.declared.name,
        format: format::<T>(),
        inputs: done.into_inner(),
        outside: outside.into_inner(),
        time: start.elapsed(),
        broken: broken.map(|(_, broken)| broken),
    }
}

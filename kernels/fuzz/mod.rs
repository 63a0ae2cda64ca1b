//! Operations on very many inputs that nobody would think of: what is promised of all finite valid
//! input, at tens of millions of inputs a second.
//!
//! Of every input: value and slopes are finite, and the value is in its range. Of pairs: identical
//! shapes share all they have, or nothing where they count as empty, with slopes of zero; and what
//! stays when shapes are exchanged stays to a few roundings of the longest aspect. Slopes stay finite
//! for upstream slopes of any size. Of some inputs: the scalar code and other positions in a batch
//! give the same bits.
//!
//! ```
//! use geograd::kernels::{IouObb2, fuzz};
//! let fuzzed = fuzz::pairs::<IouObb2, _, f32>(100_000, 1);
//! assert_eq!(fuzzed.broken, None, "{fuzzed}");
//! ```
mod draw;
mod pairs;
mod rings;

pub use draw::Drawn;
pub use pairs::pairs;
pub use rings::rings;

use crate::ad::check::sample::Draw;
use crate::kernels::real::Real;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Of so many inputs one is computed again by the scalar code.
const SINGLE: usize = 61;

/// How an operation broke what is promised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Promise {
    /// A valid input was refused.
    Accepted,
    /// A value or a slope is infinite or not a number.
    Finite,
    /// A ratio is in `[0, 1]`, an area or a length is not negative.
    Range,
    /// Identical shapes score 1 (or 0 where they count as empty) with slopes of zero.
    Identical,
    /// Exchanging the shapes changes nothing.
    Symmetric,
    /// All forms give the same bits.
    SameBits,
}

impl fmt::Display for Promise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Promise::Accepted => "a valid input is refused",
            Promise::Finite => "a number is not finite",
            Promise::Range => "the value is out of range",
            Promise::Identical => "identical shapes do not score as such",
            Promise::Symmetric => "exchanging the shapes changes the value",
            Promise::SameBits => "two forms give different bits",
        })
    }
}

/// The input at which a promise is broken.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// Which promise.
    pub promise: Promise,
    /// The numbers of the input, all shapes in a row.
    pub input: Vec<f64>,
}

/// What was fuzzed, and how it went.
#[derive(Clone, Debug, PartialEq)]
pub struct Fuzzed {
    /// The operation.
    pub op: &'static str,
    /// `f32` or `f64`.
    pub format: &'static str,
    /// How many inputs were drawn.
    pub inputs: u64,
    /// How long it took.
    pub time: Duration,
    /// The first thing that was found, if any.
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
            "{op:24} {format}  {inputs:>13} inputs, {rate:6.1} million a second: "
        )?;
        match &self.broken {
            None => f.write_str("ok"),
            Some(Broken { promise, input }) => write!(f, "{promise}: {input:?}"),
        }
    }
}

type Outcome = Result<(), Broken>;

/// Runs chunks of so many inputs on all cores until there are so many inputs or one breaks a promise. Every thread has
/// lists of its own.
fn run<T: Real, L>(
    op: &'static str,
    (count, seed): (u64, u64),
    per_chunk: usize,
    lists: impl Fn() -> L + Sync,
    chunk: impl Fn(&mut L, &mut Draw) -> Outcome + Sync,
) -> Fuzzed {
    let start = Instant::now();
    let (next, done) = (AtomicU64::new(0), AtomicU64::new(0));
    let broken: Mutex<Option<(u64, Broken)>> = Mutex::new(None);
    let chunks = count.div_ceil(per_chunk as u64);
    let work = || {
        let mut lists = lists();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= chunks {
                return;
            }
            // Every chunk has numbers of its own, whoever draws them.
            let mut draw = Draw::new(Draw::new(seed).bits() ^ i << 20);
            let outcome = chunk(&mut lists, &mut draw);
            done.fetch_add(per_chunk as u64, Ordering::Relaxed);
            if let Err(found) = outcome {
                let mut first = broken.lock().unwrap_or_else(PoisonError::into_inner);
                if first.as_ref().is_none_or(|(at, _)| i < *at) {
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
        op,
        format: if draw::is_wide::<T>() { "f64" } else { "f32" },
        inputs: done.into_inner(),
        time: start.elapsed(),
        broken: broken.map(|(_, broken)| broken),
    }
}

/// Whether two lists have the same bits.
fn same<T: Real>(a: &[T], b: &[T]) -> bool {
    let bits = |x: &T| x.widen().to_bits();
    a.len() == b.len() && a.iter().map(bits).eq(b.iter().map(bits))
}

/// The first place of a number that is not finite.
#[allow(clippy::eq_op)]
fn not_finite<T: Real>(list: &[T]) -> Option<usize> {
    // A number less itself is zero, unless it is infinite or none; sums need no branches.
    let (whole, rest) = list.as_chunks::<16>();
    let mut sums = [T::zero(); 16];
    for numbers in whole {
        for (sum, &x) in sums.iter_mut().zip(numbers) {
            *sum += x - x;
        }
    }
    match sums.iter().chain(rest).all(|x| x.finite()) {
        true => None,
        false => list.iter().position(|x| !x.finite()),
    }
}

/// The first place of which something is true, which it hardly ever is.
fn first_where<T>(list: &[T], ill: impl Fn(&T) -> bool) -> Option<usize> {
    let found = list.iter().fold(false, |any, x| any | ill(x));
    found.then(|| list.iter().position(ill)).flatten()
}

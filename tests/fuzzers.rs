//! Fuzzers of every row of the list, and of the identities between them.
use crate::list::Tested;
use geograd::kernels::fuzz::Fuzzed;
use geograd::kernels::identities::Identity;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// A row, or an identity of it, in one format.
pub struct Fuzzer {
    /// The name of the row's function.
    pub name: &'static str,
    /// True in `f64`.
    pub wide: bool,
    /// Fuzzes it with so many inputs from a seed.
    pub run: Box<dyn Fn(u64, u64) -> Fuzzed + Send + Sync>,
}

/// Fuzzers of rows in both formats.
#[must_use]
pub fn fuzzers(rows: Vec<&'static Tested>) -> Vec<Fuzzer> {
    let of = |row: &'static Tested, wide| Fuzzer {
        name: row.name(),
        wide,
        run: match wide {
            true => Box::new(|count, seed| row.fuzz::<f64>(count, seed)),
            false => Box::new(|count, seed| row.fuzz::<f32>(count, seed)),
        },
    };
    let both = |row| [of(row, true), of(row, false)];
    rows.into_iter().flat_map(both).collect()
}

/// Fuzzers of identities in both formats.
#[must_use]
pub fn of_identities(identities: impl Iterator<Item = Identity>) -> Vec<Fuzzer> {
    let of = |identity: Identity, wide| Fuzzer {
        name: identity.row(),
        wide,
        run: match wide {
            true => Box::new(move |count, seed| identity.fuzz::<f64>(count, seed)),
            false => Box::new(move |count, seed| identity.fuzz::<f32>(count, seed)),
        },
    };
    let both = |identity: Identity| [of(identity.clone(), true), of(identity, false)];
    identities.flat_map(both).collect()
}

/// How a walk over fuzzers went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Walked {
    /// How many inputs were drawn.
    pub inputs: u64,
    /// In how many seconds.
    pub seconds: f64,
    /// How many fuzzers found something.
    pub broken: usize,
}

impl Walked {
    /// The exit status of a program: 1 where something was found.
    #[must_use]
    pub fn status(self) -> u8 {
        u8::from(self.broken > 0)
    }
}

/// The number of parts of the inputs; the first one times a fuzzer.
const PARTS: u64 = 16;

/// Fewer inputs tell nothing.
const FEW: u64 = 4096;

/// Runs fuzzers on so many inputs, shared so that all of them take about the same time; says what each of them has
/// found. The same seed draws the same inputs, as far as a fuzzer comes.
pub fn walk(
    fuzzers: &[Fuzzer],
    count: u64,
    seed: u64,
    mut say: impl FnMut(&Fuzzed) + Send,
) -> Walked {
    let all = fuzzers.len().max(1) as u64;
    let each = count.div_ceil(all);
    let (first, is_timed) = match each / PARTS {
        probe @ FEW.. => (probe, true),
        _ => (each, false),
    };
    let mut walked = Walked::default();
    let mut done = |fuzzed: &Fuzzed| {
        walked.inputs += fuzzed.inputs;
        walked.seconds += fuzzed.time.as_secs_f64();
        walked.broken += usize::from(fuzzed.broken.is_some());
        say(fuzzed);
    };
    let run = |i: usize| (fuzzers[i].run)(first, seed);
    if !is_timed {
        side_by_side(fuzzers.len(), run, |_, fuzzed| done(&fuzzed));
        return walked;
    }
    let mut found: Vec<Option<Fuzzed>> = fuzzers.iter().map(|_| None).collect();
    side_by_side(fuzzers.len(), run, |i, fuzzed| found[i] = Some(fuzzed));
    let found: Vec<Fuzzed> = found.into_iter().flatten().collect();
    let rate = |fuzzed: &Fuzzed| fuzzed.inputs as f64 / fuzzed.time.as_secs_f64();
    let rates: f64 = found.iter().map(rate).sum();
    let rest = count.saturating_sub(first * all) as f64;
    let go_on = |i: usize| {
        let mut fuzzed = found[i].clone();
        if fuzzed.broken.is_none() {
            let more = (rest * rate(&fuzzed) / rates) as u64;
            let again = (fuzzers[i].run)(more, seed.wrapping_add(1));
            fuzzed.inputs += again.inputs;
            fuzzed.time += again.time;
            fuzzed.broken = again.broken;
        }
        fuzzed
    };
    side_by_side(fuzzers.len(), go_on, |_, fuzzed| done(&fuzzed));
    walked
}

/// [`on_threads`], as many as there are processors.
fn side_by_side<R>(
    count: usize,
    job: impl Fn(usize) -> R + Sync,
    done: impl FnMut(usize, R) + Send,
) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    on_threads(threads, count, job, done);
}

/// Runs so many jobs on so many threads, and gives each result to the second function, one after the other.
pub fn on_threads<R>(
    threads: usize,
    count: usize,
    job: impl Fn(usize) -> R + Sync,
    done: impl FnMut(usize, R) + Send,
) {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(done));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    if i >= count {
                        break;
                    }
                    let result = job(i);
                    // A panic in `done` ends the walk, whatever the other threads hold.
                    let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
                    done(i, result);
                }
            });
        }
    });
}

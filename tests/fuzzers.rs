//! Fuzzers of every row of the list.
use crate::list::Tested;
use geograd::kernels::fuzz::Fuzzed;

/// A row in one format.
pub struct Fuzzer {
    /// The name of its function.
    pub name: &'static str,
    /// True in `f64`.
    pub wide: bool,
    /// Fuzzes it with so many inputs from a seed.
    pub run: Box<dyn Fn(u64, u64) -> Fuzzed>,
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
pub fn walk(fuzzers: &[Fuzzer], count: u64, seed: u64, mut say: impl FnMut(&Fuzzed)) -> Walked {
    let all = fuzzers.len().max(1) as u64;
    let each = count.div_ceil(all);
    let (first, is_timed) = match each / PARTS {
        probe @ FEW.. => (probe, true),
        _ => (each, false),
    };
    let mut found: Vec<Fuzzed> = fuzzers
        .iter()
        .map(|fuzzer| (fuzzer.run)(first, seed))
        .collect();
    let rate = |fuzzed: &Fuzzed| fuzzed.inputs as f64 / fuzzed.time.as_secs_f64();
    let rates: f64 = found.iter().map(rate).sum();
    let rest = count.saturating_sub(first * all) as f64;
    let mut walked = Walked::default();
    for (fuzzer, fuzzed) in fuzzers.iter().zip(&mut found) {
        if is_timed && fuzzed.broken.is_none() {
            let more = (rest * rate(fuzzed) / rates) as u64;
            let again = (fuzzer.run)(more, seed.wrapping_add(1));
            fuzzed.inputs += again.inputs;
            fuzzed.time += again.time;
            fuzzed.broken = again.broken;
        }
        walked.inputs += fuzzed.inputs;
        walked.seconds += fuzzed.time.as_secs_f64();
        walked.broken += usize::from(fuzzed.broken.is_some());
        say(fuzzed);
    }
    walked
}

//! Fuzzers of every row of the list, compiled here once for tests and reports.
use geograd::kernels::fuzz::{self, Fuzzed};

/// One operation in one format: its name, whether that is `f64`, and what fuzzes it.
pub type Fuzzer = (&'static str, bool, Fuzz);
pub type Fuzz = fn(u64, u64) -> Fuzzed;

macro_rules! fuzzes {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        vec![
            $(
                (stringify!($pair), true, fuzz::operation::<$pair_op, f64> as Fuzz),
                (stringify!($pair), false, fuzz::operation::<$pair_op, f32>),
            )*
            $(
                (stringify!($ring), true, fuzz::ring::<$ring_op, f64>),
                (stringify!($ring), false, fuzz::ring::<$ring_op, f32>),
            )*
            $(
                (stringify!($straight), true, fuzz::operation::<$straight_op, f64>),
                (stringify!($straight), false, fuzz::operation::<$straight_op, f32>),
            )*
            $(
                (stringify!($fold), true, fuzz::fold::<$fold_op, f64>),
                (stringify!($fold), false, fuzz::fold::<$fold_op, f32>),
            )*
            $(
                (stringify!($decided), true, fuzz::decided::<$decided_op, f64>),
                (stringify!($decided), false, fuzz::decided::<$decided_op, f32>),
            )*
            $(
                (stringify!($more), true, fuzz::operation::<$more_op, f64>),
                (stringify!($more), false, fuzz::operation::<$more_op, f32>),
            )*
            $(
                (stringify!($more_fold), true, fuzz::fold::<$more_fold_op, f64>),
                (stringify!($more_fold), false, fuzz::fold::<$more_fold_op, f32>),
            )*
            $(
                (stringify!($more_search), true, fuzz::decided::<$more_decided_op, f64>),
                (stringify!($more_search), false, fuzz::decided::<$more_decided_op, f32>),
            )*
        ]
    };
}

macro_rules! more_fuzzes {
    ($($name:ident: $op:ty,)*) => {
        [$(
            (stringify!($name), true, fuzz::operation::<$op, f64> as Fuzz),
            (stringify!($name), false, fuzz::operation::<$op, f32>),
        )*]
    };
}

/// Fuzzers of all operations in both formats.
pub fn fuzzers() -> Vec<Fuzzer> {
    let mut all = geograd::for_each_op!(fuzzes);
    all.extend(crate::more_fuzzed!(more_fuzzes));
    all
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

/// Of so many parts of the inputs the first tells how fast a fuzzer is.
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
    let mut found: Vec<Fuzzed> = fuzzers.iter().map(|(_, _, run)| run(first, seed)).collect();
    let rate = |fuzzed: &Fuzzed| fuzzed.inputs as f64 / fuzzed.time.as_secs_f64();
    let rates: f64 = found.iter().map(rate).sum();
    let rest = count.saturating_sub(first * all) as f64;
    let mut walked = Walked::default();
    for ((_, _, run), fuzzed) in fuzzers.iter().zip(&mut found) {
        if is_timed && fuzzed.broken.is_none() {
            let more = (rest * rate(fuzzed) / rates) as u64;
            let again = run(more, seed.wrapping_add(1));
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

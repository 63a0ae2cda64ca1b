//! Shared code of the tests.
use geograd::Obb2;

#[cfg(feature = "gpu")]
pub mod adapter;
pub mod calls;
#[cfg(feature = "list")]
pub mod corpus;
#[cfg(all(feature = "gpu", feature = "list"))]
pub mod forms;
#[cfg(feature = "list")]
pub mod fuzzers;
#[path = "hashes/lines.rs"]
pub mod lines;
#[cfg(feature = "list")]
pub mod list;
#[cfg(all(feature = "gpu", feature = "list"))]
pub mod listed;
pub mod rows;

/// A small reproducible source of numbers.
#[derive(Clone, Debug)]
pub struct Dice(pub u64);

impl Dice {
    /// Sixty-four random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }
    /// A number in `[0, 1)`.
    pub fn roll(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// A number between two.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }
    /// A number below another.
    pub fn below(&mut self, end: usize) -> usize {
        (self.roll() * end as f64) as usize
    }
    /// A box of the distribution of the DGAL paper's benchmark.
    pub fn obb(&mut self) -> Obb2<f64> {
        Obb2::new(
            self.within(-5.0, 5.0),
            self.within(-5.0, 5.0),
            self.within(0.0, 5.0),
            self.within(0.0, 5.0),
            self.within(-5.0, 5.0),
        )
    }
}

/// A number of two texts that is the same on every machine.
fn hash(share: &str, name: &str) -> u64 {
    let bytes = share.bytes().chain([0]).chain(name.bytes());
    let mixed = bytes.fold(0, |hash, byte| Dice(hash ^ u64::from(byte)).bits());
    Dice(mixed).bits()
}

/// Returns a number that the variable `GEOGRAD_SHARE` gives, for tests that take some of many cases.
#[must_use]
pub fn turn() -> u64 {
    hash(&std::env::var("GEOGRAD_SHARE").unwrap_or_default(), "")
}

/// Returns `true` if slow tests take everything: with `GEOGRAD_ALL_ROWS=1`.
fn takes_all() -> bool {
    std::env::var("GEOGRAD_ALL_ROWS").is_ok_and(|x| x == "1")
}

/// Runs with so many threads of rayon.
///
/// # Panics
///
/// If the threads cannot be started.
pub fn with_threads<R: Send>(threads: usize, run: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.unwrap().install(run)
}

/// A slow test runs for one of so many commits.
const TURN: u64 = 6;

/// Returns `true` if a slow test takes its turn: for a sixth of all texts in the variable `GEOGRAD_SHARE`, such as names
/// of commits, and always with `GEOGRAD_ALL_ROWS=1`.
#[must_use]
pub fn is_due(test: &str) -> bool {
    let share = std::env::var("GEOGRAD_SHARE").unwrap_or_default();
    takes_all() || hash(&share, test).is_multiple_of(TURN)
}

//! The choice of vector instructions for batches.
//!
//! The level is chosen at run time: the best that the processor has. All levels give equal bits, so a lower one is for
//! measuring and testing only: [`Simd::limit`], or the environment variable `GEOGRAD_SIMD` with the word `baseline`,
//! `avx2` or `v4`.
//!
//! | level | processors | `f32` at once |
//! | --- | --- | --- |
//! | [`Baseline`](Simd::Baseline) | every one of the target: SSE2, NEON, wasm's 128 bits; plain code | 4 |
//! | [`Avx2`](Simd::Avx2) | x86-64-v3: Intel since Haswell, AMD since Excavator | 8 |
//! | [`V4`](Simd::V4) | x86-64-v4: servers since Skylake, AMD since Zen 4 | 16 |
//!
//! Plain code for other targets than x86-64 has been tested as the baseline there, but not on NEON or
//! wasm.
use crate::Error;
use std::sync::atomic::{AtomicU8, Ordering};

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Simd {
    /// The instructions that every processor of the target has.
    Baseline = 1,
    /// AVX2 and the extensions of x86-64-v3.
    Avx2 = 2,
    /// AVX-512 with F, BW, CD, DQ and VL (x86-64-v4).
    V4 = 3,
}

/// The level in use; zero before the first call, [`REFUSED`] if the environment names an unavailable one.
static LEVEL: AtomicU8 = AtomicU8::new(0);
const REFUSED: u8 = u8::MAX;

/// The environment variable that names a level.
const VARIABLE: &str = "GEOGRAD_SIMD";

impl Simd {
    /// All levels, lowest first.
    const ALL: [Simd; 3] = [Simd::Baseline, Simd::Avx2, Simd::V4];

    /// Returns the levels that this processor has, lowest first.
    #[must_use]
    pub fn available() -> Vec<Simd> {
        let best = best();
        Self::ALL.into_iter().filter(|&x| x <= best).collect()
    }
    /// Returns the level's word: `baseline`, `avx2` or `v4`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Simd::Baseline => "baseline",
            Simd::Avx2 => "avx2",
            Simd::V4 => "v4",
        }
    }
    /// Returns the level that batches use now.
    ///
    /// # Errors
    ///
    /// [`Error::Simd`] when the environment variable `GEOGRAD_SIMD` asks for a level that is unknown or that the
    /// processor lacks. Batches return this error, too.
    pub fn current() -> Result<Simd, Error> {
        match LEVEL.load(Ordering::Relaxed) {
            0 => {
                let asked = match std::env::var(VARIABLE) {
                    Ok(word) => Self::named(&word).filter(|&level| level <= best()),
                    Err(_) => Some(best()),
                };
                LEVEL.store(
                    asked.map_or(REFUSED, |level| level as u8),
                    Ordering::Relaxed,
                );
                asked.ok_or(Error::Simd)
            }
            REFUSED => Err(Error::Simd),
            _ => Ok(Self::in_use()),
        }
    }
    /// Makes all batches of the process use `level` from now on; with `None` the best one.
    ///
    /// # Errors
    ///
    /// [`Error::Simd`] when the processor lacks it; nothing changes then.
    pub fn limit(level: Option<Simd>) -> Result<(), Error> {
        let level = level.unwrap_or_else(best);
        if level > best() {
            return Err(Error::Simd);
        }
        LEVEL.store(level as u8, Ordering::Relaxed);
        Ok(())
    }

    fn named(word: &str) -> Option<Simd> {
        Self::ALL.into_iter().find(|level| level.name() == word)
    }
    /// Returns the level of kernels, which the processor has in any case.
    #[inline]
    pub(crate) fn in_use() -> Simd {
        match LEVEL.load(Ordering::Relaxed) {
            2 => Simd::Avx2,
            3 => Simd::V4,
            _ => Simd::Baseline,
        }
    }
}

/// Returns the best level that the processor has.
fn best() -> Simd {
    #[cfg(all(target_arch = "x86_64", not(geograd_portable)))]
    {
        macro_rules! has {
            ($($feature:tt)*) => { $(std::arch::is_x86_feature_detected!($feature) &&)* true };
        }
        // The features that the entries in `arch` are compiled for.
        if has!("avx2" "fma" "bmi1" "bmi2" "lzcnt" "popcnt") {
            if has!("avx512f" "avx512bw" "avx512cd" "avx512dq" "avx512vl") {
                return Simd::V4;
            }
            return Simd::Avx2;
        }
    }
    Simd::Baseline
}

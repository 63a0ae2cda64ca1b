//! Which vector instructions the batches use.
//!
//! Chosen at run time: the best the processor has. Results are the same bits at every level; a
//! lower one is for measuring and testing.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::Level;
use std::sync::atomic::{AtomicU8, Ordering};

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Simd {
    /// What every processor of the target has.
    Baseline,
    /// AVX2 with FMA (x86-64-v3).
    Avx2,
    /// AVX-512 as of Ice Lake.
    Avx512,
}

/// 0: the best there is; otherwise one more than the level asked for.
static LIMIT: AtomicU8 = AtomicU8::new(0);

impl Simd {
    /// The levels this processor has, lowest first.
    #[must_use]
    pub fn available() -> Vec<Simd> {
        let all = [Simd::Baseline, Simd::Avx2, Simd::Avx512];
        all.into_iter().filter(|&level| level <= best()).collect()
    }
    /// The level batches use now.
    #[must_use]
    pub fn current() -> Simd {
        match LIMIT.load(Ordering::Relaxed) {
            1 => Simd::Baseline,
            2 => best().min(Simd::Avx2),
            _ => best(),
        }
    }
    /// Makes all batches of the process use no more than this level from now on; `None` for the
    /// best there is.
    pub fn limit(level: Option<Simd>) {
        let code = level.map_or(0, |level| level as u8 + 1);
        LIMIT.store(code, Ordering::Relaxed);
    }
}

/// The best level there is.
fn best() -> Simd {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        let level = Level::new();
        if level.as_avx512().is_some() {
            return Simd::Avx512;
        }
        if level.as_avx2().is_some() {
            return Simd::Avx2;
        }
    }
    Simd::Baseline
}

/// Runs a call with the vector instructions of the current level; the callee must be
/// `#[inline(always)]`, all the way down.
///
/// Three copies of a kernel are enough; `fearless_simd::dispatch!` would compile five.
macro_rules! vectorized {
    ($call:expr) => {{
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            use crate::kernels::simd::Simd;
            use fearless_simd::{Level, Simd as _};
            let level = Level::new();
            match (Simd::current(), level.as_avx512(), level.as_avx2()) {
                (Simd::Avx512, Some(token), _) => token.vectorize(
                    #[inline(always)]
                    || $call,
                ),
                (Simd::Avx2, _, Some(token)) => token.vectorize(
                    #[inline(always)]
                    || $call,
                ),
                _ => $call,
            }
        }
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        {
            $call
        }
    }};
}
pub(crate) use vectorized;

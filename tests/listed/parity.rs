//! Parity: results of a GPU beside those of the processor, within a bound.
use super::ready::Ready;
use geograd::Error;

/// Results differ where they do by more than this, of themselves and of one.
pub const NEAR: f32 = 1e-3;
/// So many in a thousand may that the processor does not give for inputs a few last digits away, either: of paths,
/// which are not asked about, and where ties meet. Sides of boxes turned by the same angle tie, and their corners,
/// too: one of the two ties broken by rounding gives derivatives that no input nearby has.
pub const FEW: usize = 5;

/// Results of a GPU beside those of the processor.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compared {
    pub results: usize,
    /// So many differ.
    pub apart: usize,
    /// By so much at most.
    pub worst: f32,
    /// So many of them are not what the processor says of inputs a few last digits away, either.
    pub wrong: usize,
}

impl Compared {
    /// `true` if no more results differ than may.
    pub const fn is_within(&self) -> bool {
        1000 * self.wrong <= FEW * self.results
    }
}

/// Compares results of a GPU with those of the processor.
///
/// # Errors
///
/// The errors of computing them.
///
/// # Panics
///
/// For another number of results.
pub fn compare(on_cpu: &dyn Ready, found: &[Vec<f32>]) -> Result<Compared, Error> {
    let mut told = Compared::default();
    for (list, (found, expected)) in found.iter().zip(&on_cpu.numbers()?).enumerate() {
        assert_eq!(found.len(), expected.len());
        for (at, (&x, &y)) in found.iter().zip(expected).enumerate() {
            let off = (x - y).abs() / (1.0 + y.abs());
            told.results += 1;
            // NaN counts as infinitely far off.
            told.worst = told
                .worst
                .max(if off.is_nan() { f32::INFINITY } else { off });
            if off <= NEAR {
                continue;
            }
            told.apart += 1;
            let ways = on_cpu.beside(list, at)?.unwrap_or_default();
            let least = ways.iter().fold(y, |least, way| least.min(*way));
            let most = ways.iter().fold(y, |most, way| most.max(*way));
            let slack = NEAR * (1.0 + y.abs());
            told.wrong += usize::from(!(least - slack..=most + slack).contains(&x));
        }
    }
    Ok(told)
}

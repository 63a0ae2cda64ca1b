//! Polynomials and rounding, for elementary functions of numbers and lanes alike.
use crate::Scalar;

/// Adding and taking away 1.5 · 2⁵² rounds an `f64` to the nearest integer.
pub(crate) const SHIFT: f64 = 6_755_399_441_055_744.0;

/// Returns a polynomial, the constant first.
#[inline(always)]
pub(crate) fn polynomial<W: Scalar, const N: usize>(coefficients: [f64; N], z: W) -> W {
    let mut sum = W::lit(coefficients[N - 1]);
    let mut i = N - 1;
    while i > 0 {
        i -= 1;
        sum = sum * z + W::lit(coefficients[i]);
    }
    sum
}

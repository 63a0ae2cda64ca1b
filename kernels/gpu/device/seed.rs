//! The factors of derivatives of all pairs, and sums as they come back.
use super::matrix::Matrix;

/// The factors of derivatives.
pub(crate) enum Seed<'a> {
    /// A number for every pair, row by row.
    Numbers(&'a [f32]),
    /// The same, already on the GPU, for as many rows and columns.
    Matrix(&'a Matrix),
    /// One number for all.
    Factor(f32),
}

/// Returns the sum of partial sums that were brought back.
pub(super) fn sum_of(numbers: &[u32]) -> f64 {
    let wide = |&n: &u32| f64::from(f32::from_bits(n));
    numbers.iter().map(wide).sum()
}

//! The factors of derivatives of all pairs, and downloaded sums.
use super::matrix::DeviceMatrix;

/// The factors of derivatives of all pairs.
pub(crate) enum PairSeed<'a> {
    /// A number for every pair, in row-major order.
    Numbers(&'a [f32]),
    /// A number for every pair, in a matrix on the GPU.
    Matrix(&'a DeviceMatrix),
    /// One number for all pairs.
    Factor(f32),
}

/// Returns the sum of downloaded partial sums.
pub(super) fn sum_of(numbers: &[u32]) -> f64 {
    let wide = |&n: &u32| f64::from(f32::from_bits(n));
    numbers.iter().map(wide).sum()
}

//! Decisions of searches as comparisons.
use super::Scalar;

/// Compares constants by numbers of some bits, so that traces of comparisons differ where records do. For plain numbers
/// this is nothing.
#[inline(always)]
pub(crate) fn noted<P: Scalar>(bits: u32, numbers: impl IntoIterator<Item = u32>) {
    for number in numbers {
        for k in 0..bits {
            let side = P::lit(if number >> k & 1 == 1 { 1.0 } else { -1.0 });
            let _ = side.below(-side);
        }
    }
}

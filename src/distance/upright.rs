//! Signed distances of axis-aligned boxes, axis by axis.
use crate::{Aabb2, Scalar};

/// The signed distance of two axis-aligned boxes, in the unit of length: the shortest way between them, or minus
/// the length of the shortest shift after which they only touch.
///
/// The same as [`signed_distance`](super::signed_distance) of both, by the two gaps between their bounds alone: it
/// has no kink beside those of the distance itself, however flat the boxes are. Kinks: where bounds tie, or
/// the gaps of boxes that overlap, which share the slope half and half; boxes that touch with a corner.
///
/// ```
/// use geograd::{Aabb2, distance::upright::signed_distance_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 4.0, 4.0);
/// assert_eq!(signed_distance_aabb2(a, Aabb2::new(7.0, 8.0, 9.0, 9.0)), 5.0);
/// assert_eq!(signed_distance_aabb2(a, Aabb2::new(3.0, 1.0, 9.0, 9.0)), -1.0);
/// ```
#[must_use]
#[inline]
pub fn signed_distance_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    let zero = S::zero();
    let (x, y) = (
        (b.min.x - a.max.x).most(a.min.x - b.max.x),
        (b.min.y - a.max.y).most(a.min.y - b.max.y),
    );
    let positive = |gap: S| S::select(gap.above(zero), gap, zero);
    let apart = x.above(zero) | y.above(zero);
    S::select(apart, positive(x).hypot(positive(y)), x.most(y))
        .saturated()
        .canonical()
}

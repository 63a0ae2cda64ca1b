//! Generalised intersection over union of rotated boxes by their hull.
use super::hull::{hull_of_related, hull_scale};
use crate::clip::area_from_half;
use crate::clip::{Framed, clip, clipped_area, frame, relate, related_area};
use crate::overlap::ratio_of_union;
use crate::scalar::guarded;
use crate::{Mask, Obb2, Scalar};

/// Returns `I/U − (C − U)/C` from areas; a hull that rounding left smaller than the union counts as large.
#[inline(always)]
pub(crate) fn score<S: Scalar>(inter: S, area_a: S, area_b: S, hull: S) -> S {
    let union = area_a + area_b - inter;
    let short = hull.below(union);
    let hull = S::select(short, hull.with_primal(union.primal()), hull);
    ratio_of_union(inter, area_a, area_b) - outside_share(hull - union, hull)
}

/// Returns `rest / all`, zero with derivative zero where `all` is next to nothing.
#[inline(always)]
pub(super) fn outside_share<S: Scalar>(rest: S, all: S) -> S {
    let empty = all.at_most(S::lit(S::format().empty()));
    S::select(empty, S::zero(), rest.over(S::select(empty, S::one(), all)))
}

/// Returns the generalised IoU of two rotated boxes whose sine and cosine are known. `EXTREME` says that sizes may be
/// so small or large that products over- or underflow.
#[inline(always)]
pub(crate) fn giou_framed<S: Scalar, const EXTREME: bool>(a: Framed<S>, b: Framed<S>) -> S {
    let scale = if EXTREME {
        hull_scale(&a, &b)
    } else {
        S::one()
    };
    let pair = relate::<S, EXTREME>(a, b, scale);
    let inter = if pair.apart.all() {
        S::zero()
    } else {
        related_area(&pair, clipped_area(&clip(pair)))
    };
    let (area_a, area_b) = (area_from_half(pair.half_a), area_from_half(pair.half_b));
    let hull = hull_of_related(&pair).area();
    score(inter, area_a, area_b, hull).canonical()
}

/// Returns the generalised IoU of two rotated boxes with the exact convex hull, in `[−1, 1]`: IoU less the share of the
/// hull that neither box has. A straight line. Conventions: see the [module](super).
///
/// ```
/// use geograd::{Obb2, iou::giou_obb2};
/// let a = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.3);
/// assert_eq!(giou_obb2(a, a), 1.0);
/// let near = giou_obb2(a, Obb2::new(4.0, 0.0, 2.0, 2.0, 0.1));
/// let far = giou_obb2(a, Obb2::new(5.0, 0.0, 2.0, 2.0, 0.1));
/// assert!(far < near && near < 0.0);
/// ```
#[must_use]
#[inline]
pub fn giou_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    giou_framed::<S, true>(frame(a), frame(b))
}

impl<S: Scalar> Obb2<S> {
    /// Returns [`giou_obb2`].
    #[must_use]
    #[inline]
    pub fn giou(self, other: Self) -> S {
        guarded((self, other), |(a, b)| giou_obb2(a, b))
    }
}

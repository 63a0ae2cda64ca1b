//! Generalised intersection over union of boxes.
use super::hull::{hull_of_bounds, hull_of_related, hull_scale, joint_scale};
use crate::clip::{Framed, clip, clipped_area, frame, relate, related_area};
use crate::overlap::{area_from_half, iou_aabb2, ratio_of_union};
use crate::{Aabb2, Mask, Obb2, Scalar, Vec2};

/// `I/U − (C − U)/C` from areas; a hull that rounding left smaller than the union counts as large.
#[inline(always)]
pub(crate) fn score<S: Scalar>(inter: S, area_a: S, area_b: S, hull: S) -> S {
    let union = area_a + area_b - inter;
    let short = hull.below(union);
    let hull = S::select(short, hull.with_primal(union.primal()), hull);
    ratio_of_union(inter, area_a, area_b) - outside_share(hull - union, hull)
}

/// `rest / all`, zero with slope zero where there is next to nothing.
#[inline(always)]
fn outside_share<S: Scalar>(rest: S, all: S) -> S {
    let empty = all.at_most(S::lit(S::EMPTY));
    S::select(empty, S::zero(), rest.over(S::select(empty, S::one(), all)))
}

/// Generalised IoU of two rotated boxes with their trigonometry done. `EXTREME` says whether sizes may be
/// so small or large that products over- or underflow.
#[inline(always)]
pub fn giou_framed<S: Scalar, const EXTREME: bool>(a: Framed<S>, b: Framed<S>) -> S {
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

/// Generalised IoU of two rotated boxes with the exact convex hull, in `(−1, 1]`: IoU less the share of
/// the hull that neither box has. Straight line. Conventions: see the [module](super).
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

/// Generalised IoU of two axis-aligned boxes with the exact convex hull, in `(−1, 1]`. See the
/// [module](super); elsewhere GIoU of such boxes is often [`giou_box_aabb2`].
///
/// ```
/// use geograd::{Aabb2, iou::{giou_aabb2, giou_box_aabb2}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 1.0, 1.0), Aabb2::new(1.0, 1.0, 2.0, 2.0));
/// assert!((giou_aabb2(a, b) + 1.0_f64 / 3.0).abs() < 1e-15);
/// assert_eq!(giou_box_aabb2(a, b), -0.5);
/// ```
#[must_use]
#[inline]
pub fn giou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    bounds_score(a, b, true)
}

/// Generalised IoU of two axis-aligned boxes with the smallest box around both in place of the hull, in
/// `(−1, 1]`: Rezatofighi et al., CVPR 2019. See the [module](super).
#[must_use]
#[inline]
pub fn giou_box_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    bounds_score(a, b, false)
}

#[inline(always)]
fn bounds_score<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, exact: bool) -> S {
    let scale = joint_scale(a, b);
    let (half, cuts) = hull_of_bounds(a, b, scale);
    let own = |x: Aabb2<S>| {
        let half = |low: S, high: S| (high.halved() - low.halved()) * scale;
        area_from_half(Vec2::new(half(x.min.x, x.max.x), half(x.min.y, x.max.y)))
    };
    let (area_a, area_b) = (own(a), own(b));
    let iou = iou_aabb2(a, b);
    let union = (area_a + area_b).over(S::one() + iou);
    let mut hull = area_from_half(half);
    if exact {
        hull -= cuts + cuts;
    }
    let short = hull.below(union);
    let hull = S::select(short, hull.with_primal(union.primal()), hull);
    (iou - outside_share(hull - union, hull)).canonical()
}

impl<S: Scalar> Obb2<S> {
    /// Generalised IoU with the exact convex hull, in `(−1, 1]`; boxes that are apart have slopes.
    #[must_use]
    #[inline]
    pub fn giou(self, other: Self) -> S {
        giou_obb2(self, other)
    }
}
impl<S: Scalar> Aabb2<S> {
    /// Generalised IoU with the exact convex hull, in `(−1, 1]`; boxes that are apart have slopes.
    #[must_use]
    #[inline]
    pub fn giou(self, other: Self) -> S {
        giou_aabb2(self, other)
    }
}

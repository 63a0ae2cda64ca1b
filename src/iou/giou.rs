//! Generalised intersection over union of boxes.
use super::hull::{hull_of_bounds, hull_of_related, hull_scale, joint_scale};
use crate::clip::{Framed, clip, clipped_area, frame, relate, related_area};
use crate::overlap::{area_from_half, iou_aabb2, ratio_of_union};
use crate::{Aabb2, Mask, Obb2, Scalar};

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

/// How the extent of two intervals is divided: what only the first covers, only the second, both, and
/// neither. Lengths of no sign, in one unit.
struct Parts<S> {
    a: S,
    b: S,
    both: S,
    neither: S,
}

impl<S: Scalar> Parts<S> {
    /// Of the intervals of an axis; `half` measures from one bound to another.
    #[inline(always)]
    fn of(a: [S; 2], b: [S; 2], half: impl Fn(S, S) -> S) -> Self {
        let zero = S::zero();
        // Before the other one begins, and after it has ended.
        let (low, high) = (half(a[0], b[0]), half(b[1], a[1]));
        let shared = half(a[0].most(b[0]), a[1].least(b[1]));
        // Touching counts as apart, with its slopes, as in the area of intersection.
        let apart = shared.at_most(zero);
        let own = |size: S, x: S, y: S| S::select(apart, size, x.most(zero) + y.most(zero));
        Parts {
            a: own(half(a[0], a[1]), low, high),
            b: own(half(b[0], b[1]), -low, -high),
            both: S::select(apart, zero, shared),
            neither: S::select(apart, -shared, zero),
        }
    }
    #[inline(always)]
    fn whole(&self) -> S {
        (self.a + self.b) + (self.both + self.neither)
    }
}

#[inline(always)]
fn bounds_score<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, exact: bool) -> S {
    let scale = joint_scale(a, b);
    let half = |low: S, high: S| (high.halved() - low.halved()) * scale;
    let x = Parts::of([a.min.x, a.max.x], [b.min.x, b.max.x], half);
    let y = Parts::of([a.min.y, a.max.y], [b.min.y, b.max.y], half);
    // What neither box covers is summed up from what it is made of: the difference of the areas of the
    // box around both and of the union would lose its digits where one box all but covers the other.
    let mut rest = (x.a * (y.b + y.neither) + x.b * (y.a + y.neither))
        + (x.both * y.neither + x.neither * y.whole());
    if exact {
        rest -= hull_of_bounds(a, b, scale).1.halved();
        // Rounding must not leave less than nothing.
        let short = rest.below(S::zero());
        rest = S::select(short, rest.with_primal(S::Primal::zero()), rest);
    }
    // Each of them is shared or one's own; both boxes' areas less what is counted twice.
    let (wide_a, wide_b) = (x.a + x.both, x.b + x.both);
    let union = wide_a * (y.a + y.both) + (wide_b * y.b + x.b * y.both);
    (iou_aabb2(a, b) - outside_share(rest, union + rest)).canonical()
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

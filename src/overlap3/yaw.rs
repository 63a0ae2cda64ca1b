//! Overlap of upright boxes.
use crate::Scalar;
use crate::clip::frame;
use crate::overlap::{
    Denominator, area_from_half, iou_obb2, ratio_of_first, ratio_of_union, shared_area,
};
use crate::shape::YawBox3;

/// Heights of two upright boxes, in units of `1 / scale`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heights<S> {
    /// The height that both share.
    pub shared: S,
    /// The height of a.
    pub a: S,
    /// The height of b.
    pub b: S,
    /// The power of two by which heights were multiplied.
    pub scale: S,
}

/// Heights of two upright boxes, each given by where its middle is and half its height.
///
/// `EXTREME` says whether they may be so small or large that products over- or underflow.
#[inline(always)]
pub(crate) fn heights<S: Scalar, const EXTREME: bool>(
    [at_a, half_a]: [S; 2],
    [at_b, half_b]: [S; 2],
) -> Heights<S> {
    let zero = S::zero();
    // Relative to a's centre, so that far from the origin no digits are lost.
    let up = at_b - at_a;
    let shared = half_a.least(up + half_b) - (-half_a).most(up - half_b);
    let shared = S::select(shared.at_most(zero), zero, shared);
    let mut scale = S::one();
    if EXTREME {
        // The higher one becomes about one, so that no product overflows.
        let higher = half_a.most(half_b);
        let flat = higher.at_most(zero);
        scale = S::select(flat, S::one(), S::select(flat, S::one(), higher).binade());
    }
    Heights {
        shared: shared * scale,
        a: (half_a + half_a) * scale,
        b: (half_b + half_b) * scale,
        scale,
    }
}

/// A score of upright boxes from areas seen from above (shared, of a, of b; in units of `1 / scale²`) and
/// heights.
#[inline(always)]
pub(crate) fn score_of_columns<S: Scalar, const EXTREME: bool>(
    over: Denominator,
    [area, area_a, area_b]: [S; 3],
    scale: S,
    height: &Heights<S>,
) -> S {
    let shared = area * height.shared;
    match over {
        Denominator::None if EXTREME => {
            let value = shared.over(scale).over(height.scale).over(scale);
            value.saturated()
        }
        Denominator::None => shared,
        Denominator::Union => ratio_of_union(shared, area_a * height.a, area_b * height.b),
        // Each ratio alone: a small box in a large one has no volume in the large one's unit.
        Denominator::First => {
            ratio_of_first(area, area_a) * ratio_of_first(height.shared, height.a)
        }
    }
}

/// A score of two upright boxes.
pub(crate) fn score_yaw<S: Scalar>(over: Denominator, a: YawBox3<S>, b: YawBox3<S>) -> S {
    let (pair, area, scale) = shared_area::<S, true>(frame(a.birds_eye()), frame(b.birds_eye()));
    let height = heights::<S, true>(
        [a.center.z, a.size.z.halved()],
        [b.center.z, b.size.z.halved()],
    );
    let (area_a, area_b) = (area_from_half(pair.half_a), area_from_half(pair.half_b));
    let mut value = score_of_columns::<S, true>(over, [area, area_a, area_b], scale, &height);
    if over == Denominator::Union {
        let birds_same = (a.center.x.equals(b.center.x) & a.center.y.equals(b.center.y))
            & (a.size.x.equals(b.size.x) & a.size.y.equals(b.size.y) & a.heading.equals(b.heading));
        let same = birds_same & (a.center.z.equals(b.center.z) & a.size.z.equals(b.size.z));
        value = S::select(same, S::from_primal(value.primal()), value);
    }
    value.canonical()
}

/// The volume shared by two upright boxes, from 0 to the volume of the smaller one, in cubed units of
/// length. Saturates at the largest finite number.
///
/// The area shared seen from above times the height shared. Kinks and conventions: see the
/// [module](super).
#[must_use]
#[inline]
pub fn intersection_volume_yaw<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> S {
    score_yaw(Denominator::None, a, b)
}

/// Intersection over union of two upright boxes, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](super).
///
/// ```
/// use geograd::{Vec3, overlap3::iou_yaw, shape::YawBox3};
/// let car = YawBox3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(4.0, 2.0, 2.0), 0.3_f64);
/// let seen = YawBox3 { center: Vec3::new(0.0, 0.0, 1.0), ..car };
/// assert_eq!(iou_yaw(car, car), 1.0);
/// assert!((iou_yaw(car, seen) - 1.0 / 3.0).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn iou_yaw<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> S {
    score_yaw(Denominator::Union, a, b)
}

/// The share of the first upright box that lies in the second, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](super).
#[must_use]
#[inline]
pub fn iof_yaw<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> S {
    score_yaw(Denominator::First, a, b)
}

/// Intersection over union of two upright boxes seen from above, in `[0, 1]`: their heights do not count.
#[must_use]
#[inline]
pub fn iou_birds_eye<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> S {
    iou_obb2(a.birds_eye(), b.birds_eye())
}

impl<S: Scalar> YawBox3<S> {
    /// Intersection over union with another box, in `[0, 1]`.
    #[must_use]
    #[inline]
    pub fn iou(self, other: Self) -> S {
        iou_yaw(self, other)
    }
}

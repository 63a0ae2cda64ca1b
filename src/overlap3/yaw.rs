//! Overlap of upright boxes.
use crate::Scalar;
use crate::clip::frame;
use crate::overlap::{
    Denominator, area_from_half, iou_obb2, ratio_of_first, ratio_of_union, shared_area,
};
use crate::shape::YawBox3;

/// What two upright boxes share: areas seen from above in units of `1 / scale²`, and heights in units of
/// `1 / height_scale`.
struct Columns<S: Scalar> {
    area: S,
    area_a: S,
    area_b: S,
    scale: S,
    height: S,
    height_a: S,
    height_b: S,
    height_scale: S,
    same: S::Mask,
}

#[inline(always)]
fn columns<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> Columns<S> {
    let zero = S::zero();
    let (pair, area, scale) = shared_area::<S, true>(frame(a.birds_eye()), frame(b.birds_eye()));
    let (half_a, half_b) = (a.size.z.halved(), b.size.z.halved());
    // Relative to a's centre, so that far from the origin no digits are lost.
    let up = b.center.z - a.center.z;
    let shared = half_a.least(up + half_b) - (-half_a).most(up - half_b);
    let apart = shared.at_most(zero);
    let shared = S::select(apart, zero, shared);
    // The higher one becomes about one, so that no product overflows.
    let higher = half_a.most(half_b);
    let flat = higher.at_most(zero);
    let height_scale = S::select(flat, S::one(), S::select(flat, S::one(), higher).binade());
    let birds_same = (a.center.x.equals(b.center.x) & a.center.y.equals(b.center.y))
        & (a.size.x.equals(b.size.x) & a.size.y.equals(b.size.y) & a.heading.equals(b.heading));
    let same = birds_same & (a.center.z.equals(b.center.z) & a.size.z.equals(b.size.z));
    Columns {
        area,
        area_a: area_from_half(pair.half_a),
        area_b: area_from_half(pair.half_b),
        scale,
        height: shared * height_scale,
        height_a: (half_a + half_a) * height_scale,
        height_b: (half_b + half_b) * height_scale,
        height_scale,
        same,
    }
}

fn score_yaw<S: Scalar>(over: Denominator, a: YawBox3<S>, b: YawBox3<S>) -> S {
    let c = columns(a, b);
    let shared = c.area * c.height;
    let value = match over {
        Denominator::None => {
            let value = shared.over(c.scale).over(c.height_scale).over(c.scale);
            value.saturated()
        }
        Denominator::Union => {
            let ratio = ratio_of_union(shared, c.area_a * c.height_a, c.area_b * c.height_b);
            S::select(c.same, S::from_primal(ratio.primal()), ratio)
        }
        // Each ratio alone: a small box in a large one has no volume in the large one's unit.
        Denominator::First => {
            ratio_of_first(c.area, c.area_a) * ratio_of_first(c.height, c.height_a)
        }
    };
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

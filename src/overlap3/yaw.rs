//! Overlap of upright boxes.
use crate::clip::{COMMON_LARGE, COMMON_SMALL, area_from_half, frame, size_scale, zero_or_within};
use crate::overlap::{Denominator, iou_obb2, ratio_of_first, ratio_of_union, scaled_shared_area};
use crate::shape::YawBox3;
use crate::{Scalar, Vec2};

/// The factors of two upright boxes that are compared, so that no product over- or underflows: powers of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales<S> {
    /// Lengths seen from above.
    pub flat: S,
    /// Heights.
    pub tall: S,
}

/// Returns the scales that bring the larger side of the smaller box, seen from above, and the larger height near one.
/// Nothing is scaled where all sides are of common size, as in batches, so that the same digits are lost below the
/// smallest normal number.
///
/// Each box is given by half its sides seen from above and half its height.
#[inline(always)]
pub(crate) fn upright_scales<S: Scalar>(a: (Vec2<S>, S), b: (Vec2<S>, S)) -> Scales<S> {
    let one = S::one();
    let (small, large) = (S::lit(0.5 * COMMON_SMALL), S::lit(0.5 * COMMON_LARGE));
    let is_common = |half: S| zero_or_within(half, small, large);
    let common =
        |(half, tall): (Vec2<S>, S)| is_common(half.x) & is_common(half.y) & is_common(tall);
    let unscaled = common(a) & common(b);
    let higher = a.1.most(b.1);
    let flat = higher.at_most(S::zero());
    let tall = S::select(flat, one, S::select(flat, one, higher).binade());
    Scales {
        flat: S::select(unscaled, one, size_scale(a.0, b.0)),
        tall: S::select(unscaled, one, tall),
    }
}

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

/// Returns the heights of two upright boxes, each given by the coordinate of its middle and half its height, times
/// `scale`.
#[inline(always)]
pub(crate) fn heights<S: Scalar>(
    [at_a, half_a]: [S; 2],
    [at_b, half_b]: [S; 2],
    scale: S,
) -> Heights<S> {
    let zero = S::zero();
    // Relative to a centre, so that far from the origin no digits are lost, and within the lower one, so that it keeps
    // its own within one much higher. The result does not depend on which of them is above.
    let (up, lower, higher) = (at_b - at_a, half_a.least(half_b), half_a.most(half_b));
    let shared = lower.least(up + higher) - (-lower).most(up - higher);
    let shared = S::select(shared.at_most(zero), zero, shared);
    Heights {
        shared: shared * scale,
        a: (half_a + half_a) * scale,
        b: (half_b + half_b) * scale,
        scale,
    }
}

/// Returns a score of upright boxes from areas seen from above (shared, of a, of b; in units of `1 / scale²`) and
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

/// Returns a score of two upright boxes.
pub(crate) fn score_yaw<S: Scalar>(over: Denominator, a: YawBox3<S>, b: YawBox3<S>) -> S {
    let (flat_a, flat_b) = (frame(a.birds_eye()), frame(b.birds_eye()));
    let (tall_a, tall_b) = (a.size.z.halved(), b.size.z.halved());
    let scales = upright_scales((flat_a.half, tall_a), (flat_b.half, tall_b));
    let (pair, area) = scaled_shared_area::<S, true>(flat_a, flat_b, scales.flat);
    let height = heights([a.center.z, tall_a], [b.center.z, tall_b], scales.tall);
    let (area_a, area_b) = (area_from_half(pair.half_a), area_from_half(pair.half_b));
    let mut value = score_of_columns::<S, true>(over, [area, area_a, area_b], scales.flat, &height);
    if over == Denominator::Union {
        let birds_same = (a.center.x.equals(b.center.x) & a.center.y.equals(b.center.y))
            & (a.size.x.equals(b.size.x) & a.size.y.equals(b.size.y) & a.heading.equals(b.heading));
        let same = birds_same & (a.center.z.equals(b.center.z) & a.size.z.equals(b.size.z));
        value = S::select(same, S::from_primal(value.primal()), value);
    }
    value.canonical()
}

/// Returns the volume shared by two upright boxes, from 0 to the volume of the smaller one, in cubed units of
/// length. Saturates at the largest finite number.
///
/// The area shared seen from above times the height shared. Kinks and conventions: see the
/// [module](super).
#[must_use]
#[inline]
pub fn intersection_volume_yaw<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> S {
    score_yaw(Denominator::None, a, b)
}

/// Returns the intersection over union of two upright boxes, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](super).
///
/// ```
/// use geograd::{Vec3, YawBox3, overlap3::iou_yaw};
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

/// Returns the share of the first upright box that lies in the second, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](super).
#[must_use]
#[inline]
pub fn iof_yaw<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> S {
    score_yaw(Denominator::First, a, b)
}

/// Returns the intersection over union of two upright boxes seen from above, in `[0, 1]`: their heights do not count.
#[must_use]
#[inline]
pub fn iou_birds_eye<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>) -> S {
    iou_obb2(a.birds_eye(), b.birds_eye())
}

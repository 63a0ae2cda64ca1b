//! Overlap of two boxes: area of intersection, intersection over union, intersection over the first box.
//!
//! All results are exactly zero, with all derivatives zero, for boxes that are apart or merely touch. The ratios
//! are within `[0, 1]`; identical boxes of positive area give exactly 1 with derivative zero. A ratio with a
//! denominator of zero is 0 with derivative zero.
//!
//! Ratios by the union are right to a few roundings. If one box is R times longer than the other, the area and its
//! ratio to the small box are right to about R roundings: in `f32`, the share of a car in a kilometre of lane to 10⁻⁵.
//! Exchanging the boxes of a union changes the result by at most about the longest aspect times a rounding: in `f32` by
//! 10⁻⁴ where a box is 3·10⁷ times longer than wide.
//!
//! A box counts as empty when it is so thin that, with its longer side as the unit of length, its area is
//! at most [`Format::empty`](crate::scalar::Format::empty): longer than wide by a factor beyond about 10³⁷ in `f32` and 10³⁰⁶ in `f64`.
//! Two such boxes score 0, also when they are identical.
//!
//! Values and derivatives are finite for all finite valid input, for upstream derivatives of any size; derivatives by
//! duals where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in
//! `f64`.
//!
//! Kinks: sides lying along each other (the derivative is the mean of both sides of the kink), and
//! boxes that begin to touch (derivative zero). A corner on a side is no kink.
//!
//! # Method
//!
//! The relative pose comes first: the difference of the centres, then the rotation, both with low parts where the
//! scalar has 24 bits. Four separating axes make boxes that are apart exactly zero. A pair is scaled by a power of two,
//! so that nothing overflows; for ordinary sizes that changes no bit, and compiled kernels leave it out (`EXTREME`).
//! [`clip`](crate::clip) has the area, and [`ad::adjoint::clip`](crate::ad::adjoint::clip) its adjoint.
use crate::clip::{
    Framed, Relative, area_from_half, clip, clipped_area, frame, relate, related_area, size_scale,
};
use crate::scalar::guarded;
use crate::{Aabb2, Mask, Obb2, Scalar, Vec2};

/// Returns the intersection over union from areas, in `[0, 1]`; zero with derivative zero when the union is empty.
#[inline(always)]
pub(crate) fn ratio_of_union<S: Scalar>(inter: S, area_a: S, area_b: S) -> S {
    let total = area_a + area_b - inter;
    let empty = total.at_most(S::lit(S::format().empty()));
    S::select(
        empty,
        S::zero(),
        inter.over(S::select(empty, S::one(), total)),
    )
}

/// Returns the intersection over the first area, in `[0, 1]`; zero with derivative zero when that is empty.
#[inline(always)]
pub(crate) fn ratio_of_first<S: Scalar>(inter: S, area_a: S) -> S {
    let empty = area_a.at_most(S::lit(S::format().empty()));
    S::select(
        empty,
        S::zero(),
        inter.over(S::select(empty, S::one(), area_a)),
    )
}

/// Relates two framed boxes and measures their intersection, in units of `1 / scale`.
///
/// `EXTREME` allows sizes so small or large that products over- or underflow; the bits of the result are equal for
/// ordinary boxes in both cases.
#[inline(always)]
fn shared_area<S: Scalar, const EXTREME: bool>(a: Framed<S>, b: Framed<S>) -> (Relative<S>, S, S) {
    let scale = if EXTREME {
        size_scale(a.half, b.half)
    } else {
        S::one()
    };
    let (pair, area) = scaled_shared_area::<S, EXTREME>(a, b, scale);
    (pair, area, scale)
}

/// Returns [`shared_area`] in a given unit.
#[inline(always)]
pub(crate) fn scaled_shared_area<S: Scalar, const EXTREME: bool>(
    a: Framed<S>,
    b: Framed<S>,
    scale: S,
) -> (Relative<S>, S) {
    let pair = relate::<S, EXTREME>(a, b, scale);
    let area = if pair.apart.all() {
        S::zero()
    } else {
        related_area(&pair, clipped_area(&clip(pair)))
    };
    (pair, area)
}

/// The divisor of an area of intersection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Denominator {
    /// Nothing: the score is the area itself.
    None,
    /// The area of the union.
    Union,
    /// The area of the first box.
    First,
}

/// Returns a score from areas.
#[inline(always)]
pub(crate) fn score_of<S: Scalar>(over: Denominator, inter: S, area_a: S, area_b: S) -> S {
    match over {
        Denominator::None => inter,
        Denominator::Union => ratio_of_union(inter, area_a, area_b),
        Denominator::First => ratio_of_first(inter, area_a),
    }
}

/// Returns a score in the caller's unit: ratios have none, areas go back from units of `1 / scale²`.
#[inline(always)]
pub(crate) fn in_outer_unit<S: Scalar>(over: Denominator, value: S, scale: S) -> S {
    match over {
        Denominator::None => value.over(scale).over(scale).saturated(),
        Denominator::Union | Denominator::First => value,
    }
}

/// Returns an upstream derivative of at most about one, and the power of two that its results are to be multiplied
/// by: boxes of extreme sizes have derivatives that bear no larger one.
#[inline(always)]
pub(crate) fn tamed<S: Scalar>(out_bar: S) -> (S, S) {
    let size = out_bar.unsigned();
    let one = S::one();
    let unit = S::select(size.above(one), size, one).binade().halved();
    (out_bar * unit, one.over(unit))
}

/// Returns a score of two rotated boxes with their trigonometry done.
#[inline(always)]
pub(crate) fn score_framed<S: Scalar, const EXTREME: bool>(
    over: Denominator,
    a: Framed<S>,
    b: Framed<S>,
) -> S {
    let (pair, inter, scale) = shared_area::<S, EXTREME>(a, b);
    let (area_a, area_b) = (area_from_half(pair.half_a), area_from_half(pair.half_b));
    let value = score_of(over, inter, area_a, area_b);
    let value = if EXTREME {
        in_outer_unit(over, value, scale)
    } else {
        value
    };
    value.canonical()
}

/// Returns a score of two axis-aligned boxes.
#[inline(always)]
pub(crate) fn score_aabb2<S: Scalar>(over: Denominator, a: Aabb2<S>, b: Aabb2<S>) -> S {
    let shared = share(a, b);
    let (area_a, area_b) = (area_from_half(shared.half_a), area_from_half(shared.half_b));
    let value = score_of(over, area_of_shared(&shared), area_a, area_b);
    in_outer_unit(over, value, shared.scale).canonical()
}

/// Returns the area shared by two rotated boxes, from 0 to the area of the smaller one, in squared units
/// of length. Saturates at the largest finite number.
///
/// By the boundary integral of [`clip`](crate::clip). Kinks and conventions: see the
/// [module](self).
///
/// ```
/// use geograd::{Obb2, overlap::intersection_area_obb2};
/// let a = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0);
/// let b = Obb2::new(0.0, 0.0, 2.0, 2.0, std::f64::consts::FRAC_PI_4);
/// let octagon = 8.0 * (2.0_f64.sqrt() - 1.0);
/// assert!((intersection_area_obb2(a, b) - octagon).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn intersection_area_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    score_framed::<S, true>(Denominator::None, frame(a), frame(b))
}

/// Returns the intersection over union of two rotated boxes, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](self).
///
/// ```
/// use geograd::{Obb2, overlap::iou_obb2};
/// let a = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.3);
/// assert_eq!(iou_obb2(a, a), 1.0);
/// assert_eq!(iou_obb2(a, Obb2::new(9.0, 0.0, 2.0, 2.0, 0.1)), 0.0);
/// ```
#[must_use]
#[inline]
pub fn iou_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    score_framed::<S, true>(Denominator::Union, frame(a), frame(b))
}

/// Returns the share of the first rotated box that lies in the second, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](self).
///
/// ```
/// use geograd::{Obb2, overlap::iof_obb2};
/// let lane = Obb2::new(0.0, 0.0, 50.0, 4.0, 0.0);
/// let car = Obb2::new(10.0, 2.0, 4.0, 2.0, 0.0);
/// assert_eq!(iof_obb2(car, lane), 0.5);
/// ```
#[must_use]
#[inline]
pub fn iof_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    score_framed::<S, true>(Denominator::First, frame(a), frame(b))
}

/// The shared part of two axis-aligned boxes, all sizes halved and in units of `1 / scale`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shared<S: Scalar> {
    /// Half the size of the shared part.
    pub half: Vec2<S>,
    /// Half the size of a.
    pub half_a: Vec2<S>,
    /// Half the size of b.
    pub half_b: Vec2<S>,
    /// `true` where the boxes are apart or merely touch.
    pub apart: S::Mask,
    /// The power of two by which sizes were multiplied.
    pub scale: S,
}

/// Measures what two axis-aligned boxes share.
#[inline(always)]
pub(crate) fn share<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> Shared<S> {
    // Halving first keeps the difference of two huge bounds finite.
    let half_of = |shape: Aabb2<S>| {
        Vec2::new(
            shape.max.x.halved() - shape.min.x.halved(),
            shape.max.y.halved() - shape.min.y.halved(),
        )
    };
    let (half_a, half_b, half) = (half_of(a), half_of(b), half_of(a.meet(b)));
    let scale = size_scale(half_a, half_b);
    let apart = a.max.x.at_most(b.min.x)
        | b.max.x.at_most(a.min.x)
        | a.max.y.at_most(b.min.y)
        | b.max.y.at_most(a.min.y);
    Shared {
        half: half * scale,
        half_a: half_a * scale,
        half_b: half_b * scale,
        apart,
        scale,
    }
}

/// Returns the area of the shared part, in units of `1 / scale²`.
#[inline(always)]
fn area_of_shared<S: Scalar>(shared: &Shared<S>) -> S {
    S::select(shared.apart, S::zero(), area_from_half(shared.half))
}

/// Returns the area shared by two axis-aligned boxes, from 0 to the area of the smaller one, in squared
/// units of length. Saturates at the largest finite number.
///
/// Kinks and conventions: see the [module](self).
///
/// ```
/// use geograd::{Aabb2, overlap::intersection_area_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 2.0, 2.0);
/// assert_eq!(intersection_area_aabb2(a, Aabb2::new(1.0, -1.0, 3.0, 1.0)), 1.0);
/// ```
#[must_use]
#[inline]
pub fn intersection_area_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    score_aabb2(Denominator::None, a, b)
}

/// Returns the intersection over union of two axis-aligned boxes, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](self).
///
/// ```
/// use geograd::{Aabb2, overlap::iou_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 2.0, 2.0);
/// assert_eq!(iou_aabb2(a, Aabb2::new(1.0, 0.0, 3.0, 2.0)), 1.0 / 3.0);
/// ```
#[must_use]
#[inline]
pub fn iou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    score_aabb2(Denominator::Union, a, b)
}

/// Returns the share of the first axis-aligned box that lies in the second, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](self).
///
/// ```
/// use geograd::{Aabb2, overlap::iof_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 2.0, 2.0);
/// assert_eq!(iof_aabb2(a, Aabb2::new(1.0, 0.0, 9.0, 9.0)), 0.5);
/// ```
#[must_use]
#[inline]
pub fn iof_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    score_aabb2(Denominator::First, a, b)
}

impl<S: Scalar> Obb2<S> {
    /// Returns [`intersection_area_obb2`].
    #[must_use]
    #[inline]
    pub fn intersection_area(self, other: Self) -> S {
        guarded((self, other), |(a, b)| intersection_area_obb2(a, b))
    }
    /// Returns [`iou_obb2`].
    #[must_use]
    #[inline]
    pub fn iou(self, other: Self) -> S {
        guarded((self, other), |(a, b)| iou_obb2(a, b))
    }
    /// Returns [`iof_obb2`].
    #[must_use]
    #[inline]
    pub fn iof(self, other: Self) -> S {
        guarded((self, other), |(a, b)| iof_obb2(a, b))
    }
}

impl<S: Scalar> Aabb2<S> {
    /// Returns [`intersection_area_aabb2`].
    #[must_use]
    #[inline]
    pub fn intersection_area(self, other: Self) -> S {
        guarded((self, other), |(a, b)| intersection_area_aabb2(a, b))
    }
    /// Returns [`iou_aabb2`].
    #[must_use]
    #[inline]
    pub fn iou(self, other: Self) -> S {
        guarded((self, other), |(a, b)| iou_aabb2(a, b))
    }
    /// Returns [`iof_aabb2`].
    #[must_use]
    #[inline]
    pub fn iof(self, other: Self) -> S {
        guarded((self, other), |(a, b)| iof_aabb2(a, b))
    }
}

//! Adjoints of the overlap scores of two boxes.
//!
//! Each comes fused, as value and slopes (`…_grad`), because the slopes need the value's pieces
//! anyway, and as a plain adjoint (`…_vjp`).
use crate::ad::clip::clipped_area_slopes;
use crate::clip::{
    Framed, clip, clipped_area, frame, nothing_shared, relate, related_area, size_scale,
};
use crate::overlap::{
    Denominator, Shared, area_from_half, area_of_shared, in_outer_unit, score_of, share,
};
use crate::{Aabb2, Mask, Obb2, Scalar, Vec2};

/// The slopes of a score with respect to the areas it is made of.
///
/// `I / U` with `U = A + B − I`: `∂I = (1 + I/U) / U`, `∂A = ∂B = −(I/U) / U`.
/// `I / A`: `∂I = 1/A`, `∂A = −(I/A) / A`. Zero where the denominator is.
#[inline(always)]
fn score_slopes<S: Scalar>(over: Denominator, value: S, inter: S, area_a: S, area_b: S) -> [S; 3] {
    match over {
        Denominator::None => [S::one(), S::zero(), S::zero()],
        Denominator::Union => {
            let per_area = reciprocal_or_zero(area_a + area_b - inter);
            let area_bar = -(value * per_area);
            [per_area - area_bar, area_bar, area_bar]
        }
        Denominator::First => {
            let per_area = reciprocal_or_zero(area_a);
            [per_area, -(value * per_area), S::zero()]
        }
    }
}

/// One over a number that is not empty, else zero.
#[inline(always)]
fn reciprocal_or_zero<S: Scalar>(x: S) -> S {
    let empty = x.at_most(S::lit(S::EMPTY));
    S::select(
        empty,
        S::zero(),
        S::one().over(S::select(empty, S::one(), x)),
    )
}

/// Slopes of a score with respect to both boxes.
pub type Grads<S> = (Obb2<S>, Obb2<S>);

/// Value of a score of two boxes with their trigonometry done, and `out_bar` times its slopes.
///
/// Moving b by `(∂u, ∂v)` in a's frame is moving a the other way; turning the pair about a's centre
/// changes nothing, so `∂heading_a = −(∂heading_b + u ∂v − v ∂u)`.
#[inline(always)]
pub fn score_framed_vjp<S: Scalar, const EXTREME: bool>(
    over: Denominator,
    a: Framed<S>,
    b: Framed<S>,
    out_bar: S,
) -> (S, Grads<S>) {
    let scale = if EXTREME {
        size_scale(a.half, b.half)
    } else {
        S::one()
    };
    let pair = relate::<S, EXTREME>(a, b, scale);
    let zero = Obb2::new(S::zero(), S::zero(), S::zero(), S::zero(), S::zero());
    if pair.apart.all() {
        return (S::zero(), (zero, zero));
    }
    let clip = clip(pair);
    let area = clipped_area(&clip);
    let inter = related_area(&pair, area);
    let nothing = nothing_shared(&pair, area);
    let slopes = clipped_area_slopes(&pair, &clip);

    // From the pair's unit of length to the caller's.
    let (mut heading_unit, mut length_unit) = (S::one(), scale);
    if EXTREME && over == Denominator::None {
        length_unit = S::one().over(scale);
        heading_unit = length_unit;
    }
    let half_b = b.half * scale;
    let (area_a, area_b) = (area_from_half(pair.half_a), area_from_half(half_b));
    let value = score_of(over, inter, area_a, area_b);
    let [inter_bar, area_a_bar, area_b_bar] =
        score_slopes(over, value, inter, area_a, area_b).map(|bar| bar * out_bar);
    let value = if EXTREME {
        in_outer_unit(over, value, scale)
    } else {
        value
    };
    let inter_bar = S::select(nothing, S::zero(), inter_bar);
    // What is apart scores zero whatever the areas are, so those slopes vanish by themselves.
    let (u_bar, v_bar) = (
        bounded::<S, EXTREME>(slopes.u * inter_bar),
        bounded::<S, EXTREME>(slopes.v * inter_bar),
    );
    let heading_bar = bounded::<S, EXTREME>(slopes.heading * inter_bar);
    let turn_bar = heading_bar
        + (bounded::<S, EXTREME>(pair.u * v_bar) - bounded::<S, EXTREME>(pair.v * u_bar));
    let center_bar =
        Vec2::new(a.cos * u_bar - a.sin * v_bar, a.sin * u_bar + a.cos * v_bar) * length_unit;
    let grads = (
        Obb2 {
            center: -center_bar,
            size: size_slopes::<S, EXTREME>(pair.half_a, slopes.half_a * inter_bar, area_a_bar)
                * length_unit,
            heading: -(turn_bar * heading_unit * heading_unit),
        },
        Obb2 {
            center: center_bar,
            size: size_slopes::<S, EXTREME>(half_b, slopes.half_b * inter_bar, area_b_bar)
                * length_unit,
            heading: heading_bar * heading_unit * heading_unit,
        },
    );
    let grads = if EXTREME {
        (saturated(grads.0), saturated(grads.1))
    } else {
        grads
    };
    (value.canonical(), (canonical(grads.0), canonical(grads.1)))
}

/// A term of a sum of slopes: no larger than the largest number, so that two of opposite sign leave
/// a number. Ordinary boxes have none so large.
#[inline(always)]
fn bounded<S: Scalar, const EXTREME: bool>(x: S) -> S {
    if EXTREME { x.saturated() } else { x }
}

/// Every field with zeros without sign.
#[inline(always)]
fn canonical<S: Scalar>(x: Obb2<S>) -> Obb2<S> {
    Obb2 {
        center: x.center.canonical(),
        size: x.size.canonical(),
        heading: x.heading.canonical(),
    }
}

/// Slopes with respect to a size, which is twice its half: those through the area of intersection
/// and those through the box's own area, four times the product of the halves.
#[inline(always)]
fn size_slopes<S: Scalar, const EXTREME: bool>(
    half: Vec2<S>,
    inter_slope: Vec2<S>,
    area_bar: S,
) -> Vec2<S> {
    let twice = bounded::<S, EXTREME>(area_bar + area_bar);
    let sum = |of_inter: S, of_area: S| {
        bounded::<S, EXTREME>(of_inter.halved()) + bounded::<S, EXTREME>(of_area)
    };
    Vec2::new(
        sum(inter_slope.x, twice * half.y),
        sum(inter_slope.y, twice * half.x),
    )
}

/// Every field at the nearest finite number.
#[inline(always)]
fn saturated<S: Scalar>(x: Obb2<S>) -> Obb2<S> {
    Obb2 {
        center: Vec2::new(x.center.x.saturated(), x.center.y.saturated()),
        size: Vec2::new(x.size.x.saturated(), x.size.y.saturated()),
        heading: x.heading.saturated(),
    }
}

/// Value of a score of two axis-aligned boxes, and `out_bar` times its slopes.
///
/// With `h` half the shared size, `I = 4 h_x h_y`; a bound that decides alone takes the whole slope
/// of its side, tied bounds half each.
#[inline(always)]
pub fn score_aabb2_vjp<S: Scalar>(
    over: Denominator,
    a: Aabb2<S>,
    b: Aabb2<S>,
    out_bar: S,
) -> (S, (Aabb2<S>, Aabb2<S>)) {
    let shared = share(a, b);
    let Shared {
        half,
        half_a,
        half_b,
        apart,
        scale,
    } = shared;
    let inter = area_of_shared(&shared);
    let (area_a, area_b) = (area_from_half(half_a), area_from_half(half_b));
    let value = score_of(over, inter, area_a, area_b);
    let [inter_bar, area_a_bar, area_b_bar] =
        score_slopes(over, value, inter, area_a, area_b).map(|bar| bar * out_bar);
    let value = in_outer_unit(over, value, scale);
    let unit = match over {
        Denominator::None => S::one().over(scale),
        Denominator::Union | Denominator::First => scale,
    };
    let inter_bar = S::select(apart, S::zero(), inter_bar);
    let two = S::lit(2.0) * unit;
    // Slopes with respect to a shared bound, and to a box's own bounds.
    let bound_bar = Vec2::new(half.y * inter_bar, half.x * inter_bar) * two;
    let own_bar = |half: Vec2<S>, area_bar: S| Vec2::new(half.y, half.x) * (area_bar * two);
    let (own_a, own_b) = (own_bar(half_a, area_a_bar), own_bar(half_b, area_b_bar));
    // The part of a bound's slope that the first of two bounds takes when the smaller one decides.
    let part = |mine: S, other: S| {
        let won = S::select(mine.below(other), S::one(), S::zero());
        S::select(mine.equals(other), S::lit(0.5), won)
    };
    let max = Vec2::new(part(a.max.x, b.max.x), part(a.max.y, b.max.y));
    let min = Vec2::new(part(b.min.x, a.min.x), part(b.min.y, a.min.y));
    let times = |x: Vec2<S>, y: Vec2<S>| Vec2::new(x.x * y.x, x.y * y.y);
    let rest = |x: Vec2<S>| Vec2::new(S::one() - x.x, S::one() - x.y);
    let limit = |x: Vec2<S>| Vec2::new(x.x.saturated(), x.y.saturated()).canonical();
    (
        value.canonical(),
        (
            Aabb2 {
                min: limit(-(times(bound_bar, min) + own_a)),
                max: limit(times(bound_bar, max) + own_a),
            },
            Aabb2 {
                min: limit(-(times(bound_bar, rest(min)) + own_b)),
                max: limit(times(bound_bar, rest(max)) + own_b),
            },
        ),
    )
}

/// Both public forms of one score: the macro lists names.
macro_rules! adjoints {
    ($($over:ident: $obb_grad:ident, $obb_vjp:ident of $obb:ident;
       $aabb_grad:ident, $aabb_vjp:ident of $aabb:ident;)*) => { $(
        #[doc = concat!("[`", stringify!($obb), "`](crate::overlap::", stringify!($obb),
            ") and its slopes with respect to both boxes.")]
        #[must_use]
        #[inline]
        pub fn $obb_grad<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> (S, (Obb2<S>, Obb2<S>)) {
            score_framed_vjp::<S, true>(Denominator::$over, frame(a), frame(b), S::one())
        }
        #[doc = concat!("Adjoint of [`", stringify!($obb), "`](crate::overlap::", stringify!($obb),
            "): `out_bar` times the slopes with respect to both boxes.")]
        #[must_use]
        #[inline]
        pub fn $obb_vjp<S: Scalar>(a: Obb2<S>, b: Obb2<S>, out_bar: S) -> (Obb2<S>, Obb2<S>) {
            score_framed_vjp::<S, true>(Denominator::$over, frame(a), frame(b), out_bar).1
        }
        #[doc = concat!("[`", stringify!($aabb), "`](crate::overlap::", stringify!($aabb),
            ") and its slopes with respect to both boxes.")]
        #[must_use]
        #[inline]
        pub fn $aabb_grad<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> (S, (Aabb2<S>, Aabb2<S>)) {
            score_aabb2_vjp(Denominator::$over, a, b, S::one())
        }
        #[doc = concat!("Adjoint of [`", stringify!($aabb), "`](crate::overlap::",
            stringify!($aabb), "): `out_bar` times the slopes with respect to both boxes.")]
        #[must_use]
        #[inline]
        pub fn $aabb_vjp<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, out_bar: S) -> (Aabb2<S>, Aabb2<S>) {
            score_aabb2_vjp(Denominator::$over, a, b, out_bar).1
        }
    )* };
}

adjoints! {
    None: intersection_area_obb2_grad, intersection_area_obb2_vjp of intersection_area_obb2;
        intersection_area_aabb2_grad, intersection_area_aabb2_vjp of intersection_area_aabb2;
    Union: iou_obb2_grad, iou_obb2_vjp of iou_obb2;
        iou_aabb2_grad, iou_aabb2_vjp of iou_aabb2;
    First: iof_obb2_grad, iof_obb2_vjp of iof_obb2;
        iof_aabb2_grad, iof_aabb2_vjp of iof_aabb2;
}

//! Adjoints of the overlap scores of two boxes.
//!
//! Each comes fused, as value and derivatives (`…_grad`), because the derivatives need the value's pieces
//! anyway, and as a plain adjoint (`…_vjp`).
use crate::ad::adjoint::clip::clipped_area_derivatives;
use crate::clip::area_from_half;
use crate::clip::{
    Framed, clip, clipped_area, frame, nothing_shared, relate, related_area, size_scale,
};
pub(crate) use crate::overlap::tamed;
use crate::overlap::{Denominator, Shared, in_outer_unit, score_of, share};
use crate::{Aabb2, Mask, Obb2, Scalar, Vec2};

/// The derivatives of a score with respect to its areas (in space: volumes).
pub(crate) struct AreaDerivatives<S> {
    /// By the area of intersection.
    pub inter: S,
    /// By the areas of both boxes, without `falling`.
    pub own: [S; 2],
    /// The last factor of `own`: it may be so small that an earlier product with it would be zero.
    pub falling: S,
}

/// Returns `out_bar` times the derivatives of a score with respect to its areas.
///
/// `I / U` with `U = A + B − I`: `∂I = (1 + I/U) / U`, `∂A = ∂B = −(I/U) / U`.
/// `I / A`: `∂I = 1/A`, `∂A = −(I/A) / A`. Zero where the denominator is.
#[inline(always)]
pub(crate) fn score_derivatives<S: Scalar>(
    over: Denominator,
    value: S,
    [inter, area_a, area_b]: [S; 3],
    out_bar: S,
) -> AreaDerivatives<S> {
    let zero = S::zero();
    match over {
        Denominator::None => AreaDerivatives {
            inter: out_bar,
            own: [zero, zero],
            falling: zero,
        },
        Denominator::Union => {
            let per_area = reciprocal_or_zero(area_a + area_b - inter);
            let own = per_area * out_bar;
            AreaDerivatives {
                inter: (per_area + value * per_area) * out_bar,
                own: [own, own],
                falling: -value,
            }
        }
        Denominator::First => {
            let own = reciprocal_or_zero(area_a) * out_bar;
            AreaDerivatives {
                inter: own,
                own: [own, zero],
                falling: -value,
            }
        }
    }
}

/// Returns one over a number, or zero for one so small that it counts as none.
#[inline(always)]
pub(crate) fn reciprocal_or_zero<S: Scalar>(x: S) -> S {
    let empty = x.at_most(S::lit(S::format().empty()));
    S::select(
        empty,
        S::zero(),
        S::one().over(S::select(empty, S::one(), x)),
    )
}

/// Derivatives of a score with respect to both boxes.
pub type Grads<S> = (Obb2<S>, Obb2<S>);

/// Returns the value of a score of two boxes whose sine and cosine are known, and `out_bar` times its derivatives.
///
/// Moving b by `(∂u, ∂v)` in a's frame is moving a by the opposite vector; turning the pair about a's centre changes
/// nothing, so `∂heading_a = −(∂heading_b + u ∂v − v ∂u)`.
#[inline(always)]
pub(crate) fn score_framed_vjp<S: Scalar, const EXTREME: bool>(
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
    let (out_bar, steep) = if EXTREME {
        tamed(out_bar)
    } else {
        (out_bar, S::one())
    };
    let (value, (a_bar, b_bar)) = score_scaled_vjp::<S, EXTREME>(over, a, b, scale, out_bar);
    // From the pair's unit of length to the caller's.
    let (mut heading_unit, mut length_unit) = (S::one(), scale);
    if EXTREME && over == Denominator::None {
        length_unit = S::one().over(scale);
        heading_unit = length_unit;
    }
    let value = if EXTREME {
        in_outer_unit(over, value, scale)
    } else {
        value
    };
    let outer = |x: Obb2<S>| Obb2 {
        center: x.center * length_unit,
        size: x.size * length_unit,
        heading: x.heading * heading_unit * heading_unit,
    };
    let grads = (outer(a_bar), outer(b_bar));
    let grads = if EXTREME {
        (saturated(grads.0, steep), saturated(grads.1, steep))
    } else {
        grads
    };
    (value.canonical(), (canonical(grads.0), canonical(grads.1)))
}

/// Returns [`score_framed_vjp`] with lengths, value and derivatives in units of `1 / scale`.
#[inline(always)]
pub(crate) fn score_scaled_vjp<S: Scalar, const EXTREME: bool>(
    over: Denominator,
    a: Framed<S>,
    b: Framed<S>,
    scale: S,
    out_bar: S,
) -> (S, Grads<S>) {
    let pair = relate::<S, EXTREME>(a, b, scale);
    let zero = Obb2::new(S::zero(), S::zero(), S::zero(), S::zero(), S::zero());
    if pair.apart.all() {
        return (S::zero(), (zero, zero));
    }
    let clip = clip(pair);
    let area = clipped_area(&clip);
    let inter = related_area(&pair, area);
    let nothing = nothing_shared(&pair, area);
    let derivatives = clipped_area_derivatives(&pair, &clip);

    let half_b = b.half * scale;
    let (area_a, area_b) = (area_from_half(pair.half_a), area_from_half(half_b));
    let value = score_of(over, inter, area_a, area_b);
    let areas = score_derivatives(over, value, [inter, area_a, area_b], out_bar);
    let inter_bar = S::select(nothing, S::zero(), areas.inter);
    // A size is twice its half; a box's own area is four times the product of the halves.
    let (half_bar, falling) = (inter_bar.halved(), areas.falling + areas.falling);
    let size_a_bar = inter_size_bar::<S, EXTREME>(derivatives.half_a, half_bar)
        + own_size_bar::<S, EXTREME>(pair.half_a, areas.own[0], falling);
    let size_b_bar = inter_size_bar::<S, EXTREME>(derivatives.half_b, half_bar)
        + own_size_bar::<S, EXTREME>(half_b, areas.own[1], falling);
    // Boxes apart score zero for all areas, so those derivatives vanish by themselves.
    let (u_bar, v_bar) = (
        bounded::<S, EXTREME>(derivatives.u * inter_bar),
        bounded::<S, EXTREME>(derivatives.v * inter_bar),
    );
    let heading_bar = bounded::<S, EXTREME>(derivatives.heading * inter_bar);
    let turn_bar = heading_bar
        + (bounded::<S, EXTREME>(pair.u * v_bar) - bounded::<S, EXTREME>(pair.v * u_bar));
    let center_bar = Vec2::new(a.cos * u_bar - a.sin * v_bar, a.sin * u_bar + a.cos * v_bar);
    let grads = (
        Obb2 {
            center: -center_bar,
            size: size_a_bar,
            heading: -turn_bar,
        },
        Obb2 {
            center: center_bar,
            size: size_b_bar,
            heading: heading_bar,
        },
    );
    (value, grads)
}

/// Returns the derivatives by a box's size, of the shared area's derivatives by its halves.
#[inline(always)]
fn inter_size_bar<S: Scalar, const EXTREME: bool>(derivative: Vec2<S>, half_bar: S) -> Vec2<S> {
    Vec2::new(
        bounded::<S, EXTREME>(derivative.x * half_bar),
        bounded::<S, EXTREME>(derivative.y * half_bar),
    )
}

/// Returns the derivative by a side of its own box, whose derivative is `own` times `falling`.
#[inline(always)]
pub(super) fn own_bar<S: Scalar, const EXTREME: bool>(own: S, falling: S) -> S {
    bounded::<S, EXTREME>(bounded::<S, EXTREME>(own) * falling)
}

/// Returns the derivatives by a box's size of its own area likewise.
#[inline(always)]
fn own_size_bar<S: Scalar, const EXTREME: bool>(half: Vec2<S>, own: S, falling: S) -> Vec2<S> {
    Vec2::new(
        own_bar::<S, EXTREME>(own * half.y, falling),
        own_bar::<S, EXTREME>(own * half.x, falling),
    )
}

/// Returns a term of a sum of derivatives: no larger than the largest number, so that two of opposite sign leave
/// a number. Ordinary boxes have none so large.
#[inline(always)]
pub(super) fn bounded<S: Scalar, const EXTREME: bool>(x: S) -> S {
    if EXTREME { x.saturated() } else { x }
}

/// Returns every field with positive zeros.
#[inline(always)]
fn canonical<S: Scalar>(x: Obb2<S>) -> Obb2<S> {
    Obb2 {
        center: x.center.canonical(),
        size: x.size.canonical(),
        heading: x.heading.canonical(),
    }
}

/// Multiplies every field by the factor that was taken from the upstream derivative, up to the largest number.
#[inline(always)]
fn saturated<S: Scalar>(x: Obb2<S>, steep: S) -> Obb2<S> {
    let times = |x: S| (x.saturated() * steep).saturated();
    Obb2 {
        center: Vec2::new(times(x.center.x), times(x.center.y)),
        size: Vec2::new(times(x.size.x), times(x.size.y)),
        heading: times(x.heading),
    }
}

/// Returns the value of a score of two axis-aligned boxes, and `out_bar` times its derivatives.
#[inline(always)]
pub(crate) fn score_aabb2_vjp<S: Scalar>(
    over: Denominator,
    a: Aabb2<S>,
    b: Aabb2<S>,
    out_bar: S,
) -> (S, (Aabb2<S>, Aabb2<S>)) {
    let (out_bar, steep) = tamed(out_bar);
    let (value, (a_bar, b_bar)) = tame_score_aabb2_vjp(over, a, b, out_bar);
    let times = |x: Vec2<S>| in_unit(x, steep);
    let grads = (
        Aabb2 {
            min: times(a_bar.min),
            max: times(a_bar.max),
        },
        Aabb2 {
            min: times(b_bar.min),
            max: times(b_bar.max),
        },
    );
    (value, grads)
}

/// Returns [`score_aabb2_vjp`] for an upstream derivative of at most about one.
///
/// With `h` half the shared size, `I = 4 h_x h_y`; a bound that decides alone takes the whole derivative
/// of its side, tied bounds half each.
#[inline(always)]
pub(crate) fn tame_score_aabb2_vjp<S: Scalar>(
    over: Denominator,
    a: Aabb2<S>,
    b: Aabb2<S>,
    out_bar: S,
) -> (S, (Aabb2<S>, Aabb2<S>)) {
    let Shared {
        half,
        half_a,
        half_b,
        apart,
        scale,
    } = share(a, b);
    // It may be infinite for boxes apart, and no derivative of zero makes that zero.
    let none = |x: S| S::select(apart, S::zero(), x);
    let half = Vec2::new(none(half.x), none(half.y));
    let inter = area_from_half(half);
    let (area_a, area_b) = (area_from_half(half_a), area_from_half(half_b));
    let value = score_of(over, inter, area_a, area_b);
    let areas = score_derivatives(over, value, [inter, area_a, area_b], out_bar);
    let value = in_outer_unit(over, value, scale);
    let unit = match over {
        Denominator::None => S::one().over(scale),
        Denominator::Union | Denominator::First => scale,
    };
    // Twice the unit of the least numbers is beyond the largest.
    let two = (S::lit(2.0) * unit).saturated();
    // Derivatives with respect to a shared bound, and to a box's own bounds; to the caller's unit go their
    // sums, so that what cancels cancels however small it is there.
    let bound_bar = Vec2::new(half.y, half.x) * areas.inter;
    let own_a = own_bound_bar(half_a, areas.own[0]) * areas.falling;
    let own_b = own_bound_bar(half_b, areas.own[1]) * areas.falling;
    let max = Vec2::new(part_taken(a.max.x, b.max.x), part_taken(a.max.y, b.max.y));
    let min = Vec2::new(part_taken(b.min.x, a.min.x), part_taken(b.min.y, a.min.y));
    (
        value.canonical(),
        (
            Aabb2 {
                min: in_unit(-(times(bound_bar, min) + own_a), two),
                max: in_unit(times(bound_bar, max) + own_a, two),
            },
            Aabb2 {
                min: in_unit(-(times(bound_bar, rest(min)) + own_b), two),
                max: in_unit(times(bound_bar, rest(max)) + own_b, two),
            },
        ),
    )
}

/// Returns a box's own derivatives by its bounds, no larger than the largest number.
#[inline(always)]
fn own_bound_bar<S: Scalar>(half: Vec2<S>, own: S) -> Vec2<S> {
    Vec2::new((half.y * own).saturated(), (half.x * own).saturated())
}

/// Returns the part of a bound's derivative that the first of two bounds takes when the smaller one decides.
#[inline(always)]
pub(crate) fn part_taken<S: Scalar>(mine: S, other: S) -> S {
    let won = S::select(mine.below(other), S::one(), S::zero());
    S::select(mine.equals(other), S::lit(0.5), won)
}

/// Returns the product field by field.
#[inline(always)]
fn times<S: Scalar>(x: Vec2<S>, y: Vec2<S>) -> Vec2<S> {
    Vec2::new(x.x * y.x, x.y * y.y)
}

/// Returns `1 - x`, number by number.
#[inline(always)]
fn rest<S: Scalar>(x: Vec2<S>) -> Vec2<S> {
    Vec2::new(S::one() - x.x, S::one() - x.y)
}

/// Returns a bound's derivatives in the caller's unit of length.
#[inline(always)]
fn in_unit<S: Scalar>(x: Vec2<S>, unit: S) -> Vec2<S> {
    Vec2::new((x.x * unit).saturated(), (x.y * unit).saturated()).canonical()
}

/// Both public forms of one score: the macro lists names.
macro_rules! adjoints {
    ($($over:ident: $obb_grad:ident, $obb_vjp:ident of $obb:ident;
       $aabb_grad:ident, $aabb_vjp:ident of $aabb:ident;)*) => { $(
        #[doc = concat!("[`", stringify!($obb), "`](crate::overlap::", stringify!($obb),
            ") and its derivatives with respect to both boxes.")]
        #[must_use]
        #[inline]
        pub fn $obb_grad<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> (S, (Obb2<S>, Obb2<S>)) {
            score_framed_vjp::<S, true>(Denominator::$over, frame(a), frame(b), S::one())
        }
        #[doc = concat!("Adjoint of [`", stringify!($obb), "`](crate::overlap::", stringify!($obb),
            "): `out_bar` times the derivatives with respect to both boxes.")]
        #[must_use]
        #[inline]
        pub fn $obb_vjp<S: Scalar>(a: Obb2<S>, b: Obb2<S>, out_bar: S) -> (Obb2<S>, Obb2<S>) {
            score_framed_vjp::<S, true>(Denominator::$over, frame(a), frame(b), out_bar).1
        }
        #[doc = concat!("[`", stringify!($aabb), "`](crate::overlap::", stringify!($aabb),
            ") and its derivatives with respect to both boxes.")]
        #[must_use]
        #[inline]
        pub fn $aabb_grad<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> (S, (Aabb2<S>, Aabb2<S>)) {
            score_aabb2_vjp(Denominator::$over, a, b, S::one())
        }
        #[doc = concat!("Adjoint of [`", stringify!($aabb), "`](crate::overlap::",
            stringify!($aabb), "): `out_bar` times the derivatives with respect to both boxes.")]
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

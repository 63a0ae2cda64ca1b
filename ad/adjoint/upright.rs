//! Adjoints of the overlap scores of upright boxes.
//!
//! A volume shared is the area `A` shared seen from above times the height `H` shared. Derivatives by `A` and by
//! the boxes' own areas go on to the boxes in the plane (see [`overlap`](super::overlap)); with `h` half the
//! heights and `u` how much higher b's centre is,
//!
//! ```text
//! H = min(h_a, u + h_b) − max(−h_a, u − h_b).
//! ```
//!
//! The top that decides takes the derivative of `H` by it, likewise the bottom; tied ones take half each.
use crate::ad::adjoint::overlap::{
    Grads, bounded, own_bar, reciprocal_or_zero, score_derivatives, score_scaled_vjp, tamed,
};
use crate::clip::area_from_half;
use crate::clip::{Framed, frame};
use crate::overlap::{Denominator, ratio_of_first};
use crate::overlap3::{Heights, Scales, heights, score_of_columns, upright_scales};
use crate::shape::YawBox3;
use crate::{Obb2, Scalar, Vec2, Vec3};

/// An upright box with sine and cosine of its heading: its box seen from above, the height of its middle, and half its
/// height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Upright<S> {
    pub flat: Framed<S>,
    pub standing: [S; 2],
}

/// Computes sine and cosine of a box's heading.
#[inline(always)]
fn upright<S: Scalar>(x: YawBox3<S>) -> Upright<S> {
    Upright {
        flat: frame(x.birds_eye()),
        standing: [x.center.z, x.size.z.halved()],
    }
}

/// Returns `true` where both boxes are one set of points, given by equal numbers.
#[inline(always)]
fn same<S: Scalar>(a: &Upright<S>, b: &Upright<S>) -> S::Mask {
    let (p, q) = (&a.flat, &b.flat);
    (p.center.x.equals(q.center.x) & p.center.y.equals(q.center.y))
        & (p.half.x.equals(q.half.x) & p.half.y.equals(q.half.y))
        & (p.cos.equals(q.cos) & p.sin.equals(q.sin))
        & (a.standing[0].equals(b.standing[0]) & a.standing[1].equals(b.standing[1]))
}

/// The derivatives of a score by the areas and heights of two upright boxes.
struct ScoreDerivatives<S> {
    /// By the area shared, that of a and that of b; the last two without `falling`.
    areas: [S; 3],
    /// By the height shared, that of a and that of b; the last two without `falling`.
    heights: [S; 3],
    /// The last factor of the derivatives by a box's own area and height: for a tiny box and a huge one it is so small
    /// that it would underflow if multiplied earlier.
    falling: S,
}

/// Returns `out_bar` times the derivatives of a score by areas and heights.
#[inline(always)]
fn parts<S: Scalar>(
    over: Denominator,
    value: S,
    [area, area_a, area_b]: [S; 3],
    height: &Heights<S>,
    out_bar: S,
) -> ScoreDerivatives<S> {
    let zero = S::zero();
    match over {
        Denominator::None => ScoreDerivatives {
            areas: [height.shared * out_bar, zero, zero],
            heights: [area * out_bar, zero, zero],
            falling: zero,
        },
        Denominator::Union => {
            let volumes = [area * height.shared, area_a * height.a, area_b * height.b];
            let derivatives = score_derivatives(over, value, volumes, out_bar);
            let (shared, [a, b]) = (derivatives.inter, derivatives.own);
            ScoreDerivatives {
                areas: [shared * height.shared, a * height.a, b * height.b],
                heights: [shared * area, a * area_a, b * area_b],
                falling: derivatives.falling,
            }
        }
        Denominator::First => {
            let flat = ratio_of_first(area, area_a);
            let tall = ratio_of_first(height.shared, height.a);
            let (by_area, by_height) = (
                reciprocal_or_zero(area_a) * out_bar,
                reciprocal_or_zero(height.a) * out_bar,
            );
            ScoreDerivatives {
                areas: [by_area * tall, by_area, zero],
                heights: [by_height * flat, by_height, zero],
                falling: -value,
            }
        }
    }
}

/// Returns the derivative of the smaller of two bounds by the first: one, zero, or half in a tie.
#[inline(always)]
fn part_of_smaller<S: Scalar>(mine: S, other: S) -> S {
    let won = S::select(mine.below(other), S::one(), S::zero());
    S::select(mine.equals(other), S::lit(0.5), won)
}

/// Returns zeros where the mask is true. This is a function, since closures do not inherit instruction sets.
#[inline(always)]
fn unless<S: Scalar>(mask: S::Mask, x: [S; 3]) -> [S; 3] {
    let zero = S::zero();
    [
        S::select(mask, zero, x[0]),
        S::select(mask, zero, x[1]),
        S::select(mask, zero, x[2]),
    ]
}

/// The factors, one after another, that convert derivatives from the pair's units to the caller's.
struct OuterFactors<S> {
    flat: [S; 3],
    tall: [S; 3],
    turn: [S; 3],
    /// The factor taken out of the upstream derivative.
    steep: S,
}

/// Returns a derivative in the caller's units, no larger than the largest number.
#[inline(always)]
fn outer<S: Scalar, const EXTREME: bool>(x: S, by: &[S; 3], steep: S) -> S {
    if !EXTREME {
        return x.canonical();
    }
    let x = (x * by[0]).saturated();
    let x = ((x * by[1]).saturated() * by[2]).saturated();
    (x * steep).saturated().canonical()
}

/// Returns a box's derivatives, from those of the area shared, by that area and by its own (without `falling`), and by
/// its middle and height.
#[inline(always)]
fn box_bar<S: Scalar, const EXTREME: bool>(
    seen: Obb2<S>,
    half: Vec2<S>,
    [by_area, by_own, falling]: [S; 3],
    [z, dz]: [S; 2],
    units: &OuterFactors<S>,
) -> YawBox3<S> {
    let x = bounded::<S, EXTREME>(seen.center.x * by_area);
    let y = bounded::<S, EXTREME>(seen.center.y * by_area);
    let dx = bounded::<S, EXTREME>(seen.size.x * by_area)
        + own_bar::<S, EXTREME>((half.y + half.y) * by_own, falling);
    let dy = bounded::<S, EXTREME>(seen.size.y * by_area)
        + own_bar::<S, EXTREME>((half.x + half.x) * by_own, falling);
    let heading = bounded::<S, EXTREME>(seen.heading * by_area);
    YawBox3 {
        center: Vec3::new(
            outer::<S, EXTREME>(x, &units.flat, units.steep),
            outer::<S, EXTREME>(y, &units.flat, units.steep),
            outer::<S, EXTREME>(z, &units.tall, units.steep),
        ),
        size: Vec3::new(
            outer::<S, EXTREME>(dx, &units.flat, units.steep),
            outer::<S, EXTREME>(dy, &units.flat, units.steep),
            outer::<S, EXTREME>(dz, &units.tall, units.steep),
        ),
        heading: outer::<S, EXTREME>(heading, &units.turn, units.steep),
    }
}

/// Both boxes' derivatives.
pub(crate) type Bars<S> = (YawBox3<S>, YawBox3<S>);

/// Returns the value of a score of upright boxes and `out_bar` times its derivatives, from the area shared seen from
/// above and its derivatives, in units of `1 / scales.flat`.
#[inline(always)]
pub(crate) fn score_from_area_vjp<S: Scalar, const EXTREME: bool>(
    over: Denominator,
    a: &Upright<S>,
    b: &Upright<S>,
    (area, bars): (S, Grads<S>),
    scales: Scales<S>,
    out_bar: S,
) -> (S, Bars<S>) {
    let scale = scales.flat;
    let (zero, one) = (S::zero(), S::one());
    let (half_a, half_b) = (a.flat.half * scale, b.flat.half * scale);
    let areas = [area, area_from_half(half_a), area_from_half(half_b)];
    let height = heights(a.standing, b.standing, scales.tall);
    let value = score_of_columns::<S, EXTREME>(over, areas, scale, &height);
    let (out_bar, steep) = if EXTREME {
        tamed(out_bar)
    } else {
        (out_bar, one)
    };
    let ScoreDerivatives {
        areas,
        heights,
        falling,
    } = parts(over, value, areas, &height, out_bar);
    // The score over the union has derivative zero at identical boxes, by symmetry.
    let flat = match over {
        Denominator::Union => same(a, b),
        _ => one.below(zero),
    };
    let (areas, heights) = (unless(flat, areas), unless(flat, heights));

    let ([at_a, tall_a], [at_b, tall_b]) = (a.standing, b.standing);
    let up = at_b - at_a;
    let nothing = height.shared.at_most(zero);
    let shared_bar = S::select(nothing, zero, heights[0]);
    // The parts of a in the top and in the bottom of the shared height.
    let top = part_of_smaller(tall_a, up + tall_b);
    let bottom = part_of_smaller(up - tall_b, -tall_a);
    let by_up = bottom - top;
    let (by_a, by_b) = (top + bottom, (one - top) + (one - bottom));

    // From the pair's units to the caller's: the derivative of a volume by one length leaves two lengths.
    let (flat_units, tall_units, turn_units) = match over {
        Denominator::None => {
            let (length, tall) = (one.over(scale), one.over(height.scale));
            (
                [length, tall, one],
                [length, length, one],
                [length, tall, length],
            )
        }
        _ => ([scale, one, one], [height.scale, one, one], [one, one, one]),
    };
    let units = OuterFactors {
        flat: flat_units,
        tall: tall_units,
        turn: turn_units,
        steep,
    };
    let z = by_up * shared_bar;
    let (dz_a, dz_b) = (
        (by_a * shared_bar).halved() + own_bar::<S, EXTREME>(heights[1], falling),
        (by_b * shared_bar).halved() + own_bar::<S, EXTREME>(heights[2], falling),
    );
    let (a_bar, b_bar) = (
        box_bar::<S, EXTREME>(
            bars.0,
            half_a,
            [areas[0], areas[1], falling],
            [-z, dz_a],
            &units,
        ),
        box_bar::<S, EXTREME>(
            bars.1,
            half_b,
            [areas[0], areas[2], falling],
            [z, dz_b],
            &units,
        ),
    );
    (value.canonical(), (a_bar, b_bar))
}

/// Returns the value of a score of upright boxes and `out_bar` times its derivatives.
pub(crate) fn score_upright_vjp<S: Scalar>(
    over: Denominator,
    a: YawBox3<S>,
    b: YawBox3<S>,
    out_bar: S,
) -> (S, Bars<S>) {
    let (a, b) = (upright(a), upright(b));
    let scales = upright_scales((a.flat.half, a.standing[1]), (b.flat.half, b.standing[1]));
    let area =
        score_scaled_vjp::<S, true>(Denominator::None, a.flat, b.flat, scales.flat, S::one());
    score_from_area_vjp::<S, true>(over, &a, &b, area, scales, out_bar)
}

/// Returns the volume shared by two upright boxes, and `out_bar` times its derivatives by both.
#[must_use]
#[inline]
pub fn intersection_volume_yaw_vjp<S: Scalar>(
    a: YawBox3<S>,
    b: YawBox3<S>,
    out_bar: S,
) -> (S, Bars<S>) {
    score_upright_vjp(Denominator::None, a, b, out_bar)
}

/// Returns the intersection over union of two upright boxes, and `out_bar` times its derivatives by both.
///
/// ```
/// use geograd::{Vec3, YawBox3, ad::adjoint::upright::iou_yaw_vjp};
/// let car = YawBox3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(4.0, 2.0, 2.0), 0.3_f64);
/// let seen = YawBox3 { center: Vec3::new(0.0, 0.0, 1.0), ..car };
/// let (iou, (by_car, by_seen)) = iou_yaw_vjp(car, seen, 1.0);
/// assert!((iou - 1.0 / 3.0).abs() < 1e-15);
/// // Higher is farther: of the height h both share 2 − h, of 2 + h in all.
/// assert!((by_seen.center.z + 4.0 / 9.0).abs() < 1e-15);
/// assert_eq!(by_car.center.z, -by_seen.center.z);
/// ```
#[must_use]
#[inline]
pub fn iou_yaw_vjp<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>, out_bar: S) -> (S, Bars<S>) {
    score_upright_vjp(Denominator::Union, a, b, out_bar)
}

/// Returns the share of the first upright box that lies in the second, and `out_bar` times its derivatives by both.
#[must_use]
#[inline]
pub fn iof_yaw_vjp<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>, out_bar: S) -> (S, Bars<S>) {
    score_upright_vjp(Denominator::First, a, b, out_bar)
}

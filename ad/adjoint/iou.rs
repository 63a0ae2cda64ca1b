//! Adjoint of generalised IoU of rotated boxes.
//!
//! With `U = A + B − I`, `G = I/U + U/C − 1` has the partial derivatives
//!
//! ```text
//! ∂I = 1/U + I/U² − 1/C        ∂A = ∂B = 1/C − I/U²        ∂C = −U/C²
//! ```
//!
//! The intersection's derivatives are those of [`ad::adjoint::clip`](crate::ad::adjoint::clip). The hull's area is a
//! polynomial with constant weights (see [`iou`](crate::iou)): by the centre of b it has the derivatives `(Y, −X)`, by
//! half the size of a the coefficients of x and y, by each number of b's arms its coefficient. The arms are half the
//! size of b times cosine and sine of its turn, whose derivative takes `p_x` to `−p_y`, `p_y` to `p_x`, and the
//! magnitudes of `q_x` and `q_y` to `q_y` and `−q_x`.
use crate::ad::adjoint::clip::{Derivatives, clipped_area_derivatives};
use crate::ad::adjoint::overlap::tamed;
use crate::clip::area_from_half;
use crate::clip::{
    Framed, Relative, clip, clipped_area, frame, nothing_shared, relate, related_area,
};
use crate::iou::{HullOfBoxes, hull_of_related, hull_scale};
use crate::{Obb2, Scalar, Vec2};

// Functions, not closures: those do not inherit instruction sets.

/// Returns one over a number, or zero for one so small that it counts as none.
#[inline(always)]
fn per<S: Scalar>(x: S) -> S {
    let (zero, one) = (S::zero(), S::one());
    let empty = x.at_most(S::lit(S::format().empty()));
    S::select(empty, zero, one.over(S::select(empty, one, x)))
}
/// Returns a term so far below the largest number that a sum of some of them is one.
#[inline(always)]
fn bounded<S: Scalar, const EXTREME: bool>(x: S) -> S {
    let most = S::lit(S::format().largest() / 16.0);
    if EXTREME { x.clamp(-most, most) } else { x }
}

/// Returns the factor of the derivatives of both areas, and a box's own area.
struct Bars<S: Scalar> {
    nothing: S::Mask,
    inter: S,
    hull: S,
    own: S,
    gained: S,
    lost: S,
}

impl<S: Scalar> Bars<S> {
    /// Returns the derivative with respect to a number: the parts by both areas plus the part by its own box's area.
    #[inline(always)]
    fn sum<const EXTREME: bool>(&self, shared: S, around: S, own_area: S) -> S {
        let x = S::select(self.nothing, S::zero(), shared);
        let outside =
            bounded::<S, EXTREME>(x * self.inter) + bounded::<S, EXTREME>(around * self.hull);
        (outside + bounded::<S, EXTREME>(self.own * own_area))
            + (bounded::<S, EXTREME>(x * self.gained) + bounded::<S, EXTREME>(self.lost * own_area))
    }
    /// Returns the derivative by a size. A box's own area is four times the product of its halves, a size twice a half.
    #[inline(always)]
    fn size<const EXTREME: bool>(
        &self,
        shared: Vec2<S>,
        around: Vec2<S>,
        half: Vec2<S>,
    ) -> Vec2<S> {
        let four = S::lit(4.0);
        Vec2::new(
            self.sum::<EXTREME>(shared.x, around.x, four * half.y)
                .halved(),
            self.sum::<EXTREME>(shared.y, around.y, four * half.x)
                .halved(),
        )
    }
}

/// Multiplies a derivative by the factor that was taken from the upstream derivative, up to the largest number.
#[inline(always)]
fn outer<S: Scalar, const EXTREME: bool>(x: S, steep: S) -> S {
    if EXTREME {
        (x.saturated() * steep).saturated().canonical()
    } else {
        x.canonical()
    }
}

/// Returns a box's derivatives in the caller's unit.
#[inline(always)]
fn finished<S: Scalar, const EXTREME: bool>(
    center: Vec2<S>,
    size: Vec2<S>,
    heading: S,
    [scale, steep]: [S; 2],
) -> Obb2<S> {
    let size = size * scale;
    Obb2 {
        center: Vec2::new(
            outer::<S, EXTREME>(center.x, steep),
            outer::<S, EXTREME>(center.y, steep),
        ),
        size: Vec2::new(
            outer::<S, EXTREME>(size.x, steep),
            outer::<S, EXTREME>(size.y, steep),
        ),
        heading: outer::<S, EXTREME>(heading, steep),
    }
}

/// Returns the derivatives of the area of the hull of a related pair, in a's frame and the pair's units.
#[must_use]
#[inline(always)]
pub(crate) fn hull_derivatives<S: Scalar>(
    pair: &Relative<S>,
    hull: &HullOfBoxes<S>,
) -> Derivatives<S> {
    let (a, b, c, turn) = (hull.half_a, hull.half_b, hull.center, hull.turn);
    let ([px, py, qx, qy], gaps) = (hull.arms, hull.gaps);
    let (across, beside) = (hull.across(), hull.beside());
    // By each number of the arms.
    let p = Vec2::new(
        a.y * gaps[3] - c.y * hull.lean_b.y,
        c.x * hull.lean_b.y - a.x * gaps[2],
    );
    let q = Vec2::new(
        -(a.y * gaps[0] + c.y * hull.lean_b.x),
        a.x * gaps[1] - c.x * hull.lean_b.x,
    );
    let half_b = Vec2::new(
        b.y * hull.sides[1] + (turn.x * p.x + turn.y * p.y),
        b.x * hull.sides[1] + (turn.y * q.x + turn.x * q.y),
    );
    let heading = (px * p.y - py * p.x) + (qy * q.x - qx * q.y);
    Derivatives {
        u: across.y,
        v: S::select(hull.mirrored, across.x, -across.x),
        heading: S::select(hull.mirrored, -heading, heading),
        half_a: Vec2::new(
            (a.y * hull.sides[0] + beside.x) - c.y * hull.lean_a.y,
            (a.x * hull.sides[0] + beside.y) - c.x * hull.lean_a.x,
        ),
        half_b: Vec2::new(
            S::select(pair.swapped, half_b.y, half_b.x),
            S::select(pair.swapped, half_b.x, half_b.y),
        ),
    }
}

/// Returns the value of the generalised IoU of two boxes whose sine and cosine are known, and `out_bar` times its
/// derivatives. `EXTREME` says that sizes may be so small or large that products over- or underflow.
#[must_use]
#[inline(always)]
pub(crate) fn giou_framed_vjp<S: Scalar, const EXTREME: bool>(
    a: Framed<S>,
    b: Framed<S>,
    out_bar: S,
) -> (S, (Obb2<S>, Obb2<S>)) {
    let (zero, one) = (S::zero(), S::one());
    let scale = if EXTREME { hull_scale(&a, &b) } else { one };
    let (out_bar, steep) = if EXTREME {
        tamed(out_bar)
    } else {
        (out_bar, one)
    };
    let pair = relate::<S, EXTREME>(a, b, scale);
    let clip = clip(pair);
    let area = clipped_area(&clip);
    let inter = related_area(&pair, area);
    let nothing = nothing_shared(&pair, area);
    let hull = hull_of_related(&pair);
    let half_b = b.half * scale;
    let (area_a, area_b) = (area_from_half(pair.half_a), area_from_half(half_b));
    let hull_area = hull.area();
    let value = crate::iou::score(inter, area_a, area_b, hull_area).canonical();

    let union = area_a + area_b - inter;
    let short = hull_area.below(union);
    let hull_area = S::select(short, union, hull_area);
    let (per_union, per_hull) = (per(union), per(hull_area));
    // I/U − 1 + U/H term by term: where a small box is inside a large one, all of the second cancels,
    // and in a common sum the first would be lost.
    let lost = -(inter * per_union * per_union * out_bar);
    let own = per_hull * out_bar;
    // Exactly one where one box holds the other, so that of what cancels nothing is left.
    let filled = S::select(hull_area.equals(union), one, union * per_hull);
    let bars = Bars {
        nothing,
        inter: S::select(nothing, zero, -own),
        hull: -(filled * own),
        own,
        gained: S::select(nothing, zero, per_union * out_bar - lost),
        lost,
    };

    let (shared, around) = (
        clipped_area_derivatives(&pair, &clip),
        hull_derivatives(&pair, &hull),
    );
    let u_bar = bars.sum::<EXTREME>(shared.u, around.u, zero);
    let v_bar = bars.sum::<EXTREME>(shared.v, around.v, zero);
    let heading_bar = bars.sum::<EXTREME>(shared.heading, around.heading, zero);
    let turn_bar = heading_bar
        + (bounded::<S, EXTREME>(pair.u * v_bar) - bounded::<S, EXTREME>(pair.v * u_bar));
    let center_bar =
        Vec2::new(a.cos * u_bar - a.sin * v_bar, a.sin * u_bar + a.cos * v_bar) * scale;
    let size_a = bars.size::<EXTREME>(shared.half_a, around.half_a, pair.half_a);
    let size_b = bars.size::<EXTREME>(shared.half_b, around.half_b, half_b);
    (
        value,
        (
            finished::<S, EXTREME>(-center_bar, size_a, -turn_bar, [scale, steep]),
            finished::<S, EXTREME>(center_bar, size_b, heading_bar, [scale, steep]),
        ),
    )
}

/// Returns [`giou_obb2`](crate::iou::giou_obb2) and its derivatives with respect to both boxes.
#[must_use]
#[inline]
pub fn giou_obb2_grad<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> (S, (Obb2<S>, Obb2<S>)) {
    giou_framed_vjp::<S, true>(frame(a), frame(b), S::one())
}

/// Returns `out_bar` times the derivatives of [`giou_obb2`](crate::iou::giou_obb2) with respect to both boxes.
/// Derivation: see the [module](self).
#[must_use]
#[inline]
pub fn giou_obb2_vjp<S: Scalar>(a: Obb2<S>, b: Obb2<S>, out_bar: S) -> (Obb2<S>, Obb2<S>) {
    giou_framed_vjp::<S, true>(frame(a), frame(b), out_bar).1
}

//! Adjoint of the area that two convex quadrilaterals share, by the motion of its border.
//!
//! When corners move, the area changes by the integral of the normal velocity over the part of either border inside the
//! other shape (Reynolds' transport theorem, as in [`overlap_polygon`](super::overlap_polygon)): of every side the part
//! from `s` to `t`, as fractions of it. A side is cut by the four lines of the other shape (Cyrus and Beck). The lines
//! of sides `f` of a and `g` of b meet at
//!
//! ```text
//! s = (g × (f₀ − g₀)) / (f × g),     t = (f × (g₀ − f₀)) / −(f × g)
//! ```
//!
//! of either, so that there is one division for both; all products are known from measuring the area. The sign of
//! `f × g` decides which side leaves the other shape there and which one enters. Parallel lines meet far away, and
//! fractions beyond a side mean that all or nothing of it is inside. No corner of the shared area is computed, and none
//! is differentiated, so nearly parallel sides are harmless.
//!
//! Sides that lie along each other count half each.
use crate::ad::adjoint::overlap::tamed;
use crate::overlap_polygon::{QuadPair, TINY, choose_quad, swapped};
use crate::{Scalar, Vec2};

/// Two quadrilaterals, or a cotangent of each.
type Quads<S> = ([Vec2<S>; 4], [Vec2<S>; 4]);

/// The part of a side that is inside, from one fraction of it to another, and its weight.
#[derive(Clone, Copy)]
struct EdgePart<S> {
    from: S,
    to: S,
    weight: S,
}

/// Returns `true` where two corners are apart.
#[inline(always)]
fn is_side<S: Scalar>(from: Vec2<S>, to: Vec2<S>) -> S::Mask {
    !(from.x.equals(to.x) & from.y.equals(to.y))
}

/// Adds the cotangent of a part of a side that moves to both ends.
#[inline(always)]
fn pull<S: Scalar>(corners: &[Vec2<S>; 4], k: usize, part: EdgePart<S>, bars: &mut [Vec2<S>; 4]) {
    let next = (k + 1) % 4;
    let along = corners[next] - corners[k];
    let length = (part.to - part.from).most(S::zero()) * part.weight;
    let to_end = (length * (part.to + part.from)).halved();
    let to_start = length - to_end;
    bars[k] += Vec2::new(along.y * to_start, -(along.x * to_start));
    bars[next] += Vec2::new(along.y * to_end, -(along.x * to_end));
}

/// Returns the derivatives of the area in the units of a pair.
#[inline(always)]
fn derivatives<S: Scalar>(pair: &QuadPair<S>) -> Quads<S> {
    let (zero, one, half) = (S::zero(), S::one(), S::lit(0.5));
    // Two sides whose product is no larger count as parallel; its reciprocal is finite, times any fraction of
    // a side that is not parallel.
    let tiny = S::lit(TINY * S::format().empty());
    let whole = EdgePart {
        from: zero,
        to: one,
        weight: one,
    };
    let (mut a_bar, mut b_bar) = ([Vec2::zero(); 4], [Vec2::zero(); 4]);
    let mut of_b = [whole; 4];
    let mut is_side_b = [one.below(zero); 4];
    let mut k = 0;
    while k < 4 {
        is_side_b[k] = is_side(pair.to[k], pair.to[(k + 1) % 4]);
        k += 1;
    }
    k = 0;
    while k < 4 {
        let next = (k + 1) % 4;
        let is_side_a = is_side(pair.at[k], pair.at[next]);
        let mut of_a = whole;
        let mut i = 0;
        while i < 4 {
            let (start, end) = (pair.left_of_b[i][k], pair.left_of_b[i][next]);
            let turn = start - end;
            let parallel = turn.unsigned().at_most(tiny);
            // Parallel lines meet far away, in front or behind.
            let per = one.over(S::select(parallel, tiny, turn));
            let along = parallel & start.unsigned().at_most(tiny);
            let (s, t) = (start * per, -(pair.left_of_a[k][i] * per));
            let t = S::select(along, zero, t);
            // The side of b comes into a at the point at which the side of a leaves b to the right.
            let leaves = per.above(zero);
            let s_leaves = S::select(leaves & !along, s, one);
            let s_enters = S::select(leaves, zero, s);
            of_a.to = of_a.to.least(s_leaves);
            of_a.from = of_a.from.most(s_enters);
            of_b[i].from = of_b[i].from.most(S::select(leaves, t, zero));
            of_b[i].to = of_b[i].to.least(S::select(leaves, one, t));
            of_a.weight = S::select(along & is_side_b[i], half, of_a.weight);
            of_b[i].weight = S::select(along & is_side_a, half, of_b[i].weight);
            i += 1;
        }
        pull(&pair.at, k, of_a, &mut a_bar);
        k += 1;
    }
    k = 0;
    while k < 4 {
        pull(&pair.to, k, of_b[k], &mut b_bar);
        k += 1;
    }
    // The corners as they were given.
    let [of_a, of_b] = pair.turned;
    (swapped(of_a, a_bar), swapped(of_b, b_bar))
}

/// Multiplies a derivative by factors one after another; with `EXTREME` each product is clamped to the largest number.
#[inline(always)]
fn outer<S: Scalar, const EXTREME: bool>(x: S, [bar, unit, steep]: [S; 3]) -> S {
    let x = if EXTREME {
        (((x * bar).saturated() * unit).saturated() * steep).saturated()
    } else {
        (x * bar) * unit
    };
    x.canonical()
}

/// Returns the area that two quadrilaterals share, and `out_bar` times its derivatives. `EXTREME` allows coordinates
/// and `out_bar` so large that products overflow; the bits are equal for ordinary ones.
#[inline(always)]
pub(crate) fn area_of_quads_vjp<S: Scalar, const EXTREME: bool>(
    a: [Vec2<S>; 4],
    b: [Vec2<S>; 4],
    out_bar: S,
) -> (S, Quads<S>) {
    let zero = S::zero();
    let pair = QuadPair::new(a, b);
    let area = pair.outer_area();
    let (of_first, of_second) = derivatives(&pair);
    let (mut a_bar, mut b_bar) = (
        choose_quad(pair.exchanged, of_second, of_first),
        choose_quad(pair.exchanged, of_first, of_second),
    );
    // Lengths were halved and scaled; what saturates has no derivatives.
    let nothing = pair.nothing | area.above(S::lit(S::format().largest()));
    let out_bar = S::select(nothing, zero, out_bar);
    let (out_bar, steep) = if EXTREME {
        tamed(out_bar)
    } else {
        (out_bar, S::one())
    };
    let by = [out_bar + out_bar, S::one().over(pair.scale), steep];
    let mut k = 0;
    while k < 4 {
        a_bar[k] = Vec2::new(
            outer::<S, EXTREME>(a_bar[k].x, by),
            outer::<S, EXTREME>(a_bar[k].y, by),
        );
        b_bar[k] = Vec2::new(
            outer::<S, EXTREME>(b_bar[k].x, by),
            outer::<S, EXTREME>(b_bar[k].y, by),
        );
        k += 1;
    }
    (area.saturated().canonical(), (a_bar, b_bar))
}

/// Returns [`intersection_area_quads`](crate::overlap_polygon::intersection_area_quads) and `out_bar` times its
/// derivatives with respect to all corners. They are finite; those too steep for the format are its largest number.
/// Derivation: see the [module](self).
///
/// ```
/// use geograd::{Aabb2, ad::adjoint::overlap_quad::intersection_area_quads_vjp};
/// let a = Aabb2::new(0.0, 0.0, 2.0, 2.0).corners();
/// let b = Aabb2::new(1.0, 1.0, 3.0, 4.0).corners();
/// let (area, (a_bar, _)) = intersection_area_quads_vjp(a, b, 1.0);
/// assert_eq!(area, 1.0);
/// // Moving the upper right corner of a to the right moves its right side, of which the upper half counts.
/// assert_eq!(a_bar[2].x, 0.75);
/// ```
#[must_use]
#[inline(always)]
pub fn intersection_area_quads_vjp<S: Scalar>(
    a: [Vec2<S>; 4],
    b: [Vec2<S>; 4],
    out_bar: S,
) -> (S, Quads<S>) {
    area_of_quads_vjp::<S, true>(a, b, out_bar)
}

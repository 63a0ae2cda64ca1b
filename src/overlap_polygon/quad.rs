//! The area that two convex quadrilaterals share: a short straight line for hot loops.
//!
//! # The method
//!
//! Quadrilateral b is two triangles with a common corner. For one of them let X and Y be twice the areas of
//! the triangles that a point makes with two of its sides, and D that of all three: oblique coordinates in
//! which the triangle is `X ≥ 0, Y ≥ 0, X + Y ≤ D`. Clamping Y to `[0, D]` and then X to `[0, D − Y]` is
//! continuous, fixes the triangle and sends everything outside to its border, so, as for boxes (see
//! [`clip`](crate::clip)),
//!
//! ```text
//! D · area(a ∩ triangle) = ∮ X dY  over the clamped border of a.
//! ```
//!
//! Along an edge of a, between the heights at which it enters and leaves the strip, the clamped X is
//! `max(X, 0) − max(X + Y − D, 0)`, and the mean of the positive part of a linear function with values
//! p and q at its ends is `½ (p⁺ + q⁺) (p⁺ − q⁺) / (p − q)`. Nothing is sorted and there are no cases; the sum
//! is continuous in every vertex.
use crate::error::{Flaw, Validate, VertexFault};
use crate::{Scalar, Vec2};

/// Returns twice the mean of the positive part of a linear function between two values: the square of the sum of their
/// positive parts over the sum of their magnitudes.
#[inline(always)]
fn positive<S: Scalar>(start: S, end: S) -> S {
    let zero = S::zero();
    let part = start.most(zero) + end.most(zero);
    let (all, empty) = (
        start.magnitude() + end.magnitude(),
        S::lit(S::format().empty()),
    );
    // An empty part has the derivative zero: divided by so little, that of a small shape would overflow.
    let (none, some) = (S::Primal::zero(), S::Primal::one());
    let share = part.damp(S::Primal::select(all.at_most(empty), none, some));
    part * share.over(all.most(empty))
}

/// Returns the area that a ring shares with a triangle, from oblique coordinates.
#[inline(always)]
fn in_triangle<S: Scalar>(x: [S; 4], y: [S; 4], all: S) -> S {
    let (zero, one) = (S::zero(), S::one());
    let mut low = [zero; 4];
    let mut moved = [zero; 4];
    let mut k = 0;
    while k < 4 {
        low[k] = y[k].clamp(zero, all.most(zero));
        moved[k] = low[k] - y[k];
        k += 1;
    }
    let mut twice = zero;
    k = 0;
    while k < 4 {
        let next = (k + 1) % 4;
        let rise = y[next] - y[k];
        // A rise this small adds nothing for any derivative, and its reciprocal may be infinite.
        let level = rise.unsigned().at_most(S::lit(TINY * S::format().empty()));
        let derivative = (x[next] - x[k]).over(S::select(level, one, rise));
        let (start, end) = (
            x[k] + moved[k] * derivative,
            x[next] + moved[next] * derivative,
        );
        let beyond = positive((start + low[k]) - all, (end + low[next]) - all);
        twice += (low[next] - low[k]) * (positive(start, end) - beyond);
        k += 1;
    }
    // A triangle without an area has no strip.
    let empty = S::lit(S::format().empty());
    let twice = S::select(all.at_most(empty), zero, twice);
    twice.over(all.most(empty)).halved()
}

// Functions, not closures: those do not inherit instruction sets.

#[inline(always)]
fn half<S: Scalar>(v: Vec2<S>) -> Vec2<S> {
    Vec2::new(v.x.halved(), v.y.halved())
}
#[inline(always)]
fn against<S: Scalar>(x: [S; 4]) -> [S; 4] {
    [-x[0], -x[1], -x[2], -x[3]]
}
/// Returns twice the signed areas of corners to the left of the side between the ends of two vectors, from those to the
/// left of either vector.
#[inline(always)]
fn far<S: Scalar>(of: [S; 4], to: [S; 4], all: S) -> [S; 4] {
    let mut side = [S::zero(); 4];
    let mut k = 0;
    while k < 4 {
        side[k] = (all - of[k]) + to[k];
        k += 1;
    }
    side
}
/// Returns `true` where a side has all corners on its right or on itself.
#[inline(always)]
fn separates<S: Scalar>(side: [S; 4], along: Vec2<S>) -> S::Mask {
    let zero = S::zero();
    let is_side = !(along.x.equals(zero) & along.y.equals(zero));
    let right = S::from_primal(most_of(side)).at_most(zero);
    is_side & right
}
// One comparison instead of four: masks have fewer units than numbers.
#[inline(always)]
fn most_of<S: Scalar>(x: [S; 4]) -> S::Primal {
    let x = [x[0].primal(), x[1].primal(), x[2].primal(), x[3].primal()];
    x[0].most(x[1]).most(x[2].most(x[3]))
}
#[inline(always)]
fn least_of<S: Scalar>(x: [S; 4]) -> S::Primal {
    let x = [x[0].primal(), x[1].primal(), x[2].primal(), x[3].primal()];
    x[0].least(x[1]).least(x[2].least(x[3]))
}

/// Two quadrilaterals, relative to a corner of b in units of the larger one.
pub(crate) struct QuadPair<S: Scalar> {
    /// The corners of a and of b (where they are exchanged: of b and of a), half as far from the first one of b,
    /// times `scale`.
    pub at: [Vec2<S>; 4],
    pub to: [Vec2<S>; 4],
    /// The distance of every corner of a to the left of each side of b, times the side's length: by sides.
    pub left_of_b: [[S; 4]; 4],
    /// The distance of every corner of b to the left of each side of a, times the side's length: by sides.
    pub left_of_a: [[S; 4]; 4],
    /// The area that they share: zero, without a derivative, where nothing is.
    pub area: S,
    /// `true` where nothing is shared.
    pub nothing: S::Mask,
    /// `true` where a and b are exchanged: b is the smaller one, since heights over sides that are much longer
    /// than the measured shape lose its digits.
    pub exchanged: S::Mask,
    /// `true` where the corners `at`, and `to`, came clockwise: the second and the fourth of them are exchanged.
    pub turned: [S::Mask; 2],
    /// The power of two.
    pub scale: S,
}

/// The multiple of [`Format::empty`](crate::scalar::Format::empty) that counts as nothing, in units in which the larger quadrilateral has a size of
/// about one.
pub(crate) const TINY: f64 = 1e6;

/// Returns the largest absolute coordinate of the vectors from the first corner to the others.
#[inline(always)]
fn reach<S: Scalar>(ways: &[Vec2<S>; 4]) -> S {
    let mut reach = ways[1].x.unsigned().most(ways[1].y.unsigned());
    let mut k = 2;
    while k < 4 {
        reach = reach.most(ways[k].x.unsigned().most(ways[k].y.unsigned()));
        k += 1;
    }
    reach
}

/// Returns the first quadrilateral where the mask is true, else the second.
#[inline(always)]
pub(crate) fn choose_quad<S: Scalar>(
    mask: S::Mask,
    yes: [Vec2<S>; 4],
    no: [Vec2<S>; 4],
) -> [Vec2<S>; 4] {
    [
        Vec2::select(mask, yes[0], no[0]),
        Vec2::select(mask, yes[1], no[1]),
        Vec2::select(mask, yes[2], no[2]),
        Vec2::select(mask, yes[3], no[3]),
    ]
}

/// Returns a quadrilateral counter-clockwise, and whether it was not: by the cross product of its diagonals, twice its
/// area.
#[inline(always)]
fn counter_clockwise<S: Scalar>(q: [Vec2<S>; 4]) -> ([Vec2<S>; 4], S::Mask) {
    let twice = (q[2] - q[0]).perp_dot(q[3] - q[1]);
    let clockwise = S::from_primal(twice.primal()).below(S::zero());
    (swapped(clockwise, q), clockwise)
}

/// Exchanges the second and the fourth of four vectors where the mask is true.
#[inline(always)]
pub(crate) fn swapped<S: Scalar>(mask: S::Mask, q: [Vec2<S>; 4]) -> [Vec2<S>; 4] {
    choose_quad(mask, [q[0], q[3], q[2], q[1]], q)
}

/// Returns `true` for a convex quadrilateral in either order: no corner turns to the other side by more than
/// coordinates round. One with repeated corners or without an area is one, too.
#[inline(always)]
pub(crate) fn is_convex<S: Scalar>(q: [Vec2<S>; 4]) -> S::Mask {
    let (least, most) = turns(q);
    least.at_least(S::zero()) | most.at_most(S::zero())
}

/// Returns the least turn of the corners of a quadrilateral and the greatest one; a turn that is due to rounding is
/// none.
#[inline(always)]
fn turns<S: Scalar>(q: [Vec2<S>; 4]) -> (S, S) {
    let (mut least, mut most) = (S::zero(), S::zero());
    let mut k = 0;
    while k < 4 {
        let turn = turn_of(q, k);
        (least, most) = (least.least(turn), most.most(turn));
        k += 1;
    }
    (least, most)
}

/// Returns the size of a vector, up to a factor.
#[inline(always)]
fn size<S: Scalar>(v: Vec2<S>) -> S {
    v.x.unsigned() + v.y.unsigned()
}

/// Returns the turn at a corner: the cross product of the sides there, 0 where coordinates round by as much.
#[inline(always)]
fn turn_of<S: Scalar>(q: [Vec2<S>; 4], k: usize) -> S {
    let far = size(q[0])
        .most(size(q[1]))
        .most(size(q[2]).most(size(q[3])));
    let (side, next) = (q[k] - q[(k + 3) % 4], q[(k + 1) % 4] - q[k]);
    let turn = side.perp_dot(next);
    let rounding = far * (size(side) + size(next)) * S::rounding(8.0, 1);
    S::select(turn.unsigned().at_most(rounding), S::zero(), turn)
}

/// Checks that the corners of a quadrilateral are finite and convex, in either orientation.
pub(crate) fn check_quad<S: Scalar<Mask = bool>>(q: [Vec2<S>; 4]) -> Result<(), Flaw> {
    q.validate()?;
    // In a unit in which no product overflows.
    let size = q.iter().fold(S::zero(), |size, v| {
        size.most(v.x.unsigned()).most(v.y.unsigned())
    });
    if size.at_most(S::zero()) {
        return Ok(());
    }
    let unit = size.binade();
    let q = q.map(|v| v * unit);
    let (least, most) = turns(q);
    if least.at_least(S::zero()) || most.at_most(S::zero()) {
        return Ok(());
    }
    // The corner that turns unlike most: of two and two one that turns clockwise.
    let count = |side: fn(S) -> bool| (0..4).filter(|&k| side(turn_of(q, k))).count();
    let left = count(|turn| turn.above(S::zero()));
    let right = count(|turn| turn.below(S::zero()));
    let is_odd = |k: &usize| match left < right {
        true => turn_of(q, *k).above(S::zero()),
        false => turn_of(q, *k).below(S::zero()),
    };
    Err(Flaw::Vertex {
        index: (0..4).find(is_odd).unwrap_or(0),
        fault: VertexFault::NotConvex,
    })
}

impl<S: Scalar> QuadPair<S> {
    /// Measures two quadrilaterals.
    #[inline(always)]
    pub fn new(a: [Vec2<S>; 4], b: [Vec2<S>; 4]) -> Self {
        let zero = S::zero();
        // Halved first, so that a difference of huge numbers is finite, and relative to a corner of b.
        let (mut at, mut to) = ([Vec2::zero(); 4], [Vec2::zero(); 4]);
        let mut ways = [Vec2::zero(); 4];
        let mut k = 0;
        while k < 4 {
            ways[k] = half(a[k]) - half(a[0]);
            to[k] = half(b[k]) - half(b[0]);
            k += 1;
        }
        let (reach_a, reach_b) = (reach(&ways), reach(&to));
        let exchanged = reach_a.below(reach_b);
        let origin = Vec2::select(exchanged, half(a[0]), half(b[0]));
        let mut size = S::select(exchanged, reach_a, reach_b);
        k = 0;
        while k < 4 {
            to[k] = Vec2::select(exchanged, ways[k], to[k]);
            at[k] = Vec2::select(exchanged, half(b[k]), half(a[k])) - origin;
            size = size.most(at[k].x.unsigned().most(at[k].y.unsigned()));
            k += 1;
        }
        // A power of two that brings the larger one near one, so that nothing overflows.
        let size = S::from_primal(size.primal());
        let point = size.at_most(zero);
        let scale = S::select(point, S::one(), S::select(point, S::one(), size).binade());
        k = 0;
        while k < 4 {
            (at[k], to[k]) = (at[k] * scale, to[k] * scale);
            k += 1;
        }
        let ((at, at_turned), (to, to_turned)) = (counter_clockwise(at), counter_clockwise(to));

        // The cross products of every corner of a with the vectors from the first corner of b to the others.
        let mut cross = [[zero; 4]; 4];
        k = 0;
        while k < 4 {
            let mut i = 1;
            while i < 4 {
                cross[i][k] = to[i].perp_dot(at[k]);
                i += 1;
            }
            k += 1;
        }
        let (first, second) = (to[1].perp_dot(to[2]), to[2].perp_dot(to[3]));
        let area = in_triangle(against(cross[2]), cross[1], first)
            + in_triangle(against(cross[3]), cross[2], second);

        // A side with all of the other on its right or on itself separates them.
        let mut own = zero;
        let mut inside = S::Primal::one();
        let mut apart = S::one().below(zero);
        let mut left_of_a = [[zero; 4]; 4];
        k = 0;
        while k < 4 {
            let next = (k + 1) % 4;
            let corner = at[k].perp_dot(at[next]);
            own += corner;
            // Corners of b relative to edge k of a.
            let mut i = 0;
            while i < 4 {
                left_of_a[k][i] = corner + (cross[i][k] - cross[i][next]);
                i += 1;
            }
            // A side without a length has zeros only.
            let (most, least) = (most_of(left_of_a[k]), least_of(left_of_a[k]));
            inside = inside.least(least);
            let (most, least) = (S::from_primal(most), S::from_primal(least));
            apart = apart | most.at_most(zero) & least.below(zero);
            k += 1;
        }
        let left_of_b = [
            cross[1],
            far(cross[1], cross[2], first),
            far(cross[2], cross[3], second),
            against(cross[3]),
        ];
        let apart = apart
            | separates(left_of_b[0], to[1])
            | separates(left_of_b[1], to[2] - to[1])
            | separates(left_of_b[2], to[3] - to[2])
            | separates(left_of_b[3], to[3]);

        // If every corner is clear of a's sides, b shares its whole area. The integral over the border of an a of
        // R times its size would give that to R roundings. A nearer corner is a kink, which the integral finds.
        let whole = (first + second).halved();
        let inside = S::from_primal(inside).above(S::rounding(64.0, 1));
        let area = S::select(inside, whole, area);
        let limit = own.halved().primal().least(whole.primal());
        let beyond = area.above(S::from_primal(limit));
        let area = S::select(beyond, area.with_primal(limit), area);
        let nothing = apart | area.at_most(zero);
        QuadPair {
            at,
            to,
            left_of_b,
            left_of_a,
            area: S::select(nothing, zero, area),
            nothing,
            exchanged,
            turned: [at_turned, to_turned],
            scale,
        }
    }
    /// Returns the area in the caller's unit; infinite where that is too small.
    #[inline(always)]
    pub fn outer_area(&self) -> S {
        // Twice for each length, which was halved.
        let area = (self.area + self.area).over(self.scale);
        (area + area).over(self.scale)
    }
}

/// Returns the area shared by two convex quadrilaterals, each in either order, from 0 to the area of the smaller one,
/// in squared units of length. Exactly zero, with derivative zero, where they are apart or merely touch; saturates at
/// the largest finite number. Repeated and collinear vertices are fine.
///
/// A quadrilateral that is not convex has a finite result without a meaning, and is an error in batches. Right to a few
/// roundings of the smaller area if sizes are alike or one contains the other. Right to about R of them if one is R
/// times longer and reaches across the other's border.
///
/// Kinks: edges lying along each other, which share the derivative half and half, and repeated corners. These are at the
/// border of the convex quadrilaterals: the sum of their derivatives is that of one corner, which duals divide between
/// them otherwise than the [derivative by hand](crate::ad::adjoint::overlap_quad).
///
/// ```
/// use geograd::{Aabb2, overlap_polygon::intersection_area_quads};
/// let a = Aabb2::new(0.0, 0.0, 2.0, 2.0).corners();
/// let b = Aabb2::new(1.0, 1.0, 3.0, 4.0).corners();
/// assert_eq!(intersection_area_quads(a, b), 1.0);
/// assert_eq!(intersection_area_quads(a, a), 4.0);
/// assert_eq!(intersection_area_quads([a[3], a[2], a[1], a[0]], b), 1.0);
/// ```
#[must_use]
#[inline(always)]
pub fn intersection_area_quads<S: Scalar>(a: [Vec2<S>; 4], b: [Vec2<S>; 4]) -> S {
    QuadPair::new(a, b).outer_area().saturated().canonical()
}

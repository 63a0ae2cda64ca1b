//! Distances of two rotated boxes, in the frame of one of them.
use super::cores::{BoxCore, Upright, faces_deep};
use super::edge::{direction, scale_of, size_of};
use super::outcome::{Contact, PointPair};
use super::relation::{Relation, joined};
use super::share::{Best, Deepest, Nearest};
use crate::arrays::Each;
use crate::clip::{Relative, frame, relate};
use crate::{Obb2, Rotation2, Scalar, Vec2};

/// Returns the relation of b to a in a's frame, the frame's rotation, and the scale that brings both to a size near
/// one.
///
/// Centres are subtracted before anything is turned, and headings before anything is compared: nearly parallel faces
/// are distinguished by the sine of the angle between them, not by coordinates that it was added to.
#[inline(always)]
fn seen<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> (Relative<S>, Rotation2<S>, S) {
    let (own, other) = (frame(a), frame(b));
    let extent = |half: Vec2<S>| half.x.primal() + half.y.primal();
    let size = (size_of(b.center - a.center) + extent(other.half)).most(extent(own.half));
    let scale = scale_of::<S>(size);
    let turn = Rotation2 {
        cos: own.cos,
        sin: own.sin,
    };
    (relate::<S, true>(own, other, scale), turn, scale)
}

/// The two directions along an axis: forwards (1) and backwards (−1).
const SIGNS: [bool; 2] = [false, true];
const CORNERS: [[bool; 2]; 4] = [[false, false], [true, false], [true, true], [false, true]];

/// Returns a number, negated if `negative` holds.
#[inline(always)]
fn signed<S: Scalar>(negative: bool, x: S) -> S {
    if negative { -x } else { x }
}

/// Returns one minus the cosine, by the sine: the cosine of a small angle rounds to one.
#[inline(always)]
fn short<S: Scalar>(pair: &Relative<S>) -> S {
    (pair.sin * pair.sin).over(S::one() + pair.cos)
}

/// Returns the length by which `first + last` is beyond `half` on either side, zero between. The large `half` and
/// `first` are subtracted before the small `last` is added.
#[inline(always)]
fn beyond<S: Scalar>(first: S, last: S, half: S) -> S {
    let zero = S::zero();
    let left = (first + last).below(zero);
    let by = S::select(left, first + half, first - half) + last;
    let out = left & by.below(zero) | !left & by.above(zero);
    S::select(out, by, zero)
}

/// Returns the corner of b that is nearest to a, or the corner of a that is nearest to b, and the direction from a to
/// b. The point of b is relative to b's centre, so that its distance from a costs no digits.
#[inline(always)]
fn nearest<S: Scalar>(pair: &Relative<S>) -> Best<S, (Nearest<S>, Vec2<S>)> {
    let (h, p, cos, sin) = (pair.half_a, pair.half_b, pair.cos, pair.sin);
    let center = Vec2::new(pair.u, pair.v);
    let turn = Rotation2 { cos, sin };
    let short = short(pair);
    let of_b = CORNERS.each_as(|[i, j]| {
        let arm = Vec2::new(signed(i, p.x), signed(j, p.y));
        let (first, last) = (center + arm, arm.perp() * sin - arm * short);
        let apart = Vec2::new(beyond(first.x, last.x, h.x), beyond(first.y, last.y, h.y));
        let found = Nearest {
            apart,
            on_a: (first + last) - apart,
            on_b: arm + last,
        };
        Best::of(apart.length_squared(), (found, direction(apart)))
    });
    let of_a = CORNERS.each_as(|[i, j]| {
        let corner = Vec2::new(signed(i, h.x), signed(j, h.y));
        let way = corner - center;
        let (first, last) = (way, -(way.perp() * sin) - way * short);
        let apart = Vec2::new(beyond(first.x, last.x, p.x), beyond(first.y, last.y, p.y));
        let (turned, local) = (turn * apart, first + last);
        let found = Nearest {
            apart: -turned,
            on_a: corner,
            on_b: turn * (local - apart),
        };
        // The direction is taken before it is turned: along a side it is that side's normal, however short the vector
        // is.
        let direction = -(turn * direction(apart));
        Best::of(apart.length_squared(), (found, direction))
    });
    Best::least(of_b.into_iter().chain(of_a))
}

/// Returns the face of a or b that separates them best; the point of b is relative to b's centre.
#[inline(always)]
fn deepest<S: Scalar>(pair: &Relative<S>) -> Best<S, Deepest<S>> {
    let (h, p, cos, sin) = (pair.half_a, pair.half_b, pair.cos, pair.sin);
    let (steep, short) = (sin.magnitude(), short(pair));
    let center = Vec2::new(pair.u, pair.v);
    let of_a = BoxCore {
        center: Vec2::zero(),
        half: h,
        turn: Upright,
    };
    let of_b = BoxCore {
        center,
        half: p,
        turn: Rotation2 { cos, sin },
    };
    // The distance in front of each face at which the other box begins; terms of the boxes' size are added first.
    let aheads = SIGNS.each_as(|back| {
        let (u, v) = (signed(back, pair.u), signed(back, pair.v));
        let of_a = [
            ((u - h.x) - p.x * cos) - p.y * steep,
            ((v - h.y) - p.y * cos) - p.x * steep,
        ];
        let of_b = [
            ((u - h.x) * cos - p.x) + (v * sin - h.y * steep),
            ((v - h.y) * cos - p.y) - (u * sin + h.x * steep),
        ];
        // The excess of a's gap over b's, without the terms of both, so that nothing cancels.
        let more = [
            ((u - h.x) + p.x) * short + ((h.y - p.y) * steep - v * sin),
            ((v - h.y) + p.y) * short + ((h.x - p.x) * steep + u * sin),
        ];
        [0, 1].each_as(|axis| (of_a[axis], of_b[axis], more[axis]))
    });
    let [[right, up], [left, down]] = aheads;
    let (own, other) = (faces_deep(&of_a, &of_b), faces_deep(&of_b, &of_a));
    // The face of b that looks at a's right side is b's left one.
    let facing = [right, left, up, down].into_iter().zip([1, 0, 3, 2]);
    let pairs = facing.enumerate().map(|(k, ((of_a, of_b, more), back))| {
        let (mut a, mut b) = (own[k], other[back].flipped());
        (a.sum.ahead, b.sum.ahead) = (of_a, of_b);
        (a.sum.on_b, b.sum.on_b) = (a.sum.on_b - center, b.sum.on_b - center);
        let (zero, less) = (S::zero(), S::lowest());
        let ahead = S::select(more.below(zero), of_b, of_a);
        a.value = S::select(more.below(zero), less, ahead);
        b.value = S::select(more.above(zero), less, ahead);
        (a.sum.level, b.sum.level) = (a.value, b.value);
        a.most_of_faces(b)
    });
    Best::most_of(pairs)
}

/// Returns the relation, in which each point is relative to the centre of its box, along the axes of a.
#[inline(always)]
fn related<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> (Relation<S>, Rotation2<S>) {
    let (pair, turn, scale) = seen(a, b);
    let deepest = Some(deepest(&pair));
    let (near, way) = nearest(&pair).mean();
    let found = joined((near, direction(way)), deepest, true, Vec2::zero(), scale);
    (found, turn)
}

/// Returns the [signed distance](super::signed_distance) of two rotated boxes, in the unit of length.
///
/// ```
/// use geograd::{Obb2, distance::turned::signed_distance_obb2};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// assert_eq!(signed_distance_obb2(a, Obb2::new(5.0, 5.0, 4.0, 2.0, 0.0)), 10.0_f64.sqrt());
/// assert_eq!(signed_distance_obb2(a, Obb2::new(0.0, 1.5, 2.0, 2.0, 0.0)), -0.5);
/// ```
#[must_use]
#[inline]
pub fn signed_distance_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    related(a, b).0.signed(S::zero())
}

/// Returns the [distance](super::distance()) of two rotated boxes, in the unit of length.
///
/// ```
/// use geograd::{Obb2, distance::turned::distance_obb2};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// assert_eq!(distance_obb2(a, Obb2::new(7.0, 5.0, 4.0, 2.0, 0.0)), 18.0_f64.sqrt());
/// assert_eq!(distance_obb2(a, a), 0.0);
/// ```
#[must_use]
#[inline]
pub fn distance_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let apart = signed_distance_obb2(a, b);
    S::select(apart.above(S::zero()), apart, S::zero()).canonical()
}

/// Returns the square of [`distance_obb2`], smooth where that vanishes.
///
/// ```
/// use geograd::{Obb2, distance::turned::squared_distance_obb2};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// assert_eq!(squared_distance_obb2(a, Obb2::new(7.0, 5.0, 4.0, 2.0, 0.0)), 18.0);
/// ```
#[must_use]
#[inline]
pub fn squared_distance_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (found, _) = related(a, b);
    found.unscaled_square(found.square())
}

/// Returns the [depth](super::penetration) by which two rotated boxes overlap, and the direction in which b leaves a.
///
/// ```
/// use geograd::{Obb2, Vec2, distance::turned::penetration_obb2};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// let found = penetration_obb2(a, Obb2::new(0.0, 1.5, 2.0, 2.0, 0.0));
/// assert_eq!((found.depth, found.direction), (0.5, Vec2::new(0.0, 1.0)));
/// ```
#[must_use]
#[inline]
pub fn penetration_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> Contact<S> {
    let (found, turn) = related(a, b);
    found.penetration(S::zero(), turn * found.normal)
}

/// Returns the [nearest points](super::closest_points) of two rotated boxes.
///
/// ```
/// use geograd::{Obb2, Vec2, distance::turned::closest_points_obb2};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// let found = closest_points_obb2(a, Obb2::new(7.0, 5.0, 4.0, 2.0, 0.0));
/// assert_eq!((found.on_a, found.on_b), (Vec2::new(2.0, 1.0), Vec2::new(5.0, 4.0)));
/// ```
#[must_use]
#[inline]
pub fn closest_points_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> PointPair<S> {
    let (found, turn) = related(a, b);
    let outer = |center: Vec2<S>, v: Vec2<S>| (center + turn * found.unscaled(v)).canonical();
    PointPair {
        on_a: outer(a.center, found.on_a),
        on_b: outer(b.center, found.on_b),
    }
}

/// Returns the [longest distance](super::farthest_distance) of points of two rotated boxes, in the unit of length.
///
/// Let c be the vector between the centres, and s and t the vectors from the centres of b and a to their corners. The
/// distance is the largest `|c + s − t|`. Its square is `|c|² + |s|² + |t|²`, which is equal for all corners, plus
/// `2 (c·s − c·t − s·t)`, by which they are compared. Negating both s and t changes only the sign of the first two
/// terms. Kinks: where corners tie.
///
/// ```
/// use geograd::{Obb2, distance::turned::farthest_distance_obb2};
/// let a = Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0);
/// assert_eq!(farthest_distance_obb2(a, Obb2::new(2.0, 3.0, 1.0, 1.0, 0.0)), 5.0);
/// ```
#[must_use]
#[inline]
pub fn farthest_distance_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (pair, _, scale) = seen(a, b);
    let (h, p, cos, sin) = (pair.half_a, pair.half_b, pair.cos, pair.sin);
    let (u, v) = (pair.u, pair.v);
    // With −t in place of t, whose signs are free: c·s along b's axes, c·t along a's, s·t of each two.
    let (sx, sy) = ((u * cos + v * sin) * p.x, (v * cos - u * sin) * p.y);
    let (tx, ty) = (u * h.x, v * h.y);
    let (xx, yy) = (cos * (p.x * h.x), cos * (p.y * h.y));
    let (xy, yx) = (sin * (p.x * h.y), -sin * (p.y * h.x));
    // Some signs of which the sum is about the largest: all s and t turned around change the sign of `centers` only.
    let plus = S::one();
    let mut most = S::lowest();
    let mut signs = [plus; 4];
    for k in 0..8 {
        let [i, j, l] = [1, 2, 4].each_as(|bit| k & bit != 0);
        let centers = (sx + signed(i, sy)) + (signed(j, tx) + signed(l, ty));
        let corners = (signed(j, xx) + signed(i ^ l, yy)) + (signed(l, xy) + signed(i ^ j, yx));
        let inner = centers.unsigned() + corners;
        let (back, more) = (centers.below(S::zero()), inner.above(most));
        most = S::select(more, inner, most);
        for (sign, negative) in signs.iter_mut().zip([false, i, j, l]) {
            let turned = S::select(back, signed(!negative, plus), signed(negative, plus));
            *sign = S::select(more, turned, *sign);
        }
    }
    let [i, j, k, l] = signs;
    let (sx, sy, tx, ty) = (sx * i, sy * j, tx * k, ty * l);
    let (xx, xy, yx, yy) = (xx * (i * k), xy * (i * l), yx * (j * k), yy * (j * l));
    let inner = ((sx + sy) + (tx + ty)) + ((xx + yy) + (xy + yx));
    // Every other choice of signs is less by the sum of the terms whose sign it changes. So a large term that
    // many choices share hides no difference.
    let losses = (1..16).map(|k: usize| {
        let [i, j, k, l] = [1, 2, 4, 8].each_as(|bit| k & bit != 0);
        let changed = |change: bool, x: S| if change { x } else { S::zero() };
        let centers = (changed(i, sx) + changed(j, sy)) + (changed(k, tx) + changed(l, ty));
        let corners =
            (changed(i ^ k, xx) + changed(j ^ l, yy)) + (changed(i ^ l, xy) + changed(j ^ k, yx));
        let loss = centers + corners;
        Best::of(loss, loss)
    });
    let none = Best::of(S::zero(), S::zero());
    let inner = inner - losses.fold(none, Best::less).mean() * S::lit(2.0);
    let twice = inner + inner;
    let squares = (u * u + v * v) + (h.length_squared() + p.length_squared());
    let square = squares + twice;
    square.root().over(scale).canonical()
}

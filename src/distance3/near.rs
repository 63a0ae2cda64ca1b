//! The nearest points of corners, edges and faces that are apart.
use super::spot::Spot;
use crate::arrays::Each;
use crate::distance::share::{Best, Carry};
use crate::scalar::largest;
use crate::{Mask, Scalar, Vec3};

/// A straight edge: `from + t along` with t from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub struct Edge<S> {
    /// The point at parameter 0.
    pub from: Vec3<S>,
    /// The point at parameter 1.
    pub to: Vec3<S>,
    /// The vector from parameter 0 to parameter 1.
    pub along: Vec3<S>,
}

impl<S: Scalar> Edge<S> {
    /// Returns the edge from one point to another.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn between(from: Vec3<S>, to: Vec3<S>) -> Self {
        Edge {
            from,
            to,
            along: to - from,
        }
    }
}

/// Two points, one of each core, that are nearest to each other.
#[derive(Clone, Copy, Debug)]
pub struct Nearest<S> {
    /// The vector from the point on a to the point on b.
    pub apart: Vec3<S>,
    /// The one on a.
    pub on_a: Vec3<S>,
    /// The one on b.
    pub on_b: Vec3<S>,
    /// The direction of that vector, if a face or two edges give it; else zero.
    pub normal: Vec3<S>,
}

impl<S: Scalar> Nearest<S> {
    /// Creates a candidate, which is compared by the squared distance.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn of(apart: Vec3<S>, on_a: Vec3<S>, on_b: Vec3<S>) -> Best<S, Self> {
        let normal = Vec3::zero();
        let found = Nearest {
            apart,
            on_a,
            on_b,
            normal,
        };
        Best::of(apart.length_squared(), found)
    }
    /// Exchanges a and b.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(self) -> Self {
        Nearest {
            apart: -self.apart,
            on_a: self.on_b,
            on_b: self.on_a,
            normal: -self.normal,
        }
    }
}

/// The nearest points of two features, and their spots.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<P> {
    /// The squared distance; the largest number if the features have no nearest points between their ends.
    pub square: P,
    /// The points.
    pub near: Nearest<P>,
    /// The spot of the one on a.
    pub at_a: Spot<P>,
    /// The spot of the one on b.
    pub at_b: Spot<P>,
}

impl<P: Scalar> Candidate<P> {
    /// Returns the nearest points at spots.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn new(near: Best<P, Nearest<P>>, at_a: Spot<P>, at_b: Spot<P>) -> Self {
        Candidate {
            square: near.value,
            near: near.sum,
            at_a,
            at_b,
        }
    }
    /// Exchanges a and b.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(self) -> Self {
        Candidate {
            near: self.near.flipped(),
            at_a: self.at_b,
            at_b: self.at_a,
            ..self
        }
    }
    /// Returns the nearer of two; of equal ones the first.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn less(self, other: Self) -> Self {
        let first = self.square.at_most(other.square);
        let none = first & !first;
        Candidate {
            square: P::select(first, self.square, other.square),
            near: self.near.join(other.near, first, none),
            at_a: self.at_a.join(other.at_a, first, none),
            at_b: self.at_b.join(other.at_b, first, none),
        }
    }
    /// Adds another candidate if its squared distance equals the least one. Returns one if it does, else zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn add(&mut self, other: &Self) -> P {
        let ties = other.square.equals(self.square);
        if !ties.any() {
            return P::zero();
        }
        let sum = |sum: Vec3<P>, v: Vec3<P>| sum + Vec3::select(ties, v, Vec3::zero());
        self.near = Nearest {
            apart: sum(self.near.apart, other.near.apart),
            on_a: sum(self.near.on_a, other.near.on_a),
            on_b: sum(self.near.on_b, other.near.on_b),
            normal: sum(self.near.normal, other.near.normal),
        };
        self.at_a.add(ties, other.at_a, ties);
        self.at_b.add(ties, other.at_b, ties);
        P::select(ties, P::one(), P::zero())
    }
    /// Creates the sum of no candidates, with the least of some squares.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn none(square: P) -> Self {
        let zero = Vec3::zero();
        Candidate {
            square,
            near: Nearest {
                apart: zero,
                on_a: zero,
                on_b: zero,
                normal: zero,
            },
            at_a: Spot::none(),
            at_b: Spot::none(),
        }
    }
    /// Returns a part of it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn times(self, share: P) -> Self {
        Candidate {
            near: self.near.times(share),
            at_a: self.at_a.times(share),
            at_b: self.at_b.times(share),
            ..self
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn join<S: Scalar>(a: Vec3<S>, b: Vec3<S>, keep: S::Mask, tie: S::Mask) -> Vec3<S> {
    let one = |a: S, b: S| a.join(b, keep, tie);
    Vec3::new(one(a.x, b.x), one(a.y, b.y), one(a.z, b.z))
}

impl<S: Scalar> Carry<S> for Nearest<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Nearest {
            apart: join(self.apart, other.apart, keep, tie),
            on_a: join(self.on_a, other.on_a, keep, tie),
            on_b: join(self.on_b, other.on_b, keep, tie),
            normal: join(self.normal, other.normal, keep, tie),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> Self {
        Nearest {
            apart: self.apart * factor,
            on_a: self.on_a * factor,
            on_b: self.on_b * factor,
            normal: self.normal * factor,
        }
    }
}

/// A height, and the point that has it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Low<S>(pub S, pub Vec3<S>);

impl<S: Scalar> Carry<S> for Low<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Low(
            self.0.join(other.0, keep, tie),
            join(self.1, other.1, keep, tie),
        )
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: S) -> Self {
        Low(self.0 * factor, self.1 * factor)
    }
}

/// Returns the largest coordinate of a vector, without sign, as a constant.
#[inline(always)]
pub(crate) fn size_of<S: Scalar>(v: Vec3<S>) -> S::Primal {
    largest([v.x, v.y, v.z])
}

/// Returns the number without derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
fn fixed<S: Scalar>(x: S) -> S {
    S::from_primal(x.primal())
}

/// Returns the sum of the squares.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn square_of<S: Scalar>(x: [S; 3]) -> S {
    (x[0] * x[0] + x[1] * x[1]) + x[2] * x[2]
}

/// A direction from a cross product, of length one or zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normal<S: Scalar> {
    /// The product.
    pub long: Vec3<S>,
    /// The square of its length, or one where that is so short that it counts as none.
    pub square: S,
    /// The vector with length one; zero where the product counts as none.
    pub unit: Vec3<S>,
    /// `true` if the product counts as none: the features are parallel or points.
    pub none: S::Mask,
    /// `true` if its direction has at least half the digits of the format.
    pub clear: S::Mask,
}

/// Returns the normal of two vectors. In units of the cores' size a product shorter than ε² counts as none: the heights
/// of its features over their neighbours are then below ε.
///
/// The product of nearly parallel vectors is mostly rounding. Its component along the first vector is subtracted, so
/// that it is orthogonal to both to the digits of the format.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn normal<S: Scalar>(u: Vec3<S>, v: Vec3<S>) -> Normal<S> {
    let long = u.cross(v);
    let (least, along) = (S::rounding(1.0, 4), u.length_squared());
    let short = along.at_most(least);
    let rest = u.dot(long).over(S::select(short, S::one(), along));
    let long = long - u * S::from_primal(S::select(short, S::zero(), rest).primal());
    let square = long.length_squared();
    let none = short | square.at_most(least);
    let clear = square.above(along * v.length_squared() * S::rounding(1.0, 1));
    let square = S::select(none, S::one(), square);
    let over = S::one().over(square.root());
    let unit = Vec3::select(none, Vec3::zero(), long * over);
    Normal {
        long,
        square,
        unit,
        none,
        clear,
    }
}

/// Returns the vector between two points of features with a common normal, and its direction. It is along the normal,
/// whose digits do not depend on its length. If the normal has few digits it is the difference of the points, without a
/// direction.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn across<S: Scalar>(normal: Normal<S>, way: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
    let height = normal.unit.dot(way);
    let turned = height.below(S::zero());
    let direction = Vec3::select(turned, -normal.unit, normal.unit);
    (
        Vec3::select(normal.clear, normal.unit * height, way),
        Vec3::select(normal.clear, direction, Vec3::zero()),
    )
}

/// Returns the point of an edge that is nearest to a corner, computed from the nearer end, whose distance has more
/// digits; where on the edge, from 0 to 1, and `true` if that is between its ends.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn edge_near<S: Scalar>(
    edge: Edge<S>,
    corner: Vec3<S>,
) -> (Best<S, Nearest<S>>, S, S::Mask) {
    let (arm, back) = (corner - edge.from, edge.to - corner);
    let square = edge.along.length_squared();
    let point = square.at_most(S::rounding(1.0, 4));
    let over = S::select(point, S::one(), square);
    let (ahead, behind) = (edge.along.dot(arm), edge.along.dot(back));
    let near = ahead.at_most(behind);
    let free = S::select(near, ahead, behind).over(over);
    // It is at most one half.
    let between = free.above(S::zero()) & !point;
    let t = S::select(point, S::lit(0.5), free).most(S::zero());
    let step = edge.along * t;
    let apart = Vec3::select(near, arm - step, step - back);
    let on_a = Vec3::select(near, edge.from + step, edge.to - step);
    let along = S::select(near, t, S::one() - t);
    (Nearest::of(apart, on_a, corner), along, between)
}

/// Returns the foot of a corner on a triangle, the largest number where that is outside; the shares of the triangle's
/// corners in it, and `true` if the normal has at least half the digits of the format.
///
/// The foot is a weighted mean of corners, so that it is a point of the triangle even if the normal is mostly rounding.
/// The weights are computed at the corner opposite to the longest edge, where the angle of a needle keeps its digits.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn face_near<S: Scalar>(
    face: [Vec3<S>; 3],
    corner: Vec3<S>,
) -> (Best<S, Nearest<S>>, [S; 3], S::Mask) {
    let [a, b, c] = face;
    let [ab, bc, ca] = [b - a, c - b, a - c].each_as(Vec3::length_squared);
    let (at_c, at_b) = (bc.below(ab) & ca.below(ab), bc.below(ca) & ab.at_most(ca));
    let pick = |first, second, third| Vec3::select(at_c, third, Vec3::select(at_b, second, first));
    let face = [pick(a, b, c), pick(b, c, a), pick(c, a, b)];
    let (u, v, arm) = (face[1] - face[0], face[2] - face[0], corner - face[0]);
    let normal = normal(u, v);
    let weight = |w: Vec3<S>| w.dot(normal.long).over(normal.square);
    let (s, t) = (weight(arm.cross(v)), weight(u.cross(arm)));
    let (zero, one) = (S::zero(), S::one());
    let inside = zero.below(s) & zero.below(t) & (s + t).below(one) & !normal.none;
    // As of two edges.
    let rest = arm - u * fixed(s);
    let length = S::select(normal.none, one, v.length_squared());
    let t = S::select(inside, v.dot(rest).over(length), zero);
    let t = t.primal().most(S::Primal::zero()).least((one - s).primal());
    let t = S::from_primal(t);
    let (apart, direction) = across(normal, rest - v * t);
    let mut found = Nearest::of(apart, corner - apart, corner);
    found.value = S::select(inside, found.value, S::largest());
    found.sum.normal = direction;
    let shares = [(one - s) - t, s, t];
    let share = |by_c: usize, by_b: usize, by_a: usize| {
        let rest = S::select(at_b, shares[by_b], shares[by_a]);
        S::select(at_c, shares[by_c], rest)
    };
    let shares = [share(1, 2, 0), share(2, 0, 1), share(0, 1, 2)];
    (found, shares, normal.clear)
}

/// Returns the nearest points of two edges where they are between the ends of both, else the largest number; where on
/// both edges, from 0 to 1, and `true` if the normal has at least half the digits of the format.
///
/// The error of the first parameter grows as the edges become parallel. The other parameter is that of the point
/// nearest to it, so that the vector between them errs by the square only.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn edges_near<S: Scalar>(
    a: Edge<S>,
    b: Edge<S>,
) -> (Best<S, Nearest<S>>, [S; 2], S::Mask) {
    let (u, v, w) = (a.along, b.along, b.from - a.from);
    let normal = normal(u, v);
    let length = S::select(normal.none, S::one(), v.length_squared());
    let s = w.cross(v).dot(normal.long).over(normal.square);
    let t = (u.dot(v) * s - w.dot(v)).over(length);
    let (zero, one) = (S::zero(), S::one());
    let inside = zero.below(s) & s.below(one) & zero.below(t) & t.below(one) & !normal.none;
    // The corners are nearer, and nobody reads the rest.
    if !inside.any() {
        let none = Nearest::of(w, a.from, b.from);
        return (
            Best {
                value: S::largest(),
                ..none
            },
            [s, t],
            normal.clear,
        );
    }
    let way = w + v * fixed(t) - u * fixed(s);
    let (apart, direction) = across(normal, way);
    let mut found = Nearest::of(apart, a.from + u * s, b.from + v * t);
    found.value = S::select(inside, found.value, S::largest());
    found.sum.normal = direction;
    (found, [s, t], normal.clear)
}

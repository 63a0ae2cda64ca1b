//! The primitive of all distances: an edge and a point.
use crate::shape::Segment2;
use crate::{Scalar, Vec2};

/// A straight edge `from + t along` with `t` from `low` to `high`: a segment, a ray or a line.
#[derive(Clone, Copy, Debug)]
pub struct Edge<S> {
    /// The point at parameter 0.
    pub from: Vec2<S>,
    /// The vector from parameter 0 to parameter 1.
    pub along: Vec2<S>,
    /// The least parameter.
    pub low: S,
    /// The greatest parameter.
    pub high: S,
}

impl<S: Scalar> Edge<S> {
    /// Returns the edge from one point to another.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn between(from: Vec2<S>, to: Vec2<S>) -> Self {
        Edge {
            from,
            along: to - from,
            low: S::zero(),
            high: S::one(),
        }
    }
}

/// The point of an edge that is nearest to a given point.
#[derive(Clone, Copy, Debug)]
pub struct Reach<S> {
    /// The parameter of the nearest point of the edge.
    pub t: S,
    /// The parameter of the nearest point of the whole line.
    pub free: S,
    /// The vector from there to the point. Across the edge it is computed from the offset alone, so that its direction
    /// is right however small it is.
    pub apart: Vec2<S>,
}

/// Returns the point of an edge that is nearest to the point `edge.from + arm`. Coordinates are of a size near one, or
/// smaller.
///
/// Edges shorter than ε² count as points: t is ½ (or the bound nearest to it), with derivative zero.
/// At either end of the edge the derivative of t is shared.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn reach<S: Scalar>(edge: Edge<S>, arm: Vec2<S>) -> Reach<S> {
    let square = edge.along.length_squared();
    let point = square.at_most(S::rounding(1.0, 4));
    let square = S::select(point, S::one(), square);
    let free = S::select(point, S::lit(0.5), edge.along.dot(arm).over(square));
    let t = free.clamp(edge.low, edge.high);
    let inside = edge.low.below(free) & free.below(edge.high) & !point;
    let offset = edge.along.perp_dot(arm).over(square);
    let (across, direct) = (edge.along.perp() * offset, arm - edge.along * t);
    Reach {
        t,
        free,
        apart: Vec2::select(inside, across, direct),
    }
}

/// Returns the larger coordinate of a vector, without sign, as a constant.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn size_of<S: Scalar>(v: Vec2<S>) -> S::Primal {
    v.x.primal().magnitude().most(v.y.primal().magnitude())
}

/// Returns the power of two, a constant, in whose units a size is about one; one for zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn scale_of<S: Scalar>(size: S::Primal) -> S {
    let zero = size.at_most(S::Primal::zero());
    S::from_primal(S::Primal::select(zero, S::Primal::one(), size).binade())
}

/// A segment before it is scaled: a distance from a point chooses units in which both are of a size near one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnscaledSegment<S> {
    segment: Segment2<S>,
}

impl<S: Scalar> UnscaledSegment<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn segment(segment: Segment2<S>) -> Self {
        UnscaledSegment { segment }
    }
    /// Returns the edge and the vector from its start to a point, both in units of the larger one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn near(self, point: Vec2<S>) -> (Edge<S>, Vec2<S>) {
        let (edge, arm, _) = self.near_scaled(point);
        (edge, arm)
    }
    /// Returns the result of [`near`](Self::near) with the power of two that lengths were multiplied by.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn near_scaled(self, point: Vec2<S>) -> (Edge<S>, Vec2<S>, S) {
        let arm = point - self.segment.from;
        let along = self.segment.to - self.segment.from;
        let scale = scale_of::<S>(size_of(arm).most(size_of(along)));
        let edge = Edge {
            from: Vec2::zero(),
            along: along * scale,
            low: S::zero(),
            high: S::one(),
        };
        (edge, arm * scale, scale)
    }
}

/// Returns the distance from a point to the edge between two points, not negative; 0 with derivative zero on the
/// edge.
///
/// Derivatives, by the envelope theorem: with n the unit vector from the nearest point to `point` and t the
/// fraction of the way at which it lies, they are n for `point`, −(1 − t) n for `from` and −t n for
/// `to`. There is no kink where the nearest point becomes an end. An edge shorter than ε² of the
/// distance counts as its midpoint.
///
/// ```
/// use geograd::{Vec2, distance::edge_distance};
/// let (from, to) = (Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0));
/// assert_eq!(edge_distance(Vec2::new(1.0, 2.0), from, to), 2.0);
/// assert_eq!(edge_distance(Vec2::new(7.0, 4.0), from, to), 5.0);
/// ```
#[must_use]
#[inline]
pub fn edge_distance<S: Scalar>(point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> S {
    let (edge, arm, scale) = UnscaledSegment::segment(Segment2::new(from, to)).near_scaled(point);
    reach(edge, arm).apart.length().over(scale).canonical()
}

/// Returns the [distance](edge_distance) of a point and an edge, and where that is zero how far the point is on
/// the left of the edge's line: zero, with the derivative of the edge's normal.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn edge_sides<S: Scalar>(point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> (S, S) {
    let (edge, arm, scale) = UnscaledSegment::segment(Segment2::new(from, to)).near_scaled(point);
    let distance = reach(edge, arm).apart.length().over(scale).canonical();
    let length = edge.along.length();
    let on = distance.equals(S::zero()) & length.above(S::rounding(1.0, 2));
    let side = edge.along.perp_dot(arm);
    let side = side.over(S::select(on, length, S::one())).over(scale);
    (distance, S::select(on, side, S::zero()))
}

/// Returns the squared distance from a point to the edge between two points; smooth where the point is off
/// the ends' perpendiculars, and everywhere once differentiable. Saturates at the largest finite
/// number.
///
/// ```
/// use geograd::{Vec2, distance::edge_squared_distance};
/// let (from, to) = (Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0));
/// assert_eq!(edge_squared_distance(Vec2::new(1.0, 2.0), from, to), 4.0);
/// ```
#[must_use]
#[inline]
pub fn edge_squared_distance<S: Scalar>(point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> S {
    let (edge, arm, scale) = UnscaledSegment::segment(Segment2::new(from, to)).near_scaled(point);
    let square = reach(edge, arm).apart.length_squared();
    square.over(scale).over(scale).saturated().canonical()
}

/// Returns the part of the edge between two points in the winding number around a point: 1 where it crosses
/// the ray from the point along +x upwards, −1 where downwards, else 0. A constant: no derivative.
///
/// An edge has its lower end and lacks its upper one, so a ring's edges add up to a whole number for
/// every point off the ring. On the ring either side may win, and the distance is 0.
///
/// ```
/// use geograd::{Vec2, distance::edge_winding};
/// let at = Vec2::new(0.0, 0.0);
/// assert_eq!(edge_winding(at, Vec2::new(1.0, -1.0), Vec2::new(1.0, 1.0)), 1.0);
/// assert_eq!(edge_winding(at, Vec2::new(-1.0, -1.0), Vec2::new(-1.0, 1.0)), 0.0);
/// ```
#[must_use]
#[inline]
pub fn edge_winding<S: Scalar>(point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> S {
    let (a, b) = (from - point, to - point);
    let (u, v) = (scale_of::<S>(size_of(a)), scale_of::<S>(size_of(b)));
    let side = (a * u).perp_dot(b * v);
    winding_of(
        from.y.at_most(point.y) & point.y.below(to.y) & side.above(S::zero()),
        to.y.at_most(point.y) & point.y.below(from.y) & side.below(S::zero()),
    )
}

/// Returns 1, −1 or 0: 1 where `up` is true, −1 where `down` is.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn winding_of<S: Scalar>(up: S::Mask, down: S::Mask) -> S {
    S::select(up, S::one(), S::select(down, -S::one(), S::zero()))
}

/// Returns the vector with length one; zero for a vector so short that it counts as none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn unit<S: Scalar>(v: Vec2<S>) -> Vec2<S> {
    let square = v.length_squared();
    let none = square.at_most(S::rounding(1.0, 4));
    let length = S::select(none, S::one(), square).root();
    let unit = Vec2::new(v.x.over(length), v.y.over(length));
    Vec2::select(none, Vec2::zero(), unit)
}

/// Returns the vector with length one; zero for the zero vector. For a tiny vector it is a constant, since its
/// derivatives are beyond the format.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn direction<S: Scalar>(way: Vec2<S>) -> Vec2<S> {
    let length = way.length();
    let none = length.at_most(S::zero());
    let over = S::select(none, S::one(), length);
    let unit = Vec2::new(way.x.over(over), way.y.over(over));
    Vec2::select(length.at_most(S::speck()), unit.constant(), unit)
}

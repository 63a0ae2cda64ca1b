//! Lines of the plane.
use crate::error::{Flaw, Validate};
use crate::{Pose2, Scalar, Shape, Vec2};
use std::ops::Mul;

/// A straight line through a point, with a direction of any length. Valid when finite and the
/// direction is not zero.
///
/// There is no special case for vertical lines: a line is never written as y over x.
///
/// ```
/// use geograd::{Line2, Vec2};
/// let wall = Line2::through(Vec2::new(2.0, 0.0), Vec2::new(2.0, 5.0)); // vertical: x = 2
/// assert_eq!(wall.point_at(0.0), Vec2::new(2.0, 0.0));
/// assert_eq!(wall.side(Vec2::new(0.0, 1.0)), 2.0); // on the left
/// let [a, b, c] = wall.coefficients();
/// assert_eq!(a * 2.0 + b * 7.0 + c, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line2<S> {
    /// One point of the line, where its parameter is 0.
    pub point: Vec2<S>,
    /// The vector from parameter 0 to parameter 1.
    #[shape(non_zero)]
    pub direction: Vec2<S>,
}

impl<S> Line2<S> {
    /// Creates a line from a point and a direction, unchecked.
    #[inline(always)]
    pub const fn new(point: Vec2<S>, direction: Vec2<S>) -> Self {
        Line2 { point, direction }
    }
}

impl<S: Scalar> Line2<S> {
    /// Creates a line from a point and a direction.
    ///
    /// # Errors
    ///
    /// When a coordinate is not finite or the direction is zero.
    pub fn try_new(point: Vec2<S>, direction: Vec2<S>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Line2 { point, direction };
        made.validate().map(|()| made)
    }
    /// Returns the line from one point through another: parameters 0 and 1.
    #[must_use]
    #[inline(always)]
    pub fn through(a: Vec2<S>, b: Vec2<S>) -> Self {
        Line2::new(a, b - a)
    }
    /// Returns the line where `a x + b y + c = 0`. Its point is the one nearest to the origin, its direction
    /// `(b, −a)`, so that `a x + b y + c` is positive on the left. Not valid (direction zero) where a
    /// and b are both zero.
    #[must_use]
    #[inline]
    pub fn from_coefficients(a: S, b: S, c: S) -> Self {
        let normal = Vec2::new(a, b);
        let length = normal.length();
        let none = length.at_most(S::zero());
        let length = S::select(none, S::one(), length);
        // One division after the other: the squared length may not be representable.
        let away = -c.over(length);
        let point = Vec2::new(a.over(length) * away, b.over(length) * away);
        Line2::new(point.canonical(), (-normal.perp()).canonical())
    }
    /// Returns `[a, b, c]` with `a x + b y + c = 0` on the line and positive on its left; `√(a² + b²)` is the length of
    /// the direction.
    ///
    /// The coefficients that DGAL gives for the line through two points are these, negated.
    /// `c` loses digits far from the origin: geometry here never uses it.
    #[must_use]
    #[inline]
    pub fn coefficients(self) -> [S; 3] {
        let normal = self.direction.perp();
        let c = -normal.dot(self.point);
        [normal.x.canonical(), normal.y.canonical(), c.canonical()]
    }
    /// Returns the point at a parameter: `point + t direction`.
    #[must_use]
    #[inline(always)]
    pub fn point_at(self, t: S) -> Vec2<S> {
        (self.point + self.direction * t).canonical()
    }
    /// Returns the parameter of the point of the line that is nearest to a point.
    #[must_use]
    #[inline]
    pub fn parameter_of(self, point: Vec2<S>) -> S {
        let (unit, length) = self.unit();
        (point - self.point).dot(unit).over(length).canonical()
    }
    /// Returns the point of the line nearest to a point.
    #[must_use]
    #[inline]
    pub fn nearest(self, point: Vec2<S>) -> Vec2<S> {
        let (unit, _) = self.unit();
        (self.point + unit * (point - self.point).dot(unit)).canonical()
    }
    /// Returns the signed distance of a point, in the unit of length: positive on the left of the direction,
    /// negative on the right. Smooth, also on the line. (DGAL's sign is the opposite.)
    ///
    /// ```
    /// use geograd::{Line2, Vec2};
    /// let road = Line2::new(Vec2::new(0.0, 1.0), Vec2::new(1.0, 0.0));
    /// assert_eq!(road.side(Vec2::new(7.0, 3.0)), 2.0);
    /// ```
    #[must_use]
    #[inline]
    pub fn side(self, point: Vec2<S>) -> S {
        let (unit, _) = self.unit();
        unit.perp_dot(point - self.point).canonical()
    }
    /// Returns the direction with length one, and its length; the zero vector and 1 for a zero direction.
    #[inline(always)]
    fn unit(self) -> (Vec2<S>, S) {
        let length = self.direction.length();
        let length = S::select(length.at_most(S::zero()), S::one(), length);
        let unit = Vec2::new(self.direction.x.over(length), self.direction.y.over(length));
        (unit, length)
    }
}

impl<S: Scalar> Mul<Line2<S>> for Pose2<S> {
    type Output = Line2<S>;
    /// Returns the line carried along.
    #[inline(always)]
    fn mul(self, shape: Line2<S>) -> Line2<S> {
        Line2::new(self * shape.point, self.rotation * shape.direction)
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Line2<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.point.fmt(f)?;
        f.write_str(" along ±")?;
        self.direction.fmt(f)
    }
}

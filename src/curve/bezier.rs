//! Quadratic and cubic Bézier curves of the plane: points, derivatives, parts.
use crate::{Scalar, Shape, Vec2};

/// A quadratic Bézier curve: a parabola's arc from the first control point to the last one. Valid when finite.
///
/// ```
/// use geograd::{Vec2, curve::Quadratic2};
/// let hill = Quadratic2::new(Vec2::new(0.0, 0.0), Vec2::new(1.0, 2.0), Vec2::new(2.0, 0.0));
/// assert_eq!(hill.point(0.5), Vec2::new(1.0, 1.0));
/// assert_eq!(hill.signed_area(), -4.0 / 3.0); // clockwise of its chord
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quadratic2<S> {
    /// The control points, ends first and last.
    pub points: [Vec2<S>; 3],
}

/// A cubic Bézier curve from the first control point to the last one. Valid when finite.
///
/// ```
/// use geograd::{Vec2, curve::Cubic2};
/// let at = |x, y| Vec2::new(x, y);
/// let wave = Cubic2::new(at(0.0, 0.0), at(0.0, 4.0), at(4.0, -4.0), at(4.0, 0.0));
/// assert_eq!(wave.point(0.5), at(2.0, 0.0));
/// assert_eq!(wave.derivative(0.0), at(0.0, 12.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cubic2<S> {
    /// The control points, ends first and last.
    pub points: [Vec2<S>; 4],
}

impl<S> Quadratic2<S> {
    /// Creates a curve from its control points, unchecked.
    #[inline(always)]
    pub const fn new(from: Vec2<S>, control: Vec2<S>, to: Vec2<S>) -> Self {
        Quadratic2 {
            points: [from, control, to],
        }
    }
}

impl<S> Cubic2<S> {
    /// Creates a curve from its control points, unchecked.
    #[inline(always)]
    pub const fn new(from: Vec2<S>, first: Vec2<S>, second: Vec2<S>, to: Vec2<S>) -> Self {
        Cubic2 {
            points: [from, first, second, to],
        }
    }
}

impl<S: Scalar> Quadratic2<S> {
    /// Returns the point at a parameter, from 0 at the start to 1 at the end.
    #[must_use]
    #[inline]
    pub fn point(self, t: S) -> Vec2<S> {
        let [a, b, c] = self.points;
        a.lerp(b, t).lerp(b.lerp(c, t), t)
    }
    /// Returns the derivative of the point by the parameter.
    #[must_use]
    #[inline]
    pub fn derivative(self, t: S) -> Vec2<S> {
        let [a, b, c] = self.points;
        (b - a).lerp(c - b, t) * S::lit(2.0)
    }
    /// Returns the second derivative of the point by the parameter, a constant.
    #[must_use]
    #[inline]
    pub fn second_derivative(self) -> Vec2<S> {
        let [a, b, c] = self.points;
        ((c - b) - (b - a)) * S::lit(2.0)
    }
    /// Returns the signed area between the curve and its chord: positive where the curve runs counter-clockwise about it.
    #[must_use]
    #[inline]
    pub fn signed_area(self) -> S {
        let [a, b, c] = self.points;
        // Two thirds of the triangle of the control points.
        (b - a).perp_dot(c - a).over(S::lit(3.0)).canonical()
    }
    /// Returns the parts before and after a parameter.
    #[must_use]
    #[inline]
    pub fn split(self, t: S) -> [Self; 2] {
        let [a, b, c] = self.points;
        let (p, q) = (a.lerp(b, t), b.lerp(c, t));
        let middle = p.lerp(q, t);
        [Quadratic2::new(a, p, middle), Quadratic2::new(middle, q, c)]
    }
    /// Returns the curve in the other direction.
    #[must_use]
    #[inline]
    pub fn reversed(self) -> Self {
        let [a, b, c] = self.points;
        Quadratic2::new(c, b, a)
    }
    /// Returns the same curve as a cubic one.
    #[must_use]
    #[inline]
    pub fn elevated(self) -> Cubic2<S> {
        let [a, b, c] = self.points;
        let third = |p: Vec2<S>| {
            let part = b - p;
            let three = S::lit(3.0);
            p + Vec2::new((part.x + part.x).over(three), (part.y + part.y).over(three))
        };
        Cubic2::new(a, third(a), third(c), c)
    }
}

impl<S: Scalar> Cubic2<S> {
    /// Returns the point at a parameter, from 0 at the start to 1 at the end.
    #[must_use]
    #[inline]
    pub fn point(self, t: S) -> Vec2<S> {
        let [a, b, c, d] = self.points;
        Quadratic2::new(a.lerp(b, t), b.lerp(c, t), c.lerp(d, t)).point(t)
    }
    /// Returns the derivative of the point by the parameter.
    #[must_use]
    #[inline]
    pub fn derivative(self, t: S) -> Vec2<S> {
        let [a, b, c, d] = self.points;
        Quadratic2::new(b - a, c - b, d - c).point(t) * S::lit(3.0)
    }
    /// Returns the second derivative of the point by the parameter.
    #[must_use]
    #[inline]
    pub fn second_derivative(self, t: S) -> Vec2<S> {
        let [a, b, c, d] = self.points;
        let (from, to) = ((c - b) - (b - a), (d - c) - (c - b));
        from.lerp(to, t) * S::lit(6.0)
    }
    /// Returns the signed area between the curve and its chord: positive where the curve runs counter-clockwise about it.
    ///
    /// Green's theorem: half of the integral of `x dy − y dx` is a sum of products of the control points.
    #[must_use]
    #[inline]
    pub fn signed_area(self) -> S {
        let [a, b, c, d] = self.points;
        let (b, c, d) = (b - a, c - a, d - a);
        let of_ends = c.perp_dot(d);
        let sum = b.perp_dot(c) + b.perp_dot(d) + (of_ends + of_ends);
        (sum * S::lit(0.15)).canonical()
    }
    /// Returns the parts before and after a parameter.
    #[must_use]
    #[inline]
    pub fn split(self, t: S) -> [Self; 2] {
        let [a, b, c, d] = self.points;
        let (p, q, r) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
        let (u, v) = (p.lerp(q, t), q.lerp(r, t));
        let middle = u.lerp(v, t);
        [Cubic2::new(a, p, u, middle), Cubic2::new(middle, v, r, d)]
    }
    /// Returns the curve in the other direction.
    #[must_use]
    #[inline]
    pub fn reversed(self) -> Self {
        let [a, b, c, d] = self.points;
        Cubic2::new(d, c, b, a)
    }
}

//! Triangles of the plane.
use super::circle::{circumcircle, unit_power};
use super::within;
use crate::arrays::Each;
use crate::error::{Flaw, Validate};
use crate::scalar::{least_of, most_of};
use crate::{Aabb2, Circle, Pose2, Scalar, Shape, Vec2, twofold};
use std::ops::Mul;

/// A triangle by its corners, in either orientation. Valid when finite; corners on one line and
/// coinciding corners are valid.
///
/// ```
/// use geograd::{Triangle2, Vec2};
/// let sail = Triangle2::new(Vec2::new(0.0_f64, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0));
/// assert_eq!(sail.area(), 6.0);
/// assert_eq!(sail.perimeter(), 12.0);
/// assert!(sail.contains(Vec2::new(1.0, 1.0)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Triangle2<S> {
    /// The first corner.
    pub a: Vec2<S>,
    /// The second corner.
    pub b: Vec2<S>,
    /// The third corner.
    pub c: Vec2<S>,
}

impl<S> Triangle2<S> {
    /// Creates a triangle from its corners, unchecked.
    #[inline(always)]
    pub const fn new(a: Vec2<S>, b: Vec2<S>, c: Vec2<S>) -> Self {
        Triangle2 { a, b, c }
    }
}

impl<S: Scalar> Triangle2<S> {
    /// Creates a triangle from its corners.
    ///
    /// # Errors
    ///
    /// When a coordinate is not finite; the flaw names the corner by its number.
    pub fn try_new(a: Vec2<S>, b: Vec2<S>, c: Vec2<S>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Triangle2 { a, b, c };
        made.validate().map(|()| made)
    }
    /// Returns the corners in order.
    #[must_use]
    #[inline(always)]
    pub fn corners(self) -> [Vec2<S>; 3] {
        [self.a, self.b, self.c]
    }
    /// Returns the corners in counter-clockwise order, from the first one.
    #[must_use]
    #[inline(always)]
    pub fn counter_clockwise(self) -> [Vec2<S>; 3] {
        // Only the sign matters, so units are chosen in which the product is representable.
        let (b, c) = (self.b - self.a, self.c - self.a);
        let (u, v) = (unit_power(b), unit_power(c));
        let clockwise = (b * u).perp_dot(c * v).below(S::zero());
        let pick = |yes: Vec2<S>, no: Vec2<S>| {
            Vec2::new(
                S::select(clockwise, yes.x, no.x),
                S::select(clockwise, yes.y, no.y),
            )
        };
        [self.a, pick(self.c, self.b), pick(self.b, self.c)]
    }
    /// Returns the area: positive for corners in counter-clockwise order, negative for clockwise ones.
    /// Smooth everywhere.
    #[must_use]
    #[inline(always)]
    pub fn signed_area(self) -> S {
        let (b, c) = (self.b - self.a, self.c - self.a);
        b.perp_dot(c * S::lit(0.5)).canonical()
    }
    /// Returns the area, not negative. Kink: zero area, with derivative zero.
    #[must_use]
    #[inline(always)]
    pub fn area(self) -> S {
        self.signed_area().magnitude()
    }
    /// Returns the sum of the lengths of its sides.
    #[must_use]
    #[inline(always)]
    pub fn perimeter(self) -> S {
        (self.a.distance(self.b) + self.b.distance(self.c) + self.c.distance(self.a)).canonical()
    }
    /// Returns the centre of its area: the mean of the corners.
    #[must_use]
    #[inline(always)]
    pub fn centroid(self) -> Vec2<S> {
        let arms = (self.b - self.a) + (self.c - self.a);
        (self.a + arms * S::lit(1.0 / 3.0)).canonical()
    }
    /// Returns the smallest axis-aligned box around it; corners that share a bound share its derivative equally.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb2<S> {
        let (x, y) = (
            self.corners().each_as(|p| p.x),
            self.corners().each_as(|p| p.y),
        );
        Aabb2 {
            min: Vec2::new(least_of(x), least_of(y)).canonical(),
            max: Vec2::new(most_of(x), most_of(y)).canonical(),
        }
    }
    /// Returns the circle through its corners. For corners on one line see [`circumcircle`].
    #[must_use]
    #[inline(always)]
    pub fn circumcircle(self) -> Circle<S> {
        circumcircle(self.a, self.b, self.c)
    }
    /// Returns the largest circle inside: it touches all three sides. Center and radius are in units of length.
    ///
    /// The center is the mean of the corners, each weighted by the length of the side opposite; the radius is twice the
    /// area over the perimeter, for either orientation. Corners on one line give radius zero and a center on that line,
    /// three coinciding ones give that point.
    ///
    /// Kinks: zero area, where the radius has derivative zero, and two corners that coincide; three that do
    /// share the derivatives of the center, a third each. Source: Coxeter and Greitzer, Geometry Revisited,
    /// 1967, section 1.4.
    ///
    /// ```
    /// use geograd::{Triangle2, Vec2};
    /// let sail = Triangle2::new(Vec2::new(0.0_f64, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0));
    /// let inside = sail.incircle();
    /// assert_eq!((inside.center, inside.radius), (Vec2::new(1.0, 1.0), 1.0));
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn incircle(self) -> Circle<S> {
        // Sides over the perimeter, before anything is multiplied: no product over- or underflows.
        let (b, c) = (self.b - self.a, self.c - self.a);
        let (ab, bc, ca) = (b.length(), (c - b).length(), c.length());
        let around = ab + bc + ca;
        let point = around.at_most(S::zero());
        let share = |x: S, of_point: f64| {
            let share = x.over(S::select(point, S::one(), around));
            S::select(point, S::lit(of_point), share)
        };
        let (by_b, by_c) = (share(ca, 1.0 / 3.0), share(ab, 1.0 / 3.0));
        let short = Vec2::new(share(c.x, 0.0), share(c.y, 0.0));
        Circle {
            center: (self.a + (b * by_b + c * by_c)).canonical(),
            radius: b.perp_dot(short).magnitude().canonical(),
        }
    }
    /// Returns `true` where the point is in the triangle, which may be flat; the border belongs to it. Decided in
    /// numbers of twice the digits.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec2<S>) -> S::Mask {
        let corners = [self.a, self.b, self.c].each_as(twofold::flat);
        within::in_triangle(corners, twofold::flat(point))
    }
}

impl<S: Scalar> Mul<Triangle2<S>> for Pose2<S> {
    type Output = Triangle2<S>;
    /// Returns the triangle carried along.
    #[inline(always)]
    fn mul(self, shape: Triangle2<S>) -> Triangle2<S> {
        Triangle2::new(self * shape.a, self * shape.b, self * shape.c)
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Triangle2<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.a.fmt(f)?;
        f.write_str(" ")?;
        self.b.fmt(f)?;
        f.write_str(" ")?;
        self.c.fmt(f)
    }
}

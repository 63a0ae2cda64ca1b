//! Circles of the plane, and the circle through three points.
use super::within;
use crate::arrays::Each;
use crate::error::{Flaw, Validate};
use crate::{Aabb2, Pose2, Scalar, Shape, Vec2, twofold};
use std::f64::consts::{PI, TAU};
use std::ops::Mul;

/// A disc: all points at most a radius from a centre. Valid when finite and the radius is not
/// negative; radius zero is valid.
///
/// ```
/// use geograd::{Circle, Vec2};
/// let wheel = Circle::new(Vec2::new(1.0_f64, 0.0), 0.5);
/// assert!(wheel.contains(Vec2::new(1.5, 0.0)));
/// assert_eq!(wheel.bounding().min, Vec2::new(0.5, -0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Circle<S> {
    /// The centre.
    #[shape(names("x", "y"))]
    pub center: Vec2<S>,
    /// The radius.
    #[shape(non_negative)]
    pub radius: S,
}

impl<S> Circle<S> {
    /// Creates a circle from centre and radius, unchecked.
    #[inline(always)]
    pub const fn new(center: Vec2<S>, radius: S) -> Self {
        Circle { center, radius }
    }
}

impl<S: Scalar> Circle<S> {
    /// Creates a circle from centre and radius.
    ///
    /// # Errors
    ///
    /// When a field is not finite or the radius is negative.
    pub fn try_new(center: Vec2<S>, radius: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Circle { center, radius };
        made.validate().map(|()| made)
    }
    /// Returns the area.
    #[must_use]
    #[inline(always)]
    pub fn area(self) -> S {
        (self.radius * S::lit(PI) * self.radius).canonical()
    }
    /// Returns the length of its border.
    #[must_use]
    #[inline(always)]
    pub fn perimeter(self) -> S {
        (self.radius * S::lit(TAU)).canonical()
    }
    /// Returns the smallest axis-aligned box around it.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb2<S> {
        let reach = Vec2::new(self.radius, self.radius);
        Aabb2 {
            min: (self.center - reach).canonical(),
            max: (self.center + reach).canonical(),
        }
    }
    /// Returns `true` where the point is in the disc; the border belongs to it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, point: Vec2<S>) -> S::Mask {
        let [center, at] = [self.center, point].each_as(twofold::flat);
        within::in_ball(center, at, self.radius.primal())
    }
}

/// Returns the circle through three points.
///
/// For points on one line there is none. The result is then the circle with the longest side as its diameter, which is
/// also the smallest one around the points. Sides of equal length share the derivatives, and three coinciding points
/// give radius zero. Near a line the radius grows without bound; it and the centre end at the largest finite number.
///
/// The centre is where the perpendicular bisectors meet: with b and c relative to a and
/// `d = 2 b × c`, it is `a + ((|b|² c − |c|² b) turned back by a quarter) / d`.
///
/// ```
/// use geograd::{Vec2, shape::circumcircle};
/// let round = circumcircle(Vec2::new(4.0, 0.0), Vec2::new(0.0, 2.0), Vec2::new(0.0, 0.0));
/// assert_eq!((round.center, round.radius), (Vec2::new(2.0, 1.0), 5.0_f64.sqrt()));
/// let flat = circumcircle(Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(6.0, 0.0));
/// assert_eq!((flat.center, flat.radius), (Vec2::new(3.0, 0.0), 3.0));
/// ```
#[must_use]
#[inline]
pub fn circumcircle<S: Scalar>(a: Vec2<S>, b: Vec2<S>, c: Vec2<S>) -> Circle<S> {
    let (b, c) = (b - a, c - a);
    // Sides in units of the longer one: no product over- or underflows.
    let (u, v) = (unit_power(b), unit_power(c));
    let zero_b = b.x.equals(S::zero()) & b.y.equals(S::zero());
    let zero_c = c.x.equals(S::zero()) & c.y.equals(S::zero());
    let large = S::format().largest();
    // The zero vector must not choose the unit.
    let scale = S::select(zero_b, S::lit(large), u).least(S::select(zero_c, S::lit(large), v));
    let scale = S::select(zero_b & zero_c, S::one(), scale);
    let (b, c) = (b * scale, c * scale);
    let (bb, cc) = (b.length_squared(), c.length_squared());
    let twice = b.perp_dot(c) * S::lit(2.0);
    // Below this the points are collinear within rounding, and derivatives, which grow with the inverse square, would
    // not be finite.
    let line = twice.magnitude().at_most(S::rounding(1.0, 2));
    let twice = S::select(line, S::one(), twice);
    let across = c * bb - b * cc;
    let round = Vec2::new(across.y.over(twice), (-across.x).over(twice));
    // The longest side's middle; equal sides share.
    let side = c - b;
    let sides = [(bb, b), (cc, c), (side.length_squared(), b + c)];
    let longest = bb.most(cc).most(sides[2].0);
    let (mut count, mut twice_middle) = (S::zero(), Vec2::zero());
    let mut diameter = S::zero();
    for (k, (square, sum)) in sides.into_iter().enumerate() {
        let chosen = square.equals(longest);
        let pick = |x: S| S::select(chosen, x, S::zero());
        let length = [b, c, side][k].length();
        count += pick(S::one());
        diameter += pick(length);
        twice_middle += Vec2::new(pick(sum.x), pick(sum.y));
    }
    let twice_count = count + count;
    let flat = Vec2::new(
        twice_middle.x.over(twice_count),
        twice_middle.y.over(twice_count),
    );
    let from_a = Vec2::new(
        S::select(line, flat.x, round.x),
        S::select(line, flat.y, round.y),
    );
    let radius = S::select(line, diameter.over(twice_count), round.length());
    let outer = |x: S| x.over(scale).saturated();
    Circle {
        center: Vec2::new(
            (a.x + outer(from_a.x)).saturated(),
            (a.y + outer(from_a.y)).saturated(),
        )
        .canonical(),
        radius: outer(radius).canonical(),
    }
}

impl<S: Scalar> Mul<Circle<S>> for Pose2<S> {
    type Output = Circle<S>;
    /// Returns the circle carried along.
    #[inline(always)]
    fn mul(self, shape: Circle<S>) -> Circle<S> {
        Circle::new(self * shape.center, shape.radius)
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Circle<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.center.fmt(f)?;
        f.write_str(" within ")?;
        self.radius.fmt(f)
    }
}

/// Returns the power of two, a constant, that brings the larger coordinate of a vector to about one; one for
/// the zero vector.
#[inline(always)]
pub(super) fn unit_power<S: Scalar>(v: Vec2<S>) -> S {
    let large = v.x.primal().magnitude().most(v.y.primal().magnitude());
    let zero = large.at_most(S::Primal::zero());
    let large = S::Primal::select(zero, S::Primal::one(), large);
    S::from_primal(large.binade())
}

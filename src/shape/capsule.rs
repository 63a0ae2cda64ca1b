//! Capsules of the plane: thick segments with round ends.
use super::within;
use crate::arrays::Each;
use crate::error::{Flaw, Validate};
use crate::{Aabb2, Pose2, Scalar, Segment2, Shape, Vec2, twofold};
use std::f64::consts::{PI, TAU};
use std::ops::Mul;

/// All points at most a radius from a segment. Valid when finite and the radius is not negative;
/// with coinciding ends it is a disc, with radius zero a segment.
///
/// ```
/// use geograd::{Capsule2, Vec2};
/// let boat = Capsule2::new(Vec2::new(0.0_f64, 0.0), Vec2::new(4.0, 0.0), 1.0);
/// assert!(boat.contains(Vec2::new(-0.5, 0.5)));
/// assert!((boat.area() - (8.0 + std::f64::consts::PI)).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Capsule2<S> {
    /// One end of the segment inside.
    pub from: Vec2<S>,
    /// Its other end.
    pub to: Vec2<S>,
    /// The radius.
    #[shape(non_negative)]
    pub radius: S,
}

impl<S> Capsule2<S> {
    /// Creates a capsule from the ends of the segment inside and the radius, unchecked.
    #[inline(always)]
    pub const fn new(from: Vec2<S>, to: Vec2<S>, radius: S) -> Self {
        Capsule2 { from, to, radius }
    }
}

impl<S: Scalar> Capsule2<S> {
    /// Creates a capsule from the ends of the segment inside and the radius.
    ///
    /// # Errors
    ///
    /// When a field is not finite or the radius is negative.
    pub fn try_new(from: Vec2<S>, to: Vec2<S>, radius: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Capsule2 { from, to, radius };
        made.validate().map(|()| made)
    }
    /// Returns the segment inside.
    #[must_use]
    #[inline(always)]
    pub fn segment(self) -> Segment2<S> {
        Segment2::new(self.from, self.to)
    }
    /// Returns the area.
    #[must_use]
    #[inline(always)]
    pub fn area(self) -> S {
        let (length, two) = (self.segment().length(), S::lit(2.0));
        (self.radius * (length * two + self.radius * S::lit(PI))).canonical()
    }
    /// Returns the length of its border.
    #[must_use]
    #[inline(always)]
    pub fn perimeter(self) -> S {
        (self.segment().length() * S::lit(2.0) + self.radius * S::lit(TAU)).canonical()
    }
    /// Returns the smallest axis-aligned box around it; ends that share a bound share its derivative.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb2<S> {
        let (inner, reach) = (
            self.segment().bounding(),
            Vec2::new(self.radius, self.radius),
        );
        Aabb2 {
            min: (inner.min - reach).canonical(),
            max: (inner.max + reach).canonical(),
        }
    }
    /// Returns `true` where the point is in the capsule; the border belongs to it.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec2<S>) -> S::Mask {
        let [from, to, at] = [self.from, self.to, point].each_as(twofold::flat);
        let radius = self.radius.primal();
        let seen = within::AxisPoint::new(from, to, at, radius);
        let across = within::square([twofold::turn(seen.axis, seen.arm)]);
        let reach =
            within::square([radius * seen.unit]) * within::square(twofold::rounded(seen.axis));
        let [first, last] = [from, to].each_as(|end| within::in_ball(end, at, radius));
        first | last | seen.is_between() & across.at_most(reach)
    }
}

impl<S: Scalar> Mul<Capsule2<S>> for Pose2<S> {
    type Output = Capsule2<S>;
    /// Returns the capsule carried along.
    #[inline(always)]
    fn mul(self, shape: Capsule2<S>) -> Capsule2<S> {
        Capsule2::new(self * shape.from, self * shape.to, shape.radius)
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Capsule2<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.from.fmt(f)?;
        f.write_str(" to ")?;
        self.to.fmt(f)?;
        f.write_str(" within ")?;
        self.radius.fmt(f)
    }
}

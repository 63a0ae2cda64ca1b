//! Segments of the plane.
use crate::error::{Flaw, Validate};
use crate::{Aabb2, Line2, Pose2, Ray2, Scalar, Shape, Vec2};
use std::ops::Mul;

/// A straight segment between two points. Valid when finite; its ends may coincide.
///
/// ```
/// use geograd::{Segment2, Vec2};
/// let curb = Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0));
/// assert_eq!(curb.length(), 4.0);
/// assert_eq!(curb.parameter_of(Vec2::new(1.0, 3.0)), 0.25);
/// assert_eq!(curb.nearest(Vec2::new(9.0, 1.0)), Vec2::new(4.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Segment2<S> {
    /// Its start.
    pub from: Vec2<S>,
    /// Its end.
    pub to: Vec2<S>,
}

impl<S> Segment2<S> {
    /// Creates a segment from its ends, unchecked.
    #[inline(always)]
    pub const fn new(from: Vec2<S>, to: Vec2<S>) -> Self {
        Segment2 { from, to }
    }
}

impl<S: Scalar> Segment2<S> {
    /// Creates a segment from its ends.
    ///
    /// # Errors
    ///
    /// When a coordinate is not finite.
    pub fn try_new(from: Vec2<S>, to: Vec2<S>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Segment2 { from, to };
        made.validate().map(|()| made)
    }
    /// Returns the vector from its start to its end.
    #[must_use]
    #[inline(always)]
    pub fn along(self) -> Vec2<S> {
        self.to - self.from
    }
    /// Returns the length; derivative zero where the ends coincide.
    #[must_use]
    #[inline(always)]
    pub fn length(self) -> S {
        self.along().length().canonical()
    }
    /// Returns the midpoint.
    #[must_use]
    #[inline(always)]
    pub fn midpoint(self) -> Vec2<S> {
        self.point_at(S::lit(0.5))
    }
    /// Returns the point a fraction `t` of the way from start to end; beyond the ends for `t` outside
    /// `[0, 1]`.
    #[must_use]
    #[inline(always)]
    pub fn point_at(self, t: S) -> Vec2<S> {
        (self.from + self.along() * t).canonical()
    }
    /// Returns the segment from end to start.
    #[must_use]
    #[inline(always)]
    pub fn reversed(self) -> Self {
        Segment2::new(self.to, self.from)
    }
    /// Returns the line through its ends.
    #[must_use]
    #[inline(always)]
    pub fn line(self) -> Line2<S> {
        Line2::new(self.from, self.along())
    }
    /// Returns the ray from its start through its end.
    #[must_use]
    #[inline(always)]
    pub fn ray(self) -> Ray2<S> {
        Ray2::new(self.from, self.along())
    }
    /// Returns the smallest axis-aligned box around it; ends that share a bound share its derivative.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb2<S> {
        Aabb2 {
            min: self.from.least(self.to).canonical(),
            max: self.from.most(self.to).canonical(),
        }
    }
}

impl<S: Scalar> Mul<Segment2<S>> for Pose2<S> {
    type Output = Segment2<S>;
    /// Returns the segment carried along.
    #[inline(always)]
    fn mul(self, shape: Segment2<S>) -> Segment2<S> {
        Segment2::new(self * shape.from, self * shape.to)
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Segment2<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.from.fmt(f)?;
        f.write_str(" to ")?;
        self.to.fmt(f)
    }
}

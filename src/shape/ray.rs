//! Rays of the plane.
use crate::error::{Flaw, Validate};
use crate::scalar::Guard;
use crate::{Line2, Pose2, Scalar, Shape, Vec2};
use std::ops::Mul;

/// Half a line: from a point on, in a direction of any length. Valid when finite and the direction
/// is not zero.
///
/// ```
/// use geograd::{Ray2, Vec2};
/// let beam = Ray2::new(Vec2::new(1.0, 0.0), Vec2::new(0.0, 2.0));
/// assert_eq!(beam.point_at(1.5), Vec2::new(1.0, 3.0));
/// assert_eq!(beam.parameter_of(Vec2::new(5.0, -3.0)), 0.0); // behind its start
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ray2<S> {
    /// Its start, at parameter 0.
    pub point: Vec2<S>,
    /// The vector from parameter 0 to parameter 1.
    #[shape(non_zero)]
    pub direction: Vec2<S>,
}

impl<S> Ray2<S> {
    /// Creates a ray from its start and a direction, unchecked.
    #[inline(always)]
    pub const fn new(point: Vec2<S>, direction: Vec2<S>) -> Self {
        Ray2 { point, direction }
    }
}

impl<S: Scalar> Ray2<S> {
    /// Creates a ray from its start and a direction.
    ///
    /// # Errors
    ///
    /// When a coordinate is not finite or the direction is zero.
    pub fn try_new(point: Vec2<S>, direction: Vec2<S>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Ray2 { point, direction };
        made.validate().map(|()| made)
    }
    /// Returns the ray from one point through another: parameters 0 and 1.
    #[must_use]
    #[inline(always)]
    pub fn through(a: Vec2<S>, b: Vec2<S>) -> Self {
        Ray2::new(a, b - a)
    }
    /// Returns the point at a parameter: `point + t direction`.
    #[must_use]
    #[inline(always)]
    pub fn point_at(self, t: S) -> Vec2<S> {
        self.line().point_at(t)
    }
    /// Returns the parameter, at least 0, of the point of the ray that is nearest to a point. Kink: where
    /// that becomes the start, the derivative is shared.
    #[must_use]
    #[inline]
    pub fn parameter_of(self, point: Vec2<S>) -> S {
        self.line().parameter_of(point).most(S::zero())
    }
    /// Returns the point of the ray nearest to a point. Kink: see [`parameter_of`](Ray2::parameter_of).
    #[must_use]
    #[inline]
    pub fn nearest(self, point: Vec2<S>) -> Vec2<S> {
        let nearest = self.point_at(self.parameter_of(point));
        Guard::of(&self).and(&point).result(nearest)
    }
    /// Returns the line that it is half of.
    #[must_use]
    #[inline(always)]
    pub fn line(self) -> Line2<S> {
        Line2::new(self.point, self.direction)
    }
}

impl<S: Scalar> Mul<Ray2<S>> for Pose2<S> {
    type Output = Ray2<S>;
    /// Returns the ray carried along.
    #[inline(always)]
    fn mul(self, shape: Ray2<S>) -> Ray2<S> {
        Ray2::new(self * shape.point, self.rotation * shape.direction)
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Ray2<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.point.fmt(f)?;
        f.write_str(" along ")?;
        self.direction.fmt(f)
    }
}

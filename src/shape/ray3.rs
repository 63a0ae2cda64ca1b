//! Rays in space.
use crate::error::{Flaw, Validate};
use crate::scalar::Guard;
use crate::shape::{Line3, Pose3};
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// Half a line in space: from a point on, in a direction of any length. Valid when finite and the direction is not
/// zero.
///
/// ```
/// use geograd::{Ray3, Vec3};
/// let beam = Ray3::new(Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.0));
/// assert_eq!(beam.point_at(1.5), Vec3::new(1.0, 0.0, 3.0));
/// assert_eq!(beam.parameter_of(Vec3::new(5.0, 0.0, -3.0)), 0.0); // behind its start
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[shape(except(Sample))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ray3<S> {
    /// Its start, at parameter 0.
    pub point: Vec3<S>,
    /// The vector from parameter 0 to parameter 1.
    #[shape(direction, non_zero)]
    pub direction: Vec3<S>,
}

impl<S> Ray3<S> {
    /// Creates a ray from its start and a direction, unchecked.
    #[inline(always)]
    pub const fn new(point: Vec3<S>, direction: Vec3<S>) -> Self {
        Ray3 { point, direction }
    }
}

impl<S: Scalar> Ray3<S> {
    /// Creates a ray from its start and a direction.
    ///
    /// # Errors
    ///
    /// When a coordinate is not finite or the direction is zero.
    pub fn try_new(point: Vec3<S>, direction: Vec3<S>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Ray3 { point, direction };
        made.validate().map(|()| made)
    }
    /// Returns the ray from one point through another: parameters 0 and 1.
    #[must_use]
    #[inline(always)]
    pub fn through(a: Vec3<S>, b: Vec3<S>) -> Self {
        Ray3::new(a, b - a)
    }
    /// Returns the point at a parameter: `point + t direction`.
    #[must_use]
    #[inline(always)]
    pub fn point_at(self, t: S) -> Vec3<S> {
        self.point + self.direction * t
    }
    /// Returns the parameter, at least 0, of the point of the ray that is nearest to a point. Kink: where that becomes
    /// the start, the derivative is shared.
    #[must_use]
    #[inline]
    pub fn parameter_of(self, point: Vec3<S>) -> S {
        self.line().parameter_of(point).most(S::zero())
    }
    /// Returns the point of the ray nearest to a point. Kink: see [`parameter_of`](Ray3::parameter_of).
    #[must_use]
    #[inline]
    pub fn nearest(self, point: Vec3<S>) -> Vec3<S> {
        let nearest = self.point_at(self.parameter_of(point));
        Guard::of(&self).and(&point).result(nearest)
    }
    /// Returns the line that it is half of.
    #[must_use]
    #[inline(always)]
    pub fn line(self) -> Line3<S> {
        Line3::new(self.point, self.direction)
    }
}

impl<S: Scalar> Mul<Ray3<S>> for Pose3<S> {
    type Output = Ray3<S>;
    /// Returns the ray carried along.
    #[inline(always)]
    fn mul(self, shape: Ray3<S>) -> Ray3<S> {
        Ray3::new(self * shape.point, self.rotation * shape.direction)
    }
}

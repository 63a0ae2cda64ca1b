//! Lines in space.
use crate::error::{Flaw, Validate};
use crate::shape::Pose3;
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// A line in space: through a point, in a direction of any length. Valid when finite and the direction is not zero.
///
/// ```
/// use geograd::{Line3, Vec3};
/// let wire = Line3::new(Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.0));
/// assert_eq!(wire.nearest(Vec3::new(5.0, 1.0, -3.0)), Vec3::new(1.0, 0.0, -3.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line3<S> {
    /// Its point at parameter 0.
    pub point: Vec3<S>,
    /// The vector from parameter 0 to parameter 1.
    #[shape(direction, non_zero)]
    pub direction: Vec3<S>,
}

impl<S> Line3<S> {
    /// Creates a line from a point and a direction, unchecked.
    #[inline(always)]
    pub const fn new(point: Vec3<S>, direction: Vec3<S>) -> Self {
        Line3 { point, direction }
    }
}

impl<S: Scalar> Line3<S> {
    /// Creates a line from a point and a direction.
    ///
    /// # Errors
    ///
    /// When a coordinate is not finite or the direction is zero.
    pub fn try_new(point: Vec3<S>, direction: Vec3<S>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Line3 { point, direction };
        made.validate().map(|()| made)
    }
    /// Returns the line from one point through another: parameters 0 and 1.
    #[must_use]
    #[inline(always)]
    pub fn through(a: Vec3<S>, b: Vec3<S>) -> Self {
        Line3::new(a, b - a)
    }
    /// Returns the point at a parameter: `point + t direction`.
    #[must_use]
    #[inline(always)]
    pub fn point_at(self, t: S) -> Vec3<S> {
        self.point + self.direction * t
    }
    /// Returns the parameter of the point of the line that is nearest to a point.
    #[must_use]
    #[inline]
    pub fn parameter_of(self, point: Vec3<S>) -> S {
        let size = crate::scalar::largest([self.direction.x, self.direction.y, self.direction.z]);
        let zero = size.at_most(S::Primal::zero());
        let scale = S::from_primal(S::Primal::select(zero, S::Primal::one(), size).binade());
        let unit = self.direction * scale;
        let square = S::select(zero, S::one(), unit.length_squared());
        ((point - self.point) * scale).dot(unit).over(square)
    }
    /// Returns the point of the line nearest to a point.
    #[must_use]
    #[inline]
    pub fn nearest(self, point: Vec3<S>) -> Vec3<S> {
        self.point_at(self.parameter_of(point))
    }
}

impl<S: Scalar> Mul<Line3<S>> for Pose3<S> {
    type Output = Line3<S>;
    /// Returns the line carried along.
    #[inline(always)]
    fn mul(self, shape: Line3<S>) -> Line3<S> {
        Line3::new(self * shape.point, self.rotation * shape.direction)
    }
}

//! Spheres.
use super::within;
use crate::arrays::Each;
use crate::shape::{Aabb3, Pose3};
use crate::{Scalar, Shape, Vec3, twofold};
use std::ops::Mul;

/// A ball in space. Valid when finite and of non-negative radius; radius zero is valid.
///
/// ```
/// use geograd::{Sphere, Vec3};
/// let ball = Sphere::new(Vec3::new(1.0, 0.0, 0.0), 2.0);
/// assert_eq!(ball.signed_distance(Vec3::new(4.0, 0.0, 0.0)), 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sphere<S> {
    /// The centre.
    #[shape(names("x", "y", "z"))]
    pub center: Vec3<S>,
    /// The radius.
    #[shape(non_negative)]
    pub radius: S,
}

impl<S> Sphere<S> {
    /// Creates a sphere from centre and radius, unchecked.
    #[inline(always)]
    pub const fn new(center: Vec3<S>, radius: S) -> Self {
        Sphere { center, radius }
    }
}

impl<S: Scalar> Sphere<S> {
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        self.radius * self.radius * self.radius * S::lit(4.0 / 3.0 * std::f64::consts::PI)
    }
    /// Returns the area of the surface.
    #[must_use]
    #[inline(always)]
    pub fn surface(self) -> S {
        self.radius * self.radius * S::lit(4.0 * std::f64::consts::PI)
    }
    /// Returns `true` where the point is in the ball; the surface belongs to it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let [center, at] = [self.center, point].each_as(twofold::deep);
        within::in_ball(center, at, self.radius.primal())
    }
    /// Returns the smallest axis-aligned box around it.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb3<S> {
        let reach = Vec3::new(self.radius, self.radius, self.radius);
        Aabb3::new(self.center - reach, self.center + reach)
    }
}

impl<S: Scalar> Mul<Sphere<S>> for Pose3<S> {
    type Output = Sphere<S>;
    /// Returns the sphere carried along.
    #[inline(always)]
    fn mul(self, shape: Sphere<S>) -> Sphere<S> {
        Sphere::new(self * shape.center, shape.radius)
    }
}

//! Planes in space.
use super::within;
use crate::arrays::Each;
use crate::shape::Pose3;
use crate::{Scalar, Shape, Vec3, twofold};
use std::ops::Mul;

/// A plane in space: the points p with `normal · p = offset`, where the normal has any length but zero;
/// and the half-space behind it, `normal · p ≤ offset`. Valid when finite and the normal is not zero.
///
/// ```
/// use geograd::{Plane3, Vec3};
/// let floor = Plane3::through(Vec3::new(5.0, 5.0, 1.0), Vec3::new(0.0, 0.0, 2.0));
/// assert_eq!(floor.signed_distance(Vec3::new(0.0, 0.0, 4.0)), 3.0);
/// assert_eq!(floor.project(Vec3::new(0.0, 7.0, 4.0)), Vec3::new(0.0, 7.0, 1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane3<S> {
    /// A direction orthogonal to the plane, of any length but zero.
    #[shape(direction, non_zero)]
    pub normal: Vec3<S>,
    /// The normal's inner product with any point of the plane.
    #[shape(kind = "Offset")]
    pub offset: S,
}

impl<S> Plane3<S> {
    /// Creates a plane from normal and offset, unchecked.
    #[inline(always)]
    pub const fn new(normal: Vec3<S>, offset: S) -> Self {
        Plane3 { normal, offset }
    }
}

impl<S: Scalar> Plane3<S> {
    /// Creates the plane through a point, with a normal of any length except zero.
    #[must_use]
    #[inline(always)]
    pub fn through(point: Vec3<S>, normal: Vec3<S>) -> Self {
        Plane3::new(normal, normal.dot(point))
    }
    /// Returns `true` where the point is behind the plane or on it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let [normal, at] = [self.normal, point].each_as(twofold::deep);
        within::is_behind(normal, at, self.offset.primal())
    }
}

impl<S: Scalar> Mul<Plane3<S>> for Pose3<S> {
    type Output = Plane3<S>;
    /// Returns the plane carried along; the normal keeps its length.
    #[inline(always)]
    fn mul(self, shape: Plane3<S>) -> Plane3<S> {
        let normal = self.rotation * shape.normal;
        Plane3::new(normal, shape.offset + normal.dot(self.translation))
    }
}

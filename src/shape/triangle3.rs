//! Triangles in space.
use crate::shape::{Aabb3, Plane3, Pose3};
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// A triangle in space. Valid when finite; area zero is valid.
///
/// ```
/// use geograd::{Triangle3, Vec3};
/// let half = Triangle3::new(
///     Vec3::new(0.0, 0.0, 1.0),
///     Vec3::new(2.0, 0.0, 1.0),
///     Vec3::new(0.0, 2.0, 1.0),
/// );
/// assert_eq!(half.area(), 2.0);
/// assert_eq!(half.normal(), Vec3::new(0.0, 0.0, 1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Triangle3<S> {
    /// The first corner.
    pub a: Vec3<S>,
    /// The second corner.
    pub b: Vec3<S>,
    /// The third corner; counter-clockwise when the normal points at the viewer.
    pub c: Vec3<S>,
}

impl<S> Triangle3<S> {
    /// Creates a triangle from its corners.
    #[inline(always)]
    pub const fn new(a: Vec3<S>, b: Vec3<S>, c: Vec3<S>) -> Self {
        Triangle3 { a, b, c }
    }
}

impl<S: Scalar> Triangle3<S> {
    /// Returns the normal whose length is twice the area: smooth everywhere.
    #[must_use]
    #[inline(always)]
    pub fn twice_area_normal(self) -> Vec3<S> {
        (self.b - self.a).cross(self.c - self.a)
    }
    /// Returns the area; derivative zero at area zero.
    #[must_use]
    #[inline(always)]
    pub fn area(self) -> S {
        self.twice_area_normal().length().halved()
    }
    /// Returns the normal of length one, or the zero vector (with derivative zero) for area zero.
    #[must_use]
    #[inline(always)]
    pub fn normal(self) -> Vec3<S> {
        self.twice_area_normal().normalize_or_zero()
    }
    /// Returns the mean of the corners.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec3<S> {
        self.a + ((self.b - self.a) + (self.c - self.a)) * S::lit(1.0 / 3.0)
    }
    /// Returns the corners.
    #[must_use]
    #[inline(always)]
    pub fn corners(self) -> [Vec3<S>; 3] {
        [self.a, self.b, self.c]
    }
    /// Returns the smallest axis-aligned box around it; corners that share a bound share its derivative equally.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb3<S> {
        Aabb3::of(self.corners())
    }
    /// Returns the plane it lies in; not valid for area zero.
    #[must_use]
    #[inline(always)]
    pub fn plane(self) -> Plane3<S> {
        Plane3::through(self.a, self.twice_area_normal())
    }
    /// Returns six times the signed volume of the tetrahedron with a point. It is positive when the point is behind the
    /// triangle, as for the points inside a closed mesh whose normals point outwards.
    #[must_use]
    #[inline(always)]
    pub fn six_volume(self, point: Vec3<S>) -> S {
        self.twice_area_normal().dot(self.a - point)
    }
}

impl<S: Scalar> Mul<Triangle3<S>> for Pose3<S> {
    type Output = Triangle3<S>;
    /// Returns the triangle carried along.
    #[inline(always)]
    fn mul(self, shape: Triangle3<S>) -> Triangle3<S> {
        Triangle3::new(self * shape.a, self * shape.b, self * shape.c)
    }
}

//! Distances of points, segments, balls and planes of space as methods that need no trait in scope.
use super::{Apart, distance, signed_distance, squared_distance};
use crate::{Plane3, Scalar, Segment3, Sphere, Vec3};

impl<S: Scalar> Vec3<S> {
    /// Returns the distance of the point from another one or from a shape: [`distance`].
    ///
    /// ```
    /// use geograd::{Aabb3, Vec3};
    /// let point = Vec3::new(0.5, 4.0, 5.0);
    /// assert_eq!(point.distance(Vec3::new(0.5, 1.0, 1.0)), 5.0);
    /// assert_eq!(point.distance(Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0))), 5.0);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn distance<B>(self, other: B) -> S
    where
        Self: Apart<B, Scalar = S>,
    {
        distance(self, other)
    }
    /// Returns the signed distance of the point from the surface of a shape, negative inside: [`signed_distance`].
    #[must_use]
    #[inline]
    pub fn signed_distance<B>(self, shape: B) -> S
    where
        Self: Apart<B, Scalar = S>,
    {
        signed_distance(self, shape)
    }
    /// Returns the square of the distance from another point, where it is smooth everywhere, or from a shape:
    /// [`squared_distance`].
    #[must_use]
    #[inline(always)]
    pub fn squared_distance<B>(self, other: B) -> S
    where
        Self: Apart<B, Scalar = S>,
    {
        squared_distance(self, other)
    }
}

impl<S: Scalar> Segment3<S> {
    /// Returns the distance to a shape, 0 where they touch: [`distance`](crate::distance3::distance()).
    ///
    /// ```
    /// use geograd::{Segment3, Vec3};
    /// let edge = Segment3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0));
    /// let other = Segment3::new(Vec3::new(1.0, -1.0, 3.0), Vec3::new(1.0, 1.0, 3.0));
    /// assert_eq!(edge.distance(Vec3::new(5.0, 4.0, 0.0)), 5.0);
    /// assert_eq!(edge.distance(other), 3.0);
    /// ```
    #[must_use]
    #[inline]
    pub fn distance<B>(self, other: B) -> S
    where
        Self: Apart<B, Scalar = S>,
    {
        distance(self, other)
    }
}

impl<S: Scalar> Sphere<S> {
    /// Returns the distance from a point or another shape to the surface, negative inside; of a point the derivative is
    /// zero at the centre: [`signed_distance`](crate::distance3::signed_distance).
    #[must_use]
    #[inline(always)]
    pub fn signed_distance<B>(self, other: B) -> S
    where
        Self: Apart<B, Scalar = S>,
    {
        signed_distance(self, other)
    }
}

impl<S: Scalar> Plane3<S> {
    /// Returns the height of a point over the plane, or of the lowest point of another shape: positive on the side of
    /// the normal. For a normal of length zero the offset counts alone, with its sign changed.
    #[must_use]
    #[inline(always)]
    pub fn signed_distance<B>(self, other: B) -> S
    where
        Self: Apart<B, Scalar = S>,
    {
        signed_distance(self, other)
    }
    /// Returns the point of the plane nearest to a point.
    #[must_use]
    #[inline(always)]
    pub fn project(self, point: Vec3<S>) -> Vec3<S> {
        point - self.normal.normalize_or_zero() * self.signed_distance(point)
    }
}

//! Distances of points of space as methods that need no trait in scope.
use super::{Apart, distance, signed_distance, squared_distance};
use crate::{Scalar, Vec3};

impl<S: Scalar> Vec3<S> {
    /// The distance of the point from another one or from a shape: [`distance`].
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
    /// The signed distance of the point from the surface of a shape, negative inside: [`signed_distance`].
    #[must_use]
    #[inline]
    pub fn signed_distance<B>(self, shape: B) -> S
    where
        Self: Apart<B, Scalar = S>,
    {
        signed_distance(self, shape)
    }
    /// The square of the distance from another point, where it is smooth everywhere, or from a shape:
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

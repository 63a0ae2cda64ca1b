//! Distances of points as methods that need no trait in scope.
use super::convex::{Convex, distance, squared_distance};
use crate::{Scalar, Vec2};

impl<S: Scalar> Vec2<S> {
    /// The distance of the point from a convex shape, another point among them: [`distance`].
    ///
    /// ```
    /// use geograd::{Obb2, Vec2};
    /// let point = Vec2::new(5.0, 0.0);
    /// assert_eq!(point.distance(Vec2::new(2.0, 4.0)), 5.0);
    /// assert_eq!(point.distance(Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0)), 3.0);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn distance<B: Convex<S>>(self, other: B) -> S {
        distance(self, other)
    }
    /// The square of the distance of the point from a convex shape: [`squared_distance`].
    #[must_use]
    #[inline(always)]
    pub fn squared_distance<B: Convex<S>>(self, other: B) -> S {
        squared_distance(self, other)
    }
}

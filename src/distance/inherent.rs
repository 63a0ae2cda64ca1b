//! Distances of points, and the points of segments that are nearest to a point, as methods that need no trait in scope.
use super::convex::{Convex, distance, squared_distance};
use super::edge::{self, UnscaledSegment};
use crate::scalar::Guard;
use crate::{Scalar, Segment2, Vec2};

impl<S: Scalar> Vec2<S> {
    /// Returns the distance of the point from a convex shape, another point among them: [`distance`].
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
    /// Returns the square of the distance of the point from a convex shape: [`squared_distance`].
    #[must_use]
    #[inline(always)]
    pub fn squared_distance<B: Convex<S>>(self, other: B) -> S {
        squared_distance(self, other)
    }
}

impl<S: Scalar> Segment2<S> {
    /// Returns the fraction of the way, in `[0, 1]`, at which it is nearest to a point.
    ///
    /// Kinks: where the nearest point becomes an end, the derivative is shared. A segment of zero length
    /// (below ε² of the distance to the point) gives one half, with derivative zero.
    #[must_use]
    #[inline]
    pub fn parameter_of(self, point: Vec2<S>) -> S {
        let (edge, arm) = UnscaledSegment::segment(self).near(point);
        edge::reach(edge, arm).t.canonical()
    }
    /// Returns the point of the segment nearest to a point. Kinks: see
    /// [`parameter_of`](Segment2::parameter_of).
    #[must_use]
    #[inline]
    pub fn nearest(self, point: Vec2<S>) -> Vec2<S> {
        let nearest = self.point_at(self.parameter_of(point));
        Guard::of(&self).and(&point).result(nearest)
    }
}

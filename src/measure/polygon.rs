//! Measures of a convex polygon as methods.
use crate::measure::moments::{AreaMoments, second_moments};
use crate::{ConvexPolygon, Scalar, Vec2, ring};

/// Returns the mean of some points; the origin for none. The mean of a polygon's vertices is not the centroid of its
/// area: see [`ring::centroid`].
///
/// ```
/// use geograd::{Vec2, measure::vertex_mean};
/// assert_eq!(vertex_mean(&[Vec2::new(0.0, 0.0), Vec2::new(1.0, 3.0)]), Vec2::new(0.5, 1.5));
/// ```
#[must_use]
#[inline]
pub fn vertex_mean<S: Scalar>(points: &[Vec2<S>]) -> Vec2<S> {
    let Some((&first, rest)) = points.split_first() else {
        return Vec2::zero();
    };
    // Relative to one of them, halved, and each by its share: nothing overflows, no digits are lost.
    let share = S::one().over(S::lit(points.len() as f64));
    let mut sum = Vec2::zero();
    for &point in rest {
        sum.x += (point.x.halved() - first.x.halved()) * share;
        sum.y += (point.y.halved() - first.y.halved()) * share;
    }
    (first + sum + sum).canonical()
}

impl<S: Scalar, const N: usize> ConvexPolygon<S, N> {
    /// Returns the area, in squared units of length, never negative for a valid polygon. Saturates at the
    /// largest finite number.
    ///
    /// ```
    /// use geograd::{Aabb2, ConvexPolygon, Vec2};
    /// let shape = ConvexPolygon::from(Aabb2::new(1.0, 1.0, 5.0, 3.0));
    /// assert_eq!((shape.area(), shape.perimeter()), (8.0, 12.0));
    /// assert_eq!(shape.centroid(), Vec2::new(3.0, 2.0));
    /// ```
    #[must_use]
    #[inline]
    pub fn area(&self) -> S {
        ring::signed_area(self.as_slice())
    }
    /// Returns the sum of the lengths of all edges. Derivative zero at edges of length zero.
    #[must_use]
    #[inline]
    pub fn perimeter(&self) -> S {
        ring::perimeter(self.as_slice())
    }
    /// Returns the centroid of the area (not of the vertices); the mean of the vertices where the area is zero.
    #[must_use]
    #[inline]
    pub fn centroid(&self) -> Vec2<S> {
        ring::centroid(self.as_slice())
    }
    /// Returns the mean of the vertices (not the centroid of the area).
    #[must_use]
    #[inline]
    pub fn vertex_mean(&self) -> Vec2<S> {
        vertex_mean(self.as_slice())
    }
    /// Returns the centre of the bounding box. Ties of bounds share the derivative.
    #[must_use]
    #[inline]
    pub fn center(&self) -> Vec2<S> {
        self.bounding().center()
    }
    /// Returns the second moments of the area about its centroid.
    #[must_use]
    #[inline]
    pub fn second_moments(&self) -> AreaMoments<S> {
        second_moments(&[self.as_slice()])
    }
}

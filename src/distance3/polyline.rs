//! Distances of points to polylines of space, as a fold over edges.
use super::formula::distance;
use crate::distance::share::Best;
use crate::scalar::Guard;
use crate::{Scalar, Segment3, Shape, Vec3};

/// The nearest of some edges: its distance, and the sum of all that tie with their number.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
pub struct NearestEdge3<S> {
    /// The distance of the nearest edge.
    pub distance: S,
    /// The sum of the distances of the edges that tie.
    pub sum: S,
    /// The number of nearest edges.
    #[shape(number)]
    pub count: S,
}

impl<S: Scalar> NearestEdge3<S> {
    /// Returns the state without edges: the largest finite number.
    #[must_use]
    #[inline(always)]
    pub fn empty() -> Self {
        let most = S::largest();
        NearestEdge3 {
            distance: most,
            sum: most,
            count: S::one(),
        }
    }
    /// Creates the fold of one edge for a point.
    #[must_use]
    #[inline(always)]
    pub fn of_edge(point: Vec3<S>, from: Vec3<S>, to: Vec3<S>) -> Self {
        let distance = distance(point, Segment3::new(from, to));
        NearestEdge3 {
            distance,
            sum: distance,
            count: S::one(),
        }
    }
    /// Returns the nearer of both; where they tie, both.
    #[must_use]
    #[inline(always)]
    pub fn join(self, other: Self) -> Self {
        let best = |one: Self| Best {
            value: one.distance,
            sum: one.sum,
            count: one.count,
        };
        let Best { value, sum, count } = best(self).less(best(other));
        NearestEdge3 {
            distance: value,
            sum,
            count,
        }
    }
    /// Returns the distance, to which edges that tie contribute equally.
    #[must_use]
    #[inline(always)]
    pub fn result(self) -> S {
        // With the bits of the distance itself: a third of three thirds need not be one.
        let mean = self.sum.over(self.count);
        mean.with_primal(self.distance.primal()).canonical()
    }
}

/// Returns the distance of a point and a polyline of space; without edges the largest finite number. Edges that tie
/// share the derivative equally.
///
/// ```
/// use geograd::{Vec3, distance3::polyline::distance_to_polyline};
/// let path = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(4.0, 0.0, 0.0), Vec3::new(4.0, 0.0, 4.0)];
/// assert_eq!(distance_to_polyline(Vec3::new(4.0, 3.0, 2.0), &path), 3.0);
/// ```
#[must_use]
pub fn distance_to_polyline<S: Scalar>(point: Vec3<S>, path: &[Vec3<S>]) -> S {
    let edges = path.windows(2);
    let seen = edges.map(|ends| NearestEdge3::of_edge(point, ends[0], ends[1]));
    let nearest = seen.fold(NearestEdge3::empty(), NearestEdge3::join);
    let guard = path.iter().fold(Guard::of(&point), |guard, v| guard.and(v));
    guard.result(nearest.result())
}

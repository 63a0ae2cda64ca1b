//! Distances of a point from polylines, rings and polygons of any kind, edge by edge.
//!
//! [`EdgeFold`] is the state of a fold over edges in any order: start with [`EdgeFold::empty`],
//! [`with_edge`](EdgeFold::with_edge) for every edge, [`join`](EdgeFold::join) partial results, and
//! [`signed_distance`](EdgeFold::signed_distance) at the end. A polygon with holes is the fold over the edges of all of
//! its rings, the holes clockwise (or, with [`Fill::EvenOdd`], in either orientation).
use super::edge::edge_winding;
pub use super::edge_fold::{EdgeFold, Fill};
use super::nearest_edge::nearest;
use crate::scalar::Guard;
use crate::{Scalar, Vec2};

/// Returns the distance from a point to the edges of a polyline, not negative; 0 with derivative zero on it. For a
/// single vertex the distance to it, for none the largest finite number.
///
/// Edges that are equally near share the derivative equally.
///
/// ```
/// use geograd::{Vec2, distance::ring::distance_to_polyline};
/// let path = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(4.0, 4.0)];
/// assert_eq!(distance_to_polyline(Vec2::new(1.0, 2.0), &path), 2.0);
/// ```
#[must_use]
#[inline]
pub fn distance_to_polyline<S: Scalar<Mask = bool>>(point: Vec2<S>, path: &[Vec2<S>]) -> S {
    known(point, path).result(fold_path(point, path).distance())
}

/// Returns the distance from a point to the edges of a ring, not negative, inside as outside.
#[must_use]
#[inline]
pub fn distance_to_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> S {
    known(point, ring).result(fold_ring(point, ring).distance())
}

/// Returns the signed distance from a point to a ring in either orientation: negative inside, by the winding
/// number. Self-intersecting rings are valid. Without vertices the largest finite number.
///
/// Derivatives: the unit vector from the nearest point of the ring (inside: towards it), to the ends of
/// its edge by the share with which they take part; exactly on an edge the outward normal, on a vertex
/// zero. Kinks: the points with several nearest edges, which share the derivative equally.
///
/// ```
/// use geograd::{Vec2, distance::ring::signed_distance_to_ring};
/// let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
/// assert_eq!(signed_distance_to_ring(Vec2::new(0.25, 0.5), &square), -0.25);
/// assert_eq!(signed_distance_to_ring(Vec2::new(2.0, 0.0), &square), 1.0);
/// ```
#[must_use]
#[inline]
pub fn signed_distance_to_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> S {
    known(point, ring).result(fold_ring(point, ring).signed_distance(Fill::NonZero))
}

/// Returns the winding number of a ring around a point. On the ring it is that of one of its sides.
///
/// ```
/// use geograd::{Vec2, distance::ring::winding_of_ring};
/// let clockwise = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)].map(|(x, y)| Vec2::new(x, y));
/// assert_eq!(winding_of_ring(Vec2::new(0.2, 0.2), &clockwise), -1.0);
/// ```
#[must_use]
#[inline]
pub fn winding_of_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> S {
    let turns = edges(ring).map(|(from, to)| edge_winding(point, from, to));
    known(point, ring).result(turns.fold(S::zero(), |sum, edge| sum + edge))
}

/// Returns a guard of a point and vertices. The comparisons of vertices are independent of each other.
#[inline(always)]
fn known<S: Scalar<Mask = bool>>(point: Vec2<S>, vertices: &[Vec2<S>]) -> Guard<S> {
    let is_known = |v: &Vec2<S>| v.x.equals(v.x) & v.y.equals(v.y);
    let guard = Guard::of(&point);
    match vertices.iter().fold(true, |all, v| all & is_known(v)) {
        true => guard,
        false => guard.and_number(S::lit(f64::NAN)),
    }
}

/// Returns the fold over the edges of a polyline; over its vertex where it has only one.
#[must_use]
#[inline]
pub fn fold_path<S: Scalar<Mask = bool>>(point: Vec2<S>, path: &[Vec2<S>]) -> EdgeFold<S> {
    if let [only] = path {
        return EdgeFold::of_edge(point, *only, *only);
    }
    nearest(point, path, false).unwrap_or_else(|| {
        path.windows(2).fold(EdgeFold::empty(), |state, ends| {
            state.with_edge(point, ends[0], ends[1])
        })
    })
}

/// Returns the fold over the edges of a ring.
#[must_use]
#[inline]
pub fn fold_ring<S: Scalar<Mask = bool>>(point: Vec2<S>, ring: &[Vec2<S>]) -> EdgeFold<S> {
    nearest(point, ring, true).unwrap_or_else(|| {
        edges(ring).fold(EdgeFold::empty(), |state, (from, to)| {
            state.with_edge(point, from, to)
        })
    })
}

/// Returns the edges of a ring, the closing one first.
#[inline(always)]
fn edges<S: Copy>(ring: &[Vec2<S>]) -> impl Iterator<Item = (Vec2<S>, Vec2<S>)> {
    let previous = ring.last().into_iter().chain(ring);
    previous.zip(ring).map(|(&from, &to)| (from, to))
}

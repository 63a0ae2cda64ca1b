//! The functions of [`distance3`](super) of shapes whose numbers are known to be finite.
use super::apart::Apart;
use super::outcome::{Contact3, PointPair3};
use crate::Scalar;

/// Returns the [`signed_distance`](super::signed_distance).
#[inline]
pub(crate) fn signed_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.relation_without_points(b).signed_distance()
}

/// Returns the [`distance`](super::distance()).
#[inline]
pub(crate) fn distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.relation_without_points(b).distance()
}

/// Returns the [`squared_distance`](super::squared_distance).
#[inline]
pub(crate) fn squared_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.relation_without_points(b).squared_distance()
}

/// Returns the [`closest_points`](super::closest_points).
#[inline]
pub(crate) fn closest_points<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> PointPair3<S> {
    a.relation(b).closest_points()
}

/// Returns the [`penetration`](super::penetration).
#[inline]
pub(crate) fn penetration<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> Contact3<S> {
    a.relation(b).penetration()
}

/// Returns the [`farthest_distance`](super::farthest_distance).
#[inline]
pub(crate) fn farthest_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.farthest(b)
}

//! The functions of [`distance3`](super) of shapes whose numbers are known to be finite.
use super::{Apart, Contact3, PointPair3};
use crate::Scalar;

/// [`signed_distance`](super::signed_distance).
#[inline]
pub(crate) fn signed_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.relation(b).apart.saturated().canonical()
}

/// [`distance`](super::distance()).
#[inline]
pub(crate) fn distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    let apart = a.relation(b).apart;
    S::select(apart.above(S::zero()), apart, S::zero())
        .saturated()
        .canonical()
}

/// [`squared_distance`](super::squared_distance).
#[inline]
pub(crate) fn squared_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.relation(b).square.saturated().canonical()
}

/// [`closest_points`](super::closest_points).
#[inline]
pub(crate) fn closest_points<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> PointPair3<S> {
    let found = a.relation(b);
    PointPair3 {
        on_a: found.on_a.canonical(),
        on_b: found.on_b.canonical(),
    }
}

/// [`penetration`](super::penetration).
#[inline]
pub(crate) fn penetration<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> Contact3<S> {
    let found = a.relation(b);
    let depth = -found.apart;
    Contact3 {
        depth: S::select(depth.above(S::zero()), depth, S::zero())
            .saturated()
            .canonical(),
        direction: found.normal.canonical(),
    }
}

/// [`farthest_distance`](super::farthest_distance).
#[inline]
pub(crate) fn farthest_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.farthest(b)
}

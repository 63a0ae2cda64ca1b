//! The quantities of a pair of convex shapes, as types: a [formula](super::pair) computes one of them.

/// [`signed_distance`](super::signed_distance).
pub(super) struct Signed;
/// [`distance`](super::distance()).
pub(super) struct Unsigned;
/// [`squared_distance`](super::squared_distance).
pub(super) struct Squared;
/// [`closest_points`](super::closest_points).
pub(super) struct Closest;
/// [`penetration`](super::penetration).
pub(super) struct Penetrating;
/// [`farthest_distance`](super::farthest_distance).
pub(super) struct Farthest;

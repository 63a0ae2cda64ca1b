//! Distances between any two convex shapes: points ([`Vec2`](crate::Vec2)), [`Line2`](crate::Line2),
//! [`Ray2`](crate::Ray2), [`Segment2`](crate::Segment2), [`Triangle2`](crate::Triangle2),
//! [`Aabb2`](crate::Aabb2), [`Obb2`](crate::Obb2), [`Circle`](crate::Circle),
//! [`Capsule2`](crate::Capsule2) and arrays of corners; and from a point to rings and polylines.
//!
//! Every shape is the hull of a few corners, inflated by a radius ([`Convex`]); two of them are
//! compared corner by edge where they are apart, and corner by face where they overlap.
//!
//! | function | gives |
//! | --- | --- |
//! | [`distance`] | the shortest way between the shapes; 0 where they touch or overlap |
//! | [`squared_distance`] | its square, smooth where the distance vanishes |
//! | [`signed_distance`] | the same, and minus the depth of overlap |
//! | [`closest_points`] | where: a point of each |
//! | [`penetration`] | how far to shift one of them until they only touch, and in which direction |
//! | [`farthest_distance`] | the longest way |
//! | [`farthest_points`] | from where to where it goes |
//! | [`segments::closest_points_of_segments`] | points and parameters of two segments |
//! | [`upright`] | what all of these do for two axis-aligned boxes: their bounds alone |
//! | [`turned`] | what all of these do for two rotated boxes: the frame of one of them, which keeps digits where faces are all but parallel |
//! | [`ring`] | distances of a point from polylines and polygons of any kind, edge by edge |
//!
//! The signed distance is positive outside. (DGAL's sign is the opposite, positive inside:
//! [`depth`].)
//!
//! # Derivatives
//!
//! By the envelope theorem the derivative of a distance is that of the segment between the two nearest points, held
//! fixed on their shapes. With n the unit vector from a to b it is n for a translation of b and −n for one of a,
//! wherever the points move to. A corner gets its weight in the nearest point; a radius gets −1.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Kinks: at distance zero the distance and its derivatives are 0 (the signed distance keeps its derivative
//! there). Pairs of corner and edge that are equally near, as for parallel edges, share the derivative and the
//! point equally. For two boxes face to face the points are the middle of the facing parts, or of the repetitions
//! of their ends. Faces that are equally deep share the derivative, and the direction is that of the first.
pub(crate) mod beam;
pub(crate) mod box_core;
pub(crate) mod convex;
pub(crate) mod cores;
mod corners;
pub(crate) mod edge;
mod edge_fold;
mod inherent;
mod nearest_edge;
mod outcome;
pub(crate) mod pair;
mod quantity;
pub(crate) mod relation;
pub mod ring;
pub mod segments;
pub mod shapes;
pub(crate) mod share;
pub mod turned;
pub mod upright;

pub use convex::{
    Convex, closest_points, depth, distance, farthest_distance, farthest_points, penetration,
    signed_distance, squared_distance,
};
pub(crate) use corners::Core;
pub use edge::{edge_distance, edge_squared_distance, edge_winding};
pub use outcome::{Contact, FarthestPoints, PointPair};
pub use shapes::repeat_last;

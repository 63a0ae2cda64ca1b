//! Distances between shapes of space: points ([`Vec3`](crate::Vec3)), [`Segment3`](crate::Segment3),
//! [`Triangle3`](crate::Triangle3), [`Tetrahedron`](crate::Tetrahedron), [`Aabb3`](crate::Aabb3),
//! [`YawBox3`](crate::YawBox3), [`Obb3`](crate::Obb3), [`RoundBox3`](crate::RoundBox3), [`Sphere`](crate::Sphere) and
//! [`Capsule3`](crate::Capsule3), any two of them; points and balls and [`Cylinder`](crate::Cylinder) and
//! [`Cone`](crate::Cone). Convex hulls ([`Hull3`](crate::Hull3)), each other and any of the first ten: by a search
//! ([`hulls`]). Cylinders, cones, [`Ellipsoid`](crate::Ellipsoid), [`Disc`](crate::Disc) and own shapes by their support
//! functions ([`BySupport`]), each other, hulls and any of the first ten: by another search ([`curved`]). Half-spaces
//! ([`Plane3`](crate::Plane3)), lines and rays ([`Line3`](crate::Line3), [`Ray3`](crate::Ray3)), and all of these; lines
//! and rays each other.
//!
//! ```
//! use geograd::{Obb3, Rotation3, Vec3, distance3::signed_distance};
//! let size = Vec3::new(4.0_f64, 2.0, 2.0);
//! let shape = Obb3::new(Vec3::new(1.0, 0.0, 0.0), size, Rotation3::identity());
//! assert_eq!(signed_distance(Vec3::new(6.0, 5.0, 0.0), shape), 5.0); // an edge is nearest
//! assert_eq!(signed_distance(Vec3::new(1.5, 0.0, 0.75), shape), -0.25);
//! ```
//!
//! Every shape is the hull of a few corners, inflated by a radius (`Cored`). Plain numbers decide which features are
//! nearest: two shapes are compared corner by face, corner by edge and edge by edge where they are apart, by the
//! normals of faces and of pairs of edges where they overlap. The distance of the chosen features is then computed
//! once, with derivatives. No tolerance decides: a candidate for the distance is the distance of two points that exist,
//! a candidate for the depth a gap along a direction of length one, so that wrong decisions cost roundings.
//!
//! | function | gives |
//! | --- | --- |
//! | [`distance()`] | the shortest way between the shapes; 0 where they touch or overlap |
//! | [`squared_distance`] | its square, smooth where the distance vanishes |
//! | [`signed_distance`] | the same, and minus the depth of overlap |
//! | [`closest_points`] | where: a point of each |
//! | [`penetration`] | how far to shift one of them until they only touch, and in which direction |
//! | [`contacts`] | where they lie on each other: up to eight pairs of points |
//! | [`farthest_distance`] | the longest way |
//!
//! # Shapes and verbs
//!
//! Batches of a verb take the pairs that have a row (the table of [`verbs`](crate::kernels::verbs)), any other pair of
//! this table by [`function`](crate::kernels::verbs::function). D stands for
//! [`Distance`](crate::kernels::verbs::Distance), Q for `SquaredDistance`, S for `SignedDistance`, C for `ClosestPoints`, P for `Penetration`, F for `FarthestDistance`.
//! A capital is a row of the list by name, a small letter a method without one, `-` what there is not. Cylinders, cones,
//! ellipsoids and discs have rows of D and S with each other and with all that end but hulls, of which the list has some.
//!
//! | | point | ball | segment | capsule | triangle | tetrahedron | box | round box |
//! | --- | --- | --- | --- | --- | --- | --- | --- | --- |
//! | point | D q s c p f | D q S c p f | D Q s C p f | D q S c p f | D Q s C p f | D q S c p f | D q S c p F | d q S c p f |
//! | ball | | D q S c P f | d q S c p f | D q S c p f | d q S c p f | d q S c p f | D q S C P f | d q S c p f |
//! | segment | | | D Q s C p f | d q S c p f | D q s c p f | D q s c p f | D q s c p f | D q s c p f |
//! | capsule | | | | D q S C P F | d q S c p f | d q S c p f | D q S C P f | d q S c p f |
//! | triangle | | | | | D Q S C p f | D q s c p f | D q s c p f | D q s c p f |
//! | tetrahedron | | | | | | D q S c p f | D q S c p f | D q S c p f |
//! | box | | | | | | | D Q S C P F | d q S c p f |
//! | upright box, two | | | | | | | D Q S C P F | |
//! | round box | | | | | | | | d q S c p f |
//! | half-space | d q S c p - | d q S c p - | d q S c p - | d q S c P - | d q S c p - | d q S c p - | d q S c P - | d q S c p - |
//! | cylinder | D q S c p f | d q S c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q S c P f | d q s c p f |
//! | cone | D q S c p f | d q S c p f | d q s c p f | D q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f |
//! | ellipsoid | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s C p f | d q s c p f |
//! | disc | D q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q S c p f | d q s c p f | d q s c p f |
//! | own shape | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f | d q s c p f |
//! | hull | D q S C p f | D q S C P f | D q s c p f | D q S C P f | D q S c p f | D q S c p f | D q S C P f | D q S c P f |
//!
//! | line | D q s C p - | d q S c p - | D q s c p - | D q s c p - | D q s c p - | D q s c p - | D q s c p - | D q s c p - |
//! | ray | D q s c p - | d q S c p - | D q s c p - | D q s c p - | D q s c p - | D q s c p - | D q s c p - | D q s c p - |
//!
//! Two hulls have D Q S C P f, a half-space and a hull d q S c P. Cylinders, cones, ellipsoids and discs have d q s c p f
//! among themselves (two cylinders S, two ellipsoids D S C P), and d q s c p, some of them S, from
//! half-spaces. Own shapes have d q s c p f from these, hulls and curved shapes d q s c p f, and lines and rays d q s c p
//! from both, for one item at a time. Lines and rays have d q s c p among themselves, any two D, two lines C, too. For a
//! solid, the part of them near it counts; its ends are rounded as the solid's corners are. Rays, lines and segments
//! against solids: [`intersection3`](crate::intersection3).
//!
//! # Derivatives
//!
//! By the envelope theorem the derivative of a distance is that of the segment between the two nearest points, held
//! fixed on their shapes. Second derivatives follow from the features that touch: a corner's, an edge's, a plane's.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Kinks: at distance zero the distance and its derivatives are 0 (the signed distance keeps its derivative there).
//! Features that are equally near share the derivative and the point equally: for parallel faces it is the mean of the
//! corners of their overlap, seen along the normal, crossings of edges included. If shapes other than two boxes overlap
//! along parallel faces, the corners with a foot on the other face count; without any, the crossings of edges. Where
//! several planes are equally deep they share the derivative, and direction and points are those of the first.
//! Distances of two lines or rays jump where they become parallel: at an angle φ between them a rounding ε of a
//! direction turns their common normal by ε/φ, and moves the distance by that share of the distance between the given
//! points. Across a face the signed distance is smooth, along an edge or at a corner of the border it is not. Pairs
//! without a volume between them, such as two segments, have no depth.
//!
//! Contacts: where a gap is as small as the roundings of the coordinates, the vector between nearest points is mostly
//! rounding. Shapes less than some roundings of their size apart have the direction of a plane that separates them, one
//! of several. Beyond that a direction errs by a rounding of the size over the gap.
pub(crate) mod apart;
mod aside;
mod between;
pub(crate) mod box_core;
pub(crate) mod boxes;
mod contact;
mod contact_points;
pub(crate) mod core;
pub(crate) mod cored;
pub mod curved;
pub(crate) mod decided;
pub(crate) mod deep;
mod enclosed;
mod endless;
mod face_bracket;
mod facing;
pub(crate) mod formula;
mod gjk;
pub(crate) mod half_space;
pub mod hulls;
mod inherent;
mod manifold;
mod manifold_record;
mod manifold_search;
mod mix;
pub(crate) mod near;
mod outcome;
mod pair;
pub(crate) mod parting;
pub mod polyline;
mod polytope;
pub(crate) mod relation;
pub(crate) mod round;
pub(crate) mod simplex;
pub(crate) mod spot;
pub(crate) mod straight;

pub use apart::{
    Apart, closest_points, distance, farthest_distance, penetration, signed_distance,
    squared_distance,
};
pub use contact_points::{ContactPoint3, Contacts3};
pub use curved::{BySupport, SupportFunction};
pub(crate) use face_bracket::{Bracket, FaceBracket};
pub use manifold::contacts;
pub(crate) use manifold_record::ContactRecord;
pub use outcome::{Contact3, PointPair3};

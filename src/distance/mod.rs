//! Distances between any two convex shapes: points ([`Vec2`]), [`Line2`](crate::Line2),
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
//! By the envelope theorem the derivative of a distance is that of the way between the two nearest points,
//! held fixed on their shapes: with n the unit vector from a to b it is n for a shift of b and −n for a
//! shift of a, wherever the points move to. A corner gets the share with which it takes part in the
//! nearest point; a radius gets −1.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Kinks: at distance zero the distance and its derivatives are 0 (the signed distance keeps its derivative
//! there). Pairs of corner and edge that are equally near, as for parallel edges, share the derivative and the
//! point equally. For two boxes face to face the points are the middle of the facing parts, or of the repetitions
//! of their ends. Faces that are equally deep share the derivative, and the direction is that of the first.
use crate::scalar::Guard;
use crate::{Scalar, Vec2};

pub(crate) mod beam;
pub(crate) mod box_core;
pub(crate) mod convex;
pub(crate) mod cores;
pub(crate) mod edge;
mod edge_fold;
mod guarded;
mod nearest_edge;
pub(crate) mod pair;
pub(crate) mod relation;
pub mod ring;
pub mod segments;
pub mod shapes;
pub(crate) mod share;
pub mod turned;
pub mod upright;

pub use convex::{Convex, Core};
pub use edge::{edge_distance, edge_squared_distance, edge_winding};
use guarded::Guarded;
use pair as formula;
pub use shapes::repeat_last;

/// A point of each of two shapes.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointPair<S> {
    /// The point of a.
    pub on_a: Vec2<S>,
    /// The point of b.
    pub on_b: Vec2<S>,
}

/// A point of each of two shapes, as far apart as any.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FarthestPoints<S> {
    /// The point of a.
    pub on_a: Vec2<S>,
    /// The point of b.
    pub on_b: Vec2<S>,
}

/// The penetration depth of two shapes, and the direction in which it is least.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact<S> {
    /// The length of the shortest shift after which the shapes only touch; 0 where they are apart.
    pub depth: S,
    /// The direction, of length one, of that shift of b; where they are apart, the direction from a
    /// to b. Zero where two points coincide and no direction is preferred.
    pub direction: Vec2<S>,
}

/// The signed distance of two convex shapes, in the unit of length: the shortest way between them, or
/// minus the length of the shortest shift after which they only touch.
///
/// Minus the largest finite number for two lines that cross. Derivatives and kinks: see the
/// [module](self); on the border of a shape with an area it is smooth.
///
/// ```
/// use geograd::{Aabb2, Circle, Vec2, distance::signed_distance};
/// let square = Aabb2::new(-1.0, -1.0, 1.0, 1.0);
/// assert_eq!(signed_distance(Vec2::new(0.5, 0.0), square), -0.5);
/// assert_eq!(signed_distance(square, Circle::new(Vec2::new(4.0, 5.0), 2.0)), 3.0);
/// // On the extension of an edge is outside.
/// assert_eq!(signed_distance(Vec2::new(3.0, 1.0), square), 2.0);
/// ```
#[must_use]
#[inline]
pub fn signed_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<formula::Signed>, B>(b)
}

/// The signed distance with DGAL's sign, in the unit of length: positive where shapes overlap, negative apart.
///
/// It measures what is to stay inside, such as a robot in its lane. The free way to an obstacle is [`distance`].
///
/// ```
/// use geograd::{Aabb2, Vec2, distance::depth};
/// assert_eq!(depth(Aabb2::new(-1.0, -1.0, 1.0, 1.0), Vec2::new(0.5, 0.0)), 0.5);
/// ```
#[must_use]
#[inline]
pub fn depth<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    (-signed_distance(a, b)).canonical()
}

/// The distance of two convex shapes, in the unit of length; 0 with derivative zero where they touch or
/// overlap.
///
/// Derivatives and kinks: see the [module](self).
///
/// ```
/// use geograd::{Obb2, Segment2, Vec2, distance::distance};
/// let car = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// let curb = Segment2::new(Vec2::new(5.0, 5.0), Vec2::new(9.0, 5.0));
/// assert_eq!(distance(car, curb), 5.0);
/// assert_eq!(distance(curb, curb.from), 0.0);
/// ```
#[must_use]
#[inline]
pub fn distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<formula::Unsigned>, B>(b)
}

/// The squared distance of two convex shapes; 0 where they touch or overlap. Once differentiable
/// wherever the nearest points are. Saturates at the largest finite number.
///
/// ```
/// use geograd::{Segment2, Vec2, distance::squared_distance};
/// let curb = Segment2::new(Vec2::new(0.0, 1.0), Vec2::new(9.0, 1.0));
/// assert_eq!(squared_distance(curb, Vec2::new(-3.0, 5.0)), 25.0);
/// ```
#[must_use]
#[inline]
pub fn squared_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<formula::Squared>, B>(b)
}

/// The points in which two convex shapes are nearest to each other.
///
/// For shapes that overlap they are the points that [`penetration`] brings together: `on_b` is that point of b
/// which is deepest in a (or the reverse), `on_a` the point of a's border to which it must go. Circles with one
/// centre, and other round shapes whose cores meet in a point, leave each other by several ways; the points are those
/// of one. Ties and derivatives: see the [module](self). The points of two lines that cross are nearest to each
/// other's given points and mean nothing.
///
/// ```
/// use geograd::{Aabb2, Circle, Vec2, distance::closest_points};
/// let found = closest_points(Aabb2::new(0.0, 0.0, 2.0, 2.0), Circle::new(Vec2::new(5.0, 1.0), 1.0));
/// assert_eq!((found.on_a, found.on_b), (Vec2::new(2.0, 1.0), Vec2::new(4.0, 1.0)));
/// ```
#[must_use]
#[inline]
pub fn closest_points<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> PointPair<S> {
    a.take_formula::<Guarded<formula::Closest>, B>(b)
}

/// How deep two convex shapes are in each other, and in which direction b leaves a by the shortest
/// way.
///
/// The depth has derivatives by the envelope theorem, like a distance; it is 0 with derivative zero where the
/// shapes are apart or touch, and the largest finite number for two lines that cross.
///
/// ```
/// use geograd::{Aabb2, Obb2, Vec2, distance::penetration};
/// let found = penetration(Aabb2::new(0.0, 0.0, 4.0, 4.0), Obb2::new(4.5, 2.0, 2.0, 2.0, 0.0));
/// assert_eq!((found.depth, found.direction), (0.5, Vec2::new(1.0, 0.0)));
/// ```
#[must_use]
#[inline]
pub fn penetration<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> Contact<S> {
    a.take_formula::<Guarded<formula::Penetrating>, B>(b)
}

/// The longest distance of a point of one shape from a point of the other, in the unit of length. For
/// bounded shapes; of a ray or a line only the given point counts.
///
/// Pairs of corners that are equally far share the derivative; two equal points have derivative zero.
///
/// ```
/// use geograd::{Aabb2, distance::farthest_distance};
/// // A small box in a large one: from a corner to the opposite corner of the other.
/// let found = farthest_distance(Aabb2::new(0.0, 0.0, 10.0, 10.0), Aabb2::new(4.0, 4.0, 6.0, 6.0));
/// assert_eq!(found, 72.0_f64.sqrt());
/// ```
#[must_use]
#[inline]
pub fn farthest_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<formula::Farthest>, B>(b)
}

/// The points between which [`farthest_distance`] is: corners of both, or the points of round shapes beyond their
/// centres and ends. For bounded shapes; only the given point of a ray or a line counts.
///
/// The first of several pairs that are equally far counts, along a's corners and then b's, so that both are
/// corners: points jump where pairs tie. Round shapes with one centre have two ends of one diameter.
///
/// ```
/// use geograd::{Aabb2, Circle, Vec2, distance::farthest_points};
/// let square = Aabb2::new(0.0, 0.0, 10.0, 10.0);
/// let found = farthest_points(square, Vec2::new(6.0, 4.0));
/// assert_eq!((found.on_a, found.on_b), (Vec2::new(0.0, 10.0), Vec2::new(6.0, 4.0)));
/// let found = farthest_points(Vec2::new(0.0, 0.0), Circle::new(Vec2::new(3.0, 4.0), 5.0));
/// assert_eq!(found.on_b, Vec2::new(6.0, 8.0));
/// ```
#[must_use]
#[inline]
pub fn farthest_points<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> FarthestPoints<S> {
    let (core_a, core_b) = (a.core(), b.core());
    let origin = core_a.anchor();
    let scale = edge::scale_of::<S>(core_a.extent(origin).most(core_b.extent(origin)));
    let (seen_a, seen_b) = (core_a.placed(origin, scale), core_b.placed(origin, scale));
    let (from, to) = (core_a.corners(), core_b.corners());
    let (seen_a, seen_b) = (seen_a.corners(), seen_b.corners());
    let corners = seen_a.as_ref().iter().zip(from.as_ref());
    let candidates = corners.flat_map(|(&p, &on_a)| {
        let others = seen_b.as_ref().iter().zip(to.as_ref());
        others.map(move |(&q, &on_b)| (q - p, on_a, on_b))
    });
    let farther = |best: (Vec2<S>, Vec2<S>, Vec2<S>), other: (Vec2<S>, Vec2<S>, Vec2<S>)| {
        let keep = other.0.length_squared().at_most(best.0.length_squared());
        let pick = |x, y| Vec2::select(keep, x, y);
        (
            pick(best.0, other.0),
            pick(best.1, other.1),
            pick(best.2, other.2),
        )
    };
    let best = candidates.reduce(farther);
    let (way, mut on_a, mut on_b) = best.expect("a core has at least one corner");
    if A::ROUND || B::ROUND {
        let none = way.x.equals(S::zero()) & way.y.equals(S::zero());
        let along = Vec2::new(S::one(), S::zero());
        let direction = relation::direction(Vec2::select(none, along, way));
        on_a -= direction * a.radius();
        on_b += direction * b.radius();
    }
    b.guarded(a.guarded(Guard::new())).result(FarthestPoints {
        on_a: on_a.canonical(),
        on_b: on_b.canonical(),
    })
}

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

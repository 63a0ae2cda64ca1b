//! Pairs of shapes of space that have distances, and the functions of any of them.
use super::core::{Core3, PointCore};
use super::cored::InflatedCore;
use super::facing::{Patch, PatchName};
use super::half_space::{self, Bounded};
use super::outcome::{Contact3, PointPair3};
use super::relation::Relation;
use super::{aside, between, boxes, round};
use crate::scalar::Guard;
use crate::shape::{Cone, Cylinder, Plane3};
use crate::{Scalar, Vec3};

/// Two shapes of space that are some distance apart: `a.distance(b)` and alike.
///
/// Any two convex shapes with a core are, a half-space ([`Plane3`]) and anything that ends, and curved shapes and any of
/// these.
///
/// ```
/// use geograd::distance3::Apart;
/// use geograd::{Capsule3, Plane3, Sphere, Vec3};
/// let link = Capsule3::new(Vec3::new(0.0, 0.0, 2.0), Vec3::new(3.0, 0.0, 2.0), 0.5);
/// let ball = Sphere::new(Vec3::new(1.0, 4.0, 2.0), 1.0);
/// assert_eq!(link.distance(ball), 2.5);
/// let floor = Plane3::new(Vec3::new(0.0, 0.0, 1.0), 0.0);
/// assert_eq!(floor.signed_distance(link), 1.5);
/// assert_eq!(floor.penetration(Sphere::new(ball.center, 5.0)).depth, 3.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "the methods of distances do not take `{Self}` and `{B}`",
    label = "no distance from `{B}`",
    note = "half-spaces have none from half-spaces, lines and rays"
)]
pub trait Apart<B>: Copy {
    /// Their numbers.
    type Scalar: Scalar;
    /// Returns the relation of the shapes to each other.
    #[doc(hidden)]
    fn relation(self, other: B) -> Relation<Self::Scalar>;
    /// Returns the relation, whose normal and points may be zero. By default it has them.
    #[doc(hidden)]
    #[inline]
    fn relation_without_points(self, other: B) -> Relation<Self::Scalar> {
        self.relation(other)
    }
    /// Returns the longest distance. By default that of a shape without end.
    #[doc(hidden)]
    #[inline]
    fn farthest(self, _other: B) -> Self::Scalar {
        Self::Scalar::largest()
    }
    /// Returns the faces of both that face each other along a direction from a to b. By default one point each.
    #[doc(hidden)]
    #[inline]
    fn facing(&self, _other: &B, _normal: Vec3<Self::Scalar>) -> [PatchName; 2]
    where
        Self::Scalar: Scalar<Mask = bool>,
    {
        [PatchName::Spot; 2]
    }
    /// Returns these faces.
    #[doc(hidden)]
    #[inline]
    fn patches(
        &self,
        _other: &B,
        _names: [PatchName; 2],
        _normal: Vec3<Self::Scalar>,
    ) -> [Patch<Self::Scalar>; 2] {
        [Patch::Spot; 2]
    }
    /// Returns a guard of the numbers of both.
    #[doc(hidden)]
    fn guarded_with(&self, other: &B) -> Guard<Self::Scalar>;
    /// Returns the longest distance: [`farthest_distance`](super::farthest_distance).
    #[must_use]
    #[inline]
    fn farthest_distance(self, other: B) -> Self::Scalar {
        farthest_distance(self, other)
    }
    /// Returns the distance, 0 where the shapes touch or overlap: [`distance`](super::distance()).
    #[must_use]
    #[inline]
    fn distance(self, other: B) -> Self::Scalar {
        distance(self, other)
    }
    /// Returns the square of the distance: [`squared_distance`](super::squared_distance).
    #[must_use]
    #[inline]
    fn squared_distance(self, other: B) -> Self::Scalar {
        squared_distance(self, other)
    }
    /// Returns the distance, or minus the depth of overlap: [`signed_distance`](super::signed_distance).
    #[must_use]
    #[inline]
    fn signed_distance(self, other: B) -> Self::Scalar {
        signed_distance(self, other)
    }
    /// Returns a point of each, nearest to each other: [`closest_points`](super::closest_points).
    #[must_use]
    #[inline]
    fn closest_points(self, other: B) -> PointPair3<Self::Scalar> {
        closest_points(self, other)
    }
    /// Returns the depth of the overlap and the shortest direction that separates the shapes:
    /// [`penetration`](super::penetration).
    #[must_use]
    #[inline]
    fn penetration(self, other: B) -> Contact3<Self::Scalar> {
        penetration(self, other)
    }
}

/// Returns the signed distance of two shapes of space, in the unit of length: the distance of their nearest points, or
/// minus the length of the shortest translation after which they only touch.
///
/// Derivatives and kinks: see the [module](super).
///
/// ```
/// use geograd::{Obb3, Rotation3, Sphere, Vec3, distance3::signed_distance};
/// let cube = Obb3::new(Vec3::zero(), Vec3::new(2.0, 2.0, 2.0), Rotation3::identity());
/// assert_eq!(signed_distance(cube, Sphere::new(Vec3::new(0.0, 4.0, 5.0), 2.0)), 3.0);
/// let above = Obb3::new(Vec3::new(0.5, 0.5, 1.75), cube.size, cube.rotation);
/// assert_eq!(signed_distance(cube, above), -0.25);
/// ```
#[must_use]
#[inline]
pub fn signed_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.guarded_with(&b)
        .result(a.relation_without_points(b).signed_distance())
}

/// Returns the distance of two shapes of space, in the unit of length; 0 with derivative zero where they touch or
/// overlap.
///
/// Derivatives and kinks: see the [module](super).
///
/// ```
/// use geograd::{Aabb3, Segment3, Vec3, distance3::distance};
/// let shape = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0));
/// assert_eq!(distance(Vec3::new(0.5, 4.0, 5.0), shape), 5.0);
/// assert_eq!(distance(Vec3::new(0.5, 0.5, 0.5), shape), 0.0);
/// let wire = Segment3::new(Vec3::new(-9.0, 0.5, 3.0), Vec3::new(9.0, 0.5, 3.0));
/// assert_eq!(distance(shape, wire), 2.0);
/// ```
#[must_use]
#[inline]
pub fn distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.guarded_with(&b)
        .result(a.relation_without_points(b).distance())
}

/// Returns the squared distance of two shapes of space; 0 where they touch or overlap. Once differentiable wherever the
/// nearest points are. Saturates at the largest finite number.
///
/// ```
/// use geograd::{Segment3, Vec3, distance3::squared_distance};
/// let wire = Segment3::new(Vec3::new(0.0, 0.0, 1.0), Vec3::new(9.0, 0.0, 1.0));
/// assert_eq!(squared_distance(wire, Vec3::new(-3.0, 0.0, 5.0)), 25.0);
/// ```
#[must_use]
#[inline]
pub fn squared_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.guarded_with(&b)
        .result(a.relation_without_points(b).squared_distance())
}

/// Returns the points in which two shapes of space are nearest to each other.
///
/// Overlapping shapes have the points that [`penetration`] brings together. Balls with one centre, and other round
/// shapes whose cores meet in a point, leave each other in several directions; the points are those of one. Ties and
/// derivatives: see the [module](super).
///
/// ```
/// use geograd::{Segment3, Vec3, distance3::closest_points};
/// let wire = Segment3::new(Vec3::new(0.0, 0.0, 1.0), Vec3::new(8.0, 0.0, 1.0));
/// let rail = Segment3::new(Vec3::new(2.0, 3.0, 1.0), Vec3::new(4.0, 3.0, 1.0));
/// let found = closest_points(wire, rail); // the middle of what faces each other
/// assert_eq!((found.on_a, found.on_b), (Vec3::new(3.0, 0.0, 1.0), Vec3::new(3.0, 3.0, 1.0)));
/// ```
#[must_use]
#[inline]
pub fn closest_points<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> PointPair3<S> {
    a.guarded_with(&b).result(a.relation(b).closest_points())
}

/// Returns the depth by which two shapes of space overlap, and the direction in which b leaves a by the shortest
/// translation.
///
/// The depth has derivatives by the envelope theorem, like a distance; it is 0 with derivative zero where the shapes
/// are apart or touch.
///
/// ```
/// use geograd::{Plane3, Sphere, Vec3, distance3::penetration};
/// let floor = Plane3::new(Vec3::new(0.0, 0.0, 2.0), 0.0);
/// let found = penetration(floor, Sphere::new(Vec3::new(7.0, 0.0, 0.5), 1.0));
/// assert_eq!((found.depth, found.direction), (0.5, Vec3::new(0.0, 0.0, 1.0)));
/// ```
#[must_use]
#[inline]
pub fn penetration<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> Contact3<S> {
    a.guarded_with(&b).result(a.relation(b).penetration())
}

/// Returns the longest distance of a point of one shape of space from a point of the other, in the unit of length.
///
/// Pairs of corners that are equally far share the derivative; two equal points have derivative zero. A shape without
/// end has the largest finite number, with derivative zero.
///
/// ```
/// use geograd::{Sphere, Tetrahedron, Vec3, distance3::farthest_distance};
/// let [x, y, z] = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];
/// let corner = Tetrahedron::new(Vec3::zero(), x, y, z);
/// assert_eq!(farthest_distance(corner, Sphere::new(Vec3::new(5.0, 0.0, 0.0), 2.0)), 26.0_f64.sqrt() + 2.0);
/// ```
#[must_use]
#[inline]
pub fn farthest_distance<S: Scalar, A: Apart<B, Scalar = S>, B>(a: A, b: B) -> S {
    a.guarded_with(&b).result(a.farthest(b))
}

impl<A: InflatedCore, B: InflatedCore<Scalar = A::Scalar>> Apart<B> for A {
    type Scalar = A::Scalar;
    #[inline(always)]
    fn guarded_with(&self, other: &B) -> Guard<A::Scalar> {
        Guard::of(self).and(other)
    }
    #[inline(always)]
    fn relation(self, other: B) -> Relation<A::Scalar> {
        let found = match (self.bounds(), other.bounds()) {
            (Some(a), Some(b)) => boxes::upright(a, b),
            _ => between::relate(self.core(), other.core()),
        };
        let found = match (A::Core::DIMENSION, B::Core::DIMENSION) {
            (0, _) => from_point(found, self.core().anchor(), &other),
            (_, 0) => from_point(found, other.core().anchor(), &self),
            _ => found,
        };
        match A::ROUND || B::ROUND {
            true => {
                let aside = aside::of_cores(self.core(), other.core());
                found.inflated(self.radius(), other.radius(), aside)
            }
            false => found,
        }
    }
    #[inline]
    fn facing(&self, other: &B, normal: Vec3<A::Scalar>) -> [PatchName; 2]
    where
        A::Scalar: Scalar<Mask = bool>,
    {
        [self.face(normal), other.face(-normal)]
    }
    #[inline]
    fn patches(
        &self,
        other: &B,
        [a, b]: [PatchName; 2],
        normal: Vec3<A::Scalar>,
    ) -> [Patch<A::Scalar>; 2] {
        [self.patch(a, normal), other.patch(b, -normal)]
    }
    #[inline]
    fn farthest(self, other: B) -> A::Scalar {
        let longest = match (self.bounds(), other.bounds()) {
            (Some(a), Some(b)) => boxes::farthest_upright(a, b).saturated(),
            _ => between::farthest(self.core(), other.core()),
        };
        (longest + (self.radius() + other.radius())).canonical()
    }
}

/// Returns the distances of a point from a point and from a box, in place of those by their cores.
#[inline(always)]
fn from_point<B: InflatedCore>(
    found: Relation<B::Scalar>,
    point: Vec3<B::Scalar>,
    other: &B,
) -> Relation<B::Scalar> {
    if B::Core::DIMENSION == 0 {
        let way = other.core().anchor() - point;
        return Relation {
            apart: way.length(),
            square: way.length_squared(),
            ..found
        };
    }
    match other.beyond(point) {
        Some(beyond) => Relation {
            apart: boxes::signed(beyond),
            square: boxes::open(beyond).length_squared(),
            ..found
        },
        None => found,
    }
}

impl<S: Scalar, B: Bounded<Scalar = S>> Apart<B> for Plane3<S> {
    type Scalar = S;
    #[inline(always)]
    fn guarded_with(&self, other: &B) -> Guard<S> {
        other.with_numbers(Guard::of(self))
    }
    #[inline(always)]
    fn relation(self, other: B) -> Relation<S> {
        half_space::relate(self, other)
    }
    #[inline]
    fn facing(&self, other: &B, normal: Vec3<S>) -> [PatchName; 2]
    where
        S: Scalar<Mask = bool>,
    {
        [PatchName::Plane, other.face(-normal)]
    }
    #[inline]
    fn patches(&self, other: &B, [_, b]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
        [Patch::Plane, other.patch(b, -normal)]
    }
}

impl<S: Scalar, A: Bounded<Scalar = S>> Apart<Plane3<S>> for A {
    type Scalar = S;
    #[inline(always)]
    fn guarded_with(&self, other: &Plane3<S>) -> Guard<S> {
        self.with_numbers(Guard::of(other))
    }
    #[inline(always)]
    fn relation(self, other: Plane3<S>) -> Relation<S> {
        half_space::relate(other, self).flipped()
    }
    #[inline]
    fn facing(&self, _: &Plane3<S>, normal: Vec3<S>) -> [PatchName; 2]
    where
        S: Scalar<Mask = bool>,
    {
        [self.face(normal), PatchName::Plane]
    }
    #[inline]
    fn patches(&self, _: &Plane3<S>, [a, _]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
        [self.patch(a, normal), Patch::Plane]
    }
}

macro_rules! revolved {
    ($($Shape:ident)*) => { $(
        impl<S: Scalar, A: InflatedCore<Scalar = S, Core = PointCore<S>>> Apart<$Shape<S>> for A {
            type Scalar = S;
            #[inline(always)]
            fn guarded_with(&self, other: &$Shape<S>) -> Guard<S> {
                Guard::of(other).and(self)
            }
            #[inline(always)]
            fn relation(self, other: $Shape<S>) -> Relation<S> {
                let found = round::relate(self.core().0, other);
                match A::ROUND {
                    true => found.inflated(self.radius(), S::zero(), found.normal),
                    false => found,
                }
            }
            #[inline]
            fn farthest(self, other: $Shape<S>) -> S {
                (round::farthest(self.core().0, other) + InflatedCore::radius(&self)).canonical()
            }
        }
        impl<S: Scalar, B: InflatedCore<Scalar = S, Core = PointCore<S>>> Apart<B> for $Shape<S> {
            type Scalar = S;
            #[inline(always)]
            fn guarded_with(&self, other: &B) -> Guard<S> {
                Guard::of(self).and(other)
            }
            #[inline(always)]
            fn relation(self, other: B) -> Relation<S> {
                other.relation(self).flipped()
            }
            #[inline]
            fn farthest(self, other: B) -> S {
                other.farthest(self)
            }
        }
    )* };
}
revolved! { Cylinder Cone }

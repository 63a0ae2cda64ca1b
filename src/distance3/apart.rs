//! Pairs of shapes of space that have distances.
use super::core::{Core, PointCore};
use super::cored::Cored;
use super::half_space::{self, Bounded};
use super::relation::Relation;
use super::{aside, between, boxes, round};
use crate::scalar::Guard;
use crate::shape::{Cone, Cylinder, Plane3};
use crate::{Scalar, Vec3};

/// Two shapes of space that are some distance apart: `a.distance(b)` and alike.
///
/// Any two convex shapes with a core are, a half-space ([`Plane3`]) and anything that ends, and a point or ball and a
/// cylinder or cone.
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
    note = "cylinders and cones have distances from points, balls and half-spaces"
)]
pub trait Apart<B>: Copy {
    /// Their numbers.
    type Scalar: Scalar;
    /// The relation of the shapes to each other.
    #[doc(hidden)]
    fn relation(self, other: B) -> Relation<Self::Scalar>;
    /// The longest distance. By default that of a shape without end.
    #[doc(hidden)]
    #[inline]
    fn farthest(self, _other: B) -> Self::Scalar {
        Self::Scalar::lit(Self::Scalar::LARGEST)
    }
    /// A guard of the numbers of both.
    #[doc(hidden)]
    fn guarded_with(&self, other: &B) -> Guard<Self::Scalar>;
    /// The longest distance: [`farthest_distance`](super::farthest_distance).
    #[must_use]
    #[inline]
    fn farthest_distance(self, other: B) -> Self::Scalar {
        super::farthest_distance(self, other)
    }
    /// The distance, 0 where the shapes touch or overlap: [`distance`](super::distance()).
    #[must_use]
    #[inline]
    fn distance(self, other: B) -> Self::Scalar {
        super::distance(self, other)
    }
    /// The square of the distance: [`squared_distance`](super::squared_distance).
    #[must_use]
    #[inline]
    fn squared_distance(self, other: B) -> Self::Scalar {
        super::squared_distance(self, other)
    }
    /// The distance, or minus the depth of overlap: [`signed_distance`](super::signed_distance).
    #[must_use]
    #[inline]
    fn signed_distance(self, other: B) -> Self::Scalar {
        super::signed_distance(self, other)
    }
    /// A point of each, nearest to each other: [`closest_points`](super::closest_points).
    #[must_use]
    #[inline]
    fn closest_points(self, other: B) -> super::PointPair3<Self::Scalar> {
        super::closest_points(self, other)
    }
    /// How deep the shapes overlap, and the way out: [`penetration`](super::penetration).
    #[must_use]
    #[inline]
    fn penetration(self, other: B) -> super::Contact3<Self::Scalar> {
        super::penetration(self, other)
    }
}

impl<A: Cored, B: Cored<Scalar = A::Scalar>> Apart<B> for A {
    type Scalar = A::Scalar;
    #[inline(always)]
    fn guarded_with(&self, other: &B) -> Guard<A::Scalar> {
        other.guarded(self.guarded(Guard::new()))
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
    fn farthest(self, other: B) -> A::Scalar {
        let longest = match (self.bounds(), other.bounds()) {
            (Some(a), Some(b)) => boxes::farthest_upright(a, b).saturated(),
            _ => between::farthest(self.core(), other.core()),
        };
        (longest + (self.radius() + other.radius())).canonical()
    }
}

/// The distances of a point from a point and from a box, in place of those by their cores.
#[inline(always)]
fn from_point<B: Cored>(
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
        other.all_guarded(Guard::of(self))
    }
    #[inline(always)]
    fn relation(self, other: B) -> Relation<S> {
        half_space::relate(self, other)
    }
}

impl<S: Scalar, A: Bounded<Scalar = S>> Apart<Plane3<S>> for A {
    type Scalar = S;
    #[inline(always)]
    fn guarded_with(&self, other: &Plane3<S>) -> Guard<S> {
        self.all_guarded(Guard::of(other))
    }
    #[inline(always)]
    fn relation(self, other: Plane3<S>) -> Relation<S> {
        half_space::relate(other, self).flipped()
    }
}

macro_rules! revolved {
    ($($Shape:ident)*) => { $(
        impl<S: Scalar, A: Cored<Scalar = S, Core = PointCore<S>>> Apart<$Shape<S>> for A {
            type Scalar = S;
            #[inline(always)]
            fn guarded_with(&self, other: &$Shape<S>) -> Guard<S> {
                self.guarded(Guard::of(other))
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
                (round::farthest(self.core().0, other) + Cored::radius(&self)).canonical()
            }
        }
        impl<S: Scalar, B: Cored<Scalar = S, Core = PointCore<S>>> Apart<B> for $Shape<S> {
            type Scalar = S;
            #[inline(always)]
            fn guarded_with(&self, other: &B) -> Guard<S> {
                other.guarded(Guard::of(self))
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

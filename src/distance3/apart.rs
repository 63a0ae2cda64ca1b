//! Pairs of shapes of space that have distances.
use super::box_core::BoxCore;
use super::boxes::{self, Faces};
use super::core::{Core, PointCore};
use super::half_space::{self, Bounded};
use super::relation::{self, Relation};
use super::round;
use super::simplex::{SegmentCore, SimplexCore, TetrahedronCore, TriangleCore};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::scalar::largest;
use crate::shape::{
    Aabb3, Capsule3, Cone, Cylinder, Obb3, Plane3, RoundBox3, Segment3, Sphere, Tetrahedron,
    Triangle3, YawBox3,
};
use crate::{Rotation2, Rotation3, Scalar, Vec3};

/// A convex shape of space: every point at most [`radius`](Cored::radius) from its [`core`](Cored::core).
///
/// Points, segments, triangles, tetrahedra, boxes, balls, capsules and boxes with round edges are. Any two of them are
/// [`Apart`].
pub trait Cored: Copy {
    /// Its numbers.
    type Scalar: Scalar;
    /// The type of the shape that is inflated.
    type Core: Core<Self::Scalar>;
    /// `true` if the radius may be other than zero.
    const ROUND: bool = false;
    /// The shape that is inflated.
    fn core(self) -> Self::Core;
    /// By how much; not negative.
    #[inline(always)]
    fn radius(&self) -> Self::Scalar {
        Self::Scalar::zero()
    }
    /// The bounds, where the core is an axis-aligned box.
    #[doc(hidden)]
    #[inline(always)]
    fn bounds(&self) -> Option<Aabb3<Self::Scalar>> {
        None
    }
    /// How far a point is beyond the faces, where the core is a box.
    #[doc(hidden)]
    #[inline(always)]
    fn beyond(&self, _: Vec3<Self::Scalar>) -> Option<Vec3<Self::Scalar>> {
        None
    }
}

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

/// Two bounded shapes of space: `a.farthest_distance(b)`.
pub trait Farthest<B>: Copy {
    /// Their numbers.
    type Scalar: Scalar;
    /// The longest distance: [`farthest_distance`](super::farthest_distance).
    #[must_use]
    fn farthest_distance(self, other: B) -> Self::Scalar;
}

impl<A: Cored, B: Cored<Scalar = A::Scalar>> Apart<B> for A {
    type Scalar = A::Scalar;
    #[inline(always)]
    fn relation(self, other: B) -> Relation<A::Scalar> {
        let found = match (self.bounds(), other.bounds()) {
            (Some(a), Some(b)) => boxes::upright(a, b),
            _ => relation::relate(self.core(), other.core()),
        };
        let found = match (A::Core::DIMENSION, B::Core::DIMENSION) {
            (0, _) => from_point(found, self.core().anchor(), &other),
            (_, 0) => from_point(found, other.core().anchor(), &self),
            _ => found,
        };
        match A::ROUND || B::ROUND {
            true => found.inflated(self.radius(), other.radius()),
            false => found,
        }
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

impl<A: Cored, B: Cored<Scalar = A::Scalar>> Farthest<B> for A {
    type Scalar = A::Scalar;
    #[inline]
    fn farthest_distance(self, other: B) -> A::Scalar {
        let longest = match (self.bounds(), other.bounds()) {
            (Some(a), Some(b)) => boxes::farthest_upright(a, b).saturated(),
            _ => relation::farthest(self.core(), other.core()),
        };
        (longest + (self.radius() + other.radius())).canonical()
    }
}

impl<S: Scalar, B: Bounded<Scalar = S>> Apart<B> for Plane3<S> {
    type Scalar = S;
    #[inline(always)]
    fn relation(self, other: B) -> Relation<S> {
        half_space::relate(self, other)
    }
}

impl<S: Scalar, A: Bounded<Scalar = S>> Apart<Plane3<S>> for A {
    type Scalar = S;
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
            fn relation(self, other: $Shape<S>) -> Relation<S> {
                let found = round::relate(self.core().0, other);
                match A::ROUND {
                    true => found.inflated(self.radius(), S::zero()),
                    false => found,
                }
            }
        }
        impl<S: Scalar, B: Cored<Scalar = S, Core = PointCore<S>>> Apart<B> for $Shape<S> {
            type Scalar = S;
            #[inline(always)]
            fn relation(self, other: B) -> Relation<S> {
                other.relation(self).flipped()
            }
        }
        impl<S: Scalar, A: Cored<Scalar = S, Core = PointCore<S>>> Farthest<$Shape<S>> for A {
            type Scalar = S;
            #[inline]
            fn farthest_distance(self, other: $Shape<S>) -> S {
                (round::farthest(self.core().0, other) + Cored::radius(&self)).canonical()
            }
        }
        impl<S: Scalar, B: Cored<Scalar = S, Core = PointCore<S>>> Farthest<B> for $Shape<S> {
            type Scalar = S;
            #[inline]
            fn farthest_distance(self, other: B) -> S {
                other.farthest_distance(self)
            }
        }
    )* };
}
revolved! { Cylinder Cone }

macro_rules! cored {
    ($($Shape:ident: $Core:ident, |$shape:ident| $core:expr $(, $radius:ident)?;)*) => { $(
        impl<S: Scalar> Cored for $Shape<S> {
            type Scalar = S;
            type Core = $Core<S>;
            #[inline(always)]
            fn core(self) -> $Core<S> {
                let $shape = self;
                $core
            }
            $(
                const ROUND: bool = true;
                #[inline(always)]
                fn radius(&self) -> S {
                    self.$radius
                }
            )?
        }
    )* };
}
cored! {
    Vec3: PointCore, |point| PointCore(point);
    Sphere: PointCore, |ball| PointCore(ball.center), radius;
    Segment3: SegmentCore, |edge| SimplexCore([edge.start, edge.end]);
    Capsule3: SegmentCore, |link| SimplexCore([link.start, link.end]), radius;
    Triangle3: TriangleCore, |face| SimplexCore(face.corners());
    Tetrahedron: TetrahedronCore, |solid| SimplexCore(solid.corners());
}

/// The axes of a rotation: quotients by the squared length of its quaternion, so that quarter turns have none but zeros
/// and ones. The zero quaternion is no rotation.
#[inline(always)]
fn axes<S: Scalar>(q: Rotation3<S>) -> [Vec3<S>; 3] {
    let scale = scale_of::<S>(largest([q.w, q.x, q.y, q.z]));
    let [w, x, y, z] = [q.w, q.x, q.y, q.z].each_as(|part| part * scale);
    let square = (w * w + x * x) + (y * y + z * z);
    let none = square.equals(S::zero());
    let square = S::select(none, S::one(), square);
    let w = S::select(none, S::one(), w);
    let twice = |sum: S| (sum + sum).over(square);
    let whole = |own: S, others: S| (w * w + own * own - others).over(square);
    let [xx, yy, zz] = [x * x, y * y, z * z];
    [
        Vec3::new(
            whole(x, yy + zz),
            twice(x * y + w * z),
            twice(x * z - w * y),
        ),
        Vec3::new(
            twice(x * y - w * z),
            whole(y, xx + zz),
            twice(y * z + w * x),
        ),
        Vec3::new(
            twice(x * z + w * y),
            twice(y * z - w * x),
            whole(z, xx + yy),
        ),
    ]
}

/// A box with axes of length one.
#[inline(always)]
fn box_core<S: Scalar>(center: Vec3<S>, size: Vec3<S>, axes: [Vec3<S>; 3]) -> BoxCore<S> {
    BoxCore {
        center,
        half: [size.x.halved(), size.y.halved(), size.z.halved()],
        flat: [S::zero(); 3],
        axes,
    }
}

macro_rules! boxes {
    ($(
        $Shape:ident: |$shape:ident| $core:expr, $inner:expr $(, radius $radius:ident)? $(, bounds $bounds:expr)?;
    )*) => { $(
        impl<S: Scalar> Cored for $Shape<S> {
            type Scalar = S;
            type Core = BoxCore<S>;
            #[inline(always)]
            fn core(self) -> BoxCore<S> {
                let $shape = self;
                $core
            }
            #[inline(always)]
            fn beyond(&self, point: Vec3<S>) -> Option<Vec3<S>> {
                let $shape = self;
                Some(Faces::beyond($inner, point))
            }
            $(
                const ROUND: bool = true;
                #[inline(always)]
                fn radius(&self) -> S {
                    self.$radius
                }
            )?
            $(
                #[inline(always)]
                fn bounds(&self) -> Option<Aabb3<S>> {
                    let $shape = self;
                    Some($bounds)
                }
            )?
        }
    )* };
}
boxes! {
    Aabb3: |shape| {
        let (zero, one) = (S::zero(), S::one());
        let axes = [
            Vec3::new(one, zero, zero),
            Vec3::new(zero, one, zero),
            Vec3::new(zero, zero, one),
        ];
        box_core(shape.center(), shape.size(), axes)
    }, *shape, bounds *shape;
    YawBox3: |shape| {
        let (Rotation2 { cos, sin }, zero) = (Rotation2::from_angle(shape.heading), S::zero());
        let axes = [
            Vec3::new(cos, sin, zero),
            Vec3::new(-sin, cos, zero),
            Vec3::new(zero, zero, S::one()),
        ];
        box_core(shape.center, shape.size, axes)
    }, *shape;
    Obb3: |shape| box_core(shape.center, shape.size, axes(shape.rotation)), *shape;
    RoundBox3: |shape| {
        let inner = shape.inner;
        box_core(inner.center, inner.size, axes(inner.rotation))
    }, shape.inner, radius radius;
}

//! Shapes seen as plain numbers in memory.
use crate::curve::{Arc2, Cubic2, Quadratic2};
use crate::distance::{Contact, FarthestPoints, PointPair};
use crate::distance3::{Contact3, PointPair3};
use crate::intersection::{Chord, CommonPart, CommonPoint, Hit};
use crate::intersection3::{CommonLine3, CommonPoint3, Hit3};
use crate::shape::{
    Aabb3, Capsule2, Capsule3, Circle, Cone, Cylinder, Disc, Ellipsoid, Interval, Line2, Line3,
    Obb3, Plane3, Pose3, Ray2, Ray3, Rotation3, RoundBox3, Segment2, Segment3, Sphere, Symmetric3,
    Tetrahedron, Triangle2, Triangle3, YawBox3,
};
use crate::{Aabb2, Fixed, Obb2, Pose2, Rotation2, Vec2, Vec3};
use std::any::TypeId;
use std::slice;

/// Returns `true` if a shape is one of the library's, or an array of up to sixteen numbers. Such a shape consists of
/// numbers of this format, in the order of their fields, without padding.
pub fn is_plain<P: Fixed>() -> bool
where
    P::Scalar: 'static,
{
    /// Lists the shapes: all of them `repr(C)`, of one type of number all through.
    macro_rules! any_of {
        ($($shape:ident)*; $($length:literal)*) => {
            $(TypeId::of::<P>() == TypeId::of::<$shape<P::Scalar>>() ||)*
            $(TypeId::of::<P>() == TypeId::of::<[P::Scalar; $length]>() ||)*
            TypeId::of::<P>() == TypeId::of::<[Vec2<P::Scalar>; 3]>() ||
            TypeId::of::<P>() == TypeId::of::<[Vec2<P::Scalar>; 4]>() ||
            TypeId::of::<P>() == TypeId::of::<P::Scalar>()
        };
    }
    const { assert!(size_of::<P::Scalar>() > 0) };
    any_of!(Vec2 Vec3 Rotation2 Rotation3 Pose2 Pose3 Aabb2 Aabb3 Obb2 Obb3 YawBox3
        Segment2 Line2 Ray2 Triangle2 Circle Capsule2 Interval
        Segment3 Line3 Ray3 Triangle3 Plane3 Sphere Capsule3 Cylinder Cone Tetrahedron RoundBox3 Symmetric3
        Ellipsoid Disc Quadratic2 Cubic2 Arc2
        PointPair FarthestPoints Contact PointPair3 Contact3
        Chord Hit CommonPoint CommonPart Hit3 CommonLine3 CommonPoint3; 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16)
        && size_of::<P>() == P::LEN * size_of::<P::Scalar>()
        && align_of::<P>() == align_of::<P::Scalar>()
}

/// Returns the numbers of shapes, one shape after another; `None` for shapes that [`is_plain`] rejects.
#[inline]
pub fn lent<P: Fixed>(shapes: &[P]) -> Option<&[P::Scalar]>
where
    P::Scalar: 'static,
{
    // Sound: the shapes are contiguous numbers without padding.
    is_plain::<P>()
        .then(|| unsafe { slice::from_raw_parts(shapes.as_ptr().cast(), shapes.len() * P::LEN) })
}

/// Returns numbers as shapes, without those that make no whole shape; `None` for shapes that [`is_plain`] rejects.
#[inline]
pub fn seen_as<P: Fixed>(numbers: &[P::Scalar]) -> Option<&[P]>
where
    P::Scalar: 'static,
{
    // Sound for the reason above, with the alignment that `is_plain` compares, and since any numbers are valid.
    is_plain::<P>().then(|| unsafe {
        slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len() / P::LEN.max(1))
    })
}

/// Returns the numbers of shapes for writing; `None` for shapes that [`is_plain`] rejects.
#[inline]
pub fn lent_mut<P: Fixed>(shapes: &mut [P]) -> Option<&mut [P::Scalar]>
where
    P::Scalar: 'static,
{
    // Sound for the reason above, and since any number is valid.
    is_plain::<P>().then(|| unsafe {
        slice::from_raw_parts_mut(shapes.as_mut_ptr().cast(), shapes.len() * P::LEN)
    })
}

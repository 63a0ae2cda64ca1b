//! Rows whose function another row has for other shapes: arguments exchanged, boxes of two kinds, two points.
use super::{ClosestPoints, Distance, IntersectionVolume, Iof, Iou, SignedDistance};
use crate::distance::{closest_points, distance, signed_distance};
use crate::operation;
use crate::{Aabb2, Aabb3, Capsule2, Circle, Obb2, Obb3, Segment2, Triangle2, Vec2, Vec3, YawBox3};

operation! {
    /// The distance of two points.
    Distance: (a: Vec2<S>, b: Vec2<S>) -> S { a.distance(b) }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    derivative Reverse

    /// The distance of two points in space.
    Distance: (a: Vec3<S>, b: Vec3<S>) -> S { a.distance(b) }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    derivative Reverse
}

/// Distances with the arguments exchanged.
macro_rules! exchanged {
    ($($A:ident $B:ident;)*) => { $(
        operation! {
            /// The [distance](crate::distance::distance()).
            Distance: (a: $A<S>, b: $B<S>) -> S { distance(a, b) }
            invariances [TranslationX Stays, TranslationY Stays, Scaling Power(1)]
            jumps Never
            derivative Reverse

            /// The [signed distance](crate::distance::signed_distance()).
            SignedDistance: (a: $A<S>, b: $B<S>) -> S { signed_distance(a, b) }
            invariances [TranslationX Stays, TranslationY Stays, Scaling Power(1)]
            jumps Never
            derivative Reverse
        }
    )* };
}
exchanged! {
    Segment2 Vec2;
    Circle Vec2;
    Triangle2 Vec2;
    Capsule2 Vec2;
    Aabb2 Vec2;
    Obb2 Vec2;
    Circle Segment2;
    Obb2 Segment2;
    Obb2 Circle;
}
operation! {
    /// The [nearest points](crate::distance::closest_points()) of a box and a circle.
    ClosestPoints: (a: Obb2<S>, b: Circle<S>) -> crate::distance::ClosestPoints<S> { closest_points(a, b) }
    invariances [TranslationX Follows, TranslationY Follows, Scaling Follows]
    jumps Anywhere
    derivative Forward
}

/// Overlaps of boxes of two kinds.
macro_rules! mixed {
    ($Verb:ident by $method:ident, $($A:ident $B:ident;)*) => { $(
        operation! {
            /// The overlap of boxes of two kinds: [`Overlaps`](crate::overlap3::Overlaps).
            $Verb: (a: $A<S>, b: $B<S>) -> S { a.$method(b) }
            invariances [TranslationX Stays, TranslationY Stays]
            jumps FromZero
            derivative Forward
        }
    )* };
}
mixed! { Iou by iou, YawBox3 Aabb3; Obb3 Aabb3; Obb3 YawBox3; }
mixed! { Iof by iof, Aabb3 YawBox3; YawBox3 Aabb3; Aabb3 Obb3; Obb3 Aabb3; YawBox3 Obb3; Obb3 YawBox3; }
mixed! { IntersectionVolume by intersection_volume, Aabb3 YawBox3; YawBox3 Aabb3; Aabb3 Obb3; Obb3 Aabb3; YawBox3 Obb3; Obb3 YawBox3; }

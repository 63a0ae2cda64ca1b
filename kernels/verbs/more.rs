//! Rows whose function another row has for other shapes: arguments exchanged, boxes of two kinds, two points.
use super::{ClosestPoints, Distance, IntersectionVolume, Iof, Iou, SignedDistance};
use crate::distance::{closest_points, distance, signed_distance};
use crate::kernels::ops::noun::Number;
use crate::kernels::ops::rows::table;
use crate::operation;
use crate::overlap3::Overlaps;
use crate::{Aabb2, Aabb3, Capsule2, Circle, Obb2, Obb3, Segment2, Triangle2, Vec2, Vec3, YawBox3};

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
    ClosestPoints: (a: Obb2<S>, b: Circle<S>) -> crate::distance::PointPair<S> { closest_points(a, b) }
    invariances [TranslationX Follows, TranslationY Follows, Scaling Follows]
    jumps Anywhere
    derivative Forward
}

table! {
    /// [Intersection over union](crate::overlap3::Overlaps::iou_with) of {}, 0 to 1.
    Iou: (a, b) -> S { a.iou_with(b) } [similar] range RATIO jumps FromZero derivative Forward {
        "iou_yaw_aabb3": YawBox3, Aabb3;
        "iou_obb3_aabb3": Obb3, Aabb3;
        "iou_obb3_yaw": Obb3, YawBox3;
    }
    /// The [part of the first](crate::overlap3::Overlaps::iof_with) of {} that lies in the second, 0 to 1.
    Iof: (a, b) -> S { a.iof(b) } [similar] range RATIO jumps FromZero derivative Forward {
        "iof_aabb3_yaw": Aabb3, YawBox3;
        "iof_yaw_aabb3": YawBox3, Aabb3;
        "iof_aabb3_obb3": Aabb3, Obb3;
        "iof_obb3_aabb3": Obb3, Aabb3;
        "iof_yaw_obb3": YawBox3, Obb3;
        "iof_obb3_yaw": Obb3, YawBox3;
    }
    /// [Volume](crate::overlap3::Overlaps::volume_shared_with) that {} share.
    IntersectionVolume: (a, b) -> S { a.intersection_volume(b) }
    [rigid(3)] range NOT_NEGATIVE jumps Never derivative Forward {
        "intersection_volume_aabb3_yaw": Aabb3, YawBox3;
        "intersection_volume_yaw_aabb3": YawBox3, Aabb3;
        "intersection_volume_aabb3_obb3": Aabb3, Obb3;
        "intersection_volume_obb3_aabb3": Obb3, Aabb3;
        "intersection_volume_yaw_obb3": YawBox3, Obb3;
        "intersection_volume_obb3_yaw": Obb3, YawBox3;
    }
    /// The distance of {}, in the unit of length.
    Distance: (a, b) -> S { a.distance(b) } [rigid(1), symmetric] jumps Never derivative Reverse {
        // Beside it the compiler does not take a shape of a wrong pair for the number of the row of a number and an
        // interval: it lists pairs.
        "distance_numbers": Number, Number { (a - b).magnitude() };
        "distance_points": Vec2, Vec2;
        "distance_points3": Vec3, Vec3;
    }
}

//! Distances of points from boxes of space as operations.
use crate::distance3::{distance, signed_distance};
use crate::kernels::ops::rows::table;
use crate::kernels::verbs::{Distance, SignedDistance};
use crate::{Aabb3, Obb3, Vec3, YawBox3};

table! {
    /// The [distance](crate::distance3::distance) of {}.
    Distance: (a, b) -> S { distance(a, b) } [rigid(1), symmetric] jumps Never derivative Reverse {
        "distance_point_aabb3": Vec3, Aabb3;
        "distance_point_yaw": Vec3, YawBox3;
        "distance_point_obb3": Vec3, Obb3;
        "distance_points3": Vec3, Vec3 { a.distance(b) };
        "distance_aabb3_point": Aabb3, Vec3 { distance(b, a) };
        "distance_yaw_point": YawBox3, Vec3 { distance(b, a) };
        "distance_obb3_point": Obb3, Vec3 { distance(b, a) };
    }
    /// The [signed distance](crate::distance3::signed_distance) of {}.
    SignedDistance: (a, b) -> S { signed_distance(a, b) } [rigid(1), symmetric] jumps Never derivative Reverse {
        "signed_distance_point_aabb3": Vec3, Aabb3;
        "signed_distance_point_yaw": Vec3, YawBox3;
        "signed_distance_point_obb3": Vec3, Obb3;
        "signed_distance_aabb3_point": Aabb3, Vec3 { signed_distance(b, a) };
        "signed_distance_yaw_point": YawBox3, Vec3 { signed_distance(b, a) };
        "signed_distance_obb3_point": Obb3, Vec3 { signed_distance(b, a) };
    }
}

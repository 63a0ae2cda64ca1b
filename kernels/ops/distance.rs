//! Distances of shapes as operations.
use crate::ad::adjoint::distance::{distance_point_segment_vjp, distance_segments_vjp};
use crate::distance::segments::{ClosestOnSegments, closest_points_of_segments};
use crate::distance::turned::{
    closest_points_obb2, distance_obb2, farthest_distance_obb2, penetration_obb2,
    signed_distance_obb2, squared_distance_obb2,
};
use crate::distance::upright::{
    closest_points_aabb2, distance_aabb2, farthest_distance_aabb2, signed_distance_aabb2,
    squared_distance_aabb2,
};
use crate::distance::pair::{
    closest_points, depth, distance, farthest_distance, penetration, signed_distance,
    squared_distance,
};
use crate::distance::{Contact, PointPair};
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{
    self, Depth, Distance, FarthestDistance, SignedDistance, SquaredDistance,
};
use crate::{Aabb2, Capsule2, Circle, Obb2, Segment2, Triangle2, Vec2};

table! {
    /// The [distance](crate::distance::distance()) of {}.
    Distance: (a, b) -> S { distance(a, b) } [rigid(1), symmetric]
    (lower Distance jumps Never) derivative Reverse {
        "distance_point_segment": Vec2, Segment2
            derivative ByHand |(a, b), out_bar| { distance_point_segment_vjp(a, b, out_bar) };
        "distance_segments": Segment2, Segment2 derivative ByHand |(a, b), out_bar| { distance_segments_vjp(a, b, out_bar) };
        "distance_aabb2": Aabb2, Aabb2 { distance_aabb2(a, b) };
        "distance_obb2": Obb2, Obb2 { distance_obb2(a, b) };
        "distance_point_circle": Vec2, Circle;
        "distance_point_triangle": Vec2, Triangle2;
        "distance_point_capsule": Vec2, Capsule2;
        "distance_point_aabb2": Vec2, Aabb2;
        "distance_point_obb2": Vec2, Obb2;
        "distance_segment_circle": Segment2, Circle;
        "distance_segment_obb2": Segment2, Obb2;
        "distance_circles": Circle, Circle;
        "distance_circle_obb2": Circle, Obb2;
        "distance_capsules": Capsule2, Capsule2;
        "distance_triangles": Triangle2, Triangle2;
        "distance_points": Vec2, Vec2 { a.distance(b) };
        "distance_segment_point": Segment2, Vec2;
        "distance_circle_point": Circle, Vec2;
        "distance_triangle_point": Triangle2, Vec2;
        "distance_capsule_point": Capsule2, Vec2;
        "distance_aabb2_point": Aabb2, Vec2;
        "distance_obb2_point": Obb2, Vec2;
        "distance_circle_segment": Circle, Segment2;
        "distance_obb2_segment": Obb2, Segment2;
        "distance_obb2_circle": Obb2, Circle;
    }
    /// The [squared distance](crate::distance::squared_distance) of {}.
    SquaredDistance: (a, b) -> S { squared_distance(a, b) } [rigid(2), symmetric]
    (lower SquaredDistance jumps Never) derivative Reverse {
        "squared_distance_aabb2": Aabb2, Aabb2 { squared_distance_aabb2(a, b) };
        "squared_distance_obb2": Obb2, Obb2 { squared_distance_obb2(a, b) };
        "squared_distance_point_segment": Vec2, Segment2;
        "squared_distance_point_triangle": Vec2, Triangle2;
        "squared_distance_segments": Segment2, Segment2;
        "squared_distance_triangles": Triangle2, Triangle2;
    }
    /// The [signed distance](crate::distance::signed_distance) of {}.
    SignedDistance: (a, b) -> S { signed_distance(a, b) } [rigid(1), symmetric]
    (lower Distance jumps Never) derivative Reverse {
        "signed_distance_aabb2": Aabb2, Aabb2 { signed_distance_aabb2(a, b) };
        "signed_distance_obb2": Obb2, Obb2 { signed_distance_obb2(a, b) };
        "signed_distance_point_obb2": Vec2, Obb2;
        "signed_distance_point_circle": Vec2, Circle;
        "signed_distance_point_triangle": Vec2, Triangle2;
        "signed_distance_point_capsule": Vec2, Capsule2;
        "signed_distance_point_aabb2": Vec2, Aabb2;
        "signed_distance_segment_circle": Segment2, Circle;
        "signed_distance_segment_obb2": Segment2, Obb2;
        "signed_distance_circles": Circle, Circle;
        "signed_distance_circle_obb2": Circle, Obb2;
        "signed_distance_capsules": Capsule2, Capsule2;
        "signed_distance_triangles": Triangle2, Triangle2 derivative Forward;
        "signed_distance_point_segment": Vec2, Segment2;
        "signed_distance_segment_point": Segment2, Vec2;
        "signed_distance_circle_point": Circle, Vec2;
        "signed_distance_triangle_point": Triangle2, Vec2;
        "signed_distance_capsule_point": Capsule2, Vec2;
        "signed_distance_aabb2_point": Aabb2, Vec2;
        "signed_distance_obb2_point": Obb2, Vec2;
        "signed_distance_circle_segment": Circle, Segment2;
        "signed_distance_obb2_segment": Obb2, Segment2;
        "signed_distance_obb2_circle": Obb2, Circle;
    }
    /// The [depth](crate::distance::depth) of {}, positive inside.
    Depth: (a, b) -> S { depth(a, b) } [rigid(1)] (jumps Never) derivative Reverse {
        "depth_point_aabb2": Vec2, Aabb2;
        "depth_point_obb2": Vec2, Obb2;
    }
    /// The [longest distance](crate::distance::farthest_distance) of {}.
    FarthestDistance: (a, b) -> S { farthest_distance(a, b) } [rigid(1), symmetric] (jumps Never) derivative Reverse {
        "farthest_distance_aabb2": Aabb2, Aabb2 { farthest_distance_aabb2(a, b) };
        "farthest_distance_obb2": Obb2, Obb2 { farthest_distance_obb2(a, b) };
        "farthest_distance_point_obb2": Vec2, Obb2;
        "farthest_distance_circle_obb2": Circle, Obb2;
        "farthest_distance_triangles": Triangle2, Triangle2;
    }
    // Points and directions jump where another feature is nearest.
    /// The [depth of overlap and its direction](crate::distance::penetration) of {}. The direction jumps to another
    /// deepest face.
    verbs::Penetration: (a, b) -> Contact<S> { penetration(a, b) } [shifts] (jumps Anywhere) derivative Reverse {
        "penetration_obb2": Obb2, Obb2 { penetration_obb2(a, b) } derivative Forward;
        "penetration_circles": Circle, Circle;
        "penetration_capsules": Capsule2, Capsule2;
        "penetration_triangles": Triangle2, Triangle2;
        "penetration_aabb2": Aabb2, Aabb2;
        "penetration_circle_obb2": Circle, Obb2 derivative Forward;
    }
    /// The [nearest points](crate::distance::closest_points) of {}. Points jump to another nearest feature.
    verbs::ClosestPoints: (a, b) -> PointPair<S> { closest_points(a, b) }
    [follows] (jumps Anywhere) derivative Reverse {
        "closest_points_aabb2": Aabb2, Aabb2 { closest_points_aabb2(a, b) };
        "closest_points_obb2": Obb2, Obb2 { closest_points_obb2(a, b) };
        "closest_points_circle_obb2": Circle, Obb2 derivative Forward;
        "closest_points_obb2_circle": Obb2, Circle derivative Forward;
        "closest_points_point_segment": Vec2, Segment2;
        "closest_points_point_triangle": Vec2, Triangle2;
        "closest_points_point_obb2": Vec2, Obb2;
        "closest_points_capsules": Capsule2, Capsule2;
        "closest_points_triangles": Triangle2, Triangle2;
    }
    /// The [nearest points](crate::distance::segments::closest_points_of_segments) of {}, and where along both they
    /// lie.
    verbs::ClosestPoints: (a, b) -> ClosestOnSegments<S> { closest_points_of_segments(a, b) }
    [] (jumps Anywhere) derivative Reverse {
        "closest_points_of_segments": Segment2, Segment2;
    }
}

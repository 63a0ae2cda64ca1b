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
use crate::distance::{
    ClosestPoints, Penetration, clearance, closest_points, distance, farthest_distance,
    penetration, signed_distance, squared_distance,
};
use crate::kernels::ops::rows::rows_of_pairs;
use crate::operation;
use crate::{Aabb2, Capsule2, Circle, Obb2, Segment2, Triangle2, Vec2};

operation! {
    /// The [distance](crate::distance::distance()) of a point and a segment.
    pub DistancePointSegment = "distance_point_segment":
        (point: Vec2<S>, segment: Segment2<S>) -> S { distance(point, segment) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    jumps Never
    slopes ByHand |(point, segment), out_bar| { distance_point_segment_vjp(point, segment, out_bar) }

    /// The [distance](crate::distance::distance()) of two segments.
    pub DistanceSegments = "distance_segments": (a: Segment2<S>, b: Segment2<S>) -> S { distance(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes ByHand |(a, b), out_bar| { distance_segments_vjp(a, b, out_bar) }

    /// The [signed distance](crate::distance::upright::signed_distance_aabb2) of two axis-aligned boxes.
    pub SignedDistanceAabb2 = "signed_distance_aabb2":
        (a: Aabb2<S>, b: Aabb2<S>) -> S { signed_distance_aabb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [distance](crate::distance::upright::distance_aabb2) of two axis-aligned boxes.
    pub DistanceAabb2 = "distance_aabb2":
        (a: Aabb2<S>, b: Aabb2<S>) -> S { distance_aabb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [squared distance](crate::distance::upright::squared_distance_aabb2) of two axis-aligned boxes.
    pub SquaredDistanceAabb2 = "squared_distance_aabb2":
        (a: Aabb2<S>, b: Aabb2<S>) -> S { squared_distance_aabb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(2), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [longest distance](crate::distance::upright::farthest_distance_aabb2) of two axis-aligned boxes.
    pub FarthestDistanceAabb2 = "farthest_distance_aabb2":
        (a: Aabb2<S>, b: Aabb2<S>) -> S { farthest_distance_aabb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [nearest points](crate::distance::upright::closest_points_aabb2) of two axis-aligned boxes. Points jump where
    /// another feature is nearest.
    pub ClosestPointsAabb2 = "closest_points_aabb2":
        (a: Aabb2<S>, b: Aabb2<S>) -> ClosestPoints<S> { closest_points_aabb2(a, b) }
    promises [TranslationX Follows, TranslationY Follows, Scaling Follows]
    jumps Anywhere
    slopes Reverse

    /// The [distance](crate::distance::turned::distance_obb2) of two rotated boxes.
    pub DistanceObb2 = "distance_obb2": (a: Obb2<S>, b: Obb2<S>) -> S { distance_obb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [signed distance](crate::distance::turned::signed_distance_obb2) of two rotated boxes.
    pub SignedDistanceObb2 = "signed_distance_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { signed_distance_obb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [squared distance](crate::distance::turned::squared_distance_obb2) of two rotated boxes.
    pub SquaredDistanceObb2 = "squared_distance_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { squared_distance_obb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [longest distance](crate::distance::turned::farthest_distance_obb2) of two rotated boxes.
    pub FarthestDistanceObb2 = "farthest_distance_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { farthest_distance_obb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [depth of overlap and its direction](crate::distance::turned::penetration_obb2) of two rotated boxes. The
    /// direction jumps where another face is the deepest.
    pub PenetrationObb2 = "penetration_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> Penetration<S> { penetration_obb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays]
    jumps Anywhere
    slopes Forward

    /// The [nearest points](crate::distance::turned::closest_points_obb2) of two rotated boxes. Points jump where another
    /// feature is nearest.
    pub ClosestPointsObb2 = "closest_points_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> ClosestPoints<S> { closest_points_obb2(a, b) }
    promises [TranslationX Follows, TranslationY Follows, Scaling Follows, Rotation Follows]
    jumps Anywhere
    slopes Reverse

    /// The [signed distance](crate::distance::signed_distance) of a point and a rotated box.
    pub SignedDistancePointObb2 = "signed_distance_point_obb2":
        (point: Vec2<S>, shape: Obb2<S>) -> S { signed_distance(point, shape) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    jumps Never
    slopes Reverse

    /// The [nearest points](crate::distance::segments::closest_points_of_segments) of two segments and
    /// where along them they lie. The points jump where the segments are parallel.
    pub ClosestPointsOfSegments = "closest_points_of_segments":
        (a: Segment2<S>, b: Segment2<S>) -> ClosestOnSegments<S> { closest_points_of_segments(a, b) }
    promises []
    jumps Anywhere
    slopes Reverse
}

rows_of_pairs! {
    distance as "The [distance](crate::distance::distance())" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)],
    jumps Never, slopes Reverse {
        DistancePointCircle = "distance_point_circle": Vec2, Circle, "a point and a circle" [Rotation Stays];
        DistancePointTriangle = "distance_point_triangle": Vec2, Triangle2, "a point and a triangle" [Rotation Stays];
        DistancePointCapsule = "distance_point_capsule": Vec2, Capsule2, "a point and a capsule" [Rotation Stays];
        DistancePointAabb2 = "distance_point_aabb2": Vec2, Aabb2, "a point and an axis-aligned box" [];
        DistancePointObb2 = "distance_point_obb2": Vec2, Obb2, "a point and a rotated box" [Rotation Stays];
        DistanceSegmentCircle = "distance_segment_circle": Segment2, Circle, "a segment and a circle" [Rotation Stays];
        DistanceSegmentObb2 = "distance_segment_obb2": Segment2, Obb2, "a segment and a rotated box" [Rotation Stays];
        DistanceCircles = "distance_circles": Circle, Circle, "two circles" [Rotation Stays, Exchange Stays];
        DistanceCircleObb2 = "distance_circle_obb2": Circle, Obb2, "a circle and a rotated box" [Rotation Stays];
        DistanceCapsules = "distance_capsules": Capsule2, Capsule2, "two capsules" [Rotation Stays, Exchange Stays];
        DistanceTriangles = "distance_triangles": Triangle2, Triangle2, "two triangles" [Rotation Stays, Exchange Stays];
    }
    signed_distance as "The [signed distance](crate::distance::signed_distance)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)],
    jumps Never, slopes Reverse {
        SignedDistancePointCircle = "signed_distance_point_circle": Vec2, Circle, "a point and a circle" [Rotation Stays];
        SignedDistancePointTriangle = "signed_distance_point_triangle": Vec2, Triangle2, "a point and a triangle" [Rotation Stays];
        SignedDistancePointCapsule = "signed_distance_point_capsule": Vec2, Capsule2, "a point and a capsule" [Rotation Stays];
        SignedDistancePointAabb2 = "signed_distance_point_aabb2": Vec2, Aabb2, "a point and an axis-aligned box" [];
        SignedDistanceSegmentCircle = "signed_distance_segment_circle": Segment2, Circle, "a segment and a circle" [Rotation Stays];
        SignedDistanceSegmentObb2 = "signed_distance_segment_obb2": Segment2, Obb2, "a segment and a rotated box" [Rotation Stays];
        SignedDistanceCircles = "signed_distance_circles": Circle, Circle, "two circles" [Rotation Stays, Exchange Stays];
        SignedDistanceCircleObb2 = "signed_distance_circle_obb2": Circle, Obb2, "a circle and a rotated box" [Rotation Stays];
        SignedDistanceCapsules = "signed_distance_capsules": Capsule2, Capsule2, "two capsules" [Rotation Stays, Exchange Stays];
    }
    signed_distance as "The [signed distance](crate::distance::signed_distance)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)],
    jumps Never, slopes Forward {
        SignedDistanceTriangles = "signed_distance_triangles": Triangle2, Triangle2, "two triangles" [Rotation Stays, Exchange Stays];
    }
    clearance as "The [clearance](crate::distance::clearance), positive inside," -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)],
    jumps Never, slopes Reverse {
        ClearancePointAabb2 = "clearance_point_aabb2": Vec2, Aabb2, "a point and an axis-aligned box" [];
        ClearancePointObb2 = "clearance_point_obb2": Vec2, Obb2, "a point and a rotated box" [Rotation Stays];
    }
    squared_distance as "The [squared distance](crate::distance::squared_distance)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(2)],
    jumps Never, slopes Reverse {
        SquaredDistancePointSegment = "squared_distance_point_segment": Vec2, Segment2, "a point and a segment" [Rotation Stays];
        SquaredDistancePointTriangle = "squared_distance_point_triangle": Vec2, Triangle2, "a point and a triangle" [Rotation Stays];
        SquaredDistanceSegments = "squared_distance_segments": Segment2, Segment2, "two segments" [Rotation Stays, Exchange Stays];
        SquaredDistanceTriangles = "squared_distance_triangles": Triangle2, Triangle2, "two triangles" [Rotation Stays, Exchange Stays];
    }
    farthest_distance as "The [longest distance](crate::distance::farthest_distance)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)],
    jumps Never, slopes Reverse {
        FarthestDistancePointObb2 = "farthest_distance_point_obb2": Vec2, Obb2, "a point and a rotated box" [Rotation Stays];
        FarthestDistanceCircleObb2 = "farthest_distance_circle_obb2": Circle, Obb2, "a circle and a rotated box" [Rotation Stays];
        FarthestDistanceTriangles = "farthest_distance_triangles": Triangle2, Triangle2, "two triangles" [Rotation Stays, Exchange Stays];
    }
}

// Points and directions jump where another feature is nearest.
rows_of_pairs! {
    penetration as "The [depth of overlap and its direction](crate::distance::penetration)" -> Penetration<S>,
    promises [TranslationX Stays, TranslationY Stays],
    jumps Anywhere, slopes Reverse {
        PenetrationCircles = "penetration_circles": Circle, Circle, "two circles" [];
        PenetrationCapsules = "penetration_capsules": Capsule2, Capsule2, "two capsules" [];
        PenetrationTriangles = "penetration_triangles": Triangle2, Triangle2, "two triangles" [];
        PenetrationAabb2 = "penetration_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [];
    }
    penetration as "The [depth of overlap and its direction](crate::distance::penetration)" -> Penetration<S>,
    promises [TranslationX Stays, TranslationY Stays],
    jumps Anywhere, slopes Forward {
        PenetrationCircleObb2 = "penetration_circle_obb2": Circle, Obb2, "a circle and a rotated box" [];
    }
    closest_points as "The [nearest points](crate::distance::closest_points)" -> ClosestPoints<S>,
    promises [TranslationX Follows, TranslationY Follows, Scaling Follows],
    jumps Anywhere, slopes Forward {
        ClosestPointsCircleObb2 = "closest_points_circle_obb2": Circle, Obb2, "a circle and a rotated box" [Rotation Follows];
    }
    closest_points as "The [nearest points](crate::distance::closest_points)" -> ClosestPoints<S>,
    promises [TranslationX Follows, TranslationY Follows, Scaling Follows],
    jumps Anywhere, slopes Reverse {
        ClosestPointsPointSegment = "closest_points_point_segment": Vec2, Segment2, "a point and a segment" [Rotation Follows];
        ClosestPointsPointTriangle = "closest_points_point_triangle": Vec2, Triangle2, "a point and a triangle" [Rotation Follows];
        ClosestPointsPointObb2 = "closest_points_point_obb2": Vec2, Obb2, "a point and a rotated box" [Rotation Follows];
        ClosestPointsCapsules = "closest_points_capsules": Capsule2, Capsule2, "two capsules" [Rotation Follows];
        ClosestPointsTriangles = "closest_points_triangles": Triangle2, Triangle2, "two triangles" [Rotation Follows];
    }
}

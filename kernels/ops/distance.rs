//! Distances of shapes as operations.
use crate::distance::segments::{ClosestOnSegments, closest_points_of_segments};
use crate::distance::{distance, signed_distance};
use crate::operation;
use crate::{Obb2, Segment2, Vec2};

operation! {
    /// The [distance](crate::distance::distance()) of a point and a segment.
    pub DistancePointSegment = "distance_point_segment":
        (point: Vec2<S>, segment: Segment2<S>) -> S { distance(point, segment) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    jumps Never
    slopes Reverse

    /// The [distance](crate::distance::distance()) of two rotated boxes.
    pub DistanceObb2 = "distance_obb2": (a: Obb2<S>, b: Obb2<S>) -> S { distance(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1), Exchange Stays]
    jumps Never
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

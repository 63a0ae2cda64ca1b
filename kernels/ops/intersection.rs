//! Crossings, hits and lengths inside shapes as operations.
use crate::intersection::{
    Crossing, Hit, Meeting, Span, crossing_of_lines, first_hit, length_inside, meeting_of_segments,
    span,
};
use crate::kernels::ops::rows::rows_of_pairs;
use crate::{Aabb2, Capsule2, Circle, Line2, Obb2, Ray2, Segment2, Triangle2};

// What is found jumps where lines are parallel, where a line grazes a shape, and where another face is
// hit. Shifts would move directions like points, so they are not promised; with a direction that grows as all
// else does, parameters stay.
rows_of_pairs! {
    crossing_of_lines as "The [crossing](crate::intersection::crossing_of_lines())" -> Crossing<S>,
    promises [],
    // Slopes grow with the square of the reciprocal of the sine, which is a rounding of the product of the directions.
    finite Within(crate::kernels::op::Limits::new([-8, 8], [-150, 150])),
    jumps Anywhere, slopes Reverse {
        CrossingOfLines = "crossing_of_lines": Line2, Line2, "two lines" [];
    }
    meeting_of_segments as "[What is shared](crate::intersection::meeting_of_segments())" -> Meeting<S>,
    promises [],
    jumps Anywhere, slopes Reverse {
        MeetingOfSegments = "meeting_of_segments": Segment2, Segment2, "two segments" [];
    }
    first_hit as "The [first hit](crate::intersection::first_hit)" -> Hit<S>,
    promises [],
    jumps Anywhere, slopes Reverse {
        FirstHitRayCircle = "first_hit_ray_circle": Ray2, Circle, "a ray and a circle" [];
        FirstHitRayTriangle = "first_hit_ray_triangle": Ray2, Triangle2, "a ray and a triangle" [];
        FirstHitRayCapsule = "first_hit_ray_capsule": Ray2, Capsule2, "a ray and a capsule" [];
        FirstHitRayAabb2 = "first_hit_ray_aabb2": Ray2, Aabb2, "a ray and an axis-aligned box" [];
        FirstHitRayObb2 = "first_hit_ray_obb2": Ray2, Obb2, "a ray and a rotated box" [];
    }
    span as "The [parameters of entry and exit](crate::intersection::span())" -> Span<S>,
    promises [Scaling Stays],
    jumps Anywhere, slopes Reverse {
        SpanLineCircle = "span_line_circle": Line2, Circle, "a line and a circle" [Rotation Stays];
        SpanLineTriangle = "span_line_triangle": Line2, Triangle2, "a line and a triangle" [Rotation Stays];
        SpanLineCapsule = "span_line_capsule": Line2, Capsule2, "a line and a capsule" [Rotation Stays];
        SpanLineAabb2 = "span_line_aabb2": Line2, Aabb2, "a line and an axis-aligned box" [];
        SpanLineObb2 = "span_line_obb2": Line2, Obb2, "a line and a rotated box" [Rotation Stays];
    }
}

// Continuous, but for a segment along a straight side.
rows_of_pairs! {
    length_inside as "The [length inside](crate::intersection::length_inside)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)],
    jumps Anywhere, slopes Reverse {
        LengthInsideSegmentCircle = "length_inside_segment_circle": Segment2, Circle, "a segment and a circle" [Rotation Stays];
        LengthInsideSegmentTriangle = "length_inside_segment_triangle": Segment2, Triangle2, "a segment and a triangle" [Rotation Stays];
        LengthInsideSegmentCapsule = "length_inside_segment_capsule": Segment2, Capsule2, "a segment and a capsule" [Rotation Stays];
        LengthInsideSegmentAabb2 = "length_inside_segment_aabb2": Segment2, Aabb2, "a segment and an axis-aligned box" [];
        LengthInsideSegmentObb2 = "length_inside_segment_obb2": Segment2, Obb2, "a segment and a rotated box" [Rotation Stays];
    }
}

//! Crossings, hits and lengths inside shapes as operations.
use crate::intersection::{
    Chord, CommonPart, CommonPoint, Hit, crossing_of_lines, first_hit, length_inside, meeting_of_segments,
    span,
};
use crate::kernels::row::op::Limits;
use crate::kernels::ops::tables::table;
use crate::kernels::verbs;
use crate::{Aabb2, Capsule2, Circle, Line2, Obb2, Ray2, Segment2, Triangle2};

// The crossing or hit jumps where lines are parallel, where a line grazes a shape, and where another face is hit.
// Shifts would move directions like points, so they are not declared. Parameters stay under scaling, since directions
// grow, too. A length inside is continuous, except for a segment along a straight side.
table! {
    /// The [crossing](crate::intersection::crossing_of_lines()) of {}.
    verbs::Crossing: (a, b) -> CommonPoint<S> { crossing_of_lines(a, b) } []
    // Derivatives grow with the square of the reciprocal of the sine, which may be as small as a rounding error of the
    // product of the directions.
    (finite Within(Limits::new([-8, 8], [-150, 150])) jumps Anywhere) derivative Reverse {
        "crossing_of_lines": Line2, Line2;
    }
    /// The [meeting](crate::intersection::meeting_of_segments()) of {}.
    verbs::Meeting: (a, b) -> CommonPart<S> { meeting_of_segments(a, b) } [] (jumps Anywhere) derivative Reverse {
        "meeting_of_segments": Segment2, Segment2;
    }
    /// The [first hit](crate::intersection::first_hit) of {}.
    verbs::FirstHit: (a, b) -> Hit<S> { first_hit(a, b) } [] (jumps Anywhere) derivative Reverse {
        "first_hit_ray_circle": Ray2, Circle;
        "first_hit_ray_triangle": Ray2, Triangle2;
        "first_hit_ray_capsule": Ray2, Capsule2;
        "first_hit_ray_aabb2": Ray2, Aabb2;
        "first_hit_ray_obb2": Ray2, Obb2;
    }
    /// The [parameters of entry and exit](crate::intersection::span()) of {}.
    verbs::Span: (a, b) -> Chord<S> { span(a, b) } [similar] (jumps Anywhere) derivative Reverse {
        "span_line_circle": Line2, Circle;
        "span_line_triangle": Line2, Triangle2;
        "span_line_capsule": Line2, Capsule2;
        "span_line_aabb2": Line2, Aabb2;
        "span_line_obb2": Line2, Obb2;
    }
    /// The [length inside](crate::intersection::length_inside) of {}.
    verbs::LengthInside: (a, b) -> S { length_inside(a, b) } [rigid(1)] (jumps Anywhere) derivative Reverse {
        "length_inside_segment_circle": Segment2, Circle;
        "length_inside_segment_triangle": Segment2, Triangle2;
        "length_inside_segment_capsule": Segment2, Capsule2;
        "length_inside_segment_aabb2": Segment2, Aabb2;
        "length_inside_segment_obb2": Segment2, Obb2;
    }
}

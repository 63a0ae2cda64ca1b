//! Hits and lengths inside shapes in space, and intersections of planes, as operations.
use crate::intersection::Chord;
use crate::intersection3::{
    CommonLine3, CommonPoint3, Hit3, crossing_of_three_planes, crossing_of_two_planes, first_hit,
    first_hit_of_segment, first_hit_triangle, length_inside, span,
};
use crate::intersection3::planes::triple_terms;
use crate::kernels::row::op::Limits;
use crate::kernels::ops::tables::table;
use crate::kernels::verbs;
use crate::{
    Aabb3, Capsule3, Cone, Cylinder, Line3, Obb3, Plane3, Ray3, RoundBox3, Segment3, Sphere, Tetrahedron,
    Triangle3, YawBox3,
};

/// Returns a number of roundings equal to 1 where single precision cannot tell whether three planes meet, otherwise 0.
fn meet_in_doubt(a: Plane3<f64>, b: Plane3<f64>, c: Plane3<f64>) -> f64 {
    let (l, m, n) = (a.normal, b.normal, c.normal);
    let (epsilon, volume) = (f64::from(f32::EPSILON), l.dot(m.cross(n)).abs());
    match volume <= 8.0 * epsilon * triple_terms(l, m, n) {
        true => epsilon.recip(),
        false => 0.0,
    }
}

// Results jump at silhouettes, where a ray grazes a shape, and where another face is hit. A motion rounds, so at an
// edge it may change the face. A length inside is continuous, except for a segment along a face. A parameter of a line
// grows with the scale, since its direction does not; whether there is one does not change.
table! {
    /// The [first hit](crate::intersection3::first_hit) of {}.
    verbs::FirstHit: (a, b) -> Hit3<S> { first_hit(a, b) } [] (jumps Anywhere) derivative Reverse {
        "first_hit_ray_plane": Ray3, Plane3;
        "first_hit_ray_sphere": Ray3, Sphere;
        "first_hit_ray_capsule3": Ray3, Capsule3;
        "first_hit_ray_cylinder": Ray3, Cylinder;
        "first_hit_ray_cone": Ray3, Cone;
        "first_hit_ray_aabb3": Ray3, Aabb3;
        "first_hit_ray_yaw": Ray3, YawBox3;
        "first_hit_ray_obb3": Ray3, Obb3;
        "first_hit_ray_round_box": Ray3, RoundBox3;
        "first_hit_ray_tetrahedron": Ray3, Tetrahedron;
        "first_hit_ray_triangle3": Ray3, Triangle3 { first_hit_triangle(a, b) };
        "first_hit_segment_triangle3": Segment3, Triangle3 { first_hit_of_segment(a, b) };
    }
    /// The [parameters of entry and exit](crate::intersection3::span()) of {}.
    verbs::Span: (a, b) -> Chord<S> { span(a, b) } [isometric] (jumps Anywhere) derivative Reverse {
        "span_line_plane": Line3, Plane3;
        "span_line_sphere": Line3, Sphere;
        "span_line_capsule3": Line3, Capsule3;
        "span_line_cylinder": Line3, Cylinder;
        "span_line_cone": Line3, Cone;
        "span_line_obb3": Line3, Obb3;
        "span_line_tetrahedron": Line3, Tetrahedron;
    }
    /// The [length inside](crate::intersection3::length_inside) of {}.
    verbs::LengthInside: (a, b) -> S { length_inside(a, b) } [rigid(1)] (jumps Anywhere) derivative Reverse {
        "length_inside_segment_plane": Segment3, Plane3;
        "length_inside_segment_sphere": Segment3, Sphere;
        "length_inside_segment_capsule3": Segment3, Capsule3;
        "length_inside_segment_cylinder": Segment3, Cylinder;
        "length_inside_segment_cone": Segment3, Cone;
        "length_inside_segment_aabb3": Segment3, Aabb3;
        "length_inside_segment_yaw": Segment3, YawBox3;
        "length_inside_segment_obb3": Segment3, Obb3;
        "length_inside_segment_round_box": Segment3, RoundBox3;
        "length_inside_segment_tetrahedron": Segment3, Tetrahedron;
    }
    // The point nearest to the origin does not follow shifts, nor does the origin, which stands for no result.
    /// The line of two planes, the borders of {}.
    verbs::Crossing: (a, b) -> CommonLine3<S> { crossing_of_two_planes(a, b) } [follows, about_origin]
    (finite Within(Limits::new([-8, 8], [-150, 150])) jumps Anywhere) derivative Reverse {
        "crossing_of_two_planes": Plane3, Plane3;
    }
    /// The [point](crate::intersection3::crossing_of_three_planes) of three planes.
    verbs::Crossing: (a, b, c) -> CommonPoint3<S> { crossing_of_three_planes(a, b, c) } [follows, about_origin]
    // Numbers from 1/R to R give points up to R⁶ and derivatives up to R¹¹; terms of the determinant that cancel add
    // factors of 1/ε.
    (finite Within(Limits::new([-3, 3], [-25, 25])) jumps Anywhere) derivative Reverse {
        "crossing_of_three_planes": Plane3, Plane3, Plane3 (roundings { meet_in_doubt(a, b, c) });
    }
}

//! Hits and lengths inside shapes of space as operations.
use crate::intersection3::{Hit3, first_hit, first_hit_triangle, length_inside};
use crate::kernels::ops::rows::table;
use crate::kernels::verbs;
use crate::{Cylinder, Obb3, Plane3, Ray3, Segment3, Sphere, Tetrahedron, Triangle3};

// What is found jumps at silhouettes, where a ray grazes a shape, and where another face is hit; motions round, and at
// an edge let another face be hit. A length inside is continuous, but for a segment along a face.
table! {
    /// The [first hit](crate::intersection3::first_hit) of {}.
    verbs::FirstHit: (a, b) -> Hit3<S> { first_hit(a, b) } [] jumps Anywhere derivative Reverse {
        "first_hit_ray_plane": Ray3, Plane3;
        "first_hit_ray_sphere": Ray3, Sphere;
        "first_hit_ray_cylinder": Ray3, Cylinder;
        "first_hit_ray_obb3": Ray3, Obb3;
        "first_hit_ray_tetrahedron": Ray3, Tetrahedron;
        "first_hit_ray_triangle3": Ray3, Triangle3 { first_hit_triangle(a, b) };
    }
    /// The [length inside](crate::intersection3::length_inside) of {}.
    verbs::LengthInside: (a, b) -> S { length_inside(a, b) } [rigid(1)] jumps Anywhere derivative Reverse {
        "length_inside_segment_sphere": Segment3, Sphere;
        "length_inside_segment_cylinder": Segment3, Cylinder;
        "length_inside_segment_obb3": Segment3, Obb3;
    }
}

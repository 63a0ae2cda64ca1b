//! Distances of shapes of space as operations.
use crate::distance3::formula::{
    closest_points, distance, farthest_distance, penetration, signed_distance, squared_distance,
};
use crate::distance3::{Contact3, PointPair3};
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{self, Distance, FarthestDistance, SignedDistance, SquaredDistance};
use crate::{
    Aabb3, Capsule3, Cone, Cylinder, Disc, Ellipsoid, Line3, Obb3, Plane3, Ray3, RoundBox3, Segment3, Sphere, Tetrahedron,
    Triangle3, Vec3, YawBox3,
};

table! {
    /// The [distance](crate::distance3::distance) of {}.
    Distance: (a, b) -> S { distance(a, b) } [rigid(1), symmetric]
    (lower Distance jumps Never) derivative Reverse {
        "distance_point_aabb3": Vec3, Aabb3;
        "distance_point_yaw": Vec3, YawBox3;
        "distance_point_obb3": Vec3, Obb3;
        "distance_points3": Vec3, Vec3;
        "distance_aabb3_point": Aabb3, Vec3;
        "distance_yaw_point": YawBox3, Vec3;
        "distance_obb3_point": Obb3, Vec3;
        "distance_point_segment3": Vec3, Segment3;
        "distance_point_triangle3": Vec3, Triangle3;
        "distance_point_tetrahedron": Vec3, Tetrahedron;
        "distance_point_capsule3": Vec3, Capsule3;
        "distance_point_cylinder": Vec3, Cylinder;
        "distance_point_cone": Vec3, Cone;
        "distance_segments3": Segment3, Segment3;
        "distance_segment_triangle3": Segment3, Triangle3;
        "distance_triangles3": Triangle3, Triangle3;
        "distance_spheres": Sphere, Sphere;
        "distance_capsules3": Capsule3, Capsule3;
        "distance_capsule_sphere": Capsule3, Sphere;
        "distance_capsule_obb3": Capsule3, Obb3;
        "distance_sphere_obb3": Sphere, Obb3;
        "distance_aabb3": Aabb3, Aabb3;
        "distance_obb3": Obb3, Obb3;
        "distance_point_line3": Vec3, Line3;
        "distance_point_ray3": Vec3, Ray3;
        "distance_segment_line3": Segment3, Line3;
        "distance_segment_ray3": Segment3, Ray3;
        "distance_capsule_line3": Capsule3, Line3;
        "distance_segment_obb3": Segment3, Obb3;
        "distance_line_obb3": Line3, Obb3;
        "distance_ray_obb3": Ray3, Obb3;
        "distance_point_sphere": Vec3, Sphere;
        "distance_segment_tetrahedron": Segment3, Tetrahedron;
        "distance_segment_round_box": Segment3, RoundBox3;
        "distance_triangle_obb3": Triangle3, Obb3;
        "distance_triangle_round_box": Triangle3, RoundBox3;
        "distance_triangle_tetrahedron": Triangle3, Tetrahedron;
        "distance_tetrahedra": Tetrahedron, Tetrahedron;
        "distance_tetrahedron_obb3": Tetrahedron, Obb3;
        "distance_tetrahedron_round_box": Tetrahedron, RoundBox3;
        "distance_line_triangle3": Line3, Triangle3;
        "distance_line_tetrahedron": Line3, Tetrahedron;
        "distance_line_round_box": Line3, RoundBox3;
        "distance_ray_capsule3": Ray3, Capsule3;
        "distance_ray_triangle3": Ray3, Triangle3;
        "distance_ray_tetrahedron": Ray3, Tetrahedron;
        "distance_ray_round_box": Ray3, RoundBox3;
        /// It jumps where they become parallel.
        "distance_lines3": Line3, Line3 (jumps Anywhere);
        /// It jumps where they become parallel.
        "distance_line_ray3": Line3, Ray3 (jumps Anywhere);
        /// It jumps where they become parallel.
        "distance_rays3": Ray3, Ray3 (jumps Anywhere);
    }
    /// The [squared distance](crate::distance3::squared_distance) of {}.
    SquaredDistance: (a, b) -> S { squared_distance(a, b) } [rigid(2), symmetric]
    (lower SquaredDistance jumps Never) derivative Reverse {
        "squared_distance_point_segment3": Vec3, Segment3;
        "squared_distance_point_triangle3": Vec3, Triangle3;
        "squared_distance_segments3": Segment3, Segment3;
        "squared_distance_triangles3": Triangle3, Triangle3;
        "squared_distance_aabb3": Aabb3, Aabb3;
        "squared_distance_obb3": Obb3, Obb3;
    }
    /// The [signed distance](crate::distance3::signed_distance) of {}.
    SignedDistance: (a, b) -> S { signed_distance(a, b) } [rigid(1), symmetric]
    (lower Distance jumps Never) derivative Reverse {
        "signed_distance_point_aabb3": Vec3, Aabb3;
        "signed_distance_point_yaw": Vec3, YawBox3;
        "signed_distance_point_obb3": Vec3, Obb3;
        "signed_distance_aabb3_point": Aabb3, Vec3;
        "signed_distance_yaw_point": YawBox3, Vec3;
        "signed_distance_obb3_point": Obb3, Vec3;
        "signed_distance_point_sphere": Vec3, Sphere;
        "signed_distance_point_capsule3": Vec3, Capsule3;
        "signed_distance_point_tetrahedron": Vec3, Tetrahedron;
        "signed_distance_point_cylinder": Vec3, Cylinder;
        "signed_distance_point_cone": Vec3, Cone;
        "signed_distance_point_round_box": Vec3, RoundBox3;
        "signed_distance_spheres": Sphere, Sphere;
        "signed_distance_capsules3": Capsule3, Capsule3;
        "signed_distance_capsule_sphere": Capsule3, Sphere;
        "signed_distance_capsule_obb3": Capsule3, Obb3;
        "signed_distance_sphere_obb3": Sphere, Obb3;
        "signed_distance_sphere_triangle3": Sphere, Triangle3;
        "signed_distance_capsule_triangle3": Capsule3, Triangle3;
        "signed_distance_sphere_round_box": Sphere, RoundBox3;
        "signed_distance_triangles3": Triangle3, Triangle3 derivative Forward;
        "signed_distance_aabb3": Aabb3, Aabb3;
        "signed_distance_obb3": Obb3, Obb3;
        "signed_distance_plane_point": Plane3, Vec3;
        "signed_distance_plane_sphere": Plane3, Sphere;
        "signed_distance_plane_capsule": Plane3, Capsule3;
        "signed_distance_plane_triangle3": Plane3, Triangle3;
        "signed_distance_plane_tetrahedron": Plane3, Tetrahedron;
        "signed_distance_plane_obb3": Plane3, Obb3;
        "signed_distance_plane_cylinder": Plane3, Cylinder;
        "signed_distance_plane_cone": Plane3, Cone;
        "signed_distance_plane_ellipsoid": Plane3, Ellipsoid;
        "signed_distance_plane_disc": Plane3, Disc;
        "signed_distance_line_sphere": Line3, Sphere;
        "signed_distance_ray_sphere": Ray3, Sphere;
        "signed_distance_sphere_segment3": Sphere, Segment3;
        "signed_distance_sphere_tetrahedron": Sphere, Tetrahedron;
        "signed_distance_sphere_cylinder": Sphere, Cylinder;
        "signed_distance_sphere_cone": Sphere, Cone;
        "signed_distance_segment_capsule3": Segment3, Capsule3;
        "signed_distance_capsule_tetrahedron": Capsule3, Tetrahedron;
        "signed_distance_tetrahedra": Tetrahedron, Tetrahedron;
        "signed_distance_tetrahedron_obb3": Tetrahedron, Obb3;
        "signed_distance_tetrahedron_round_box": Tetrahedron, RoundBox3;
        "signed_distance_capsule_round_box": Capsule3, RoundBox3;
        "signed_distance_obb3_round_box": Obb3, RoundBox3;
        "signed_distance_round_boxes": RoundBox3, RoundBox3;
        "signed_distance_plane_segment3": Plane3, Segment3;
        "signed_distance_plane_round_box": Plane3, RoundBox3;
    }
    /// The [longest distance](crate::distance3::farthest_distance) of {}.
    FarthestDistance: (a, b) -> S { farthest_distance(a, b) } [rigid(1), symmetric] (jumps Never) derivative Reverse {
        "farthest_distance_point_obb3": Vec3, Obb3;
        "farthest_distance_capsules3": Capsule3, Capsule3;
        "farthest_distance_aabb3": Aabb3, Aabb3;
        "farthest_distance_obb3": Obb3, Obb3;
    }
    // Points and directions jump where another feature is nearest.
    /// The [depth of overlap and its direction](crate::distance3::penetration) of {}. The direction jumps to another
    /// deepest face.
    verbs::Penetration: (a, b) -> Contact3<S> { penetration(a, b) } [shifts] (jumps Anywhere) derivative Reverse {
        "penetration_spheres": Sphere, Sphere;
        "penetration_capsules3": Capsule3, Capsule3;
        "penetration_sphere_obb3": Sphere, Obb3;
        "penetration_capsule_obb3": Capsule3, Obb3;
        "penetration_aabb3": Aabb3, Aabb3;
        "penetration_obb3": Obb3, Obb3;
        "penetration_plane_capsule": Plane3, Capsule3;
        "penetration_plane_obb3": Plane3, Obb3;
    }
    /// The [nearest points](crate::distance3::closest_points) of {}. Points jump to another nearest feature.
    verbs::ClosestPoints: (a, b) -> PointPair3<S> { closest_points(a, b) }
    [follows] (jumps Anywhere) derivative Reverse {
        "closest_points_point_segment3": Vec3, Segment3;
        "closest_points_point_triangle3": Vec3, Triangle3;
        "closest_points_segments3": Segment3, Segment3;
        "closest_points_capsules3": Capsule3, Capsule3;
        "closest_points_sphere_obb3": Sphere, Obb3;
        "closest_points_capsule_obb3": Capsule3, Obb3;
        "closest_points_triangles3": Triangle3, Triangle3;
        "closest_points_aabb3": Aabb3, Aabb3;
        "closest_points_obb3": Obb3, Obb3;
        "closest_points_point_line3": Vec3, Line3;
        "closest_points_lines3": Line3, Line3;
    }
}

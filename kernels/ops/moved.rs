//! Shapes moved by poses as operations. The rotation of a pose counts by its direction, whatever its length, so that
//! shapes keep their size.
use crate::kernels::ops::convention::unsigned;
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::Move;
use crate::{
    Capsule2, Capsule3, Circle, Cone, Cylinder, Disc, Ellipsoid, Line2, Line3, Obb2, Obb3, Plane3, Pose2, Pose3, Ray2, Ray3,
    RoundBox3, Segment2, Segment3, Sphere, Tetrahedron, Triangle2, Triangle3, Vec2, Vec3,
};

table! {
    /// A point, moved by a pose.
    Move: (pose, shape) -> Vec2<S> { unsigned(pose.normalized() * shape) } [] (jumps Never) derivative Reverse {
        "move_point": Pose2, Vec2;
    }
    /// A segment, moved by a pose. The pose's cosine and sine count by their direction alone: the segment keeps its length.
    Move: (pose, segment) -> Segment2<S> { pose.normalized() * segment } [] (jumps Never) derivative Reverse {
        "move_segment": Pose2, Segment2;
    }
    /// A triangle, moved by a pose.
    Move: (pose, shape) -> Triangle2<S> { unsigned(pose.normalized() * shape) } [] (jumps Never) derivative Reverse {
        "move_triangle": Pose2, Triangle2;
    }
    /// A circle, moved by a pose.
    Move: (pose, shape) -> Circle<S> { unsigned(pose.normalized() * shape) } [] (jumps Never) derivative Reverse {
        "move_circle": Pose2, Circle;
    }
    /// A capsule, moved by a pose.
    Move: (pose, shape) -> Capsule2<S> { unsigned(pose.normalized() * shape) } [] (jumps Never) derivative Reverse {
        "move_capsule": Pose2, Capsule2;
    }
    /// A rotated box, moved by a pose. The angle of the pose, of (−π, π], is added to its heading and jumps there.
    Move: (pose, shape) -> Obb2<S> { unsigned(pose.normalized() * shape) } [] (jumps Anywhere) derivative Reverse {
        "move_obb2": Pose2, Obb2;
    }
    /// A line, moved by a pose.
    Move: (pose, shape) -> Line2<S> { unsigned(pose.normalized() * shape) } [] (jumps Never) derivative Reverse {
        "move_line": Pose2, Line2;
    }
    /// A ray, moved by a pose.
    Move: (pose, shape) -> Ray2<S> { unsigned(pose.normalized() * shape) } [] (jumps Never) derivative Reverse {
        "move_ray": Pose2, Ray2;
    }
    /// The pose that applies the second one first, then the first one.
    Move: (pose, shape) -> Pose2<S> { unsigned(pose.normalized() * shape.normalized()) }
    [] (jumps Never) derivative Reverse {
        "move_pose": Pose2, Pose2;
    }
    /// A point, moved by a pose.
    Move: (pose, shape) -> Vec3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_point3": Pose3, Vec3;
    }
    /// A segment of space, moved by a pose.
    Move: (pose, shape) -> Segment3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_segment3": Pose3, Segment3;
    }
    /// A triangle of space, moved by a pose.
    Move: (pose, shape) -> Triangle3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_triangle3": Pose3, Triangle3;
    }
    /// A tetrahedron, moved by a pose.
    Move: (pose, shape) -> Tetrahedron<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_tetrahedron": Pose3, Tetrahedron;
    }
    /// A ball, moved by a pose.
    Move: (pose, shape) -> Sphere<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_sphere": Pose3, Sphere;
    }
    /// A capsule of space, moved by a pose.
    Move: (pose, shape) -> Capsule3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_capsule3": Pose3, Capsule3;
    }
    /// A cylinder, moved by a pose.
    Move: (pose, shape) -> Cylinder<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_cylinder": Pose3, Cylinder;
    }
    /// A cone, moved by a pose.
    Move: (pose, shape) -> Cone<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_cone": Pose3, Cone;
    }
    /// An ellipsoid, moved by a pose.
    Move: (pose, shape) -> Ellipsoid<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_ellipsoid": Pose3, Ellipsoid;
    }
    /// A disc, moved by a pose.
    Move: (pose, shape) -> Disc<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_disc": Pose3, Disc;
    }
    /// A box with round edges, moved by a pose.
    Move: (pose, shape) -> RoundBox3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_round_box": Pose3, RoundBox3;
    }
    /// A box of any orientation, moved by a pose.
    Move: (pose, shape) -> Obb3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_obb3": Pose3, Obb3;
    }
    /// A half-space, moved by a pose.
    Move: (pose, shape) -> Plane3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_plane": Pose3, Plane3;
    }
    /// A line of space, moved by a pose.
    Move: (pose, shape) -> Line3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_line3": Pose3, Line3;
    }
    /// A ray of space, moved by a pose.
    Move: (pose, shape) -> Ray3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_ray3": Pose3, Ray3;
    }
    /// The pose of space that applies the second one first, then the first one.
    Move: (pose, shape) -> Pose3<S> { unsigned(pose * shape) } [] (jumps Never) derivative Reverse {
        "move_pose3": Pose3, Pose3;
    }
}

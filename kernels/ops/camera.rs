//! Images of points, and angles between rotations, as operations with domains.
use crate::camera::{BrownConrady, Fisheye, Pinhole};
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{Angle, Project};
use crate::{Rotation3, Vec2, Vec3};

table! {
    /// The angle in radians between {}, 0 to π.
    Angle: (a, b) -> S { a.angle_to(b).canonical() }
    [similar, symmetric] (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "angle_rotations3": Rotation3, Rotation3;
        "angle_vectors3": Vec3, Vec3 [similar, about_origin, symmetric];
    }
    // The point is in the camera's own frame, so a motion of the point changes the image.
    /// The image of a point of a camera's frame, in pixels. Points that it does not see have one, too; `sees` tells.
    Project: (point, camera) -> Vec2<S> { camera.project(point) }
    [] (jumps Never domain { camera.sees(point) }) derivative Reverse {
        /// The camera has no distortion: [`Pinhole`](crate::camera::Pinhole).
        "project_pinhole": Vec3, Pinhole;
        /// The camera has radial and tangential distortion: [`BrownConrady`](crate::camera::BrownConrady).
        "project_brown_conrady": Vec3, BrownConrady;
        /// The camera sees by the angle to its axis: [`Fisheye`](crate::camera::Fisheye).
        "project_fisheye": Vec3, Fisheye;
    }
}

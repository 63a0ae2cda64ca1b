//! Images of points, and angles between rotations, as operations with domains.
use crate::camera::{BrownConrady, Fisheye, Pinhole};
use crate::kernels::verbs::{Angle, Project};
use crate::{Rotation3, Vec2, Vec3, operation};

operation! {
    /// The [angle](Rotation3::angle_to) between two rotations.
    Angle: (a: Rotation3<S>, b: Rotation3<S>) -> S { a.angle_to(b).canonical() }
    invariances [Rotation Stays, RotationX Stays, RotationY Stays, Exchange Stays]
    range NOT_NEGATIVE
    jumps Never
    derivative Reverse

    /// The [image](Pinhole::project) of a point in a pinhole camera.
    Project: (point: Vec3<S>, camera: Pinhole<S>) -> Vec2<S> { camera.project(point) }
    invariances []
    jumps Never
    domain { camera.sees(point) }
    derivative Reverse

    /// The [image](BrownConrady::project) of a point in a camera with radial and tangential distortion.
    Project: (point: Vec3<S>, camera: BrownConrady<S>) -> Vec2<S> { camera.project(point) }
    invariances []
    jumps Never
    domain { camera.sees(point) }
    derivative Reverse

    /// The [image](Fisheye::project) of a point in a fisheye camera.
    Project: (point: Vec3<S>, camera: Fisheye<S>) -> Vec2<S> { camera.project(point) }
    invariances []
    jumps Never
    domain { camera.sees(point) }
    derivative Reverse
}

//! Rotations and poses of space: exponentials, logarithms, their Jacobians, and what poses do to twists.
use crate::unsigned;
use geograd::{Pose2, Pose3, Rotation3, Vec3, operation};

operation! {
    /// The rotation of a rotation vector in radians: the exponential.
    pub FromRotationVector = "rotation_of_vector": (vector: Vec3<S>) -> Rotation3<S> {
        unsigned(Rotation3::from_rotation_vector(vector))
    }
    invariances [] jumps Never derivative Reverse

    /// The rotation vector of a rotation, of length 0 to π radians: the logarithm. It jumps at half turns.
    pub RotationVector = "vector_of_rotation": (rotation: Rotation3<S>) -> Vec3<S> {
        unsigned(rotation.rotation_vector())
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The left Jacobian of the exponential at a rotation vector, column by column.
    pub LeftJacobian = "left_jacobian": (vector: Vec3<S>) -> [Vec3<S>; 3] {
        unsigned(Rotation3::left_jacobian(vector))
    }
    invariances [] jumps Never derivative Reverse

    /// The right Jacobian of the exponential at a rotation vector, column by column.
    pub RightJacobian = "right_jacobian": (vector: Vec3<S>) -> [Vec3<S>; 3] {
        unsigned(Rotation3::right_jacobian(vector))
    }
    invariances [] jumps Never derivative Reverse

    /// The inverse of the left Jacobian at a rotation vector shorter than 2π, column by column.
    pub LeftJacobianInverse = "left_jacobian_inverse": (vector: Vec3<S>) -> [Vec3<S>; 3] {
        unsigned(Rotation3::left_jacobian_inverse(vector))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The inverse of the right Jacobian at a rotation vector shorter than 2π, column by column.
    pub RightJacobianInverse = "right_jacobian_inverse": (vector: Vec3<S>) -> [Vec3<S>; 3] {
        unsigned(Rotation3::right_jacobian_inverse(vector))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The rotation after a small turn in the body's frame, a rotation vector in radians.
    pub RetractRotation = "retract_rotation": (rotation: Rotation3<S>, turn: Vec3<S>) -> Rotation3<S> {
        unsigned(rotation.retract(turn))
    }
    invariances [] jumps Never derivative Reverse

    /// The turn in the body's frame that leads to another rotation, a rotation vector in radians: the inverse of
    /// `retract`. It jumps at half turns.
    pub TangentToRotation = "tangent_to_rotation": (a: Rotation3<S>, b: Rotation3<S>) -> Vec3<S> {
        unsigned(a.tangent_to(b))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The square of the angle between two rotations, in `[0, π²]`.
    pub SquaredAngle = "squared_angle_rotations": (a: Rotation3<S>, b: Rotation3<S>) -> S { a.squared_angle_to(b) }
    invariances [] jumps Never derivative Reverse

    /// The rotation a share of the way to another one, along the shorter arc. It jumps at half turns.
    pub InterpolateRotations = "interpolate_rotations": (a: Rotation3<S>, b: Rotation3<S>, share: S) -> Rotation3<S> {
        unsigned(a.interpolate(b, share))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The rotation that turns back.
    pub InverseRotation = "inverse_rotation": (rotation: Rotation3<S>) -> Rotation3<S> { unsigned(rotation.inverse()) }
    invariances [] jumps Never derivative Reverse
}

operation! {
    /// The images of the axes of a rotation: the columns of its matrix.
    pub Axes = "axes_of_rotation": (rotation: Rotation3<S>) -> [Vec3<S>; 3] { unsigned(rotation.axes()) }
    invariances [] jumps Never derivative Reverse

    /// The rotation with the smallest difference from a matrix, given by its columns: its nearest rotation. It jumps
    /// where several are nearest.
    pub NearestRotation = "nearest_rotation": (columns: [Vec3<S>; 3]) -> Rotation3<S> {
        unsigned(Rotation3::nearest_to(columns))
    }
    invariances [] jumps Anywhere derivative Forward

    /// The first two columns of a rotation's matrix: six coordinates without jumps.
    pub ToSix = "six_of_rotation": (rotation: Rotation3<S>) -> [Vec3<S>; 2] { unsigned(rotation.to_6d()) }
    invariances [] jumps Never derivative Reverse

    /// The rotation whose x axis is along the first vector and whose y axis is in the half plane of both.
    pub FromSix = "rotation_of_six": (columns: [Vec3<S>; 2]) -> Rotation3<S> { unsigned(Rotation3::from_6d(columns)) }
    invariances [] jumps Anywhere derivative Reverse

    /// A vector, turned.
    pub TurnVector = "turn_vector": (rotation: Rotation3<S>, vector: Vec3<S>) -> Vec3<S> { unsigned(rotation * vector) }
    invariances [] jumps Never derivative Reverse

    /// The rotation that turns by the second one first, then by the first one.
    pub TurnRotation = "turn_rotation": (a: Rotation3<S>, b: Rotation3<S>) -> Rotation3<S> { unsigned(a * b) }
    invariances [] jumps Never derivative Reverse
}

operation! {
    /// The pose after one unit of time at constant velocity, a screw, from turn and shift: the coupled exponential.
    pub FromTwist = "pose_of_twist": (turn: Vec3<S>, shift: Vec3<S>) -> Pose3<S> {
        unsigned(Pose3::from_twist(turn, shift))
    }
    invariances [] jumps Never derivative Reverse

    /// The turn, of length 0 to π radians, and the shift of the screw to a pose: the coupled logarithm. It jumps at half
    /// turns.
    pub Twist = "twist_of_pose": (pose: Pose3<S>) -> (Vec3<S>, Vec3<S>) { unsigned(pose.twist()) }
    invariances [] jumps Anywhere derivative Reverse

    /// The pose after a small turn and shift in the body's own frame.
    pub RetractPose = "retract_pose": (pose: Pose3<S>, turn: Vec3<S>, shift: Vec3<S>) -> Pose3<S> {
        unsigned(pose.retract(turn, shift))
    }
    invariances [] jumps Never derivative Reverse

    /// The turn and the shift that lead to another pose: the inverse of `retract`. It jumps at half turns.
    pub TangentToPose = "tangent_to_pose": (a: Pose3<S>, b: Pose3<S>) -> (Vec3<S>, Vec3<S>) {
        unsigned(a.tangent_to(b))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// A twist, turn and shift, of frame b in frame a, by the pose `a_from_b`: the adjoint.
    pub Adjoint = "adjoint_of_pose": (pose: Pose3<S>, turn: Vec3<S>, shift: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
        unsigned(pose.adjoint(turn, shift))
    }
    invariances [] jumps Never derivative Reverse

    /// A moment and a force of frame a in frame b, by the pose `a_from_b`: the transposed adjoint.
    pub AdjointTransposed = "adjoint_transposed_of_pose":
        (pose: Pose3<S>, moment: Vec3<S>, force: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
        unsigned(pose.adjoint_transposed(moment, force))
    }
    invariances [] jumps Never derivative Reverse

    /// The pose a share of the way to another one. It jumps at half turns.
    pub InterpolatePoses = "interpolate_poses": (a: Pose3<S>, b: Pose3<S>, share: S) -> Pose3<S> {
        unsigned(a.interpolate(b, share))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The pose that moves back.
    pub InversePose = "inverse_pose": (pose: Pose3<S>) -> Pose3<S> { unsigned(pose.inverse()) }
    invariances [] jumps Never derivative Reverse

    /// The pose of the plane back. Its cosine and sine count by their direction alone.
    pub InversePlane = "inverse_pose2": (pose: Pose2<S>) -> Pose2<S> { unsigned(pose.normalized().inverse()) }
    invariances [] jumps Never derivative Reverse
}

//! Motions of bodies, from poses and at a time.
use crate::unsigned;
use geograd::motion::Motion3;
use geograd::{Pose3, operation};

operation! {
    /// The motion from one pose to another at constant velocity and turn: the origin moves along a straight line. It
    /// jumps at half turns.
    pub Between = "motion_between": (start: Pose3<S>, end: Pose3<S>) -> Motion3<S> {
        unsigned(Motion3::between(start, end))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The motion from one pose to another along a screw: a turn about one axis and a shift along it. It jumps at half
    /// turns.
    pub Screw = "motion_screw": (start: Pose3<S>, end: Pose3<S>) -> Motion3<S> {
        unsigned(Motion3::screw(start, end))
    }
    invariances [] jumps Anywhere derivative Reverse

    /// The pose that takes a body from its place at time 0 to that at a time.
    pub PoseAt = "pose_at": (motion: Motion3<S>, time: S) -> Pose3<S> { unsigned(motion.at(time)) }
    invariances [] jumps Never derivative Reverse
}

//! Motions of space at a constant velocity and a constant turn.
use crate::shape::{Pose3, Rotation3};
use crate::{Scalar, Shape, Vec3};

/// A motion of a rigid body from time 0 to time 1: a turn about a centre, which moves along a straight line.
///
/// A body stands where it is given at time 0. Velocity and turn are those of the whole time: a body with turn
/// `(0, 0, π)` makes half a turn about z.
///
/// ```
/// use geograd::motion::Motion3;
/// use geograd::{Pose3, Rotation3, Sphere, Vec3};
/// let (start, end) = (Pose3::identity(), Pose3::new(Vec3::new(4.0, 0.0, 0.0), Rotation3::from_yaw(1.0)));
/// let motion = Motion3::between(start, end);
/// let ball = Sphere::new(Vec3::new(0.0, 0.0, 3.0), 1.0);
/// assert_eq!((motion.at(0.5) * ball).center, Vec3::new(2.0, 0.0, 3.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion3<S> {
    /// The centre of the turn at time 0, such as the body's own origin.
    pub center: Vec3<S>,
    /// The way of the centre in the whole time.
    #[shape(direction)]
    pub velocity: Vec3<S>,
    /// The turn in the whole time, as a rotation vector in radians; several turns are allowed.
    #[shape(rotation_vector)]
    pub turn: Vec3<S>,
}

impl<S> Motion3<S> {
    /// Creates a motion from the centre of its turn, the way of that centre and the rotation vector.
    #[inline(always)]
    pub const fn new(center: Vec3<S>, velocity: Vec3<S>, turn: Vec3<S>) -> Self {
        Motion3 {
            center,
            velocity,
            turn,
        }
    }
}

impl<S: Scalar> Motion3<S> {
    /// Returns the motion of a body that stands still.
    #[must_use]
    #[inline]
    pub fn still() -> Self {
        Motion3::new(Vec3::zero(), Vec3::zero(), Vec3::zero())
    }
    /// Returns the motion along a straight line without a turn.
    #[must_use]
    #[inline]
    pub fn straight(velocity: Vec3<S>) -> Self {
        Motion3::new(Vec3::zero(), velocity, Vec3::zero())
    }
    /// Returns the motion of a body from one pose to another: its origin moves along a straight line, the rotation along
    /// the shorter arc, as [`Pose3::interpolate`] does. The body stands at the first pose.
    #[must_use]
    #[inline]
    pub fn between(from: Pose3<S>, to: Pose3<S>) -> Self {
        let turn = (to.rotation * from.rotation.inverse()).rotation_vector();
        Motion3::new(from.translation, to.translation - from.translation, turn)
    }
    /// Returns the motion of a body from one pose to another along a screw: a turn about one axis and a shift along it.
    /// The body stands at the first pose.
    ///
    /// It is the straight way where the poses have one rotation. The axis of a turn by a small angle φ is far away: places
    /// along the way have an error of a rounding of the way over φ.
    #[must_use]
    #[inline]
    pub fn screw(from: Pose3<S>, to: Pose3<S>) -> Self {
        let between = Motion3::between(from, to);
        let (turn, way) = (between.turn, between.velocity);
        let square = turn.length_squared();
        let none = square.at_most(S::zero());
        let square = S::select(none, S::one(), square);
        let along = turn * turn.dot(way).over(square);
        let across = way - along;
        // The centre p of a turn by the angle a that takes the origin across by w: p = w/2 + (k × w)/2 cot(a/2), with
        // k the axis; per unit of the angle, a cot(a/2) is finite at 0.
        let angle = turn.length();
        let (sin, cos) = angle.halved().sin_cos();
        let flat = sin.unsigned().at_most(S::zero());
        let cotangent = cos.over(S::select(flat, S::one(), sin) * angle_or_one(angle));
        let arm = across * S::lit(0.5) + turn.cross(across) * cotangent.halved();
        let arm = Vec3::select(none, Vec3::zero(), arm);
        let way = Vec3::select(none, way, along);
        Motion3::new(between.center + arm, way, turn)
    }
    /// Returns the pose that takes the body from its place at time 0 to that at time `t`.
    #[must_use]
    #[inline]
    pub fn at(self, t: S) -> Pose3<S> {
        let rotation = Rotation3::from_rotation_vector(self.turn * t);
        let center = self.center + self.velocity * t;
        Pose3::new(center - rotation * self.center, rotation)
    }
    /// Returns the pose at time `t` of a body whose place is given relative to the centre.
    #[inline]
    pub(super) fn after_center(self, t: S) -> Pose3<S> {
        Pose3::new(
            self.center + self.velocity * t,
            Rotation3::from_rotation_vector(self.turn * t),
        )
    }
    /// Returns the shift that makes places relative to the centre.
    #[inline]
    pub(super) fn before_center(self) -> Pose3<S> {
        Pose3::new(-self.center, Rotation3::identity())
    }
    /// Returns the velocity of a point of the body that is at `point` at time `t`.
    #[inline]
    pub(super) fn velocity_at(self, t: S, point: Vec3<S>) -> Vec3<S> {
        let center = self.center + self.velocity * t;
        self.velocity + self.turn.cross(point - center)
    }
}

/// Returns an angle, or one in place of zero.
#[inline(always)]
fn angle_or_one<S: Scalar>(angle: S) -> S {
    S::select(angle.at_most(S::zero()), S::one(), angle)
}

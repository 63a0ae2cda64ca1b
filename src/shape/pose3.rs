//! Rigid motions of space.
use crate::shape::Rotation3;
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// A rigid motion of space: a rotation, then a translation.
///
/// Named `a_from_b` it maps coordinates of frame b to frame a, and `a_from_b * b_from_c` is `a_from_c`.
///
/// ```
/// use geograd::{Pose3, Rotation3, Vec3};
/// let world_from_car = Pose3::new(Vec3::new(10.0, 0.0, 1.0), Rotation3::from_yaw(0.5));
/// let there = world_from_car * Vec3::new(2.0, 1.0, 0.5);
/// assert!((world_from_car.inverse() * there).distance(Vec3::new(2.0, 1.0, 0.5)) < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose3<S> {
    /// Applied first.
    pub rotation: Rotation3<S>,
    /// Applied second: where the origin goes.
    pub translation: Vec3<S>,
}

impl<S> Pose3<S> {
    /// Creates a motion from the image of the origin and the rotation, in the order of
    /// [`Pose2::new`](crate::Pose2::new) and of the boxes.
    #[inline(always)]
    pub const fn new(translation: Vec3<S>, rotation: Rotation3<S>) -> Self {
        Pose3 {
            rotation,
            translation,
        }
    }
}

impl<S: Scalar> Pose3<S> {
    /// Returns the motion that moves nothing.
    #[inline(always)]
    pub fn identity() -> Self {
        Pose3::new(Vec3::zero(), Rotation3::identity())
    }
    /// Returns the motion back.
    #[must_use]
    #[inline]
    pub fn inverse(self) -> Self {
        let rotation = self.rotation.inverse();
        Pose3::new(-(rotation * self.translation), rotation)
    }
    /// Returns the motion a fraction `t` of the way to another one: the rotation along the shorter arc, the origin
    /// along a straight line.
    #[must_use]
    #[inline]
    pub fn interpolate(self, other: Self, t: S) -> Self {
        Pose3::new(
            self.translation.lerp(other.translation, t),
            self.rotation.interpolate(other.rotation, t),
        )
    }
    /// Returns the motion after a small one in the body's own frame: a turn as a rotation vector in radians and
    /// a shift. The step of an optimiser in six numbers.
    #[must_use]
    #[inline]
    pub fn retract(self, turn: Vec3<S>, shift: Vec3<S>) -> Self {
        Pose3::new(
            self.translation + self.rotation * shift,
            self.rotation.retract(turn),
        )
    }
    /// Returns the turn and the shift that lead to another motion: the inverse of [`retract`](Self::retract).
    #[must_use]
    #[inline]
    pub fn tangent_to(self, other: Self) -> (Vec3<S>, Vec3<S>) {
        (
            self.rotation.tangent_to(other.rotation),
            self.rotation.inverse() * (other.translation - self.translation),
        )
    }
}

impl<S: Scalar> Mul for Pose3<S> {
    type Output = Self;
    /// Returns the motion that applies `other` first, then `self`.
    #[inline]
    fn mul(self, other: Self) -> Self {
        Pose3::new(self * other.translation, self.rotation * other.rotation)
    }
}

impl<S: Scalar> Mul<Vec3<S>> for Pose3<S> {
    type Output = Vec3<S>;
    #[inline]
    fn mul(self, point: Vec3<S>) -> Vec3<S> {
        self.rotation * point + self.translation
    }
}

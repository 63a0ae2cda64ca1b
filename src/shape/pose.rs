//! Rotations and rigid motions of the plane.
use crate::{Scalar, Shape, Vec2};
use std::ops::Mul;

/// A rotation of the plane, as the cosine and sine of its angle (counter-clockwise).
///
/// Operators take both numbers as they are, and scale by their length. [`normalized`](Self::normalized) brings any pair
/// except zero to length one, and [`Move`](crate::kernels::Move) does that by itself. Valid when finite and not zero.
///
/// ```
/// use geograd::{Rotation2, Vec2};
/// let quarter = Rotation2::from_angle(std::f64::consts::FRAC_PI_2);
/// assert!((quarter * Vec2::new(1.0, 0.0)).distance(Vec2::new(0.0, 1.0)) < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Sample), non_zero)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rotation2<S> {
    /// The cosine of the angle.
    pub cos: S,
    /// The sine of the angle.
    pub sin: S,
}

impl<S: Scalar> Rotation2<S> {
    /// Returns the rotation by zero.
    #[inline(always)]
    pub fn identity() -> Self {
        Rotation2 {
            cos: S::one(),
            sin: S::zero(),
        }
    }
    /// Creates the rotation by an angle in radians, counter-clockwise.
    #[inline(always)]
    pub fn from_angle(angle: S) -> Self {
        let (sin, cos) = angle.sin_cos();
        Rotation2 { cos, sin }
    }
    /// Returns the angle in radians, in `[−π, π]`.
    #[must_use]
    #[inline(always)]
    pub fn angle(self) -> S {
        self.sin.atan2(self.cos)
    }
    /// Returns the rotation by this angle with cosine and sine of length one; no rotation (with derivative zero) for
    /// two zeros.
    ///
    /// ```
    /// use geograd::Rotation2;
    /// let long = 2.0_f64.powi(600);
    /// let turn = Rotation2 { cos: 3.0 * long, sin: 4.0 * long };
    /// assert_eq!(turn.normalized(), Rotation2 { cos: 0.6, sin: 0.8 });
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn normalized(self) -> Self {
        let size = self.cos.primal().magnitude();
        let size = size.most(self.sin.primal().magnitude());
        let zero = size.at_most(S::Primal::zero());
        let scale = S::from_primal(S::Primal::select(zero, S::Primal::one(), size).binade());
        let cos = S::select(zero, S::one(), self.cos * scale);
        let sin = S::select(zero, S::zero(), self.sin * scale);
        let length = (cos * cos + sin * sin).root();
        Rotation2 {
            cos: cos.over(length),
            sin: sin.over(length),
        }
    }
    /// Returns the rotation back.
    #[must_use]
    #[inline(always)]
    pub fn inverse(self) -> Self {
        Rotation2 {
            cos: self.cos,
            sin: -self.sin,
        }
    }
}

impl<S: Scalar> Mul for Rotation2<S> {
    type Output = Self;
    /// Returns the rotation that turns by `other` first, then by `self`.
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Rotation2 {
            cos: self.cos * other.cos - self.sin * other.sin,
            sin: self.sin * other.cos + self.cos * other.sin,
        }
    }
}

impl<S: Scalar> Mul<Vec2<S>> for Rotation2<S> {
    type Output = Vec2<S>;
    #[inline(always)]
    fn mul(self, v: Vec2<S>) -> Vec2<S> {
        Vec2::new(
            self.cos * v.x - self.sin * v.y,
            self.sin * v.x + self.cos * v.y,
        )
    }
}

/// A rigid motion of the plane: a rotation, then a translation.
///
/// Named `a_from_b` it maps coordinates of frame b to frame a, and
/// `a_from_b * b_from_c` is `a_from_c`.
///
/// ```
/// use geograd::{Pose2, Vec2};
/// let world_from_car = Pose2::new(Vec2::new(10.0, 0.0), 0.5);
/// let there = world_from_car * Vec2::new(2.0, 1.0);
/// assert!((world_from_car.inverse() * there).distance(Vec2::new(2.0, 1.0)) < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose2<S> {
    /// Applied first.
    pub rotation: Rotation2<S>,
    /// Applied second: where the origin goes.
    pub translation: Vec2<S>,
}

impl<S: Scalar> Pose2<S> {
    /// Creates a motion from the image of the origin and the angle in radians, counter-clockwise.
    #[inline(always)]
    pub fn new(translation: Vec2<S>, angle: S) -> Self {
        Pose2 {
            rotation: Rotation2::from_angle(angle),
            translation,
        }
    }
    /// Returns the motion that moves nothing.
    #[inline(always)]
    pub fn identity() -> Self {
        Pose2 {
            rotation: Rotation2::identity(),
            translation: Vec2::zero(),
        }
    }
    /// Returns the angle of the rotation in radians, in `[−π, π]`.
    #[must_use]
    #[inline(always)]
    pub fn angle(self) -> S {
        self.rotation.angle()
    }
    /// Returns the motion with its rotation [normalized](Rotation2::normalized): rigid for any length of cosine and
    /// sine.
    #[must_use]
    #[inline(always)]
    pub fn normalized(self) -> Self {
        Pose2 {
            rotation: self.rotation.normalized(),
            ..self
        }
    }
    /// Returns the motion back.
    #[must_use]
    #[inline(always)]
    pub fn inverse(self) -> Self {
        let rotation = self.rotation.inverse();
        Pose2 {
            rotation,
            translation: -(rotation * self.translation),
        }
    }
}

impl<S: Scalar> Mul for Pose2<S> {
    type Output = Self;
    /// Returns the motion that applies `other` first, then `self`.
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Pose2 {
            rotation: self.rotation * other.rotation,
            translation: self * other.translation,
        }
    }
}

impl<S: Scalar> Mul<Vec2<S>> for Pose2<S> {
    type Output = Vec2<S>;
    #[inline(always)]
    fn mul(self, point: Vec2<S>) -> Vec2<S> {
        self.rotation * point + self.translation
    }
}

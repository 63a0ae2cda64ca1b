//! Boxes of any orientation in space.
use crate::scalar::Guard;
use crate::shape::{Aabb3, Plane3, Pose3, Rotation3, YawBox3};
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// A box of any orientation in space: centre, size along its own axes, rotation of those axes. Valid
/// when finite, of non-negative size and with a quaternion that is not zero; zero size is valid.
///
/// ```
/// use geograd::{Obb3, Rotation3, Vec3};
/// let tilted = Rotation3::from_axis_angle(Vec3::new(1.0, 0.0, 0.0), 0.2_f64);
/// let a = Obb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(4.0, 2.0, 1.0), tilted);
/// assert_eq!(a.volume(), 8.0);
/// assert!(a.contains(tilted * Vec3::new(1.9, 0.9, 0.4)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding, except(Sample))]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Obb3<S> {
    /// The centre.
    #[shape(names("x", "y", "z"))]
    pub center: Vec3<S>,
    /// The size along the box's own x, y and z axes.
    #[shape(names("dx", "dy", "dz"), non_negative, length)]
    pub size: Vec3<S>,
    /// The rotation of the box's own axes.
    #[shape(names("qw", "qx", "qy", "qz"))]
    pub rotation: Rotation3<S>,
}

impl<S> Obb3<S> {
    /// Creates a box from centre, size and rotation, unchecked.
    #[inline(always)]
    pub const fn new(center: Vec3<S>, size: Vec3<S>, rotation: Rotation3<S>) -> Self {
        Obb3 {
            center,
            size,
            rotation,
        }
    }
}

impl<S: Scalar> Obb3<S> {
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        self.size.x * self.size.y * self.size.z
    }
    /// Returns the area of all six faces.
    #[must_use]
    #[inline(always)]
    pub fn surface(self) -> S {
        let size = self.size;
        let half = size.x * size.y + size.y * size.z + size.z * size.x;
        half + half
    }
    /// Returns the motion from the box's own frame (centre at the origin, axes aligned) to the world.
    #[must_use]
    #[inline(always)]
    pub fn world_from_local(self) -> Pose3<S> {
        Pose3::new(self.center, self.rotation)
    }
    /// Returns the corners, in the order of [`FACES`](crate::shape::FACES).
    #[must_use]
    #[inline]
    pub fn corners(self) -> [Vec3<S>; 8] {
        let [x, y, z] = self.rotation.axes();
        let (x, y, z) = (
            x * self.size.x.halved(),
            y * self.size.y.halved(),
            z * self.size.z.halved(),
        );
        let c = self.center;
        let (low, high) = (c - z, c + z);
        [
            low - y - x,
            low - y + x,
            low + y - x,
            low + y + x,
            high - y - x,
            high - y + x,
            high + y - x,
            high + y + x,
        ]
    }
    /// Returns the planes of its faces, normals outwards: low x, high x, low y, high y, low z, high z.
    #[must_use]
    #[inline]
    pub fn planes(self) -> [Plane3<S>; 6] {
        let axes = self.rotation.axes();
        let half = [
            self.size.x.halved(),
            self.size.y.halved(),
            self.size.z.halved(),
        ];
        let face = |n: usize| {
            let along = axes[n / 2].dot(self.center);
            if n.is_multiple_of(2) {
                Plane3::new(-axes[n / 2], half[n / 2] - along)
            } else {
                Plane3::new(axes[n / 2], half[n / 2] + along)
            }
        };
        [face(0), face(1), face(2), face(3), face(4), face(5)]
    }
    /// Returns `true` where the point is in the box; the border belongs to it.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let p = self.rotation.inverse() * (point - self.center);
        let inside = p.x.magnitude().at_most(self.size.x.halved())
            & p.y.magnitude().at_most(self.size.y.halved())
            & p.z.magnitude().at_most(self.size.z.halved());
        Guard::of(&self.rotation).truth(inside)
    }
    /// Returns the smallest axis-aligned box around it. Kinks where an axis of the box is orthogonal to one of
    /// the world's.
    #[must_use]
    #[inline]
    pub fn bounding(self) -> Aabb3<S> {
        let [x, y, z] = self.rotation.axes();
        let reach = |v: Vec3<S>, half: S| {
            Vec3::new(
                v.x.magnitude() * half,
                v.y.magnitude() * half,
                v.z.magnitude() * half,
            )
        };
        let reach = reach(x, self.size.x.halved())
            + reach(y, self.size.y.halved())
            + reach(z, self.size.z.halved());
        Aabb3::new(self.center - reach, self.center + reach)
    }
    /// Returns the box after a small turn about its own axes, as a rotation vector in radians.
    #[must_use]
    #[inline]
    pub fn retract(self, turn: Vec3<S>) -> Self {
        Obb3::new(self.center, self.size, self.rotation.retract(turn))
    }
}

impl<S: Scalar> Mul<Obb3<S>> for Pose3<S> {
    type Output = Obb3<S>;
    /// Returns the box carried along: `world_from_car * box_in_car` is the box in the world.
    #[inline]
    fn mul(self, shape: Obb3<S>) -> Obb3<S> {
        Obb3 {
            center: self * shape.center,
            size: shape.size,
            rotation: self.rotation * shape.rotation,
        }
    }
}

impl<S: Scalar> From<YawBox3<S>> for Obb3<S> {
    #[inline(always)]
    fn from(upright: YawBox3<S>) -> Self {
        Obb3::new(upright.center, upright.size, upright.rotation())
    }
}

impl<S: Scalar> From<Aabb3<S>> for Obb3<S> {
    /// Returns the box as one with no rotation; a side longer than the largest number becomes that number.
    #[inline(always)]
    fn from(bounds: Aabb3<S>) -> Self {
        Obb3::new(
            bounds.center(),
            bounds.size().saturated(),
            Rotation3::identity(),
        )
    }
}

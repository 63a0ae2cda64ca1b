//! Ellipsoids.
use crate::shape::{Aabb3, Pose3, Rotation3, Sphere};
use crate::{Scalar, Shape, Vec3};
use std::f64::consts::PI;
use std::ops::Mul;

/// A solid ellipsoid: centre, half of the extents along its own axes, rotation of those axes. Valid when finite, of
/// non-negative extents and with a quaternion that is not zero; an extent of zero is valid.
///
/// ```
/// use geograd::{Ellipsoid, Rotation3, Vec3};
/// let egg = Ellipsoid::new(Vec3::new(0.0_f64, 0.0, 1.0), Vec3::new(3.0, 2.0, 1.0), Rotation3::identity());
/// assert!((egg.volume() - 8.0 * std::f64::consts::PI).abs() < 1e-14);
/// assert!(egg.contains(Vec3::new(2.9, 0.0, 1.0)));
/// assert!(!egg.contains(Vec3::new(2.9, 0.0, 1.5)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding, except(Sample))]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ellipsoid<S> {
    /// The centre.
    #[shape(names("x", "y", "z"))]
    pub center: Vec3<S>,
    /// Half of the extents along the ellipsoid's own x, y and z axes.
    #[shape(names("a", "b", "c"), non_negative, length)]
    pub semi_axes: Vec3<S>,
    /// The rotation of the ellipsoid's own axes.
    #[shape(names("qw", "qx", "qy", "qz"))]
    pub rotation: Rotation3<S>,
}

impl<S> Ellipsoid<S> {
    /// Creates an ellipsoid from centre, half extents and rotation, unchecked.
    #[inline(always)]
    pub const fn new(center: Vec3<S>, semi_axes: Vec3<S>, rotation: Rotation3<S>) -> Self {
        Ellipsoid {
            center,
            semi_axes,
            rotation,
        }
    }
}

impl<S: Scalar> Ellipsoid<S> {
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        self.semi_axes.x * self.semi_axes.y * self.semi_axes.z * S::lit(4.0 / 3.0 * PI)
    }
    /// Returns the smallest axis-aligned box around it.
    #[must_use]
    #[inline]
    pub fn bounding(self) -> Aabb3<S> {
        let [x, y, z] = self.rotation.axes();
        let size = self.semi_axes;
        let reach = |x: S, y: S, z: S| Vec3::new(x * size.x, y * size.y, z * size.z).length();
        let reach = Vec3::new(
            reach(x.x, y.x, z.x),
            reach(x.y, y.y, z.y),
            reach(x.z, y.z, z.z),
        );
        Aabb3::new(
            (self.center - reach).canonical(),
            (self.center + reach).canonical(),
        )
    }
    /// Returns the point that is farthest in a direction of any length; the centre for the zero vector.
    #[must_use]
    #[inline]
    pub fn support(self, direction: Vec3<S>) -> Vec3<S> {
        let [x, y, z] = self.rotation.axes();
        let size = self.semi_axes;
        let seen = Vec3::new(
            x.dot(direction) * size.x,
            y.dot(direction) * size.y,
            z.dot(direction) * size.z,
        );
        let unit = seen.normalize_or_zero();
        self.center + x * (unit.x * size.x) + y * (unit.y * size.y) + z * (unit.z * size.z)
    }
    /// Returns `true` where the point is in the ellipsoid; the surface belongs to it, within rounding.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let p = self.rotation.inverse() * (point - self.center);
        let size = self.semi_axes;
        let share = |x: S, size: S| {
            let none = size.at_most(S::zero());
            let share = x.over(S::select(none, S::one(), size));
            // Beside a side without an extent any share is beyond.
            let beyond = S::select(x.equals(S::zero()), S::zero(), S::lit(2.0));
            S::select(none, beyond, share)
        };
        let seen = Vec3::new(share(p.x, size.x), share(p.y, size.y), share(p.z, size.z));
        crate::scalar::Guard::of(&self.rotation).truth(seen.length().at_most(S::one()))
    }
}

impl<S: Scalar> Mul<Ellipsoid<S>> for Pose3<S> {
    type Output = Ellipsoid<S>;
    /// Returns the ellipsoid carried along.
    #[inline]
    fn mul(self, shape: Ellipsoid<S>) -> Ellipsoid<S> {
        Ellipsoid {
            center: self * shape.center,
            semi_axes: shape.semi_axes,
            rotation: self.rotation * shape.rotation,
        }
    }
}

impl<S: Scalar> From<Sphere<S>> for Ellipsoid<S> {
    #[inline(always)]
    fn from(ball: Sphere<S>) -> Self {
        let radius = ball.radius;
        Ellipsoid::new(
            ball.center,
            Vec3::new(radius, radius, radius),
            Rotation3::identity(),
        )
    }
}

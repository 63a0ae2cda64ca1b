//! Boxes with round edges in space.
use super::within;
use crate::error::{Flaw, Validate};
use crate::scalar::Guard;
use crate::shape::{Aabb3, Obb3, Pose3};
use crate::{Scalar, Shape, Vec3, twofold};
use std::f64::consts::PI;
use std::ops::Mul;

/// All points of space at most a radius from a box of any orientation. Valid when the box is and the radius is not
/// negative.
///
/// ```
/// use geograd::{Obb3, Rotation3, RoundBox3, Vec3};
/// let inner = Obb3::new(Vec3::new(0.0_f64, 0.0, 0.0), Vec3::new(4.0, 2.0, 2.0), Rotation3::identity());
/// let link = RoundBox3::new(inner, 0.5);
/// assert!(link.contains(Vec3::new(2.2, 1.2, 1.2)));
/// assert!(!link.contains(Vec3::new(2.4, 1.4, 1.4)));
/// assert_eq!(link.bounding().max, Vec3::new(2.5, 1.5, 1.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RoundBox3<S> {
    /// The box inside.
    #[shape(names("x", "y", "z", "dx", "dy", "dz", "qw", "qx", "qy", "qz"))]
    pub inner: Obb3<S>,
    /// The radius of edges and corners, and the distance of the faces from those of the box inside.
    #[shape(non_negative)]
    pub radius: S,
}

impl<S> RoundBox3<S> {
    /// Creates a box from the box inside and the radius, unchecked.
    #[inline(always)]
    pub const fn new(inner: Obb3<S>, radius: S) -> Self {
        RoundBox3 { inner, radius }
    }
}

impl<S: Scalar> RoundBox3<S> {
    /// Creates a box from the box inside and the radius.
    ///
    /// # Errors
    ///
    /// When the box is not valid or the radius is negative or not finite.
    pub fn try_new(inner: Obb3<S>, radius: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = RoundBox3 { inner, radius };
        made.validate().map(|()| made)
    }
    /// Returns the volume.
    #[must_use]
    #[inline]
    pub fn volume(self) -> S {
        let (size, r) = (self.inner.size, self.radius);
        let edges = (size.x + size.y + size.z) * S::lit(PI);
        let round = (r * S::lit(4.0 / 3.0 * PI) + edges) * r;
        (self.inner.volume() + (round + self.inner.surface()) * r).canonical()
    }
    /// Returns the area of the surface.
    #[must_use]
    #[inline]
    pub fn surface(self) -> S {
        let (size, r) = (self.inner.size, self.radius);
        let edges = (size.x + size.y + size.z) * S::lit(2.0 * PI);
        (self.inner.surface() + (r * S::lit(4.0 * PI) + edges) * r).canonical()
    }
    /// Returns the smallest axis-aligned box around it. Kinks where an axis of the box is orthogonal to one of the
    /// world's.
    #[must_use]
    #[inline]
    pub fn bounding(self) -> Aabb3<S> {
        let (bounds, r) = (self.inner.bounding(), self.radius);
        let reach = Vec3::new(r, r, r);
        Aabb3::new(
            (bounds.min - reach).canonical(),
            (bounds.max + reach).canonical(),
        )
    }
    /// Returns `true` where the point is in the box; the surface belongs to it.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let Obb3 {
            center,
            size,
            rotation,
        } = self.inner;
        let p = rotation.inverse() * (point - center);
        let beyond = |x: S, side: S| (x.magnitude() - side.halved()).most(S::zero());
        let out = Vec3::new(
            beyond(p.x, size.x),
            beyond(p.y, size.y),
            beyond(p.z, size.z),
        );
        let inside = within::in_ball(
            [S::Primal::zero(); 3],
            twofold::deep(out),
            self.radius.primal(),
        );
        Guard::of(&self).and(&point).truth(inside)
    }
}

impl<S: Scalar> Mul<RoundBox3<S>> for Pose3<S> {
    type Output = RoundBox3<S>;
    /// Returns the box carried along.
    #[inline]
    fn mul(self, shape: RoundBox3<S>) -> RoundBox3<S> {
        RoundBox3::new(self * shape.inner, shape.radius)
    }
}

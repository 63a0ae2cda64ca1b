//! Cylinders.
use super::within;
use crate::arrays::Each;
use crate::error::{Flaw, Validate};
use crate::shape::{Aabb3, Pose3};
use crate::{Scalar, Shape, Vec3, twofold};
use std::f64::consts::PI;
use std::ops::Mul;

/// A solid cylinder with flat ends. Valid when finite, its axis has a length and its radius is not negative; with
/// radius zero it is a segment.
///
/// ```
/// use geograd::{Cylinder, Vec3};
/// let can = Cylinder::new(Vec3::new(0.0_f64, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.0), 1.0);
/// assert!((can.volume() - 2.0 * std::f64::consts::PI).abs() < 1e-15);
/// assert!(can.contains(Vec3::new(0.6, 0.6, 1.9)));
/// assert!(!can.contains(Vec3::new(0.0, 0.0, 2.1)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cylinder<S> {
    /// The centre of one end.
    pub start: Vec3<S>,
    /// The centre of the other end.
    #[shape(differs_from = "start")]
    pub end: Vec3<S>,
    /// The radius.
    #[shape(non_negative)]
    pub radius: S,
}

/// Returns the half extents along x, y and z of a disc of radius one, given its unit normal.
#[inline(always)]
pub(super) fn disc_reach<S: Scalar>(normal: Vec3<S>) -> Vec3<S> {
    Vec3::new(
        normal.y.hypot(normal.z),
        normal.z.hypot(normal.x),
        normal.x.hypot(normal.y),
    )
}

impl<S> Cylinder<S> {
    /// Creates a cylinder from both ends of the axis and the radius, unchecked.
    #[inline(always)]
    pub const fn new(start: Vec3<S>, end: Vec3<S>, radius: S) -> Self {
        Cylinder { start, end, radius }
    }
}

impl<S: Scalar> Cylinder<S> {
    /// Creates a cylinder from both ends of the axis and the radius.
    ///
    /// # Errors
    ///
    /// When a field is not finite, the ends coincide or the radius is negative.
    pub fn try_new(start: Vec3<S>, end: Vec3<S>, radius: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Cylinder { start, end, radius };
        made.validate().map(|()| made)
    }
    /// Returns the height: how far both ends of the axis are apart.
    #[must_use]
    #[inline(always)]
    pub fn height(self) -> S {
        (self.end - self.start).length()
    }
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        (self.radius * self.radius * self.height() * S::lit(PI)).canonical()
    }
    /// Returns the area of the surface, both ends included.
    #[must_use]
    #[inline(always)]
    pub fn surface(self) -> S {
        (self.radius * (self.radius + self.height()) * S::lit(2.0 * PI)).canonical()
    }
    /// Returns the centre of its volume.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec3<S> {
        let half = S::lit(0.5);
        self.start * half + self.end * half
    }
    /// Returns the smallest axis-aligned box around it. Kinks where the axis is orthogonal to one of the world's.
    #[must_use]
    #[inline]
    pub fn bounding(self) -> Aabb3<S> {
        let axis = (self.end - self.start).normalize_or_zero();
        let reach = disc_reach(axis) * self.radius;
        let inner = Aabb3::of([self.start, self.end]);
        Aabb3::new(
            (inner.min - reach).canonical(),
            (inner.max + reach).canonical(),
        )
    }
    /// Returns `true` where the point is in the cylinder; the surface belongs to it.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let [start, end, at] = [self.start, self.end, point].each_as(twofold::deep);
        let radius = self.radius.primal();
        let seen = within::AxisPoint::new(start, end, at, radius);
        let across = within::square(twofold::cross(seen.axis, seen.arm));
        let reach =
            within::square([radius * seen.unit]) * within::square(twofold::rounded(seen.axis));
        seen.is_between() & across.at_most(reach)
    }
}

impl<S: Scalar> Mul<Cylinder<S>> for Pose3<S> {
    type Output = Cylinder<S>;
    /// Returns the cylinder carried along.
    #[inline(always)]
    fn mul(self, shape: Cylinder<S>) -> Cylinder<S> {
        Cylinder::new(self * shape.start, self * shape.end, shape.radius)
    }
}

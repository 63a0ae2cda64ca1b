//! Capsules in space: thick segments with round ends.
use super::within;
use crate::arrays::Each;
use crate::error::{Flaw, Validate};
use crate::shape::{Aabb3, Pose3, Segment3};
use crate::{Scalar, Shape, Vec3, twofold};
use std::f64::consts::PI;
use std::ops::Mul;

/// All points of space at most a radius from a segment. Valid when finite and the radius is not negative; with
/// coinciding ends it is a ball, with radius zero a segment.
///
/// ```
/// use geograd::{Capsule3, Vec3};
/// let link = Capsule3::new(Vec3::new(0.0_f64, 0.0, 0.0), Vec3::new(0.0, 0.0, 3.0), 1.0);
/// assert!(link.contains(Vec3::new(0.5, 0.5, -0.5)));
/// assert!((link.volume() - 13.0 / 3.0 * std::f64::consts::PI).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Capsule3<S> {
    /// One end of the segment inside.
    pub start: Vec3<S>,
    /// Its other end.
    pub end: Vec3<S>,
    /// The radius.
    #[shape(non_negative)]
    pub radius: S,
}

impl<S> Capsule3<S> {
    /// Creates a capsule from the ends of the segment inside and the radius, unchecked.
    #[inline(always)]
    pub const fn new(start: Vec3<S>, end: Vec3<S>, radius: S) -> Self {
        Capsule3 { start, end, radius }
    }
}

impl<S: Scalar> Capsule3<S> {
    /// Creates a capsule from the ends of the segment inside and the radius.
    ///
    /// # Errors
    ///
    /// When a field is not finite or the radius is negative.
    pub fn try_new(start: Vec3<S>, end: Vec3<S>, radius: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Capsule3 { start, end, radius };
        made.validate().map(|()| made)
    }
    /// Returns the segment inside.
    #[must_use]
    #[inline(always)]
    pub fn segment(self) -> Segment3<S> {
        Segment3::new(self.start, self.end)
    }
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        let (length, r) = (self.segment().length(), self.radius);
        (r * r * (length + r * S::lit(4.0 / 3.0)) * S::lit(PI)).canonical()
    }
    /// Returns the area of the surface.
    #[must_use]
    #[inline(always)]
    pub fn surface(self) -> S {
        let (length, r) = (self.segment().length(), self.radius);
        (r * (length + r + r) * S::lit(2.0 * PI)).canonical()
    }
    /// Returns the centre of its volume.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec3<S> {
        self.segment().center()
    }
    /// Returns the smallest axis-aligned box around it; ends that share a bound share its derivative.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb3<S> {
        let reach = Vec3::new(self.radius, self.radius, self.radius);
        let inner = self.segment().bounding();
        Aabb3::new(
            (inner.min - reach).canonical(),
            (inner.max + reach).canonical(),
        )
    }
    /// Returns `true` where the point is in the capsule; the surface belongs to it.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let [start, end, at] = [self.start, self.end, point].each_as(twofold::deep);
        let radius = self.radius.primal();
        let seen = within::AxisPoint::new(start, end, at, radius);
        let across = within::square(twofold::cross(seen.axis, seen.arm));
        let reach =
            within::square([radius * seen.unit]) * within::square(twofold::rounded(seen.axis));
        let [first, last] = [start, end].each_as(|end| within::in_ball(end, at, radius));
        first | last | seen.is_between() & across.at_most(reach)
    }
}

impl<S: Scalar> Mul<Capsule3<S>> for Pose3<S> {
    type Output = Capsule3<S>;
    /// Returns the capsule carried along.
    #[inline(always)]
    fn mul(self, shape: Capsule3<S>) -> Capsule3<S> {
        Capsule3::new(self * shape.start, self * shape.end, shape.radius)
    }
}

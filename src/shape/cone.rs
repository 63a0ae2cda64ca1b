//! Cones.
use super::within;
use crate::arrays::Each;
use crate::error::{Flaw, Validate};
use crate::shape::cylinder::disc_reach;
use crate::shape::{Aabb3, Pose3};
use crate::{Scalar, Shape, Vec3, twofold};
use std::f64::consts::PI;
use std::ops::Mul;

/// A solid cone with a flat base. Valid when finite, its axis has a length and its radius is not negative; with radius
/// zero it is a segment.
///
/// ```
/// use geograd::{Cone, Vec3};
/// let hat = Cone::new(Vec3::new(0.0_f64, 0.0, 3.0), Vec3::new(0.0, 0.0, 0.0), 1.0);
/// assert!((hat.volume() - std::f64::consts::PI).abs() < 1e-15);
/// assert!(hat.contains(Vec3::new(0.3, 0.0, 2.0)));
/// assert!(!hat.contains(Vec3::new(0.4, 0.0, 2.0)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cone<S> {
    /// The tip.
    pub apex: Vec3<S>,
    /// The centre of the base.
    #[shape(differs_from = "apex")]
    pub base: Vec3<S>,
    /// The radius of the base.
    #[shape(non_negative)]
    pub radius: S,
}

impl<S> Cone<S> {
    /// Creates a cone from both ends of the axis and the radius, unchecked.
    #[inline(always)]
    pub const fn new(apex: Vec3<S>, base: Vec3<S>, radius: S) -> Self {
        Cone { apex, base, radius }
    }
}

impl<S: Scalar> Cone<S> {
    /// Creates a cone from both ends of the axis and the radius.
    ///
    /// # Errors
    ///
    /// When a field is not finite, the ends coincide or the radius is negative.
    pub fn try_new(apex: Vec3<S>, base: Vec3<S>, radius: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Cone { apex, base, radius };
        made.validate().map(|()| made)
    }
    /// Returns the height: how far both ends of the axis are apart.
    #[must_use]
    #[inline(always)]
    pub fn height(self) -> S {
        (self.base - self.apex).length()
    }
    /// Returns the length of a straight line on its side, from the base's rim to the apex.
    #[must_use]
    #[inline(always)]
    pub fn slant(self) -> S {
        self.height().hypot(self.radius)
    }
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        (self.radius * self.radius * self.height() * S::lit(PI / 3.0)).canonical()
    }
    /// Returns the area of the surface, the base included.
    #[must_use]
    #[inline(always)]
    pub fn surface(self) -> S {
        (self.radius * (self.radius + self.slant()) * S::lit(PI)).canonical()
    }
    /// Returns the centre of its volume, at three quarters of the way from the apex to the base.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec3<S> {
        self.apex.lerp(self.base, S::lit(0.75))
    }
    /// Returns the smallest axis-aligned box around it. Kinks: where apex and base have an equal bound, and where the
    /// axis is orthogonal to one of the world's.
    #[must_use]
    #[inline]
    pub fn bounding(self) -> Aabb3<S> {
        let reach = disc_reach((self.base - self.apex).normalize_or_zero()) * self.radius;
        Aabb3::new(
            self.apex.least(self.base - reach).canonical(),
            self.apex.most(self.base + reach).canonical(),
        )
    }
    /// Returns `true` where the point is in the cone; the surface belongs to it.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let [apex, base, at] = [self.apex, self.base, point].each_as(twofold::deep);
        let radius = self.radius.primal();
        let seen = within::AxisPoint::new(apex, base, at, radius);
        let across = within::square(twofold::cross(seen.axis, seen.arm));
        let axis = within::square(twofold::rounded(seen.axis));
        let reach = within::square([radius * seen.unit]) * within::square([seen.height]);
        seen.is_between() & (across * axis).at_most(reach)
    }
}

impl<S: Scalar> Mul<Cone<S>> for Pose3<S> {
    type Output = Cone<S>;
    /// Returns the cone carried along.
    #[inline(always)]
    fn mul(self, shape: Cone<S>) -> Cone<S> {
        Cone::new(self * shape.apex, self * shape.base, shape.radius)
    }
}

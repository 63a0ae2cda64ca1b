//! Discs.
use crate::shape::cylinder::disc_reach;
use crate::shape::{Aabb3, Pose3};
use crate::{Scalar, Shape, Vec3};
use std::f64::consts::PI;
use std::ops::Mul;

/// A flat disc in space. Valid when finite, its normal has a length and its radius is not negative; with radius zero it
/// is a point. The length of the normal does not matter.
///
/// ```
/// use geograd::{Disc, Vec3};
/// let coin = Disc::new(Vec3::new(0.0_f64, 0.0, 1.0), Vec3::new(0.0, 0.0, 2.0), 3.0);
/// assert!((coin.area() - 9.0 * std::f64::consts::PI).abs() < 1e-14);
/// assert_eq!(coin.bounding().min, Vec3::new(-3.0, -3.0, 1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding, except(Sample))]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Disc<S> {
    /// The centre.
    #[shape(names("x", "y", "z"))]
    pub center: Vec3<S>,
    /// A vector orthogonal to it.
    #[shape(names("nx", "ny", "nz"), direction, non_zero)]
    pub normal: Vec3<S>,
    /// The radius.
    #[shape(non_negative)]
    pub radius: S,
}

impl<S> Disc<S> {
    /// Creates a disc from centre, normal and radius, unchecked.
    #[inline(always)]
    pub const fn new(center: Vec3<S>, normal: Vec3<S>, radius: S) -> Self {
        Disc {
            center,
            normal,
            radius,
        }
    }
}

impl<S: Scalar> Disc<S> {
    /// Returns the area.
    #[must_use]
    #[inline(always)]
    pub fn area(self) -> S {
        (self.radius * self.radius * S::lit(PI)).canonical()
    }
    /// Returns the smallest axis-aligned box around it. Kinks where the normal is along one of the world's axes.
    #[must_use]
    #[inline]
    pub fn bounding(self) -> Aabb3<S> {
        let reach = disc_reach(self.normal.normalize_or_zero()) * self.radius;
        Aabb3::new(
            (self.center - reach).canonical(),
            (self.center + reach).canonical(),
        )
    }
}

impl<S: Scalar> Mul<Disc<S>> for Pose3<S> {
    type Output = Disc<S>;
    /// Returns the disc carried along.
    #[inline(always)]
    fn mul(self, shape: Disc<S>) -> Disc<S> {
        Disc::new(
            self * shape.center,
            self.rotation * shape.normal,
            shape.radius,
        )
    }
}

//! Contact points as results.
use crate::{Scalar, Vec3};

/// The largest number of points of a contact.
pub(super) const MOST: usize = 8;

/// A pair of points in which two shapes touch, or all but touch.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactPoint3<S> {
    /// The point of a.
    pub on_a: Vec3<S>,
    /// The point of b.
    pub on_b: Vec3<S>,
    /// The signed distance of the points along the normal: minus the depth.
    #[shape(number)]
    pub gap: S,
}

/// The contact of two shapes of space: a direction, and up to eight pairs of points.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contacts3<S> {
    /// The direction, of length one, in which the shapes are apart or must part, from a to b; zero without a contact.
    #[shape(direction)]
    pub normal: Vec3<S>,
    /// The number of points. A constant.
    #[shape(number)]
    pub count: S,
    /// The points, counter-clockwise as the normal is seen from its tip; zero from `count` on.
    pub points: [ContactPoint3<S>; MOST],
}

impl<S: Scalar<Mask = bool>> Contacts3<S> {
    /// Returns the points that there are.
    #[must_use]
    pub fn points(&self) -> &[ContactPoint3<S>] {
        let is = |&k: &usize| S::lit(k as f64).below(self.count);
        &self.points[..(0..MOST).take_while(is).count()]
    }
}

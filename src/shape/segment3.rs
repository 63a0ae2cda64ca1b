//! Segments in space.
use crate::scalar::Guard;
use crate::shape::{Aabb3, Pose3};
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// A segment in space. Valid when finite; length zero is valid.
///
/// ```
/// use geograd::{Segment3, Vec3};
/// let edge = Segment3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0));
/// assert_eq!(edge.nearest(Vec3::new(5.0, 1.0, 0.0)), Vec3::new(2.0, 0.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Segment3<S> {
    /// Its start.
    pub start: Vec3<S>,
    /// Its end.
    pub end: Vec3<S>,
}

impl<S> Segment3<S> {
    /// Creates a segment from both ends.
    #[inline(always)]
    pub const fn new(start: Vec3<S>, end: Vec3<S>) -> Self {
        Segment3 { start, end }
    }
}

impl<S: Scalar> Segment3<S> {
    /// Returns the length; derivative zero at length zero.
    #[must_use]
    #[inline(always)]
    pub fn length(self) -> S {
        self.start.distance(self.end)
    }
    /// Returns the vector from start to end.
    #[must_use]
    #[inline(always)]
    pub fn vector(self) -> Vec3<S> {
        self.end - self.start
    }
    /// Returns the point a fraction `t` of the way along it.
    #[must_use]
    #[inline(always)]
    pub fn at(self, t: S) -> Vec3<S> {
        self.start.lerp(self.end, t)
    }
    /// Returns the middle.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec3<S> {
        let half = S::lit(0.5);
        self.start * half + self.end * half
    }
    /// Returns the smallest axis-aligned box around it; ends that share a bound share its derivative.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb3<S> {
        Aabb3::of([self.start, self.end])
    }
    /// Returns the point of the segment nearest to a point. Kinks where that begins to be an end.
    #[must_use]
    #[inline(always)]
    pub fn nearest(self, point: Vec3<S>) -> Vec3<S> {
        let along = self.vector();
        let size = along.x.magnitude().most(along.y.magnitude());
        let size = size.most(along.z.magnitude()).primal();
        let zero = size.at_most(S::Primal::zero());
        let scale = S::from_primal(S::Primal::select(zero, S::Primal::one(), size).binade());
        let unit = along * scale;
        let square = S::select(zero, S::one(), unit.length_squared());
        let t = ((point - self.start) * scale).dot(unit).over(square);
        let t = S::select(zero, S::zero(), t.clamp(S::zero(), S::one()));
        let nearest = self.at(t);
        Guard::of(&self).and(&point).result(nearest)
    }
}

impl<S: Scalar> Mul<Segment3<S>> for Pose3<S> {
    type Output = Segment3<S>;
    /// Returns the segment carried along.
    #[inline(always)]
    fn mul(self, shape: Segment3<S>) -> Segment3<S> {
        Segment3::new(self * shape.start, self * shape.end)
    }
}

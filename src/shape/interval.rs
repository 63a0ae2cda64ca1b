//! Intervals of the number line.
use crate::error::{Flaw, Validate};
use crate::scalar::Guard;
use crate::{Scalar, Shape};

/// A closed interval of the number line. Valid when finite and `min ≤ max`; length zero is valid.
///
/// ```
/// use geograd::Interval;
/// let (a, b) = (Interval::new(0.0, 4.0), Interval::new(3.0, 5.0));
/// assert_eq!(a.iou(b), 0.2); // one over five: each interval counts with its own length
/// assert_eq!(a.signed_distance(b), -1.0);
/// assert_eq!(a.distance(Interval::new(6.0, 7.0)), 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval<S> {
    /// The lower bound.
    #[shape(at_most = "max")]
    pub min: S,
    /// The upper bound.
    pub max: S,
}

impl<S> Interval<S> {
    /// Creates an interval from its bounds, unchecked.
    #[inline(always)]
    pub const fn new(min: S, max: S) -> Self {
        Interval { min, max }
    }
}

impl<S: Scalar> Interval<S> {
    /// Creates an interval from its bounds.
    ///
    /// # Errors
    ///
    /// When a bound is not finite or the lower one is above the upper one.
    pub fn try_new(min: S, max: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Interval { min, max };
        made.validate().map(|()| made)
    }
    /// Creates an interval from its centre and its length.
    #[must_use]
    #[inline(always)]
    pub fn from_center(center: S, length: S) -> Self {
        Interval::new(center - length.halved(), center + length.halved())
    }
    /// Returns the length.
    #[must_use]
    #[inline(always)]
    pub fn length(self) -> S {
        (self.max - self.min).canonical()
    }
    /// Returns the centre.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> S {
        (self.min.halved() + self.max.halved()).canonical()
    }
    /// Returns `true` where the number is in the interval; its bounds belong to it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, x: S) -> S::Mask {
        self.min.at_most(x) & x.at_most(self.max)
    }
    /// Returns the signed distance of two intervals: the gap between them, or minus the shortest translation that
    /// separates them. Ties share the derivative.
    #[must_use]
    #[inline(always)]
    pub fn signed_distance(self, other: Self) -> S {
        let gap = (self.min - other.max).most(other.min - self.max);
        Guard::of(&self).and(&other).result(gap.canonical())
    }
    /// Returns the gap between two intervals; 0 with derivative zero where they touch or overlap.
    #[must_use]
    #[inline(always)]
    pub fn distance(self, other: Self) -> S {
        let gap = self.signed_distance(other);
        let gap = S::select(gap.above(S::zero()), gap, S::zero());
        Guard::of(&self).and(&other).result(gap.canonical())
    }
    /// Returns the signed distance of a number: negative inside. Kink: the centre, which has derivative zero, with
    /// half of each bound's derivative.
    #[must_use]
    #[inline(always)]
    pub fn signed_distance_to(self, x: S) -> S {
        let gap = (self.min - x).most(x - self.max);
        Guard::of(&self).and(&x).result(gap.canonical())
    }
    /// Returns the distance of a number; 0 with derivative zero inside and on the bounds.
    #[must_use]
    #[inline(always)]
    pub fn distance_to(self, x: S) -> S {
        self.distance(Interval::new(x, x))
    }
    /// Returns the length that both share; 0 with derivative zero where they are apart or touch.
    #[must_use]
    #[inline(always)]
    pub fn intersection_length(self, other: Self) -> S {
        let shared = self.max.least(other.max) - self.min.most(other.min);
        let shared = S::select(shared.above(S::zero()), shared, S::zero());
        Guard::of(&self).and(&other).result(shared.canonical())
    }
    /// Returns the intersection over union, in `[0, 1]`; 0 with derivative zero where they are apart, touch, or both
    /// have length zero. Kinks: equal bounds share the derivative, so that identical intervals have derivative zero.
    #[must_use]
    #[inline]
    pub fn iou(self, other: Self) -> S {
        // Relative to one bound and in units of the larger length.
        let (a, b) = (self.max - self.min, other.max - other.min);
        let large = a.primal().most(b.primal());
        let empty = large.at_most(S::Primal::zero());
        let scale = S::from_primal(S::Primal::select(empty, S::Primal::one(), large).binade());
        let (a, b) = (a * scale, b * scale);
        let shared = self.intersection_length(other) * scale;
        let union = a + b - shared;
        let none = union.at_most(S::zero());
        let ratio = shared.over(S::select(none, S::one(), union));
        let ratio = S::select(none, S::zero(), ratio);
        Guard::of(&self).and(&other).result(ratio.canonical())
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Interval<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("[")?;
        self.min.fmt(f)?;
        f.write_str(", ")?;
        self.max.fmt(f)?;
        f.write_str("]")
    }
}

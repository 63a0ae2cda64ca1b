//! Straight features: points, segments, rays and lines.
use super::near::size_of;
use crate::distance::edge::scale_of;
use crate::{Scalar, Vec3};

/// The range of the parameter of a straight feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StraightKind {
    /// From 0 to 0.
    Point,
    /// From 0 to 1.
    Segment,
    /// At 0.
    Ray,
    /// All numbers.
    Line,
}

/// A straight feature: `from + t along`.
#[derive(Clone, Copy, Debug)]
pub struct Straight<S> {
    pub(super) from: Vec3<S>,
    pub(super) along: Vec3<S>,
    pub(super) reach: StraightKind,
}

impl<S: Scalar> Straight<S> {
    /// Returns a point.
    #[inline(always)]
    pub(super) fn point(from: Vec3<S>) -> Self {
        Straight {
            from,
            along: Vec3::zero(),
            reach: StraightKind::Point,
        }
    }
    /// Returns a segment.
    #[inline(always)]
    pub(super) fn segment([from, to]: [Vec3<S>; 2]) -> Self {
        Straight {
            from,
            along: to - from,
            reach: StraightKind::Segment,
        }
    }
    /// Returns an upper bound of the length, as a constant; zero for a line or ray.
    #[inline(always)]
    pub(super) fn extent(&self) -> S::Primal {
        match self.reach {
            StraightKind::Segment => size_of(self.along),
            _ => S::Primal::zero(),
        }
    }
    /// Returns the vector along it: for a segment in the units of both features, else in units of its own size.
    #[inline(always)]
    pub(super) fn way(&self, scale: S) -> Vec3<S> {
        match self.reach {
            StraightKind::Segment => self.along * scale,
            _ => self.along * scale_of::<S>(size_of(self.along)),
        }
    }
    /// Returns the parameter inside the bounds that is nearest to one, and `true` where it is between them.
    #[inline(always)]
    pub(super) fn held(&self, t: S) -> (S, S::Mask) {
        let (zero, one) = (S::zero(), S::one());
        match self.reach {
            StraightKind::Point => (zero, one.below(zero)),
            StraightKind::Segment => (t.clamp(zero, one), zero.below(t) & t.below(one)),
            StraightKind::Ray => (t.most(zero), zero.below(t)),
            StraightKind::Line => (t, zero.below(one)),
        }
    }
}

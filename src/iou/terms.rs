//! Terms of DIoU, CIoU and EIoU of boxes of the plane.
use crate::{Scalar, Vec2};

/// Returns `x / y`, zero with derivative zero where `y` is zero.
#[inline(always)]
pub(crate) fn share<S: Scalar>(x: S, y: S) -> S {
    let none = y.at_most(S::zero());
    S::select(none, S::zero(), x.over(S::select(none, S::one(), y)))
}

/// Returns `x / y` for `x ≤ y`, at most one in spite of rounding; zero with derivative zero where `y` is zero.
#[inline(always)]
pub(crate) fn part<S: Scalar>(x: S, y: S) -> S {
    let part = share(x, y);
    let over = part.above(S::one());
    S::select(over, part.with_primal(S::Primal::one()), part)
}

/// Returns the power of two that brings the longest of some lengths into `[½, 1)`; one where all are zero. Derivatives
/// of ratios of such lengths have no intermediate result much larger than themselves.
#[inline(always)]
pub(crate) fn unit<S: Scalar, const N: usize>(lengths: [S; N]) -> S {
    let mut longest = S::Primal::zero();
    for x in lengths {
        longest = longest.most(x.primal().unsigned());
    }
    let none = longest.at_most(S::Primal::zero());
    let held = S::Primal::select(none, S::Primal::one(), longest);
    let unit = held.binade() * S::Primal::lit(0.25);
    S::from_primal(S::Primal::select(none, S::Primal::one(), unit))
}

/// Returns the larger one; of equal ones the first, with its derivatives.
#[inline(always)]
pub(crate) fn larger<S: Scalar>(x: S, y: S) -> S {
    S::select(x.below(y), y, x)
}

/// Returns the weighted difference of the aspects of boxes whose `v` is known: `v² / (1 − IoU + v)`.
#[inline(always)]
pub(crate) fn weighted<S: Scalar>(v: S, iou: S, fixed: bool) -> S {
    let weight = share(v, (S::one() - iou) + v);
    let weight = if fixed {
        S::from_primal(weight.primal())
    } else {
        weight
    };
    weight * v
}

/// The terms of a pair; lengths are in one unit.
pub(super) struct Terms<S> {
    pub iou: S,
    /// `(d/D)²`, in `[0, 1]`.
    pub way: S,
    /// The sizes of both boxes along their own axes.
    pub sizes: [Vec2<S>; 2],
    /// The divisors of the differences of the sizes.
    pub against: Vec2<S>,
}

impl<S: Scalar> Terms<S> {
    #[inline(always)]
    pub fn diou(&self) -> S {
        (self.iou - self.way).canonical()
    }
    #[inline(always)]
    pub fn ciou(&self, fixed: bool) -> S {
        let angle = |size: Vec2<S>| size.x.atan2(size.y);
        let difference = angle(self.sizes[0]) - angle(self.sizes[1]);
        let v = (difference * S::lit(std::f64::consts::FRAC_2_PI)).squared();
        (self.iou - self.way - weighted(v, self.iou, fixed)).canonical()
    }
    #[inline(always)]
    pub fn eiou(&self) -> S {
        let [a, b] = self.sizes;
        // For a tiny box derivatives are beyond the format.
        let share = |x: S, y: S| {
            let share = share(x, y);
            let constant = S::from_primal(share.primal());
            S::select(y.at_most(S::speck()), constant, share)
        };
        let wide = share(a.x - b.x, self.against.x).squared();
        let high = share(a.y - b.y, self.against.y).squared();
        (self.iou - self.way - (wide + high)).canonical()
    }
}

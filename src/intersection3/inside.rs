//! Ranges of a line of space inside of convex pieces.
use crate::distance::share::{Best, Carry};
use crate::{Scalar, Vec3};

/// A parameter and the normal at it. If several tie, the parameter shares the derivative and the first normal is
/// taken.
#[derive(Clone, Copy, Debug)]
pub struct Border<S> {
    /// The parameter.
    pub t: S,
    /// The normal, of length one or zero.
    pub normal: Vec3<S>,
}

impl<S: Scalar> Carry<S> for Border<S> {
    #[inline(always)]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Border {
            t: self.t.join(other.t, keep, tie),
            normal: Vec3::select(keep | tie, self.normal, other.normal),
        }
    }
    #[inline(always)]
    fn times(self, factor: S) -> Self {
        Border {
            t: self.t * factor,
            normal: self.normal,
        }
    }
}

/// A line with a direction of length one, seen from a shape in units of their extent.
#[derive(Clone, Copy, Debug)]
pub struct Beam<S> {
    /// The point at parameter 0.
    pub from: Vec3<S>,
    /// The direction.
    pub along: Vec3<S>,
}

/// The range of a beam inside a convex piece. It is empty if the beam enters at the largest number and leaves at
/// the smallest.
#[derive(Clone, Copy, Debug)]
pub struct Inside<S> {
    /// The parameter and normal at which it enters.
    pub enter: Best<S, Border<S>>,
    /// The parameter and normal at which it leaves.
    pub exit: Best<S, Border<S>>,
}

/// A direction of length one; zero for none.
#[inline(always)]
fn unit<S: Scalar>(v: Vec3<S>) -> Vec3<S> {
    let square = v.length_squared();
    let none = square.at_most(S::lit(S::EPSILON.powi(4)));
    let length = S::select(none, S::one(), square).root();
    let over = S::one().over(length);
    Vec3::select(none, Vec3::zero(), v * over)
}

/// A vector's part along an axis of length one, and across it.
#[inline(always)]
fn split<S: Scalar>(axis: Vec3<S>, v: Vec3<S>) -> (S, Vec3<S>) {
    (axis.dot(v), axis.cross(v).cross(axis))
}

impl<S: Scalar> Inside<S> {
    #[inline(always)]
    fn new(enter: Border<S>, exit: Border<S>) -> Self {
        Inside {
            enter: Best::of(enter.t, enter),
            exit: Best::of(exit.t, exit),
        }
    }
    /// From one end of the line to the other.
    #[inline(always)]
    pub fn everywhere() -> Self {
        let end = |t: f64| Border {
            t: S::lit(t),
            normal: Vec3::zero(),
        };
        Inside::new(end(-S::LARGEST), end(S::LARGEST))
    }
    /// Nowhere where the mask says so, or where it would leave before it enters.
    #[must_use]
    #[inline(always)]
    pub fn unless(mut self, empty: S::Mask) -> Self {
        let empty = empty | self.exit.value.below(self.enter.value);
        let large = S::lit(S::LARGEST);
        self.enter.value = S::select(empty, large, self.enter.value);
        self.exit.value = S::select(empty, -large, self.exit.value);
        self
    }
    /// `true` for an empty range.
    #[inline(always)]
    pub fn is_empty(&self) -> S::Mask {
        self.exit.value.below(self.enter.value)
    }
    /// The range that both have in common.
    #[must_use]
    #[inline(always)]
    pub fn meet(self, other: Self) -> Self {
        Inside {
            enter: self.enter.most(other.enter),
            exit: self.exit.less(other.exit),
        }
        .unless(self.is_empty() | other.is_empty())
    }
    /// Both pieces of a convex whole.
    #[must_use]
    #[inline(always)]
    pub fn joined(self, other: Self) -> Self {
        Inside {
            enter: self.enter.less(other.enter),
            exit: self.exit.most(other.exit),
        }
    }
    /// Cut by the half-space behind a plane; a plane without a normal cuts nothing.
    #[must_use]
    #[inline(always)]
    pub fn behind(self, beam: Beam<S>, point: Vec3<S>, normal: Vec3<S>) -> Self {
        let ahead = normal.dot(beam.from - point);
        let rate = normal.dot(beam.along);
        let parallel = rate.magnitude().at_most(S::lit(S::EPSILON.powi(2)));
        let t = (-ahead).over(S::select(parallel, S::one(), rate));
        let large = S::lit(S::LARGEST);
        let border = Best::of(t, Border { t, normal });
        let only = |mask: S::Mask, none: S| Best {
            value: S::select(!parallel & mask, t, none),
            ..border
        };
        Inside {
            enter: self.enter.most(only(rate.below(S::zero()), -large)),
            exit: self.exit.less(only(rate.above(S::zero()), large)),
        }
        .unless(self.is_empty() | (parallel & ahead.above(S::zero())))
    }
    /// In a ball; one of radius zero is missed.
    #[inline(always)]
    pub fn ball(beam: Beam<S>, center: Vec3<S>, radius: S) -> Self {
        let arm = beam.from - center;
        let aside = beam.along.cross(arm).length();
        let square = (radius - aside) * (radius + aside);
        let (middle, half) = (-arm.dot(beam.along), square.root());
        let border = |t: S| Border {
            t,
            normal: outwards(arm + beam.along * t, radius),
        };
        let missed = square.below(S::zero()) | radius.at_most(S::zero());
        Inside::new(border(middle - half), border(middle + half)).unless(missed)
    }
    /// In a cylinder without ends, given its axis.
    #[inline(always)]
    pub fn tube(beam: Beam<S>, from: Vec3<S>, axis: Vec3<S>, radius: S) -> Self {
        let ((_, arm), (_, along)) = (split(axis, beam.from - from), split(axis, beam.along));
        let square = along.length_squared();
        let parallel = square.at_most(S::lit(S::EPSILON.powi(4)));
        let square = S::select(parallel, S::one(), square);
        let length = square.root();
        let aside = axis.dot(along.cross(arm)).over(length).magnitude();
        let left = (radius - aside) * (radius + aside);
        let (middle, half) = (-arm.dot(along).over(square), left.root().over(length));
        let large = S::lit(S::LARGEST);
        let border = |t: S, end: S| {
            let normal = outwards(arm + along * t, radius);
            Border {
                t: S::select(parallel, end, t),
                normal: Vec3::select(parallel, Vec3::zero(), normal),
            }
        };
        let within = arm.length().at_most(radius);
        let empty = parallel & !within | !parallel & left.below(S::zero());
        Inside::new(border(middle - half, -large), border(middle + half, large)).unless(empty)
    }
    /// In a cone without a base, given its apex, its axis and its radius at distance one.
    #[inline(always)]
    pub fn nappe(beam: Beam<S>, apex: Vec3<S>, axis: Vec3<S>, slope: S) -> Self {
        let ((z, arm), (rate, along)) = (split(axis, beam.from - apex), split(axis, beam.along));
        let steep = slope * slope;
        let a = along.length_squared() - steep * rate * rate;
        let b = arm.dot(along) - steep * z * rate;
        let c = arm.length_squared() - steep * z * z;
        let turn = axis.dot(arm.cross(along)).magnitude();
        let reach = (along * z - arm * rate).length() * slope;
        let square = (reach - turn) * (reach + turn);
        let zero = S::zero();
        // The root that does not cancel, and the other one by the product of both.
        let sum = -(b + square.root().signed_as(b));
        let (no_sum, parallel) = (
            sum.equals(zero),
            a.magnitude().at_most(S::lit(S::EPSILON.powi(2))),
        );
        let far = sum.over(S::select(parallel, S::one(), a));
        let near = c.over(S::select(no_sum, S::one(), sum));
        let near = S::select(no_sum, far, near);
        let far = S::select(parallel, near, far);
        let first = near.at_most(far);
        let (low, high) = (S::select(first, near, far), S::select(first, far, near));
        let through = a.above(zero) & !parallel;
        let ahead = rate.above(zero);
        let large = S::lit(S::LARGEST);
        // Through one side and the other, or in by a side and out by the base, or the reverse.
        let border = |t: S| {
            let outwards = (arm + along * t) - axis * ((z + rate * t) * steep);
            Border {
                t,
                normal: unit(outwards),
            }
        };
        let (enter, exit) = (
            border(S::select(through | !ahead, low, high)),
            border(S::select(through | ahead, high, low)),
        );
        let end = |t: S| Border {
            t,
            normal: Vec3::zero(),
        };
        let pick = |open: S::Mask, t: S, found: Border<S>| Border {
            t: S::select(open, t, found.t),
            normal: Vec3::select(open, end(t).normal, found.normal),
        };
        let inside = Inside::new(
            pick(!through & !ahead, -large, enter),
            pick(!through & ahead, large, exit),
        );
        let middle = z + rate * (low + (high - low).halved());
        let other = through & (square.below(zero) | middle.below(zero));
        inside.unless(other)
    }
}

/// The normal of a round border; zero where the radius is.
#[inline(always)]
fn outwards<S: Scalar>(arm: Vec3<S>, radius: S) -> Vec3<S> {
    let none = radius.at_most(S::zero());
    let over = S::one().over(S::select(none, S::one(), radius));
    Vec3::select(none, Vec3::zero(), arm * over)
}

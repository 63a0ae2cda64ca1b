//! Ranges of a line of space inside of convex pieces.
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::distance::share::{Best, Carry};
use crate::distance3::near::size_of;
use crate::{Scalar, Vec3};

/// A parameter and the normal at it. If several tie, the parameter shares the derivative and the first normal is
/// taken.
#[derive(Clone, Copy, Debug)]
pub struct Border<S> {
    /// The parameter.
    pub t: S,
    /// The normal, of about unit length or zero.
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

/// A line relative to a shape in units of their extent, its direction in units of the direction's own size.
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

/// Returns the parameters of both points at which a quadratic `a t² − 2 b t + c` vanishes, that of the smaller
/// magnitude first, given `b² − a c`, with `a` not zero. The root that would cancel follows from the product of both:
/// it is exactly zero where `c` is, and depends on `a` only by the discriminant.
#[inline(always)]
pub(super) fn roots<S: Scalar>(a: S, b: S, c: S, square: S) -> (S, S) {
    let (negative, root) = (b.below(S::zero()), square.root());
    let (sum, rest) = (b + root, b - root);
    let (sum, rest) = (
        S::select(negative, rest, sum),
        S::select(negative, sum, rest),
    );
    let far = sum.over(a);
    // Nothing cancels where both vanish, and a quotient by their sum would have slopes beyond all bounds. A line that
    // misses within rounding has a quotient beyond the other root, which is mostly rounding.
    let beyond = (a * c).above(sum * sum);
    let none = sum.magnitude().at_most(S::rounding(1.0, 2)) | square.below(S::zero()) | beyond;
    let (over, under) = (S::select(none, rest, c), S::select(none, a, sum));
    (over.over(under), far)
}

/// Returns both numbers, the lower one first.
#[inline(always)]
pub(super) fn sorted<S: Scalar>((one, other): (S, S)) -> (S, S) {
    let is_first = one.at_most(other);
    (
        S::select(is_first, one, other),
        S::select(is_first, other, one),
    )
}

/// Returns `b² − a c` of a quadratic. If `a c` is not positive nothing cancels; otherwise it is `square`, a form
/// without squares of squares.
#[inline(always)]
pub(super) fn discriminant<S: Scalar>(a: S, b: S, c: S, square: S) -> S {
    let product = a * c;
    S::select(product.at_most(S::zero()), b * b - product, square)
}

/// Returns a vector in units of its own size.
#[inline(always)]
pub(super) fn sized<S: Scalar>(v: Vec3<S>) -> Vec3<S> {
    v * scale_of::<S>(size_of(v))
}

/// The parameters at which a line is in a cylinder without ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tube<S: Scalar> {
    pub low: S,
    pub high: S,
    /// `true` for a line along the axis, without parameters.
    pub is_parallel: S::Mask,
    pub is_missed: S::Mask,
}

impl<S: Scalar> Tube<S> {
    /// Creates the tube from products of the line's point p and direction u across the axis and one length: `a = u·u`,
    /// `b = u·p`, `c = p·p − r²`, and `square = r² a − (u × p)²`. Directions with `a` up to `none` are parallel to the
    /// axis.
    #[inline(always)]
    pub fn new(a: S, b: S, c: S, square: S, none: S) -> Self {
        let is_parallel = a.at_most(none);
        let square = discriminant(a, b, c, square);
        let (low, high) = sorted(roots(S::select(is_parallel, S::one(), a), -b, c, square));
        let zero = S::zero();
        Tube {
            low,
            high,
            is_parallel,
            is_missed: is_parallel & c.above(zero) | !is_parallel & square.below(zero),
        }
    }
    /// Creates the tube around an axis, given in units of its own size.
    #[inline(always)]
    pub fn about(beam: Beam<S>, from: Vec3<S>, axis: Vec3<S>, radius: S) -> Self {
        let arm = beam.from - from;
        let (u, v, square) = (
            beam.along.cross(axis),
            arm.cross(axis),
            axis.length_squared(),
        );
        let turn = axis.dot(beam.along.cross(arm));
        let (a, most) = (u.length_squared(), radius * radius);
        let left = square * (a * most - turn * turn);
        let c = v.length_squared() - square * most;
        // Across the axis a direction has some roundings.
        Tube::new(a, u.dot(v), c, left, S::rounding(8.0, 2))
    }
}

impl<S: Scalar> Inside<S> {
    /// Returns the range from one border to the other.
    #[inline(always)]
    pub(super) fn new(enter: Border<S>, exit: Border<S>) -> Self {
        Inside {
            enter: Best::of(enter.t, enter),
            exit: Best::of(exit.t, exit),
        }
    }
    /// Returns the range of the whole line.
    #[inline(always)]
    pub fn everywhere() -> Self {
        let end = |t: f64| Border {
            t: S::lit(t),
            normal: Vec3::zero(),
        };
        Inside::new(end(-S::format().largest()), end(S::format().largest()))
    }
    /// Returns an empty range where the mask is true or where the line would leave before it enters.
    #[must_use]
    #[inline(always)]
    pub fn unless(mut self, empty: S::Mask) -> Self {
        let empty = empty | self.exit.value.below(self.enter.value);
        let large = S::largest();
        self.enter.value = S::select(empty, large, self.enter.value);
        self.exit.value = S::select(empty, -large, self.exit.value);
        self
    }
    /// Returns `true` for an empty range.
    #[inline(always)]
    pub fn is_empty(&self) -> S::Mask {
        self.exit.value.below(self.enter.value)
    }
    /// Returns the range that both have in common.
    #[must_use]
    #[inline(always)]
    pub fn meet(self, other: Self) -> Self {
        Inside {
            enter: self.enter.most(other.enter),
            exit: self.exit.less(other.exit),
        }
        .unless(self.is_empty() | other.is_empty())
    }
    /// Returns the part of the range behind a plane; a plane without a normal cuts nothing.
    #[must_use]
    #[inline(always)]
    pub fn behind(self, beam: Beam<S>, point: Vec3<S>, normal: Vec3<S>) -> Self {
        let ahead = normal.dot(beam.from - point);
        let rate = normal.dot(beam.along);
        let parallel = rate.magnitude().at_most(S::rounding(1.0, 2));
        let t = (-ahead).over(S::select(parallel, S::one(), rate));
        let large = S::largest();
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
    /// Returns the range inside a ball; one of radius zero is a point.
    #[inline(always)]
    pub fn ball(beam: Beam<S>, center: Vec3<S>, radius: S) -> Self {
        let arm = beam.from - center;
        let (a, most) = (beam.along.length_squared(), radius * radius);
        let square = a * most - beam.along.cross(arm).length_squared();
        let (b, c) = (-arm.dot(beam.along), arm.length_squared() - most);
        let square = discriminant(a, b, c, square);
        let none = a.at_most(S::zero());
        let (low, high) = sorted(roots(S::select(none, S::one(), a), b, c, square));
        let border = |t: S| Border {
            t,
            normal: outwards(arm + beam.along * t, radius),
        };
        Inside::new(border(low), border(high)).unless(square.below(S::zero()))
    }
    /// Returns the range inside a cylinder without ends. `across` returns the component across the axis of the line's
    /// point at a parameter, times any factor.
    #[inline(always)]
    pub(super) fn of_tube(tube: Tube<S>, across: impl Fn(S) -> Vec3<S>, radius: S) -> Self {
        let border = |t: S, end: S| Border {
            t: S::select(tube.is_parallel, end, t),
            normal: Vec3::select(tube.is_parallel, Vec3::zero(), outwards(across(t), radius)),
        };
        let large = S::largest();
        Inside::new(border(tube.low, -large), border(tube.high, large)).unless(tube.is_missed)
    }
    /// Returns the range inside a cylinder without ends, given its axis in units of its own size.
    #[inline(always)]
    pub fn tube(beam: Beam<S>, from: Vec3<S>, axis: Vec3<S>, radius: S) -> Self {
        let arm = beam.from - from;
        let across = |t: S| axis.cross(arm + beam.along * t).cross(axis);
        Inside::of_tube(Tube::about(beam, from, axis, radius), across, radius)
    }
    /// Returns the range inside a capsule, given its ends relative to the beam's anchor.
    #[inline(always)]
    pub fn capsule(beam: Beam<S>, from: Vec3<S>, to: Vec3<S>, radius: S) -> Self {
        let axis = sized(to - from);
        let base = axis.dot(beam.from - from);
        Inside::tube(beam, from, axis, radius).rounded(
            [from, to].each_as(|end| Inside::ball(beam, end, radius)),
            [base, axis.dot(beam.along), axis.dot(to - from)],
        )
    }
    /// Returns the range inside a capsule from the range inside the cylinder around it and those inside the balls at
    /// its ends. The numbers are heights along its axis: of the line's point, its rate along the line, and of the end.
    ///
    /// The height of the point where the line enters the cylinder decides which of the three parts the line enters: at
    /// a seam both have one normal.
    #[inline(always)]
    pub(super) fn rounded(self, [start, end]: [Self; 2], [base, rate, top]: [S; 3]) -> Self {
        let zero = S::zero();
        let pick = |t: S, [low, side, high]: [Best<S, Border<S>>; 3]| {
            let endless = t.magnitude().at_least(S::largest());
            let height = base + rate * S::select(endless, zero, t);
            let ahead = rate.above(zero) & t.above(zero) | rate.below(zero) & t.below(zero);
            let below = endless & !ahead | !endless & height.below(zero);
            let above = endless & ahead | !endless & height.above(top);
            choose(below, low, choose(above, high, side))
        };
        Inside {
            enter: pick(self.enter.value, [start.enter, self.enter, end.enter]),
            exit: pick(self.exit.value, [start.exit, self.exit, end.exit]),
        }
        .unless(self.is_empty())
    }
    /// Returns both pieces of a convex whole.
    #[must_use]
    #[inline(always)]
    pub fn joined(self, other: Self) -> Self {
        Inside {
            enter: self.enter.less(other.enter),
            exit: self.exit.most(other.exit),
        }
    }
}

/// Returns `yes` where the mask is true, else `no`.
#[inline(always)]
pub(super) fn choose<S: Scalar>(
    mask: S::Mask,
    yes: Best<S, Border<S>>,
    no: Best<S, Border<S>>,
) -> Best<S, Border<S>> {
    let pick = |yes: S, no: S| S::select(mask, yes, no);
    Best {
        value: pick(yes.value, no.value),
        sum: Border {
            t: pick(yes.sum.t, no.sum.t),
            normal: Vec3::select(mask, yes.sum.normal, no.sum.normal),
        },
        count: pick(yes.count, no.count),
    }
}

/// Returns the normal of a round border; zero where the radius is.
#[inline(always)]
pub(super) fn outwards<S: Scalar>(arm: Vec3<S>, radius: S) -> Vec3<S> {
    let none = radius.at_most(S::zero());
    let over = S::one().over(S::select(none, S::one(), radius));
    Vec3::select(none, Vec3::zero(), arm * over)
}

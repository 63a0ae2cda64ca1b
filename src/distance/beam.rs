//! The range of a line inside convex pieces: discs, strips, polygons.
use super::edge::unit;
use super::share::{Best, Carry};
use crate::{Scalar, Vec2};

/// A parameter and the normal at it. If several tie, the parameter shares the derivative and the first normal is
/// taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Border<S> {
    pub t: S,
    pub normal: Vec2<S>,
}

impl<S: Scalar> Carry<S> for Border<S> {
    #[inline(always)]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Border {
            t: self.t.join(other.t, keep, tie),
            normal: Vec2::select(keep | tie, self.normal, other.normal),
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

/// A line with a direction of length one, relative to the shape's anchor in units of its extent.
#[derive(Clone, Copy, Debug)]
pub struct Beam<S> {
    pub(crate) from: Vec2<S>,
    pub(crate) along: Vec2<S>,
}

/// The range of a beam inside a convex piece: where it enters and where it leaves. It is empty if the beam enters
/// at the largest number and leaves at the smallest.
#[derive(Clone, Copy, Debug)]
pub struct Inside<S> {
    pub(crate) enter: Best<S, Border<S>>,
    pub(crate) exit: Best<S, Border<S>>,
}

impl<S: Scalar> Inside<S> {
    #[inline(always)]
    fn new(enter: Border<S>, exit: Border<S>) -> Self {
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
            normal: Vec2::zero(),
        };
        Inside::new(end(-S::format().largest()), end(S::format().largest()))
    }
    /// Returns an empty range where the mask is true or where the line would leave before it enters.
    #[inline(always)]
    fn unless(mut self, empty: S::Mask) -> Self {
        let empty = empty | self.exit.value.below(self.enter.value);
        let large = S::largest();
        self.enter.value = S::select(empty, large, self.enter.value);
        self.exit.value = S::select(empty, -large, self.exit.value);
        self
    }
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> S::Mask {
        self.exit.value.below(self.enter.value)
    }
    /// Returns the part of the range behind a face; a face without a normal cuts nothing.
    #[inline(always)]
    pub fn behind(self, beam: Beam<S>, point: Vec2<S>, normal: Vec2<S>) -> Self {
        let ahead = normal.dot(beam.from - point);
        let rate = normal.dot(beam.along);
        let parallel = rate.magnitude().at_most(S::rounding(1.0, 2));
        let safe = S::select(parallel, S::one(), rate);
        let t = (-ahead).over(safe);
        let large = S::largest();
        let enters = !parallel & rate.below(S::zero());
        let leaves = !parallel & S::zero().below(rate);
        let border = Border { t, normal };
        let mut enter = Best::of(t, border);
        enter.value = S::select(enters, t, -large);
        let mut exit = Best::of(t, border);
        exit.value = S::select(leaves, t, large);
        Inside {
            enter: self.enter.most(enter),
            exit: self.exit.less(exit),
        }
        .unless(self.is_empty() | (parallel & ahead.above(S::zero())))
    }
    /// Returns both pieces of a convex whole.
    #[inline(always)]
    pub fn joined(self, other: Self) -> Self {
        Inside {
            enter: self.enter.less(other.enter),
            exit: self.exit.most(other.exit),
        }
    }
    /// Returns the range inside a disc.
    #[inline(always)]
    pub fn disc(beam: Beam<S>, center: Vec2<S>, radius: S) -> Self {
        let arm = beam.from - center;
        let aside = beam.along.perp_dot(arm);
        let square = (radius - aside) * (radius + aside);
        let (middle, half) = (-arm.dot(beam.along), square.root());
        let point = radius.at_most(S::zero());
        let safe = S::select(point, S::one(), radius);
        let border = |t: S| {
            let out = arm + beam.along * t;
            let normal = Vec2::new(out.x.over(safe), out.y.over(safe));
            Border {
                t,
                normal: Vec2::select(point, Vec2::zero(), normal),
            }
        };
        Inside::new(border(middle - half), border(middle + half)).unless(square.below(S::zero()))
    }
    /// Returns the range inside the rectangle over an edge that extends `radius` to both sides. The edge may lack its
    /// start or its end.
    ///
    /// With a radius the ends are drawn in by some roundings. A disc around an end covers the part that is lost, so
    /// that the range ends at its border and not at the strip's end where both meet the side.
    #[inline(always)]
    pub fn strip(
        beam: Beam<S>,
        from: Vec2<S>,
        along: Vec2<S>,
        radius: S,
        starts: bool,
        ends: bool,
    ) -> Self {
        let ahead = unit(along);
        let normal = ahead.perp();
        let none = ahead.x.equals(S::zero()) & ahead.y.equals(S::zero());
        let mut inside = Inside::everywhere()
            .behind(beam, from + normal * radius, normal)
            .behind(beam, from - normal * radius, -normal);
        // A disc falls behind the side by the square of this over twice the radius: less than a rounding.
        let few = S::Primal::rounding(64.0, 1);
        let drawn = radius.primal() * S::Primal::lit(1.0 / 32.0);
        let drawn = ahead.constant() * S::from_primal(drawn.least(few));
        if starts {
            inside = inside.behind(beam, from + drawn, -ahead);
        }
        if ends {
            inside = inside.behind(beam, from + along - drawn, ahead);
        }
        inside.unless(none)
    }
    /// Returns the range inside a convex polygon, counter-clockwise; empty where the polygon is flat to rounding.
    #[inline(always)]
    pub fn polygon(beam: Beam<S>, corners: &[Vec2<S>]) -> Self {
        let n = corners.len();
        let mut inside = Inside::everywhere();
        for i in 0..n {
            let along = corners[(i + 1) % n] - corners[i];
            let normal = -unit(along.perp());
            inside = inside.behind(beam, corners[i], normal);
        }
        // The faces of a flat polygon do not bound it.
        let (mut twice, mut reach) = (S::zero(), S::zero());
        for i in 1..n {
            let way = corners[i] - corners[0];
            reach += way.length_squared();
            twice += way.perp_dot(corners[(i + 1) % n] - corners[0]);
        }
        inside.unless(twice.at_most(reach * S::rounding(4.0, 1)))
    }
    /// Returns the range inside a hull of corners, inflated by a radius, from the range inside the hull.
    #[inline(always)]
    pub fn round(self, beam: Beam<S>, corners: &[Vec2<S>], radius: S) -> Self {
        let n = corners.len();
        let mut inside = self;
        for i in 0..n {
            let along = corners[(i + 1) % n] - corners[i];
            if n > 2 {
                let strip = Inside::strip(beam, corners[i], along, radius, true, true);
                inside = inside.joined(strip);
            }
            inside = inside.joined(Inside::disc(beam, corners[i], radius));
        }
        inside
    }
}

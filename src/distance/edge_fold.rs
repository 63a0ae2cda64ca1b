//! The state of a point after some edges of a path.
use super::edge::{edge_sides, edge_winding};
use crate::{Scalar, Vec2};

/// The winding numbers of a ring that count as inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fill {
    /// Points with a winding number other than zero: loops add up.
    #[default]
    NonZero,
    /// Points with an odd winding number: every crossing changes sides.
    EvenOdd,
}

/// The state of a point after some edges.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
pub struct EdgeFold<S> {
    /// The distance of the nearest edge so far, with the derivative of the edges that tie.
    pub distance: S,
    /// The sum of the distances of the edges that tie.
    sum: S,
    /// The number of nearest edges.
    count: S,
    /// The distance to the left of an edge that the point is exactly on: the value zero with derivatives. It counts
    /// here if the winding number on that side is the point's own.
    left: S,
    /// The distance to the right, if the winding number on that side is the point's own.
    right: S,
    /// The winding number so far.
    pub winding: S,
}

impl<S> EdgeFold<S> {
    /// The index of the winding number among its numbers.
    pub(crate) const WINDING: usize = 5;
}

impl<S: Scalar> EdgeFold<S> {
    /// Creates the fold of no edges: the largest finite distance, winding number 0.
    #[inline(always)]
    pub fn empty() -> Self {
        EdgeFold {
            distance: S::largest(),
            sum: S::zero(),
            count: S::zero(),
            left: S::zero(),
            right: S::zero(),
            winding: S::zero(),
        }
    }
    /// Creates the fold of one edge for a point.
    #[inline(always)]
    pub fn of_edge(point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> Self {
        let (distance, side) = edge_sides(point, from, to);
        // A point at the height of a level edge, or of an end, counts as just above it.
        let upwards = from.y.below(to.y) | (from.y.equals(to.y) & to.x.below(from.x));
        EdgeFold {
            distance,
            sum: distance,
            count: S::one(),
            left: S::select(upwards, S::zero(), side),
            right: S::select(upwards, side, S::zero()),
            winding: edge_winding(point, from, to),
        }
    }
    /// Creates the fold of a distance to the nearest edge and the winding number of all edges.
    #[inline(always)]
    pub(super) fn nearest(distance: S, winding: S) -> Self {
        EdgeFold {
            distance,
            sum: distance,
            count: S::one(),
            left: S::zero(),
            right: S::zero(),
            winding,
        }
    }
    /// Adds the distance of another edge that ties with the nearest one, although rounding may order them.
    #[inline(always)]
    pub(super) fn and_also(mut self, distance: S) -> Self {
        self.sum += distance;
        self.count += S::one();
        self
    }
    /// Returns both sets of edges together: the nearer one, the sum of the winding numbers.
    #[must_use]
    #[inline(always)]
    pub fn join(self, other: Self) -> Self {
        let nearer = self.distance.below(other.distance);
        let tie = self.distance.equals(other.distance);
        let pick = |a: S, b: S| S::select(nearer, a, b);
        let both = |a: S, b: S| S::select(tie, a + b, pick(a, b));
        EdgeFold {
            distance: pick(self.distance, other.distance),
            sum: both(self.sum, other.sum),
            count: both(self.count, other.count),
            left: both(self.left, other.left),
            right: both(self.right, other.right),
            winding: self.winding + other.winding,
        }
    }
    /// Adds one more edge.
    #[must_use]
    #[inline(always)]
    pub fn with_edge(self, point: Vec2<S>, from: Vec2<S>, to: Vec2<S>) -> Self {
        self.join(Self::of_edge(point, from, to))
    }
    /// Returns the distance of the nearest edge; the largest finite number without edges. Edges that tie share
    /// the derivative equally.
    #[must_use]
    #[inline(always)]
    pub fn distance(self) -> S {
        // With the bits of the distance itself: a third of three thirds need not be one.
        let none = self.count.equals(S::zero());
        let mean = self.sum.over(S::select(none, S::one(), self.count));
        mean.with_primal(self.distance.primal()).canonical()
    }
    /// Returns `true` where the point is inside: by the rule, a winding number that is not zero, or that is odd.
    #[must_use]
    #[inline(always)]
    pub fn inside(self, fill: Fill) -> S::Mask {
        fills(self.winding, fill)
    }
    /// Returns the distance of the border, negative inside. Exactly on an edge, across which it is smooth, the
    /// derivative is that of the outward normal; where several edges meet it is zero.
    #[must_use]
    #[inline(always)]
    pub fn signed_distance(self, fill: Fill) -> S {
        let distance = self.distance();
        let inside = self.inside(fill);
        let off = S::select(inside, -distance, distance);
        // Crossing an edge from its right to its left adds one to the winding number.
        let beyond = |by: S| fills(self.winding + by, fill);
        let outward = |to_left: S, left: S::Mask, right: S::Mask| {
            let of_left = S::select(left & !right, -to_left, S::zero());
            S::select(right & !left, to_left, of_left)
        };
        let normal = outward(self.left, inside, beyond(-S::one()))
            + outward(self.right, beyond(S::one()), inside);
        // Between two edges the winding number on either side of one depends on the other.
        let alone = self.count.equals(S::one());
        let normal = S::select(alone, normal, S::zero());
        let border = self.distance.equals(S::zero());
        let on = normal.with_primal(S::Primal::zero());
        S::select(border, on, off).canonical()
    }
}

/// Returns `true` where a rule puts a winding number inside.
#[inline(always)]
fn fills<S: Scalar>(winding: S, fill: Fill) -> S::Mask {
    match fill {
        Fill::NonZero => !winding.equals(S::zero()),
        Fill::EvenOdd => !is_even(winding),
    }
}

/// Returns `true` where a whole number is even.
#[inline(always)]
fn is_even<S: Scalar>(whole: S) -> S::Mask {
    // Adding and taking away 1.5 / ε rounds to a whole number.
    let shift = S::lit(1.5 / S::format().epsilon());
    let half = whole.halved();
    ((half + shift) - shift).equals(half)
}

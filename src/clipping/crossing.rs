//! Crossings of two edges.
use crate::reference::Reference;
use crate::{Scalar, Vec2};

/// A crossing in local coordinates: its fraction along either edge, and the numbers that the derivatives need.
pub(crate) struct Crossing<S> {
    pub seen: Reference<S>,
    /// From start to end of the first edge.
    pub along_a: Vec2<S>,
    /// From start to end of the second edge.
    pub along_b: Vec2<S>,
    /// The fraction of the first edge, in `[0, 1]`.
    pub at_a: S,
    /// The fraction of the second edge (any number where that stands for a line).
    pub at_b: S,
    /// `along_a × along_b`, one where that is zero.
    pub cross: S,
}

/// Returns the crossing of two edges that are known to cross; the middle of the first one if rounding leaves them
/// parallel.
#[inline]
pub(crate) fn meet<S: Scalar>(a: [Vec2<S>; 2], b: [Vec2<S>; 2]) -> Crossing<S> {
    let seen = Reference::of_ring(&[a[0], a[1], b[0], b[1]]);
    let ([p, q], [r, s]) = (a.map(|v| seen.place(v)), b.map(|v| seen.place(v)));
    let (along_a, along_b, between) = (q - p, s - r, r - p);
    let cross = along_a.perp_dot(along_b);
    let parallel = cross.equals(S::zero());
    let cross = S::select(parallel, S::one(), cross);
    let fraction = |x: S| S::select(parallel, S::lit(0.5), x.over(cross));
    let at_a = fraction(between.perp_dot(along_b));
    let at_b = fraction(between.perp_dot(along_a));
    // Rounding must not carry it beyond either end.
    let inside = at_a.primal().clamp(S::Primal::zero(), S::Primal::one());
    let outside = at_a.below(S::zero()) | at_a.above(S::one());
    let at_a = S::select(outside, at_a.with_primal(inside), at_a);
    Crossing {
        seen,
        along_a,
        along_b,
        at_a,
        at_b,
        cross,
    }
}

/// Returns the crossing of two edges that are known to cross.
#[inline]
pub(crate) fn crossing<S: Scalar>(a: [Vec2<S>; 2], b: [Vec2<S>; 2]) -> Vec2<S> {
    let met = meet(a, b);
    let start = met.seen.place(a[0]);
    met.seen
        .outer_place(start + met.along_a * met.at_a)
        .canonical()
}

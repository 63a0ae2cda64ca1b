//! Triangles from one point over the edges of two rings: the intersection of every two of them.
use super::quad::TINY;
use crate::reference::Reference;
use crate::{Mask, Scalar, Vec2};

/// An edge of a ring against an edge of a polygon, relative to a common point and both turned so that they run
/// counter-clockwise around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wedge<S: Scalar> {
    /// `true` where the triangles share any direction.
    pub shared: S::Mask,
    /// `true` where the first edge ran clockwise.
    pub turned_f: S::Mask,
    /// `true` where the second edge ran clockwise.
    pub turned_g: S::Mask,
    /// The directions' first ray goes through the start of `g` (else of `f`).
    pub first_g: S::Mask,
    /// Their last ray goes through the end of `g` (else of `f`).
    pub last_g: S::Mask,
    /// The fraction of an edge at which the first ray meets it: of `f` if the ray goes through the start of `g`.
    pub skip: S,
    /// The fraction of an edge from its end at which the last ray meets it.
    pub rest: S,
    /// Distances of f and g along the first ray, in a common unit, and their difference.
    pub first: [S; 3],
    /// Distances of f and g along the last ray, in a common unit, and their difference.
    pub last: [S; 3],
    /// Twice the areas of both triangles, not negative.
    pub twice: [S; 2],
}

/// Relates the triangles over `f` and `g`. `cross` is `g × f` of start and start, start of g and end of f, end of g and
/// start of f, end and end. `beyond` has the distances of both ends of f to the left of g, and of both ends of g to the
/// left of f. Returns `None` if they share no direction in any lane.
#[inline(always)]
fn wedge<S: Scalar>(
    twice: [S; 2],
    cross: [S; 4],
    beyond: impl FnOnce() -> ([S; 2], [S; 2]),
) -> Option<Wedge<S>> {
    let zero = S::zero();
    let (turned_f, turned_g) = (twice[0].below(zero), twice[1].below(zero));
    let swap = |mask, x: [S; 2]| [S::select(mask, x[1], x[0]), S::select(mask, x[0], x[1])];
    let sign = |mask, x: [S; 2]| [S::select(mask, -x[0], x[0]), S::select(mask, -x[1], x[1])];
    let [p00, p01] = swap(turned_f, [cross[0], cross[1]]);
    let [p10, p11] = swap(turned_f, [cross[2], cross[3]]);
    let [p00, p10] = swap(turned_g, [p00, p10]);
    let [p01, p11] = swap(turned_g, [p01, p11]);
    let twice = [twice[0].unsigned(), twice[1].unsigned()];

    let (first_g, last_g) = (p00.below(zero), p11.above(zero));
    // Each triangle spans less than a half turn: they share directions where the start of one is
    // within the other.
    let shared = (first_g & p01.above(zero)) | (!first_g & p10.below(zero));
    if !shared.any() {
        return None;
    }
    let (beyond_g, beyond_f) = beyond();
    let beyond_g = sign(turned_g, swap(turned_f, beyond_g));
    let beyond_f = sign(turned_f, swap(turned_g, beyond_f));
    // Positive wherever a direction is shared; rounding may leave nothing.
    let first_unit = S::select(first_g, p01 - p00, p00 - p10);
    let last_unit = S::select(last_g, p11 - p10, p01 - p11);
    let shared = shared & first_unit.above(zero) & last_unit.above(zero);
    let (first_unit, last_unit) = (
        S::select(shared, first_unit, S::one()),
        S::select(shared, last_unit, S::one()),
    );
    Some(Wedge {
        shared,
        turned_f,
        turned_g,
        first_g,
        last_g,
        skip: S::select(first_g, -p00, p00).over(first_unit),
        rest: S::select(last_g, p11, -p11).over(last_unit),
        first: [
            S::select(first_g, twice[0], first_unit),
            S::select(first_g, first_unit, twice[1]),
            S::select(first_g, beyond_f[0], -beyond_g[0]),
        ],
        last: [
            S::select(last_g, twice[0], last_unit),
            S::select(last_g, last_unit, twice[1]),
            S::select(last_g, beyond_f[1], -beyond_g[1]),
        ],
        twice,
    })
}

/// Returns the triangle over an edge `f` against that over an edge `g`, given twice the area of both.
#[inline(always)]
pub(crate) fn between<S: Scalar>(
    f: [Vec2<S>; 2],
    g: [Vec2<S>; 2],
    twice: [S; 2],
) -> Option<Wedge<S>> {
    wedge(
        twice,
        [
            g[0].perp_dot(f[0]),
            g[0].perp_dot(f[1]),
            g[1].perp_dot(f[0]),
            g[1].perp_dot(f[1]),
        ],
        #[inline(always)]
        || {
            let (along_f, along_g) = (f[1] - f[0], g[1] - g[0]);
            (
                [along_g.perp_dot(f[0] - g[0]), along_g.perp_dot(f[1] - g[0])],
                [along_f.perp_dot(g[0] - f[0]), along_f.perp_dot(g[1] - f[0])],
            )
        },
    )
}

/// Returns twice the area that both triangles share, with the sign of their orientations; `of_g` is true where the
/// second edge belongs to the smaller polygon.
///
/// It is found as a part of the smaller polygon's triangle: of one that is R times as long the part is R² times smaller,
/// and what is left of one.
#[inline(always)]
pub(crate) fn shared_twice<S: Scalar>(pair: &Wedge<S>, of_g: S::Mask) -> S {
    let (zero, one) = (S::zero(), S::one());
    // For g both are exchanged. A triangle whose reciprocal may be infinite cannot be the divisor.
    let of_g = of_g & pair.twice[1].above(S::lit(TINY * S::format().empty()));
    let choose = |by_g: S, by_f: S| S::select(of_g, by_g, by_f);
    let skips = of_g & !pair.first_g | !of_g & pair.first_g;
    let rests = of_g & !pair.last_g | !of_g & pair.last_g;
    let span = one - S::select(skips, pair.skip, zero) - S::select(rests, pair.rest, zero);
    let turned = |[f, g, more]: [S; 3]| [choose(g, f), choose(f, g), choose(-more, more)];
    let ([a, b, alpha], [far_a, far_b, beta]) = (turned(pair.first), turned(pair.last));
    let excess = |at: S, by: S, other: S| {
        // On the other's border it counts if it comes from beyond or leads there.
        let beyond = (by.above(zero) | (by.equals(zero) & other.above(zero))) & at.above(zero);
        let share = S::select(beyond, by, zero).over(S::select(beyond, at, one));
        // Rounding apart it is at most one.
        S::select(share.above(one), one, share)
    };
    let (x, y) = (excess(a, alpha, beta), excess(far_a, beta, alpha));
    let (nearer, nearer_last) = (alpha.below(zero), beta.below(zero));
    let crossing = (nearer & beta.above(zero)) | (nearer_last & alpha.above(zero));
    let cut = S::select(nearer, b * y * y, far_b * x * x);
    let by = S::select(nearer, a * y - alpha, far_a * x - beta);
    let crossed = one - cut.over(S::select(crossing, by, one));
    let whole = (one - x) * (one - y);
    let tie = alpha.equals(zero) & beta.equals(zero) & a.above(zero) & far_a.above(zero);
    let halves = alpha.over(S::select(tie, a, one)) + beta.over(S::select(tie, far_a, one));
    let tied = one - halves.halved();
    let share = S::select(tie, tied, S::select(crossing, crossed, whole));
    let area = choose(pair.twice[1], pair.twice[0]) * span * share;
    let area = S::select(pair.shared, area, zero);
    S::select(mixed::<S>(pair), -area, area)
}

/// Returns `true` where the two triangles are of opposite orientation.
#[inline(always)]
pub(crate) fn mixed<S: Scalar>(pair: &Wedge<S>) -> S::Mask {
    (pair.turned_f & !pair.turned_g) | (pair.turned_g & !pair.turned_f)
}

/// A convex (or any) polygon in local coordinates, with the triangles over its edges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fan<S, const M: usize> {
    /// The vertices.
    pub at: [Vec2<S>; M],
    /// Twice the area of the triangle over each edge.
    pub twice: [S; M],
    /// The number of vertices.
    pub count: usize,
}

impl<S: Scalar, const M: usize> Fan<S, M> {
    /// Creates the wedges of the first `count` of some vertices.
    #[inline(always)]
    pub fn new(polygon: &[Vec2<S>; M], count: usize, seen: &Reference<S>) -> Self {
        let mut fan = Fan {
            at: [Vec2::zero(); M],
            twice: [S::zero(); M],
            count: count.min(M),
        };
        let mut k = 0;
        while k < fan.count {
            fan.at[k] = seen.place(polygon[k]);
            k += 1;
        }
        k = 0;
        while k < fan.count {
            fan.twice[k] = fan.at[k].perp_dot(fan.at[fan.after(k)]);
            k += 1;
        }
        fan
    }
    /// Returns the vertex after vertex `k`.
    #[inline(always)]
    pub fn after(&self, k: usize) -> usize {
        if k + 1 < self.count { k + 1 } else { 0 }
    }
    /// Returns the edge from vertex `k`.
    #[inline(always)]
    pub fn edge(&self, k: usize) -> [Vec2<S>; 2] {
        [self.at[k], self.at[self.after(k)]]
    }
    /// Returns the area.
    #[inline(always)]
    pub fn area(&self) -> S {
        let mut sum = S::zero();
        let mut k = 0;
        while k < self.count {
            sum += self.twice[k];
            k += 1;
        }
        sum.halved()
    }
    /// Returns the triangle over an edge `f` of a ring against that over edge `k`.
    #[inline(always)]
    pub fn wedge(&self, f: [Vec2<S>; 2], k: usize) -> Option<Wedge<S>> {
        between(f, self.edge(k), [f[0].perp_dot(f[1]), self.twice[k]])
    }
    /// Returns the contribution of an edge of a ring to twice the area that the ring shares with this polygon, which
    /// may be the smaller one.
    #[inline(always)]
    pub fn shared_with(&self, edge: [Vec2<S>; 2], smaller: S::Mask) -> S {
        let mut sum = S::zero();
        let mut k = 0;
        while k < self.count {
            if let Some(pair) = self.wedge(edge, k) {
                sum += shared_twice(&pair, smaller);
            }
            k += 1;
        }
        sum
    }
    /// Returns `true` where one of the edges has all of the other polygon on its right or on itself, both being convex:
    /// they are apart or merely touch.
    #[inline(always)]
    pub fn separates<const N: usize>(&self, other: &Fan<S, N>) -> S::Mask {
        let zero = S::zero();
        let mut any = S::one().below(zero);
        let mut k = 0;
        while k < self.count {
            let [start, end] = self.edge(k);
            let along = end - start;
            let mut all = !(along.x.equals(zero) & along.y.equals(zero));
            let mut i = 0;
            while i < other.count {
                all = all & along.perp_dot(other.at[i] - start).at_most(zero);
                i += 1;
            }
            any = any | all;
            k += 1;
        }
        any
    }
}

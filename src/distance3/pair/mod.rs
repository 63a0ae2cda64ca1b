//! Two boxes of any orientation, in the frame of the first.
//!
//! All that chooses between features is computed with plain numbers; the distance is then computed once, with
//! derivatives, from the features that were chosen. Nine of the 144 pairs of edges can be nearest: those that support
//! both boxes along their common normal.
//!
//! The axes of b along a's axes are a matrix; every sign is taken from its numbers. They decide alike wherever they
//! occur, so that no rounding leaves out the end of a common stretch in favour of neither.
mod decide;
mod face;
mod features;
mod seen;

use super::core::{BoxCore, Core3};
use super::relation::{Relation, direction};
use super::spot::vanish;
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::scalar::most_of;
use crate::{Scalar, Vec3};
use decide::{Choice, decide};
use seen::{Gaps, RelativeBox, column, dot, gaps_primal, least_square, sign_or_none};

/// Returns constants of a scalar type with derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
fn fixed<S: Scalar>(x: [S::Primal; 3]) -> [S; 3] {
    x.each_as(|x| S::from_primal(x.primal()))
}

impl<S: Scalar> RelativeBox<S> {
    /// Returns the gap of the planes that separate the boxes best, in the mean of all that tie. Parallel faces turn
    /// about the middle of their overlap.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deepest(&self, gaps: &Gaps<S>, choice: &Choice<S::Primal>) -> S {
        let RelativeBox { r, g, h, c, d } = self;
        let share = |x: S::Primal| S::from_primal(x.primal());
        let mut sum = S::zero();
        for k in 0..3 {
            let lean_a = dot(
                fixed(choice.lean_a[k]),
                [0, 1, 2].each_as(|j| r[k][j] * h[j]),
            );
            let lean_b = dot(
                fixed(choice.lean_b[k]),
                [0, 1, 2].each_as(|i| r[i][k] * g[i]),
            );
            let (side_a, side_b) = (sign_or_none(c[k].primal()), sign_or_none(d[k].primal()));
            sum += (gaps.a[k] + lean_a * share(side_a)) * share(choice.share_a[k]);
            sum += (gaps.b[k] - lean_b * share(side_b)) * share(choice.share_b[k]);
            for j in 0..3 {
                let part = choice.share_edges[k][j];
                // Parallel edges have no gap, whose largest number times zero is none.
                let none = part.equals(S::Primal::zero());
                let gap = S::select(none, S::zero(), gaps.edges[k][j]);
                sum += gap * share(part);
            }
        }
        sum.with_primal(choice.deepest)
    }
}

/// Returns b in the frame of a, in units in which both are of a size near one, and the scale of these units.
#[cfg_attr(not(debug_assertions), inline(always))]
fn seen<S: Scalar>(a: &BoxCore<S>, b: &BoxCore<S>) -> (RelativeBox<S>, S) {
    let anchor = a.anchor();
    let scale = scale_of::<S>(a.extent(anchor).most(b.extent(anchor)));
    let way = ((b.given - a.given) + (b.arm - a.arm)) * scale;
    // Axes of a are orthogonal: of equal ones of b only the difference is left, which is exactly zero.
    let turn = |i: usize, j: usize| {
        let (u, v) = (a.axes[i], b.axes[j]);
        let sine = u.dot(if i == j { v } else { v - a.axes[j] });
        // The rest of half a turn is rounding, which sums absorb and signs do not.
        let none = sine.unsigned().below(S::lit(S::format().parallel()));
        S::select(none, sine.with_primal(S::Primal::zero()), sine)
    };
    let seen = RelativeBox {
        c: a.axes.each_as(|axis| axis.dot(way)),
        d: b.axes.each_as(|axis| axis.dot(way)),
        r: [0, 1, 2].each_as(|i| [0, 1, 2].each_as(|j| turn(i, j))),
        g: a.half.each_as(|half| half * scale),
        h: b.half.each_as(|half| half * scale),
    };
    (seen, scale)
}

/// Returns the relation of two boxes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn relate<S: Scalar>(a: BoxCore<S>, b: BoxCore<S>) -> Relation<S> {
    let (seen, scale) = seen(&a, &b);
    let gaps = seen.gaps();
    let choice = decide(&seen.primal(), &gaps_primal(&gaps));
    let RelativeBox { c, r, g, h, .. } = seen;
    let (x, y) = (fixed::<S>(choice.x), fixed::<S>(choice.y));
    let (at_a, at_b) = (
        [0, 1, 2].each_as(|k| g[k] * x[k]),
        [0, 1, 2].each_as(|k| h[k] * y[k]),
    );
    // The vector from the point of a to that of b, along the axes of a and of b.
    let w = [0, 1, 2].each_as(|k| (c[k] + dot(r[k], at_b)) - at_a[k]);
    let seen_b = [0, 1, 2].each_as(|j| (seen.d[j] + at_b[j]) - dot(column(&r, j), at_a));
    let keep = fixed::<S>(choice.keep);
    let kept = |w: [S; 3]| Vec3::new(w[0] * keep[0], w[1] * keep[1], w[2] * keep[2]);
    // Two edges: their normal, and where the edge of b is nearest.
    let (u, along) = (fixed::<S>(choice.edge_a), fixed::<S>(choice.edge_b));
    let v = r.each_as(|row| dot(row, along));
    let vector = |x: [S; 3]| Vec3::new(x[0], x[1], x[2]);
    let long = vector(u).cross(vector(v));
    let square = long.length_squared();
    let none = square.at_most(least_square());
    let square = S::select(none, S::one(), square);
    let side = S::from_primal(choice.side.primal());
    let unit = long * side.over(square.root());
    let height = unit.dot(vector(w));
    let off = |x: Vec3<S>| x - vector(u) * vector(u).dot(x);
    // The points are nearest already: only their derivatives slide.
    let t = vanish(off(vector(w)).dot(off(vector(v))).over(square));
    let zero = S::zero();
    let pick = |in_a: Vec3<S>, in_b: Vec3<S>, edges: Vec3<S>| {
        let faces = Vec3::select(choice.by_a, in_a, in_b);
        Vec3::select(choice.by_edges, edges, faces)
    };
    let apart = pick(kept(w), kept(seen_b), Vec3::new(height, zero, zero));
    let shape = |axes: [Vec3<S>; 3], x: Vec3<S>| axes[0] * x.x + axes[1] * x.y + axes[2] * x.z;
    let outer = kept(fixed(choice.out));
    let way = direction(apart);
    let to_face = Vec3::select(choice.inside, outer, way);
    let normal = pick(
        shape(a.axes, to_face),
        shape(b.axes, to_face),
        shape(a.axes, unit),
    );
    let length = apart.length();
    // Duals of a tiny length pass through numbers beyond the largest one.
    let straight = apart.dot(way.constant());
    let straight = straight.with_primal(length.primal());
    let length = S::select(length.at_most(S::speck()), straight, length);
    let deepest = seen.deepest(&gaps, &choice);
    let gap = S::select(choice.inside, deepest, length);
    let overlap = choice.inside & deepest.below(zero);
    let over = |x: S| x.over(scale);
    let step = normal * over(gap);
    let [half_a, half_b] = [at_a, at_b].each_as(|at| at.each_as(over));
    let on_a = a.given + (a.arm + shape(a.axes, vector(half_a)));
    let on_b = b.given + (b.arm + shape(b.axes, vector(half_b)));
    let slid = shape(b.axes, vector(along)) * over(S::select(choice.by_edges, t, zero));
    let from_b = !choice.by_a & !choice.by_edges;
    let on_b = Vec3::select(from_b, on_a + step, on_b - slid);
    Relation {
        apart: over(gap),
        square: over(over(S::select(overlap, zero, apart.length_squared()))),
        normal,
        on_a: Vec3::select(from_b, on_a, on_b - step),
        on_b,
    }
}

/// Returns the longest distance of points of two boxes: the corner of a decides which of two opposite sides of b is
/// farther.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn farthest<S: Scalar>(a: BoxCore<S>, b: BoxCore<S>) -> S {
    let (RelativeBox { c, d, r, g, h }, scale) = seen(&a, &b);
    // From the corner of a at the negative ends of its axes; the others by signs.
    let (along_a, along_b) = (
        [0, 1, 2].each_as(|i| g[i] * c[i]),
        [0, 1, 2].each_as(|j| h[j] * d[j]),
    );
    let arms = [0, 1, 2].each_as(|j| [0, 1, 2].each_as(|i| (g[i] * h[j]) * r[i][j]));
    let signed = |negative: bool, x: S| if negative { -x } else { x };
    let far = std::array::from_fn::<S, 8, _>(|n| {
        let at = |x: [S; 3]| {
            let [x, y, z] = [0, 1, 2].each_as(|k| signed(n >> k & 1 == 1, x[k]));
            (x + y) + z
        };
        let sides = [0, 1, 2].each_as(|j| (along_b[j] - at(arms[j])).magnitude());
        ((sides[0] + sides[1]) + sides[2]) - at(along_a)
    });
    let most = most_of(far);
    ((dot(c, c) + (dot(g, g) + dot(h, h))) + (most + most))
        .root()
        .over(scale)
}

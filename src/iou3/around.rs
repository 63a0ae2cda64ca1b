//! Shapes around a pair of boxes of any orientation.
use super::enclosing::{Enclosing, gap, outside, shared};
use super::terms::Terms;
use crate::arrays::Each;
use crate::iou::{larger, part, unit};
use crate::overlap3::relate::relate3_in;
use crate::shape::Obb3;
use crate::{Scalar, Vec3};

/// The number of roundings within which the volumes of two enclosing boxes count as equal.
const ROUNDINGS: f64 = 32.0;

/// Lengths along three axes.
type Three<S> = [S; 3];

/// Two boxes in one unit.
struct BoxPair<S> {
    iou: S,
    size_a: Three<S>,
    size_b: Three<S>,
    /// The squared distance of the centres.
    way: S,
}

#[inline(always)]
fn volume<S: Scalar>([x, y, z]: Three<S>) -> S {
    (x * y) * z
}

#[inline(always)]
fn three<S: Copy>(v: Vec3<S>) -> Three<S> {
    [v.x, v.y, v.z]
}

#[inline(always)]
fn choose<S: Scalar>(mask: S::Mask, yes: S, no: S) -> S {
    S::select(mask, yes, no)
}

impl<S: Scalar> BoxPair<S> {
    /// Returns the terms by a box of which the sides are given.
    #[inline(always)]
    fn terms(&self, around: Three<S>) -> Terms<S> {
        let all = volume(around);
        let empty = all.at_most(S::lit(S::format().empty()));
        let held = choose(empty, S::one(), all);
        let covered = |size| choose(empty, S::zero(), part(volume(size), held));
        let covered = [covered(self.size_a), covered(self.size_b)];
        let [x, y, z] = around;
        let (a, b) = (self.size_a, self.size_b);
        // A box turned against the one around both may be longer than that.
        let gap = |i: usize| gap(a[i], b[i], larger(larger(around[i], a[i]), b[i]));
        Terms {
            outside: outside(covered, shared(covered, self.iou), empty),
            way: part(self.way, (x * x + y * y) + z * z),
            gaps: gap(0) + gap(1) + gap(2),
        }
    }
}

/// Returns the extents of two boxes about a centre: of one that reaches so far along its own axes, and one elsewhere.
#[inline(always)]
fn extents<S: Scalar>(own: Three<S>, center: Three<S>, reach: Three<S>) -> Three<S> {
    [0, 1, 2].each_as(|i| own[i].most(reach[i] + center[i]) + own[i].most(reach[i] - center[i]))
}

/// Returns the terms of two boxes of any orientation.
#[inline(always)]
pub(super) fn of_any<S: Scalar>(a: Obb3<S>, b: Obb3<S>, iou: S, kind: Enclosing) -> Terms<S> {
    let half = S::lit(0.5);
    let (half_a, half_b) = (a.size * half, b.size * half);
    let way = Vec3::new(
        b.center.x.halved() - a.center.x.halved(),
        b.center.y.halved() - a.center.y.halved(),
        b.center.z.halved() - a.center.z.halved(),
    );
    let scale = unit([
        way.x, way.y, way.z, half_a.x, half_a.y, half_a.z, half_b.x, half_b.y, half_b.z,
    ]);
    let way = way * scale;
    let way = way + way;
    let pair = BoxPair {
        iou,
        size_a: three(a.size * scale),
        size_b: three(b.size * scale),
        way: way.length_squared(),
    };
    if kind == Enclosing::Aabb {
        let reach = |x: Obb3<S>, half: Vec3<S>| {
            let (axes, half) = (x.rotation.axes(), half * scale);
            let part = |axis: Vec3<S>, half: S| {
                Vec3::new(axis.x.magnitude(), axis.y.magnitude(), axis.z.magnitude()) * half
            };
            three(part(axes[0], half.x) + part(axes[1], half.y) + part(axes[2], half.z))
        };
        return pair.terms(extents(reach(a, half_a), three(way), reach(b, half_b)));
    }
    let seen = relate3_in(a, b, scale);
    let (r, c, h, p) = (seen.turn, seen.center, seen.half_a, seen.half_b);
    let reach = [0, 1, 2].each_as(|i: usize| {
        (r[i][0].magnitude() * p[0] + r[i][1].magnitude() * p[1]) + r[i][2].magnitude() * p[2]
    });
    let by_a = extents(h, c, reach);
    let back = [0, 1, 2].each_as(|i: usize| (r[0][i] * c[0] + r[1][i] * c[1]) + r[2][i] * c[2]);
    let reach = [0, 1, 2].each_as(|i: usize| {
        (r[0][i].magnitude() * h[0] + r[1][i].magnitude() * h[1]) + r[2][i].magnitude() * h[2]
    });
    let by_b = extents(p, back, reach);
    // The smaller one, by values alone: where rounding decides, both by half.
    let (of_a, of_b) = (volume(by_a).primal(), volume(by_b).primal());
    let slack = (of_a + of_b) * S::Primal::rounding(ROUNDINGS, 1);
    let close = (of_a - of_b).unsigned().at_most(slack);
    // A box that holds the other one is the least around both, however it turns.
    let holds = |around: Three<S>, half: Three<S>| {
        let [x, y, z] = [0, 1, 2].each_as(|i: usize| {
            let half = half[i].primal();
            around[i].primal().at_most(half + half)
        });
        (x & y) & z
    };
    let (a_holds, b_holds) = (holds(by_a, h), holds(by_b, p));
    let by_b = seen.renamed.restore(by_b);
    let tie = close & ((a_holds & b_holds) | !(a_holds | b_holds));
    let second = (of_b.below(of_a) & !(close & a_holds)) | (close & (b_holds & !a_holds));
    let chosen = [0, 1, 2].each_as(|i: usize| choose(second, by_b[i], by_a[i]));
    let other = [0, 1, 2].each_as(|i: usize| choose(second, by_a[i], by_b[i]));
    let (chosen, other) = (pair.terms(chosen), pair.terms(other));
    let shared = |x: S, y: S| choose(tie, x.halved() + y.halved(), x);
    Terms {
        outside: shared(chosen.outside, other.outside),
        way: shared(chosen.way, other.way),
        gaps: shared(chosen.gaps, other.gaps),
    }
}

//! An overlap of rotated boxes that has derivatives for boxes apart, too.
use super::hull_scale;
use crate::clip::{frame, relate};
use crate::overlap::iou_obb2;
use crate::{Obb2, Scalar};

/// Returns the IoU of two rotated boxes where they overlap. For boxes apart it is minus `g / (g + s)`, with the widest
/// gap g between them along the direction of a side and the mean s of the boxes' larger sides: from 0 at contact to −1
/// far away. The range is `[−1, 1]`. It is continuous, and boxes apart always have a derivative.
///
/// Kinks: those of IoU, and where another side's direction has the widest gap.
///
/// ```
/// use geograd::{Obb2, iou::separation_aware_obb2};
/// let a = Obb2::new(0.0_f64, 0.0, 2.0, 2.0, 0.0);
/// assert_eq!(separation_aware_obb2(a, a), 1.0);
/// assert_eq!(separation_aware_obb2(a, Obb2::new(4.0, 0.0, 2.0, 1.0, 0.0)), -0.5);
/// ```
#[must_use]
#[inline]
pub fn separation_aware_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (own, other) = (frame(a), frame(b));
    let scale = hull_scale(&own, &other);
    let pair = relate::<S, true>(own, other, scale);
    let (h, p, cos, steep) = (pair.half_a, pair.half_b, pair.cos, pair.sin.magnitude());
    let (u, v) = (pair.u, pair.v);
    let gap = |center: S, own: S, along: S, across: S| {
        center.magnitude() - (own + (along * cos + across * steep))
    };
    let (e, f) = (u * cos + v * pair.sin, v * cos - u * pair.sin);
    // The gap of parallel sides is equal along both. Let b turn by t from there. The gap along b's side is then wider
    // by `tilt t + (p − h) |t|`; p and h are the extents of b and a across it. It is wider for both signs of t if the
    // second term is larger, else for one of them. Then the derivative is the mean of both directions.
    let wider = |of_a: S, of_b: S, [p, h]: [S; 2], tilt: S| {
        let parallel = of_a.equals(of_b) & pair.sin.equals(S::zero());
        let more = S::from_primal((p - h).primal());
        let decided = parallel & tilt.unsigned().below(more.unsigned());
        let (first, second) = (decided & p.below(h), decided & h.below(p));
        let turn = pair.sin * more.signed_as(tilt).halved();
        let shared = of_a.most(of_b) + S::select(parallel, turn, S::zero());
        S::select(first, of_a, S::select(second, of_b, shared))
    };
    let along = wider(
        gap(u, h.x, p.x, p.y),
        gap(e, p.x, h.x, h.y),
        [p.y, h.y],
        v.signed_as(u),
    );
    let across = wider(
        gap(v, h.y, p.y, p.x),
        gap(f, p.y, h.y, h.x),
        [p.x, h.x],
        (-u).signed_as(v),
    );
    let gap = along.most(across);
    let size = h.x.most(h.y) + p.x.most(p.y);
    let apart = gap.above(S::zero());
    let held = S::select(apart, gap, S::one());
    let value = held.over(held + size);
    S::select(apart, -value, iou_obb2(a, b)).canonical()
}

//! The gap between two boxes of any orientation, or the depth of their overlap.
use super::scored::Solid;
use crate::Scalar;
use crate::overlap3::relate::{Relative3, relate3};
use crate::scalar::most_of;
use crate::shape::Obb3;

/// Returns the largest gap between the boxes' shadows over all fifteen axes that could separate them: a face's normal
/// of either or the cross product of two edges. In units of `1 / scale`.
///
/// The normal of two nearly parallel edges adds nothing to the faces; it counts as far as the square of its length is
/// above rounding.
fn widest_gap<S: Scalar>(pair: &Relative3<S>) -> S {
    let (r, c, h, p) = (pair.turn, pair.center, pair.half_a, pair.half_b);
    let faces = |i: usize| {
        let reach =
            (r[i][0].magnitude() * p[0] + r[i][1].magnitude() * p[1]) + r[i][2].magnitude() * p[2];
        let of_a = c[i].magnitude() - (h[i] + reach);
        let reach =
            (r[0][i].magnitude() * h[0] + r[1][i].magnitude() * h[1]) + r[2][i].magnitude() * h[2];
        let center = (r[0][i] * c[0] + r[1][i] * c[1]) + r[2][i] * c[2];
        of_a.most(center.magnitude() - (p[i] + reach))
    };
    let gap = most_of([faces(0), faces(1), faces(2)]);
    let least = S::rounding(64.0, 1);
    // The gap along a's edge i cross b's edge m, or the given number if both are parallel.
    let edges = |i: usize, m: usize, gap: S| {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        let (a, b) = ((m + 1) % 3, (m + 2) % 3);
        let square = r[j][m].squared() + r[l][m].squared();
        let parallel = square.at_most(least);
        let length = S::select(parallel, S::one(), square).root();
        let distance = (c[l] * r[j][m] - c[j] * r[l][m]).magnitude();
        let reach_a = h[j] * r[l][m].magnitude() + h[l] * r[j][m].magnitude();
        let reach_b = p[a] * r[i][b].magnitude() + p[b] * r[i][a].magnitude();
        let own = (distance - (reach_a + reach_b)).over(length);
        S::select(parallel, gap, own)
    };
    // Groups that neither other names of the coordinates nor an exchange of the boxes mix: ties are shared alike.
    let along = |i: usize| edges(i, i, gap);
    let across = |i: usize| {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        edges(j, l, gap).most(edges(l, j, gap))
    };
    let of_edges = most_of([along(0), along(1), along(2)]);
    let of_edges = of_edges.most(most_of([across(0), across(1), across(2)]));
    gap.most(of_edges)
}

/// Returns the gap between two boxes along the axis that separates them most, a length. It is negative for boxes that
/// overlap: minus the distance that one must move to leave the other.
///
/// For boxes apart it is at most their distance, and equal to it where that is between faces, or edges, or a face and
/// anything; its derivatives point apart. Kinks where another axis becomes the widest; axes that tie share the
/// derivative.
///
/// ```
/// use geograd::{Obb3, Rotation3, Vec3, iou3::penetration_or_gap};
/// let a = Obb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0), Rotation3::identity());
/// let at = |x: f64| Obb3 { center: Vec3::new(x, 0.0, 0.0), ..a };
/// assert_eq!(penetration_or_gap(a, at(5.0)), 3.0);
/// assert_eq!(penetration_or_gap(a, at(1.5)), -0.5);
/// ```
#[must_use]
#[inline]
pub fn penetration_or_gap<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let pair = relate3(a, b);
    widest_gap(&pair).over(pair.scale).saturated().canonical()
}

/// Returns the IoU of two boxes where they overlap. For boxes apart it is minus `g / (g + s)`, with the widest gap g
/// between them ([`penetration_or_gap`]) and the mean s of the boxes' largest sizes: from 0 at contact to −1 far away.
/// The range is `(−1, 1]`. It is continuous, and boxes apart always have a derivative.
///
/// ```
/// use geograd::{Aabb3, Vec3, iou3::separation_aware};
/// let a = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0));
/// let b = Aabb3::new(Vec3::new(4.0, 0.0, 0.0), Vec3::new(6.0, 2.0, 2.0));
/// assert_eq!(separation_aware(a, a), 1.0);
/// assert_eq!(separation_aware(a, b), -0.5);
/// ```
#[must_use]
#[inline]
pub fn separation_aware<S: Scalar, B: Solid<S>>(a: B, b: B) -> S {
    or_overlap(a.into(), b.into(), || a.overlap(b)).canonical()
}

/// Returns the separation of boxes apart, the overlap of others.
#[inline(always)]
pub(super) fn or_overlap<S: Scalar>(a: Obb3<S>, b: Obb3<S>, overlap: impl Fn() -> S) -> S {
    let pair = relate3(a, b);
    let gap = widest_gap(&pair);
    let size = most_of(pair.half_a) + most_of(pair.half_b);
    let apart = gap.above(S::zero());
    let held = S::select(apart, gap, S::one());
    let value = held.over(held + size);
    S::select(apart, -value, overlap())
}

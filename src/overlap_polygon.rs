//! How much polygons overlap: area of intersection, intersection over union, over the first; nothing
//! is clipped and no polygon is built.
//!
//! # The method
//!
//! Let `c` be any place. A closed ring is the sum, with signs, of the triangles `T(f)` from `c` over
//! its edges `f`: around every point they add up to the number of times that the ring winds around it.
//! So for any ring `P` and a polygon `K`
//!
//! ```text
//! area(P ∩ K) = Σ over edges f of P, g of K:  sign(f) sign(g) area(T(f) ∩ T(g)),
//! ```
//!
//! where regions that `P` winds around twice count twice and clockwise ones (holes) count negative.
//! Two triangles with a common corner share the directions between the later of their first and the
//! earlier of their last rays, and along each ray what is nearer. With `Δ` the part of `f` between
//! the two rays, and `x`, `y` by how much of itself `f` lies beyond `g` on either ray,
//!
//! ```text
//! 2 area(T(f) ∩ T(g)) = (f₀ × f₁) Δ h(x, y),     h = (1 − x)(1 − y)      where one edge is nearer,
//!                                                h = 1 − b y² / (a y − α)  where they cross,
//! ```
//!
//! with `a`, `b` the distances of `f` and `g` along the ray on which `f` is nearer, in a common unit,
//! and `α = a − b`. The sum is continuous in every vertex, so identical, touching, contained and
//! collinear polygons need no care, and every term is bounded by either triangle: with `c` near the
//! smaller polygon nothing large cancels.
//!
//! Kinks: edges lying along each other (where both are exactly on one line on either ray, the slope
//! is shared half and half), and polygons that begin to touch (slope zero).
use crate::overlap::{ratio_of_first, ratio_of_union};
use crate::reference::{Reference, bounds_of, choose};
use crate::shape::edges;
use crate::{Aabb2, ConvexPolygon, Scalar, Vec2};

/// An edge of a ring against an edge of a polygon, seen from a common place and both turned so that
/// they run counter-clockwise around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wedge<S: Scalar> {
    /// Where the triangles share any direction.
    pub shared: S::Mask,
    /// Where the first edge ran clockwise.
    pub turned_f: S::Mask,
    /// Where the second edge ran clockwise.
    pub turned_g: S::Mask,
    /// The directions' first ray goes through the start of `g` (else of `f`).
    pub first_g: S::Mask,
    /// Their last ray goes through the end of `g` (else of `f`).
    pub last_g: S::Mask,
    /// How far into an edge the first ray meets it: into `f` where it goes through the start of `g`.
    pub skip: S,
    /// How far from its end the last ray meets an edge.
    pub rest: S,
    /// Distances of f and g along the first ray, in a common unit, and their difference.
    pub first: [S; 3],
    /// Distances of f and g along the last ray, in a common unit, and their difference.
    pub last: [S; 3],
    /// Twice the areas of both triangles, not negative.
    pub twice: [S; 2],
}

/// Sees the triangles over `f` and `g`. `cross` is `g × f` of start and start, start of g and end of
/// f, end of g and start of f, end and end; `beyond_g` how far both ends of f are to the left of g,
/// `beyond_f` those of g of f.
#[inline(always)]
pub(crate) fn wedge<S: Scalar>(
    twice: [S; 2],
    cross: [S; 4],
    beyond_g: [S; 2],
    beyond_f: [S; 2],
) -> Wedge<S> {
    let zero = S::zero();
    let (turned_f, turned_g) = (twice[0].below(zero), twice[1].below(zero));
    let swap = |mask, x: [S; 2]| [S::select(mask, x[1], x[0]), S::select(mask, x[0], x[1])];
    let sign = |mask, x: [S; 2]| [S::select(mask, -x[0], x[0]), S::select(mask, -x[1], x[1])];
    let [p00, p01] = swap(turned_f, [cross[0], cross[1]]);
    let [p10, p11] = swap(turned_f, [cross[2], cross[3]]);
    let [p00, p10] = swap(turned_g, [p00, p10]);
    let [p01, p11] = swap(turned_g, [p01, p11]);
    let beyond_g = sign(turned_g, swap(turned_f, beyond_g));
    let beyond_f = sign(turned_f, swap(turned_g, beyond_f));
    let twice = [twice[0].unsigned(), twice[1].unsigned()];

    let (first_g, last_g) = (p00.below(zero), p11.above(zero));
    // Each triangle spans less than a half turn: they share directions where the start of one is
    // within the other.
    let shared = (first_g & p01.above(zero)) | (!first_g & p10.below(zero));
    // Positive wherever a direction is shared; rounding may leave nothing.
    let first_unit = S::select(first_g, p01 - p00, p00 - p10);
    let last_unit = S::select(last_g, p11 - p10, p01 - p11);
    let shared = shared & first_unit.above(zero) & last_unit.above(zero);
    let (first_unit, last_unit) = (
        S::select(shared, first_unit, S::one()),
        S::select(shared, last_unit, S::one()),
    );
    Wedge {
        shared,
        turned_f,
        turned_g,
        first_g,
        last_g,
        skip: p00.unsigned().over(first_unit),
        rest: p11.unsigned().over(last_unit),
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
    }
}

/// Twice the area that both triangles share, with the sign of their orientations.
#[inline(always)]
fn shared_twice<S: Scalar>(pair: &Wedge<S>) -> S {
    let (zero, one) = (S::zero(), S::one());
    let span =
        one - S::select(pair.first_g, pair.skip, zero) - S::select(pair.last_g, pair.rest, zero);
    let ([a, b, alpha], [far_a, far_b, beta]) = (pair.first, pair.last);
    let excess = |at: S, by: S, other: S| {
        // On the other's border it counts where it comes from beyond or goes there.
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
    let area = pair.twice[0] * span * share;
    let area = S::select(pair.shared, area, zero);
    S::select(mixed::<S>(pair), -area, area)
}

/// Where the two triangles are of opposite orientation.
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
}

impl<S: Scalar, const M: usize> Fan<S, M> {
    #[inline(always)]
    pub fn new(polygon: &[Vec2<S>; M], seen: &Reference<S>) -> Self {
        let mut at = *polygon;
        let mut k = 0;
        while k < M {
            at[k] = seen.place(polygon[k]);
            k += 1;
        }
        let mut twice = [S::zero(); M];
        k = 0;
        while k < M {
            twice[k] = at[k].perp_dot(at[Self::after(k)]);
            k += 1;
        }
        Fan { at, twice }
    }
    /// The vertex after vertex `k`.
    #[inline(always)]
    pub fn after(k: usize) -> usize {
        if k + 1 < M { k + 1 } else { 0 }
    }
    /// The area.
    #[inline(always)]
    pub fn area(&self) -> S {
        let mut sum = S::zero();
        let mut k = 0;
        while k < M {
            sum += self.twice[k];
            k += 1;
        }
        sum.halved()
    }
    /// The triangle over an edge `f` of a ring against that over edge `k`.
    #[inline(always)]
    pub fn wedge(&self, f: [Vec2<S>; 2], k: usize) -> Wedge<S> {
        let g = [self.at[k], self.at[Self::after(k)]];
        let (along_f, along_g) = (f[1] - f[0], g[1] - g[0]);
        wedge(
            [f[0].perp_dot(f[1]), self.twice[k]],
            [
                g[0].perp_dot(f[0]),
                g[0].perp_dot(f[1]),
                g[1].perp_dot(f[0]),
                g[1].perp_dot(f[1]),
            ],
            [along_g.perp_dot(f[0] - g[0]), along_g.perp_dot(f[1] - g[0])],
            [along_f.perp_dot(g[0] - f[0]), along_f.perp_dot(g[1] - f[0])],
        )
    }
    /// What an edge of a ring contributes to twice the area that the ring shares with this.
    #[inline(always)]
    pub fn shared_with(&self, edge: [Vec2<S>; 2]) -> S {
        let mut sum = S::zero();
        let mut k = 0;
        while k < M {
            sum += shared_twice(&self.wedge(edge, k));
            k += 1;
        }
        sum
    }
    /// Where one of the edges has all of the other polygon on its right or on itself, both being
    /// convex: they are apart or merely touch.
    #[inline(always)]
    fn separates<const N: usize>(&self, other: &Fan<S, N>) -> S::Mask {
        let zero = S::zero();
        let mut any = S::one().below(zero);
        let mut k = 0;
        while k < M {
            let (start, end) = (self.at[k], self.at[Self::after(k)]);
            let along = end - start;
            let mut all = !(along.x.equals(zero) & along.y.equals(zero));
            let mut i = 0;
            while i < N {
                all = all & along.perp_dot(other.at[i] - start).at_most(zero);
                i += 1;
            }
            any = any | all;
            k += 1;
        }
        any
    }
}

/// Areas of two convex polygons and of what they share, in the local unit of a reference.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SharedArea<S: Scalar> {
    pub seen: Reference<S>,
    /// Shared area, area of a, area of b.
    pub areas: [S; 3],
    /// Where nothing is shared: value and slopes are zero.
    pub nothing: S::Mask,
}

#[inline(always)]
fn least_bounds<S: Scalar, const N: usize>(polygon: &[Vec2<S>; N]) -> Aabb2<S> {
    bounds_of(polygon).unwrap_or(Aabb2 {
        min: Vec2::zero(),
        max: Vec2::zero(),
    })
}

/// A place inside a convex polygon, in local coordinates, at which no vertex of another one is to be
/// expected: there it would have no direction. So the vertices have weights of no simple ratio.
#[inline(always)]
fn middle<S: Scalar, const N: usize>(polygon: &[Vec2<S>; N], seen: &Reference<S>) -> Vec2<S> {
    let (mut sum, mut total, mut k) = (Vec2::zero(), 0.0, 0);
    while k < N {
        let weight = 1.0 + 0.618_033_988_749_895 * ((k % 3) as f64) / 5.0;
        sum += seen.place(polygon[k]) * S::lit(weight);
        total += weight;
        k += 1;
    }
    sum * S::lit(1.0 / total)
}

/// How both polygons are seen: from a place inside the smaller one. And whether their bounds are apart.
#[inline(always)]
fn pair_reference<S: Scalar, const N: usize, const M: usize>(
    a: &[Vec2<S>; N],
    b: &[Vec2<S>; M],
) -> (Reference<S>, S::Mask) {
    let (seen, in_a, apart) = Reference::of_pair(least_bounds(a), least_bounds(b));
    let middle = choose(in_a, middle(a, &seen), middle(b, &seen));
    (seen.shifted(middle), apart)
}

/// Measures two convex polygons, given as `N` and `M` vertices (repeated ones change nothing).
#[inline(always)]
pub(crate) fn measure<S: Scalar, const N: usize, const M: usize>(
    a: &[Vec2<S>; N],
    b: &[Vec2<S>; M],
) -> SharedArea<S> {
    let (seen, apart) = pair_reference(a, b);
    let (fan_a, fan_b) = (Fan::new(a, &seen), Fan::new(b, &seen));
    let (area_a, area_b) = (fan_a.area(), fan_b.area());
    let mut twice = S::zero();
    let mut k = 0;
    while k < N {
        twice += fan_b.shared_with([fan_a.at[k], fan_a.at[Fan::<S, N>::after(k)]]);
        k += 1;
    }
    let area = twice.halved();
    let limit = area_a.primal().least(area_b.primal());
    let beyond = area.above(S::from_primal(limit));
    let area = S::select(beyond, area.with_primal(limit), area);
    let separate = fan_a.separates(&fan_b) | fan_b.separates(&fan_a);
    let nothing = apart | separate | area.at_most(S::zero());
    SharedArea {
        seen,
        areas: [S::select(nothing, S::zero(), area), area_a, area_b],
        nothing,
    }
}

/// The area shared by two convex polygons, from 0 to the area of the smaller one, in squared units of
/// length. Exactly zero, with slope zero, where they are apart or merely touch; saturates at the
/// largest finite number.
///
/// Straight line over all pairs of edges. Right to a few roundings of the smaller polygon's area
/// where sizes are alike, to about R of them where one is R times longer. Method and kinks: see the
/// [module](self).
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, Vec2, overlap_polygon::intersection_area_polygons};
/// let square = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
/// let triangle = ConvexPolygon::from([(1.0, 1.0), (4.0, 1.0), (1.0, 4.0)].map(|(x, y)| Vec2::new(x, y)));
/// assert!((intersection_area_polygons(&square, &triangle) - 1.0_f64).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn intersection_area_polygons<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> S {
    let shared = measure(&a.padded(), &b.padded());
    let seen = shared.seen;
    seen.outer(seen.outer(shared.areas[0]))
        .saturated()
        .canonical()
}

/// Intersection over union of two convex polygons, in `[0, 1]`; exactly 1 with slope zero for the same
/// polygon twice, zero with slope zero where the union is empty. See the [module](self).
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, overlap_polygon::iou_polygons};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 4.0, 2.0));
/// let b = ConvexPolygon::from(Aabb2::new(2.0, 0.0, 6.0, 2.0));
/// assert!((iou_polygons(&a, &b) - 1.0_f64 / 3.0).abs() < 1e-15);
/// assert_eq!(iou_polygons(&a, &a), 1.0);
/// ```
#[must_use]
#[inline]
pub fn iou_polygons<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> S {
    let [inter, area_a, area_b] = measure(&a.padded(), &b.padded()).areas;
    ratio_of_union(inter, area_a, area_b).canonical()
}

/// The share of the first convex polygon that lies in the second, in `[0, 1]`; zero with slope zero
/// where the first has no area. See the [module](self).
#[must_use]
#[inline]
pub fn iof_polygons<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> S {
    let [inter, area_a, _] = measure(&a.padded(), &b.padded()).areas;
    ratio_of_first(inter, area_a).canonical()
}

/// What rings are measured against: a convex polygon, and where both are seen from. The body of a fold
/// over edges takes it.
#[derive(Clone, Copy, Debug)]
pub struct Inside<S: Scalar, const M: usize> {
    pub(crate) seen: Reference<S>,
    pub(crate) fan: Fan<S, M>,
    pub(crate) apart: S::Mask,
}

impl<S: Scalar, const M: usize> Inside<S, M> {
    /// For rings within some bounds and a convex polygon, given as `M` vertices (repeated ones change
    /// nothing).
    #[must_use]
    #[inline(always)]
    pub fn new(rings: Aabb2<S>, polygon: &[Vec2<S>; M]) -> Self {
        let bounds = least_bounds(polygon);
        let (seen, in_rings, apart) = Reference::of_pair(rings, bounds);
        // Inside the rings' bounds, at no simple fraction of them.
        let (low, high) = (seen.place(rings.min), seen.place(rings.max));
        let share = Vec2::new(S::lit(0.463_647_609), S::lit(0.540_302_306));
        let size = high - low;
        let at = low + Vec2::new(size.x * share.x, size.y * share.y);
        let seen = seen.shifted(choose(in_rings, at, middle(polygon, &seen)));
        Inside {
            seen,
            fan: Fan::new(polygon, &seen),
            apart,
        }
    }
    /// The body of the fold: what the edge from `start` to `end` contributes. Contributions are added.
    #[must_use]
    #[inline(always)]
    pub fn of_edge(&self, start: Vec2<S>, end: Vec2<S>) -> S {
        self.fan
            .shared_with([self.seen.place(start), self.seen.place(end)])
    }
    /// The end of the fold: the area inside, in the caller's unit, from the sum over all edges.
    #[must_use]
    #[inline(always)]
    pub fn finish(&self, sum: S) -> S {
        let area = self.seen.outer(self.seen.outer(sum.halved()));
        S::select(self.apart, S::zero(), area.saturated()).canonical()
    }
}

/// The signed area of the part of a polygon that lies in a convex one, in squared units of length. The
/// polygon is any number of rings: holes are rings of the other orientation, and each region counts as
/// often as the rings wind around it, clockwise negative. Rings may touch and cross themselves and
/// each other.
///
/// A fold over edges; right to a few roundings of the smaller extent squared. See the [module](self).
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, overlap_polygon::area_inside};
/// let outer = Aabb2::new(0.0, 0.0, 4.0, 4.0).corners();
/// let mut hole = Aabb2::new(1.0, 1.0, 3.0, 3.0).corners();
/// hole.reverse();
/// let half = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 4.0));
/// assert!((area_inside(&[&outer, &hole], &half) - 6.0_f64).abs() < 1e-14);
/// ```
#[must_use]
#[inline]
pub fn area_inside<S: Scalar, const M: usize>(
    rings: &[&[Vec2<S>]],
    polygon: &ConvexPolygon<S, M>,
) -> S {
    let Some(bounds) = bounds_of_rings(rings) else {
        return S::zero();
    };
    let inside = Inside::new(bounds, &polygon.padded());
    let mut sum = S::zero();
    for ring in rings {
        for [start, end] in edges(ring) {
            sum += inside.of_edge(start, end);
        }
    }
    inside.finish(sum)
}

/// The smallest axis-aligned box around all rings, as constants.
#[inline]
pub(crate) fn bounds_of_rings<S: Scalar>(rings: &[&[Vec2<S>]]) -> Option<Aabb2<S>> {
    let each = rings.iter().filter_map(|ring| bounds_of(ring));
    each.reduce(|a, b| a.join(b))
}

impl<S: Scalar, const N: usize> ConvexPolygon<S, N> {
    /// The area shared with another convex polygon, from 0 to the area of the smaller one.
    #[must_use]
    #[inline]
    pub fn intersection_area<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> S {
        intersection_area_polygons(self, other)
    }
    /// Intersection over union, in `[0, 1]`.
    #[must_use]
    #[inline]
    pub fn iou<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> S {
        iou_polygons(self, other)
    }
    /// The share of this polygon that lies in the other one, in `[0, 1]`.
    #[must_use]
    #[inline]
    pub fn iof<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> S {
        iof_polygons(self, other)
    }
}

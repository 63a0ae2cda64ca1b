//! Overlap of polygons: area of intersection, intersection over union, over the first; nothing is clipped and no
//! polygon is built.
//!
//! # The method
//!
//! Let `c` be any point. A closed ring is the sum, with signs, of the triangles `T(f)` from `c` over its edges `f`:
//! around every point they add up to the number of times that the ring winds around it. So for any ring `P` and a
//! polygon `K`
//!
//! ```text
//! area(P ∩ K) = Σ over edges f of P, g of K:  sign(f) sign(g) area(T(f) ∩ T(g)),
//! ```
//!
//! where regions that `P` winds around twice count twice and clockwise ones (holes) count negative. Two triangles with
//! a common corner share the directions between the later of their first and the earlier of their last rays, and along
//! each ray the range up to the nearer edge. With `Δ` the part of `f` between the two rays, and `x`, `y` by how much of
//! itself `f` lies beyond `g` on either ray,
//!
//! ```text
//! 2 area(T(f) ∩ T(g)) = (f₀ × f₁) Δ h(x, y),     h = (1 − x)(1 − y)      where one edge is nearer,
//!                                                h = 1 − b y² / (a y − α)  where they cross,
//! ```
//!
//! with `a`, `b` the distances of `f` and `g` along the ray on which `f` is nearer, in a common unit, and `α = a − b`.
//! The sum is continuous in every vertex, so identical, touching, contained and collinear polygons need no special
//! case, and every term is bounded by either triangle: with `c` near the smaller polygon nothing large cancels.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Kinks: edges lying along each other (where both are exactly on one line on either ray, the derivative
//! is shared half and half), and polygons that begin to touch (derivative zero).
pub mod holed;
mod quad;
mod wedge;

use crate::overlap::{ratio_of_first, ratio_of_union};
use crate::reference::{Reference, bounds_of};
use crate::scalar::Guard;
use crate::shape::edges;
use crate::{Aabb2, ConvexPolygon, Mask, Scalar, Vec2};
pub use quad::intersection_area_quads;
pub(crate) use quad::{QuadPair, TINY, check_quad, choose_quad, is_convex, swapped};
pub(crate) use wedge::{Fan, Wedge, between, mixed, shared_twice};

/// Areas of two convex polygons and of their intersection, in the local unit of a reference.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SharedArea<S: Scalar> {
    pub seen: Reference<S>,
    /// Shared area, area of a, area of b.
    pub areas: [S; 3],
    /// `true` where nothing is shared: value and derivatives are zero.
    pub nothing: S::Mask,
    /// `true` if both have equal vertices in one order: each has half the derivatives of its own area.
    pub same: S::Mask,
}

#[inline(always)]
fn least_bounds<S: Scalar>(polygon: &[Vec2<S>]) -> Aabb2<S> {
    bounds_of(polygon).unwrap_or(Aabb2 {
        min: Vec2::zero(),
        max: Vec2::zero(),
    })
}

/// Returns a point inside a convex polygon, in local coordinates, at which no vertex of another one is to be expected:
/// a vertex there would have no direction. So the vertices have weights of no simple ratio.
#[inline(always)]
fn middle<S: Scalar>(polygon: &[Vec2<S>], seen: &Reference<S>) -> Vec2<S> {
    let (mut sum, mut total) = (Vec2::zero(), 0.0);
    for (k, &vertex) in polygon.iter().enumerate() {
        let weight = 1.0 + 0.618_033_988_749_895 * ((k % 3) as f64) / 5.0;
        sum += seen.place(vertex) * S::lit(weight);
        total += weight;
    }
    sum * S::lit(1.0 / total.max(1.0))
}

/// Returns the frame of both polygons with its origin inside the smaller one; then if that is a, and if their bounds
/// are apart.
#[inline(always)]
fn pair_reference<S: Scalar>(a: &[Vec2<S>], b: &[Vec2<S>]) -> (Reference<S>, S::Mask, S::Mask) {
    let (seen, in_a, apart) = Reference::of_pair(least_bounds(a), least_bounds(b));
    let middle = Vec2::select(in_a, middle(a, &seen), middle(b, &seen));
    (seen.shifted(middle), in_a, apart)
}

/// Returns `true` if two polygons have equal vertices in one order.
#[inline(always)]
fn same_vertices<S: Scalar>(a: &[Vec2<S>], b: &[Vec2<S>]) -> S::Mask {
    let zero = S::zero();
    if a.len() != b.len() {
        return zero.below(zero);
    }
    let pairs = a.iter().zip(b);
    pairs.fold(zero.equals(zero), |same, (p, q)| {
        same & p.x.equals(q.x) & p.y.equals(q.y)
    })
}

/// Measures two convex polygons, given as the first `count_a` and `count_b` of some vertices (repeated
/// ones change nothing).
#[inline(always)]
fn measure_counted<S: Scalar, const N: usize, const M: usize>(
    a: &[Vec2<S>; N],
    count_a: usize,
    b: &[Vec2<S>; M],
    count_b: usize,
) -> SharedArea<S> {
    let (seen, in_a, apart) = pair_reference(&a[..count_a], &b[..count_b]);
    let (fan_a, fan_b) = (Fan::new(a, count_a, &seen), Fan::new(b, count_b, &seen));
    let (area_a, area_b) = (fan_a.area(), fan_b.area());
    let zero = S::zero();
    if apart.all() {
        return SharedArea {
            seen,
            areas: [zero, area_a, area_b],
            nothing: apart,
            same: !apart & apart,
        };
    }
    let mut twice = zero;
    let mut k = 0;
    while k < fan_a.count {
        twice += shared_of_edge(&fan_b, fan_a.edge(k), !in_a);
        k += 1;
    }
    let area = twice.halved();
    let limit = area_a.primal().least(area_b.primal());
    let beyond = area.above(S::from_primal(limit));
    let area = S::select(beyond, area.with_primal(limit), area);
    let separate = fan_a.separates(&fan_b) | fan_b.separates(&fan_a);
    let same = same_vertices(&a[..count_a], &b[..count_b]);
    let area = S::select(same, area_a.halved() + area_b.halved(), area);
    let nothing = apart | separate | area.at_most(zero);
    SharedArea {
        seen,
        areas: [S::select(nothing, zero, area), area_a, area_b],
        nothing,
        same,
    }
}

/// Returns the contribution of an edge, as a call: in line, for every edge of full polygons, derivatives of many
/// numbers are megabytes of code.
#[inline(never)]
fn shared_of_edge<S: Scalar, const M: usize>(
    fan: &Fan<S, M>,
    edge: [Vec2<S>; 2],
    smaller: S::Mask,
) -> S {
    fan.shared_with(edge, smaller)
}

/// Measures two convex polygons. Full ones have code of their own, without a count. It is not inlined, because seven
/// functions call it: inlined copies are a tenth of the library with derivatives of many numbers.
#[inline(never)]
pub(crate) fn measure<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> SharedArea<S> {
    if a.count == N && b.count == M {
        return measure_counted(&a.vertices, N, &b.vertices, M);
    }
    measure_counted(&a.vertices, a.count.min(N), &b.vertices, b.count.min(M))
}

/// Returns the area shared by two convex polygons, from 0 to the area of the smaller one, in squared units of
/// length. Exactly zero, with derivative zero, where they are apart or merely touch; saturates at the
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
    let shared = measure(a, b);
    let seen = shared.seen;
    seen.outer(seen.outer(shared.areas[0]))
        .saturated()
        .canonical()
}

/// Returns the intersection over union of two convex polygons, in `[0, 1]`; exactly 1 with derivative zero for equal
/// vertices in one order, zero with derivative zero where the union is empty. See the [module](self).
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
    let [inter, area_a, area_b] = measure(a, b).areas;
    ratio_of_union(inter, area_a, area_b).canonical()
}

/// Returns the share of the first convex polygon that lies in the second, in `[0, 1]`; zero with derivative zero
/// where the first has no area. See the [module](self).
#[must_use]
#[inline]
pub fn iof_polygons<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> S {
    let [inter, area_a, _] = measure(a, b).areas;
    ratio_of_first(inter, area_a).canonical()
}

/// The convex polygon that rings are measured against, and the local frame of both. The body of a fold over edges takes
/// it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window<S: Scalar, const M: usize> {
    pub(crate) seen: Reference<S>,
    pub(crate) fan: Fan<S, M>,
    pub(crate) smaller: S::Mask,
    pub(crate) apart: S::Mask,
}

impl<S: Scalar, const M: usize> Window<S, M> {
    /// Prepares a convex polygon for rings within some bounds.
    #[must_use]
    #[inline(always)]
    pub fn new(rings: Aabb2<S>, polygon: &ConvexPolygon<S, M>) -> Self {
        let bounds = least_bounds(polygon.as_slice());
        let (seen, in_rings, apart) = Reference::of_pair(rings, bounds);
        // Inside the rings' bounds, at no simple fraction of them.
        let (low, high) = (seen.place(rings.min), seen.place(rings.max));
        let share = Vec2::new(S::lit(0.463_647_609), S::lit(0.540_302_306));
        let size = high - low;
        let at = low + Vec2::new(size.x * share.x, size.y * share.y);
        let seen = seen.shifted(Vec2::select(
            in_rings,
            at,
            middle(polygon.as_slice(), &seen),
        ));
        Window {
            seen,
            fan: Fan::new(&polygon.vertices, polygon.count, &seen),
            smaller: !in_rings,
            apart,
        }
    }
    /// Returns the body of the fold: the contribution of the edge from `start` to `end`. Contributions are added.
    #[must_use]
    #[inline(always)]
    pub fn of_edge(&self, start: Vec2<S>, end: Vec2<S>) -> S {
        let edge = [self.seen.place(start), self.seen.place(end)];
        self.fan.shared_with(edge, self.smaller)
    }
    /// Returns the end of the fold: the area inside, in the caller's unit, from the sum over all edges.
    #[must_use]
    #[inline(always)]
    pub fn finish(&self, sum: S) -> S {
        let area = self.seen.outer(self.seen.outer(sum.halved()));
        S::select(self.apart, S::zero(), area.saturated()).canonical()
    }
}

/// Returns the signed area of the part of a polygon that lies in a convex one, in squared units of length. The
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
    let inside = Window::new(bounds, polygon);
    let mut sum = S::zero();
    for ring in rings {
        for [start, end] in edges(ring) {
            sum += inside.of_edge(start, end);
        }
    }
    inside.finish(sum)
}

/// Returns the smallest axis-aligned box around all rings, as constants.
#[inline]
pub(crate) fn bounds_of_rings<S: Scalar>(rings: &[&[Vec2<S>]]) -> Option<Aabb2<S>> {
    let each = rings.iter().filter_map(|ring| bounds_of(ring));
    each.reduce(|a, b| a.join(b))
}

impl<S: Scalar, const N: usize> ConvexPolygon<S, N> {
    /// Returns a guard with the vertices of both.
    fn guard_with<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> Guard<S> {
        let all = self.as_slice().iter().chain(other.as_slice());
        all.fold(Guard::new(), |guard, vertex| guard.and(vertex))
    }
    /// Returns the area shared with another convex polygon, from 0 to the area of the smaller one.
    #[must_use]
    #[inline]
    pub fn intersection_area<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> S {
        self.guard_with(other)
            .result(intersection_area_polygons(self, other))
    }
    /// Returns the intersection over union, in `[0, 1]`.
    #[must_use]
    #[inline]
    pub fn iou<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> S {
        self.guard_with(other).result(iou_polygons(self, other))
    }
    /// Returns the share of this polygon that lies in the other one, in `[0, 1]`.
    #[must_use]
    #[inline]
    pub fn iof<const M: usize>(&self, other: &ConvexPolygon<S, M>) -> S {
        self.guard_with(other).result(iof_polygons(self, other))
    }
}

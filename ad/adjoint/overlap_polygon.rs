//! Adjoints of areas of intersection of polygons, by the motion of their own borders.
//!
//! Moving a piece of the border of one polygon by `v` changes the shared area by the integral of
//! `v · n` over what of the piece lies inside the other one, with `n` the normal outwards (Reynolds'
//! transport theorem). An edge from `f₀` to `f₁` of which the part from `s` to `t` counts, as
//! fractions of itself, moves by `(1 − r) ḟ₀ + r ḟ₁`, and `n` times its length is `(Δy, −Δx)`. So
//!
//! ```text
//! f̄₀ += ((t − s) − (t² − s²)/2) (Δy, −Δx),     f̄₁ += (t² − s²)/2 (Δy, −Δx).
//! ```
//!
//! In the sum over pairs of triangles the part of `f` that is inside `T(g)` is between two rays, up to the crossing of
//! `f` and `g`. Nothing is divided by the sine of the angle between two edges, and the crossing point itself is not
//! differentiated, so nearly parallel edges are harmless. Edges that lie along each other count half each.
use crate::overlap_polygon::{Fan, SharedArea, Wedge, Window, bounds_of_rings, measure, mixed};
use crate::shape::edges;
use crate::{ConvexPolygon, Mask, Scalar, Vec2};

/// The part of an edge that counts, from one fraction of it to another, and its weight.
struct EdgePart<S> {
    from: S,
    to: S,
    weight: S,
}

/// Returns the pieces of `f` and `g` that bound what their triangles share.
#[inline(always)]
fn pieces<S: Scalar>(pair: &Wedge<S>) -> [EdgePart<S>; 2] {
    let (zero, one, half) = (S::zero(), S::one(), S::lit(0.5));
    let pick = |mask, x| S::select(mask, x, zero);
    let f = [
        pick(pair.first_g, pair.skip),
        one - pick(pair.last_g, pair.rest),
    ];
    let g = [
        pick(!pair.first_g, pair.skip),
        one - pick(!pair.last_g, pair.rest),
    ];
    let ([a, b, alpha], [far_a, far_b, beta]) = (pair.first, pair.last);
    // The fractions of the range from the first to the last ray in which f is nearer, and in which g is: by the depths
    // of one behind the other on both rays.
    let below = |x: S| S::select(x.below(zero), -x, zero);
    let (unit, far_unit) = (a.most(b), far_a.most(far_b));
    let guard = |x: S| S::select(x.at_most(zero), one, x);
    let (unit, far_unit) = (guard(unit), guard(far_unit));
    let (a, b, alpha) = (a.over(unit), b.over(unit), alpha.over(unit));
    let (far_a, far_b, beta) = (
        far_a.over(far_unit),
        far_b.over(far_unit),
        beta.over(far_unit),
    );
    let tie = alpha.equals(zero) & beta.equals(zero);
    let share = |near: S, far: S, alpha: S, beta: S| {
        let (x, y) = (far * below(alpha), near * below(beta));
        let all = far * alpha.unsigned() + near * beta.unsigned();
        let none = all.at_most(zero);
        let share = (x + y).over(S::select(none, one, all));
        S::select(tie, one, S::select(none, zero, share))
    };
    let of_f = share(b, far_b, alpha, beta);
    let of_g = share(a, far_a, -alpha, -beta);
    let weight = S::select(tie, half, one);
    // Nearer first, or nearer last.
    let cut = |span: [S; 2], share: S, leads| {
        let length = (span[1] - span[0]) * share;
        EdgePart {
            from: S::select(leads, span[0], span[1] - length),
            to: S::select(leads, span[0] + length, span[1]),
            weight,
        }
    };
    let f_leads = alpha.below(zero);
    [cut(f, of_f, f_leads), cut(g, of_g, !f_leads)]
}

/// Adds the cotangent of a part of an edge that moves to both ends.
#[inline(always)]
fn pull<S: Scalar>(
    edge: [Vec2<S>; 2],
    piece: &EdgePart<S>,
    turned: S::Mask,
    bar: S,
) -> [Vec2<S>; 2] {
    let along = edge[1] - edge[0];
    let out = Vec2::new(along.y, -along.x) * (bar * piece.weight);
    let to_end = ((piece.to - piece.from) * (piece.to + piece.from)).halved();
    let to_start = (piece.to - piece.from) - to_end;
    let (start, end) = (
        S::select(turned, to_end, to_start),
        S::select(turned, to_start, to_end),
    );
    [out * start, out * end]
}

/// Returns the derivatives of the area that the triangles over two edges share, by the ends of both.
#[inline(always)]
pub(super) fn pair_derivatives<S: Scalar>(
    f: [Vec2<S>; 2],
    g: [Vec2<S>; 2],
    pair: &Wedge<S>,
) -> [[Vec2<S>; 2]; 2] {
    let (zero, one) = (S::zero(), S::one());
    let [piece_f, piece_g] = pieces(pair);
    let sign = S::select(mixed(pair), -one, one);
    let sign = S::select(pair.shared, sign, zero);
    // An edge's own orientation is in its normal.
    let by_f = S::select(pair.turned_f, -sign, sign);
    let by_g = S::select(pair.turned_g, -sign, sign);
    [
        pull(f, &piece_f, pair.turned_f, by_f),
        pull(g, &piece_g, pair.turned_g, by_g),
    ]
}

/// Adds the derivatives of what an edge of a ring shares with a polygon, both in local coordinates: to the
/// polygon's vertices, and as a result to both ends of the edge.
#[inline(always)]
fn edge_derivatives<S: Scalar, const M: usize>(
    fan: &Fan<S, M>,
    edge: [Vec2<S>; 2],
    fan_bar: &mut [Vec2<S>; M],
) -> [Vec2<S>; 2] {
    let mut edge_bar = [Vec2::zero(); 2];
    let mut k = 0;
    while k < fan.count {
        let (now, next) = (k, fan.after(k));
        k += 1;
        let Some(pair) = fan.wedge(edge, now) else {
            continue;
        };
        let [f, g] = pair_derivatives(edge, [fan.at[now], fan.at[next]], &pair);
        edge_bar[0] += f[0];
        edge_bar[1] += f[1];
        fan_bar[now] += g[0];
        fan_bar[next] += g[1];
    }
    edge_bar
}

/// Returns the local derivatives of the shared area of two convex polygons.
#[inline(always)]
fn shared_derivatives<S: Scalar, const N: usize, const M: usize>(
    fan_a: &Fan<S, N>,
    fan_b: &Fan<S, M>,
) -> ([Vec2<S>; N], [Vec2<S>; M]) {
    let (mut a_bar, mut b_bar) = ([Vec2::zero(); N], [Vec2::zero(); M]);
    let mut k = 0;
    while k < fan_a.count {
        let next = fan_a.after(k);
        let bars = edge_derivatives(fan_b, fan_a.edge(k), &mut b_bar);
        a_bar[k] += bars[0];
        a_bar[next] += bars[1];
        k += 1;
    }
    (a_bar, b_bar)
}

/// Returns the local derivatives of a polygon's own area: `v̄ = (q_y − p_y, p_x − q_x)/2` with `p`, `q` its neighbours.
#[inline(always)]
fn own_derivatives<S: Scalar, const N: usize>(fan: &Fan<S, N>) -> [Vec2<S>; N] {
    let mut bars = [Vec2::zero(); N];
    let mut k = 0;
    while k < fan.count {
        let next = fan.after(k);
        let across = fan.at[fan.after(next)] - fan.at[k];
        bars[next] = Vec2::new(across.y.halved(), -across.x.halved());
        k += 1;
    }
    bars
}

/// A pair of cotangents.
type Bars<S, const N: usize, const M: usize> = (ConvexPolygon<S, N>, ConvexPolygon<S, M>);

/// Combines the derivatives of a function of the three areas, given the function's partial derivatives in
/// local units; `power` is the unit of the function as a power of length.
#[inline(always)]
fn combined<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    shared: &SharedArea<S>,
    partials: [S; 3],
    power: i32,
) -> Bars<S, N, M> {
    let seen = shared.seen;
    let fan_a = Fan::new(&a.vertices, a.count, &seen);
    let fan_b = Fan::new(&b.vertices, b.count, &seen);
    let (mut a_bar, mut b_bar) = ([Vec2::zero(); N], [Vec2::zero(); M]);
    if !shared.nothing.all() {
        (a_bar, b_bar) = shared_derivatives(&fan_a, &fan_b);
    }
    let (own_a, own_b) = (own_derivatives(&fan_a), own_derivatives(&fan_b));
    let inter = S::select(shared.nothing, S::zero(), partials[0]);
    let half = |own: Vec2<S>| Vec2::new(own.x.halved(), own.y.halved());
    for (bar, own) in a_bar.iter_mut().zip(own_a) {
        let of_both = Vec2::select(shared.same, half(own), *bar);
        *bar = seen.outer_derivative(of_both * inter + own * partials[1], power);
    }
    for (bar, own) in b_bar.iter_mut().zip(own_b) {
        let of_both = Vec2::select(shared.same, half(own), *bar);
        *bar = seen.outer_derivative(of_both * inter + own * partials[2], power);
    }
    (
        ConvexPolygon {
            vertices: a_bar,
            count: a.count,
        },
        ConvexPolygon {
            vertices: b_bar,
            count: b.count,
        },
    )
}

/// Returns `out_bar` times the derivatives of
/// [`intersection_area_polygons`](crate::overlap_polygon::intersection_area_polygons) with respect to both polygons.
/// Derivation: see the [module](self).
#[must_use]
#[inline]
pub fn intersection_area_polygons_vjp<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    out_bar: S,
) -> Bars<S, N, M> {
    let shared = measure(a, b);
    combined(a, b, &shared, [out_bar, S::zero(), S::zero()], 2)
}

/// Returns `out_bar` times the derivatives of [`iou_polygons`](crate::overlap_polygon::iou_polygons) with respect to
/// both polygons.
///
/// With `r = I / U`: `∂I = (1 + r) / U`, `∂A = ∂B = −r / U`.
#[must_use]
#[inline]
pub fn iou_polygons_vjp<S: Scalar, const N: usize, const M: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    out_bar: S,
) -> Bars<S, N, M> {
    let shared = measure(a, b);
    let [inter, area_a, area_b] = shared.areas;
    let union = area_a + area_b - inter;
    let empty = union.at_most(S::lit(S::format().empty()));
    let per = S::one().over(S::select(empty, S::one(), union));
    let per = S::select(empty, S::zero(), per * out_bar);
    let ratio = crate::overlap::ratio_of_union(inter, area_a, area_b);
    let own = -(ratio * per);
    combined(a, b, &shared, [per + ratio * per, own, own], 0)
}

/// Writes the cotangents of [`area_inside`](crate::overlap_polygon::area_inside), one per vertex of each ring, and
/// returns those of the convex polygon.
///
/// # Panics
///
/// When a list of cotangents is shorter than its ring, or there are fewer lists than rings.
pub fn area_inside_vjp<S: Scalar, const M: usize>(
    rings: &[&[Vec2<S>]],
    polygon: &ConvexPolygon<S, M>,
    out_bar: S,
    ring_bars: &mut [&mut [Vec2<S>]],
) -> ConvexPolygon<S, M> {
    let mut fan_bar = [Vec2::zero(); M];
    let Some(bounds) = bounds_of_rings(rings) else {
        return ConvexPolygon {
            vertices: fan_bar,
            count: polygon.count,
        };
    };
    let inside = Window::new(bounds, polygon);
    let out_bar = S::select(inside.apart, S::zero(), out_bar);
    let seen = inside.seen;
    for (ring, bars) in rings.iter().zip(ring_bars.iter_mut()) {
        let bars = &mut bars[..ring.len()];
        bars.fill(Vec2::zero());
        for (k, [start, end]) in edges(ring).enumerate() {
            let edge = [seen.place(start), seen.place(end)];
            let pulled = edge_derivatives(&inside.fan, edge, &mut fan_bar);
            bars[k] += pulled[0];
            bars[(k + 1) % ring.len()] += pulled[1];
        }
        for bar in bars {
            *bar = seen.outer_derivative(*bar * out_bar, 2);
        }
    }
    for bar in &mut fan_bar {
        *bar = seen.outer_derivative(*bar * out_bar, 2);
    }
    ConvexPolygon {
        vertices: fan_bar,
        count: polygon.count,
    }
}

//! Adjoints of the measures of polygons of any kind, and of their distance from a point: one cotangent per vertex, one
//! ring after the other.
use super::ring::{perimeter_vjp as ring_perimeter_vjp, signed_area_vjp};
use crate::ad::forward::{First, gradient};
use crate::distance::ring::EdgeFold;
use crate::measure::moments::of_edge;
use crate::polygon::{Fill, Rings, Sides};
use crate::reference::Reference;
use crate::shape::edges;
use crate::{Jet, Scalar, Vec2};

/// Calls a function for every ring, with its number and its part of the cotangents.
fn each_ring<'a, S: Scalar>(
    rings: Rings<'a, S>,
    bars: &mut [Vec2<S>],
    mut f: impl FnMut(usize, &'a [Vec2<S>], &mut [Vec2<S>]),
) {
    let mut rest = &mut bars[..rings.vertex_count()];
    for (k, ring) in rings.iter().enumerate() {
        let (own, others) = rest.split_at_mut(ring.len());
        f(k, ring, own);
        rest = others;
    }
}

/// Writes the cotangents of [`area`](crate::polygon::area), one per vertex.
///
/// ```
/// use geograd::{Aabb2, Vec2, ad::adjoint::polygon::area_vjp};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 2.0, 2.0).corners());
/// let (rings, mut bars) = ([outer.as_slice(), &hole], [Vec2::zero(); 8]);
/// area_vjp(&rings[..], 1.0, &mut bars);
/// assert_eq!((bars[0], bars[4]), (Vec2::new(-2.0, -2.0), Vec2::new(0.5, 0.5)));
/// ```
///
/// # Panics
///
/// When there are fewer cotangents than vertices.
pub fn area_vjp<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    out_bar: S,
    bars: &mut [Vec2<S>],
) {
    let rings = rings.into();
    let sides = Sides::decided(rings);
    each_ring(rings, bars, |k, ring, own| {
        signed_area_vjp(ring, out_bar * sides.sign(k), own);
    });
}

/// Writes the cotangents of [`perimeter`](crate::polygon::perimeter), one per vertex.
///
/// # Panics
///
/// When there are fewer cotangents than vertices.
pub fn perimeter_vjp<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    out_bar: S,
    bars: &mut [Vec2<S>],
) {
    each_ring(rings.into(), bars, |_, ring, own| {
        ring_perimeter_vjp(ring, out_bar, own);
    });
}

/// Writes the cotangents of [`centroid`](crate::polygon::centroid), one per vertex.
///
/// With the centroid as origin, `k = p × q` of each edge and `T = Σ k`: `p̄ = (w (q_y, −q_x) + k c̄) / 3T` and
/// `q̄ = (w (−p_y, p_x) + k c̄) / 3T` for `w = (p + q) · c̄`. Rings on the other side count negative.
///
/// # Panics
///
/// When there are fewer cotangents than vertices.
pub fn centroid_vjp<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    out_bar: Vec2<S>,
    bars: &mut [Vec2<S>],
) {
    let rings = rings.into();
    let bars = &mut bars[..rings.vertex_count()];
    bars.fill(Vec2::zero());
    let Some(bounds) = rings.bounds() else {
        return;
    };
    let (sides, mut seen) = (Sides::decided(rings), Reference::of_moments(bounds));
    let mut sums = [S::zero(); 3];
    rings.each_edge(|ring, _, [start, end]| {
        let [twice, x, y, ..] = of_edge(seen.place(start), seen.place(end));
        for (sum, of_edge) in sums.iter_mut().zip([twice, x, y]) {
            *sum += of_edge * sides.sign(ring);
        }
    });
    let [twice, x, y] = sums;
    if twice.equals(S::zero()) {
        let mean = S::lit(1.0 / rings.vertex_count() as f64);
        bars.fill((out_bar * mean).saturated().canonical());
        return;
    }
    let thrice = S::lit(3.0) * twice;
    seen = seen.shifted(Vec2::new(x.over(thrice), y.over(thrice)));
    rings.each_edge(|ring, [from, to], [start, end]| {
        let (p, q, side) = (seen.place(start), seen.place(end), sides.sign::<S>(ring));
        let turned = (p + q).dot(out_bar) * side;
        let both = out_bar * (p.perp_dot(q) * side);
        bars[from] += Vec2::new(q.y, -q.x) * turned + both;
        bars[to] += Vec2::new(-p.y, p.x) * turned + both;
    });
    for bar in bars {
        *bar = Vec2::new(bar.x.over(thrice), bar.y.over(thrice))
            .saturated()
            .canonical();
    }
}

/// Returns the distance of a point from the border of a polygon, in units of length, negative inside by a fill rule, and
/// adds its cotangents, times `out_bar`, to those of the point and of the vertices. Without vertices it is the largest
/// finite number.
///
/// Exactly on one edge the derivative is that of the outward normal, where several edges meet zero. Edges that are
/// equally near share it.
///
/// ```
/// use geograd::{Aabb2, Vec2, ad::adjoint::polygon::signed_distance_vjp, polygon::Fill};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// let (rings, mut bars, mut by) = ([outer.as_slice(), &hole], [Vec2::zero(); 8], Vec2::zero());
/// let at = Vec2::new(1.5, 2.0); // in the hole
/// let distance = signed_distance_vjp(at, &rings[..], Fill::EvenOdd, 1.0, &mut by, &mut bars);
/// assert_eq!((distance, by.x, bars[4].x + bars[7].x), (0.5, 1.0, -1.0));
/// ```
///
/// # Panics
///
/// When there are fewer cotangents than vertices.
pub fn signed_distance_vjp<'a, S: Scalar<Mask = bool>>(
    point: Vec2<S>,
    rings: impl Into<Rings<'a, S>>,
    fill: Fill,
    out_bar: S,
    point_bar: &mut Vec2<S>,
    bars: &mut [Vec2<S>],
) -> S {
    let rings = rings.into();
    let bars = &mut bars[..rings.vertex_count()];
    let state = rings.fold(point);
    let value = state.signed_distance(fill);
    // Edges that may be the nearest one: measured one by one, a distance may differ by roundings from the least.
    let reach = state.distance * S::lit(1.0 + 64.0 * S::format().epsilon());
    let mut least = S::lit(S::format().largest());
    let mut nearest: Vec<([usize; 2], [Vec2<S>; 2])> = Vec::new();
    let mut first = 0;
    for ring in rings.iter() {
        for (k, [from, to]) in edges(ring).enumerate() {
            let next = if k + 1 < ring.len() { k + 1 } else { 0 };
            if is_beyond(point, from, to, reach) {
                continue;
            }
            let distance = EdgeFold::of_edge(point, from, to).distance();
            if distance.below(least) {
                nearest.clear();
                least = distance;
            }
            if distance.equals(least) {
                nearest.push(([first + k, first + next], [from, to]));
            }
        }
        first += ring.len();
    }
    let count = S::lit(nearest.len() as f64);
    let is_border = least.equals(S::zero());
    for &([from, to], [start, end]) in &nearest {
        // There is no normal where several edges meet on the border.
        if is_border && nearest.len() > 1 {
            break;
        }
        let (_, [by_point, by_start, by_end]) = gradient(
            |[point, start, end]: [Vec2<First<S>>; 3]| {
                let mut edge = EdgeFold::of_edge(point, start, end);
                // Constant: the place of the variable is none.
                edge.winding = Jet::variable(state.winding, usize::MAX);
                edge.signed_distance(fill)
            },
            [point, start, end],
        );
        let share = out_bar.over(count);
        *point_bar += by_point * share;
        bars[from] += by_start * share;
        bars[to] += by_end * share;
    }
    value
}

/// Returns `true` if an edge is certainly farther than a distance from a point.
fn is_beyond<S: Scalar<Mask = bool>>(point: Vec2<S>, from: Vec2<S>, to: Vec2<S>, reach: S) -> bool {
    let (from, to) = (from - point, to - point);
    let apart =
        |a: S, b: S| (a.above(reach) && b.above(reach)) || ((-a).above(reach) && (-b).above(reach));
    apart(from.x, to.x) || apart(from.y, to.y)
}

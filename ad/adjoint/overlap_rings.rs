//! Adjoints of the overlap of polygons with holes, by the motion of their own borders, as in
//! [`overlap_polygon`](super::overlap_polygon): nothing is divided by the sine of the angle between two
//! edges. Each writes one cotangent per vertex, one ring after the other, and returns the value.
use super::overlap_polygon::pair_derivatives;
use crate::overlap::{ratio_of_first, ratio_of_union};
use crate::overlap_polygon::between;
use crate::overlap_polygon::holed::RingsPair;
use crate::polygon::Rings;
use crate::{Scalar, Vec2};

/// Adds the local derivatives of the area of one of both polygons, times a factor.
fn add_own<S: Scalar<Mask = bool>>(
    pair: &RingsPair<'_, S>,
    which: usize,
    by: S,
    bars: &mut [Vec2<S>],
) {
    pair.each_tile(which, |tile| {
        for k in 0..tile.count {
            let ([start, end], [from, to]) = (tile.edges[k], tile.numbers[k]);
            let half = (by * tile.signs[k]).halved();
            bars[from] += Vec2::new(end.y, -end.x) * half;
            bars[to] += Vec2::new(-start.y, start.x) * half;
        }
    });
}

/// Adds the local derivatives of the shared area, times a factor.
fn add_shared<S: Scalar<Mask = bool>>(
    pair: &RingsPair<'_, S>,
    by: S,
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) {
    if pair.same {
        add_own(pair, 0, by.halved(), a_bar);
        add_own(pair, 1, by.halved(), b_bar);
        return;
    }
    pair.each_tile(1, |g| {
        pair.each_tile(0, |f| {
            for i in 0..f.count {
                for k in 0..g.count {
                    let (edge_f, edge_g) = (f.edges[i], g.edges[k]);
                    let Some(found) = between(edge_f, edge_g, [f.twice[i], g.twice[k]]) else {
                        continue;
                    };
                    let sign = f.signs[i] * g.signs[k] * by;
                    let [by_f, by_g] = pair_derivatives(edge_f, edge_g, &found);
                    for end in 0..2 {
                        a_bar[f.numbers[i][end]] += by_f[end] * sign;
                        b_bar[g.numbers[k][end]] += by_g[end] * sign;
                    }
                }
            }
        });
    });
}

/// A function of the areas: its value, its partial derivatives by shared area and both areas, all in
/// local units, and its unit as a power of length.
struct Score<S> {
    value: S,
    partials: [S; 3],
    power: i32,
}

fn pulled<'a, S: Scalar<Mask = bool>>(
    a: Rings<'a, S>,
    b: Rings<'a, S>,
    (a_bar, b_bar): (&mut [Vec2<S>], &mut [Vec2<S>]),
    score: impl FnOnce(&RingsPair<'a, S>, [S; 3]) -> Score<S>,
) -> S {
    let (a_bar, b_bar) = (
        &mut a_bar[..a.vertex_count()],
        &mut b_bar[..b.vertex_count()],
    );
    a_bar.fill(Vec2::zero());
    b_bar.fill(Vec2::zero());
    let Some(pair) = RingsPair::new(a, b) else {
        return S::zero();
    };
    let areas = pair.areas();
    let found = score(&pair, areas);
    let [by_inter, by_a, by_b] = found.partials;
    let is_zero = |x: S| x.equals(S::zero());
    if !is_zero(areas[0]) && !is_zero(by_inter) {
        add_shared(&pair, by_inter, a_bar, b_bar);
    }
    if !is_zero(by_a) {
        add_own(&pair, 0, by_a, a_bar);
    }
    if !is_zero(by_b) {
        add_own(&pair, 1, by_b, b_bar);
    }
    for bar in a_bar.iter_mut().chain(b_bar) {
        *bar = pair.seen.outer_derivative(*bar, found.power);
    }
    found.value
}

/// Writes the cotangents of [`intersection_area`](crate::overlap_polygon::holed::intersection_area) and returns the
/// value.
///
/// ```
/// use geograd::{Aabb2, Vec2, ad::adjoint::overlap_rings::intersection_area_vjp};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 2.0, 2.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// let (mut a_bar, mut b_bar) = ([Vec2::zero(); 4], [Vec2::zero(); 4]);
/// let area = intersection_area_vjp(&a, &b, 1.0, &mut a_bar, &mut b_bar);
/// assert!((area - 1.0_f64).abs() < 1e-15);
/// let shifted = a_bar.iter().fold(0.0, |sum, bar| sum + bar.x);
/// assert!((shifted - 1.0).abs() < 1e-14); // moving a to the right
/// ```
///
/// # Panics
///
/// When a list of cotangents is shorter than its polygon has vertices.
pub fn intersection_area_vjp<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    out_bar: S,
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) -> S {
    let zero = S::zero();
    pulled(a.into(), b.into(), (a_bar, b_bar), |pair, areas| Score {
        value: pair.outer(areas[0]),
        partials: [out_bar, zero, zero],
        power: 2,
    })
}

/// Writes the cotangents of [`union_area`](crate::overlap_polygon::holed::union_area) and returns the value.
///
/// # Panics
///
/// When a list of cotangents is shorter than its polygon has vertices.
pub fn union_area_vjp<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    out_bar: S,
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) -> S {
    pulled(a.into(), b.into(), (a_bar, b_bar), |pair, areas| Score {
        value: pair.outer(areas[1] + areas[2] - areas[0]),
        partials: [-out_bar, out_bar, out_bar],
        power: 2,
    })
}

/// Writes the cotangents of [`iou`](crate::overlap_polygon::holed::iou) and returns the value. With `r = I / U`:
/// `∂I = (1 + r) / U`, `∂A = ∂B = −r / U`.
///
/// # Panics
///
/// When a list of cotangents is shorter than its polygon has vertices.
pub fn iou_vjp<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    out_bar: S,
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) -> S {
    pulled(
        a.into(),
        b.into(),
        (a_bar, b_bar),
        |pair, [inter, area_a, area_b]| {
            let value = ratio_of_union(inter, area_a, area_b);
            let union = area_a + area_b - inter;
            let flat = pair.same || union.at_most(S::lit(S::format().empty()));
            let per = S::select(
                flat,
                S::zero(),
                out_bar.over(S::select(flat, S::one(), union)),
            );
            let own = -(value * per);
            Score {
                value: value.canonical(),
                partials: [per + value * per, own, own],
                power: 0,
            }
        },
    )
}

/// Writes the cotangents of [`iof`](crate::overlap_polygon::holed::iof) and returns the value. With `r = I / A`:
/// `∂I = 1 / A`, `∂A = −r / A`.
///
/// # Panics
///
/// When a list of cotangents is shorter than its polygon has vertices.
pub fn iof_vjp<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    out_bar: S,
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) -> S {
    pulled(
        a.into(),
        b.into(),
        (a_bar, b_bar),
        |_, [inter, area_a, _]| {
            let value = ratio_of_first(inter, area_a);
            let flat = area_a.at_most(S::lit(S::format().empty()));
            let per = S::select(
                flat,
                S::zero(),
                out_bar.over(S::select(flat, S::one(), area_a)),
            );
            Score {
                value: value.canonical(),
                partials: [per, -(value * per), S::zero()],
                power: 0,
            }
        },
    )
}

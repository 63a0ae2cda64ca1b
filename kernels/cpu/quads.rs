//! Block kernels of convex quadrilaterals.
//!
//! Compiled in this library only, by the entries in `arch`.
use crate::ad::adjoint::overlap_quad::area_of_quads_vjp;
use crate::kernels::cpu::arch::{LARGE, Vector};
use crate::kernels::cpu::blocks::{all_up_to, bring};
use crate::kernels::cpu::lane::{Lane, PLANE, ResultTiles, TILE, Tiles};
use crate::kernels::cpu::overlaps::{lanes_of, put, seed};
use crate::overlap_polygon::{intersection_area_quads, is_convex};
use crate::scalar::power_of_largest;
use crate::{Fixed, Mask, Real, Scalar, Vec2};

/// The number of scalars of a quadrilateral.
pub(crate) const QUAD2: usize = 8;

/// Returns the limit of coordinates beyond which the scalar code computes: `10¹⁵` in single precision.
pub(crate) fn farthest<T: Scalar>() -> f64 {
    power_of_largest::<T>(0.39)
}

/// Returns the vector of quadrilaterals that begins at item `at` of tile `t`.
#[inline(always)]
fn quad<T: Real, V: Vector<T>>(tiles: Tiles<'_, T>, t: usize, at: usize) -> Option<[Vec2<V>; 4]> {
    let tile = tiles.tile::<QUAD2>(t)?;
    let mut quad = [Vec2::zero(); 4];
    let mut k = 0;
    while k < 4 {
        quad[k] = Vec2::new(V::read(&tile[2 * k], at), V::read(&tile[2 * k + 1], at));
        k += 1;
    }
    Some(quad)
}

/// Returns `true` if all quadrilaterals are convex, of either orientation, and of ordinary size. The test is quick: it
/// may return `false` for such ones, too.
#[inline(always)]
pub(crate) fn all_convex<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let far = farthest::<T>();
    if !all_up_to::<T, V>(numbers, far) {
        return false;
    }
    let mut tile = [Lane::default(); QUAD2];
    for rows in numbers.chunks(TILE * QUAD2) {
        bring::<T, V>(rows, QUAD2, &mut tile);
        for at in V::starts() {
            let Some(corners) = quad::<T, V>(Tiles::one(&tile), 0, at) else {
                return false;
            };
            // Products of shorter sides may underflow.
            let size = corners.iter().fold(V::zero(), |size, v| {
                size.most(v.x.unsigned()).most(v.y.unsigned())
            });
            let near = size.below(V::lit(1.0 / far));
            if !(is_convex(corners) & !near).all() {
                return false;
            }
        }
    }
    true
}

/// Writes the intersection areas of convex quadrilaterals.
#[inline(always)]
pub(crate) fn quad_scores<T: Real, V: Vector<T>>(
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, 1>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (quad::<T, V>(a, t, at), quad::<T, V>(b, t, at)) else {
                return;
            };
            put([intersection_area_quads(a, b)], out, 0, at);
        }
    }
}

/// Writes the intersection areas of convex quadrilaterals, each followed by its sixteen derivatives.
#[inline(always)]
pub(crate) fn quad_derivatives<T: Real, V: Vector<T>>(
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    seeds: Option<Tiles<'_, T>>,
    mut out: ResultTiles<'_, T>,
) {
    if !LARGE {
        return;
    }
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, { 2 * QUAD2 * PLANE + 1 }>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (quad::<T, V>(a, t, at), quad::<T, V>(b, t, at)) else {
                return;
            };
            let (value, bars) = area_of_quads_vjp::<V, false>(a, b, seed(seeds, t, at));
            put([value], out, 0, at);
            let mut derivatives = [V::zero(); 2 * QUAD2];
            bars.store(&mut derivatives);
            put(derivatives, out, 1, at);
        }
    }
}

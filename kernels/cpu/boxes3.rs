//! Block kernels of the overlap of boxes of any orientation in space.
//!
//! Compiled in this library only, by the entries in `arch`. Unlike the kernels of the plane they scale every pair, so
//! shapes need no preparation. Derivatives of extreme boxes may overflow here, so the scalar code computes them.
use crate::ad::adjoint::overlap3::score_obb3_vjp_here;
use crate::clip::{COMMON_FAR, COMMON_LARGE, COMMON_SMALL};
use crate::kernels::cpu::arch::{LARGE, Vector};
use crate::kernels::cpu::blocks::all_within;
use crate::kernels::cpu::lane::{PLANE, ResultTiles, Tiles};
use crate::kernels::cpu::overlaps::{is_within, lanes_of, put, seed};
use crate::overlap::Denominator;
use crate::overlap3::score_obb3_here;
use crate::shape::Obb3;
use crate::{Fixed, Real};

/// Numbers of a box of any orientation: centre, size, quaternion.
pub(crate) const OBB3: usize = 10;

/// Returns the vector of boxes that begins at item `at` of tile `t`.
#[inline(always)]
fn obb3<T: Real, V: Vector<T>>(tiles: Tiles<'_, T>, t: usize, at: usize) -> Option<Obb3<V>> {
    let tile = tiles.tile::<OBB3>(t)?;
    let mut numbers = [V::zero(); OBB3];
    let mut k = 0;
    while k < OBB3 {
        numbers[k] = V::read(&tile[k], at);
        k += 1;
    }
    Some(Obb3::load(&numbers))
}

/// Writes the scores of pairs of boxes.
#[inline(always)]
pub(crate) fn scores<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    mut out: ResultTiles<'_, T>,
) {
    if !LARGE {
        return;
    }
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, 1>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (obb3::<T, V>(a, t, at), obb3::<T, V>(b, t, at)) else {
                return;
            };
            put([score_obb3_here(over, a, b)], out, 0, at);
        }
    }
}

/// Writes the scores of pairs of boxes, each followed by its twenty derivatives.
#[inline(always)]
pub(crate) fn derivatives<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    seeds: Option<Tiles<'_, T>>,
    mut out: ResultTiles<'_, T>,
) {
    if !LARGE {
        return;
    }
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, { 2 * OBB3 * PLANE + 1 }>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (obb3::<T, V>(a, t, at), obb3::<T, V>(b, t, at)) else {
                return;
            };
            let (value, (a_bar, b_bar)) = score_obb3_vjp_here(over, a, b, seed(seeds, t, at));
            put([value], out, 0, at);
            let mut derivatives = [V::zero(); 2 * OBB3];
            (a_bar, b_bar).store(&mut derivatives);
            put(derivatives, out, 1, at);
        }
    }
}

/// Limits of the quaternions that kernels serve: every number is at most the first, the largest one at least the
/// second.
const LONG: f64 = 1e3;
const SHORT: f64 = 1e-3;

/// Returns `true` if a valid box is within the limits that [`all_common`] has for many.
pub(crate) fn is_common_obb3<T: Real>(x: &[T]) -> bool {
    let place = |x: &T| x.unsigned() <= T::lit(COMMON_FAR);
    let size = |x: &T| is_within(*x, COMMON_SMALL, COMMON_LARGE);
    let turn = |x: &T| x.unsigned() <= T::lit(LONG);
    let sized = x[..3].iter().all(place) && x[3..6].iter().all(size);
    sized && x[6..].iter().all(turn) && x[6..].iter().any(|x| x.unsigned() >= T::lit(SHORT))
}

/// Returns `true` if every box is valid, of a size from 10⁻⁵ to 10⁶ or zero, and no farther than 10⁹ from the origin.
/// Its quaternion must be neither very long nor very short.
#[inline(always)]
pub(crate) fn all_common<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let (small, large, far) = (COMMON_SMALL, COMMON_LARGE, COMMON_FAR);
    let (items, _) = numbers.as_chunks::<OBB3>();
    let short = T::lit(SHORT);
    let turned = items.iter().fold(true, |all, x| {
        let long = x[6].unsigned().at_least(short) | x[7].unsigned().at_least(short);
        all & (long | x[8].unsigned().at_least(short) | x[9].unsigned().at_least(short))
    });
    turned
        & all_within::<T, V, OBB3>(
            numbers,
            [
                true, true, true, false, false, false, true, true, true, true,
            ],
            [0.0, 0.0, 0.0, small, small, small, 0.0, 0.0, 0.0, 0.0],
            [far, far, far, large, large, large, LONG, LONG, LONG, LONG],
        )
}

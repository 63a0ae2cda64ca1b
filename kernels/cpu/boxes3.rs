//! Block kernels of the overlap of boxes of any orientation in space.
//!
//! Compiled in this library only, by the entries in `arch`. Unlike those of the plane they leave nothing
//! out, so they serve boxes of any size, and shapes need no preparation.
use crate::Fixed;
use crate::kernels::cpu::arch::{LARGE, Vector};
use crate::kernels::cpu::blocks::all_finite;
use crate::kernels::cpu::boxes::{lanes_of, put, seed};
use crate::kernels::cpu::lane::{PLANE, Results, Tiles};
use crate::kernels::real::Real;
use crate::overlap::Denominator;
use crate::overlap3::{score_obb3_here, score_obb3_vjp_here};
use crate::shape::Obb3;

/// Numbers of a box of any orientation: centre, size, quaternion.
pub(crate) const OBB3: usize = 10;

/// A part of a tile of boxes.
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

/// Scores of boxes.
#[inline(always)]
pub(crate) fn scores<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    mut out: Results<'_, T>,
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

/// Scores of boxes, each followed by its twenty slopes.
#[inline(always)]
pub(crate) fn slopes<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    seeds: Option<Tiles<'_, T>>,
    mut out: Results<'_, T>,
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
            let mut slopes = [V::zero(); 2 * OBB3];
            (a_bar, b_bar).store(&mut slopes);
            put(slopes, out, 1, at);
        }
    }
}

/// Whether every box is valid: finite, of no negative size, with a quaternion that is not zero.
#[inline(always)]
pub(crate) fn all_valid<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let (items, _) = numbers.as_chunks::<OBB3>();
    let none = T::default();
    let valid = items.iter().fold(true, |all, x| {
        let sized = none.at_most(x[3]) & none.at_most(x[4]) & none.at_most(x[5]);
        let still = x[6].equals(none) & x[7].equals(none) & x[8].equals(none) & x[9].equals(none);
        all & sized & !still
    });
    valid & all_finite::<T, V>(numbers)
}

//! Block kernels of the overlap of upright boxes: the last stage, after the areas seen from above.
//!
//! Compiled in this library only, by the entries in `arch`.
use crate::ad::adjoint::upright::{Upright, score_from_area_vjp};
use crate::clip::area_from_half;
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, PLANE, ResultTiles, Tiles};
use crate::kernels::cpu::overlaps::{
    OBB2, SEEN, UPRIGHT, frame_fields, framed, lanes_of, put, seed,
};
use crate::overlap::Denominator;
use crate::overlap3::{Scales, heights, score_of_columns};
use crate::{Fixed, Obb2, Real};

/// Extends results with ten derivatives of boxes seen from above to fourteen derivatives of upright boxes.
pub(crate) fn extend_derivatives<T: Real>(out: &mut ResultTiles<'_, T>) {
    for t in 0..out.tiles {
        // Moving the last fields first overwrites none that is still needed.
        for side in [1, 0] {
            for (from, to) in SEEN.into_iter().enumerate().rev() {
                let from = out.lanes[(1 + side * OBB2 + from) * PLANE + t];
                out.lanes[(1 + side * UPRIGHT + to) * PLANE + t] = from;
            }
        }
        for side in 0..2 {
            for height in [2, 5] {
                out.lanes[(1 + side * UPRIGHT + height) * PLANE + t] = Lane::default();
            }
        }
    }
}

/// Returns the vector of prepared upright boxes that begins at item `at` of tile `t`.
#[inline(always)]
fn upright<T: Real, V: Vector<T>>(tiles: Tiles<'_, T>, t: usize, at: usize) -> Option<Upright<V>> {
    let flat = framed(tiles, t, at)?;
    let standing = tiles.lanes.get(t * tiles.step + frame_fields::<T>()..)?;
    let [at_middle, half] = standing.first_chunk::<2>()?;
    Some(Upright {
        flat,
        standing: [V::read(at_middle, at), V::read(half, at)],
    })
}

/// Replaces intersection areas seen from above by the scores of prepared upright boxes of common size.
#[inline(always)]
pub(crate) fn scores<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, 1>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (upright::<T, V>(a, t, at), upright::<T, V>(b, t, at)) else {
                return;
            };
            let area = V::read(&out[0], at);
            let areas = [
                area,
                area_from_half(a.flat.half),
                area_from_half(b.flat.half),
            ];
            let height = heights(a.standing, b.standing, V::one());
            let value = score_of_columns::<V, false>(over, areas, V::one(), &height);
            put([value.canonical()], out, 0, at);
        }
    }
}

/// Replaces intersection areas and their ten derivatives by scores and their fourteen derivatives.
#[inline(always)]
pub(crate) fn derivatives<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    seeds: Option<Tiles<'_, T>>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, { 2 * UPRIGHT * PLANE + 1 }>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (upright::<T, V>(a, t, at), upright::<T, V>(b, t, at)) else {
                return;
            };
            let mut numbers = [V::zero(); 2 * OBB2];
            let mut k = 0;
            while k < 2 * OBB2 {
                numbers[k] = V::read(&out[(1 + k) * PLANE], at);
                k += 1;
            }
            let bars = <(Obb2<V>, Obb2<V>)>::load(&numbers);
            let area = (V::read(&out[0], at), bars);
            let unscaled = Scales {
                flat: V::one(),
                tall: V::one(),
            };
            let seed = seed(seeds, t, at);
            let (value, (a_bar, b_bar)) =
                score_from_area_vjp::<V, false>(over, &a, &b, area, unscaled, seed);
            put([value], out, 0, at);
            let mut derivatives = [V::zero(); 2 * UPRIGHT];
            (a_bar, b_bar).store(&mut derivatives);
            put(derivatives, out, 1, at);
        }
    }
}

//! Lower bounds of distances, from axis-aligned boxes.
use crate::Real;
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, Tiles};

/// The number of scalars of a box: the lower bounds along x, y and z, then the upper ones. Boxes of the plane are
/// endless along z.
pub(crate) const SPACE: usize = 6;

/// Returns the part of a distance, and of the largest side of a box, by which lower bounds are too small: more than any
/// row errs.
fn share<T: Real>() -> f64 {
    4.0 * T::format().epsilon().sqrt()
}

/// Widens boxes by more than a computed distance of shapes inside can be less than the exact one.
///
/// Bounds that are not numbers become endless.
#[inline(always)]
pub(crate) fn widen<T: Real, V: Vector<T>>(boxes: &mut [Lane<T>]) {
    let (of_place, of_size) = (V::lit(64.0 * T::format().epsilon()), V::lit(share::<T>()));
    let (largest, endless) = (V::lit(T::format().largest()), V::lit(f64::INFINITY));
    // The least normal number, times a power of two.
    let tiny = V::lit(256.0 / T::format().largest());
    for tile in boxes.as_chunks_mut::<SPACE>().0 {
        for at in V::starts() {
            let mut size = V::zero();
            let mut k = 0;
            while k < 3 {
                let side = V::read(&tile[k + 3], at) - V::read(&tile[k], at);
                size = V::select(side.at_most(largest), size.most(side), size);
                k += 1;
            }
            let slack = size * of_size + tiny;
            k = 0;
            while k < 3 {
                let (low, high) = (V::read(&tile[k], at), V::read(&tile[k + 3], at));
                let slack = low.unsigned().most(high.unsigned()) * of_place + slack;
                let (low, high) = (low - slack, high + slack);
                let low = V::select(low.equals(low), low, -endless);
                let high = V::select(high.equals(high), high, endless);
                low.write(&mut tile[k], at);
                high.write(&mut tile[k + 3], at);
                k += 1;
            }
        }
    }
}

/// Writes a lower bound of the distance of each box from one box, or of its square: negative where they overlap, by
/// the shortest translation along an axis that parts them.
#[inline(always)]
pub(crate) fn gaps<T: Real, V: Vector<T>>(
    own: &[T; SPACE],
    boxes: Tiles<'_, T>,
    squared: bool,
    out: &mut [Lane<T>],
) {
    let own = [0, 1, 2, 3, 4, 5].map(
        #[inline(always)]
        |k: usize| V::splat(own[k]),
    );
    let zero = V::zero();
    let shrunk = V::lit(1.0 - share::<T>());
    let largest = V::lit(T::format().largest());
    for (tile, out) in boxes.lanes.as_chunks::<SPACE>().0.iter().zip(out) {
        for at in V::starts() {
            let mut gap = [zero; 3];
            let mut k = 0;
            while k < 3 {
                let (low, high) = (V::read(&tile[k], at), V::read(&tile[k + 3], at));
                gap[k] = (low - own[k + 3]).most(own[k] - high);
                k += 1;
            }
            let inside = gap[0].most(gap[1]).most(gap[2]);
            let [x, y, z] = [gap[0].most(zero), gap[1].most(zero), gap[2].most(zero)];
            let square = x * x + y * y + z * z;
            let apart = V::select(square.at_most(largest), square.root(), inside);
            let apart = apart.most(inside) * shrunk;
            let bound = match squared {
                true => apart.most(zero) * apart.most(zero),
                false => V::select(inside.at_most(zero), inside, apart),
            };
            // A result saturates below the largest number.
            let bound = bound.least(largest * shrunk);
            V::select(bound.equals(bound), bound, -largest).write(out, at);
        }
    }
}

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

/// Writes a lower bound of the distance of each box from one box: its square, or where they overlap the shortest
/// translation along an axis that parts them, which is negative. Roots would take longer than all else;
/// [`reach`] is the bound that a distance is compared with.
#[inline(always)]
pub(crate) fn gaps<T: Real, V: Vector<T>>(
    own: &[T; SPACE],
    boxes: Tiles<'_, T>,
    out: &mut [Lane<T>],
) {
    let own = [0, 1, 2, 3, 4, 5].map(
        #[inline(always)]
        |k: usize| V::splat(own[k]),
    );
    let zero = V::zero();
    let shrunk = 1.0 - share::<T>();
    let (shrunk, largest) = (V::lit(shrunk * shrunk), V::lit(T::format().largest()));
    // A result saturates below the largest number.
    let most = largest * shrunk;
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
            let bound = V::select(inside.at_most(zero), inside, square * shrunk);
            let bound = bound.least(most);
            V::select(bound.equals(bound), bound, -largest).write(out, at);
        }
    }
}

/// Returns the number that the [gaps](gaps()) of all boxes have at most whose shapes have a result up to a limit: a
/// distance, or the square of one.
pub(crate) fn reach<T: Real>(limit: T, squared: bool) -> T {
    if squared || limit <= T::default() {
        return limit;
    }
    // More than roundings of squares, also of those below the least normal number.
    let tiny = T::lit(256.0 / T::format().largest());
    limit * limit * T::lit(1.0 + 8.0 * T::format().epsilon()) + tiny
}

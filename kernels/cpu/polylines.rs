//! Lengths of polylines: the distances of neighbouring vertices in vectors, and their sums in order.
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::ragged::each_piece;
use crate::kernels::row::item::rows::numbers;
use crate::{Real, Vec2};

/// The number of distances that wait to be summed: to clear the room for them takes as long as sixteen distances.
const ROOM: usize = 256;

/// Writes the length of every polyline, with the bits of the fold over its edges. Returns `false` if a vertex is not
/// finite. Offsets were checked.
pub(crate) fn lengths<T: Real>(vertices: &[Vec2<T>], offsets: &[usize], out: &mut [T]) -> bool {
    each_piece(offsets, out, 1, |offsets, values| {
        let own = offsets[0]..offsets[values.len()];
        sum_up(&numbers(&vertices[own]), offsets, values)
    })
}

/// Writes the sums of the distances within each polyline. `vertices` has the numbers of these polylines alone. Returns
/// `false` if one is not finite.
fn sum_up<T: Real>(vertices: &[T], offsets: &[usize], out: &mut [T]) -> bool {
    let (base, count) = (offsets[0], vertices.len() / 2);
    let mut room = [T::default(); ROOM];
    // The edges whose lengths are in the room; those between two polylines belong to none.
    let mut known = 0..0;
    for (ends, out) in offsets.windows(2).zip(out) {
        let (mut at, end) = (ends[0] - base, (ends[1] - base).saturating_sub(1));
        let mut sum = T::default();
        while at < end {
            if at >= known.end {
                let last = count.min(at + ROOM + 1);
                known = at..last - 1;
                let own = &vertices[2 * at..2 * last];
                (kernels_in::<T>().edge_lengths)(own, &mut room[..known.len()]);
            }
            let stop = end.min(known.end);
            for &length in &room[at - known.start..stop - known.start] {
                sum += length;
            }
            at = stop;
        }
        // A sum of finite distances says that their vertices are finite; a lone vertex has none.
        let own = 2 * (ends[0] - base)..2 * (ends[1] - base);
        let is_known = own.len() > 2 && sum.finite();
        if !is_known && !(kernels_in::<T>().all_finite)(&vertices[own]) {
            return false;
        }
        *out = sum.saturated().canonical();
    }
    true
}

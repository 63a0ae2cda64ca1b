//! Which bounds meet those of a row, one after another or in a tree.
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::boxes::BOUNDS;
use crate::kernels::cpu::lane::{Lane, TILE, Tiles};
use crate::kernels::real::Real;

/// The places of the ones in a byte.
static PLACES: [[u8; 8]; 256] = {
    let mut places = [[0; 8]; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut bit, mut count) = (0, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                places[byte][count] = bit as u8;
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    places
};

/// Which of a tile's bounds meet those of a row, as bits.
#[inline(always)]
fn meeting<T: Real, V: Vector<T>>(row: &[V; BOUNDS], tile: &[Lane<T>; BOUNDS]) -> u32 {
    let mut bits = 0;
    let mut at = 0;
    while at < TILE {
        let meet = V::read(&tile[0], at).at_most(row[2])
            & V::read(&tile[1], at).at_most(row[3])
            & row[0].at_most(V::read(&tile[2], at))
            & row[1].at_most(V::read(&tile[3], at));
        bits |= V::bits(meet) << at;
        at += V::WIDTH;
    }
    bits
}

#[inline(always)]
fn splat<T: Real, V: Vector<T>>(row: &[T; BOUNDS]) -> [V; BOUNDS] {
    [
        V::splat(row[0]),
        V::splat(row[1]),
        V::splat(row[2]),
        V::splat(row[3]),
    ]
}

/// Writes the index of every item whose bounds meet those of the row, ascending from `first` for the
/// first item; how many they are. There is room for sixteen more than there are items.
#[inline(always)]
pub(crate) fn near<T: Real, V: Vector<T>>(
    row: &[T; BOUNDS],
    bounds: Tiles<'_, T>,
    first: u32,
    hits: &mut [u32],
) -> usize {
    let row = splat::<T, V>(row);
    let (mut base, mut count) = (first, 0);
    for tile in bounds.lanes.as_chunks::<BOUNDS>().0 {
        let bits = meeting(&row, tile);
        let Some(room) = hits.get_mut(count..).and_then(|x| x.first_chunk_mut()) else {
            return count;
        };
        count += places(bits, base, room);
        base += TILE as u32;
    }
    count
}

/// Writes the places of the ones among sixteen bits, plus a base; how many they are.
#[inline(always)]
fn places(bits: u32, base: u32, room: &mut [u32; TILE]) -> usize {
    let (low, high) = ((bits & 0xff) as usize, (bits >> 8 & 0xff) as usize);
    let few = low.count_ones() as usize;
    let mut i = 0;
    while i < 8 {
        room[i] = base + u32::from(PLACES[low][i]);
        i += 1;
    }
    // At most eight before them.
    if let Some(room) = room[few..].first_chunk_mut::<8>() {
        i = 0;
        while i < 8 {
            room[i] = base + 8 + u32::from(PLACES[high][i]);
            i += 1;
        }
    }
    few + high.count_ones() as usize
}

/// Adds the index of every item of a tree of bounds that meets those of the row. Level 0 has the
/// items, in the tree's order; each box of a higher level bounds a tile of the one below.
#[inline(always)]
pub(crate) fn search<T: Real, V: Vector<T>>(
    row: &[T; BOUNDS],
    levels: &[Vec<Lane<T>>],
    order: &[u32],
    hits: &mut Vec<u32>,
) {
    let row = splat::<T, V>(row);
    // What is left to look at: levels and tiles. Each level leaves at most fifteen behind.
    let mut waiting = [(0_usize, 0_usize); 16 * 8];
    let mut count = 0;
    let top = levels.len().wrapping_sub(1);
    for t in 0..levels.last().map_or(0, |level| level.len() / BOUNDS) {
        waiting[0] = (top, t);
        count += 1;
        while count > 0 {
            count -= 1;
            let (level, t) = waiting[count];
            let Some(tile) = levels[level].as_chunks::<BOUNDS>().0.get(t) else {
                continue;
            };
            let mut bits = meeting(&row, tile);
            while bits != 0 {
                let child = t * TILE + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                if level == 0 {
                    if let Some(&item) = order.get(child) {
                        hits.push(item);
                    }
                } else if let Some(next) = waiting.get_mut(count) {
                    *next = (level - 1, child);
                    count += 1;
                }
            }
        }
    }
}

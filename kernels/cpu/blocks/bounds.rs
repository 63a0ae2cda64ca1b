//! Searches for bounds that meet a row's, in a list or in a tree.
use crate::Real;
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, TILE, Tiles};
use crate::kernels::cpu::overlaps::BOUNDS;

/// For every byte the positions of its one bits.
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

/// Returns one bit per bound of a tile: `1` if it meets that of the row.
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

/// Writes the index of every item whose bounds meet the row's, ascending; the first item has index `first`. Returns
/// their number. `hits` has room for sixteen more indices than there are items.
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

/// Writes the positions of the one bits among sixteen, plus a base. Returns their number.
#[inline(always)]
fn places(bits: u32, base: u32, room: &mut [u32; TILE]) -> usize {
    let (low, high) = ((bits & 0xff) as usize, (bits >> 8 & 0xff) as usize);
    let few = low.count_ones() as usize;
    let mut i = 0;
    while i < 8 {
        room[i] = base + u32::from(PLACES[low][i]);
        i += 1;
    }
    // The low byte has at most eight.
    if let Some(room) = room[few..].first_chunk_mut::<8>() {
        i = 0;
        while i < 8 {
            room[i] = base + 8 + u32::from(PLACES[high][i]);
            i += 1;
        }
    }
    few + high.count_ones() as usize
}

/// Finds every item of a tree whose bounds meet the row's. Level 0 has the items, in the tree's order. Each box of a
/// higher level bounds a tile of the level below, up to a single tile. Indices found are written level by level.
/// Returns the range of the indices of level 0, the items.
///
/// There is no branch per item, since it would be unpredictable. `room` grows as needed.
#[inline(always)]
pub(crate) fn search<T: Real, V: Vector<T>>(
    row: &[T; BOUNDS],
    levels: &[Vec<Lane<T>>],
    room: &mut Vec<u32>,
) -> [usize; 2] {
    let row = splat::<T, V>(row);
    if room.is_empty() {
        room.resize(16 * TILE, 0);
    }
    // The only tile of the highest level.
    room[0] = 0;
    let (mut start, mut end) = (0, 1);
    for level in levels.iter().rev() {
        let tiles = level.as_chunks::<BOUNDS>().0;
        let mut to = end;
        for i in start..end {
            let t = room[i];
            if room.len() < to + TILE {
                room.resize(2 * room.len(), 0);
            }
            let to_fill = room.get_mut(to..).and_then(|x| x.first_chunk_mut());
            if let (Some(tile), Some(room)) = (tiles.get(t as usize), to_fill) {
                to += places(meeting(&row, tile), t * TILE as u32, room);
            }
        }
        (start, end) = (end, to);
    }
    [start, end]
}

//! Block kernels that know nothing of operations: rows into tiles and back, what bounds tell, sums.
//!
//! Compiled in this library only, by the entries in `arch`.
use crate::Mask;
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::boxes::BOUNDS;
use crate::kernels::cpu::lane::{Lane, Planes, TILE, Tiles};
use crate::kernels::real::Real;

/// Numbers that are brought and taken together.
pub(crate) const QUAD: usize = 4;

/// Where a quad of so many fields begins: one after another, the last one as late as it may.
#[inline(always)]
const fn quad_start(quad: usize, fields: usize) -> usize {
    let (next, last) = (quad * QUAD, fields - QUAD);
    if next < last { next } else { last }
}

/// Four numbers of an item, in one piece.
#[inline(always)]
fn quad_of<T: Real, const FIELDS: usize>(item: &[T; FIELDS], start: usize) -> [T; QUAD] {
    match item[start..].first_chunk() {
        Some(quad) => *quad,
        None => [T::default(); QUAD],
    }
}

/// Items one after another, so many numbers each, into tiles. The last tile is filled up with the
/// last item.
#[inline(always)]
pub(crate) fn bring<T: Real, V: Vector<T>>(rows: &[T], fields: usize, out: &mut [Lane<T>]) {
    let count = rows.len() / fields;
    // The number of fields is a constant of the usual loops: one check for sixteen items.
    let whole = match fields {
        1 => bring_few::<T, 1>(rows, out),
        2 => bring_few::<T, 2>(rows, out),
        3 => bring_few::<T, 3>(rows, out),
        4 => bring_tiles::<T, V, 4>(rows, out),
        5 => bring_tiles::<T, V, 5>(rows, out),
        6 => bring_tiles::<T, V, 6>(rows, out),
        7 => bring_tiles::<T, V, 7>(rows, out),
        8 => bring_tiles::<T, V, 8>(rows, out),
        10 => bring_tiles::<T, V, 10>(rows, out),
        _ => 0,
    };
    // What is left over.
    for (i, row) in rows.chunks_exact(fields).enumerate().skip(whole * TILE) {
        for (lane, &x) in out[i / TILE * fields..].iter_mut().zip(row) {
            lane.0[i % TILE] = x;
        }
    }
    let used = count % TILE;
    if used > 0 {
        for lane in out[count / TILE * fields..].iter_mut().take(fields) {
            let last = lane.0[used - 1];
            lane.0[used..].fill(last);
        }
    }
}

/// Whole tiles; how many.
#[inline(always)]
fn bring_tiles<T: Real, V: Vector<T>, const FIELDS: usize>(
    rows: &[T],
    out: &mut [Lane<T>],
) -> usize {
    let groups = rows.as_chunks::<FIELDS>().0.as_chunks::<TILE>().0;
    for (items, tile) in groups.iter().zip(out.as_chunks_mut::<FIELDS>().0) {
        let mut quad = 0;
        while quad * QUAD < FIELDS {
            let start = quad_start(quad, FIELDS);
            let mut at = 0;
            while at < TILE {
                let parts = V::from_items(
                    #[inline(always)]
                    |i| quad_of(&items[(at + i) % TILE], start),
                );
                let mut k = 0;
                while k < QUAD {
                    parts[k].write(&mut tile[start + k], at);
                    k += 1;
                }
                at += V::WIDTH;
            }
            quad += 1;
        }
    }
    groups.len()
}

/// Whole tiles of items of less than four numbers; how many.
#[inline(always)]
fn bring_few<T: Real, const FIELDS: usize>(rows: &[T], out: &mut [Lane<T>]) -> usize {
    let groups = rows.as_chunks::<FIELDS>().0.as_chunks::<TILE>().0;
    for (items, tile) in groups.iter().zip(out.as_chunks_mut::<FIELDS>().0) {
        let mut k = 0;
        while k < FIELDS {
            let mut i = 0;
            while i < TILE {
                tile[k].0[i] = items[i][k];
                i += 1;
            }
            k += 1;
        }
    }
    groups.len()
}

/// Some fields of results into rows of so many numbers: field `k` of an item goes to `row[k]`. Rows
/// keep what they have beyond `fields`.
#[inline(always)]
pub(crate) fn take<T: Real, V: Vector<T>>(
    results: Planes<'_, T>,
    fields: usize,
    rows: &mut [T],
    stride: usize,
) {
    let whole = match (fields, stride) {
        (1, 1) => {
            let (groups, _) = rows.as_chunks_mut::<TILE>();
            for (group, lane) in groups.iter_mut().zip(results.0) {
                *group = lane.0;
            }
            groups.len()
        }
        (4, 4) => take_tiles::<T, V, 4>(results, rows),
        (5, 5) => take_tiles::<T, V, 5>(results, rows),
        (6, 6) => take_tiles::<T, V, 6>(results, rows),
        (7, 7) => take_tiles::<T, V, 7>(results, rows),
        (8, 8) => take_tiles::<T, V, 8>(results, rows),
        _ => 0,
    };
    for (i, row) in rows.chunks_exact_mut(stride).enumerate().skip(whole * TILE) {
        for (k, x) in row.iter_mut().enumerate().take(fields) {
            *x = results.field(k)[i / TILE].0[i % TILE];
        }
    }
}

/// Whole tiles; how many.
#[inline(always)]
fn take_tiles<T: Real, V: Vector<T>, const FIELDS: usize>(
    results: Planes<'_, T>,
    rows: &mut [T],
) -> usize {
    let groups = rows.as_chunks_mut::<FIELDS>().0.as_chunks_mut::<TILE>().0;
    let mut whole = 0;
    for items in groups {
        let Some(tile) = tile_of::<T, FIELDS>(results, whole) else {
            break;
        };
        let mut at = 0;
        while at < TILE {
            let mut quad = 0;
            while quad * QUAD < FIELDS {
                let start = quad_start(quad, FIELDS);
                let parts = [
                    V::read(tile[start], at),
                    V::read(tile[start + 1], at),
                    V::read(tile[start + 2], at),
                    V::read(tile[start + 3], at),
                ];
                V::to_items(
                    parts,
                    #[inline(always)]
                    |i, numbers| {
                        let item = &mut items[(at + i) % TILE];
                        if let Some(quad) = item[start..].first_chunk_mut() {
                            *quad = numbers;
                        }
                    },
                );
                quad += 1;
            }
            at += V::WIDTH;
        }
        whole += 1;
    }
    whole
}

/// The first fields of a tile of results.
#[inline(always)]
fn tile_of<'a, T: Real, const FIELDS: usize>(
    results: Planes<'a, T>,
    t: usize,
) -> Option<[&'a Lane<T>; FIELDS]> {
    let mut tile = [results.0.get(t)?; FIELDS];
    let mut k = 1;
    while k < FIELDS {
        tile[k] = results.field(k).get(t)?;
        k += 1;
    }
    Some(tile)
}

/// Items picked from rows of `stride` numbers, a multiple of four, into tiles of so many fields. The
/// last tile is filled up with the last item.
#[inline(always)]
pub(crate) fn gather<T: Real, V: Vector<T>>(
    rows: &[T],
    stride: usize,
    picked: &[u32],
    fields: usize,
    out: &mut [Lane<T>],
) {
    match stride / QUAD {
        1 => gather_quads::<T, V, 1>(rows, picked, fields, out),
        2 => gather_quads::<T, V, 2>(rows, picked, fields, out),
        3 => gather_quads::<T, V, 3>(rows, picked, fields, out),
        _ => {
            for (k, &item) in picked.iter().enumerate() {
                let row = &rows[item as usize * stride..];
                for (lane, &x) in out[k / TILE * fields..].iter_mut().zip(row).take(fields) {
                    lane.0[k % TILE] = x;
                }
            }
            // What fills up the last tile must be valid; the last item is at hand.
            if let (Some(&last), used @ 1..) = (picked.last(), picked.len() % TILE) {
                let row = &rows[last as usize * stride..];
                let tile = &mut out[picked.len() / TILE * fields..];
                for (lane, &x) in tile.iter_mut().zip(row).take(fields) {
                    lane.0[used..].fill(x);
                }
            }
        }
    }
}

#[inline(always)]
fn gather_quads<T: Real, V: Vector<T>, const QUADS: usize>(
    rows: &[T],
    picked: &[u32],
    fields: usize,
    out: &mut [Lane<T>],
) {
    let Some(&last) = picked.last() else { return };
    let items = rows.as_chunks::<QUAD>().0.as_chunks::<QUADS>().0;
    let Some(mut own) = items.get(last as usize).map(|last| [last; TILE]) else {
        return;
    };
    for (picked, tile) in picked.chunks(TILE).zip(out.chunks_exact_mut(fields)) {
        match picked.first_chunk::<TILE>() {
            Some(picked) => {
                let mut i = 0;
                while i < TILE {
                    let Some(item) = items.get(picked[i] as usize) else {
                        return;
                    };
                    own[i] = item;
                    i += 1;
                }
            }
            None => {
                for (i, own) in own.iter_mut().enumerate() {
                    let picked = *picked.get(i).unwrap_or(&last);
                    *own = &items[picked as usize];
                }
            }
        }
        let mut at = 0;
        while at < TILE {
            let mut quad = 0;
            while quad < QUADS {
                let parts = V::from_items(
                    #[inline(always)]
                    |i| own[(at + i) % TILE][quad],
                );
                // The last quad may have numbers that only fill it up.
                for (part, lane) in parts.into_iter().zip(&mut tile[quad * QUAD..]) {
                    part.write(lane, at);
                }
                quad += 1;
            }
            at += V::WIDTH;
        }
    }
}

/// One item of a tile in every place of another.
#[inline(always)]
pub(crate) fn spread<T: Real, V: Vector<T>>(from: &[Lane<T>], item: usize, tile: &mut [Lane<T>]) {
    for (lane, from) in tile.iter_mut().zip(from) {
        let x = V::splat(from.0[item % TILE]);
        let mut at = 0;
        while at < TILE {
            x.write(lane, at);
            at += V::WIDTH;
        }
    }
}

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

/// Adds the slopes of results: to a row's sixteen sums per field of the first shape, and to the sums of
/// every column.
///
/// Results are a value, then `fields[0]` and `fields[1]` slopes; column sums are tiles.
#[inline(always)]
pub(crate) fn accumulate<T: Real, V: Vector<T>>(
    results: Planes<'_, T>,
    fields: [usize; 2],
    count: usize,
    row_sums: &mut [Lane<T>],
    column_sums: &mut [Lane<T>],
) {
    // What fills up the last tile does not count.
    let (whole, used) = (count / TILE, count % TILE);
    let part = |slope: &Lane<T>| {
        let mut part = Lane([T::default(); TILE]);
        part.0[..used].copy_from_slice(&slope.0[..used]);
        part
    };
    // Field after field: a row's sum stays in a register.
    for (k, sum) in row_sums.iter_mut().enumerate().take(fields[0]) {
        let slopes = results.field(1 + k);
        let mut at = 0;
        while at < TILE {
            let mut total = V::read(sum, at);
            for slope in slopes.iter().take(whole) {
                total += V::read(slope, at);
            }
            if let (1.., Some(slope)) = (used, slopes.get(whole)) {
                total += V::read(&part(slope), at);
            }
            total.write(sum, at);
            at += V::WIDTH;
        }
    }
    for k in 0..fields[1] {
        let slopes = results.field(1 + fields[0] + k);
        let mut add = |t: usize, slope: &Lane<T>| {
            if let Some(sum) = column_sums.get_mut(t * fields[1] + k) {
                let mut at = 0;
                while at < TILE {
                    (V::read(sum, at) + V::read(slope, at)).write(sum, at);
                    at += V::WIDTH;
                }
            }
        };
        for (t, slope) in slopes.iter().enumerate().take(whole) {
            add(t, slope);
        }
        if let (1.., Some(slope)) = (used, slopes.get(whole)) {
            add(whole, &part(slope));
        }
    }
}

/// Results of picked columns, put into one row of numbers per field, each `stride` after the one
/// before; `first` is the column where rows begin. Other numbers stay.
#[inline(always)]
pub(crate) fn scatter<T: Real, V: Vector<T>>(
    results: Planes<'_, T>,
    columns: &[u32],
    first: usize,
    rows: &mut [T],
    stride: usize,
) {
    for (k, row) in rows.chunks_mut(stride).enumerate() {
        for (columns, lane) in columns.chunks(TILE).zip(results.field(k)) {
            for (&j, &x) in columns.iter().zip(&lane.0) {
                if let Some(place) = row.get_mut((j as usize).wrapping_sub(first)) {
                    *place = x;
                }
            }
        }
    }
}

/// [`accumulate`] for picked columns. Sums lie item by item: numbers of a column, or of one of a
/// row's sixteen sums, side by side, as many as are a multiple of four.
#[inline(always)]
pub(crate) fn accumulate_picked<T: Real, V: Vector<T>>(
    results: Planes<'_, T>,
    fields: [usize; 2],
    columns: &[u32],
    row_sums: &mut [Lane<T>],
    column_sums: &mut [Lane<T>],
) {
    match fields {
        [5, 5] => add_picked::<T, V, 5, 2, 5, 2>(results, columns, row_sums, column_sums),
        [4, 4] => add_picked::<T, V, 4, 1, 4, 1>(results, columns, row_sums, column_sums),
        _ => {
            let strides = fields.map(|n| n.next_multiple_of(QUAD));
            for (k, &j) in columns.iter().enumerate() {
                let j = j as usize;
                let add = |sums: &mut [Lane<T>], at: usize, first: usize, count: usize| {
                    for field in 0..count {
                        let at = at + field;
                        let slope = results.field(first + field)[k / TILE].0[k % TILE];
                        sums[at / TILE].0[at % TILE] += slope;
                    }
                };
                add(row_sums, j % TILE * strides[0], 1, fields[0]);
                add(column_sums, j * strides[1], 1 + fields[0], fields[1]);
            }
        }
    }
}

/// Adds a quad of numbers to one in lanes.
#[inline(always)]
fn add_quad<T: Real>(lanes: &mut [Lane<T>], quad: usize, slopes: &[T; QUAD]) {
    let Some(lane) = lanes.get_mut(quad / QUAD) else {
        return;
    };
    let sums = &mut lane.0.as_chunks_mut::<QUAD>().0[quad % QUAD];
    let mut i = 0;
    while i < QUAD {
        sums[i] += slopes[i];
        i += 1;
    }
}

#[inline(always)]
fn add_picked<
    T: Real,
    V: Vector<T>,
    const A: usize,
    const QUADS_A: usize,
    const B: usize,
    const QUADS_B: usize,
>(
    results: Planes<'_, T>,
    columns: &[u32],
    row_sums: &mut [Lane<T>],
    column_sums: &mut [Lane<T>],
) {
    let zero = [T::default(); QUAD];
    let (mut of_row, mut of_column) = ([[zero; QUADS_A]; TILE], [[zero; QUADS_B]; TILE]);
    for (t, columns) in columns.chunks(TILE).enumerate() {
        items_of::<T, V, A, QUADS_A>(results.from(1), t, &mut of_row);
        items_of::<T, V, B, QUADS_B>(results.from(1 + A), t, &mut of_column);
        for ((&j, of_row), of_column) in columns.iter().zip(&of_row).zip(&of_column) {
            let j = j as usize;
            let mut quad = 0;
            while quad < QUADS_A {
                add_quad(row_sums, j % TILE * QUADS_A + quad, &of_row[quad]);
                quad += 1;
            }
            quad = 0;
            while quad < QUADS_B {
                add_quad(column_sums, j * QUADS_B + quad, &of_column[quad]);
                quad += 1;
            }
        }
    }
}

/// The items of a tile, their numbers side by side; what fills up the last quad is zero.
#[inline(always)]
fn items_of<T: Real, V: Vector<T>, const FIELDS: usize, const QUADS: usize>(
    results: Planes<'_, T>,
    t: usize,
    items: &mut [[[T; QUAD]; QUADS]; TILE],
) {
    let Some(tile) = tile_of::<T, FIELDS>(results, t) else {
        return;
    };
    let zero = V::zero();
    let mut at = 0;
    while at < TILE {
        let mut quad = 0;
        while quad < QUADS {
            let mut parts = [zero; QUAD];
            let mut k = 0;
            while k < QUAD && quad * QUAD + k < FIELDS {
                parts[k] = V::read(tile[quad * QUAD + k], at);
                k += 1;
            }
            V::to_items(
                parts,
                #[inline(always)]
                |i, numbers| items[(at + i) % TILE][quad] = numbers,
            );
            quad += 1;
        }
        at += V::WIDTH;
    }
}

/// Numbers looked at side by side.
const SIDE: usize = 32;

/// The largest of some numbers; minus infinity of none.
#[inline(always)]
pub(crate) fn largest<T: Real, V: Vector<T>>(numbers: &[T]) -> T {
    let least = T::lit(f64::NEG_INFINITY);
    let mut lanes = [least; SIDE];
    let (whole, rest) = numbers.as_chunks::<SIDE>();
    for part in whole {
        for (lane, &x) in lanes.iter_mut().zip(part) {
            *lane = if x > *lane { x } else { *lane };
        }
    }
    let all = lanes.iter().chain(rest);
    all.fold(least, |most, &x| if x > most { x } else { most })
}

/// How many numbers are above a threshold.
#[inline(always)]
pub(crate) fn count_above<T: Real, V: Vector<T>>(numbers: &[T], threshold: T) -> u64 {
    numbers.iter().map(|&x| u64::from(x > threshold)).sum()
}

/// Adds numbers to sixteen sums, number `i` to sum `i` modulo sixteen.
#[inline(always)]
pub(crate) fn add_up<T: Real, V: Vector<T>>(numbers: &[T], sums: &mut [f64; TILE]) {
    let (whole, rest) = numbers.as_chunks::<TILE>();
    for part in whole {
        for (sum, x) in sums.iter_mut().zip(part) {
            *sum += x.widen();
        }
    }
    for (sum, x) in sums.iter_mut().zip(rest) {
        *sum += x.widen();
    }
}

/// Whether every number is finite.
#[allow(clippy::eq_op)]
#[inline(always)]
pub(crate) fn all_finite<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let (whole, rest) = numbers.as_chunks::<TILE>();
    // A finite number less itself is zero, all others less themselves are not numbers. Sums of their
    // own need not wait for each other.
    let mut sums = [V::zero(); 4];
    for numbers in whole {
        let lane = Lane(*numbers);
        for (k, at) in V::starts().enumerate() {
            let x = V::read(&lane, at);
            sums[k % 4] += x - x;
        }
    }
    let sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    sum.equals(V::zero()).all() && rest.iter().all(|x| x.finite())
}

/// Whether every number is finite and none beyond a limit.
#[inline(always)]
pub(crate) fn all_up_to<T: Real, V: Vector<T>>(numbers: &[T], limit: f64) -> bool {
    all_within::<T, V, 1>(numbers, [true], [0.0], [limit])
}

/// Whether the numbers of a lane are zero or within limits, as far as all so far are; `limits` are which
/// ones are signed, and how small and how large they may be.
#[inline(always)]
fn within<T: Real, V: Vector<T>>(
    numbers: &[T; TILE],
    [signed, low, high]: &[Lane<T>; 3],
    mut all: V::Mask,
) -> V::Mask {
    let (numbers, zero) = (Lane(*numbers), V::zero());
    let mut at = 0;
    while at < TILE {
        let x = V::read(&numbers, at);
        let x = V::select(V::read(signed, at).above(zero), x.unsigned(), x);
        all = all & (V::read(low, at).at_most(x) | x.equals(zero)) & x.at_most(V::read(high, at));
        at += V::WIDTH;
    }
    all
}

/// Whether every number is zero or within the limits of its field, for items of so many fields; of
/// signed fields the magnitude.
#[inline(always)]
pub(crate) fn all_within<T: Real, V: Vector<T>, const FIELDS: usize>(
    numbers: &[T],
    signed: [bool; FIELDS],
    low: [f64; FIELDS],
    high: [f64; FIELDS],
) -> bool {
    // Sixteen items are FIELDS lanes, whose limits repeat.
    let limits = |k: usize, of: [f64; FIELDS]| {
        let mut lane = Lane([T::default(); TILE]);
        for (i, x) in lane.0.iter_mut().enumerate() {
            *x = T::lit(of[(k * TILE + i) % FIELDS]);
        }
        lane
    };
    let mut lanes = [[Lane::default(); 3]; FIELDS];
    let signs = signed.map(|signed| if signed { 1.0 } else { 0.0 });
    for (k, lane) in lanes.iter_mut().enumerate() {
        *lane = [limits(k, signs), limits(k, low), limits(k, high)];
    }
    let zero = V::zero();
    let mut all = zero.equals(zero);
    let (whole, rest) = numbers.as_chunks::<TILE>();
    let (groups, few) = whole.as_chunks::<FIELDS>();
    for group in groups {
        let mut k = 0;
        while k < FIELDS {
            all = within::<T, V>(&group[k], &lanes[k], all);
            k += 1;
        }
    }
    for (numbers, limits) in few.iter().zip(&lanes) {
        all = within::<T, V>(numbers, limits, all);
    }
    let done = whole.len() * TILE;
    all.all()
        && rest.iter().enumerate().all(|(i, &x)| {
            let k = (done + i) % FIELDS;
            let (x, low, high) = (if signed[k] { x.unsigned() } else { x }, low[k], high[k]);
            x.at_most(T::lit(high)) && (x.at_least(T::lit(low)) || x.equals(T::default()))
        })
}

/// Whether every axis-aligned box is finite and no lower bound is above its upper one.
#[inline(always)]
pub(crate) fn all_aabb2<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let (items, _) = numbers.as_chunks::<4>();
    let ordered = items
        .iter()
        .fold(true, |all, x| all & x[0].at_most(x[2]) & x[1].at_most(x[3]));
    ordered & all_finite::<T, V>(numbers)
}

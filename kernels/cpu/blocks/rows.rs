//! Transposition of rows of numbers to tiles and back.
use crate::Real;
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, Planes, TILE};

/// The number of fields that are transposed together.
pub(crate) const QUAD: usize = 4;

/// Returns the first field of a quad: quads follow each other, and the last one ends with the last field.
#[inline(always)]
const fn quad_start(quad: usize, fields: usize) -> usize {
    let (next, last) = (quad * QUAD, fields - QUAD);
    if next < last { next } else { last }
}

/// Returns four consecutive numbers of an item.
#[inline(always)]
fn quad_of<T: Real, const FIELDS: usize>(item: &[T; FIELDS], start: usize) -> [T; QUAD] {
    match item[start..].first_chunk() {
        Some(quad) => *quad,
        None => [T::default(); QUAD],
    }
}

/// Writes items of `fields` numbers each into tiles. The last item fills up the last tile.
#[inline(always)]
pub(crate) fn bring<T: Real, V: Vector<T>>(rows: &[T], fields: usize, out: &mut [Lane<T>]) {
    let count = rows.len() / fields;
    // A constant number of fields needs one bounds check for sixteen items.
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
        0 => 0,
        _ => bring_wide::<T, V>(rows, fields, out),
    };
    // The items after the last whole tile.
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

/// Writes the whole tiles of items. Returns their number.
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

/// Writes the whole tiles of items with nine numbers or more. Returns their number.
#[inline(always)]
fn bring_wide<T: Real, V: Vector<T>>(rows: &[T], fields: usize, out: &mut [Lane<T>]) -> usize {
    let groups = rows.chunks_exact(TILE * fields);
    let whole = groups.len();
    for (items, tile) in groups.zip(out.chunks_exact_mut(fields)) {
        let mut next = 0;
        while next < fields {
            let start = next.min(fields - QUAD);
            let lanes = tile
                .get_mut(start..)
                .and_then(|tile| tile.first_chunk_mut::<QUAD>());
            let Some(lanes) = lanes else {
                return 0;
            };
            let mut at = 0;
            while at < TILE {
                let parts = V::from_items(
                    #[inline(always)]
                    |i| {
                        let item = items.get((at + i) % TILE * fields + start..);
                        match item.and_then(|item| item.first_chunk()) {
                            Some(quad) => *quad,
                            None => [T::default(); QUAD],
                        }
                    },
                );
                let mut k = 0;
                while k < QUAD {
                    parts[k].write(&mut lanes[k], at);
                    k += 1;
                }
                at += V::WIDTH;
            }
            next += QUAD;
        }
    }
    whole
}

/// Writes the whole tiles of items with fewer than four numbers. Returns their number.
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

/// Writes the first fields of results into rows of `stride` numbers: field `k` of an item goes to `row[k]`. Numbers of
/// a row beyond `fields` keep their values.
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
        (9.., _) if fields == stride => take_wide::<T, V>(results, fields, rows),
        _ => 0,
    };
    for (i, row) in rows.chunks_exact_mut(stride).enumerate().skip(whole * TILE) {
        for (k, x) in row.iter_mut().enumerate().take(fields) {
            *x = results.field(k)[i / TILE].0[i % TILE];
        }
    }
}

/// Writes whole tiles into rows. Returns their number.
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

/// Writes whole tiles into rows of nine numbers or more. Returns their number.
#[inline(always)]
fn take_wide<T: Real, V: Vector<T>>(
    results: Planes<'_, T>,
    fields: usize,
    rows: &mut [T],
) -> usize {
    let mut whole = 0;
    for items in rows.chunks_exact_mut(TILE * fields) {
        let mut next = 0;
        while next < fields {
            let start = next.min(fields - QUAD);
            let mut at = 0;
            while at < TILE {
                let mut parts = [V::splat(T::default()); QUAD];
                let mut k = 0;
                while k < QUAD {
                    let Some(lane) = results.field(start + k).get(whole) else {
                        return whole;
                    };
                    parts[k] = V::read(lane, at);
                    k += 1;
                }
                V::to_items(
                    parts,
                    #[inline(always)]
                    |i, numbers| {
                        let item = items.get_mut((at + i) % TILE * fields + start..);
                        if let Some(quad) = item.and_then(|item| item.first_chunk_mut()) {
                            *quad = numbers;
                        }
                    },
                );
                at += V::WIDTH;
            }
            next += QUAD;
        }
        whole += 1;
    }
    whole
}

/// Returns the first fields of a tile of results.
#[inline(always)]
pub(super) fn tile_of<'a, T: Real, const FIELDS: usize>(
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

/// Gathers items from rows of `stride` numbers, a multiple of four, into tiles of `fields` fields. The last item fills
/// up the last tile.
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
            // The padding of the last tile must be valid shapes: it repeats the last item.
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
    let Some(own_last) = items.get(last as usize) else {
        return;
    };
    let mut own = [own_last; TILE];
    for (t, picked) in picked.chunks(TILE).enumerate() {
        let Some(tile) = out.get_mut(t * fields..(t + 1) * fields) else {
            return;
        };
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
            // The last tile, four places at a time. The number of items is unpredictable, so the padding repeats the
            // last item without a branch.
            None => {
                own = [own_last; TILE];
                let end = picked.len().wrapping_sub(1);
                for (group, own) in own.as_chunks_mut::<4>().0.iter_mut().enumerate() {
                    if 4 * group >= picked.len() {
                        break;
                    }
                    let mut i = 0;
                    while i < 4 {
                        let place = picked.get((4 * group + i).min(end)).unwrap_or(&last);
                        let Some(item) = items.get(*place as usize) else {
                            return;
                        };
                        own[i] = item;
                        i += 1;
                    }
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
                // The last quad may have padding.
                for (part, lane) in parts.into_iter().zip(&mut tile[quad * QUAD..]) {
                    part.write(lane, at);
                }
                quad += 1;
            }
            at += V::WIDTH;
        }
    }
}

/// Broadcasts one item of a tile to all places of another tile.
#[inline(always)]
pub(crate) fn broadcast<T: Real, V: Vector<T>>(
    from: &[Lane<T>],
    item: usize,
    tile: &mut [Lane<T>],
) {
    for (lane, from) in tile.iter_mut().zip(from) {
        let x = V::splat(from.0[item % TILE]);
        let mut at = 0;
        while at < TILE {
            x.write(lane, at);
            at += V::WIDTH;
        }
    }
}

/// Writes the results of picked columns into one row of numbers per field. Rows are `stride` numbers apart and begin
/// with column `first`. Other numbers keep their values.
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

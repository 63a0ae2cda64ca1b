//! Sums of derivatives of all pairs, in an order that depends neither on vectors nor on skipped pairs.
use super::rows::{QUAD, tile_of};
use crate::Real;
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, Planes, TILE};

/// Adds the derivatives of results: to a row's sixteen sums per field of the first shape, and to the sums of
/// every column.
///
/// A result is a value, then `fields[0]` and `fields[1]` derivatives; column sums are in tiles.
#[inline(always)]
pub(crate) fn accumulate<T: Real, V: Vector<T>>(
    results: Planes<'_, T>,
    fields: [usize; 2],
    count: usize,
    row_sums: &mut [Lane<T>],
    column_sums: &mut [Lane<T>],
) {
    // The padding of the last tile does not count.
    let (whole, used) = (count / TILE, count % TILE);
    let part = |derivative: &Lane<T>| {
        let mut part = Lane([T::default(); TILE]);
        part.0[..used].copy_from_slice(&derivative.0[..used]);
        part
    };
    // Field by field, a row's sum stays in a register.
    for (k, sum) in row_sums.iter_mut().enumerate().take(fields[0]) {
        let derivatives = results.field(1 + k);
        let mut at = 0;
        while at < TILE {
            let mut total = V::read(sum, at);
            for derivative in derivatives.iter().take(whole) {
                total += V::read(derivative, at);
            }
            if let (1.., Some(derivative)) = (used, derivatives.get(whole)) {
                total += V::read(&part(derivative), at);
            }
            total.write(sum, at);
            at += V::WIDTH;
        }
    }
    for k in 0..fields[1] {
        let derivatives = results.field(1 + fields[0] + k);
        let mut add = |t: usize, derivative: &Lane<T>| {
            if let Some(sum) = column_sums.get_mut(t * fields[1] + k) {
                let mut at = 0;
                while at < TILE {
                    (V::read(sum, at) + V::read(derivative, at)).write(sum, at);
                    at += V::WIDTH;
                }
            }
        };
        for (t, derivative) in derivatives.iter().enumerate().take(whole) {
            add(t, derivative);
        }
        if let (1.., Some(derivative)) = (used, derivatives.get(whole)) {
            add(whole, &part(derivative));
        }
    }
}

/// Accumulates as [`accumulate`], for picked columns. Sums lie item by item: the numbers of a column, or of one of a
/// row's sixteen sums, are contiguous and padded to a multiple of four.
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
                        let derivative = results.field(first + field)[k / TILE].0[k % TILE];
                        sums[at / TILE].0[at % TILE] += derivative;
                    }
                };
                add(row_sums, j % TILE * strides[0], 1, fields[0]);
                add(column_sums, j * strides[1], 1 + fields[0], fields[1]);
            }
        }
    }
}

/// Adds four derivatives to quad number `quad` of the lanes.
#[inline(always)]
fn add_quad<T: Real>(lanes: &mut [Lane<T>], quad: usize, derivatives: &[T; QUAD]) {
    let Some(lane) = lanes.get_mut(quad / QUAD) else {
        return;
    };
    let sums = &mut lane.0.as_chunks_mut::<QUAD>().0[quad % QUAD];
    let mut i = 0;
    while i < QUAD {
        sums[i] += derivatives[i];
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

/// Writes the items of a tile, each with its numbers contiguous; the padding of the last quad is zero.
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

//! A program over rows of numbers: rows to slots, instructions, slots to rows.
//!
//! Rows are transposed to slots and back in registers, four fields at a time, without a tile in between.
use super::execute::{CarryOut, Memory, STRIP};
use crate::Real;
use crate::kernels::cpu::arch::memory::prefetch;
use crate::kernels::cpu::arch::{Native, Vector};
use crate::kernels::cpu::blocks::QUAD;
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::kernels::cpu::program::instructions::AHEAD;
use crate::kernels::cpu::program::lower::Tape;
use crate::kernels::row::item::STRETCH;
use std::cell::Cell;

/// The size in bytes up to which the arguments and results of a batch stay in a core's own cache. Prefetching them
/// costs a short program a twentieth of its time.
pub(crate) const NEAR: usize = 1 << 18;

/// An argument of a batch: one row per item, or one that stands for all.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArgumentRows<'a, T> {
    pub(crate) rows: &'a [T],
    /// The number of scalars of a row, at least one.
    pub(crate) fields: usize,
    pub(crate) is_one: bool,
}

/// The results of a batch: rows, `None` if they are not wanted, and the number of scalars of a row.
pub(crate) type ResultRows<'a, T> = (Option<&'a mut [T]>, usize);

/// A range of items of a batch.
#[derive(Clone, Copy)]
pub(crate) struct RowRange<'a, T> {
    /// The lanes of all slots, and the number of lanes of one.
    pub(crate) lanes: &'a [Cell<Lane<T>>],
    pub(crate) stride: usize,
    pub(crate) given: &'a [ArgumentRows<'a, T>],
    /// The first item, and the number of items.
    pub(crate) first: usize,
    pub(crate) items: usize,
    /// The number of results of the program before the wanted ones.
    pub(crate) skipped: usize,
    /// `true` if rows are prefetched.
    pub(crate) far: bool,
    pub(crate) native: Option<&'a Native>,
    /// The executor of instructions.
    pub(crate) carry_out: CarryOut<T>,
}

/// Executes a program on some items.
#[inline(always)]
pub(crate) fn over_rows<T: Real, V: Vector<T>>(
    tape: &Tape,
    part: RowRange<'_, T>,
    wanted: &mut [ResultRows<'_, T>],
) {
    let tiles = part.items.div_ceil(TILE);
    let memory = Memory {
        lanes: part.lanes,
        width: tiles.next_multiple_of(STRIP),
        stride: part.stride,
    };
    let mut native = part
        .native
        .and_then(|native| native.bind(part.lanes, part.items));
    // Columns of numbers are read in place if they fill whole strips.
    let full = memory.width * TILE == part.items;
    let mut first = 0;
    for given in part.given {
        let Some(slots) = tape.inputs.get(first..first + given.fields) else {
            return;
        };
        match (&mut native, part.native) {
            (Some(bound), Some(native))
                if full && slots.len() == 1 && !given.is_one && native.has_input(first) =>
            {
                let numbers = given.rows.get(part.first..part.first + part.items);
                bound.lend(first, numbers.unwrap_or_default());
            }
            _ => bring::<T, V>(memory, slots, given, &part),
        }
        first += given.fields;
    }
    let is_lent = |first: usize, fields: usize| {
        full && fields == 1 && part.native.is_some_and(|native| native.has_output(first))
    };
    let mut first = part.skipped;
    for (rows, fields) in &mut *wanted {
        if let (Some(native), true) = (&mut native, is_lent(first, *fields))
            && let Some(numbers) = part.of(rows, 1)
        {
            native.lend_mut(first, numbers);
        }
        first += *fields;
    }
    (part.carry_out)(&tape.code, memory, native.as_ref());
    let mut first = part.skipped;
    for (rows, fields) in wanted {
        let slots = tape.outputs.get(first..first + *fields);
        if let (Some(slots), false) = (slots, is_lent(first, *fields))
            && let Some(rows) = part.of(rows, *fields)
        {
            take::<T, V>(memory, slots, rows, part.far);
        }
        first += *fields;
    }
}

impl<T> RowRange<'_, T> {
    /// Returns the rows of these items.
    fn of<'r>(&self, rows: &'r mut Option<&mut [T]>, fields: usize) -> Option<&'r mut [T]> {
        rows.as_deref_mut()?
            .get_mut(self.first * fields..(self.first + self.items) * fields)
    }
}

/// Calls a function with the number of fields as constant `N` if it is a usual one, which checks sixteen items at once.
/// `N` is 0 for any other number.
macro_rules! by_fields {
    ($fields:expr, $N:ident => $call:expr) => {
        by_fields!(@of $fields, $N => $call; 1 4 5 6 7 8 9 10 11 12 13 14 15 16)
    };
    (@of $fields:expr, $N:ident => $call:expr; $($n:literal)*) => {
        match $fields {
            $($n => {
                const $N: usize = $n;
                $call
            })*
            _ => {
                const $N: usize = 0;
                $call
            }
        }
    };
}

/// Returns the first field of a quad: quads follow each other, and the last one ends with the last field.
#[inline(always)]
const fn quad_start(quad: usize, fields: usize) -> usize {
    let (next, last) = (quad * QUAD, fields - QUAD);
    if next < last { next } else { last }
}

/// Returns four numbers of an item of a tile with `N` fields, or with `fields` fields for `N = 0`.
#[inline(always)]
fn quad_of<T: Real, const N: usize>(
    rows: &[T],
    fields: usize,
    item: usize,
    start: usize,
) -> [T; QUAD] {
    let quad = match N {
        0 => rows
            .get(item * fields + start..)
            .and_then(|item| item.first_chunk()),
        _ => {
            let items = rows.as_chunks::<N>().0.first_chunk::<TILE>();
            items.and_then(|items| items[item % TILE][start..].first_chunk())
        }
    };
    quad.copied().unwrap_or([T::default(); QUAD])
}

/// Returns the lanes of a slot.
#[inline(always)]
fn lanes_of<'a, T>(memory: Memory<'a, T>, slot: u16) -> &'a [Cell<Lane<T>>] {
    memory.slot(slot).as_flattened()
}

/// Transposes rows of some items to the slots of their fields; `None` is an unused field. The last item fills up the
/// last strip.
#[inline(always)]
fn bring<T: Real, V: Vector<T>>(
    memory: Memory<'_, T>,
    slots: &[Option<u16>],
    given: &ArgumentRows<'_, T>,
    part: &RowRange<'_, T>,
) {
    let fields = slots.len();
    if given.is_one {
        for (slot, &x) in slots.iter().zip(given.rows) {
            let &Some(slot) = slot else { continue };
            for lane in lanes_of(memory, slot) {
                lane.set(Lane([x; TILE]));
            }
        }
        return;
    }
    let items = part.first * fields..(part.first + part.items) * fields;
    let Some(rows) = given.rows.get(items).filter(|rows| !rows.is_empty()) else {
        return;
    };
    let whole = rows.chunks_exact(TILE * fields);
    let rest = whole.remainder();
    by_fields!(fields, N => bring_tiles::<T, V, N>(memory, slots, whole, part.far));
    let first = part.items / TILE;
    if first == memory.width {
        return;
    }
    // The last tile is padded; further ones repeat the last item.
    let last = &rows[rows.len() - fields..];
    for (k, slot) in slots.iter().enumerate() {
        let &Some(slot) = slot else { continue };
        for (t, lane) in lanes_of(memory, slot).iter().enumerate().skip(first) {
            let own = if t == first { rest } else { &[] };
            let mut numbers = Lane([last[k]; TILE]);
            for (x, row) in numbers.0.iter_mut().zip(own.chunks_exact(fields)) {
                *x = row[k];
            }
            lane.set(numbers);
        }
    }
}

/// Transposes whole tiles of rows of `N` numbers, or of any number for `N = 0`.
#[inline(always)]
fn bring_tiles<'r, T: Real, V: Vector<T>, const N: usize>(
    memory: Memory<'_, T>,
    slots: &[Option<u16>],
    tiles: impl Iterator<Item = &'r [T]>,
    far: bool,
) {
    let fields = if N == 0 { slots.len() } else { N };
    for (t, rows) in tiles.enumerate() {
        if far {
            prefetch(rows, STRETCH * fields);
        }
        if N == 1 {
            if let (&[Some(slot)], Some(numbers)) = (slots, rows.first_chunk()) {
                lanes_of(memory, slot)[t].set(Lane(*numbers));
            }
            continue;
        }
        if fields < QUAD {
            for (k, slot) in slots.iter().enumerate() {
                let &Some(slot) = slot else { continue };
                let mut lane = Lane::default();
                for (x, row) in lane.0.iter_mut().zip(rows.chunks_exact(fields)) {
                    *x = row[k];
                }
                lanes_of(memory, slot)[t].set(lane);
            }
            continue;
        }
        let mut quad = 0;
        while quad * QUAD < fields {
            let start = quad_start(quad, fields);
            let mut lanes = [Lane::default(); QUAD];
            let mut at = 0;
            while at < TILE {
                let parts = V::from_items(
                    #[inline(always)]
                    |i| quad_of::<T, N>(rows, fields, (at + i) % TILE, start),
                );
                let mut k = 0;
                while k < QUAD {
                    parts[k].write(&mut lanes[k], at);
                    k += 1;
                }
                at += V::WIDTH;
            }
            for (slot, lane) in slots[start..].iter().zip(lanes) {
                if let &Some(slot) = slot {
                    lanes_of(memory, slot)[t].set(lane);
                }
            }
            quad += 1;
        }
    }
}

/// Returns a lane whose zeros have no sign.
#[inline(always)]
fn canonical<T: Real, V: Vector<T>>(from: &Lane<T>) -> Lane<T> {
    let mut to = Lane::default();
    let mut at = 0;
    while at < TILE {
        V::read(from, at).canonical().write(&mut to, at);
        at += V::WIDTH;
    }
    to
}

/// Transposes slots of fields to rows.
#[inline(always)]
fn take<T: Real, V: Vector<T>>(memory: Memory<'_, T>, slots: &[u16], rows: &mut [T], far: bool) {
    let fields = slots.len();
    if fields == 0 {
        return;
    }
    let whole = by_fields!(fields, N => take_tiles::<T, V, N>(memory, slots, rows, far));
    let rest = &mut rows[whole * TILE * fields..];
    for (k, &slot) in slots.iter().enumerate() {
        let Some(lane) = lanes_of(memory, slot).get(whole) else {
            return;
        };
        let lane = canonical::<T, V>(&lane.get());
        for (row, x) in rest.chunks_exact_mut(fields).zip(lane.0) {
            row[k] = x;
        }
    }
}

/// Transposes whole tiles to rows. Returns their number.
#[inline(always)]
fn take_tiles<T: Real, V: Vector<T>, const N: usize>(
    memory: Memory<'_, T>,
    slots: &[u16],
    rows: &mut [T],
    far: bool,
) -> usize {
    let fields = if N == 0 { slots.len() } else { N };
    let mut tiles = 0;
    for rows in rows.chunks_exact_mut(TILE * fields) {
        let t = tiles;
        tiles += 1;
        if far {
            prefetch(rows, AHEAD / size_of::<T>());
        }
        // A closure would not be inlined, and so would be compiled for the baseline.
        macro_rules! lane {
            ($k:expr) => {
                canonical::<T, V>(&lanes_of(memory, slots[$k])[t].get())
            };
        }
        if N == 1 {
            if let Some(numbers) = rows.first_chunk_mut() {
                *numbers = lane!(0).0;
            }
            continue;
        }
        if fields < QUAD {
            for k in 0..fields {
                for (row, x) in rows.chunks_exact_mut(fields).zip(lane!(k).0) {
                    row[k] = x;
                }
            }
            continue;
        }
        let mut quad = 0;
        while quad * QUAD < fields {
            let start = quad_start(quad, fields);
            let own = [
                lane!(start),
                lane!(start + 1),
                lane!(start + 2),
                lane!(start + 3),
            ];
            let mut at = 0;
            while at < TILE {
                let parts = [
                    V::read(&own[0], at),
                    V::read(&own[1], at),
                    V::read(&own[2], at),
                    V::read(&own[3], at),
                ];
                V::to_items(
                    parts,
                    #[inline(always)]
                    |i, numbers| {
                        let item = (at + i) % TILE;
                        let quad = match N {
                            0 => rows
                                .get_mut(item * fields + start..)
                                .and_then(|item| item.first_chunk_mut()),
                            _ => {
                                let items = rows.as_chunks_mut::<N>().0.first_chunk_mut::<TILE>();
                                items.and_then(|items| items[item][start..].first_chunk_mut())
                            }
                        };
                        if let Some(quad) = quad {
                            *quad = numbers;
                        }
                    },
                );
                at += V::WIDTH;
            }
            quad += 1;
        }
    }
    tiles
}

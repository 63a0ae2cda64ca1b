//! All-pairs batches: every row with every row.
use crate::error::{Argument, Error};
use crate::kernels::cpu::{A, B};
use crate::kernels::op::PairOp;
use crate::kernels::real::{Bundle, Real};
use crate::kernels::tile::{
    check, entries, expect, gather, narrow, opaque, run, splat, spread, start_of, store, widened,
    width_of,
};

/// Tiles of columns whose frames are made and kept together: few enough for the innermost cache.
pub(super) const BLOCK: usize = 16;

/// Every row of `a` with every row of `b`: a matrix, row by row.
///
/// # Errors
///
/// [`Error::Invalid`] for a shape that is not valid, [`Error::TooLarge`] when the matrix has more
/// entries than memory has addresses.
///
/// ```
/// use geograd::Aabb2;
/// use geograd::kernels::{cpu, overlap::IouAabb2};
/// let a = [Aabb2::new(0.0, 0.0, 2.0, 2.0)];
/// let b = [Aabb2::new(0.0, 0.0, 2.0, 1.0), Aabb2::new(7.0, 0.0, 9.0, 1.0)];
/// assert_eq!(cpu::all_pairs::<IouAabb2, f64>(&a, &b)?, [0.5, 0.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn all_pairs<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<Vec<T>, Error> {
    let mut values = vec![T::default(); entries(a.len(), b.len(), 1)?];
    all_pairs_into::<O, T>(a, b, &mut values)?;
    Ok(values)
}

/// Rows per piece of work: at most 64 pieces, each of them worth a thread's while. Never depends
/// on the number of threads.
pub(super) fn rows_per_piece(rows: usize) -> usize {
    rows.div_ceil(64).max(16)
}

/// [`all_pairs`] into the caller's buffer.
///
/// # Errors
///
/// As [`all_pairs`], and [`Error::Length`] for a buffer of another length. The buffer is then as it
/// was.
pub fn all_pairs_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
) -> Result<(), Error> {
    expect(
        Argument::Values,
        entries(a.len(), b.len(), 1)?,
        values.len(),
    )?;
    let extreme = check::<O, T>(a, b)?;
    if values.is_empty() {
        return Ok(());
    }
    let (rows, columns) = (rows_per_piece(a.len()), b.len());
    let work = a
        .chunks(rows)
        .zip(values.chunks_mut(rows * columns))
        .collect();
    spread(work, |(a, values): (&[A<O, T>], &mut [T])| {
        block::<O, T>(a, b, extreme, values);
    });
    Ok(())
}

/// A block of the matrix on the calling thread. Nothing is checked, and nothing is empty.
pub(super) fn block<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    extreme: bool,
    values: &mut [T],
) {
    let (columns, width) = (b.len(), width_of::<T>(extreme));
    if let Some(b) = widened(b, width) {
        let mut wide = vec![T::default(); a.len() * width];
        run!(extreme, matrix_values::<O, T>(a, &b, &mut wide));
        narrow(&wide, width, values, columns);
    } else {
        run!(extreme, matrix_values::<O, T>(a, b, values));
    }
}

/// Frames of rows, one by one.
#[inline(always)]
pub(super) fn frames_a<O: PairOp, T: Real>(a: &[A<O, T>]) -> Vec<O::FrameA<T>> {
    a.iter().map(|&shape| O::frame_a(shape)).collect()
}

/// Frames of some tiles of columns, in bundles.
#[inline(always)]
pub(super) fn frames_b<O: PairOp, T: Real, L: Bundle<T>>(
    b: &[B<O, T>],
    tiles: std::ops::Range<usize>,
    frames: &mut Vec<O::FrameB<L>>,
) {
    frames.clear();
    for tile in tiles {
        let shapes: B<O, L> = gather::<T, L, _, _>(&b[start_of::<T, L>(tile, b.len())..]);
        frames.push(O::frame_b(shapes));
    }
}

#[inline(always)]
fn matrix_values<O: PairOp, T: Real, L: Bundle<T>, const EXTREME: bool>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
) {
    let (columns, tiles) = (b.len(), b.len().div_ceil(L::WIDTH));
    let rows = frames_a::<O, T>(a);
    let mut frames = Vec::with_capacity(BLOCK);
    for first in (0..tiles).step_by(BLOCK) {
        frames_b::<O, T, L>(b, first..tiles.min(first + BLOCK), &mut frames);
        for (i, &row) in rows.iter().enumerate() {
            let row: O::FrameA<L> = splat::<T, L, _, _>(row);
            let values = &mut values[i * columns..][..columns];
            for (k, &frame) in frames.iter().enumerate() {
                let start = start_of::<T, L>(first + opaque(k), columns);
                let value = O::value::<L, EXTREME>(row, frame);
                store::<T, L>(value, &mut values[start..]);
            }
        }
    }
}

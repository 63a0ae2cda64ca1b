//! All-pairs batches: every row with every row.
use crate::Fixed;
use crate::error::{Argument, Error};
use crate::kernels::cpu::{A, B, Bars};
use crate::kernels::op::PairOp;
use crate::kernels::real::{Bundle, Real};
use crate::kernels::tile::{
    check, check_upstream, entries, expect, gather, load, narrow, opaque, plus, run, scatter,
    splat, spread, start_of, store, times, widened, width_of, zeros,
};
use std::marker::PhantomData;

/// Tiles of columns whose frames are made and kept together: few enough for the innermost cache.
const BLOCK: usize = 16;

/// No bundle has more lanes.
const MOST_LANES: usize = 16;

/// A value and slopes for every row of one list with every row of another.
///
/// Slopes are kept as planes, one matrix per field of `A`, then one per field of `B`, because that
/// is how a consumer of millions reads them and because the processor can write nothing else at
/// full speed.
#[derive(Clone, Debug, PartialEq)]
pub struct PairGrads<O, T> {
    /// Rows: shapes of the first list.
    pub rows: usize,
    /// Columns: shapes of the second list.
    pub columns: usize,
    /// The results, row by row.
    pub values: Vec<T>,
    /// The slopes: `planes[(k · rows + i) · columns + j]` for field `k`.
    pub planes: Vec<T>,
    operation: PhantomData<O>,
}

impl<O: PairOp, T: Real> PairGrads<O, T> {
    /// Room for the slopes of so many rows and columns.
    ///
    /// # Errors
    ///
    /// [`Error::TooLarge`] when they have more entries than memory has addresses.
    pub fn new(rows: usize, columns: usize) -> Result<Self, Error> {
        let fields = A::<O, T>::LEN + B::<O, T>::LEN;
        Ok(PairGrads {
            rows,
            columns,
            values: vec![T::default(); entries(rows, columns, 1)?],
            planes: vec![T::default(); entries(rows, columns, fields)?],
            operation: PhantomData,
        })
    }
    /// Slopes of pair `(i, j)` with respect to both shapes.
    ///
    /// # Panics
    ///
    /// When there is no such pair.
    #[must_use]
    pub fn at(&self, i: usize, j: usize) -> (A<O, T>, B<O, T>) {
        assert!(
            i < self.rows && j < self.columns,
            "pair ({i}, {j}) out of range"
        );
        let plane = |k: usize| self.planes[(k * self.rows + i) * self.columns + j];
        let (mut of_a, mut of_b) = (
            zeros::<T, A<O, T>>().to_array(),
            zeros::<T, B<O, T>>().to_array(),
        );
        for (k, slope) in of_a.as_mut().iter_mut().enumerate() {
            *slope = plane(k);
        }
        for (k, slope) in of_b.as_mut().iter_mut().enumerate() {
            *slope = plane(A::<O, T>::LEN + k);
        }
        (Fixed::from_array(of_a), Fixed::from_array(of_b))
    }
}

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
fn rows_per_piece(rows: usize) -> usize {
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
    let (rows, columns, width) = (rows_per_piece(a.len()), b.len(), width_of::<T>(extreme));
    let wide_b = widened(b, width);
    let work = a
        .chunks(rows)
        .zip(values.chunks_mut(rows * columns))
        .collect();
    spread(work, |(a, values): (&[A<O, T>], &mut [T])| {
        let mut wide = wide_b.as_ref().map(|_| vec![T::default(); a.len() * width]);
        let to = wide.as_deref_mut().unwrap_or(&mut *values);
        run!(
            extreme,
            matrix_values::<O, T>(a, wide_b.as_deref().unwrap_or(b), to)
        );
        if let Some(wide) = wide {
            narrow(&wide, width, values, columns);
        }
    });
    Ok(())
}

/// Frames of rows, one by one.
#[inline(always)]
fn frames_a<O: PairOp, T: Real>(a: &[A<O, T>]) -> Vec<O::FrameA<T>> {
    a.iter().map(|&shape| O::frame_a(shape)).collect()
}

/// Frames of some tiles of columns, in bundles.
#[inline(always)]
fn frames_b<O: PairOp, T: Real, L: Bundle<T>>(
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

/// [`all_pairs`] with the slopes of every result with respect to both of its shapes.
///
/// # Errors
///
/// As [`all_pairs`].
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{cpu, overlap::IouObb2};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// let grads = cpu::all_pairs_grad::<IouObb2, f64>(&a, &b)?;
/// let (_, b_bar) = grads.at(0, 1);
/// assert!((b_bar.center.x + 4.0 / 9.0).abs() < 1e-15);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn all_pairs_grad<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
) -> Result<PairGrads<O, T>, Error> {
    let mut grads = PairGrads::new(a.len(), b.len())?;
    all_pairs_grad_into::<O, T>(a, b, &mut grads)?;
    Ok(grads)
}

/// [`all_pairs_grad`] into the caller's buffers, made by [`PairGrads::new`].
///
/// # Errors
///
/// As [`all_pairs`], and [`Error::Length`] for buffers of another size. The buffers are then as
/// they were.
pub fn all_pairs_grad_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    grads: &mut PairGrads<O, T>,
) -> Result<(), Error> {
    let fields = A::<O, T>::LEN + B::<O, T>::LEN;
    expect(Argument::Values, a.len(), grads.rows)?;
    expect(Argument::Values, b.len(), grads.columns)?;
    expect(
        Argument::Values,
        entries(a.len(), b.len(), 1)?,
        grads.values.len(),
    )?;
    expect(
        Argument::GradA,
        entries(a.len(), b.len(), fields)?,
        grads.planes.len(),
    )?;
    let extreme = check::<O, T>(a, b)?;
    if grads.values.is_empty() {
        return Ok(());
    }
    let (rows, columns, width) = (rows_per_piece(a.len()), b.len(), width_of::<T>(extreme));
    let wide_b = widened(b, width);
    let values = grads.values.chunks_mut(rows * b.len());
    // Every piece gets its rows of every plane.
    let mut planes: Vec<Vec<&mut [T]>> = Vec::new();
    planes.resize_with(a.len().div_ceil(rows), || Vec::with_capacity(fields));
    for plane in grads.planes.chunks_mut(a.len() * b.len()) {
        for (piece, part) in planes.iter_mut().zip(plane.chunks_mut(rows * b.len())) {
            piece.push(part);
        }
    }
    let work = a.chunks(rows).zip(values).zip(planes).collect();
    spread(
        work,
        |((a, values), mut planes): ((&[A<O, T>], &mut [T]), Vec<&mut [T]>)| {
            let fill = |n: usize| wide_b.as_ref().map(|_| vec![T::default(); n]);
            let mut wide = fill(a.len() * width);
            let mut wide_planes = fill(a.len() * width * fields);
            let to = wide.as_deref_mut().unwrap_or(&mut *values);
            let mut to_planes: Vec<&mut [T]> = match &mut wide_planes {
                Some(wide) => wide.chunks_mut(a.len() * width).collect(),
                None => planes.iter_mut().map(|plane| &mut **plane).collect(),
            };
            run!(
                extreme,
                matrix_grads::<O, T>(a, wide_b.as_deref().unwrap_or(b), to, &mut to_planes)
            );
            if let (Some(wide), Some(wide_planes)) = (wide, wide_planes) {
                narrow(&wide, width, values, columns);
                for (from, to) in wide_planes.chunks(a.len() * width).zip(planes) {
                    narrow(from, width, to, columns);
                }
            }
        },
    );
    Ok(())
}

#[inline(always)]
fn matrix_grads<O: PairOp, T: Real, L: Bundle<T>, const EXTREME: bool>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
    planes: &mut [&mut [T]],
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
                let (value, bars) = O::grad::<L, EXTREME>(row, frame);
                store::<T, L>(value, &mut values[start..]);
                let (of_a, of_b) = planes.split_at_mut(A::<O, T>::LEN);
                store_planes::<T, L>(bars.0.to_array().as_ref(), of_a, i * columns + start);
                store_planes::<T, L>(bars.1.to_array().as_ref(), of_b, i * columns + start);
            }
        }
    }
}

/// Copies a bundle into each plane.
#[inline(always)]
fn store_planes<T: Real, L: Bundle<T>>(bundles: &[L], planes: &mut [&mut [T]], at: usize) {
    for (&bundle, plane) in bundles.iter().zip(planes) {
        store::<T, L>(bundle, &mut plane[at..]);
    }
}

/// The adjoint of [`all_pairs`]: slopes of `Σ upstream[i, j] · result[i, j]` with respect to every
/// shape of both lists. `upstream` is a matrix, row by row.
///
/// # Errors
///
/// As [`all_pairs`], and for an upstream of another size or one that is not finite.
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{cpu, overlap::IouObb2};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// let (a_bar, b_bar) = cpu::all_pairs_vjp::<IouObb2, f64>(&a, &b, &[1.0, 3.0])?;
/// assert!((a_bar[0].center.x - 3.0 * 4.0 / 9.0).abs() < 1e-15);
/// assert_eq!(b_bar[0].center.x, 0.0);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn all_pairs_vjp<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
) -> Result<Bars<O, T>, Error> {
    let (mut a_bar, mut b_bar) = (a.to_vec(), b.to_vec());
    all_pairs_vjp_into::<O, T>(a, b, upstream, &mut a_bar, &mut b_bar)?;
    Ok((a_bar, b_bar))
}

/// [`all_pairs_vjp`] into the caller's buffers.
///
/// Beside the results it holds one partial gradient of `b` per 16 or more rows of `a`: less than
/// the upstream matrix has.
///
/// # Errors
///
/// As [`all_pairs_vjp`], and [`Error::Length`] for a buffer of another length. The buffers are then
/// as they were.
pub fn all_pairs_vjp_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) -> Result<(), Error> {
    expect(
        Argument::Upstream,
        entries(a.len(), b.len(), 1)?,
        upstream.len(),
    )?;
    expect(Argument::GradA, a.len(), a_bar.len())?;
    expect(Argument::GradB, b.len(), b_bar.len())?;
    let extreme = check::<O, T>(a, b)?;
    check_upstream(upstream)?;
    a_bar.fill(zeros());
    b_bar.fill(zeros());
    if upstream.is_empty() {
        return Ok(());
    }
    let (rows, columns, width) = (rows_per_piece(a.len()), b.len(), width_of::<T>(extreme));
    let wide_b = widened(b, width);
    let mut partials = vec![zeros(); a.len().div_ceil(rows) * b.len()];
    let ups = upstream.chunks(rows * b.len());
    let work = a
        .chunks(rows)
        .zip(ups)
        .zip(a_bar.chunks_mut(rows))
        .zip(partials.chunks_mut(b.len()));
    spread(
        work.collect(),
        |(((a, upstream), a_bar), b_bar): (
            ((&[A<O, T>], &[T]), &mut [A<O, T>]),
            &mut [B<O, T>],
        )| {
            // The columns added have no upstream.
            let wide = wide_b.as_ref().map(|_| {
                let mut wide = vec![T::default(); a.len() * width];
                for (to, from) in wide.chunks_mut(width).zip(upstream.chunks(columns)) {
                    to[..columns].copy_from_slice(from);
                }
                wide
            });
            let mut wide_bar = wide_b.clone();
            run!(
                extreme,
                matrix_vjp::<O, T>(
                    a,
                    wide_b.as_deref().unwrap_or(b),
                    wide.as_deref().unwrap_or(upstream),
                    a_bar,
                    wide_bar.as_deref_mut().unwrap_or(&mut *b_bar),
                )
            );
            if let Some(wide_bar) = wide_bar {
                b_bar.copy_from_slice(&wide_bar[..columns]);
            }
        },
    );
    // Piece after piece, so the order of the sum is fixed.
    for partial in partials.chunks(b.len()) {
        for (sum, &part) in b_bar.iter_mut().zip(partial) {
            *sum = plus(*sum, part);
        }
    }
    Ok(())
}

#[inline(always)]
fn matrix_vjp<O: PairOp, T: Real, L: Bundle<T>, const EXTREME: bool>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) {
    let columns = b.len();
    let rows = frames_a::<O, T>(a);
    let mut sums: Vec<A<O, L>> = vec![zeros(); rows.len()];
    let tiles = columns.div_ceil(L::WIDTH);
    let (mut frames, mut bars) = (Vec::with_capacity(BLOCK), Vec::with_capacity(BLOCK));
    for first in (0..tiles).step_by(BLOCK) {
        frames_b::<O, T, L>(b, first..tiles.min(first + BLOCK), &mut frames);
        bars.clear();
        for (k, &frame) in frames.iter().enumerate() {
            let start = start_of::<T, L>(first + opaque(k), columns);
            // Lanes of the tile before, where the last one overlaps it: they must not count twice.
            let counted = (first + k) * L::WIDTH - start;
            let mut column: B<O, L> = zeros();
            for i in 0..rows.len() {
                let i = opaque(i);
                let row: O::FrameA<L> = splat::<T, L, _, _>(rows[i]);
                let mut factor = load::<T, L>(&upstream[i * columns + start..]);
                if counted > 0 {
                    factor.lanes_mut()[..counted].fill(T::default());
                }
                let (_, bars) = O::grad::<L, EXTREME>(row, frame);
                sums[i] = plus(sums[i], times(bars.0, factor));
                column = plus(column, times(bars.1, factor));
            }
            bars.push(column);
        }
        for (k, &column) in bars.iter().enumerate() {
            let start = start_of::<T, L>(first + opaque(k), columns);
            let counted = (first + k) * L::WIDTH - start;
            let mut shapes = [zeros(); MOST_LANES];
            scatter::<T, L, _, _>(column, &mut shapes);
            b_bar[start + counted..start + L::WIDTH].copy_from_slice(&shapes[counted..L::WIDTH]);
        }
    }
    for (bar, sum) in a_bar.iter_mut().zip(sums) {
        *bar = folded::<T, L, _, _>(sum);
    }
}

/// The sum of all lanes of every field, always in the same order: halves onto halves.
#[inline(always)]
fn folded<T: Real, L: Bundle<T>, P: Fixed<Scalar = T>, Q: Fixed<Scalar = L>>(sum: Q) -> P {
    let mut bundles = sum.to_array();
    let mut totals = zeros::<T, P>().to_array();
    for (total, bundle) in totals.as_mut().iter_mut().zip(bundles.as_mut()) {
        let lanes = bundle.lanes_mut();
        let mut half = lanes.len() / 2;
        while half > 0 {
            for lane in 0..half {
                lanes[lane] += lanes[lane + half];
            }
            half /= 2;
        }
        *total = lanes[0];
    }
    P::from_array(totals)
}

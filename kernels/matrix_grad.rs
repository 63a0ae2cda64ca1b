//! All-pairs batches with the slopes of every pair.
use crate::Fixed;
use crate::error::{Argument, Error};
use crate::kernels::cpu::{A, B};
use crate::kernels::matrix::{frames_a, frames_b, rows_per_piece};
use crate::kernels::op::PairOp;
use crate::kernels::real::{Bundle, Real};
use crate::kernels::tile::{
    check, entries, expect, narrow, opaque, run, splat, spread, start_of, store, widened, width_of,
    zeros,
};
use std::marker::PhantomData;

/// Tiles of columns whose slopes leave together: four kilobytes of every plane, which is where
/// longer runs stop being faster.
const SPAN: usize = 64;

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

/// [`all_pairs`](crate::kernels::cpu::all_pairs) with the slopes of every result with respect to both of its shapes.
///
/// # Errors
///
/// As [`all_pairs`](crate::kernels::cpu::all_pairs).
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
/// As [`all_pairs`](crate::kernels::cpu::all_pairs), and [`Error::Length`] for buffers of another size. The buffers are then as
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
    let mut frames = Vec::with_capacity(SPAN);
    // One row's results wait here, field after field, and leave in long runs: stores that cross
    // lines of the cache and touch a dozen pages in turn would cost more than the arithmetic.
    let mut waiting_values = vec![T::default(); SPAN * L::WIDTH];
    let mut waiting = vec![T::default(); planes.len() * SPAN * L::WIDTH];
    let mut parts: Vec<&mut [T]> = waiting.chunks_mut(SPAN * L::WIDTH).collect();
    for first in (0..tiles).step_by(SPAN) {
        let last = tiles.min(first + SPAN);
        let from = start_of::<T, L>(first, columns);
        let run = start_of::<T, L>(last - 1, columns) + L::WIDTH - from;
        frames_b::<O, T, L>(b, first..last, &mut frames);
        for (i, &row) in rows.iter().enumerate() {
            let row: O::FrameA<L> = splat::<T, L, _, _>(row);
            for (k, &frame) in frames.iter().enumerate() {
                let at = start_of::<T, L>(first + opaque(k), columns) - from;
                let (value, bars) = O::grad::<L, EXTREME>(row, frame);
                store::<T, L>(value, &mut waiting_values[at..]);
                let (of_a, of_b) = parts.split_at_mut(A::<O, T>::LEN);
                store_planes::<T, L>(bars.0.to_array().as_ref(), of_a, at);
                store_planes::<T, L>(bars.1.to_array().as_ref(), of_b, at);
            }
            let to = i * columns + from;
            values[to..to + run].copy_from_slice(&waiting_values[..run]);
            for (part, plane) in parts.iter().zip(&mut *planes) {
                plane[to..to + run].copy_from_slice(&part[..run]);
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

//! The adjoint of all-pairs batches.
use crate::Fixed;
use crate::error::{Argument, Error};
use crate::kernels::cpu::{A, B, Bars};
use crate::kernels::matrix::{BLOCK, frames_a, frames_b, rows_per_piece};
use crate::kernels::op::PairOp;
use crate::kernels::real::{Bundle, Real};
use crate::kernels::tile::{
    check, check_upstream, entries, expect, load, opaque, plus, run, scatter, splat, spread,
    start_of, times, widened, width_of, zeros,
};

/// No bundle has more lanes.
const MOST_LANES: usize = 16;

/// The adjoint of [`all_pairs`](crate::kernels::cpu::all_pairs): slopes of `Σ upstream[i, j] · result[i, j]` with respect to every
/// shape of both lists. `upstream` is a matrix, row by row.
///
/// # Errors
///
/// As [`all_pairs`](crate::kernels::cpu::all_pairs), and for an upstream of another size or one that is not finite.
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
    let upstream = Upstream {
        slopes: upstream,
        step: b.len(),
    };
    pull_back::<O, T>(a, b, upstream, extreme, a_bar, b_bar);
    Ok(())
}

/// An upstream matrix: row `i` starts at `i * step`. With a step of zero all rows are the same one.
#[derive(Clone, Copy)]
pub(super) struct Upstream<'a, T> {
    pub slopes: &'a [T],
    pub step: usize,
}

impl<T: Real> Upstream<'_, T> {
    /// From a row on.
    fn from_row(&self, row: usize) -> Self {
        Upstream {
            slopes: &self.slopes[row * self.step..],
            ..*self
        }
    }
}

/// [`all_pairs_vjp_into`] without checks.
pub(super) fn pull_back<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: Upstream<'_, T>,
    extreme: bool,
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) {
    a_bar.fill(zeros());
    b_bar.fill(zeros());
    if a.is_empty() || b.is_empty() {
        return;
    }
    let (rows, columns, width) = (rows_per_piece(a.len()), b.len(), width_of::<T>(extreme));
    let wide_b = widened(b, width);
    let mut partials = vec![zeros(); a.len().div_ceil(rows) * columns];
    let work = a
        .chunks(rows)
        .zip(a_bar.chunks_mut(rows))
        .zip(partials.chunks_mut(columns))
        .enumerate();
    spread(
        work.collect(),
        |(piece, ((a, a_bar), b_bar)): (usize, ((&[A<O, T>], &mut [A<O, T>]), &mut [B<O, T>]))| {
            let upstream = upstream.from_row(piece * rows);
            let Some(b) = &wide_b else {
                run!(extreme, matrix_vjp::<O, T>(a, b, upstream, a_bar, b_bar));
                return;
            };
            // The columns added have no upstream.
            let mut slopes = vec![T::default(); a.len() * width];
            for (i, row) in slopes.chunks_mut(width).enumerate() {
                row[..columns].copy_from_slice(&upstream.from_row(i).slopes[..columns]);
            }
            let wide = Upstream {
                slopes: &slopes,
                step: width,
            };
            let mut wide_bar = b.clone();
            run!(
                extreme,
                matrix_vjp::<O, T>(a, b, wide, a_bar, &mut wide_bar)
            );
            b_bar.copy_from_slice(&wide_bar[..columns]);
        },
    );
    // Piece after piece, so the order of the sum is fixed.
    for partial in partials.chunks(columns) {
        for (sum, &part) in b_bar.iter_mut().zip(partial) {
            *sum = plus(*sum, part);
        }
    }
}

#[inline(always)]
fn matrix_vjp<O: PairOp, T: Real, L: Bundle<T>, const EXTREME: bool>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: Upstream<'_, T>,
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) {
    let columns = b.len();
    let Upstream { slopes, step } = upstream;
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
                let mut factor = load::<T, L>(&slopes[i * step + start..]);
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

//! Batches on the CPU: SIMD lanes inside, threads outside, the same bits for any number of either.
//!
//! The generic source runs on bundles of lanes. The instruction set is chosen at run time, once
//! per stretch of work, so a default build uses AVX-512 where there is AVX-512; see
//! [`Simd`](crate::kernels::simd::Simd). Shapes go in as slices of shapes. Inputs are checked
//! before anything is written: on an error every buffer is as it was.
//!
//! With the feature `parallel` the work is spread over rayon's current thread pool (run inside
//! `pool.install` to choose another). It is cut the same way for any number of threads, and sums
//! are added in a fixed order.
use crate::error::{Argument, Error};
use crate::kernels::op::{PairOp, RingOp};
use crate::kernels::real::{Bundle, Real};
use crate::kernels::simd::vectorized;
use crate::{Fixed, Scalar, Vec2};

/// A first shape of a pair operation.
pub type A<O, T> = <O as PairOp>::A<T>;
/// A second shape of a pair operation.
pub type B<O, T> = <O as PairOp>::B<T>;

/// Columns whose frames are made and kept together: few enough for the innermost cache.
const BLOCK: usize = 256;

/// Aligned pairs per piece of work: enough to be worth a thread's while.
const STRETCH: usize = 2048;

/// A value and slopes for every row of one list with every row of another.
///
/// Slopes are kept as planes, field by field, because that is how a consumer of millions reads
/// them and because the processor can write nothing else at full speed: row `i` of the matrix
/// holds one run of all columns for each field of `A`, then for each field of `B`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairGrads<T> {
    /// Rows: shapes of the first list.
    pub rows: usize,
    /// Columns: shapes of the second list.
    pub columns: usize,
    /// The results, row by row.
    pub values: Vec<T>,
    /// The slopes: `planes[(i · fields + k) · columns + j]`.
    pub planes: Vec<T>,
}

impl<T: Real> PairGrads<T> {
    /// Slopes of pair `(i, j)` with respect to both shapes.
    ///
    /// # Panics
    ///
    /// When there is no such pair.
    #[must_use]
    pub fn at<O: PairOp>(&self, i: usize, j: usize) -> (A<O, T>, B<O, T>) {
        assert!(
            i < self.rows && j < self.columns,
            "pair ({i}, {j}) out of range"
        );
        let fields = A::<O, T>::LEN + B::<O, T>::LEN;
        let mut slopes = [T::default(); 2 * MOST_FIELDS];
        for k in 0..fields {
            slopes[k] = self.planes[(i * fields + k) * self.columns + j];
        }
        Fixed::take(&slopes)
    }
}

/// Runs every piece of work, on all threads when there are threads.
fn spread<W: Send>(work: Vec<W>, run: impl Fn(W) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if work.len() > 1 {
        use rayon::prelude::*;
        work.into_par_iter().with_max_len(1).for_each(run);
        return;
    }
    work.into_iter().for_each(run);
}

/// Checks the number of items of an argument.
fn expect(argument: Argument, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found {
        Ok(())
    } else {
        Err(Error::Length {
            argument,
            expected,
            found,
        })
    }
}

/// Checks every shape of both lists; `Ok(true)` when some product might over- or underflow.
fn check<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<bool, Error> {
    let mut ordinary = true;
    for (row, shape) in a.iter().enumerate() {
        let invalid = |flaw| Error::Invalid {
            argument: Argument::A,
            row,
            flaw,
        };
        ordinary &= O::check_a(shape).map_err(invalid)?;
    }
    for (row, shape) in b.iter().enumerate() {
        let invalid = |flaw| Error::Invalid {
            argument: Argument::B,
            row,
            flaw,
        };
        ordinary &= O::check_b(shape).map_err(invalid)?;
    }
    Ok(!ordinary)
}

/// Checks that every upstream slope is finite.
fn check_upstream<T: Real>(upstream: &[T]) -> Result<(), Error> {
    for (row, &x) in upstream.iter().enumerate() {
        crate::error::finite(x, crate::error::Field::Value).map_err(|flaw| Error::Invalid {
            argument: Argument::Upstream,
            row,
            flaw,
        })?;
    }
    Ok(())
}

/// More fields than any shape or frame has.
const MOST_FIELDS: usize = 16;

/// The shape of a bundle: one shape per lane, the last one again where there are fewer.
#[inline(always)]
fn gather<T: Real, P: Fixed<Scalar = T>, Q: Fixed<Scalar = T::Bundle>>(shapes: &[P]) -> Q {
    let mut fields = [T::Bundle::splat(T::default()); MOST_FIELDS];
    let mut one = [T::default(); MOST_FIELDS];
    for lane in 0..T::Bundle::WIDTH {
        shapes[lane.min(shapes.len() - 1)].put(&mut one);
        for field in 0..P::LEN {
            fields[field].lanes_mut()[lane] = one[field];
        }
    }
    Q::take(&fields)
}

/// The other way: as many shapes as there is room for.
#[inline(always)]
fn scatter<T: Real, P: Fixed<Scalar = T>, Q: Fixed<Scalar = T::Bundle>>(from: Q, shapes: &mut [P]) {
    let mut fields = [T::Bundle::splat(T::default()); MOST_FIELDS];
    let mut one = [T::default(); MOST_FIELDS];
    from.put(&mut fields);
    for (lane, shape) in shapes.iter_mut().enumerate() {
        for field in 0..P::LEN {
            one[field] = fields[field].lanes()[lane];
        }
        *shape = P::take(&one);
    }
}

/// One shape in every lane.
#[inline(always)]
fn splat<T: Real, P: Fixed<Scalar = T>, Q: Fixed<Scalar = T::Bundle>>(shape: P) -> Q {
    let mut one = [T::default(); MOST_FIELDS];
    let mut fields = [T::Bundle::splat(T::default()); MOST_FIELDS];
    shape.put(&mut one);
    for field in 0..P::LEN {
        fields[field] = T::Bundle::splat(one[field]);
    }
    Q::take(&fields)
}

/// Copies lanes out, as many as there is room for.
#[inline(always)]
fn store<T: Real>(from: T::Bundle, to: &mut [T]) {
    to.copy_from_slice(&from.lanes()[..to.len()]);
}

/// The index of a tile, hidden from the optimizer.
///
/// Without it the loop over tiles is itself vectorised, sixteen tiles at a time through gathers and
/// scatters, at a third of the speed.
#[inline(always)]
fn opaque(tile: usize) -> usize {
    std::hint::black_box(tile)
}

/// Row i of `a` with row i of `b`: one result per row.
///
/// # Errors
///
/// [`Error::Length`] when the lists differ in length, [`Error::Invalid`] for a shape that is not
/// valid.
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{cpu, overlap::IouObb2};
/// let a = [Obb2::new(0.0_f32, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
/// assert_eq!(cpu::aligned::<IouObb2, _>(&a, &b)?, [1.0 / 3.0, 1.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn aligned<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<Vec<T>, Error> {
    let mut values = vec![T::default(); a.len()];
    aligned_into::<O, T>(a, b, &mut values)?;
    Ok(values)
}

/// [`aligned`] into the caller's buffer.
///
/// # Errors
///
/// As [`aligned`], and [`Error::Length`] for a buffer of another length. The buffer is then as it
/// was.
pub fn aligned_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
) -> Result<(), Error> {
    expect(Argument::B, a.len(), b.len())?;
    expect(Argument::Values, a.len(), values.len())?;
    let extreme = check::<O, T>(a, b)?;
    let work = a
        .chunks(STRETCH)
        .zip(b.chunks(STRETCH))
        .zip(values.chunks_mut(STRETCH))
        .collect();
    spread(
        work,
        |((a, b), values): ((&[A<O, T>], &[B<O, T>]), &mut [T])| {
            vectorized!(aligned_values::<O, T>(a, b, values, extreme));
        },
    );
    Ok(())
}

#[inline(always)]
fn aligned_values<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
    extreme: bool,
) {
    let width = T::Bundle::WIDTH;
    for ((a, b), values) in a
        .chunks(width)
        .zip(b.chunks(width))
        .zip(values.chunks_mut(width))
    {
        let a: A<O, T::Bundle> = gather::<T, _, _>(a);
        let b: B<O, T::Bundle> = gather::<T, _, _>(b);
        let value = O::value::<T::Bundle>(O::frame_a(a), O::frame_b(b), extreme);
        store::<T>(value, values);
    }
}

/// Results and slopes of aligned pairs.
pub type AlignedGrads<O, T> = (Vec<T>, Vec<A<O, T>>, Vec<B<O, T>>);

/// [`aligned`] with the slopes of every result with respect to both of its shapes.
///
/// # Errors
///
/// As [`aligned`].
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{cpu, overlap::IouObb2};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// let (iou, a_bar, _) = cpu::aligned_grad::<IouObb2, f64>(&a, &b)?;
/// assert_eq!(iou, [1.0 / 3.0]);
/// assert!((a_bar[0].center.x - 4.0 / 9.0).abs() < 1e-15); // nearer is better
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn aligned_grad<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
) -> Result<AlignedGrads<O, T>, Error> {
    expect(Argument::B, a.len(), b.len())?;
    let (mut values, mut a_bar, mut b_bar) = (vec![T::default(); a.len()], a.to_vec(), b.to_vec());
    aligned_grad_into::<O, T>(a, b, &mut values, &mut a_bar, &mut b_bar)?;
    Ok((values, a_bar, b_bar))
}

/// [`aligned_grad`] into the caller's buffers.
///
/// # Errors
///
/// As [`aligned`], and [`Error::Length`] for a buffer of another length. The buffers are then as
/// they were.
pub fn aligned_grad_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) -> Result<(), Error> {
    expect(Argument::B, a.len(), b.len())?;
    expect(Argument::Values, a.len(), values.len())?;
    aligned_slopes::<O, T>(a, b, Seed::One(values), a_bar, b_bar)
}

/// The adjoint of [`aligned`]: `upstream[i]` times the slopes of result i.
///
/// # Errors
///
/// As [`aligned`], and for an upstream of another length or one that is not finite.
pub fn aligned_vjp<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
) -> Result<(Vec<A<O, T>>, Vec<B<O, T>>), Error> {
    let (mut a_bar, mut b_bar) = (a.to_vec(), b.to_vec());
    aligned_vjp_into::<O, T>(a, b, upstream, &mut a_bar, &mut b_bar)?;
    Ok((a_bar, b_bar))
}

/// [`aligned_vjp`] into the caller's buffers.
///
/// # Errors
///
/// As [`aligned_vjp`], and [`Error::Length`] for a buffer of another length. The buffers are then
/// as they were.
pub fn aligned_vjp_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) -> Result<(), Error> {
    expect(Argument::B, a.len(), b.len())?;
    expect(Argument::Upstream, a.len(), upstream.len())?;
    check_upstream(upstream)?;
    aligned_slopes::<O, T>(a, b, Seed::Upstream(upstream), a_bar, b_bar)
}

/// What slopes are multiplied by, or where the results go.
enum Seed<'a, T> {
    One(&'a mut [T]),
    Upstream(&'a [T]),
}

fn aligned_slopes<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    seed: Seed<'_, T>,
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) -> Result<(), Error> {
    expect(Argument::GradA, a.len(), a_bar.len())?;
    expect(Argument::GradB, b.len(), b_bar.len())?;
    let extreme = check::<O, T>(a, b)?;
    let seeds: Vec<Seed<'_, T>> = match seed {
        Seed::One(values) => values.chunks_mut(STRETCH).map(Seed::One).collect(),
        Seed::Upstream(upstream) => upstream.chunks(STRETCH).map(Seed::Upstream).collect(),
    };
    let bars = a_bar.chunks_mut(STRETCH).zip(b_bar.chunks_mut(STRETCH));
    let work = a
        .chunks(STRETCH)
        .zip(b.chunks(STRETCH))
        .zip(seeds)
        .zip(bars)
        .collect();
    spread(
        work,
        |(((a, b), mut seed), (a_bar, b_bar)): (
            ((&[A<O, T>], &[B<O, T>]), _),
            (&mut [A<O, T>], &mut [B<O, T>]),
        )| {
            vectorized!(aligned_bars::<O, T>(a, b, &mut seed, a_bar, b_bar, extreme));
        },
    );
    Ok(())
}

#[inline(always)]
fn aligned_bars<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    seed: &mut Seed<'_, T>,
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
    extreme: bool,
) {
    let width = T::Bundle::WIDTH;
    for tile in 0..a.len().div_ceil(width) {
        let start = opaque(tile) * width;
        let range = start..a.len().min(start + width);
        let a: A<O, T::Bundle> = gather::<T, _, _>(&a[range.clone()]);
        let b: B<O, T::Bundle> = gather::<T, _, _>(&b[range.clone()]);
        let (value, mut bars) = O::grad::<T::Bundle>(O::frame_a(a), O::frame_b(b), extreme);
        match seed {
            Seed::One(values) => store::<T>(value, &mut values[range.clone()]),
            Seed::Upstream(upstream) => {
                let mut factor = T::Bundle::splat(T::default());
                let here = &upstream[range.clone()];
                factor.lanes_mut()[..here.len()].copy_from_slice(here);
                bars = (times(bars.0, factor), times(bars.1, factor));
            }
        }
        scatter::<T, _, _>(bars.0, &mut a_bar[range.clone()]);
        scatter::<T, _, _>(bars.1, &mut b_bar[range]);
    }
}

/// Every field times a factor.
#[inline(always)]
fn times<S: Scalar, P: Fixed<Scalar = S>>(shape: P, factor: S) -> P {
    let mut fields = [S::zero(); MOST_FIELDS];
    shape.put(&mut fields);
    for field in &mut fields[..P::LEN] {
        *field *= factor;
    }
    P::take(&fields)
}

/// Field by field the sum.
#[inline(always)]
fn plus<S: Scalar, P: Fixed<Scalar = S>>(x: P, y: P) -> P {
    let (mut fields, mut more) = ([S::zero(); MOST_FIELDS], [S::zero(); MOST_FIELDS]);
    x.put(&mut fields);
    y.put(&mut more);
    for field in 0..P::LEN {
        fields[field] += more[field];
    }
    P::take(&fields)
}

/// A shape of zeros.
#[inline(always)]
fn zeros<S: Scalar, P: Fixed<Scalar = S>>() -> P {
    P::take(&[S::zero(); MOST_FIELDS])
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

/// The number of entries of a matrix.
fn entries(rows: usize, columns: usize, fields: usize) -> Result<usize, Error> {
    let count = rows
        .checked_mul(columns)
        .and_then(|n| n.checked_mul(fields));
    count
        .filter(|&n| n <= isize::MAX as usize / 8)
        .ok_or(Error::TooLarge)
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
    let rows = rows_per_piece(a.len());
    let work = a
        .chunks(rows)
        .zip(values.chunks_mut(rows * b.len()))
        .collect();
    spread(work, |(a, values): (&[A<O, T>], &mut [T])| {
        vectorized!(matrix_values::<O, T>(a, b, values, extreme));
    });
    Ok(())
}

/// Frames of rows, one by one.
#[inline(always)]
fn frames_a<O: PairOp, T: Real>(a: &[A<O, T>]) -> Vec<O::FrameA<T>> {
    a.iter().map(|&shape| O::frame_a(shape)).collect()
}

/// Frames of a block of columns, in bundles.
#[inline(always)]
fn frames_b<O: PairOp, T: Real>(b: &[B<O, T>], frames: &mut Vec<O::FrameB<T::Bundle>>) {
    frames.clear();
    for shapes in b.chunks(T::Bundle::WIDTH) {
        let shapes: B<O, T::Bundle> = gather::<T, _, _>(shapes);
        frames.push(O::frame_b(shapes));
    }
}

#[inline(always)]
fn matrix_values<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
    extreme: bool,
) {
    let (width, columns) = (T::Bundle::WIDTH, b.len());
    let rows = frames_a::<O, T>(a);
    let mut frames = Vec::with_capacity(BLOCK / width);
    for (block, b) in b.chunks(BLOCK).enumerate() {
        frames_b::<O, T>(b, &mut frames);
        for (i, &row) in rows.iter().enumerate() {
            let row: O::FrameA<T::Bundle> = splat::<T, _, _>(row);
            let values = &mut values[i * columns + block * BLOCK..][..b.len()];
            for tile in 0..frames.len() {
                let tile = opaque(tile);
                let value = O::value::<T::Bundle>(row, frames[tile], extreme);
                let end = b.len().min((tile + 1) * width);
                store::<T>(value, &mut values[tile * width..end]);
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
/// let (_, b_bar) = grads.at::<IouObb2>(0, 1);
/// assert!((b_bar.center.x + 4.0 / 9.0).abs() < 1e-15);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn all_pairs_grad<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
) -> Result<PairGrads<T>, Error> {
    let fields = A::<O, T>::LEN + B::<O, T>::LEN;
    let mut grads = PairGrads {
        rows: a.len(),
        columns: b.len(),
        values: vec![T::default(); entries(a.len(), b.len(), 1)?],
        planes: vec![T::default(); entries(a.len(), b.len(), fields)?],
    };
    all_pairs_grad_into::<O, T>(a, b, &mut grads)?;
    Ok(grads)
}

/// [`all_pairs_grad`] into the caller's buffers, which must have the right size already.
///
/// # Errors
///
/// As [`all_pairs`], and [`Error::Length`] for buffers of another size. The buffers are then as
/// they were.
pub fn all_pairs_grad_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    grads: &mut PairGrads<T>,
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
    let rows = rows_per_piece(a.len());
    let values = grads.values.chunks_mut(rows * b.len());
    let planes = grads.planes.chunks_mut(rows * b.len() * fields);
    let work = a.chunks(rows).zip(values).zip(planes).collect();
    spread(
        work,
        |((a, values), planes): ((&[A<O, T>], &mut [T]), &mut [T])| {
            vectorized!(matrix_grads::<O, T>(a, b, values, planes, extreme));
        },
    );
    Ok(())
}

#[inline(always)]
fn matrix_grads<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
    planes: &mut [T],
    extreme: bool,
) {
    let (width, columns) = (T::Bundle::WIDTH, b.len());
    let fields = A::<O, T>::LEN + B::<O, T>::LEN;
    let rows = frames_a::<O, T>(a);
    let mut frames = Vec::with_capacity(BLOCK / width);
    for (block, b) in b.chunks(BLOCK).enumerate() {
        frames_b::<O, T>(b, &mut frames);
        for (i, &row) in rows.iter().enumerate() {
            let row: O::FrameA<T::Bundle> = splat::<T, _, _>(row);
            let values = &mut values[i * columns..][..columns];
            let planes = &mut planes[i * columns * fields..][..columns * fields];
            for tile in 0..frames.len() {
                let tile = opaque(tile);
                let (value, bars) = O::grad::<T::Bundle>(row, frames[tile], extreme);
                let start = block * BLOCK + tile * width;
                let end = columns.min(start + width);
                store::<T>(value, &mut values[start..end]);
                let mut slopes = [T::Bundle::splat(T::default()); 2 * MOST_FIELDS];
                bars.put(&mut slopes);
                for (field, &slope) in slopes[..fields].iter().enumerate() {
                    store::<T>(
                        slope,
                        &mut planes[field * columns + start..field * columns + end],
                    );
                }
            }
        }
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
) -> Result<(Vec<A<O, T>>, Vec<B<O, T>>), Error> {
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
    let rows = rows_per_piece(a.len());
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
            vectorized!(matrix_vjp::<O, T>(a, b, upstream, a_bar, b_bar, extreme));
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
fn matrix_vjp<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
    extreme: bool,
) {
    let (width, columns) = (T::Bundle::WIDTH, b.len());
    let rows = frames_a::<O, T>(a);
    let zero = T::Bundle::splat(T::default());
    let mut sums: Vec<A<O, T::Bundle>> = vec![zeros(); rows.len()];
    for tile in 0..columns.div_ceil(width) {
        let start = opaque(tile) * width;
        let range = start..columns.min(start + width);
        let shapes: B<O, T::Bundle> = gather::<T, _, _>(&b[range.clone()]);
        let frame = O::frame_b(shapes);
        let mut column: B<O, T::Bundle> = zeros();
        for i in 0..rows.len() {
            let i = opaque(i);
            let row: O::FrameA<T::Bundle> = splat::<T, _, _>(rows[i]);
            // Lanes beyond the last column have upstream zero and add nothing.
            let mut factor = zero;
            let here = &upstream[i * columns..][range.clone()];
            factor.lanes_mut()[..here.len()].copy_from_slice(here);
            let (_, bars) = O::grad::<T::Bundle>(row, frame, extreme);
            sums[i] = plus(sums[i], times(bars.0, factor));
            column = plus(column, times(bars.1, factor));
        }
        scatter::<T, _, _>(column, &mut b_bar[range]);
    }
    for (bar, sum) in a_bar.iter_mut().zip(sums) {
        *bar = folded::<T, _, _>(sum);
    }
}

/// The sum of all lanes of every field, always in the same order: halves onto halves.
#[inline(always)]
fn folded<T: Real, P: Fixed<Scalar = T>, Q: Fixed<Scalar = T::Bundle>>(sum: Q) -> P {
    let mut fields = [T::Bundle::splat(T::default()); MOST_FIELDS];
    let mut totals = [T::default(); MOST_FIELDS];
    sum.put(&mut fields);
    for field in 0..Q::LEN {
        let lanes = fields[field].lanes_mut();
        let mut half = lanes.len() / 2;
        while half > 0 {
            for lane in 0..half {
                lanes[lane] = lanes[lane] + lanes[lane + half];
            }
            half /= 2;
        }
        totals[field] = lanes[0];
    }
    P::take(&totals)
}

/// One result per ring. Ring i has the vertices `offsets[i]..offsets[i + 1]`; there is one offset
/// more than there are rings, from 0 to the number of vertices. Empty rings are valid.
///
/// # Errors
///
/// [`Error::Offsets`] for offsets that decrease or do not cover the vertices, [`Error::Invalid`]
/// for a vertex that is not finite.
///
/// ```
/// use geograd::Vec2;
/// use geograd::kernels::{cpu, ring::SignedArea};
/// let v = |x, y| Vec2::new(x, y);
/// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0), v(0.0, 0.0), v(0.0, 1.0), v(1.0, 0.0)];
/// assert_eq!(cpu::ragged::<SignedArea, f64>(&vertices, &[0, 3, 6])?, [6.0, -0.5]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn ragged<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
) -> Result<Vec<O::Out<T>>, Error> {
    let mut values = vec![zeros(); offsets.len().saturating_sub(1)];
    ragged_into::<O, T>(vertices, offsets, &mut values)?;
    Ok(values)
}

/// Checks offsets and vertices.
pub(crate) fn check_ragged<T: Real>(vertices: &[Vec2<T>], offsets: &[usize]) -> Result<(), Error> {
    if offsets.first() != Some(&0) {
        return Err(Error::Offsets { row: 0 });
    }
    for row in 1..offsets.len() {
        if offsets[row] < offsets[row - 1] || offsets[row] > vertices.len() {
            return Err(Error::Offsets { row });
        }
    }
    if offsets.last() != Some(&vertices.len()) {
        return Err(Error::Offsets {
            row: offsets.len() - 1,
        });
    }
    for (row, vertex) in vertices.iter().enumerate() {
        use crate::error::{Field, finite};
        finite(vertex.x, Field::X)
            .and_then(|()| finite(vertex.y, Field::Y))
            .map_err(|flaw| Error::Invalid {
                argument: Argument::Vertices,
                row,
                flaw,
            })?;
    }
    Ok(())
}

/// Where to cut a ragged batch: indices of rings, about [`STRETCH`] vertices apart.
fn cuts(offsets: &[usize]) -> Vec<usize> {
    let mut cuts = vec![0];
    let mut start = 0;
    for ring in 1..offsets.len() {
        if offsets[ring] - offsets[start] >= STRETCH || ring - start >= STRETCH {
            cuts.push(ring);
            start = ring;
        }
    }
    if start + 1 < offsets.len() {
        cuts.push(offsets.len() - 1);
    }
    cuts
}

/// [`ragged`] into the caller's buffer.
///
/// # Errors
///
/// As [`ragged`], and [`Error::Length`] for a buffer of another length. The buffer is then as it
/// was.
pub fn ragged_into<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    values: &mut [O::Out<T>],
) -> Result<(), Error> {
    check_ragged(vertices, offsets)?;
    expect(Argument::Values, offsets.len() - 1, values.len())?;
    let mut rest = values;
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let (values, after) = rest.split_at_mut(cut[1] - cut[0]);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], values));
    }
    spread(work, |(offsets, values): (&[usize], &mut [O::Out<T>])| {
        for (ring, value) in offsets.windows(2).zip(values) {
            *value = O::value(&vertices[ring[0]..ring[1]]);
        }
    });
    Ok(())
}

/// Results and slopes of a ragged batch.
pub type RaggedGrads<O, T> = (Vec<<O as crate::kernels::op::Op>::Out<T>>, Vec<Vec2<T>>);

/// [`ragged`] with the adjoint for the given upstream, one slope per result: results, and one
/// cotangent per vertex.
///
/// # Errors
///
/// As [`ragged`], and for an upstream of another length or one that is not finite.
pub fn ragged_grad<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[O::Out<T>],
) -> Result<RaggedGrads<O, T>, Error> {
    Ok((
        ragged::<O, T>(vertices, offsets)?,
        ragged_vjp::<O, T>(vertices, offsets, upstream)?,
    ))
}

/// The adjoint of [`ragged`]: one cotangent per vertex.
///
/// # Errors
///
/// As [`ragged`], and for an upstream of another length or one that is not finite.
///
/// ```
/// use geograd::Vec2;
/// use geograd::kernels::{cpu, ring::SignedArea};
/// let v = |x, y| Vec2::new(x, y);
/// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0)];
/// let bars = cpu::ragged_vjp::<SignedArea, f64>(&vertices, &[0, 3], &[1.0])?;
/// assert_eq!(bars, [v(-1.5, -2.0), v(1.5, 0.0), v(0.0, 2.0)]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn ragged_vjp<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[O::Out<T>],
) -> Result<Vec<Vec2<T>>, Error> {
    let mut bars = vec![Vec2::new(T::default(), T::default()); vertices.len()];
    ragged_vjp_into::<O, T>(vertices, offsets, upstream, &mut bars)?;
    Ok(bars)
}

/// [`ragged_vjp`] into the caller's buffer.
///
/// # Errors
///
/// As [`ragged_vjp`], and [`Error::Length`] for a buffer of another length. The buffer is then as
/// it was.
pub fn ragged_vjp_into<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[O::Out<T>],
    bars: &mut [Vec2<T>],
) -> Result<(), Error> {
    check_ragged(vertices, offsets)?;
    expect(Argument::Upstream, offsets.len() - 1, upstream.len())?;
    expect(Argument::GradVertices, vertices.len(), bars.len())?;
    for (row, out_bar) in upstream.iter().enumerate() {
        let mut slopes = [T::default(); MOST_FIELDS];
        out_bar.put(&mut slopes);
        for &slope in &slopes[..O::Out::<T>::LEN] {
            crate::error::finite(slope, crate::error::Field::Value).map_err(|flaw| {
                Error::Invalid {
                    argument: Argument::Upstream,
                    row,
                    flaw,
                }
            })?;
        }
    }
    let mut rest = bars;
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let (bars, after) = rest.split_at_mut(offsets[cut[1]] - offsets[cut[0]]);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], &upstream[cut[0]..cut[1]], bars));
    }
    spread(
        work,
        |(offsets, upstream, bars): (&[usize], &[O::Out<T>], &mut [Vec2<T>])| {
            for (ring, &out_bar) in offsets.windows(2).zip(upstream) {
                let bars = &mut bars[ring[0] - offsets[0]..ring[1] - offsets[0]];
                O::ring_vjp(&vertices[ring[0]..ring[1]], out_bar, bars);
            }
        },
    );
    Ok(())
}

//! All-pairs batches: every row with every row.
use crate::Fixed;
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::{entries, expect, fill, pairs, restore, tame};
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::sweep::Upstream;
use crate::kernels::cpu::{A, B, Bars};
use crate::kernels::op::PairOp;
use crate::kernels::real::Real;
use std::marker::PhantomData;

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
    let pairs = pairs::<O, T>(a, b)?;
    (T::drivers().values)(&pairs, values);
    Ok(())
}

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
            A::<O, T>::filled(T::default()).to_array(),
            B::<O, T>::filled(T::default()).to_array(),
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
    let pairs = pairs::<O, T>(a, b)?;
    (T::drivers().grads)(&pairs, &mut grads.values, &mut grads.planes);
    Ok(())
}

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
    let pairs = pairs::<O, T>(a, b)?;
    pull_back(&pairs, upstream, b.len(), a_bar, b_bar)
}

/// Sums of upstream slopes times slopes; row `i` of the upstream slopes starts at `i * step`.
///
/// Where one is too steep for kernels all are brought down by the same power of two, and the sums back.
pub(crate) fn pull_back<T: Real, P: Fixed<Scalar = T>, Q: Fixed<Scalar = T>>(
    pairs: &Pairs<'_, T>,
    upstream: &[T],
    step: usize,
    a_bar: &mut [P],
    b_bar: &mut [Q],
) -> Result<(), Error> {
    let steep = tame(upstream, pairs.plan.steepest)?;
    let by = steep
        .iter()
        .flatten()
        .fold(T::one(), |most, x| most.most(x.1));
    let down: Vec<T> = match steep {
        Some(_) => upstream.iter().map(|&x| x.over(by)).collect(),
        None => Vec::new(),
    };
    let slopes = if steep.is_some() { &down } else { upstream };
    fill(a_bar, |a_bar| {
        fill(b_bar, |b_bar| {
            (T::drivers().pull_back)(pairs, Upstream { slopes, step }, a_bar, b_bar);
            if steep.is_some() {
                restore(a_bar, by);
                restore(b_bar, by);
            }
        });
    });
    Ok(())
}

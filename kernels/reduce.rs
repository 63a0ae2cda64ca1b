//! Reductions of all pairs on the CPU, without the matrix: what `gpu` reduces where it is.
use crate::error::{Argument, Error, Field, Flaw};
use crate::kernels::cpu::{self, A, B};
use crate::kernels::op::PairOp;
use crate::kernels::real::Real;

/// The largest score of a row or column, and where in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best<T = f32> {
    /// The score.
    pub value: T,
    /// The column (of a row) or the row (of a column); of several the first.
    pub index: usize,
}

/// A pair whose score is above a threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found<T = f32> {
    /// The row: a shape of the first list.
    pub row: usize,
    /// The column: a shape of the second list.
    pub column: usize,
    /// The score.
    pub value: T,
}

/// Numbers of a matrix kept at a time: few enough for a cache further out.
const PART: usize = 1 << 18;

/// Refuses to look for the largest of nothing.
pub(crate) fn check_sides(rows: usize, columns: usize, of_rows: bool) -> Result<(), Error> {
    let (own, other, argument) = match of_rows {
        true => (rows, columns, Argument::B),
        false => (columns, rows, Argument::A),
    };
    if own > 0 && other == 0 {
        return Err(Error::Length {
            argument,
            expected: 1,
            found: 0,
        });
    }
    Ok(())
}

/// Refuses a threshold that is not a number.
pub(crate) fn check_threshold<T: Real>(threshold: T) -> Result<(), Error> {
    crate::error::finite(threshold, Field::Value).map_err(|flaw: Flaw| Error::Invalid {
        argument: Argument::Threshold,
        row: 0,
        flaw,
    })
}

/// Hands the matrix over in bands of whole rows: the first row's index, and the numbers.
fn bands<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    mut each: impl FnMut(usize, &[T]),
) -> Result<(), Error> {
    // One check of everything, so that nothing is handed over from a batch that is refused, and
    // rows in errors count from the start of the list.
    cpu::all_pairs::<O, T>(a, &[])?;
    cpu::all_pairs::<O, T>(&[], b)?;
    if b.is_empty() {
        return Ok(());
    }
    let rows = (PART / b.len()).max(1);
    let mut values = Vec::new();
    for (band, a) in a.chunks(rows).enumerate() {
        values.resize(a.len() * b.len(), T::default());
        cpu::all_pairs_into::<O, T>(a, b, &mut values)?;
        each(band * rows, &values);
    }
    Ok(())
}

/// The largest score of every row and its column; of several the first.
///
/// # Errors
///
/// [`Error::Invalid`] for a shape that is not valid, [`Error::Length`] for rows without columns.
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{overlap::IouObb2, reduce};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// let best = reduce::row_max::<IouObb2, f64>(&a, &b)?;
/// assert_eq!((best[0].value, best[0].index), (1.0 / 3.0, 1));
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn row_max<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<Vec<Best<T>>, Error> {
    check_sides(a.len(), b.len(), true)?;
    let mut all = Vec::with_capacity(a.len());
    bands::<O, T>(a, b, |_, values| {
        all.extend(values.chunks(b.len()).map(|row| {
            let first = Best {
                value: row[0],
                index: 0,
            };
            row.iter().enumerate().fold(first, larger)
        }));
    })?;
    Ok(all)
}

/// The larger one; of equals the one that was there.
fn larger<T: Real>(best: Best<T>, (index, &value): (usize, &T)) -> Best<T> {
    if value.above(best.value) {
        Best { value, index }
    } else {
        best
    }
}

/// The largest score of every column and its row; of several the first.
///
/// # Errors
///
/// As [`row_max`], for columns without rows.
pub fn column_max<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<Vec<Best<T>>, Error> {
    check_sides(a.len(), b.len(), false)?;
    let mut all: Vec<Best<T>> = Vec::new();
    bands::<O, T>(a, b, |first, values| {
        for (i, row) in values.chunks(b.len()).enumerate() {
            if all.is_empty() {
                all.extend(row.iter().map(|&value| Best { value, index: 0 }));
            }
            for (best, value) in all.iter_mut().zip(row) {
                *best = larger(*best, (first + i, value));
            }
        }
    })?;
    Ok(all)
}

/// Every pair whose score is above the threshold, row by row and within a row by column.
///
/// # Errors
///
/// [`Error::Invalid`] for a shape that is not valid or a threshold that is not finite.
pub fn above<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    threshold: T,
) -> Result<Vec<Found<T>>, Error> {
    check_threshold(threshold)?;
    let mut all = Vec::new();
    bands::<O, T>(a, b, |first, values| {
        for (i, row) in values.chunks(b.len()).enumerate() {
            let found = row.iter().enumerate().filter(|(_, v)| v.above(threshold));
            all.extend(found.map(|(column, &value)| Found {
                row: first + i,
                column,
                value,
            }));
        }
    })?;
    Ok(all)
}

/// How many pairs have a score above the threshold.
///
/// # Errors
///
/// As [`above`].
pub fn count_above<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    threshold: T,
) -> Result<u64, Error> {
    check_threshold(threshold)?;
    let mut count = 0;
    bands::<O, T>(a, b, |_, values| {
        count += values.iter().filter(|v| v.above(threshold)).count() as u64;
    })?;
    Ok(count)
}

/// The sum of all scores, added in `f64` row by row.
///
/// # Errors
///
/// [`Error::Invalid`] for a shape that is not valid.
pub fn sum<O: PairOp, T: Real + Into<f64>>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<f64, Error> {
    let mut sum = 0.0;
    bands::<O, T>(a, b, |_, values| {
        for row in values.chunks(b.len()) {
            sum += row.iter().map(|&v| v.into()).sum::<f64>();
        }
    })?;
    Ok(sum)
}

/// The mean of all scores; zero where there are none.
///
/// # Errors
///
/// As [`sum`].
pub fn mean<O: PairOp, T: Real + Into<f64>>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<f64, Error> {
    let count = a.len() as f64 * b.len() as f64;
    Ok(sum::<O, T>(a, b)? / count.max(1.0))
}

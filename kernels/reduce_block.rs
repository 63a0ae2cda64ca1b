//! The matrix of all pairs block by block, and what reductions take of a block.
use crate::error::Error;
use crate::kernels::cpu::{A, B};
use crate::kernels::matrix::{block, rows_per_piece};
use crate::kernels::op::PairOp;
use crate::kernels::real::Real;
use crate::kernels::reduce::{Best, Found};
use crate::kernels::simd::vectorized;
use crate::kernels::tile::{check, spread};

/// Rows and columns of a block of the matrix: together few enough numbers for a cache of one core,
/// each enough to be worth preparing the shapes for.
const ROWS: usize = 128;
const COLUMNS: usize = 1024;

/// A block of a matrix, row by row, and where it starts.
pub(super) struct Block<'a, T> {
    row: usize,
    column: usize,
    columns: usize,
    values: &'a [T],
}

impl<'a, T: Real> Block<'a, T> {
    /// A whole matrix.
    pub fn whole(columns: usize, values: &'a [T]) -> Self {
        Block {
            row: 0,
            column: 0,
            columns: columns.max(1),
            values,
        }
    }
    fn rows(&self) -> std::slice::Chunks<'a, T> {
        self.values.chunks(self.columns)
    }
    /// Takes the largest of every row so far; `best` has one place per row, and its last ones are
    /// those of the block.
    pub fn row_max(&self, best: &mut Vec<Option<Best<T>>>) {
        let rows = self.rows().len();
        if self.column == 0 {
            best.resize(best.len() + rows, None);
        }
        let done = best.len() - rows;
        for (row, best) in self.rows().zip(&mut best[done..]) {
            let largest = vectorized!(largest(row));
            if best.is_none_or(|best| largest.above(best.value)) {
                let index = row.iter().position(|&x| x == largest).unwrap_or(0);
                *best = Some(Best {
                    value: largest,
                    index: self.column + index,
                });
            }
        }
    }
    /// Takes the largest of every column so far; `best` has one place per column of the matrix.
    pub fn column_max(&self, best: &mut [Best<T>]) {
        let best = &mut best[self.column..][..self.columns];
        for (i, row) in self.rows().enumerate() {
            for (best, &value) in best.iter_mut().zip(row) {
                if value.above(best.value) {
                    *best = Best {
                        value,
                        index: self.row + i,
                    };
                }
            }
        }
    }
    /// Adds what is above the threshold, row by row.
    pub fn above(&self, threshold: T, found: &mut Vec<Found<T>>) {
        for (i, row) in self.rows().enumerate() {
            // Most rows of most matrices have nothing.
            if vectorized!(largest(row)).above(threshold) {
                let above = row.iter().enumerate().filter(|(_, x)| x.above(threshold));
                found.extend(above.map(|(j, &value)| Found {
                    row: self.row + i,
                    column: self.column + j,
                    value,
                }));
            }
        }
    }
    pub fn count_above(&self, threshold: T) -> u64 {
        self.rows()
            .map(|row| vectorized!(count(row, threshold)))
            .sum()
    }
    /// The sum, in `f64`.
    pub fn sum(&self) -> f64
    where
        T: Into<f64>,
    {
        self.rows().map(|row| vectorized!(total(row))).sum()
    }
}

/// Numbers looked at side by side.
const SIDE: usize = 32;

/// The largest of a row that has at least one number.
#[inline(always)]
fn largest<T: Real>(row: &[T]) -> T {
    let mut lanes = [row[0]; SIDE];
    let (whole, rest) = row.as_chunks::<SIDE>();
    for part in whole {
        for (lane, &x) in lanes.iter_mut().zip(part) {
            *lane = if x > *lane { x } else { *lane };
        }
    }
    let all = lanes.iter().chain(rest);
    all.fold(row[0], |most, &x| if x > most { x } else { most })
}

/// How many of a row are above a threshold.
#[inline(always)]
fn count<T: Real>(row: &[T], threshold: T) -> u64 {
    row.iter().map(|&x| u64::from(x > threshold)).sum()
}

/// The sum of a row.
#[inline(always)]
fn total<T: Real + Into<f64>>(row: &[T]) -> f64 {
    let mut lanes = [0.0; SIDE];
    let (whole, rest) = row.as_chunks::<SIDE>();
    for part in whole {
        for (lane, &x) in lanes.iter_mut().zip(part) {
            *lane += x.into();
        }
    }
    let rest = rest.iter().map(|&x| x.into()).sum::<f64>();
    lanes.iter().sum::<f64>() + rest
}

/// Hands the matrix over block by block: pieces of rows on all threads, few enough that a result of
/// each fits in memory; within a piece from top to bottom, and from left to right. What `take` made
/// of every piece, in order.
pub(super) fn blocks<O: PairOp, T: Real, R: Send>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    start: impl Fn() -> R,
    take: impl Fn(&mut R, Block<'_, T>) + Send + Sync,
) -> Result<Vec<R>, Error> {
    let extreme = check::<O, T>(a, b)?;
    let rows = rows_per_piece(a.len()).next_multiple_of(ROWS);
    let mut results: Vec<R> = a.chunks(rows).map(|_| start()).collect();
    let work = a.chunks(rows).zip(&mut results).enumerate().collect();
    spread(
        work,
        |(piece, (a, result)): (usize, (&[A<O, T>], &mut R))| {
            let mut values = vec![T::default(); a.len().min(ROWS) * b.len().min(COLUMNS)];
            for (band, a) in a.chunks(ROWS).enumerate() {
                for (part, b) in b.chunks(COLUMNS).enumerate() {
                    let values = &mut values[..a.len() * b.len()];
                    block::<O, T>(a, b, extreme, values);
                    let block = Block {
                        row: piece * rows + band * ROWS,
                        column: part * COLUMNS,
                        columns: b.len(),
                        values,
                    };
                    take(result, block);
                }
            }
        },
    );
    Ok(results)
}

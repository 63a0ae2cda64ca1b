//! Reductions of all pairs over plain numbers, without storing the matrix.
use crate::Real;
use crate::kernels::cpu::arch::flat;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::TILE;
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::sweep::{PartColumns, RowPart};
use crate::kernels::cpu::work::rows_per_piece;
use crate::kernels::machine::found::{Best, Found};

/// The scores of a row, or of a part of it.
enum Scores<'a, T> {
    /// The first of successive columns, and their scores.
    Run(usize, &'a [T]),
    /// Some columns, ascending, and their scores; all other columns score zero.
    Picked(&'a [u32], &'a [T]),
}

/// Returns the scores of a part of a row.
fn scores<'a, T: Real>(part: &RowPart<'a, T>) -> Scores<'a, T> {
    let scores = flat(part.results.field(0));
    match &part.columns {
        PartColumns::Run(run) => Scores::Run(run.start, &scores[..run.len()]),
        PartColumns::Picked(columns) => Scores::Picked(columns, scores),
    }
}

/// Returns picked scores with their columns.
fn picked<'a, T: Real>(
    columns: &'a [u32],
    scores: &'a [T],
) -> impl Iterator<Item = (usize, T)> + 'a {
    let columns = columns.iter().map(|&j| j as usize);
    columns.zip(scores.iter().copied())
}

/// Returns the maximum before any score: zero where pairs may be left out, since those score zero; else minus infinity.
pub fn initial<T: Real>(filtered: bool, index: usize) -> Best<T> {
    let value = T::lit(if filtered { 0.0 } else { f64::NEG_INFINITY });
    Best { value, index }
}

/// Raises the maximum to a larger score.
#[inline]
pub fn raise<T: Real>(best: &mut Best<T>, value: T, index: usize) {
    if value.above(best.value) {
        *best = Best { value, index };
    }
}

/// Returns the largest score of every row and its column; the first of equal ones.
pub fn most_of_rows<T: Real>(pairs: &Pairs<'_, T>) -> Vec<Best<T>> {
    let [rows, columns] = pairs.counts();
    let mut best = vec![initial(false, 0); rows];
    if columns == 0 {
        return best;
    }
    let work = best.chunks_mut(rows_per_piece(rows)).collect();
    pairs.sweep(None, work, |sweep, rows, best: &mut [Best<T>]| {
        best.fill(initial(sweep.is_filtered(), 0));
        let start = rows.start;
        sweep.run(rows, |part| {
            let best = &mut best[part.row - start];
            match scores(&part) {
                Scores::Run(first, values) => {
                    let value = (kernels_in::<T>().largest)(values);
                    if value.above(best.value) {
                        let at = values.iter().position(|&x| x == value);
                        raise(best, value, first + at.unwrap_or(0));
                    }
                }
                Scores::Picked(columns, results) => {
                    for (column, value) in picked(columns, results) {
                        raise(best, value, column);
                    }
                }
            }
        });
    });
    best
}

/// Returns the largest score of every column and its row; the first of equal ones.
pub fn most_of_columns<T: Real>(pairs: &Pairs<'_, T>) -> Vec<Best<T>> {
    let [rows, columns] = pairs.counts();
    let mut best = vec![initial(false, 0); columns];
    if rows == 0 || columns == 0 {
        return best;
    }
    let mut partials = vec![best.clone(); rows.div_ceil(rows_per_piece(rows))];
    let work = partials.iter_mut().collect();
    pairs.sweep(None, work, |sweep, rows, best: &mut Vec<Best<T>>| {
        best.fill(initial(sweep.is_filtered(), rows.start));
        sweep.run(rows, |part| match (part.row, scores(&part)) {
            (row, Scores::Run(first, values)) => {
                for (best, &value) in best[first..].iter_mut().zip(values) {
                    raise(best, value, row);
                }
            }
            (row, Scores::Picked(columns, results)) => {
                for (column, value) in picked(columns, results) {
                    raise(&mut best[column], value, row);
                }
            }
        });
    });
    for piece in partials {
        for (best, other) in best.iter_mut().zip(piece) {
            raise(best, other.value, other.index);
        }
    }
    best
}

/// Returns every pair whose score is above the threshold, ordered by row and then by column.
pub fn above<T: Real>(pairs: &Pairs<'_, T>, threshold: T) -> Vec<Found<T>> {
    let [rows, _] = pairs.counts();
    let mut found = vec![Vec::new(); rows.div_ceil(rows_per_piece(rows))];
    let work = found.iter_mut().collect();
    pairs.sweep(None, work, |sweep, rows, found: &mut Vec<Found<T>>| {
        sweep.run(rows, |part| {
            let row = part.row;
            let mut take = |column, value: T| {
                if value.above(threshold) {
                    found.push(Found { row, column, value });
                }
            };
            match scores(&part) {
                // Most runs have no score above the threshold; their maximum shows that faster.
                Scores::Run(first, values) => {
                    if (kernels_in::<T>().largest)(values).above(threshold) {
                        for (k, &value) in values.iter().enumerate() {
                            take(first + k, value);
                        }
                    }
                }
                Scores::Picked(columns, results) => {
                    for (column, value) in picked(columns, results) {
                        take(column, value);
                    }
                }
            }
        });
        // A piece comes stretch by stretch, each with all rows, so its results must be sorted.
        found.sort_unstable_by_key(|x| (x.row, x.column));
    });
    found.concat()
}

/// Returns the number of pairs whose score is above the threshold.
pub fn count_above<T: Real>(pairs: &Pairs<'_, T>, threshold: T) -> u64 {
    let [rows, _] = pairs.counts();
    let mut counts = vec![0; rows.div_ceil(rows_per_piece(rows))];
    let work = counts.iter_mut().collect();
    pairs.sweep(None, work, |sweep, rows, count: &mut u64| {
        sweep.run(rows, |part| {
            *count += match scores(&part) {
                Scores::Run(_, values) => (kernels_in::<T>().count_above)(values, threshold),
                Scores::Picked(columns, results) => picked(columns, results)
                    .map(|(_, value)| u64::from(value.above(threshold)))
                    .sum(),
            };
        });
    });
    counts.iter().sum()
}

/// Returns the sum of all scores in `f64`. A row has sixteen sums, column `j` in sum `j` modulo sixteen. These, rows,
/// and pieces of rows are added in a fixed order.
pub fn sum<T: Real>(pairs: &Pairs<'_, T>) -> f64 {
    let [rows, _] = pairs.counts();
    let mut sums = vec![0.0; rows.div_ceil(rows_per_piece(rows))];
    let work = sums.iter_mut().collect();
    pairs.sweep(None, work, |sweep, rows, sum: &mut f64| {
        let start = rows.start;
        let mut lanes = vec![[0.0; TILE]; rows.len()];
        sweep.run(rows, |part| {
            let lanes = &mut lanes[part.row - start];
            match scores(&part) {
                Scores::Run(_, values) => (kernels_in::<T>().add_up)(values, lanes),
                Scores::Picked(columns, results) => {
                    for (column, value) in picked(columns, results) {
                        lanes[column % TILE] += value.widen();
                    }
                }
            }
        });
        *sum = lanes.iter().flatten().sum();
    });
    sums.iter().fold(0.0, |sum, x| sum + x)
}

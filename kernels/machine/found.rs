//! Results of reductions, and checks of their arguments.
use crate::Real;
use crate::error::{Argument, Error, Validate};

/// The largest score of a row or column, or the least, and its index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best<T = f32> {
    /// The score.
    pub value: T,
    /// The column (in a row) or the row (in a column); the first of equal scores.
    pub index: usize,
}

/// A pair of two lists and its score, such as one above a threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found<T = f32> {
    /// The row: a shape of the first list.
    pub row: usize,
    /// The column: a shape of the second list.
    pub column: usize,
    /// The score.
    pub value: T,
}

/// Returns an error for a largest score of nothing.
pub(crate) fn check_sides(rows: usize, columns: usize, of_rows: bool) -> Result<(), Error> {
    let (own, other, argument) = match of_rows {
        true => (rows, columns, Argument::B),
        false => (columns, rows, Argument::A),
    };
    if own > 0 && other == 0 {
        return Err(Error::NoLargest { argument });
    }
    Ok(())
}

/// Returns an error for a threshold that is not finite.
pub(crate) fn check_threshold<T: Real>(threshold: T) -> Result<(), Error> {
    threshold.validate().map_err(|flaw| Error::Invalid {
        argument: Argument::Threshold,
        item: 0,
        flaw,
    })
}

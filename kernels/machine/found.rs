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

/// A search for the least results of the pairs within groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Least<T> {
    /// The least of every row, at most a cap.
    Rows(T),
    /// The least of every column, at most a cap.
    Columns(T),
    /// The least of every group, at most a cap.
    Groups(T),
    /// Every pair below a limit.
    Below(T),
}

impl<T: Real> Least<T> {
    /// Returns the cap.
    pub(crate) fn cap(self) -> T {
        match self {
            Least::Rows(cap) | Least::Columns(cap) | Least::Groups(cap) | Least::Below(cap) => cap,
        }
    }
    /// Returns an error for a limit that is not finite and for a cap that is NaN.
    pub(crate) fn check(self) -> Result<(), Error> {
        match self {
            Least::Below(limit) => check_threshold(limit),
            _ if self.cap().equals(self.cap()) => Ok(()),
            _ => check_threshold(self.cap()),
        }
    }
}

/// The result of a search for the least results.
#[derive(Clone, Debug, Default)]
pub struct LeastPairs<T> {
    /// The first of the least pairs of every row, column or group; `None` without a finite result up to the cap.
    pub best: Vec<Option<Found<T>>>,
    /// Every pair below the limit, or every pair with the least result if ties are wanted; ordered by row and then by
    /// column.
    pub pairs: Vec<Found<T>>,
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

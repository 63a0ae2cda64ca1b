//! Checks of the numbers of items and of entries.
use crate::Real;
use crate::error::{Argument, Error, Validate};

/// Checks the number of items of an argument.
pub(crate) fn expect(argument: Argument, expected: usize, found: usize) -> Result<(), Error> {
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

/// Returns the number of scalars in a matrix of items, or an error if it overflows.
pub(crate) fn entries(rows: usize, columns: usize, fields: usize) -> Result<usize, Error> {
    let count = rows
        .checked_mul(columns)
        .and_then(|n| n.checked_mul(fields));
    count
        .filter(|&n| n <= isize::MAX as usize / 8)
        .ok_or(Error::TooLarge)
}

/// Checks that every number is finite.
pub(crate) fn check_finite<T: Real>(argument: Argument, numbers: &[T]) -> Result<(), Error> {
    if numbers.iter().all(|x| x.finite()) {
        return Ok(());
    }
    for (item, x) in numbers.iter().enumerate() {
        x.validate().map_err(|flaw| Error::Invalid {
            argument,
            item,
            flaw,
        })?;
    }
    Ok(())
}

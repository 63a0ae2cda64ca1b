//! A matrix of scores in memory, and its reductions on the CPU.
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::TILE;
use crate::kernels::machine::found::{Best, Found, check_sides, check_threshold};
use crate::kernels::machine::{self, Bests, Founds, InMemory, Matrices, Pending};
use crate::kernels::machine::{Reduced, Reduction};
use crate::kernels::row::item::counts::{entries, expect};
use std::any::Any;

/// Returns the initial maximum of every column.
fn no_best<T: Real>(columns: usize) -> Vec<Best<T>> {
    let value = T::lit(f64::NEG_INFINITY);
    vec![Best { value, index: 0 }; columns]
}

/// A matrix of scores on the CPU, for several reductions.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix<T = f32> {
    rows: usize,
    columns: usize,
    pub(crate) values: Vec<T>,
}

impl<T: Real> Matrix<T> {
    /// Creates a matrix from its numbers in row-major order.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] unless there are rows times columns numbers, [`Error::TooLarge`] when that product overflows.
    ///
    /// ```
    /// use geograd::kernels::reduce::Matrix;
    /// let matrix = Matrix::new(2, 3, vec![0.1, 0.4, 0.2, 0.0, 0.0, 0.9])?;
    /// assert_eq!(matrix.row_max()?[0].index, 1);
    /// assert_eq!(matrix.above(0.3)?.len(), 2);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn new(rows: usize, columns: usize, values: Vec<T>) -> Result<Self, Error> {
        expect(Argument::Values, entries(rows, columns, 1)?, values.len())?;
        Ok(Matrix {
            rows,
            columns,
            values,
        })
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }
    /// Returns the number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }
    /// Returns the numbers in row-major order.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    fn rows_of(&self) -> impl Iterator<Item = &[T]> {
        self.values.chunks(self.columns.max(1))
    }
    /// Returns the largest number of every row and its column; the first of equal ones.
    ///
    /// # Errors
    ///
    /// [`Error::NoLargest`] for rows without columns.
    pub fn row_max(&self) -> Result<Vec<Best<T>>, Error> {
        check_sides(self.rows, self.columns, true)?;
        let best = self.rows_of().map(|row| {
            let value = (kernels_in::<T>().largest)(row);
            let index = row.iter().position(|&x| x == value).unwrap_or(0);
            Best { value, index }
        });
        Ok(best.collect())
    }

    /// Returns the largest number of every column and its row; the first of equal ones.
    ///
    /// # Errors
    ///
    /// [`Error::NoLargest`] for columns without rows.
    pub fn column_max(&self) -> Result<Vec<Best<T>>, Error> {
        check_sides(self.rows, self.columns, false)?;
        let mut best = no_best(self.columns);
        for (index, row) in self.rows_of().enumerate() {
            for (best, &value) in best.iter_mut().zip(row) {
                if value.above(best.value) {
                    *best = Best { value, index };
                }
            }
        }
        Ok(best)
    }

    /// Returns every number above the threshold, ordered by row and then by column.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a threshold that is not finite.
    pub fn above(&self, threshold: T) -> Result<Vec<Found<T>>, Error> {
        check_threshold(threshold)?;
        let mut found = Vec::new();
        for (row, values) in self.rows_of().enumerate() {
            // Most rows of a usual matrix have no number above the threshold.
            if (kernels_in::<T>().largest)(values).above(threshold) {
                let above = values
                    .iter()
                    .enumerate()
                    .filter(|(_, x)| x.above(threshold));
                found.extend(above.map(|(column, &value)| Found { row, column, value }));
            }
        }
        Ok(found)
    }

    /// Returns the number of entries above the threshold.
    ///
    /// # Errors
    ///
    /// As [`above`](Matrix::above).
    pub fn count_above(&self, threshold: T) -> Result<u64, Error> {
        check_threshold(threshold)?;
        Ok((kernels_in::<T>().count_above)(&self.values, threshold))
    }

    /// Returns the sum of all numbers, added in `f64` in a fixed order.
    #[must_use]
    pub fn sum(&self) -> f64 {
        let mut sums = [0.0; TILE];
        for row in self.rows_of() {
            (kernels_in::<T>().add_up)(row, &mut sums);
        }
        sums.iter().sum()
    }

    /// Returns the mean of all numbers; zero for an empty matrix.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.sum() / (self.rows as f64 * self.columns as f64).max(1.0)
    }
}

impl<T: Real> Matrices<T> for Matrix<T> {
    fn size(&self) -> [usize; 2] {
        [self.rows(), self.columns()]
    }
    fn update(&mut self, values: &[T]) -> Result<(), Error> {
        self.values.copy_from_slice(values);
        Ok(())
    }
    fn started(&self) -> Result<Pending<Vec<T>>, Error> {
        Ok(Pending::ready(self.values.clone()))
    }
    fn reduce(&self, reduction: Reduction<T>) -> Result<Reduced<T>, Error> {
        Ok(match reduction {
            Reduction::Best { of_rows: true } => {
                Reduced::Bests(Bests::new(InMemory(self.row_max()?), self.columns()))
            }
            Reduction::Best { of_rows: false } => {
                Reduced::Bests(Bests::new(InMemory(self.column_max()?), self.rows()))
            }
            Reduction::Above(threshold) => {
                Reduced::Founds(Founds::new(InMemory(self.above(threshold)?)))
            }
            Reduction::Count(threshold) => Reduced::Count(self.count_above(threshold)?),
            Reduction::Sum => Reduced::Sum(self.sum()),
        })
    }
    fn duplicate(&self) -> Result<machine::Matrix<T>, Error> {
        Ok(self.boxed())
    }
    fn duplicate_into(&self, to: &mut machine::Matrix<T>) -> Result<(), Error> {
        let to = to.own_mut::<Self>()?;
        expect(Argument::Values, self.rows(), to.rows())?;
        expect(Argument::Values, self.columns(), to.columns())?;
        to.values.copy_from_slice(&self.values);
        Ok(())
    }
    fn boxed(&self) -> machine::Matrix<T> {
        machine::Matrix(Box::new(self.clone()))
    }
    fn any(&self) -> &dyn Any {
        self
    }
    fn any_mut(&mut self) -> &mut dyn Any {
        self
    }
}

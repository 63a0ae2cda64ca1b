//! Tables: the results of all pairs.
use crate::error::Error;
use crate::kernels::row::item::counts::entries;
use crate::kernels::row::item::{Item, Results, item_of, width};
use std::marker::PhantomData;

/// The results of all pairs of two lists: a row per shape of the first list, a column per shape of the second.
///
/// Numbers are stored as planes, one row-major matrix per number of a result. A consumer of millions of results reads
/// them in this order, and a CPU writes no other at full speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<P: Results> {
    rows: usize,
    columns: usize,
    planes: Vec<P::Scalar>,
    result: PhantomData<P>,
}

impl<P: Results> Table<P> {
    /// Returns a table of zeros.
    ///
    /// # Errors
    ///
    /// [`Error::TooLarge`] when its size overflows the address space.
    pub fn new(rows: usize, columns: usize) -> Result<Self, Error> {
        Ok(Table {
            rows,
            columns,
            planes: vec![P::Scalar::default(); entries(rows, columns, P::widths().iter().sum())?],
            result: PhantomData,
        })
    }
    /// Returns the number of rows: shapes of the first list.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }
    /// Returns the number of columns: shapes of the second list.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }
    /// Returns the first number of every result, in row-major order; for results of one number this is the whole table.
    #[must_use]
    pub fn values(&self) -> &[P::Scalar] {
        self.plane(0)
    }
    /// Returns number `k` of every result, in row-major order; empty if results have fewer numbers.
    #[must_use]
    pub fn plane(&self, k: usize) -> &[P::Scalar] {
        let size = self.rows * self.columns;
        self.planes
            .get(k * size..(k + 1) * size)
            .unwrap_or_default()
    }
    /// Returns all numbers plane by plane: plane `k` has number `k` of every result in row-major order.
    #[must_use]
    pub fn planes(&self) -> &[P::Scalar] {
        &self.planes
    }
    /// Returns all numbers for writing, plane by plane.
    #[must_use]
    pub fn planes_mut(&mut self) -> &mut [P::Scalar] {
        &mut self.planes
    }
    /// Returns all numbers plane by plane, as a vector.
    #[must_use]
    pub fn into_planes(self) -> Vec<P::Scalar> {
        self.planes
    }
}

impl<P: Item> Table<P> {
    /// Returns the result of a row with a column.
    ///
    /// # Panics
    ///
    /// If the row or column does not exist.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> P {
        let (rows, columns) = (self.rows, self.columns);
        assert!(
            row < rows && column < columns,
            "pair ({row}, {column}) of {rows} × {columns}"
        );
        let number = |k: usize| self.planes[(k * rows + row) * columns + column];
        let numbers: Vec<P::Scalar> = (0..width::<P>()).map(number).collect();
        item_of(&numbers)
    }
}

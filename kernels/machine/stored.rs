//! Untyped columns of a machine.
use super::column::Column;
use super::machine_column::{FOREIGN, MachineColumn};
use super::pending::Pending;
use crate::Real;
use crate::error::Error;

/// Columns of a machine, without the types of their items.
#[derive(Debug)]
pub struct Stored<T = f32> {
    count: usize,
    pub(super) columns: Vec<Box<dyn MachineColumn<T>>>,
}

impl<T> Default for Stored<T> {
    /// Returns no columns.
    fn default() -> Self {
        Stored {
            count: 0,
            columns: Vec::new(),
        }
    }
}

impl<T: Real> Stored<T> {
    pub(crate) fn new(count: usize, columns: Vec<Box<dyn MachineColumn<T>>>) -> Self {
        Stored { count, columns }
    }
    /// Returns the columns for a call.
    pub(crate) fn columns(&self) -> impl Iterator<Item = Column<'_, T>> {
        let own = self.columns.iter();
        own.map(|own| Column::held(&**own, self.count))
    }
    /// Returns the columns of machine type `C`, or an error for another machine.
    pub(crate) fn own<C: 'static>(&self) -> Result<Vec<&C>, Error> {
        let own = self.columns.iter().map(|own| own.any().downcast_ref());
        own.collect::<Option<_>>().ok_or(FOREIGN)
    }
    /// Returns the number of items.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }
    /// Returns `true` without items.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
    pub(super) fn started(&self) -> Result<Pending<Vec<Vec<T>>>, Error> {
        match self.columns.first() {
            Some(first) => first.started(&self.columns),
            None => Ok(Pending::ready(Vec::new())),
        }
    }
    /// Returns the numbers of the items: of the first shape of every item, item by item, then of the second.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn numbers(&self) -> Result<Vec<Vec<T>>, Error> {
        self.started()?.wait()
    }
    /// Splits the columns after the first ones.
    pub(super) fn cut(self, first: usize) -> [Self; 2] {
        let (count, mut columns) = (self.count, self.columns);
        let others = columns.split_off(first.min(columns.len()));
        [columns, others].map(|columns| Stored { count, columns })
    }
}

/// Columns of plain numbers that stay on the machine.
pub type HeldNumbers = Stored<f32>;

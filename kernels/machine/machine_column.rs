//! The numbers of columns on a machine.
use super::pending::Pending;
use crate::GpuFault;
use crate::error::Error;
use crate::kernels::row::item::Leaf;
use std::any::Any;
use std::fmt;

/// The error for data of another machine.
pub(crate) const FOREIGN: Error = Error::Gpu(GpuFault::ForeignBuffer);

/// The numbers of one shape of every item.
#[derive(Clone, Debug)]
pub struct Numbers<T> {
    /// The number of scalars of a shape.
    pub(crate) fields: usize,
    /// The numbers, shape after shape.
    pub(crate) rows: Vec<T>,
}

/// The numbers of one shape of every item, on a machine.
pub(crate) trait MachineColumn<T>: fmt::Debug + Send + Sync {
    /// Returns the number of scalars of a shape.
    #[doc(hidden)]
    fn fields(&self) -> usize;
    /// Returns the numbers if they are in the memory of the program.
    #[doc(hidden)]
    fn here(&self) -> Option<&[T]>;
    /// Checks shapes, one after another.
    #[doc(hidden)]
    fn check(&self, leaf: Leaf<T>, numbers: &[T]) -> Result<(), Error>;
    /// Replaces the numbers of all shapes; the new ones were checked.
    #[doc(hidden)]
    fn update(&mut self, rows: Vec<T>);
    /// Starts the download of several columns of one machine, this one among them.
    #[doc(hidden)]
    fn started(&self, all: &[Box<dyn MachineColumn<T>>]) -> Result<Pending<Vec<Vec<T>>>, Error>;
    #[doc(hidden)]
    fn any(&self) -> &dyn Any;
}

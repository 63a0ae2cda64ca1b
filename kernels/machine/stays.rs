//! Columns that stay on a machine, each as one that keeps its numbers.
use super::pending::Pending;
use crate::GpuFault;
use crate::error::Error;
use crate::kernels::row::item::Leaf;
use std::any::Any;
use std::fmt;

/// The error for data of another machine.
pub(crate) const FOREIGN: Error = Error::Gpu(GpuFault::ForeignBuffer);

/// Numbers of one shape of every item.
#[derive(Clone, Debug)]
pub struct Numbers<T> {
    /// Numbers of a shape.
    pub(crate) fields: usize,
    /// Shape after shape.
    pub(crate) rows: Vec<T>,
}

/// Numbers of one shape of every item, on a machine.
pub(crate) trait Stays<T>: fmt::Debug + Send + Sync {
    /// Numbers of a shape.
    #[doc(hidden)]
    fn fields(&self) -> usize;
    /// Returns the numbers, if they are in the memory of the program.
    #[doc(hidden)]
    fn here(&self) -> Option<&[T]>;
    /// Checks shapes, one after another.
    #[doc(hidden)]
    fn check(&self, leaf: Leaf<T>, numbers: &[T]) -> Result<(), Error>;
    /// Other numbers, checked, for as many shapes.
    #[doc(hidden)]
    fn update(&mut self, rows: Vec<T>);
    /// Starts the download of columns of the same machine, of which this is one.
    #[doc(hidden)]
    fn started(&self, all: &[Box<dyn Stays<T>>]) -> Result<Pending<Vec<Vec<T>>>, Error>;
    #[doc(hidden)]
    fn any(&self) -> &dyn Any;
}

//! The numbers of columns on a machine.
use super::pending::Pending;
use crate::GpuFault;
use crate::error::Error;
use crate::kernels::row::item::Leaf;
use std::any::Any;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// The error for data of another machine.
pub(crate) const FOREIGN: Error = Error::Gpu(GpuFault::ForeignBuffer);

/// The numbers of one shape of every item.
#[derive(Clone, Debug)]
pub struct Numbers<T> {
    /// The number of scalars of a shape.
    pub(crate) fields: usize,
    /// The numbers, shape after shape.
    pub(crate) rows: Vec<T>,
    /// The preparations that calls have made of them.
    pub(crate) prepared: Prepared,
}

impl<T> Numbers<T> {
    /// Creates the numbers of shapes, of `fields` scalars each.
    pub(crate) fn new(fields: usize, rows: Vec<T>) -> Self {
        Numbers {
            fields,
            rows,
            prepared: Prepared::default(),
        }
    }
    /// Replaces the numbers.
    pub(crate) fn replace(&mut self, rows: Vec<T>) {
        self.rows = rows;
        self.prepared = Prepared::default();
    }
}

/// The most preparations of a column that are kept.
const KEPT: usize = 4;

/// The key of a preparation: the number of the function's recording, the argument, and an option of the preparation.
pub(crate) type PreparedKey = (u64, usize, bool);

/// The preparations that calls have made of a column, kept until its numbers change: those of the last few functions.
#[derive(Default)]
pub(crate) struct Prepared(Mutex<Vec<(PreparedKey, Arc<dyn Any + Send + Sync>)>>);

impl Clone for Prepared {
    /// Returns no preparation: it is made again when it is needed.
    fn clone(&self) -> Self {
        Prepared::default()
    }
}

impl fmt::Debug for Prepared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Prepared")
    }
}

impl Prepared {
    /// Returns the preparation of a key, made at first use.
    ///
    /// # Errors
    ///
    /// The errors of making it; it is not kept then.
    pub(crate) fn made<X: Send + Sync + 'static>(
        &self,
        key: PreparedKey,
        make: impl FnOnce() -> Result<X, Error>,
    ) -> Result<Arc<X>, Error> {
        let all = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = all()
            .iter()
            .find(|own| own.0 == key)
            .map(|own| Arc::clone(&own.1));
        if let Some(Ok(known)) = known.map(Arc::downcast) {
            return Ok(known);
        }
        let made = Arc::new(make()?);
        let mut all = all();
        if all.len() == KEPT {
            all.remove(0);
        }
        all.push((key, made.clone()));
        Ok(made)
    }
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

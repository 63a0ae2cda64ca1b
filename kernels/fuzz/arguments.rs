//! Lists of inputs as columns of numbers.
use crate::Real;

/// A list of inputs of an operation.
#[derive(Clone, Debug, Default)]
pub(super) struct InputColumns<T> {
    /// The numbers of every shape of an input, input after input.
    pub columns: Vec<Vec<T>>,
    /// The numbers of all vertices, if an input has a path.
    pub vertices: Vec<T>,
    /// The first vertex of every path, and the end of the last.
    pub offsets: Vec<usize>,
    /// The number of inputs.
    pub count: usize,
    /// The number of rejected draws outside the domain.
    pub outside: u64,
}

impl<T: Real> InputColumns<T> {
    /// Returns the inputs with their two shapes exchanged.
    pub fn exchanged(&self) -> Self {
        let mut other = self.clone();
        other.columns.swap(0, 1);
        other
    }
    /// Returns the inputs with their first shape in place of the second.
    pub fn twins(&self) -> Self {
        let mut other = self.clone();
        other.columns[1] = other.columns[0].clone();
        other
    }
}

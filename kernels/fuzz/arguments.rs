//! Inputs as columns of numbers.
use crate::Real;

/// Many inputs of an operation.
#[derive(Clone, Debug, Default)]
pub(super) struct Inputs<T> {
    /// For every shape of an input its numbers, input after input.
    pub columns: Vec<Vec<T>>,
    /// Numbers of vertices of paths, where an input has one.
    pub vertices: Vec<T>,
    /// The first vertex of every path, and the end of the last.
    pub offsets: Vec<usize>,
    /// How many inputs.
    pub count: usize,
    /// How many more were drawn outside the domain.
    pub outside: u64,
}

impl<T: Real> Inputs<T> {
    /// With the second shape instead of the first, and the first instead of the second.
    pub fn exchanged(&self) -> Self {
        let mut other = self.clone();
        other.columns.swap(0, 1);
        other
    }
    /// With the first shape instead of the second.
    pub fn twins(&self) -> Self {
        let mut other = self.clone();
        other.columns[1] = other.columns[0].clone();
        other
    }
}

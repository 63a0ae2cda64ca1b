//! Pairs of shapes of one list that overlap: what suppression starts from.
use crate::Error;
use crate::kernels::cpu::{Cpu, Single};
use crate::kernels::op::Runs;
use crate::kernels::reduce::Found;
use crate::suppression::Pair;

impl<T> From<Found<T>> for Pair<T> {
    /// The same pair.
    fn from(found: Found<T>) -> Self {
        Pair {
            first: found.row,
            second: found.column,
            overlap: found.value,
        }
    }
}

impl Cpu {
    /// Every two shapes of a list whose result is above the threshold, each two once: for
    /// [`suppression`](crate::suppression). Of the two the one that comes first in the list is the first
    /// argument.
    ///
    /// # Errors
    ///
    /// As [`above`](Cpu::above).
    pub fn overlaps<A: Single, R>(
        &self,
        run: R,
        shapes: &[A],
        threshold: A::Scalar,
    ) -> Result<Vec<Pair<A::Scalar>>, Error>
    where
        R: Runs<(A, A), Out = A::Scalar>,
    {
        let found = self.above(run, shapes, shapes, threshold)?;
        let ascending = found.into_iter().filter(|pair| pair.row < pair.column);
        Ok(ascending.map(Pair::from).collect())
    }
}

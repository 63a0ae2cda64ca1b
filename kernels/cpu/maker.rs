//! The contract of what computes blocks of items: compiled kernels and interpreted programs.
use crate::kernels::cpu::lane::{Results, Tiles};
use crate::kernels::cpu::program::rowwise::{Given, Wanted};

/// Something that computes blocks of items from one or more arguments.
///
/// Compiled kernels and interpreted programs are makers. A maker does not depend on batches.
pub(crate) trait Maker<T>: Send + Sync {
    /// Computes as many tiles of results as are asked for. Each input has at least as many tiles, or
    /// one that stands for all.
    fn make(&self, inputs: &[Tiles<'_, T>], out: Results<'_, T>);
    /// Returns the same computation from rows of numbers, if there is one.
    fn rows(&self) -> Option<&dyn OverRows<T>> {
        None
    }
}

/// Something that computes items from rows to rows.
pub(crate) trait OverRows<T> {
    /// Computes so many items; rows are prefetched if they are `far`. Results are all but the first ones, which are
    /// skipped.
    fn over_rows(
        &self,
        given: &[Given<'_, T>],
        items: usize,
        skipped: usize,
        wanted: &mut [Wanted<'_, T>],
        far: bool,
    );
}

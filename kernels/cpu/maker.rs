//! The interface of compiled kernels and interpreted programs: both compute blocks of items.
use crate::kernels::cpu::lane::{ResultTiles, Tiles};
use crate::kernels::cpu::program::rowwise::{ArgumentRows, ResultRows};

/// A computation of blocks of items from one or more arguments.
///
/// Compiled kernels and interpreted programs are makers. A maker does not depend on batches.
pub(crate) trait Maker<T>: Send + Sync {
    /// Computes `out.tiles` tiles of results. Each input has at least as many tiles, or one that stands for all.
    fn make(&self, inputs: &[Tiles<'_, T>], out: ResultTiles<'_, T>);
    /// Returns this computation as one over rows of numbers, if it has that form.
    fn rows(&self) -> Option<&dyn OverRows<T>> {
        None
    }
}

/// A computation of items from rows of numbers to rows of numbers.
pub(crate) trait OverRows<T> {
    /// Computes `items` items and prefetches their rows if `far`. The first `skipped` results are not written.
    fn over_rows(
        &self,
        given: &[ArgumentRows<'_, T>],
        items: usize,
        skipped: usize,
        wanted: &mut [ResultRows<'_, T>],
        far: bool,
    );
    /// Returns `true` if to compute items again takes no longer than to read their numbers twice.
    fn is_brief(&self) -> bool {
        true
    }
}

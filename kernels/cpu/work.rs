//! How batches are cut into pieces of work: never depending on the number of threads.

/// Runs every piece of work, on all threads when there are threads.
pub fn spread<W: Send>(work: Vec<W>, run: impl Fn(W) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if work.len() > 1 {
        use rayon::prelude::*;
        work.into_par_iter().with_max_len(1).for_each(run);
        return;
    }
    work.into_iter().for_each(run);
}

/// Rows of a matrix per piece of work: at most 64 pieces, each of them worth a thread's while.
pub fn rows_per_piece(rows: usize) -> usize {
    rows.div_ceil(64).max(16)
}

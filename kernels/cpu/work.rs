//! How batches are cut into pieces of work: never depending on the number of threads.
use std::cell::Cell;

thread_local! {
    /// `true` if batches that this thread calls stay on it.
    static STAYS: Cell<bool> = const { Cell::new(false) };
}

/// Runs batches inside on the calling thread alone; results are the same bits.
///
/// rayon's own pool is as good where all threads may be used. It is not where a call is too small to wake them, or in
/// a process that was forked from one that used them: there are none then, and a call would wait for ever.
///
/// ```
/// use geograd::kernels::dynamic::{Rows, on_this_thread, operation};
/// let iou = operation("iou_obb2").and_then(|iou| iou.value::<f64>()).expect("is listed");
/// let boxes = [0.0, 0.0, 2.0, 2.0, 0.0].repeat(10_000);
/// let all = on_this_thread(|| iou.aligned(&[Rows::new(&boxes, 5), Rows::one(&boxes[..5])]))?;
/// assert_eq!(all[0][9_999], 1.0);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn on_this_thread<R>(run: impl FnOnce() -> R) -> R {
    struct Before(bool);
    impl Drop for Before {
        fn drop(&mut self) {
            STAYS.set(self.0);
        }
    }
    let _before = Before(STAYS.replace(true));
    run()
}

/// Returns `true` if work of the calling thread may use others.
#[cfg(feature = "parallel")]
pub(crate) fn is_spread() -> bool {
    !STAYS.get()
}

/// Runs every piece of work, on all threads when there are threads.
pub fn spread<W: Send>(work: Vec<W>, run: impl Fn(W) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if work.len() > 1 && is_spread() {
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

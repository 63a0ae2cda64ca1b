//! The cut of batches into pieces of work, independent of the number of threads.
use std::cell::Cell;

thread_local! {
    /// `true` if batches called by this thread stay on it.
    static STAYS: Cell<bool> = const { Cell::new(false) };
}

/// Runs batches inside `run` on the calling thread alone; bits do not change.
///
/// It helps where a call is too small for waking threads. A forked process needs it: the threads of its parent's pool
/// do not exist there, so a call would wait for ever.
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

/// Returns `true` if work of the calling thread may run on others.
#[cfg(feature = "parallel")]
pub(crate) fn is_parallel() -> bool {
    !STAYS.get()
}

/// Runs every piece of work, in parallel if threads are allowed.
pub fn in_parallel<W: Send>(work: Vec<W>, run: impl Fn(W) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if work.len() > 1 && is_parallel() {
        use rayon::prelude::*;
        work.into_par_iter().with_max_len(1).for_each(run);
        return;
    }
    work.into_iter().for_each(run);
}

/// Returns the number of rows in a piece of work: there are at most 64 pieces, each worth a thread's start.
pub fn rows_per_piece(rows: usize) -> usize {
    rows.div_ceil(64).max(16)
}

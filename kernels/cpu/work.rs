//! The cut of batches into pieces of work, independent of the number of threads.
use std::cell::{Cell, RefCell};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
#[cfg(feature = "parallel")]
use std::sync::{Mutex, PoisonError};

thread_local! {
    /// `true` if batches called by this thread stay on it.
    static STAYS: Cell<bool> = const { Cell::new(false) };
    /// The interruption of batches called by this thread.
    static INTERRUPTION: RefCell<Interruption> = const { RefCell::new(Interruption(None)) };
}

/// A question to a caller, which any thread may ask.
type Question = dyn Fn() -> bool + Send + Sync;

/// An interruption of batches, which all of their threads share. By default there is none.
#[derive(Clone, Default)]
pub struct Interruption(Option<Arc<(AtomicBool, Box<Question>)>>);

impl std::fmt::Debug for Interruption {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Interruption")
            .field(&self.0.is_some())
            .finish()
    }
}

impl Interruption {
    /// Returns that of batches called by this thread.
    #[must_use]
    pub fn current() -> Self {
        INTERRUPTION.with_borrow(Clone::clone)
    }
    /// Returns `true` once the batches shall end.
    #[must_use]
    #[inline]
    pub fn is_due(&self) -> bool {
        self.0.as_ref().is_some_and(|own| {
            let is_due = own.0.load(Ordering::Relaxed) || (own.1)();
            if is_due {
                own.0.store(true, Ordering::Relaxed);
            }
            is_due
        })
    }
    /// Runs a part of a batch on the calling thread.
    fn within<R>(&self, run: impl FnOnce() -> R) -> R {
        struct Before(Interruption);
        impl Drop for Before {
            fn drop(&mut self) {
                INTERRUPTION.set(std::mem::take(&mut self.0));
            }
        }
        if self.0.is_none() {
            return run();
        }
        let _before = Before(INTERRUPTION.replace(self.clone()));
        run()
    }
}

/// Runs batches inside `run` until `is_over` returns `true`, and `None` then. Threads ask between blocks of work.
///
/// A batch that ends early leaves its results incomplete, those that it writes to the caller's memory, too.
///
/// ```
/// use geograd::kernels::dynamic::{Rows, interruptible, operation};
/// let iou = operation("iou_obb2").and_then(|iou| iou.value::<f64>()).expect("is listed");
/// let boxes = [0.0, 0.0, 2.0, 2.0, 0.0].repeat(10_000);
/// let all = || iou.aligned(&[Rows::new(&boxes, 5), Rows::one(&boxes[..5])]);
/// assert!(interruptible(|| true, all).is_none());
/// assert_eq!(interruptible(|| false, all).expect("is complete")?[0][9_999], 1.0);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn interruptible<R>(
    is_over: impl Fn() -> bool + Send + Sync + 'static,
    run: impl FnOnce() -> R,
) -> Option<R> {
    let own = Interruption(Some(Arc::new((AtomicBool::new(false), Box::new(is_over)))));
    let result = own.within(run);
    let has_ended = own.0.is_some_and(|own| own.0.load(Ordering::Relaxed));
    (!has_ended).then_some(result)
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

/// Runs every piece of work, in parallel if threads are allowed. Leaves out what follows an interruption.
pub fn in_parallel<W: Send>(work: Vec<W>, run: impl Fn(W) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if work.len() > 1 && is_parallel() {
        let work: Vec<_> = work
            .into_iter()
            .map(|work| Mutex::new(Some(work)))
            .collect();
        on_all_threads(work.len(), &|place| {
            let mut piece = work[place].lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(work) = piece.take() {
                drop(piece);
                run(work);
            }
        });
        return;
    }
    let interruption = Interruption::current();
    for work in work {
        if interruption.is_due() {
            return;
        }
        run(work);
    }
}

/// Calls a function with every number below a count on all threads, until an interruption. It is compiled once for all
/// kinds of work.
#[cfg(feature = "parallel")]
fn on_all_threads(count: usize, run: &(dyn Fn(usize) + Send + Sync)) {
    use rayon::prelude::*;
    let interruption = Interruption::current();
    (0..count)
        .into_par_iter()
        .with_max_len(1)
        .for_each(|place| {
            if !interruption.is_due() {
                interruption.within(|| run(place));
            }
        });
}

/// Returns the number of rows in a piece of work: there are at most 64 pieces, each worth a thread's start.
pub fn rows_per_piece(rows: usize) -> usize {
    rows.div_ceil(64).max(16)
}

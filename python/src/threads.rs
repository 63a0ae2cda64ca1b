//! The thread pool of this process; a forked child needs its own, since threads do not survive a fork.
use geograd::kernels::dynamic::{interruptible, on_this_thread};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The pool of a process: the process number, the number of threads, and the pool.
struct ProcessPool {
    process: u32,
    threads: usize,
    pool: Arc<rayon::ThreadPool>,
}

static POOL: Mutex<Option<ProcessPool>> = Mutex::new(None);
/// The number of threads of calls; zero before the first call.
static THREADS: AtomicUsize = AtomicUsize::new(0);

thread_local! {
    /// The lock of the pool while this thread forks.
    static HELD: RefCell<Option<MutexGuard<'static, Option<ProcessPool>>>> = const { RefCell::new(None) };
}

fn lock() -> MutexGuard<'static, Option<ProcessPool>> {
    POOL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The largest number of threads: starting more takes seconds.
const MOST: usize = 1024;

/// Returns an error unless a number of threads is from 1 to [`MOST`].
fn allowed(name: &str, threads: Option<i64>, given: &str) -> PyResult<usize> {
    let threads = threads.and_then(|n| usize::try_from(n).ok());
    threads.filter(|n| (1..=MOST).contains(n)).ok_or_else(|| {
        PyValueError::new_err(format!(
            "{name}: a whole number from 1 to {MOST} is needed, not {given}"
        ))
    })
}

/// How many threads calls use: `GEOGRAD_THREADS`, or as many as there are processors.
#[pyfunction]
pub fn get_num_threads() -> PyResult<usize> {
    match THREADS.load(Ordering::Relaxed) {
        0 => {
            let asked = std::env::var("GEOGRAD_THREADS").unwrap_or_default();
            let all = || std::thread::available_parallelism().map_or(1, usize::from);
            let threads = match asked.trim() {
                "" => all().min(MOST),
                asked => allowed("GEOGRAD_THREADS", asked.parse().ok(), asked)?,
            };
            THREADS.store(threads, Ordering::Relaxed);
            Ok(threads)
        }
        threads => Ok(threads),
    }
}

/// Sets how many threads calls use, from 1 to 1024.
#[pyfunction]
pub fn set_num_threads(threads: i64) -> PyResult<()> {
    let threads = allowed("threads", Some(threads), &threads.to_string())?;
    THREADS.store(threads, Ordering::Relaxed);
    Ok(())
}

/// Takes the lock of the pool, so that no other thread holds it in the child.
#[pyfunction]
pub fn before_fork() {
    HELD.with_borrow_mut(|held| {
        if held.is_none() {
            *held = Some(lock());
        }
    });
}
/// Gives it back, in the parent and in the child.
#[pyfunction]
pub fn after_fork() {
    HELD.with_borrow_mut(|held| *held = None);
}

/// Returns the pool of this process.
fn pool(threads: usize) -> PyResult<Arc<rayon::ThreadPool>> {
    let process = std::process::id();
    let mut kept = lock();
    if let Some(kept) = &*kept
        && kept.process == process
        && kept.threads == threads
    {
        return Ok(kept.pool.clone());
    }
    let made = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let made = made.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let made = Arc::new(made);
    let new = ProcessPool {
        process,
        threads,
        pool: made.clone(),
    };
    if let Some(old) = kept.replace(new) {
        // Dropping it in a child would wait for threads that do not exist there.
        if old.process != process {
            std::mem::forget(old);
        }
    }
    Ok(made)
}

/// The number of items below which a call runs on its own thread: the library does not split so small a batch.
pub const FEW: usize = 2048;

/// The number of items below which a call keeps Python's lock: it lasts some microseconds, and other threads wait for
/// milliseconds anyway.
const BRIEF: usize = 256;

/// The milliseconds between two looks at Python's signals: a key press and its exception are less than twice as far
/// apart, and a look takes some microseconds.
const LOOKS: u64 = 100;

/// A watch for signals while a call runs without Python's lock, such as the one of Ctrl-C.
struct Watch {
    begun: Instant,
    /// When to look again, in milliseconds after the begin.
    next: AtomicU64,
    /// The exception that ends the call.
    raised: Mutex<Option<PyErr>>,
}

impl Watch {
    fn new() -> Self {
        Watch {
            begun: Instant::now(),
            next: AtomicU64::new(LOOKS),
            raised: Mutex::new(None),
        }
    }
    fn raised(&self) -> MutexGuard<'_, Option<PyErr>> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner)
    }
    /// Runs Python's handlers of signals where it is time to. Returns `true` once one has raised an exception.
    fn look(&self) -> bool {
        let now = u64::try_from(self.begun.elapsed().as_millis()).unwrap_or(u64::MAX);
        if now < self.next.load(Ordering::Relaxed) {
            return false;
        }
        // Any call of Python runs handlers, that of the second question, too.
        let found = Python::attach(|py| py.check_signals().and_then(|()| is_main(py)));
        // They run in the main thread alone, so that another one need not look again.
        let next = match found {
            Ok(false) => u64::MAX,
            _ => now + LOOKS,
        };
        self.next.store(next, Ordering::Relaxed);
        match found {
            Ok(_) => false,
            Err(error) => {
                *self.raised() = Some(error);
                true
            }
        }
    }
}

/// Returns `true` in Python's main thread.
fn is_main(py: Python<'_>) -> PyResult<bool> {
    let threading = py.import("threading")?;
    let own = threading.call_method0("get_ident")?;
    own.eq(threading.call_method0("main_thread")?.getattr("ident")?)
}

/// Runs a call without Python's lock, on the threads of this process. A signal's handler may end it by an exception.
pub fn on_threads<R: Send>(
    py: Python<'_>,
    items: usize,
    run: impl FnOnce() -> R + Send,
) -> PyResult<R> {
    let (mut run, mut result) = (Some(run), None);
    let is_complete = carried_out(py, items, &mut || result = run.take().map(|run| run()))?;
    let result = result.filter(|_| is_complete);
    result.ok_or_else(|| PyRuntimeError::new_err("the call was interrupted"))
}

/// As [`on_threads`], for a function without a type of its own, so that pools and watches are compiled once. Returns
/// `false` if the call was interrupted.
fn carried_out(py: Python<'_>, items: usize, run: &mut (dyn FnMut() + Send)) -> PyResult<bool> {
    let threads = get_num_threads()?;
    if items <= BRIEF {
        on_this_thread(run);
        return Ok(true);
    }
    if items <= FEW {
        py.detach(|| on_this_thread(run));
        return Ok(true);
    }
    let watch = Arc::new(Watch::new());
    let own = watch.clone();
    let result = match threads {
        1 => py.detach(|| on_this_thread(|| interruptible(move || own.look(), run))),
        _ => py.detach(|| {
            let is_over = Arc::new(AtomicBool::new(false));
            let asked = is_over.clone();
            let (done, wait) = mpsc::channel::<()>();
            let mut result = None;
            pool(threads)?.in_place_scope(|scope| {
                scope.spawn(|_| {
                    result = interruptible(move || asked.load(Ordering::Relaxed), run);
                    drop(done);
                });
                // The threads of the pool compute; this one, which may be Python's main thread, looks.
                let pause = Duration::from_millis(LOOKS);
                while wait.recv_timeout(pause) == Err(RecvTimeoutError::Timeout) {
                    if own.look() {
                        is_over.store(true, Ordering::Relaxed);
                    }
                }
            });
            PyResult::Ok(result)
        })?,
    };
    match watch.raised().take() {
        Some(error) => Err(error),
        None => Ok(result.is_some()),
    }
}

//! The thread pool of this process; a forked child needs its own, since threads do not survive a fork.
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::cell::RefCell;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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

/// Runs a call without Python's lock, on the threads of this process.
pub fn on_threads<R: Send>(
    py: Python<'_>,
    items: usize,
    run: impl FnOnce() -> R + Send,
) -> PyResult<R> {
    let threads = get_num_threads()?;
    if threads == 1 || items <= FEW {
        return Ok(py.detach(|| geograd::kernels::dynamic::on_this_thread(run)));
    }
    py.detach(|| {
        let pool = pool(threads)?;
        Ok(pool.install(run))
    })
}

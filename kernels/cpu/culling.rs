//! Leaving out pairs that are apart for certain.
use std::sync::atomic::{AtomicBool, Ordering};

static OFF: AtomicBool = AtomicBool::new(false);

/// Switches the filter of all-pairs batches on (as it is from the start) or off, for the whole
/// process.
///
/// The filter compares bounds before anything else is computed. Results are the same bits either way;
/// where nearly all pairs overlap it costs a few hundredths of the time, which it notices and saves.
pub fn cull(on: bool) {
    OFF.store(!on, Ordering::Relaxed);
}

pub(crate) fn is_on() -> bool {
    !OFF.load(Ordering::Relaxed)
}

//! Search for the simplest input that fails for the same reason. [`examine`](fn@crate::ad::check::examine) calls it for
//! the first failures of a report.
use crate::ad::check::candidate::Candidate;
use crate::ad::check::tolerances::{FEW_INPUTS, SHRINKING, SHRINKING_TIME};
use crate::ad::check::verdict::{Fault, Findings, Smoothness};
use crate::ad::sample::fewer_digits;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// The effort that is left to make inputs simple.
pub(crate) struct Effort {
    /// The count of numbers that all tried inputs may have together.
    numbers: usize,
    /// The time that a search may take; without end where there is no clock.
    time: Duration,
}

impl Effort {
    /// Returns the effort for a report.
    pub(crate) fn new() -> Self {
        Effort {
            numbers: SHRINKING,
            time: SHRINKING_TIME,
        }
    }
    /// Leaves a quarter of the effort at most.
    pub(crate) fn quarter(&mut self) {
        self.numbers = self.numbers.min(SHRINKING / 4);
        self.time = self.time.min(SHRINKING_TIME / 4);
    }
}

/// Returns `true` if two faults have one reason and no other witness is outvoted.
pub(crate) fn is_like(found: &Fault, fault: &Fault) -> bool {
    let blamed = fault.suspect.is_none() || found.suspect == fault.suspect;
    found.reason == fault.reason && blamed
}

/// Returns the simplest input found that fails in the same way: for the same reason, at the same number of an input of
/// the same length, with the same smoothness, with no other witness outvoted. A function that panics at an input of
/// another length does not fail there in the same way.
pub(crate) fn shrunk<'a>(
    x: &dyn Candidate<'a>,
    fault: Fault,
    place: Smoothness,
    effort: &mut Effort,
    judged: &mut dyn FnMut(&dyn Candidate<'a>) -> Option<Findings>,
) -> (Box<dyn Candidate<'a> + 'a>, Fault) {
    // No time is known on WebAssembly.
    let start = (!cfg!(target_family = "wasm")).then(Instant::now);
    let numbers = x.numbers();
    let mut least = (x.refilled(&numbers), fault);
    loop {
        let numbers = least.0.numbers();
        let count = numbers.len();
        let like = &least.0;
        let rounded = fewer_digits(numbers).map(|list| like.refilled(&list));
        let mut candidates = like.fewer().chain(rounded);
        let found = candidates.find_map(|candidate| {
            let length = candidate.numbers().len();
            effort.numbers = effort.numbers.saturating_sub(length.max(FEW_INPUTS));
            let is_late = start.is_some_and(|start| start.elapsed() > effort.time);
            if effort.numbers == 0 || is_late {
                return Some(None);
            }
            let found = catch_unwind(AssertUnwindSafe(|| judged(&*candidate))).ok()??;
            let same_place = |f: &Fault| {
                let own = (f.output, f.input) == (least.1.output, least.1.input);
                own || length != count || fault.numbers.along
            };
            let same = |f: &Fault| is_like(f, &fault) && same_place(f);
            let same = found.faults.into_iter().find(same)?;
            (found.place == place).then_some(Some((candidate, same)))
        });
        drop(candidates);
        match found.flatten() {
            Some(found) => least = found,
            None => return least,
        }
    }
}

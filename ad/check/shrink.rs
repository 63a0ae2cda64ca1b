//! Smaller inputs that fail the same way, and inputs as code.
use crate::Pack;
use crate::ad::check::tolerances::{FEW_INPUTS, SHRINKING};
use crate::ad::check::trace::Number;
use crate::ad::check::verdict::{Fault, Findings, Place};
use crate::ad::sample::simpler;
use std::fmt::Debug;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The simplest input found that fails in the same way: for the same reason, at the same number of an
/// input of the same length, at the same kind of place, with no other witness outvoted. A function
/// that panics at an input of another length does not fail there in the same way.
pub(crate) fn shrunk<S: Number, X: Pack<Scalar = S> + Debug>(
    x: &X,
    fault: Fault,
    place: Place,
    mut judged: impl FnMut(&X) -> Option<Findings>,
) -> (X, Fault) {
    let mut least = (x.clone(), fault);
    let mut left = SHRINKING;
    loop {
        let count = least.0.count();
        let affordable = |candidate: &X| {
            let cost = candidate.count().max(FEW_INPUTS);
            left = left.saturating_sub(cost);
            left > 0
        };
        let mut candidates = simpler(&least.0).take_while(affordable);
        let found = candidates.find_map(|candidate| {
            let found = catch_unwind(AssertUnwindSafe(|| judged(&candidate))).ok()??;
            let same_place = |f: &Fault| {
                let own = (f.output, f.input) == (least.1.output, least.1.input);
                own || candidate.count() != count || fault.numbers.along
            };
            let same = |f: &Fault| {
                let blamed = fault.suspect.is_none() || f.suspect == fault.suspect;
                f.reason == fault.reason && blamed && same_place(f)
            };
            let same = found.faults.into_iter().find(same)?;
            (found.place == place).then_some((candidate, same))
        });
        drop(candidates);
        match found {
            Some(found) => least = found,
            None => return least,
        }
    }
}

/// An input as code.
pub(crate) fn code<X: Debug>(x: &X) -> String {
    let text = format!("{x:?}");
    let name = std::any::type_name::<X>();
    if name.contains("Vec<") && !name.contains('[') {
        // Every list is one of run-time length.
        text.replace('[', "vec![")
    } else if name.starts_with("alloc::vec::Vec") {
        format!("vec!{text}")
    } else {
        text
    }
}

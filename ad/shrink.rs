//! Smaller inputs that fail the same way, and inputs as code.
use crate::Pack;
use crate::ad::trace::Number;
use crate::ad::verdict::Fault;
use std::fmt::Debug;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How many numbers simpler inputs of a failure may have together: 400 short inputs are tried.
const WORK: usize = 400 * 48;

/// Simpler inputs, simplest first: fewer elements, then fewer digits. For shrinking.
pub fn simpler<S: Number, X: Pack<Scalar = S>>(x: &X) -> impl Iterator<Item = X> {
    let list: Vec<S> = x.scalars();
    let rounded = (0..list.len()).flat_map(move |i| {
        let (at, list) = (list[i].widen(), list.clone());
        let power = if at == 0.0 {
            1.0
        } else {
            10_f64.powi(at.abs().log10().floor() as i32)
        };
        let simple = [
            0.0,
            at.signum(),
            at.round(),
            (at / power).round() * power,
            (at * 64.0).round() / 64.0,
        ];
        // Simpler means fewer digits, or it might go round in circles.
        let simple = simple.into_iter().filter(move |s| digits(*s) < digits(at));
        simple.map(move |simple| {
            let mut simpler = list.clone();
            simpler[i] = S::nearest(simple);
            x.refill(&simpler)
        })
    });
    x.fewer().chain(rounded)
}

/// How long a number is when written out.
fn digits(x: f64) -> usize {
    if x == 0.0 { 0 } else { format!("{x:e}").len() }
}

/// The simplest input found that fails for the same reason. A function that panics at an input of
/// another length does not fail there for the same reason.
pub(crate) fn shrunk<S: Number, X: Pack<Scalar = S> + Debug>(
    x: &X,
    fault: Fault,
    mut faults: impl FnMut(&X) -> Vec<Fault>,
) -> (X, Fault) {
    let mut least = (x.clone(), fault);
    let mut left = WORK;
    loop {
        let found = simpler(&least.0).find_map(|candidate| {
            left = left.saturating_sub(candidate.count().max(48));
            if left == 0 {
                return None;
            }
            let found = catch_unwind(AssertUnwindSafe(|| faults(&candidate))).unwrap_or_default();
            let same = found.into_iter().find(|f| f.reason == fault.reason)?;
            Some((candidate, same))
        });
        match found {
            Some(found) => least = found,
            None => return least,
        }
    }
}

/// An input as code.
pub(crate) fn code<X: Debug>(x: &X) -> String {
    let text = format!("{x:?}");
    if std::any::type_name::<X>().starts_with("alloc::vec::Vec") {
        format!("vec!{text}")
    } else {
        text
    }
}

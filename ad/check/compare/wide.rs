//! Comparison of a function of `f32` with its source in `f64`. It decides if values and derivatives agree within the
//! rounding of the inputs and of single precision. [`judge`](crate::ad::check::judge) calls it.
use crate::ad::check::evidence::{Combination, Evidence, SMALLEST, comparison, finite};
use crate::ad::check::notes::Notes;
use crate::ad::check::subject::Subject;
use crate::ad::check::tolerances::{FEW_INPUTS, ROUNDINGS, SAFETY, SCATTER};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::{combined, dot};
use crate::ad::declared::Jumps;

/// Compares values and derivatives with those in double precision, at the same inputs of single precision.
///
/// The value of an operation may be off by the change of the exact function when inputs move by twice their rounding
/// (that of numbers of one unit is the rounding of the largest). The change of the value in single precision does not
/// count: a formula that scatters its results has errors of that size. Edges a millionth from parallel are no such
/// case, since there the function itself moves. Terms that cancel may add the error that the row declares
/// ([`roundings`](Subject::roundings)). A derivative may scatter a hundred times as much. The numbers of a closure have
/// unknown units, so its own roughness is allowed.
pub(crate) fn wide(e: &Evidence<'_>) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let Some(wide) = e.wide.as_deref() else {
        return notes;
    };
    let value = wide.value(e.x);
    if !finite(&value) {
        return notes;
    }
    notes.add(values(e, wide, &value));
    // Longer inputs are compared along directions ([`projection`](super::projection)).
    if e.x.len() <= FEW_INPUTS {
        for row in &e.rows {
            notes.add(derivatives(e, wide, row));
        }
    }
    notes
}

fn values(e: &Evidence<'_>, wide: &dyn Subject, value: &[f64]) -> Notes {
    let mut notes = Notes::new(e.x.len());
    // Decisions may fall differently in the other format, so changes of branch count as deviation.
    let f = |x: &[f64]| Some(wide.value(x));
    let mut deviation = e.deviation(value, None, f);
    let count = value.len().min(e.y.len());
    let plain = |j: usize| ROUNDINGS * e.eps * f64::max(value[j].abs(), e.y[j].abs());
    let outside = |deviation: &[f64]| {
        let off = |j: usize| (value[j] - e.y[j]).abs() > plain(j) + SAFETY * deviation[j];
        (0..count).any(off)
    };
    if !e.subject.comparable() {
        let own = e.deviation(&e.y, None, |x| Some(e.subject.value(x)));
        deviation
            .iter_mut()
            .zip(own)
            .for_each(|(deviation, own)| *deviation += own);
    } else if outside(&deviation) {
        deviation = e.deviation_of_many(value, f);
    }
    for j in 0..count {
        let (narrow, value) = (e.y[j], value[j]);
        let own = e.resolution[j].max(e.cancelled);
        let off = deviation[j].max(own).max(reach(e, j));
        let tolerance = plain(j) + SAFETY * off;
        if e.both_saturated(narrow, value) {
            continue;
        }
        // At a hit of a corner, single precision may decide near the input as double precision decides at the input.
        let decided = |there: &[f64]| {
            let near = e.subject.value(there);
            near.get(j).is_some_and(|y| (y - value).abs() <= plain(j))
        };
        let jumps = e.subject.conventions().jumps == Jumps::Anywhere;
        if (value - narrow).abs() > tolerance && !(jumps && e.holds_nearby(decided)) {
            let reason = Reason::ValuesDisagree(Witness::Wide);
            let numbers = ByWitness::pair(narrow, value);
            notes.add_fault_with(reason, None, (j, 0), numbers, tolerance);
        }
    }
    notes
}

/// Returns the change of an output within the rounding of the inputs, by the derivatives by hand; zero for a closure.
fn reach(e: &Evidence<'_>, output: usize) -> f64 {
    let alone = |row: &&Combination| {
        row.weights
            .iter()
            .enumerate()
            .all(|(j, w)| (*w != 0.0) == (j == output))
    };
    let row = e.rows.iter().find(alone);
    match row.and_then(|row| row.adjoint.as_ref()) {
        Some(adjoint) if e.subject.comparable() => {
            let each = adjoint.iter().zip(e.x);
            each.map(|(derivative, x)| (derivative * x).abs() * e.eps)
                .sum()
        }
        _ => 0.0,
    }
}

fn derivatives(e: &Evidence<'_>, wide: &dyn Subject, row: &Combination) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let by_duals = |x: &[f64]| {
        let jacobian = wide.jacobian(x)?;
        Some(combined(&row.weights, &jacobian, x.len()))
    };
    let (Some(exact), Some(adjoint)) = (by_duals(e.x), &row.adjoint) else {
        return notes;
    };
    if !finite(&exact) {
        return notes;
    }
    let weight: f64 = row.weights.iter().map(|weight| weight.abs()).sum();
    let cancelled = |i: usize| SAFETY * weight * e.cancelled / e.units[i];
    let mut tolerance = row.plain.clone();
    let outside =
        |tolerance: &[f64]| (0..exact.len()).any(|i| (exact[i] - adjoint[i]).abs() > tolerance[i]);
    let perturbed = outside(&tolerance);
    // A quotient has a derivative of its own size divided by its divisor, before anything cancels.
    let value = dot(&row.weights, &e.y).abs();
    // Rounding decides a value of its own size: shapes that touch may be apart.
    let lost = value <= SAFETY * reach(e, row.output);
    let plain = |i: usize| match e.x[i] {
        x if x != 0.0 && e.subject.comparable() => {
            row.plain[i].max(ROUNDINGS * e.eps * value / x.abs())
        }
        _ => row.plain[i],
    };
    if perturbed {
        let by_hand = |x: &[f64]| e.subject.adjoint(x, &row.weights);
        let own = e.deviation(adjoint, None, by_hand);
        let rough = e.rough_derivatives(&row.weights, adjoint, &by_hand);
        let with = |theirs: &[f64]| -> Vec<f64> {
            let each = (0..exact.len()).map(|i| {
                let function = plain(i) + SAFETY * theirs[i];
                let formula = SAFETY * own[i].max(rough[i]);
                let both = match e.subject.comparable() && !lost {
                    true => function + formula.min(SCATTER * function),
                    false => function + formula,
                };
                both + cancelled(i)
            });
            each.collect()
        };
        tolerance = with(&e.deviation(&exact, None, by_duals));
        if outside(&tolerance) && e.subject.comparable() {
            tolerance = with(&e.deviation_of_many(&exact, by_duals));
        }
    }
    let within = |found: &[f64]| {
        let each = found.iter().zip(&exact).zip(&tolerance);
        each.len() == exact.len() && each.clone().all(|((a, b), most)| (a - b).abs() <= *most)
    };
    // At a tie single precision may decide near the input as double precision decides at the input.
    let decided = |there: &[f64]| {
        let near = e.subject.adjoint(there, &row.weights);
        near.is_some_and(|near| within(&near))
    };
    if outside(&tolerance) && e.holds_nearby(decided) {
        notes.judged.fill(true);
        return notes;
    }
    // Below the smallest number of single precision there are no digits.
    tolerance
        .iter_mut()
        .for_each(|tolerance| *tolerance = tolerance.max(SMALLEST));
    for i in 0..exact.len() {
        notes.judged[i] = true;
        let gap = (exact[i] - adjoint[i]).abs();
        let numbers = ByWitness {
            adjoint: Some(adjoint[i]),
            dual: row.dual.as_ref().map(|dual| dual[i]),
            other: Some(exact[i]),
            ..ByWitness::default()
        };
        let mut at = comparison(row, i, numbers, tolerance[i]);
        at.perturbed = perturbed;
        notes.compared(3, gap, row.size[i], e.eps, at);
        if gap > tolerance[i] {
            let reason = Reason::Disagree(Witness::Adjoint, Witness::Wide);
            let suspect = Some(Witness::Adjoint);
            notes.add_fault_with(reason, suspect, (row.output, i), numbers, tolerance[i]);
        }
    }
    notes
}

//! A function of `f32` against itself in `f64`, as far as single precision can tell.
use crate::ad::check::evidence::{Evidence, Row, finite};
use crate::ad::check::notes::{Notes, comparison};
use crate::ad::check::subject::Subject;
use crate::ad::check::tolerances::{FEW_INPUTS, ROUNDINGS, SAFETY};
use crate::ad::check::verdict::{Numbers, Reason, Witness};
use crate::ad::check::witness::combined;

/// Values and slopes against those in double precision.
pub(crate) fn wide(e: &Evidence<'_>) -> Notes {
    let mut said = Notes::new(e.x.len());
    let Some(wide) = e.wide.as_deref() else {
        return said;
    };
    let value = wide.value(e.x);
    if !finite(&value) {
        return said;
    }
    said.add(values(e, wide, &value));
    // Longer inputs are projected.
    if e.x.len() <= FEW_INPUTS {
        for row in &e.rows {
            said.add(slopes(e, wide, row));
        }
    }
    said
}

fn values(e: &Evidence<'_>, wide: &dyn Subject, value: &[f64]) -> Notes {
    let mut said = Notes::new(e.x.len());
    // Decisions may fall differently in the other format, so other branches count as spread.
    let spread = e.spread(value, None, |x| Some(wide.value(x)));
    let own = e.spread(&e.y, None, |x| Some(e.subject.value(x)));
    for j in 0..value.len().min(e.y.len()) {
        let (narrow, value) = (e.y[j], value[j]);
        let off = (spread[j] + own[j]).max(e.resolution[j]);
        let tolerance = ROUNDINGS * e.eps * value.abs().max(narrow.abs()) + SAFETY * off;
        if e.both_saturated(narrow, value) {
            continue;
        }
        if (value - narrow).abs() > tolerance {
            let reason = Reason::ValuesDisagree(Witness::Wide);
            let numbers = Numbers::pair(narrow, value);
            said.complain_of(reason, None, (j, 0), numbers, tolerance);
        }
    }
    said
}

fn slopes(e: &Evidence<'_>, wide: &dyn Subject, row: &Row) -> Notes {
    let mut said = Notes::new(e.x.len());
    let by_duals = |x: &[f64]| {
        let jacobian = wide.jacobian(x)?;
        Some(combined(&row.weights, &jacobian, x.len()))
    };
    let (Some(exact), Some(adjoint)) = (by_duals(e.x), &row.adjoint) else {
        return said;
    };
    if !finite(&exact) {
        return said;
    }
    let mut tolerance = row.plain.clone();
    let outside = (0..exact.len()).any(|i| (exact[i] - adjoint[i]).abs() > tolerance[i]);
    if outside {
        let by_hand = |x: &[f64]| e.subject.adjoint(x, &row.weights);
        let theirs = e.spread(&exact, None, by_duals);
        let own = e.spread(adjoint, None, by_hand);
        let rough = e.rough_slopes(&row.weights, adjoint, &by_hand);
        for i in 0..tolerance.len() {
            tolerance[i] += SAFETY * (theirs[i] + own[i].max(rough[i]));
        }
    }
    for i in 0..exact.len() {
        said.covered[i] = true;
        let gap = (exact[i] - adjoint[i]).abs();
        let numbers = Numbers {
            adjoint: Some(adjoint[i]),
            dual: row.dual.as_ref().map(|dual| dual[i]),
            other: Some(exact[i]),
            ..Numbers::default()
        };
        let mut at = comparison(row, i, numbers, tolerance[i]);
        at.provoked = outside;
        said.compared(3, gap, row.size[i], e.eps, at);
        if gap > tolerance[i] {
            let reason = Reason::Disagree(Witness::Adjoint, Witness::Wide);
            let suspect = Some(Witness::Adjoint);
            said.complain_of(reason, suspect, (row.output, i), numbers, tolerance[i]);
        }
    }
    said
}

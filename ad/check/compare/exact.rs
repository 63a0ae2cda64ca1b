//! Comparison of the adjoint with the exact witnesses: duals, num-dual's numbers, batches and further witnesses. They
//! take no steps, so only rounding may separate them. It decides per number of the input; rounding is perturbed where
//! they differ. [`judge`](crate::ad::check::judge) calls it first.
use crate::ad::check::compare::values::another;
use crate::ad::check::evidence::{Combination, Evidence, comparison};
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{CONVENTION_BORDER, DECIDED, FEW_INPUTS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::dot;

/// Returns `true` if a convention may decide about this derivative: the value is zero and the input cannot be moved in
/// both directions.
pub(crate) fn conventional_border(e: &Evidence<'_>, row: &Combination, i: usize) -> bool {
    let stuck = |sign: f64| {
        let mut there = e.x.to_vec();
        there[i] += sign * CONVENTION_BORDER * e.scales[i];
        !e.subject.inside(&there)
    };
    e.subject.conventions().flat && dot(&row.weights, &e.y) == 0.0 && (stuck(1.0) || stuck(-1.0))
}

/// Compares all rows with all witnesses that take no steps.
pub(crate) fn exact(e: &Evidence<'_>) -> Notes {
    let mut notes = Notes::new(e.x.len());
    for row in &e.rows {
        notes.add(one_row(e, row));
    }
    notes
}

/// Returns the error that a witness other than the adjoint and the duals may have, per number. It is the change of its
/// derivative when inputs move by their last digits, or when its own roundings fall differently. `form` is the
/// number of the batch.
fn rounding_of(
    e: &Evidence<'_>,
    row: &Combination,
    (witness, form): (Witness, usize),
    notes: &[f64],
) -> Vec<f64> {
    // In the backward pass, edges that are nearly parallel give terms that are larger than the derivative by this
    // factor. Their rounding may be as large as the derivative itself, without another decision.
    let sizes: Vec<f64> = row.size.iter().map(|size| size / DECIDED).collect();
    if witness == Witness::NumDual {
        // SubjectRef as strictly as our own duals.
        let by_them = |x: &[f64]| e.by_num_dual(row, x);
        let along = |axis: &[f64]| e.num_dual_along(row, e.x, axis);
        return e.rounding_of_duals(row, notes, &by_them, &along);
    }
    let mut deviation = e.deviation(notes, Some(&sizes), |x| match witness {
        Witness::Further(k) => e.subject.further(x, &row.weights).into_iter().nth(k),
        _ => Some(e.subject.batch(form, x, &row.weights)?.1),
    });
    if let Witness::Further(k) = witness {
        let noisy = |seed| e.subject.noisy_further(e.x, &row.weights, k, seed);
        let own = e.roundings_of_each(notes, &sizes, noisy);
        for (deviation, own) in deviation.iter_mut().zip(own) {
            *deviation = deviation.max(own);
        }
    }
    deviation
}

fn one_row(e: &Evidence<'_>, row: &Combination) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let Some(adjoint) = &row.adjoint else {
        return notes;
    };
    let further = e.subject.further(e.x, &row.weights);
    let batch = |form| Some((form, e.subject.batch(form, e.x, &row.weights)?));
    let batches: Vec<_> = (0..e.subject.forms()).filter_map(batch).collect();
    for (_, (value, _)) in &batches {
        notes.add(another(e, value, Witness::Batch));
    }
    let dual = row
        .dual
        .iter()
        .cloned()
        .map(|dual| (Witness::Dual, 0, dual));
    let further = (0..).zip(further);
    // Long inputs are projected.
    let theirs = (e.x.len() <= FEW_INPUTS).then(|| e.by_num_dual(row, e.x));
    let others = dual
        .chain(theirs.flatten().map(|theirs| (Witness::NumDual, 0, theirs)))
        .chain(further.map(|(k, derivatives)| (Witness::Further(k), 0, derivatives)))
        .chain(
            batches
                .into_iter()
                .map(|(form, (_, derivatives))| (Witness::Batch, form, derivatives)),
        );
    for (witness, form, other) in others {
        if other.len() != adjoint.len() {
            notes.add_length_fault(witness, row.output, [other.len(), adjoint.len()]);
            continue;
        }
        let pair = match witness {
            Witness::Dual => 0,
            Witness::Batch => 5,
            Witness::NumDual => 6,
            _ => 4,
        };
        let mut theirs: Option<Vec<f64>> = None;
        for i in 0..adjoint.len() {
            notes.judged[i] = true;
            let gap = (adjoint[i] - other[i]).abs();
            if gap > row.allowed(i) || gap.is_nan() {
                e.perturb(row);
            }
            let mut tolerance = row.allowed(i);
            if gap > tolerance && witness != Witness::Dual {
                // The row's perturbation includes the duals; other witnesses have their own.
                let theirs =
                    theirs.get_or_insert_with(|| rounding_of(e, row, (witness, form), &other));
                tolerance += SAFETY * theirs[i];
            }
            let numbers = ByWitness {
                adjoint: Some(adjoint[i]),
                dual: row.dual.as_ref().map(|dual| dual[i]),
                other: (witness != Witness::Dual).then_some(other[i]),
                ..ByWitness::default()
            };
            let at = comparison(row, i, numbers, tolerance);
            notes.compared(pair, gap, row.size[i], e.eps, at);
            if gap > tolerance && conventional_border(e, row, i) {
                // Differences decide for both if they lie between zero and the derivative of the only side.
                notes.convention = true;
            } else if gap > tolerance || gap.is_nan() {
                let reason = Reason::Disagree(Witness::Adjoint, witness);
                notes.add_fault_with(reason, None, (row.output, i), numbers, tolerance);
            }
        }
    }
    notes
}

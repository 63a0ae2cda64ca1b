//! Comparison of the adjoint with the exact witnesses: duals, num-dual's numbers, batches and further witnesses. They
//! take no steps, so they may differ by rounding only. The comparison decides for each number of the input, and perturbs
//! rounding if witnesses differ. [`judge`](crate::ad::check::judge) calls it first.
use crate::ad::check::compare::values::another;
use crate::ad::check::evidence::{Combination, Evidence, comparison};
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{CONVENTION_BORDER, DECIDED, FEW_INPUTS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::dot;

/// Returns `true` if a convention may decide about this derivative: the value is zero, and the input cannot move to both
/// sides along number `i`.
pub(crate) fn conventional_border(e: &Evidence<'_>, row: &Combination, i: usize) -> bool {
    let is_stuck = |sign: f64| {
        let mut there = e.x.to_vec();
        there[i] += sign * CONVENTION_BORDER * e.scales[i];
        !e.subject.inside(&there)
    };
    e.subject.conventions().flat
        && dot(&row.weights, &e.y) == 0.0
        && (is_stuck(1.0) || is_stuck(-1.0))
}

/// Compares the adjoint of every combination of outputs with all witnesses that take no steps.
pub(crate) fn exact(e: &Evidence<'_>) -> Notes {
    let mut notes = Notes::new(e.x.len());
    for row in &e.rows {
        notes.add(one_row(e, row));
    }
    notes
}

/// Returns the error that the derivatives of another witness than the adjoint and the duals may have, per number. It is
/// their change when inputs move by their last digits, or when the witness's own roundings fall differently. `form` is
/// the index of a batch among those of the function.
fn rounding_of(
    e: &Evidence<'_>,
    row: &Combination,
    (witness, form): (Witness, usize),
    derivatives: &[f64],
) -> Vec<f64> {
    // In the backward pass, nearly parallel edges give terms that are larger than the derivative. Their rounding may be
    // as large as the derivative itself, although no decision changes. Changes up to these sizes count.
    let sizes: Vec<f64> = row.size.iter().map(|size| size / DECIDED).collect();
    if witness == Witness::NumDual {
        // Judged as strictly as our own duals.
        let by_num_dual = |x: &[f64]| e.by_num_dual(row, x);
        let along = |axis: &[f64]| e.num_dual_along(row, e.x, axis);
        return e.rounding_of_duals(row, derivatives, &by_num_dual, &along);
    }
    let mut deviation = e.deviation(derivatives, Some(&sizes), |x| match witness {
        Witness::Further(k) => e.subject.further(x, &row.weights).into_iter().nth(k),
        _ => Some(e.subject.batch(form, x, &row.weights)?.1),
    });
    if let Witness::Further(k) = witness {
        let noisy = |seed| e.subject.noisy_further(e.x, &row.weights, k, seed);
        let own = e.roundings_of_each(derivatives, &sizes, noisy);
        for (deviation, own) in deviation.iter_mut().zip(own) {
            *deviation = deviation.max(own);
        }
    }
    deviation
}

/// Compares the adjoint of one combination of outputs with all witnesses that take no steps.
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
    // The derivatives of a long input are compared along directions, by another comparison.
    let num_dual = (e.x.len() <= FEW_INPUTS).then(|| e.by_num_dual(row, e.x));
    let others = dual
        .chain(
            num_dual
                .flatten()
                .map(|derivatives| (Witness::NumDual, 0, derivatives)),
        )
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
        // An index in `PAIRS`.
        let pair = match witness {
            Witness::Dual => 0,
            Witness::Batch => 5,
            Witness::NumDual => 6,
            _ => 4,
        };
        let mut rounding: Option<Vec<f64>> = None;
        for i in 0..adjoint.len() {
            notes.judged[i] = true;
            let gap = (adjoint[i] - other[i]).abs();
            if gap > row.allowed(i) || gap.is_nan() {
                e.perturb(row);
            }
            let mut tolerance = row.allowed(i);
            if gap > tolerance && witness != Witness::Dual {
                // The tolerance includes the rounding of the duals, but not that of other witnesses.
                let rounding =
                    rounding.get_or_insert_with(|| rounding_of(e, row, (witness, form), &other));
                tolerance += SAFETY * rounding[i];
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
                // Differences decide about both: each must lie between zero and the derivative of the only side.
                notes.convention = true;
            } else if gap > tolerance || gap.is_nan() {
                let reason = Reason::Disagree(Witness::Adjoint, witness);
                notes.add_fault_with(reason, None, (row.output, i), numbers, tolerance);
            }
        }
    }
    notes
}

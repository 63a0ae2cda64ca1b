//! Check that the adjoint is linear in its seed: it decides if the adjoint of a random sum of outputs is the sum of
//! their adjoints, and that of zero is zero. [`judge`](crate::ad::check::judge) calls it.
use crate::ad::check::evidence::Evidence;
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{ROUNDINGS, UNSEEN};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::perturbed;
use crate::ad::sample::Draw;

/// The number of inputs a last digit away at which the adjoint is computed.
const NEIGHBOURS: u64 = 12;

/// Returns the largest change of a derivative of a weighted sum at inputs a last digit away, where equal numbers move
/// alike. Terms that cancel inside a function differ by their roundings there; a derivative that is not linear does
/// not.
fn deviation(e: &Evidence<'_>, weights: &[f64], derivative: f64, i: usize) -> f64 {
    let still = vec![0.0; e.x.len()];
    (0..NEIGHBOURS)
        .filter_map(|k| {
            // Every third perturbation is by last digits.
            let x = perturbed(e.subject.precision(), e.x, &still, 3 * k);
            let found = e.subject.adjoint(&x, weights)?;
            Some((found.get(i)? - derivative).abs())
        })
        .filter(|apart| apart.is_finite())
        .fold(0.0, f64::max)
}

/// Compares the adjoint of a random sum with the sum of the adjoints, and the adjoint of zero with zero.
pub(crate) fn linear(e: &Evidence<'_>, draw: &mut Draw) -> Notes {
    let mut notes = Notes::new(e.x.len());
    if e.rows.is_empty() || e.rows.iter().any(|row| row.adjoint.is_none()) {
        return notes;
    }
    let m = e.y.len();
    let mut factor = || f64::from([-3_i8, -1, 1, 3][draw.below(4)]) * 0.75;
    let mut factors: Vec<f64> = e.rows.iter().map(|_| factor()).collect();
    // A sign that never changes would hide an absolute value.
    factors[0] = -factors[0].abs();
    let weight = |j: usize| {
        let terms = e.rows.iter().zip(&factors);
        terms.map(|(row, f)| f * row.weights[j]).sum()
    };
    let weights: Vec<f64> = (0..m).map(weight).collect();
    let Some(combined) = e.subject.adjoint(e.x, &weights) else {
        return notes;
    };
    if combined.len() != e.x.len() {
        notes.add_length_fault(Witness::Adjoint, 0, [combined.len(), e.x.len()]);
        return notes;
    }
    // Roundings inside a function of unknown source cannot be perturbed; mistakes of this kind are as large as the sum.
    let is_unseen = e.subject.conventions().flat && e.subject.noisy(e.x, &weights, 0).is_none();
    let unseen = if is_unseen { UNSEEN } else { 1.0 };
    let total = |i: usize| {
        let parts = e.rows.iter().zip(&factors).map(|(row, f)| {
            let derivative = row.adjoint.as_ref().map_or(0.0, |adjoint| adjoint[i]);
            let own = ROUNDINGS * e.eps * derivative.abs() + row.allowed(i);
            (f * derivative, f.abs() * own * unseen)
        });
        parts.fold((0.0, 0.0), |(s, t), (a, b)| (s + a, t + b))
    };
    for (i, &got) in combined.iter().enumerate() {
        let (sum, tolerance) = total(i);
        if (got - sum).abs() > tolerance {
            e.rows.iter().for_each(|row| e.perturb(row));
        }
        let (_, mut tolerance) = total(i);
        if is_unseen && (got - sum).abs() > tolerance {
            tolerance += ROUNDINGS * deviation(e, &weights, got, i);
        }
        if (got - sum).abs() > tolerance {
            let (reason, suspect) = (Reason::NotLinear, Some(Witness::Adjoint));
            let numbers = ByWitness::pair(got, sum);
            notes.add_fault_with(reason, suspect, (0, i), numbers, tolerance);
            break;
        }
    }
    if let Some(nothing) = e.subject.adjoint(e.x, &vec![0.0; m])
        && let Some(i) = nothing.iter().position(|&x| x != 0.0)
    {
        notes.add_fault(Reason::NotLinear, 0, i);
    }
    notes
}

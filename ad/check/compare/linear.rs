//! The adjoint is linear in what it is seeded with.
use crate::ad::check::evidence::Evidence;
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{ROUNDINGS, UNSEEN};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::beside;
use crate::ad::sample::Draw;

/// Inputs a last digit away at which an adjoint is asked for.
const NEIGHBOURS: u64 = 12;

/// Returns how far a derivative of a weighted sum is from itself at inputs a last digit away, equal numbers moved
/// alike. Terms that cancel inside a function differ by their roundings there; a derivative that is not linear does
/// not.
fn spread(e: &Evidence<'_>, weights: &[f64], derivative: f64, i: usize) -> f64 {
    let still = vec![0.0; e.x.len()];
    (0..NEIGHBOURS)
        .filter_map(|k| {
            // Every third of the ways to move is by last digits.
            let x = beside(e.subject.precision(), e.x, &still, 3 * k);
            let found = e.subject.adjoint(&x, weights)?;
            Some((found.get(i)? - derivative).abs())
        })
        .filter(|apart| apart.is_finite())
        .fold(0.0, f64::max)
}

/// Returns the adjoint of a random sum against the sum of the adjoints, and that of nothing against nothing.
pub(crate) fn linear(e: &Evidence<'_>, draw: &mut Draw) -> Notes {
    let mut said = Notes::new(e.x.len());
    if e.rows.is_empty() || e.rows.iter().any(|row| row.adjoint.is_none()) {
        return said;
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
        return said;
    };
    if combined.len() != e.x.len() {
        said.complain_of_length(Witness::Adjoint, 0, [combined.len(), e.x.len()]);
        return said;
    }
    // The roundings inside a function of unknown source do not show; mistakes of this kind are as large as the sum.
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
            e.rows.iter().for_each(|row| e.provoke(row));
        }
        let (_, mut tolerance) = total(i);
        if is_unseen && (got - sum).abs() > tolerance {
            tolerance += ROUNDINGS * spread(e, &weights, got, i);
        }
        if (got - sum).abs() > tolerance {
            let (reason, suspect) = (Reason::NotLinear, Some(Witness::Adjoint));
            let numbers = ByWitness::pair(got, sum);
            said.complain_of(reason, suspect, (0, i), numbers, tolerance);
            break;
        }
    }
    if let Some(nothing) = e.subject.adjoint(e.x, &vec![0.0; m])
        && let Some(i) = nothing.iter().position(|&x| x != 0.0)
    {
        said.complain(Reason::NotLinear, 0, i);
    }
    said
}

//! Comparison of the value with those of other paths: traced numbers, duals, further implementations. It decides if
//! they agree within rounding, which is perturbed where they differ. [`judge`](crate::ad::check::judge) calls it;
//! [`exact`](super::exact) uses it for batches.
use crate::ad::check::evidence::{Evidence, finite, same_bits};
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{ROUNDINGS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};

/// Compares the value with those of traced numbers, duals and other paths.
pub(crate) fn values(e: &Evidence<'_>) -> Notes {
    let mut notes = Notes::new(e.x.len());
    // Traced numbers and duals compute the value by the same operations, to a few roundings.
    let carried = e
        .traced
        .clone()
        .into_iter()
        .chain(e.subject.dual_values(e.x));
    for values in carried {
        notes.add(compared(e, &values, Witness::Dual, false));
    }
    let still = vec![0.0; e.x.len()];
    if let Some((values, _)) = e.subject.num_dual(e.x, &still) {
        notes.add(another(e, &values, Witness::NumDual));
    }
    for (i, values) in e.subject.other_values(e.x).into_iter().enumerate() {
        notes.add(another(e, &values, Witness::Further(i)));
    }
    notes
}

/// Compares the value of another path with the value; where they differ, rounding errors are perturbed.
pub(crate) fn another(e: &Evidence<'_>, other: &[f64], witness: Witness) -> Notes {
    compared(e, other, witness, true)
}

fn compared(e: &Evidence<'_>, other: &[f64], witness: Witness, perturbed: bool) -> Notes {
    let mut notes = Notes::new(e.x.len());
    if other.len() != e.y.len() {
        notes.add_length_fault(witness, 0, [other.len(), e.y.len()]);
        return notes;
    }
    if !finite(other) {
        notes.add_fault(Reason::NotFinite(witness), 0, 0);
        return notes;
    }
    if same_bits(other, &e.y) {
        return notes;
    }
    let deviation = if perturbed {
        e.deviation(&e.y, None, |x| Some(e.subject.value(x)))
    } else {
        vec![0.0; e.y.len()]
    };
    for j in 0..other.len() {
        let (a, b) = (e.y[j], other[j]);
        let off = deviation[j].max(e.resolution[j]);
        let tolerance = ROUNDINGS * e.eps * a.abs().max(b.abs()) + SAFETY * off;
        if (a - b).abs() > tolerance {
            let reason = Reason::ValuesDisagree(witness);
            notes.add_fault_with(reason, None, (j, 0), ByWitness::pair(a, b), tolerance);
        }
    }
    notes
}

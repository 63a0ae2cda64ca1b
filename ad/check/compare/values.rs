//! Values against values: the same function by other paths.
use crate::ad::check::evidence::{Evidence, finite, same_bits};
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{ROUNDINGS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};

/// Compares the value with those of traced numbers, duals and other paths.
pub(crate) fn values(e: &Evidence<'_>) -> Notes {
    let mut said = Notes::new(e.x.len());
    // Numbers that carry more compute the value as it is, to a few roundings.
    let carried = e
        .traced
        .clone()
        .into_iter()
        .chain(e.subject.dual_values(e.x));
    for values in carried {
        said.add(compared(e, &values, Witness::Dual, false));
    }
    let still = vec![0.0; e.x.len()];
    if let Some((values, _)) = e.subject.num_dual(e.x, &still) {
        said.add(another(e, &values, Witness::NumDual));
    }
    for (i, values) in e.subject.other_values(e.x).into_iter().enumerate() {
        said.add(another(e, &values, Witness::Further(i)));
    }
    said
}

/// Compares the value of another path with the value; where they differ, rounding errors are perturbed.
pub(crate) fn another(e: &Evidence<'_>, other: &[f64], witness: Witness) -> Notes {
    compared(e, other, witness, true)
}

fn compared(e: &Evidence<'_>, other: &[f64], witness: Witness, provoked: bool) -> Notes {
    let mut said = Notes::new(e.x.len());
    if other.len() != e.y.len() {
        said.complain_of_length(witness, 0, [other.len(), e.y.len()]);
        return said;
    }
    if !finite(other) {
        said.complain(Reason::NotFinite(witness), 0, 0);
        return said;
    }
    if same_bits(other, &e.y) {
        return said;
    }
    let spread = if provoked {
        e.spread(&e.y, None, |x| Some(e.subject.value(x)))
    } else {
        vec![0.0; e.y.len()]
    };
    for j in 0..other.len() {
        let (a, b) = (e.y[j], other[j]);
        let off = spread[j].max(e.resolution[j]);
        let tolerance = ROUNDINGS * e.eps * a.abs().max(b.abs()) + SAFETY * off;
        if (a - b).abs() > tolerance {
            let reason = Reason::ValuesDisagree(witness);
            said.complain_of(reason, None, (j, 0), ByWitness::pair(a, b), tolerance);
        }
    }
    said
}

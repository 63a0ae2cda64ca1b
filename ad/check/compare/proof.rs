//! Comparison of a distance in space with its proof. It decides if the value equals the gap of the best separating
//! plane and the distance of the nearest points. [`judge`](crate::ad::check::judge) calls it.
use crate::ad::check::certificate::Proved;
use crate::ad::check::evidence::Evidence;
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{PROVED_ROUNDINGS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Tightest, Witness};

/// Compares the value with the gap of the plane that separates the bodies best, and with the distance of the points
/// given as nearest.
///
/// Both may be off by roundings of the largest coordinate. Points of bodies that overlap bound nothing.
pub(crate) fn proof(e: &Evidence<'_>) -> Notes {
    let mut notes = Notes::new(e.x.len());
    let (Some(proof), [value]) = (e.subject.proof(e.x), &e.y[..]) else {
        return notes;
    };
    let off_scale = e.off_scale.contains(&true) || e.both_saturated(*value, *value);
    let Some(bounds) = proof.bounds().filter(|_| !off_scale) else {
        return notes;
    };
    let distance = match proof.measure {
        Proved::SquaredDistance => value.max(0.0).sqrt(),
        _ => *value,
    };
    let parted = match proof.measure {
        Proved::SignedDistance => bounds.parted,
        _ => bounds.parted.max(0.0),
    };
    let mut tolerance = PROVED_ROUNDINGS * e.eps * bounds.size + f64::MIN_POSITIVE;
    // The rounding of one step bounds no error where nearly parallel lines cross.
    if proof.is_endless() && (distance - parted).abs() > tolerance {
        tolerance += SAFETY * e.deviation_of_many(&e.y, |x| Some(e.subject.value(x)))[0];
    }
    // Every plane bounds the depth of curved bodies that overlap; the best one need not be among those tried.
    let is_bound = !bounds.is_depth && parted <= 0.0 && distance <= tolerance;
    let gap = match is_bound {
        true => (parted - distance).max(0.0),
        false => (distance - parted).abs(),
    };
    let mut compare = |pair: usize, witness: Witness, other: f64, gap: f64| {
        let numbers = ByWitness::pair(distance, other);
        let at = Tightest {
            numbers,
            tolerance,
            ..Tightest::default()
        };
        notes.compared(pair, gap, bounds.size, e.eps, at);
        if gap > tolerance || gap.is_nan() {
            let reason = Reason::ValuesDisagree(witness);
            notes.add_fault_with(reason, None, (0, 0), numbers, tolerance);
        }
    };
    compare(7, Witness::Planes, parted, gap);
    if let Some([apart, off]) = bounds.points.filter(|_| parted > tolerance) {
        compare(8, Witness::Points, apart, (distance - apart).abs().max(off));
    }
    notes
}

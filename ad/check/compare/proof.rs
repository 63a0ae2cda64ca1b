//! A distance with what proves it.
use crate::ad::check::certificate::Proved;
use crate::ad::check::evidence::Evidence;
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{PROVED_ROUNDINGS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Tightest, Witness};

/// Returns the value with the gap of the plane that parts the bodies best, and with the way between the points that are
/// said to be nearest.
///
/// Both may be off by roundings of the largest coordinate. Points of bodies that overlap bound nothing.
pub(crate) fn proof(e: &Evidence<'_>) -> Notes {
    let mut said = Notes::new(e.x.len());
    let (Some(proof), [value]) = (e.subject.proof(e.x), &e.y[..]) else {
        return said;
    };
    let off_scale = e.off_scale.contains(&true) || e.both_saturated(*value, *value);
    let Some(bounds) = proof.bounds().filter(|_| !off_scale) else {
        return said;
    };
    let told = match proof.measure {
        Proved::SquaredDistance => value.max(0.0).sqrt(),
        _ => *value,
    };
    let parted = match proof.measure {
        Proved::SignedDistance => bounds.parted,
        _ => bounds.parted.max(0.0),
    };
    let mut tolerance = PROVED_ROUNDINGS * e.eps * bounds.size + f64::MIN_POSITIVE;
    // Where lines cross that are all but parallel, no rounding of one step bounds.
    if proof.is_endless() && (told - parted).abs() > tolerance {
        tolerance += SAFETY * e.spread_of_many(&e.y, |x| Some(e.subject.value(x)))[0];
    }
    let mut compare = |pair: usize, witness: Witness, other: f64, gap: f64| {
        let numbers = ByWitness::pair(told, other);
        let at = Tightest {
            numbers,
            tolerance,
            ..Tightest::default()
        };
        said.compared(pair, gap, bounds.size, e.eps, at);
        if gap > tolerance || gap.is_nan() {
            let reason = Reason::ValuesDisagree(witness);
            said.complain_of(reason, None, (0, 0), numbers, tolerance);
        }
    };
    compare(7, Witness::Planes, parted, (told - parted).abs());
    if let Some([apart, off]) = bounds.points.filter(|_| parted > tolerance) {
        compare(8, Witness::Points, apart, (told - apart).abs().max(off));
    }
    said
}

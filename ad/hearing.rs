//! What a ladder of steps says about a slope.
use crate::ad::judge::SAFETY;
use crate::ad::verdict::Place;
use crate::ad::witness::{Estimate, Ladder};

/// A difference whose error is larger than this share of the largest slope says nothing.
pub(crate) const INFORMATIVE: f64 = 0.02;

/// What steps along one direction say about a slope.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Said {
    /// In order, at such a place; `switched` when other branches were taken however small the step.
    /// At an undefined place the estimate, if any, is too coarse for a slope as large as others are,
    /// and agrees.
    Fine {
        place: Place,
        switched: bool,
        estimate: Option<Estimate>,
    },
    /// Another slope.
    Other { estimate: Estimate, tolerance: f64 },
    /// A kink, and the slope is not between both sides; or the border of the domain, and it is not
    /// that of the only side.
    Outside { sides: [f64; 2], tolerance: f64 },
}

/// Whether a complaint stands: some other ladder repeats it, and none contradicts.
pub(crate) fn confirmed(again: impl Iterator<Item = Option<bool>>) -> bool {
    let mut repeated = false;
    for said in again.flatten() {
        if !said {
            return false;
        }
        repeated = true;
    }
    repeated
}

/// What other ladders make of a complaint.
pub(crate) struct Rehearing {
    /// Whether it stands: another ladder repeats it, and none contradicts.
    pub(crate) stands: bool,
    /// The best estimate against the slope, if any.
    pub(crate) against: Option<Estimate>,
    /// The best estimate for it.
    pub(crate) support: Option<Estimate>,
}

/// Weighs what all ladders say about a slope; those in `own` began at the number's own size, and if
/// they complain, they know best.
///
/// A ladder contradicts a complaint when what it says instead is another slope than the complaint's,
/// by more than both may be off. One so coarse that it agrees with both has no opinion.
pub(crate) fn rehear(said: &[Said], own: &[Said], exact: f64) -> Rehearing {
    let mut against: Vec<Estimate> = Vec::new();
    let mut support: Vec<Estimate> = Vec::new();
    let (mut outside, mut kink) = (0, false);
    for said in said.iter().chain(own) {
        match *said {
            Said::Other { estimate, .. } => against.push(estimate),
            Said::Outside { .. } => outside += 1,
            Said::Fine {
                place: Place::Undefined,
                ..
            } => {}
            Said::Fine {
                place: Place::Smooth,
                estimate: Some(e),
                ..
            } => support.push(e),
            Said::Fine { .. } => kink = true,
        }
    }
    let finest = own.iter().find_map(|said| match said {
        Said::Other { estimate, .. } => Some(*estimate),
        _ => None,
    });
    let least = |list: &[Estimate]| {
        let by_error = |a: &Estimate, b: &Estimate| a.error.total_cmp(&b.error);
        list.iter().copied().min_by(by_error)
    };
    let best = finest.or(least(&against));
    let differ = |a: &Estimate, b: &Estimate| {
        (a.value - b.value).abs() > SAFETY * (a.error + b.error) + exact
    };
    let (repeated, contradicted) = match best {
        Some(best) => (
            against.iter().filter(|e| !differ(e, &best)).count() + outside,
            support.iter().any(|e| differ(e, &best)),
        ),
        None => (outside, !support.is_empty()),
    };
    Rehearing {
        stands: repeated >= 2 && !contradicted && !kink,
        against: best,
        support: least(&support),
    }
}

/// Hears what a ladder says about a slope; `exact` is by how much that may be off by itself,
/// `size` the largest slope there is. `rough` is how rough the values were found to be: what that
/// explains is no complaint.
pub(crate) fn hear(
    ladder: &Ladder,
    weights: &[f64],
    noise: f64,
    rough: f64,
    slope: f64,
    exact: f64,
    size: f64,
) -> Said {
    let noise = noise.max(ladder.noise(weights));
    let undefined = Said::Fine {
        place: Place::Undefined,
        switched: ladder.traced,
        estimate: None,
    };
    let informative = |e: &Estimate| SAFETY * e.error <= INFORMATIVE * size.max(e.value.abs());
    if ladder.traced
        && let Some(e) = ladder.central(weights, noise, true).filter(informative)
    {
        let tolerance = SAFETY * e.error + exact;
        let gap = (e.value - slope).abs();
        return if gap <= tolerance {
            Said::Fine {
                place: Place::Smooth,
                switched: false,
                estimate: Some(e),
            }
        } else if gap <= tolerance + SAFETY * rough / e.step {
            undefined
        } else {
            Said::Other {
                estimate: e,
                tolerance,
            }
        };
    }
    let ahead = ladder.one_sided(true, weights, noise);
    let behind = ladder.one_sided(false, weights, noise);
    let (ahead, behind) = match (ahead, behind) {
        (Some(ahead), Some(behind)) => (ahead, behind),
        (Some(side), None) | (None, Some(side)) => (side, side),
        (None, None) => return undefined,
    };
    let error = ahead.error.max(behind.error);
    let border = ladder.ahead.len() < 2 || ladder.behind.len() < 2;
    if !ladder.settled() {
        return undefined;
    }
    if !border && (ahead.value - behind.value).abs() <= 2.0 * SAFETY * error + exact {
        // Where branches meet smoothly, the central slope converges slowly and the sides fast.
        let mean = Estimate {
            value: 0.5 * (ahead.value + behind.value),
            error: error + 0.5 * (ahead.value - behind.value).abs() / SAFETY,
            step: ahead.step.min(behind.step),
        };
        let central = ladder.central(weights, noise, false);
        let e = match central {
            Some(central) if !ladder.traced && central.error < mean.error => central,
            _ => mean,
        };
        let tolerance = SAFETY * e.error + exact;
        let gap = (e.value - slope).abs();
        let explained = gap > tolerance && gap <= tolerance + SAFETY * rough / e.step;
        return if tolerance.is_nan() || explained {
            undefined
        } else if !informative(&e) {
            Said::Fine {
                place: Place::Undefined,
                switched: ladder.traced,
                estimate: (gap <= tolerance).then_some(e),
            }
        } else if gap <= tolerance {
            Said::Fine {
                place: Place::Smooth,
                switched: ladder.traced,
                estimate: Some(e),
            }
        } else {
            Said::Other {
                estimate: e,
                tolerance,
            }
        };
    }
    let sides = [behind.value, ahead.value];
    let tolerance = SAFETY * error + exact;
    let (low, high) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
    let coarse = SAFETY * error > INFORMATIVE * size.max(ahead.value.abs()).max(behind.value.abs());
    let beyond = (low - slope).max(slope - high);
    if coarse || tolerance.is_nan() {
        let middle = Estimate {
            value: 0.5 * (low + high),
            error: error + 0.5 * (high - low) / SAFETY,
            step: ahead.step.min(behind.step),
        };
        return Said::Fine {
            place: Place::Undefined,
            switched: ladder.traced,
            estimate: (beyond <= tolerance).then_some(middle),
        };
    }
    if beyond > tolerance && beyond <= tolerance + SAFETY * rough / ahead.step.min(behind.step) {
        return undefined;
    }
    if beyond <= tolerance {
        let place = if border { Place::Smooth } else { Place::Kink };
        Said::Fine {
            place,
            switched: ladder.traced,
            estimate: None,
        }
    } else {
        Said::Outside { sides, tolerance }
    }
}

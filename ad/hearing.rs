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

/// Hears what a ladder says about a slope; `exact` is by how much that may be off by itself,
/// `size` the largest slope there is.
pub(crate) fn hear(
    ladder: &Ladder,
    weights: &[f64],
    noise: f64,
    slope: f64,
    exact: f64,
    size: f64,
) -> Said {
    let noise = noise.max(ladder.noise(weights));
    let informative = |e: &Estimate| SAFETY * e.error <= INFORMATIVE * size.max(e.value.abs());
    if ladder.traced
        && let Some(e) = ladder.central(weights, noise, true).filter(informative)
    {
        let tolerance = SAFETY * e.error + exact;
        return if (e.value - slope).abs() <= tolerance {
            Said::Fine {
                place: Place::Smooth,
                switched: false,
                estimate: Some(e),
            }
        } else {
            Said::Other {
                estimate: e,
                tolerance,
            }
        };
    }
    let undefined = Said::Fine {
        place: Place::Undefined,
        switched: ladder.traced,
        estimate: None,
    };
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
        };
        let central = ladder.central(weights, noise, false);
        let e = match central {
            Some(central) if !ladder.traced && central.error < mean.error => central,
            _ => mean,
        };
        if !informative(&e) {
            return undefined;
        }
        let tolerance = SAFETY * e.error + exact;
        return if (e.value - slope).abs() <= tolerance {
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
    if SAFETY * error > INFORMATIVE * size.max(ahead.value.abs()).max(behind.value.abs()) {
        return undefined;
    }
    let sides = [behind.value, ahead.value];
    let tolerance = SAFETY * error + exact;
    let (low, high) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
    if slope >= low - tolerance && slope <= high + tolerance {
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

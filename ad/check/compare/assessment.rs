//! The assessment of a derivative by one sequence of steps, and the review of a refusal by all sequences.
//! [`DerivativeTest`](super::derivative_test::DerivativeTest) makes both.
use crate::ad::check::tolerances::{REPEATED, SAFETY};
use crate::ad::check::verdict::Smoothness;
use crate::ad::check::witness::Estimate;

/// The assessment of a derivative by a sequence of steps along one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Assessment {
    /// The derivative agrees with the steps, and `place` is the smoothness. `switched` is `true` if other branches were
    /// taken however small the step. If `place` is undefined, an estimate that is given agrees, but is too coarse for a
    /// derivative as large as the others.
    Agrees {
        place: Smoothness,
        switched: bool,
        estimate: Option<Estimate>,
    },
    /// The steps give another derivative.
    Differs { estimate: Estimate },
    /// The derivative is not between those of both sides of a kink, or at the border of the domain is not that of the
    /// only side.
    Outside { sides: [f64; 2], tolerance: f64 },
}

impl Assessment {
    /// Returns `true` if the steps decide nothing.
    pub(crate) fn undefined(&self) -> bool {
        matches!(
            self,
            Assessment::Agrees {
                place: Smoothness::Undefined,
                ..
            }
        )
    }
    /// Returns `true` if the steps refuse the derivative.
    pub(crate) fn refuses(&self) -> bool {
        !matches!(self, Assessment::Agrees { .. })
    }
}

/// The review of a refusal by other sequences.
pub(crate) struct Review {
    /// `true` if the refusal stands: another sequence repeats it, and none contradicts.
    pub(crate) stands: bool,
    /// The best estimate against the derivative, if any.
    pub(crate) against: Option<Estimate>,
    /// `true` if some sequence agrees with the derivative.
    pub(crate) supported: bool,
}

/// Weighs the assessments of a derivative by all sequences. Those in `own` began at the number's own size; their
/// refusals have priority.
///
/// A sequence contradicts a refusal when its own derivative differs from the refusing one's by more than the errors of
/// both. One so coarse that it agrees with both does not count.
pub(crate) fn review(all: &[Assessment], own: &[Assessment], exact: f64) -> Review {
    let mut against: Vec<Estimate> = Vec::new();
    let mut support: Vec<Estimate> = Vec::new();
    let (mut outside, mut kink) = (0, false);
    for assessment in all.iter().chain(own) {
        match *assessment {
            Assessment::Differs { estimate } => against.push(estimate),
            Assessment::Outside { .. } => outside += 1,
            Assessment::Agrees {
                place: Smoothness::Undefined,
                ..
            } => {}
            Assessment::Agrees {
                place: Smoothness::Smooth,
                estimate: Some(e),
                ..
            } => support.push(e),
            Assessment::Agrees { .. } => kink = true,
        }
    }
    let finest = own.iter().find_map(|assessment| match assessment {
        Assessment::Differs { estimate } => Some(*estimate),
        _ => None,
    });
    let by_error = |a: &Estimate, b: &Estimate| a.error.total_cmp(&b.error);
    let best = finest.or(against.iter().copied().min_by(by_error));
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
    Review {
        stands: repeated >= REPEATED && !contradicted && !kink,
        against: best,
        supported: !support.is_empty(),
    }
}

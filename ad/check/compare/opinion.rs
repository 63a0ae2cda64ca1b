//! The opinion of a ladder of steps about a derivative.
use crate::ad::check::tolerances::{REPEATED, SAFETY};
use crate::ad::check::verdict::Smoothness;
use crate::ad::check::witness::Estimate;

/// The opinion of the steps along one direction about a derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Opinion {
    /// In order, at such a place; `switched` when other branches were taken however small the step.
    /// At an undefined place the estimate, if any, is too coarse for a derivative as large as others are,
    /// and agrees.
    Fine {
        place: Smoothness,
        switched: bool,
        estimate: Option<Estimate>,
    },
    /// Another derivative.
    Other { estimate: Estimate },
    /// A kink, and the derivative is not between both sides; or the border of the domain, and it is not
    /// that of the only side.
    Outside { sides: [f64; 2], tolerance: f64 },
}

impl Opinion {
    /// Returns `true` if the steps decide nothing.
    pub(crate) fn undefined(&self) -> bool {
        matches!(
            self,
            Opinion::Fine {
                place: Smoothness::Undefined,
                ..
            }
        )
    }
    /// Returns `true` if it is a complaint.
    pub(crate) fn complains(&self) -> bool {
        !matches!(self, Opinion::Fine { .. })
    }
}

/// The verdict of other ladders on a complaint.
pub(crate) struct Review {
    /// `true` if it stands: another ladder repeats it, and none contradicts.
    pub(crate) stands: bool,
    /// The best estimate against the derivative, if any.
    pub(crate) against: Option<Estimate>,
    /// `true` if some ladder agrees with the derivative.
    pub(crate) supported: bool,
}

/// Weighs the opinions of all ladders about a derivative. Ladders in `own` began at the number's own size; their
/// complaints have priority.
///
/// A ladder contradicts a complaint when its own derivative differs from the complaint's
/// by more than both may be off. One so coarse that it agrees with both does not count.
pub(crate) fn review(said: &[Opinion], own: &[Opinion], exact: f64) -> Review {
    let mut against: Vec<Estimate> = Vec::new();
    let mut support: Vec<Estimate> = Vec::new();
    let (mut outside, mut kink) = (0, false);
    for said in said.iter().chain(own) {
        match *said {
            Opinion::Other { estimate } => against.push(estimate),
            Opinion::Outside { .. } => outside += 1,
            Opinion::Fine {
                place: Smoothness::Undefined,
                ..
            } => {}
            Opinion::Fine {
                place: Smoothness::Smooth,
                estimate: Some(e),
                ..
            } => support.push(e),
            Opinion::Fine { .. } => kink = true,
        }
    }
    let finest = own.iter().find_map(|said| match said {
        Opinion::Other { estimate } => Some(*estimate),
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

//! The test of one derivative along one direction by sequences of steps. The steps confirm the derivative, refuse it or
//! decide nothing. Within one branch the test uses central differences, across a kink the derivatives of both sides.
//! [`along`](super::along) calls it, and before it refuses a derivative has further sequences review the refusal
//! ([`again`](DerivativeTest::again)).
use crate::ad::check::compare::assessment::{Assessment, Review, review};
use crate::ad::check::tolerances::{FINER, FIRST, INFORMATIVE, OWN_FIRST, OWN_SIZE, SAFETY, SIDES};
use crate::ad::check::verdict::Smoothness;
use crate::ad::check::witness::{Estimate, StepSequence};

/// A derivative, and the sequences of steps along its direction with which it is compared.
pub(crate) struct DerivativeTest<'l> {
    /// The weights with which outputs add up to the value.
    pub(crate) weights: &'l [f64],
    /// Values along the direction.
    pub(crate) here: &'l StepSequence,
    /// The function that evaluates a sequence from another first step.
    pub(crate) steps_from: &'l dyn Fn(f64) -> StepSequence,
    /// The derivative in question.
    pub(crate) derivative: f64,
    /// The rounding error of the derivative, which a tolerance includes whatever the steps are.
    pub(crate) exact: f64,
    /// The rounding noise of the value.
    pub(crate) noise: f64,
    /// The measured roughness of the values. A gap that it explains does not refuse the derivative.
    pub(crate) rough: f64,
    /// The least roughness of values that are constant along all steps. Such values do not show the digits that they
    /// lose by cancellation.
    pub(crate) hidden: f64,
    /// The size of the largest derivative. An estimate with a larger error than a share of it decides nothing.
    pub(crate) size: f64,
    /// `true` if the scales are only guessed, so that finer steps are tried.
    pub(crate) guessed: bool,
    /// The size of the input's number that the direction moves, in units of its scale.
    pub(crate) own: f64,
}

impl DerivativeTest<'_> {
    /// Returns the assessment by the first sequence.
    pub(crate) fn first(&self) -> Assessment {
        self.compare(self.here)
    }

    /// Returns the assessment by a sequence with another first step.
    fn starting_at(&self, first: f64) -> Assessment {
        let sequence = (self.steps_from)(first);
        if sequence.still() && !self.here.still() {
            // The steps are too small to change the value. That does not make the derivative zero.
            return Assessment::Agrees {
                place: Smoothness::Undefined,
                switched: false,
                estimate: None,
            };
        }
        self.compare(&sequence)
    }

    /// Returns the assessments by sequences that begin near the number's own size. There are none unless the scale is
    /// guessed and the number is smaller than it.
    fn of_own_size(&self) -> Vec<Assessment> {
        let is_smaller = self.guessed && self.own > 0.0 && self.own < OWN_SIZE;
        let firsts = OWN_FIRST.iter().filter(|_| is_smaller);
        let steps = firsts.map(|first| first * self.own);
        steps.map(|step| self.starting_at(step)).collect()
    }

    /// Returns the assessment by finer steps, if the first ones decide nothing.
    pub(crate) fn finer(&self, first: Assessment) -> Assessment {
        if !first.undefined() || !self.guessed {
            return first;
        }
        let own = self.of_own_size();
        let own = own.into_iter().filter(|one| !one.undefined());
        let finer = FIRST[FINER].iter().map(|&first| self.starting_at(first));
        let fine = |one: &Assessment| matches!(one, Assessment::Agrees { .. }) && !one.undefined();
        own.chain(finer.filter(fine)).last().unwrap_or(first)
    }

    /// Returns the review of a refusal by all sequences. If both witnesses `agree`, a refusal by guessed scales stands
    /// only where the finest steps decide, too: no trace shows a pole between two steps.
    pub(crate) fn again(&self, first: Assessment, agree: bool) -> Review {
        let mut all = vec![first];
        all.extend(FIRST[1..].iter().map(|&first| self.starting_at(first)));
        let own = self.of_own_size();
        let mut reviewed = review(&all, &own, self.exact);
        let finest = all.iter().chain(&own).last();
        if agree && self.guessed && finest.is_some_and(Assessment::undefined) {
            reviewed.stands = false;
        }
        reviewed
    }

    /// Compares the derivative with an estimate that both sides share.
    fn smooth(&self, e: Estimate, informative: bool, switched: bool, rough: f64) -> Assessment {
        let tolerance = SAFETY * e.error + self.exact;
        let gap = (e.value - self.derivative).abs();
        let with_roughness = Estimate {
            error: e.error + rough / e.step,
            ..e
        };
        let explained = gap <= SAFETY * with_roughness.error + self.exact;
        if tolerance.is_finite() && informative && (gap <= tolerance || !explained) {
            return if gap <= tolerance {
                Assessment::Agrees {
                    place: Smoothness::Smooth,
                    switched,
                    estimate: Some(e),
                }
            } else {
                Assessment::Differs { estimate: e }
            };
        }
        Assessment::Agrees {
            place: Smoothness::Undefined,
            switched,
            estimate: explained.then_some(with_roughness),
        }
    }

    /// Returns the assessment of the derivative by a sequence.
    fn compare(&self, sequence: &StepSequence) -> Assessment {
        let (weights, derivative, exact) = (self.weights, self.derivative, self.exact);
        let noise = self.noise.max(sequence.noise(weights));
        let rough = if sequence.still() {
            self.rough.max(self.hidden)
        } else {
            self.rough
        };
        let undefined = Assessment::Agrees {
            place: Smoothness::Undefined,
            switched: sequence.traced,
            estimate: None,
        };
        let informative =
            |e: &Estimate| SAFETY * e.error <= INFORMATIVE * self.size.max(e.value.abs());
        if sequence.traced
            && let Some(e) = sequence.central(weights, noise, true).filter(informative)
        {
            return self.smooth(e, true, false, rough);
        }
        let ahead = sequence.one_sided(true, weights, noise);
        let behind = sequence.one_sided(false, weights, noise);
        let (ahead, behind) = match (ahead, behind) {
            (Some(ahead), Some(behind)) => (ahead, behind),
            (Some(side), None) | (None, Some(side)) => (side, side),
            (None, None) => return undefined,
        };
        let error = ahead.error.max(behind.error);
        let border = sequence.is_at_border();
        if !sequence.settled() {
            return undefined;
        }
        if !border && (ahead.value - behind.value).abs() <= SIDES * SAFETY * error + exact {
            // At a smooth junction of branches, one-sided differences converge faster than central ones.
            let mean = Estimate {
                value: 0.5 * (ahead.value + behind.value),
                error: error + 0.5 * (ahead.value - behind.value).abs() / SAFETY,
                step: ahead.step.min(behind.step),
            };
            let central = sequence.central(weights, noise, false);
            let e = match central {
                Some(central) if !sequence.traced && central.error < mean.error => central,
                _ => mean,
            };
            return self.smooth(e, informative(&e), sequence.traced, rough);
        }
        let sides = [behind.value, ahead.value];
        let tolerance = SAFETY * error + exact;
        let (low, high) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
        let coarse =
            SAFETY * error > INFORMATIVE * self.size.max(ahead.value.abs()).max(behind.value.abs());
        let beyond = (low - derivative).max(derivative - high);
        if coarse || tolerance.is_nan() {
            let middle = Estimate {
                value: 0.5 * (low + high),
                error: error + 0.5 * (high - low) / SAFETY,
                step: ahead.step.min(behind.step),
            };
            return Assessment::Agrees {
                place: Smoothness::Undefined,
                switched: sequence.traced,
                estimate: (beyond <= tolerance).then_some(middle),
            };
        }
        if beyond > tolerance && beyond <= tolerance + SAFETY * rough / ahead.step.min(behind.step)
        {
            return undefined;
        }
        if beyond <= tolerance {
            let place = if border {
                Smoothness::Smooth
            } else {
                Smoothness::Kink
            };
            Assessment::Agrees {
                place,
                switched: sequence.traced,
                estimate: None,
            }
        } else {
            Assessment::Outside { sides, tolerance }
        }
    }
}

//! One derivative along one direction against what ladders of steps give for it.
use crate::ad::check::compare::opinion::{Opinion, Review, review};
use crate::ad::check::tolerances::{FINER, FIRST, INFORMATIVE, OWN_FIRST, OWN_SIZE, SAFETY, SIDES};
use crate::ad::check::verdict::Smoothness;
use crate::ad::check::witness::{Estimate, Ladder};

/// The two sides of a comparison: a derivative, and ladders of any first step along its direction.
pub(crate) struct DerivativeTest<'l> {
    pub(crate) weights: &'l [f64],
    /// Values along the direction.
    pub(crate) here: &'l Ladder,
    /// The same from another first step.
    pub(crate) climb: &'l dyn Fn(f64) -> Ladder,
    pub(crate) derivative: f64,
    /// The error that the derivative may have by itself.
    pub(crate) exact: f64,
    /// The rounding noise of the value.
    pub(crate) noise: f64,
    /// The measured roughness of the values: a gap that it explains is no complaint.
    pub(crate) rough: f64,
    /// The same of constant values: they do not show the digits that they lose by cancellation.
    pub(crate) hidden: f64,
    /// The largest derivative.
    pub(crate) size: f64,
    /// `true` if the scales are only guessed, so that finer steps are worth a try.
    pub(crate) guessed: bool,
    /// The number's own size in units of its scale.
    pub(crate) own: f64,
}

impl DerivativeTest<'_> {
    /// Returns the opinion of the first ladder.
    pub(crate) fn first(&self) -> Opinion {
        self.compare(self.here)
    }

    /// Returns the opinion of a ladder with another first step.
    fn other(&self, first: f64) -> Opinion {
        let ladder = (self.climb)(first);
        if ladder.still() && !self.here.still() {
            // Too small steps: the derivative need not be zero.
            return Opinion::Fine {
                place: Smoothness::Undefined,
                switched: false,
                estimate: None,
            };
        }
        self.compare(&ladder)
    }

    /// Returns the opinions of ladders that begin at the number's own size, where that is far smaller than its scale.
    fn of_own_size(&self) -> Vec<Opinion> {
        let worth = self.guessed && self.own > 0.0 && self.own < OWN_SIZE;
        let firsts = OWN_FIRST.iter().filter(|_| worth);
        firsts.map(|first| self.other(first * self.own)).collect()
    }

    /// Returns the opinion of finer steps, where the first ones decide nothing.
    pub(crate) fn finer(&self, said: Opinion) -> Opinion {
        if !said.undefined() || !self.guessed {
            return said;
        }
        let own = self.of_own_size();
        let own = own.into_iter().filter(|said| !said.undefined());
        let finer = FIRST[FINER].iter().map(|&first| self.other(first));
        let fine = |said: &Opinion| matches!(said, Opinion::Fine { .. }) && !said.undefined();
        own.chain(finer.filter(fine)).last().unwrap_or(said)
    }

    /// Returns the review of a complaint by all ladders. Against two witnesses that `agree` the finest steps must
    /// decide: a trace has no comparison that shows a pole between two steps.
    pub(crate) fn again(&self, said: Opinion, agree: bool) -> Review {
        let mut all = vec![said];
        all.extend(FIRST[1..].iter().map(|&first| self.other(first)));
        let own = self.of_own_size();
        let mut covered = review(&all, &own, self.exact);
        let finest = all.iter().chain(&own).last();
        if agree && self.guessed && finest.is_some_and(Opinion::undefined) {
            covered.stands = false;
        }
        covered
    }

    /// Returns the derivative against an estimate that is the same on both sides.
    fn smooth(&self, e: Estimate, informative: bool, switched: bool, rough: f64) -> Opinion {
        let tolerance = SAFETY * e.error + self.exact;
        let gap = (e.value - self.derivative).abs();
        let roughly = Estimate {
            error: e.error + rough / e.step,
            ..e
        };
        let explained = gap <= SAFETY * roughly.error + self.exact;
        if tolerance.is_finite() && informative && (gap <= tolerance || !explained) {
            return if gap <= tolerance {
                Opinion::Fine {
                    place: Smoothness::Smooth,
                    switched,
                    estimate: Some(e),
                }
            } else {
                Opinion::Other { estimate: e }
            };
        }
        Opinion::Fine {
            place: Smoothness::Undefined,
            switched,
            estimate: explained.then_some(roughly),
        }
    }

    /// Returns the opinion of a ladder about the derivative.
    fn compare(&self, ladder: &Ladder) -> Opinion {
        let (weights, derivative, exact) = (self.weights, self.derivative, self.exact);
        let noise = self.noise.max(ladder.noise(weights));
        let rough = if ladder.still() {
            self.rough.max(self.hidden)
        } else {
            self.rough
        };
        let undefined = Opinion::Fine {
            place: Smoothness::Undefined,
            switched: ladder.traced,
            estimate: None,
        };
        let informative =
            |e: &Estimate| SAFETY * e.error <= INFORMATIVE * self.size.max(e.value.abs());
        if ladder.traced
            && let Some(e) = ladder.central(weights, noise, true).filter(informative)
        {
            return self.smooth(e, true, false, rough);
        }
        let ahead = ladder.one_sided(true, weights, noise);
        let behind = ladder.one_sided(false, weights, noise);
        let (ahead, behind) = match (ahead, behind) {
            (Some(ahead), Some(behind)) => (ahead, behind),
            (Some(side), None) | (None, Some(side)) => (side, side),
            (None, None) => return undefined,
        };
        let error = ahead.error.max(behind.error);
        let border = ladder.is_at_border();
        if !ladder.settled() {
            return undefined;
        }
        if !border && (ahead.value - behind.value).abs() <= SIDES * SAFETY * error + exact {
            // At a smooth junction of branches the central derivative converges slowly and the sides fast.
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
            return self.smooth(e, informative(&e), ladder.traced, rough);
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
            return Opinion::Fine {
                place: Smoothness::Undefined,
                switched: ladder.traced,
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
            Opinion::Fine {
                place,
                switched: ladder.traced,
                estimate: None,
            }
        } else {
            Opinion::Outside { sides, tolerance }
        }
    }
}

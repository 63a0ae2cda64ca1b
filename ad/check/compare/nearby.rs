//! Derivatives near a kink, which bound a right derivative at the kink. This file decides if a derivative lies between
//! those of the smooth branches that meet at the input (Clarke's generalised gradient). [`along`](super::along) and
//! [`judge`](crate::ad::check::judge) call it before they refuse a derivative at a tie.
use crate::ad::check::evidence::{Combination, Evidence, finite};
use crate::ad::check::tolerances::{
    APPROACHES, DECIDED, FEW_INPUTS, FEW_PLACES, FIRST, INFORMATIVE, MOVED_ROUNDINGS, NEARBY,
    NEARER, NEARER_STEPS, PLACES, SAFETY, SIDES, TRIES, TRIES_OF_STEPS,
};
use crate::ad::check::witness::{Estimate, Precision, StepSequence, combined, dot};
use crate::ad::sample::Draw;

/// Returns the difference of two lists.
fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

impl Evidence<'_> {
    /// Returns `true` if a derivative along a direction is between those at points near the input.
    ///
    /// Kinks of both signs may meet (the larger one of two functions with kinks of their own), or the input may be at
    /// the border of its domain. The derivatives to both sides of the input do not bound a right derivative there; the
    /// derivatives of the function's smooth branches do (Clarke's generalised gradient). Derivatives of two branches
    /// differ by at least `apart`.
    pub(crate) fn is_among_derivatives_nearby(
        &self,
        weights: &[f64],
        direction: &[f64],
        (derivative, tolerance): (f64, f64),
        apart: f64,
    ) -> bool {
        let on = self.on();
        if on.precision() != Precision::F64 {
            return false;
        }
        let by_duals = on.along(self.x, direction).is_some();
        let tries = if by_duals { TRIES } else { TRIES_OF_STEPS };
        // A function of single precision may have decided as if its input were another one.
        let rounding = self.subject.rounding(self.x);
        let mut draw = Draw::new(11);
        let (mut least, mut most, mut seen) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for k in 0..tries {
            // The input may lie between two kinks that are nearer to each other than this distance.
            let far = match k % 2 {
                0 => NEARBY,
                _ if by_duals => NEARBY * NEARER.powf(draw.within(0.0, 1.0)),
                _ => NEARBY * NEARER_STEPS.powf(draw.within(0.0, 1.0)),
            };
            let there: Vec<f64> = (self.x.iter().zip(&self.scales))
                .zip(&rounding)
                .map(|((x, scale), rounding)| {
                    x + (far * scale).max(*rounding) * draw.within(-1.0, 1.0)
                })
                .collect();
            if !on.inside(&there) {
                continue;
            }
            let (own, error) = match on.along(&there, direction) {
                Some(along) => (dot(weights, &along), 0.0),
                None if by_duals => return false,
                None => match self.by_steps(weights, direction, (&there, far)) {
                    Some(found) => (found.value, SAFETY * found.error),
                    None => continue,
                },
            };
            if !own.is_finite() || error > INFORMATIVE * own.abs().max(derivative.abs()) {
                continue;
            }
            (least, most) = (least.min(own - error), most.max(own + error));
            let is_between = derivative >= least - tolerance && derivative <= most + tolerance;
            if is_between && most - least >= apart {
                return true;
            }
            seen += 1;
            if seen == PLACES {
                break;
            }
        }
        false
    }

    /// Returns `true` if the derivatives by hand along a direction equal differences at several points near the input.
    pub(crate) fn is_right_nearby(&self, row: &Combination, direction: &[f64]) -> bool {
        let on = self.on();
        let mut draw = Draw::new(17);
        let mut seen = 0;
        for _ in 0..TRIES_OF_STEPS {
            let each = self.x.iter().zip(&self.scales);
            let there: Vec<f64> = each
                .map(|(x, scale)| x + NEARBY * scale * draw.within(-1.0, 1.0))
                .collect();
            if !on.inside(&there) {
                continue;
            }
            let Some(found) = self.by_steps(&row.weights, direction, (&there, NEARBY)) else {
                continue;
            };
            let Some(adjoint) = on.adjoint(&there, &row.weights) else {
                return false;
            };
            let own = dot(&adjoint, direction);
            let error = SAFETY * found.error;
            if error > INFORMATIVE * found.value.abs().max(row.largest) {
                continue;
            }
            if (own - found.value).abs() > error + row.allowed_along(direction) {
                return false;
            }
            seen += 1;
            if seen == FEW_PLACES {
                return true;
            }
        }
        false
    }

    /// Returns `true` if a search chooses among branches that meet near the input: the tested derivatives along a direction
    /// differ there, by more than smooth ones would, from the one at the input. Nearest points of faces that are parallel
    /// are a mean of several, and any motion of the input that is not theirs leaves one of them.
    pub(crate) fn branches_nearby(
        &self,
        row: &Combination,
        direction: &[f64],
        (derivative, tolerance): (f64, f64),
    ) -> bool {
        if !self.subject.conventions().searches {
            return false;
        }
        let on = self.on();
        let rounding = self.subject.rounding(self.x);
        let mut draw = Draw::new(23);
        (0..PLACES).any(|k| {
            // Features may be as small as rounding, and as large as the scales.
            let far = NEARBY * NEARER.powf(k as f64 / PLACES as f64);
            let each = self.x.iter().zip(&self.scales).zip(&rounding);
            let there: Vec<f64> = each
                .map(|((x, scale), rounding)| {
                    x + (far * scale).max(*rounding) * draw.within(-1.0, 1.0)
                })
                .collect();
            if !on.inside(&there) {
                return false;
            }
            let own = match on.adjoint(&there, &row.weights) {
                Some(adjoint) => Some(dot(&adjoint, direction)),
                None => on
                    .along(&there, direction)
                    .map(|along| dot(&row.weights, &along)),
            };
            own.is_some_and(|own| (own - derivative).abs() > tolerance + DECIDED * row.largest)
        })
    }

    /// Returns the derivative along a direction at a point near the input by differences, whose steps are small
    /// compared with its distance; `None` if they cross a kink.
    fn by_steps(
        &self,
        weights: &[f64],
        direction: &[f64],
        (there, far): (&[f64], f64),
    ) -> Option<Estimate> {
        let on = self.on();
        let center = on.value(there);
        let probe = |x: &Vec<f64>| {
            let values = on.inside(x).then(|| on.value(x))?;
            let usable = values.len() == center.len() && finite(&values);
            usable.then_some((values, None))
        };
        let probe = |places: &[Vec<f64>]| places.iter().map(probe).collect();
        let first = FIRST[0] * far;
        let sequence = StepSequence::evaluate(
            &probe,
            on.precision(),
            there,
            &center,
            None,
            direction,
            first,
        );
        let terms = weights.iter().zip(&center).map(|(w, y)| (w * y).abs());
        let noise = self.eps * terms.sum::<f64>();
        let noise = noise.max(sequence.noise(weights));
        let ahead = sequence.one_sided(true, weights, noise)?;
        let behind = sequence.one_sided(false, weights, noise)?;
        let is_kink =
            (ahead.value - behind.value).abs() > SIDES * SAFETY * ahead.error.max(behind.error);
        if is_kink {
            return None;
        }
        sequence.central(weights, noise, false)
    }

    /// Returns `true` if the derivatives by hand lie in the convex hull of those of the smooth branches that meet at
    /// the input. Duals give the latter at points a few last digits away.
    ///
    /// Steps need both sides of a kink, at several steps each. Here a branch may end as near as a millionth of the
    /// scales.
    pub(crate) fn is_between_branches(&self, row: &Combination) -> bool {
        let (on, n) = (self.on(), self.x.len());
        let Some(adjoint) = row.adjoint.as_ref().filter(|_| n <= FEW_INPUTS) else {
            return false;
        };
        // A tie is one to the bit where branches are known. Those that a search compares are not.
        let searches = self.subject.conventions().searches;
        if self.trace.is_some() && !searches && !self.exactly_tied() {
            return false;
        }
        let rounding = self.subject.rounding(self.x);
        let mut draw = Draw::new(13);
        let branches: Vec<Vec<f64>> = (0..PLACES)
            .filter_map(|_| {
                let there: Vec<f64> = (0..n)
                    .map(|i| {
                        // A zero has no last digit.
                        let own = match self.x[i] {
                            0.0 => self.eps * self.scales[i],
                            _ => rounding[i],
                        };
                        let moved = self.x[i] + MOVED_ROUNDINGS * own * draw.within(-1.0, 1.0);
                        self.subject.precision().round(moved)
                    })
                    .collect();
                if !on.inside(&there) {
                    return None;
                }
                let derivatives = combined(&row.weights, &on.jacobian(&there)?, n);
                finite(&derivatives).then_some(derivatives)
            })
            .collect();
        if branches.is_empty() {
            return false;
        }
        // Derivatives times scales are comparable.
        let scaled = |derivatives: &[f64]| -> Vec<f64> {
            let each = derivatives.iter().zip(&self.scales);
            each.map(|(derivative, scale)| derivative * scale).collect()
        };
        let own = scaled(adjoint);
        let corners: Vec<Vec<f64>> = branches.iter().map(|branch| scaled(branch)).collect();
        // An iteration towards the point of the hull that is nearest to the derivatives in question (Frank and Wolfe).
        // The vector from it to them separates them from the branches' derivatives, if that is possible.
        let mut nearest = corners[0].clone();
        for _ in 0..APPROACHES {
            let on = minus(&own, &nearest);
            let Some(farthest) =
                (corners.iter()).max_by(|a, b| dot(a, &on).total_cmp(&dot(b, &on)))
            else {
                return false;
            };
            let direction = scaled(&on);
            let most = dot(farthest, &on);
            let each = direction.iter().zip(&row.plain);
            let plain: f64 = each.map(|(d, plain)| d.abs() * plain).sum();
            if dot(&own, &on) > most + plain {
                return false;
            }
            let step = minus(farthest, &nearest);
            let part = dot(&on, &step) / dot(&step, &step);
            if part.is_nan() || part <= 0.0 {
                break;
            }
            for (nearest, step) in nearest.iter_mut().zip(&step) {
                *nearest += part.min(1.0) * step;
            }
        }
        true
    }
}

//! Derivatives beside a kink: what a derivative at the kink may be between.
use crate::ad::check::evidence::{Evidence, Item, finite};
use crate::ad::check::sample::Draw;
use crate::ad::check::tolerances::{
    APPROACHES, FEW_INPUTS, MOVED_ROUNDINGS, NEARBY, NEARER, PLACES, TRIES,
};
use crate::ad::check::witness::{Precision, combined, dot};

/// The difference of two lists.
fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

impl Evidence<'_> {
    /// `true` if a derivative along a direction is between those at places beside the input.
    ///
    /// Where kinks of both signs meet (the larger one of two functions with kinks of their own), or where the
    /// input is at the border of its domain, the derivatives to both sides of the input do not bound what a
    /// derivative there may be: the derivatives of the function's smooth pieces do (Clarke's generalised gradient).
    pub(crate) fn among_derivatives_nearby(
        &self,
        weights: &[f64],
        direction: &[f64],
        (derivative, tolerance): (f64, f64),
    ) -> bool {
        let on = self.on();
        if on.precision() != Precision::F64 {
            return false;
        }
        // A function of single precision may have decided as if its input were another one.
        let rounding = self.subject.rounding(self.x);
        let mut draw = Draw::new(11);
        let (mut least, mut most, mut seen) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for k in 0..TRIES {
            // The input may lie between two kinks that are nearer to each other than that.
            let far = match k % 2 {
                0 => NEARBY,
                _ => NEARBY * NEARER.powf(draw.within(0.0, 1.0)),
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
            let Some(along) = on.along(&there, direction) else {
                return false;
            };
            let own = dot(weights, &along);
            if !own.is_finite() {
                continue;
            }
            (least, most) = (least.min(own), most.max(own));
            seen += 1;
            if seen == PLACES {
                break;
            }
        }
        derivative >= least - tolerance && derivative <= most + tolerance
    }

    /// `true` if the derivatives by hand lie between those of the smooth pieces that meet at the input, as duals tell a
    /// few last digits beside it: along every axis, along random directions, and along those that lead from the
    /// pieces' derivatives and their mean to the derivatives in question.
    ///
    /// Steps need both sides of a kink, at several steps each. Here it is enough that the pieces are there, which
    /// may end as near as a millionth of the scales.
    pub(crate) fn between_pieces(&self, row: &Item) -> bool {
        let (on, n) = (self.on(), self.x.len());
        let Some(adjoint) = row.adjoint.as_ref().filter(|_| n <= FEW_INPUTS) else {
            return false;
        };
        // A tie is one to the bit where branches are known.
        if self.trace.is_some() && !self.exactly_tied() {
            return false;
        }
        let rounding = self.subject.rounding(self.x);
        let mut draw = Draw::new(13);
        let pieces: Vec<Vec<f64>> = (0..PLACES)
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
        if pieces.is_empty() {
            return false;
        }
        // Derivatives times scales are comparable.
        let scaled = |derivatives: &[f64]| -> Vec<f64> {
            let each = derivatives.iter().zip(&self.scales);
            each.map(|(derivative, scale)| derivative * scale).collect()
        };
        let own = scaled(adjoint);
        let corners: Vec<Vec<f64>> = pieces.iter().map(|piece| scaled(piece)).collect();
        // From one of them to the nearest of all that lie between: the way on is a direction that separates the
        // derivatives in question from the pieces', if there is one.
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

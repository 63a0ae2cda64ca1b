//! Slopes beside a kink: what a derivative at the kink may be between.
use crate::ad::check::evidence::Evidence;
use crate::ad::check::sample::Draw;
use crate::ad::check::tolerances::{NEARBY, NEARER, PLACES, TRIES};
use crate::ad::check::witness::{Precision, dot};

impl Evidence<'_> {
    /// Whether a slope along a direction is between those at places beside the input.
    ///
    /// Where kinks of both signs meet (the larger one of two functions with kinks of their own), or where the
    /// input is at the border of its domain, the slopes to both sides of the input do not bound what a
    /// derivative there may be: the slopes of the function's smooth pieces do (Clarke's generalised gradient).
    pub(crate) fn among_slopes_nearby(
        &self,
        weights: &[f64],
        direction: &[f64],
        (slope, tolerance): (f64, f64),
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
        slope >= least - tolerance && slope <= most + tolerance
    }
}

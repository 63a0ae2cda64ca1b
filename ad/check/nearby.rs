//! Slopes beside a kink: what a derivative at the kink may be between.
use crate::ad::check::judge::Judge;
use crate::ad::check::sample::Draw;
use crate::ad::check::subject::Subject;
use crate::ad::check::witness::{Precision, dot};

/// How far the places beside the input are, in its scales.
const NEAR: f64 = 1e-4;
/// How many of them are looked at, and how many are tried: of a box without width only those are in the
/// domain that have one.
const PLACES: usize = 48;
const TRIES: usize = 4000;

impl Judge<'_> {
    /// Whether a slope along a direction is between those at places beside the input.
    ///
    /// Where kinks of both signs meet (the larger one of two functions with kinks of their own), or where the
    /// input is at the border of its domain, the slopes to both sides of the input do not bound what a
    /// derivative there may be: the slopes of the function's smooth pieces do (Clarke's generalised gradient).
    pub(crate) fn among_slopes_nearby(
        &self,
        on: &dyn Subject,
        weights: &[f64],
        direction: &[f64],
        (slope, tolerance): (f64, f64),
    ) -> bool {
        if on.precision() != Precision::F64 {
            return false;
        }
        let mut draw = Draw::new(11);
        let (mut least, mut most, mut seen) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for _ in 0..TRIES {
            let there: Vec<f64> = (self.x.iter().zip(&self.scales))
                .map(|(x, scale)| x + NEAR * scale * draw.within(-1.0, 1.0))
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

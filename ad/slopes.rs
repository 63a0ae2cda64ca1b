//! The part of a judgement that takes steps: differences and kinks.
use crate::ad::hearing::{Said, confirmed, hear};
use crate::ad::judge::{Judge, ROUNDINGS, Row, SAFETY};
use crate::ad::sample::Draw;
use crate::ad::subject::{Jumps, Subject};
use crate::ad::trace::Trace;
use crate::ad::verdict::{Nearest, Numbers, Place, Reason, Witness};
use crate::ad::witness::{Estimate, Ladder, dot};

/// Inputs up to this number are stepped one by one, more of them along random directions.
pub(crate) const FEW_INPUTS: usize = 48;
/// First steps of the ladder that judges and of those that confirm, in units of the scales. The
/// last ones look for features smaller than the first one can see.
pub(crate) const FIRST: [f64; 5] = [0.1, 0.037, 0.23, 1e-3, 1e-5];
/// First step of the ladder that tells a jump from a kink very near.
const NEAR: f64 = 1e-8;
impl Judge<'_> {
    /// Slopes against differences along every direction. True when the function stays in one
    /// branch for a while along all of them, so that second derivatives make sense.
    pub(crate) fn differences(&mut self, rows: &mut [Row], draw: &mut Draw) -> bool {
        let subject = self.subject;
        let wide = subject.wide();
        let on: &dyn Subject = wide.as_deref().unwrap_or(subject);
        let (center, trace) = match on.traced(self.x) {
            Some((values, trace)) => (values, Some(trace)),
            None => (on.value(self.x), None),
        };
        let (x, n, scales) = (self.x, self.x.len(), self.scales.clone());
        if n == 0 || center.len() != self.y.len() || center.iter().any(|y| !y.is_finite()) {
            return false;
        }
        let probe = |there: &[f64]| -> Option<(Vec<f64>, Option<Trace>)> {
            if !on.inside(there) {
                return None;
            }
            let (values, trace) = match on.traced(there) {
                Some((values, trace)) => (values, Some(trace)),
                None => (on.value(there), None),
            };
            let usable = values.len() == center.len() && values.iter().all(|y| y.is_finite());
            usable.then_some((values, trace))
        };
        let ladder = |direction: &[f64], first: f64| {
            Ladder::climb(&probe, on.precision(), x, &center, trace, direction, first)
        };
        let unit = |i: usize| {
            let mut direction = vec![0.0; n];
            direction[i] = scales[i];
            direction
        };
        let mut random =
            || -> Vec<f64> { scales.iter().map(|s| s * draw.within(-1.0, 1.0)).collect() };
        let mut directions: Vec<Vec<f64>> = if n <= FEW_INPUTS {
            (0..n).map(unit).collect()
        } else {
            (0..12).map(|_| random()).collect()
        };
        let more: Vec<Vec<f64>> = (0..4).map(|_| random()).collect();

        let mut said = Vec::new();
        let mut kinks = false;
        let mut k = 0;
        while k < directions.len() {
            let direction = directions[k].clone();
            let here = ladder(&direction, FIRST[0]);
            let reach = self.reach(rows, &direction);
            if self.jumps(&here, &|| ladder(&direction, NEAR), reach, k) {
                self.found.directions[2] += rows.len() as u64;
                said.push(true);
                k += 1;
                continue;
            }
            for row in rows.iter_mut() {
                let noise = if wide.is_some() {
                    4.0 * f64::EPSILON * center.iter().map(|y| y.abs()).sum::<f64>()
                } else {
                    row.noise
                };
                let place = self.one_direction(row, k, &direction, noise, &here, &ladder);
                said.push(place.1);
                kinks |= place.0 == Place::Kink;
                let at = match place.0 {
                    Place::Smooth => 0,
                    Place::Kink => 1,
                    Place::Undefined => 2,
                };
                self.found.directions[at] += 1;
                self.found.switched += u64::from(place.1);
            }
            k += 1;
            // The directions of a long input are all alike: one refusal says it.
            if n > FEW_INPUTS && !self.found.faults.is_empty() {
                break;
            }
            // At a kink the coordinate axes are not enough.
            if k == n && kinks && n <= FEW_INPUTS {
                directions.extend(more.iter().cloned());
            }
        }
        self.vote();
        let [smooth, kinked, undefined] = self.found.directions;
        self.found.place = if self.found.jump || (smooth + kinked == 0 && undefined > 0) {
            Place::Undefined
        } else if kinked > 0 {
            Place::Kink
        } else {
            Place::Smooth
        };
        self.found.place == Place::Smooth && undefined == 0 && !said.contains(&true)
    }

    /// Where adjoint and duals differ, the one that the differences are against is outvoted.
    fn vote(&mut self) {
        let faults = self.found.faults.clone();
        for fault in &mut self.found.faults {
            if fault.reason != Reason::Disagree(Witness::Adjoint, Witness::Dual) {
                continue;
            }
            let against = |witness: Witness| {
                let reason = Reason::Disagree(witness, Witness::Difference);
                let found = faults
                    .iter()
                    .find(|f| f.reason == reason && f.output == fault.output);
                found.copied()
            };
            let (adjoint, dual) = (against(Witness::Adjoint), against(Witness::Dual));
            fault.suspect = match (adjoint, dual) {
                (Some(_), None) => Some(Witness::Adjoint),
                (None, Some(_)) => Some(Witness::Dual),
                _ => None,
            };
        }
    }

    /// By how much the value may change within the rounding of the steps along a direction. Along
    /// an axis steps are exact.
    fn reach(&self, rows: &[Row], direction: &[f64]) -> f64 {
        let moved = || (0..self.x.len()).filter(|&i| direction[i] != 0.0);
        if moved().count() < 2 {
            return 0.0;
        }
        let slope = |i: usize| rows.iter().fold(0.0_f64, |m, row| m.max(row.size[i]));
        moved().map(|i| slope(i) * self.eps * self.x[i].abs()).sum()
    }

    /// Whether any output jumps along a direction by more than `reach`; if it must not, that is
    /// refused.
    fn jumps(&mut self, here: &Ladder, near: &dyn Fn() -> Ladder, reach: f64, k: usize) -> bool {
        let mut unrest = Vec::new();
        for j in 0..self.y.len() {
            let mut weights = vec![0.0; self.y.len()];
            weights[j] = 1.0;
            if here.traced && here.jump(&weights, self.eps * self.y[j].abs()).is_some() {
                // Rounding within a branch is no jump.
                let none = vec![0.0; self.y.len()];
                unrest = self.spread(&self.y, Some(&none), |x| Some(self.subject.value(x)));
            }
            let noise = self.eps * self.y[j].abs() + unrest.get(j).unwrap_or(&0.0) + reach;
            // A kink may be nearer than the smallest step; a jump still jumps nearer by.
            if here.jump(&weights, noise).is_some() && near().jump(&weights, noise).is_some() {
                self.found.jump = true;
                let allowed = match self.subject.conventions().jumps {
                    Jumps::Never => false,
                    Jumps::FromZero => self.y[j] == 0.0,
                    Jumps::Anywhere => true,
                };
                if !allowed {
                    self.refuse(Reason::Jump, j, k);
                }
                return true;
            }
        }
        false
    }

    /// One direction: what kind of place it is there, and whether branches switch.
    fn one_direction(
        &mut self,
        row: &mut Row,
        k: usize,
        direction: &[f64],
        noise: f64,
        here: &Ladder,
        climb: &dyn Fn(&[f64], f64) -> Ladder,
    ) -> (Place, bool) {
        let n = self.x.len();
        let ladder = |first| climb(direction, first);
        let along = |list: &[f64]| dot(list, direction);
        // Along random directions the steps are rounded in every coordinate.
        let largest = row.largest;
        let mut noise = noise;
        if direction.iter().filter(|d| **d != 0.0).count() > 1
            && let Some(slopes) = row.adjoint.as_ref().or(row.dual.as_ref())
        {
            noise += (0..n)
                .map(|i| slopes[i].abs() * self.x[i].abs() * f64::EPSILON)
                .sum::<f64>();
        }
        let input = if n <= FEW_INPUTS && k < n { k } else { 0 };
        let by_hand = row.adjoint.as_ref().map(|list| along(list));
        let by_duals = match &row.dual {
            Some(list) => Some(along(list)),
            None => self.by_duals(row, direction),
        };
        let mut result = (Place::Undefined, here.traced);
        let mut judged = false;
        for (witness, slope) in [(Witness::Adjoint, by_hand), (Witness::Dual, by_duals)] {
            let Some(slope) = slope else { continue };
            let exact =
                |row: &Row| -> f64 { (0..n).map(|i| direction[i].abs() * row.tolerance[i]).sum() };
            let mut said = hear(here, &row.weights, noise, slope, exact(row), largest);
            if matches!(said, Said::Other { .. } | Said::Outside { .. }) {
                self.provoke(row);
                self.provoke_widely(row);
                said = hear(here, &row.weights, noise, slope, exact(row), largest);
            }
            let pair = if witness == Witness::Adjoint { 1 } else { 2 };
            // Along one number, say its slopes.
            let along = n > FEW_INPUTS || k >= n;
            let per = if along { 1.0 } else { direction[k] };
            let numbers = |difference: Option<f64>, sides: Option<[f64; 2]>| Numbers {
                adjoint: by_hand.map(|slope| slope / per),
                dual: by_duals.map(|slope| slope / per),
                difference: difference.map(|slope| slope / per),
                sides: sides.map(|sides| sides.map(|slope| slope / per)),
                other: None,
                along,
            };
            let output = row.output;
            let provoked = row.provoked;
            let nearest = |e: &Estimate, tolerance: f64| Nearest {
                provoked,
                output,
                input,
                numbers: numbers(Some(e.value), None),
                tolerance: tolerance / per,
                ..Nearest::default()
            };
            let other_agrees = |value: f64, tolerance: f64| {
                let other = if witness == Witness::Adjoint {
                    by_duals
                } else {
                    by_hand
                };
                other.is_some_and(|slope| (slope - value).abs() <= tolerance)
            };
            match said {
                Said::Fine {
                    place,
                    switched,
                    estimate,
                } => {
                    if !judged {
                        result = (place, switched);
                    }
                    if let Some(e) = estimate {
                        let tolerance = SAFETY * e.error + exact(row);
                        let gap = (e.value - slope).abs() / per;
                        let at = nearest(&e, tolerance);
                        self.found.worst[pair].note(gap, largest / per, self.eps, at);
                    }
                }
                Said::Other {
                    estimate,
                    tolerance,
                } => {
                    result = (Place::Smooth, false);
                    let confirmed = confirmed(FIRST[1..].iter().map(|&first| {
                        let again = ladder(first);
                        match hear(&again, &row.weights, noise, slope, exact(row), largest) {
                            Said::Other { estimate: e, .. } => Some(
                                (e.value - estimate.value).abs()
                                    <= SAFETY * (e.error + estimate.error) + exact(row),
                            ),
                            Said::Outside { .. } => Some(true),
                            Said::Fine {
                                place: Place::Undefined,
                                ..
                            } => None,
                            Said::Fine { .. } => Some(false),
                        }
                    }));
                    if confirmed {
                        let suspect = other_agrees(estimate.value, tolerance).then_some(witness);
                        let reason = Reason::Disagree(witness, Witness::Difference);
                        let input = if n <= FEW_INPUTS {
                            input
                        } else {
                            self.worst_input(row, witness, direction, &|there| {
                                climb(there, FIRST[0])
                            })
                        };
                        let numbers = numbers(Some(estimate.value), None);
                        let tolerance = tolerance / per;
                        self.refuse_with(reason, suspect, output, input, numbers, tolerance);
                    } else {
                        result = (Place::Undefined, true);
                    }
                }
                Said::Outside { sides, tolerance } => {
                    let border = here.ahead.len() < 2 || here.behind.len() < 2;
                    result = (if border { Place::Smooth } else { Place::Kink }, true);
                    let value = dot(&row.weights, &self.y);
                    let flat = self.subject.conventions().flat
                        && if border {
                            let (low, high) = (sides[0].min(0.0), sides[0].max(0.0));
                            slope >= low - tolerance && slope <= high + tolerance
                        } else {
                            value == 0.0 && slope.abs() <= tolerance
                        };
                    if flat {
                        self.found.convention = true;
                    } else if confirmed(FIRST[1..].iter().map(|&first| {
                        let again = ladder(first);
                        match hear(&again, &row.weights, noise, slope, exact(row), largest) {
                            Said::Outside { .. } | Said::Other { .. } => Some(true),
                            Said::Fine {
                                place: Place::Undefined,
                                ..
                            } => None,
                            Said::Fine { .. } => Some(false),
                        }
                    })) {
                        let numbers = numbers(None, Some(sides));
                        self.refuse_with(
                            Reason::OutsideKink,
                            None,
                            output,
                            input,
                            numbers,
                            tolerance / per,
                        );
                    }
                }
            }
            judged = true;
            // Duals that say what the adjoint says need no hearing of their own.
            let gap = by_duals.map(|dual| (dual - slope).abs());
            if gap.is_some_and(|gap| gap <= ROUNDINGS * self.eps * largest) {
                if let Said::Fine {
                    estimate: Some(e), ..
                } = said
                {
                    let tolerance = SAFETY * e.error + exact(row) + ROUNDINGS * self.eps * largest;
                    let gap = by_duals.map_or(0.0, |dual| (dual - e.value).abs()) / per;
                    let at = nearest(&e, tolerance);
                    self.found.worst[2].note(gap, largest / per, self.eps, at);
                }
                break;
            }
        }
        if !judged {
            // No derivative at all: still say what kind of place it is.
            let said = hear(here, &row.weights, noise, 0.0, f64::INFINITY, largest);
            if let Said::Fine {
                place, switched, ..
            } = said
            {
                result = (place, switched);
            }
        }
        result
    }
}

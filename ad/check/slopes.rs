//! The part of a judgement that takes steps: differences and kinks.
use crate::ad::check::hearing::Said;
use crate::ad::check::judge::{Judge, ROUNDINGS, Row, SAFETY};
use crate::ad::check::listener::{INFORMATIVE, Listener};
use crate::ad::check::sample::Draw;
use crate::ad::check::subject::{Jumps, Subject};
use crate::ad::check::trace::Trace;
use crate::ad::check::verdict::{Nearest, Numbers, Place, Reason, Witness};
use crate::ad::check::witness::{Estimate, Ladder, dot};

/// Inputs up to this number are stepped one by one, more of them along random directions.
pub(crate) const FEW_INPUTS: usize = 48;
/// First steps of the ladder that judges and of those that confirm, in units of the scales. The
/// last ones look for features smaller than the first one can see.
pub(crate) const FIRST: [f64; 5] = [0.1, 0.037, 0.23, 1e-3, 1e-5];
/// First step of the ladder that tells a jump from a kink very near.
const NEAR: f64 = 1e-8;
/// How near the border of its domain a number is on it, in its scale.
const BORDER: f64 = 1e-6;

/// A direction to take differences along.
struct Direction<'d> {
    /// The number of the direction: that of the input for the first ones of a short input.
    k: usize,
    direction: &'d [f64],
    /// Values along it.
    here: &'d Ladder,
    /// The same along any direction from another first step.
    climb: &'d dyn Fn(&[f64], f64) -> Ladder,
    /// The function, in double precision if it is known there.
    on: &'d dyn Subject,
}

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
        let mut more: Vec<Vec<f64>> = (0..4).map(|_| random()).collect();
        // A number at the border of its domain can move to one side only, and one side of a kink says
        // nothing of the other: there such a number stays, so that both sides are seen.
        let bordered = |i: usize| {
            let steps = [-BORDER, BORDER].map(|step| {
                let mut there = x.to_vec();
                there[i] += step * scales[i];
                on.inside(&there)
            });
            steps.contains(&false)
        };
        if n <= FEW_INPUTS {
            for i in (0..n).filter(|&i| bordered(i)) {
                more.iter_mut().for_each(|direction| direction[i] = 0.0);
            }
            more.retain(|direction| direction.iter().any(|d| *d != 0.0));
        }

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
            let along = Direction {
                k,
                direction: &direction,
                here: &here,
                climb: &ladder,
                on,
            };
            for row in rows.iter_mut() {
                let noise = if wide.is_some() {
                    4.0 * f64::EPSILON * center.iter().map(|y| y.abs()).sum::<f64>()
                } else {
                    row.noise
                };
                let place = self.one_direction(row, noise, &along);
                said.push(place.1);
                kinks |= place.0 == Place::Kink;
                let derived = row.adjoint.is_some() || row.dual.is_some();
                if place.0 != Place::Undefined && derived {
                    self.told.push((row.output, k, place.0));
                    match self.found.heard.get_mut(k) {
                        Some(heard) if n <= FEW_INPUTS => *heard = true,
                        _ => self.found.heard.fill(true),
                    }
                }
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
                directions.extend(self.tied());
            }
        }
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

    /// Whether the input is an exact tie at which no slopes are right: along single numbers the value
    /// rises as if it were smooth, and along all of them together not by the sum of that.
    fn nobodys(&self, weights: &[f64], noise: f64, climb: &dyn Fn(&[f64], f64) -> Ladder) -> bool {
        let n = self.x.len();
        if n > FEW_INPUTS || self.trace.is_none_or(|trace| trace.margin != 0.0) {
            return false;
        }
        let rise = |direction: &[f64]| {
            let ladder = climb(direction, FIRST[0]);
            let sides = [true, false].map(|ahead| ladder.one_sided(ahead, weights, noise));
            let [Some(ahead), Some(behind)] = sides else {
                return None;
            };
            let gap = (ahead.value - behind.value).abs();
            let error = ahead.error.max(behind.error) + gap;
            Some([0.5 * (ahead.value + behind.value), error])
        };
        let mut alone = [0.0; 2];
        for i in 0..n {
            let mut axis = vec![0.0; n];
            axis[i] = self.scales[i];
            let Some([value, error]) = rise(&axis) else {
                return false;
            };
            alone = [alone[0] + value, alone[1] + error];
        }
        rise(&self.scales).is_some_and(|[value, error]| {
            let gap = (value - alone[0]).abs();
            gap > SAFETY * (error + alone[1]) && gap > INFORMATIVE * value.abs().max(alone[0].abs())
        })
    }

    /// Directions that keep ties: along each all numbers of one magnitude move alike. There a kink of
    /// many is smooth, and a derivative has no choice.
    fn tied(&self) -> Vec<Vec<f64>> {
        let mut sizes: Vec<u64> = self.x.iter().map(|x| x.abs().to_bits()).collect();
        sizes.sort_unstable();
        sizes.dedup();
        let direction = |size: u64| {
            let member = |i: &usize| self.x[*i].abs().to_bits() == size;
            let group: Vec<usize> = (0..self.x.len()).filter(member).collect();
            let least = |m: f64, &i: &usize| m.min(self.scales[i]);
            let step = group.iter().fold(f64::INFINITY, least);
            let mut direction = vec![0.0; self.x.len()];
            for &i in &group {
                direction[i] = step.copysign(self.x[i]);
            }
            (group.len() > 1).then_some(direction)
        };
        sizes.into_iter().filter_map(direction).take(8).collect()
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
            if here.traced && here.jump(j, self.eps * self.y[j].abs()).is_some() {
                // Rounding within a branch is no jump.
                let none = vec![0.0; self.y.len()];
                unrest = self.spread(&self.y, Some(&none), |x| Some(self.subject.value(x)));
            }
            let noise = self.eps * self.y[j].abs() + unrest.get(j).unwrap_or(&0.0) + reach;
            // A kink may be nearer than the smallest step; a jump still jumps nearer by.
            if here.jump(j, noise).is_some() && near().jump(j, noise).is_some() {
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
    fn one_direction(&mut self, row: &mut Row, noise: f64, at: &Direction<'_>) -> (Place, bool) {
        let &Direction {
            k,
            direction,
            here,
            climb,
            on,
        } = at;
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
        let along_axis = n <= FEW_INPUTS && k < n;
        for (witness, slope) in [(Witness::Adjoint, by_hand), (Witness::Dual, by_duals)] {
            let Some(slope) = slope else { continue };
            let exact =
                |row: &Row| -> f64 { (0..n).map(|i| direction[i].abs() * row.tolerance[i]).sum() };
            let weights = row.weights.clone();
            let mut listener = Listener {
                weights: &weights,
                here,
                climb: &ladder,
                slope,
                exact: exact(row),
                noise,
                rough: 0.0,
                hidden: self.eps * self.x.iter().fold(0.0_f64, |m, x| m.max(x.abs())),
                size: largest,
                guessed: self.subject.guessed_scales(),
                own: match (along_axis, self.x.get(k)) {
                    (true, Some(x)) => x.abs() / direction[k].abs(),
                    _ => 1.0,
                },
            };
            let mut said = listener.first();
            if said.complains() {
                self.provoke(row);
                self.provoke_widely(row);
                (listener.exact, listener.rough) = (exact(row), self.rough_value(on, &weights));
                said = listener.first();
            }
            let coarse = said;
            said = listener.finer(said);
            if along_axis && said.undefined() && !self.found.heard[k] {
                self.hear_coarsely(row, coarse, listener.exact, (k, direction[k].abs()));
            }
            let pair = if witness == Witness::Adjoint { 1 } else { 2 };
            // Along one number, say its slopes.
            let along = !along_axis;
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
                    if let Some(e) = estimate.filter(|_| place != Place::Undefined) {
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
                    let agree = by_hand.zip(by_duals);
                    let agree = agree.is_some_and(|(a, b)| (a - b).abs() <= exact(row));
                    let heard = listener.again(said, agree);
                    let estimate = heard.against.unwrap_or(estimate);
                    let tolerance = if heard.stands {
                        SAFETY * estimate.error + exact(row)
                    } else {
                        tolerance
                    };
                    let convention = witness == Witness::Dual && self.tie_of_duals();
                    result = (Place::Smooth, false);
                    if heard.stands && (convention || self.nobodys(&weights, noise, climb)) {
                        self.found.convention = true;
                    } else if heard.stands {
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
                    } else if !heard.supported {
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
                    } else if listener.again(said, false).stands {
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
                if let (false, Said::Fine { estimate, .. }) = (said.undefined(), said)
                    && let Some(e) = estimate
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
            let listener = Listener {
                weights: &row.weights,
                here,
                climb: &ladder,
                slope: 0.0,
                exact: f64::INFINITY,
                noise,
                rough: 0.0,
                hidden: 0.0,
                size: largest,
                guessed: false,
                own: 1.0,
            };
            let said = listener.first();
            if let Said::Fine {
                place, switched, ..
            } = said
            {
                result = (place, switched);
            }
        }
        result
    }

    /// Notes that a slope was heard although differences are too coarse for one as large as others are:
    /// not too coarse for this one as it typically is.
    fn hear_coarsely(&mut self, row: &Row, said: Said, exact: f64, (k, scale): (usize, f64)) {
        let Said::Fine {
            estimate: Some(e), ..
        } = said
        else {
            return;
        };
        let slopes = |x: &[f64]| self.subject.adjoint(x, &row.weights);
        let typical = (row.adjoint.as_ref()).map_or(0.0, |list| {
            self.typical(&row.weights, list, &slopes)[k] * scale
        });
        if e.error == 0.0 || SAFETY * e.error + exact <= 0.5 * typical {
            self.found.heard[k] = true;
        }
    }
}

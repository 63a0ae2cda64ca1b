//! The part of a judgement that takes steps: differences and kinks.
use crate::ad::check::judge::{Judge, ROUNDINGS, Row, SAFETY};
use crate::ad::check::opinion::Opinion;
use crate::ad::check::sample::Draw;
use crate::ad::check::slope_test::{INFORMATIVE, SlopeTest};
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
    /// The same across the border of the domain, where the function may be asked there.
    across: Option<&'d dyn Fn(&[f64], f64) -> Ladder>,
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
        let anywhere = |there: &[f64]| -> Option<(Vec<f64>, Option<Trace>)> {
            let (values, trace) = match on.traced(there) {
                Some((values, trace)) => (values, Some(trace)),
                None => (on.value(there), None),
            };
            let usable = values.len() == center.len() && values.iter().all(|y| y.is_finite());
            usable.then_some((values, trace))
        };
        let probe = |there: &[f64]| on.inside(there).then(|| anywhere(there)).flatten();
        let ladder = |direction: &[f64], first: f64| {
            Ladder::climb(&probe, on.precision(), x, &center, trace, direction, first)
        };
        let across = |direction: &[f64], first: f64| {
            let precision = on.precision();
            Ladder::climb(&anywhere, precision, x, &center, trace, direction, first)
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
                across: on.total().then_some(&across),
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
                    self.compared.push((row.output, k, place.0));
                    match self.found.covered.get_mut(k) {
                        Some(covered) if n <= FEW_INPUTS => *covered = true,
                        _ => self.found.covered.fill(true),
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
            across,
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
            let mut test = SlopeTest {
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
            let mut said = test.first();
            if said.complains() {
                self.provoke(row);
                self.provoke_widely(row);
                (test.exact, test.rough) = (exact(row), self.rough_value(on, &weights));
                said = test.first();
            }
            let coarse = said;
            said = test.finer(said);
            if along_axis && said.undefined() && !self.found.covered[k] {
                self.count_coarse(row, coarse, test.exact, (k, direction[k].abs()));
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
                Opinion::Fine {
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
                Opinion::Other {
                    estimate,
                    tolerance,
                } => {
                    let agree = by_hand.zip(by_duals);
                    let agree = agree.is_some_and(|(a, b)| (a - b).abs() <= exact(row));
                    let covered = test.again(said, agree);
                    let estimate = covered.against.unwrap_or(estimate);
                    let tolerance = if covered.stands {
                        SAFETY * estimate.error + exact(row)
                    } else {
                        tolerance
                    };
                    let convention = witness == Witness::Dual && self.tie_of_duals();
                    result = (Place::Smooth, false);
                    let tied = agree && self.exactly_tied();
                    let bent = || tied && (self.chosen() || self.bent(row, at));
                    if covered.stands && convention {
                        self.found.convention = true;
                    } else if covered.stands && bent() {
                        self.found.convention = true;
                        result = (Place::Undefined, true);
                    } else if covered.stands {
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
                    } else if !covered.supported {
                        result = (Place::Undefined, true);
                    }
                }
                Opinion::Outside { sides, tolerance } => {
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
                    // A kink exactly on the border has its other side beyond.
                    let beyond = || {
                        let across = across.filter(|_| border && self.exactly_tied())?;
                        let here = across(direction, FIRST[0]);
                        let climb = |first| across(direction, first);
                        let there = SlopeTest {
                            here: &here,
                            climb: &climb,
                            ..test
                        };
                        let said = there.first();
                        (!said.undefined() && !said.complains()).then_some(())
                    };
                    let found = self.chosen() && self.exactly_tied();
                    if flat || found || beyond().is_some() {
                        self.found.convention = true;
                    } else if test.again(said, false).stands
                        && !self.among_slopes_nearby(on, &weights, direction, (slope, tolerance))
                    {
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
            // Duals that say what the adjoint says need no check of their own.
            let gap = by_duals.map(|dual| (dual - slope).abs());
            if gap.is_some_and(|gap| gap <= ROUNDINGS * self.eps * largest) {
                if let (false, Opinion::Fine { estimate, .. }) = (said.undefined(), said)
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
            let test = SlopeTest {
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
            let said = test.first();
            if let Opinion::Fine {
                place, switched, ..
            } = said
            {
                result = (place, switched);
            }
        }
        result
    }

    /// Whether the result is something that was chosen, such as the nearest points of two shapes, and not a
    /// least or a greatest number: found by a search, or of several numbers that may jump. Where several
    /// choices are as good to the bit, slopes are those of one of them, or their mean, and need not be
    /// between those of the two that happen to win on either side.
    fn chosen(&self) -> bool {
        let conventions = self.subject.conventions();
        conventions.searches || (conventions.jumps == Jumps::Anywhere && self.y.len() > 1)
    }

    /// Whether the input is a tie of the source, to the bit.
    fn exactly_tied(&self) -> bool {
        self.trace.is_some_and(|trace| trace.margin == 0.0)
    }

    /// Whether there is no gradient at the input: the slope along the sum of two directions is not the sum of
    /// the slopes, although there is one along each, seen from both sides or from one. So it is where a
    /// function of homogeneous degree one that is not linear begins, as the circle through three points
    /// does where these coincide.
    fn bent(&self, row: &Row, at: &Direction<'_>) -> bool {
        let (weights, noise) = (&row.weights, row.noise);
        let slopes = |direction: &[f64]| {
            let ladder = (at.climb)(direction, FIRST[0]);
            [
                ladder.central(weights, noise, false),
                ladder.one_sided(true, weights, noise),
                ladder.one_sided(false, weights, noise),
            ]
        };
        let here = slopes(at.direction);
        (0..self.x.len()).any(|i| {
            let mut other = vec![0.0; self.x.len()];
            other[i] = self.scales[i];
            let sum = other.iter().zip(at.direction).map(|(a, b)| a + b);
            let both = slopes(&sum.collect::<Vec<f64>>());
            let other = slopes(&other);
            (0..3).any(|side| {
                let (Some(one), Some(other), Some(both)) = (here[side], other[side], both[side])
                else {
                    return false;
                };
                let gap = (both.value - one.value - other.value).abs();
                let errors = both.error + one.error + other.error;
                gap > INFORMATIVE * row.largest && gap > SAFETY * errors
            })
        })
    }

    /// Notes that a slope was covered although differences are too coarse for one as large as others are:
    /// not too coarse for this one as it typically is.
    fn count_coarse(&mut self, row: &Row, said: Opinion, exact: f64, (k, scale): (usize, f64)) {
        let Opinion::Fine {
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
            self.found.covered[k] = true;
        }
    }
}

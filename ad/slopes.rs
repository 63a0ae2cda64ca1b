//! The part of a judgement that takes steps: differences, kinks, second derivatives, motions.
use crate::ad::judge::{Judge, ROUNDINGS, Row, SAFETY};
use crate::ad::sample::Draw;
use crate::ad::subject::{Jumps, Subject};
use crate::ad::symmetry::{Answer, Kind, Motion, answer, exchanged, moved_by, velocity};
use crate::ad::trace::Trace;
use crate::ad::verdict::{Numbers, Place, Reason, Witness};
use crate::ad::witness::{Estimate, Ladder, Precision, Probe, beside, dot};

/// Inputs up to this number are stepped one by one, more of them along random directions.
pub(crate) const FEW_INPUTS: usize = 48;
/// First steps of the ladder that judges and of those that confirm, in units of the scales. The
/// last ones look for features smaller than the first one can see.
const FIRST: [f64; 5] = [0.1, 0.037, 0.23, 1e-3, 1e-5];
/// First step of the ladder that tells a jump from a kink very near.
const NEAR: f64 = 1e-8;
/// A difference whose error is larger than this share of the largest slope says nothing.
const INFORMATIVE: f64 = 0.02;

/// What steps along one direction say about a slope.
#[derive(Clone, Copy, Debug)]
enum Said {
    /// In order, at such a place; `switched` when other branches were taken however small the step.
    Fine {
        place: Place,
        switched: bool,
        estimate: Option<Estimate>,
    },
    /// Another slope.
    Other { estimate: Estimate, tolerance: f64 },
    /// A kink, and the slope is not between both sides; or the border of the domain, and it is not
    /// that of the only side.
    Outside { sides: [f64; 2], tolerance: f64 },
}

/// Whether a complaint stands: some other ladder repeats it, and none contradicts.
fn confirmed(again: impl Iterator<Item = Option<bool>>) -> bool {
    let mut repeated = false;
    for said in again.flatten() {
        if !said {
            return false;
        }
        repeated = true;
    }
    repeated
}

/// Hears what a ladder says about a slope; `exact` is by how much that may be off by itself,
/// `size` the largest slope there is.
fn hear(ladder: &Ladder, weights: &[f64], noise: f64, slope: f64, exact: f64, size: f64) -> Said {
    let noise = noise.max(ladder.noise(weights));
    let informative = |e: &Estimate| SAFETY * e.error <= INFORMATIVE * size.max(e.value.abs());
    if ladder.traced
        && let Some(e) = ladder.central(weights, noise, true).filter(informative)
    {
        let tolerance = SAFETY * e.error + exact;
        return if (e.value - slope).abs() <= tolerance {
            Said::Fine {
                place: Place::Smooth,
                switched: false,
                estimate: Some(e),
            }
        } else {
            Said::Other {
                estimate: e,
                tolerance,
            }
        };
    }
    let undefined = Said::Fine {
        place: Place::Undefined,
        switched: ladder.traced,
        estimate: None,
    };
    let ahead = ladder.one_sided(true, weights, noise);
    let behind = ladder.one_sided(false, weights, noise);
    let (ahead, behind) = match (ahead, behind) {
        (Some(ahead), Some(behind)) => (ahead, behind),
        (Some(side), None) | (None, Some(side)) => (side, side),
        (None, None) => return undefined,
    };
    let error = ahead.error.max(behind.error);
    let border = ladder.ahead.len() < 2 || ladder.behind.len() < 2;
    if !ladder.settled() {
        return undefined;
    }
    if !border && (ahead.value - behind.value).abs() <= 2.0 * SAFETY * error + exact {
        // Where branches meet smoothly, the central slope converges slowly and the sides fast.
        let mean = Estimate {
            value: 0.5 * (ahead.value + behind.value),
            error: error + 0.5 * (ahead.value - behind.value).abs() / SAFETY,
        };
        let central = ladder.central(weights, noise, false);
        let e = match central {
            Some(central) if !ladder.traced && central.error < mean.error => central,
            _ => mean,
        };
        if !informative(&e) {
            return undefined;
        }
        let tolerance = SAFETY * e.error + exact;
        return if (e.value - slope).abs() <= tolerance {
            Said::Fine {
                place: Place::Smooth,
                switched: ladder.traced,
                estimate: Some(e),
            }
        } else {
            Said::Other {
                estimate: e,
                tolerance,
            }
        };
    }
    if SAFETY * error > INFORMATIVE * size.max(ahead.value.abs()).max(behind.value.abs()) {
        return undefined;
    }
    let sides = [behind.value, ahead.value];
    let tolerance = SAFETY * error + exact;
    let (low, high) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
    if slope >= low - tolerance && slope <= high + tolerance {
        let place = if border { Place::Smooth } else { Place::Kink };
        Said::Fine {
            place,
            switched: ladder.traced,
            estimate: None,
        }
    } else {
        Said::Outside { sides, tolerance }
    }
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
        let more: Vec<Vec<f64>> = (0..4).map(|_| random()).collect();

        let mut said = Vec::new();
        let mut kinks = false;
        let mut k = 0;
        while k < directions.len() {
            let direction = directions[k].clone();
            let here = ladder(&direction, FIRST[0]);
            if self.jumps(&here, &|| ladder(&direction, NEAR), k) {
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
                let place = self.one_direction(row, k, &direction, noise, &here, &|first| {
                    ladder(&direction, first)
                });
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

    /// Whether any output jumps along a direction; if it must not, that is refused.
    fn jumps(&mut self, here: &Ladder, near: &dyn Fn() -> Ladder, k: usize) -> bool {
        let mut unrest = Vec::new();
        for j in 0..self.y.len() {
            let mut weights = vec![0.0; self.y.len()];
            weights[j] = 1.0;
            if here.traced && here.jump(&weights, self.eps * self.y[j].abs()).is_some() {
                // Rounding within a branch is no jump.
                let none = vec![0.0; self.y.len()];
                unrest = self.spread(&self.y, Some(&none), |x| Some(self.subject.value(x)));
            }
            let noise = self.eps * self.y[j].abs() + unrest.get(j).unwrap_or(&0.0);
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
        ladder: &dyn Fn(f64) -> Ladder,
    ) -> (Place, bool) {
        let n = self.x.len();
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
        let slopes = [
            (Witness::Adjoint, row.adjoint.clone()),
            (Witness::Dual, row.dual.clone()),
        ];
        let mut result = (Place::Undefined, here.traced);
        let mut judged = false;
        for (witness, list) in slopes {
            let Some(list) = list else { continue };
            let slope = along(&list);
            let exact =
                |row: &Row| -> f64 { (0..n).map(|i| direction[i].abs() * row.tolerance[i]).sum() };
            let mut said = hear(here, &row.weights, noise, slope, exact(row), largest);
            if matches!(said, Said::Other { .. } | Said::Outside { .. }) {
                self.provoke(row);
                self.provoke_widely(row);
                said = hear(here, &row.weights, noise, slope, exact(row), largest);
            }
            let pair = if witness == Witness::Adjoint { 1 } else { 2 };
            let numbers = |difference, sides| Numbers {
                adjoint: row.adjoint.as_ref().map(|list| along(list)),
                dual: row.dual.as_ref().map(|list| along(list)),
                difference,
                sides,
                other: None,
            };
            let other_agrees = |value: f64, tolerance: f64| {
                let other = if witness == Witness::Adjoint {
                    &row.dual
                } else {
                    &row.adjoint
                };
                other
                    .as_ref()
                    .is_some_and(|list| (along(list) - value).abs() <= tolerance)
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
                        let gap = (e.value - slope).abs();
                        let eps = self.eps;
                        self.found.worst[pair].note(gap, largest, tolerance, eps, input);
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
                        let numbers = numbers(Some(estimate.value), None);
                        self.refuse_with(reason, suspect, row.output, input, numbers, tolerance);
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
                            row.output,
                            input,
                            numbers,
                            tolerance,
                        );
                    }
                }
            }
            judged = true;
            // Duals that say what the adjoint says need no hearing of their own.
            let same = row
                .dual
                .as_ref()
                .is_some_and(|dual| (along(dual) - slope).abs() <= ROUNDINGS * self.eps * largest);
            if same {
                if let Said::Fine {
                    estimate: Some(e), ..
                } = said
                {
                    let tolerance = SAFETY * e.error + exact(row);
                    let gap = row
                        .dual
                        .as_ref()
                        .map_or(0.0, |d| (along(d) - e.value).abs());
                    let eps = self.eps;
                    self.found.worst[2].note(gap, largest, tolerance, eps, input);
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

    /// Second derivatives: through the adjoint, by nested duals, by differences of the adjoint.
    pub(crate) fn curvature(&mut self, row: &Row, draw: &mut Draw) {
        let subject = self.subject;
        if subject.precision() == Precision::F32 || self.x.is_empty() {
            return;
        }
        let (n, output) = (self.x.len(), row.output);
        let mut random = || -> Vec<f64> {
            self.scales
                .iter()
                .map(|s| s * draw.within(-1.0, 1.0))
                .collect()
        };
        let (u, v) = (random(), random());
        let Some(bend) = subject.curvature(self.x, &row.weights, &v) else {
            return;
        };
        if bend.len() != n {
            self.refuse(Reason::WrongLength(Witness::Adjoint), output, 0);
            return;
        }
        if let Some(i) = bend.iter().position(|b| !b.is_finite()) {
            self.refuse(Reason::NotFinite(Witness::Adjoint), output, i);
            return;
        }
        let scales = &self.units;
        let largest = (0..n)
            .fold(0.0_f64, |m, i| m.max(bend[i].abs() * scales[i]))
            .max((0..n).fold(0.0_f64, |m, i| m.max(row.size[i] * scales[i])));
        let sizes: Vec<f64> = scales.iter().map(|s| largest / s).collect();
        let spread = std::cell::OnceCell::new();
        let spread = || {
            spread.get_or_init(|| {
                let own = self.spread(&bend, Some(&sizes), |x| {
                    subject.curvature(x, &row.weights, &v)
                });
                let nested = subject.nested(self.x, &row.weights, &v).unwrap_or_default();
                let other = self.spread(&nested, Some(&sizes), |x| {
                    subject.nested(x, &row.weights, &v)
                });
                (0..n)
                    .map(|i| own[i] + other.get(i).unwrap_or(&0.0))
                    .collect::<Vec<f64>>()
            })
        };
        let exact = |i: usize| 4.0 * ROUNDINGS * self.eps * largest / scales[i];
        let mut faults = Vec::new();
        if let Some(nested) = subject.nested(self.x, &row.weights, &v) {
            for i in 0..n {
                let gap = (bend[i] - nested[i]).abs();
                let mut tolerance = exact(i);
                if gap > tolerance {
                    tolerance += SAFETY * spread()[i];
                }
                if gap > tolerance || gap.is_nan() {
                    let numbers = Numbers {
                        adjoint: Some(bend[i]),
                        dual: Some(nested[i]),
                        ..Numbers::default()
                    };
                    let reason = Reason::CurvatureDisagrees(Witness::Dual);
                    faults.push((reason, i, numbers, tolerance));
                }
            }
        }
        if let Some(other) = subject.curvature(self.x, &row.weights, &u) {
            let (a, b) = (dot(&u, &bend), dot(&v, &other));
            let sum: f64 = (0..n)
                .map(|i| {
                    let size = (u[i] * bend[i]).abs() + (v[i] * other[i]).abs();
                    ROUNDINGS * self.eps * size + (u[i].abs() + v[i].abs()) * exact(i)
                })
                .sum();
            let mut tolerance = sum;
            if (a - b).abs() > tolerance {
                let theirs = self.spread(&other, Some(&sizes), |x| {
                    subject.curvature(x, &row.weights, &u)
                });
                tolerance += (0..n)
                    .map(|i| SAFETY * (u[i].abs() * spread()[i] + v[i].abs() * theirs[i]))
                    .sum::<f64>();
            }
            if (a - b).abs() > tolerance {
                let numbers = Numbers {
                    adjoint: Some(a),
                    other: Some(b),
                    ..Numbers::default()
                };
                faults.push((Reason::CurvatureNotSymmetric, 0, numbers, tolerance));
            }
        }
        if let Some(adjoint) = &row.adjoint {
            let probe = |there: &[f64]| -> Option<(Vec<f64>, Option<Trace>)> {
                if !subject.inside(there) {
                    return None;
                }
                let slopes = subject.adjoint(there, &row.weights)?;
                let usable = slopes.len() == n && slopes.iter().all(|y| y.is_finite());
                usable.then(|| (slopes, subject.traced(there).map(|(_, trace)| trace)))
            };
            let probe: Probe<'_> = &probe;
            let climb = |first| {
                let (x, precision) = (self.x, subject.precision());
                Ladder::climb(probe, precision, x, adjoint, self.trace, &v, first)
            };
            let ladder = climb(FIRST[0]);
            for i in 0..n {
                let mut weights = vec![0.0; n];
                weights[i] = 1.0;
                let noise = self.eps * row.size[i]
                    + row.tolerance[i] / ROUNDINGS
                    + (0..n)
                        .map(|k| self.x[k].abs() * self.eps * largest / scales[k])
                        .sum::<f64>()
                        / scales[i];
                let size = largest / scales[i];
                let wrong = |ladder: &Ladder, exact: f64| {
                    let e = ladder.central(&weights, noise, true)?;
                    let tolerance = SAFETY * e.error + exact;
                    let wrong = SAFETY * e.error <= INFORMATIVE * size.max(e.value.abs())
                        && (e.value - bend[i]).abs() > tolerance;
                    wrong.then_some((e, tolerance))
                };
                if wrong(&ladder, exact(i)).is_none() {
                    continue;
                }
                let exact = exact(i) + SAFETY * spread()[i];
                if let Some((e, tolerance)) = wrong(&ladder, exact)
                    && confirmed(FIRST[1..].iter().map(|&first| {
                        let again = climb(first);
                        let heard = again.central(&weights, noise, true)?;
                        let says =
                            SAFETY * heard.error <= INFORMATIVE * size.max(heard.value.abs());
                        says.then(|| {
                            wrong(&again, exact).is_some_and(|(again, _)| {
                                (again.value - e.value).abs() <= SAFETY * (again.error + e.error)
                            })
                        })
                    }))
                {
                    let numbers = Numbers {
                        adjoint: Some(bend[i]),
                        difference: Some(e.value),
                        ..Numbers::default()
                    };
                    let reason = Reason::CurvatureDisagrees(Witness::Difference);
                    faults.push((reason, i, numbers, tolerance));
                }
            }
        }
        for (reason, input, numbers, tolerance) in faults {
            self.refuse_with(reason, None, output, input, numbers, tolerance);
        }
    }

    /// Declared motions, of values and of slopes.
    pub(crate) fn promises(&mut self, rows: &mut [Row]) {
        let subject = self.subject;
        let kinds = subject.kinds();
        if self.found.jump || kinds.len() != self.x.len() || self.x.is_empty() {
            return;
        }
        let points: Vec<Kind> = [Kind::X, Kind::Y].repeat(self.y.len().div_ceil(2));
        let typical = self.scales.iter().fold(f64::INFINITY, |m, s| m.min(*s));
        for &promise in subject.promises() {
            let motion = promise.motion;
            // The whole input, moved.
            let amount = match motion {
                Motion::TranslationX | Motion::TranslationY => 0.75 * typical,
                Motion::Rotation => 0.6,
                Motion::Scaling => 3.0,
                Motion::Exchange => 0.0,
            };
            let there = moved_by(motion, amount, &kinds, self.x);
            let precision = subject.precision();
            let there: Vec<f64> = there.iter().map(|x| precision.round(*x)).collect();
            if subject.inside(&there) {
                let y = subject.value(&there);
                let wanted = match promise.answer {
                    Answer::Stays => self.y.clone(),
                    Answer::Power(p) => self.y.iter().map(|y| y * amount.powi(p)).collect(),
                    Answer::Follows => moved_by(motion, amount, &points, &self.y),
                };
                let spread = self.spread(&self.y, None, |x| Some(subject.value(x)));
                for j in 0..y.len() {
                    // Moving rounds every number; what that may do, a slope says.
                    let rounding: f64 =
                        rows.iter()
                            .filter_map(|row| row.adjoint.as_ref().or(row.dual.as_ref()))
                            .flat_map(|slopes| {
                                slopes.iter().zip(self.x).zip(&there).map(|((s, x), t)| {
                                    s.abs() * (x.abs() + t.abs() / amount.max(1.0))
                                })
                            })
                            .sum();
                    let size = y[j].abs().max(wanted[j].abs());
                    let growth = (size / self.y[j].abs().max(f64::MIN_POSITIVE)).clamp(1.0, 9.0);
                    let mut tolerance = ROUNDINGS * self.eps * size
                        + growth * SAFETY * (2.0 * spread[j] + self.eps * rounding);
                    if (y[j] - wanted[j]).abs() > tolerance {
                        // The moved input has a conditioning of its own.
                        tolerance += SAFETY * self.unrest(&there, &y)[j];
                    }
                    if (y[j] - wanted[j]).abs() > tolerance {
                        let numbers = Numbers {
                            adjoint: Some(y[j]),
                            other: Some(wanted[j]),
                            ..Numbers::default()
                        };
                        let reason = Reason::MotionBroken(motion);
                        self.refuse_with(reason, None, j, 0, numbers, tolerance);
                    }
                }
            }
            for row in rows.iter_mut() {
                let Some(slopes) = row.adjoint.clone() else {
                    continue;
                };
                if motion == Motion::Exchange {
                    let Some(other) = subject.adjoint(&exchanged(self.x), &row.weights) else {
                        continue;
                    };
                    let other = exchanged(&other);
                    for i in 0..other.len() {
                        if (other[i] - slopes[i]).abs() > row.tolerance[i] {
                            self.provoke(row);
                            self.provoke_exchanged(row);
                        }
                        self.unbalanced(motion, row, i, slopes[i], other[i], row.tolerance[i]);
                    }
                    continue;
                }
                let speed = velocity(motion, &kinds, self.x);
                let wanted = dot(&row.weights, &answer(promise, &self.y));
                let balance = dot(&slopes, &speed);
                let tolerance = |row: &Row| -> f64 {
                    (0..self.x.len())
                        .map(|i| {
                            let own = ROUNDINGS * self.eps * slopes[i].abs() + row.tolerance[i];
                            own * speed[i].abs()
                        })
                        .sum::<f64>()
                        + ROUNDINGS * self.eps * wanted.abs()
                };
                if (balance - wanted).abs() > tolerance(row) {
                    self.provoke(row);
                }
                let tolerance = tolerance(row);
                self.unbalanced(motion, row, 0, balance, wanted, tolerance);
            }
        }
    }

    /// By how much the value at another input changes under provoked rounding.
    fn unrest(&self, x: &[f64], y: &[f64]) -> Vec<f64> {
        let (subject, precision) = (self.subject, self.subject.precision());
        let rounding = subject.rounding(x);
        let mut unrest = vec![0.0_f64; y.len()];
        for round in 0..12 {
            let there = beside(precision, x, &rounding, round);
            if subject.inside(&there) {
                for (unrest, (a, b)) in unrest.iter_mut().zip(subject.value(&there).iter().zip(y)) {
                    *unrest = unrest.max((a - b).abs());
                }
            }
        }
        unrest
    }

    /// Refuses slopes that do not follow a motion.
    fn unbalanced(&mut self, motion: Motion, row: &Row, i: usize, a: f64, b: f64, tolerance: f64) {
        if (a - b).abs() > tolerance || (a - b).is_nan() {
            let numbers = Numbers {
                adjoint: Some(a),
                other: Some(b),
                ..Numbers::default()
            };
            let reason = Reason::MotionUnbalanced(motion);
            self.refuse_with(
                reason,
                Some(Witness::Adjoint),
                row.output,
                i,
                numbers,
                tolerance,
            );
        }
    }
}

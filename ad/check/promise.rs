//! The part of a judgement that moves the whole input.
use crate::ad::check::judge::{Judge, ROUNDINGS, Row, SAFETY};
use crate::ad::check::symmetry::{
    Answer, Motion, answer, exchanged, following, moved_by, velocity,
};
use crate::ad::check::verdict::{Numbers, Reason, Witness};
use crate::ad::check::witness::{beside, dot};

/// How often rounding is provoked where a motion seems broken.
const DRAWS: u64 = 48;

impl Judge<'_> {
    /// Declared motions, of values and of slopes.
    pub(crate) fn promises(&mut self, rows: &mut [Row]) {
        let subject = self.subject;
        let kinds = subject.kinds();
        if self.found.jump || kinds.len() != self.x.len() || self.x.is_empty() {
            return;
        }
        let points = following(self.y.len());
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
                        // The moved input has a conditioning of its own, and few draws may miss that of
                        // this one.
                        tolerance += SAFETY * self.unrest(&there, &y)[j];
                        tolerance += growth * SAFETY * self.unrest(self.x, &self.y)[j];
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
        for round in 0..DRAWS {
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

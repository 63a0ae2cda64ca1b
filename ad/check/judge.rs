//! All checks at one input.
//!
//! Tolerances come from the witnesses themselves. Two derivatives that are both exact up to
//! rounding may differ by a few units in the last place of the largest slope in the same unit, and
//! by as much as either of them changes when the input is moved by its last digit (whatever a
//! function does to rounding errors, it does to that too) or its own roundings fall differently. A finite difference may be off by its
//! own error estimate. A refusal by differences must be repeated by other ladders of steps that
//! agree among themselves.
use crate::ad::check::sample::Draw;
use crate::ad::check::slopes::FEW_INPUTS;
use crate::ad::check::subject::Subject;
use crate::ad::check::trace::Trace;
use crate::ad::check::verdict::{Fault, Findings, Numbers, PAIRS, Place, Reason, Witness, Worst};
use crate::ad::check::witness::{beside, combined, dot};

/// How many roundings the last step of a derivative may have more than the other way to get it.
pub(crate) const ROUNDINGS: f64 = 16.0;
/// By how much estimated errors are multiplied before they count as exceeded.
pub(crate) const SAFETY: f64 = 8.0;
/// Outputs up to this number are checked one by one, more of them in random combinations.
const FEW_OUTPUTS: usize = 8;
/// How often rounding is provoked.
const ROUNDS: u64 = 12;

/// The slopes of one combination of the outputs.
pub(crate) struct Row {
    pub(crate) weights: Vec<f64>,
    pub(crate) output: usize,
    pub(crate) adjoint: Option<Vec<f64>>,
    pub(crate) dual: Option<Vec<f64>>,
    /// How much both may be off together, per input; grows when rounding was provoked.
    pub(crate) tolerance: Vec<f64>,
    /// What it is before that.
    pub(crate) plain: Vec<f64>,
    /// The largest slope in each input's unit.
    pub(crate) size: Vec<f64>,
    /// The largest slope per scale.
    pub(crate) largest: f64,
    pub(crate) provoked: bool,
    pub(crate) wide: bool,
    /// Rounding noise of the combined value.
    pub(crate) noise: f64,
}

/// What is known about an input beside the one that is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Beside {
    /// The same branches.
    Same,
    /// Equal numbers stayed equal, so a change of branch comes from rounding.
    Tied,
    /// Numbers moved on their own: an exact tie may have been broken.
    Loose,
}

/// The state of a judgement.
pub(crate) struct Judge<'a> {
    pub(crate) subject: &'a dyn Subject,
    pub(crate) x: &'a [f64],
    pub(crate) y: Vec<f64>,
    pub(crate) trace: Option<Trace>,
    pub(crate) scales: Vec<f64>,
    pub(crate) units: Vec<f64>,
    pub(crate) eps: f64,
    /// Inputs beside `x`, with the branches of `x` as far as possible.
    pub(crate) around: Vec<(Vec<f64>, Beside)>,
    pub(crate) found: Findings,
    /// Disagreements with duals that differences may explain: a tie, of which each takes an element
    /// of its own.
    pub(crate) pending: Vec<Fault>,
    /// Outputs and directions at which steps could tell, and what kind of place it is along them.
    pub(crate) compared: Vec<(usize, usize, Place)>,
}

/// Checks everything at one input. `seed` chooses random directions.
#[must_use]
pub fn judge(subject: &dyn Subject, x: &[f64], seed: u64) -> Findings {
    let mut judge = Judge {
        subject,
        x,
        y: subject.value(x),
        trace: None,
        scales: subject.scales(x),
        units: subject.units(x),
        eps: subject.precision().epsilon(),
        around: Vec::new(),
        found: Findings {
            place: Place::Smooth,
            directions: [0; 3],
            switched: 0,
            jump: false,
            convention: false,
            margin: f64::INFINITY,
            covered: vec![false; x.len()],
            worst: [Worst::default(); PAIRS.len()],
            faults: Vec::new(),
        },
        pending: Vec::new(),
        compared: Vec::new(),
    };
    judge.all(&mut Draw::new(seed));
    judge.found
}

/// Whether all numbers are finite.
pub(crate) fn finite(list: &[f64]) -> bool {
    list.iter().all(|x| x.is_finite())
}

/// Whether two lists have the same bits.
pub(crate) fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

impl Judge<'_> {
    pub(crate) fn refuse(&mut self, reason: Reason, output: usize, input: usize) {
        self.refuse_with(reason, None, output, input, Numbers::default(), 0.0);
    }

    pub(crate) fn refuse_with(
        &mut self,
        reason: Reason,
        suspect: Option<Witness>,
        output: usize,
        input: usize,
        numbers: Numbers,
        tolerance: f64,
    ) {
        // One of a kind and place is enough.
        let known = |fault: &Fault| fault.reason == reason && fault.output == output;
        let fault = Fault {
            reason,
            suspect,
            output,
            input,
            numbers,
            tolerance,
        };
        let by_duals = [Witness::Dual, Witness::Wide]
            .iter()
            .any(|&witness| reason == Reason::Disagree(Witness::Adjoint, witness));
        if by_duals && !numbers.along && !self.subject.conventions().shared_ties {
            self.pending.push(fault);
        } else if !self.found.faults.iter().any(known) {
            self.found.faults.push(fault);
        }
    }

    fn all(&mut self, draw: &mut Draw) {
        if !self.subject.inside(self.x) {
            self.found.place = Place::Undefined;
            return;
        }
        if !finite(&self.y) {
            self.found.place = Place::Undefined;
            self.refuse(Reason::NotFinite(Witness::Value), 0, 0);
            return;
        }
        if !same_bits(&self.y, &self.subject.value(self.x)) {
            self.refuse(Reason::Impure(Witness::Value), 0, 0);
        }
        if self.underflows() {
            self.found.place = Place::Undefined;
            return;
        }
        if let Some((values, trace)) = self.subject.traced(self.x) {
            self.trace = Some(trace);
            self.found.margin = trace.margin;
            if !same_bits(&values, &self.y) {
                self.compare_values(&values, Witness::Dual);
            }
        }
        if let Some(values) = self.subject.dual_values(self.x) {
            self.compare_values(&values, Witness::Dual);
        }
        let rounding = self.subject.rounding(self.x);
        for round in 0..ROUNDS {
            let there = beside(self.subject.precision(), self.x, &rounding, round);
            if self.subject.inside(&there) {
                let traced = || self.subject.traced(&there);
                let same = self
                    .trace
                    .is_some_and(|here| traced().is_some_and(|(_, trace)| trace.hash == here.hash));
                let same = match (same, round % 3) {
                    (true, _) => Beside::Same,
                    (false, 1) => Beside::Loose,
                    (false, _) => Beside::Tied,
                };
                self.around.push((there, same));
            }
        }
        for (i, values) in self.subject.other_values(self.x).into_iter().enumerate() {
            self.compare_values(&values, Witness::Further(i));
        }
        let Some(mut rows) = self.rows(draw) else {
            return;
        };
        for row in &mut rows {
            self.compare_exact(row);
        }
        self.compare_wide(&rows);
        self.projections(&mut rows, draw);
        self.linear(&mut rows, draw);
        let plain = self.differences(&mut rows, draw);
        self.resolve_ties();
        self.vote();
        let values_only = rows
            .iter()
            .all(|row| row.adjoint.is_none() && row.dual.is_none())
            && (!self.subject.other_values(self.x).is_empty()
                || !self.subject.promises().is_empty());
        if values_only {
            self.found.covered.fill(true);
        }
        self.promises(&mut rows);
        if plain {
            for row in &rows {
                self.curvature(row, draw);
            }
        }
        // After everything else: a function that remembers would answer differently now.
        if !same_bits(&self.y, &self.subject.value(self.x)) {
            self.refuse(Reason::Impure(Witness::Value), 0, 0);
        }
        for row in &rows {
            let again = self.subject.adjoint(self.x, &row.weights);
            if let (Some(first), Some(again)) = (&row.adjoint, again)
                && !same_bits(first, &again)
            {
                self.refuse(Reason::Impure(Witness::Adjoint), row.output, 0);
            }
        }
    }

    /// Whether a result in single precision is below the smallest number that has all digits, as the fourth
    /// power of a small length is: neither it nor what is pulled back through it has any to judge.
    fn underflows(&self) -> bool {
        let small = |y: &f64| *y != 0.0 && y.abs() < f64::from(f32::MIN_POSITIVE);
        let wide = self.subject.wide();
        wide.is_some_and(|wide| wide.value(self.x).iter().any(small))
    }

    /// The slopes by hand and by duals; `None` when they cannot be compared at all.
    fn rows(&mut self, draw: &mut Draw) -> Option<Vec<Row>> {
        let (n, m) = (self.x.len(), self.y.len());
        let jacobian = if n <= FEW_INPUTS {
            self.subject.jacobian(self.x)
        } else {
            None
        };
        if let Some(jacobian) = &jacobian {
            if jacobian.len() != m || jacobian.iter().any(|row| row.len() != n) {
                self.refuse(Reason::WrongLength(Witness::Dual), 0, 0);
                return None;
            }
            if let Some(j) = jacobian.iter().position(|row| !finite(row)) {
                self.refuse(Reason::NotFinite(Witness::Dual), j, 0);
            }
        }
        let weights: Vec<Vec<f64>> = if m <= FEW_OUTPUTS {
            (0..m)
                .map(|j| (0..m).map(|k| f64::from(u8::from(j == k))).collect())
                .collect()
        } else {
            (0..4)
                .map(|_| {
                    (0..m)
                        .map(|_| (draw.within(-8.0, 8.0)).round() / 4.0)
                        .collect()
                })
                .collect()
        };
        let mut rows = Vec::new();
        for (output, weights) in weights.into_iter().enumerate() {
            let adjoint = self.subject.adjoint(self.x, &weights);
            if let Some(adjoint) = &adjoint {
                if adjoint.len() != n {
                    self.refuse(Reason::WrongLength(Witness::Adjoint), output, 0);
                    return None;
                }
                if let Some(i) = adjoint.iter().position(|x| !x.is_finite()) {
                    self.refuse(Reason::NotFinite(Witness::Adjoint), output, i);
                    return None;
                }
                let again = self.subject.adjoint(self.x, &weights);
                if again.is_none_or(|again| !same_bits(adjoint, &again)) {
                    self.refuse(Reason::Impure(Witness::Adjoint), output, 0);
                }
            }
            let dual = jacobian
                .as_ref()
                .map(|jacobian| combined(&weights, jacobian, n));
            if dual.as_ref().is_some_and(|dual| !finite(dual)) {
                return None;
            }
            let slope = |i: usize| {
                let a = adjoint.as_ref().map_or(0.0, |a| a[i].abs());
                dual.as_ref().map_or(a, |d| d[i].abs().max(a))
            };
            let largest = (0..n).fold(0.0_f64, |m, i| m.max(slope(i) * self.scales[i]));
            let value = dot(&weights, &self.y).abs();
            let per_unit = (0..n).fold(value, |m, i| m.max(slope(i) * self.units[i]));
            let size: Vec<f64> = (0..n).map(|i| per_unit / self.units[i]).collect();
            let largest = largest.max(value);
            let comparable = self.subject.comparable();
            let plain: Vec<f64> = (0..n)
                .map(|i| if comparable { size[i] } else { slope(i) })
                .map(|size| ROUNDINGS * self.eps * size + f64::MIN_POSITIVE)
                .collect();
            let tolerance = plain.clone();
            let noise = self.noise(&weights, adjoint.as_deref().or(dual.as_deref()));
            rows.push(Row {
                weights,
                output,
                adjoint,
                dual,
                tolerance,
                plain,
                size,
                largest,
                provoked: false,
                wide: false,
                noise,
            });
        }
        Some(rows)
    }

    /// The rounding noise of a combined value: what changes beside the point and is not slope.
    fn noise(&self, weights: &[f64], slopes: Option<&[f64]>) -> f64 {
        let here = dot(weights, &self.y);
        let size: f64 = weights
            .iter()
            .zip(&self.y)
            .map(|(w, y)| (w * y).abs())
            .sum();
        let mut noise = self.eps * size;
        for (there, _) in self.around.iter().take(4) {
            let change = dot(weights, &self.subject.value(there)) - here;
            let by_slope = slopes.map_or(0.0, |slopes| {
                (0..self.x.len())
                    .map(|i| slopes[i] * (there[i] - self.x[i]))
                    .sum()
            });
            let left = (change - by_slope).abs().min(change.abs());
            if left.is_finite() {
                noise = noise.max(left);
            }
        }
        noise
    }
}

//! All checks at one input.
//!
//! Tolerances come from the witnesses themselves. Two derivatives that are both exact up to
//! rounding may differ by a few units in the last place of the largest slope in the same unit, and
//! by as much as either of them changes when the input is moved by its last digit (whatever a
//! function does to rounding errors, it does to that too) or its own roundings fall differently. A finite difference may be off by its
//! own error estimate. A refusal by differences must be repeated by other ladders of steps that
//! agree among themselves.
use crate::ad::sample::Draw;
use crate::ad::slopes::FEW_INPUTS;
use crate::ad::subject::Subject;
use crate::ad::symmetry::exchanged;
use crate::ad::trace::Trace;
use crate::ad::verdict::{Fault, Findings, Numbers, PAIRS, Place, Reason, Witness, Worst};
use crate::ad::witness::{Precision, beside, dot};

/// How many roundings the last step of a derivative may have more than the other way to get it.
pub(crate) const ROUNDINGS: f64 = 16.0;
/// By how much estimated errors are multiplied before they count as exceeded.
pub(crate) const SAFETY: f64 = 8.0;
/// Outputs up to this number are checked one by one, more of them in random combinations.
const FEW_OUTPUTS: usize = 8;
/// How often rounding is provoked.
const ROUNDS: u64 = 12;
/// How often an adjoint's own roundings are drawn.
const RUNS: u64 = 6;

/// The slopes of one combination of the outputs.
pub(crate) struct Row {
    pub(crate) weights: Vec<f64>,
    pub(crate) output: usize,
    pub(crate) adjoint: Option<Vec<f64>>,
    pub(crate) dual: Option<Vec<f64>>,
    /// How much both may be off together, per input; grows when rounding was provoked.
    pub(crate) tolerance: Vec<f64>,
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
            worst: [Worst::default(); PAIRS.len()],
            faults: Vec::new(),
        },
    };
    judge.all(&mut Draw::new(seed));
    judge.found
}

/// Whether all numbers are finite.
fn finite(list: &[f64]) -> bool {
    list.iter().all(|x| x.is_finite())
}

/// Whether two lists have the same bits.
fn same_bits(a: &[f64], b: &[f64]) -> bool {
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
        if !self.found.faults.iter().any(known) {
            self.found.faults.push(Fault {
                reason,
                suspect,
                output,
                input,
                numbers,
                tolerance,
            });
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
        if let Some((values, trace)) = self.subject.traced(self.x) {
            self.trace = Some(trace);
            self.found.margin = trace.margin;
            if !same_bits(&values, &self.y) {
                self.compare_values(&values, Witness::Dual);
            }
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

    /// The largest change of a list-valued function under provoked rounding, per number. With
    /// `sizes`, a change of branch that may have broken an exact tie counts only when it changes
    /// less than a thousandth of them: more is a kink, and a tie must be decided as it stands.
    pub(crate) fn spread(
        &self,
        base: &[f64],
        sizes: Option<&[f64]>,
        f: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        let mut spread = vec![0.0_f64; base.len()];
        for (there, same) in &self.around {
            let Some(list) = f(there) else { continue };
            if list.len() != base.len() {
                continue;
            }
            let change = |i: usize| (list[i] - base[i]).abs();
            let small = |sizes: &[f64]| (0..base.len()).all(|i| change(i) <= 1e-3 * sizes[i]);
            // Single precision is nearly tied everywhere, so there every change counts.
            let strict = *same == Beside::Loose && self.subject.precision() == Precision::F64;
            if strict && sizes.is_some_and(|sizes| !small(sizes)) {
                continue;
            }
            for (i, spread) in spread.iter_mut().enumerate() {
                if change(i).is_finite() {
                    *spread = spread.max(change(i));
                }
            }
        }
        spread
    }

    /// The largest change of a derivative when its own roundings fall differently. What changes more
    /// than a thousandth of the sizes was decided differently, which is no rounding.
    pub(crate) fn roundings(
        &self,
        base: &[f64],
        sizes: &[f64],
        noisy: impl Fn(u64) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        let mut spread = vec![0.0_f64; base.len()];
        for list in (0..RUNS).map_while(noisy) {
            let change = |i: usize| (list[i] - base[i]).abs();
            if (0..list.len()).all(|i| change(i) <= 1e-3 * sizes[i]) {
                for (i, spread) in spread.iter_mut().enumerate() {
                    *spread = spread.max(change(i));
                }
            }
        }
        spread
    }

    /// Another path's value against the value.
    fn compare_values(&mut self, other: &[f64], witness: Witness) {
        if other.len() != self.y.len() {
            self.refuse(Reason::WrongLength(witness), 0, 0);
            return;
        }
        if !finite(other) {
            self.refuse(Reason::NotFinite(witness), 0, 0);
            return;
        }
        if same_bits(other, &self.y) {
            return;
        }
        let spread = self.spread(&self.y, None, |x| Some(self.subject.value(x)));
        for j in 0..other.len() {
            let (a, b) = (self.y[j], other[j]);
            let tolerance = ROUNDINGS * self.eps * a.abs().max(b.abs()) + SAFETY * spread[j];
            if (a - b).abs() > tolerance {
                let numbers = Numbers {
                    adjoint: Some(a),
                    other: Some(b),
                    ..Numbers::default()
                };
                self.refuse_with(
                    Reason::ValuesDisagree(witness),
                    None,
                    j,
                    0,
                    numbers,
                    tolerance,
                );
            }
        }
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
            let dual = jacobian.as_ref().map(|jacobian| {
                (0..n)
                    .map(|i| {
                        let column: Vec<f64> = jacobian.iter().map(|row| row[i]).collect();
                        dot(&weights, &column)
                    })
                    .collect::<Vec<f64>>()
            });
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
            let tolerance = size
                .iter()
                .map(|size| ROUNDINGS * self.eps * size)
                .collect();
            let noise = self.noise(&weights, adjoint.as_deref().or(dual.as_deref()));
            rows.push(Row {
                weights,
                output,
                adjoint,
                dual,
                tolerance,
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

    /// Adds to a row's tolerance what provoked rounding shows.
    pub(crate) fn provoke(&self, row: &mut Row) {
        if std::mem::replace(&mut row.provoked, true) {
            return;
        }
        if let Some(adjoint) = &row.adjoint {
            let spread = self.spread(adjoint, Some(&row.size), |x| {
                self.subject.adjoint(x, &row.weights)
            });
            let noise = self.roundings(adjoint, &row.size, |seed| {
                self.subject.noisy(self.x, &row.weights, seed)
            });
            for (tolerance, (spread, noise)) in
                row.tolerance.iter_mut().zip(spread.iter().zip(noise))
            {
                *tolerance += SAFETY * spread.max(noise);
            }
        }
        if let Some(dual) = &row.dual {
            let spread = self.spread(dual, Some(&row.size), |x| {
                let jacobian = self.subject.jacobian(x)?;
                Some(
                    (0..x.len())
                        .map(|i| {
                            let column: Vec<f64> = jacobian.iter().map(|row| row[i]).collect();
                            dot(&row.weights, &column)
                        })
                        .collect(),
                )
            });
            for (tolerance, spread) in row.tolerance.iter_mut().zip(spread) {
                *tolerance += SAFETY * spread;
            }
        }
    }

    /// Where single precision is judged by double, decisions may fall differently: what that does
    /// counts too.
    pub(crate) fn provoke_widely(&self, row: &mut Row) {
        let (Some(wide), Some(adjoint)) = (self.subject.wide(), &row.adjoint) else {
            return;
        };
        if self.subject.precision() == Precision::F64 || std::mem::replace(&mut row.wide, true) {
            return;
        }
        let own = self.spread(adjoint, None, |x| self.subject.adjoint(x, &row.weights));
        let exact = wide.adjoint(self.x, &row.weights).unwrap_or_default();
        let theirs = self.spread(&exact, None, |x| wide.adjoint(x, &row.weights));
        for (i, own) in own.iter().enumerate() {
            row.tolerance[i] += SAFETY * (own + theirs.get(i).unwrap_or(&0.0));
        }
    }

    /// Adds what provoked rounding shows with the arguments exchanged.
    pub(crate) fn provoke_exchanged(&self, row: &mut Row) {
        let of = |x: &[f64]| {
            let slopes = self.subject.adjoint(&exchanged(x), &row.weights)?;
            Some(exchanged(&slopes))
        };
        let Some(base) = of(self.x) else { return };
        if let Some(adjoint) = &row.adjoint {
            let own = self.spread(adjoint, None, |x| self.subject.adjoint(x, &row.weights));
            for (tolerance, spread) in row.tolerance.iter_mut().zip(own) {
                *tolerance += SAFETY * spread;
            }
        }
        // The exchanged arguments are rounded differently, so near a tie they may be decided
        // differently.
        let spread = self.spread(&base, None, of);
        for (tolerance, spread) in row.tolerance.iter_mut().zip(spread) {
            *tolerance += SAFETY * spread;
        }
    }

    /// Whether a convention may decide about this slope: the value is zero and the input cannot be
    /// moved both ways.
    pub(crate) fn conventional_border(&self, row: &Row, i: usize) -> bool {
        let stuck = |sign: f64| {
            let mut there = self.x.to_vec();
            there[i] += sign * 1e-3 * self.scales[i];
            !self.subject.inside(&there)
        };
        self.subject.conventions().flat
            && dot(&row.weights, &self.y) == 0.0
            && (stuck(1.0) || stuck(-1.0))
    }

    /// The adjoint against duals and further witnesses: no steps, so hardly any tolerance.
    fn compare_exact(&mut self, row: &mut Row) {
        let Some(adjoint) = row.adjoint.clone() else {
            return;
        };
        let further = self.subject.further(self.x, &row.weights);
        let batch = self.subject.batch(self.x, &row.weights);
        if let Some((value, _)) = &batch {
            self.compare_values(value, Witness::Batch);
        }
        let others = row
            .dual
            .iter()
            .cloned()
            .map(|dual| (Witness::Dual, dual))
            .chain((0..).map(Witness::Further).zip(further))
            .chain(batch.map(|(_, slopes)| (Witness::Batch, slopes)))
            .collect::<Vec<_>>();
        for (witness, other) in others {
            let mut theirs: Option<Vec<f64>> = None;
            if other.len() != adjoint.len() {
                self.refuse(Reason::WrongLength(witness), row.output, 0);
                continue;
            }
            for i in 0..adjoint.len() {
                let gap = (adjoint[i] - other[i]).abs();
                if gap > row.tolerance[i] || gap.is_nan() {
                    self.provoke(row);
                }
                let mut tolerance = row.tolerance[i];
                if gap > tolerance && witness != Witness::Dual {
                    // Duals were provoked with the row; others on their own.
                    let theirs = theirs.get_or_insert_with(|| {
                        self.spread(&other, Some(&row.size), |x| match witness {
                            Witness::Further(k) => {
                                let further = self.subject.further(x, &row.weights);
                                further.into_iter().nth(k)
                            }
                            _ => Some(self.subject.batch(x, &row.weights)?.1),
                        })
                    });
                    tolerance += SAFETY * theirs[i];
                }
                let pair = match witness {
                    Witness::Dual => 0,
                    Witness::Batch => 5,
                    _ => 4,
                };
                self.found.worst[pair].note(gap, row.size[i], tolerance, self.eps, i);
                if gap > tolerance && self.conventional_border(row, i) {
                    // Differences will ask both whether they lie between zero and the only side.
                    self.found.convention = true;
                } else if gap > tolerance || gap.is_nan() {
                    let numbers = Numbers {
                        adjoint: Some(adjoint[i]),
                        dual: row.dual.as_ref().map(|dual| dual[i]),
                        other: (witness != Witness::Dual).then_some(other[i]),
                        ..Numbers::default()
                    };
                    let reason = Reason::Disagree(Witness::Adjoint, witness);
                    self.refuse_with(reason, None, row.output, i, numbers, tolerance);
                }
            }
        }
    }

    /// A function of `f32` against itself in `f64`, as far as single precision can tell.
    fn compare_wide(&mut self, rows: &[Row]) {
        let Some(wide) = self.subject.wide() else {
            return;
        };
        let value = wide.value(self.x);
        if !finite(&value) {
            return;
        }
        // Decisions may fall differently in the other format, so other branches count as spread.
        let spread = self.spread(&value, None, |x| Some(wide.value(x)));
        let own = self.spread(&self.y, None, |x| Some(self.subject.value(x)));
        for j in 0..value.len().min(self.y.len()) {
            let tolerance = ROUNDINGS * self.eps * value[j].abs().max(self.y[j].abs())
                + SAFETY * (spread[j] + own[j]);
            if (value[j] - self.y[j]).abs() > tolerance {
                let numbers = Numbers {
                    adjoint: Some(self.y[j]),
                    other: Some(value[j]),
                    ..Numbers::default()
                };
                let reason = Reason::ValuesDisagree(Witness::Wide);
                self.refuse_with(reason, None, j, 0, numbers, tolerance);
            }
        }
        // Longer inputs are projected.
        let rows = if self.x.len() <= FEW_INPUTS {
            rows
        } else {
            &[]
        };
        for row in rows {
            let combined = |x: &[f64]| {
                let jacobian = wide.jacobian(x)?;
                Some(
                    (0..x.len())
                        .map(|i| {
                            let column: Vec<f64> = jacobian.iter().map(|row| row[i]).collect();
                            dot(&row.weights, &column)
                        })
                        .collect::<Vec<f64>>(),
                )
            };
            let (Some(exact), Some(adjoint)) = (combined(self.x), &row.adjoint) else {
                continue;
            };
            if !finite(&exact) {
                continue;
            }
            let mut tolerance: Vec<f64> = row
                .size
                .iter()
                .map(|size| ROUNDINGS * self.eps * size)
                .collect();
            let outside = |tolerance: &[f64]| {
                (0..exact.len()).any(|i| (exact[i] - adjoint[i]).abs() > tolerance[i])
            };
            if outside(&tolerance) {
                let theirs = self.spread(&exact, None, combined);
                let own = self.spread(adjoint, None, |x| self.subject.adjoint(x, &row.weights));
                for i in 0..tolerance.len() {
                    tolerance[i] += SAFETY * (theirs[i] + own[i]);
                }
            }
            for i in 0..exact.len() {
                let gap = (exact[i] - adjoint[i]).abs();
                self.found.worst[3].note(gap, row.size[i], tolerance[i], self.eps, i);
                if gap > tolerance[i] {
                    let numbers = Numbers {
                        adjoint: Some(adjoint[i]),
                        dual: row.dual.as_ref().map(|dual| dual[i]),
                        other: Some(exact[i]),
                        ..Numbers::default()
                    };
                    let reason = Reason::Disagree(Witness::Adjoint, Witness::Wide);
                    let suspect = Some(Witness::Adjoint);
                    self.refuse_with(reason, suspect, row.output, i, numbers, tolerance[i]);
                }
            }
        }
    }

    /// The adjoint is linear in what it is seeded with.
    fn linear(&mut self, rows: &mut [Row], draw: &mut Draw) {
        if rows.is_empty() || rows.iter().any(|row| row.adjoint.is_none()) {
            return;
        }
        let m = self.y.len();
        let mut factor = || f64::from([-3_i8, -1, 1, 3][draw.below(4)]) * 0.75;
        let mut factors: Vec<f64> = rows.iter().map(|_| factor()).collect();
        // A sign that never changes would hide an absolute value.
        factors[0] = -factors[0].abs();
        let weights: Vec<f64> = (0..m)
            .map(|j| {
                rows.iter()
                    .zip(&factors)
                    .map(|(row, f)| f * row.weights[j])
                    .sum()
            })
            .collect();
        let Some(combined) = self.subject.adjoint(self.x, &weights) else {
            return;
        };
        if combined.len() != self.x.len() {
            self.refuse(Reason::WrongLength(Witness::Adjoint), 0, 0);
            return;
        }
        let total = |rows: &[Row], i: usize| {
            let parts = rows.iter().zip(&factors).map(|(row, f)| {
                let slope = row.adjoint.as_ref().map_or(0.0, |adjoint| adjoint[i]);
                let own = ROUNDINGS * self.eps * slope.abs() + row.tolerance[i];
                (f * slope, f.abs() * own)
            });
            parts.fold((0.0, 0.0), |(s, t), (a, b)| (s + a, t + b))
        };
        let mut fault = None;
        for (i, &got) in combined.iter().enumerate() {
            let (sum, tolerance) = total(rows, i);
            if (got - sum).abs() > tolerance {
                rows.iter_mut().for_each(|row| self.provoke(row));
            }
            let (_, tolerance) = total(rows, i);
            if (got - sum).abs() > tolerance {
                let numbers = Numbers {
                    adjoint: Some(got),
                    other: Some(sum),
                    ..Numbers::default()
                };
                fault = Some((i, numbers, tolerance));
                break;
            }
        }
        if let Some((i, numbers, tolerance)) = fault {
            let suspect = Some(Witness::Adjoint);
            self.refuse_with(Reason::NotLinear, suspect, 0, i, numbers, tolerance);
        }
        if let Some(nothing) = self.subject.adjoint(self.x, &vec![0.0; m])
            && let Some(i) = nothing.iter().position(|&x| x != 0.0)
        {
            self.refuse(Reason::NotLinear, 0, i);
        }
    }
}

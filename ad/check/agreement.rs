//! The part of a judgement that needs no steps: values against values, the adjoint against duals,
//! further witnesses and double precision, and its linearity.
use crate::ad::check::judge::{Judge, ROUNDINGS, Row, SAFETY, finite, same_bits};
use crate::ad::check::sample::Draw;
use crate::ad::check::slopes::FEW_INPUTS;
use crate::ad::check::verdict::{Nearest, Numbers, Reason, Witness};
use crate::ad::check::witness::{combined, dot};

impl Judge<'_> {
    /// Another path's value against the value.
    pub(crate) fn compare_values(&mut self, other: &[f64], witness: Witness) {
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
    pub(crate) fn compare_exact(&mut self, row: &mut Row) {
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
                self.found.covered[i] = true;
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
                let numbers = Numbers {
                    adjoint: Some(adjoint[i]),
                    dual: row.dual.as_ref().map(|dual| dual[i]),
                    other: (witness != Witness::Dual).then_some(other[i]),
                    ..Numbers::default()
                };
                let at = Nearest {
                    output: row.output,
                    input: i,
                    numbers,
                    tolerance,
                    provoked: row.provoked,
                    ..Nearest::default()
                };
                self.found.worst[pair].note(gap, row.size[i], self.eps, at);
                if gap > tolerance && self.conventional_border(row, i) {
                    // Differences will ask both whether they lie between zero and the only side.
                    self.found.convention = true;
                } else if gap > tolerance || gap.is_nan() {
                    let reason = Reason::Disagree(Witness::Adjoint, witness);
                    self.refuse_with(reason, None, row.output, i, numbers, tolerance);
                }
            }
        }
    }

    /// A function of `f32` against itself in `f64`, as far as single precision can tell.
    pub(crate) fn compare_wide(&mut self, rows: &[Row]) {
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
            // The largest number of a format says no more than that the value is larger.
            let most = f64::from(f32::MAX);
            let off_scale = self.y[j].abs() == most && value[j].abs() >= most;
            if off_scale && (self.y[j] > 0.0) == (value[j] > 0.0) {
                continue;
            }
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
            let by_duals = |x: &[f64]| {
                let jacobian = wide.jacobian(x)?;
                Some(combined(&row.weights, &jacobian, x.len()))
            };
            let (Some(exact), Some(adjoint)) = (by_duals(self.x), &row.adjoint) else {
                continue;
            };
            if !finite(&exact) {
                continue;
            }
            let mut tolerance = row.plain.clone();
            let outside = |tolerance: &[f64]| {
                (0..exact.len()).any(|i| (exact[i] - adjoint[i]).abs() > tolerance[i])
            };
            let provoked = outside(&tolerance);
            if provoked {
                let by_hand = |x: &[f64]| self.subject.adjoint(x, &row.weights);
                let theirs = self.spread(&exact, None, by_duals);
                let own = self.spread(adjoint, None, by_hand);
                let rough = self.rough_slopes(&row.weights, adjoint, &by_hand);
                for i in 0..tolerance.len() {
                    tolerance[i] += SAFETY * (theirs[i] + own[i].max(rough[i]));
                }
            }
            for i in 0..exact.len() {
                self.found.covered[i] = true;
                let gap = (exact[i] - adjoint[i]).abs();
                let numbers = Numbers {
                    adjoint: Some(adjoint[i]),
                    dual: row.dual.as_ref().map(|dual| dual[i]),
                    other: Some(exact[i]),
                    ..Numbers::default()
                };
                let at = Nearest {
                    output: row.output,
                    input: i,
                    numbers,
                    tolerance: tolerance[i],
                    provoked,
                    ..Nearest::default()
                };
                self.found.worst[3].note(gap, row.size[i], self.eps, at);
                if gap > tolerance[i] {
                    let reason = Reason::Disagree(Witness::Adjoint, Witness::Wide);
                    let suspect = Some(Witness::Adjoint);
                    self.refuse_with(reason, suspect, row.output, i, numbers, tolerance[i]);
                }
            }
        }
    }

    /// The adjoint is linear in what it is seeded with.
    pub(crate) fn linear(&mut self, rows: &mut [Row], draw: &mut Draw) {
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

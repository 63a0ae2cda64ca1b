//! Finite differences with an error estimate, and the perturbation of inputs by their rounding.
//!
//! A [`StepSequence`] holds values at steps of geometrically falling size on both sides of a point. It gives the
//! central derivative and the derivatives of both sides, each extrapolated to step zero by Richardson's scheme. The
//! extrapolation with the smallest error estimate counts (Ridders' method); the estimate includes the rounding noise of
//! the values. `compare/derivative_test` and `compare/curvature` use it.
use crate::Scalar;
use crate::ad::check::tolerances::{
    JUMP_NOISE, JUMP_STAYS, LAST_DIGITS, MOVED_ROUNDINGS, NOISE_OF_STEPS, POWERS, RATIO, SAME_STEP,
    SETTLED, SMALL_STEPS, STEPS, TRUNCATION,
};
use crate::ad::check::trace::Trace;
use crate::ad::sample::Draw;

/// The number format a function is checked in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// 24 bits.
    F32,
    /// 53 bits.
    F64,
}

impl Precision {
    /// Returns the precision of a type.
    #[must_use]
    pub fn of<S: Scalar>() -> Self {
        if S::format().epsilon() > f64::EPSILON {
            Precision::F32
        } else {
            Precision::F64
        }
    }
    /// Returns the name of its type.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
        }
    }
    /// Returns the distance from 1 to the next larger number.
    #[must_use]
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::EPSILON),
            Precision::F64 => f64::EPSILON,
        }
    }
    /// Returns the nearest number of the format.
    #[must_use]
    pub fn round(self, x: f64) -> f64 {
        match self {
            Precision::F32 => f64::from(x as f32),
            Precision::F64 => x,
        }
    }
    /// Moves a number by `ulps` numbers of the format away from zero (towards it, when negative). Zero stays.
    #[must_use]
    pub fn away_from_zero(self, x: f64, ulps: i32) -> f64 {
        if x == 0.0 || !x.is_finite() {
            return x;
        }
        let moved = match self {
            Precision::F32 => {
                let bits = (x as f32).to_bits() as i32;
                f64::from(f32::from_bits(bits.saturating_add(ulps) as u32))
            }
            Precision::F64 => {
                let bits = x.to_bits() as i64;
                f64::from_bits(bits.saturating_add(i64::from(ulps)) as u64)
            }
        };
        if moved.is_finite() && (moved < 0.0) == (x < 0.0) {
            moved
        } else {
            x
        }
    }
}

/// A number with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its estimated error.
    pub error: f64,
    /// The smallest step that it combines: an error of the values counts divided by it.
    pub step: f64,
}

/// The value at one step from the point.
#[derive(Clone, Debug)]
pub struct StepValue {
    /// The size of the step, in multiples of the direction.
    pub size: f64,
    /// The value there.
    pub values: Vec<f64>,
    /// `true` if the branches are those of the point, or unknown.
    pub same: bool,
    /// The hash of the branches; zero if they are unknown.
    pub branch: u64,
}

/// A value and, if there is a traced source, its trace; `None` outside the domain.
pub type Probed = Option<(Vec<f64>, Option<Trace>)>;
/// A function that evaluates another one at several inputs.
pub type Probe<'a> = &'a dyn Fn(&[Vec<f64>]) -> Vec<Probed>;

/// Values at a sequence of step sizes along a direction, on both sides of a point.
#[derive(Clone, Debug)]
pub struct StepSequence {
    /// The steps ahead, largest first; fewer at the border of the domain.
    pub ahead: Vec<StepValue>,
    /// The steps behind, largest first.
    pub behind: Vec<StepValue>,
    /// The value at the point.
    pub center: Vec<f64>,
    /// `true` if branches are known.
    pub traced: bool,
}

impl StepSequence {
    /// Returns `true` if a side has fewer than two steps: the domain ends there.
    pub fn is_at_border(&self) -> bool {
        self.ahead.len() < 2 || self.behind.len() < 2
    }

    /// Evaluates at `x ± step · direction`, from `first` downwards.
    pub fn evaluate(
        probe: Probe<'_>,
        precision: Precision,
        x: &[f64],
        center: &[f64],
        trace: Option<Trace>,
        direction: &[f64],
        first: f64,
    ) -> StepSequence {
        // The rounded step is measured in the number with the largest entry of the direction.
        let main = (0..x.len())
            .max_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs()))
            .unwrap_or(0);
        // Steps that are lost in rounding carry no information.
        let place = |sign: f64, k: i32| {
            let wanted = first * RATIO.powi(-k);
            let there: Vec<f64> = x
                .iter()
                .zip(direction)
                .map(|(&x, &d)| precision.round(x + sign * wanted * d))
                .collect();
            let step = sign * (there[main] - x[main]) / direction[main];
            (step > 0.0).then_some((step, there))
        };
        let side = |sign: f64| (0..STEPS).filter_map(move |k| place(sign, k));
        let ((mut steps, mut places), behind): ((Vec<f64>, Vec<Vec<f64>>), (Vec<f64>, Vec<_>)) =
            (side(1.0).unzip(), side(-1.0).unzip());
        let count = steps.len();
        steps.extend(behind.0);
        places.extend(behind.1);
        let mut found = steps.into_iter().zip(probe(&places));
        let mut side = |count: usize| {
            let mut taken: Vec<StepValue> = Vec::with_capacity(STEPS as usize);
            for (step, probed) in found.by_ref().take(count) {
                // Steps no smaller than the previous one carry no information.
                let Some((values, there)) = probed.filter(|_| {
                    let last = taken.last();
                    last.is_none_or(|last| last.size >= SAME_STEP * step)
                }) else {
                    continue;
                };
                let same = match (trace, there) {
                    (Some(here), Some(there)) => here.hash == there.hash,
                    _ => true,
                };
                let branch = there.map_or(0, |trace| trace.hash);
                taken.push(StepValue {
                    size: step,
                    values,
                    same,
                    branch,
                });
            }
            taken
        };
        StepSequence {
            ahead: side(count),
            behind: side(usize::MAX),
            center: center.to_vec(),
            traced: trace.is_some(),
        }
    }

    /// Returns the central derivative of `weights · value`. With `within`, only from steps up to which the branches are
    /// those of the point.
    #[must_use]
    pub fn central(&self, weights: &[f64], noise: f64, within: bool) -> Option<Estimate> {
        let mut points = Vec::new();
        let mut behind = self.behind.iter().peekable();
        for ahead in &self.ahead {
            while behind
                .next_if(|b| b.size > SAME_STEP * ahead.size)
                .is_some()
            {}
            let Some(&b) = behind.peek() else { break };
            if b.size < ahead.size / SAME_STEP {
                continue;
            }
            if within && !(ahead.same && b.same) {
                // A larger step may return to the branches of the point after having left them.
                points.clear();
                continue;
            }
            let span = ahead.size + b.size;
            let rise = dot(weights, &ahead.values) - dot(weights, &b.values);
            points.push((span / 2.0, rise / span));
        }
        extrapolated(&points, 2, noise)
    }

    /// Returns the derivative of `weights · value` on one side.
    #[must_use]
    pub fn one_sided(&self, ahead: bool, weights: &[f64], noise: f64) -> Option<Estimate> {
        let (side, sign) = if ahead {
            (&self.ahead, 1.0)
        } else {
            (&self.behind, -1.0)
        };
        let here = dot(weights, &self.center);
        let points: Vec<(f64, f64)> = nearest_branch(side)
            .iter()
            .map(|step| {
                let rise = dot(weights, &step.values) - here;
                (step.size, sign * rise / step.size)
            })
            .collect();
        let mut estimate = extrapolated(&points, 1, 2.0 * noise)?;
        if self.traced
            && let [.., before, last] = &points[..]
        {
            // The branches differ from those of the point. Nearer than the smallest step the derivative may change as
            // much as at the last two steps.
            estimate.error += (last.1 - before.1).abs();
        }
        Some(estimate)
    }

    /// Returns the rounding noise that the smallest steps show: their distance from a linear continuation of the next
    /// larger ones, on the side with less noise. Rounding need not show at the point itself, where values may be
    /// quantised.
    #[must_use]
    pub fn noise(&self, weights: &[f64]) -> f64 {
        let here = dot(weights, &self.center);
        let side = |side: &[StepValue]| {
            let derivatives: Vec<(f64, f64)> = side
                .iter()
                .map(|step| (step.size, (dot(weights, &step.values) - here) / step.size))
                .collect();
            // Values that are constant and then leap have a noise of the smallest leap.
            let leaps = derivatives
                .iter()
                .map(|(step, derivative)| (step * derivative).abs());
            let least = leaps
                .filter(|leap| *leap > 0.0)
                .fold(f64::INFINITY, f64::min);
            let still =
                derivatives.iter().any(|(_, derivative)| *derivative == 0.0) && least.is_finite();
            let small = &derivatives[derivatives.len().saturating_sub(SMALL_STEPS)..];
            small
                .windows(3)
                .fold(if still { least } else { 0.0 }, |noise, w| {
                    let [(h0, a0), (h1, a1), (h2, a2)] = [w[0], w[1], w[2]];
                    let ahead = a1 + (a1 - a0) * (h2 - h1) / (h1 - h0);
                    noise.max((a2 - ahead).abs() * h2)
                })
        };
        side(&self.ahead).min(side(&self.behind))
    }

    /// Returns `true` if the smallest steps of each side are in one branch, enough of them to judge by.
    #[must_use]
    pub fn settled(&self) -> bool {
        [&self.ahead, &self.behind].iter().all(|side| {
            let branch = side.last().map_or(0, |step| step.branch);
            side.len() < SETTLED
                || side
                    .iter()
                    .rev()
                    .take(SETTLED)
                    .all(|step| step.branch == branch)
        })
    }

    /// Returns `true` if the value is constant along the whole sequence.
    #[must_use]
    pub fn still(&self) -> bool {
        let mut steps = self.ahead.iter().chain(&self.behind);
        steps.all(|step| step.values == self.center)
    }

    /// Returns the size of the jump of an output on either side, if it jumps: the change to the nearest steps does not
    /// shrink with the step.
    #[must_use]
    pub fn jump(&self, output: usize, noise: f64) -> Option<f64> {
        let here = self.center[output];
        [&self.ahead, &self.behind].into_iter().find_map(|side| {
            let near = side.last_chunk::<3>()?;
            let rises = near.each_ref().map(|step| step.values[output] - here);
            let (low, high) = rises
                .iter()
                .fold((f64::INFINITY, 0.0_f64), |(low, high), r| {
                    (low.min(r.abs()), high.max(r.abs()))
                });
            (low > JUMP_STAYS * high && low > JUMP_NOISE * noise).then_some(low)
        })
    }
}

/// Returns the steps nearest to the point that all took one branch; all steps if those are too few.
fn nearest_branch(side: &[StepValue]) -> &[StepValue] {
    let branch = side.last().map_or(0, |step| step.branch);
    let near = side
        .iter()
        .rev()
        .take_while(|step| step.branch == branch)
        .count();
    if near < SETTLED {
        side
    } else {
        &side[side.len() - near..]
    }
}

/// Returns the inner product, by halves when long: its error is a few units in the last place of its terms, however
/// many there are.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    if n > 64 {
        let (low, high) = (a.split_at(n / 2), b.split_at(n / 2));
        return dot(low.0, high.0) + dot(low.1, &high.1[..n - n / 2]);
    }
    a.iter()
        .zip(b)
        .map(|(a, b)| if *a == 0.0 { 0.0 } else { a * b })
        .sum()
}

/// Returns the unit vector along number `i`.
pub(crate) fn axis(length: usize, i: usize) -> Vec<f64> {
    (0..length).map(|k| f64::from(u8::from(k == i))).collect()
}

/// Returns the derivatives of one combination of the outputs, from a Jacobian with one row per output.
pub(crate) fn combined(weights: &[f64], jacobian: &[Vec<f64>], inputs: usize) -> Vec<f64> {
    let derivative = |i: usize| {
        let column: Vec<f64> = jacobian.iter().map(|row| row[i]).collect();
        dot(weights, &column)
    };
    (0..inputs).map(derivative).collect()
}

/// Extrapolates `(step, derivative)` to step zero, eliminating the powers `order, 2 order, …`.
///
/// The extrapolation with the smallest error counts. Its error is the change from the extrapolations it combines, the
/// noise, and the disagreement of smaller steps: large steps may miss a feature smaller than they are.
fn extrapolated(points: &[(f64, f64)], order: i32, noise: f64) -> Option<Estimate> {
    let mut best: Option<Estimate> = None;
    let mut last: Vec<f64> = Vec::new();
    for (k, &(step, derivative)) in points.iter().enumerate() {
        let mut row = vec![derivative];
        for j in 1..=k.min(POWERS) {
            let ratio = (points[k - j].0 / step).powi(order);
            row.push(row[j - 1] + (row[j - 1] - last[j - 1]) / (ratio - 1.0));
        }
        for j in 0..row.len().min(k + 1) {
            let change = match j {
                0 if k == 0 => continue,
                0 => (row[0] - last[0]).abs(),
                _ => (row[j] - row[j - 1])
                    .abs()
                    .max((row[j] - last[j - 1]).abs()),
            };
            let off = (derivative - row[j]).abs();
            let excess = points[k + 1..].iter().fold(0.0_f64, |excess, near| {
                let truncation = TRUNCATION * off * (near.0 / step).powi(order);
                let allowed = truncation + NOISE_OF_STEPS * noise / near.0 + change;
                excess.max((near.1 - row[j]).abs() - allowed)
            });
            let error = change + noise / step + excess;
            if error.is_finite() && best.is_none_or(|best| error < best.error) {
                best = Some(Estimate {
                    value: row[j],
                    error,
                    step,
                });
            }
        }
        last = row;
    }
    best
}

/// Returns the point with its rounding perturbed, in three modes by turns. Every number moves by one or two units in
/// its last place, equal numbers alike, so that ties stay ties. Or every number moves independently by up to twice its
/// `rounding`, or equal numbers alike by that much.
#[must_use]
pub fn perturbed(precision: Precision, x: &[f64], rounding: &[f64], round: u64) -> Vec<f64> {
    (0..x.len())
        .map(|i| {
            let key = if round % 3 == 1 {
                i as u64
            } else {
                x[i].abs().to_bits()
            };
            let mut draw = Draw::new(key ^ round.wrapping_mul(0x9e37_79b9));
            if round.is_multiple_of(3) {
                precision.away_from_zero(x[i], LAST_DIGITS[draw.below(4)])
            } else {
                precision.round(x[i] + MOVED_ROUNDINGS * rounding[i] * draw.within(-1.0, 1.0))
            }
        })
        .collect()
}

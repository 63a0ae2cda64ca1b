//! The rounding error of each witness at an input, measured by perturbing roundings. Comparisons call it when two
//! witnesses differ by more than plain rounding, and add the result to the tolerance.
//!
//! Four kinds of rounding are perturbed, each by a change that leaves the true result as it is, or nearly. Inputs move
//! by their last digits, which shows the effect of errors of the input and of the value's computation. The adjoint's
//! own operations round at random ([`noise`](crate::ad::check::noise)). The operations of a closure are not visible, so
//! its roughness between equally spaced inputs is measured ([`roughness`]). Functions linear in a direction (duals,
//! second derivatives) are computed along a shorter direction: the result is shorter by the same factor, but every sum
//! and product of derivatives rounds differently. Perturbing the input does not show these roundings: where two large
//! equal derivatives cancel, the rest is their last digit, which does not move with the input's.
use crate::ad::check::evidence::{Combination, Evidence, Neighbour};
use crate::ad::check::roughness::roughness;
use crate::ad::check::subject::Subject;
use crate::ad::check::symmetry::exchanged;
use crate::ad::check::tolerances::{
    DECIDED, DRAWS, ELSEWHERE, FEW_INPUTS, ROUGH, RUNS, SAFETY, TALL, TALL_SECOND, TIED,
};
use crate::ad::check::witness::{Precision, axis, combined, dot, perturbed};
use crate::ad::sample::Draw;

impl Evidence<'_> {
    /// Returns the largest change of a list-valued function under perturbed rounding, per number. With `sizes`, a
    /// change of branch that may have broken an exact tie counts only if it changes less than a thousandth of them:
    /// more is a kink, and a tie is judged at the input itself.
    pub(crate) fn deviation(
        &self,
        base: &[f64],
        sizes: Option<&[f64]>,
        f: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.deviation_if(base, sizes, |neighbour| neighbour != Neighbour::Loose, f)
    }

    /// Returns the largest change of an output under perturbed rounding as far as derivatives explain it. Near a tie
    /// every input takes another branch, and the value changes by at most the derivative there times the displacement.
    /// A jump is larger.
    pub(crate) fn explained(&self, output: usize) -> f64 {
        let mut weights = vec![0.0; self.y.len()];
        weights[output] = 1.0;
        let explained = |there: &Vec<f64>| {
            let change = (self.subject.value(there).get(output)? - self.y[output]).abs();
            let derivatives = self.subject.adjoint(there, &weights)?;
            let moves = there.iter().zip(self.x).map(|(to, from)| (to - from).abs());
            let reach = derivatives
                .iter()
                .zip(moves)
                .map(|(by, far)| by.abs() * far);
            let reach: f64 = reach.sum();
            (change.is_finite() && reach.is_finite()).then_some(change.min(reach))
        };
        let places = self.around.iter().map(|(there, _)| there);
        places.filter_map(explained).fold(0.0, f64::max)
    }

    /// Returns the largest change at many more inputs near this one, whatever branches they take. At one of them
    /// numbers below the rounding of their unit are zero, which no draw hits: the sine of edges that are parallel to
    /// 10⁻¹⁷.
    pub(crate) fn deviation_of_many(
        &self,
        base: &[f64],
        f: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        let rounding = self.subject.rounding(self.x);
        let mut deviation = vec![0.0_f64; base.len()];
        let vanished = self.x.iter().zip(&rounding);
        let vanished = vanished.map(|(x, rounding)| if x.abs() > *rounding { *x } else { 0.0 });
        for there in self.drawn_nearby(1.0).chain([vanished.collect()]) {
            if !self.subject.inside(&there) {
                continue;
            }
            for ((deviation, base), y) in deviation
                .iter_mut()
                .zip(base)
                .zip(f(&there).unwrap_or_default())
            {
                let change = (y - base).abs();
                if change.is_finite() {
                    *deviation = deviation.max(change);
                }
            }
        }
        deviation
    }

    /// Draws many inputs within `times` roundings of this one.
    fn drawn_nearby(&self, times: f64) -> impl Iterator<Item = Vec<f64>> {
        let precision = self.subject.precision();
        let mut rounding = self.subject.rounding(self.x);
        rounding.iter_mut().for_each(|rounding| *rounding *= times);
        (0..DRAWS).map(move |round| perturbed(precision, self.x, &rounding, round))
    }

    /// Returns `true` if a condition holds at an input within the rounding of this one, or within the width of a tie:
    /// decisions there may fall otherwise.
    pub(crate) fn holds_nearby(&self, holds: impl Fn(&[f64]) -> bool) -> bool {
        let near = self.around.iter().map(|(there, _)| there.clone());
        near.chain(self.drawn_nearby(1.0))
            .chain(self.drawn_nearby(TIED))
            .any(|there| self.subject.inside(&there) && holds(&there))
    }

    /// Returns the largest change under perturbed rounding; `decides` selects the neighbours at which a change too
    /// large for rounding counts, too.
    fn deviation_if(
        &self,
        base: &[f64],
        sizes: Option<&[f64]>,
        decides: impl Fn(Neighbour) -> bool,
        f: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        let mut deviation = vec![0.0_f64; base.len()];
        for (there, same) in &self.around {
            let Some(list) = f(there) else { continue };
            if list.len() != base.len() {
                continue;
            }
            let change = |i: usize| (list[i] - base[i]).abs();
            let small = |sizes: &[f64]| (0..base.len()).all(|i| change(i) <= DECIDED * sizes[i]);
            // Single precision is nearly tied everywhere, so there every change counts.
            let strict = !decides(*same) && self.subject.precision() == Precision::F64;
            if strict && sizes.is_some_and(|sizes| !small(sizes)) {
                continue;
            }
            for (i, deviation) in deviation.iter_mut().enumerate() {
                if change(i).is_finite() {
                    *deviation = deviation.max(change(i));
                }
            }
        }
        deviation
    }

    /// Returns the largest change of a derivative when its own roundings fall differently. A change of more
    /// than a thousandth of the size comes from another decision, not from rounding.
    pub(crate) fn roundings(
        &self,
        base: &[f64],
        sizes: &[f64],
        noisy: impl Fn(u64) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.rounded(base, sizes, noisy, true)
    }

    /// Returns the largest change of each derivative when its own roundings fall differently, number by number: one
    /// that changes by rounding counts although others changed by another decision.
    pub(crate) fn roundings_of_each(
        &self,
        base: &[f64],
        sizes: &[f64],
        noisy: impl Fn(u64) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.rounded(base, sizes, noisy, false)
    }

    fn rounded(
        &self,
        base: &[f64],
        sizes: &[f64],
        noisy: impl Fn(u64) -> Option<Vec<f64>>,
        together: bool,
    ) -> Vec<f64> {
        let mut deviation = vec![0.0_f64; base.len()];
        let lists = (0..RUNS).map_while(noisy);
        for list in lists.filter(|list| list.len() == base.len()) {
            let change = |i: usize| (list[i] - base[i]).abs();
            let small = |i: usize| change(i) <= DECIDED * sizes[i];
            if together && !(0..list.len()).all(small) {
                continue;
            }
            for (i, deviation) in deviation.iter_mut().enumerate().filter(|(i, _)| small(*i)) {
                *deviation = deviation.max(change(i));
            }
        }
        deviation
    }

    /// Returns the value of a function linear in a direction, by a shorter direction: the factor is drawn from
    /// a seed, and the result divided by it. It is for [`roundings`](Self::roundings).
    pub(crate) fn along_shorter(
        &self,
        direction: &[f64],
        seed: u64,
        linear: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Option<Vec<f64>> {
        let precision = self.subject.precision();
        let by = precision.round(Draw::new(seed).within(0.5, 1.0));
        let shorter: Vec<f64> = direction.iter().map(|x| precision.round(x * by)).collect();
        Some(linear(&shorter)?.iter().map(|x| x / by).collect())
    }

    /// Returns the roughness of a list-valued function near the point: its rounding errors, estimated from its values
    /// alone.
    fn rough(&self, on: &dyn Subject, f: &dyn Fn(&[f64]) -> Option<Vec<f64>>) -> Vec<f64> {
        let own = |(scale, x): (&f64, &f64)| {
            if *x == 0.0 {
                *scale
            } else {
                scale.min(x.abs())
            }
        };
        let scales: Vec<f64> = self.scales.iter().zip(self.x).map(own).collect();
        let inside = |x: &[f64]| on.inside(x).then(|| f(x)).flatten();
        roughness(on.precision(), self.x, &scales, &inside)
    }

    /// Returns the roughness of the combined value.
    pub(crate) fn rough_value(&self, on: &dyn Subject, weights: &[f64]) -> f64 {
        let value = |x: &[f64]| Some(vec![dot(weights, &on.value(x))]);
        self.rough(on, &value).first().copied().unwrap_or(0.0)
    }

    /// Returns the size that each derivative reaches when the numbers of the input change over their size, all together
    /// and one by one. Points with a derivative far larger than the value do not count: another feature is near.
    pub(crate) fn typical(
        &self,
        weights: &[f64],
        base: &[f64],
        derivatives: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
        tallest: f64,
    ) -> Vec<f64> {
        let mut sizes: Vec<f64> = base.iter().map(|derivative| derivative.abs()).collect();
        let value = |y: &[f64]| -> f64 { weights.iter().zip(y).map(|(w, y)| (w * y).abs()).sum() };
        let here = value(&self.y);
        let mut look = |there: &[f64]| {
            if !self.subject.inside(there) {
                return;
            }
            let tall = match value(&self.subject.value(there)).max(here) {
                0.0 => f64::INFINITY,
                value => tallest * value,
            };
            for (i, derivative) in derivatives(there).unwrap_or_default().iter().enumerate() {
                if derivative.is_finite() && derivative.abs() * self.scales[i] <= tall {
                    sizes[i] = sizes[i].max(derivative.abs());
                }
            }
        };
        let precision = self.subject.precision();
        let n = self.x.len();
        for times in ELSEWHERE {
            let whole = self
                .x
                .iter()
                .map(|x| precision.round(times * x))
                .collect::<Vec<f64>>();
            look(&whole);
            for i in (0..n).filter(|_| n <= FEW_INPUTS && times < 1.0) {
                let mut there = self.x.to_vec();
                there[i] = if there[i] == 0.0 {
                    precision.round((times - 0.25) * self.scales[i])
                } else {
                    whole[i]
                };
                look(&there);
            }
        }
        sizes
    }

    /// Returns the rounding error that derivatives may have. Their terms are as large as derivatives typically are.
    /// Their roughness near the point counts as far as rounding of such terms explains it. A derivative rougher than
    /// that loses digits without need.
    pub(crate) fn rough_derivatives(
        &self,
        weights: &[f64],
        base: &[f64],
        derivatives: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.roughly(weights, base, derivatives, TALL)
    }

    /// Returns the rounding error that second derivatives along a direction may have, as
    /// [`rough_derivatives`](Self::rough_derivatives) does.
    pub(crate) fn rough_second_derivatives(
        &self,
        weights: &[f64],
        base: &[f64],
        bends: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.roughly(weights, base, bends, TALL_SECOND)
    }

    fn roughly(
        &self,
        weights: &[f64],
        base: &[f64],
        derivatives: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
        tallest: f64,
    ) -> Vec<f64> {
        // Derivatives of one unit have a known bound of their error.
        if self.subject.comparable() {
            return vec![0.0; base.len()];
        }
        let mut rough = self.rough(self.subject, derivatives);
        rough.resize(base.len(), 0.0);
        let typical = self.typical(weights, base, derivatives, tallest);
        for (rough, typical) in rough.iter_mut().zip(typical) {
            let one = self.eps * typical;
            *rough = if *rough <= ROUGH * one {
                rough.max(one)
            } else {
                one
            };
        }
        rough
    }

    /// Returns `true` if a derivative lies among those at neighbouring inputs, by another witness if there is one.
    /// Otherwise rounding does not explain it: it is wrong at this input alone. For each number of a short input, only
    /// inputs with another value of that number count: the fault may be a special case of it.
    fn is_among_neighbours(
        &self,
        derivative: &[f64],
        sizes: &[f64],
        neighbours: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> bool {
        let places = self.around.iter().map(|(there, _)| there.as_slice());
        let all: Vec<(&[f64], Vec<f64>)> = places
            .filter_map(|there| Some((there, neighbours(there)?)))
            .filter(|(_, list)| list.len() == derivative.len())
            .collect();
        let is_among = |counts: &dyn Fn(&[f64]) -> bool| {
            let others = || {
                all.iter()
                    .filter(|(there, _)| counts(there))
                    .map(|(_, list)| list)
            };
            (0..derivative.len()).all(|i| {
                let slack = DECIDED * sizes[i];
                let least = others().fold(f64::INFINITY, |m, list| m.min(list[i]));
                let most = others().fold(f64::NEG_INFINITY, |m, list| m.max(list[i]));
                least > most || (least - slack..=most + slack).contains(&derivative[i])
            })
        };
        match self.x.len() {
            ..=FEW_INPUTS => (0..self.x.len()).all(|k| is_among(&|there| there[k] != self.x[k])),
            _ => is_among(&|_| true),
        }
    }

    /// Adds to a row's tolerance the changes that perturbed rounding shows, once.
    pub(crate) fn perturb(&self, row: &Combination) {
        if row.perturbed.replace(true) {
            return;
        }
        let by_duals = |x: &[f64]| {
            let jacobian = self.subject.jacobian(x)?;
            Some(combined(&row.weights, &jacobian, x.len()))
        };
        if let Some(adjoint) = &row.adjoint {
            let alone = !self.is_among_neighbours(adjoint, &row.size, |x| match &row.dual {
                Some(_) => by_duals(x),
                None => self.subject.adjoint(x, &row.weights),
            });
            let deviation = self.deviation_if(
                adjoint,
                Some(&row.size),
                |neighbour| neighbour != Neighbour::Loose && !alone,
                |x| self.subject.adjoint(x, &row.weights),
            );
            let noise = self.roundings(adjoint, &row.size, |seed| {
                self.subject.noisy(self.x, &row.weights, seed)
            });
            let rough = self.rough_derivatives(&row.weights, adjoint, &|x| {
                self.subject.adjoint(x, &row.weights)
            });
            row.allow(|i| SAFETY * deviation[i].max(noise[i]).max(rough[i]));
        }
        if let Some(dual) = &row.dual {
            let along = |axis: &[f64]| self.by_duals(row, axis);
            let off = self.rounding_of_duals(row, dual, &by_duals, &along);
            row.allow(|i| SAFETY * off[i]);
        }
    }

    /// Returns the rounding error of each derivative by duals: the largest change at neighbouring inputs and along a
    /// shorter axis, and the roughness.
    pub(crate) fn rounding_of_duals(
        &self,
        row: &Combination,
        dual: &[f64],
        derivatives: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
        along: &dyn Fn(&[f64]) -> Option<f64>,
    ) -> Vec<f64> {
        let deviation = self.deviation(dual, Some(&row.size), derivatives);
        let rough = self.rough_derivatives(&row.weights, dual, derivatives);
        let each = (0..dual.len()).map(|i| {
            let axis = axis(dual.len(), i);
            let own = self.roundings(&dual[i..=i], &row.size[i..=i], |seed| {
                self.along_shorter(&axis, seed, |axis| Some(vec![along(axis)?]))
            });
            deviation[i].max(own[0]).max(rough[i])
        });
        each.collect()
    }

    /// Adds to a row's tolerance the effect of decisions that fall differently in single and in double precision,
    /// once.
    pub(crate) fn perturb_in_double(&self, row: &Combination) {
        let (Some(wide), Some(adjoint)) = (&self.wide, &row.adjoint) else {
            return;
        };
        if self.subject.precision() == Precision::F64 || row.perturbed_in_double.replace(true) {
            return;
        }
        let own = self.deviation(adjoint, None, |x| self.subject.adjoint(x, &row.weights));
        let exact = wide.adjoint(self.x, &row.weights).unwrap_or_default();
        let theirs = self.deviation(&exact, None, |x| wide.adjoint(x, &row.weights));
        row.allow(|i| SAFETY * (own[i] + theirs.get(i).unwrap_or(&0.0)));
    }

    /// Adds to a row's tolerance the changes that perturbed rounding shows with the arguments exchanged, once.
    pub(crate) fn perturb_exchanged(&self, row: &Combination) {
        if row.perturbed_exchanged.replace(true) {
            return;
        }
        let of = |x: &[f64]| {
            let derivatives = self.subject.adjoint(&exchanged(x), &row.weights)?;
            Some(exchanged(&derivatives))
        };
        let Some(base) = of(self.x) else { return };
        if let Some(adjoint) = &row.adjoint {
            let own = self.deviation(adjoint, None, |x| self.subject.adjoint(x, &row.weights));
            row.allow(|i| SAFETY * own[i]);
        }
        // The exchanged arguments are rounded differently, so near a tie they may be decided
        // differently.
        let deviation = self.deviation(&base, None, of);
        row.allow(|i| SAFETY * deviation[i]);
    }

    /// Returns the derivative of a row along a direction by num-dual's numbers.
    pub(crate) fn num_dual_along(
        &self,
        row: &Combination,
        x: &[f64],
        direction: &[f64],
    ) -> Option<f64> {
        let (_, ahead) = self.subject.num_dual(x, direction)?;
        let usable = ahead.len() == self.y.len();
        usable.then(|| dot(&row.weights, &ahead))
    }
    /// Returns the derivatives of a row by num-dual's numbers.
    pub(crate) fn by_num_dual(&self, row: &Combination, x: &[f64]) -> Option<Vec<f64>> {
        let derivative = |i| self.num_dual_along(row, x, &axis(x.len(), i));
        (0..x.len()).map(derivative).collect()
    }
    /// Returns the derivative of a row along a direction by duals.
    pub(crate) fn by_duals(&self, row: &Combination, direction: &[f64]) -> Option<f64> {
        let ahead = self.subject.along(self.x, direction)?;
        let usable = ahead.len() == self.y.len() && ahead.iter().all(|y| y.is_finite());
        usable.then(|| dot(&row.weights, &ahead))
    }
}

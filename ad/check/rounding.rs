//! The rounding error of each witness at an input, measured by perturbing roundings. Comparisons call it when two
//! witnesses differ by more than plain rounding, and add the result to the tolerance.
//!
//! Four kinds of rounding are perturbed, each by a change that leaves the true result as it is, or nearly. Inputs move
//! by their last digits, which shows the effect of errors of the input and of the value's computation. The adjoint's
//! own operations round at random ([`noise`](crate::ad::check::noise)). The operations of a closure are not visible, so
//! its roughness between equally spaced inputs is measured ([`roughness`]). Functions linear in a direction (duals,
//! second derivatives) are computed along a shorter direction. The result is shorter by the same factor, but every sum
//! and product of derivatives rounds differently. Perturbed inputs do not show these roundings. Two large derivatives
//! that cancel leave an error of their last digit, which does not move with the input.
//!
//! Functions named `perturb…` add to the tolerance of a [`Combination`] of outputs. It is called a row here, since it is
//! a row of the Jacobian or a sum of rows.
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
    /// Returns the largest change of a list-valued function under perturbed rounding, per number.
    ///
    /// With `sizes`, a change at a neighbour that may have broken an exact tie counts only up to a thousandth of them. A
    /// larger change comes from a kink, and a tie is judged at the input itself.
    pub(crate) fn deviation(
        &self,
        base: &[f64],
        sizes: Option<&[f64]>,
        f: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.deviation_if(base, sizes, |neighbour| neighbour != Neighbour::Loose, f)
    }

    /// Returns the largest change of an output under perturbed rounding, as far as derivatives explain it. Near a tie
    /// any input may take another branch. The value then changes by at most the derivative there times the
    /// displacement, and by more at a jump.
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

    /// Returns the largest change at many more inputs near this one, whatever branches they take. At one of them all
    /// numbers below the rounding of their unit are zero, which no draw hits. Such a number is the sine of edges that
    /// are parallel to 10⁻¹⁷.
    pub(crate) fn deviation_of_many(
        &self,
        base: &[f64],
        f: impl Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        let rounding = self.subject.rounding(self.x);
        let mut deviation = vec![0.0_f64; base.len()];
        let numbers = self.x.iter().zip(&rounding);
        let vanished = numbers.map(|(x, rounding)| if x.abs() > *rounding { *x } else { 0.0 });
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

    /// Returns `true` if a condition holds at an input within the rounding of this one, or within the width of a tie.
    /// The function may take other decisions there.
    pub(crate) fn holds_nearby(&self, holds: impl Fn(&[f64]) -> bool) -> bool {
        let near = self.around.iter().map(|(there, _)| there.clone());
        near.chain(self.drawn_nearby(1.0))
            .chain(self.drawn_nearby(TIED))
            .any(|there| self.subject.inside(&there) && holds(&there))
    }

    /// Returns the largest change under perturbed rounding. `decides` selects the neighbours at which even a change too
    /// large for rounding counts.
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

    /// Returns the largest change of each derivative when its own roundings fall differently. A run in which some
    /// derivative changes by more than a thousandth of its size does not count: it took another decision.
    pub(crate) fn roundings(
        &self,
        base: &[f64],
        sizes: &[f64],
        noisy: impl Fn(u64) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.rounded(base, sizes, noisy, true)
    }

    /// Returns the largest change of each derivative when its own roundings fall differently, number by number. A number
    /// that changes by rounding counts even if another decision changed others.
    pub(crate) fn roundings_of_each(
        &self,
        base: &[f64],
        sizes: &[f64],
        noisy: impl Fn(u64) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.rounded(base, sizes, noisy, false)
    }

    /// Returns the largest change of each number of `base` in runs with other roundings. Only small changes count, and
    /// with `together` only runs in which all changes are small.
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

    /// Returns the value along a direction of a function that is linear in it, computed along a shorter one. The result
    /// is divided by the factor, which is drawn from a seed. Serves [`roundings`](Self::roundings).
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

    /// Returns the roughness of a list-valued function near the input: its rounding errors, estimated from its values
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
    /// and one by one. A derivative far larger than the value does not count: another feature is near.
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
        let mut measure = |there: &[f64]| {
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
            measure(&whole);
            for i in (0..n).filter(|_| n <= FEW_INPUTS && times < 1.0) {
                let mut there = self.x.to_vec();
                there[i] = if there[i] == 0.0 {
                    precision.round((times - 0.25) * self.scales[i])
                } else {
                    whole[i]
                };
                measure(&there);
            }
        }
        sizes
    }

    /// Returns the rounding error that derivatives may have. The terms of a derivative are taken to have its
    /// [typical](Self::typical) size. Roughness near the input counts as far as the rounding of such terms explains it. A
    /// rougher derivative loses digits without need.
    pub(crate) fn rough_derivatives(
        &self,
        weights: &[f64],
        base: &[f64],
        derivatives: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.roughness_limit(weights, base, derivatives, TALL)
    }

    /// Returns the rounding error that second derivatives along a direction may have, as
    /// [`rough_derivatives`](Self::rough_derivatives) does.
    pub(crate) fn rough_second_derivatives(
        &self,
        weights: &[f64],
        base: &[f64],
        bends: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<f64> {
        self.roughness_limit(weights, base, bends, TALL_SECOND)
    }

    /// Returns the rounding error that derivatives may have; `tallest` is the limit of [`typical`](Self::typical).
    fn roughness_limit(
        &self,
        weights: &[f64],
        base: &[f64],
        derivatives: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
        tallest: f64,
    ) -> Vec<f64> {
        // The error of derivatives that can be compared has a known bound.
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
    /// Otherwise rounding does not explain it: it is wrong at this input alone. A fault may be a special case of one
    /// number. So for each number of a short input, only neighbours with another value of it count.
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

    /// Adds the changes that perturbed rounding shows to the tolerance of a row, once.
    pub(crate) fn perturb(&self, row: &Combination) {
        if row.perturbed.replace(true) {
            return;
        }
        let by_duals = |x: &[f64]| {
            let jacobian = self.subject.jacobian(x)?;
            Some(combined(&row.weights, &jacobian, x.len()))
        };
        if let Some(adjoint) = &row.adjoint {
            let is_alone = !self.is_among_neighbours(adjoint, &row.size, |x| match &row.dual {
                Some(_) => by_duals(x),
                None => self.subject.adjoint(x, &row.weights),
            });
            let deviation = self.deviation_if(
                adjoint,
                Some(&row.size),
                |neighbour| neighbour != Neighbour::Loose && !is_alone,
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
            let rounding = self.rounding_of_duals(row, dual, &by_duals, &along);
            row.allow(|i| SAFETY * rounding[i]);
        }
    }

    /// Returns the rounding error of each derivative by duals. It is the largest of three: the change at neighbouring
    /// inputs, the change along a shorter axis, and the roughness.
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

    /// Adds the effect of decisions that differ between single and double precision to the tolerance of a row, once.
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

    /// Adds the changes that perturbed rounding shows with exchanged arguments to the tolerance of a row, once.
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
        // The exchanged arguments round differently, so near a tie the function may decide differently.
        let deviation = self.deviation(&base, None, of);
        row.allow(|i| SAFETY * deviation[i]);
    }

    /// Returns the derivative of a row along a direction by the dual numbers of num-dual.
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
    /// Returns the derivatives of a row by the dual numbers of num-dual.
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

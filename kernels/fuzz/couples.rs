//! Properties of pairs of shapes: apart, identical, exchanged.
use super::arguments::InputColumns;
use super::inputs::is_inside;
use super::job::Job;
use super::properties::{BatchResults, Outcome, first_where, unless};
use super::property::{Finding, Property};
use crate::Real;
use crate::ad::declared::Kind;
use crate::kernels::row::op::Extremes;

/// The number of roundings, times the longest aspect, by which values may change when shapes are exchanged, and the
/// limit of aspects.
const ROUNDINGS: f64 = 64.0;
const LIMIT: f64 = 1e20;
/// The same for distances, times the largest coordinate or length: 512 roundings are more than [`OF_SEARCHES`].
const OF_DISTANCES: f64 = 512.0;
/// The error of searches over curved bodies, times the largest coordinate or length, in either format.
pub(super) const OF_SEARCHES: f64 = 1e-13;

impl<T: Real> Job<T> {
    /// Tests pairs that are certainly apart, since their numbers bound them along x or y.
    pub(super) fn apart(&self, inputs: &InputColumns<T>, found: &BatchResults<T>) -> Outcome {
        use Extremes::{Ratio, Shared, Union};
        if !matches!(self.declared.extremes, Shared | Ratio | Union) || self.shapes.len() != 2 {
            return Ok(());
        }
        let reach = |s: usize, i: usize, along: Kind| {
            let n = self.shapes[s].leaf.fields;
            let numbers = &inputs.columns[s][i * n..][..n];
            let (mut low, mut high, mut around) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
            for (x, &kind) in numbers.iter().zip(&self.shapes[s].kinds) {
                let x = x.widen();
                if kind == along {
                    (low, high) = (low.min(x), high.max(x));
                } else if kind == Kind::Length {
                    around += x.abs();
                }
            }
            [low - around, high + around]
        };
        let mut places = (0..inputs.count).step_by(7);
        let place = places.find(|&i| {
            let is_apart = [Kind::X, Kind::Y].into_iter().any(|along| {
                let ([a, b], [c, d]) = (reach(0, i, along), reach(1, i, along));
                // They must be further apart than rounding. Shapes of plain coordinates are compared in their own
                // format.
                let least = [a, b, c, d]
                    .into_iter()
                    .fold(0.0, |m: f64, x| m.max(x.abs()))
                    * 1e-6;
                (c - b).max(a - d) > least
            });
            let is_zero = |x: &T| *x == T::zero();
            is_apart
                && !(self.value_of(&found.values, i).iter().all(is_zero)
                    && self
                        .derivatives_of(inputs, &found.derivatives, i)
                        .iter()
                        .all(is_zero))
        });
        unless(Property::Apart, place)
    }

    /// Tests every shape with itself.
    pub(super) fn identical(&self, inputs: &InputColumns<T>) -> Outcome {
        use Extremes::{One, Ratio, Union};
        let extremes = self.declared.extremes;
        if !matches!(extremes, Ratio | Union | One)
            || self.shapes[0].leaf.fields != self.shapes[1].leaf.fields
        {
            return Ok(());
        }
        // Pairs outside the domain are skipped.
        let mut twins = inputs.twins();
        let mut places: Vec<usize> = (0..inputs.count).collect();
        if self.declared.domain.is_some() {
            places.retain(|&i| is_inside(self, &twins.item(self, i)));
            if places.is_empty() {
                return Ok(());
            }
            twins.keep(self, &places);
        }
        let found = self.compute(&twins)?;
        let unless = |property, place: Option<usize>| unless(property, place.map(|at| places[at]));
        let ill = |x: &T| (*x != T::one()) & (*x != T::zero());
        unless(Property::Identical, first_where(&found.values[0], ill))?;
        // Only a union is smooth here; a share of the first box has a kink.
        if extremes != Union {
            return Ok(());
        }
        found
            .derivatives
            .iter()
            .zip(&self.shapes)
            .try_for_each(|(list, shape)| {
                let some = first_where(list, |x| *x != T::zero());
                unless(Property::Identical, some.map(|at| at / shape.leaf.fields))
            })
    }

    /// Tests the shapes in exchanged order.
    pub(super) fn exchanged(&self, inputs: &InputColumns<T>, found: &BatchResults<T>) -> Outcome {
        let [a, b] = [0, 1].map(|s| self.shapes[s].leaf.fields);
        if !self.declared.is_symmetric() || a != b || self.outputs.len() != 1 {
            return Ok(());
        }
        let mut exchanged = inputs.exchanged();
        for i in 0..inputs.count {
            // An input that leaves the domain is not exchanged.
            if self.declared.domain.is_some() && !is_inside(self, &exchanged.item(self, i)) {
                exchanged.put(self, i, &inputs.item(self, i));
            }
        }
        let others = (self.values)(&exchanged, []);
        let others = others.map_err(|_| Finding {
            property: Property::Accepted,
            at: 0,
        })?;
        let (own, n) = (&found.values[0], self.outputs[0]);
        let place = (0..own.len()).find(|&k| {
            let apart = (own[k].widen() - others[0][k].widen()).abs();
            // An unbounded score changes in proportion to its size.
            let size = own[k].widen().abs().max(1.0);
            let size = if self.declared.power() == Some(0) {
                size
            } else {
                1.0
            };
            apart > 0.0
                && apart > size * self.exchange_may_change(inputs, k / n) * T::format().epsilon()
        });
        unless(Property::Symmetric, place.map(|k| k / n))
    }

    /// Returns the number of roundings of one by which a result may change when shapes are exchanged; infinite without
    /// a declared bound.
    fn exchange_may_change(&self, inputs: &InputColumns<T>, i: usize) -> f64 {
        let Some(power) = self.declared.power() else {
            return f64::INFINITY;
        };
        let numbers = |s: usize| {
            let n = self.shapes[s].leaf.fields;
            &inputs.columns[s][i * n..][..n]
        };
        let sides = [0, 1].map(|s| self.shapes[s].rules.sides(numbers(s)));
        let is_measure = matches!(self.declared.extremes, Extremes::Shared);
        if power > 0 && !is_measure {
            // A distance changes by roundings of the coordinates.
            let all = [0, 1].map(numbers);
            let all = all.iter().flat_map(|x| x.iter()).zip(&self.kinds);
            let largest = all.fold(0.0_f64, |m, (x, kind)| match kind.is_length() {
                true => m.max(x.widen().abs()),
                false => m,
            });
            return OF_DISTANCES * largest.powi(power);
        }
        if sides.iter().any(Vec::is_empty) {
            return f64::INFINITY;
        }
        // A rounding of the longest side moves the sides of the other box. So does a rounding of the distance of boxes
        // apart, in scores that compare it with sizes.
        let all = || sides.iter().flatten().copied();
        let way = match self.declared.extremes {
            Extremes::Undeclared | Extremes::One => {
                let [a, b] = [0, 1].map(numbers);
                let pairs = a.iter().zip(b).zip(&self.kinds);
                let lengths = pairs.filter(|(_, kind)| kind.is_length());
                lengths.fold(0.0, |m: f64, ((x, y), _)| {
                    m.max((x.widen() - y.widen()).abs())
                })
            }
            _ => 0.0,
        };
        let aspect = all().fold(way, f64::max) / all().fold(f64::INFINITY, f64::min);
        if aspect.is_nan() || aspect >= LIMIT {
            return f64::INFINITY;
        }
        let content = |sides: &Vec<f64>| sides.iter().product::<f64>();
        // A volume may have two short sides.
        let aspect = if power == 3 { aspect * aspect } else { aspect };
        match is_measure {
            true => ROUNDINGS * aspect * content(&sides[0]).min(content(&sides[1])),
            // Unbounded scores contain ratios of squares of sizes.
            false if self.declared.range.least < -3.0 || self.declared.range.largest > 1.0 => {
                ROUNDINGS * aspect * aspect
            }
            false => ROUNDINGS * aspect,
        }
    }
}

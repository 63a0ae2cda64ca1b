//! Comparison of second derivatives with one another. It multiplies the Hessian by a random direction and decides if
//! the products through the adjoint, by duals of duals and by differences of the adjoint agree, and if the Hessian is
//! symmetric. [`judge`](crate::ad::check::judge) calls it at inputs that are smooth along all directions.
use crate::ad::check::evidence::{Combination, Evidence};
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{
    COMBINATIONS, CURVATURE_ROUNDINGS, FEW_INPUTS, FIRST, INFORMATIVE, ROUNDINGS, SAFETY,
};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::{Estimate, Probe, Probed, StepSequence, axis, dot};
use crate::ad::sample::Draw;
use std::cell::OnceCell;

/// Returns `true` if a refusal stands: some other sequence repeats it, and none contradicts.
fn confirmed(again: impl Iterator<Item = Option<bool>>) -> bool {
    let mut repeated = false;
    for agrees in again.flatten() {
        if !agrees {
            return false;
        }
        repeated = true;
    }
    repeated
}

/// Compares second derivatives of every row: through the adjoint, by duals of duals, by differences of the adjoint. A
/// function of `f32` that is known in double precision uses duals of duals there instead.
pub(crate) fn curvature(e: &Evidence<'_>, draw: &mut Draw) -> Notes {
    let mut notes = Notes::new(e.x.len());
    if e.x.is_empty() {
        return notes;
    }
    for row in &e.rows {
        let mut random = || -> Vec<f64> {
            let within = |scale: &f64| scale * draw.within(-1.0, 1.0);
            e.scales.iter().map(within).collect()
        };
        let (u, v) = (random(), random());
        let Some(product) = e.subject.curvature(e.x, &row.weights, &v) else {
            continue;
        };
        if product.len() != e.x.len() {
            notes.add_length_fault(Witness::Adjoint, row.output, [product.len(), e.x.len()]);
            continue;
        }
        if let Some(i) = product.iter().position(|b| !b.is_finite()) {
            notes.add_fault(Reason::NotFinite(Witness::Adjoint), row.output, i);
            continue;
        }
        let product = HessianTimes::new(e, row, v, product);
        notes.add(product.by_duals());
        notes.add(product.widely());
        notes.add(product.symmetric(&u));
        // Differences of derivatives in single precision are mostly rounding: double precision has judged.
        if e.wide.is_none() {
            notes.add(product.by_differences(&mut random));
        }
    }
    notes
}

/// The Hessian of a row times a direction.
struct HessianTimes<'e> {
    evidence: &'e Evidence<'e>,
    row: &'e Combination,
    direction: Vec<f64>,
    /// Through the adjoint.
    product: Vec<f64>,
    /// The largest second or first derivative, in each number's unit.
    sizes: Vec<f64>,
    /// The error of this product and that by duals of duals together, from perturbed rounding.
    deviation: OnceCell<Vec<f64>>,
}

impl<'e> HessianTimes<'e> {
    fn new(
        e: &'e Evidence<'e>,
        row: &'e Combination,
        direction: Vec<f64>,
        product: Vec<f64>,
    ) -> Self {
        let largest_of = |list: &[f64]| {
            let each = list.iter().zip(&e.units);
            each.fold(0.0_f64, |m, (x, unit)| m.max(x.abs() * unit))
        };
        let largest = largest_of(&product).max(largest_of(&row.size));
        HessianTimes {
            evidence: e,
            row,
            direction,
            product,
            sizes: e.units.iter().map(|unit| largest / unit).collect(),
            deviation: OnceCell::new(),
        }
    }

    /// Returns the product by the adjoint, at any point and along any direction.
    fn along(&self, x: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        self.evidence.subject.curvature(x, &self.row.weights, v)
    }
    /// Returns the product by duals of duals; a whole Hessian row by row is for short inputs.
    fn nested(&self, x: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let short = self.evidence.x.len() <= FEW_INPUTS;
        let nested = || self.evidence.subject.second_order(x, &self.row.weights, v);
        short.then(nested).flatten()
    }

    /// Returns the error that roundings alone explain: a share of the largest second derivative in one unit if such are
    /// summed, else of its own size.
    fn exact(&self, i: usize) -> f64 {
        let size = if self.evidence.subject.comparable() {
            self.sizes[i]
        } else {
            self.product[i].abs()
        };
        CURVATURE_ROUNDINGS * self.evidence.eps * size + f64::MIN_POSITIVE
    }

    fn deviation(&self) -> &[f64] {
        self.deviation.get_or_init(|| {
            let (e, v, sizes) = (self.evidence, &self.direction, Some(&self.sizes[..]));
            let own = e.deviation(&self.product, sizes, |x| self.along(x, v));
            let second = self.nested(e.x, v).unwrap_or_default();
            let other = e.deviation(&second, sizes, |x| self.nested(x, v));
            let noise = e.roundings(&self.product, &self.sizes, |seed| {
                e.subject.noisy_curvature(e.x, &self.row.weights, v, seed)
            });
            // Both are linear in the direction.
            let shorter = e.roundings(&self.product, &self.sizes, |seed| {
                e.along_shorter(v, seed, |v| self.along(e.x, v))
            });
            let other_shorter = e.roundings(&second, &self.sizes, |seed| {
                e.along_shorter(v, seed, |v| self.nested(e.x, v))
            });
            let other = |i: usize| {
                let seen = other.get(i).zip(other_shorter.get(i));
                seen.map_or(0.0, |(deviation, shorter)| deviation.max(*shorter))
            };
            let rough =
                e.rough_second_derivatives(&self.row.weights, &self.product, &|x| self.along(x, v));
            let own = |i: usize| own[i].max(noise[i]).max(shorter[i]).max(rough[i]);
            (0..self.product.len()).map(|i| own(i) + other(i)).collect()
        })
    }

    /// Compares another second derivative with this one.
    fn compared(
        &self,
        witness: Witness,
        second: &[f64],
        deviation: impl Fn(usize) -> f64,
    ) -> Notes {
        let mut notes = Notes::new(self.evidence.x.len());
        for (i, (&product, &second)) in self.product.iter().zip(second).enumerate() {
            let gap = (product - second).abs();
            let mut tolerance = self.exact(i);
            if gap > tolerance {
                tolerance += SAFETY * deviation(i);
            }
            if gap > tolerance || (gap.is_nan() && witness == Witness::Dual) {
                let numbers = match witness {
                    Witness::Dual => ByWitness {
                        adjoint: Some(product),
                        dual: Some(second),
                        ..ByWitness::default()
                    },
                    _ => ByWitness::pair(product, second),
                };
                let reason = Reason::CurvatureDisagrees(witness);
                notes.add_fault_with(reason, None, (self.row.output, i), numbers, tolerance);
            }
        }
        notes
    }

    fn by_duals(&self) -> Notes {
        let second = self
            .nested(self.evidence.x, &self.direction)
            .unwrap_or_default();
        self.compared(Witness::Dual, &second, |i| self.deviation()[i])
    }

    fn widely(&self) -> Notes {
        let e = self.evidence;
        let wide = e.wide.as_ref().filter(|_| e.x.len() <= FEW_INPUTS);
        let widely = |x: &[f64]| wide?.second_order(x, &self.row.weights, &self.direction);
        let second = widely(e.x).unwrap_or_default();
        // Decisions may fall differently in the other format, so other branches count.
        let deviation = OnceCell::new();
        let deviation = || {
            deviation.get_or_init(|| {
                let own = e.deviation(&self.product, None, |x| self.along(x, &self.direction));
                let theirs = e.deviation(&second, None, widely);
                own.iter()
                    .zip(theirs)
                    .map(|(a, b)| a + b)
                    .collect::<Vec<f64>>()
            })
        };
        self.compared(Witness::Wide, &second, |i| deviation()[i])
    }

    /// Checks that the Hessian is symmetric: `u · H v = v · H u`.
    fn symmetric(&self, u: &[f64]) -> Notes {
        let (e, v, n) = (self.evidence, &self.direction, self.product.len());
        let mut notes = Notes::new(n);
        let Some(other) = self.along(e.x, u) else {
            return notes;
        };
        let (a, b) = (dot(u, &self.product), dot(v, &other));
        let own = |i: usize| {
            let size = (u[i] * self.product[i]).abs() + (v[i] * other[i]).abs();
            ROUNDINGS * e.eps * size + (u[i].abs() + v[i].abs()) * self.exact(i)
        };
        let mut tolerance: f64 = (0..n).map(own).sum();
        if (a - b).abs() > tolerance {
            let theirs = e.deviation(&other, Some(&self.sizes), |x| self.along(x, u));
            let deviation =
                |i: usize| SAFETY * (u[i].abs() * self.deviation()[i] + v[i].abs() * theirs[i]);
            tolerance += (0..n).map(deviation).sum::<f64>();
        }
        if (a - b).abs() > tolerance {
            let numbers = ByWitness {
                along: true,
                ..ByWitness::pair(a, b)
            };
            let reason = Reason::CurvatureNotSymmetric;
            notes.add_fault_with(reason, None, (self.row.output, 0), numbers, tolerance);
        }
        notes
    }

    /// Compares with differences of the adjoint along the direction.
    fn by_differences(&self, random: &mut dyn FnMut() -> Vec<f64>) -> Notes {
        let (e, row, v, n) = (self.evidence, self.row, &self.direction, self.product.len());
        let mut notes = Notes::new(n);
        let Some(adjoint) = &row.adjoint else {
            return notes;
        };
        let subject = e.subject;
        let probe = |there: &Vec<f64>| -> Probed {
            if !subject.inside(there) {
                return None;
            }
            let derivatives = subject.adjoint(there, &row.weights)?;
            let usable = derivatives.len() == n && derivatives.iter().all(|y| y.is_finite());
            usable.then(|| (derivatives, subject.traced(there).map(|(_, trace)| trace)))
        };
        let probe: Probe<'_> = &|places| places.iter().map(probe).collect();
        let steps_from = |first| {
            StepSequence::evaluate(probe, subject.precision(), e.x, adjoint, e.trace, v, first)
        };
        let sequence = steps_from(FIRST[0]);
        let moved: f64 = (0..n).map(|k| e.x[k].abs() * e.eps * self.sizes[k]).sum();
        // Steps are rounded in every number, some to zero. The effect on derivatives is that of moving the input by its
        // last digits.
        let moved_by_digits = OnceCell::new();
        let moved_by_digits = || {
            moved_by_digits.get_or_init(|| {
                let there = |x: &[f64]| subject.adjoint(x, &row.weights);
                e.deviation(adjoint, Some(&self.sizes), there)
            })
        };
        // One by one, or all of a long input in random combinations.
        let combinations: Vec<Vec<f64>> = if n <= FEW_INPUTS {
            (0..n).map(|i| axis(n, i)).collect()
        } else {
            (0..COMBINATIONS).map(|_| random()).collect()
        };
        for (i, weights) in combinations.into_iter().enumerate() {
            let over =
                |f: &dyn Fn(usize) -> f64| -> f64 { (0..n).map(|k| weights[k].abs() * f(k)).sum() };
            let noise =
                over(&|k| e.eps * row.size[k] + row.allowed(k) / ROUNDINGS + moved / e.units[k]);
            let test = HessianTest {
                weights: &weights,
                product: dot(&weights, &self.product),
                size: over(&|k| self.sizes[k]),
                exact: over(&|k| self.exact(k)),
                noise,
            };
            if test.wrong(&sequence).is_none() {
                continue;
            }
            let test = HessianTest {
                exact: test.exact + SAFETY * over(&|k| self.deviation()[k]),
                noise: noise + over(&|k| moved_by_digits()[k]),
                ..test
            };
            if let Some((found, tolerance)) = test.wrong(&sequence)
                && confirmed(
                    FIRST[1..]
                        .iter()
                        .map(|&first| test.repeats(&steps_from(first), found)),
                )
            {
                let numbers = ByWitness {
                    adjoint: Some(test.product),
                    difference: Some(found.value),
                    along: n > FEW_INPUTS,
                    ..ByWitness::default()
                };
                let reason = Reason::CurvatureDisagrees(Witness::Difference);
                let input = if n <= FEW_INPUTS { i } else { 0 };
                notes.add_fault_with(reason, None, (row.output, input), numbers, tolerance);
            }
        }
        notes
    }
}

/// One combination of second derivatives, which is compared with a sequence of first derivatives.
struct HessianTest<'w> {
    weights: &'w [f64],
    product: f64,
    /// The largest second derivative.
    size: f64,
    /// The rounding error of the product.
    exact: f64,
    /// The rounding noise of the derivatives.
    noise: f64,
}

impl HessianTest<'_> {
    fn informative(&self, e: &Estimate) -> bool {
        SAFETY * e.error <= INFORMATIVE * self.size.max(e.value.abs())
    }

    /// Returns the estimate of a sequence that contradicts the second derivative, and how much they may differ.
    fn wrong(&self, sequence: &StepSequence) -> Option<(Estimate, f64)> {
        let e = sequence.central(self.weights, self.noise, true)?;
        let tolerance = SAFETY * e.error + self.exact;
        let wrong = self.informative(&e) && (e.value - self.product).abs() > tolerance;
        // At a kink of the derivative itself, the second derivative may be that of either side.
        let side = |ahead| sequence.one_sided(ahead, self.weights, self.noise);
        let between = side(true).zip(side(false)).is_some_and(|(a, b)| {
            let off = SAFETY * (a.error + b.error) + self.exact;
            let kink = (a.value - b.value).abs() > off;
            kink && self.product >= a.value.min(b.value) - off
                && self.product <= a.value.max(b.value) + off
        });
        (wrong && !between).then_some((e, tolerance))
    }

    /// Returns `true` if another sequence confirms the estimate; nothing if it is too coarse to decide.
    fn repeats(&self, again: &StepSequence, found: Estimate) -> Option<bool> {
        let central = again.central(self.weights, self.noise, true)?;
        self.informative(&central).then(|| {
            self.wrong(again).is_some_and(|(again, _)| {
                (again.value - found.value).abs() <= SAFETY * (again.error + found.error)
            })
        })
    }
}

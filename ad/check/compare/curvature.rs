//! Second derivatives against one another.
use crate::ad::check::evidence::{Combination, Evidence};
use crate::ad::check::notes::Notes;
use crate::ad::check::tolerances::{
    COMBINATIONS, CURVATURE_ROUNDINGS, FEW_INPUTS, FIRST, INFORMATIVE, ROUNDINGS, SAFETY,
};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::{Estimate, Ladder, Probe, Probed, axis, dot};
use crate::ad::sample::Draw;
use std::cell::OnceCell;

/// Returns `true` if a complaint stands: some other ladder repeats it, and none contradicts.
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

/// Compares second derivatives of every row: through the adjoint, by duals of duals, by differences of the adjoint. A
/// function of `f32` that is known in double precision uses duals of duals there instead.
pub(crate) fn curvature(e: &Evidence<'_>, draw: &mut Draw) -> Notes {
    let mut said = Notes::new(e.x.len());
    if e.x.is_empty() {
        return said;
    }
    for row in &e.rows {
        let mut random = || -> Vec<f64> {
            let within = |scale: &f64| scale * draw.within(-1.0, 1.0);
            e.scales.iter().map(within).collect()
        };
        let (u, v) = (random(), random());
        let Some(bend) = e.subject.curvature(e.x, &row.weights, &v) else {
            continue;
        };
        if bend.len() != e.x.len() {
            said.complain_of_length(Witness::Adjoint, row.output, [bend.len(), e.x.len()]);
            continue;
        }
        if let Some(i) = bend.iter().position(|b| !b.is_finite()) {
            said.complain(Reason::NotFinite(Witness::Adjoint), row.output, i);
            continue;
        }
        let bent = Bend::new(e, row, v, bend);
        said.add(bent.by_duals());
        said.add(bent.widely());
        said.add(bent.symmetric(&u));
        // Differences of derivatives in single precision are mostly rounding: double precision has judged.
        if e.wide.is_none() {
            said.add(bent.by_differences(&mut random));
        }
    }
    said
}

/// The Hessian of a row times a direction.
struct Bend<'e> {
    e: &'e Evidence<'e>,
    row: &'e Combination,
    direction: Vec<f64>,
    /// Through the adjoint.
    bend: Vec<f64>,
    /// The largest second derivative or derivative, in each number's unit.
    sizes: Vec<f64>,
    /// By how much it and that by duals of duals may be off together, as provoked rounding shows.
    spread: OnceCell<Vec<f64>>,
}

impl<'e> Bend<'e> {
    fn new(e: &'e Evidence<'e>, row: &'e Combination, direction: Vec<f64>, bend: Vec<f64>) -> Self {
        let largest_of = |list: &[f64]| {
            let each = list.iter().zip(&e.units);
            each.fold(0.0_f64, |m, (x, unit)| m.max(x.abs() * unit))
        };
        let largest = largest_of(&bend).max(largest_of(&row.size));
        Bend {
            e,
            row,
            direction,
            bend,
            sizes: e.units.iter().map(|unit| largest / unit).collect(),
            spread: OnceCell::new(),
        }
    }

    /// Returns the product by the adjoint, at any point and along any direction.
    fn along(&self, x: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        self.e.subject.curvature(x, &self.row.weights, v)
    }
    /// Returns the product by duals of duals; a whole Hessian row by row is for short inputs.
    fn nested(&self, x: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let short = self.e.x.len() <= FEW_INPUTS;
        let nested = || self.e.subject.second_order(x, &self.row.weights, v);
        short.then(nested).flatten()
    }

    /// Returns the error that roundings alone explain: a share of the largest second derivative in the same unit where
    /// such are summed, otherwise of its own size.
    fn exact(&self, i: usize) -> f64 {
        let size = if self.e.subject.comparable() {
            self.sizes[i]
        } else {
            self.bend[i].abs()
        };
        CURVATURE_ROUNDINGS * self.e.eps * size + f64::MIN_POSITIVE
    }

    fn spread(&self) -> &[f64] {
        self.spread.get_or_init(|| {
            let (e, v, sizes) = (self.e, &self.direction, Some(&self.sizes[..]));
            let own = e.spread(&self.bend, sizes, |x| self.along(x, v));
            let second = self.nested(e.x, v).unwrap_or_default();
            let other = e.spread(&second, sizes, |x| self.nested(x, v));
            let noise = e.roundings(&self.bend, &self.sizes, |seed| {
                e.subject.noisy_curvature(e.x, &self.row.weights, v, seed)
            });
            // Both are linear in the direction.
            let shorter = e.roundings(&self.bend, &self.sizes, |seed| {
                e.along_shorter(v, seed, |v| self.along(e.x, v))
            });
            let other_shorter = e.roundings(&second, &self.sizes, |seed| {
                e.along_shorter(v, seed, |v| self.nested(e.x, v))
            });
            let other = |i: usize| {
                let seen = other.get(i).zip(other_shorter.get(i));
                seen.map_or(0.0, |(spread, shorter)| spread.max(*shorter))
            };
            let rough = e.rough_bends(&self.row.weights, &self.bend, &|x| self.along(x, v));
            let own = |i: usize| own[i].max(noise[i]).max(shorter[i]).max(rough[i]);
            (0..self.bend.len()).map(|i| own(i) + other(i)).collect()
        })
    }

    /// Compares another second derivative with this one.
    fn compared(&self, witness: Witness, second: &[f64], spread: impl Fn(usize) -> f64) -> Notes {
        let mut said = Notes::new(self.e.x.len());
        for (i, (&bend, &second)) in self.bend.iter().zip(second).enumerate() {
            let gap = (bend - second).abs();
            let mut tolerance = self.exact(i);
            if gap > tolerance {
                tolerance += SAFETY * spread(i);
            }
            if gap > tolerance || (gap.is_nan() && witness == Witness::Dual) {
                let numbers = match witness {
                    Witness::Dual => ByWitness {
                        adjoint: Some(bend),
                        dual: Some(second),
                        ..ByWitness::default()
                    },
                    _ => ByWitness::pair(bend, second),
                };
                let reason = Reason::CurvatureDisagrees(witness);
                said.complain_of(reason, None, (self.row.output, i), numbers, tolerance);
            }
        }
        said
    }

    fn by_duals(&self) -> Notes {
        let second = self.nested(self.e.x, &self.direction).unwrap_or_default();
        self.compared(Witness::Dual, &second, |i| self.spread()[i])
    }

    fn widely(&self) -> Notes {
        let e = self.e;
        let wide = e.wide.as_ref().filter(|_| e.x.len() <= FEW_INPUTS);
        let widely = |x: &[f64]| wide?.second_order(x, &self.row.weights, &self.direction);
        let second = widely(e.x).unwrap_or_default();
        // Decisions may fall differently in the other format, so other branches count.
        let spread = OnceCell::new();
        let spread = || {
            spread.get_or_init(|| {
                let own = e.spread(&self.bend, None, |x| self.along(x, &self.direction));
                let theirs = e.spread(&second, None, widely);
                own.iter()
                    .zip(theirs)
                    .map(|(a, b)| a + b)
                    .collect::<Vec<f64>>()
            })
        };
        self.compared(Witness::Wide, &second, |i| spread()[i])
    }

    /// Checks that the Hessian is symmetric: `u · H v = v · H u`.
    fn symmetric(&self, u: &[f64]) -> Notes {
        let (e, v, n) = (self.e, &self.direction, self.bend.len());
        let mut said = Notes::new(n);
        let Some(other) = self.along(e.x, u) else {
            return said;
        };
        let (a, b) = (dot(u, &self.bend), dot(v, &other));
        let own = |i: usize| {
            let size = (u[i] * self.bend[i]).abs() + (v[i] * other[i]).abs();
            ROUNDINGS * e.eps * size + (u[i].abs() + v[i].abs()) * self.exact(i)
        };
        let mut tolerance: f64 = (0..n).map(own).sum();
        if (a - b).abs() > tolerance {
            let theirs = e.spread(&other, Some(&self.sizes), |x| self.along(x, u));
            let spread =
                |i: usize| SAFETY * (u[i].abs() * self.spread()[i] + v[i].abs() * theirs[i]);
            tolerance += (0..n).map(spread).sum::<f64>();
        }
        if (a - b).abs() > tolerance {
            let numbers = ByWitness {
                along: true,
                ..ByWitness::pair(a, b)
            };
            let reason = Reason::CurvatureNotSymmetric;
            said.complain_of(reason, None, (self.row.output, 0), numbers, tolerance);
        }
        said
    }

    /// Compares with differences of the adjoint along the direction.
    fn by_differences(&self, random: &mut dyn FnMut() -> Vec<f64>) -> Notes {
        let (e, row, v, n) = (self.e, self.row, &self.direction, self.bend.len());
        let mut said = Notes::new(n);
        let Some(adjoint) = &row.adjoint else {
            return said;
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
        let climb =
            |first| Ladder::climb(probe, subject.precision(), e.x, adjoint, e.trace, v, first);
        let ladder = climb(FIRST[0]);
        let moved: f64 = (0..n).map(|k| e.x[k].abs() * e.eps * self.sizes[k]).sum();
        // Steps are rounded in every number, some of them away; what that does to the derivatives is what
        // moving the input by its last digits does.
        let bent = OnceCell::new();
        let bent = || {
            bent.get_or_init(|| {
                let there = |x: &[f64]| subject.adjoint(x, &row.weights);
                e.spread(adjoint, Some(&self.sizes), there)
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
            let test = BendTest {
                weights: &weights,
                bend: dot(&weights, &self.bend),
                size: over(&|k| self.sizes[k]),
                exact: over(&|k| self.exact(k)),
                noise,
            };
            if test.wrong(&ladder).is_none() {
                continue;
            }
            let test = BendTest {
                exact: test.exact + SAFETY * over(&|k| self.spread()[k]),
                noise: noise + over(&|k| bent()[k]),
                ..test
            };
            if let Some((found, tolerance)) = test.wrong(&ladder)
                && confirmed(
                    FIRST[1..]
                        .iter()
                        .map(|&first| test.repeats(&climb(first), found)),
                )
            {
                let numbers = ByWitness {
                    adjoint: Some(test.bend),
                    difference: Some(found.value),
                    along: n > FEW_INPUTS,
                    ..ByWitness::default()
                };
                let reason = Reason::CurvatureDisagrees(Witness::Difference);
                let input = if n <= FEW_INPUTS { i } else { 0 };
                said.complain_of(reason, None, (row.output, input), numbers, tolerance);
            }
        }
        said
    }
}

/// One combination of second derivatives against a ladder of derivatives.
struct BendTest<'w> {
    weights: &'w [f64],
    bend: f64,
    /// The largest there is.
    size: f64,
    /// By how much it may be off by itself.
    exact: f64,
    /// The rounding noise of the derivatives.
    noise: f64,
}

impl BendTest<'_> {
    fn informative(&self, e: &Estimate) -> bool {
        SAFETY * e.error <= INFORMATIVE * self.size.max(e.value.abs())
    }

    /// Returns the estimate of a ladder that contradicts the second derivative, and how much they may differ.
    fn wrong(&self, ladder: &Ladder) -> Option<(Estimate, f64)> {
        let e = ladder.central(self.weights, self.noise, true)?;
        let tolerance = SAFETY * e.error + self.exact;
        let wrong = self.informative(&e) && (e.value - self.bend).abs() > tolerance;
        // At a kink of the derivative itself, the second derivative may be that of either side.
        let side = |ahead| ladder.one_sided(ahead, self.weights, self.noise);
        let between = side(true).zip(side(false)).is_some_and(|(a, b)| {
            let off = SAFETY * (a.error + b.error) + self.exact;
            let kink = (a.value - b.value).abs() > off;
            kink && self.bend >= a.value.min(b.value) - off
                && self.bend <= a.value.max(b.value) + off
        });
        (wrong && !between).then_some((e, tolerance))
    }

    /// Returns `true` if another ladder says the same; nothing when it is too coarse to tell.
    fn repeats(&self, again: &Ladder, found: Estimate) -> Option<bool> {
        let covered = again.central(self.weights, self.noise, true)?;
        self.informative(&covered).then(|| {
            self.wrong(again).is_some_and(|(again, _)| {
                (again.value - found.value).abs() <= SAFETY * (again.error + found.error)
            })
        })
    }
}

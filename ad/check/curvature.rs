//! The part of a judgement that takes second derivatives.
use crate::ad::check::judge::{Judge, ROUNDINGS, Row, SAFETY};
use crate::ad::check::sample::Draw;
use crate::ad::check::slope_test::INFORMATIVE;
use crate::ad::check::slopes::{FEW_INPUTS, FIRST};
use crate::ad::check::trace::Trace;
use crate::ad::check::verdict::{Numbers, Reason, Witness};
use crate::ad::check::witness::{Ladder, Probe, dot};

/// Whether a complaint stands: some other ladder repeats it, and none contradicts.
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

impl Judge<'_> {
    /// Second derivatives: through the adjoint, by duals of duals, by differences of the adjoint; those
    /// of a function of `f32` that is known in double precision by duals of duals there instead.
    pub(crate) fn curvature(&mut self, row: &Row, draw: &mut Draw) {
        let subject = self.subject;
        if self.x.is_empty() {
            return;
        }
        let (n, output) = (self.x.len(), row.output);
        let mut random = || -> Vec<f64> {
            self.scales
                .iter()
                .map(|s| s * draw.within(-1.0, 1.0))
                .collect()
        };
        let (u, v) = (random(), random());
        let Some(bend) = subject.curvature(self.x, &row.weights, &v) else {
            return;
        };
        if bend.len() != n {
            self.refuse(Reason::WrongLength(Witness::Adjoint), output, 0);
            return;
        }
        if let Some(i) = bend.iter().position(|b| !b.is_finite()) {
            self.refuse(Reason::NotFinite(Witness::Adjoint), output, i);
            return;
        }
        let scales = &self.units;
        let largest = (0..n)
            .fold(0.0_f64, |m, i| m.max(bend[i].abs() * scales[i]))
            .max((0..n).fold(0.0_f64, |m, i| m.max(row.size[i] * scales[i])));
        let sizes: Vec<f64> = scales.iter().map(|s| largest / s).collect();
        // A whole Hessian row by row is for short inputs.
        let nested_along = |x: &[f64], v: &[f64]| {
            let short = n <= FEW_INPUTS;
            short
                .then(|| subject.second_order(x, &row.weights, v))
                .flatten()
        };
        let by_duals = |x: &[f64]| nested_along(x, &v);
        let spread = std::cell::OnceCell::new();
        let spread = || {
            spread.get_or_init(|| {
                let own = self.spread(&bend, Some(&sizes), |x| {
                    subject.curvature(x, &row.weights, &v)
                });
                let second = by_duals(self.x).unwrap_or_default();
                let other = self.spread(&second, Some(&sizes), by_duals);
                let noise = self.roundings(&bend, &sizes, |seed| {
                    subject.noisy_curvature(self.x, &row.weights, &v, seed)
                });
                // Both are linear in the direction.
                let shorter = self.roundings(&bend, &sizes, |seed| {
                    self.along_shorter(&v, seed, |v| subject.curvature(self.x, &row.weights, v))
                });
                let other_shorter = self.roundings(&second, &sizes, |seed| {
                    self.along_shorter(&v, seed, |v| nested_along(self.x, v))
                });
                let other = |i: usize| {
                    let seen = other.get(i).zip(other_shorter.get(i));
                    seen.map_or(0.0, |(spread, shorter)| spread.max(*shorter))
                };
                (0..n)
                    .map(|i| own[i].max(noise[i]).max(shorter[i]) + other(i))
                    .collect::<Vec<f64>>()
            })
        };
        let exact = |i: usize| 4.0 * ROUNDINGS * self.eps * largest / scales[i];
        let mut faults = Vec::new();
        if let Some(second) = by_duals(self.x) {
            for i in 0..n {
                let gap = (bend[i] - second[i]).abs();
                let mut tolerance = exact(i);
                if gap > tolerance {
                    tolerance += SAFETY * spread()[i];
                }
                if gap > tolerance || gap.is_nan() {
                    let numbers = Numbers {
                        adjoint: Some(bend[i]),
                        dual: Some(second[i]),
                        ..Numbers::default()
                    };
                    let reason = Reason::CurvatureDisagrees(Witness::Dual);
                    faults.push((reason, i, numbers, tolerance));
                }
            }
        }
        let wide = subject.wide().filter(|_| n <= FEW_INPUTS);
        let widely = |x: &[f64]| wide.as_ref()?.second_order(x, &row.weights, &v);
        if let Some(second) = widely(self.x) {
            // Decisions may fall differently in the other format, so other branches count.
            let spread = std::cell::OnceCell::new();
            let theirs = || {
                spread.get_or_init(|| {
                    let own = self.spread(&bend, None, |x| subject.curvature(x, &row.weights, &v));
                    let theirs = self.spread(&second, None, widely);
                    own.iter()
                        .zip(theirs)
                        .map(|(a, b)| a + b)
                        .collect::<Vec<f64>>()
                })
            };
            for i in 0..n {
                let gap = (bend[i] - second[i]).abs();
                let mut tolerance = exact(i);
                if gap > tolerance {
                    tolerance += SAFETY * theirs()[i];
                }
                if gap > tolerance {
                    let numbers = Numbers {
                        adjoint: Some(bend[i]),
                        other: Some(second[i]),
                        ..Numbers::default()
                    };
                    let reason = Reason::CurvatureDisagrees(Witness::Wide);
                    faults.push((reason, i, numbers, tolerance));
                }
            }
        }
        if let Some(other) = subject.curvature(self.x, &row.weights, &u) {
            let (a, b) = (dot(&u, &bend), dot(&v, &other));
            let sum: f64 = (0..n)
                .map(|i| {
                    let size = (u[i] * bend[i]).abs() + (v[i] * other[i]).abs();
                    ROUNDINGS * self.eps * size + (u[i].abs() + v[i].abs()) * exact(i)
                })
                .sum();
            let mut tolerance = sum;
            if (a - b).abs() > tolerance {
                let theirs = self.spread(&other, Some(&sizes), |x| {
                    subject.curvature(x, &row.weights, &u)
                });
                tolerance += (0..n)
                    .map(|i| SAFETY * (u[i].abs() * spread()[i] + v[i].abs() * theirs[i]))
                    .sum::<f64>();
            }
            if (a - b).abs() > tolerance {
                let numbers = Numbers {
                    adjoint: Some(a),
                    other: Some(b),
                    along: true,
                    ..Numbers::default()
                };
                faults.push((Reason::CurvatureNotSymmetric, 0, numbers, tolerance));
            }
        }
        // Differences of slopes in single precision are mostly rounding: double precision has judged.
        if let Some(adjoint) = &row.adjoint
            && subject.wide().is_none()
        {
            let probe = |there: &[f64]| -> Option<(Vec<f64>, Option<Trace>)> {
                if !subject.inside(there) {
                    return None;
                }
                let slopes = subject.adjoint(there, &row.weights)?;
                let usable = slopes.len() == n && slopes.iter().all(|y| y.is_finite());
                usable.then(|| (slopes, subject.traced(there).map(|(_, trace)| trace)))
            };
            let probe: Probe<'_> = &probe;
            let climb = |first| {
                let (x, precision) = (self.x, subject.precision());
                Ladder::climb(probe, precision, x, adjoint, self.trace, &v, first)
            };
            let ladder = climb(FIRST[0]);
            let moved: f64 = (0..n)
                .map(|k| self.x[k].abs() * self.eps * largest / scales[k])
                .sum();
            // Steps are rounded in every number, some of them away; what that does to the slopes is what
            // moving the input by its last digits does.
            let bent = std::cell::OnceCell::new();
            let bent = || {
                bent.get_or_init(|| {
                    let there = |x: &[f64]| subject.adjoint(x, &row.weights);
                    self.spread(adjoint, Some(&sizes), there)
                })
            };
            // One by one, or all of a long input in random combinations.
            let combinations: Vec<Vec<f64>> = if n <= FEW_INPUTS {
                (0..n)
                    .map(|i| (0..n).map(|k| f64::from(u8::from(i == k))).collect())
                    .collect()
            } else {
                (0..4).map(|_| random()).collect()
            };
            for (i, weights) in combinations.into_iter().enumerate() {
                let over = |f: &dyn Fn(usize) -> f64| -> f64 {
                    (0..n).map(|k| weights[k].abs() * f(k)).sum()
                };
                let noise = over(&|k| {
                    self.eps * row.size[k] + row.tolerance[k] / ROUNDINGS + moved / scales[k]
                });
                let size = over(&|k| largest / scales[k]);
                let bend = dot(&weights, &bend);
                let i = if n <= FEW_INPUTS { i } else { 0 };
                let exact = over(&exact);
                let wrong = |ladder: &Ladder, exact: f64, noise: f64| {
                    let e = ladder.central(&weights, noise, true)?;
                    let tolerance = SAFETY * e.error + exact;
                    let wrong = SAFETY * e.error <= INFORMATIVE * size.max(e.value.abs())
                        && (e.value - bend).abs() > tolerance;
                    // Where the slope itself has a kink, the second derivative may be that of either
                    // side.
                    let side = |ahead| ladder.one_sided(ahead, &weights, noise);
                    let between = side(true).zip(side(false)).is_some_and(|(a, b)| {
                        let off = SAFETY * (a.error + b.error) + exact;
                        let kink = (a.value - b.value).abs() > off;
                        kink && bend >= a.value.min(b.value) - off
                            && bend <= a.value.max(b.value) + off
                    });
                    (wrong && !between).then_some((e, tolerance))
                };
                if wrong(&ladder, exact, noise).is_none() {
                    continue;
                }
                let exact = exact + SAFETY * over(&|k| spread()[k]);
                let noise = noise + over(&|k| bent()[k]);
                if let Some((e, tolerance)) = wrong(&ladder, exact, noise)
                    && confirmed(FIRST[1..].iter().map(|&first| {
                        let again = climb(first);
                        let covered = again.central(&weights, noise, true)?;
                        let says =
                            SAFETY * covered.error <= INFORMATIVE * size.max(covered.value.abs());
                        says.then(|| {
                            wrong(&again, exact, noise).is_some_and(|(again, _)| {
                                (again.value - e.value).abs() <= SAFETY * (again.error + e.error)
                            })
                        })
                    }))
                {
                    let numbers = Numbers {
                        adjoint: Some(bend),
                        difference: Some(e.value),
                        along: n > FEW_INPUTS,
                        ..Numbers::default()
                    };
                    let reason = Reason::CurvatureDisagrees(Witness::Difference);
                    faults.push((reason, i, numbers, tolerance));
                }
            }
        }
        for (reason, input, numbers, tolerance) in faults {
            self.refuse_with(reason, None, output, input, numbers, tolerance);
        }
    }
}

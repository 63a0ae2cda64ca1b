//! The adjoint against duals along a direction: `⟨vjp(w), v⟩ = ⟨w, jvp(v)⟩`.
//!
//! One jvp costs about as much as one value, whatever the number of inputs, so this is how duals
//! judge an input too long for a whole Jacobian. No number of the direction is smaller than half a
//! unit: a single derivative that is off by `e` units moves the product by `e / 2` at least, while the
//! product may be off by what all derivatives may be off by together. So among n inputs a single derivative
//! is refused from 32 n roundings of the largest derivative on: 10⁻¹¹ of it for a thousand numbers in
//! double precision. A direction along which they disagree is halved until the number at fault is found.
use crate::ad::check::compare::exact::conventional_border;
use crate::ad::check::evidence::{Combination, Evidence, comparison};
use crate::ad::check::notes::Notes;
use crate::ad::check::subject::Subject;
use crate::ad::check::tolerances::{FEW_INPUTS, PARTS, PROJECTIONS, ROUNDINGS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::{Ladder, dot};
use crate::ad::sample::Draw;
use std::cell::Cell;
use std::ops::Range;

/// The derivatives of two witnesses along a direction.
#[derive(Clone, Copy)]
struct Product {
    adjoint: f64,
    other: f64,
    /// The difference that rounding explains by itself.
    plain: f64,
    /// The same, with the changes that provoked rounding shows.
    tolerance: f64,
}

impl Product {
    fn gap(&self) -> f64 {
        let gap = (self.adjoint - self.other).abs();
        if gap.is_nan() { f64::INFINITY } else { gap }
    }
    /// Returns both derivatives, divided by `per`.
    fn numbers(&self, witness: Witness, per: f64, along: bool) -> ByWitness {
        let other = self.other / per;
        ByWitness {
            adjoint: Some(self.adjoint / per),
            dual: (witness == Witness::Dual).then_some(other),
            other: (witness != Witness::Dual).then_some(other),
            along,
            ..ByWitness::default()
        }
    }
}

/// Returns the direction without the numbers outside a range.
fn part(direction: &[f64], range: &Range<usize>) -> Vec<f64> {
    let keep = |i| {
        if range.contains(&i) {
            direction[i]
        } else {
            0.0
        }
    };
    (0..direction.len()).map(keep).collect()
}

/// Returns the adjoint against duals along random directions, and that of a function of `f32` against
/// its duals in double precision.
pub(crate) fn projections(e: &Evidence<'_>, draw: &mut Draw) -> Notes {
    let (n, subject) = (e.x.len(), e.subject);
    let mut said = Notes::new(n);
    if n == 0 {
        return said;
    }
    let long = n > FEW_INPUTS;
    let wide = e.wide.as_deref().filter(|_| long);
    let largest = e.units.iter().fold(0.0_f64, |m, u| m.max(*u));
    for _ in 0..if long { PROJECTIONS } else { 1 } {
        let direction: Vec<f64> = (e.units.iter())
            .map(|unit| {
                let sign = if draw.once_in(2) { -1.0 } else { 1.0 };
                let length = sign * draw.within(0.5, 1.0) * (unit / largest);
                subject.precision().round(length)
            })
            .collect();
        let mut project = |row, witness, on| {
            let along = Along {
                e,
                row,
                witness,
                on,
                direction: &direction,
                left: Cell::new(PARTS),
            };
            along.project(&mut said);
        };
        for row in &e.rows {
            project(row, Witness::Dual, subject);
            if long {
                project(row, Witness::NumDual, subject);
            }
            if let Some(wide) = wide {
                project(row, Witness::Wide, wide);
            }
        }
    }
    said
}

/// One row along one direction; the duals are those of `on`.
struct Along<'e> {
    e: &'e Evidence<'e>,
    row: &'e Combination,
    witness: Witness,
    on: &'e dyn Subject,
    direction: &'e [f64],
    /// How many more parts may be looked at.
    left: Cell<usize>,
}

impl Along<'_> {
    fn project(&self, said: &mut Notes) {
        let &Along {
            e,
            row,
            witness,
            direction,
            ..
        } = self;
        let Some(whole) = self.product(direction, said) else {
            return;
        };
        let sizes: Vec<f64> = direction.iter().map(|d| d.abs()).collect();
        said.covered.fill(true);
        if row.dual.is_none() {
            let pair = match witness {
                Witness::Dual => 0,
                Witness::NumDual => 6,
                _ => 3,
            };
            let numbers = whole.numbers(witness, 1.0, true);
            let at = comparison(row, 0, numbers, whole.tolerance);
            said.compared(pair, whole.gap(), dot(&row.size, &sizes), e.eps, at);
        }
        let Some((range, last)) = self.search((0..direction.len(), whole), said) else {
            return;
        };
        let input = range.start;
        // One number left: say derivatives rather than products.
        let per = if range.len() == 1 {
            direction[input]
        } else {
            1.0
        };
        if range.len() == 1 && conventional_border(e, row, input) {
            said.convention = true;
            return;
        }
        let numbers = last.numbers(witness, per, range.len() > 1);
        let suspect = (witness == Witness::Wide).then_some(Witness::Adjoint);
        let reason = Reason::Disagree(Witness::Adjoint, witness);
        let tolerance = last.tolerance / per.abs();
        said.complain_of(reason, suspect, (row.output, input), numbers, tolerance);
    }

    /// Returns the smallest part of a direction at which both sides differ by more than they may. Halves are
    /// searched although the whole is within its tolerance: what a few numbers on a kink may be off by
    /// must not hide the others.
    fn search(
        &self,
        (range, product): (Range<usize>, Product),
        said: &mut Notes,
    ) -> Option<(Range<usize>, Product)> {
        if product.gap() <= product.plain {
            return None;
        }
        if range.len() > 1 {
            let middle = usize::midpoint(range.start, range.end);
            let mut halves: Vec<(Range<usize>, Product)> = Vec::new();
            for half in [range.start..middle, middle..range.end] {
                self.left.set(self.left.get().checked_sub(1)?);
                let product = self.product(&part(self.direction, &half), said)?;
                halves.push((half, product));
            }
            halves.sort_by(|a, b| b.1.gap().total_cmp(&a.1.gap()));
            for half in halves {
                let found = self.search(half, said);
                if found.is_some() {
                    return found;
                }
            }
        }
        (product.gap() > product.tolerance).then_some((range, product))
    }

    /// Returns both products along a part of the direction; rounding is provoked when they differ. `None` when
    /// there is nothing to compare, or a length or number that is complained about.
    fn product(&self, direction: &[f64], said: &mut Notes) -> Option<Product> {
        let &Along {
            e,
            row,
            witness,
            on,
            ..
        } = self;
        let adjoint = dot(row.adjoint.as_ref()?, direction);
        let along = |x: &[f64], direction: &[f64]| match witness {
            Witness::NumDual => Some(on.num_dual(x, direction)?.1),
            _ => on.along(x, direction),
        };
        let ahead = along(e.x, direction)?;
        if ahead.len() != e.y.len() {
            said.complain_of_length(witness, row.output, [ahead.len(), e.y.len()]);
            return None;
        }
        if ahead.iter().any(|y| !y.is_finite()) {
            if (row.dual.is_none() && witness == Witness::Dual) || witness == Witness::NumDual {
                said.complain(Reason::NotFinite(witness), row.output, 0);
            }
            return None;
        }
        let other = dot(&row.weights, &ahead);
        let terms: f64 = row
            .weights
            .iter()
            .zip(&ahead)
            .map(|(w, y)| (w * y).abs())
            .sum();
        let sums = ROUNDINGS * e.eps * terms;
        let own = |each: &[f64]| -> f64 {
            let all = direction.iter().zip(each);
            all.map(|(d, each)| d.abs() * each).sum()
        };
        let plain = own(&row.plain) + sums;
        let mut tolerance = row.allowed_along(direction) + sums;
        if (adjoint - other).abs() > plain {
            e.provoke(row);
            e.provoke_widely(row);
            // A tie is decided as it stands: a kink in a single number is no rounding.
            let single = (0..direction.len())
                .map(|i| direction[i].abs() * row.size[i])
                .fold(0.0, f64::max);
            let strict = (witness != Witness::Wide).then_some([single]);
            let spread = e.spread(&[other], strict.as_ref().map(|s| &s[..]), |x| {
                Some(vec![dot(&row.weights, &along(x, direction)?)])
            });
            let own = e.roundings(&[other], &[single], |seed| {
                e.along_shorter(direction, seed, |shorter| {
                    Some(vec![dot(&row.weights, &along(e.x, shorter)?)])
                })
            });
            tolerance = row.allowed_along(direction) + sums + SAFETY * spread[0].max(own[0]);
        }
        Some(Product {
            adjoint,
            other,
            plain,
            tolerance,
        })
    }
}

/// Returns the number of the input at which a derivative that differences refuse along a direction is off
/// most, as far as halving the direction tells.
pub(crate) fn worst_input(
    e: &Evidence<'_>,
    row: &Combination,
    witness: Witness,
    direction: &[f64],
    climb: &dyn Fn(&[f64]) -> Ladder,
) -> usize {
    let excess = |range: &Range<usize>| {
        let there = part(direction, range);
        let derivative = match (witness, &row.adjoint) {
            (Witness::Adjoint, Some(list)) => dot(list, &there),
            _ => e.by_duals(row, &there)?,
        };
        let estimate = climb(&there).central(&row.weights, row.noise, false)?;
        Some((estimate.value - derivative).abs() - SAFETY * estimate.error)
    };
    let mut range = 0..direction.len();
    while range.len() > 1 {
        let middle = usize::midpoint(range.start, range.end);
        let (low, high) = (range.start..middle, middle..range.end);
        range = match (excess(&low), excess(&high)) {
            (Some(a), Some(b)) if b > a => high,
            (Some(_), Some(_)) => low,
            _ => break,
        };
    }
    range.start
}

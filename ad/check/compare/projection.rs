//! The adjoint against duals along a direction: `⟨vjp(w), v⟩ = ⟨w, jvp(v)⟩`.
//!
//! One jvp costs about as much as one value, whatever the number of inputs, so this is how duals judge an input too
//! long for a whole Jacobian. [`judge`](crate::ad::check::judge) calls it, and [`along`](super::along) uses its
//! halving. No number of the direction is smaller than half a unit: a single derivative that is off by `e` units moves
//! the product by `e / 2` at least, while the product may be off by what all derivatives may be off by together. So
//! among n inputs a single derivative is refused from 32 n roundings of the largest derivative on: 10⁻¹¹ of it for a
//! thousand numbers in double precision. A direction along which they disagree is halved until the number at fault is
//! found.
use crate::ad::check::compare::exact::conventional_border;
use crate::ad::check::evidence::{Combination, Evidence, comparison};
use crate::ad::check::notes::Notes;
use crate::ad::check::subject::Subject;
use crate::ad::check::tolerances::{FEW_INPUTS, PARTS, PROJECTIONS, ROUNDINGS, SAFETY};
use crate::ad::check::verdict::{ByWitness, Reason, Witness};
use crate::ad::check::witness::{StepSequence, dot};
use crate::ad::sample::Draw;
use crate::arrays::sort_few;
use std::cell::Cell;
use std::ops::Range;

/// The derivatives of two witnesses along a direction.
#[derive(Clone, Copy)]
struct Product {
    adjoint: f64,
    other: f64,
    /// The difference that rounding explains by itself.
    plain: f64,
    /// The difference that rounding explains with the changes that perturbed rounding shows.
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

/// Compares the adjoint with duals along random directions, and for a function of `f32` with its duals in double
/// precision.
pub(crate) fn projections(e: &Evidence<'_>, draw: &mut Draw) -> Notes {
    let (n, subject) = (e.x.len(), e.subject);
    let mut notes = Notes::new(n);
    if n == 0 {
        return notes;
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
            let along = RowProjection {
                evidence: e,
                row,
                witness,
                on,
                direction: &direction,
                left: Cell::new(PARTS),
            };
            along.project(&mut notes);
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
    notes
}

/// The comparison of one row along one direction; `on` computes the duals.
struct RowProjection<'e> {
    evidence: &'e Evidence<'e>,
    row: &'e Combination,
    witness: Witness,
    on: &'e dyn Subject,
    direction: &'e [f64],
    /// The number of parts that may still be computed.
    left: Cell<usize>,
}

impl RowProjection<'_> {
    fn project(&self, notes: &mut Notes) {
        let &RowProjection {
            evidence: e,
            row,
            witness,
            direction,
            ..
        } = self;
        let Some(whole) = self.product(direction, notes) else {
            return;
        };
        let sizes: Vec<f64> = direction.iter().map(|d| d.abs()).collect();
        notes.judged.fill(true);
        if row.dual.is_none() {
            let pair = match witness {
                Witness::Dual => 0,
                Witness::NumDual => 6,
                _ => 3,
            };
            let numbers = whole.numbers(witness, 1.0, true);
            let at = comparison(row, 0, numbers, whole.tolerance);
            notes.compared(pair, whole.gap(), dot(&row.size, &sizes), e.eps, at);
        }
        let Some((range, last)) = self.search((0..direction.len(), whole), notes) else {
            return;
        };
        let input = range.start;
        // With one number left the fault shows derivatives rather than products.
        let per = if range.len() == 1 {
            direction[input]
        } else {
            1.0
        };
        if range.len() == 1 && conventional_border(e, row, input) {
            notes.convention = true;
            return;
        }
        let numbers = last.numbers(witness, per, range.len() > 1);
        let suspect = (witness == Witness::Wide).then_some(Witness::Adjoint);
        let reason = Reason::Disagree(Witness::Adjoint, witness);
        let tolerance = last.tolerance / per.abs();
        notes.add_fault_with(reason, suspect, (row.output, input), numbers, tolerance);
    }

    /// Returns the smallest part of a direction along which both products differ by more than they may. Halves are
    /// searched although the whole is within its tolerance: the large tolerance of a few numbers on a kink must not
    /// hide the others.
    fn search(
        &self,
        (range, product): (Range<usize>, Product),
        notes: &mut Notes,
    ) -> Option<(Range<usize>, Product)> {
        if product.gap() <= product.plain {
            return None;
        }
        if range.len() > 1 {
            let middle = usize::midpoint(range.start, range.end);
            let mut halves: Vec<(Range<usize>, Product)> = Vec::new();
            for half in [range.start..middle, middle..range.end] {
                self.left.set(self.left.get().checked_sub(1)?);
                let product = self.product(&part(self.direction, &half), notes)?;
                halves.push((half, product));
            }
            sort_few(&mut halves, |a, b| b.1.gap().total_cmp(&a.1.gap()).is_lt());
            for half in halves {
                let found = self.search(half, notes);
                if found.is_some() {
                    return found;
                }
            }
        }
        (product.gap() > product.tolerance).then_some((range, product))
    }

    /// Returns both products along a part of the direction; rounding is perturbed when they differ. `None` if there is
    /// nothing to compare, or if a length or number is a fault of its own.
    fn product(&self, direction: &[f64], notes: &mut Notes) -> Option<Product> {
        let &RowProjection {
            evidence: e,
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
            notes.add_length_fault(witness, row.output, [ahead.len(), e.y.len()]);
            return None;
        }
        if ahead.iter().any(|y| !y.is_finite()) {
            if (row.dual.is_none() && witness == Witness::Dual) || witness == Witness::NumDual {
                notes.add_fault(Reason::NotFinite(witness), row.output, 0);
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
            e.perturb(row);
            e.perturb_in_double(row);
            // A tie is decided as it stands: a kink in a single number is no rounding.
            let single = (0..direction.len())
                .map(|i| direction[i].abs() * row.size[i])
                .fold(0.0, f64::max);
            let strict = (witness != Witness::Wide).then_some([single]);
            let deviation = e.deviation(&[other], strict.as_ref().map(|s| &s[..]), |x| {
                Some(vec![dot(&row.weights, &along(x, direction)?)])
            });
            let own = e.roundings(&[other], &[single], |seed| {
                e.along_shorter(direction, seed, |shorter| {
                    Some(vec![dot(&row.weights, &along(e.x, shorter)?)])
                })
            });
            tolerance = row.allowed_along(direction) + sums + SAFETY * deviation[0].max(own[0]);
        }
        Some(Product {
            adjoint,
            other,
            plain,
            tolerance,
        })
    }
}

/// Returns the number of the input whose derivative is off most, when differences refuse the derivative along a
/// direction. Halving the direction finds it approximately.
pub(crate) fn worst_input(
    e: &Evidence<'_>,
    row: &Combination,
    witness: Witness,
    direction: &[f64],
    take_steps: &dyn Fn(&[f64]) -> StepSequence,
) -> usize {
    let excess = |range: &Range<usize>| {
        let there = part(direction, range);
        let derivative = match (witness, &row.adjoint) {
            (Witness::Adjoint, Some(list)) => dot(list, &there),
            _ => e.by_duals(row, &there)?,
        };
        let estimate = take_steps(&there).central(&row.weights, row.noise, false)?;
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

//! The part of a judgement that projects: `⟨vjp(w), v⟩ = ⟨w, jvp(v)⟩`.
//!
//! One jvp costs about as much as one value, whatever the number of inputs, so this is how duals
//! judge an input too long for a whole Jacobian. No number of the direction is smaller than half a
//! unit: a single slope that is off by `e` units moves the product by `e / 2` at least, while the
//! product may be off by what all slopes may be off by together. So among n inputs a single slope
//! is refused from 32 n roundings of the largest slope on: 10⁻¹¹ of it for a thousand numbers in
//! double precision. What does not agree is halved until the number at fault is found.
use crate::ad::check::judge::{Judge, ROUNDINGS, Row, SAFETY};
use crate::ad::check::sample::Draw;
use crate::ad::check::slopes::FEW_INPUTS;
use crate::ad::check::subject::Subject;
use crate::ad::check::verdict::{Nearest, Numbers, Reason, Witness};
use crate::ad::check::witness::{Ladder, dot};
use std::ops::Range;

/// Random directions for an input whose Jacobian is too large. Two slopes that are both wrong
/// cancel along one of them with probability zero; more only guard against that.
const DIRECTIONS: usize = 3;

/// How many parts of a direction are looked at in search of the number at fault.
const PARTS: usize = 256;

/// What both sides say along a direction.
#[derive(Clone, Copy)]
struct Product {
    adjoint: f64,
    other: f64,
    /// What rounding explains by itself.
    plain: f64,
    /// With what provoked rounding shows.
    tolerance: f64,
}

impl Product {
    fn gap(&self) -> f64 {
        let gap = (self.adjoint - self.other).abs();
        if gap.is_nan() { f64::INFINITY } else { gap }
    }
    /// What both say, per so much of the direction.
    fn numbers(&self, witness: Witness, per: f64, along: bool) -> Numbers {
        let other = self.other / per;
        Numbers {
            adjoint: Some(self.adjoint / per),
            dual: (witness == Witness::Dual).then_some(other),
            other: (witness != Witness::Dual).then_some(other),
            along,
            ..Numbers::default()
        }
    }
}

/// The direction without the numbers outside a range.
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

impl Judge<'_> {
    /// The adjoint against duals along random directions, and that of a function of `f32` against
    /// its duals in double precision.
    pub(crate) fn projections(&mut self, rows: &mut [Row], draw: &mut Draw) {
        let (n, subject) = (self.x.len(), self.subject);
        if n == 0 || self.found.convention || !self.pending.is_empty() {
            return;
        }
        let long = n > FEW_INPUTS;
        let wide = subject.wide().filter(|_| long);
        let largest = self.units.iter().fold(0.0_f64, |m, u| m.max(*u));
        for _ in 0..if long { DIRECTIONS } else { 1 } {
            let direction: Vec<f64> = (self.units.iter())
                .map(|unit| {
                    let sign = if draw.once_in(2) { -1.0 } else { 1.0 };
                    let length = sign * draw.within(0.5, 1.0) * (unit / largest);
                    subject.precision().round(length)
                })
                .collect();
            for row in rows.iter_mut() {
                self.project(row, Witness::Dual, subject, &direction);
                if let Some(wide) = &wide {
                    self.project(row, Witness::Wide, wide.as_ref(), &direction);
                }
            }
        }
    }

    /// One row along one direction; the duals are those of `on`.
    fn project(&mut self, row: &mut Row, witness: Witness, on: &dyn Subject, direction: &[f64]) {
        let Some(whole) = self.product(row, witness, on, direction) else {
            return;
        };
        let size: f64 = dot(
            &row.size,
            &direction.iter().map(|d| d.abs()).collect::<Vec<_>>(),
        );
        self.found.covered.fill(true);
        if row.dual.is_none() {
            let pair = if witness == Witness::Dual { 0 } else { 3 };
            let at = Nearest {
                output: row.output,
                numbers: whole.numbers(witness, 1.0, true),
                tolerance: whole.tolerance,
                provoked: row.provoked,
                ..Nearest::default()
            };
            self.found.worst[pair].note(whole.gap(), size, self.eps, at);
        }
        let all = 0..direction.len();
        let mut left = PARTS;
        let Some((range, last)) = self.search(row, witness, on, direction, (all, whole), &mut left)
        else {
            return;
        };
        let input = range.start;
        // One number left: say slopes rather than products.
        let per = if range.len() == 1 {
            direction[input]
        } else {
            1.0
        };
        if range.len() == 1 && self.conventional_border(row, input) {
            self.found.convention = true;
            return;
        }
        let numbers = last.numbers(witness, per, range.len() > 1);
        let suspect = (witness == Witness::Wide).then_some(Witness::Adjoint);
        let reason = Reason::Disagree(Witness::Adjoint, witness);
        let tolerance = last.tolerance / per.abs();
        self.refuse_with(reason, suspect, row.output, input, numbers, tolerance);
    }

    /// The smallest part of a direction at which both sides differ by more than they may. Halves are
    /// searched although the whole is within its tolerance: what a few numbers on a kink may be off by
    /// must not hide the others.
    fn search(
        &mut self,
        row: &mut Row,
        witness: Witness,
        on: &dyn Subject,
        direction: &[f64],
        (range, product): (Range<usize>, Product),
        left: &mut usize,
    ) -> Option<(Range<usize>, Product)> {
        if product.gap() <= product.plain {
            return None;
        }
        if range.len() > 1 {
            let middle = usize::midpoint(range.start, range.end);
            let mut halves: Vec<(Range<usize>, Product)> = Vec::new();
            for half in [range.start..middle, middle..range.end] {
                *left = left.checked_sub(1)?;
                let product = self.product(row, witness, on, &part(direction, &half))?;
                halves.push((half, product));
            }
            halves.sort_by(|a, b| b.1.gap().total_cmp(&a.1.gap()));
            for (half, product) in halves {
                let found = self.search(row, witness, on, direction, (half, product), left);
                if found.is_some() {
                    return found;
                }
            }
        }
        (product.gap() > product.tolerance).then_some((range, product))
    }

    /// The slope of a row along a direction by duals.
    pub(crate) fn by_duals(&self, row: &Row, direction: &[f64]) -> Option<f64> {
        let ahead = self.subject.along(self.x, direction)?;
        let usable = ahead.len() == self.y.len() && ahead.iter().all(|y| y.is_finite());
        usable.then(|| dot(&row.weights, &ahead))
    }

    /// The number of the input at which a slope that differences refuse along a direction is off
    /// most, as far as halving the direction tells.
    pub(crate) fn worst_input(
        &self,
        row: &Row,
        witness: Witness,
        direction: &[f64],
        climb: &dyn Fn(&[f64]) -> Ladder,
    ) -> usize {
        let excess = |range: &Range<usize>| {
            let there = part(direction, range);
            let slope = match (witness, &row.adjoint) {
                (Witness::Adjoint, Some(list)) => dot(list, &there),
                _ => self.by_duals(row, &there)?,
            };
            let estimate = climb(&there).central(&row.weights, row.noise, false)?;
            Some((estimate.value - slope).abs() - SAFETY * estimate.error)
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

    /// Both products along a direction; rounding is provoked when they differ. `None` when there
    /// is nothing to compare, or a length or number that was refused.
    fn product(
        &mut self,
        row: &mut Row,
        witness: Witness,
        on: &dyn Subject,
        direction: &[f64],
    ) -> Option<Product> {
        let adjoint = dot(row.adjoint.as_ref()?, direction);
        let ahead = on.along(self.x, direction)?;
        if ahead.len() != self.y.len() {
            self.refuse(Reason::WrongLength(witness), row.output, 0);
            return None;
        }
        if ahead.iter().any(|y| !y.is_finite()) {
            if row.dual.is_none() && witness == Witness::Dual {
                self.refuse(Reason::NotFinite(witness), row.output, 0);
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
        let allowed = |each: &dyn Fn(usize) -> f64| {
            let own: f64 = (0..direction.len())
                .map(|i| direction[i].abs() * each(i))
                .sum();
            own + ROUNDINGS * self.eps * terms
        };
        let plain = allowed(&|i| row.plain[i]);
        let mut tolerance = allowed(&|i| row.tolerance[i]);
        if (adjoint - other).abs() > plain {
            self.provoke(row);
            self.provoke_widely(row);
            // A tie is decided as it stands: a kink in a single number is no rounding.
            let single = (0..direction.len())
                .map(|i| direction[i].abs() * row.size[i])
                .fold(0.0, f64::max);
            let strict = (witness == Witness::Dual).then_some([single]);
            let spread = self.spread(&[other], strict.as_ref().map(|s| &s[..]), |x| {
                Some(vec![dot(&row.weights, &on.along(x, direction)?)])
            });
            let own = self.roundings(&[other], &[single], |seed| {
                self.along_shorter(direction, seed, |shorter| {
                    Some(vec![dot(&row.weights, &on.along(self.x, shorter)?)])
                })
            });
            tolerance = allowed(&|i| row.tolerance[i]) + SAFETY * spread[0].max(own[0]);
        }
        Some(Product {
            adjoint,
            other,
            plain,
            tolerance,
        })
    }
}

//! The evidence about a function at one input: values, derivatives, branches and neighbouring inputs.
//! [`judge`](crate::ad::check::judge) gathers it once, before anything is compared. Comparisons read it and write
//! [notes](crate::ad::check::notes).
use crate::ad::check::notes::Notes;
use crate::ad::check::subject::Subject;
use crate::ad::check::tolerances::{
    COMBINATIONS, FEW_INPUTS, FEW_OUTPUTS, NOISE_ROUNDS, ROUNDINGS, ROUNDS,
};
use crate::ad::check::trace::Trace;
use crate::ad::check::verdict::{ByWitness, Reason, Tightest, Witness};
use crate::ad::check::witness::{Precision, combined, dot, perturbed};
use crate::ad::sample::Draw;
use std::cell::{Cell, RefCell};

/// The derivatives of one combination of the outputs.
pub(crate) struct Combination {
    pub(crate) weights: Vec<f64>,
    pub(crate) output: usize,
    pub(crate) adjoint: Option<Vec<f64>>,
    pub(crate) dual: Option<Vec<f64>>,
    /// The error that plain rounding allows both together, per input.
    pub(crate) plain: Vec<f64>,
    /// The error with the changes that perturbed rounding shows, once it was perturbed.
    pub(crate) tolerance: RefCell<Vec<f64>>,
    /// `true` once rounding was perturbed; the next two for double precision and for exchanged arguments.
    pub(crate) perturbed: Cell<bool>,
    pub(crate) perturbed_in_double: Cell<bool>,
    pub(crate) perturbed_exchanged: Cell<bool>,
    /// The typical size of the derivative by each input: `largest` by units in place of scales, divided by the input's
    /// unit.
    pub(crate) size: Vec<f64>,
    /// The largest of the combined value and all derivatives times their scales.
    pub(crate) largest: f64,
    /// Rounding noise of the combined value.
    pub(crate) noise: f64,
}

impl Combination {
    /// Returns the largest difference of two exact derivatives with respect to an input.
    pub(crate) fn allowed(&self, input: usize) -> f64 {
        self.tolerance.borrow()[input]
    }
    /// Returns the largest difference of two exact derivatives along a direction.
    pub(crate) fn allowed_along(&self, direction: &[f64]) -> f64 {
        let tolerance = self.tolerance.borrow();
        let each = direction.iter().zip(tolerance.iter());
        each.map(|(d, tolerance)| d.abs() * tolerance).sum()
    }
    /// Adds to the tolerance of each input.
    pub(crate) fn allow(&self, more: impl Fn(usize) -> f64) {
        for (i, tolerance) in self.tolerance.borrow_mut().iter_mut().enumerate() {
            *tolerance += more(i);
        }
    }
}

/// The branches of a neighbouring input, compared with those of the judged input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Neighbour {
    /// The same branches.
    Same,
    /// Equal numbers stayed equal, so a change of branch comes from rounding.
    Tied,
    /// Numbers moved independently: an exact tie may have been broken.
    Loose,
}

/// Everything known of a function at an input.
pub(crate) struct Evidence<'a> {
    pub(crate) subject: &'a dyn Subject,
    /// The function in double precision, if it computes in single and is known there.
    pub(crate) wide: Option<Box<dyn Subject + 'a>>,
    pub(crate) x: &'a [f64],
    pub(crate) y: Vec<f64>,
    /// The branches the value took, where they are known.
    pub(crate) trace: Option<Trace>,
    /// The value on traced numbers.
    pub(crate) traced: Option<Vec<f64>>,
    pub(crate) scales: Vec<f64>,
    pub(crate) units: Vec<f64>,
    pub(crate) eps: f64,
    /// The error of each output that the function declares for its values.
    pub(crate) resolution: Vec<f64>,
    /// The error of outputs by terms that cancel, as the function declares it; only another format shows it.
    pub(crate) cancelled: f64,
    /// `true` for outputs that single precision holds with fewer than all digits, or as its largest number. Only the
    /// size of their values is judged ([`resolution`](Evidence::resolution)); derivatives pulled back through them have
    /// no digits to judge.
    pub(crate) off_scale: Vec<bool>,
    /// Inputs near `x` in the domain, each with the relation of its branches to those of `x`.
    pub(crate) around: Vec<(Vec<f64>, Neighbour)>,
    /// The derivatives; empty until they are [gathered](Evidence::gather_derivatives).
    pub(crate) rows: Vec<Combination>,
}

/// Returns `true` if all numbers are finite.
pub(crate) fn finite(list: &[f64]) -> bool {
    list.iter().all(|x| x.is_finite())
}

/// Returns `true` if two lists have the same bits.
pub(crate) fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

impl<'a> Evidence<'a> {
    /// Gathers the values at an input. Returns `None` if there is nothing to judge, and adds the reason to `notes` if
    /// it is a fault of the function.
    pub(crate) fn of_values(
        subject: &'a dyn Subject,
        x: &'a [f64],
        notes: &mut Notes,
    ) -> Option<Self> {
        if !subject.inside(x) {
            return None;
        }
        let y = subject.value(x);
        if !finite(&y) {
            notes.add_fault(Reason::NotFinite(Witness::Value), 0, 0);
            return None;
        }
        if !same_bits(&y, &subject.value(x)) {
            notes.add_fault(Reason::Impure(Witness::Value), 0, 0);
        }
        let wide = subject.wide();
        let off_scale = off_scale(wide.as_deref(), x, y.len());
        let (traced, trace) = subject.traced(x).unzip();
        let rounding = subject.rounding(x);
        let around = (0..ROUNDS).filter_map(|round| {
            let there = perturbed(subject.precision(), x, &rounding, round);
            subject.inside(&there).then(|| {
                let same = trace.is_some_and(|here: Trace| {
                    let there = subject.traced(&there);
                    there.is_some_and(|(_, trace)| trace.hash == here.hash)
                });
                let same = match (same, round % 3) {
                    (true, _) => Neighbour::Same,
                    (false, 1) => Neighbour::Loose,
                    (false, _) => Neighbour::Tied,
                };
                (there, same)
            })
        });
        let around = around.collect();
        let eps = subject.precision().epsilon();
        let cancelled = eps * subject.roundings(x);
        Some(Evidence {
            subject,
            wide,
            x,
            scales: subject.scales(x),
            units: subject.units(x),
            eps,
            resolution: resolution(subject, &y, &off_scale),
            cancelled,
            off_scale,
            y,
            trace,
            traced,
            around,
            rows: Vec::new(),
        })
    }

    /// Gathers the derivatives by hand and by duals. Returns `false` if nothing can be compared, and adds the reason to
    /// `notes`, unless all outputs are [off scale](Evidence::off_scale).
    pub(crate) fn gather_derivatives(&mut self, draw: &mut Draw, notes: &mut Notes) -> bool {
        let (n, m) = (self.x.len(), self.y.len());
        let jacobian = if n <= FEW_INPUTS {
            self.subject.jacobian(self.x)
        } else {
            None
        };
        if let Some(jacobian) = &jacobian {
            let wrong = jacobian.iter().find(|row| row.len() != n);
            if jacobian.len() != m || wrong.is_some() {
                let (got, wanted) = match wrong {
                    Some(row) => (row.len(), n),
                    None => (jacobian.len(), m),
                };
                notes.add_length_fault(Witness::Dual, 0, [got, wanted]);
                return false;
            }
            if let Some(j) = jacobian.iter().position(|row| !finite(row)) {
                notes.add_fault(Reason::NotFinite(Witness::Dual), j, 0);
            }
        }
        for (output, weights) in self.combinations(draw).into_iter().enumerate() {
            // An output may be off scale by design, such as the exit of a ray that never leaves: only combinations without
            // it are judged.
            let mut used = weights.iter().zip(&self.off_scale);
            if used.any(|(weight, off)| *off && *weight != 0.0) {
                continue;
            }
            let adjoint = self.subject.adjoint(self.x, &weights);
            if let Some(adjoint) = &adjoint {
                if adjoint.len() != n {
                    notes.add_length_fault(Witness::Adjoint, output, [adjoint.len(), n]);
                    return false;
                }
                if let Some(i) = adjoint.iter().position(|x| !x.is_finite()) {
                    notes.add_fault(Reason::NotFinite(Witness::Adjoint), output, i);
                    return false;
                }
                let again = self.subject.adjoint(self.x, &weights);
                if again.is_none_or(|again| !same_bits(adjoint, &again)) {
                    notes.add_fault(Reason::Impure(Witness::Adjoint), output, 0);
                }
            }
            let dual = jacobian
                .as_ref()
                .map(|jacobian| combined(&weights, jacobian, n));
            if dual.as_ref().is_some_and(|dual| !finite(dual)) {
                return false;
            }
            let row = self.row(output, weights, adjoint, dual);
            self.rows.push(row);
        }
        m == 0 || !self.rows.is_empty()
    }

    /// Returns every output by itself, or random combinations of many.
    fn combinations(&self, draw: &mut Draw) -> Vec<Vec<f64>> {
        let m = self.y.len();
        if m <= FEW_OUTPUTS {
            let one = |j| (0..m).map(|k| f64::from(u8::from(j == k))).collect();
            return (0..m).map(one).collect();
        }
        // Quarters, which single precision has, too.
        let mut one = || {
            let mut weight = || draw.within(-8.0, 8.0).round() / 4.0;
            // One output off scale would spoil every combination.
            let of = |&off: &bool| if off { 0.0 } else { weight() };
            self.off_scale.iter().map(of).collect()
        };
        (0..COMBINATIONS).map(|_| one()).collect()
    }

    fn row(
        &self,
        output: usize,
        weights: Vec<f64>,
        adjoint: Option<Vec<f64>>,
        dual: Option<Vec<f64>>,
    ) -> Combination {
        let n = self.x.len();
        let derivative = |i: usize| {
            let a = adjoint.as_ref().map_or(0.0, |a| a[i].abs());
            dual.as_ref().map_or(a, |d| d[i].abs().max(a))
        };
        let value = dot(&weights, &self.y).abs();
        let largest_per = |unit: &[f64]| (0..n).fold(value, |m, i| m.max(derivative(i) * unit[i]));
        let (largest, per_unit) = (largest_per(&self.scales), largest_per(&self.units));
        let size: Vec<f64> = self.units.iter().map(|unit| per_unit / unit).collect();
        let comparable = self.subject.comparable();
        let plain: Vec<f64> = (0..n)
            .map(|i| if comparable { size[i] } else { derivative(i) })
            .map(|size| ROUNDINGS * self.eps * size + f64::MIN_POSITIVE)
            .collect();
        Combination {
            noise: self.noise(&weights, adjoint.as_deref().or(dual.as_deref())),
            weights,
            output,
            adjoint,
            dual,
            tolerance: RefCell::new(plain.clone()),
            plain,
            size,
            largest,
            perturbed: Cell::new(false),
            perturbed_in_double: Cell::new(false),
            perturbed_exchanged: Cell::new(false),
        }
    }

    /// Returns the rounding noise of a combined value: the change at neighbouring inputs that the derivative does not
    /// explain, and at least the error that the function declares.
    fn noise(&self, weights: &[f64], derivatives: Option<&[f64]>) -> f64 {
        let here = dot(weights, &self.y);
        let terms = |y: &[f64]| -> f64 { weights.iter().zip(y).map(|(w, y)| (w * y).abs()).sum() };
        let mut noise = (self.eps * terms(&self.y)).max(terms(&self.resolution));
        for (there, _) in self.around.iter().take(NOISE_ROUNDS) {
            let change = dot(weights, &self.subject.value(there)) - here;
            let by_derivative = derivatives.map_or(0.0, |derivatives| {
                (0..self.x.len())
                    .map(|i| derivatives[i] * (there[i] - self.x[i]))
                    .sum()
            });
            let left = (change - by_derivative).abs().min(change.abs());
            if left.is_finite() {
                noise = noise.max(left);
            }
        }
        noise
    }

    /// Returns the function on which steps are taken: in double precision if it is known there.
    pub(crate) fn on(&self) -> &dyn Subject {
        self.wide.as_deref().unwrap_or(self.subject)
    }

    /// Returns `true` if the input is a tie of the source, to the bit. A search may compare equal numbers that decide nothing:
    /// its input is a tie if another one within roundings has other branches.
    pub(crate) fn exactly_tied(&self) -> bool {
        let Some(trace) = self.trace else {
            return false;
        };
        match self.subject.conventions().searches {
            true => (self.around.iter()).any(|(_, neighbour)| *neighbour != Neighbour::Same),
            false => trace.margin == 0.0,
        }
    }

    /// Returns `true` if the duals may be wrong because the input is an exact tie of their source, of which they take a
    /// share although it may be no kink of the function. The adjoint is judged anyway.
    pub(crate) fn tie_of_duals(&self) -> bool {
        self.exactly_tied() && !self.subject.conventions().shared_ties
    }
}

/// The smallest number of single precision that has all digits.
pub(crate) const SMALLEST: f64 = f32::MIN_POSITIVE as f64;
/// Its largest number.
const LARGEST: f64 = f32::MAX as f64;

/// Returns the error of each output by the way it is computed, as the function declares it.
fn resolution(subject: &dyn Subject, y: &[f64], off_scale: &[bool]) -> Vec<f64> {
    let mut own = subject.resolution(y);
    own.resize(y.len(), 0.0);
    for (own, _) in own.iter_mut().zip(off_scale).filter(|(_, off)| **off) {
        *own = own.max(SMALLEST);
    }
    own
}

/// Returns which results of single precision are below the smallest normal number, as the fourth power of a small
/// length is, or above the largest number. Zeros are included if all others are too small.
fn off_scale(wide: Option<&dyn Subject>, x: &[f64], outputs: usize) -> Vec<bool> {
    let small = |y: &f64| *y != 0.0 && y.abs() < SMALLEST;
    let values = wide.map_or(Vec::new(), |wide| wide.value(x));
    let mut all: Vec<bool> = values.iter().map(small).collect();
    if all.contains(&true) && values.iter().all(|y| y.abs() < SMALLEST) {
        all.fill(true);
    }
    for (off, y) in all.iter_mut().zip(&values) {
        *off |= y.abs() > LARGEST;
    }
    all.resize(outputs, false);
    all
}

impl Evidence<'_> {
    /// Returns `true` if two numbers are both saturated: above the largest number of single precision, with one sign.
    pub(crate) fn both_saturated(&self, one: f64, other: f64) -> bool {
        let most = one.abs().min(other.abs());
        self.subject.precision() == Precision::F32
            && most >= LARGEST
            && (one > 0.0) == (other > 0.0)
    }
}

/// Returns a comparison at an output and an input, without its share of the tolerance.
pub(crate) fn comparison(
    row: &Combination,
    input: usize,
    numbers: ByWitness,
    tolerance: f64,
) -> Tightest {
    Tightest {
        output: row.output,
        input,
        numbers,
        tolerance,
        perturbed: row.perturbed.get(),
        ..Tightest::default()
    }
}

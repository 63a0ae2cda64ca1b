//! The interface of a function under test: lists of numbers in, lists of numbers out. `closures`, `second_order` and
//! `kernels/check` implement [`Subject`]; all comparisons call it.
use crate::ad::check::certificate::Proof;
use crate::ad::check::tolerances::{LEAST_SCALE, NO_UNIT};
use crate::ad::check::trace::Trace;
use crate::ad::check::witness::Precision;
pub use crate::ad::declared::Jumps;
use crate::ad::declared::{Invariance, Kind};

/// The conventions of a function at points without a derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Conventions {
    /// `true` if the derivative may be zero where the value is zero, or where the input lies on the border of its
    /// domain, although zero is not between the derivatives of both sides.
    pub flat: bool,
    /// The points at which the value may jump.
    pub jumps: Jumps,
    /// `true` if at a tie the derivative by hand must equal that of the duals, and not another one between the
    /// derivatives of both sides.
    pub shared_ties: bool,
    /// `true` if the function searches, and its derivatives are those of the choice that it finds. If several choices
    /// tie to the bit, the derivatives need not be between those of both sides. More choices tie than the two on either
    /// side: between two boxes of one heading, many pairs of points are nearest. It counts at exact ties of the source
    /// only.
    pub searches: bool,
}

/// A function near one input, with all its derivatives by different methods. All lists are `f64`; a function of `f32`
/// gets only inputs that are `f32` numbers, and its results are such numbers.
///
/// Only [`value`](Subject::value) is required. A method that returns `None` is not checked.
pub trait Subject {
    /// Returns the format the function computes in.
    fn precision(&self) -> Precision;
    /// Returns the value at an input.
    fn value(&self, x: &[f64]) -> Vec<f64>;
    /// Returns the values by other paths.
    fn other_values(&self, _x: &[f64]) -> Vec<Vec<f64>> {
        Vec::new()
    }
    /// Returns the derivatives of `y_bar · value` by hand.
    fn adjoint(&self, _x: &[f64], _y_bar: &[f64]) -> Option<Vec<f64>> {
        None
    }
    /// Returns the derivative by hand with every rounding drawn from a seed ([`noise`](crate::ad::check::noise)).
    fn noisy(&self, _x: &[f64], _y_bar: &[f64], _seed: u64) -> Option<Vec<f64>> {
        None
    }
    /// Returns the derivatives of `y_bar · value` by further witnesses: a fused path, a GPU.
    fn further(&self, _x: &[f64], _y_bar: &[f64]) -> Vec<Vec<f64>> {
        Vec::new()
    }
    /// Returns the derivative by a further witness, by its position, with every rounding drawn from a seed.
    fn noisy_further(
        &self,
        _x: &[f64],
        _y_bar: &[f64],
        _position: usize,
        _seed: u64,
    ) -> Option<Vec<f64>> {
        None
    }
    /// Returns the number of forms of batches that [`batch`](Subject::batch) computes.
    fn forms(&self) -> usize {
        0
    }
    /// Returns value and derivatives of `y_bar · value` from a batch of a form, on the CPU or a GPU.
    fn batch(&self, _form: usize, _x: &[f64], _y_bar: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        None
    }
    /// Returns the Jacobian by duals, one row per output.
    fn jacobian(&self, _x: &[f64]) -> Option<Vec<Vec<f64>>> {
        None
    }
    /// Returns the value that duals carry.
    fn dual_values(&self, _x: &[f64]) -> Option<Vec<f64>> {
        None
    }
    /// Returns the derivatives of all outputs along a direction by duals: the Jacobian times the direction, for
    /// inputs too long for a whole one.
    fn along(&self, _x: &[f64], _direction: &[f64]) -> Option<Vec<f64>> {
        None
    }
    /// Returns values and the derivatives of all outputs along a direction by num-dual's own dual numbers: another
    /// implementation of duals, for derivatives by hand.
    fn num_dual(&self, _x: &[f64], _direction: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        None
    }
    /// Returns the value and trace of the generic source on traced numbers.
    fn traced(&self, _x: &[f64]) -> Option<(Vec<f64>, Trace)> {
        None
    }
    /// Returns the values and traces at many inputs; nothing if one of them has none.
    fn traced_all(&self, inputs: &[Vec<f64>]) -> Option<Vec<(Vec<f64>, Trace)>> {
        inputs.iter().map(|x| self.traced(x)).collect()
    }
    /// Returns the Hessian of `y_bar · value` times a direction, through the adjoint.
    fn curvature(&self, _x: &[f64], _y_bar: &[f64], _direction: &[f64]) -> Option<Vec<f64>> {
        None
    }
    /// Returns the Hessian times a direction, through the adjoint, with every rounding drawn from a seed.
    fn noisy_curvature(
        &self,
        _x: &[f64],
        _y_bar: &[f64],
        _direction: &[f64],
        _seed: u64,
    ) -> Option<Vec<f64>> {
        None
    }
    /// Returns the Hessian of `y_bar · value` times a direction, by duals of duals of the value.
    fn second_order(&self, _x: &[f64], _y_bar: &[f64], _direction: &[f64]) -> Option<Vec<f64>> {
        None
    }
    /// Returns this function in double precision, if it computes in single.
    fn wide(&self) -> Option<Box<dyn Subject + '_>> {
        None
    }
    /// Returns the proof of the value, if it is a distance in space.
    fn proof(&self, _x: &[f64]) -> Option<Proof> {
        None
    }
    /// Returns `true` if an input is valid.
    fn inside(&self, _x: &[f64]) -> bool {
        true
    }
    /// Returns `true` if the function may be evaluated at invalid inputs, too. At the border of its domain that shows
    /// both sides of a kink that lies exactly there.
    fn total(&self) -> bool {
        false
    }
    /// Returns for each number the length over which the function may be expected to change.
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        default_scales(x)
    }
    /// Returns `true` if the scales are only guessed from the numbers.
    fn guessed_scales(&self) -> bool {
        false
    }
    /// Returns for each number its unit. Derivatives times units are comparable, and a derivative is right to within
    /// the rounding of the largest of them.
    fn units(&self, x: &[f64]) -> Vec<f64> {
        self.scales(x)
    }
    /// Returns `true` if the components of the gradient, scaled by the units of their inputs, can be compared with the
    /// largest one: each may then have its rounding. Otherwise every derivative is judged by its own digits and by
    /// perturbed rounding.
    fn comparable(&self) -> bool {
        false
    }
    /// Returns for each number its backward error: the perturbation of the input that may explain the function's
    /// rounding. By default it is the rounding of the number itself; functions that add numbers of one unit may use
    /// that of the largest of them.
    fn rounding(&self, x: &[f64]) -> Vec<f64> {
        let eps = self.precision().epsilon();
        x.iter().map(|x| eps * x.abs()).collect()
    }
    /// Returns the error that each number of the result `y` may have by the way it is computed, beyond rounding: a
    /// table, an iteration.
    fn resolution(&self, y: &[f64]) -> Vec<f64> {
        vec![0.0; y.len()]
    }
    /// Returns the number of roundings of the format that results at `x` may be off by terms that cancel, times the
    /// size of these terms. Derivatives may be off by that number over the [units](Subject::units).
    fn roundings(&self, x: &[f64]) -> f64 {
        let _ = x;
        0.0
    }
    /// Returns the kind of each number; only invariances need it.
    fn kinds(&self) -> Vec<Kind> {
        Vec::new()
    }
    /// Returns the kind of each number of the result; only results that
    /// [follow](crate::ad::check::symmetry::Effect::Follows) need it. Numbers without a kind stay where they are.
    fn output_kinds(&self) -> Vec<Kind> {
        Vec::new()
    }
    /// Returns the function's invariances under motions.
    fn invariances(&self) -> &[Invariance] {
        &[]
    }
    /// Returns the function's conventions at kinks and jumps.
    fn conventions(&self) -> Conventions {
        Conventions::default()
    }
}

/// Returns the default scales: numbers change over their own size, but not over less than a thousandth of the largest
/// one.
#[must_use]
pub fn default_scales(x: &[f64]) -> Vec<f64> {
    let largest = x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let least = match largest {
        0.0 => 1.0,
        x if x > NO_UNIT => f64::MIN_POSITIVE,
        x => LEAST_SCALE * x,
    };
    x.iter().map(|x| x.abs().max(least)).collect()
}

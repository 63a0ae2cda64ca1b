//! One function of the corpus, and the line that lists it.
use crate::corpus::mutant::Mutant;
use geograd::Jet;
use geograd::ad::check::trace::Traced;

/// A function of some numbers with one number as result, and its right gradient by hand. Kinds of scalars
/// are taken out here, once, so that whatever walks the corpus is compiled once.
pub struct Function {
    /// The name.
    pub name: &'static str,
    /// For each number of the input, the interval that it is drawn from.
    pub domain: &'static [[f64; 2]],
    /// Inputs that lie on a kink, or at a tie that is none.
    pub kinks: &'static [&'static [f64]],
    /// The function.
    pub value: fn(&[f64]) -> f64,
    /// The same on duals.
    pub dual: fn(&[Jet<f64, 1>]) -> Jet<f64, 1>,
    /// The same on numbers that record comparisons.
    pub traced: fn(&[Traced<f64>]) -> Traced<f64>,
    /// The same with one rule of differentiation broken.
    pub value_mutant: fn(&[Mutant]) -> Mutant,
    /// The right gradient.
    pub gradient: fn(&[f64]) -> Vec<f64>,
    /// The same in single precision.
    pub gradient_single: fn(&[f32]) -> Vec<f32>,
    /// The same with one step of the formula changed.
    pub gradient_mutant: fn(&[Mutant]) -> Vec<Mutant>,
    /// Plausible wrong gradients, each with its mistake in words.
    pub wrong: &'static [(&'static str, fn(&[f64]) -> Vec<f64>)],
}

/// Lists a function: `row!(function, gradient, domain, kinks [inputs], wrong ["what": gradient])`. Both are generic
/// over the scalar and take an array; wrong gradients are written for `f64`. The last two parts may be left out.
macro_rules! row {
    ($value:ident, $derivatives:ident, $domain:expr
     $(, kinks [$($kink:expr),+ $(,)?])? $(, wrong [$($what:literal: $wrong:ident),+ $(,)?])? $(,)?) => {
        Function {
            name: stringify!($value),
            domain: &$domain,
            kinks: &[$($(&$kink),+)?],
            value: |x| $value(array(x)),
            dual: |x| $value(array(x)),
            traced: |x| $value(array(x)),
            value_mutant: |x| $value(array(x)),
            gradient: |x| $derivatives(array(x)).to_vec(),
            gradient_single: |x| $derivatives(array(x)).to_vec(),
            gradient_mutant: |x| $derivatives(array(x)).to_vec(),
            wrong: &[$($(($what, |x| $wrong(array(x)).to_vec())),+)?],
        }
    };
}
pub(crate) use row;

//! A function together with the declarations of a sampling: its ties, resolution and domain.
//! [`examine`](fn@crate::ad::check::examine) wraps every function in it before it is judged.
use crate::ad::check::certificate::Proof;
use crate::ad::check::sampling::Sampling;
use crate::ad::check::subject::{Conventions, Subject};
use crate::ad::check::symmetry::{Invariance, Kind};
use crate::ad::check::trace::Trace;
use crate::ad::check::witness::Precision;

/// A function with the declarations of a sampling.
pub(crate) struct WithSampling<'a> {
    pub(crate) subject: SubjectRef<'a>,
    pub(crate) sampling: &'a Sampling<'a>,
}

/// A function that is borrowed or owned.
pub(crate) enum SubjectRef<'a> {
    Borrowed(&'a dyn Subject),
    Owned(Box<dyn Subject + 'a>),
}

impl<'a> WithSampling<'a> {
    fn subject(&self) -> &(dyn Subject + 'a) {
        match &self.subject {
            SubjectRef::Borrowed(subject) => *subject,
            SubjectRef::Owned(subject) => &**subject,
        }
    }
}

/// Methods that are forwarded to the function unchanged.
macro_rules! handed_on {
    ($(fn $name:ident(&self $(, $arg:ident: $type:ty)*) -> $out:ty;)*) => { $(
        fn $name(&self $(, $arg: $type)*) -> $out {
            self.subject().$name($($arg),*)
        }
    )* };
}

impl Subject for WithSampling<'_> {
    handed_on! {
        fn precision(&self) -> Precision;
        fn value(&self, x: &[f64]) -> Vec<f64>;
        fn other_values(&self, x: &[f64]) -> Vec<Vec<f64>>;
        fn adjoint(&self, x: &[f64], y_bar: &[f64]) -> Option<Vec<f64>>;
        fn noisy(&self, x: &[f64], y_bar: &[f64], seed: u64) -> Option<Vec<f64>>;
        fn further(&self, x: &[f64], y_bar: &[f64]) -> Vec<Vec<f64>>;
        fn noisy_further(&self, x: &[f64], y_bar: &[f64], position: usize, seed: u64) -> Option<Vec<f64>>;
        fn forms(&self) -> usize;
        fn batch(&self, form: usize, x: &[f64], y_bar: &[f64]) -> Option<(Vec<f64>, Vec<f64>)>;
        fn jacobian(&self, x: &[f64]) -> Option<Vec<Vec<f64>>>;
        fn dual_values(&self, x: &[f64]) -> Option<Vec<f64>>;
        fn along(&self, x: &[f64], direction: &[f64]) -> Option<Vec<f64>>;
        fn num_dual(&self, x: &[f64], direction: &[f64]) -> Option<(Vec<f64>, Vec<f64>)>;
        fn traced(&self, x: &[f64]) -> Option<(Vec<f64>, Trace)>;
        fn traced_all(&self, inputs: &[Vec<f64>]) -> Option<Vec<(Vec<f64>, Trace)>>;
        fn curvature(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>>;
        fn noisy_curvature(&self, x: &[f64], y_bar: &[f64], direction: &[f64], seed: u64) -> Option<Vec<f64>>;
        fn second_order(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>>;
        fn units(&self, x: &[f64]) -> Vec<f64>;
        fn comparable(&self) -> bool;
        fn rounding(&self, x: &[f64]) -> Vec<f64>;
        fn kinds(&self) -> Vec<Kind>;
        fn output_kinds(&self) -> Vec<Kind>;
        fn invariances(&self) -> &[Invariance];
    }
    fn wide(&self) -> Option<Box<dyn Subject + '_>> {
        let subject = SubjectRef::Owned(self.subject().wide()?);
        let sampling = self.sampling;
        Some(Box::new(WithSampling { subject, sampling }))
    }
    fn proof(&self, x: &[f64]) -> Option<Proof> {
        match self.sampling.proof {
            Some(proof) => proof(x),
            None => self.subject().proof(x),
        }
    }
    fn inside(&self, x: &[f64]) -> bool {
        self.subject().inside(x) && self.sampling.inside.is_none_or(|inside| inside(x))
    }
    fn total(&self) -> bool {
        // Beyond a declared border the function may be anything.
        self.sampling.inside.is_none() && self.subject().total()
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        match self.sampling.scales {
            Some(scales) => scales(x),
            None => self.subject().scales(x),
        }
    }
    fn guessed_scales(&self) -> bool {
        self.sampling.scales.is_none() && self.subject().guessed_scales()
    }
    fn resolution(&self, y: &[f64]) -> Vec<f64> {
        let [absolute, share] = self.sampling.resolution.unwrap_or_default();
        let mut all = self.subject().resolution(y);
        for (own, y) in all.iter_mut().zip(y) {
            *own = own.max(absolute).max(share * y.abs());
        }
        all
    }
    fn roundings(&self, x: &[f64]) -> f64 {
        self.sampling
            .roundings
            .map_or(0.0, |roundings| roundings(x))
    }
    fn conventions(&self) -> Conventions {
        let own = self.subject().conventions();
        Conventions {
            shared_ties: own.shared_ties || self.sampling.shared_ties,
            ..own
        }
    }
}

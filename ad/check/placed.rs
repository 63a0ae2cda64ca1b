//! A check near one of its points.
use crate::ad::check::{Check, narrow};
use crate::{Pack, Real};

/// A check near one of its points.
pub(crate) struct Near<'c, 'a, X: Pack> {
    pub(crate) check: &'c Check<'a, X>,
    pub(crate) near: &'c X,
}

impl<S: Real, X: Pack<Scalar = S>> Near<'_, '_, X> {
    pub(crate) fn made(&self, x: &[f64]) -> X {
        self.near.refill(&narrow::<S>(x))
    }
}

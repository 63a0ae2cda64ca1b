//! A check near one of its points.
use crate::Pack;
use crate::ad::check::{Check, narrow};
use crate::ad::program::Plain;

/// A check near one of its points.
pub(crate) struct Near<'c, 'a, X: Pack> {
    pub(crate) check: &'c Check<'a, X>,
    pub(crate) near: &'c X,
}

impl<S: Plain, X: Pack<Scalar = S>> Near<'_, '_, X> {
    pub(crate) fn made(&self, x: &[f64]) -> X {
        self.near.refill(&narrow::<S>(x))
    }
}

//! A check of closures as a [`Subject`], near one of its points: it calls the closures of a
//! [`Check`](crate::ad::check::Check) on lists of numbers.
use crate::ad::check::builder::CheckAtPoint;
use crate::ad::check::second_order::{Wide, bends, transposed};
use crate::ad::check::subject::{Conventions, Subject, default_scales};
use crate::ad::check::symmetry::{Invariance, Kind};
use crate::ad::check::trace::Trace;
use crate::ad::check::witness::{Precision, axis};
use crate::{Pack, Real};
use std::panic::{AssertUnwindSafe, catch_unwind};

impl<S: Real, X: Pack<Scalar = S>> Subject for CheckAtPoint<'_, '_, X> {
    fn precision(&self) -> Precision {
        Precision::of::<S>()
    }
    fn value(&self, x: &[f64]) -> Vec<f64> {
        let value = self.check.value.as_ref().expect("checked at the start");
        value(&self.made(x))
    }
    fn other_values(&self, x: &[f64]) -> Vec<Vec<f64>> {
        self.check
            .paths
            .iter()
            .map(|path| path(&self.made(x)))
            .collect()
    }
    fn adjoint(&self, x: &[f64], y_bar: &[f64]) -> Option<Vec<f64>> {
        let adjoint = self.check.adjoint.as_ref()?;
        Some(adjoint(&self.made(x), y_bar))
    }
    fn further(&self, x: &[f64], y_bar: &[f64]) -> Vec<Vec<f64>> {
        self.check
            .further
            .iter()
            .map(|f| f(&self.made(x), y_bar))
            .collect()
    }
    fn jacobian(&self, x: &[f64]) -> Option<Vec<Vec<f64>>> {
        let dual = self.check.dual.as_ref()?;
        let here = self.made(x);
        let columns: Vec<Vec<f64>> = (0..x.len())
            .map(|i| dual(&here, &axis(x.len(), i)).1)
            .collect();
        Some(transposed(&columns))
    }
    fn along(&self, x: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let dual = self.check.dual.as_ref()?;
        Some(dual(&self.made(x), direction).1)
    }
    fn dual_values(&self, x: &[f64]) -> Option<Vec<f64>> {
        let dual = self.check.dual.as_ref()?;
        Some(dual(&self.made(x), &vec![0.0; x.len()]).0)
    }
    fn num_dual(&self, x: &[f64], direction: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let num_dual = self.check.num_dual.as_ref()?;
        Some(num_dual(&self.made(x), direction))
    }
    fn traced(&self, x: &[f64]) -> Option<(Vec<f64>, Trace)> {
        let traced = self.check.traced.as_ref()?;
        Some(traced(&self.made(x)))
    }
    fn curvature(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let curvature = self.check.curvature.as_ref()?;
        assert!(
            y_bar.len() == 1,
            "`hessian_times` is for a function with one number as result"
        );
        let bend = curvature(&self.made(x), direction);
        Some(bend.iter().map(|b| b * y_bar[0]).collect())
    }
    fn second_order(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let source = self.check.second_order.as_ref()?;
        Some(bends(|at| source(self.near, at), x, y_bar, direction))
    }
    fn wide(&self) -> Option<Box<dyn Subject + '_>> {
        let source = self.check.wide.as_ref()?;
        let narrow = self.precision() == Precision::F32;
        narrow.then(|| {
            Box::new(Wide {
                narrow: self,
                source,
            }) as Box<dyn Subject>
        })
    }
    fn inside(&self, x: &[f64]) -> bool {
        let here = self.made(x);
        match (&self.check.inside, &self.check.value) {
            (Some(inside), _) => inside(&here),
            // A function that panics near its point has a border there.
            (None, Some(value)) => catch_unwind(AssertUnwindSafe(|| value(&here))).is_ok(),
            (None, None) => true,
        }
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        match &self.check.scales {
            Some(scales) => scales(&self.made(x)),
            None => default_scales(x),
        }
    }
    fn guessed_scales(&self) -> bool {
        self.check.scales.is_none()
    }
    fn kinds(&self) -> Vec<Kind> {
        self.check.kinds.clone()
    }
    fn output_kinds(&self) -> Vec<Kind> {
        self.check.output_kinds.clone()
    }
    fn resolution(&self, y: &[f64]) -> Vec<f64> {
        let [absolute, share] = self.check.resolution;
        let each = y.iter().map(|y| absolute.max(share * y.abs()));
        each.collect()
    }
    fn invariances(&self) -> &[Invariance] {
        &self.check.invariances
    }
    fn conventions(&self) -> Conventions {
        self.check.conventions
    }
}

//! A check of closures, put together step by step: [`Check`] collects points, the function and its witnesses, and `run`
//! judges them.
use crate::ad::check::bent::{BentFn, TracedBentFn};
use crate::ad::check::subject::Conventions;
use crate::ad::check::symmetry::{Invariance, Kind};
use crate::ad::check::trace::{Trace, Traced, of_num_duals, trace};
use crate::ad::check::{Report, SEED, Sampling, examine, narrow};
use crate::ad::sample::{Draw, Sample, hard_cases, random};
use crate::{Jet, Pack, Real};
use std::fmt::Debug;

type InsideFn<'a, X> = Box<dyn Fn(&X) -> bool + 'a>;
type ValueFn<'a, X> = Box<dyn Fn(&X) -> Vec<f64> + 'a>;
type AdjointFn<'a, X> = Box<dyn Fn(&X, &[f64]) -> Vec<f64> + 'a>;
type DualFn<'a, X> = Box<dyn Fn(&X, &[f64]) -> (Vec<f64>, Vec<f64>) + 'a>;
type TracedFn<'a, X> = Box<dyn Fn(&X) -> (Vec<f64>, Trace) + 'a>;

/// A check of a function given as closures, at inputs of any shape: `[f64; 2]`, `Vec<f64>`,
/// `(Obb2<f32>, Obb2<f32>)`.
///
/// ```
/// use geograd::ad::check::Check;
/// // Run-time size, 32 bits: the sum of squares.
/// let report = Check::at(vec![1.0_f32, 2.0, 3.0, 4.0])
///     .value(|x| x.iter().map(|x| x * x).sum::<f32>())
///     .gradient(|x| x.iter().map(|x| 2.0 * x).collect())
///     .run();
/// assert!(report.passed(), "{report}");
/// ```
pub struct Check<'a, X: Pack> {
    pub(crate) name: String,
    pub(crate) points: Vec<X>,
    pub(crate) random_from: usize,
    pub(crate) seed: u64,
    pub(crate) value: Option<ValueFn<'a, X>>,
    pub(crate) paths: Vec<ValueFn<'a, X>>,
    pub(crate) adjoint: Option<AdjointFn<'a, X>>,
    pub(crate) further: Vec<AdjointFn<'a, X>>,
    pub(crate) dual: Option<DualFn<'a, X>>,
    pub(crate) num_dual: Option<DualFn<'a, X>>,
    pub(crate) traced: Option<TracedFn<'a, X>>,
    pub(crate) curvature: Option<AdjointFn<'a, X>>,
    pub(crate) second_order: Option<BentFn<'a, X>>,
    pub(crate) wide: Option<TracedBentFn<'a, X>>,
    pub(crate) inside: Option<InsideFn<'a, X>>,
    pub(crate) scales: Option<ValueFn<'a, X>>,
    pub(crate) kinds: Vec<Kind>,
    pub(crate) output_kinds: Vec<Kind>,
    pub(crate) resolution: [f64; 2],
    pub(crate) invariances: Vec<Invariance>,
    pub(crate) conventions: Conventions,
}

/// A check near one of its points.
pub(crate) struct CheckAtPoint<'c, 'a, X: Pack> {
    pub(crate) check: &'c Check<'a, X>,
    pub(crate) near: &'c X,
}

impl<S: Real, X: Pack<Scalar = S>> CheckAtPoint<'_, '_, X> {
    pub(crate) fn made(&self, x: &[f64]) -> X {
        self.near.refill(&narrow::<S>(x))
    }
}

/// Returns the numbers of a pack of floats as a list.
fn wide<S: Real, X: Pack<Scalar = S>>(x: &X) -> Vec<f64> {
    x.scalars().iter().map(|x| x.widen()).collect()
}

impl<'a, S: Real, X: Pack<Scalar = S> + Debug + 'a> Check<'a, X> {
    /// Checks at a point. Everything else is added with the other methods.
    #[must_use]
    pub fn at(point: X) -> Self {
        Check::among([point])
    }
    /// Checks at points.
    #[must_use]
    pub fn among(points: impl IntoIterator<Item = X>) -> Self {
        let points: Vec<X> = points.into_iter().collect();
        Check {
            name: "function".to_owned(),
            random_from: points.len(),
            points,
            seed: SEED,
            value: None,
            paths: Vec::new(),
            adjoint: None,
            further: Vec::new(),
            dual: None,
            num_dual: None,
            traced: None,
            curvature: None,
            second_order: None,
            wide: None,
            inside: None,
            scales: None,
            kinds: Vec::new(),
            output_kinds: Vec::new(),
            resolution: [0.0; 2],
            invariances: Vec::new(),
            conventions: Conventions::default(),
        }
    }
    /// Checks at `count` points that `make` draws, from a seed.
    #[must_use]
    pub fn drawn(count: usize, seed: u64, mut make: impl FnMut(&mut Draw) -> X) -> Self {
        let sampling = Sampling::new(count, seed);
        let mut check = Check::among((0..count).map(|i| make(&mut sampling.draw(i))));
        (check.seed, check.random_from) = (seed, 0);
        check
    }
    /// Adds a point.
    #[must_use]
    pub fn and(mut self, point: X) -> Self {
        self.points.insert(self.random_from, point);
        self.random_from += 1;
        self
    }
    /// Sets the name in the report.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.name = name.to_owned();
        self
    }
    /// Sets the function.
    #[must_use]
    pub fn value<Y: Pack<Scalar = S>>(mut self, f: impl Fn(X) -> Y + 'a) -> Self {
        self.value = Some(Box::new(move |x| wide(&f(x.clone()))));
        self
    }
    /// Adds the function by another path, which must give the same value.
    #[must_use]
    pub fn path<Y: Pack<Scalar = S>>(mut self, f: impl Fn(X) -> Y + 'a) -> Self {
        self.paths.push(Box::new(move |x| wide(&f(x.clone()))));
        self
    }
    /// Sets the derivative by hand of a function with one number as result.
    #[must_use]
    pub fn gradient(mut self, f: impl Fn(X) -> X + 'a) -> Self {
        self.adjoint = Some(Box::new(move |x, y_bar| {
            let seed = y_bar.first().copied().unwrap_or(0.0);
            wide(&f(x.clone()))
                .iter()
                .map(|derivative| seed * derivative)
                .collect()
        }));
        self
    }
    /// Sets the derivative by hand: the derivatives of `y_bar · value` with respect to the input.
    #[must_use]
    pub fn adjoint(mut self, f: impl Fn(X, &[S]) -> X + 'a) -> Self {
        self.adjoint = Some(Box::new(move |x, y_bar| {
            wide(&f(x.clone(), &narrow(y_bar)))
        }));
        self
    }
    /// Adds a further witness of the derivative by hand: another path, a GPU.
    #[must_use]
    pub fn witness(mut self, f: impl Fn(X, &[S]) -> X + 'a) -> Self {
        self.further.push(Box::new(move |x, y_bar| {
            wide(&f(x.clone(), &narrow(y_bar)))
        }));
        self
    }
    /// Sets the generic source, called with duals.
    #[must_use]
    pub fn dual<Y>(mut self, f: impl Fn(X::With<Jet<S, 1>>) -> Y + 'a) -> Self
    where
        Y: Pack<Scalar = Jet<S, 1>>,
    {
        self.dual = Some(Box::new(move |x, direction| {
            let mut i = 0;
            let jets = x.remake(&mut |&value| {
                i += 1;
                let derivative = [S::nearest(direction[i - 1])];
                Jet { value, derivative }
            });
            let jets = f(jets).scalars();
            let values = jets.iter().map(|jet| jet.value.widen()).collect();
            let derivatives = jets.iter().map(|jet| jet.derivative[0].widen()).collect();
            (values, derivatives)
        }));
        self
    }
    /// Sets the generic source, called with num-dual's own dual numbers: an implementation of duals independent of
    /// ours, and a witness of its own. A mistake that a derivative by hand shares with one of them is unlikely in both.
    #[must_use]
    pub fn num_dual<Y>(mut self, f: impl Fn(X::With<S::NumDual>) -> Y + 'a) -> Self
    where
        Y: Pack<Scalar = S::NumDual>,
    {
        self.num_dual = Some(Box::new(move |x, direction| {
            let mut i = 0;
            let duals = x.remake(&mut |&value| {
                i += 1;
                S::num_dual(value, S::nearest(direction[i - 1]))
            });
            of_num_duals::<S>(f(duals).scalars())
        }));
        self
    }
    /// Sets the generic source, called with numbers that record every comparison.
    #[must_use]
    pub fn traced<Y>(mut self, f: impl Fn(X::With<Traced<S>>) -> Y + 'a) -> Self
    where
        Y: Pack<Scalar = Traced<S>>,
    {
        self.traced = Some(Box::new(move |x| {
            let (y, trace) = trace(|| f(x.remake(&mut |&value| Traced(value))));
            (y.scalars().iter().map(|y| y.0.widen()).collect(), trace)
        }));
        self
    }
    /// Sets the Hessian by hand times a direction, of a function with one number as result.
    #[must_use]
    pub fn hessian_times(mut self, f: impl Fn(X, X) -> X + 'a) -> Self {
        self.curvature = Some(Box::new(move |x, direction| {
            wide(&f(x.clone(), x.refill(&narrow::<S>(direction))))
        }));
        self
    }
    /// Sets the domain of the function: no step leads outside. A refused input is shrunk, to other lengths too; inputs
    /// outside, and those at which the function panics, are skipped. Without this a function is taken to be defined
    /// wherever it does not panic.
    #[must_use]
    pub fn inside(mut self, f: impl Fn(&X) -> bool + 'a) -> Self {
        self.inside = Some(Box::new(f));
        self
    }
    /// Sets for each number the length over which the function may be expected to change. By default it is the
    /// magnitude of the number.
    #[must_use]
    pub fn scales(mut self, f: impl Fn(&X) -> X + 'a) -> Self {
        self.scales = Some(Box::new(move |x| wide(&f(x))));
        self
    }
    /// Sets the function's invariances under motions, and the kind of each number of the input.
    #[must_use]
    pub fn invariances(mut self, kinds: &[Kind], invariances: &[Invariance]) -> Self {
        self.kinds = kinds.to_vec();
        self.invariances = invariances.to_vec();
        self
    }
    /// Sets the kind of each number of the result, for invariances that it
    /// [follows](crate::ad::check::symmetry::Effect::Follows).
    #[must_use]
    pub fn result_kinds(mut self, kinds: &[Kind]) -> Self {
        self.output_kinds = kinds.to_vec();
        self
    }
    /// Sets the error that values may have, beyond rounding, because of the way they are computed: from a table, by an
    /// iteration that stops. It is in the unit of the result; for a share of the result, see
    /// [`relative_resolution`](Check::relative_resolution). Differences are then as coarse as that allows, and a change
    /// as small is no jump. Derivatives are judged as strictly as without it.
    ///
    /// ```
    /// use geograd::ad::check::Check;
    /// // Sines to six digits after the point, with the derivative of the exact one.
    /// let rounded = |x: f64| (x.sin() * 1e6).round() / 1e6;
    /// Check::among([0.3, 1.0]).value(rounded).gradient(f64::cos).resolution(1e-6).assert();
    /// let report = Check::at(0.3).value(rounded).gradient(|x| 1.01 * x.cos()).resolution(1e-6).run();
    /// assert!(!report.passed());
    /// ```
    #[must_use]
    pub fn resolution(mut self, absolute: f64) -> Self {
        self.resolution[0] = absolute;
        self
    }
    /// Sets the error that values may have, as a share of each number of the result: see
    /// [`resolution`](Check::resolution).
    #[must_use]
    pub fn relative_resolution(mut self, share: f64) -> Self {
        self.resolution[1] = share;
        self
    }
    /// Sets the conventions of the function.
    #[must_use]
    pub fn conventions(mut self, conventions: Conventions) -> Self {
        self.conventions = conventions;
        self
    }
    /// Sets another seed.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }
    /// Judges the function at all points.
    ///
    /// # Panics
    ///
    /// When no [`value`](Check::value) was given.
    #[must_use]
    pub fn run(&self) -> Report {
        assert!(self.value.is_some(), "a check needs a function");
        let sampling = Sampling::new(self.points.len(), self.seed);
        examine(
            &self.name,
            &sampling,
            &self.points,
            self.random_from,
            |near, judge| judge(&CheckAtPoint { check: self, near }),
        )
    }
    /// Judges the function at all points, and panics with the report if something was refused.
    ///
    /// # Panics
    ///
    /// When something was refused.
    #[track_caller]
    pub fn assert(&self) {
        let report = self.run();
        assert!(report.passed(), "the derivative is refused\n{report}");
    }
}

impl<'a, X: Sample + 'a> Check<'a, X> {
    /// Checks at the hard cases of a shape and `count` random ones.
    #[must_use]
    pub fn random(count: usize, seed: u64) -> Self {
        let sampling = Sampling::new(count, seed);
        let mut check = Check::among(hard_cases());
        check
            .points
            .extend((0..count).map(|i| random::<X>(&mut sampling.draw(i))));
        check.seed = seed;
        check.inside(X::inside).scales(|x| x.refill(&x.scales()))
    }
}

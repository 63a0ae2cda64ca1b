//! The gradient verification harness: is a derivative right?
//!
//! Every derivative is judged from three sides: by hand (the adjoint), by forward duals through the
//! generic source, by finite differences with an error estimate. They must agree as far as their
//! own errors, measured at every sample, allow; no tolerance is set per function. Beside that a derivative must be the same
//! bits twice, linear in its seed, finite, right at kinks, consistent with declared invariances,
//! and have the right derivatives itself. A refused input is made as simple as it can be, in its
//! numbers and its length, and printed as code.
//!
//! # A correct derivative
//!
//! ```
//! use geograd::assert_gradient;
//! assert_gradient!(
//!     |[x, y]: [f64; 2]| x * x * y.sin(),
//!     |[x, y]| [2.0 * x * y.sin(), x * x * y.cos()],
//!     at [1.0, 2.0], [-3.0, 0.5]
//! );
//! ```
//!
//! With a function that is generic over the scalar, duals and branch tracing join in:
//!
//! ```
//! use geograd::{assert_gradient, Scalar};
//! fn norm<S: Scalar>([x, y]: [S; 2]) -> S {
//!     x.hypot(y)
//! }
//! assert_gradient!(generic norm, |[x, y]| [x / x.hypot(y), y / x.hypot(y)], at [3.0, 4.0]);
//! ```
//!
//! # A subtly wrong one
//!
//! The signed distance of the point `(x, y)` from the line `a x + b y + c = 0`, with derivatives as
//! a published library had them: those with respect to c, x and y are right, those with respect to
//! a and b miss a part of the chain rule, and are nearly right for many lines.
//!
//! ```
//! use geograd::ad::check::Check;
//! use geograd::ad::check::verdict::{Reason, Witness};
//! use geograd::Scalar;
//! fn distance<S: Scalar>([a, b, c, x, y]: [S; 5]) -> S {
//!     (a * x + b * y + c).over((a * a + b * b).root())
//! }
//! let wrong = |[a, b, _c, x, y]: [f64; 5]| {
//!     let n = (a * a + b * b).sqrt();
//!     let cube = n * n * n;
//!     [a * y * y / cube, b * x * x / cube, 1.0 / n, a / n, b / n]
//! };
//! let report = Check::at([1.3, -0.7, 0.4, 2.1, 0.9])
//!     .value(distance)
//!     .dual(distance)
//!     .gradient(wrong)
//!     .run();
//! let fault = report.failures[0].fault;
//! assert_eq!(fault.reason, Reason::Disagree(Witness::Adjoint, Witness::Dual));
//! assert_eq!(fault.input, 0); // the derivative with respect to a
//! assert_eq!(fault.suspect, Some(Witness::Adjoint)); // the differences side with the duals
//! let right = |[a, b, c, x, y]: [f64; 5]| {
//!     let n = (a * a + b * b).sqrt();
//!     let cube = n * n * n;
//!     let (by_a, by_b) = (b * (b * x - a * y) - a * c, a * (a * y - b * x) - b * c);
//!     [by_a / cube, by_b / cube, 1.0 / n, a / n, b / n]
//! };
//! geograd::assert_gradient!(generic distance, right, at [1.3, -0.7, 0.4, 2.1, 0.9]);
//! ```
//!
//! # A function with a kink
//!
//! At a kink a derivative is right when it lies between the slopes of both sides along every
//! direction, and where many numbers tie, equals the slope along the direction that keeps the tie.
//! Where kinks of both signs meet, and at the border of the domain, both sides do not bound it: there it may
//! lie between the slopes at places nearby. It may be another element than the duals'
//! ([`shared_ties`](crate::ad::check::subject::Conventions::shared_ties) asks for theirs). The report says how
//! many samples were kinks, so that a function cannot pass by being nothing but kinks; and a number of
//! the input about which no witness could say anything is [`Unjudged`](crate::ad::check::verdict::Reason::Unjudged).
//!
//! ```
//! use geograd::ad::check::Check;
//! use geograd::ad::check::verdict::Reason;
//! let larger = |[x, y]: [f64; 2]| x.max(y);
//! // Halves at the tie: between the sides.
//! let halves = |[x, y]: [f64; 2]| match x.partial_cmp(&y) {
//!     Some(std::cmp::Ordering::Greater) => [1.0, 0.0],
//!     Some(std::cmp::Ordering::Less) => [0.0, 1.0],
//!     _ => [0.5, 0.5],
//! };
//! let report = Check::at([1.0, 1.0]).and([2.0, 1.0]).value(larger).gradient(halves).run();
//! assert!(report.passed());
//! assert_eq!(report.places, [1, 1, 0]); // one smooth place, one kink
//! // One and one at the tie: not the slope of anything.
//! let both = |[x, y]: [f64; 2]| [f64::from(x >= y), f64::from(y >= x)];
//! let report = Check::at([1.0, 1.0]).value(larger).gradient(both).run();
//! assert!(report.refused_for(Reason::OutsideKink));
//! ```
//!
//! # A long input
//!
//! Up to 48 numbers are judged one by one, each slope by its own digits. Of more the slopes are multiplied with a direction and
//! compared with what duals and differences say along it; halving the direction finds the number
//! at fault.
//!
//! ```
//! use geograd::ad::check::Check;
//! use geograd::Scalar;
//! fn sines<S: Scalar>(x: Vec<S>) -> S {
//!     x.iter().fold(S::lit(0.0), |sum, x| sum + x.sin())
//! }
//! let wrong = |x: Vec<f64>| -> Vec<f64> {
//!     // Of two thousand numbers, those above 1.9 are wrong.
//!     x.iter().map(|x| if *x > 1.9 { 1.01 * x.cos() } else { x.cos() }).collect()
//! };
//! let point: Vec<f64> = (0..2000).map(|i| f64::from(i % 97) / 50.0).collect();
//! let report = Check::at(point).value(sines).dual(sines).gradient(wrong).run();
//! assert_eq!(report.failures[0].code, "vec![2.0]");
//! ```
//!
//! # Other witnesses
//!
//! Single precision is judged by double where the source is generic ([`Check::wide`]), a Hessian by
//! duals of duals ([`Check::second_order`]). Another implementation is a witness ([`Check::witness`],
//! [`Check::path`]). Batches of the
//! library's operations, on the CPU or a GPU, are witnesses in
//! [`kernels::check`](crate::kernels::check::prove_on).
//!
//! # How far the verdict goes
//!
//! | measured by the tests of this crate | |
//! | --- | --- |
//! | planted faults refused for the right reason | all 77 |
//! | difficult but correct functions accepted | all 31, and rings of 600 vertices |
//! | right gradients of random functions refused | 0 of 1000 |
//! | random functions with one number off by 10⁻⁶ to 1, by differences alone, accepted | 0 of 1000 |
//! | the library's own operations, 100 000 random samples each and all hard cases, in both formats | no false alarm in 1.8 million |
//!
//! Give a function's generic source where there is one ([`Check::dual`], [`Check::traced`]): duals
//! know no step, and traces tell a kink from a coincidence. Differences alone do not see a
//! feature smaller than a hundred-millionth of the [scale](Check::scales), nor a slope whose rise is
//! lost in the rounding of the value; a function that has such features (boxes tilted by less, poles
//! nearer than that) may be refused falsely without them. Without scales a number is taken to change
//! over its own size or a thousandth of the largest one, whichever tells.
//!
//! A slope may be off by the rounding of terms as large as it gets when the inputs change over
//! their size: what is left of `1 - 0.9997` has four digits less, and that is no mistake. One that
//! loses more, half of its digits say, is refused.
//!
//! Where a value is decided within rounding (a tie that is none in exact arithmetic), no witness
//! is better than another, and what provoked rounding changes is tolerated. Exact ties of equal
//! inputs are judged strictly in double precision.
mod agreement;
mod closures;
mod curvature;
pub(crate) mod derived;
mod details;
mod examine;
pub mod judge;
mod nearby;
pub mod noise;
mod opinion;
pub mod picture;
mod projection;
mod promise;
pub mod report;
pub mod roughness;
mod rounding;
pub mod sample;
mod second_order;
mod shapes;
mod shrink;
mod slope_test;
mod slopes;
mod solids;
#[cfg(feature = "proptest")]
pub mod strategy;
pub mod subject;
pub mod symmetry;
mod ties;
pub mod trace;
pub mod verdict;
pub mod witness;

use crate::ad::check::closures::Near;
use crate::ad::check::sample::{Draw, Sample, hard_cases, random};
use crate::ad::check::second_order::{BentFn, TracedBentFn};
use crate::ad::check::subject::Conventions;
use crate::ad::check::symmetry::{Kind, Promise};
use crate::ad::check::trace::{Number, Trace, Traced, trace};
use crate::{Jet, Pack};
use std::fmt::Debug;

pub use crate::ad::check::examine::{Plan, SEED, examine};
pub use crate::ad::check::report::{Failure, Report};
pub use crate::ad::check::second_order::Bent;

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
    pub(crate) traced: Option<TracedFn<'a, X>>,
    pub(crate) curvature: Option<AdjointFn<'a, X>>,
    pub(crate) second_order: Option<BentFn<'a, X>>,
    pub(crate) wide: Option<TracedBentFn<'a, X>>,
    pub(crate) inside: Option<InsideFn<'a, X>>,
    pub(crate) scales: Option<ValueFn<'a, X>>,
    pub(crate) kinds: Vec<Kind>,
    pub(crate) promises: Vec<Promise>,
    pub(crate) conventions: Conventions,
}

/// A pack of floats as a list.
fn wide<S: Number, X: Pack<Scalar = S>>(x: &X) -> Vec<f64> {
    x.scalars().iter().map(|x| x.widen()).collect()
}

/// A list as floats.
pub(crate) fn narrow<S: Number>(list: &[f64]) -> Vec<S> {
    list.iter().map(|&x| S::nearest(x)).collect()
}

impl<'a, S: Number, X: Pack<Scalar = S> + Debug + 'a> Check<'a, X> {
    /// At a point. Everything else is added with the other methods.
    #[must_use]
    pub fn at(point: X) -> Self {
        Check::among([point])
    }
    /// At points.
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
            traced: None,
            curvature: None,
            second_order: None,
            wide: None,
            inside: None,
            scales: None,
            kinds: Vec::new(),
            promises: Vec::new(),
            conventions: Conventions::default(),
        }
    }
    /// At so many points of one's own making, from a seed.
    #[must_use]
    pub fn drawn(count: usize, seed: u64, mut make: impl FnMut(&mut Draw) -> X) -> Self {
        let plan = Plan::new(count, seed);
        let mut check = Check::among((0..count).map(|i| make(&mut plan.draw(i))));
        (check.seed, check.random_from) = (seed, 0);
        check
    }
    /// At one more point.
    #[must_use]
    pub fn and(mut self, point: X) -> Self {
        self.points.insert(self.random_from, point);
        self.random_from += 1;
        self
    }
    /// Under a name, for the report.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.name = name.to_owned();
        self
    }
    /// The function.
    #[must_use]
    pub fn value<Y: Pack<Scalar = S>>(mut self, f: impl Fn(X) -> Y + 'a) -> Self {
        self.value = Some(Box::new(move |x| wide(&f(x.clone()))));
        self
    }
    /// The function by another path, which must give the same value.
    #[must_use]
    pub fn path<Y: Pack<Scalar = S>>(mut self, f: impl Fn(X) -> Y + 'a) -> Self {
        self.paths.push(Box::new(move |x| wide(&f(x.clone()))));
        self
    }
    /// The derivative by hand of a function with one number as result.
    #[must_use]
    pub fn gradient(mut self, f: impl Fn(X) -> X + 'a) -> Self {
        self.adjoint = Some(Box::new(move |x, y_bar| {
            let seed = y_bar.first().copied().unwrap_or(0.0);
            wide(&f(x.clone()))
                .iter()
                .map(|slope| seed * slope)
                .collect()
        }));
        self
    }
    /// The derivative by hand: the slopes of `y_bar · value` with respect to the input.
    #[must_use]
    pub fn adjoint(mut self, f: impl Fn(X, &[S]) -> X + 'a) -> Self {
        self.adjoint = Some(Box::new(move |x, y_bar| {
            wide(&f(x.clone(), &narrow(y_bar)))
        }));
        self
    }
    /// A further witness of the same kind: another path, a GPU.
    #[must_use]
    pub fn witness(mut self, f: impl Fn(X, &[S]) -> X + 'a) -> Self {
        self.further.push(Box::new(move |x, y_bar| {
            wide(&f(x.clone(), &narrow(y_bar)))
        }));
        self
    }
    /// The generic source, called with duals.
    #[must_use]
    pub fn dual<Y>(mut self, f: impl Fn(X::With<Jet<S, 1>>) -> Y + 'a) -> Self
    where
        Y: Pack<Scalar = Jet<S, 1>>,
    {
        self.dual = Some(Box::new(move |x, direction| {
            let mut i = 0;
            let jets = x.map(&mut |&value| {
                i += 1;
                let slope = [S::nearest(direction[i - 1])];
                Jet { value, slope }
            });
            let jets = f(jets).scalars();
            let values = jets.iter().map(|jet| jet.value.widen()).collect();
            let slopes = jets.iter().map(|jet| jet.slope[0].widen()).collect();
            (values, slopes)
        }));
        self
    }
    /// The generic source, called with numbers that record every comparison.
    #[must_use]
    pub fn traced<Y>(mut self, f: impl Fn(X::With<Traced<S>>) -> Y + 'a) -> Self
    where
        Y: Pack<Scalar = Traced<S>>,
    {
        self.traced = Some(Box::new(move |x| {
            let (y, trace) = trace(|| f(x.map(&mut |&value| Traced(value))));
            (y.scalars().iter().map(|y| y.0.widen()).collect(), trace)
        }));
        self
    }
    /// The Hessian by hand times a direction, of a function with one number as result.
    #[must_use]
    pub fn hessian_times(mut self, f: impl Fn(X, X) -> X + 'a) -> Self {
        self.curvature = Some(Box::new(move |x, direction| {
            wide(&f(x.clone(), x.refill(&narrow::<S>(direction))))
        }));
        self
    }
    /// Where the function is defined: no step leads outside. A refused input is shrunk, to other
    /// lengths too: those outside, and those at which the function panics, are passed over. Without
    /// this a function is taken to be defined wherever it does not panic.
    #[must_use]
    pub fn inside(mut self, f: impl Fn(&X) -> bool + 'a) -> Self {
        self.inside = Some(Box::new(f));
        self
    }
    /// For each number, the length over which the function may be expected to change. By default
    /// the number itself.
    #[must_use]
    pub fn scales(mut self, f: impl Fn(&X) -> X + 'a) -> Self {
        self.scales = Some(Box::new(move |x| wide(&f(x))));
        self
    }
    /// What the function promises under motions, and what each number of the input is.
    #[must_use]
    pub fn promises(mut self, kinds: &[Kind], promises: &[Promise]) -> Self {
        self.kinds = kinds.to_vec();
        self.promises = promises.to_vec();
        self
    }
    /// What the function does on purpose.
    #[must_use]
    pub fn conventions(mut self, conventions: Conventions) -> Self {
        self.conventions = conventions;
        self
    }
    /// From another seed.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }
    /// Judges.
    ///
    /// # Panics
    ///
    /// When no [`value`](Check::value) was given.
    #[must_use]
    pub fn run(&self) -> Report {
        assert!(self.value.is_some(), "a check needs a function");
        let plan = Plan::new(self.points.len(), self.seed);
        examine(
            &self.name,
            &plan,
            &self.points,
            self.random_from,
            |near, judge| judge(&Near { check: self, near }),
        )
    }
    /// Judges, and panics with the report when something was refused.
    ///
    /// # Panics
    ///
    /// When something was refused.
    #[track_caller]
    pub fn prove(&self) {
        let report = self.run();
        assert!(report.passed(), "the derivative is refused\n{report}");
    }
}

impl<'a, X: Sample + 'a> Check<'a, X> {
    /// At the hard cases of a shape and so many random ones.
    #[must_use]
    pub fn random(count: usize, seed: u64) -> Self {
        let plan = Plan::new(count, seed);
        let mut check = Check::among(hard_cases());
        check
            .points
            .extend((0..count).map(|i| random::<X>(&mut plan.draw(i))));
        check.seed = seed;
        check.inside(X::inside).scales(|x| x.refill(&x.scales()))
    }
}

/// Proves a gradient at points, or panics with the numbers. For use in tests; see the
/// [module](crate::ad::check) for examples.
///
/// `assert_gradient!(value, gradient, at point, …)` takes closures;
/// `assert_gradient!(generic function, gradient, at point, …)` takes a function generic over the
/// scalar, which is then also run on duals, traced, and at points of `f32` in double precision.
#[macro_export]
macro_rules! assert_gradient {
    (generic $value:path, $gradient:expr, at $($point:expr),+ $(,)?) => {
        $crate::ad::check::Check::among([$($point),+])
            .value($value)
            .dual($value)
            .traced($value)
            .wide($value)
            .gradient($gradient)
            .prove()
    };
    ($value:expr, $gradient:expr, at $($point:expr),+ $(,)?) => {
        $crate::ad::check::Check::among([$($point),+])
            .value($value)
            .gradient($gradient)
            .prove()
    };
}

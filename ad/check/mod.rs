//! The gradient verification harness: is a derivative right?
//!
//! A derivative is computed in three ways: by hand (the adjoint), by forward duals through the generic source, and by
//! finite differences. All must agree up to their own errors, which are measured at every sample; no tolerance is set
//! per function. A derivative must be finite, linear in the cotangent of the result, right at kinks, and consistent with
//! declared invariances. A second run must give it the same bits, and its own derivatives must be right. The harness
//! simplifies an input at which it refuses, in its numbers and its length, and prints it as code.
//!
//! One module, [`geograd::check`](crate::check), has all that a check needs.
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
//! The function is the signed distance of the point `(x, y)` from the line `a x + b y + c = 0`. The derivatives are those
//! of a published library. Those with respect to c, x and y are right. Those with respect to a and b miss a part of the
//! chain rule, and are nearly right for many lines.
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
//! At a kink a derivative is right when it lies between the derivatives of both sides along every direction. If many
//! numbers tie, it must also equal the derivative along the direction that keeps the tie. The two sides do not bound it
//! at a point where kinks of both signs meet, nor at the border of the domain. It may then lie between the derivatives
//! at points nearby. It may differ from the duals' choice
//! ([`shared_ties`](crate::ad::check::subject::Conventions::shared_ties) requires theirs, for an operation
//! [`Sampling::shared_ties`]). If steps cannot give the derivatives of both sides, duals at inputs a few last digits
//! away do. The report counts the samples at kinks, so that a function cannot pass by having kinks everywhere. A number
//! of the input that no witness could judge is refused as
//! [`Unjudged`](crate::ad::check::verdict::Reason::Unjudged).
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
//! // One and one at the tie: not the derivative of anything.
//! let both = |[x, y]: [f64; 2]| [f64::from(x >= y), f64::from(y >= x)];
//! let report = Check::at([1.0, 1.0]).value(larger).gradient(both).run();
//! assert!(report.refused_for(Reason::OutsideKink));
//! ```
//!
//! # A long input
//!
//! The derivatives of up to 48 numbers are judged one by one, each by its own digits. Derivatives of more numbers are
//! multiplied with a direction, and compared with duals and differences along it. Halving the direction finds the
//! number at fault.
//!
//! ```
//! use geograd::ad::check::Check;
//! use geograd::Scalar;
//! fn sines<S: Scalar>(x: Vec<S>) -> S {
//!     x.iter().fold(S::lit(0.0), |sum, x| sum + x.sin())
//! }
//! let wrong = |x: Vec<f64>| -> Vec<f64> {
//!     // Derivatives by numbers above 1.9 are wrong.
//!     x.iter().map(|x| if *x > 1.9 { 1.01 * x.cos() } else { x.cos() }).collect()
//! };
//! let point: Vec<f64> = (0..200).map(|i| f64::from(i % 97) / 50.0).collect();
//! let report = Check::at(point).value(sines).dual(sines).gradient(wrong).run();
//! assert_eq!(report.failures[0].code, "vec![2.0]");
//! ```
//!
//! # Other witnesses
//!
//! Single precision is judged by double where the source is generic ([`Check::wide`]), a Hessian by duals of duals
//! ([`Check::second_order`]). Another implementation is a witness ([`Check::witness`], [`Check::path`]). Batches of the
//! library's operations, on the CPU or a GPU, are witnesses in [`kernels::check`](crate::kernels::check::check_on).
//!
//! The dual numbers of the crate num-dual judge derivatives by hand, in addition to our [`Jet`](crate::Jet): either may
//! share a mistake with the derivative. `assert_gradient!(generic …)`, operations with an adjoint by hand and rings use
//! them. A check of closures adds them by [`Check::num_dual`].
//!
//! ```
//! use geograd::ad::check::Check;
//! use geograd::ad::check::verdict::{Reason, Witness};
//! use geograd::{Jet, Scalar};
//! fn little<S: Scalar>(x: S) -> S {
//!     S::lit(1e9) + x * x * S::lit(1e-9) // less than the value's rounding: steps say nothing
//! }
//! // Duals and gradient share a mistake.
//! let tampered = |x: Jet<f64, 1>| little(x).damp(0.999);
//! let check = || Check::at(0.7).value(little).dual(tampered).gradient(|x| 0.999 * 2e-9 * x);
//! assert!(check().run().passed());
//! let report = check().num_dual(little).run();
//! assert!(report.refused_for(Reason::Disagree(Witness::Adjoint, Witness::NumDual)));
//! ```
//!
//! # A refusal that is no mistake
//!
//! Even the best formula loses digits that cancel in single precision. The value is refused, and the report names the
//! remedy: [`Check::resolution`] sets the error that values may have. Derivatives are judged as strictly as before.
//!
//! ```
//! use geograd::ad::check::Check;
//! use geograd::ad::check::verdict::{Reason, Witness};
//! use geograd::Scalar;
//! fn rise<S: Scalar>([x, y]: [S; 2]) -> S {
//!     (S::one() + x * x + y * y).root() - S::one()
//! }
//! let derivatives = |[x, y]: [f32; 2]| [x, y].map(|s| s / (1.0 + x * x + y * y).sqrt());
//! let check = || Check::at([0.01_f32, 0.02]).value(rise).wide(rise).gradient(derivatives);
//! let report = check().run();
//! assert!(report.refused_for(Reason::ValuesDisagree(Witness::Wide)));
//! assert!(report.to_string().contains("`resolution`"));
//! check().resolution(1e-7).assert();
//! ```
//!
//! An operation has the same options, `Check::of(operation).resolution(1e-7).inside(…)`, or its row states them
//! ([`operation!`](crate::operation): `domain`, `resolution`). Inputs outside the domain are counted and not judged. If
//! fewer than a tenth of the random inputs are inside, the operation is refused as
//! [`FewInside`](crate::ad::check::verdict::Reason::FewInside). One that cannot be recorded is refused as
//! [`Unrecordable`](crate::ad::check::verdict::Reason::Unrecordable), and the report says what to do.
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
//! Give a function's generic source where there is one ([`Check::dual`], [`Check::traced`]): duals need no steps, and
//! traces distinguish a kink from a coincidence. Differences alone miss a feature smaller than a hundred-millionth of
//! the [scale](Check::scales), and a derivative whose rise is lost in the rounding of the value. By differences alone a
//! function with such features (boxes tilted by less, poles nearer than that) may be refused falsely. If no scales are
//! given, a number may change over its own size or over a thousandth of the largest number. The harness uses the one by
//! which steps can decide.
//!
//! A derivative may be off by the rounding of its largest terms, as large as it becomes when inputs change over their
//! own size. So `1 - 0.9997` may have four digits less, and that is no mistake. A derivative that loses more, such as
//! half of its digits, is refused.
//!
//! At a near tie rounding decides the branch, though exact arithmetic has no tie. No witness is then better than
//! another, and the changes that perturbed rounding shows are allowed. Exact ties of equal inputs are judged strictly in
//! double precision.
//!
//! # How it is made
//!
//! One input is judged in [`judge`](mod@judge). First `evidence` gathers the data there once: values, derivatives by
//! hand and by duals, branches, neighbouring inputs. Each file of `compare` holds a comparison that reads them and
//! returns its findings (`notes`), and `judge` decides which faults are refused. Every number by which it decides is in
//! `tolerances`, with its reason; `rounding` measures the error of each witness at an input. Sequences of steps are in
//! [`witness`], the test of one derivative by them in `compare/derivative_test`, the weighing of several sequences in
//! `compare/assessment`. [`examine`](fn@examine) walks the inputs, `shrink` makes refused ones simple, [`report`] has
//! the lines, `words` the sentences. A function is a [`Subject`](subject::Subject): lists of numbers in and out.
//!
//! A traced scalar (`trace`) records every comparison and its margin, to distinguish a kink from a mistake. The trace of a
//! search is its record: steps with the same record judge its derivatives, whatever it compared on the way. Where branches
//! meet among which it chooses, derivatives nearby differ from the tested one; only there a choice is accepted. `rounding`
//! measures sensitivity: inputs move by an ulp, and a scalar of `noise` rounds at random. `with_sampling` adds the
//! declarations of a sampling to a function: ties, resolution, domain. `strategy` draws for proptest from the same
//! [`sample`]. `tests/corpus` measures the harness and other checkers. It has functions, faults made by operators and
//! by a scalar that makes one mistake, and a record of the harness's errors.
mod bent;
mod builder;
pub(crate) mod candidate;
pub mod certificate;
mod closures;
mod compare;
mod convex_body;
mod details;
mod evidence;
pub(crate) mod examine;
mod json;
pub mod judge;
mod macros;
pub mod noise;
mod notes;
mod of_program;
pub mod picture;

pub mod report;
pub mod roughness;
mod rounding;
mod sampling;
mod second_order;
mod separating;
mod shrink;
pub mod subject;
pub mod symmetry;
pub(crate) mod tolerances;
pub mod trace;
pub(crate) mod trace_lanes;
pub mod verdict;
mod with_sampling;
pub mod witness;
mod words;

pub use crate::ad::check::bent::Bent;
pub use crate::ad::check::builder::Check;
pub use crate::ad::check::examine::examine;
pub use crate::ad::check::report::{Failure, Report};
pub use crate::ad::check::sampling::{SEED, Sampling};
pub use crate::ad::sample;
#[cfg(feature = "proptest")]
pub use crate::ad::sample::strategy;

/// Returns the numbers of a list, each rounded to the format `S`.
pub(crate) fn narrow<S: crate::Real>(list: &[f64]) -> Vec<S> {
    list.iter().map(|&x| S::nearest(x)).collect()
}

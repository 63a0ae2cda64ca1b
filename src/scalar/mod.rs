//! The number types that formulas are generic over, and their rules at kinks.
//!
//! A [`Scalar`] is a number type of shapes: `f32`, `f64`, a dual number over either (of `num-dual` or our own [`Jet`]),
//! or a bundle of SIMD [`Lanes`]. Comparisons look at the value only and yield a [`Mask`]; branch-free code chooses
//! with [`Scalar::select`] and runs on all of them, code with control flow requires `S: Scalar<Mask = bool>`.
//!
//! # The kink policy
//!
//! 1. The derivative is that of the branch the value took.
//! 2. Exact ties share the derivative equally ([`least`](Scalar::least), [`most`](Scalar::most),
//!    [`clamp`](Scalar::clamp)): half and half; thirds where three tie, and so on ([`least_of`],
//!    [`most_of`]). So at one kink the derivative lies between the slopes of both sides. Where several kinks meet, each
//!    shares by itself, and their sum may lie outside these slopes.
//! 3. A norm at zero has derivative zero ([`magnitude`](Scalar::magnitude), [`root`](Scalar::root),
//!    [`hypot`](Scalar::hypot)).
//! 4. The angle of the zero vector is 0 with derivative zero ([`atan2`](Scalar::atan2)).
//!
//! # Three kinds of functions
//!
//! * *Straight lines* require `S: Scalar` alone. They run on floats, SIMD lanes, duals and the symbols of a
//!   [recording](crate::ad::program).
//! * *Searches* (clipping, hulls) require `S: Scalar<Mask = bool>`. `…_search` returns a record of the decisions, which
//!   holds no numbers; `…_replay` computes the result from inputs and record, with derivatives.
//! * *Folds* are sums over the edges of a list of any length ([`Fold`](crate::kernels::Fold)).
//!
//! A dual type implements `dual::Tangent`, which applies the chain rule; everything else follows from it.
pub(crate) mod arc_tangent;
pub mod dual;
#[cfg(feature = "nalgebra")]
mod dual_vector;
pub(crate) mod elementary;
pub(crate) mod exponential;
pub(crate) mod float;
pub(crate) mod format;
pub(crate) mod guard;
pub mod jet;
pub mod lanes;
mod mask;
mod noted;
pub(crate) mod number;
mod polynomial;
pub(crate) mod real;
mod ties;

pub use format::Format;
#[doc(hidden)]
pub use guard::Guard;
pub(crate) use guard::guarded;
pub use jet::Jet;
pub use lanes::Lanes;
pub use mask::Mask;
pub(crate) use noted::noted;
pub use number::Scalar;
pub use real::Real;
pub(crate) use ties::Span;
pub use ties::{least_of, most_of};

/// Returns the largest number of the format to a power between −1 and 1, for bounds of sizes; equal on every machine.
#[inline]
pub(crate) fn power_of_largest<S: Scalar>(power: f64) -> f64 {
    S::format().largest_to(power)
}

/// Returns a format's largest number to a power between −1 and 1.
#[inline]
pub(crate) fn to_power(largest: f64, epsilon: f64, power: f64) -> f64 {
    // It is 2ⁿ less half a unit in its last place.
    let n = (largest.to_bits() >> 52) as f64 - 1022.0;
    let whole = (n * power).floor();
    let part = exponential::exp_wide((n * power - whole) * std::f64::consts::LN_2);
    let all = part * <f64 as exponential::Exponents>::power_of_two(whole);
    all - all * (power * (epsilon / 2.0))
}

/// Returns the largest of some magnitudes, without derivative.
#[inline(always)]
pub(crate) fn largest<S: Scalar, const N: usize>(x: [S; N]) -> S::Primal {
    let zero = S::Primal::zero();
    x.iter()
        .fold(zero, |most, x| most.most(x.primal().magnitude()))
}

/// Returns `√(x² + y² + z²)` without overflow; 0 with derivative 0 at the origin.
///
/// One root: of [`hypot`](Scalar::hypot) of `hypot` the inner one has no second derivative where x and y are zero.
#[inline(always)]
pub(crate) fn norm<S: Scalar>(x: S, y: S, z: S) -> S {
    let large = x.primal().magnitude().most(y.primal().magnitude());
    let large = large.most(z.primal().magnitude());
    let none = large.at_most(S::Primal::zero());
    let scale = S::Primal::select(none, S::Primal::one(), large).binade();
    let back = S::from_primal(S::Primal::one().over(scale));
    let scale = S::from_primal(scale);
    let (x, y, z) = (x * scale, y * scale, z * scale);
    ((x * x + y * y) + z * z).root() * back
}

//! The number types that formulas are generic over, and their rules at kinks.
//!
//! A [`Scalar`] is a number that a shape can be made of: `f32`, `f64`, a dual number over either (of
//! `num-dual` or our own [`Jet`]), or a bundle of SIMD [`Lanes`].
//! Comparisons look at the value only and yield a [`Mask`]; branch-free code chooses with
//! [`Scalar::select`] and runs on all of them, code with control flow asks for
//! `S: Scalar<Mask = bool>`.
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
//! * *Straight lines* ask for `S: Scalar` alone. They run on floats, SIMD lanes, duals and the symbols of a
//!   [recording](crate::ad::program).
//! * *Searches* (clipping, hulls) ask for `S: Scalar<Mask = bool>`. `…_search` returns a record of the decisions, which
//!   holds no numbers; `…_replay` computes the result from inputs and record, with derivatives.
//! * *Folds* are sums over the edges of a list of any length ([`Fold`](crate::kernels::Fold)).
//!
//! A dual type implements `dual::Tangent`, which applies the chain rule; everything else follows from it.
pub(crate) mod arc_tangent;
pub mod dual;
#[cfg(feature = "nalgebra")]
mod dual_vector;
pub(crate) mod exponential;
pub(crate) mod float;
mod guard;
pub mod jet;
pub mod lanes;
mod polynomial;
pub(crate) mod real;
mod ties;

#[doc(hidden)]
pub use guard::{Guard, guarded};
pub use jet::Jet;
pub use lanes::Lanes;
pub use real::{Format, Real};
pub(crate) use ties::Span;
pub use ties::{least_of, most_of};

/// A length that is negligible in a sum with one, 2⁻⁶⁴ in single precision and 2⁻⁵¹² in double precision: no
/// difference of [ordinary](crate::kernels::op::Limits::ORDINARY) coordinates is so small, but one times the sine of
/// a small angle is. Quotients by it may have infinite derivatives.
pub(crate) fn speck<S: Scalar>() -> f64 {
    power_of_largest::<S>(-0.5)
}

/// The largest number of the format to a power between −1 and 1, as bounds of sizes are given: the same on every machine.
#[inline]
pub(crate) fn power_of_largest<S: Scalar>(power: f64) -> f64 {
    // It is 2ⁿ less half a unit in its last place.
    let n = (S::LARGEST.to_bits() >> 52) as f64 - 1022.0;
    let whole = (n * power).floor();
    let part = exponential::exp_wide((n * power - whole) * std::f64::consts::LN_2);
    let all = part * <f64 as exponential::Exponents>::power_of_two(whole);
    all - all * (power * (S::EPSILON / 2.0))
}

/// The largest of some magnitudes, without derivative.
#[inline(always)]
pub(crate) fn largest<S: Scalar, const N: usize>(x: [S; N]) -> S::Primal {
    let zero = S::Primal::zero();
    x.iter()
        .fold(zero, |most, x| most.most(x.primal().magnitude()))
}

/// `√(x² + y² + z²)` without overflow; 0 with derivative 0 at the origin.
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

use crate::Fixed;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// The outcome of a comparison: a `bool`, one `bool` per SIMD lane, or a symbol of a recording.
///
/// [`any`](Mask::any) and [`all`](Mask::all) are **hints** for leaving early: the code that follows must give the
/// same value without them, that is if `any` had answered `true` and `all` `false`. A symbol answers so unless its
/// truth is known; [recording](crate::ad::program) refuses a function whose value depends on the answer. Choose with
/// [`Scalar::select`]. Code that needs control flow asks for `S: Scalar<Mask = bool>`.
pub trait Mask:
    Copy + Debug + Send + Sync + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// `true` if any lane is true or that is unknown. A hint: `false` allows to skip work that only true lanes need.
    fn any(self) -> bool;
    /// `true` if every lane is true, `false` if that is unknown. A hint: `true` allows to skip work that only false
    /// lanes need.
    fn all(self) -> bool;
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

/// A number that a shape can be made of; the [module](self) lists the implementing types and the rules at kinks.
///
/// Division in geometry goes through [`over`](Scalar::over), roots through
/// [`root`](Scalar::root), absolute values through [`magnitude`](Scalar::magnitude): the
/// operators and inherent methods of some dual types round differently or have no derivative there.
///
/// ```
/// use geograd::Scalar;
/// fn norm<S: Scalar>(x: S, y: S) -> S {
///     x.hypot(y)
/// }
/// assert_eq!(norm(3.0_f32, 4.0), 5.0);
/// let derivative = norm(num_dual::Dual64::new(0.0, 1.0), num_dual::Dual64::new(0.0, 0.0)).eps;
/// assert_eq!(derivative, 0.0); // a norm at zero has derivative zero
/// ```
///
/// # Writing a generic function
///
/// Some habits of plain numbers do not compile for `S: Scalar`.
///
/// **Literals.** `2.0` is an `f64`, and `2.0 * x` asks for an `f64` times an `S`: "cannot multiply `{float}` by `S`".
/// [`lit`](Scalar::lit) makes an `S` of it; [`halved`](Scalar::halved), [`squared`](Scalar::squared),
/// [`zero`](Scalar::zero) and [`one`](Scalar::one) need no literal.
///
/// ```compile_fail,E0277
/// # use geograd::Scalar;
/// fn energy<S: Scalar>(mass: S, speed: S) -> S {
///     0.5 * mass * speed * speed
/// }
/// ```
///
/// ```
/// # use geograd::Scalar;
/// fn energy<S: Scalar>(mass: S, speed: S) -> S {
///     S::lit(0.5) * mass * speed.squared()
/// }
/// assert_eq!(energy(2.0, 3.0), 9.0);
/// ```
///
/// **Functions.** The methods of this trait are all that `S` has. `x.sqrt()`, `x.abs()`, `x.min(y)` and `x.max(y)` are
/// [`root`](Scalar::root), [`magnitude`](Scalar::magnitude), [`least`](Scalar::least) and [`most`](Scalar::most) in
/// generic functions, with their derivatives at kinks; on `f64` itself they are the standard library's. π is `S::lit(PI)`, the arc sine of `x`
/// `x.atan2((S::one() - x * x).root())`, the arc cosine the same with exchanged arguments. Formulas of rows have no
/// further bounds, such as the compiler may suggest.
///
/// **Branches.** `S` has no `<` and `>`: `x.above(y)` stands for `x > y`, and [`select`](Scalar::select) for `if`; the
/// compiler's advice `S: PartialOrd` leads nowhere, since lanes and symbols have no order. A comparison gives a [`Mask`], which is a `bool` for some scalars only: lanes have several outcomes,
/// recorded numbers have none yet. [`select`](Scalar::select), [`least`](Scalar::least), [`most`](Scalar::most) and
/// [`clamp`](Scalar::clamp) choose for every scalar. A function with `if` asks for `S: Scalar<Mask = bool>`. It runs on
/// plain numbers and duals; [`operation!`](crate::operation), batches and programs cannot call it: "type mismatch
/// resolving `<S as Scalar>::Mask == bool`".
///
/// ```compile_fail,E0271
/// # use geograd::Scalar;
/// fn ramp<S: Scalar<Mask = bool>>(x: S) -> S {
///     if x.below(S::zero()) { S::zero() } else { x }
/// }
/// fn sum_of_ramps<S: Scalar>(x: S, y: S) -> S {
///     ramp(x) + ramp(y)
/// }
/// ```
///
/// ```
/// # use geograd::Scalar;
/// fn ramp<S: Scalar>(x: S) -> S {
///     S::select(x.below(S::zero()), S::zero(), x) // or x.most(S::zero()), which shares the derivative at zero
/// }
/// fn sum_of_ramps<S: Scalar>(x: S, y: S) -> S {
///     ramp(x) + ramp(y)
/// }
/// assert_eq!(sum_of_ramps(3.0, -1.0), 3.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a number that shapes are made of",
    label = "not a `Scalar`",
    note = "`f32`, `f64`, `Jet`, num-dual's numbers, `Lanes` and `Sym` are",
    note = "a whole number is not: write `2.0`, or `S::lit(2.0)` in a generic function"
)]
pub trait Scalar:
    Fixed<Scalar = Self>
    + Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The outcome of a comparison.
    type Mask: Mask;
    /// The plain number (or lanes of plain numbers) under all derivative parts.
    type Primal: Scalar<Mask = Self::Mask, Primal = Self::Primal>;

    /// `true` if products carry a low part through cancellation: for 24-bit significands, with which a rotated long
    /// thin box would otherwise lose its width.
    const COMPENSATED: bool;
    /// The distance from 1 to the next larger number.
    const EPSILON: f64;
    /// A sine below which two directions count as exactly parallel, such as those of headings that
    /// differ by π/2 as it is rounded. (With 24 bits a smaller one still matters to a long thin
    /// box; its reciprocal's powers must not overflow.)
    const PARALLEL: f64;
    /// The largest finite number.
    const LARGEST: f64;
    /// At or below this an area counts as empty, where a box has a side of about one: its reciprocal,
    /// sixty-four times over, would not be finite, and derivatives could not cancel.
    const EMPTY: f64 = 64.0 / Self::LARGEST;

    /// A literal: `S::lit(0.5)`. Rounded to the precision of the scalar.
    fn lit(x: f64) -> Self;
    /// A constant: no derivative.
    fn from_primal(x: Self::Primal) -> Self;
    /// The value without its derivatives.
    fn primal(self) -> Self::Primal;

    /// `self < other`, by value.
    fn below(self, other: Self) -> Self::Mask;
    /// `self ≤ other`, by value.
    fn at_most(self, other: Self) -> Self::Mask;
    /// `self = other`, by value.
    fn equals(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is true, else `no`. The other value has no effect, even if it is NaN.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The quotient, with the value of plain numbers.
    fn over(self, divisor: Self) -> Self;
    /// The square root; 0 with derivative 0 for zero and below, NaN for NaN.
    fn root(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Sine and cosine, each as a short high part (half the significand, a constant) and the rest
    /// (which carries the derivative): `[(sin_high, sin_low), (cos_high, cos_low)]`.
    fn sin_cos_parts(self) -> [(Self, Self); 2];
    /// `(high, low)` with `high + low = self` exactly, `high` a constant of half the significand.
    fn parts(self) -> (Self, Self);
    /// The angle of `(x, self)` in radians, in `[−π, π]`; 0 with derivative 0 at the origin. The sign of a zero does
    /// not count: `(−1, −0)` is at π.
    fn atan2(self, x: Self) -> Self;
    /// The exponential.
    fn exp(self) -> Self;
    /// The natural logarithm.
    fn ln(self) -> Self;
    /// The power of two `2⁻ᵉ` (a constant) that brings `self > 0` into `[2, 4)`. Values too small
    /// to be normal count as the smallest normal number.
    fn binade(self) -> Self;

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::lit(0.0)
    }
    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::lit(1.0)
    }
    /// `self > other`, by value.
    #[inline(always)]
    fn above(self, other: Self) -> Self::Mask {
        other.below(self)
    }
    /// `self ≥ other`, by value.
    #[inline(always)]
    fn at_least(self, other: Self) -> Self::Mask {
        other.at_most(self)
    }
    /// Half of it.
    #[inline(always)]
    fn halved(self) -> Self {
        self * Self::lit(0.5)
    }
    /// The smaller value; an exact tie shares the derivative, half and half.
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        let nearer = Self::select(self.below(other), self, other);
        Self::select(self.equals(other), self.halved() + other.halved(), nearer)
    }
    /// The larger value; an exact tie shares the derivative, half and half.
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        let nearer = Self::select(other.below(self), self, other);
        Self::select(self.equals(other), self.halved() + other.halved(), nearer)
    }
    /// The nearest value in `[low, high]`; at either bound half of the derivative.
    #[inline(always)]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.most(low).least(high)
    }
    /// The absolute value; derivative zero at zero.
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.most(-self)
    }
    /// [`root`](Scalar::root), by the name that plain numbers have. Numbers below zero have the root 0, not NaN.
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.root()
    }
    /// [`magnitude`](Scalar::magnitude), by the name that plain numbers have.
    #[inline(always)]
    fn abs(self) -> Self {
        self.magnitude()
    }
    /// [`least`](Scalar::least), by the name that plain numbers have; of NaN and a number it is not always the number.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.least(other)
    }
    /// [`most`](Scalar::most), by the name that plain numbers have; of NaN and a number it is not always the number.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.most(other)
    }
    /// Whichever of `self` and `−self` is not negative. Unlike [`magnitude`](Scalar::magnitude) it
    /// has the derivative of `self` at zero: for choosing between two descriptions of the same thing,
    /// where there is no kink.
    #[inline(always)]
    fn unsigned(self) -> Self {
        Self::select(self.below(Self::zero()), -self, self)
    }
    /// `self`, negated where `side` is negative.
    #[inline(always)]
    fn signed_as(self, side: Self) -> Self {
        Self::select(side.below(Self::zero()), -self, self)
    }
    /// `√(self² + other²)` without overflow; 0 with derivative 0 at the origin.
    #[inline(always)]
    fn hypot(self, other: Self) -> Self {
        let (x, y) = (self.primal(), other.primal());
        let large = x.magnitude().most(y.magnitude());
        let zero = large.at_most(Self::Primal::zero());
        let scale = Self::Primal::select(zero, Self::Primal::one(), large).binade();
        let (scale, back) = (
            Self::from_primal(scale),
            Self::from_primal(Self::Primal::one().over(scale)),
        );
        let (x, y) = (self * scale, other * scale);
        (x * x + y * y).root() * back
    }
    /// The same value with the derivatives multiplied by a constant: shares a derivative at a tie that one comparison
    /// cannot detect.
    #[inline(always)]
    fn damp(self, share: Self::Primal) -> Self {
        let value = Self::from_primal(self.primal());
        value + (self - value) * Self::from_primal(share)
    }
    /// The same derivatives with another value, to correct rounding of the value alone.
    ///
    /// The literal zero as value says that products with it are zero: programs do not compute them, but their
    /// derivatives.
    #[inline(always)]
    fn with_primal(self, value: Self::Primal) -> Self {
        (self - Self::from_primal(self.primal())) + Self::from_primal(value)
    }
    /// `false` if it is known to be a number: an input of a program that is being recorded, whose columns are checked.
    #[doc(hidden)]
    #[inline(always)]
    fn may_be_nan(self) -> bool {
        true
    }
    /// The same where the mask is true, else NaN in every part, made of the given NaN.
    #[doc(hidden)]
    #[inline(always)]
    fn known(self, known: Self::Mask, nan: Self::Primal) -> Self {
        Self::select(known, self, self * Self::from_primal(nan))
    }
    /// True where the value is neither infinite nor NaN.
    ///
    /// A guard stands before the operation that needs it: `x.over(S::select(y.equals(zero), one, y))`, then a choice.
    /// On a GPU a check of the result is none, because drivers fold a divisor that is always zero, and what they make
    /// of the quotient is neither infinite nor NaN; nor does a check afterwards keep derivatives finite.
    #[inline(always)]
    fn finite(self) -> Self::Mask {
        self.unsigned().at_most(Self::lit(Self::LARGEST))
    }
    /// The nearest finite number: for results that overflow. Not a guard of a division by zero, for which see
    /// [`finite`](Scalar::finite).
    #[inline(always)]
    fn saturated(self) -> Self {
        let largest = Self::lit(Self::LARGEST);
        let low = Self::select(self.above(largest), largest, self);
        Self::select(low.below(-largest), -largest, low)
    }
    /// The same number; a zero loses its sign. Results end in it: which zero a sum of products gives
    /// depends on what was left out because nothing needed it.
    #[inline(always)]
    fn canonical(self) -> Self {
        self + Self::zero()
    }
    /// The sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// The cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// The tangent.
    #[inline(always)]
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin.over(cos)
    }
    /// `self` squared.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
    /// An integer power, by repeated multiplication.
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let (mut left, mut square, mut out) = (exponent.unsigned_abs(), self, Self::one());
        while left > 0 {
            if left & 1 == 1 {
                out *= square;
            }
            square *= square;
            left >>= 1;
        }
        if exponent < 0 {
            Self::one().over(out)
        } else {
            out
        }
    }
}

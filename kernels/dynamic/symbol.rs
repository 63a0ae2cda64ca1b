//! The operations of [`Scalar`] on symbols, as functions that refuse symbols of other recordings.
//!
//! A function is recorded between [`Tracing::start`](super::Tracing::start) and
//! [`Tracing::finish`](super::Tracing::finish). Symbols stand for its numbers, [`Truth`]s for comparisons of them. They
//! are valid on the thread of their recording until it is finished. Elsewhere every function here returns
//! [`Unrecordable::ForeignSymbol`](crate::Unrecordable::ForeignSymbol).
use crate::ad::program::opened::{is_open, is_open_in};
use crate::ad::program::{Sym, SymMask};
use crate::error::Error;
use crate::scalar::{Guard, elementary};
use crate::{Real, Scalar};

/// A number of the function that is being recorded.
#[derive(Clone, Copy, Debug)]
pub struct Symbol<T>(pub(super) Sym<T>);

/// A truth of the function that is being recorded.
#[derive(Clone, Copy, Debug)]
pub struct Truth<T>(SymMask<T>);

/// The result of a function here: an error for symbols of another recording or thread.
pub type Made<X> = Result<X, Error>;

impl<T: Real> Symbol<T> {
    /// Checks that the symbol belongs to the recording that is open on this thread.
    ///
    /// # Errors
    ///
    /// [`Error::Program`].
    pub fn belongs(self) -> Made<()> {
        self.0.belongs().map_err(Error::Program)
    }
}
impl<T: Real> Truth<T> {
    /// Checks that the truth belongs to the recording that is open on this thread.
    ///
    /// # Errors
    ///
    /// [`Error::Program`].
    pub fn belongs(self) -> Made<()> {
        self.0.belongs().map_err(Error::Program)
    }
}

/// Returns `true` while a recording is open on this thread.
#[must_use]
pub fn is_recording() -> bool {
    is_open()
}

/// Returns a literal, rounded to the format.
///
/// # Errors
///
/// [`Error::Program`] without a recording of the format on this thread.
pub fn literal<T: Real>(x: f64) -> Made<Symbol<T>> {
    is_open_in::<T>().map_err(Error::Program)?;
    Ok(Symbol(Sym::lit(x)))
}

/// Defines functions of symbols: documentation, name, arguments, and a formula of [`Scalar`].
macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident($($x:ident: $type:ident),+) -> $out:ident = $body:expr;)*) => { $(
        $(#[$doc])*
        ///
        /// # Errors
        ///
        /// [`Error::Program`] for symbols of another recording or thread.
        pub fn $name<T: Real>($($x: $type<T>),+) -> Made<$out<T>> {
            $($x.belongs()?;)+
            $(let $x = $x.0;)+
            let made = $out($body);
            // This finds a recording with too many operations.
            made.belongs()?;
            Ok(made)
        }
    )* };
}

functions! {
    /// Returns `−x`.
    neg(x: Symbol) -> Symbol = -x;
    /// Returns `a + b`.
    add(a: Symbol, b: Symbol) -> Symbol = a + b;
    /// Returns `a − b`.
    sub(a: Symbol, b: Symbol) -> Symbol = a - b;
    /// Returns `a b`.
    mul(a: Symbol, b: Symbol) -> Symbol = a * b;
    /// Returns `a / b`: [`Scalar::over`].
    over(a: Symbol, b: Symbol) -> Symbol = a.over(b);
    /// Returns the smaller one; an exact tie shares the derivative: [`Scalar::least`].
    least(a: Symbol, b: Symbol) -> Symbol = a.least(b);
    /// Returns the larger one; an exact tie shares the derivative: [`Scalar::most`].
    most(a: Symbol, b: Symbol) -> Symbol = a.most(b);
    /// Returns the nearest value in `[low, high]`; at either border the derivative is shared: [`Scalar::clamp`].
    clamp(x: Symbol, low: Symbol, high: Symbol) -> Symbol = x.clamp(low, high);
    /// Returns `x`, or NaN where `of` is NaN, since comparisons, [`least`] and [`most`] lose it.
    known(x: Symbol, of: Symbol) -> Symbol = Guard::of_numbers(&[of]).result(x);
    /// Returns `|x|`, with derivative 0 at 0: [`Scalar::magnitude`].
    magnitude(x: Symbol) -> Symbol = x.magnitude();
    /// Returns `|x|`, with derivative 1 at 0: [`Scalar::unsigned`].
    unsigned(x: Symbol) -> Symbol = x.unsigned();
    /// Returns `x`, negated where `side` is negative: [`Scalar::signed_as`].
    signed_as(x: Symbol, side: Symbol) -> Symbol = x.signed_as(side);
    /// Returns the square root; zero with derivative zero at zero and below: [`Scalar::root`].
    root(x: Symbol) -> Symbol = x.root();
    /// Returns the square root: NaN, with derivative NaN, below zero; derivative zero at zero.
    root_or_nan(x: Symbol) -> Symbol = elementary::root_or_nan(x);
    /// Returns the cube root, with derivative zero at zero.
    cbrt(x: Symbol) -> Symbol = elementary::cbrt(x);
    /// Returns `√(a² + b²)` without overflow; derivative zero at the origin: [`Scalar::hypot`].
    hypot(a: Symbol, b: Symbol) -> Symbol = a.hypot(b);
    /// Returns the sine of an angle in radians.
    sin(x: Symbol) -> Symbol = x.sin();
    /// Returns the cosine of an angle in radians.
    cos(x: Symbol) -> Symbol = x.cos();
    /// Returns the tangent of an angle in radians.
    tan(x: Symbol) -> Symbol = x.tan();
    /// Returns the angle of the vector `(x, y)` in radians, in `[−π, π]`: [`Scalar::atan2`].
    atan2(y: Symbol, x: Symbol) -> Symbol = y.atan2(x);
    /// Returns the exponential.
    exp(x: Symbol) -> Symbol = x.exp();
    /// Returns the natural logarithm.
    ln(x: Symbol) -> Symbol = x.ln();
    /// Returns `eˣ − 1`, right near zero.
    exp_m1(x: Symbol) -> Symbol = elementary::exp_m1(x);
    /// Returns `ln(1 + x)`, right near zero.
    ln_1p(x: Symbol) -> Symbol = elementary::ln_1p(x);
    /// Returns the logarithm to the base 2.
    log2(x: Symbol) -> Symbol = elementary::ln_over(x, std::f64::consts::LN_2);
    /// Returns the logarithm to the base 10.
    log10(x: Symbol) -> Symbol = elementary::ln_over(x, std::f64::consts::LN_10);
    /// Returns `ln(eᵃ + eᵇ)` without overflow.
    ln_of_exponentials(a: Symbol, b: Symbol) -> Symbol = elementary::ln_of_exponentials(a, b);
    /// Returns the hyperbolic sine.
    sinh(x: Symbol) -> Symbol = elementary::sinh(x);
    /// Returns the hyperbolic cosine.
    cosh(x: Symbol) -> Symbol = elementary::cosh(x);
    /// Returns the hyperbolic tangent.
    tanh(x: Symbol) -> Symbol = elementary::tanh(x);
    /// Returns the inverse of the hyperbolic sine.
    arcsinh(x: Symbol) -> Symbol = elementary::arcsinh(x);
    /// Returns the inverse of the hyperbolic cosine; NaN below 1.
    arccosh(x: Symbol) -> Symbol = elementary::arccosh(x);
    /// Returns the inverse of the hyperbolic tangent; NaN beyond ±1.
    arctanh(x: Symbol) -> Symbol = elementary::arctanh(x);
    /// Returns the angle in `[−π/2, π/2]` with a sine; NaN beyond ±1, where its derivative is zero.
    arcsin(x: Symbol) -> Symbol = elementary::arcsin(x);
    /// Returns the angle in `[0, π]` with a cosine; NaN beyond ±1, where its derivative is zero.
    arccos(x: Symbol) -> Symbol = elementary::arccos(x);
    /// Returns the angle in `[−π/2, π/2]` with a tangent.
    arctan(x: Symbol) -> Symbol = elementary::arctan(x);
    /// Returns `xʸ` for `x ≥ 0`; NaN below zero.
    power_of(x: Symbol, y: Symbol) -> Symbol = elementary::power_of(x, y);
    /// Returns the nearest whole number, of two the even one; without derivative.
    rint(x: Symbol) -> Symbol = elementary::rint(x);
    /// Returns the largest whole number that is not above `x`; without derivative.
    floor(x: Symbol) -> Symbol = elementary::floor(x);
    /// Returns the smallest whole number that is not below `x`; without derivative.
    ceil(x: Symbol) -> Symbol = elementary::ceil(x);
    /// Returns `x` without the digits after its point; without derivative.
    trunc(x: Symbol) -> Symbol = elementary::trunc(x);
    /// Returns the largest whole number that is not above `a / b`; without derivative.
    floor_divide(a: Symbol, b: Symbol) -> Symbol = elementary::floor_divide(a, b);
    /// Returns `a` less the multiple of `b` below it: zero, or of the sign of `b`.
    remainder(a: Symbol, b: Symbol) -> Symbol = elementary::remainder(a, b);
    /// Returns 1, −1 or 0 by the sign of `x`; without derivative.
    sign(x: Symbol) -> Symbol = elementary::sign(x);
    /// Returns `x²`.
    squared(x: Symbol) -> Symbol = x.squared();
    /// Returns `x / 2`.
    halved(x: Symbol) -> Symbol = x.halved();
    /// Returns the power of two that brings `x > 0` into `[2, 4)`, a constant: [`Scalar::binade`].
    binade(x: Symbol) -> Symbol = x.binade();
    /// Returns the value without its derivatives: [`Scalar::primal`].
    primal(x: Symbol) -> Symbol = x.primal();
    /// Returns the derivatives of `x` at another value: [`Scalar::with_primal`].
    with_primal(x: Symbol, value: Symbol) -> Symbol = x.with_primal(value);
    /// Returns the value of `x` with its derivatives multiplied by `share`: [`Scalar::damp`].
    damp(x: Symbol, share: Symbol) -> Symbol = x.damp(share);
    /// Returns the nearest finite number: [`Scalar::saturated`].
    saturated(x: Symbol) -> Symbol = x.saturated();
    /// Returns `x` with the sign removed from a zero: [`Scalar::canonical`].
    canonical(x: Symbol) -> Symbol = x.canonical();
    /// Returns `a < b`.
    below(a: Symbol, b: Symbol) -> Truth = a.below(b);
    /// Returns `a ≤ b`.
    at_most(a: Symbol, b: Symbol) -> Truth = a.at_most(b);
    /// Returns `a > b`.
    above(a: Symbol, b: Symbol) -> Truth = a.above(b);
    /// Returns `a ≥ b`.
    at_least(a: Symbol, b: Symbol) -> Truth = a.at_least(b);
    /// Returns `a = b`.
    equals(a: Symbol, b: Symbol) -> Truth = a.equals(b);
    /// Returns `true` where the value is neither infinite nor NaN: [`Scalar::finite`].
    finite(x: Symbol) -> Truth = x.finite();
    /// Returns the conjunction of two truths.
    and(a: Truth, b: Truth) -> Truth = a & b;
    /// Returns the disjunction of two truths.
    or(a: Truth, b: Truth) -> Truth = a | b;
    /// Returns the negation of a truth.
    not(x: Truth) -> Truth = !x;
    /// Returns `yes` where the truth holds, else `no`, without effects of the other one: [`Scalar::select`].
    select(truth: Truth, yes: Symbol, no: Symbol) -> Symbol = Sym::select(truth, yes, no);
}

/// Returns a whole power, by repeated multiplication: [`Scalar::powi`].
///
/// # Errors
///
/// [`Error::Program`] for symbols of another recording or thread.
pub fn powi<T: Real>(x: Symbol<T>, exponent: i32) -> Made<Symbol<T>> {
    x.belongs()?;
    Ok(Symbol(x.0.powi(exponent)))
}

/// Returns a power of any exponent up to 2³⁰: NaN below zero unless the exponent is whole.
///
/// # Errors
///
/// [`Error::Program`] for symbols of another recording or thread.
pub fn power<T: Real>(x: Symbol<T>, exponent: f64) -> Made<Symbol<T>> {
    x.belongs()?;
    let made = Symbol(elementary::power(x.0, exponent));
    made.belongs()?;
    Ok(made)
}

/// Splits `x` into `(high, low)` with `high + low = x` exactly, `high` a constant of half the significand:
/// [`Scalar::parts`].
///
/// # Errors
///
/// [`Error::Program`] for symbols of another recording or thread.
pub fn parts<T: Real>(x: Symbol<T>) -> Made<(Symbol<T>, Symbol<T>)> {
    x.belongs()?;
    let (high, low) = x.0.parts();
    Ok((Symbol(high), Symbol(low)))
}

/// Returns sine and cosine, each as a short high part and the rest: [`Scalar::sin_cos_parts`].
///
/// # Errors
///
/// [`Error::Program`] for symbols of another recording or thread.
pub fn sin_cos_parts<T: Real>(x: Symbol<T>) -> Made<[(Symbol<T>, Symbol<T>); 2]> {
    x.belongs()?;
    let parts = x.0.sin_cos_parts();
    Ok(parts.map(|(high, low)| (Symbol(high), Symbol(low))))
}

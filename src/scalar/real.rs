//! The two types of plain numbers: `f32` and `f64`.
use crate::scalar::format::Format;
use crate::{Pack, Scalar};
use std::any::Any;

/// A result that is one number, `f32` or `f64`: what has a gradient.
#[diagnostic::on_unimplemented(
    message = "`.value_grad()` needs one number as result, and `{Self}` is none",
    label = "the result is `{Self}`",
    note = "`.jacobian()` gives the gradient of every number of a result, `.vjp()` that of their sum times cotangents"
)]
#[doc(hidden)]
pub trait OneNumber {}

impl OneNumber for f32 {}
impl OneNumber for f64 {}

/// `f32` or `f64`: the formats that programs and batches compute in.
pub trait Real:
    OneNumber + Scalar<Mask = bool, Primal = Self> + Pack<Scalar = Self> + Default + PartialOrd
{
    /// Its format.
    const FORMAT: Format;
    /// num-dual's own dual number over it.
    type NumDual: Scalar<Mask = bool>;
    /// The bit pattern as an integer, also the type of a lane's mask.
    #[doc(hidden)]
    type Bits: Copy + std::fmt::Debug + Send + Sync + 'static;
    /// All zeros.
    #[doc(hidden)]
    const NONE: Self::Bits;
    /// Returns a dual number of num-dual's.
    fn num_dual(value: Self, derivative: Self) -> Self::NumDual;
    /// Returns its value and its derivative.
    fn of_num_dual(dual: Self::NumDual) -> (Self, Self);
    /// Returns the number nearest to an `f64`.
    #[inline]
    fn nearest(x: f64) -> Self {
        Self::lit(x)
    }
    /// Returns the exact value as `f64`.
    #[doc(hidden)]
    fn widen(self) -> f64;
    /// Returns the high half of the significand.
    #[doc(hidden)]
    fn high(self) -> Self;
    /// Returns all ones if `yes`.
    #[doc(hidden)]
    fn mask(yes: bool) -> Self::Bits;
    /// Selects bit by bit.
    #[doc(hidden)]
    fn choose(mask: Self::Bits, yes: Self, no: Self) -> Self;
    /// Returns the bitwise and.
    #[doc(hidden)]
    fn and(a: Self::Bits, b: Self::Bits) -> Self::Bits;
    /// Returns the bitwise or.
    #[doc(hidden)]
    fn or(a: Self::Bits, b: Self::Bits) -> Self::Bits;
    /// Returns the bitwise complement.
    #[doc(hidden)]
    fn not(a: Self::Bits) -> Self::Bits;
}

/// Returns the one of two values, in `f32` and in `f64`, that has the type of the format in question.
#[inline]
pub(crate) fn in_format<X: 'static>(both: [&dyn Any; 2]) -> &X {
    let found = both.into_iter().find_map(|one| one.downcast_ref());
    found.unwrap_or_else(|| unreachable!("there are two formats"))
}

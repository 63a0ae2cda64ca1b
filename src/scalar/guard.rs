//! NaN in, NaN out: what functions of shapes do with a NaN among the numbers of their arguments.
//!
//! A comparison with NaN is false, so that the least of NaN and a number is a number, and a search takes another
//! candidate. A [`Guard`] of a function's arguments makes every number of its result NaN instead. Finite arguments keep
//! every bit of the result and of its derivatives, the signs of zeros included: it is chosen, or multiplied by one.
//!
//! A recording has the guard of such numbers alone that may be NaN: columns are checked before a program runs, so that its
//! inputs are finite.
use crate::{Fixed, Pack, Scalar};

/// The sum of the numbers of some shapes: NaN as soon as one of them is.
///
/// A sum of finite numbers one by one is no NaN: beyond the largest number it is infinite, and stays so.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Guard<S: Scalar>(Option<S::Primal>);

impl<S: Scalar> Guard<S> {
    /// Creates the guard of no shapes.
    #[must_use]
    #[inline(always)]
    pub const fn new() -> Self {
        Guard(None)
    }
    /// Creates the guard of one shape.
    #[must_use]
    #[inline(always)]
    pub fn of<P: Pack<Scalar = S>>(shape: &P) -> Self {
        Self::new().and(shape)
    }
    /// Adds the numbers of another shape.
    #[must_use]
    #[inline(always)]
    pub fn and<P: Pack<Scalar = S>>(mut self, shape: &P) -> Self {
        shape.remake(&mut |&x| self = self.and_number(x));
        self
    }
    /// Creates the guard of some numbers.
    #[must_use]
    #[inline(always)]
    pub fn of_numbers(numbers: &[S]) -> Self {
        let start = Self::new();
        numbers.iter().fold(start, |all, &x| all.and_number(x))
    }
    /// Adds another number.
    #[must_use]
    #[inline(always)]
    pub fn and_number(self, x: S) -> Self {
        match self.0 {
            _ if !x.may_be_nan() => self,
            None => Guard(Some(x.primal())),
            Some(sum) => Guard(Some(sum + x.primal())),
        }
    }
    /// Returns a condition about these shapes, or false if a number is NaN.
    #[must_use]
    #[inline(always)]
    pub fn truth(self, holds: S::Mask) -> S::Mask {
        self.0.map_or(holds, |sum| holds & sum.equals(sum))
    }
    /// Returns the result of a function of these shapes: as it is, or NaN everywhere. Codes stay.
    #[must_use]
    #[inline(always)]
    pub fn result<Out: Fixed<Scalar = S>>(self, mut out: Out) -> Out {
        if let Some(sum) = self.0 {
            let known = sum.equals(sum);
            out.each(&mut |x| *x = x.known(known, sum));
        }
        out
    }
}

impl<S: Scalar> Default for Guard<S> {
    fn default() -> Self {
        Self::new()
    }
}

/// Returns the result of a function of a shape, which has the shape's scalar: NaN everywhere if a number of the shape
/// is NaN.
#[doc(hidden)]
#[must_use]
#[inline(always)]
pub fn guarded<In, Out>(input: In, function: impl FnOnce(In) -> Out) -> Out
where
    In: Fixed<Scalar: Scalar>,
    Out: Fixed<Scalar = In::Scalar>,
{
    Guard::of(&input).result(function(input))
}

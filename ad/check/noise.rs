//! Stochastic arithmetic: a scalar whose every operation rounds at random.
//!
//! Moving the input shows how a function amplifies errors of its input. Intermediate results that are larger than both
//! input and result (the coordinates whose difference is the length of a crossing) round, too. Only a run whose own
//! roundings fall differently shows that. This is discrete stochastic arithmetic (Vignes): each result moves by one
//! unit in its last place up, down, or not at all. The deviation of a few runs estimates the error of one. Exact
//! results stay, and equal ones move alike, so that most ties stay ties.
use crate::ad::check::trace::{wrapped, wrapped_operators};
use crate::ad::check::witness::Precision;
use crate::ad::sample::Draw;
use crate::{Real, Scalar};
use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

thread_local! {
    // An operator has no argument for a seed, so it belongs to the thread.
    static SEED: Cell<u64> = const { Cell::new(0) };
}

/// Runs a function with roundings of [`Noisy`] numbers drawn from a seed.
pub fn noisy<R>(seed: u64, run: impl FnOnce() -> R) -> R {
    SEED.set(seed);
    run()
}

/// A float whose operations round at random.
#[derive(Clone, Copy, Debug, Default)]
pub struct Noisy<T>(
    /// The number.
    pub T,
);

impl<T: Real> Noisy<T> {
    /// Returns a result with a random change of its rounding.
    fn rounded(x: T) -> Self {
        let x = x.widen();
        let mut draw = Draw::new(x.abs().to_bits() ^ SEED.get().wrapping_mul(0x9e37_79b9));
        let by = draw.below(3) as i32 - 1;
        Noisy(T::nearest(Precision::of::<T>().away_from_zero(x, by)))
    }
    /// Returns a result with a random change of its rounding, unless it is `exact`.
    fn unless(x: T, exact: bool) -> Self {
        if exact { Noisy(x) } else { Self::rounded(x) }
    }
}

/// Operators, each with a rounding of its own.
macro_rules! rounded {
    ($($operator:ident $method:ident |$a:ident, $b:ident, $x:ident| $exact:expr;)*) => { $(
        impl<T: Real> $operator for Noisy<T> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let out = self.0.$method(other.0);
                let ($a, $b, $x) = (self.0.widen(), other.0.widen(), out.widen());
                Self::unless(out, $exact)
            }
        }
    )* };
}
rounded! {
    Add add |a, b, x| x - a == b && x - b == a;
    Sub sub |a, b, x| x - a == -b && x + b == a;
    Mul mul |a, b, x| a.mul_add(b, -x) == 0.0;
    Div div |a, b, x| x.mul_add(b, -a) == 0.0;
}
wrapped_operators!(Noisy, |x| Noisy(-x.0));

impl<T: Real> Scalar for Noisy<T> {
    wrapped!(Noisy of T);

    fn below(self, other: Self) -> bool {
        self.0.below(other.0)
    }
    fn at_most(self, other: Self) -> bool {
        self.0.at_most(other.0)
    }
    fn equals(self, other: Self) -> bool {
        self.0.equals(other.0)
    }
    fn over(self, divisor: Self) -> Self {
        let out = self.0.over(divisor.0);
        let exact = out.widen().mul_add(divisor.0.widen(), -self.0.widen()) == 0.0;
        Self::unless(out, exact)
    }
    fn root(self) -> Self {
        Self::rounded(self.0.root())
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Self::rounded(sin), Self::rounded(cos))
    }
    fn sin_cos_parts(self) -> [(Self, Self); 2] {
        // The low part rounds; noise in the high one would make it useless.
        self.0
            .sin_cos_parts()
            .map(|(high, low)| (Noisy(high), Self::rounded(low)))
    }
    fn atan2(self, x: Self) -> Self {
        Self::rounded(self.0.atan2(x.0))
    }
    fn exp(self) -> Self {
        Self::rounded(self.0.exp())
    }
    fn ln(self) -> Self {
        Self::rounded(self.0.ln())
    }
    fn least(self, other: Self) -> Self {
        Noisy(self.0.least(other.0))
    }
    fn most(self, other: Self) -> Self {
        Noisy(self.0.most(other.0))
    }
}

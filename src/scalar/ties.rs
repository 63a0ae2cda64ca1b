//! The least and the largest of several numbers, where all that tie share the derivative equally.
//!
//! [`Scalar::least`] and [`Scalar::most`] share between two. A chain of them gives a tie of three a
//! quarter, a quarter and a half, by the order of the chain; these functions give thirds.
use crate::Scalar;
use std::any::TypeId;

/// Returns the least of `N ≥ 1` numbers; those that tie share the derivative equally.
///
/// Kinks: ties. Infinite numbers that tie leave the derivative to the first.
///
/// ```
/// use geograd::{Jet, scalar::least_of};
/// let x: [Jet<f64, 4>; 4] = std::array::from_fn(|i| Jet::variable(2.0, i));
/// assert_eq!(least_of(x).derivative, [0.25; 4]);
/// assert_eq!(least_of([3.0, 1.0, 2.0, 1.0]), 1.0);
/// ```
#[must_use]
#[inline(always)]
pub fn least_of<S: Scalar, const N: usize>(x: [S; N]) -> S {
    Extreme::<S, false>::of_all(x)
}

/// Returns the largest of `N ≥ 1` numbers; those that tie share the derivative equally.
///
/// Kinks: ties. Infinite numbers that tie leave the derivative to the first.
///
/// ```
/// use geograd::{Jet, scalar::most_of};
/// let x: [Jet<f64, 4>; 4] = std::array::from_fn(|i| Jet::variable(2.0, i));
/// assert_eq!(most_of(x).derivative, [0.25; 4]);
/// assert_eq!(most_of([3.0, 1.0, 2.0, 3.0]), 3.0);
/// ```
#[must_use]
#[inline(always)]
pub fn most_of<S: Scalar, const N: usize>(x: [S; N]) -> S {
    Extreme::<S, true>::of_all(x)
}

/// The least number so far, or the largest, with all that tie with it.
#[derive(Clone, Copy, Debug)]
struct Extreme<S: Scalar, const MOST: bool> {
    /// The first one of those that tie.
    first: S,
    /// The sum of the others less the first: no value, only derivatives.
    rest: S,
    /// The number of those that tie.
    count: S::Primal,
}

impl<S: Scalar, const MOST: bool> Extreme<S, MOST> {
    /// Creates the extreme of one number.
    #[inline(always)]
    fn new(x: S) -> Self {
        Extreme {
            first: x,
            rest: S::zero(),
            count: S::Primal::one(),
        }
    }
    #[inline(always)]
    fn of_all<const N: usize>(x: [S; N]) -> S {
        const { assert!(N > 0, "there is no least of no numbers") };
        if N == 3 {
            return Self::of_three(x[0], x[1], x[2]);
        }
        let mut best = Self::new(x[0]);
        for &x in &x[1..] {
            best = best.or(x);
        }
        best.value()
    }
    /// Returns the extreme of three numbers, by two comparisons. A tie of all takes a sixth from the share of the
    /// third: from a half to a third.
    #[inline(always)]
    fn of_three(x: S, y: S, z: S) -> S {
        let of = |x: S, y: S| if MOST { x.most(y) } else { x.least(y) };
        let pair = of(x, y);
        // The difference of infinite numbers is none.
        let all = x.equals(y) & pair.equals(z) & z.finite();
        let more = (pair - z) * S::lit(1.0 / 6.0);
        of(pair, z) + S::select(all, more, S::zero())
    }
    /// Adds another number.
    #[must_use]
    #[inline(always)]
    fn or(self, x: S) -> Self {
        // Plain numbers have nothing to share: one comparison.
        let plain = TypeId::of::<S>();
        if plain == TypeId::of::<f32>() || plain == TypeId::of::<f64>() {
            let first = if MOST {
                self.first.most(x)
            } else {
                self.first.least(x)
            };
            return Extreme { first, ..self };
        }
        let better = if MOST {
            x.above(self.first)
        } else {
            x.below(self.first)
        };
        // The difference of infinite numbers is none.
        let tie = x.equals(self.first) & x.finite();
        let (none, one) = (S::Primal::zero(), S::Primal::one());
        let rest = S::select(tie, self.rest + (x - self.first), self.rest);
        let count = self.count + S::Primal::select(tie, one, none);
        Extreme {
            first: S::select(better, x, self.first),
            rest: S::select(better, S::zero(), rest),
            count: S::Primal::select(better, one, count),
        }
    }
    /// Returns the value, with the mean of the derivatives.
    #[must_use]
    #[inline(always)]
    fn value(self) -> S {
        let share = S::Primal::one().over(self.count);
        self.first + self.rest * S::from_primal(share)
    }
}

/// The least and the largest of numbers that are added one by one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span<S: Scalar> {
    low: Extreme<S, false>,
    high: Extreme<S, true>,
}

impl<S: Scalar> Span<S> {
    /// Returns the span of one number.
    #[inline(always)]
    pub(crate) fn new(x: S) -> Self {
        Span {
            low: Extreme::new(x),
            high: Extreme::new(x),
        }
    }
    /// Adds another number.
    #[must_use]
    #[inline(always)]
    pub(crate) fn or(self, x: S) -> Self {
        Span {
            low: self.low.or(x),
            high: self.high.or(x),
        }
    }
    /// Returns the least; those that tie share the derivative equally.
    #[must_use]
    #[inline(always)]
    pub(crate) fn least(self) -> S {
        self.low.value()
    }
    /// Returns the largest; those that tie share the derivative equally.
    #[must_use]
    #[inline(always)]
    pub(crate) fn most(self) -> S {
        self.high.value()
    }
}

//! Branch tracing of several inputs side by side: a program reads each of its nodes once for all of them.
//!
//! Values and traces equal those of [`Traced`](crate::ad::check::trace::Traced) for each input, to the bit.
use crate::ad::check::trace::{Trace, forward, wrapped_operators};
use crate::{Mask, Real, Scalar};
use std::cell::RefCell;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// The number of inputs side by side: a third of a sequence's steps.
pub(crate) const LANES: usize = 8;

thread_local! {
    // As for one input: a comparison yields a mask, which cannot carry a history.
    static TAPES: RefCell<[Trace; LANES]> = const { RefCell::new([Trace::EMPTY; LANES]) };
}

/// Runs a function and returns its result and the trace of each lane.
pub(crate) fn trace_lanes<R>(run: impl FnOnce() -> R) -> (R, [Trace; LANES]) {
    let outer = TAPES.replace([Trace::EMPTY; LANES]);
    let result = run();
    (result, TAPES.replace(outer))
}

/// Numbers side by side that record their comparisons.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TracedLanes<T>(pub(crate) [T; LANES]);

/// The outcomes of a comparison.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcomes([bool; LANES]);

impl BitAnd for Outcomes {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Outcomes(lanes(|i| self.0[i] & other.0[i]))
    }
}
impl BitOr for Outcomes {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Outcomes(lanes(|i| self.0[i] | other.0[i]))
    }
}
impl Not for Outcomes {
    type Output = Self;
    fn not(self) -> Self {
        Outcomes(self.0.map(|outcome| !outcome))
    }
}
impl Mask for Outcomes {
    fn any(self) -> bool {
        self.0.contains(&true)
    }
    fn all(self) -> bool {
        !self.0.contains(&false)
    }
}

/// Returns one value per lane.
#[inline(always)]
fn lanes<U>(of: impl FnMut(usize) -> U) -> [U; LANES] {
    std::array::from_fn(of)
}

impl<T: Real> TracedLanes<T> {
    #[inline(always)]
    fn each(self, of: impl Fn(T) -> T) -> Self {
        TracedLanes(lanes(|i| of(self.0[i])))
    }
    #[inline(always)]
    fn both(self, other: Self, of: impl Fn(T, T) -> T) -> Self {
        TracedLanes(lanes(|i| of(self.0[i], other.0[i])))
    }
    /// Returns two results of each lane.
    #[inline(always)]
    fn pair(self, of: impl Fn(T) -> (T, T)) -> (Self, Self) {
        let pairs = lanes(|i| of(self.0[i]));
        (
            TracedLanes(pairs.map(|pair| pair.0)),
            TracedLanes(pairs.map(|pair| pair.1)),
        )
    }
    /// Records a comparison in every lane that makes it, and returns its outcomes.
    #[inline(always)]
    fn note(
        self,
        other: Self,
        made: impl Fn(usize) -> bool,
        of: impl Fn(T, T) -> bool,
    ) -> Outcomes {
        let outcomes = lanes(|i| of(self.0[i], other.0[i]));
        TAPES.with_borrow_mut(|tapes| {
            for i in (0..LANES).filter(|&i| made(i)) {
                tapes[i].record(outcomes[i], self.0[i].widen(), other.0[i].widen());
            }
        });
        Outcomes(outcomes)
    }
}

forward!(TracedLanes: Add add, Sub sub, Mul mul, Div div);
wrapped_operators!(TracedLanes, |x| x.each(T::neg));

impl<T: Real> Scalar for TracedLanes<T> {
    type Mask = Outcomes;
    type Primal = Self;
    #[inline(always)]
    fn format() -> crate::scalar::Format {
        T::format()
    }

    #[inline(always)]
    fn lit(x: f64) -> Self {
        TracedLanes([T::nearest(x); LANES])
    }
    #[inline(always)]
    fn from_primal(x: Self) -> Self {
        x
    }
    #[inline(always)]
    fn primal(self) -> Self {
        self
    }
    #[inline(always)]
    fn below(self, other: Self) -> Outcomes {
        self.note(other, |_| true, T::below)
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> Outcomes {
        self.note(other, |_| true, T::at_most)
    }
    #[inline(always)]
    fn equals(self, other: Self) -> Outcomes {
        self.note(other, |_| true, T::equals)
    }
    #[inline(always)]
    fn select(mask: Outcomes, yes: Self, no: Self) -> Self {
        TracedLanes(lanes(|i| if mask.0[i] { yes.0[i] } else { no.0[i] }))
    }
    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        self.both(divisor, T::over)
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.at_most(Self::zero());
        self.each(T::root)
    }
    fn sin_cos(self) -> (Self, Self) {
        self.pair(T::sin_cos)
    }
    fn sin_cos_parts(self) -> [(Self, Self); 2] {
        [0, 1].map(|k| self.pair(|x| x.sin_cos_parts()[k]))
    }
    fn parts(self) -> (Self, Self) {
        self.pair(T::parts)
    }
    fn atan2(self, x: Self) -> Self {
        let behind = x.below(Self::zero());
        self.note(Self::zero(), |i| behind.0[i], T::below);
        self.both(x, T::atan2)
    }
    fn exp(self) -> Self {
        self.each(T::exp)
    }
    fn ln(self) -> Self {
        self.each(T::ln)
    }
    fn binade(self) -> Self {
        self.each(Scalar::binade)
    }
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        self.equals(other);
        Self::select(self.below(other), self, other)
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        self.equals(other);
        Self::select(other.below(self), self, other)
    }
    #[inline(always)]
    fn damp(self, _share: Self) -> Self {
        self
    }
    #[inline(always)]
    fn with_primal(self, value: Self) -> Self {
        value
    }
}

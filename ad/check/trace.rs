//! Branch tracing: a scalar that records the outcome of every comparison.
//!
//! A function takes the same branches at two points with equal [`Trace`]s. If it is made of arithmetic, it is then smooth
//! between them, and finite differences are reliable. Between points with different traces there may be a kink, or only
//! a harmless change of branch. The smallest margin of the comparisons says how near it is.
//!
//! ```
//! use geograd::ad::check::trace::{Traced, trace};
//! use geograd::Scalar;
//! let larger = |x: f64, y: f64| trace(|| Traced(x).most(Traced(y)).0);
//! let (value, here) = larger(2.0, 1.0);
//! assert_eq!((value, here.margin), (2.0, 0.5));
//! assert_eq!(here.hash, larger(3.0, 1.0).1.hash); // the same branch
//! assert_ne!(here.hash, larger(1.0, 2.0).1.hash); // another one
//! assert_eq!(larger(1.0, 1.0).1.margin, 0.0); // a tie
//! ```
use crate::{Real, Scalar};
use std::cell::Cell;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// The comparisons that one run recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trace {
    /// A hash of the outcomes of all comparisons, in order.
    pub hash: u64,
    /// The number of comparisons.
    pub count: u64,
    /// The smallest relative difference of two compared numbers: zero at a tie, infinite without comparisons.
    pub margin: f64,
}

impl Trace {
    /// A trace without comparisons.
    pub(crate) const EMPTY: Trace = Trace {
        hash: 0xcbf2_9ce4_8422_2325,
        count: 0,
        margin: f64::INFINITY,
    };
    /// Returns the trace of a replay with the record that it follows.
    pub(crate) fn with_record(self, record: &impl Hash) -> Self {
        let mut hasher = DefaultHasher::new();
        (self.hash, record).hash(&mut hasher);
        Trace {
            hash: hasher.finish(),
            ..self
        }
    }
    /// Adds a comparison of `x` with `y`.
    #[inline]
    pub(crate) fn record(&mut self, outcome: bool, x: f64, y: f64) {
        // FNV-1a, one byte per comparison.
        self.hash = (self.hash ^ u64::from(outcome)).wrapping_mul(0x0100_0000_01b3);
        self.count += 1;
        let size = x.abs().max(y.abs());
        let margin = if x == y { 0.0 } else { (x - y).abs() / size };
        if margin < self.margin {
            self.margin = margin;
        }
    }
}

thread_local! {
    // A comparison returns a plain `bool`, which cannot carry a trace, so the trace belongs to the thread.
    static CURRENT: Cell<Trace> = const { Cell::new(Trace::EMPTY) };
}

/// Runs a function and returns its result and the trace of its [`Traced`] numbers. Calls may be nested; an outer trace
/// does not include inner ones.
pub fn trace<R>(run: impl FnOnce() -> R) -> (R, Trace) {
    let outer = CURRENT.replace(Trace::EMPTY);
    let result = run();
    (result, CURRENT.replace(outer))
}

/// A float that records its comparisons: `Traced<f64>`, `Traced<f32>`, or the scalar of a dual, `Jet<Traced<f64>, N>`.
/// Values equal those of the float, to the bit.
#[derive(Clone, Copy, Debug, Default)]
pub struct Traced<T>(
    /// The number.
    pub T,
);

/// Returns dual numbers of the crate num-dual, made of values and a direction.
pub(crate) fn num_duals<S: Real>(x: &[f64], direction: &[f64]) -> Vec<S::NumDual> {
    let each = x.iter().zip(direction);
    each.map(|(&x, &d)| S::num_dual(S::nearest(x), S::nearest(d)))
        .collect()
}
/// Returns the values and the derivatives of a list of num-dual's dual numbers.
pub(crate) fn of_num_duals<S: Real>(list: Vec<S::NumDual>) -> (Vec<f64>, Vec<f64>) {
    let parts = list.into_iter().map(S::of_num_dual);
    parts
        .map(|(y, derivative)| (y.widen(), derivative.widen()))
        .unzip()
}

impl<T: Real> Traced<T> {
    #[inline(always)]
    fn both(self, other: Self, of: impl Fn(T, T) -> T) -> Self {
        Traced(of(self.0, other.0))
    }
    /// Records a comparison and returns its outcome.
    #[inline(always)]
    fn note(self, other: Self, outcome: bool) -> bool {
        CURRENT.with(|current| {
            let mut trace = current.get();
            trace.record(outcome, self.0.widen(), other.0.widen());
            current.set(trace);
        });
        outcome
    }
}

/// Writes the items of `Scalar` that are the same for every wrapper of one float.
macro_rules! wrapped {
    ($wrapper:ident of $number:ident) => {
        type Mask = bool;
        type Primal = Self;
        #[inline(always)]
        fn format() -> crate::scalar::Format {
            <$number as Scalar>::format()
        }

        #[inline(always)]
        fn lit(x: f64) -> Self {
            $wrapper($number::nearest(x))
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
        fn widened(self) -> Option<f64> {
            Some(self.0.widen())
        }
        #[inline(always)]
        fn select(mask: bool, yes: Self, no: Self) -> Self {
            if mask { yes } else { no }
        }
        #[inline(always)]
        fn parts(self) -> (Self, Self) {
            let (high, low) = self.0.parts();
            ($wrapper(high), $wrapper(low))
        }
        #[inline(always)]
        fn binade(self) -> Self {
            $wrapper(Scalar::binade(self.0))
        }
        #[inline(always)]
        fn damp(self, _share: Self) -> Self {
            self
        }
        #[inline(always)]
        fn with_primal(self, value: Self) -> Self {
            value
        }
    };
}
/// Implements the operators of a wrapper that follow from others; `$negated` is the value of `-$x`.
macro_rules! wrapped_operators {
    ($wrapper:ident, |$x:ident| $negated:expr) => {
        impl<T: Real> AddAssign for $wrapper<T> {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl<T: Real> SubAssign for $wrapper<T> {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl<T: Real> MulAssign for $wrapper<T> {
            #[inline(always)]
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }
        impl<T: Real> Neg for $wrapper<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let $x = self;
                $negated
            }
        }
        crate::pack::leaf! {
            [T: Real] $wrapper<T>,
        }
    };
}
/// Implements operators that compute a value and record nothing, by the method `both` of a wrapper.
macro_rules! forward {
    ($wrapper:ident: $($operator:ident $method:ident),*) => { $(
        impl<T: Real> $operator for $wrapper<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.both(other, T::$method)
            }
        }
    )* };
}
pub(crate) use {forward, wrapped, wrapped_operators};

forward!(Traced: Add add, Sub sub, Mul mul, Div div);
wrapped_operators!(Traced, |x| Traced(-x.0));

impl<T: Real> Scalar for Traced<T> {
    wrapped!(Traced of T);

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self.note(other, self.0.below(other.0))
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self.note(other, self.0.at_most(other.0))
    }
    #[inline(always)]
    fn equals(self, other: Self) -> bool {
        self.note(other, self.0.equals(other.0))
    }
    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        Traced(self.0.over(divisor.0))
    }
    #[inline(always)]
    fn root(self) -> Self {
        // A root has a kink at zero, so the comparison with zero is recorded.
        self.at_most(Self::zero());
        Traced(self.0.root())
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Traced(sin), Traced(cos))
    }
    #[inline(always)]
    fn sin_cos_parts(self) -> [(Self, Self); 2] {
        self.0
            .sin_cos_parts()
            .map(|(high, low)| (Traced(high), Traced(low)))
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        // The angle jumps across the negative x axis, so the side of it is recorded.
        if x.below(Self::zero()) {
            self.below(Self::zero());
        }
        Traced(self.0.atan2(x.0))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        Traced(self.0.exp())
    }
    #[inline(always)]
    fn ln(self) -> Self {
        Traced(self.0.ln())
    }
    // The value is that of the float; the tie is recorded as by the default of the trait.
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        self.equals(other);
        if self.below(other) { self } else { other }
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        self.equals(other);
        if other.below(self) { self } else { other }
    }
}

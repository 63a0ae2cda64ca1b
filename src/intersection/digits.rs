//! Sums and products without rounding, or with that of twice the digits, and without branches.
use crate::Scalar;

/// The sum of two numbers: first what the rounded one lacks (Knuth).
#[inline(always)]
pub(crate) fn sum<P: Scalar>(a: P, b: P) -> [P; 2] {
    let rounded = a + b;
    let taken = rounded - a;
    [(a - (rounded - taken)) + (b - taken), rounded]
}

/// A number with two halves of its digits (Veltkamp).
#[derive(Clone, Copy)]
pub(crate) struct Halves<P> {
    whole: P,
    high: P,
    low: P,
}

impl<P: Scalar> Halves<P> {
    #[inline(always)]
    pub(crate) fn of(whole: P) -> Self {
        // 2 to the number of digits of the low half, and one.
        let wide = P::EPSILON < 1e-10;
        let large = whole * P::lit(if wide { 134_217_729.0 } else { 4097.0 });
        let high = large - (large - whole);
        let low = whole - high;
        Halves { whole, high, low }
    }
    /// The product: first what the rounded one lacks (Dekker).
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> [P; 2] {
        let rounded = self.whole * other.whole;
        let high = self.high * other.high - rounded;
        let middle = (high + self.high * other.low) + self.low * other.high;
        [middle + self.low * other.low, rounded]
    }
}

/// A number of twice the digits: a rounded one and the rest.
#[derive(Clone, Copy)]
pub(crate) struct Wide<P> {
    pub(crate) high: P,
    low: P,
}

impl<P: Scalar> Wide<P> {
    #[inline(always)]
    pub(crate) fn of(x: P) -> Self {
        Wide {
            high: x,
            low: P::zero(),
        }
    }
    /// `a − b`, exactly.
    #[inline(always)]
    pub(crate) fn difference(a: P, b: P) -> Self {
        let [low, high] = sum(a, -b);
        Wide { high, low }
    }
    /// Times a power of two.
    #[inline(always)]
    pub(crate) fn scaled(self, by: P) -> Self {
        Wide {
            high: self.high * by,
            low: self.low * by,
        }
    }
    #[inline(always)]
    fn of_parts(high: P, low: P) -> Self {
        let rounded = high + low;
        Wide {
            high: rounded,
            low: low - (rounded - high),
        }
    }
    /// The sum, to ε² of what is added.
    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        let [lost, high] = sum(self.high, other.high);
        Wide::of_parts(high, lost + (self.low + other.low))
    }
    /// The difference, to ε² of both.
    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(Wide {
            high: -other.high,
            low: -other.low,
        })
    }
    /// The product, to two ε².
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        let [lost, high] = Halves::of(self.high).times(Halves::of(other.high));
        Wide::of_parts(high, lost + (self.high * other.low + self.low * other.high))
    }
    /// `a d − b c`, to some ε² of both products.
    #[inline(always)]
    pub(crate) fn cross([a, b]: [Self; 2], [c, d]: [Self; 2]) -> Self {
        a.times(d).minus(b.times(c))
    }
}

//! Sums and products without rounding, numbers of twice the digits, and signs of small determinants in them: straight
//! lines.
//!
//! Dekker, A floating-point technique for extending the available precision, 1971. A value within the rounding of such
//! numbers, 16 ε² of the sum of its terms' magnitudes, counts as zero where it is [`settled`](Twofold::settled). Exact
//! zeros are therefore recognised, and signs are those of the given numbers except for values that near to zero.
//! Derivatives take no part.
use crate::arrays::Each;
use crate::{Scalar, Vec2, Vec3};

/// Returns the rounding error of the difference `a − b` (Knuth, The Art of Computer Programming 2, 4.2.2).
#[inline(always)]
pub(crate) fn lost<P: Scalar>(a: P, b: P, rounded: P) -> P {
    let taken = rounded - a;
    (a - (rounded - taken)) - (b + taken)
}

/// Returns the sum of two numbers: first the rounding error, then the rounded sum.
#[inline(always)]
pub(crate) fn sum<P: Scalar>(a: P, b: P) -> [P; 2] {
    let rounded = a + b;
    let taken = rounded - a;
    [(a - (rounded - taken)) + (b - taken), rounded]
}

/// A number with two halves of its digits, whose products are exact. In `f64` it is below 10³⁰⁰.
#[derive(Clone, Copy)]
pub(crate) struct Halves<P> {
    whole: P,
    high: P,
    low: P,
}

impl<P: Scalar> Halves<P> {
    #[inline(always)]
    pub(crate) fn of(whole: P) -> Self {
        let (high, low) = if P::format().epsilon() > 1e-10 {
            whole.parts()
        } else {
            // If 53 digits are cut in two, one half has 27, too many for a product. Rounded to 26, the rest has a sign
            // and 26 (Veltkamp): by 2 to the number of digits of the low half, and one.
            let large = whole * P::lit(134_217_729.0);
            let high = large - (large - whole);
            (high, whole - high)
        };
        Halves { whole, high, low }
    }
    /// Returns the product: first the rounding error, then the rounded product (Dekker).
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> [P; 2] {
        let rounded = self.whole * other.whole;
        let high = self.high * other.high - rounded;
        // In this order each sum is exact.
        let middle = (high + self.high * other.low) + self.low * other.high;
        [middle + self.low * other.low, rounded]
    }
}

/// A number of twice the digits: a rounded one and the rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Twofold<P> {
    pub(crate) high: P,
    low: P,
}

impl<P: Scalar> Twofold<P> {
    /// Returns a number that is not rounded.
    #[inline(always)]
    pub(crate) fn of(x: P) -> Self {
        Twofold {
            high: x,
            low: P::zero(),
        }
    }
    /// Returns `a − b`, exactly.
    #[inline(always)]
    pub(crate) fn difference(a: P, b: P) -> Self {
        let high = a - b;
        let low = lost(a, b, high);
        Twofold { high, low }
    }
    /// Returns the product of two numbers, exactly.
    #[inline(always)]
    pub(crate) fn product(a: P, b: P) -> Self {
        let [low, high] = Halves::of(a).times(Halves::of(b));
        Twofold { high, low }
    }
    /// Multiplies by a power of two.
    #[inline(always)]
    pub(crate) fn scaled(self, by: P) -> Self {
        Twofold {
            high: self.high * by,
            low: self.low * by,
        }
    }
    /// Returns the sum of a number and a smaller one.
    #[inline(always)]
    fn of_parts(high: P, low: P) -> Self {
        let rounded = high + low;
        Twofold {
            high: rounded,
            low: low - (rounded - high),
        }
    }
    /// Returns the sum, to ε² of its terms.
    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        let [lost, high] = sum(self.high, other.high);
        Twofold::of_parts(high, lost + (self.low + other.low))
    }
    /// Returns the difference, to ε² of both.
    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(Twofold {
            high: -other.high,
            low: -other.low,
        })
    }
    /// Returns the product, to two ε².
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        let product = Twofold::product(self.high, other.high);
        let rest = self.high * other.low + self.low * other.high;
        Twofold::of_parts(product.high, product.low + rest)
    }
    /// Returns `a d − b c`, to some ε² of both products.
    #[inline(always)]
    pub(crate) fn cross(a: [Self; 2], b: [Self; 2]) -> Self {
        outer(a, b).0
    }
    /// Returns zero where the value is within the rounding of a sum whose terms have this sum of magnitudes, else its
    /// high part.
    #[inline(always)]
    pub(crate) fn settled(self, terms: P) -> P {
        let least = terms * P::lit(16.0 * P::format().epsilon() * P::format().epsilon());
        P::select(self.high.magnitude().at_most(least), P::zero(), self.high)
    }
}

/// A vector of the plane or of space by exact differences, in units of a power of two.
pub(crate) type ExactVector<P, const N: usize> = [Twofold<P>; N];

/// Returns the numbers of a point of the plane, without derivatives.
#[inline(always)]
pub(crate) fn flat<S: Scalar>(p: Vec2<S>) -> [S::Primal; 2] {
    [p.x.primal(), p.y.primal()]
}

/// Returns the numbers of a point of space, without derivatives.
#[inline(always)]
pub(crate) fn deep<S: Scalar>(p: Vec3<S>) -> [S::Primal; 3] {
    [p.x.primal(), p.y.primal(), p.z.primal()]
}

/// Returns the vector between two points, exact, times a power of two.
#[inline(always)]
pub(crate) fn way<P: Scalar, const N: usize>(
    from: [P; N],
    to: [P; N],
    unit: P,
) -> ExactVector<P, N> {
    let mut way = [Twofold::of(P::zero()); N];
    for k in 0..N {
        way[k] = Twofold::difference(to[k] * unit, from[k] * unit);
    }
    way
}

/// Returns the rounded coordinates.
#[inline(always)]
pub(crate) fn rounded<P: Scalar, const N: usize>(way: ExactVector<P, N>) -> [P; N] {
    way.each_as(|x| x.high)
}

/// Returns an outer product of two numbers each, and the sum of its terms' magnitudes.
#[inline(always)]
fn outer<P: Scalar>(a: [Twofold<P>; 2], b: [Twofold<P>; 2]) -> (Twofold<P>, P) {
    let (left, right) = (a[0].times(b[1]), a[1].times(b[0]));
    let terms = left.high.magnitude() + right.high.magnitude();
    (left.minus(right), terms)
}

/// Returns the outer product of two vectors of the plane; exactly zero for parallel ones.
#[inline(always)]
pub(crate) fn turn<P: Scalar>(a: ExactVector<P, 2>, b: ExactVector<P, 2>) -> P {
    let (value, terms) = outer(a, b);
    value.settled(terms)
}

/// Returns the inner product of two vectors; exactly zero for orthogonal ones.
#[inline(always)]
pub(crate) fn dot<P: Scalar, const N: usize>(a: ExactVector<P, N>, b: ExactVector<P, N>) -> P {
    let mut sum = a[0].times(b[0]);
    let mut terms = sum.high.magnitude();
    for k in 1..N {
        let next = a[k].times(b[k]);
        terms += next.high.magnitude();
        sum = sum.plus(next);
    }
    sum.settled(terms)
}

/// Returns the outer products of two vectors of space; exactly zero for parallel ones.
#[inline(always)]
pub(crate) fn cross<P: Scalar>(a: ExactVector<P, 3>, b: ExactVector<P, 3>) -> [P; 3] {
    outer_products(a, b).each_as(|(value, terms)| value.settled(terms))
}

#[inline(always)]
fn outer_products<P: Scalar>(a: ExactVector<P, 3>, b: ExactVector<P, 3>) -> [(Twofold<P>, P); 3] {
    [(1, 2), (2, 0), (0, 1)].each_as(|(i, j)| outer([a[i], a[j]], [b[i], b[j]]))
}

/// Returns the triple product of three vectors of space; exactly zero for those of one plane.
#[inline(always)]
pub(crate) fn volume<P: Scalar>(
    a: ExactVector<P, 3>,
    b: ExactVector<P, 3>,
    c: ExactVector<P, 3>,
) -> P {
    let faces = outer_products(a, b);
    let (mut sum, mut terms) = (Twofold::of(P::zero()), P::zero());
    for k in 0..3 {
        let (face, share) = faces[k];
        sum = sum.plus(face.times(c[k]));
        terms += share * c[k].high.magnitude();
    }
    sum.settled(terms)
}

//! Elementary functions beside those of [`Scalar`], for functions that users record: right near zero and at the ends of
//! the format, with derivatives of any order.
use crate::Scalar;
use crate::scalar::polynomial::polynomial;

/// Returns the reciprocals of the factorials of `first`, `first + step` and so on.
const fn reciprocals<const N: usize>(first: u32, step: u32) -> [f64; N] {
    let (mut all, mut factorial, mut n, mut k) = ([0.0; N], 1.0, 0, 0);
    while k < N {
        while n < first + step * k as u32 {
            n += 1;
            factorial *= n as f64;
        }
        all[k] = 1.0 / factorial;
        k += 1;
    }
    all
}

/// Taylor's series of `sinh x / x` and `cosh x` in `x²`, below 1: the first terms left out are below 2⁻⁷⁰, in second
/// derivatives, too.
const SINH: [f64; 12] = reciprocals(1, 2);
const COSH: [f64; 12] = reciprocals(0, 2);
/// Taylor's series of `(eˣ − 1) / x`, below 1/2: the first term left out is below 2⁻⁶⁹.
const EXP_M1: [f64; 17] = reciprocals(1, 1);

/// Returns the magnitude of a number, smooth at zero, and `true` where it is below a bound.
fn size<S: Scalar>(x: S, bound: f64) -> (S, S::Mask) {
    let size = x.unsigned();
    (size, size.below(S::lit(bound)))
}

/// Returns the square root: NaN, with derivative NaN, below zero.
pub(crate) fn root_or_nan<S: Scalar>(x: S) -> S {
    let root = x.root();
    // Below zero the root is 0, and 0 / 0 is NaN; the factor x passes it on to the derivative.
    S::select(x.at_least(S::zero()), root, x * root.over(root))
}

/// Returns `eˣ − 1`.
pub(crate) fn exp_m1<S: Scalar>(x: S) -> S {
    let (_, is_small) = size(x, 0.5);
    S::select(is_small, x * polynomial(EXP_M1, x), x.exp() - S::one())
}

/// Returns `ln(1 + x)`.
///
/// Near zero `1 + x` is rounded to `1 + d`, and `ln(1 + d) x / d` corrects it (Kahan; Goldberg 1991, theorem 4).
pub(crate) fn ln_1p<S: Scalar>(x: S) -> S {
    let (one, value) = (S::Primal::one(), x.primal());
    let rounded = one + value;
    let corrected = rounded.ln() * value.over(rounded - one);
    let near = S::Primal::select(rounded.equals(one), value, corrected);
    let ln = (S::one() + x).ln();
    let (_, is_small) = size(x, 0.5);
    S::select(is_small, ln.with_primal(near), ln)
}

/// Returns half of `eˣ` and half of `e⁻ˣ` for `x ≥ 0`, finite as far as either is.
fn halves<S: Scalar>(x: S) -> (S, S) {
    let up = x.halved().exp();
    let down = S::one().over(up);
    (up.halved() * up, down.halved() * down)
}

/// Returns the hyperbolic sine.
pub(crate) fn sinh<S: Scalar>(x: S) -> S {
    let (size, is_small) = size(x, 1.0);
    let (up, down) = halves(size);
    S::select(
        is_small,
        x * polynomial(SINH, x * x),
        (up - down).signed_as(x),
    )
}

/// Returns the hyperbolic cosine.
pub(crate) fn cosh<S: Scalar>(x: S) -> S {
    let (size, is_small) = size(x, 1.0);
    let (up, down) = halves(size);
    S::select(is_small, polynomial(COSH, x * x), up + down)
}

/// Returns the hyperbolic tangent.
pub(crate) fn tanh<S: Scalar>(x: S) -> S {
    let (size, is_small) = size(x, 1.0);
    let near = (x * polynomial(SINH, x * x)).over(polynomial(COSH, x * x));
    let q = (-(size + size)).exp();
    let far = (S::one() - q).over(S::one() + q);
    S::select(is_small, near, far.signed_as(x))
}

/// Returns the inverse of the hyperbolic sine.
pub(crate) fn arcsinh<S: Scalar>(x: S) -> S {
    // Beyond the bound the one under the root does not count.
    let (size, is_small) = size(x, 1.0 / S::format().epsilon());
    let root = (S::one() + size * size).root();
    let near = ln_1p(size + (size * size).over(S::one() + root));
    let far = size.ln() + S::lit(std::f64::consts::LN_2);
    S::select(is_small, near, far).signed_as(x)
}

/// Returns the inverse of the hyperbolic cosine; NaN below 1.
pub(crate) fn arccosh<S: Scalar>(x: S) -> S {
    let less = x - S::one();
    ln_1p(less + root_or_nan(less) * (x + S::one()).root())
}

/// Returns the inverse of the hyperbolic tangent.
pub(crate) fn arctanh<S: Scalar>(x: S) -> S {
    let size = x.unsigned();
    ln_1p((size + size).over(S::one() - size))
        .halved()
        .signed_as(x)
}

/// Returns the angle in `[−π/2, π/2]` with a sine; NaN beyond 1, with derivative zero at ±1.
pub(crate) fn arcsin<S: Scalar>(x: S) -> S {
    x.atan2(root_or_nan((S::one() - x) * (S::one() + x)))
}

/// Returns the angle in `[0, π]` with a cosine; NaN beyond 1, with derivative zero at ±1.
pub(crate) fn arccos<S: Scalar>(x: S) -> S {
    root_or_nan((S::one() - x) * (S::one() + x)).atan2(x)
}

/// Returns the angle in `[−π/2, π/2]` with a tangent.
pub(crate) fn arctan<S: Scalar>(x: S) -> S {
    x.atan2(S::one())
}

/// Returns the logarithm to a base.
pub(crate) fn ln_over<S: Scalar>(x: S, ln_of_base: f64) -> S {
    x.ln().over(S::lit(ln_of_base))
}

/// Returns the cube root, with derivative zero at zero.
pub(crate) fn cbrt<S: Scalar>(x: S) -> S {
    let (size, none) = (x.unsigned(), x.equals(S::zero()));
    let root = ln_over(size, 3.0).exp();
    let (value, three) = (root.primal(), S::Primal::lit(3.0));
    // One step of Newton's corrects the rounding of the logarithm, a factor for the derivative.
    let step = (value - size.primal().over(value * value)).over(three);
    let corrected = value - step;
    let factor = S::from_primal(corrected.over(value));
    let near = (root * factor).with_primal(corrected);
    let whole = S::select(root.finite(), near, root);
    S::select(none, S::zero(), whole).signed_as(x)
}

/// Returns the logarithm of the sum of the exponentials of two numbers.
pub(crate) fn ln_of_exponentials<S: Scalar>(a: S, b: S) -> S {
    let most = a.primal().most(b.primal());
    let shift = S::from_primal(most);
    let ln = ((a - shift).exp() + (b - shift).exp()).ln();
    // The larger exponential is one, and the smaller one may be lost beside it.
    let small = (-(a.primal() - b.primal()).unsigned()).exp();
    let sum = shift + ln.with_primal(ln_1p(small));
    let is_finite = shift.finite();
    // One of them is infinite: the larger one is the result; and a sum passes NaN on.
    let larger = S::select(a.below(b), b, S::select(b.equals(b), a, b));
    let at_end = S::select(a.equals(b), a, larger);
    S::select(is_finite, sum, at_end)
}

/// Returns the nearest whole number, of two the even one; without derivative.
pub(crate) fn rint<S: Scalar>(x: S) -> S {
    S::from_primal(nearest(x.primal()))
}
fn nearest<P: Scalar>(x: P) -> P {
    // Numbers from here on are whole; below, sums with it round to whole numbers.
    let bound = P::lit(1.0 / P::format().epsilon());
    let shift = bound.signed_as(x);
    P::select(x.unsigned().below(bound), (x + shift) - shift, x)
}
fn below_or_at<P: Scalar>(x: P) -> P {
    let near = nearest(x);
    P::select(x.below(near), near - P::one(), near)
}

/// Returns the largest whole number that is not above `x`; without derivative.
pub(crate) fn floor<S: Scalar>(x: S) -> S {
    S::from_primal(below_or_at(x.primal()))
}

/// Returns the smallest whole number that is not below `x`; without derivative.
pub(crate) fn ceil<S: Scalar>(x: S) -> S {
    S::from_primal(-below_or_at(-x.primal()))
}

/// Returns the whole number without the digits after the point; without derivative.
pub(crate) fn trunc<S: Scalar>(x: S) -> S {
    let value = x.primal();
    let whole = below_or_at(value.unsigned());
    S::from_primal(whole.signed_as(value))
}

/// Returns the whole number `n` and the rest `a − n b`, which is zero or has the sign of `b`.
fn divided<S: Scalar>(a: S, b: S) -> (S, S) {
    let (x, y, zero) = (a.primal(), b.primal(), S::Primal::zero());
    let n = below_or_at(x.over(y));
    let rest = x - n * y;
    // The quotient was rounded up to a whole number.
    let is_wrong = (rest.below(zero) & y.above(zero)) | (rest.above(zero) & y.below(zero));
    let n = S::from_primal(S::Primal::select(is_wrong, n - S::Primal::one(), n));
    (n, a - n * b)
}

/// Returns the largest whole number that is not above a quotient; without derivative.
pub(crate) fn floor_divide<S: Scalar>(a: S, b: S) -> S {
    divided(a, b).0
}

/// Returns the rest of a division, which is zero or has the sign of `b`: right to the rounding of `a`.
pub(crate) fn remainder<S: Scalar>(a: S, b: S) -> S {
    divided(a, b).1
}

/// Returns 1, −1 or 0; without derivative.
pub(crate) fn sign<S: Scalar>(x: S) -> S {
    let (value, one, zero) = (x.primal(), S::Primal::one(), S::Primal::zero());
    let negative = S::Primal::select(value.below(zero), -one, value);
    S::from_primal(S::Primal::select(value.above(zero), one, negative))
}

/// Returns a power with a constant exponent: NaN below zero unless the exponent is whole.
pub(crate) fn power<S: Scalar>(x: S, exponent: f64) -> S {
    if exponent < 0.0 {
        return S::one().over(power(x, -exponent));
    }
    // The whole part is exact but for the roundings of products; the rest has a small logarithm.
    let (whole, rest) = (exponent.trunc(), exponent.fract());
    let by_whole = x.powi(whole as i32);
    let by_rest = if rest == 0.0 {
        return by_whole;
    } else if rest == 0.5 {
        root_or_nan(x)
    } else {
        let power = (x.ln() * S::lit(rest)).exp();
        S::select(x.equals(S::zero()), S::zero(), power)
    };
    if whole == 0.0 {
        by_rest
    } else {
        by_whole * by_rest
    }
}

/// Returns a power of a number above zero, `e` to the power of `exponent ln x`; NaN below zero.
pub(crate) fn power_of<S: Scalar>(x: S, exponent: S) -> S {
    let (zero, one) = (S::zero(), S::one());
    let power = (x.ln() * exponent).exp();
    let of_zero = S::select(exponent.equals(zero), one, one.over(x));
    let of_zero = S::select(exponent.above(zero), zero, of_zero);
    S::select(x.equals(zero), of_zero, power)
}

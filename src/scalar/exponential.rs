//! Exponentials and logarithms of `f64`, and of lanes of it: polynomials, so that a number and a lane have equal bits
//! on every machine and at every SIMD level.
use crate::Scalar;
use crate::scalar::polynomial::{SHIFT, polynomial};

/// ln 2 in two parts (fdlibm, `e_exp.c`): the first has 33 bits, so that its product with an exponent is exact.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];

/// Numbers of `f64` whose exponents can be read and written.
pub(crate) trait Exponents: Scalar<Primal = Self> {
    /// Returns `2ᵏ` for a whole `k` from −1022 to 1023.
    fn power_of_two(k: Self) -> Self;
    /// Returns `(e, m)` of a normal positive number `2ᵉ m`, `m` in `[1, 2)`.
    fn exponent(self) -> (Self, Self);
}

/// The exponent's bias in the low bits of [`SHIFT`]'s significand.
const BIASED: f64 = SHIFT + 1023.0;
/// The bits of 2⁵², of which a whole number takes the low ones.
pub(crate) const WHOLE: u64 = 0x4330_0000_0000_0000;
/// The bits of a significand, and those of 1.
pub(crate) const FRACTION: u64 = 0x000f_ffff_ffff_ffff;
pub(crate) const ONE: u64 = 0x3ff0_0000_0000_0000;
/// Turns the number with the bits of [`WHOLE`] and an exponent field into the exponent.
pub(crate) const UNBIASED: f64 = 4_503_599_627_370_496.0 + 1023.0;
/// Bits of a significand.
pub(crate) const BITS: i32 = 52;

/// Returns `k` with its bias in the low bits of the significand: shifted left by [`BITS`] they are `2ᵏ`.
#[inline(always)]
pub(crate) fn biased<W: Scalar>(k: W) -> W {
    k + W::lit(BIASED)
}

impl Exponents for f64 {
    #[inline(always)]
    fn power_of_two(k: f64) -> f64 {
        f64::from_bits(biased(k).to_bits() << BITS)
    }
    #[inline(always)]
    fn exponent(self) -> (f64, f64) {
        let bits = self.to_bits();
        (
            f64::from_bits(bits >> BITS | WHOLE) - UNBIASED,
            f64::from_bits(bits & FRACTION | ONE),
        )
    }
}

/// Returns the nearest whole number.
#[inline(always)]
fn rounded<W: Scalar>(x: W) -> W {
    let shift = W::lit(SHIFT);
    (x + shift) - shift
}

/// Returns the exponential; within one unit in the last place.
///
/// `eᵏ ˡⁿ² ⁺ ʳ = 2ᵏ eʳ` with `|r| ≤ ln 2 / 2`, and Taylor's series of `eʳ`: its first term left out is below 2⁻⁵⁷.
#[inline(always)]
pub(crate) fn exp_wide<W: Exponents>(x: W) -> W {
    let [power, first, second] = exp_parts(x);
    // Two factors: results may be subnormal, and 2¹⁰²⁴ is no number.
    let all = power * W::power_of_two(first) * W::power_of_two(second);
    W::select(x.equals(x), all, x)
}

/// Returns `(p, j, k)` with `eˣ = p 2ʲ 2ᵏ`.
#[inline(always)]
pub(crate) fn exp_parts<W: Scalar>(x: W) -> [W; 3] {
    // 1/n! from n = 2.
    let series = [
        0.5,
        0.166_666_666_666_666_66,
        0.041_666_666_666_666_664,
        0.008_333_333_333_333_333,
        0.001_388_888_888_888_889,
        0.000_198_412_698_412_698_4,
        2.480_158_730_158_73e-5,
        2.755_731_922_398_589e-6,
        2.755_731_922_398_589e-7,
        2.505_210_838_544_172e-8,
        2.087_675_698_786_81e-9,
        1.605_904_383_682_161_3e-10,
    ];
    // Beyond these limits results are 0 and infinity.
    let near = x.most(W::lit(-746.0)).least(W::lit(710.0));
    let (k, power) = reduced(near, series);
    let half = rounded(k.halved());
    [power, half, k - half]
}

/// Returns the exponential in `f64` of a number that is an `f32`: right to 2⁻³⁶.
#[inline(always)]
pub(crate) fn exp_single<W: Exponents>(x: W) -> W {
    let [power, k] = exp_parts_short(x);
    W::select(x.equals(x), power * W::power_of_two(k), x)
}

/// Returns `(p, k)` with `eˣ = p 2ᵏ`, in `f64` for a number that is an `f32`.
#[inline(always)]
pub(crate) fn exp_parts_short<W: Scalar>(x: W) -> [W; 2] {
    // 1/n! from n = 2.
    let series = [
        0.5,
        0.166_666_666_666_666_66,
        0.041_666_666_666_666_664,
        0.008_333_333_333_333_333,
        0.001_388_888_888_888_889,
        0.000_198_412_698_412_698_4,
        2.480_158_730_158_73e-5,
        2.755_731_922_398_589e-6,
    ];
    // Beyond these limits results are 0 and infinity as `f32`.
    let near = x.most(W::lit(-150.0)).least(W::lit(90.0));
    let (k, power) = reduced(near, series);
    [power, k]
}

/// Returns `k` and `eʳ` with `x = k ln 2 + r`.
#[inline(always)]
fn reduced<W: Scalar, const N: usize>(x: W, series: [f64; N]) -> (W, W) {
    let k = rounded(x * W::lit(std::f64::consts::LOG2_E));
    let (high, low) = (x - k * W::lit(LN_2[0]), k * W::lit(LN_2[1]));
    let r = high - low;
    // The part of r that rounding took.
    let rest = (high - r) - low;
    (k, W::one() + (r + (r * r * polynomial(series, r) + rest)))
}

/// Returns the natural logarithm; within one unit in the last place. −∞ for zero, NaN below.
///
/// The reduction and the minimax polynomial of fdlibm (`e_log.c`).
#[inline(always)]
pub(crate) fn ln_wide<W: Exponents>(x: W) -> W {
    ln_by(x, LN_SERIES)
}

/// The minimax polynomial of [`ln_wide`].
pub(crate) const LN_SERIES: [f64; 7] = [
    0.666_666_666_666_673_5,
    0.399_999_999_994_094_2,
    0.285_714_287_436_623_9,
    0.222_221_984_321_497_84,
    0.181_835_721_616_180_5,
    0.153_138_376_992_093_73,
    0.147_981_986_051_165_86,
];

/// Returns the natural logarithm in `f64` of a number that is an `f32`: right to 2⁻³⁴.
///
/// With the series of the inverse hyperbolic tangent in place of the minimax polynomial.
#[inline(always)]
pub(crate) fn ln_single<W: Exponents>(x: W) -> W {
    ln_by(x, LN_SERIES_SHORT)
}

/// The series of [`ln_single`].
pub(crate) const LN_SERIES_SHORT: [f64; 5] =
    [2.0 / 3.0, 2.0 / 5.0, 2.0 / 7.0, 2.0 / 9.0, 2.0 / 11.0];

#[inline(always)]
fn ln_by<W: Exponents, const N: usize>(x: W, series: [f64; N]) -> W {
    let (exponent, fraction) = normal(x).exponent();
    ln_from(x, exponent, fraction, series)
}

/// Returns `true` for numbers below the smallest normal one.
#[inline(always)]
fn is_subnormal<W: Scalar>(x: W) -> W::Mask {
    x.below(W::lit(f64::MIN_POSITIVE))
}

/// Returns the number, or 2⁵⁴ times it, which is normal, for a subnormal one.
#[inline(always)]
pub(crate) fn normal<W: Scalar>(x: W) -> W {
    W::select(is_subnormal(x), x * W::lit(18_014_398_509_481_984.0), x)
}

/// Returns the natural logarithm of `x`, with the exponent and the significand of [`normal`] of it.
#[inline(always)]
pub(crate) fn ln_from<W: Scalar, const N: usize>(
    x: W,
    exponent: W,
    fraction: W,
    series: [f64; N],
) -> W {
    let (zero, largest) = (W::zero(), W::lit(f64::MAX));
    let exponent = exponent - W::select(is_subnormal(x), W::lit(54.0), zero);
    // The significand from 1/√2 to √2.
    let high = fraction.above(W::lit(std::f64::consts::SQRT_2));
    let fraction = W::select(high, fraction.halved(), fraction);
    let exponent = exponent + W::select(high, W::one(), zero);
    let f = fraction - W::one();
    let s = f.over(W::lit(2.0) + f);
    let z = s * s;
    let square = (f * f).halved();
    let rest = s * (square + z * polynomial(series, z)) + exponent * W::lit(LN_2[1]);
    let value = exponent * W::lit(LN_2[0]) - ((square - rest) - f);
    let ordinary = zero.below(x) & x.at_most(largest);
    let (low, infinite) = (W::lit(f64::NEG_INFINITY), W::lit(f64::INFINITY));
    let outside = W::select(
        x.equals(zero),
        low,
        W::select(x.above(largest), infinite, W::lit(f64::NAN)),
    );
    W::select(ordinary, value, outside)
}

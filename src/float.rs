//! `f32` and `f64` as scalars, and the elementary functions they share with SIMD lanes.
//!
//! Sine and cosine are our own polynomials, evaluated in `f64`, so that a number and a lane give
//! the same bits on every machine and at every SIMD level.
use crate::Scalar;

/// Above this angle the three-part reduction loses digits and the platform's library takes over.
const REDUCED: f64 = 800_000.0;

/// Sine and cosine of lanes of `f64` (or one `f64`) for angles up to [`REDUCED`].
///
/// Reduction to `[−π/4, π/4]` by three parts of π/2 whose products with the quadrant are exact,
/// then the minimax polynomials of Sun's fdlibm (`k_sin.c`, `k_cos.c`); within one unit in the
/// last place.
#[inline(always)]
fn sin_cos_reduced<W: Scalar<Primal = W>>(angle: W) -> (W, W) {
    // Adding and taking away 1.5 · 2^52 rounds to the nearest integer.
    let shift = W::lit(6_755_399_441_055_744.0);
    let quadrant = (angle * W::lit(std::f64::consts::FRAC_2_PI) + shift) - shift;
    // π/2 in parts of 33 bits (fdlibm, e_rem_pio2.c).
    let r = ((angle - quadrant * W::lit(1.570_796_326_734_125_6))
        - quadrant * W::lit(6.077_100_506_303_966e-11))
        - quadrant * W::lit(2.022_266_248_795_950_6e-21);
    let z = r * r;
    let poly = |coefficients: [f64; 6]| {
        let mut sum = W::lit(coefficients[5]);
        for i in (0..5).rev() {
            sum = sum * z + W::lit(coefficients[i]);
        }
        sum
    };
    let s = poly([
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ]);
    let c = poly([
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ]);
    let sin = r + r * z * s;
    let half = z.halved();
    let whole = W::one() - half;
    let cos = whole + (((W::one() - whole) - half) + z * z * c);
    // The quadrant modulo 4, in {−2, −1, 0, 1, 2}.
    let turn = quadrant - ((quadrant * W::lit(0.25) + shift) - shift) * W::lit(4.0);
    let odd = (turn * turn).equals(W::one());
    let far = (turn * turn).above(W::lit(2.0));
    let (a, b) = (W::select(odd, cos, sin), W::select(odd, sin, cos));
    (
        W::select(far | turn.equals(W::lit(-1.0)), -a, a),
        W::select(far | turn.equals(W::one()), -b, b),
    )
}

/// Sine and cosine of lanes of `f64` (or one `f64`); `one` serves the rare huge angles.
#[inline(always)]
pub(crate) fn sin_cos_wide<W: Scalar<Primal = W>>(
    angle: W,
    by_library: impl Fn(W) -> (W, W),
) -> (W, W) {
    use crate::Mask;
    let near = W::select(angle.below(W::zero()), -angle, angle).at_most(W::lit(REDUCED));
    let (sin, cos) = sin_cos_reduced(W::select(near, angle, W::zero()));
    if near.all() {
        return (sin, cos);
    }
    let (far_sin, far_cos) = by_library(angle);
    (W::select(near, sin, far_sin), W::select(near, cos, far_cos))
}

/// What differs between the two formats, for the numbers here and the lanes built on them.
pub trait Float: Copy + std::fmt::Debug + Send + Sync + 'static {
    /// The bit pattern as an integer, also the type of a lane's mask.
    type Bits: Copy + std::fmt::Debug + Send + Sync + 'static;
    /// All zeros.
    const NONE: Self::Bits;
    /// The exact value as `f64`.
    fn widen(self) -> f64;
    /// The high half of the significand.
    fn high(self) -> Self;
    /// All ones if `yes`.
    fn mask(yes: bool) -> Self::Bits;
    /// Bitwise choice.
    fn choose(mask: Self::Bits, yes: Self, no: Self) -> Self;
    /// Bitwise and.
    fn and(a: Self::Bits, b: Self::Bits) -> Self::Bits;
    /// Bitwise or.
    fn or(a: Self::Bits, b: Self::Bits) -> Self::Bits;
    /// Bitwise not.
    fn not(a: Self::Bits) -> Self::Bits;
}

/// Both formats: the macro takes what the two differ in.
macro_rules! float {
    ($f:ident, $bits:ident, compensated: $compensated:literal, parallel: $parallel:literal,
     low_half: $low:literal, mantissa: $mantissa:literal) => {
        impl Float for $f {
            type Bits = $bits;
            const NONE: $bits = 0;
            #[inline(always)]
            fn widen(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn high(self) -> Self {
                $f::from_bits(self.to_bits() & !((1 << $low) - 1))
            }
            #[inline(always)]
            fn mask(yes: bool) -> $bits {
                if yes { !0 } else { 0 }
            }
            #[inline(always)]
            fn choose(mask: $bits, yes: Self, no: Self) -> Self {
                $f::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
            }
            #[inline(always)]
            fn and(a: $bits, b: $bits) -> $bits {
                a & b
            }
            #[inline(always)]
            fn or(a: $bits, b: $bits) -> $bits {
                a | b
            }
            #[inline(always)]
            fn not(a: $bits) -> $bits {
                !a
            }
        }

        impl Scalar for $f {
            type Mask = bool;
            type Primal = Self;
            const COMPENSATED: bool = $compensated;
            const EPSILON: f64 = $f::EPSILON as f64;
            const PARALLEL: f64 = $parallel;
            const LARGEST: f64 = $f::MAX as f64;
            #[inline(always)]
            fn lit(x: f64) -> Self {
                x as $f
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
            fn below(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn equals(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }
            #[inline(always)]
            fn root(self) -> Self {
                if self > 0.0 { self.sqrt() } else { 0.0 }
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = sin_cos_wide(self.widen(), f64::sin_cos);
                (sin as $f, cos as $f)
            }
            #[inline(always)]
            fn sin_cos_parts(self) -> [(Self, Self); 2] {
                let (sin, cos) = sin_cos_wide(self.widen(), f64::sin_cos);
                let parts = |wide: f64| {
                    let high = (wide as $f).high();
                    (high, (wide - high.widen()) as $f)
                };
                [parts(sin), parts(cos)]
            }
            #[inline(always)]
            fn parts(self) -> (Self, Self) {
                let high = self.high();
                (high, self - high)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                if self == 0.0 && x == 0.0 {
                    0.0
                } else {
                    self.widen().atan2(x.widen()) as $f
                }
            }
            #[inline(always)]
            fn exp(self) -> Self {
                self.widen().exp() as $f
            }
            #[inline(always)]
            fn ln(self) -> Self {
                self.widen().ln() as $f
            }
            #[inline(always)]
            fn binade(self) -> Self {
                // The exponent field e becomes 2·bias + 1 − e.
                let normal = if self < $f::MIN_POSITIVE {
                    $f::MIN_POSITIVE
                } else {
                    self
                };
                let field = normal.to_bits() >> $mantissa << $mantissa;
                let twice_bias = (2 * ($f::MAX_EXP as $bits - 1) + 1) << $mantissa;
                $f::from_bits(twice_bias - field)
            }
            // A tie of plain numbers has one value, so the kinks need a single choice.
            #[inline(always)]
            fn least(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn most(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn magnitude(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn unsigned(self) -> Self {
                self.abs()
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
    };
}

float!(f32, u32, compensated: true, parallel: 2e-10, low_half: 12, mantissa: 23);
float!(f64, u64, compensated: false, parallel: 4e-16, low_half: 27, mantissa: 52);

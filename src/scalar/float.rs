//! `f32` and `f64` as scalars, and the elementary functions they share with SIMD lanes.
//!
//! Sine, cosine, arctangent, exponential and logarithm are polynomials, evaluated in `f64`, so that a number and a lane
//! have equal bits on every machine and at every SIMD level. None calls the platform's library.
use crate::Scalar;
use crate::scalar::arc_tangent::{atan2_single, atan2_wide};
use crate::scalar::exponential::{exp_single, exp_wide, ln_single, ln_wide};
use crate::scalar::format::Format;
use crate::scalar::polynomial::{SHIFT, polynomial};
use crate::scalar::real::Real;

/// Above this angle the three-part reduction loses digits, and that of fdlibm by all digits of π takes over (`libm`).
pub(crate) const REDUCED: f64 = 800_000.0;

/// Returns the nearest multiple of a quarter turn, in quarters.
#[inline(always)]
fn quadrant_of<W: Scalar>(angle: W) -> W {
    let shift = W::lit(SHIFT);
    (angle * W::lit(std::f64::consts::FRAC_2_PI) + shift) - shift
}

/// Returns sine and cosine of an angle from those of its remainder after the nearest quarter turn.
#[inline(always)]
fn turned<W: Scalar>(quadrant: W, sin: W, cos: W) -> (W, W) {
    let shift = W::lit(SHIFT);
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

/// Returns sine and cosine of lanes of `f64` (or one `f64`) for angles up to [`REDUCED`].
///
/// Reduction to `[−π/4, π/4]` by three parts of π/2 whose products with the quadrant are exact,
/// then the minimax polynomials of Sun's fdlibm (`k_sin.c`, `k_cos.c`); within one unit in the
/// last place.
#[inline(always)]
pub(crate) fn sin_cos_reduced<W: Scalar<Primal = W>>(angle: W) -> (W, W) {
    let quadrant = quadrant_of(angle);
    // π/2 in parts of 33 bits (fdlibm, e_rem_pio2.c).
    let r = ((angle - quadrant * W::lit(1.570_796_326_734_125_6))
        - quadrant * W::lit(6.077_100_506_303_966e-11))
        - quadrant * W::lit(2.022_266_248_795_950_6e-21);
    let z = r * r;
    let s = polynomial(
        [
            -1.666_666_666_666_663_2e-1,
            8.333_333_333_322_49e-3,
            -1.984_126_982_985_795e-4,
            2.755_731_370_707_006_8e-6,
            -2.505_076_025_340_686_3e-8,
            1.589_690_995_211_55e-10,
        ],
        z,
    );
    let c = polynomial(
        [
            4.166_666_666_666_66e-2,
            -1.388_888_888_887_411e-3,
            2.480_158_728_947_673e-5,
            -2.755_731_435_139_066_3e-7,
            2.087_572_321_298_175e-9,
            -1.135_964_755_778_819_5e-11,
        ],
        z,
    );
    let sin = r + r * z * s;
    let half = z.halved();
    let whole = W::one() - half;
    let cos = whole + (((W::one() - whole) - half) + z * z * c);
    turned(quadrant, sin, cos)
}

/// Returns sine and cosine in `f64` of angles that are `f32`, for angles up to [`REDUCED`]: right to 2⁻⁴², which is
/// more than an `f32` and its rest have.
///
/// As [`sin_cos_reduced`], with shorter polynomials (minimax, by Remez' exchange) and π/2 in two
/// parts, of which the first has 33 bits.
#[inline(always)]
pub(crate) fn sin_cos_short<W: Scalar<Primal = W>>(angle: W) -> (W, W) {
    let quadrant = quadrant_of(angle);
    let r = (angle - quadrant * W::lit(1.570_796_326_734_125_6))
        - quadrant * W::lit(6.077_100_506_506_192e-11);
    let z = r * r;
    let s = polynomial(
        [
            -1.666_666_666_663_031_5e-1,
            8.333_333_325_071_131e-3,
            -1.984_126_372_495_233e-4,
            2.755_533_886_300_622_8e-6,
            -2.476_039_626_536_973e-8,
        ],
        z,
    );
    let c = polynomial(
        [
            4.166_666_661_945_37e-2,
            -1.388_888_349_685_687e-3,
            2.479_945_930_932_67e-5,
            -2.720_568_456_781_55e-7,
        ],
        z,
    );
    let sin = r + r * z * s;
    let cos = (W::one() - z.halved()) + z * z * c;
    turned(quadrant, sin, cos)
}

/// Returns sine and cosine of lanes of `f64` (or one `f64`). `short` says that the angles come from `f32`; `far` serves
/// the rare huge angles.
#[inline(always)]
fn sin_cos_by<W: Scalar<Primal = W>>(short: bool, angle: W, far: impl Fn(W) -> (W, W)) -> (W, W) {
    use crate::Mask;
    let near = angle.unsigned().at_most(W::lit(REDUCED));
    if near.all() {
        return match short {
            true => sin_cos_short(angle),
            false => sin_cos_reduced(angle),
        };
    }
    let angle_near = W::select(near, angle, W::zero());
    let (sin, cos) = match short {
        true => sin_cos_short(angle_near),
        false => sin_cos_reduced(angle_near),
    };
    let (far_sin, far_cos) = far(angle);
    (W::select(near, sin, far_sin), W::select(near, cos, far_cos))
}

/// Returns sine and cosine of lanes of `f64` (or one `f64`).
#[inline(always)]
pub(crate) fn sin_cos_wide<W: Scalar<Primal = W>>(angle: W, far: impl Fn(W) -> (W, W)) -> (W, W) {
    sin_cos_by(false, angle, far)
}

/// Returns sine and cosine in `f64` of angles that are `f32`.
#[inline(always)]
pub(crate) fn sin_cos_single<W: Scalar<Primal = W>>(angle: W, far: impl Fn(W) -> (W, W)) -> (W, W) {
    sin_cos_by(true, angle, far)
}

/// Returns an `f64` as the twelve high bits of its significand, which an `f32` holds, and the rest, rounded
/// to `f32`.
#[inline(always)]
pub(crate) fn split_single(wide: f64) -> (f32, f32) {
    let high = f64::from_bits(wide.to_bits() & HIGH_OF_SINGLE);
    (high as f32, (wide - high) as f32)
}

/// Leaves twelve bits of a significand of an `f64`.
pub(crate) const HIGH_OF_SINGLE: u64 = !((1 << 41) - 1);

/// Both formats: the arguments of the macro are their differences.
macro_rules! float {
    ($f:ident, $bits:ident, $format:ident,
     low_half: $low:literal, mantissa: $mantissa:literal,
     sines: $sin_cos:ident, angle: $atan2:ident, split: $split:expr, exponentials: $exp:ident $ln:ident) => {
        impl Real for $f {
            const FORMAT: Format = Format::$format;
            type NumDual = num_dual::Dual<$f>;
            type Bits = $bits;
            const NONE: $bits = 0;
            #[inline]
            fn num_dual(value: Self, derivative: Self) -> Self::NumDual {
                num_dual::Dual::new(value, derivative)
            }
            #[inline]
            fn of_num_dual(dual: Self::NumDual) -> (Self, Self) {
                (dual.re, dual.eps)
            }
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
            #[inline(always)]
            fn format() -> crate::scalar::Format {
                crate::scalar::Format::$format
            }
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
            fn widened(self) -> Option<f64> {
                Some(f64::from(self))
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
                if self <= 0.0 { 0.0 } else { self.sqrt() }
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = $sin_cos(self.widen(), libm::sincos);
                (sin as $f, cos as $f)
            }
            #[inline(always)]
            fn sin_cos_parts(self) -> [(Self, Self); 2] {
                let (sin, cos) = $sin_cos(self.widen(), libm::sincos);
                [$split(sin), $split(cos)]
            }
            #[inline(always)]
            fn parts(self) -> (Self, Self) {
                let high = self.high();
                (high, self - high)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $atan2(self.widen(), x.widen()) as $f
            }
            #[inline(always)]
            fn exp(self) -> Self {
                $exp(self.widen()) as $f
            }
            #[inline(always)]
            fn ln(self) -> Self {
                $ln(self.widen()) as $f
            }
            #[inline(always)]
            fn binade(self) -> Self {
                // The exponent field e becomes 2·bias + 1 − e. (A NaN may have a sign.)
                let normal = if self < $f::MIN_POSITIVE {
                    $f::MIN_POSITIVE
                } else {
                    self
                };
                let field = normal.to_bits() & $f::INFINITY.to_bits();
                let twice_bias = (2 * ($f::MAX_EXP as $bits - 1) + 1) << $mantissa;
                $f::from_bits(twice_bias.wrapping_sub(field))
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
            fn known(self, known: bool, nan: Self) -> Self {
                if known { self } else { nan }
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

/// Returns [`atan2_wide`] of numbers, compiled once.
#[inline(never)]
fn atan2_of_wide(y: f64, x: f64) -> f64 {
    atan2_wide(y, x)
}

/// Returns [`atan2_single`] of numbers, compiled once.
#[inline(never)]
fn atan2_of_single(y: f64, x: f64) -> f64 {
    atan2_single(y, x)
}

float!(f32, u32, F32, low_half: 12, mantissa: 23,
    sines: sin_cos_single, angle: atan2_of_single, split: split_single, exponentials: exp_single ln_single);
float!(f64, u64, F64, low_half: 27, mantissa: 52,
    sines: sin_cos_wide, angle: atan2_of_wide, split: f64::parts, exponentials: exp_wide ln_wide);

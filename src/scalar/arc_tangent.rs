//! The angle of a vector in `f64` by our own arithmetic, on numbers and lanes alike, so that its bits are equal on
//! every machine and at every SIMD level.
//!
//! The arctangent of the shorter side over the longer one is that of `r = s / l`, or `π/4` and that of
//! `r = (s − l) / (s + l)` where that is nearer to zero, so that `r` is below `√2 − 1`. Then a polynomial follows, and the
//! multiple of `π/4` at which the octant begins. There is one division and no branch.
use super::polynomial::polynomial;
use crate::Scalar;
use std::f64::consts::{FRAC_PI_4, SQRT_2};

/// The error of the nearest number to `π/4`; that of each multiple up to four is as many times this one.
const LACKS: f64 = 3.061_616_997_868_383e-17;

/// The arctangent less its argument, over the cube of it, in powers of the square: the best ones in the uniform norm.
/// The arctangent of at most `√2 − 1` errs by less than 2⁻⁶³ of the cube.
const SERIES: [f64; 12] = [
    -0.333_333_333_333_333_3,
    0.199_999_999_999_988_55,
    -0.142_857_142_855_120_22,
    0.111_111_110_948_249_38,
    -0.090_909_083_553_991_24,
    0.076_922_870_208_649_48,
    -0.066_662_837_499_248_5,
    0.058_775_324_173_485_01,
    -0.052_214_375_344_140_81,
    0.045_150_122_183_836_82,
    -0.033_723_998_466_293_51,
    0.015_433_384_613_947_445,
];
/// The series for angles of `f32`: it errs by less than 2⁻⁴⁹ of the cube.
const SHORT_SERIES: [f64; 9] = [
    -0.333_333_333_332_989_9,
    0.199_999_999_888_458_87,
    -0.142_857_132_256_665_5,
    0.111_110_644_906_701_8,
    -0.090_897_776_942_790_79,
    0.076_758_687_636_079_25,
    -0.065_189_033_433_183_2,
    0.050_635_964_511_025_32,
    -0.025_805_289_343_612_675,
];

/// A vector by the octant of its angle: both sides without sign, the octant's first angle in `π/4`, and `true` where the
/// angle falls from there to zero.
#[derive(Clone, Copy)]
struct Octant<W: Scalar> {
    short: W,
    long: W,
    /// `true` where the shorter side is above `√2 − 1` of the longer one: `π/4` is nearer than the side of the octant.
    is_diagonal: W::Mask,
    start: W,
    sign: W,
}

impl<W: Scalar<Primal = W>> Octant<W> {
    #[inline(always)]
    fn of(y: W, x: W) -> Self {
        let (zero, one, largest) = (W::zero(), W::one(), W::lit(f64::MAX));
        let (along, across) = (x.unsigned(), y.unsigned());
        let is_steep = across.above(along);
        let short = W::select(is_steep, along, across);
        let long = W::select(is_steep, across, along);
        // The diagonal of infinite vectors is the one of finite ones.
        let (is_endless, diagonal) = (long.above(largest), short.above(largest));
        let short = W::select(is_endless, W::select(diagonal, one, zero), short);
        let long = W::select(is_endless, one, long);
        let is_diagonal = short.above(long * W::lit(SQRT_2 - 1.0));
        // From the x axis up, from the y axis down, from it on, from the x axis to the left back.
        let is_left = x.below(zero);
        let start = W::select(is_left, W::lit(4.0), zero);
        let start = W::select(is_steep, W::lit(2.0), start);
        let sign = W::select(is_left, -one, one);
        let sign = W::select(is_steep, -sign, sign);
        Octant {
            short,
            long,
            is_diagonal,
            start: W::select(is_diagonal, start + sign, start),
            sign,
        }
    }
    /// Returns the numerator and the denominator of `r`, each with its rounding error.
    #[inline(always)]
    fn quotient(short: W, long: W, is_diagonal: W::Mask) -> [[W; 2]; 2] {
        let (zero, one) = (W::zero(), W::one());
        let (less, more) = (short - long, short + long);
        // The longer side is the larger one.
        let (lacks_less, lacks_more) = (short - (less + long), short - (more - long));
        let pick = |yes: W, no: W| W::select(is_diagonal, yes, no);
        let long = W::select(long.equals(zero), one, long);
        [
            [pick(less, short), pick(lacks_less, zero)],
            [pick(more, long), pick(lacks_more, zero)],
        ]
    }
}

/// Returns the angle above or below the x axis; of NaN it is NaN.
#[inline(always)]
fn signed<W: Scalar<Primal = W>>(angle: W, y: W, x: W) -> W {
    let angle = W::select(y.below(W::zero()), -angle, angle);
    let is_known = x.equals(x) & y.equals(y);
    W::select(is_known, angle, x + y)
}

/// Returns two halves of the digits (Veltkamp): products of halves are exact.
#[inline(always)]
fn halves<W: Scalar>(x: W) -> [W; 2] {
    let large = x * W::lit(134_217_729.0);
    let high = large - (large - x);
    [high, x - high]
}

/// Returns the angle of the vector `(x, y)` in radians, in `[−π, π]`; 0 at the origin. The sign of a zero does not
/// count. It errs by 0.7 units in the last place at most: it is the nearest number in all but one of a hundred cases,
/// in which it is a neighbour.
#[inline(always)]
pub(crate) fn atan2_wide<W: Scalar<Primal = W>>(y: W, x: W) -> W {
    let octant = Octant::of(y, x);
    let unit = octant.long.binade();
    let (short, long) = (octant.short * unit, octant.long * unit);
    let [[above, above_lacks], [below, below_lacks]] =
        Octant::quotient(short, long, octant.is_diagonal);
    let inverse = W::one().over(below);
    // The quotient as a high half and the rest.
    let [r, _] = halves(above * inverse);
    let [high, low] = halves(below);
    let left = ((above - r * high) - r * low) + (above_lacks - r * below_lacks);
    let rest = left * inverse;
    let all = r + rest;
    let z = all * all;
    let rest = rest + all * z * polynomial(SERIES, z);
    let start = octant.start * W::lit(FRAC_PI_4);
    let lacks = octant.start * W::lit(LACKS);
    let (r, rest) = (r * octant.sign, rest * octant.sign);
    let sum = start + r;
    // The start is zero or larger.
    let more = r - (sum - start);
    signed(sum + (more + (lacks + rest)), y, x)
}

/// Returns the angle in `f64` of a vector of two `f32`: right to 2⁻⁴⁸.
#[inline(always)]
pub(crate) fn atan2_single<W: Scalar<Primal = W>>(y: W, x: W) -> W {
    let octant = Octant::of(y, x);
    let [[above, _], [below, _]] = Octant::quotient(octant.short, octant.long, octant.is_diagonal);
    let r = above.over(below);
    let z = r * r;
    let angle = r + r * z * polynomial(SHORT_SERIES, z);
    let start = octant.start * W::lit(FRAC_PI_4);
    signed(start + angle * octant.sign, y, x)
}

//! The angle of a vector in `f64` by our own arithmetic, so that it has the same bits on every machine.
//!
//! With `t = n / d` for the shorter and the longer side, and `c` the nearest multiple of 1/32 to it, the arctangent is
//! `atan c + atan r` with `r = (n − c d) / (d + c n)`. Quotient and sums carry their roundings, so that the result is the
//! nearest number but for one in some thousands, for which it is a neighbour.
use super::polynomial::polynomial;

/// `atan (k / 32)` as the nearest number and the rest.
const ARCTANGENTS: [[f64; 2]; 33] = [
    [0.0, 0.0],
    [0.031_239_833_430_268_277, -1.188_442_711_587_748e-18],
    [0.062_418_809_995_957_35, -1.549_075_630_829_504_6e-18],
    [0.093_476_781_158_589_47, -6.284_472_599_542_095_4e-18],
    [0.124_354_994_546_761_44, -3.125_324_142_453_938_3e-18],
    [0.154_996_741_923_940_97, 9.585_415_594_114_324e-18],
    [0.185_347_949_995_694_76, 4.180_692_268_843_079e-18],
    [0.215_357_699_697_738_05, 4.738_160_130_078_733e-19],
    [0.244_978_663_126_864_14, 1.069_875_561_873_445_1e-17],
    [0.274_167_451_119_658_8, 8.261_353_575_163_773e-18],
    [0.302_884_868_374_971_4, -1.101_082_790_300_136_9e-17],
    [0.331_096_076_704_132_1, -7.952_610_375_793_799e-18],
    [0.358_770_670_270_572_25, -2.462_381_558_263_863_5e-17],
    [0.385_882_669_398_073_75, 2.378_822_732_491_941e-17],
    [0.412_410_441_597_387_3, -1.587_652_227_770_689e-17],
    [0.438_336_559_857_957_83, -2.494_277_030_626_541e-17],
    [0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17],
    [0.488_333_951_056_405_54, -1.137_323_618_932_958_5e-17],
    [0.512_389_460_310_737_7, -2.546_278_147_285_580_4e-17],
    [0.535_811_237_960_463_7, -4.063_795_683_482_557_5e-18],
    [0.558_599_315_343_562_4, -5.455_630_548_591_626_4e-18],
    [0.580_756_353_567_670_4, -1.441_464_378_193_067e-17],
    [0.602_287_346_134_964_2, 2.950_430_737_228_402e-17],
    [0.623_199_329_934_065_9, 2.672_403_885_140_095e-17],
    [0.643_501_108_793_284_4, 1.583_478_505_144_428_6e-17],
    [0.663_202_992_706_093_3, -3.076_054_864_429_649e-17],
    [0.682_316_554_874_748_1, 6.943_223_671_560_008e-18],
    [0.700_854_407_884_450_2, -1.987_626_234_335_816e-17],
    [0.718_829_999_621_624_5, -2.147_838_844_445_698_3e-17],
    [0.736_257_428_981_428_1, 3.473_937_648_299_457e-17],
    [0.753_151_280_962_194_4, -2.425_693_465_918_206_8e-17],
    [0.769_526_480_405_658_3, -3.704_991_905_602_721e-17],
    [std::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17],
];
/// A quarter turn, as the nearest number and the rest.
const QUARTER: [f64; 2] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17];
/// Half a turn.
const HALF: [f64; 2] = [std::f64::consts::PI, 1.224_646_799_147_353_2e-16];

/// A sum and its rounding error.
fn sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let from_b = sum - a;
    [sum, (a - (sum - from_b)) + (b - from_b)]
}

/// The high half of a significand, and the rest: products of halves are exact.
fn halves(x: f64) -> [f64; 2] {
    let high = f64::from_bits(x.to_bits() & !((1 << 27) - 1));
    [high, x - high]
}

/// The power of two that brings a normal number into `[1, 2)`, or one near that for the extremes of the format.
fn unit_of(x: f64) -> f64 {
    let field = (x.to_bits() >> 52).clamp(1, 2045);
    f64::from_bits((2046 - field) << 52)
}

/// The angle of the vector `(x, y)` in radians, in `[−π, π]`; 0 at the origin. The sign of a zero does not count.
#[inline(never)]
pub(crate) fn atan2_wide(y: f64, x: f64) -> f64 {
    by_octants(y, x, |short, long| {
        if short < long * SMALL {
            // The arctangent is the quotient, which may be too small for a rest.
            return (0, [short / long, 0.0]);
        }
        let unit = unit_of(long);
        turned(short * unit, long * unit)
    })
}

/// The angle in `f64` of a vector of two `f32`: right to 2⁻⁴⁸.
#[inline(never)]
pub(crate) fn atan2_single(y: f64, x: f64) -> f64 {
    by_octants(y, x, |short, long| {
        let base = (short / long * 32.0 + 0.5) as usize;
        let c = base as f64 * (1.0 / 32.0);
        let r = (short - c * long) / (long + c * short);
        let z = r * r;
        let [third, fifth, seventh, ..] = SERIES;
        (base, [r, r * z * polynomial([third, fifth, seventh], z)])
    })
}

/// The angle of a vector, by the arctangent of its shorter side over its longer one: the index of a known arctangent, and
/// the rest of the way in two parts.
#[inline(always)]
fn by_octants(y: f64, x: f64, arctangent: impl Fn(f64, f64) -> (usize, [f64; 2])) -> f64 {
    let (along, across) = (x.abs(), y.abs());
    let is_steep = across > along;
    let (short, long) = match is_steep {
        true => (along, across),
        false => (across, along),
    };
    // Of zero, infinite and NaN.
    let (short, long) = match long > 0.0 && long <= f64::MAX {
        true => (short, long),
        false if along.is_nan() || across.is_nan() => return x + y,
        false if long == 0.0 => return 0.0,
        // The diagonal of infinite vectors is the one of finite ones.
        false => (if short == long { 1.0 } else { 0.0 }, 1.0),
    };
    if short.is_nan() {
        return x + y;
    }
    let (base, [high, low]) = arctangent(short, long);
    // The sides of the octants: at the x axis, at the y axis, at the x axis to the left.
    let (start, sign) = match (is_steep, x < 0.0) {
        (false, false) => ([0.0; 2], 1.0),
        (true, false) => (QUARTER, -1.0),
        (true, true) => (QUARTER, 1.0),
        (false, true) => (HALF, -1.0),
    };
    let [known, known_low] = ARCTANGENTS[base];
    let [first, rest] = sum(start[0], sign * known);
    let [angle, more] = sum(first, sign * high);
    let angle = angle + (more + (rest + (start[1] + sign * (known_low + low))));
    if y < 0.0 { -angle } else { angle }
}

/// Below this share of the longer side an angle is its tangent: the next term, a third of the cube, is less than a
/// quarter of a unit in the last place.
const SMALL: f64 = 7.450_580_596_923_828e-9;

/// The index of the known arctangent that is nearest to that of `short / long`, and the arctangent of the rest of the way
/// in two parts.
#[inline(always)]
fn turned(short: f64, long: f64) -> (usize, [f64; 2]) {
    let base = (short as f32 / long as f32 * 32.0 + 0.5) as usize;
    let c = base as f64 * (1.0 / 32.0);
    let ([short_high, short_low], [long_high, long_low]) = (halves(short), halves(long));
    // Six bits times a half are exact.
    let [above, above_low] = sum(short, -c * long_high);
    let [below, below_low] = sum(long, c * short_high);
    let [above, above_low] = sum(above, above_low - c * long_low);
    let [below, below_low] = sum(below, below_low + c * short_low);
    let inverse = 1.0 / below;
    // The quotient as a half and what is left of it.
    let [r, _] = halves(above * inverse);
    let [high, low] = halves(below);
    let left = ((above - r * high) - r * low) + (above_low - r * below_low);
    let rest = left * inverse;
    let all = r + rest;
    let z = all * all;
    (base, [r, rest + all * z * polynomial(SERIES, z)])
}

/// The arctangent less its argument, over the cube of it: a series in the square, whose first term left out is below
/// 2⁻⁷⁰.
const SERIES: [f64; 6] = [
    -1.0 / 3.0,
    1.0 / 5.0,
    -1.0 / 7.0,
    1.0 / 9.0,
    -1.0 / 11.0,
    1.0 / 13.0,
];

//! Distributions of numbers that provoke errors.
use crate::Real;
use crate::ad::declared::Kind;
use crate::ad::sample::Draw;
use crate::kernels::row::op::{Finite, Limits};
use std::f64::consts::FRAC_PI_4;

/// A distribution of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    /// Any bit pattern of a finite number.
    Bits,
    /// From 2⁻¹⁶ to 2¹⁶.
    Moderate,
    /// A few values, so that shapes share coordinates; angles are multiples of 45 degrees.
    Shared,
    /// A few values, and others a few roundings away.
    Nearly,
    /// Numbers of about unit size.
    Ordinary,
    /// Numbers of about unit size times one power of two.
    Scaled(i32),
    /// Powers of two.
    Powers,
    /// The largest and the smallest numbers, and others near them.
    Limits,
}

/// The few values of shared coordinates.
const SHARED: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5, 3.0, 0.1, -0.1, 1e-3, 1e3, 0.25, 1.5, -3.0,
];

/// Returns `true` if a format is double precision.
pub(super) fn is_wide<T: Real>() -> bool {
    T::format().largest() > f64::from(f32::MAX)
}

/// Returns the exponents of the least and of the largest number.
fn exponents<T: Real>() -> [i32; 2] {
    match is_wide::<T>() {
        true => [-1074, 1023],
        false => [-149, 127],
    }
}

/// Returns two to a power, subnormal ones included.
pub(super) fn power(exponent: i32) -> f64 {
    match exponent {
        ..-1074 => 0.0,
        -1074..-1022 => f64::from_bits(1 << (exponent + 1074)),
        -1022..=1023 => f64::from_bits(((exponent + 1023) as u64) << 52),
        _ => f64::INFINITY,
    }
}

/// Returns the nearest finite number of the format.
fn nearest<T: Real>(x: f64) -> T {
    T::lit(x.clamp(-T::format().largest(), T::format().largest()))
}

impl Family {
    /// Returns a random family that batches compute at full speed.
    pub fn quick(draw: &mut Draw) -> Self {
        match draw.below(6) {
            0 | 1 => Family::Moderate,
            2 => Family::Shared,
            3 => Family::Nearly,
            _ => Family::Ordinary,
        }
    }
    /// Returns a random family.
    pub fn any<T: Real>(draw: &mut Draw) -> Self {
        match draw.below(10) {
            0 => Family::Bits,
            1 | 2 => Family::Limits,
            3 => Family::Powers,
            4 => {
                let [least, most] = exponents::<T>();
                Family::Scaled(least + draw.below((most - least) as usize) as i32)
            }
            _ => Family::quick(draw),
        }
    }
    /// Returns a number of a kind.
    #[inline]
    pub fn number<T: Real>(self, kind: Kind, draw: &mut Draw) -> T {
        let bits = draw.bits();
        let is_angle = kind.is_angle();
        match self {
            Family::Bits => {
                let x = match is_wide::<T>() {
                    true => f64::from_bits(bits),
                    false => f64::from(f32::from_bits((bits >> 32) as u32)),
                };
                T::lit(if x.is_finite() { x } else { 1.0 })
            }
            // Both signs.
            Family::Moderate => {
                let power = 1023 - 16 + (bits & 31);
                T::lit(f64::from_bits(
                    bits << 58 & 1 << 63 | power << 52 | bits >> 12,
                ))
            }
            Family::Shared | Family::Nearly => {
                let x = match is_angle {
                    true => ((bits >> 60) as f64 - 8.0) * FRAC_PI_4,
                    false => SHARED[(bits >> 60) as usize],
                };
                let roundings = match self {
                    Family::Nearly => (bits & 7) as f64 - 4.0,
                    _ => 0.0,
                };
                T::lit(x * (1.0 + roundings * T::format().epsilon()))
            }
            Family::Ordinary => T::lit((bits >> 11) as f64 / (1_u64 << 51) as f64 - 2.0),
            Family::Scaled(exponent) => {
                let x = (bits >> 11) as f64 / (1_u64 << 51) as f64 - 2.0;
                nearest(if is_angle { x } else { x * power(exponent) })
            }
            Family::Powers => {
                let [least, most] = exponents::<T>();
                let exponent = least + (bits >> 33) as i32 % (most - least + 1);
                nearest(power(exponent) * if bits & 1 == 0 { 1.0 } else { -1.0 })
            }
            Family::Limits => {
                let most = T::format().largest();
                let [least, largest] = exponents::<T>();
                // The smallest normal number.
                let normal = power(2 - largest - 1);
                let x = match bits >> 60 {
                    0 | 1 => most,
                    2 => most * (1.0 - T::format().epsilon()),
                    3 => most * 0.5,
                    4 => most * 0.25,
                    5 => most.sqrt(),
                    6 => most.sqrt() * 0.5,
                    7 => normal,
                    8 => normal * 1.5,
                    9 => normal * 0.75,
                    10 => power(least),
                    11 => normal.sqrt(),
                    12 => T::format().epsilon(),
                    13 => 0.0,
                    14 => 1.0,
                    _ => 1.0 + T::format().epsilon(),
                };
                nearest(if bits & 1 == 0 { x } else { -x })
            }
        }
    }
}

/// Returns the exponents to which a row limits its numbers.
pub(super) fn limits_of<T: Real>(finite: Finite) -> Option<[i32; 2]> {
    let of = |limits: Limits| match is_wide::<T>() {
        true => limits.double,
        false => limits.single,
    };
    match finite {
        Finite::Always => None,
        Finite::Within(limits) | Finite::Values(limits) => Some(of(limits)),
        Finite::Undeclared => Some(of(Limits::ORDINARY)),
    }
}

/// Returns `true` if a row with limits declares a property for this angle.
pub(super) fn is_angle_within<T: Real>(x: T) -> bool {
    let [single, double] = Limits::LEAST_ANGLE;
    let least = if is_wide::<T>() { double } else { single };
    let size = x.widen().abs();
    size == 0.0 || size >= power(least)
}

/// Returns a number within limits: with another exponent if its own is beyond them; zero for a smaller angle.
pub(super) fn limited<T: Real>(x: T, kind: Kind, [least, most]: [i32; 2]) -> T {
    let wide = x.widen();
    if kind.is_angle() && !is_angle_within(x) {
        return T::zero();
    }
    if wide == 0.0 || (kind.is_angle() && wide.abs() <= power(most)) {
        return x;
    }
    let bits = wide.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32 - 1023;
    if (least..most).contains(&exponent) {
        return x;
    }
    let exponent = least + (exponent - least).rem_euclid(most - least);
    T::lit(f64::from_bits(
        bits & !(0x7ff << 52) | ((exponent + 1023) as u64) << 52,
    ))
}

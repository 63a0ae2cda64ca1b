//! Sines and cosines of vectors, and angles.
use super::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8, Vector};
use crate::Scalar;
use crate::scalar::arc_tangent::{atan2_single, atan2_wide};
use crate::scalar::float::{HIGH_OF_SINGLE, sin_cos_single, sin_cos_wide};
use std::arch::x86_64::*;

/// Returns sines and cosines of angles beyond the polynomial's range, number by number. Not inlined: it is rare, and
/// the call costs less than the code's size.
#[inline(never)]
fn far_sin_cos<const N: usize>(angle: [f64; N]) -> ([f64; N], [f64; N]) {
    (angle.map(libm::sin), angle.map(libm::cos))
}

/// Sines and cosines of vectors of `f64`.
macro_rules! wide {
    ($name:ident) => {
        impl $name {
            #[inline(always)]
            fn far(self) -> (Self, Self) {
                let (sin, cos) = far_sin_cos(self.array());
                (Self::from_array(sin), Self::from_array(cos))
            }
            #[inline(always)]
            pub(super) fn wide_sin_cos(self) -> (Self, Self) {
                sin_cos_wide(self, Self::far)
            }
            #[inline(always)]
            pub(super) fn wide_atan2(self, x: Self) -> Self {
                atan2_wide(self, x)
            }
            #[inline(always)]
            pub(super) fn wide_parts(self) -> [(Self, Self); 2] {
                let (sin, cos) = self.wide_sin_cos();
                [sin.parts(), cos.parts()]
            }
        }
    };
}

/// Sines and cosines of vectors of `f32`, computed in `f64` half by half.
macro_rules! narrow {
    ($name:ident = 2 $half:ident of $wide:ident: $widen:ident $narrow:ident $and:ident;
     low |$v:ident| $low:expr, high $high:expr; join |$x:ident, $y:ident| $join:expr) => {
        impl $name {
            /// Returns both halves in `f64`.
            #[inline(always)]
            pub(super) fn halves(self) -> [$wide; 2] {
                let $v = self.0;
                [$wide(arch!($widen($low))), $wide(arch!($widen($high)))]
            }
            /// Returns the sines and cosines of both halves.
            #[inline(always)]
            pub(super) fn wide_sin_cos(self) -> [($wide, $wide); 2] {
                let [low, high] = self.halves();
                [
                    sin_cos_single(low, $wide::far),
                    sin_cos_single(high, $wide::far),
                ]
            }
            #[inline(always)]
            fn join($x: $half, $y: $half) -> Self {
                $name(arch!($join))
            }
            #[inline(always)]
            pub(super) fn narrow(low: $wide, high: $wide) -> Self {
                Self::join(arch!($narrow(low.0)), arch!($narrow(high.0)))
            }
            /// Returns the high parts and the rests of numbers in `f64`, as
            /// [`split_single`](crate::scalar::float::split_single).
            #[inline(always)]
            fn parts_of(low: $wide, high: $wide) -> (Self, Self) {
                let mask = $wide::splat(f64::from_bits(HIGH_OF_SINGLE));
                let (a, b) = (
                    $wide(arch!($and(low.0, mask.0))),
                    $wide(arch!($and(high.0, mask.0))),
                );
                (Self::narrow(a, b), Self::narrow(low - a, high - b))
            }
            #[inline(always)]
            pub(super) fn narrow_sin_cos(self) -> (Self, Self) {
                let [low, high] = self.wide_sin_cos();
                (Self::narrow(low.0, high.0), Self::narrow(low.1, high.1))
            }
            #[inline(always)]
            pub(super) fn narrow_atan2(self, x: Self) -> Self {
                let ([y_low, y_high], [x_low, x_high]) = (self.halves(), x.halves());
                Self::narrow(atan2_single(y_low, x_low), atan2_single(y_high, x_high))
            }
            #[inline(always)]
            pub(super) fn narrow_parts(self) -> [(Self, Self); 2] {
                let [low, high] = self.wide_sin_cos();
                [Self::parts_of(low.0, high.0), Self::parts_of(low.1, high.1)]
            }
        }
    };
}
wide!(F64x2);
wide!(F64x4);
wide!(F64x8);
narrow! {
    F32x4 = 2 __m128 of F64x2: _mm_cvtps_pd _mm_cvtpd_ps _mm_and_pd;
    low |v| v, high _mm_movehl_ps(v, v);
    join |x, y| _mm_movelh_ps(x, y)
}
narrow! {
    F32x8 = 2 __m128 of F64x4: _mm256_cvtps_pd _mm256_cvtpd_ps _mm256_and_pd;
    low |v| _mm256_castps256_ps128(v), high _mm256_extractf128_ps::<1>(v);
    join |x, y| _mm256_set_m128(y, x)
}
narrow! {
    F32x16 = 2 __m256 of F64x8: _mm512_cvtps_pd _mm512_cvtpd_ps _mm512_and_pd;
    low |v| _mm512_castps512_ps256(v), high _mm512_extractf32x8_ps::<1>(v);
    join |x, y| _mm512_insertf32x8::<1>(_mm512_castps256_ps512(x), y)
}

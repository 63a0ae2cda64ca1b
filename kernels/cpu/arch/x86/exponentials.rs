//! Exponentials and logarithms of vectors.
use super::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8, Vector};
use crate::scalar::exponential::{
    BITS, Exponents, FRACTION, ONE, UNBIASED, WHOLE, biased, exp_single, exp_wide, ln_single,
    ln_wide,
};
use std::arch::x86_64::*;

/// Exponentials and logarithms of vectors of `f64`.
macro_rules! wide {
    ($name:ident: $to_int:ident $from_int:ident $left:ident $right:ident $and:ident $or:ident) => {
        impl Exponents for $name {
            #[inline(always)]
            fn power_of_two(k: Self) -> Self {
                $name(arch!($from_int($left::<{ BITS as _ }>($to_int(
                    biased(k).0
                )))))
            }
            #[inline(always)]
            fn exponent(self) -> (Self, Self) {
                let bits = |bits: u64| Self::splat(f64::from_bits(bits)).0;
                let field = arch!($from_int($right::<{ BITS as _ }>($to_int(self.0))));
                (
                    $name(arch!($or(field, bits(WHOLE)))) - Self::splat(UNBIASED),
                    $name(arch!($or($and(self.0, bits(FRACTION)), bits(ONE)))),
                )
            }
        }
        impl $name {
            #[inline(always)]
            pub(super) fn wide_exp(self) -> Self {
                exp_wide(self)
            }
            #[inline(always)]
            pub(super) fn wide_ln(self) -> Self {
                ln_wide(self)
            }
        }
    };
}
wide!(F64x2: _mm_castpd_si128 _mm_castsi128_pd _mm_slli_epi64 _mm_srli_epi64 _mm_and_pd _mm_or_pd);
wide!(F64x4: _mm256_castpd_si256 _mm256_castsi256_pd _mm256_slli_epi64 _mm256_srli_epi64 _mm256_and_pd _mm256_or_pd);
wide!(F64x8: _mm512_castpd_si512 _mm512_castsi512_pd _mm512_slli_epi64 _mm512_srli_epi64 _mm512_and_pd _mm512_or_pd);

/// Exponentials and logarithms of vectors of `f32`, computed in `f64` half by half.
macro_rules! narrow {
    ($($name:ident)*) => { $(
        impl $name {
            #[inline(always)]
            pub(super) fn narrow_exp(self) -> Self {
                let [low, high] = self.halves();
                Self::narrow(exp_single(low), exp_single(high))
            }
            #[inline(always)]
            pub(super) fn narrow_ln(self) -> Self {
                let [low, high] = self.halves();
                Self::narrow(ln_single(low), ln_single(high))
            }
        }
    )* };
}
narrow!(F32x4 F32x8 F32x16);

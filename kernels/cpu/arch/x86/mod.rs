//! Vectors of SSE2, AVX2 and AVX-512.
use super::Vector;
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::{Mask, Scalar};
use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// The only unsafe expression of vector arithmetic. Sound because values of these types exist
/// only in functions compiled for their instruction set: see the module above.
macro_rules! arch {
    ($e:expr) => {{
        // Masks of AVX-512 are plain integers.
        #[allow(unused_unsafe)]
        unsafe {
            $e
        }
    }};
}

#[macro_use]
mod registers;
mod exponentials;
mod items;
mod sines;

use items::*;

vector! {
    /// Two `f64` of SSE2.
    F64x2(__m128d, Mask64x2(__m128d)) of 2 f64, bits u64, low half 27;
    _mm_add_pd _mm_sub_pd _mm_mul_pd _mm_div_pd _mm_sqrt_pd _mm_min_pd _mm_max_pd
    _mm_and_pd _mm_andnot_pd _mm_xor_pd _mm_set1_pd
    _mm_castsi128_pd _mm_castpd_si128 _mm_set1_epi64x _mm_and_si128 _mm_sub_epi64;
    below |p, q| _mm_cmplt_pd(p, q), _mm_cmple_pd(p, q), _mm_cmpeq_pd(p, q);
    choose |m, yes, no| _mm_or_pd(_mm_and_pd(m, yes), _mm_andnot_pd(m, no));
    masks |a, b| _mm_and_pd(a, b), _mm_or_pd(a, b),
        _mm_xor_pd(a, _mm_castsi128_pd(_mm_set1_epi8(-1))), _mm_movemask_pd(a);
    words |x| x, x;
    sines |angle| angle.wide_sin_cos(), angle.wide_parts();
    angle wide_atan2;
    exponentials wide_exp wide_ln;
    items from_f64x2 to_f64x2
}

vector! {
    /// Four `f32` of SSE2.
    F32x4(__m128, Mask32x4(__m128)) of 4 f32, bits u32, low half 12;
    _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps _mm_sqrt_ps _mm_min_ps _mm_max_ps
    _mm_and_ps _mm_andnot_ps _mm_xor_ps _mm_set1_ps
    _mm_castsi128_ps _mm_castps_si128 _mm_set1_epi32 _mm_and_si128 _mm_sub_epi32;
    below |p, q| _mm_cmplt_ps(p, q), _mm_cmple_ps(p, q), _mm_cmpeq_ps(p, q);
    choose |m, yes, no| _mm_or_ps(_mm_and_ps(m, yes), _mm_andnot_ps(m, no));
    masks |a, b| _mm_and_ps(a, b), _mm_or_ps(a, b),
        _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi8(-1))), _mm_movemask_ps(a);
    words |x| x, x;
    sines |angle| angle.narrow_sin_cos(), angle.narrow_parts();
    angle narrow_atan2;
    exponentials narrow_exp narrow_ln;
    items from_f32x4 to_f32x4
}

vector! {
    /// Four `f64` of AVX2.
    F64x4(__m256d, Mask64x4(__m256d)) of 4 f64, bits u64, low half 27;
    _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd _mm256_min_pd _mm256_max_pd
    _mm256_and_pd _mm256_andnot_pd _mm256_xor_pd _mm256_set1_pd
    _mm256_castsi256_pd _mm256_castpd_si256 _mm256_set1_epi64x _mm256_and_si256 _mm256_sub_epi64;
    below |p, q| _mm256_cmp_pd::<_CMP_LT_OQ>(p, q), _mm256_cmp_pd::<_CMP_LE_OQ>(p, q), _mm256_cmp_pd::<_CMP_EQ_OQ>(p, q);
    choose |m, yes, no| _mm256_blendv_pd(no, yes, m);
    masks |a, b| _mm256_and_pd(a, b), _mm256_or_pd(a, b),
        _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi8(-1))), _mm256_movemask_pd(a);
    words |x| x, x;
    sines |angle| angle.wide_sin_cos(), angle.wide_parts();
    angle wide_atan2;
    exponentials wide_exp wide_ln;
    items from_f64x4 to_f64x4
}

vector! {
    /// Eight `f32` of AVX2.
    F32x8(__m256, Mask32x8(__m256)) of 8 f32, bits u32, low half 12;
    _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_sqrt_ps _mm256_min_ps _mm256_max_ps
    _mm256_and_ps _mm256_andnot_ps _mm256_xor_ps _mm256_set1_ps
    _mm256_castsi256_ps _mm256_castps_si256 _mm256_set1_epi32 _mm256_and_si256 _mm256_sub_epi32;
    below |p, q| _mm256_cmp_ps::<_CMP_LT_OQ>(p, q), _mm256_cmp_ps::<_CMP_LE_OQ>(p, q), _mm256_cmp_ps::<_CMP_EQ_OQ>(p, q);
    choose |m, yes, no| _mm256_blendv_ps(no, yes, m);
    masks |a, b| _mm256_and_ps(a, b), _mm256_or_ps(a, b),
        _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi8(-1))), _mm256_movemask_ps(a);
    words |x| x, x;
    sines |angle| angle.narrow_sin_cos(), angle.narrow_parts();
    angle narrow_atan2;
    exponentials narrow_exp narrow_ln;
    items from_f32x8 to_f32x8
}

vector! {
    /// Eight `f64` of AVX-512.
    F64x8(__m512d, Mask64x8(__mmask8)) of 8 f64, bits u64, low half 27;
    _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd _mm512_min_pd _mm512_max_pd
    _mm512_and_pd _mm512_andnot_pd _mm512_xor_pd _mm512_set1_pd
    _mm512_castsi512_pd _mm512_castpd_si512 _mm512_set1_epi64 _mm512_and_si512 _mm512_sub_epi64;
    below |p, q| _mm512_cmp_pd_mask::<_CMP_LT_OQ>(p, q), _mm512_cmp_pd_mask::<_CMP_LE_OQ>(p, q), _mm512_cmp_pd_mask::<_CMP_EQ_OQ>(p, q);
    choose |m, yes, no| _mm512_mask_blend_pd(m, no, yes);
    masks |a, b| a & b, a | b, !a, a;
    words |x| _mm512_castsi512_pd(_mm512_movm_epi64(x)), _mm512_movepi64_mask(_mm512_castpd_si512(x));
    sines |angle| angle.wide_sin_cos(), angle.wide_parts();
    angle wide_atan2;
    exponentials wide_exp wide_ln;
    items from_f64x8 to_f64x8
}

vector! {
    /// Sixteen `f32` of AVX-512.
    F32x16(__m512, Mask32x16(__mmask16)) of 16 f32, bits u32, low half 12;
    _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps _mm512_sqrt_ps _mm512_min_ps _mm512_max_ps
    _mm512_and_ps _mm512_andnot_ps _mm512_xor_ps _mm512_set1_ps
    _mm512_castsi512_ps _mm512_castps_si512 _mm512_set1_epi32 _mm512_and_si512 _mm512_sub_epi32;
    below |p, q| _mm512_cmp_ps_mask::<_CMP_LT_OQ>(p, q), _mm512_cmp_ps_mask::<_CMP_LE_OQ>(p, q), _mm512_cmp_ps_mask::<_CMP_EQ_OQ>(p, q);
    choose |m, yes, no| _mm512_mask_blend_ps(m, no, yes);
    masks |a, b| a & b, a | b, !a, a;
    words |x| _mm512_castsi512_ps(_mm512_movm_epi32(x)), _mm512_movepi32_mask(_mm512_castps_si512(x));
    sines |angle| angle.narrow_sin_cos(), angle.narrow_parts();
    angle narrow_atan2;
    exponentials narrow_exp narrow_ln;
    items from_f32x16 to_f32x16
}

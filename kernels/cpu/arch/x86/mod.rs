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
mod eights;
mod exponentials;
mod sines;

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

/// Transposes the 4×4 matrices in every 128 bits of four vectors.
macro_rules! exchange {
    ($unpacklo:ident $unpackhi:ident $shuffle:ident; $a:ident $b:ident $c:ident $d:ident) => {{
        let (p, q) = ($unpacklo($a, $b), $unpackhi($a, $b));
        let (r, s) = ($unpacklo($c, $d), $unpackhi($c, $d));
        [
            $shuffle::<0b01_00_01_00>(p, r),
            $shuffle::<0b11_10_11_10>(p, r),
            $shuffle::<0b01_00_01_00>(q, s),
            $shuffle::<0b11_10_11_10>(q, s),
        ]
    }};
}

#[inline(always)]
fn quad(x: [f32; 4]) -> __m128 {
    arch!(std::mem::transmute::<[f32; 4], __m128>(x))
}
#[inline(always)]
fn quad_of(x: __m128) -> [f32; 4] {
    arch!(std::mem::transmute::<__m128, [f32; 4]>(x))
}

#[inline(always)]
fn exchange_f32x16([F32x16(a), F32x16(b), F32x16(c), F32x16(d)]: [F32x16; 4]) -> [F32x16; 4] {
    arch!(exchange!(_mm512_unpacklo_ps _mm512_unpackhi_ps _mm512_shuffle_ps; a b c d)).map(F32x16)
}
#[inline(always)]
pub(super) fn from_f32x16(item: impl Fn(usize) -> [f32; 4]) -> [F32x16; 4] {
    // Every fourth item, so that the transposition puts them in order.
    #[inline(always)]
    fn spaced(a: [f32; 4], b: [f32; 4], c: [f32; 4], d: [f32; 4]) -> F32x16 {
        let low = arch!(_mm512_insertf32x4::<1>(
            _mm512_castps128_ps512(quad(a)),
            quad(b)
        ));
        let three = arch!(_mm512_insertf32x4::<2>(low, quad(c)));
        F32x16(arch!(_mm512_insertf32x4::<3>(three, quad(d))))
    }
    exchange_f32x16([
        spaced(item(0), item(4), item(8), item(12)),
        spaced(item(1), item(5), item(9), item(13)),
        spaced(item(2), item(6), item(10), item(14)),
        spaced(item(3), item(7), item(11), item(15)),
    ])
}
#[inline(always)]
pub(super) fn to_f32x16(fields: [F32x16; 4], mut put: impl FnMut(usize, [f32; 4])) {
    let spaced = exchange_f32x16(fields);
    let mut i = 0;
    while i < 4 {
        let F32x16(x) = spaced[i];
        put(i, quad_of(arch!(_mm512_castps512_ps128(x))));
        put(i + 4, quad_of(arch!(_mm512_extractf32x4_ps::<1>(x))));
        put(i + 8, quad_of(arch!(_mm512_extractf32x4_ps::<2>(x))));
        put(i + 12, quad_of(arch!(_mm512_extractf32x4_ps::<3>(x))));
        i += 1;
    }
}

#[inline(always)]
fn exchange_f32x4([F32x4(a), F32x4(b), F32x4(c), F32x4(d)]: [F32x4; 4]) -> [F32x4; 4] {
    arch!(exchange!(_mm_unpacklo_ps _mm_unpackhi_ps _mm_shuffle_ps; a b c d)).map(F32x4)
}
#[inline(always)]
pub(super) fn from_f32x4(item: impl Fn(usize) -> [f32; 4]) -> [F32x4; 4] {
    exchange_f32x4([0, 1, 2, 3].map(
        #[inline(always)]
        |i| F32x4(quad(item(i))),
    ))
}
#[inline(always)]
pub(super) fn to_f32x4(fields: [F32x4; 4], mut put: impl FnMut(usize, [f32; 4])) {
    let items = exchange_f32x4(fields);
    let mut i = 0;
    while i < 4 {
        put(i, quad_of(items[i].0));
        i += 1;
    }
}

#[inline(always)]
pub(super) fn from_f64x2(item: impl Fn(usize) -> [f64; 4]) -> [F64x2; 4] {
    let ([a, b, c, d], [e, f, g, h]) = (item(0), item(1));
    [
        F64x2::from_array([a, e]),
        F64x2::from_array([b, f]),
        F64x2::from_array([c, g]),
        F64x2::from_array([d, h]),
    ]
}
#[inline(always)]
pub(super) fn to_f64x2(fields: [F64x2; 4], mut put: impl FnMut(usize, [f64; 4])) {
    let [x, y, z, w] = fields;
    let (x, y, z, w) = (x.array(), y.array(), z.array(), w.array());
    put(0, [x[0], y[0], z[0], w[0]]);
    put(1, [x[1], y[1], z[1], w[1]]);
}

#[inline(always)]
fn exchange_f32x8([F32x8(a), F32x8(b), F32x8(c), F32x8(d)]: [F32x8; 4]) -> [F32x8; 4] {
    arch!(exchange!(_mm256_unpacklo_ps _mm256_unpackhi_ps _mm256_shuffle_ps; a b c d)).map(F32x8)
}
#[inline(always)]
pub(super) fn from_f32x8(item: impl Fn(usize) -> [f32; 4]) -> [F32x8; 4] {
    #[inline(always)]
    fn spaced(a: [f32; 4], b: [f32; 4]) -> F32x8 {
        F32x8(arch!(_mm256_set_m128(quad(b), quad(a))))
    }
    exchange_f32x8([
        spaced(item(0), item(4)),
        spaced(item(1), item(5)),
        spaced(item(2), item(6)),
        spaced(item(3), item(7)),
    ])
}
#[inline(always)]
pub(super) fn to_f32x8(fields: [F32x8; 4], mut put: impl FnMut(usize, [f32; 4])) {
    let spaced = exchange_f32x8(fields);
    let mut i = 0;
    while i < 4 {
        let F32x8(x) = spaced[i];
        put(i, quad_of(arch!(_mm256_castps256_ps128(x))));
        put(i + 4, quad_of(arch!(_mm256_extractf128_ps::<1>(x))));
        i += 1;
    }
}

#[inline(always)]
fn exchange_f64x4([F64x4(a), F64x4(b), F64x4(c), F64x4(d)]: [F64x4; 4]) -> [F64x4; 4] {
    arch!({
        let (p, q) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (r, s) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(p, r),
            _mm256_permute2f128_pd::<0x20>(q, s),
            _mm256_permute2f128_pd::<0x31>(p, r),
            _mm256_permute2f128_pd::<0x31>(q, s),
        ]
    })
    .map(F64x4)
}
#[inline(always)]
pub(super) fn from_f64x4(item: impl Fn(usize) -> [f64; 4]) -> [F64x4; 4] {
    exchange_f64x4([
        F64x4::from_array(item(0)),
        F64x4::from_array(item(1)),
        F64x4::from_array(item(2)),
        F64x4::from_array(item(3)),
    ])
}
#[inline(always)]
pub(super) fn to_f64x4(fields: [F64x4; 4], mut put: impl FnMut(usize, [f64; 4])) {
    let items = exchange_f64x4(fields);
    let mut i = 0;
    while i < 4 {
        put(i, items[i].array());
        i += 1;
    }
}

#[inline(always)]
fn exchange_f64x8([F64x8(a), F64x8(b), F64x8(c), F64x8(d)]: [F64x8; 4]) -> [F64x8; 4] {
    arch!({
        let (p, q) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        let (r, s) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
        let low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
        let high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
        [
            _mm512_permutex2var_pd(p, low, r),
            _mm512_permutex2var_pd(q, low, s),
            _mm512_permutex2var_pd(p, high, r),
            _mm512_permutex2var_pd(q, high, s),
        ]
    })
    .map(F64x8)
}
#[inline(always)]
pub(super) fn from_f64x8(item: impl Fn(usize) -> [f64; 4]) -> [F64x8; 4] {
    #[inline(always)]
    fn spaced(a: [f64; 4], b: [f64; 4]) -> F64x8 {
        let (F64x4(a), F64x4(b)) = (F64x4::from_array(a), F64x4::from_array(b));
        F64x8(arch!(_mm512_insertf64x4::<1>(_mm512_castpd256_pd512(a), b)))
    }
    exchange_f64x8([
        spaced(item(0), item(4)),
        spaced(item(1), item(5)),
        spaced(item(2), item(6)),
        spaced(item(3), item(7)),
    ])
}
#[inline(always)]
pub(super) fn to_f64x8(fields: [F64x8; 4], mut put: impl FnMut(usize, [f64; 4])) {
    let spaced = exchange_f64x8(fields);
    let mut i = 0;
    while i < 4 {
        let F64x8(x) = spaced[i];
        put(i, F64x4(arch!(_mm512_castpd512_pd256(x))).array());
        put(i + 4, F64x4(arch!(_mm512_extractf64x4_pd::<1>(x))).array());
        i += 1;
    }
}

//! Items of four numbers each into vectors of a field each, and back.
use super::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
use std::arch::x86_64::*;

/// Four rows of four numbers in every 128 bits, rows and columns exchanged.
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
    // Every fourth item, so that they end up in order.
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

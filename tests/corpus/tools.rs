//! Common parts of the functions of the corpus.
use geograd::Scalar;
use std::array::from_fn;

/// A list of known length as an array.
///
/// # Panics
///
/// When the list has another length.
pub fn array<S: Copy, const N: usize>(list: &[S]) -> [S; N] {
    list.try_into()
        .expect("as many numbers as the function has")
}

/// Scalar product.
pub fn dot<S: Scalar, const N: usize>(a: [S; N], b: [S; N]) -> S {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum += a[i] * b[i];
    }
    sum
}
/// Sum of two vectors.
pub fn plus<S: Scalar, const N: usize>(a: [S; N], b: [S; N]) -> [S; N] {
    from_fn(|i| a[i] + b[i])
}
/// Difference of two vectors.
pub fn minus<S: Scalar, const N: usize>(a: [S; N], b: [S; N]) -> [S; N] {
    from_fn(|i| a[i] - b[i])
}
/// A vector times a number.
pub fn times<S: Scalar, const N: usize>(a: [S; N], by: S) -> [S; N] {
    a.map(|x| x * by)
}
/// Vector product.
pub fn cross<S: Scalar>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
/// Literals.
pub fn literals<S: Scalar, const N: usize>(x: [f64; N]) -> [S; N] {
    x.map(S::lit)
}
/// One over a number, and zero of zero: so a norm has derivative zero at zero.
pub fn inverse<S: Scalar>(x: S) -> S {
    S::select(x.equals(S::zero()), S::zero(), S::one() / x)
}
/// The derivative of the larger of `x` and zero: 0, 1, and a half at the tie.
pub fn step<S: Scalar>(x: S) -> S {
    let side = S::select(x.above(S::zero()), S::one(), S::zero());
    S::select(x.equals(S::zero()), S::lit(0.5), side)
}
/// The derivative of the absolute value: −1, 1, and zero at zero.
pub fn sign<S: Scalar>(x: S) -> S {
    let side = S::select(x.above(S::zero()), S::one(), -S::one());
    S::select(x.equals(S::zero()), S::zero(), side)
}
/// The logistic function.
pub fn sigmoid<S: Scalar>(x: S) -> S {
    S::one() / (S::one() + (-x).exp())
}
/// The hyperbolic tangent.
pub fn tanh<S: Scalar>(x: S) -> S {
    S::one() - S::lit(2.0) / ((x + x).exp() + S::one())
}

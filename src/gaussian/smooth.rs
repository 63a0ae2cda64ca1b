//! Functions of small differences that keep their digits.
use crate::Scalar;

/// Within this of zero, series replace logarithms and exponentials.
const NEAR: f64 = 0.25;

/// Returns `atanh(y) / y − 1`, for `y² ≤ 1/49`: the sum of `y²ⁿ / (2n + 1)`.
#[inline(always)]
fn atanh_series<S: Scalar>(square: S) -> S {
    let mut sum = S::lit(1.0 / 21.0);
    for odd in [19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0] {
        sum = sum * square + S::lit(1.0 / odd);
    }
    sum * square
}

/// Returns `ln(1 + x)` for `x > −1`, right to a few roundings for small x, too.
#[must_use]
#[inline]
pub fn ln_one_plus<S: Scalar>(x: S) -> S {
    let small = x.unsigned().below(S::lit(NEAR));
    // ln(1 + x) = 2 atanh(x / (2 + x)).
    let held = S::select(small, x, S::zero());
    let y = held.over(held + S::lit(2.0));
    let near = (y + y) * (S::one() + atanh_series(y * y));
    S::select(
        small,
        near,
        (S::select(small, S::zero(), x) + S::one()).ln(),
    )
}

/// Returns `eˣ − 1`, right to a few roundings for small x, too.
#[must_use]
#[inline]
pub fn exp_minus_one<S: Scalar>(x: S) -> S {
    let small = x.unsigned().below(S::lit(NEAR));
    let held = S::select(small, x, S::zero());
    // x (1 + x/2 (1 + x/3 (1 + …))).
    let mut sum = S::one();
    for n in [12.0, 11.0, 10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0] {
        sum = S::one() + sum * held * S::lit(1.0 / n);
    }
    let far = S::select(small, S::zero(), x).exp() - S::one();
    S::select(small, held * sum, far)
}

/// Returns `r − 1 − ln r` for `r = (p/q)²` and positive p and q: zero where they are equal, positive elsewhere.
#[must_use]
#[inline]
pub fn excess<S: Scalar>(p: S, q: S) -> S {
    // x = r − 1 = e (2 + e) with e = (p − q)/q.
    let e = (p - q).over(q);
    let x = e * (e + S::lit(2.0));
    let small = x.unsigned().below(S::lit(NEAR));
    let held = S::select(small, x, S::zero());
    // With y = x/(2 + x), x = 2y/(1 − y): x − 2 atanh y = 2y²/(1 − y) − 2y (atanh(y)/y − 1).
    let y = held.over(held + S::lit(2.0));
    let near = (y * y).over(S::one() - y) - y * atanh_series(y * y);
    let ratio = p.over(q);
    let ratio = S::select(small, S::one(), ratio);
    let log = ratio.ln();
    let far = x - (log + log);
    S::select(small, near + near, far)
}

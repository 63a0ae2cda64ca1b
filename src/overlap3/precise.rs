//! Differences and products that keep the digits that long thin boxes need.
use crate::shape::Rotation3;
use crate::{Scalar, twofold};

/// Beyond this many units (of which the smaller box has about one) between the centres in any
/// coordinate, only the fact that the boxes are apart matters.
const FAR: f64 = (1_u64 << 44) as f64;

pub(super) type Quaternion<S> = [S; 4];

#[inline(always)]
pub(super) fn product<S: Scalar>(a: Quaternion<S>, b: Quaternion<S>) -> Quaternion<S> {
    [
        (a[0] * b[0] - a[1] * b[1]) - (a[2] * b[2] + a[3] * b[3]),
        (a[0] * b[1] + a[1] * b[0]) + (a[2] * b[3] - a[3] * b[2]),
        (a[0] * b[2] + a[2] * b[0]) + (a[3] * b[1] - a[1] * b[3]),
        (a[0] * b[3] + a[3] * b[0]) + (a[1] * b[2] - a[2] * b[1]),
    ]
}
#[inline(always)]
fn conjugate<S: Scalar>([w, x, y, z]: Quaternion<S>) -> Quaternion<S> {
    [w, -x, -y, -z]
}
#[inline(always)]
pub(super) fn sum<S: Scalar>(a: Quaternion<S>, b: Quaternion<S>) -> Quaternion<S> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

/// Returns a number of `[−1, 1]` as a multiple of 2⁻¹² and the rest. Sums of products of such multiples that
/// stay within `[−1, 1]` are exact in 24 bits.
#[inline(always)]
fn split<S: Scalar>(x: S) -> (S, S) {
    // Numbers from 2048 to 4096 have steps of 2⁻¹².
    let shift = S::Primal::lit(3072.0);
    let high = S::from_primal((x.primal() + shift) - shift);
    (high, x - high)
}
#[inline(always)]
fn split_all<S: Scalar>(q: Quaternion<S>) -> (Quaternion<S>, Quaternion<S>) {
    let [w, x, y, z] = [split(q[0]), split(q[1]), split(q[2]), split(q[3])];
    ([w.0, x.0, y.0, z.0], [w.1, x.1, y.1, z.1])
}

/// Returns the power of two that brings the largest of some numbers into `[¼, ½)`; one for zeros.
#[inline(always)]
fn to_half<S: Scalar>(largest: S::Primal) -> S {
    let zero = largest.at_most(S::Primal::zero());
    let one = S::Primal::one();
    let scale = S::Primal::select(zero, one, largest).binade() * S::Primal::lit(0.125);
    S::from_primal(S::Primal::select(zero, one, scale))
}
#[inline(always)]
fn largest<S: Scalar>(x: S, y: S, z: S) -> S::Primal {
    let (x, y, z) = (x.primal(), y.primal(), z.primal());
    x.magnitude().most(y.magnitude()).most(z.magnitude())
}

/// Returns a quaternion of length at most one, whose products stay far from over- and underflow; no rotation
/// for zero.
#[inline(always)]
pub(super) fn bounded<S: Scalar>(q: Rotation3<S>) -> Quaternion<S> {
    let size = largest(q.x, q.y, q.z).most(q.w.primal().magnitude());
    let scale = to_half::<S>(size);
    let zero = size.at_most(S::Primal::zero());
    let w = S::select(zero, S::lit(0.25), q.w * scale);
    let none = S::zero();
    [
        w,
        S::select(zero, none, q.x * scale),
        S::select(zero, none, q.y * scale),
        S::select(zero, none, q.z * scale),
    ]
}

/// Returns a quaternion times a power of two that brings its largest number into `[¼, ½)` (less for one below the
/// smallest normal number), and that power.
#[inline(always)]
pub(crate) fn to_about_half<S: Scalar>(q: Rotation3<S>) -> (Rotation3<S>, S) {
    let scale = to_half(largest(q.x, q.y, q.z).most(q.w.primal().magnitude()));
    let q = Rotation3::new(q.w * scale, q.x * scale, q.y * scale, q.z * scale);
    (q, scale)
}

/// Returns the rotation from a to b, of any length. With products that carry low parts it is right to about 2⁻³⁵ even
/// where they cancel, which long thin boxes need. `cube` is one of the 24 rotations of the cube, with zeros and ones.
#[inline(always)]
pub(super) fn relative<S: Scalar>(
    a: Quaternion<S>,
    b: Quaternion<S>,
) -> (Quaternion<S>, Option<Quaternion<S>>) {
    let back = conjugate(a);
    if S::format().is_compensated() {
        let ((a_high, a_low), (b_high, b_low)) = (split_all(back), split_all(b));
        let low = sum(product(a_high, b_low), product(a_low, b));
        (product(a_high, b_high), Some(low))
    } else {
        (product(back, b), None)
    }
}

/// Returns the matrix of a quaternion of any length. Small parts of it keep their digits where x, y and z are
/// small.
#[inline(always)]
pub(super) fn matrix<S: Scalar>([w, x, y, z]: Quaternion<S>) -> [[S; 3]; 3] {
    let norm = (w * w + x * x) + (y * y + z * z);
    let two = S::lit(2.0).over(norm);
    let one = S::one();
    let (x2, y2, z2) = (x * two, y * two, z * two);
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, xz, yz) = (x * y2, x * z2, y * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    [
        [one - (yy + zz), xy - wz, xz + wy],
        [xy + wz, one - (xx + zz), yz - wx],
        [xz - wy, yz + wx, one - (xx + yy)],
    ]
}

/// Returns `b − a` in units of `1 / scale`, clamped to the distance that matters, and its rounding error (a constant;
/// zero where products carry no low part).
#[inline(always)]
pub(super) fn difference<S: Scalar>(a: S, b: S, scale: S) -> (S, S) {
    let rounded = b - a;
    let mut lost = S::Primal::zero();
    if S::format().is_compensated() {
        lost = twofold::lost(b.primal(), a.primal(), rounded.primal());
    }
    let (x, far) = (rounded * scale, S::lit(FAR));
    let near = x.unsigned().at_most(far);
    let x = S::select(near, x, S::select(x.below(S::zero()), -far, far));
    let lost = S::from_primal(lost) * scale;
    (x, S::select(near, lost, S::zero()))
}

/// A number in two parts: exact, and small.
type HighLow<S> = (S, S);

// Functions, not closures: those do not inherit instruction sets.
#[inline(always)]
fn add<S: Scalar>(a: HighLow<S>, b: HighLow<S>) -> HighLow<S> {
    (a.0 + b.0, a.1 + b.1)
}
#[inline(always)]
fn less<S: Scalar>(a: HighLow<S>, b: HighLow<S>) -> HighLow<S> {
    (a.0 - b.0, a.1 - b.1)
}
/// Returns the square of a number, given with its high part and the rest.
#[inline(always)]
fn square<S: Scalar>(x: S, (high, low): HighLow<S>) -> HighLow<S> {
    (high * high, low * (high + x))
}
/// Returns twice the product of two numbers.
#[inline(always)]
fn twice<S: Scalar>(a: HighLow<S>, y: S, b: HighLow<S>) -> HighLow<S> {
    let rest = a.0 * b.1 + a.1 * y;
    (S::lit(2.0) * (a.0 * b.0), rest + rest)
}
/// Returns the product of a column and a vector, whose parts are given, too.
#[inline(always)]
fn along<S: Scalar>(column: [HighLow<S>; 3], v: [S; 3], v_parts: [HighLow<S>; 3], unit: S) -> S {
    let (mut exact, mut rest) = (S::zero(), S::zero());
    for i in 0..3 {
        let (high, middle) = split(column[i].0);
        exact += high * v_parts[i].0;
        rest += high * v_parts[i].1 + (middle + column[i].1) * v[i];
    }
    (exact + rest).over(unit)
}

/// Returns a vector in the frame of a rotation. For a scalar with 24 bits it is right to about 2⁻³⁵ of its length.
#[inline(always)]
pub(super) fn into_frame<S: Scalar>(q: Quaternion<S>, v: [S; 3], lost: [S; 3]) -> [S; 3] {
    if !S::format().is_compensated() {
        let m = matrix(q);
        return [
            (m[0][0] * v[0] + m[1][0] * v[1]) + m[2][0] * v[2],
            (m[0][1] * v[0] + m[1][1] * v[1]) + m[2][1] * v[2],
            (m[0][2] * v[0] + m[1][2] * v[1]) + m[2][2] * v[2],
        ];
    }
    // The matrix times the squared length, as an exact part and a small one.
    let [w, x, y, z] = [split(q[0]), split(q[1]), split(q[2]), split(q[3])];
    let (ww, xx) = (square(q[0], w), square(q[1], x));
    let (yy, zz) = (square(q[2], y), square(q[3], z));
    let (wx, wy, wz) = (twice(w, q[1], x), twice(w, q[2], y), twice(w, q[3], z));
    let (xy, xz, yz) = (twice(x, q[2], y), twice(x, q[3], z), twice(y, q[3], z));
    let columns = [
        [add(less(ww, yy), less(xx, zz)), add(xy, wz), less(xz, wy)],
        [less(xy, wz), add(less(ww, xx), less(yy, zz)), add(yz, wx)],
        [add(xz, wy), less(yz, wx), add(less(ww, xx), less(zz, yy))],
    ];
    let scale = to_half::<S>(largest(v[0], v[1], v[2]));
    let v = [v[0] * scale, v[1] * scale, v[2] * scale];
    let mut v_parts = [split(v[0]), split(v[1]), split(v[2])];
    for i in 0..3 {
        v_parts[i].1 += lost[i] * scale;
    }
    let norm = ((ww.0 + xx.0) + (yy.0 + zz.0)) + ((ww.1 + xx.1) + (yy.1 + zz.1));
    let unit = scale * norm;
    [
        along(columns[0], v, v_parts, unit),
        along(columns[1], v, v_parts, unit),
        along(columns[2], v, v_parts, unit),
    ]
}

//! One box of any orientation seen from another: what their overlap is computed from.
use crate::shape::{Obb3, Rotation3};
use crate::{Scalar, Vec3};

/// The larger box of a pair may be 2³⁸ times as large as the smaller one: its volume fits an `f32`.
const LARGEST_INVERSE: f64 = 1.0 / (1_u64 << 38) as f64;

/// Beyond this many units (of which the smaller box has about one) between the centres in any
/// coordinate, only the fact that the boxes are apart matters.
const FAR: f64 = (1_u64 << 44) as f64;

/// Box b seen from box a, in units of `1 / scale`.
#[derive(Clone, Copy, Debug)]
pub struct Relative3<S: Scalar> {
    /// The rotation: `turn[i][m]` is coordinate i, in a's frame, of b's axis m. The axes of b are
    /// renamed so that the rotation is as small as it can be: no entry of the diagonal is below 0.457,
    /// the cosine of the largest such rotation, 62.8 degrees.
    pub turn: [[S; 3]; 3],
    /// The centre of b in a's frame.
    pub center: [S; 3],
    /// Half the size of a.
    pub half_a: [S; 3],
    /// Half the size of b, along the renamed axes.
    pub half_b: [S; 3],
    /// How b's axes were renamed.
    pub renamed: Renaming<S>,
    /// The power of two by which lengths were multiplied.
    pub scale: S,
    /// Where both boxes are the same set of points.
    pub same: S::Mask,
}

/// Which of a box's axes took which name.
#[derive(Clone, Copy, Debug)]
pub struct Renaming<S: Scalar> {
    /// The axes were exchanged in pairs: y and z, z and x, x and y.
    exchanged: [S::Mask; 3],
    /// Axis 0 is what was axis 1, axis 1 was 2, axis 2 was 0.
    forward: S::Mask,
    /// Axis 0 is what was axis 2, axis 1 was 0, axis 2 was 1.
    backward: S::Mask,
}

impl<S: Scalar> Renaming<S> {
    /// Numbers that belong to the axes, under the new names.
    #[inline(always)]
    pub fn rename(&self, [x, y, z]: [S; 3]) -> [S; 3] {
        self.pick([x, y, z], [y, z, x], [z, x, y])
    }
    /// The same numbers under the old names.
    #[inline(always)]
    pub fn restore(&self, [x, y, z]: [S; 3]) -> [S; 3] {
        self.pick([x, y, z], [z, x, y], [y, z, x])
    }
    #[inline(always)]
    fn pick(&self, v: [S; 3], forward: [S; 3], backward: [S; 3]) -> [S; 3] {
        let [yz, zx, xy] = self.exchanged;
        let turned = [
            S::select(self.forward, forward[0], v[0]),
            S::select(self.forward, forward[1], v[1]),
            S::select(self.forward, forward[2], v[2]),
        ];
        let turned = [
            S::select(self.backward, backward[0], turned[0]),
            S::select(self.backward, backward[1], turned[1]),
            S::select(self.backward, backward[2], turned[2]),
        ];
        [
            S::select(zx, v[2], S::select(xy, v[1], turned[0])),
            S::select(yz, v[2], S::select(xy, v[0], turned[1])),
            S::select(yz, v[1], S::select(zx, v[0], turned[2])),
        ]
    }
}

type Quaternion<S> = [S; 4];

#[inline(always)]
fn product<S: Scalar>(a: Quaternion<S>, b: Quaternion<S>) -> Quaternion<S> {
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
fn sum<S: Scalar>(a: Quaternion<S>, b: Quaternion<S>) -> Quaternion<S> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

/// A number of `[−1, 1]` as a multiple of 2⁻¹² and the rest. Sums of products of such multiples that
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

/// The power of two that brings the largest of some numbers into `[¼, ½)`; one for zeros.
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

/// A quaternion of length at most one, whose products stay far from over- and underflow; no rotation
/// for zero.
#[inline(always)]
fn bounded<S: Scalar>(q: Rotation3<S>) -> Quaternion<S> {
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

/// The rotation from a to b, of any length. Where products carry low parts it is right to about 2⁻³⁵
/// even where they cancel, which long thin boxes need; `cube` is one of the 24 rotations of the cube,
/// made of zeros and ones.
#[inline(always)]
fn relative<S: Scalar>(
    a: Quaternion<S>,
    b: Quaternion<S>,
) -> (Quaternion<S>, Option<Quaternion<S>>) {
    let back = conjugate(a);
    if S::COMPENSATED {
        let ((a_high, a_low), (b_high, b_low)) = (split_all(back), split_all(b));
        let low = sum(product(a_high, b_low), product(a_low, b));
        (product(a_high, b_high), Some(low))
    } else {
        (product(back, b), None)
    }
}

/// The rotation of the cube by which b's axes are renamed, as zeros and ones with signs, and the
/// renaming.
///
/// After it the real part is the largest that is possible: one number of the quaternion alone (a half
/// turn about an axis, no axis renamed), two of them by √½ (two axes exchanged), or the mean of all four
/// (all three axes renamed in a circle).
#[inline(always)]
fn smallest_turn<S: Scalar>(q: Quaternion<S>) -> (Quaternion<S>, Renaming<S>) {
    let (zero, one) = (S::Primal::zero(), S::Primal::one());
    let p = [
        q[0].primal(),
        q[1].primal(),
        q[2].primal(),
        q[3].primal(),
    ];
    let size = [
        p[0].magnitude(),
        p[1].magnitude(),
        p[2].magnitude(),
        p[3].magnitude(),
    ];
    let (mut best, mut kind) = (size[0], zero);
    let mut used = [one, zero, zero, zero];
    let root = S::Primal::lit(std::f64::consts::FRAC_1_SQRT_2);
    // Which of the four numbers take part, and which axes are exchanged.
    const CANDIDATES: [([usize; 4], usize); 10] = [
        ([0, 1, 0, 0], 0),
        ([0, 0, 1, 0], 0),
        ([0, 0, 0, 1], 0),
        ([1, 1, 0, 0], 1),
        ([0, 0, 1, 1], 1),
        ([1, 0, 1, 0], 2),
        ([0, 1, 0, 1], 2),
        ([1, 0, 0, 1], 3),
        ([0, 1, 1, 0], 3),
        ([1, 1, 1, 1], 4),
    ];
    for (part, renamed) in CANDIDATES {
        let mut score = zero;
        for i in 0..4 {
            if part[i] == 1 {
                score += size[i];
            }
        }
        let score = match renamed {
            0 => score,
            4 => score.halved(),
            _ => score * root,
        };
        let better = score.above(best);
        best = S::Primal::select(better, score, best);
        kind = S::Primal::select(better, S::Primal::lit(renamed as f64), kind);
        for i in 0..4 {
            let takes = S::Primal::lit(part[i] as f64);
            used[i] = S::Primal::select(better, takes, used[i]);
        }
    }
    let sign = [
        one.signed_as(p[0]),
        one.signed_as(p[1]),
        one.signed_as(p[2]),
        one.signed_as(p[3]),
    ];
    let cube = [
        S::from_primal(used[0] * sign[0]),
        S::from_primal(-(used[1] * sign[1])),
        S::from_primal(-(used[2] * sign[2])),
        S::from_primal(-(used[3] * sign[3])),
    ];
    let handed = (sign[0] * sign[1]) * (sign[2] * sign[3]);
    let circle = kind.equals(S::Primal::lit(4.0));
    let is = |k: f64| kind.equals(S::Primal::lit(k));
    let renaming = Renaming {
        exchanged: [is(1.0), is(2.0), is(3.0)],
        forward: circle & handed.below(zero),
        backward: circle & handed.above(zero),
    };
    (cube, renaming)
}

/// The matrix of a quaternion of any length. Small parts of it keep their digits where x, y and z are
/// small.
#[inline(always)]
fn matrix<S: Scalar>([w, x, y, z]: Quaternion<S>) -> [[S; 3]; 3] {
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

/// `b − a` in units of `1 / scale`, no farther than it matters, and what rounding took away (a
/// constant; zero where products carry no low part).
#[inline(always)]
fn difference<S: Scalar>(a: S, b: S, scale: S) -> (S, S) {
    let rounded = b - a;
    let mut lost = S::Primal::zero();
    if S::COMPENSATED {
        // The exact error of a difference (Knuth, The Art of Computer Programming 2, 4.2.2).
        let (a, b, rounded) = (a.primal(), b.primal(), rounded.primal());
        let taken = rounded - b;
        lost = (b - (rounded - taken)) - (a + taken);
    }
    let (x, far) = (rounded * scale, S::lit(FAR));
    let near = x.unsigned().at_most(far);
    let x = S::select(near, x, S::select(x.below(S::zero()), -far, far));
    let lost = S::from_primal(lost) * scale;
    (x, S::select(near, lost, S::zero()))
}

/// A vector in the frame of a rotation. Where the scalar has 24 bits it is right to about 2⁻³⁵ of its
/// length.
#[inline(always)]
fn into_frame<S: Scalar>(q: Quaternion<S>, v: [S; 3], lost: [S; 3]) -> [S; 3] {
    if !S::COMPENSATED {
        let m = matrix(q);
        let along = |i: usize| (m[0][i] * v[0] + m[1][i] * v[1]) + m[2][i] * v[2];
        return [along(0), along(1), along(2)];
    }
    // The matrix times the squared length, as an exact part and a small one.
    let (high, low) = split_all(q);
    let square = |i: usize| (high[i] * high[i], low[i] * (high[i] + q[i]));
    let twice = |i: usize, j: usize| {
        let rest = high[i] * low[j] + low[i] * q[j];
        (S::lit(2.0) * (high[i] * high[j]), rest + rest)
    };
    let (ww, xx, yy, zz) = (square(0), square(1), square(2), square(3));
    let (wx, wy, wz) = (twice(0, 1), twice(0, 2), twice(0, 3));
    let (xy, xz, yz) = (twice(1, 2), twice(1, 3), twice(2, 3));
    let add = |a: (S, S), b: (S, S)| (a.0 + b.0, a.1 + b.1);
    let less = |a: (S, S), b: (S, S)| (a.0 - b.0, a.1 - b.1);
    let columns = [
        [add(less(ww, yy), less(xx, zz)), add(xy, wz), less(xz, wy)],
        [less(xy, wz), add(less(ww, xx), less(yy, zz)), add(yz, wx)],
        [add(xz, wy), less(yz, wx), add(less(ww, xx), less(zz, yy))],
    ];
    let scale = to_half::<S>(largest(v[0], v[1], v[2]));
    let parts = |i: usize| {
        let (high, low) = split(v[i] * scale);
        (high, low + lost[i] * scale)
    };
    let v_parts = [parts(0), parts(1), parts(2)];
    let norm = ((ww.0 + xx.0) + (yy.0 + zz.0)) + ((ww.1 + xx.1) + (yy.1 + zz.1));
    let unit = scale * norm;
    let along = |column: [(S, S); 3]| {
        let (mut exact, mut rest) = (S::zero(), S::zero());
        for i in 0..3 {
            let (high, middle) = split(column[i].0);
            exact += high * v_parts[i].0;
            rest += high * v_parts[i].1 + (middle + column[i].1) * (v[i] * scale);
        }
        (exact + rest).over(unit)
    };
    [along(columns[0]), along(columns[1]), along(columns[2])]
}

/// The power of two by which a pair of boxes is multiplied so that no volume over- or underflows: it
/// brings the largest side of the smaller box near one, unless that is zero or the other box would
/// become too large.
#[inline(always)]
pub fn size_scale3<S: Scalar>(half_a: Vec3<S>, half_b: Vec3<S>) -> S {
    let size_a = half_a.x.most(half_a.y).most(half_a.z);
    let size_b = half_b.x.most(half_b.y).most(half_b.z);
    let (smaller, larger) = (size_a.least(size_b), size_a.most(size_b));
    let bounded = smaller.most(larger * S::lit(LARGEST_INVERSE));
    let size = S::select(smaller.at_most(S::zero()), larger, bounded);
    let zero = size.at_most(S::zero());
    S::select(zero, S::one(), S::select(zero, S::one(), size).binade())
}

/// Sees `b` from `a`.
#[inline(always)]
pub fn relate3<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> Relative3<S> {
    let half = S::lit(0.5);
    let (half_a, half_b) = (a.size * half, b.size * half);
    let scale = size_scale3(half_a, half_b);
    let (half_a, half_b) = (half_a * scale, half_b * scale);
    let (dx, lost_x) = difference(a.center.x, b.center.x, scale);
    let (dy, lost_y) = difference(a.center.y, b.center.y, scale);
    let (dz, lost_z) = difference(a.center.z, b.center.z, scale);
    let (from, to) = (bounded(a.rotation), bounded(b.rotation));
    let center = into_frame(from, [dx, dy, dz], [lost_x, lost_y, lost_z]);

    let (high, low) = relative(from, to);
    let whole = match low {
        Some(low) => sum(high, low),
        None => high,
    };
    let (cube, renamed) = smallest_turn(whole);
    let turned = match low {
        Some(low) => sum(product(high, cube), product(low, cube)),
        None => product(high, cube),
    };
    // Nothing but rounding is left of an angle below this one.
    let [w, x, y, z] = turned;
    let flat = w.unsigned() * S::lit(S::PARALLEL);
    let level = |x: S| {
        let nothing = x.unsigned().below(flat);
        S::select(nothing, x.with_primal(S::Primal::zero()), x)
    };
    let (x, y, z) = (level(x), level(y), level(z));
    let half_a = [half_a.x, half_a.y, half_a.z];
    let half_b = renamed.rename([half_b.x, half_b.y, half_b.z]);
    let none = S::zero();
    let still = (x.equals(none) & y.equals(none) & z.equals(none))
        & (center[0].equals(none) & center[1].equals(none) & center[2].equals(none));
    let same = still
        & (half_a[0].equals(half_b[0]) & half_a[1].equals(half_b[1]) & half_a[2].equals(half_b[2]));
    Relative3 {
        turn: matrix([w, x, y, z]),
        center,
        half_a,
        half_b,
        renamed,
        scale,
        same,
    }
}

//! Other names for a box's axes, so that the rotation between two boxes is small.
use super::precise::Quaternion;
use crate::Scalar;

/// A renaming of a box's axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Renaming<S: Scalar> {
    /// The axes were exchanged in pairs: y and z, z and x, x and y.
    exchanged: [S::Mask; 3],
    /// The new axes 0, 1 and 2 are the old axes 1, 2 and 0.
    forward: S::Mask,
    /// The new axes 0, 1 and 2 are the old axes 2, 0 and 1.
    backward: S::Mask,
}

impl<S: Scalar> Renaming<S> {
    /// Returns numbers of the old axes in the order of the new ones.
    #[inline(always)]
    pub fn rename(&self, [x, y, z]: [S; 3]) -> [S; 3] {
        self.pick([x, y, z], [y, z, x], [z, x, y])
    }
    /// Returns numbers of the new axes in the order of the old ones.
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

/// The best rotation of the cube so far.
struct BestRotation<P> {
    /// The real part that it leaves.
    score: P,
    /// The axes that are exchanged: none, y and z, z and x, x and y, or all three cyclically.
    kind: P,
    /// Ones for the numbers of the quaternion that take part.
    used: [P; 4],
}

impl<P: Scalar> BestRotation<P> {
    /// Keeps the better of this rotation and another one. `PARTS` has ones for the numbers of the quaternion that take
    /// part, the lowest bit for the first.
    #[inline(always)]
    fn or<const PARTS: usize, const KIND: usize>(&mut self, size: [P; 4]) {
        let mut score = P::zero();
        for i in 0..4 {
            if PARTS >> i & 1 == 1 {
                score += size[i];
            }
        }
        let score = match KIND {
            0 => score,
            4 => score.halved(),
            _ => score * P::lit(std::f64::consts::FRAC_1_SQRT_2),
        };
        let better = score.above(self.score);
        self.score = P::select(better, score, self.score);
        self.kind = P::select(better, P::lit(KIND as f64), self.kind);
        for i in 0..4 {
            let takes = P::lit((PARTS >> i & 1) as f64);
            self.used[i] = P::select(better, takes, self.used[i]);
        }
    }
}

/// Returns the rotation of the cube by which b's axes are renamed, as zeros and ones with signs, and the
/// renaming.
///
/// After it the real part is the largest possible. It is one number of the quaternion alone (a half turn about an axis,
/// no axis renamed), two of them by √½ (two axes exchanged), or the mean of all four (all three axes renamed
/// cyclically).
#[inline(always)]
pub(super) fn smallest_turn<S: Scalar>(q: Quaternion<S>) -> (Quaternion<S>, Renaming<S>) {
    let (zero, one) = (S::Primal::zero(), S::Primal::one());
    let p = [q[0].primal(), q[1].primal(), q[2].primal(), q[3].primal()];
    let size = [
        p[0].magnitude(),
        p[1].magnitude(),
        p[2].magnitude(),
        p[3].magnitude(),
    ];
    let mut best = BestRotation {
        score: size[0],
        kind: zero,
        used: [one, zero, zero, zero],
    };
    // Not a loop: which numbers take part is known to the compiler, then.
    best.or::<0b0010, 0>(size);
    best.or::<0b0100, 0>(size);
    best.or::<0b1000, 0>(size);
    best.or::<0b0011, 1>(size);
    best.or::<0b1100, 1>(size);
    best.or::<0b0101, 2>(size);
    best.or::<0b1010, 2>(size);
    best.or::<0b1001, 3>(size);
    best.or::<0b0110, 3>(size);
    best.or::<0b1111, 4>(size);
    let BestRotation { kind, used, .. } = best;
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
    let renaming = Renaming {
        exchanged: [
            kind.equals(S::Primal::lit(1.0)),
            kind.equals(S::Primal::lit(2.0)),
            kind.equals(S::Primal::lit(3.0)),
        ],
        forward: circle & handed.below(zero),
        backward: circle & handed.above(zero),
    };
    (cube, renaming)
}

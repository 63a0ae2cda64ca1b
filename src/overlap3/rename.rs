//! Other names for a box's axes, so that the rotation between two boxes is small.
use super::precise::Quaternion;
use crate::Scalar;

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

/// The rotation of the cube by which b's axes are renamed, as zeros and ones with signs, and the
/// renaming.
///
/// After it the real part is the largest that is possible: one number of the quaternion alone (a half
/// turn about an axis, no axis renamed), two of them by √½ (two axes exchanged), or the mean of all four
/// (all three axes renamed in a circle).
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

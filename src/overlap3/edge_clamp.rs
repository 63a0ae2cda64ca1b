//! One edge of a box and where another box clamps it.
use super::relate::Relative3;
use crate::Scalar;

/// Returns the nearest number of `[low, high]`.
#[inline(always)]
pub(super) fn clamped<S: Scalar>(x: S, low: S, high: S) -> S {
    x.most(low).least(high)
}

/// Returns a number without derivatives where a mask is true.
#[inline(always)]
pub(super) fn fixed<S: Scalar>(mask: S::Mask, x: S) -> S {
    S::select(mask, S::from_primal(x.primal()), x)
}

/// Returns the limit below which an entry of the rotation counts as zero: powers of its reciprocal must not overflow.
#[inline(always)]
pub(super) fn tiny<S: Scalar>() -> f64 {
    if S::format().is_compensated() {
        S::format().parallel()
    } else {
        S::format().parallel() * S::format().parallel()
    }
}

/// Both boxes relative to a point near both, so that rounding is a common shift of all of it, which thin
/// boxes need.
///
/// The steps along all three axes are alike. So they are written once, for an edge along axis 0 and a face across axis
/// 2. The axes of both boxes take turns ([`turn`](Cut::turn)). Kernels then have a loop of three rounds in which every
/// index is a constant.
#[derive(Clone, Copy)]
pub(super) struct Cut<S: Scalar> {
    /// Entries of the rotation.
    pub r: [[S; 3]; 3],
    /// Their reciprocals. The sign of these, always, decides if a coordinate rises or falls.
    pub rho: [[S; 3]; 3],
    /// `true` where an entry counts as zero, off the diagonal.
    pub flat: [[S::Mask; 3]; 3],
    /// The number added to a crossing there: the middle of the edge, so that ties are halves.
    pub middle: [[S; 3]; 3],
    /// Bounds of a.
    pub k: [[S; 2]; 3],
    /// Bounds of b along its own axes.
    pub f: [[S; 2]; 3],
}

impl<S: Scalar> Cut<S> {
    /// Renames the axes of both boxes: 1 becomes 0, 2 becomes 1, 0 becomes 2. In place, since a copy of the struct
    /// would be a call.
    #[inline(always)]
    pub(super) fn turn(&mut self) {
        turn_both(&mut self.r);
        turn_both(&mut self.rho);
        turn_both(&mut self.flat);
        turn_both(&mut self.middle);
        turn_pairs(&mut self.k);
        turn_pairs(&mut self.f);
    }
}

/// Moves entry 1 to 0, entry 2 to 1, and entry 0 to 2.
#[inline(always)]
pub(super) fn turn<X: Copy>(x: &mut [X; 3]) {
    [x[0], x[1], x[2]] = [x[1], x[2], x[0]];
}

/// Moves rows and columns 1 to 0, 2 to 1, and 0 to 2.
#[inline(always)]
fn turn_both<X: Copy>(x: &mut [[X; 3]; 3]) {
    [x[0][0], x[1][1], x[2][2]] = [x[1][1], x[2][2], x[0][0]];
    [x[0][1], x[1][2], x[2][0]] = [x[1][2], x[2][0], x[0][1]];
    [x[0][2], x[1][0], x[2][1]] = [x[1][0], x[2][1], x[0][2]];
}

#[inline(always)]
fn turn_pairs<X: Copy>(x: &mut [[X; 2]; 3]) {
    [x[0][0], x[1][0], x[2][0]] = [x[1][0], x[2][0], x[0][0]];
    [x[0][1], x[1][1], x[2][1]] = [x[1][1], x[2][1], x[0][1]];
}

/// One edge of b: the points `start + t axis`. Its coordinate n is that of a's axis n places after the one
/// that the edge follows.
#[derive(Clone, Copy)]
pub(super) struct Edge<S> {
    /// The point at which t is zero, in a's frame.
    pub start: [S; 3],
    /// The t where a coordinate is at its lower and upper bound.
    pub at: [[S; 2]; 3],
    /// The t where a coordinate comes into bounds; for the edge's main direction no less than its start.
    pub enter: [S; 3],
    /// The t where it leaves them; for the edge's main direction no more than its end.
    pub leave: [S; 3],
}

/// Derivatives by the bounds of a.
#[derive(Clone, Copy)]
pub(super) struct BoundDerivatives<S> {
    /// By the upper bounds.
    pub high: [S; 3],
    /// By the lower bounds.
    pub low: [S; 3],
}

impl<S: Scalar> BoundDerivatives<S> {
    /// Moves the numbers of axis 1 to 0, 2 to 1, and 0 to 2, as [`Cut::turn`] does.
    #[inline(always)]
    pub(super) fn turn(&mut self) {
        turn(&mut self.high);
        turn(&mut self.low);
    }
}

/// Returns `sum − sign · x`, where the sign is positive for equal sides.
#[inline(always)]
pub(super) fn less_signed<S: Scalar>(sum: S, a: usize, b: usize, x: S) -> S {
    if a == b { sum - x } else { sum + x }
}

/// Returns `sum + x` for an upper side, `sum − x` for a lower one.
#[inline(always)]
pub(super) fn signed<S: Scalar>(sum: S, side: usize, x: S) -> S {
    if side == 1 { sum + x } else { sum - x }
}

/// A side of b is cut off if a reaches less than this part of its half.
const REACHED: f64 = 0.125;

/// Returns the bounds of b along its own axes, without the parts of its long sides that a cannot reach. The integrals
/// over a thin long box that another one crosses would otherwise have terms 10⁴ times as large as their sum.
///
/// Between two opposite faces of a, across its axis i, `Σ R_in w_n` is within h_i of `−c_i`, so w_m is known up
/// to `(h_i + Σ_{n≠m} |R_in| p_n) / |R_im|`. The narrowest of these three ranges counts, with room for rounding.
/// Only where products carry low parts: digits are plenty elsewhere.
#[inline(always)]
fn reached<S: Scalar>(pair: &Relative3<S>, rho: &[[S; 3]; 3]) -> [[S; 2]; 3] {
    let (r, c, h, p) = (pair.turn, pair.center, pair.half_a, pair.half_b);
    let mut out = [[-p[0], p[0]], [-p[1], p[1]], [-p[2], p[2]]];
    if !S::format().is_compensated() {
        return out;
    }
    let limit = [
        p[0] * S::lit(REACHED),
        p[1] * S::lit(REACHED),
        p[2] * S::lit(REACHED),
    ];
    let (mut least, mut middle) = (limit, [S::zero(); 3]);
    for i in 0..3 {
        let steep = [r[i][0].unsigned(), r[i][1].unsigned(), r[i][2].unsigned()];
        let reach = (steep[0] * p[0] + steep[1] * p[1]) + steep[2] * p[2];
        let rounding = (h[i] + reach + c[i].unsigned()) * S::rounding(32.0, 1);
        let all = (h[i] + reach) + rounding;
        for m in 0..3 {
            let own = (all - steep[m] * p[m]) * rho[i][m].unsigned();
            let narrow = own.below(least[m]);
            least[m] = S::select(narrow, own, least[m]);
            middle[m] = S::select(narrow, -(c[i] * rho[i][m]), middle[m]);
        }
    }
    for m in 0..3 {
        let short = least[m].below(limit[m]);
        let low = clamped(middle[m] - least[m], -p[m], p[m]);
        let high = clamped(middle[m] + least[m], low, p[m]);
        // Nothing depends on where it is cut.
        let (low, high) = (S::from_primal(low.primal()), S::from_primal(high.primal()));
        out[m] = [S::select(short, low, -p[m]), S::select(short, high, p[m])];
    }
    out
}

#[inline(always)]
pub(super) fn cut<S: Scalar>(pair: &Relative3<S>) -> (Cut<S>, [S; 3]) {
    let (r, c, h) = (pair.turn, pair.center, pair.half_a);
    let zero = S::zero();
    let least = S::lit(tiny::<S>());
    let never = S::one().below(zero);
    let (mut rho, mut flat) = ([[zero; 3]; 3], [[never; 3]; 3]);
    for i in 0..3 {
        for m in 0..3 {
            let entry = r[i][m];
            if i == m {
                rho[i][m] = S::one().over(entry);
            } else {
                flat[i][m] = entry.unsigned().below(least);
                let safe = S::select(flat[i][m], least.signed_as(entry), entry);
                rho[i][m] = S::one().over(safe);
            }
        }
    }
    let reached = reached(pair, &rho);
    // Alternating projections onto both boxes.
    let (mut w, mut origin) = ([zero; 3], c);
    for m in 0..3 {
        w[m] = (reached[m][0] + reached[m][1]).halved();
    }
    for i in 0..3 {
        origin[i] = c[i] + ((r[i][0] * w[0] + r[i][1] * w[1]) + r[i][2] * w[2]);
    }
    for _ in 0..2 {
        let mut y = [zero; 3];
        for i in 0..3 {
            y[i] = clamped(origin[i], -h[i], h[i]) - c[i];
        }
        for m in 0..3 {
            let t = (r[0][m] * y[0] + r[1][m] * y[1]) + r[2][m] * y[2];
            w[m] = clamped(t, reached[m][0], reached[m][1]);
        }
        for i in 0..3 {
            origin[i] = c[i] + ((r[i][0] * w[0] + r[i][1] * w[1]) + r[i][2] * w[2]);
        }
    }
    let (mut k, mut f) = ([[zero; 2]; 3], [[zero; 2]; 3]);
    for i in 0..3 {
        k[i] = [-h[i] - origin[i], h[i] - origin[i]];
        f[i] = [reached[i][0] - w[i], reached[i][1] - w[i]];
    }
    let mut middle = [[zero; 3]; 3];
    for i in 0..3 {
        for m in 0..3 {
            if i != m {
                let half = (f[m][0] + f[m][1]).halved();
                middle[i][m] = S::select(flat[i][m], half, zero);
            }
        }
    }
    let cut = Cut {
        r,
        rho,
        flat,
        middle,
        k,
        f,
    };
    (cut, origin)
}

/// Returns the edge of b along axis `M`, on side `a` of the next axis and side `b` of the one after.
#[inline(always)]
pub(super) fn edge<S: Scalar, const PIECES: bool, const M: usize>(
    cut: &Cut<S>,
    a: usize,
    b: usize,
) -> Edge<S> {
    if PIECES {
        edge_apart::<S, M>(cut, a, b)
    } else {
        edge_here::<S, M>(cut, a, b)
    }
}

#[inline(never)]
fn edge_apart<S: Scalar, const M: usize>(cut: &Cut<S>, a: usize, b: usize) -> Edge<S> {
    edge_here::<S, M>(cut, a, b)
}

#[inline(always)]
fn edge_here<S: Scalar, const M: usize>(cut: &Cut<S>, a: usize, b: usize) -> Edge<S> {
    let (j, l) = ((M + 1) % 3, (M + 2) % 3);
    let zero = S::zero();
    let mut made = Edge {
        start: [zero; 3],
        at: [[zero; 2]; 3],
        enter: [zero; 3],
        leave: [zero; 3],
    };
    for n in 0..3 {
        let i = (M + n) % 3;
        let start = cut.f[j][a % 2] * cut.r[i][j] + cut.f[l][b % 2] * cut.r[i][l];
        let low = (cut.k[i][0] - start) * cut.rho[i][M] + cut.middle[i][M];
        let high = (cut.k[i][1] - start) * cut.rho[i][M] + cut.middle[i][M];
        // An edge that lies in a bound has the middle as crossing wherever it moves: both sides share.
        let (low, high) = match n {
            0 => (low, high),
            _ => (fixed(cut.flat[i][M], low), fixed(cut.flat[i][M], high)),
        };
        made.start[n] = start;
        made.at[n] = [low, high];
        if n == 0 {
            made.enter[n] = low.most(cut.f[M][0]);
            made.leave[n] = high.least(cut.f[M][1]);
        } else {
            made.enter[n] = low.least(high);
            made.leave[n] = low.most(high);
        }
    }
    made
}

/// Returns coordinate i of an edge along axis 0 at t, clamped to a.
#[inline(always)]
pub(super) fn coordinate<S: Scalar>(cut: &Cut<S>, edge: &Edge<S>, i: usize, t: S) -> S {
    clamped(t * cut.r[i][0] + edge.start[i], cut.k[i][0], cut.k[i][1])
}

/// Returns the integral of clamped coordinate i over `[low, high]`, where it is between its bounds from `enter`
/// to `leave`.
#[inline(always)]
fn along<S: Scalar>(cut: &Cut<S>, edge: &Edge<S>, i: usize, low: S, high: S) -> S {
    let enter = clamped(edge.enter[i], low, high);
    let leave = clamped(edge.leave[i], low, high);
    let (before, inside, after) = (enter - low, leave - enter, high - leave);
    let mean = (enter + leave).halved() * cut.r[i][0] + edge.start[i];
    let falls = cut.rho[i][0].below(S::zero());
    let above = S::select(falls, before, after);
    let below = S::select(falls, after, before);
    inside * mean + (above * cut.k[i][1] + below * cut.k[i][0])
}

/// Returns six times the integral of `X_1 X_2 dX_0` along an edge.
///
/// From the crossings of both coordinates it has at most five pieces; on the outer two both are constant,
/// on the inner ones each is linear, where `6 ∫ X Y dt = D ((X + X')(Y + Y') + X Y + X' Y')`.
#[inline(always)]
pub(super) fn edge_term<S: Scalar, const DERIVATIVE: bool, const PIECES: bool>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    sides: [usize; 2],
    bounds: &mut BoundDerivatives<S>,
) -> S {
    if PIECES {
        edge_term_apart::<S, DERIVATIVE>(cut, edge, sides, bounds)
    } else {
        edge_term_here::<S, DERIVATIVE>(cut, edge, sides, bounds)
    }
}

#[inline(never)]
fn edge_term_apart<S: Scalar, const DERIVATIVE: bool>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    sides: [usize; 2],
    bounds: &mut BoundDerivatives<S>,
) -> S {
    edge_term_here::<S, DERIVATIVE>(cut, edge, sides, bounds)
}

#[inline(always)]
fn edge_term_here<S: Scalar, const DERIVATIVE: bool>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    [a, b]: [usize; 2],
    bounds: &mut BoundDerivatives<S>,
) -> S {
    let t0 = edge.enter[0].least(cut.f[0][1]);
    let t1 = edge.leave[0].most(cut.f[0][0]);
    let (j0, j1) = (
        clamped(edge.enter[1], t0, t1),
        clamped(edge.leave[1], t0, t1),
    );
    let (l0, l1) = (
        clamped(edge.enter[2], t0, t1),
        clamped(edge.leave[2], t0, t1),
    );
    let (n1, n4) = (j0.least(l0), j1.most(l1));
    let (n2, n3) = (j0.most(l0), j1.least(l1));
    let (n2, n3) = (n2.least(n3), n2.most(n3));
    let t = [t0, n2, n3, t1];
    let (mut x, mut y) = ([t0; 4], [t0; 4]);
    for n in 0..4 {
        x[n] = coordinate(cut, edge, 1, t[n]);
        y[n] = coordinate(cut, edge, 2, t[n]);
    }
    let both = [x[0] * y[0], x[1] * y[1], x[2] * y[2], x[3] * y[3]];
    let ends = [n1, n2, n3, n4];
    let mut six = ((n1 - t0) * both[0] + (t1 - n4) * both[3]) * S::lit(6.0);
    for n in 0..3 {
        let mixed = (x[n] + x[n + 1]) * (y[n] + y[n + 1]) + (both[n] + both[n + 1]);
        six += (ends[n + 1] - ends[n]) * mixed;
    }
    if DERIVATIVE {
        // X_0 is a bound of a where the edge is beyond a along its own direction.
        let q0 = coordinate(cut, edge, 1, cut.f[0][0]) * coordinate(cut, edge, 2, cut.f[0][0]);
        let q1 = coordinate(cut, edge, 1, cut.f[0][1]) * coordinate(cut, edge, 2, cut.f[0][1]);
        bounds.high[0] = less_signed(bounds.high[0], a, b, both[3] - q1);
        bounds.low[0] = less_signed(bounds.low[0], a, b, q0 - both[0]);
        // The integral of X_2 where X_1 is a bound, and vice versa.
        clamped_part::<S, 1, 2>(cut, edge, [a, b], [t0, j0, j1, t1], bounds);
        clamped_part::<S, 2, 1>(cut, edge, [a, b], [t0, l0, l1, t1], bounds);
    }
    six * cut.r[0][0]
}

/// Adds the derivatives by the bounds of coordinate `ONE` where an edge is beyond them: the integral of coordinate
/// `OTHER`.
#[inline(always)]
fn clamped_part<S: Scalar, const ONE: usize, const OTHER: usize>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    [a, b]: [usize; 2],
    [t0, enter, leave, t1]: [S; 4],
    bounds: &mut BoundDerivatives<S>,
) {
    let before = along(cut, edge, OTHER, t0, enter) * cut.r[0][0];
    let after = along(cut, edge, OTHER, leave, t1) * cut.r[0][0];
    let falls = cut.rho[ONE][0].below(S::zero());
    let at_high = S::select(falls, before, after);
    let at_low = S::select(falls, after, before);
    // The sum over edges is taken away from the volume.
    bounds.high[ONE] = less_signed(bounds.high[ONE], a, b, at_high);
    bounds.low[ONE] = less_signed(bounds.low[ONE], a, b, at_low);
}

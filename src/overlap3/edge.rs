//! One edge of a box and where another box clamps it.
use super::relate::Relative3;
use crate::Scalar;

/// The nearest number of `[low, high]`.
#[inline(always)]
pub(super) fn clamped<S: Scalar>(x: S, low: S, high: S) -> S {
    x.most(low).least(high)
}

/// Below this an entry of the rotation counts as zero: powers of its reciprocal must not overflow.
#[inline(always)]
pub(super) fn tiny<S: Scalar>() -> f64 {
    if S::COMPENSATED {
        S::PARALLEL
    } else {
        S::PARALLEL * S::PARALLEL
    }
}

/// Both boxes relative to a point near both, so that rounding is a common shift of all of it, which thin
/// boxes need.
#[derive(Clone, Copy)]
pub(super) struct Cut<S: Scalar> {
    /// Entries of the rotation.
    pub r: [[S; 3]; 3],
    /// Their reciprocals. Whether a coordinate rises or falls is read from the sign of these, always.
    pub rho: [[S; 3]; 3],
    /// Where an entry counts as zero, off the diagonal.
    pub flat: [[S::Mask; 3]; 3],
    /// What is added to a crossing there: the middle of the edge, so that ties are halves.
    pub middle: [[S; 3]; 3],
    /// Bounds of a.
    pub k: [[S; 2]; 3],
    /// Bounds of b along its own axes.
    pub f: [[S; 2]; 3],
}

/// One edge of b: the points `start + t axis`.
#[derive(Clone, Copy)]
pub(super) struct Edge<S> {
    /// Where t is zero, in a's frame.
    pub start: [S; 3],
    /// The t where coordinate i is at its lower and upper bound.
    pub at: [[S; 2]; 3],
    /// The t where coordinate i comes into bounds; for the edge's main direction no less than its start.
    pub enter: [S; 3],
    /// The t where it leaves them; for the edge's main direction no more than its end.
    pub leave: [S; 3],
}

/// Edges by their direction and the sides of the two others.
pub(super) type Edges<S> = [[[Edge<S>; 2]; 2]; 3];

/// Slopes by the bounds of a.
#[derive(Clone, Copy)]
pub(super) struct Bounds<S> {
    /// By the upper bounds.
    pub high: [S; 3],
    /// By the lower bounds.
    pub low: [S; 3],
}

/// `sum − sign · x`, where the sign is positive for equal sides.
#[inline(always)]
pub(super) fn less_signed<S: Scalar>(sum: S, a: usize, b: usize, x: S) -> S {
    if a == b { sum - x } else { sum + x }
}

#[inline(always)]
pub(super) fn cut<S: Scalar>(pair: &Relative3<S>) -> (Cut<S>, [S; 3]) {
    let (r, c, h, p) = (pair.turn, pair.center, pair.half_a, pair.half_b);
    let zero = S::zero();
    // Alternating projections onto both boxes.
    let (mut w, mut origin) = ([zero; 3], c);
    for _ in 0..2 {
        let mut y = [zero; 3];
        for i in 0..3 {
            y[i] = clamped(origin[i], -h[i], h[i]) - c[i];
        }
        for m in 0..3 {
            let t = (r[0][m] * y[0] + r[1][m] * y[1]) + r[2][m] * y[2];
            w[m] = clamped(t, -p[m], p[m]);
        }
        for i in 0..3 {
            origin[i] = c[i] + ((r[i][0] * w[0] + r[i][1] * w[1]) + r[i][2] * w[2]);
        }
    }
    let (mut k, mut f) = ([[zero; 2]; 3], [[zero; 2]; 3]);
    for i in 0..3 {
        k[i] = [-h[i] - origin[i], h[i] - origin[i]];
        f[i] = [-p[i] - w[i], p[i] - w[i]];
    }
    let least = S::lit(tiny::<S>());
    let never = S::one().below(zero);
    let (mut rho, mut middle, mut flat) = ([[zero; 3]; 3], [[zero; 3]; 3], [[never; 3]; 3]);
    for i in 0..3 {
        for m in 0..3 {
            let entry = r[i][m];
            if i == m {
                rho[i][m] = S::one().over(entry);
            } else {
                flat[i][m] = entry.unsigned().below(least);
                let safe = S::select(flat[i][m], least.signed_as(entry), entry);
                rho[i][m] = S::one().over(safe);
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

#[inline(always)]
pub(super) fn edge<S: Scalar, const PIECES: bool>(
    cut: &Cut<S>,
    m: usize,
    a: usize,
    b: usize,
) -> Edge<S> {
    if PIECES {
        edge_apart(cut, m, a, b)
    } else {
        edge_here(cut, m, a, b)
    }
}

#[inline(never)]
fn edge_apart<S: Scalar>(cut: &Cut<S>, m: usize, a: usize, b: usize) -> Edge<S> {
    edge_here(cut, m, a, b)
}

#[inline(always)]
fn edge_here<S: Scalar>(cut: &Cut<S>, m: usize, a: usize, b: usize) -> Edge<S> {
    let (j, l) = ((m + 1) % 3, (m + 2) % 3);
    let zero = S::zero();
    let mut made = Edge {
        start: [zero; 3],
        at: [[zero; 2]; 3],
        enter: [zero; 3],
        leave: [zero; 3],
    };
    for i in 0..3 {
        let start = cut.f[j][a] * cut.r[i][j] + cut.f[l][b] * cut.r[i][l];
        let low = (cut.k[i][0] - start) * cut.rho[i][m] + cut.middle[i][m];
        let high = (cut.k[i][1] - start) * cut.rho[i][m] + cut.middle[i][m];
        made.start[i] = start;
        made.at[i] = [low, high];
        if i == m {
            made.enter[i] = low.most(cut.f[m][0]);
            made.leave[i] = high.least(cut.f[m][1]);
        } else {
            made.enter[i] = low.least(high);
            made.leave[i] = low.most(high);
        }
    }
    made
}

/// Coordinate i at t, clamped to a.
#[inline(always)]
pub(super) fn coordinate<S: Scalar>(cut: &Cut<S>, edge: &Edge<S>, m: usize, i: usize, t: S) -> S {
    clamped(t * cut.r[i][m] + edge.start[i], cut.k[i][0], cut.k[i][1])
}

/// The integral of clamped coordinate i over `[low, high]`, where it is between its bounds from `enter`
/// to `leave`.
#[inline(always)]
fn along<S: Scalar>(cut: &Cut<S>, edge: &Edge<S>, m: usize, i: usize, low: S, high: S) -> S {
    let enter = clamped(edge.enter[i], low, high);
    let leave = clamped(edge.leave[i], low, high);
    let (before, inside, after) = (enter - low, leave - enter, high - leave);
    let mean = (enter + leave).halved() * cut.r[i][m] + edge.start[i];
    let falls = cut.rho[i][m].below(S::zero());
    let above = S::select(falls, before, after);
    let below = S::select(falls, after, before);
    inside * mean + (above * cut.k[i][1] + below * cut.k[i][0])
}

/// Six times the integral of `X_j X_l dX_m` along an edge.
///
/// From the crossings of both coordinates it has at most five pieces; on the outer two both are constant,
/// on the inner ones each is linear, where `6 ∫ X Y dt = D ((X + X')(Y + Y') + X Y + X' Y')`.
#[inline(always)]
pub(super) fn edge_term<S: Scalar, const SLOPES: bool, const PIECES: bool>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    at: [usize; 3],
    bounds: &mut Bounds<S>,
) -> S {
    if PIECES {
        edge_term_apart::<S, SLOPES>(cut, edge, at, bounds)
    } else {
        edge_term_here::<S, SLOPES>(cut, edge, at, bounds)
    }
}

#[inline(never)]
fn edge_term_apart<S: Scalar, const SLOPES: bool>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    at: [usize; 3],
    bounds: &mut Bounds<S>,
) -> S {
    edge_term_here::<S, SLOPES>(cut, edge, at, bounds)
}

#[inline(always)]
fn edge_term_here<S: Scalar, const SLOPES: bool>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    [m, a, b]: [usize; 3],
    bounds: &mut Bounds<S>,
) -> S {
    let (j, l) = ((m + 1) % 3, (m + 2) % 3);
    let t0 = edge.enter[m].least(cut.f[m][1]);
    let t1 = edge.leave[m].most(cut.f[m][0]);
    let (j0, j1) = (
        clamped(edge.enter[j], t0, t1),
        clamped(edge.leave[j], t0, t1),
    );
    let (l0, l1) = (
        clamped(edge.enter[l], t0, t1),
        clamped(edge.leave[l], t0, t1),
    );
    let (n1, n4) = (j0.least(l0), j1.most(l1));
    let (n2, n3) = (j0.most(l0), j1.least(l1));
    let (n2, n3) = (n2.least(n3), n2.most(n3));
    let t = [t0, n2, n3, t1];
    let (mut x, mut y) = ([t0; 4], [t0; 4]);
    for n in 0..4 {
        x[n] = coordinate(cut, edge, m, j, t[n]);
        y[n] = coordinate(cut, edge, m, l, t[n]);
    }
    let both = [x[0] * y[0], x[1] * y[1], x[2] * y[2], x[3] * y[3]];
    let ends = [n1, n2, n3, n4];
    let mut six = ((n1 - t0) * both[0] + (t1 - n4) * both[3]) * S::lit(6.0);
    for n in 0..3 {
        let mixed = (x[n] + x[n + 1]) * (y[n] + y[n + 1]) + (both[n] + both[n + 1]);
        six += (ends[n + 1] - ends[n]) * mixed;
    }
    if SLOPES {
        // Where the edge is beyond a along its own direction, X_m is a bound of a.
        let corner = |t: S| coordinate(cut, edge, m, j, t) * coordinate(cut, edge, m, l, t);
        let (q0, q1) = (corner(cut.f[m][0]), corner(cut.f[m][1]));
        bounds.high[m] = less_signed(bounds.high[m], a, b, both[3] - q1);
        bounds.low[m] = less_signed(bounds.low[m], a, b, q0 - both[0]);
        // Where X_j is a bound, the integral of X_l; and the other way round.
        for (one, other, enter, leave) in [(j, l, j0, j1), (l, j, l0, l1)] {
            let before = along(cut, edge, m, other, t0, enter) * cut.r[m][m];
            let after = along(cut, edge, m, other, leave, t1) * cut.r[m][m];
            let falls = cut.rho[one][m].below(S::zero());
            let (at_high, at_low) = (
                S::select(falls, before, after),
                S::select(falls, after, before),
            );
            // The sum over edges is taken away from the volume.
            bounds.high[one] = less_signed(bounds.high[one], a, b, at_high);
            bounds.low[one] = less_signed(bounds.low[one], a, b, at_low);
        }
    }
    six * cut.r[m][m]
}

//! The border of one box of any orientation clamped to another: the volume they share, and its slopes.
//!
//! # The method
//!
//! Let K be box a, axis-aligned about the origin of its own frame, P box b, and C the map that clamps
//! each coordinate to K. C is continuous, fixes K, sends everything outside to K's border, and the
//! straight path from a point to its clamp never meets the inside of K. So the border of P and its image
//! under C wind equally often about every point inside K, and the volume shared is the integral of any
//! primitive of `dx dy dz` over the clamped border of P. There is no list of vertices and no sorting; the
//! sum is continuous in every input.
//!
//! The primitives `x_k dx_i dx_j` (k, i, j in circular order) differ by exact forms. So each face of P may
//! use the one whose direction it faces most, if the differences are made good along the edges and at the
//! corners where faces with different primitives meet. With X the clamped coordinates:
//!
//! ```text
//! V =  Σ faces (k, s)        s · ∫ clamp(x_k) dx_i dx_j   over the face seen along x_k, inside K's rectangle
//!    − Σ edges (m; s_j, s_l) s_j s_l · ∫ X_j X_l dX_m
//!    + Σ corners             s_0 s_1 s_2 · X_0 X_1 X_2
//! ```
//!
//! Every integrand is a polynomial between the places where a coordinate begins or ceases to be clamped.
//! Those crossings are computed once per edge and shared by the faces that meet there, so that rounding
//! cannot tear the border.
//!
//! # Slopes
//!
//! By the fundamental theorem the slope by a move of P's face outwards is the area of that face inside K,
//! and by a turn its first moment; both come from the pieces of the faces' integrals. Slopes by K's size
//! come from the parts of the integrals that are clamped to K's faces. Moving or turning both boxes
//! together changes nothing, which gives the rest.
use super::face::{Face, face};
use super::relate::Relative3;
use crate::Scalar;

/// The volume that two related boxes share, in units of `1 / scale³`, and its slopes in a's frame.
#[derive(Clone, Copy, Debug)]
pub struct Shared3<S> {
    /// The volume.
    pub volume: S,
    /// By the centre of b.
    pub center: [S; 3],
    /// By a turn of b about its own centre, as a rotation vector in a's frame.
    pub turn: [S; 3],
    /// By half the size of a.
    pub half_a: [S; 3],
    /// By half the size of b, along its renamed axes.
    pub half_b: [S; 3],
}

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
fn less_signed<S: Scalar>(sum: S, a: usize, b: usize, x: S) -> S {
    if a == b { sum - x } else { sum + x }
}

#[inline(always)]
fn cut<S: Scalar>(pair: &Relative3<S>) -> (Cut<S>, [S; 3]) {
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
fn edge<S: Scalar>(cut: &Cut<S>, m: usize, a: usize, b: usize) -> Edge<S> {
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
fn coordinate<S: Scalar>(cut: &Cut<S>, edge: &Edge<S>, m: usize, i: usize, t: S) -> S {
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
fn edge_term<S: Scalar, const SLOPES: bool>(
    cut: &Cut<S>,
    edge: &Edge<S>,
    [m, a, b]: [usize; 3],
    bounds: &mut Bounds<S>,
) -> S {
    let (j, l) = ((m + 1) % 3, (m + 2) % 3);
    let t0 = edge.enter[m].least(cut.f[m][1]);
    let t1 = edge.leave[m].most(cut.f[m][0]);
    let (j0, j1) = (clamped(edge.enter[j], t0, t1), clamped(edge.leave[j], t0, t1));
    let (l0, l1) = (clamped(edge.enter[l], t0, t1), clamped(edge.leave[l], t0, t1));
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

/// The most that two boxes can share: each against the other's bounds in its own frame. Zero where one of
/// the fifteen axes separates them.
#[inline(always)]
fn most_shared<S: Scalar>(pair: &Relative3<S>) -> S {
    let (r, c, h, p) = (pair.turn, pair.center, pair.half_a, pair.half_b);
    let zero = S::zero();
    let mut steep = [[zero; 3]; 3];
    for i in 0..3 {
        for m in 0..3 {
            steep[i][m] = r[i][m].unsigned();
        }
    }
    let (mut in_a, mut in_b) = (S::one(), S::one());
    for i in 0..3 {
        let reach = (steep[i][0] * p[0] + steep[i][1] * p[1]) + steep[i][2] * p[2];
        let shared = (c[i] + reach).least(h[i]) - (c[i] - reach).most(-h[i]);
        in_a = in_a * shared.most(zero);
        let reach = (steep[0][i] * h[0] + steep[1][i] * h[1]) + steep[2][i] * h[2];
        let center = (r[0][i] * c[0] + r[1][i] * c[1]) + r[2][i] * c[2];
        let shared = (center + reach).least(p[i]) - (center - reach).most(-p[i]);
        in_b = in_b * shared.most(zero);
    }
    let mut gap = -S::one();
    for i in 0..3 {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        for m in 0..3 {
            let (a, b) = ((m + 1) % 3, (m + 2) % 3);
            let distance = (c[l] * r[j][m] - c[j] * r[l][m]).unsigned();
            let reach_a = h[j] * steep[l][m] + h[l] * steep[j][m];
            let reach_b = p[a] * steep[i][b] + p[b] * steep[i][a];
            gap = gap.most(distance - (reach_a + reach_b));
        }
    }
    S::select(gap.above(zero), zero, in_a.least(in_b))
}

/// The volume that two related boxes share and, if asked for, its slopes. Straight line.
#[inline(always)]
pub fn shared_volume<S: Scalar, const SLOPES: bool>(pair: &Relative3<S>) -> Shared3<S> {
    let zero = S::zero();
    let (cut, origin) = cut(pair);
    let mut bounds = Bounds {
        high: [zero; 3],
        low: [zero; 3],
    };

    let mut volume = zero;
    let none = Edge {
        start: [zero; 3],
        at: [[zero; 2]; 3],
        enter: [zero; 3],
        leave: [zero; 3],
    };
    let mut edges = [[[none; 2]; 2]; 3];
    for m in 0..3 {
        for a in 0..2 {
            for b in 0..2 {
                let made = edge(&cut, m, a, b);
                let six = edge_term::<S, SLOPES>(&cut, &made, [m, a, b], &mut bounds);
                volume = less_signed(volume, a, b, six);
                edges[m][a][b] = made;
            }
        }
    }
    volume = volume * S::lit(1.0 / 6.0);
    for a in 0..2 {
        for b in 0..2 {
            for side in 0..2 {
                let (at, t) = (&edges[0][a][b], cut.f[0][side]);
                let x = coordinate(&cut, at, 0, 0, t);
                let y = coordinate(&cut, at, 0, 1, t);
                let z = coordinate(&cut, at, 0, 2, t);
                let corner = x * y * z;
                volume = if (a + b + side) % 2 == 1 {
                    volume + corner
                } else {
                    volume - corner
                };
            }
        }
    }
    let mut faces = [[Face::none(); 2]; 3];
    let mut thrice = zero;
    for k in 0..3 {
        for side in 0..2 {
            let made = face::<S, SLOPES>(&cut, &edges, k, side, &mut bounds);
            thrice = if side == 1 {
                thrice + made.thrice
            } else {
                thrice - made.thrice
            };
            faces[k][side] = made;
        }
    }
    let volume = thrice * S::lit(1.0 / 3.0) + volume;
    let most = most_shared(pair);
    let mut out = Shared3 {
        volume: volume.most(zero).least(most),
        center: [zero; 3],
        turn: [zero; 3],
        half_a: [zero; 3],
        half_b: [zero; 3],
    };
    if SLOPES {
        slopes(pair, &cut.r, origin, &faces, &bounds, &mut out);
        let apart = most.at_most(zero);
        for i in 0..3 {
            out.center[i] = S::select(apart, zero, out.center[i]);
            out.turn[i] = S::select(apart, zero, out.turn[i]);
            out.half_a[i] = S::select(apart, zero, out.half_a[i]);
            out.half_b[i] = S::select(apart, zero, out.half_b[i]);
        }
    }
    same_box::<S, SLOPES>(pair, out)
}

/// Slopes from areas and moments of b's faces inside a.
#[inline(always)]
fn slopes<S: Scalar>(
    pair: &Relative3<S>,
    r: &[[S; 3]; 3],
    origin: [S; 3],
    faces: &[[Face<S>; 2]; 3],
    bounds: &Bounds<S>,
    out: &mut Shared3<S>,
) {
    let mut from_center = [S::zero(); 3];
    for i in 0..3 {
        from_center[i] = origin[i] - pair.center[i];
        out.half_a[i] = bounds.high[i] - bounds.low[i];
    }
    for k in 0..3 {
        let [low, high] = &faces[k];
        let along = high.area - low.area;
        out.half_b[k] = high.area + low.area;
        let normal = [r[0][k], r[1][k], r[2][k]];
        let mut moment = [S::zero(); 3];
        for i in 0..3 {
            out.center[i] += along * normal[i];
            moment[i] = along * from_center[i] + (high.moment[i] - low.moment[i]);
        }
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            out.turn[i] += moment[j] * normal[l] - moment[l] * normal[j];
        }
    }
}

/// For boxes that are the same set of points: exactly their volume, each size with half the slope, and no
/// slope by motion, by symmetry.
#[inline(always)]
fn same_box<S: Scalar, const SLOPES: bool>(pair: &Relative3<S>, found: Shared3<S>) -> Shared3<S> {
    let (same, h, zero) = (pair.same, pair.half_a, S::zero());
    let whole = (h[0] + h[0]) * (h[1] + h[1]) * (h[2] + h[2]);
    let mut out = found;
    out.volume = S::select(same, whole, found.volume);
    if SLOPES {
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            let face = (h[j] + h[j]) * (h[l] + h[l]);
            out.center[i] = S::select(same, zero, found.center[i]);
            out.turn[i] = S::select(same, zero, found.turn[i]);
            out.half_a[i] = S::select(same, face, found.half_a[i]);
            out.half_b[i] = S::select(same, face, found.half_b[i]);
        }
    }
    out
}

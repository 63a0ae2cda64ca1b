//! Corners and pairs of edges of two boxes as candidates for the nearest points: numbers without derivatives.
use super::super::spot::part;
use super::seen::{NEXT, RelativeBox, least_square, sign};
use crate::Scalar;
use crate::arrays::Each;

/// Returns the square of a number.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn squared<P: Scalar>(x: P) -> P {
    x * x
}

/// Returns one where the mask is true, else zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn weight<P: Scalar>(mask: P::Mask) -> P {
    P::select(mask, P::one(), P::zero())
}

/// Returns the larger of numbers without derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn larger<P: Scalar>(x: P, y: P) -> P {
    P::select(x.below(y), y, x)
}

/// Returns the smaller one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn smaller<P: Scalar>(x: P, y: P) -> P {
    P::select(y.below(x), y, x)
}

/// The corners of one box against the other.
pub(super) struct Corners<P> {
    /// The squares of their distances.
    squares: [P; 8],
}

/// The signs of corners along the three axes.
const SIGNS: [[f64; 3]; 8] = {
    let mut signs = [[1.0; 3]; 8];
    let mut k = 0;
    while k < 24 {
        if (k / 3) >> (k % 3) & 1 == 1 {
            signs[k / 3][k % 3] = -1.0;
        }
        k += 1;
    }
    signs
};

/// Returns the distance of a coordinate from the interval `[−half, half]`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn beyond<P: Scalar>(x: P, half: P) -> P {
    larger(x.unsigned() - half, P::zero())
}

impl<P: Scalar> Corners<P> {
    /// Returns the features of a box with a centre and half its size along axes `rows[k]`, against a box with its
    /// centre at zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(center: [P; 3], rows: [[P; 3]; 3], half: [P; 3], other: [P; 3]) -> Self {
        let squares = [0, 1, 2].each_as(|k| {
            let arms = [0, 1, 2].each_as(|j| rows[k][j] * half[j]);
            SIGNS.each_as(|signs| {
                let along = |x: P, j: usize| {
                    if signs[j] < 0.0 {
                        x - arms[j]
                    } else {
                        x + arms[j]
                    }
                };
                squared(beyond(along(along(along(center[k], 0), 1), 2), other[k]))
            })
        });
        let squares = std::array::from_fn(|n| (squares[0][n] + squares[1][n]) + squares[2][n]);
        Corners { squares }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn least(&self) -> P {
        self.squares
            .into_iter()
            .reduce(smaller)
            .unwrap_or_else(P::zero)
    }
    /// Returns the mean of the signs of those whose square is some number, and how many they are.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn tied(&self, least: P) -> ([P; 3], P) {
        let shares = self
            .squares
            .each_as(|square| weight::<P>(square.equals(least)));
        let sum = |of: fn([f64; 3]) -> f64| {
            let parts = SIGNS.iter().zip(shares);
            parts.fold(P::zero(), |sum, (&signs, share)| {
                if of(signs) < 0.0 {
                    sum - share
                } else {
                    sum + share
                }
            })
        };
        let count = shares.into_iter().fold(P::zero(), |sum, share| sum + share);
        let over = P::select(count.equals(P::zero()), P::one(), count);
        let sums = [sum(|s| s[0]), sum(|s| s[1]), sum(|s| s[2])];
        (sums.each_as(|sum| sum.over(over)), count)
    }
}

/// An edge of each box: those that support them along their common normal.
#[derive(Clone, Copy)]
pub(super) struct Edges<P: Scalar> {
    /// The squared distance of their lines; the largest number if a nearest point is beyond an end.
    pub square: P,
    /// `true` if the normal has at least half the digits of the format.
    pub clear: P::Mask,
    /// The point of a along its axes, as parts of half its size.
    pub x: [P; 3],
    /// The coordinates on the edge of b.
    pub y: [P; 3],
    /// The side of the normal.
    pub side: P,
    /// One along the axis of a that the normal is parallel to.
    pub upright_a: [P; 3],
    /// Along the axis of b.
    pub upright_b: [P; 3],
}

/// Returns the matrix with a sign for each zero. If an axis of b lies in a plane of a, neither of the plane's sides is
/// nearer. A rotation too small to count then decides for all pairs of edges alike.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn turned<P: Scalar>(r: &[[P; 3]; 3]) -> [[P; 3]; 3] {
    let turn = [0.73, 0.41, 0.97].each_as(|part| P::lit(part * P::format().epsilon().powi(2)));
    [0, 1, 2].each_as(|i| {
        let [k, l] = NEXT[i];
        [0, 1, 2].each_as(|j| {
            let moved = turn[k] * r[l][j] - turn[l] * r[k][j];
            P::select(r[i][j].equals(P::zero()), moved, r[i][j])
        })
    })
}

impl<P: Scalar> Edges<P> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(seen: &RelativeBox<P>, turned: &[[P; 3]; 3], i: usize, j: usize) -> Self {
        let RelativeBox { c, r, g, h, .. } = seen;
        let ([k, l], [m, p]) = (NEXT[i], NEXT[j]);
        let zero = P::zero();
        let (rk, rl) = (r[k][j], r[l][j]);
        let square = rl * rl + rk * rk;
        let none = square.at_most(least_square());
        let side = sign(rk * c[l] - rl * c[k]);
        // The sides of a that the normal `(-rl, rk)` leaves, of b those that it enters.
        let (tk, tl) = (turned[k][j], turned[l][j]);
        let (xk, xl) = (-side.signed_as(tl), side.signed_as(tk));
        // The normal's component along axis m of b equals that of axis p of b along axis i of a up to sign, which gives
        // the sign if products cancel within rounding.
        let across = |m: usize, own: P| {
            let (plus, minus) = (tk * turned[l][m], tl * turned[k][m]);
            let size = plus.unsigned() + minus.unsigned();
            let rest = plus - minus;
            P::select(
                rest.unsigned().at_most(size * P::rounding(8.0, 1)),
                own,
                rest,
            )
        };
        let ym = -side.signed_as(across(m, turned[i][p]));
        let yp = -side.signed_as(across(p, -turned[i][m]));
        let from = |k: usize| c[k] + (r[k][m] * (h[m] * ym) + r[k][p] * (h[p] * yp));
        let way = [from(k) - g[k] * xk, from(l) - g[l] * xl];
        let t = -(way[0] * rk + way[1] * rl).over(P::select(none, P::one(), square));
        let s = from(i) + r[i][j] * t;
        let way = [way[0] + rk * t, way[1] + rl * t];
        let within = s.unsigned().below(g[i]) & t.unsigned().below(h[j]) & !none;
        let length = squared(way[0]) + squared(way[1]);
        let place = |along: (usize, P), sides: [(usize, P); 2]| {
            let mut all = [along.1; 3];
            for (k, x) in sides {
                all[k] = x;
            }
            all
        };
        let exact = |x: P| weight(x.equals(zero));
        let none_of = |at: [(usize, P); 2]| {
            let mut all = [zero; 3];
            for (k, x) in at {
                all[k] = x;
            }
            all
        };
        Edges {
            square: P::select(within, length, P::largest()),
            clear: square.above(P::rounding(1.0, 1)),
            x: place((i, part(s, g[i])), [(k, xk), (l, xl)]),
            y: place((j, part(t, h[j])), [(m, ym), (p, yp)]),
            side,
            upright_a: none_of([(k, exact(rk)), (l, exact(rl))]),
            upright_b: none_of([(p, exact(r[i][p])), (m, exact(r[i][m]))]),
        }
    }
}

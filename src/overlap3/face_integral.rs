//! One face of a box integrated over what of it is above and below another box.
use super::edge_clamp::{
    BoundDerivatives, Cut, Edge, clamped, edge, edge_term, fixed, less_signed, signed, tiny,
};
use crate::Scalar;

/// A face of b: its part of the volume, and its area and first moment inside a.
#[derive(Clone, Copy)]
pub(super) struct Face<S> {
    /// Three times the integral of the clamped coordinate that the face looks along.
    pub thrice: S,
    /// Six times the part of its edges along axis 0.
    pub six: S,
    /// The area inside a.
    pub area: S,
    /// The first moment of that about the common origin, along a's axes as the face names them.
    pub moment: [S; 3],
}

impl<S: Scalar> Face<S> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        Face {
            thrice: S::zero(),
            six: S::zero(),
            area: S::zero(),
            moment: [S::zero(); 3],
        }
    }
}

/// One side of the region that is integrated over: an edge of the face, or a side of a's rectangle.
#[derive(Clone, Copy)]
struct RegionSide<S: Scalar> {
    /// The range of its parameter.
    from: S,
    to: S,
    /// The parameter where z comes into a's bounds and where it leaves them.
    enter: S,
    leave: S,
    /// Negative where z falls along it.
    rises: S,
    /// `true` where z counts as constant along it.
    flat: S::Mask,
    /// `z + z₀/2` at parameter zero, and half its derivative.
    z: S,
    half_derivative: S,
    /// A point of it and its direction.
    at: [S; 2],
    direction: [S; 2],
}

/// Sums around the region.
#[derive(Clone, Copy)]
struct Sums<S> {
    /// `Σ d⁰ (W + z₀ L / 2)`.
    height: S,
    /// Twice the areas: of all (only for derivatives), above a, below a.
    area: [S; 3],
    /// Three times their first moments about the level points.
    moment: [[S; 2]; 3],
}

impl<S: Scalar> Sums<S> {
    /// Adds a side, given the weight of a unit of it for each level point; returns `∫ (clamp(z) + z₀/2)`
    /// along it.
    #[inline(always)]
    fn add<const DERIVATIVE: bool, const PIECES: bool>(
        &mut self,
        side: RegionSide<S>,
        weight: [S; 3],
        z_bounds: [S; 2],
        points: &[[S; 2]; 3],
    ) -> S {
        if PIECES {
            self.add_apart::<DERIVATIVE>(side, weight, z_bounds, points)
        } else {
            self.add_here::<DERIVATIVE>(side, weight, z_bounds, points)
        }
    }

    #[inline(never)]
    fn add_apart<const DERIVATIVE: bool>(
        &mut self,
        side: RegionSide<S>,
        weight: [S; 3],
        z_bounds: [S; 2],
        points: &[[S; 2]; 3],
    ) -> S {
        self.add_here::<DERIVATIVE>(side, weight, z_bounds, points)
    }

    #[inline(always)]
    fn add_here<const DERIVATIVE: bool>(
        &mut self,
        side: RegionSide<S>,
        weight: [S; 3],
        z_bounds: [S; 2],
        points: &[[S; 2]; 3],
    ) -> S {
        let from = side.from;
        let to = side.to.most(from);
        let enter = clamped(side.enter, from, to);
        let leave = clamped(side.leave, from, to);
        let (enter, leave) = if DERIVATIVE {
            // An empty side has no parts: a tie of its ends with a crossing shares no derivative among them.
            let empty = side.to.below(from);
            (S::select(empty, from, enter), S::select(empty, from, leave))
        } else {
            (enter, leave)
        };
        let (before, inside, after) = (enter - from, leave - enter, to - leave);
        let falls = side.rises.below(S::zero());
        let above = S::select(falls, before, after);
        let below = S::select(falls, after, before);
        let mean = (enter + leave) * side.half_derivative + side.z;
        let height = inside * mean + (above * z_bounds[1] + below * z_bounds[0]);
        self.height += weight[0] * height;
        self.area[1] += weight[1] * above;
        self.area[2] += weight[2] * below;
        if DERIVATIVE {
            let length = to - from;
            self.area[0] += weight[0] * length;
            let (first, last) = ((from + enter).halved(), (leave + to).halved());
            let center = (from + to).halved();
            let high = S::select(side.flat, center, S::select(falls, first, last));
            let low = S::select(side.flat, center, S::select(falls, last, first));
            let pieces = [(center, length), (high, above), (low, below)];
            for n in 0..3 {
                let (t, length) = pieces[n];
                let mass = weight[n] * length;
                for i in 0..2 {
                    let at = t * side.direction[i] + side.at[i];
                    self.moment[n][i] += mass * (at - points[n][i]);
                }
            }
        }
        height
    }
}

/// Returns a face of b: the one across b's axis 2, low or high `side`, seen along a's axis 2; and its edges along
/// axis 0.
///
/// The projection of the face is a parallelogram F' in the plane of x = axis 0 and y = axis 1, over which the plane of
/// the face is `z = z_c + b x + c y`. It is integrated over F' cut with a's rectangle: its border consists of four
/// edges of the face and four sides of the rectangle. On each level ζ (zero, the upper and the lower bound of z) a
/// *level point* p is chosen from which the indicator of z > ζ does not change along rays; so areas and integrals are
/// sums over the border of `cross(q − p, dq)`:
///
/// ```text
/// ∫ clamp(z) = (Σ d⁰ W + z₀ A₀ + k⁺ A⁺ + k⁻ A⁻) / 3,   W = ∫ clamp(z) along a side
/// ```
///
/// by the divergence of `clamp(z) (q − p)`; all terms stay bounded for a thin a.
#[inline(always)]
pub(super) fn face<S: Scalar, const DERIVATIVE: bool, const PIECES: bool>(
    cut: &Cut<S>,
    side: usize,
    bounds: &mut BoundDerivatives<S>,
) -> Face<S> {
    if PIECES {
        face_apart::<S, DERIVATIVE>(cut, side, bounds)
    } else {
        face_here::<S, DERIVATIVE, false>(cut, side, bounds)
    }
}

#[inline(never)]
fn face_apart<S: Scalar, const DERIVATIVE: bool>(
    cut: &Cut<S>,
    side: usize,
    bounds: &mut BoundDerivatives<S>,
) -> Face<S> {
    face_here::<S, DERIVATIVE, true>(cut, side, bounds)
}

/// The numbers that the sides of the region have in common.
struct FaceRegion<'a, S: Scalar> {
    cut: &'a Cut<S>,
    side: usize,
    /// The edges of the face along axis 0, bottom and top, and along axis 1, left and right.
    edges: [[Edge<S>; 2]; 2],
    /// `z = z_center + derivative · (x, y)`.
    derivative: [S; 2],
    z_center: S,
    half_z0: S,
    /// The bounds of z, raised by half of z₀.
    raised: [S; 2],
    points: [[S; 2]; 3],
    /// The cross products of a point of the plane through the middle, seen from every level point, with the
    /// directions of both kinds of edges.
    cross: [[S; 3]; 2],
}

/// The indices of a face's coordinates x, y and z in the coordinates of its edges along axis 0 and along axis 1.
const OF_EDGE: [[usize; 3]; 2] = [[0, 1, 2], [2, 0, 1]];

impl<S: Scalar> FaceRegion<'_, S> {
    /// Adds an edge of the face: along axis `N`, the lower or the upper one (`G`).
    #[inline(always)]
    fn edge<const DERIVATIVE: bool, const PIECES: bool, const N: usize, const G: usize>(
        &self,
        sums: &mut Sums<S>,
    ) {
        let (
            Cut {
                r, rho, flat, f, ..
            },
            edge,
        ) = (self.cut, &self.edges[N][G]);
        let [x, y, z] = OF_EDGE[N];
        let shift = f[1 - N][G] * r[2][2];
        // Around the face: forwards along the bottom and up the right, back along the top and down.
        let mut weight = [S::zero(); 3];
        for m in 0..3 {
            let cross = self.cross[N][m];
            weight[m] = match (N, G) {
                (0, 0) => cross - shift,
                (0, _) => shift - cross,
                (_, 0) => -shift - cross,
                (_, _) => cross + shift,
            };
        }
        let border = RegionSide {
            from: edge.enter[x].most(edge.enter[y]),
            to: edge.leave[x].least(edge.leave[y]),
            enter: edge.enter[z],
            leave: edge.leave[z],
            rises: rho[2][N],
            flat: flat[2][N],
            z: edge.start[z] + self.half_z0,
            half_derivative: r[2][N].halved(),
            at: [edge.start[x], edge.start[y]],
            direction: [r[0][N], r[1][N]],
        };
        sums.add::<DERIVATIVE, PIECES>(border, weight, self.raised, &self.points);
    }

    /// Returns the other coordinate of an edge where it crosses the lower or the upper (`G`) bound of coordinate `OWN`.
    #[inline(always)]
    fn crossing<const N: usize, const OWN: usize, const G: usize>(&self, edge: usize) -> S {
        let (edge, own, other) = (&self.edges[N][edge], OF_EDGE[N][OWN], OF_EDGE[N][1 - OWN]);
        edge.at[own][G] * self.cut.r[1 - OWN][N] + edge.start[other]
    }

    /// Adds a side of a's rectangle: where x (`N` = 0) or y (1) is at its lower or upper bound (`G`). Along it
    /// z has the reciprocal derivative −R₂₂ / R₁₂ or −R₂₂ / R₀₂.
    #[inline(always)]
    fn side<const DERIVATIVE: bool, const PIECES: bool, const N: usize, const G: usize>(
        &self,
        sums: &mut Sums<S>,
        bounds: &mut BoundDerivatives<S>,
    ) {
        let (zero, one) = (S::zero(), S::one());
        let Cut {
            r, rho, flat, k, ..
        } = self.cut;
        let other = 1 - N;
        let (bound, [low_bound, high_bound], z_bounds) = (k[N][G], k[other], k[2]);
        // The crossings of the four edges of the face with it.
        let (low_u, high_u) = (self.crossing::<0, N, G>(0), self.crossing::<0, N, G>(1));
        let (low_v, high_v) = (self.crossing::<1, N, G>(0), self.crossing::<1, N, G>(1));
        let (low, high, one_of, another) = if N == 0 {
            (low_u, high_u, low_v, high_v)
        } else {
            (low_v, high_v, low_u, high_u)
        };
        let from = low_bound.most(low).most(one_of.least(another));
        let to = high_bound.least(high).least(one_of.most(another));
        let z = self.derivative[N] * bound + self.z_center;
        let per_derivative = -(r[2][2] * rho[other][2]);
        let center = (low_bound + high_bound).halved();
        let center = S::select(flat[other][2], center, zero);
        let at_low = (z_bounds[0] - z) * per_derivative + center;
        let at_high = (z_bounds[1] - z) * per_derivative + center;
        let (at_low, at_high) = (
            fixed(flat[other][2], at_low),
            fixed(flat[other][2], at_high),
        );
        let mut weight = [zero; 3];
        for m in 0..3 {
            let beyond = bound - self.points[m][N];
            weight[m] = if G == 1 { beyond } else { -beyond };
        }
        let border = RegionSide {
            from,
            to,
            enter: at_low.least(at_high),
            leave: at_low.most(at_high),
            rises: -rho[other][2],
            flat: flat[other][2],
            z: z + self.half_z0,
            half_derivative: self.derivative[other].halved(),
            at: if N == 0 { [bound, zero] } else { [zero, bound] },
            direction: if N == 0 { [zero, one] } else { [one, zero] },
        };
        let height = sums.add::<DERIVATIVE, PIECES>(border, weight, self.raised, &self.points);
        if DERIVATIVE {
            // The gain of a's face when it moves outwards.
            let gain = height - self.half_z0 * (to.most(from) - from);
            let bar = if G == 1 {
                &mut bounds.high[N]
            } else {
                &mut bounds.low[N]
            };
            *bar = if self.side == G {
                *bar + gain
            } else {
                *bar - gain
            };
        }
    }
}

/// Returns the range of a coordinate over F': its derivative along `own` is `along`, that along `other` is `across`.
#[inline(always)]
fn reach<S: Scalar>([own, other]: [[S; 2]; 2], along: S, across: S, middle: S) -> [S; 2] {
    let (p, q) = (other[0] * across, other[1] * across);
    [
        (own[0] * along + p.least(q)) + middle,
        (own[1] * along + p.most(q)) + middle,
    ]
}

#[inline(always)]
fn face_here<S: Scalar, const DERIVATIVE: bool, const PIECES: bool>(
    cut: &Cut<S>,
    side: usize,
    bounds: &mut BoundDerivatives<S>,
) -> Face<S> {
    let (zero, one) = (S::zero(), S::one());
    let edges = [
        [
            edge::<S, PIECES, 0>(cut, 0, side),
            edge::<S, PIECES, 0>(cut, 1, side),
        ],
        [
            edge::<S, PIECES, 1>(cut, side, 0),
            edge::<S, PIECES, 1>(cut, side, 1),
        ],
    ];
    let mut out = Face::none();
    for a in 0..2 {
        let six = edge_term::<S, DERIVATIVE, PIECES>(cut, &edges[0][a], [a, side], bounds);
        out.six = less_signed(out.six, a, side, six);
    }

    let Cut {
        r,
        rho,
        k: [x_bounds, y_bounds, z_bounds],
        f,
        ..
    } = cut;
    let per = rho[2][2];
    let derivative = [-(r[0][2] * per), -(r[1][2] * per)];
    let offset = f[2][side % 2];
    let normal = [offset * r[0][2], offset * r[1][2]];
    let z_center = offset * per;

    // The part of a's rectangle that F' can reach.
    let x_reach = reach([f[0], f[1]], r[0][0], r[0][1], normal[0]);
    let y_reach = reach([f[1], f[0]], r[1][1], r[1][0], normal[1]);
    let (x_low, x_high) = (x_reach[0].most(x_bounds[0]), x_reach[1].least(x_bounds[1]));
    let (y_low, y_high) = (y_reach[0].most(y_bounds[0]), y_reach[1].least(y_bounds[1]));
    let mid = [(x_low + x_high).halved(), (y_low + y_high).halved()];
    let half = [
        (x_high - x_low).halved().most(zero),
        (y_high - y_low).halved().most(zero),
    ];
    let uphill = [
        half[0].signed_as(derivative[0]),
        half[1].signed_as(derivative[1]),
    ];
    let range = derivative[0] * uphill[0] + derivative[1] * uphill[1];
    let z_mid = derivative[0] * mid[0] + (derivative[1] * mid[1] + z_center);
    let least = S::lit(tiny::<S>());
    let level = range.at_most(least);
    let per_range = one.over(S::select(level, least, range));
    let mut points = [[zero; 2]; 3];
    let mut z0 = zero;
    let heights = [zero, z_bounds[1], z_bounds[0]];
    for n in 0..3 {
        let tau = clamped((heights[n] - z_mid) * per_range, -one, one);
        let tau = fixed(level, tau);
        points[n] = [tau * uphill[0] + mid[0], tau * uphill[1] + mid[1]];
        if n == 0 {
            z0 = tau * range + z_mid;
        }
    }

    // Weights of the edges: cross(point of the edge − level point, its direction).
    let mut cross = [[zero; 3]; 2];
    for n in 0..3 {
        let from = [normal[0] - points[n][0], normal[1] - points[n][1]];
        cross[0][n] = from[0] * r[1][0] - from[1] * r[0][0];
        cross[1][n] = from[0] * r[1][1] - from[1] * r[0][1];
    }
    let half_z0 = z0.halved();
    let mut sums = Sums {
        height: zero,
        area: [zero; 3],
        moment: [[zero; 2]; 3],
    };
    let seen = FaceRegion {
        cut,
        side,
        edges,
        derivative,
        z_center,
        half_z0,
        raised: [z_bounds[0] + half_z0, z_bounds[1] + half_z0],
        points,
        cross,
    };
    seen.edge::<DERIVATIVE, PIECES, 0, 0>(&mut sums);
    seen.edge::<DERIVATIVE, PIECES, 0, 1>(&mut sums);
    seen.edge::<DERIVATIVE, PIECES, 1, 0>(&mut sums);
    seen.edge::<DERIVATIVE, PIECES, 1, 1>(&mut sums);
    seen.side::<DERIVATIVE, PIECES, 0, 0>(&mut sums, bounds);
    seen.side::<DERIVATIVE, PIECES, 1, 0>(&mut sums, bounds);
    seen.side::<DERIVATIVE, PIECES, 0, 1>(&mut sums, bounds);
    seen.side::<DERIVATIVE, PIECES, 1, 1>(&mut sums, bounds);

    let (above, below) = (sums.area[1].halved(), sums.area[2].halved());
    out.thrice = (z_bounds[1] - z0) * above + ((z_bounds[0] - z0) * below + sums.height);
    if DERIVATIVE {
        let all = sums.area[0].halved();
        bounds.high[2] = signed(bounds.high[2], side, above);
        bounds.low[2] = signed(bounds.low[2], side, below);
        out.area = (all - above - below) * per;
        let mut moment = [zero; 2];
        for n in 0..2 {
            let own = sums.moment[0][n] - sums.moment[1][n] - sums.moment[2][n];
            let shift = points[0][n] * all - points[1][n] * above - points[2][n] * below;
            moment[n] = (own * S::lit(1.0 / 3.0) + shift) * per;
        }
        out.moment[0] = moment[0];
        out.moment[1] = moment[1];
        out.moment[2] =
            z_center * out.area + (derivative[0] * moment[0] + derivative[1] * moment[1]);
    }
    out
}

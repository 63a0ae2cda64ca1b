//! One face of a box integrated over what of it is above and below another box.
use super::edge::{Bounds, Cut, Edges, clamped, tiny};
use crate::Scalar;

/// A face of b: its part of the volume, and its area and first moment inside a.
#[derive(Clone, Copy)]
pub(super) struct Face<S> {
    /// Three times the integral of the clamped coordinate that the face looks along.
    pub thrice: S,
    /// The area inside a.
    pub area: S,
    /// The first moment of that about the common origin.
    pub moment: [S; 3],
}

impl<S: Scalar> Face<S> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        Face {
            thrice: S::zero(),
            area: S::zero(),
            moment: [S::zero(); 3],
        }
    }
}

/// One side of the region that is integrated over: an edge of the face, or a side of a's rectangle.
#[derive(Clone, Copy)]
struct Side<S: Scalar> {
    /// From where to where its parameter runs.
    from: S,
    to: S,
    /// The parameter where z comes into a's bounds and where it leaves them.
    enter: S,
    leave: S,
    /// Negative where z falls along it.
    rises: S,
    /// Where z counts as constant along it.
    flat: S::Mask,
    /// `z + z₀/2` at parameter zero, and half its slope.
    z: S,
    half_slope: S,
    /// A point of it and its direction.
    at: [S; 2],
    direction: [S; 2],
}

/// Sums around the region.
#[derive(Clone, Copy)]
struct Sums<S> {
    /// `Σ d⁰ (W + z₀ L / 2)`.
    height: S,
    /// Twice the areas: of all (only for slopes), above a, below a.
    area: [S; 3],
    /// Three times their first moments about the level points.
    moment: [[S; 2]; 3],
}

impl<S: Scalar> Sums<S> {
    /// Adds a side, given the weight of a unit of it for each level point; returns `∫ (clamp(z) + z₀/2)`
    /// along it.
    #[inline(always)]
    fn add<const SLOPES: bool, const PIECES: bool>(
        &mut self,
        side: Side<S>,
        weight: [S; 3],
        z_bounds: [S; 2],
        points: &[[S; 2]; 3],
    ) -> S {
        if PIECES {
            self.add_apart::<SLOPES>(side, weight, z_bounds, points)
        } else {
            self.add_here::<SLOPES>(side, weight, z_bounds, points)
        }
    }

    #[inline(never)]
    fn add_apart<const SLOPES: bool>(
        &mut self,
        side: Side<S>,
        weight: [S; 3],
        z_bounds: [S; 2],
        points: &[[S; 2]; 3],
    ) -> S {
        self.add_here::<SLOPES>(side, weight, z_bounds, points)
    }

    #[inline(always)]
    fn add_here<const SLOPES: bool>(
        &mut self,
        side: Side<S>,
        weight: [S; 3],
        z_bounds: [S; 2],
        points: &[[S; 2]; 3],
    ) -> S {
        let from = side.from;
        let to = side.to.most(from);
        let enter = clamped(side.enter, from, to);
        let leave = clamped(side.leave, from, to);
        let (before, inside, after) = (enter - from, leave - enter, to - leave);
        let falls = side.rises.below(S::zero());
        let above = S::select(falls, before, after);
        let below = S::select(falls, after, before);
        let mean = (enter + leave) * side.half_slope + side.z;
        let height = inside * mean + (above * z_bounds[1] + below * z_bounds[0]);
        self.height += weight[0] * height;
        self.area[1] += weight[1] * above;
        self.area[2] += weight[2] * below;
        if SLOPES {
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

/// A face of b: the one across b's axis `k`, low or high `side`, seen along a's axis k.
///
/// The face seen so is a parallelogram F' in the plane of x = axis i and y = axis j, over which the plane
/// of the face is `z = z_c + b x + c y`. It is integrated over F' cut with a's rectangle: its border
/// consists of four edges of the face and four sides of the rectangle. On each level ζ (zero, the upper
/// and the lower bound of z) a *level point* p is chosen from which the indicator of z > ζ does not change
/// along rays; so areas and integrals are sums over the border of `cross(q − p, dq)`:
///
/// ```text
/// ∫ clamp(z) = (Σ d⁰ W + z₀ A₀ + k⁺ A⁺ + k⁻ A⁻) / 3,   W = ∫ clamp(z) along a side
/// ```
///
/// by the divergence of `clamp(z) (q − p)`; all terms stay bounded for a thin a.
#[inline(always)]
pub(super) fn face<S: Scalar, const SLOPES: bool, const PIECES: bool>(
    cut: &Cut<S>,
    edges: &Edges<S>,
    k: usize,
    side: usize,
    bounds: &mut Bounds<S>,
) -> Face<S> {
    if PIECES {
        face_apart::<S, SLOPES>(cut, edges, k, side, bounds)
    } else {
        face_here::<S, SLOPES, false>(cut, edges, k, side, bounds)
    }
}

#[inline(never)]
fn face_apart<S: Scalar, const SLOPES: bool>(
    cut: &Cut<S>,
    edges: &Edges<S>,
    k: usize,
    side: usize,
    bounds: &mut Bounds<S>,
) -> Face<S> {
    face_here::<S, SLOPES, true>(cut, edges, k, side, bounds)
}

#[inline(always)]
fn face_here<S: Scalar, const SLOPES: bool, const PIECES: bool>(
    cut: &Cut<S>,
    edges: &Edges<S>,
    k: usize,
    side: usize,
    bounds: &mut Bounds<S>,
) -> Face<S> {
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let (zero, one) = (S::zero(), S::one());
    let Cut {
        r,
        rho,
        flat,
        k: box_bounds,
        f,
        ..
    } = cut;
    let per = rho[k][k];
    let slope = [-(r[i][k] * per), -(r[j][k] * per)];
    let (u, v) = ([r[i][i], r[j][i]], [r[i][j], r[j][j]]);
    let (u_z, v_z) = (r[k][i], r[k][j]);
    let area_unit = r[k][k];
    let (x_bounds, y_bounds, z_bounds) = (box_bounds[i], box_bounds[j], box_bounds[k]);
    let offset = f[k][side];
    let normal = [offset * r[i][k], offset * r[j][k]];
    let z_center = offset * per;

    // The part of a's rectangle that F' can reach.
    let reach = |n: usize| {
        let (along, across) = if n == 0 { (u[0], v[0]) } else { (v[1], u[1]) };
        let (own, other) = if n == 0 { (f[i], f[j]) } else { (f[j], f[i]) };
        let (p, q) = (other[0] * across, other[1] * across);
        let low = (own[0] * along + p.least(q)) + normal[n];
        let high = (own[1] * along + p.most(q)) + normal[n];
        (low, high)
    };
    let (x_reach, y_reach) = (reach(0), reach(1));
    let (x_low, x_high) = (x_reach.0.most(x_bounds[0]), x_reach.1.least(x_bounds[1]));
    let (y_low, y_high) = (y_reach.0.most(y_bounds[0]), y_reach.1.least(y_bounds[1]));
    let mid = [(x_low + x_high).halved(), (y_low + y_high).halved()];
    let half = [
        (x_high - x_low).halved().most(zero),
        (y_high - y_low).halved().most(zero),
    ];
    let uphill = [half[0].signed_as(slope[0]), half[1].signed_as(slope[1])];
    let range = slope[0] * uphill[0] + slope[1] * uphill[1];
    let z_mid = slope[0] * mid[0] + (slope[1] * mid[1] + z_center);
    let least = S::lit(tiny::<S>());
    let level = range.at_most(least);
    let per_range = one.over(S::select(level, least, range));
    let mut points = [[zero; 2]; 3];
    let mut z0 = zero;
    for (n, height) in [zero, z_bounds[1], z_bounds[0]].into_iter().enumerate() {
        let tau = clamped((height - z_mid) * per_range, -one, one);
        points[n] = [tau * uphill[0] + mid[0], tau * uphill[1] + mid[1]];
        if n == 0 {
            z0 = tau * range + z_mid;
        }
    }

    // Weights of the edges: cross(point of the edge − level point, its direction).
    let (mut cross_u, mut cross_v) = ([zero; 3], [zero; 3]);
    for n in 0..3 {
        let from = [normal[0] - points[n][0], normal[1] - points[n][1]];
        cross_u[n] = from[0] * u[1] - from[1] * u[0];
        cross_v[n] = from[0] * v[1] - from[1] * v[0];
    }
    let half_z0 = z0.halved();
    let raised = [z_bounds[0] + half_z0, z_bounds[1] + half_z0];
    let mut sums = Sums {
        height: zero,
        area: [zero; 3],
        moment: [[zero; 2]; 3],
    };
    for a in 0..2 {
        let edge = &edges[i][a][side];
        let shift = f[j][a] * area_unit;
        let weight = if a == 0 {
            [cross_u[0] - shift, cross_u[1] - shift, cross_u[2] - shift]
        } else {
            [shift - cross_u[0], shift - cross_u[1], shift - cross_u[2]]
        };
        let border = Side {
            from: edge.enter[i].most(edge.enter[j]),
            to: edge.leave[i].least(edge.leave[j]),
            enter: edge.enter[k],
            leave: edge.leave[k],
            rises: rho[k][i],
            flat: flat[k][i],
            z: edge.start[k] + half_z0,
            half_slope: u_z.halved(),
            at: [edge.start[i], edge.start[j]],
            direction: u,
        };
        sums.add::<SLOPES, PIECES>(border, weight, raised, &points);
    }
    for b in 0..2 {
        let edge = &edges[j][side][b];
        let shift = f[i][b] * area_unit;
        let weight = if b == 1 {
            [cross_v[0] + shift, cross_v[1] + shift, cross_v[2] + shift]
        } else {
            [
                -shift - cross_v[0],
                -shift - cross_v[1],
                -shift - cross_v[2],
            ]
        };
        let border = Side {
            from: edge.enter[i].most(edge.enter[j]),
            to: edge.leave[i].least(edge.leave[j]),
            enter: edge.enter[k],
            leave: edge.leave[k],
            rises: rho[k][j],
            flat: flat[k][j],
            z: edge.start[k] + half_z0,
            half_slope: v_z.halved(),
            at: [edge.start[i], edge.start[j]],
            direction: v,
        };
        sums.add::<SLOPES, PIECES>(border, weight, raised, &points);
    }
    // Along a side of the rectangle z has the reciprocal slope −R_kk / R_jk or −R_kk / R_ik.
    let (bottom, top) = (&edges[i][0][side], &edges[i][1][side]);
    let (left, right) = (&edges[j][side][0], &edges[j][side][1]);
    for g in 0..2 {
        for n in 0..2 {
            // The side at x = bound g (n = 0) or at y = bound g (n = 1).
            let (own, other) = if n == 0 { (i, j) } else { (j, i) };
            let bound = if n == 0 { x_bounds[g] } else { y_bounds[g] };
            let along_bounds = if n == 0 { y_bounds } else { x_bounds };
            // Where the four edges of the face cross it.
            let (u_other, v_other) = if n == 0 { (u[1], v[1]) } else { (u[0], v[0]) };
            let low_u = bottom.at[own][g] * u_other + bottom.start[other];
            let high_u = top.at[own][g] * u_other + top.start[other];
            let low_v = left.at[own][g] * v_other + left.start[other];
            let high_v = right.at[own][g] * v_other + right.start[other];
            let (low, high, one_of, another) = if n == 0 {
                (low_u, high_u, low_v, high_v)
            } else {
                (low_v, high_v, low_u, high_u)
            };
            let from = along_bounds[0].most(low).most(one_of.least(another));
            let to = along_bounds[1].least(high).least(one_of.most(another));
            let z = slope[n] * bound + z_center;
            let per_slope = -(r[k][k] * rho[other][k]);
            let center = (along_bounds[0] + along_bounds[1]).halved();
            let center = S::select(flat[other][k], center, zero);
            let crossings = [
                (z_bounds[0] - z) * per_slope + center,
                (z_bounds[1] - z) * per_slope + center,
            ];
            let mut weight = [zero; 3];
            for m in 0..3 {
                let beyond = bound - points[m][n];
                weight[m] = if g == 1 { beyond } else { -beyond };
            }
            let border = Side {
                from,
                to,
                enter: crossings[0].least(crossings[1]),
                leave: crossings[0].most(crossings[1]),
                rises: -rho[other][k],
                flat: flat[other][k],
                z: z + half_z0,
                half_slope: slope[1 - n].halved(),
                at: if n == 0 { [bound, zero] } else { [zero, bound] },
                direction: if n == 0 { [zero, one] } else { [one, zero] },
            };
            let height = sums.add::<SLOPES, PIECES>(border, weight, raised, &points);
            if SLOPES {
                // What a's face gains when it moves outwards.
                let gain = height - half_z0 * (to.most(from) - from);
                let bar = if g == 1 {
                    &mut bounds.high[own]
                } else {
                    &mut bounds.low[own]
                };
                *bar = if side == g { *bar + gain } else { *bar - gain };
            }
        }
    }
    let (above, below) = (sums.area[1].halved(), sums.area[2].halved());
    let mut out = Face::none();
    out.thrice = (z_bounds[1] - z0) * above + ((z_bounds[0] - z0) * below + sums.height);
    if SLOPES {
        let all = sums.area[0].halved();
        let gain = |bar: S, area: S| if side == 1 { bar + area } else { bar - area };
        bounds.high[k] = gain(bounds.high[k], above);
        bounds.low[k] = gain(bounds.low[k], below);
        out.area = (all - above - below) * per;
        let mut moment = [zero; 2];
        for n in 0..2 {
            let own = sums.moment[0][n] - sums.moment[1][n] - sums.moment[2][n];
            let shift = points[0][n] * all - points[1][n] * above - points[2][n] * below;
            moment[n] = (own * S::lit(1.0 / 3.0) + shift) * per;
        }
        out.moment[i] = moment[0];
        out.moment[j] = moment[1];
        out.moment[k] = z_center * out.area + (slope[0] * moment[0] + slope[1] * moment[1]);
    }
    out
}

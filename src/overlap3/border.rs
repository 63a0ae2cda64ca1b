//! The border of one box of any orientation clamped to another: the volume they share, and its derivatives.
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
//! The primitives `x_k dx_i dx_j` (k, i, j in circular order) differ by exact forms. So each face of P may use the one
//! whose direction it faces most, if the differences are compensated along the edges and at the corners where faces
//! with different primitives meet. With X the clamped coordinates:
//!
//! ```text
//! V =  Σ faces (k, s)        s · ∫ clamp(x_k) dx_i dx_j   over the face seen along x_k, inside K's rectangle
//!    − Σ edges (m; s_j, s_l) s_j s_l · ∫ X_j X_l dX_m
//!    + Σ corners             s_0 s_1 s_2 · X_0 X_1 X_2
//! ```
//!
//! Every integrand is a polynomial between the points where a coordinate begins or ceases to be clamped. These
//! crossings are computed once per edge and shared by the faces that meet there, so that rounding cannot tear the
//! border.
//!
//! # Derivatives
//!
//! By the fundamental theorem the derivative by a move of P's face outwards is the area of that face inside K,
//! and by a turn its first moment; both come from the pieces of the faces' integrals. Derivatives by K's size
//! come from the parts of the integrals that are clamped to K's faces. Moving or turning both boxes
//! together changes nothing, which gives the rest.
//!
//! Its functions are internal; those of [`overlap3`](super) call them.
use super::edge_clamp::{BoundDerivatives, Cut, clamped, cut, less_signed, signed, turn};
use super::face_integral::{Face, face};
use super::relate::Relative3;
use super::volume_from_half;
use crate::{Mask, Scalar};

/// The volume that two related boxes share, in units of `1 / scale³`, and its derivatives in a's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shared3<S> {
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

/// The bounds of two boxes against each other, before the border of one is clamped to the other.
struct PairBounds<S: Scalar> {
    /// The most that they can share: each against the other's bounds in its own frame. Zero where one of the
    /// fifteen axes separates them.
    most: S,
    /// `true` where a lies in b, and touches none of its faces.
    a_inside: S::Mask,
    /// `true` where b lies in a, and touches none of its faces.
    b_inside: S::Mask,
}

/// Looks at the bounds of each box in the other's frame.
#[inline(always)]
fn glance<S: Scalar>(pair: &Relative3<S>) -> PairBounds<S> {
    let (r, c, h, p) = (pair.turn, pair.center, pair.half_a, pair.half_b);
    let zero = S::zero();
    let mut steep = [[zero; 3]; 3];
    for i in 0..3 {
        for m in 0..3 {
            steep[i][m] = r[i][m].unsigned();
        }
    }
    let (mut in_a, mut in_b) = (S::one(), S::one());
    let (mut a_inside, mut b_inside) = (zero.at_most(zero), zero.at_most(zero));
    // A face that is touched is a kink whose sides share the derivative; the faces' integrals detect it.
    let clear = S::lit(1.0 - 32.0 * S::format().epsilon());
    for i in 0..3 {
        let reach = (steep[i][0] * p[0] + steep[i][1] * p[1]) + steep[i][2] * p[2];
        b_inside = b_inside & (c[i].unsigned() + reach).below(h[i] * clear);
        let shared = (c[i] + reach).least(h[i]) - (c[i] - reach).most(-h[i]);
        in_a *= shared.most(zero);
        let reach = (steep[0][i] * h[0] + steep[1][i] * h[1]) + steep[2][i] * h[2];
        let center = (r[0][i] * c[0] + r[1][i] * c[1]) + r[2][i] * c[2];
        a_inside = a_inside & (center.unsigned() + reach).below(p[i] * clear);
        let shared = (center + reach).least(p[i]) - (center - reach).most(-p[i]);
        in_b *= shared.most(zero);
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
    let most = S::select(gap.above(zero), zero, in_a.least(in_b));
    // Rounding of a huge box's position may separate it from a box inside it.
    let own = volume_from_half(h).least(volume_from_half(p)).most(zero);
    PairBounds {
        most: S::select(a_inside | b_inside, own, most),
        a_inside,
        b_inside,
    }
}

/// Returns the volume that two related boxes share and, with `DERIVATIVE`, its derivatives. A straight line, except for
/// lanes of pairs all of which are apart.
///
/// `PIECES` keeps the repeated pieces functions of their own, which costs less to build and less stack;
/// without it all is one piece, as code for vector instructions must be.
#[inline(always)]
pub(crate) fn shared_volume<S: Scalar, const DERIVATIVE: bool, const PIECES: bool>(
    pair: &Relative3<S>,
) -> Shared3<S> {
    let zero = S::zero();
    let seen = glance(pair);
    let most = seen.most;
    let mut out = Shared3 {
        volume: zero,
        center: [zero; 3],
        turn: [zero; 3],
        half_a: [zero; 3],
        half_b: [zero; 3],
    };
    let apart = most.at_most(zero);
    if apart.all() {
        return same_box::<S, DERIVATIVE>(pair, out);
    }
    let (mut cut, origin) = cut(pair);
    let mut derivatives = Derivatives {
        from_center: [zero; 3],
        center: [zero; 3],
        turn: [zero; 3],
        half_b: [zero; 3],
        bounds: BoundDerivatives {
            high: [zero; 3],
            low: [zero; 3],
        },
    };
    for i in 0..3 {
        derivatives.from_center[i] = origin[i] - pair.center[i];
    }
    let (mut six, mut thrice) = (zero, zero);
    for _ in 0..3 {
        cut.turn();
        derivatives.turn();
        let mut both = Face::none();
        let mut all = zero;
        for side in 0..2 {
            let made = face::<S, DERIVATIVE, PIECES>(&cut, side, &mut derivatives.bounds);
            six += made.six;
            thrice = signed(thrice, side, made.thrice);
            if DERIVATIVE {
                all += made.area;
                both.area = signed(both.area, side, made.area);
                for n in 0..3 {
                    both.moment[n] = signed(both.moment[n], side, made.moment[n]);
                }
            }
        }
        if DERIVATIVE {
            derivatives.add(&cut, &both, all);
        }
    }
    let volume = thrice * S::lit(1.0 / 3.0) + (six * S::lit(1.0 / 6.0) + corners(&cut));
    out.volume = volume.most(zero).least(most);
    if DERIVATIVE {
        for i in 0..3 {
            let by_half = derivatives.bounds.high[i] - derivatives.bounds.low[i];
            out.center[i] = S::select(apart, zero, derivatives.center[i]);
            out.turn[i] = S::select(apart, zero, derivatives.turn[i]);
            out.half_a[i] = S::select(apart, zero, by_half);
            out.half_b[i] = S::select(apart, zero, derivatives.half_b[i]);
        }
    }
    nested::<S, DERIVATIVE>(pair, &seen, &mut out);
    same_box::<S, DERIVATIVE>(pair, out)
}

/// Returns the part of the volume that corners have: the product of their clamped coordinates, positive where an odd
/// number of sides is upper ones.
#[inline(always)]
fn corners<S: Scalar>(cut: &Cut<S>) -> S {
    let mut sum = S::zero();
    for a in 0..2 {
        for b in 0..2 {
            let mut ends = [S::one(); 2];
            for i in 0..3 {
                let start = cut.f[1][a] * cut.r[i][1] + cut.f[2][b] * cut.r[i][2];
                let [low, high] = cut.k[i];
                ends[0] *= clamped(cut.f[0][0] * cut.r[i][0] + start, low, high);
                ends[1] *= clamped(cut.f[0][1] * cut.r[i][0] + start, low, high);
            }
            sum = less_signed(sum, a, b, ends[0] - ends[1]);
        }
    }
    sum
}

/// Derivatives as they are summed, under the names of axes that [`Cut::turn`] gives.
struct Derivatives<S> {
    /// From the centre of b to the common origin.
    from_center: [S; 3],
    /// By the centre of b, a turn of b about it, and half the size of b.
    center: [S; 3],
    turn: [S; 3],
    half_b: [S; 3],
    bounds: BoundDerivatives<S>,
}

impl<S: Scalar> Derivatives<S> {
    #[inline(always)]
    fn turn(&mut self) {
        turn(&mut self.from_center);
        turn(&mut self.center);
        turn(&mut self.turn);
        turn(&mut self.half_b);
        self.bounds.turn();
    }

    /// Adds the derivatives by the two faces across axis 2: the upper one's area and moment less those of the lower
    /// one, and the area of both.
    #[inline(always)]
    fn add(&mut self, cut: &Cut<S>, both: &Face<S>, all: S) {
        self.half_b[2] = all;
        let normal = [cut.r[0][2], cut.r[1][2], cut.r[2][2]];
        let mut moment = [S::zero(); 3];
        for i in 0..3 {
            self.center[i] += both.area * normal[i];
            moment[i] = both.area * self.from_center[i] + both.moment[i];
        }
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            self.turn[i] += moment[j] * normal[l] - moment[l] * normal[j];
        }
    }
}

/// Gives a box inside the other exactly its volume, which only its own sizes change. The integrals over the
/// border of a box of a thousand times its size would lose three digits of it.
#[inline(always)]
fn nested<S: Scalar, const DERIVATIVE: bool>(
    pair: &Relative3<S>,
    seen: &PairBounds<S>,
    out: &mut Shared3<S>,
) {
    let (h, p, zero) = (pair.half_a, pair.half_b, S::zero());
    // Boxes without volume share no more when one of them alone grows.
    let solid = seen.most.above(zero);
    let (a, b) = (seen.a_inside & solid, seen.b_inside & solid);
    out.volume = S::select(a, volume_from_half(h), out.volume);
    out.volume = S::select(b, volume_from_half(p), out.volume);
    if DERIVATIVE {
        for i in 0..3 {
            out.center[i] = S::select(a | b, zero, out.center[i]);
            out.turn[i] = S::select(a | b, zero, out.turn[i]);
            out.half_a[i] = S::select(a, by_half(h, i), S::select(b, zero, out.half_a[i]));
            out.half_b[i] = S::select(b, by_half(p, i), S::select(a, zero, out.half_b[i]));
        }
    }
}

/// Returns the derivative of a box's volume by half of one of its sizes.
#[inline(always)]
fn by_half<S: Scalar>(half: [S; 3], i: usize) -> S {
    let (j, l) = ((i + 1) % 3, (i + 2) % 3);
    let face = (half[j] + half[j]) * (half[l] + half[l]);
    face + face
}

/// Returns the overlap of boxes that are one set of points: exactly their volume, each size with half the derivative,
/// and no derivative by motion, by symmetry. Boxes without volume have no derivatives at all.
#[inline(always)]
fn same_box<S: Scalar, const DERIVATIVE: bool>(
    pair: &Relative3<S>,
    found: Shared3<S>,
) -> Shared3<S> {
    let (same, h, zero) = (pair.same, pair.half_a, S::zero());
    // The volume is computed from both boxes, so that derivatives through this value are shared, too.
    let p = pair.half_b;
    let whole = (h[0] + p[0]) * (h[1] + p[1]) * (h[2] + p[2]);
    // Boxes without volume share no more when one of them alone grows.
    let flat = whole.at_most(zero);
    let whole = S::select(flat, zero, whole);
    let mut out = found;
    out.volume = S::select(same, whole, found.volume);
    if DERIVATIVE {
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            let face = (h[j] + h[j]) * (h[l] + h[l]);
            let face = S::select(flat, zero, face);
            out.center[i] = S::select(same, zero, found.center[i]);
            out.turn[i] = S::select(same, zero, found.turn[i]);
            out.half_a[i] = S::select(same, face, found.half_a[i]);
            out.half_b[i] = S::select(same, face, found.half_b[i]);
        }
    }
    out
}

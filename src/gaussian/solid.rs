//! The same in space, for boxes of any orientation. Upright boxes come as [`Obb3::from`].
//!
//! With `D_ij = R_ij²` from the rotation R between the boxes, traces and determinants are sums over D with
//! terms that are not negative; what would cancel for similar boxes is taken out by hand. The axes of the
//! second box are renamed first so that R is as small as it can be.
#![expect(
    clippy::needless_range_loop,
    reason = "indices are axes, shared by several arrays"
)]
use super::smooth::{excess, ln_one_plus};
use super::{fused, similarity, unit};
use crate::overlap3::relate::relate3;
use crate::shape::{Obb3, Rotation3};
use crate::{Scalar, Vec3};

/// Two Gaussians of space seen from the first, in units of `1 / scale`.
struct Pair<S: Scalar> {
    /// From the first mean to the second, in the first one's frame and in the second one's.
    offset: [S; 3],
    offset_b: [S; 3],
    /// Standard deviations.
    a: [S; 3],
    b: [S; 3],
    /// The rotation.
    turn: [[S; 3]; 3],
    /// The power of two by which lengths were multiplied.
    scale: S,
    /// Where both boxes are the same.
    same: S::Mask,
}

#[inline(always)]
fn largest<S: Scalar>(v: [S; 3]) -> S::Primal {
    let v = v.map(|x| x.primal().magnitude());
    v[0].most(v[1]).most(v[2])
}

fn pair<S: Scalar, const FLOOR: bool>(a: Obb3<S>, b: Obb3<S>, deviation: f64) -> Pair<S> {
    let between = b.center - a.center;
    let most = |v: Vec3<S>| v.x.most(v.y).most(v.z);
    let (scale, least) = unit(most(a.size).most(most(b.size)).most(between.length()));
    let sizes = |v: Vec3<S>| [v.x * scale, v.y * scale, v.z * scale];
    let floored = |v: [S; 3]| [v[0].most(least), v[1].most(least), v[2].most(least)];
    let (own, other) = (sizes(a.size), sizes(b.size));
    let (full, full_other) = (floored(own), floored(other));
    // The rotation and the names of axes do not depend on sizes: those that are bounded keep every unit finite.
    let made = |center: Vec3<S>, [x, y, z]: [S; 3], rotation: Rotation3<S>| {
        Obb3::new(center, Vec3::new(x, y, z), rotation)
    };
    let related = relate3(
        made(Vec3::zero(), full, a.rotation),
        made(between * scale, full_other, b.rotation),
    );
    let (own, other) = if FLOOR {
        (full, full_other)
    } else {
        (own, other)
    };
    let other = related.renamed.rename(other);
    let offset = related.center.map(|x| x.over(related.scale));
    let turn = related.turn;
    let mut offset_b = [S::zero(); 3];
    for m in 0..3 {
        offset_b[m] = (turn[0][m] * offset[0] + turn[1][m] * offset[1]) + turn[2][m] * offset[2];
    }
    let alike = own[0].equals(other[0]) & own[1].equals(other[1]) & own[2].equals(other[2]);
    let deviations = |v: [S; 3]| v.map(|x| x * S::lit(deviation));
    Pair {
        offset,
        offset_b,
        a: deviations(own),
        b: deviations(other),
        turn,
        scale,
        same: related.same & alike,
    }
}

/// The orthogonal matrix nearest to a matrix of positive determinant, as a constant: the rotation that
/// aligns one cloud with another.
///
/// Newton's iteration `X ← ½ (γ X + X⁻ᵀ / γ)` with Higham's scaling γ; nine steps reach rounding from any
/// matrix that sizes of [`Scalar::EPSILON`] to one can make, three more are room.
fn nearest_rotation<S: Scalar>(mut x: [[S::Primal; 3]; 3]) -> [[S; 3]; 3] {
    let zero = S::Primal::zero();
    for _ in 0..12 {
        let mut cofactor = [[zero; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                let (p, q) = ((i + 1) % 3, (i + 2) % 3);
                let (s, t) = ((j + 1) % 3, (j + 2) % 3);
                cofactor[i][j] = x[p][s] * x[q][t] - x[p][t] * x[q][s];
            }
        }
        let det = x[0][0] * cofactor[0][0] + x[0][1] * cofactor[0][1] + x[0][2] * cofactor[0][2];
        let flat = det.at_most(S::Primal::lit(S::EMPTY));
        let det = S::Primal::select(flat, S::Primal::one(), det);
        let norm = |m: &[[S::Primal; 3]; 3]| {
            let mut sum = zero;
            for row in m {
                for &entry in row {
                    sum += entry * entry;
                }
            }
            sum.root()
        };
        // γ = √(‖X⁻¹‖ / ‖X‖).
        let gamma = norm(&cofactor).over(det).over(norm(&x)).root();
        let back = S::Primal::one().over(gamma).over(det);
        for i in 0..3 {
            for j in 0..3 {
                let next = (x[i][j] * gamma + cofactor[i][j] * back).halved();
                x[i][j] = S::Primal::select(flat, x[i][j], next);
            }
        }
    }
    x.map(|row| row.map(S::from_primal))
}

fn squared_distance<S: Scalar>(pair: &Pair<S>) -> S {
    // The trace of Σa + Σb − 2 (√Σa Σb √Σa)^½ is the least ‖√Σa − √Σb Q‖² over all rotations Q: a sum of
    // squares. At the best Q slopes by Q vanish, so Q is a constant.
    let turn = &pair.turn;
    let (zero, one) = (S::Primal::zero(), S::Primal::one());
    let least = S::Primal::lit(S::EPSILON);
    let size = largest(pair.a).most(largest(pair.b)) * least;
    let size = S::from_primal(S::Primal::select(size.at_most(zero), one, size));
    let mut aligned = [[S::zero(); 3]; 3];
    for m in 0..3 {
        for i in 0..3 {
            aligned[m][i] = (turn[i][m] * pair.b[m].most(size)) * pair.a[i].most(size);
        }
    }
    let best = nearest_rotation::<S>(aligned.map(|row| row.map(S::primal)));
    let mut sum = S::zero();
    for i in 0..3 {
        sum += pair.offset[i].squared();
        for j in 0..3 {
            // Row i, column j of diag(a) − R diag(b) Q.
            let mut entry = if i == j { pair.a[i] } else { S::zero() };
            for m in 0..3 {
                entry -= turn[i][m] * pair.b[m] * best[m][j];
            }
            sum += entry.squared();
        }
    }
    sum - gain(&aligned, &best)
}

/// What moving the best rotation Q along with the pair takes from the sum of squares: nothing here, and no
/// slope, but a second derivative.
///
/// With `K = Qᵀ M`, symmetric where Q is the best, a further turn ω changes `⟨M, Q⟩` by `ω · v − ½ ωᵀ P ω`,
/// where v is twice the skew part of K and `P = tr K − K`; the best ω gains `½ vᵀ P⁻¹ v` of it, so twice that
/// of the sum. Zero where P cannot be inverted: boxes without thickness in two directions.
fn gain<S: Scalar>(aligned: &[[S; 3]; 3], best: &[[S; 3]; 3]) -> S {
    let mut k = [[S::zero(); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            for m in 0..3 {
                k[i][j] += best[m][i] * aligned[m][j];
            }
        }
    }
    let p = k.map(|row| row.map(S::primal));
    let trace = p[0][0] + p[1][1] + p[2][2];
    let [d0, d1, d2] = [trace - p[0][0], trace - p[1][1], trace - p[2][2]];
    let off = |i: usize, j: usize| -(p[i][j] + p[j][i]).halved();
    let (e0, e1, e2) = (off(1, 2), off(2, 0), off(0, 1));
    // The inverse of P by its cofactors.
    let (c00, c11, c22) = (d1 * d2 - e0 * e0, d2 * d0 - e1 * e1, d0 * d1 - e2 * e2);
    let (c12, c20, c01) = (e1 * e2 - d0 * e0, e2 * e0 - d1 * e1, e0 * e1 - d2 * e2);
    let det = d0 * c00 + e2 * c01 + e1 * c20;
    let flat = det.at_most(S::Primal::lit(S::EPSILON) * (trace * trace) * trace);
    let per = S::Primal::select(flat, S::Primal::one(), det);
    let per = S::Primal::select(flat, S::Primal::zero(), S::Primal::one().over(per));
    let still = |x: S| x.with_primal(S::Primal::zero());
    let v = [
        still(k[2][1] - k[1][2]),
        still(k[0][2] - k[2][0]),
        still(k[1][0] - k[0][1]),
    ];
    let inverse = [[c00, c01, c20], [c01, c11, c12], [c20, c12, c22]];
    let mut sum = S::zero();
    for i in 0..3 {
        for j in 0..3 {
            sum += v[i] * v[j] * S::from_primal(inverse[i][j] * per);
        }
    }
    sum
}

/// The square of [`wasserstein`], in squared units of length.
#[must_use]
#[inline]
pub fn wasserstein_squared<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let pair = pair::<S, false>(a, b, 0.5);
    let value = squared_distance(&pair);
    value
        .over(pair.scale)
        .over(pair.scale)
        .saturated()
        .canonical()
}

/// Wasserstein's distance of two boxes as Gaussians, a length. Slope zero for identical ones. Derivatives
/// above the second are not served.
///
/// ```
/// use geograd::{Vec3, gaussian::solid, shape::{Obb3, Rotation3}};
/// let a = Obb3::new(
///     Vec3::new(0.0, 0.0, 0.0),
///     Vec3::new(4.0, 2.0, 1.0),
///     Rotation3::new(0.9_f64, 0.1, 0.2, 0.3),
/// );
/// let moved = Obb3 { center: Vec3::new(2.0, 3.0, 6.0), ..a };
/// assert!(solid::wasserstein(a, a) == 0.0);
/// assert!((solid::wasserstein(a, moved) - 7.0).abs() < 1e-14);
/// ```
#[must_use]
#[inline]
pub fn wasserstein<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let pair = pair::<S, false>(a, b, 0.5);
    let value = squared_distance(&pair).root();
    let value = S::select(pair.same, S::zero(), value);
    value.over(pair.scale).saturated().canonical()
}

/// The Kullback-Leibler divergence of box a from box b as Gaussians, `KL(a ‖ b)`, from 0.
#[must_use]
#[inline]
pub fn kullback_leibler<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    divergence(&pair::<S, true>(a, b, 0.5))
        .saturated()
        .canonical()
}

/// `½ (dᵀ Σb⁻¹ d + tr(Σb⁻¹ Σa) − 3 − ln det(Σb⁻¹ Σa))`, where the trace is
/// `Σ a_k²/b_k² + Σ_{i≠j} D_ij a_i² (1/b_j² − 1/b_i²)`.
#[inline(always)]
fn divergence<S: Scalar>(pair: &Pair<S>) -> S {
    let (a, b) = (pair.a, pair.b);
    let mut sum = S::zero();
    for k in 0..3 {
        sum += pair.offset_b[k].over(b[k]).squared() + excess(a[k], b[k]);
    }
    for i in 0..3 {
        for j in 0..3 {
            if i != j {
                let tilt = (pair.turn[i][j] * a[i]).over(b[j]).squared();
                let sizes = (b[i] - b[j]).over(b[i]) * (b[i] + b[j]).over(b[i]);
                sum += tilt * sizes;
            }
        }
    }
    sum.halved()
}

/// Jeffreys' divergence of two boxes as Gaussians, `KL(a ‖ b) + KL(b ‖ a)`, from 0: symmetric.
#[must_use]
#[inline]
pub fn jeffreys<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let (forth, back) = (pair::<S, true>(a, b, 0.5), pair::<S, true>(b, a, 0.5));
    (divergence(&forth) + divergence(&back))
        .saturated()
        .canonical()
}

/// The mean of both Kullback-Leibler divergences, from 0: half of [`jeffreys`].
#[must_use]
#[inline]
pub fn kullback_leibler_mean<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    jeffreys(a, b).halved()
}

/// How much larger `det(Σa + Σb)` is than the product of all `a_k² + b_k²`, relative to that product, which
/// is what it would be if the axes agreed; and the lengths `√(a_k² + b_k²)`.
///
/// By Cauchy and Binet the determinant is `Π a² + Π b² + Σ_ij D_ij G_ij`, where `G_ij` is the product of the
/// squares of b_j and of both a but a_i, plus that of a_i and of both b but b_j. Each column of D sums to
/// one, so the part of `G_jj` can be taken out of column j.
fn twist<S: Scalar>(pair: &Pair<S>) -> (S, [S; 3]) {
    let (a, b) = (pair.a, pair.b);
    let length = [a[0].hypot(b[0]), a[1].hypot(b[1]), a[2].hypot(b[2])];
    let mut sum = S::zero();
    for j in 0..3 {
        for i in 0..3 {
            if i == j {
                continue;
            }
            let l = 3 - i - j;
            // G_ij − G_jj = (a_j² − a_i²)(a_l² b_j² − b_i² b_l²), over (length_i length_j length_l)².
            let own = (a[j] - a[i]).over(length[j]) * (a[j] + a[i]).over(length[i]);
            let (p, q) = (a[l] * b[j], b[i] * b[l]);
            let mixed =
                (p - q).over(length[l]).over(length[j]) * (p + q).over(length[l]).over(length[i]);
            sum += pair.turn[i][j].squared() * (own * mixed);
        }
    }
    (sum, length)
}

/// Bhattacharyya's distance of two boxes as Gaussians, from 0.
#[must_use]
#[inline]
pub fn bhattacharyya<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    distance(&pair::<S, true>(a, b, 0.5))
        .saturated()
        .canonical()
}

/// `⅛ dᵀ Σ⁻¹ d + ½ ln (det Σ / √(det Σa det Σb))` with the mean Σ of both covariances. `Σa + Σb` is a sum of
/// six squares of vectors x (deviations along axes), so its adjugate is the sum of the squares of all cross
/// products of two of them: `dᵀ adj d = Σ (d · (x × y))²`.
fn distance<S: Scalar>(pair: &Pair<S>) -> S {
    let (a, b, d, e, r) = (pair.a, pair.b, pair.offset, pair.offset_b, pair.turn);
    let (twist, length) = twist(pair);
    let mut shape = ln_one_plus(twist);
    for k in 0..3 {
        let difference = a[k] - b[k];
        let apart = (difference.over(a[k]) * difference.over(b[k])).halved();
        shape += ln_one_plus(apart);
    }
    let per = |x: S| x.over(length[0]).over(length[1]).over(length[2]).squared();
    let mut form = S::zero();
    for i in 0..3 {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        form += per(a[j] * a[l] * d[i]) + per(b[j] * b[l] * e[i]);
        for m in 0..3 {
            // a's axis i cross b's axis m.
            let volume = d[l] * r[j][m] - d[j] * r[l][m];
            form += per(a[i] * b[m] * volume);
        }
    }
    let far = form.over(S::one() + twist);
    far.halved().halved() + shape.halved()
}

/// One minus Hellinger's distance of two boxes as Gaussians of even spread, in `[0, 1]`: 1 for identical
/// ones. Slope zero there.
#[must_use]
#[inline]
pub fn probiou<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    similarity(distance(&pair::<S, true>(a, b, (1.0 / 12.0_f64).sqrt())))
}

/// The overlap of two boxes as Gaussians when they are fused as a Kalman filter does, over their union, in
/// `[0, 1 / (2√8 − 1)]`. The centres do not count.
#[must_use]
#[inline]
pub fn kfiou<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let pair = pair::<S, true>(a, b, 0.5);
    let (twist, length) = twist(&pair);
    let root = (S::one() + twist).root();
    let share = |v: [S; 3]| {
        let product = v[0].over(length[0]) * v[1].over(length[1]) * v[2].over(length[2]);
        product.over(root)
    };
    fused(share(pair.b), share(pair.a))
}

//! Boxes as Gaussians in space, for boxes of any orientation. Upright boxes are converted by [`Obb3::from`].
//!
//! With `D_ij = R_ij²` from the rotation R between the boxes, traces and determinants are sums over D with terms that
//! are not negative; terms that would cancel for similar boxes are removed by hand. The axes of the second box are
//! renamed first so that R is as small as it can be.
use super::smooth::{excess, ln_one_plus};
pub use super::solid_wasserstein::{wasserstein, wasserstein_squared};
use super::{finite_derivatives, fused, similarity, unit};
use crate::arrays::Each;
use crate::overlap3::relate::relate3;
use crate::scalar::{least_of, most_of};
use crate::shape::{Obb3, Rotation3};
use crate::{Scalar, Vec3};

/// Two Gaussians of space in the frame of the first, in units of `1 / scale`.
struct GaussianPair3<S: Scalar> {
    /// From the first mean to the second, in the first one's frame and in the second one's.
    offset: [S; 3],
    offset_b: [S; 3],
    /// Standard deviations.
    a: [S; 3],
    b: [S; 3],
    /// The rotation.
    turn: [[S; 3]; 3],
}

fn pair<S: Scalar>(a: Obb3<S>, b: Obb3<S>, deviation: f64) -> GaussianPair3<S> {
    let between = b.center - a.center;
    let between = Vec3::new(
        between.x.saturated(),
        between.y.saturated(),
        between.z.saturated(),
    );
    let most = |v: Vec3<S>| most_of([v.x, v.y, v.z]);
    let quarter = S::lit(0.25);
    let way = Vec3::new(
        between.x * quarter,
        between.y * quarter,
        between.z * quarter,
    );
    let (scale, least) = unit(most_of([
        most(a.size) * quarter,
        most(b.size) * quarter,
        way.length(),
    ]));
    let sizes = |v: Vec3<S>| [v.x, v.y, v.z].each_as(|x| (x * scale).most(least));
    let (own, other) = (sizes(a.size), sizes(b.size));
    let held = finite_derivatives(scale, least_of(own).least(least_of(other)));
    let (own, other) = (own.each_as(&held), other.each_as(&held));
    let between = Vec3::new(between.x * scale, between.y * scale, between.z * scale);
    // A displacement of 2⁻⁹⁰ of the largest length counts as zero: units in which it is long have no finite
    // derivatives. Scores have second derivatives by it there.
    let long = most_of([
        between.x.unsigned(),
        between.y.unsigned(),
        between.z.unsigned(),
    ]);
    let none = long.below(S::lit(1.0 / (1_u128 << 90) as f64));
    let still = |x: S| S::select(none, x.with_primal(S::Primal::zero()), x);
    let seen = |x: S| held(still(x));
    let between = Vec3::new(seen(between.x), seen(between.y), seen(between.z));
    let made = |center: Vec3<S>, [x, y, z]: [S; 3], rotation: Rotation3<S>| {
        Obb3::new(center, Vec3::new(x, y, z), rotation)
    };
    let related = relate3(
        made(Vec3::zero(), own, a.rotation),
        made(between, other, b.rotation),
    );
    let other = related.renamed.rename(other);
    let offset = related.center.each_as(|x| x.over(related.scale));
    let turn = related.turn;
    let mut offset_b = [S::zero(); 3];
    for m in 0..3 {
        offset_b[m] = (turn[0][m] * offset[0] + turn[1][m] * offset[1]) + turn[2][m] * offset[2];
    }
    let deviations = |v: [S; 3]| v.each_as(|x| x * S::lit(deviation));
    GaussianPair3 {
        offset,
        offset_b,
        a: deviations(own),
        b: deviations(other),
        turn,
    }
}

/// Returns the Kullback-Leibler divergence of box a from box b as Gaussians, `KL(a ‖ b)`, from 0.
#[must_use]
#[inline]
pub fn kullback_leibler<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    divergence(&pair(a, b, 0.5)).saturated().canonical()
}

/// Returns `½ (dᵀ Σb⁻¹ d + tr(Σb⁻¹ Σa) − 3 − ln det(Σb⁻¹ Σa))`, where the trace is
/// `Σ a_k²/b_k² + Σ_{i≠j} D_ij a_i² (1/b_j² − 1/b_i²)`.
#[inline(always)]
fn divergence<S: Scalar>(pair: &GaussianPair3<S>) -> S {
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

/// Returns the Jeffreys' divergence of two boxes as Gaussians, `KL(a ‖ b) + KL(b ‖ a)`, from 0: symmetric.
#[must_use]
#[inline]
pub fn jeffreys<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let (forth, back) = (pair(a, b, 0.5), pair(b, a, 0.5));
    (divergence(&forth) + divergence(&back))
        .saturated()
        .canonical()
}

/// Returns the mean of both Kullback-Leibler divergences, from 0: half of [`jeffreys`].
#[must_use]
#[inline]
pub fn kullback_leibler_mean<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    jeffreys(a, b).halved()
}

/// Returns the relative excess of `det(Σa + Σb)` over the product of all `a_k² + b_k²`, which it would equal if the
/// axes agreed; and the lengths `√(a_k² + b_k²)`.
///
/// By Cauchy and Binet the determinant is `Π a² + Π b² + Σ_ij D_ij G_ij`, where `G_ij` is the product of the
/// squares of b_j and of both a but a_i, plus that of a_i and of both b but b_j. Each column of D sums to
/// one, so the part of `G_jj` can be taken out of column j.
fn twist<S: Scalar>(pair: &GaussianPair3<S>) -> (S, [S; 3]) {
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

/// Returns the Bhattacharyya distance of two boxes as Gaussians, from 0.
#[must_use]
#[inline]
pub fn bhattacharyya<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    distance(&pair(a, b, 0.5)).saturated().canonical()
}

/// Returns `⅛ dᵀ Σ⁻¹ d + ½ ln (det Σ / √(det Σa det Σb))` with the mean Σ of both covariances. `Σa + Σb` is a sum of
/// six squares of vectors x (deviations along axes). Its adjugate is therefore the sum of the squares of all cross
/// products of two of them: `dᵀ adj d = Σ (d · (x × y))²`.
fn distance<S: Scalar>(pair: &GaussianPair3<S>) -> S {
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

/// Returns one minus the Hellinger distance of two boxes as Gaussians, each with the covariance of a uniform
/// distribution over its box, in `[0, 1]`: 1 for identical ones, with derivative zero.
#[must_use]
#[inline]
pub fn probiou<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    similarity(distance(&pair(a, b, (1.0 / 12.0_f64).sqrt())))
}

/// Returns the overlap of two boxes as Gaussians when they are fused as a Kalman filter does, over their union, in
/// `[0, 1 / (2√8 − 1)]`. The centres do not count.
#[must_use]
#[inline]
pub fn kfiou<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let pair = pair(a, b, 0.5);
    let (twist, length) = twist(&pair);
    let root = (S::one() + twist).root();
    let share = |v: [S; 3]| {
        let product = v[0].over(length[0]) * v[1].over(length[1]) * v[2].over(length[2]);
        product.over(root)
    };
    fused(share(pair.b), share(pair.a))
}

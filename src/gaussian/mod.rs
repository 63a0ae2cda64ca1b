//! Boxes as Gaussians: distances and losses that have derivatives for boxes apart, too.
//!
//! A box stands for the Gaussian with its centre as mean and, along its own axes, half its sizes as standard
//! deviations; [`probiou`] alone takes those of a uniform distribution over the box, `size / √12`, as its paper does.
//! All are in closed forms of sizes and angles, arranged so that nothing cancels: sums of terms that are not negative,
//! where products of matrices and determinants would lose the difference of similar boxes. Two-dimensional functions
//! are in this module, three-dimensional ones in [`solid`].
//!
//! | function | of | range | paper |
//! | --- | --- | --- | --- |
//! | [`wasserstein`] | distance, a length | `[0, ∞)` | Yang et al., *Rethinking rotated object detection with Gaussian Wasserstein distance loss*, ICML 2021 |
//! | [`kullback_leibler`], [`jeffreys`] | divergence | `[0, ∞)` | Yang et al., *Learning high-precision bounding box for rotated object detection via Kullback-Leibler divergence*, NeurIPS 2021 |
//! | [`bhattacharyya`] | distance | `[0, ∞)` | the same |
//! | [`probiou`] | similarity, one minus Hellinger's distance | `[0, 1]` | Llerena et al., *Gaussian bounding boxes and probabilistic intersection-over-union for object detection*, 2021 |
//! | [`kfiou`] | similarity of shapes, blind to the centres | `[0, 1/3]` | Yang et al., *The KFIoU loss for rotated object detection*, ICLR 2023 |
//!
//! A square is a circle as a Gaussian, so its heading has no derivative.
//!
//! Wasserstein's distance takes sizes and the distance of the centres each in a unit of its own: none costs another
//! one digits, however far apart they are.
//!
//! Except for Wasserstein's distance, sizes count as at least 2⁻²³ of the largest length of the pair: of all sizes and
//! the distance of the centres. So boxes of zero size are allowed, sides up to eight million times as long as others
//! are exact, and all results are finite in every format. Derivatives go through that bound, too: by the largest
//! length.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Derivatives are zero where they could exceed the largest number. These are derivatives by lengths of pairs that are
//! both thin and near the smallest numbers (in `f32` 10⁶ times as long as thick and below 10⁻¹⁷). They are also those
//! of Wasserstein's distance by rotations of sizes near the largest numbers, or near the root of them for its square.
//!
//! Kinks: [`wasserstein`] and [`probiou`] at identical Gaussians (derivative zero). The others are smooth, except where
//! a size meets that bound, and where all lengths are zero: there boxes count as identical.
use crate::{Obb2, Rotation2, Scalar, Vec2};

mod lengths;
pub mod smooth;
pub mod solid;
mod solid_wasserstein;
mod wasserstein;

pub use wasserstein::{wasserstein, wasserstein_squared};

use smooth::{excess, exp_minus_one, ln_one_plus};

/// Two Gaussians of the plane in the frame of the first, in units of `1 / scale`.
struct GaussianPair<S> {
    /// From the first mean to the second, in the first one's frame and in the second one's.
    offset: Vec2<S>,
    offset_b: Vec2<S>,
    /// Standard deviations.
    a: Vec2<S>,
    b: Vec2<S>,
    /// The square of the sine of the angle between the axes, where the axes of b are named so that the larger
    /// deviations of both are on one axis.
    sin2: S,
}

/// The least size, as a share of the largest size or distance of a pair: 2⁻²³, in every format.
const LEAST: f64 = 1.0 / (1_u32 << 23) as f64;

/// Returns the power of two by which the lengths of a pair are multiplied, from a quarter of the largest one (so that
/// it is finite), and the least size in that unit; where all lengths are zero the least size is one.
#[inline(always)]
fn unit<S: Scalar>(quarter: S) -> (S, S) {
    let none = quarter.at_most(S::zero());
    let scale = S::select(none, S::one(), quarter).binade();
    let least = quarter * scale * S::lit(LEAST);
    let scale = S::select(none, S::one(), scale * S::lit(0.25));
    (scale, S::select(none, S::one(), least))
}

/// Returns a length, or a constant if derivatives by lengths might not be finite: they grow as the unit's scale times
/// the third power of the reciprocal of the smallest size. A function of the scale and that size.
#[inline(always)]
fn finite_derivatives<S: Scalar>(scale: S, smallest: S) -> impl Fn(S) -> S + use<S> {
    let per = S::Primal::one().over(smallest.primal());
    let steep = ((scale.primal() * per) * (per * per))
        .above(S::Primal::lit(S::format().largest() / 1024.0));
    move |x: S| S::select(steep, S::from_primal(x.primal()), x)
}

/// Brings a pair into a common unit.
fn pair<S: Scalar>(a: Obb2<S>, b: Obb2<S>, deviation: f64) -> GaussianPair<S> {
    let between = b.center - a.center;
    let between = Vec2::new(between.x.saturated(), between.y.saturated());
    let sizes = a.size.x.most(a.size.y).most(b.size.x.most(b.size.y));
    let quarter = S::lit(0.25);
    let (scale, least) = unit((sizes * quarter).most((between * quarter).length()));
    let deviations = |v: Vec2<S>| {
        let v = v * scale;
        Vec2::new(v.x.most(least), v.y.most(least)) * S::lit(deviation)
    };
    let (own, other) = (deviations(a.size), deviations(b.size));
    let held = finite_derivatives(scale, own.x.least(own.y).least(other.x.least(other.y)));
    let held = |v: Vec2<S>| Vec2::new(held(v.x), held(v.y));
    let (own, other) = (held(own), held(other));
    let (axes_a, axes_b) = (
        Rotation2::from_angle(a.heading),
        Rotation2::from_angle(b.heading),
    );
    let between = held(between * scale);
    let turn = axes_a.inverse() * axes_b;
    let crossed = ((own.x - own.y) * (other.x - other.y)).below(S::zero());
    let exchange = |x: S, y: S| S::select(crossed, y, x);
    let offset_b = axes_b.inverse() * between;
    GaussianPair {
        offset: axes_a.inverse() * between,
        offset_b: Vec2::new(
            exchange(offset_b.x, offset_b.y),
            exchange(offset_b.y, offset_b.x),
        ),
        a: own,
        b: Vec2::new(exchange(other.x, other.y), exchange(other.y, other.x)),
        sin2: exchange(turn.sin, turn.cos).squared(),
    }
}

/// Returns the Kullback-Leibler divergence of box a from box b as Gaussians, `KL(a ‖ b)`, from 0.
///
/// `½ (dᵀ Σb⁻¹ d + f(a₁²/b₁²) + f(a₂²/b₂²) + sin² (a₁²−a₂²)(b₁²−b₂²) / (b₁² b₂²))` with
/// `f(r) = r − 1 − ln r`.
///
/// ```
/// use geograd::{Obb2, gaussian::kullback_leibler};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.3_f64);
/// assert_eq!(kullback_leibler(a, a), 0.0);
/// assert!(kullback_leibler(a, Obb2::new(1.0, 0.0, 4.0, 2.0, 0.3)) > 0.1);
/// ```
#[must_use]
#[inline]
pub fn kullback_leibler<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    divergence(&pair(a, b, 0.5)).saturated().canonical()
}

#[inline(always)]
fn divergence<S: Scalar>(pair: &GaussianPair<S>) -> S {
    let (a, b, d) = (pair.a, pair.b, pair.offset_b);
    let far = d.x.over(b.x).squared() + d.y.over(b.y).squared();
    let sizes = excess(a.x, b.x) + excess(a.y, b.y);
    let anisotropy_a = ((a.x - a.y).over(b.x)) * ((a.x + a.y).over(b.y));
    let anisotropy_b = ((b.x - b.y).over(b.x)) * ((b.x + b.y).over(b.y));
    (far + (sizes + pair.sin2 * (anisotropy_a * anisotropy_b))).halved()
}

/// Returns the Jeffreys' divergence of two boxes as Gaussians, `KL(a ‖ b) + KL(b ‖ a)`, from 0: symmetric.
#[must_use]
#[inline]
pub fn jeffreys<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (forth, back) = (pair(a, b, 0.5), pair(b, a, 0.5));
    (divergence(&forth) + divergence(&back))
        .saturated()
        .canonical()
}

/// Returns the mean of both Kullback-Leibler divergences, from 0: half of [`jeffreys`].
#[must_use]
#[inline]
pub fn kullback_leibler_mean<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    jeffreys(a, b).halved()
}

/// Returns the Bhattacharyya distance of two boxes as Gaussians, from 0.
///
/// `⅛ dᵀ Σ⁻¹ d + ½ ln (det Σ / √(det Σa det Σb))` with the mean Σ of both covariances. The logarithm is the
/// sum of those of `1 + (a−b)²/(2ab)`, once for each axis, and of `1 + sin² (a₁²−a₂²)(b₁²−b₂²) / ((a₁²+b₁²)
/// (a₂²+b₂²))`.
#[must_use]
#[inline]
pub fn bhattacharyya<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    distance(&pair(a, b, 0.5)).saturated().canonical()
}

#[inline(always)]
fn distance<S: Scalar>(pair: &GaussianPair<S>) -> S {
    let (a, b) = (pair.a, pair.b);
    let (d, e) = (pair.offset, pair.offset_b);
    // (a₁²+b₁²)(a₂²+b₂²) as a product of lengths, so that small sizes keep their digits.
    let (one, two) = (a.x.hypot(b.x), a.y.hypot(b.y));
    let anisotropy = |v: Vec2<S>| (v.x - v.y).over(one) * (v.x + v.y).over(two);
    let twist = pair.sin2 * (anisotropy(a) * anisotropy(b));
    let apart = |a: S, b: S| ((a - b).over(a) * (a - b).over(b)).halved();
    let shape = ln_one_plus(apart(a.x, b.x)) + ln_one_plus(apart(a.y, b.y)) + ln_one_plus(twist);
    // The adjugate of a sum of two matrices is the sum of theirs.
    let form = |v: Vec2<S>, s: Vec2<S>| {
        let (p, q) = ((s.y * v.x).over(one), (s.x * v.y).over(one));
        p.over(two).squared() + q.over(two).squared()
    };
    let far = (form(d, a) + form(e, b)).over(S::one() + twist);
    far.halved().halved() + shape.halved()
}

/// Returns one minus the Hellinger distance of two boxes as Gaussians, each with the covariance of a uniform
/// distribution over its box, in `[0, 1]`: 1 for identical ones, with derivative zero. Below 10⁻³⁵ it is zero, in every
/// format; [`bhattacharyya`] has derivatives farther away.
///
/// ```
/// use geograd::{Obb2, gaussian::probiou};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.3_f64);
/// assert_eq!(probiou(a, a), 1.0);
/// assert!(probiou(a, Obb2::new(40.0, 0.0, 4.0, 2.0, 0.3)) < 1e-9);
/// ```
#[must_use]
#[inline]
pub fn probiou<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let pair = pair(a, b, (1.0 / 12.0_f64).sqrt());
    similarity(distance(&pair))
}

/// From this distance on boxes count as not similar at all: below the smallest numbers of `f32`.
const FAR: f64 = 80.0;

/// Returns one minus the Hellinger distance from the Bhattacharyya distance: `1 − √(1 − q)` with `q = e⁻ᵈ`, computed as
/// `q / (1 + √(1 − q))`, which keeps its digits far away.
#[inline(always)]
pub(crate) fn similarity<S: Scalar>(distance: S) -> S {
    let far = distance.above(S::lit(FAR));
    let distance = S::select(far, S::zero(), distance);
    let hellinger = (-exp_minus_one(-distance)).root();
    let value = (-distance).exp().over(S::one() + hellinger);
    S::select(far, S::zero(), value).canonical()
}

/// Returns the overlap of two boxes as Gaussians when they are fused as a Kalman filter does, over their union, in
/// `[0, 1/3]`: the product's volume `V`, over `Va + Vb − V`. The centres do not count; losses add a term
/// for them.
#[must_use]
#[inline]
pub fn kfiou<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let pair = pair(a, b, 0.5);
    let (a, b) = (pair.a, pair.b);
    let (one, two) = (a.x.hypot(b.x), a.y.hypot(b.y));
    let anisotropy = |v: Vec2<S>| (v.x - v.y).over(one) * (v.x + v.y).over(two);
    let root = (S::one() + pair.sin2 * (anisotropy(a) * anisotropy(b))).root();
    // V / Va and V / Vb.
    let of_a = (b.x.over(one) * b.y.over(two)).over(root);
    let of_b = (a.x.over(one) * a.y.over(two)).over(root);
    fused(of_a, of_b)
}

/// Returns `V / (Va + Vb − V)` from `V / Va` and `V / Vb`.
#[inline(always)]
pub(crate) fn fused<S: Scalar>(of_a: S, of_b: S) -> S {
    let product = of_a * of_b;
    let total = of_a + of_b - product;
    let empty = total.at_most(S::lit(S::format().empty()));
    let value = product.over(S::select(empty, S::one(), total));
    S::select(empty, S::zero(), value).canonical()
}

/// Returns the loss `1 − 1 / (τ + ln(1 + d))` of a distance or divergence `d ≥ 0`, in `[1 − 1/τ, 1)`; at
/// least 0 with `τ = 1`. The papers apply it to [`wasserstein`] and [`kullback_leibler`].
#[must_use]
#[inline]
pub fn saturating_loss<S: Scalar>(d: S, tau: S) -> S {
    S::one() - S::one().over(tau + ln_one_plus(d))
}

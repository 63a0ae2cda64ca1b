//! Wasserstein's distance of two boxes of the plane as Gaussians.
use super::lengths::{BoxUnits, Displacement, root_of_sum, sum_of_squares};
use crate::{Obb2, Rotation2, Scalar, Vec2};

fn way<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> Displacement<S> {
    let between = b.center - a.center;
    Displacement::of([between.x, between.y])
}

/// Returns sizes, as constants where all are near the smallest numbers: relative derivatives are near the largest
/// there.
fn small_as_constant<S: Scalar>(size: Vec2<S>) -> Vec2<S> {
    let small = size
        .x
        .most(size.y)
        .at_most(S::lit(4096.0 / S::format().largest()));
    let held = |x: S| S::select(small, S::from_primal(x.primal()), x);
    Vec2::new(held(size.x), held(size.y))
}

/// Returns the squared distance of both shapes, as if their centres agreed, in squared units of [`BoxUnits`]. `POWER` is
/// that of the result in lengths.
fn of_shapes<S: Scalar, const POWER: usize>(a: Obb2<S>, b: Obb2<S>) -> (S, BoxUnits<S>) {
    let units = BoxUnits::of(a.size.x.most(a.size.y), b.size.x.most(b.size.y));
    let half = S::lit(0.5);
    let (own, other) = (
        small_as_constant(a.size) * units.a * half,
        small_as_constant(b.size) * units.b * half,
    );
    let held = units.finite_derivatives::<POWER>();
    let axes = |heading: S| Rotation2::from_angle(held(heading));
    let turn = axes(a.heading).inverse() * axes(b.heading);
    // The larger deviations of both are put on one axis.
    let crossed = ((own.x - own.y) * (other.x - other.y)).below(S::zero());
    let exchange = |x: S, y: S| S::select(crossed, y, x);
    let (a, b) = (
        own,
        Vec2::new(exchange(other.x, other.y), exchange(other.y, other.x)),
    );
    let sin2 = exchange(turn.sin, turn.cos).squared();
    let cos2 = exchange(turn.cos, turn.sin).squared();
    // The last term in the product of both units.
    let straight = a.x * b.x + a.y * b.y;
    let crossed = a.x * b.y + a.y * b.x;
    let root = (straight * straight * cos2 + crossed * crossed * sin2).root();
    let sum = straight + root;
    let empty = sum.at_most(S::lit(S::format().empty()));
    let anisotropy = (a.x - a.y) * (a.x + a.y) * ((b.x - b.y) * (b.x + b.y));
    let twist = (sin2 * anisotropy).over(S::select(empty, S::one(), sum));
    let twist = S::select(empty, S::zero(), twist) * (units.share_a * units.share_b);
    let apart = a * units.share_a - b * units.share_b;
    (apart.length_squared() + (twist + twist), units)
}

/// Returns the square of [`wasserstein`], in squared units of length; smooth except for boxes of zero size.
///
/// `|Δ|² + (a₁−b₁)² + (a₂−b₂)² + 2 sin² (a₁²−a₂²)(b₁²−b₂²) / (P + T)` with the deviations a, b,
/// `P = a₁b₁ + a₂b₂`, `Q = a₁b₂ + a₂b₁` and `T = √(P² cos² + Q² sin²)`, axes named so that no term is
/// negative: the trace of `Σa + Σb − 2 (√Σa Σb √Σa)^½` by the determinant of its last term.
#[must_use]
#[inline]
pub fn wasserstein_squared<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (shape, units) = of_shapes::<S, 2>(a, b);
    sum_of_squares(shape, &units, &way(a, b)).canonical()
}

/// Returns the Wasserstein distance of two boxes as Gaussians, a length: the distance that mass must move, as the root
/// of a mean of squares. Identical boxes have derivative zero.
///
/// ```
/// use geograd::{Obb2, gaussian::wasserstein};
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.3_f64);
/// assert_eq!(wasserstein(a, a), 0.0);
/// let moved = Obb2::new(3.0, 4.0, 4.0, 2.0, 0.3);
/// assert!((wasserstein(a, moved) - 5.0).abs() < 1e-14);
/// ```
#[must_use]
#[inline]
pub fn wasserstein<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (shape, units) = of_shapes::<S, 1>(a, b);
    root_of_sum(shape, &units, &way(a, b)).canonical()
}

//! Wasserstein's distance of two boxes of any orientation as Gaussians.
#![expect(
    clippy::needless_range_loop,
    reason = "indices are axes, shared by several arrays"
)]
use crate::arrays::Each;
use crate::gaussian::lengths::{BoxUnits, Displacement, root_of_sum, sum_of_squares};
use crate::overlap3::relate::relate3;
use crate::scalar::most_of;
use crate::shape::{Obb3, Rotation3};
use crate::{Scalar, Vec3};

/// Two Gaussians of space in the frame of the first, lengths in the units of [`BoxUnits`] and [`Displacement`].
struct WassersteinPair<S: Scalar> {
    /// The displacement between the means.
    way: Displacement<S>,
    /// Standard deviations, each box in its own unit.
    a: [S; 3],
    b: [S; 3],
    /// The rotation.
    turn: [[S; 3]; 3],
    units: BoxUnits<S>,
    /// `true` where both boxes are equal.
    same: S::Mask,
}

/// Relates two boxes. `POWER` is the power of a length in the result.
fn pair<S: Scalar, const POWER: usize>(a: Obb3<S>, b: Obb3<S>) -> WassersteinPair<S> {
    let between = b.center - a.center;
    let way = Displacement::of([between.x, between.y, between.z]);
    let numbers = |v: Vec3<S>| [v.x, v.y, v.z];
    let units = BoxUnits::of(most_of(numbers(a.size)), most_of(numbers(b.size)));
    let own = numbers(a.size).each_as(|x| x * units.a);
    let other = numbers(b.size).each_as(|x| x * units.b);
    // The rotation and the names of axes do not depend on sizes: these keep every unit finite.
    let held = units.finite_derivatives::<POWER>();
    let turned = |q: Rotation3<S>| {
        let cube = Vec3::new(S::one(), S::one(), S::one());
        let rotation = Rotation3::new(held(q.w), held(q.x), held(q.y), held(q.z));
        Obb3::new(Vec3::zero(), cube, rotation)
    };
    let related = relate3(turned(a.rotation), turned(b.rotation));
    let other = related.renamed.rename(other);
    let alike = |k: usize| (own[k] * units.share_a).equals(other[k] * units.share_b);
    let same = (related.same & way.none) & (alike(0) & alike(1) & alike(2));
    WassersteinPair {
        way,
        a: own.each_as(S::halved),
        b: other.each_as(S::halved),
        turn: related.turn,
        units,
        same,
    }
}

/// Returns the orthogonal matrix nearest to a matrix of positive determinant, as a constant: the rotation that
/// aligns one cloud with another.
///
/// Newton's iteration `X ← ½ (γ X + X⁻ᵀ / γ)` with Higham's scaling γ; nine steps reach rounding from any
/// matrix that two boxes with sizes of [`Format::epsilon`](crate::scalar::Format::epsilon) to four can make, three more are room. Its determinant is
/// then above the fourth power of epsilon: no product underflows.
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
        let flat = det.at_most(S::Primal::lit(S::format().empty()));
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
    x.each_as(|row| row.each_as(S::from_primal))
}

/// Returns the squared distance of both shapes, as if their centres agreed, in squared units of [`BoxUnits`].
///
/// The trace of `Σa + Σb − 2 (√Σa Σb √Σa)^½` is the least `‖√Σa − √Σb Q‖²` over all rotations Q: a sum of
/// squares. At the best Q derivatives by Q vanish, so Q is a constant.
fn of_shapes<S: Scalar>(pair: &WassersteinPair<S>) -> S {
    let (turn, units) = (&pair.turn, &pair.units);
    // Each box in its own unit: the rotation does not depend on units. Sides without thickness count as thin.
    let largest = |v: [S; 3]| {
        let v = v.each_as(S::primal);
        let size = v[0].most(v[1]).most(v[2]);
        let none = size.at_most(S::Primal::zero());
        S::Primal::select(none, S::Primal::one(), size)
    };
    let (size_a, size_b) = (largest(pair.a), largest(pair.b));
    let thin = |size: S::Primal| S::from_primal(size * S::Primal::rounding(1.0, 1));
    let (least_a, least_b) = (thin(size_a), thin(size_b));
    let mut aligned = [[S::zero(); 3]; 3];
    for m in 0..3 {
        for i in 0..3 {
            aligned[m][i] = (turn[i][m] * pair.b[m].most(least_b)) * pair.a[i].most(least_a);
        }
    }
    let (by_a, by_b) = (size_a.binade(), size_b.binade());
    let whole = |x: S| (x.primal() * by_a) * by_b;
    let best = nearest_rotation::<S>(aligned.each_as(|row| row.each_as(whole)));
    let (a, b) = (
        pair.a.each_as(|x| x * units.share_a),
        pair.b.each_as(|x| x * units.share_b),
    );
    let mut sum = S::zero();
    for i in 0..3 {
        for j in 0..3 {
            // Row i, column j of diag(a) − R diag(b) Q.
            let mut entry = if i == j { a[i] } else { S::zero() };
            for m in 0..3 {
                entry -= turn[i][m] * b[m] * best[m][j];
            }
            sum += entry.squared();
        }
    }
    sum - gain(&aligned, &best) * (units.share_a * units.share_b)
}

/// Returns the decrease of the sum of squares as the best rotation Q moves along with the pair. Its value and
/// derivative are zero here; its second derivative is not.
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
    let p = k.each_as(|row| row.each_as(S::primal));
    let trace = p[0][0] + p[1][1] + p[2][2];
    let [d0, d1, d2] = [trace - p[0][0], trace - p[1][1], trace - p[2][2]];
    let off = |i: usize, j: usize| -(p[i][j] + p[j][i]).halved();
    let (e0, e1, e2) = (off(1, 2), off(2, 0), off(0, 1));
    // The inverse of P by its cofactors.
    let (c00, c11, c22) = (d1 * d2 - e0 * e0, d2 * d0 - e1 * e1, d0 * d1 - e2 * e2);
    let (c12, c20, c01) = (e1 * e2 - d0 * e0, e2 * e0 - d1 * e1, e0 * e1 - d2 * e2);
    let det = d0 * c00 + e2 * c01 + e1 * c20;
    let rounding = S::Primal::rounding(1.0, 1) * (trace * trace) * trace;
    let flat = det.at_most(rounding.most(S::Primal::lit(S::format().empty())));
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

/// Returns the square of [`wasserstein`], in squared units of length.
#[must_use]
#[inline]
pub fn wasserstein_squared<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let pair = pair::<S, 2>(a, b);
    sum_of_squares(of_shapes(&pair), &pair.units, &pair.way).canonical()
}

/// Returns the Wasserstein distance of two boxes as Gaussians, a length. Identical boxes have derivative zero.
/// Derivatives above the second are not supported.
///
/// ```
/// use geograd::{Obb3, Rotation3, Vec3, gaussian::solid};
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
    let pair = pair::<S, 1>(a, b);
    let value = root_of_sum(of_shapes(&pair), &pair.units, &pair.way);
    S::select(pair.same, S::zero(), value).canonical()
}

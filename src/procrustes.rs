//! Alignment of point sets: the rotation, shift and scale that bring points closest to others, with exact derivatives.
//!
//! The value comes from the largest eigenvector of Horn's 4 by 4 matrix, found on plain numbers. One Newton step on the
//! condition of optimality carries derivatives of first and second order. It divides by sums of two singular values and
//! by no difference: repeated singular values are ordinary.
//!
//! Sources: Horn, *Closed-form solution of absolute orientation using unit quaternions*, 1987; Umeyama, *Least-squares
//! estimation of transformation parameters between two point patterns*, 1991.
use crate::error::Argument;
use crate::shape::{Pose3, Rotation3};
use crate::{Error, Scalar, Shape, Vec3};
use std::ops::Mul;

/// A similarity of space: a scale, then a rotation, then a translation.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Alignment<S> {
    /// Applied second.
    pub pose: Pose3<S>,
    /// The factor of lengths, at least 0; applied first.
    pub scale: S,
}

impl<S: Scalar> Mul<Vec3<S>> for Alignment<S> {
    type Output = Vec3<S>;
    #[inline]
    fn mul(self, point: Vec3<S>) -> Vec3<S> {
        self.pose * (point * self.scale)
    }
}

/// Returns the similarity that brings points closest to targets: it minimises the weighted sum of squared distances.
/// Mirrored points get the best proper rotation.
///
/// The rotation of points on a line is the smallest one of those that fit equally well; about the line its derivative
/// is zero. Coincident points, or weights of zero, give no rotation and the scale 1, with derivative zero. Weights are
/// at least 0.
///
/// Kinks: points on a line, and mirrored ones whose two smaller singular values are equal; there the rotation jumps.
///
/// ```
/// use geograd::{Pose3, Rotation3, Vec3, procrustes::procrustes};
/// let points = [[0.0_f64, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
/// let points = points.map(|[x, y, z]| Vec3::new(x, y, z));
/// let pose = Pose3::new(Vec3::new(5.0, -1.0, 2.0), Rotation3::new(0.5, 0.1, -0.3, 0.2));
/// let targets = points.map(|point| pose * (point * 2.0));
/// let found = procrustes(&points, &targets, &[1.0, 1.0, 2.0, 0.5])?;
/// assert!((found.scale - 2.0).abs() < 1e-14);
/// assert!((found * points[3]).distance(targets[3]) < 1e-14);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// [`Error::Length`] for another number of targets or weights than of points.
pub fn procrustes<S: Scalar>(
    points: &[Vec3<S>],
    targets: &[Vec3<S>],
    weights: &[S],
) -> Result<Alignment<S>, Error> {
    let moments = Moments::of(points, targets, weights)?;
    let rotation = Rotation3::nearest_to(moments.product);
    let [x, y, z] = rotation.axes();
    let [a, b, c] = moments.product;
    let along = (x.dot(a) + y.dot(b)) + z.dot(c);
    let none = moments.spread.at_most(S::zero());
    let scale = along.over(S::select(none, S::one(), moments.spread));
    let scale = S::select(none, S::one(), scale);
    let translation = moments.target - rotation * (moments.point * scale);
    let pose = Pose3::new(translation, rotation);
    Ok(Alignment { pose, scale })
}

/// Returns the rigid motion that brings points closest to targets: [`procrustes`] without scale.
///
/// # Errors
///
/// [`Error::Length`] for another number of targets or weights than of points.
pub fn procrustes_rigid<S: Scalar>(
    points: &[Vec3<S>],
    targets: &[Vec3<S>],
    weights: &[S],
) -> Result<Pose3<S>, Error> {
    let moments = Moments::of(points, targets, weights)?;
    let rotation = Rotation3::nearest_to(moments.product);
    Ok(Pose3::new(
        moments.target - rotation * moments.point,
        rotation,
    ))
}

/// Weighted means of two lists of points, and moments about them.
struct Moments<S> {
    point: Vec3<S>,
    target: Vec3<S>,
    /// The sum of target times transposed point, column by column.
    product: [Vec3<S>; 3],
    /// The sum of squared distances of the points from their mean.
    spread: S,
}

impl<S: Scalar> Moments<S> {
    fn of(points: &[Vec3<S>], targets: &[Vec3<S>], weights: &[S]) -> Result<Self, Error> {
        for (name, found) in [("targets", targets.len()), ("weights", weights.len())] {
            if found != points.len() {
                return Err(Error::Length {
                    argument: Argument::Named(name),
                    expected: points.len(),
                    found,
                });
            }
        }
        let mut total = S::zero();
        for &weight in weights {
            total += weight;
        }
        let none = total.at_most(S::zero());
        let share = S::select(
            none,
            S::zero(),
            S::one().over(S::select(none, S::one(), total)),
        );
        // About the first point that counts: means of far points keep their digits, and points that coincide are exactly
        // at their mean.
        let mean = |all: &[Vec3<S>]| {
            let mut first = all.first().copied().unwrap_or_else(Vec3::zero);
            let mut none = S::zero().at_most(S::zero());
            for (&point, &weight) in all.iter().zip(weights) {
                let counts = weight.above(S::zero());
                first = Vec3::select(none & counts, point, first);
                none = none & !counts;
            }
            let mut sum = Vec3::zero();
            for (&point, &weight) in all.iter().zip(weights) {
                sum += (point - first) * (weight * share);
            }
            first + sum
        };
        let (point, target) = (mean(points), mean(targets));
        let (mut product, mut spread) = ([Vec3::zero(); 3], S::zero());
        for ((&p, &q), &weight) in points.iter().zip(targets).zip(weights) {
            let (p, q) = (p - point, (q - target) * weight);
            product[0] += q * p.x;
            product[1] += q * p.y;
            product[2] += q * p.z;
            spread += p.length_squared() * weight;
        }
        Ok(Moments {
            point,
            target,
            product,
            spread,
        })
    }
}

impl<S: Scalar> Rotation3<S> {
    /// Returns the rotation whose matrix is nearest to a matrix, column by column, by the sum of squared differences:
    /// nine coordinates without jumps where the determinant is positive.
    ///
    /// Kinks: where the two smaller singular values, the smaller negative for a mirroring matrix, have the sum zero.
    /// There the rotation is the smallest of those equally near, and its derivative about the free axis is zero. The
    /// zero matrix gives no rotation.
    ///
    /// ```
    /// use geograd::{Rotation3, Vec3};
    /// let [x, y, z] = Rotation3::new(0.5_f64, 0.1, -0.3, 0.2).axes();
    /// let found = Rotation3::nearest_to([x * 3.0, y * 3.0, z * 3.0]); // three equal singular values
    /// assert!(found.angle_to(Rotation3::new(0.5, 0.1, -0.3, 0.2)) < 1e-15);
    /// ```
    #[must_use]
    pub fn nearest_to([a, b, c]: [Vec3<S>; 3]) -> Self {
        let mut size = S::Primal::zero();
        for v in [a, b, c] {
            for x in [v.x, v.y, v.z] {
                size = size.most(x.primal().magnitude());
            }
        }
        let none = size.at_most(S::Primal::zero());
        let scale = S::Primal::select(none, S::Primal::one(), size).binade();
        let scale = S::from_primal(scale);
        let (a, b, c) = (a * scale, b * scale, c * scale);
        let plain = |v: Vec3<S>| Vec3::new(v.x.primal(), v.y.primal(), v.z.primal());
        let (start, inverse) = optimum([plain(a), plain(b), plain(c)]);
        let lift = |v: Vec3<S::Primal>| {
            Vec3::new(
                S::from_primal(v.x),
                S::from_primal(v.y),
                S::from_primal(v.z),
            )
        };
        let start = Rotation3::new(
            S::from_primal(start.w),
            S::from_primal(start.x),
            S::from_primal(start.y),
            S::from_primal(start.z),
        );
        // The matrix in the frame of the rotation found; symmetric where that is the nearest.
        let back = start.inverse();
        let [x, y, z] = [back * a, back * b, back * c];
        let (xx, yy, zz) = (y.y + z.z, x.x + z.z, x.x + y.y);
        let (xy, xz, yz) = (
            (x.y + y.x).halved(),
            (x.z + z.x).halved(),
            (y.z + z.y).halved(),
        );
        let residual = Vec3::new(y.z - z.y, z.x - x.z, x.y - y.x);
        let [p, q, r] = inverse.map(lift);
        let solve = |v: Vec3<S>| Vec3::new(p.dot(v), q.dot(v), r.dot(v));
        let step = solve(residual);
        // One step of refinement by the matrix with its derivatives.
        let product = Vec3::new(
            xx * step.x - (xy * step.y + xz * step.z),
            yy * step.y - (xy * step.x + yz * step.z),
            zz * step.z - (xz * step.x + yz * step.y),
        );
        start.retract(step + solve(residual - product)).canonical()
    }
}

/// Sweeps of Jacobi's method. After six, 900,000 matrices of nine kinds of singular values were off by rounding only.
const SWEEPS: usize = 6;

/// Returns the rotation nearest to a matrix, and the inverse of the second derivative in its body tangent; zero along
/// directions in which the rotation is free.
fn optimum<S: Scalar>([a, b, c]: [Vec3<S>; 3]) -> (Rotation3<S>, [Vec3<S>; 3]) {
    let (zero, one) = (S::zero(), S::one());
    let (xy, xz, yz) = (a.y + b.x, a.z + c.x, b.z + c.y);
    let (wx, wy, wz) = (b.z - c.y, c.x - a.z, a.y - b.x);
    let mut k = [
        [(a.x + b.y) + c.z, wx, wy, wz],
        [wx, (a.x - b.y) - c.z, xy, xz],
        [wy, xy, (b.y - a.x) - c.z, yz],
        [wz, xz, yz, (c.z - a.x) - b.y],
    ];
    // Row i is the eigenvector of value k[i][i].
    let mut vectors = [[zero; 4]; 4];
    for (i, row) in vectors.iter_mut().enumerate() {
        row[i] = one;
    }
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (2, 3), (0, 2), (1, 3), (0, 3), (1, 2)] {
            let (off, half) = (k[p][q] + k[p][q], k[q][q] - k[p][p]);
            let below = half.unsigned() + half.hypot(off);
            let none = below.at_most(zero);
            let tan = off.over(S::select(none, one, below)).signed_as(half);
            let cos = one.over((one + tan * tan).root());
            let sin = tan * cos;
            let turn = |x: S, y: S| (x * cos - y * sin, x * sin + y * cos);
            for row in &mut k {
                (row[p], row[q]) = turn(row[p], row[q]);
            }
            for i in 0..4 {
                (k[p][i], k[q][i]) = turn(k[p][i], k[q][i]);
                (vectors[p][i], vectors[q][i]) = turn(vectors[p][i], vectors[q][i]);
            }
        }
    }
    let (mut most, mut best) = (k[0][0], vectors[0]);
    for i in 1..4 {
        let above = k[i][i].above(most);
        most = S::select(above, k[i][i], most);
        for (x, y) in best.iter_mut().zip(vectors[i]) {
            *x = S::select(above, y, *x);
        }
    }
    // The eigenvalues are off by a few roundings of the largest.
    let tolerance = most * S::rounding(64.0, 1);
    let free: [S::Mask; 4] = std::array::from_fn(|i| (most - k[i][i]).at_most(tolerance));
    // The part of no rotation in the space of all that fit equally well.
    let mut near = [zero; 4];
    for (vector, &free) in vectors.iter().zip(&free) {
        for (sum, &x) in near.iter_mut().zip(vector) {
            *sum += S::select(free, x * vector[0], zero);
        }
    }
    let far = near[0].at_most(S::rounding(1.0, 1));
    let pick = |i: usize| S::select(far, best[i], near[i]);
    let start = Rotation3::new(pick(0), pick(1), pick(2), pick(3)).normalized();
    let mut inverse = [Vec3::zero(); 3];
    for (i, (v, &free)) in vectors.iter().zip(&free).enumerate() {
        let gap = S::select(free, one, most - k[i][i]);
        let weight = S::select(free, zero, S::lit(2.0).over(gap));
        let u = (start.inverse() * Rotation3::new(v[0], v[1], v[2], v[3])).vector();
        inverse[0] += u * (u.x * weight);
        inverse[1] += u * (u.y * weight);
        inverse[2] += u * (u.z * weight);
    }
    (start, inverse)
}

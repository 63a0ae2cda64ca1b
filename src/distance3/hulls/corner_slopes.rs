//! The first derivatives of a signed distance by the corners of both shapes, from its features.
//!
//! The distance of two features is stationary in their points and in its direction. So its derivative by a corner is
//! the direction times the corner's share of the point.
use super::hull_record::HullRecord;
use super::hull_replay::{FeatureShares, shares};
use super::{Cornered, hulls_replay, origin};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::distance3::cored::axes;
use crate::distance3::relation::Relation;
use crate::scalar::largest;
use crate::{
    Capsule3, Hull3, Obb3, Real, Rotation3, RoundBox3, Scalar, Segment3, Sphere, Tetrahedron,
    Triangle3, Vec3,
};

/// Derivatives by corners, each with the number of its corner, which may occur several times.
type ByCorner<S> = Vec<(usize, Vec3<S>)>;

/// The derivatives of a signed distance by corners.
pub(crate) struct CornerSlopes<S> {
    /// The relation of the shapes.
    pub relation: Relation<S>,
    /// The derivatives by corners of the first shape.
    pub by_a: ByCorner<S>,
    /// The derivatives by corners of the second shape.
    pub by_b: ByCorner<S>,
}

/// Returns the derivatives of the signed distance of two shapes by their corners, times a factor, given the record of a
/// search.
pub(crate) fn corner_slopes<S, A, B>(
    a: &A,
    b: &B,
    record: &HullRecord,
    factor: impl FnOnce(&Relation<S>) -> S,
) -> CornerSlopes<S>
where
    S: Real,
    A: Cornered<Scalar = S>,
    B: Cornered<Scalar = S>,
{
    let from = origin(a, b);
    let relation = hulls_replay(a, b, record);
    let factor = factor(&relation);
    let all = record.features();
    let planes = 1 + all.iter().map(|features| features.plane).max().unwrap_or(0);
    let (mut by_a, mut by_b) = (Vec::new(), Vec::new());
    for (features, found) in
        all.iter()
            .zip(shares(&a.corners_from(from), &b.corners_from(from), record))
    {
        let FeatureShares { normal, of_a, of_b } = found;
        let level = all.iter().filter(|other| other.plane == features.plane);
        let part = normal * (factor * S::lit(1.0 / (level.count() as f64 * f64::from(planes))));
        by_a.extend(of_a.map(|(corner, share)| (corner, part * -share)));
        by_b.extend(of_b.map(|(corner, share)| (corner, part * share)));
    }
    CornerSlopes {
        relation,
        by_a,
        by_b,
    }
}

/// A shape whose derivatives follow from those of its corners.
pub(crate) trait ByCorners: Cornered {
    /// Returns the derivatives of a signed distance by the shape, times a factor, given those by its corners, times this
    /// factor, and the direction of the distance.
    fn by_corners(
        &self,
        by: &ByCorner<Self::Scalar>,
        normal: Vec3<Self::Scalar>,
        factor: Self::Scalar,
    ) -> Self;
}

/// Returns the derivatives by corners that are given.
fn by_given<S: Scalar, const N: usize>(by: &ByCorner<S>) -> [Vec3<S>; N] {
    let mut slopes = [Vec3::zero(); N];
    for &(corner, slope) in by {
        slopes[corner] += slope;
    }
    slopes
}

macro_rules! by_given_corners {
    ($($Shape:ident { $($corner:ident)+ } $($radius:ident)?;)*) => { $(
        impl<S: Scalar> ByCorners for $Shape<S> {
            fn by_corners(&self, by: &ByCorner<S>, _normal: Vec3<S>, factor: S) -> Self {
                let [$($corner),+] = by_given(by);
                // A radius brings the shapes nearer by itself.
                $(let $radius = -factor;)?
                let _ = factor;
                $Shape { $($corner),+ $(, $radius)? }
            }
        }
    )* };
}
by_given_corners! {
    Sphere { center } radius;
    Segment3 { start end };
    Capsule3 { start end } radius;
    Triangle3 { a b c };
    Tetrahedron { a b c d };
}

impl<S: Scalar> ByCorners for Vec3<S> {
    fn by_corners(&self, by: &ByCorner<S>, _normal: Vec3<S>, _factor: S) -> Self {
        let [point] = by_given(by);
        point
    }
}

impl<S: Scalar, const N: usize> ByCorners for Hull3<S, N> {
    fn by_corners(&self, by: &ByCorner<S>, _normal: Vec3<S>, _factor: S) -> Self {
        Hull3 {
            vertices: by_given(by),
            count: self.count,
        }
    }
}

impl<S: Scalar> ByCorners for Obb3<S> {
    /// Returns the derivatives by centre, size and quaternion.
    ///
    /// With the vector h·aᵢ of a side from the centre, a corner's slope s and its side σ, the length of the side has the
    /// slope σ·aᵢ·s/2, and its direction σ·h·s. A small turn ω moves axes by ω × aᵢ, so the sum of aᵢ × σ·h·s is the slope by
    /// ω, which goes with the quaternion's change dq as ω = 2·Im(dq·q⁻¹).
    fn by_corners(&self, by: &ByCorner<S>, normal: Vec3<S>, factor: S) -> Self {
        let axes = axes(self.rotation);
        let half = [self.size.x, self.size.y, self.size.z].each_as(S::halved);
        let mut center = Vec3::zero();
        let mut aside = [Vec3::zero(); 3];
        for &(corner, slope) in by {
            center += slope;
            for (k, sum) in aside.iter_mut().enumerate() {
                match corner >> k & 1 {
                    0 => *sum -= slope,
                    _ => *sum += slope,
                }
            }
        }
        let mut size = [S::zero(); 3];
        let mut turn = Vec3::zero();
        for k in 0..3 {
            // A side of length zero grows towards the other shape.
            let grown = -(normal.dot(axes[k]).magnitude() * factor);
            let flat = half[k].equals(S::zero());
            size[k] = S::select(flat, grown, axes[k].dot(aside[k])).halved();
            turn += axes[k].cross(aside[k]) * half[k];
        }
        let [x, y, z] = size;
        Obb3 {
            center,
            size: Vec3::new(x, y, z),
            rotation: by_turn(self.rotation, turn),
        }
    }
}

/// Returns the derivatives by a quaternion, given those by a small turn after it.
pub(crate) fn by_turn<S: Scalar>(q: Rotation3<S>, turn: Vec3<S>) -> Rotation3<S> {
    let scale = scale_of::<S>(largest([q.w, q.x, q.y, q.z]));
    let [w, x, y, z] = [q.w, q.x, q.y, q.z].each_as(|part| part * scale);
    let square = (w * w + x * x) + (y * y + z * z);
    // The zero quaternion counts as no turn.
    let none = square.equals(S::zero());
    let (w, square) = (
        S::select(none, S::one(), w),
        S::select(none, S::one(), square),
    );
    let v = Vec3::new(x, y, z);
    let factor = (scale + scale).over(square);
    let by = (turn * w + turn.cross(v)) * factor;
    let by_w = -turn.dot(v) * factor;
    Rotation3 {
        w: S::select(none, S::zero(), by_w),
        x: by.x,
        y: by.y,
        z: by.z,
    }
}

impl<S: Scalar> ByCorners for RoundBox3<S> {
    fn by_corners(&self, by: &ByCorner<S>, normal: Vec3<S>, factor: S) -> Self {
        RoundBox3 {
            inner: self.inner.by_corners(by, normal, factor),
            radius: -factor,
        }
    }
}

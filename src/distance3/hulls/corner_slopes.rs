//! The first derivatives of a signed distance by the corners of both shapes, from its features.
//!
//! The distance of two features is stationary in their points and in its direction. So its derivative by a corner is
//! the direction times the corner's share of the point.
use super::hull_record::HullRecord;
use super::hull_replay::{FeatureShares, shares};
use super::{CornerList, Cornered, hulls_replay, origin};
use crate::distance3::relation::Relation;
use crate::distance3::spot::fixed_vector;
use crate::{Hull3, Real, Scalar, Vec3};

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

/// Returns derivatives by the vertices of a hull as a hull.
pub(crate) fn by_vertices<S: Scalar, const N: usize>(
    hull: &Hull3<S, N>,
    by: &ByCorner<S>,
) -> Hull3<S, N> {
    let mut slopes = Hull3 {
        vertices: [Vec3::zero(); N],
        count: hull.count,
    };
    for &(corner, slope) in by {
        slopes.vertices[corner] += slope;
    }
    slopes
}

/// Returns a number whose derivative by a shape is that of the signed distance times a factor, given the derivatives by
/// its corners, times this factor, and the direction between the shapes, as constants.
pub(crate) fn by_shape<S, A>(
    shape: &A,
    by: &ByCorner<S::Primal>,
    normal: Vec3<S::Primal>,
    factor: S::Primal,
) -> S
where
    S: Scalar,
    A: Cornered<Scalar = S>,
{
    let corners = shape.corners_from(Vec3::zero());
    let heights = by
        .iter()
        .map(|&(corner, slope)| fixed_vector::<S>(slope).dot(corners.at(corner)));
    let height = heights.fold(S::zero(), |sum, height| sum + height);
    let rest = shape.widening(fixed_vector(normal)) + shape.inflation();
    height - rest * S::from_primal(factor)
}

//! Adjoints of distances, by the envelope theorem.
//!
//! The nearest points move along their shapes, but to first order that does not change their distance. So its
//! derivative is that of the segment between both, held fixed on their shapes: with n the unit vector from a to b, a
//! point of a has the derivative −n and one of b n. The ends of a segment share it by the fraction at which the point
//! lies between them. (How the fractions themselves change matters to curvature, which follows from differentiating
//! these adjoints.)
use crate::distance::pair::distance;
use crate::distance::segments::{way_between_segments, way_to_segment};
use crate::{Scalar, Segment2, Vec2};

/// Returns the cotangents of the ends of a segment from that of the point at a fraction of its length; zeros are
/// positive.
#[inline(always)]
fn shared<S: Scalar>(fraction: S, bar: Vec2<S>) -> Segment2<S> {
    let to = bar * fraction;
    Segment2 {
        from: (bar - to).canonical(),
        to: to.canonical(),
    }
}

/// Returns the [distance](crate::distance::distance()) of a point and a segment and its adjoint: the distance, and
/// `out_bar` times its derivatives with respect to both. Zero where the point is on the segment.
///
/// ```
/// use geograd::{Segment2, Vec2, ad::adjoint::distance::distance_point_segment_vjp};
/// let segment = Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0));
/// let (distance, (by_point, by_segment)) =
///     distance_point_segment_vjp(Vec2::new(1.0, 3.0), segment, 1.0);
/// assert_eq!((distance, by_point.y), (3.0, 1.0));
/// assert_eq!((by_segment.from.y, by_segment.to.y), (-0.75, -0.25));
/// ```
#[must_use]
#[inline]
pub fn distance_point_segment_vjp<S: Scalar>(
    point: Vec2<S>,
    segment: Segment2<S>,
    out_bar: S,
) -> (S, (Vec2<S>, Segment2<S>)) {
    let apart = distance(point, segment);
    let way = way_to_segment(point, segment, apart);
    let bar = way.direction * out_bar;
    (apart, ((-bar).canonical(), shared(way.along_b, bar)))
}

/// Returns the [distance](crate::distance::distance()) of two segments and its adjoint: the distance, and `out_bar`
/// times its derivatives with respect to both. Derivatives are zero where the segments meet. Ends that are equally
/// near, such as those of parallel segments, share the derivative equally.
///
/// ```
/// use geograd::{Segment2, Vec2, ad::adjoint::distance::distance_segments_vjp};
/// let a = Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0));
/// let b = Segment2::new(Vec2::new(1.0, 3.0), Vec2::new(2.0, 9.0));
/// // The start of b is nearest, three above a quarter of the way along a.
/// let (distance, (a_bar, b_bar)) = distance_segments_vjp(a, b, 1.0);
/// assert_eq!(distance, 3.0);
/// assert_eq!((a_bar.from.y, a_bar.to.y), (-0.75, -0.25));
/// assert_eq!((b_bar.from.y, b_bar.to.y), (1.0, 0.0));
/// ```
#[must_use]
#[inline]
pub fn distance_segments_vjp<S: Scalar>(
    a: Segment2<S>,
    b: Segment2<S>,
    out_bar: S,
) -> (S, (Segment2<S>, Segment2<S>)) {
    let apart = distance(a, b);
    let way = way_between_segments(a, b, apart);
    let bar = way.direction * out_bar;
    (apart, (shared(way.along_a, -bar), shared(way.along_b, bar)))
}

//! The closest points of two segments, with their parameters.
use super::convex::Convex;
use super::corners::Core;
use super::edge::{Edge, reach, scale_of, size_of};
use super::relation;
use super::share::{Best, Carry};
use crate::{Scalar, Segment2, Vec2};

/// The points in which two segments are nearest to each other.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClosestOnSegments<S> {
    /// The point of a.
    pub on_a: Vec2<S>,
    /// The point of b.
    pub on_b: Vec2<S>,
    /// The fraction of the way along a at which its point lies, in `[0, 1]`.
    #[shape(number)]
    pub along_a: S,
    /// The fraction of the way along b at which its point lies, in `[0, 1]`.
    #[shape(number)]
    pub along_b: S,
}

/// Two parameters.
#[derive(Clone, Copy, Debug)]
struct Parameters<S>(S, S);

impl<S: Scalar> Carry<S> for Parameters<S> {
    #[inline(always)]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Parameters(
            self.0.join(other.0, keep, tie),
            self.1.join(other.1, keep, tie),
        )
    }
    #[inline(always)]
    fn times(self, factor: S) -> Self {
        Parameters(self.0 * factor, self.1 * factor)
    }
}

/// Returns the points in which two segments are nearest to each other, and where along the segments they lie.
/// For segments that cross it is the point of crossing, with its derivatives.
///
/// Kinks: parallel segments, where the nearest pairs of an end and a segment share equally (for
/// segments of equal length side by side: the middles); nearest points that become an end; ends that
/// touch. A segment of length zero has parameter ½.
///
/// ```
/// use geograd::{Segment2, Vec2, distance::segments::closest_points_of_segments};
/// let a = Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0));
/// let b = Segment2::new(Vec2::new(1.0, 3.0), Vec2::new(1.0, 2.0));
/// let found = closest_points_of_segments(a, b);
/// assert_eq!((found.on_a, found.on_b), (Vec2::new(1.0, 0.0), Vec2::new(1.0, 2.0)));
/// assert_eq!((found.along_a, found.along_b), (0.25, 1.0));
/// ```
#[must_use]
#[inline]
pub fn closest_points_of_segments<S: Scalar>(
    a: Segment2<S>,
    b: Segment2<S>,
) -> ClosestOnSegments<S> {
    let (along_a, along_b, way) = (a.along(), b.along(), b.from - a.from);
    let size = size_of(along_a).most(size_of(along_b)).most(size_of(way));
    let scale = scale_of::<S>(size);
    let (da, db, w) = (along_a * scale, along_b * scale, way * scale);
    let (zero, one) = (S::zero(), S::one());
    let edge = |from: Vec2<S>, along: Vec2<S>| Edge {
        from,
        along,
        low: zero,
        high: one,
    };
    let (edge_a, edge_b) = (edge(Vec2::zero(), da), edge(w, db));
    // Each end against the other segment.
    let end_of_b = |at: Vec2<S>, t: S| {
        let found = reach(edge_a, at);
        Best::of(found.apart.length_squared(), Parameters(found.t, t))
    };
    let end_of_a = |at: Vec2<S>, t: S| {
        let found = reach(edge_b, at - w);
        Best::of(found.apart.length_squared(), Parameters(t, found.t))
    };
    let ends = end_of_b(w, zero)
        .less(end_of_b(w + db, one))
        .less(end_of_a(Vec2::zero(), zero))
        .less(end_of_a(da, one));
    let least = ends.value;
    let Parameters(t, u) = ends.mean();
    // The crossing of both lines, where it is inside both segments: t = w × db / (da × db) and
    // u = w × da / (da × db).
    let turn = da.perp_dot(db);
    let (above_t, above_u) = (
        w.perp_dot(db).signed_as(turn),
        w.perp_dot(da).signed_as(turn),
    );
    let turn = turn.unsigned();
    let crossing = turn.above(S::rounding(1.0, 4))
        & zero.below(above_t)
        & above_t.below(turn)
        & zero.below(above_u)
        & above_u.below(turn);
    // Guarded before the division, since the value that is not chosen must be finite, too.
    let safe = S::select(crossing, turn, one);
    let inside = |x: S| S::select(crossing, x, zero).over(safe);
    let (free_t, free_u) = (inside(above_t), inside(above_u));
    // Rounding produces crossings of collinear segments: none counts if an end is nearer than the crossing's two
    // points.
    let off = da * free_t - (w + db * free_u);
    let rounding = S::rounding(8.0, 2);
    let crossing = crossing & off.length_squared().at_most(least.most(rounding));
    let t = S::select(crossing, free_t, t);
    let u = S::select(crossing, free_u, u);
    ClosestOnSegments {
        on_a: (a.from + along_a * t).canonical(),
        on_b: (b.from + along_b * u).canonical(),
        along_a: t.canonical(),
        along_b: u.canonical(),
    }
}

/// Returns the distance of two segments that have no point in common; `None` where they are so near that roundings might
/// decide otherwise. It has the bits of [`distance`](super::distance), which computes more.
#[inline(always)]
pub(crate) fn distance_apart<S: Scalar<Mask = bool>>(a: Segment2<S>, b: Segment2<S>) -> Option<S> {
    let (a, b) = (a.core(), b.core());
    let origin = a.anchor();
    let scale = scale_of::<S>(a.extent(origin).most(b.extent(origin)));
    let (a, b) = (a.placed(origin, scale), b.placed(origin, scale));
    let near = |edge: Edge<S>, corner: Vec2<S>| {
        let apart = reach(edge, corner - edge.from).apart;
        Best::of(apart.length_squared(), apart)
    };
    let ([from_a, to_a], [from_b, to_b]) = (a.corners(), b.corners());
    let of_b = near(a.edge, from_b).less(near(a.edge, to_b));
    let mut of_a = near(b.edge, from_a).less(near(b.edge, to_a));
    of_a.sum = -of_a.sum;
    let length = of_b.less(of_a).mean().length();
    let is_far = length.above(S::rounding(16.0 * relation::SLACK, 1));
    is_far.then(|| length.over(scale).canonical())
}

/// The shortest segment from one shape to another, with the numbers that the derivatives of its length need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShortestLink<S> {
    /// The direction from a to b, of length one; zero where a and b have a point in common.
    pub direction: Vec2<S>,
    /// The parameter along a at which it begins.
    pub along_a: S,
    /// The parameter along b at which it ends.
    pub along_b: S,
}

#[derive(Clone, Copy, Debug)]
struct Link<S> {
    apart: Vec2<S>,
    along_a: S,
    along_b: S,
}

impl<S: Scalar> Carry<S> for Link<S> {
    #[inline(always)]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        let join = |a: S, b: S| a.join(b, keep, tie);
        Link {
            apart: Vec2::new(
                join(self.apart.x, other.apart.x),
                join(self.apart.y, other.apart.y),
            ),
            along_a: join(self.along_a, other.along_a),
            along_b: join(self.along_b, other.along_b),
        }
    }
    #[inline(always)]
    fn times(self, factor: S) -> Self {
        Link {
            apart: self.apart * factor,
            along_a: self.along_a * factor,
            along_b: self.along_b * factor,
        }
    }
}

/// Returns the link from an edge to a corner, which is at `fraction` of its own shape.
#[inline(always)]
fn link<S: Scalar>(edge: Edge<S>, corner: Vec2<S>, fraction: S) -> Best<S, Link<S>> {
    let found = reach(edge, corner - edge.from);
    let link = Link {
        apart: found.apart,
        along_a: found.t,
        along_b: fraction,
    };
    Best::of(found.apart.length_squared(), link)
}

/// Exchanges a and b.
#[inline(always)]
fn flipped<S: Scalar>(mut link: Best<S, Link<S>>) -> Best<S, Link<S>> {
    let Link {
        apart,
        along_a,
        along_b,
    } = link.sum;
    link.sum = Link {
        apart: -apart,
        along_a: along_b,
        along_b: along_a,
    };
    link
}

#[inline(always)]
fn way<S: Scalar>(link: Link<S>, distance: S) -> ShortestLink<S> {
    let length = link.apart.length();
    let over = S::select(length.at_most(S::zero()), S::one(), length);
    let direction = Vec2::new(link.apart.x.over(over), link.apart.y.over(over));
    ShortestLink {
        direction: Vec2::select(distance.above(S::zero()), direction, Vec2::zero()),
        along_a: link.along_a,
        along_b: link.along_b,
    }
}

// Both compute the numbers of `relation` in one order, so that a recording of the distance and of the segment has every
// number once.

/// Returns the shortest segment from a point to a segment at some distance.
#[inline(always)]
pub(crate) fn way_to_segment<S: Scalar>(
    point: Vec2<S>,
    segment: Segment2<S>,
    distance: S,
) -> ShortestLink<S> {
    let (a, b) = (point.core(), segment.core());
    let scale = scale_of::<S>(a.extent(point).most(b.extent(point)));
    let (a, b) = (a.placed(point, scale), b.placed(point, scale));
    way(flipped(link(b.edge, a.0, S::zero())).mean(), distance)
}

/// Returns the shortest segment between two segments at some distance.
#[inline(always)]
pub(crate) fn way_between_segments<S: Scalar>(
    a: Segment2<S>,
    b: Segment2<S>,
    distance: S,
) -> ShortestLink<S> {
    let (a, b) = (a.core(), b.core());
    let origin = a.anchor();
    let scale = scale_of::<S>(a.extent(origin).most(b.extent(origin)));
    let (a, b) = (a.placed(origin, scale), b.placed(origin, scale));
    let (zero, one) = (S::zero(), S::one());
    let ([from_a, to_a], [from_b, to_b]) = (a.corners(), b.corners());
    let of_b = link(a.edge, from_b, zero).less(link(a.edge, to_b, one));
    let of_a = link(b.edge, from_a, zero).less(link(b.edge, to_a, one));
    way(of_b.less(flipped(of_a)).mean(), distance)
}

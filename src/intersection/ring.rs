//! Segments and polygons of any kind, edge by edge.
use crate::distance::edge::{scale_of, size_of};
use crate::scalar::Guard;
use crate::{Scalar, Segment2, Vec2};

/// Returns the part of the edge between two points in the share of a segment that lies inside a ring, in
/// `[−1, 1]`.
///
/// The winding number around the segment's point at parameter s is the number of edges that cross its line
/// upwards (from right to left) beyond s, less those that do so downwards. Integrated over the
/// segment, an edge that crosses the line at parameter t counts ±t, cut to `[0, 1]`: the sum over all
/// edges is the mean winding number along the segment. For a counter-clockwise ring with clockwise
/// holes it is the share of the segment that lies inside.
///
/// An edge includes its lower end and excludes its upper one, seen along the segment; an edge along the segment counts
/// as on its left.
#[must_use]
#[inline]
pub fn edge_inside<S: Scalar>(segment: Segment2<S>, from: Vec2<S>, to: Vec2<S>) -> S {
    let (along, a, b) = (segment.along(), from - segment.from, to - segment.from);
    let scale = scale_of::<S>(size_of(along).most(size_of(a)).most(size_of(b)));
    let (d, a, b) = (along * scale, a * scale, b * scale);
    let (zero, one) = (S::zero(), S::one());
    let (side_a, side_b) = (d.perp_dot(a), d.perp_dot(b));
    let up = side_a.below(zero) & side_b.at_least(zero);
    let down = side_b.below(zero) & side_a.at_least(zero);
    // t = a × (b − a) / (d × (b − a)), cut before the division.
    let turn = S::select(up, side_b - side_a, side_a - side_b);
    let over = S::select(up, a.perp_dot(b), b.perp_dot(a));
    let crosses = (up | down) & turn.above(zero);
    let turn = S::select(crosses, turn, one);
    let t = S::select(crosses, over, zero).clamp(zero, turn).over(turn);
    S::select(down, -t, t)
}

/// Returns the length of the part of a segment that lies in a ring of any kind and either orientation; parts
/// that a ring winds around twice count twice.
///
/// Derivatives: exact for the segment and every vertex. Kinks: an end on the border, where the derivative is
/// shared; a segment along an edge, where the length jumps. No vertices: 0.
///
/// ```
/// use geograd::{Segment2, Vec2, intersection::length_inside_ring};
/// let notched = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)];
/// let ring = notched.map(|(x, y)| Vec2::new(x, y));
/// let way = Segment2::new(Vec2::new(-1.0, 2.5), Vec2::new(9.0, 2.5));
/// assert_eq!(length_inside_ring(way, &ring), 2.0);
/// ```
#[must_use]
#[inline]
pub fn length_inside_ring<S: Scalar<Mask = bool>>(segment: Segment2<S>, ring: &[Vec2<S>]) -> S {
    let guard = ring
        .iter()
        .fold(Guard::of(&segment), |all, vertex| all.and(vertex));
    let previous = ring.last().into_iter().chain(ring);
    let share = previous
        .zip(ring)
        .map(|(&from, &to)| edge_inside(segment, from, to))
        .fold(S::zero(), |sum, edge| sum + edge);
    guard.result((share.unsigned() * segment.length()).canonical())
}

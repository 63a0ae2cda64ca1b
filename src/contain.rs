//! Tests whether a point lies in a polygon, and its distance from the border.
//!
//! Borders belong to the polygon. [`winding_number`] and [`locate`] decide exactly; [`crossing`] is the straight-line
//! body of a fold over edges, for batches, exact except for rounding on the border itself.
use crate::distance::edge_winding;
use crate::predicate::{Turn, same, turn};
use crate::reference::Reference;
use crate::shape::edges;
use crate::{Aabb2, ConvexPolygon, Scalar, Vec2};

/// The location of a point relative to rings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Location {
    /// On an edge or a vertex of a ring.
    Border,
    /// Not on the border; how often the rings wind around it counter-clockwise.
    Off(i32),
}

/// Returns the contribution of an edge to the winding number of a ring around a point: +1 where it passes to the right
/// of the point upwards, −1 downwards, else 0. The sum over a closed ring is the winding number; its odd values are the
/// inside by the even-odd rule. Straight line, no derivative.
///
/// An edge has its lower end and not its upper one. Sunday, Inclusion of a point in a polygon, 2001. Backwards it
/// contributes the opposite, so that a point on the common edge of two polygons is in one of them, however it rounds.
///
/// ```
/// use geograd::{Vec2, contain::crossing, shape::edges};
/// let ring = [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
/// let around = |p| edges(&ring).map(|[a, b]| crossing(a, b, p)).sum::<f64>();
/// assert_eq!((around(Vec2::new(0.5, 0.5)), around(Vec2::new(1.5, 1.5))), (1.0, 0.0));
/// ```
#[must_use]
#[inline(always)]
pub fn crossing<S: Scalar>(start: Vec2<S>, end: Vec2<S>, point: Vec2<S>) -> S {
    edge_winding(point, start, end)
}

/// Returns the location of a point with respect to some rings, decided exactly.
///
/// ```
/// use geograd::{Aabb2, Vec2, contain::{Location, locate}};
/// let square = Aabb2::new(0.0, 0.0, 2.0, 2.0).corners();
/// assert_eq!(locate(&[&square], Vec2::new(1.0, 1.0)), Location::Off(1));
/// assert_eq!(locate(&[&square], Vec2::new(2.0, 1.0)), Location::Border);
/// assert_eq!(locate(&[&square], Vec2::new(3.0, 0.0)), Location::Off(0));
/// ```
#[must_use]
pub fn locate<S: Scalar<Mask = bool>>(rings: &[&[Vec2<S>]], point: Vec2<S>) -> Location {
    let mut winding = 0;
    for ring in rings {
        // Edges to each vertex, which are told apart sooner than those of `edges`.
        let Some(&(mut from)) = ring.last() else {
            continue;
        };
        let edges = ring
            .iter()
            .map(|&to| [std::mem::replace(&mut from, to), to]);
        match locate_by(edges, point) {
            Location::Border => return Location::Border,
            Location::Off(own) => winding += own,
        }
    }
    Location::Off(winding)
}

/// Returns the location of a point with respect to edges of closed rings. Edges above, below or to the left of the point may
/// be left out.
#[inline]
pub(crate) fn locate_by<S: Scalar<Mask = bool>>(
    edges: impl Iterator<Item = [Vec2<S>; 2]>,
    point: Vec2<S>,
) -> Location {
    let mut winding = 0;
    for [start, end] in edges {
        let is_above = start.y.above(point.y) & end.y.above(point.y);
        let is_below = start.y.below(point.y) & end.y.below(point.y);
        let is_left = start.x.below(point.x) & end.x.below(point.x);
        if is_above | is_below | is_left {
            continue;
        }
        let (low, high) = match start.y.at_most(end.y) {
            true => (start, end),
            false => (end, start),
        };
        if low.y.equals(high.y) {
            let inside = |p: Vec2<S>, q: Vec2<S>| p.x.at_most(point.x) && point.x.at_most(q.x);
            if inside(start, end) || inside(end, start) {
                return Location::Border;
            }
            continue;
        }
        if same(point, low) || same(point, high) {
            return Location::Border;
        }
        match turn(low, high, point) {
            Turn::Straight => return Location::Border,
            Turn::Left if point.y.below(high.y) => {
                winding += if start.y.below(end.y) { 1 } else { -1 };
            }
            _ => {}
        }
    }
    Location::Off(winding)
}

/// Returns the winding number of a ring around a point, counter-clockwise positive, decided exactly; `None` on the
/// border.
#[must_use]
pub fn winding_number<S: Scalar<Mask = bool>>(ring: &[Vec2<S>], point: Vec2<S>) -> Option<i32> {
    match locate(&[ring], point) {
        Location::Border => None,
        Location::Off(winding) => Some(winding),
    }
}

/// Returns `true` if a point is on the border of some rings or they wind around it a number of times that is not
/// zero (the non-zero rule). Holes are rings of the other orientation.
#[must_use]
pub fn contains<S: Scalar<Mask = bool>>(rings: &[&[Vec2<S>]], point: Vec2<S>) -> bool {
    locate(rings, point) != Location::Off(0)
}

/// Returns `true` if a point is on the border of some rings or they wind around it an odd number of times (the
/// even-odd rule). Holes may have either orientation.
#[must_use]
pub fn contains_even_odd<S: Scalar<Mask = bool>>(rings: &[&[Vec2<S>]], point: Vec2<S>) -> bool {
    match locate(rings, point) {
        Location::Border => true,
        Location::Off(winding) => winding % 2 != 0,
    }
}

/// The part of an edge that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Nearest {
    /// The edge's start.
    Start,
    /// A point between its ends.
    Between,
    /// The edge's end.
    End,
}

/// The record of a depth: the point of a polygon's border that is nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NearestEdge {
    /// The ring ...
    pub ring: usize,
    /// ... and the edge of it nearest to the point, by the number of its start.
    pub edge: usize,
    /// The part of that edge.
    pub part: Nearest,
    /// `true` if the point is in the polygon by the non-zero rule; its border belongs to it.
    pub inside: bool,
}

/// Returns the distance of a point from the border of a polygon, in units of length, positive inside, negative outside,
/// and the record of its decisions. `None` for rings without vertices. (The sign is the DGAL paper's, opposite to that
/// of [`signed_distance`](crate::distance::signed_distance()).)
///
/// The sign is decided by winding numbers, so it is right where the point is on the extension of an edge. Kinks:
/// several nearest points (the medial axis), and the border, where both one-sided derivatives are those of the inside.
/// Derivatives: see [`depth_replay`].
///
/// ```
/// use geograd::{Aabb2, Vec2, contain::depth_search};
/// let square = Aabb2::new(0.0, 0.0, 1.0, 1.0).corners();
/// let depth = |x, y| depth_search(&[&square], Vec2::new(x, y)).unwrap().0;
/// assert_eq!((depth(2.0, 0.0), depth(2.0, 0.5), depth(0.5, 0.25)), (-1.0, -1.0, 0.25));
/// ```
#[must_use]
pub fn depth_search<S: Scalar<Mask = bool>>(
    rings: &[&[Vec2<S>]],
    point: Vec2<S>,
) -> Option<(S, NearestEdge)> {
    let inside = contains(rings, point);
    let bounds = crate::overlap_polygon::bounds_of_rings(rings)?;
    let here = crate::reference::bounds_of(&[point])?;
    let seen = Reference::of_bounds(Aabb2::join(bounds, here));
    let at = seen.place(point);
    let mut best: Option<(S::Primal, NearestEdge)> = None;
    for (ring, vertices) in rings.iter().enumerate() {
        for (edge, ends) in edges(vertices).enumerate() {
            let [start, end] = ends.map(|v| seen.place(v));
            let (along, to_point) = (end - start, at - start);
            let (way, length) = (to_point.dot(along), along.length_squared());
            let (part, squared) = if way.at_most(S::zero()) {
                (Nearest::Start, to_point.length_squared())
            } else if way.at_least(length) {
                (Nearest::End, (at - end).length_squared())
            } else {
                let off = along.perp_dot(to_point);
                (Nearest::Between, (off * off).over(length))
            };
            let squared = squared.primal();
            if best.is_none_or(|(least, _)| squared.below(least)) {
                let record = NearestEdge {
                    ring,
                    edge,
                    part,
                    inside,
                };
                best = Some((squared, record));
            }
        }
    }
    best.map(|(_, record)| (depth_replay(rings, point, record), record))
}

/// Returns the signed distance of a point from the part of an edge that a record names. Its derivatives are to the
/// point and to that edge's ends. At distance zero between the ends of an edge, the derivative is that of the side on
/// the edge's left, else zero.
///
/// # Panics
///
/// When the record names a ring or an edge that is not there.
#[must_use]
pub fn depth_replay<S: Scalar>(rings: &[&[Vec2<S>]], point: Vec2<S>, record: NearestEdge) -> S {
    let ring = rings[record.ring];
    let next = if record.edge + 1 < ring.len() {
        record.edge + 1
    } else {
        0
    };
    let (start, end) = (ring[record.edge], ring[next]);
    let seen = Reference::of_ring(&[start, end, point]);
    let [start, end, at] = [start, end, point].map(|v| seen.place(v));
    let distance = match record.part {
        Nearest::Start => (at - start).length(),
        Nearest::End => (at - end).length(),
        Nearest::Between => (end - start)
            .normalize_or_zero()
            .perp_dot(at - start)
            .unsigned(),
    };
    let signed = if record.inside { distance } else { -distance };
    seen.outer(signed).saturated().canonical()
}

impl<S: Scalar, const N: usize> ConvexPolygon<S, N> {
    /// Returns `true` if a point is in the polygon; the border belongs to it. Search exactly.
    #[must_use]
    #[inline]
    pub fn contains(&self, point: Vec2<S>) -> bool
    where
        S: Scalar<Mask = bool>,
    {
        contains(&[self.as_slice()], point)
    }
    /// Returns the distance of a point from the border: positive inside, negative outside; zero without vertices.
    #[must_use]
    #[inline]
    pub fn depth(&self, point: Vec2<S>) -> S
    where
        S: Scalar<Mask = bool>,
    {
        depth_search(&[self.as_slice()], point).map_or(S::zero(), |(value, _)| value)
    }
}

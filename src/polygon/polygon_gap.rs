//! The distance of two polygons: one vertex of each, a line between both, then boxes of edges.
use super::box_ends::{Ends, NOWHERE, joined, squared_gap};
use super::edge_boxes::{EdgeBoxes, Search, around, seen};
use super::{Fill, Rings};
use crate::{Scalar, Vec2};

/// The most edges of a list that are looked at before boxes are made, which takes as long.
const MANY: usize = 1024;

/// Returns the distance of the areas of two polygons, in units of length; 0 with derivative zero where they meet or one
/// contains the other, by the even-odd rule. Largest finite number where one has no vertices.
///
/// Search by a line between both and by boxes, of time in proportion to the number of vertices for polygons that are not
/// long beside each other.
/// The decision that areas meet is exact, but for edges that cross within a rounding.
/// Kinks: several nearest edges, of which the first have the derivative, and polygons that touch.
///
/// ```
/// use geograd::{Aabb2, Rings, polygon};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(7.0, 8.0, 9.0, 9.0).corners());
/// assert_eq!(polygon::distance(&a, &b), 5.0);
/// let inner = Aabb2::new(1.0, 1.0, 2.0, 2.0).corners();
/// assert_eq!(polygon::distance(&a, &inner), 0.0);
/// ```
#[must_use]
pub fn distance<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
) -> S {
    DistanceRoom::default().distance(a, b)
}

/// Memory for [`distance`] between one call and the next.
///
/// ```
/// use geograd::{Aabb2, polygon::DistanceRoom};
/// let square = |x: f64| Aabb2::new(x, 0.0, x + 1.0, 1.0).corners();
/// let mut room = DistanceRoom::default();
/// let gaps = [2.0, 3.0, 0.5].map(|x| room.distance(&square(0.0), &square(x)));
/// assert_eq!(gaps, [1.0, 2.0, 0.0]);
/// ```
#[derive(Clone, Debug)]
pub struct DistanceRoom<S> {
    lists: [EdgeBoxes<S>; 2],
}

impl<S> Default for DistanceRoom<S> {
    /// Creates a room, without memory before its first use.
    fn default() -> Self {
        DistanceRoom {
            lists: [EdgeBoxes::none(), EdgeBoxes::none()],
        }
    }
}

impl<S: Scalar<Mask = bool>> DistanceRoom<S> {
    /// Returns the [`distance`] of two polygons.
    #[must_use]
    pub fn distance<'a>(&mut self, a: impl Into<Rings<'a, S>>, b: impl Into<Rings<'a, S>>) -> S {
        let (a, b) = (a.into(), b.into());
        let [own, other] = &mut self.lists;
        let (Some(whole), Some(others)) = (whole(a), whole(b)) else {
            return S::largest();
        };
        let wholes = [whole, others];
        // A search of edges takes longer than a decision for one vertex, which often settles overlaps.
        let is_near = squared_gap(wholes[0], wholes[1]) <= 0.0;
        if is_near && (a.holds_one_of(wholes[0], b) || b.holds_one_of(wholes[1], a)) {
            return S::zero();
        }
        own.take(a);
        other.take(b);
        let mut search = Search::new([own, other], wholes);
        let best = if search.all_few(wholes, MANY) {
            search.best
        } else {
            own.build();
            other.build();
            let mut search = Search::new([own, other], wholes);
            search.by_boxes();
            search.best
        };
        best.map_or(S::largest(), |best| best.distance)
    }
}

impl<S: Scalar<Mask = bool>> Rings<'_, S> {
    /// Returns `true` if the first vertex of some ring of another polygon is inside by the even-odd rule, or on the
    /// border. Of polygons whose edges are apart it says whether one contains a part of the other.
    #[must_use]
    pub fn holds_a_ring_of(&self, other: Rings<'_, S>) -> bool {
        whole(*self).is_some_and(|whole| self.holds_one_of(whole, other))
    }
    /// Decides the same, given the box around the polygon.
    #[inline(always)]
    fn holds_one_of(&self, whole: Ends, other: Rings<'_, S>) -> bool {
        let mut firsts = other.iter().filter_map(<[_]>::first);
        firsts.any(|&v| {
            squared_gap(whole, around(&[[v; 2]])) <= 0.0 && self.contains(v, Fill::EvenOdd)
        })
    }
}

/// Returns the box around a polygon; `None` without vertices.
#[inline(always)]
fn whole<S: Scalar>(rings: Rings<'_, S>) -> Option<Ends> {
    let mut found = None;
    for ring in rings.iter().filter(|ring| !ring.is_empty()) {
        let at = |v: Vec2<S>| [seen(v.x), seen(v.y)];
        // Two boxes: the comparisons of one vertex need not wait for those of the one before.
        let (mut one, mut other) = (found.unwrap_or(NOWHERE), NOWHERE);
        let pairs = ring.chunks_exact(2);
        if let &[last] = pairs.remainder() {
            one = joined(one, at(last));
        }
        for pair in pairs {
            (one, other) = (joined(one, at(pair[0])), joined(other, at(pair[1])));
        }
        found = Some(joined(one, other));
    }
    found
}

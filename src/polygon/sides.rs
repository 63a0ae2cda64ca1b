//! The rings that are holes: decided once, by their position.
use super::Rings;
use crate::contain::{Location, locate};
use crate::reference::bounds_of;
use crate::shape::edges;
use crate::{Aabb2, Scalar, Vec2, ring};

/// The rings that have their inside on their right, and so count in the opposite orientation as borders of the polygon.
/// A decision without numbers, for rings that do not cross. A ring that lies in an even number of others bounds a part,
/// one that lies in an odd number a hole.
///
/// ```
/// use geograd::{Aabb2, polygon::Sides};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 2.0, 2.0).corners());
/// let rings = [outer.as_slice(), &hole];
/// let sides = Sides::decided(&rings[..]);
/// assert_eq!([sides.is_turned(0), sides.is_turned(1)], [false, true]);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sides {
    first: bool,
    /// The sides of the second ring and further ones: a polygon of one ring needs no memory.
    others: Vec<bool>,
}

impl Sides {
    /// All rings count as they run.
    pub const AS_GIVEN: Sides = Sides {
        first: false,
        others: Vec::new(),
    };

    /// Decides it, from the signs of areas and exact tests of vertices. The later one of two identical rings lies
    /// in the earlier one.
    #[must_use]
    pub fn decided<'a, S: Scalar<Mask = bool>>(rings: impl Into<Rings<'a, S>>) -> Self {
        let rings = rings.into();
        // One ring has none around it.
        let bounds: Vec<_> = match rings.count() {
            0 | 1 => Vec::new(),
            _ => rings.iter().map(bounds_of).collect(),
        };
        // Outside of a ring's bounds a vertex is outside of the ring.
        let is_beyond = |vertex: Vec2<S>, around: &Option<Aabb2<S>>| {
            around.is_some_and(|own| {
                vertex.x.below(own.min.x)
                    || vertex.x.above(own.max.x)
                    || vertex.y.below(own.min.y)
                    || vertex.y.above(own.max.y)
            })
        };
        let turned = |k: usize| {
            let here = rings.ring(k);
            let clockwise = ring::signed_area(here).below(S::zero());
            let around = (0..rings.count()).filter(|&j| j != k);
            let around =
                around.filter(|&j| !here.first().is_some_and(|&v| is_beyond(v, &bounds[j])));
            let depth = around
                .filter(|&j| lies_in(here, rings.ring(j), j < k))
                .count();
            clockwise != (depth % 2 == 1)
        };
        Sides {
            first: rings.count() > 0 && turned(0),
            others: (1..rings.count()).map(turned).collect(),
        }
    }
    /// Returns `true` if a ring counts in the opposite orientation.
    #[must_use]
    #[inline]
    pub fn is_turned(&self, ring: usize) -> bool {
        match ring.checked_sub(1) {
            None => self.first,
            Some(k) => self.others.get(k).copied().unwrap_or(false),
        }
    }
    /// Returns one, or minus one for rings that are counted in the opposite orientation.
    #[inline(always)]
    pub(crate) fn sign<S: Scalar>(&self, ring: usize) -> S {
        S::lit(if self.is_turned(ring) { -1.0 } else { 1.0 })
    }
}

/// Returns `true` if a ring lies in another one, both not crossing.
fn lies_in<S: Scalar<Mask = bool>>(
    inner: &[Vec2<S>],
    outer: &[Vec2<S>],
    where_identical: bool,
) -> bool {
    // Vertices may lie on the other border. Between two of them there is then a point that does not.
    let between = edges(inner)
        .map(|[p, q]| Vec2::new(p.x.halved() + q.x.halved(), p.y.halved() + q.y.halved()));
    let places = inner.iter().copied().chain(between);
    let found = places
        .map(|at| locate(&[outer], at))
        .find_map(|at| match at {
            Location::Border => None,
            Location::Off(winding) => Some(winding % 2 != 0),
        });
    found.unwrap_or(where_identical)
}

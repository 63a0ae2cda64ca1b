//! Overlap of two polygons of any shape, with holes and of many parts: nothing is clipped, no polygon is built, and
//! nothing is allocated for polygons of one ring.
//!
//! Rings have either orientation and do not cross (points in an odd number of them are inside): see
//! [`polygon`](crate::polygon). Crossing and self-intersecting rings are for [`boolean`](crate::boolean). The method is
//! the sum over pairs of edges of the [parent](super) module, `O(n m)`, and so are the kinks. Adjoints:
//! [`ad::adjoint::overlap_rings`](crate::ad::adjoint::overlap_rings).
use super::{between, shared_twice};
use crate::overlap::{ratio_of_first, ratio_of_union};
use crate::polygon::{Rings, Sides};
use crate::reference::Reference;
use crate::{Scalar, Vec2};

/// A tile of edges of one polygon, processed together.
const TILE: usize = 32;

/// Some edges of a polygon, in local coordinates.
pub(crate) struct Tile<S> {
    /// Both ends.
    pub edges: [[Vec2<S>; 2]; TILE],
    /// Twice the area of the triangle over each, as it runs.
    pub twice: [S; TILE],
    /// One, or minus one if the edge counts in the opposite direction.
    pub signs: [S; TILE],
    /// The numbers of both ends among all vertices.
    pub numbers: [[usize; 2]; TILE],
    /// The number of edges.
    pub count: usize,
}

/// Two polygons in the local frame of a measure.
pub(crate) struct RingsPair<'a, S: Scalar> {
    pub rings: [Rings<'a, S>; 2],
    pub sides: [Sides; 2],
    pub seen: Reference<S>,
    /// `true` if b is the smaller one.
    pub in_b: bool,
    /// `true` if nothing is shared: value and derivatives are zero.
    pub apart: bool,
    /// `true` if both have equal vertices in one order.
    pub same: bool,
}

impl<'a, S: Scalar<Mask = bool>> RingsPair<'a, S> {
    /// Returns `None` where neither has vertices.
    pub fn new(a: Rings<'a, S>, b: Rings<'a, S>) -> Option<Self> {
        let (bounds_a, bounds_b) = (a.bounds(), b.bounds());
        let empty = bounds_a.is_none() || bounds_b.is_none();
        let (bounds_a, bounds_b) = (bounds_a.or(bounds_b)?, bounds_b.or(bounds_a)?);
        let (seen, in_a, apart) = Reference::of_pair(bounds_a, bounds_b);
        let inner = match in_a {
            true => bounds_a,
            false => bounds_b,
        };
        // Inside those bounds, at no simple fraction of them: no vertex is to be expected there.
        let (low, high) = (seen.place(inner.min), seen.place(inner.max));
        let size = high - low;
        let share = [S::lit(0.463_647_609), S::lit(0.540_302_306)];
        let at = low + Vec2::new(size.x * share[0], size.y * share[1]);
        let alike = |v: (Vec2<S>, Vec2<S>)| v.0.x.equals(v.1.x) && v.0.y.equals(v.1.y);
        let same = a.count() == b.count()
            && (0..a.count()).all(|k| {
                let (p, q) = (a.ring(k), b.ring(k));
                p.len() == q.len() && p.iter().copied().zip(q.iter().copied()).all(alike)
            });
        Some(RingsPair {
            rings: [a, b],
            sides: [Sides::decided(a), Sides::decided(b)],
            seen: seen.shifted(at),
            in_b: !in_a,
            apart: apart || empty,
            same,
        })
    }
    /// Calls a function for every tile of edges of one of them.
    #[inline(always)]
    pub fn each_tile(&self, which: usize, mut f: impl FnMut(&Tile<S>)) {
        let zero = Vec2::zero();
        let mut tile = Tile {
            edges: [[zero; 2]; TILE],
            twice: [S::zero(); TILE],
            signs: [S::zero(); TILE],
            numbers: [[0; 2]; TILE],
            count: 0,
        };
        self.rings[which].each_edge(|ring, numbers, ends| {
            let k = tile.count;
            let edge = ends.map(|v| self.seen.place(v));
            tile.edges[k] = edge;
            tile.twice[k] = edge[0].perp_dot(edge[1]);
            tile.signs[k] = self.sides[which].sign(ring);
            tile.numbers[k] = numbers;
            tile.count += 1;
            if tile.count == TILE {
                f(&tile);
                tile.count = 0;
            }
        });
        if tile.count > 0 {
            f(&tile);
        }
    }
    /// Returns the area of one of them, in local units.
    pub fn own_area(&self, which: usize) -> S {
        let mut sum = S::zero();
        self.each_tile(which, |tile| {
            for k in 0..tile.count {
                sum += tile.twice[k] * tile.signs[k];
            }
        });
        sum.halved()
    }
    /// Returns the shared area, the area of a and the area of b, in local units.
    pub fn areas(&self) -> [S; 3] {
        let (area_a, area_b) = (self.own_area(0), self.own_area(1));
        if self.apart {
            return [S::zero(), area_a, area_b];
        }
        if self.same {
            return [area_a.halved() + area_b.halved(), area_a, area_b];
        }
        let mut twice = S::zero();
        self.each_tile(1, |g| {
            self.each_tile(0, |f| {
                for i in 0..f.count {
                    let mut sum = S::zero();
                    for k in 0..g.count {
                        let areas = [f.twice[i], g.twice[k]];
                        if let Some(pair) = between(f.edges[i], g.edges[k], areas) {
                            sum += shared_twice(&pair, self.in_b) * g.signs[k];
                        }
                    }
                    twice += sum * f.signs[i];
                }
            });
        });
        let area = twice.halved();
        let limit = area_a.primal().least(area_b.primal());
        if area.at_most(S::zero()) {
            return [S::zero(), area_a, area_b];
        }
        let beyond = area.above(S::from_primal(limit));
        let area = S::select(beyond, area.with_primal(limit), area);
        [area, area_a, area_b]
    }
    /// Returns a local area in the caller's unit.
    pub fn outer(&self, area: S) -> S {
        let area = self.seen.outer(self.seen.outer(area));
        area.saturated().canonical()
    }
}

/// Returns the area that two polygons share, from 0 to the area of the smaller one, in squared units of length. Exactly
/// zero where their bounds are apart; of polygons apart whose bounds overlap, to a few roundings of the smaller area.
/// See the [module](self).
///
/// ```
/// use geograd::{Aabb2, overlap_polygon::holed::intersection_area};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// let frame = [outer.as_slice(), &hole];
/// let half = Aabb2::new(0.0, 0.0, 2.0, 4.0).corners();
/// assert!((intersection_area(&frame[..], &half) - 6.0_f64).abs() < 1e-14);
/// ```
#[must_use]
pub fn intersection_area<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
) -> S {
    RingsPair::new(a.into(), b.into()).map_or(S::zero(), |pair| pair.outer(pair.areas()[0]))
}

/// Returns the area that two polygons cover together, in squared units of length. See the [module](self).
///
/// ```
/// use geograd::{Aabb2, overlap_polygon::holed::union_area};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 2.0, 2.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// assert!((union_area(&a, &b) - 7.0_f64).abs() < 1e-14);
/// ```
#[must_use]
pub fn union_area<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
) -> S {
    RingsPair::new(a.into(), b.into()).map_or(S::zero(), |pair| {
        let [inter, area_a, area_b] = pair.areas();
        pair.outer(area_a + area_b - inter)
    })
}

/// Returns the intersection over union of two polygons, in `[0, 1]`; exactly 1 with derivative zero if the vertices are
/// equal, zero with derivative zero where their bounds are apart or the union is empty. For polygons apart whose bounds
/// overlap it is zero to a few roundings, and so are its derivatives. See the [module](self).
///
/// ```
/// use geograd::{Aabb2, Polygon, overlap_polygon::holed::iou};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// let frame = Polygon::from_rings([&outer[..], &hole]);
/// assert!((iou(&frame, &outer) - 0.75_f64).abs() < 1e-15);
/// let (same, derivatives) = geograd::gradient(|(a, b): (Polygon<_>, Polygon<_>)| iou(&a, &b), (frame.clone(), frame));
/// assert_eq!((same, derivatives.0.ring(1)[2].x), (1.0, 0.0));
/// ```
#[must_use]
pub fn iou<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
) -> S {
    RingsPair::new(a.into(), b.into()).map_or(S::zero(), |pair| {
        let [inter, area_a, area_b] = pair.areas();
        ratio_of_union(inter, area_a, area_b).canonical()
    })
}

/// Returns the share of the first polygon that lies in the second, in `[0, 1]`; zero with derivative zero where the
/// first has no area. See the [module](self).
#[must_use]
pub fn iof<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
) -> S {
    RingsPair::new(a.into(), b.into()).map_or(S::zero(), |pair| {
        let [inter, area_a, _] = pair.areas();
        ratio_of_first(inter, area_a).canonical()
    })
}

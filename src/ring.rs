//! Rings: closed polygons given as a slice of vertices, of any number.
//!
//! The last vertex is joined to the first. Repeated vertices, fewer than three vertices, zero area
//! and self-intersection are valid: the functions are sums over edges and say what they give.
//! Vertices are taken relative to the first one and in units of the ring's own extent, so neither
//! the distance from the origin nor the size costs digits.
use crate::{Scalar, Vec2};

/// A ring in its own frame: the first vertex at the origin, lengths multiplied by a power of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local<'a, S> {
    ring: &'a [Vec2<S>],
    /// What lengths were multiplied by; a constant.
    pub scale: S,
}

impl<'a, S: Scalar> Local<'a, S> {
    #[inline(always)]
    pub fn new(ring: &'a [Vec2<S>]) -> Self {
        let unscaled = Local {
            ring,
            scale: S::one(),
        };
        let extent = (0..ring.len()).fold(S::Primal::zero(), |extent, i| {
            let at = unscaled.halved(i);
            extent
                .most(at.x.primal().magnitude())
                .most(at.y.primal().magnitude())
        });
        let point = extent.at_most(S::Primal::zero());
        let scale = S::Primal::select(point, S::Primal::one(), extent).binade();
        // Halved, because the vertices are.
        Local {
            ring,
            scale: S::from_primal(S::Primal::select(point, S::Primal::one(), scale)),
        }
    }
    /// Half the way from the first vertex to vertex `i`: the whole way may not be finite.
    #[inline(always)]
    fn halved(&self, i: usize) -> Vec2<S> {
        let (at, first) = (self.ring[i], self.ring[0]);
        Vec2::new(
            at.x.halved() - first.x.halved(),
            at.y.halved() - first.y.halved(),
        )
    }
    /// Vertex `i` in the local frame.
    #[inline(always)]
    pub fn at(&self, i: usize) -> Vec2<S> {
        self.halved(i) * self.scale
    }
    /// The index after `i`, around the ring.
    #[inline(always)]
    pub fn after(&self, i: usize) -> usize {
        if i + 1 == self.ring.len() { 0 } else { i + 1 }
    }
    /// The edges: start and end of each.
    #[inline(always)]
    pub fn edges(self) -> impl Iterator<Item = (Vec2<S>, Vec2<S>)> {
        (0..self.ring.len()).map(move |i| (self.at(i), self.at(self.after(i))))
    }
    /// A local length in the caller's unit.
    #[inline(always)]
    pub fn outer(&self, length: S) -> S {
        (length + length).over(self.scale)
    }
    /// Twice the signed area, in the local unit.
    #[inline(always)]
    pub fn twice_area(self) -> S {
        let mut twice = S::zero();
        for (start, end) in self.edges() {
            twice += start.perp_dot(end);
        }
        twice
    }
}

/// The signed area of a ring, in squared units of length: positive when it runs counter-clockwise.
/// Saturates at the largest finite number.
///
/// Each region counts as often as the ring winds around it. Zero for fewer than three vertices.
/// Smooth everywhere. Source: the shoelace formula.
///
/// ```
/// use geograd::{Vec2, ring::signed_area};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(signed_area(&triangle), 6.0);
/// ```
#[must_use]
pub fn signed_area<S: Scalar>(ring: &[Vec2<S>]) -> S {
    let local = Local::new(ring);
    local
        .outer(local.outer(local.twice_area().halved()))
        .saturated()
}

/// The perimeter of a ring, in units of length: the sum of the lengths of its edges. Saturates at
/// the largest finite number.
///
/// Zero for fewer than two vertices; two vertices count their distance twice. Kink: an edge of
/// length zero, where the slope is zero.
///
/// ```
/// use geograd::{Vec2, ring::perimeter};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(perimeter(&triangle), 12.0);
/// ```
#[must_use]
pub fn perimeter<S: Scalar>(ring: &[Vec2<S>]) -> S {
    let local = Local::new(ring);
    let mut sum = S::zero();
    for (start, end) in local.edges() {
        sum += (end - start).length();
    }
    local.outer(sum).saturated()
}

/// The centroid of the area of a ring (not of its vertices): where a plate of that shape balances.
///
/// Where the signed area is exactly zero (fewer than three vertices, collinear vertices, a
/// symmetric figure of eight) there is no such point: the mean of the vertices is returned, with
/// its slope; the origin for no vertices. That case is a jump, and near it the result grows without
/// bound for rings whose lobes cancel (it saturates at the largest finite number). Source: Green's
/// theorem.
///
/// ```
/// use geograd::{Vec2, ring::centroid};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(3.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(centroid(&triangle), Vec2::new(1.0, 1.0));
/// ```
#[must_use]
pub fn centroid<S: Scalar>(ring: &[Vec2<S>]) -> Vec2<S> {
    let Some(&first) = ring.first() else {
        return Vec2::zero();
    };
    let local = Local::new(ring);
    let (mut twice, mut moment, mut sum) = (S::zero(), Vec2::zero(), Vec2::zero());
    for (start, end) in local.edges() {
        let cross = start.perp_dot(end);
        twice += cross;
        moment += (start + end) * cross;
        sum += start;
    }
    let flat = twice.equals(S::zero());
    let thrice = S::lit(3.0) * S::select(flat, S::one(), twice);
    let count = S::lit(ring.len() as f64);
    let place = |first: S, moment: S, sum: S| {
        let at = S::select(flat, sum.over(count), moment.over(thrice));
        (first + local.outer(at)).saturated()
    };
    Vec2::new(
        place(first.x, moment.x, sum.x),
        place(first.y, moment.y, sum.y),
    )
}

//! Measures of polygons with holes.
use super::{Rings, Sides};
use crate::measure::moments::{AreaMoments, finish, of_edge};
use crate::reference::Reference;
use crate::{Scalar, Vec2, ring};

/// Returns the sums of moments over all rings, each counted by its side, in a local frame.
fn sums<S: Scalar>(rings: Rings<'_, S>, sides: &Sides) -> Option<(Reference<S>, [S; 6])> {
    let seen = Reference::of_moments(rings.bounds()?);
    let mut sums = [S::zero(); 6];
    rings.each_edge(|ring, _, [start, end]| {
        let edge = of_edge(seen.place(start), seen.place(end));
        for (sum, of_edge) in sums.iter_mut().zip(edge) {
            *sum += of_edge * sides.sign(ring);
        }
    });
    Some((seen, sums))
}

/// Returns the area of a polygon whose rings count as they run, in squared units of length: each region as often
/// as the rings wind around it, clockwise negative. Straight line; smooth. Saturates at the largest
/// finite number.
#[must_use]
pub fn signed_area<'a, S: Scalar>(rings: impl Into<Rings<'a, S>>) -> S {
    let mut sum = S::zero();
    for ring in rings.into().iter() {
        sum += ring::signed_area(ring);
    }
    sum.saturated().canonical()
}

/// Returns the area of a polygon, in squared units of length, of rings that do not cross and have either
/// orientation: what an odd number of them enclose. Smooth. Saturates at the largest finite number.
///
/// ```
/// use geograd::{Aabb2, polygon};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 2.0, 2.0).corners());
/// let rings = [outer.as_slice(), &hole];
/// assert_eq!(polygon::area(&rings[..]), 15.0);
/// ```
#[must_use]
pub fn area<'a, S: Scalar<Mask = bool>>(rings: impl Into<Rings<'a, S>>) -> S {
    let rings = rings.into();
    let sides = Sides::decided(rings);
    let mut sum = S::zero();
    for (k, ring) in rings.iter().enumerate() {
        sum += ring::signed_area(ring) * sides.sign(k);
    }
    sum.saturated().canonical()
}

/// Returns the perimeter of a polygon, in units of length: the borders of its holes count, too. Straight line.
/// Kink: an edge of length zero, where the derivative is zero.
#[must_use]
pub fn perimeter<'a, S: Scalar>(rings: impl Into<Rings<'a, S>>) -> S {
    let mut sum = S::zero();
    for ring in rings.into().iter() {
        sum += ring::perimeter(ring);
    }
    sum.saturated().canonical()
}

/// Returns the centroid of the area of a polygon, of rings that do not cross and have either orientation. If the area
/// is exactly zero it is the mean of the vertices (a jump); the origin without vertices.
///
/// ```
/// use geograd::{Aabb2, Vec2, polygon};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(0.0, 0.0, 2.0, 4.0).corners());
/// let rings = [outer.as_slice(), &hole];
/// assert_eq!(polygon::centroid(&rings[..]), Vec2::new(3.0, 2.0));
/// ```
#[must_use]
pub fn centroid<'a, S: Scalar<Mask = bool>>(rings: impl Into<Rings<'a, S>>) -> Vec2<S> {
    let rings = rings.into();
    let Some((seen, [twice, x, y, ..])) = sums(rings, &Sides::decided(rings)) else {
        return Vec2::zero();
    };
    if twice.equals(S::zero()) {
        let share = S::lit(1.0 / rings.vertex_count() as f64);
        let mut mean = Vec2::zero();
        rings.each_edge(|_, _, [start, _]| mean += seen.place(start) * share);
        return seen.outer_place(mean).canonical();
    }
    let thrice = S::lit(3.0) * twice;
    let at = Vec2::new(x.over(thrice), y.over(thrice));
    seen.outer_place(at).canonical()
}

/// Returns the second moments of the area of a polygon about its centroid, in fourth powers of length, of rings
/// that do not cross and have either orientation. Zero where the area is zero.
///
/// ```
/// use geograd::{Aabb2, polygon};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// let rings = [outer.as_slice(), &hole];
/// let moments = polygon::second_moments(&rings[..]);
/// assert!((moments.xx - 240.0_f64 / 12.0).abs() < 1e-13 && moments.xy.abs() < 1e-13);
/// ```
#[must_use]
pub fn second_moments<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
) -> AreaMoments<S> {
    let rings = rings.into();
    match sums(rings, &Sides::decided(rings)) {
        Some((seen, sums)) => finish(sums, &seen),
        None => AreaMoments {
            xx: S::zero(),
            yy: S::zero(),
            xy: S::zero(),
        },
    }
}

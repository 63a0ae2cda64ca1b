//! The location of a point relative to a polygon.
use super::{Fill, Rings};
use crate::contain::{Location, locate};
use crate::distance::ring::{EdgeFold, fold_ring};
use crate::{Scalar, Vec2};

impl Location {
    /// Returns `true` inside by a fill rule, and on the border.
    pub(crate) fn is_inside(self, fill: Fill) -> bool {
        match (self, fill) {
            (Location::Border, _) => true,
            (Location::Off(winding), Fill::NonZero) => winding != 0,
            (Location::Off(winding), Fill::EvenOdd) => winding % 2 != 0,
        }
    }
}

impl<S: Scalar<Mask = bool>> Rings<'_, S> {
    /// Returns the location of a point: on the border, or the winding number of the rings around it. Search exactly.
    #[must_use]
    pub fn locate(&self, point: Vec2<S>) -> Location {
        let mut sum = 0;
        for ring in self.iter() {
            match locate(&[ring], point) {
                Location::Border => return Location::Border,
                Location::Off(winding) => sum += winding,
            }
        }
        Location::Off(sum)
    }
    /// Returns `true` if a point is in the polygon by a fill rule; its border belongs to it. Search exactly.
    ///
    /// ```
    /// use geograd::{Aabb2, Rings, Vec2, polygon::Fill};
    /// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 2.0, 2.0).corners());
    /// let rings = [outer.as_slice(), &hole];
    /// let rings = Rings::from(&rings[..]);
    /// let at = Vec2::new(1.5, 1.5); // both rings run counter-clockwise
    /// assert!(rings.contains(at, Fill::NonZero) && !rings.contains(at, Fill::EvenOdd));
    /// ```
    #[must_use]
    pub fn contains(&self, point: Vec2<S>, fill: Fill) -> bool {
        self.locate(point).is_inside(fill)
    }
    /// Returns the distance of a point from the nearest edge of any ring, in units of length: positive inside, negative
    /// outside, by a fill rule. Without vertices it is the lowest finite number.
    ///
    /// The sign is decided exactly. Derivatives are exact for the point and the ends of the nearest edge.
    /// Kinks: several nearest edges, which share the derivative equally, and the border, where it is zero.
    ///
    /// ```
    /// use geograd::{Aabb2, Rings, Vec2, polygon::Fill};
    /// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
    /// let rings = [outer.as_slice(), &hole];
    /// let rings = Rings::from(&rings[..]);
    /// assert_eq!(rings.depth(Vec2::new(0.25, 2.0), Fill::EvenOdd), 0.25);
    /// assert_eq!(rings.depth(Vec2::new(1.5, 2.0), Fill::EvenOdd), -0.5);
    /// ```
    #[must_use]
    pub fn depth(&self, point: Vec2<S>, fill: Fill) -> S {
        let distance = self.fold(point).distance();
        let signed = match self.contains(point, fill) {
            true => distance,
            false => -distance,
        };
        signed.canonical()
    }
    /// Returns the distance of a point from the border, in units of length: negative inside by a fill rule, positive
    /// outside. Without vertices it is the largest finite number.
    ///
    /// Exactly on one edge the derivative is that of the outward normal, where several edges meet zero. Edges that are
    /// equally near share it. The adjoint is
    /// [`signed_distance_vjp`](crate::ad::adjoint::polygon::signed_distance_vjp).
    ///
    /// ```
    /// use geograd::{Aabb2, Rings, Vec2, polygon::Fill};
    /// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
    /// let rings = [outer.as_slice(), &hole];
    /// let rings = Rings::from(&rings[..]);
    /// assert_eq!(rings.signed_distance(Vec2::new(0.25, 2.0), Fill::EvenOdd), -0.25);
    /// assert_eq!(rings.signed_distance(Vec2::new(1.5, 2.0), Fill::EvenOdd), 0.5);
    /// ```
    #[must_use]
    pub fn signed_distance(&self, point: Vec2<S>, fill: Fill) -> S {
        self.fold(point).signed_distance(fill)
    }
    /// Returns the fold over the edges of all rings.
    pub(crate) fn fold(&self, point: Vec2<S>) -> EdgeFold<S> {
        let rings = self.iter().filter(|ring| !ring.is_empty());
        rings.fold(EdgeFold::empty(), |state, ring| {
            state.join(fold_ring(point, ring))
        })
    }
}

//! Tetrahedra.
use super::within;
use crate::arrays::Each;
use crate::shape::{Aabb3, Pose3, Triangle3};
use crate::{Scalar, Shape, Vec3, twofold};
use std::ops::Mul;

/// A solid tetrahedron. Valid when finite; corners in any order, volume zero is valid.
///
/// ```
/// use geograd::{Tetrahedron, Vec3};
/// let [x, y, z] = [Vec3::new(1.0_f64, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 0.0, 3.0)];
/// let solid = Tetrahedron::new(Vec3::new(0.0, 0.0, 0.0), x, y, z);
/// assert_eq!(solid.volume(), 1.0);
/// assert!(solid.contains(Vec3::new(0.25, 0.25, 0.25)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tetrahedron<S> {
    /// The first corner.
    pub a: Vec3<S>,
    /// The second corner.
    pub b: Vec3<S>,
    /// The third corner.
    pub c: Vec3<S>,
    /// The fourth corner.
    pub d: Vec3<S>,
}

impl<S> Tetrahedron<S> {
    /// Creates a tetrahedron from its corners.
    #[inline(always)]
    pub const fn new(a: Vec3<S>, b: Vec3<S>, c: Vec3<S>, d: Vec3<S>) -> Self {
        Tetrahedron { a, b, c, d }
    }
}

impl<S: Scalar> Tetrahedron<S> {
    /// Returns the corners.
    #[must_use]
    #[inline(always)]
    pub fn corners(self) -> [Vec3<S>; 4] {
        [self.a, self.b, self.c, self.d]
    }
    /// Returns the faces, each opposite to one corner. Their normals point outwards where the
    /// [signed volume](Self::signed_volume) is positive, inwards where it is negative.
    #[must_use]
    #[inline(always)]
    pub fn faces(self) -> [Triangle3<S>; 4] {
        let Tetrahedron { a, b, c, d } = self;
        [
            Triangle3::new(b, c, d),
            Triangle3::new(a, d, c),
            Triangle3::new(a, b, d),
            Triangle3::new(a, c, b),
        ]
    }
    /// Returns the volume: positive where the corners b, c and d are counter-clockwise seen from the side away from a.
    /// Smooth everywhere.
    #[must_use]
    #[inline(always)]
    pub fn signed_volume(self) -> S {
        let [b, c, d] = [self.b - self.a, self.c - self.a, self.d - self.a];
        (b.cross(c).dot(d) * S::lit(1.0 / 6.0)).canonical()
    }
    /// Returns the volume, not negative. Kink: volume zero, with derivative zero.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        self.signed_volume().magnitude()
    }
    /// Returns the area of all four faces.
    #[must_use]
    #[inline]
    pub fn surface(self) -> S {
        let [a, b, c, d] = self.faces().each_as(Triangle3::area);
        (a + b) + (c + d)
    }
    /// Returns the centre of its volume: the mean of the corners.
    #[must_use]
    #[inline(always)]
    pub fn center(self) -> Vec3<S> {
        let arms = (self.b - self.a) + (self.c - self.a) + (self.d - self.a);
        (self.a + arms * S::lit(0.25)).canonical()
    }
    /// Returns the smallest axis-aligned box around it; corners that share a bound share its derivative equally.
    #[must_use]
    #[inline]
    pub fn bounding(self) -> Aabb3<S> {
        Aabb3::of(self.corners())
    }
    /// Returns `true` where the point is in the tetrahedron, which may be flat; the surface belongs to it. Decided in
    /// numbers of twice the digits.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        within::in_tetrahedron(self.corners().each_as(twofold::deep), twofold::deep(point))
    }
}

impl<S: Scalar> Mul<Tetrahedron<S>> for Pose3<S> {
    type Output = Tetrahedron<S>;
    /// Returns the tetrahedron carried along.
    #[inline]
    fn mul(self, shape: Tetrahedron<S>) -> Tetrahedron<S> {
        let [a, b, c, d] = shape.corners().each_as(|corner| self * corner);
        Tetrahedron::new(a, b, c, d)
    }
}

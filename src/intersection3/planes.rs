//! Intersections of planes: the line of two, the point of three.
use crate::distance::edge::scale_of;
use crate::distance3::near::size_of;
use crate::intersection::lines::flag;
use crate::scalar::Guard;
use crate::shape::{Line3, Plane3};
use crate::{Scalar, Vec3};

/// The line that two planes share.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CommonLine3<S> {
    /// The point of the line that is nearest to the origin; the origin for parallel planes.
    pub point: Vec3<S>,
    /// The direction of the line, of length one: the cross product of both normals; zero for parallel planes.
    #[shape(direction)]
    pub direction: Vec3<S>,
    /// 1 where the planes cross, 0 where they are parallel. A constant.
    #[shape(number)]
    pub found: S,
}

impl<S> CommonLine3<S> {
    /// Returns the line; not valid for parallel planes.
    #[must_use]
    #[inline(always)]
    pub fn line(self) -> Line3<S> {
        Line3::new(self.point, self.direction)
    }
}

/// The point that three planes share.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CommonPoint3<S> {
    /// The point; the origin for planes without one.
    pub point: Vec3<S>,
    /// 1 where the planes have one point in common, 0 where two are parallel or all share a direction. A constant.
    #[shape(number)]
    pub found: S,
}

/// Returns a normal and an offset in units of the normal's own size.
#[inline(always)]
fn sized<S: Scalar>(plane: Plane3<S>) -> (Vec3<S>, S) {
    let scale = scale_of::<S>(size_of(plane.normal));
    (plane.normal * scale, plane.offset * scale)
}

/// Returns the line in which two planes cross.
///
/// Planes count as parallel by the sine of their angle. The point depends on both offsets, so it has the digits of
/// planes at that distance from the origin. Derivatives grow with the square of the reciprocal of the sine; they are
/// finite where every number is zero or of a magnitude from 2⁻⁸ to 2⁸ in `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
///
/// ```
/// use geograd::{Plane3, Vec3, intersection3::crossing_of_two_planes};
/// let floor = Plane3::new(Vec3::new(0.0, 0.0, 2.0), 2.0); // z = 1
/// let wall = Plane3::new(Vec3::new(1.0, 0.0, 0.0), 3.0); // x = 3
/// let found = crossing_of_two_planes(wall, floor);
/// assert_eq!((found.point, found.direction), (Vec3::new(3.0, 0.0, 1.0), Vec3::new(0.0, -1.0, 0.0)));
/// assert_eq!(crossing_of_two_planes(wall, wall).found, 0.0);
/// ```
#[must_use]
#[inline]
pub fn crossing_of_two_planes<S: Scalar>(a: Plane3<S>, b: Plane3<S>) -> CommonLine3<S> {
    let ((m, p), (n, q)) = (sized(a), sized(b));
    let way = m.cross(n);
    let square = way.length_squared();
    let cross = square.above(S::rounding(1.0, 4));
    let square = S::select(cross, square, S::one());
    let point = n.cross(way) * p.over(square) + way.cross(m) * q.over(square);
    let direction = way * S::one().over(square.root());
    let pick = |v: Vec3<S>| Vec3::select(cross, v, Vec3::zero()).canonical();
    Guard::of(&a).and(&b).result(CommonLine3 {
        point: pick(point),
        direction: pick(direction),
        found: flag::<S>(cross),
    })
}

/// Returns the sum of the sizes of the terms of a triple product.
#[inline(always)]
pub(crate) fn triple_terms<S: Scalar>(l: Vec3<S>, m: Vec3<S>, n: Vec3<S>) -> S {
    let size = |v: Vec3<S>| Vec3::new(v.x.magnitude(), v.y.magnitude(), v.z.magnitude());
    let (l, m, n) = (size(l), size(m), size(n));
    l.x * (m.y * n.z + m.z * n.y) + l.y * (m.z * n.x + m.x * n.z) + l.z * (m.x * n.y + m.y * n.x)
}

/// Returns the point in which three planes meet.
///
/// Planes whose normals have a triple product within its own rounding, four ε of its terms, count as without one point.
/// Derivatives and where they are finite: as of [two planes](crossing_of_two_planes), by the triple product.
///
/// ```
/// use geograd::{Plane3, Vec3, intersection3::crossing_of_three_planes};
/// let [x, y, z] = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 1.0, 1.0)];
/// let found = crossing_of_three_planes(Plane3::new(x, 3.0), Plane3::new(y, 4.0), Plane3::new(z, 1.0));
/// assert_eq!((found.point, found.found), (Vec3::new(3.0, 2.0, -1.0), 1.0));
/// ```
#[must_use]
#[inline]
pub fn crossing_of_three_planes<S: Scalar>(
    a: Plane3<S>,
    b: Plane3<S>,
    c: Plane3<S>,
) -> CommonPoint3<S> {
    let ((l, p), (m, q), (n, r)) = (sized(a), sized(b), sized(c));
    let [mn, nl, lm] = [m.cross(n), n.cross(l), l.cross(m)];
    let volume = l.dot(mn);
    // Five roundings, each half an ε, reach every term.
    let meet = volume
        .magnitude()
        .above(triple_terms(l, m, n) * S::rounding(4.0, 1));
    let volume = S::select(meet, volume, S::one());
    let point = mn * p.over(volume) + nl * q.over(volume) + lm * r.over(volume);
    Guard::of(&a).and(&b).and(&c).result(CommonPoint3 {
        point: Vec3::select(meet, point, Vec3::zero()).canonical(),
        found: flag::<S>(meet),
    })
}

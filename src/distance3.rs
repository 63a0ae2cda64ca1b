//! How far a point is from boxes of space.
//!
//! ```
//! use geograd::{Obb3, Rotation3, Vec3, distance3::signed_distance};
//! let size = Vec3::new(4.0_f64, 2.0, 2.0);
//! let shape = Obb3::new(Vec3::new(1.0, 0.0, 0.0), size, Rotation3::identity());
//! assert_eq!(signed_distance(Vec3::new(6.0, 5.0, 0.0), shape), 5.0); // an edge is nearest
//! assert_eq!(signed_distance(Vec3::new(1.5, 0.0, 0.75), shape), -0.25);
//! ```
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Kinks: inside, where several faces are equally near and share the derivative equally; at the centre's planes outside
//! nothing. Across a face the signed distance is smooth, along an edge or at a corner of the border it is not.
use crate::scalar::most_of;
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Rotation2, Scalar, Vec2, Vec3};

/// A kind of box in space whose faces a point can be beyond.
pub trait Faces<S: Scalar>: Copy {
    /// How far a point is beyond the nearer face across each of the box's own axes; negative between both.
    #[must_use]
    fn beyond(self, point: Vec3<S>) -> Vec3<S>;
}

impl<S: Scalar> Faces<S> for Aabb3<S> {
    #[inline]
    fn beyond(self, point: Vec3<S>) -> Vec3<S> {
        let (low, high) = (self.min - point, point - self.max);
        Vec3::new(low.x.most(high.x), low.y.most(high.y), low.z.most(high.z))
    }
}

/// The same from a point in the box's own frame.
#[inline(always)]
fn from_center<S: Scalar>(at: Vec3<S>, size: Vec3<S>) -> Vec3<S> {
    let across = |x: S, size: S| x.magnitude() - size.halved();
    Vec3::new(
        across(at.x, size.x),
        across(at.y, size.y),
        across(at.z, size.z),
    )
}

impl<S: Scalar> Faces<S> for YawBox3<S> {
    #[inline]
    fn beyond(self, point: Vec3<S>) -> Vec3<S> {
        let at = point - self.center;
        let flat = Rotation2::from_angle(self.heading).inverse() * Vec2::new(at.x, at.y);
        from_center(Vec3::new(flat.x, flat.y, at.z), self.size)
    }
}

impl<S: Scalar> Faces<S> for Obb3<S> {
    #[inline]
    fn beyond(self, point: Vec3<S>) -> Vec3<S> {
        from_center(self.rotation.inverse() * (point - self.center), self.size)
    }
}

/// Distance of a point from the border of a box, in units of length: positive outside, negative inside, where
/// it is how far the nearest face is.
#[must_use]
#[inline]
pub fn signed_distance<S: Scalar>(point: Vec3<S>, shape: impl Faces<S>) -> S {
    let beyond = shape.beyond(point);
    let nearest = most_of([beyond.x, beyond.y, beyond.z]);
    let outside = clear(beyond);
    S::select(nearest.above(S::zero()), outside, nearest).canonical()
}

/// Distance of a point from a box, in units of length; zero inside, with derivative zero.
///
/// ```
/// use geograd::{Aabb3, Vec3, distance3::distance};
/// let shape = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0));
/// assert_eq!(distance(Vec3::new(0.5, 4.0, 5.0), shape), 5.0);
/// assert_eq!(distance(Vec3::new(0.5, 0.5, 0.5), shape), 0.0);
/// ```
#[must_use]
#[inline]
pub fn distance<S: Scalar>(point: Vec3<S>, shape: impl Faces<S>) -> S {
    clear(shape.beyond(point)).canonical()
}

/// Shapes of space at some distance from a point.
pub trait FromPoint<S: Scalar>: Copy {
    /// The distance of the point, in units of length; zero inside.
    #[must_use]
    fn distance_from(self, point: Vec3<S>) -> S;
}

impl<S: Scalar> FromPoint<S> for Vec3<S> {
    #[inline(always)]
    fn distance_from(self, point: Vec3<S>) -> S {
        (point - self).length()
    }
}

macro_rules! from_point {
    ($($shape:ident)*) => { $(
        impl<S: Scalar> FromPoint<S> for $shape<S> {
            #[inline]
            fn distance_from(self, point: Vec3<S>) -> S {
                distance(point, self)
            }
        }
    )* };
}
from_point! { Aabb3 YawBox3 Obb3 }

impl<S: Scalar> Vec3<S> {
    /// The distance of the point from another one or from a box.
    ///
    /// ```
    /// use geograd::{Aabb3, Vec3};
    /// let point = Vec3::new(0.5, 4.0, 5.0);
    /// assert_eq!(point.distance(Vec3::new(0.5, 1.0, 1.0)), 5.0);
    /// assert_eq!(point.distance(Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0))), 5.0);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn distance<B: FromPoint<S>>(self, other: B) -> S {
        other.distance_from(self)
    }
    /// The signed distance of the point from the border of a box, negative inside: [`signed_distance`].
    #[must_use]
    #[inline]
    pub fn signed_distance<B: Faces<S>>(self, shape: B) -> S {
        signed_distance(self, shape)
    }
    /// The square of the distance to another point: smooth everywhere.
    #[must_use]
    #[inline(always)]
    pub fn squared_distance(self, other: Self) -> S {
        (self - other).length_squared()
    }
}

/// The length of what is beyond the faces.
#[inline(always)]
fn clear<S: Scalar>(beyond: Vec3<S>) -> S {
    let out = |x: S| x.most(S::zero());
    Vec3::new(out(beyond.x), out(beyond.y), out(beyond.z)).length()
}

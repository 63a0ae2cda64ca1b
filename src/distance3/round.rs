//! Points and balls against cylinders and cones: in the plane through their axis.
use super::aside;
use super::near::size_of;
use super::relation::{Relation, direction};
use super::spot::plain;
use crate::distance::edge::scale_of;
use crate::distance::{Convex, pair as distance};
use crate::scalar::largest;
use crate::shape::{Cone, Cylinder};
use crate::{Aabb2, Pack, Scalar, Triangle2, Vec2, Vec3};

/// A solid that turns about an axis.
pub(crate) trait Revolved: Copy + Pack<Scalar: Scalar> {
    /// Its section by a plane through the axis.
    type Section: Convex<Self::Scalar>;
    /// Returns the start of the axis.
    fn start(self) -> Vec3<Self::Scalar>;
    /// Returns the vector from there to its end.
    fn axis(self) -> Vec3<Self::Scalar>;
    /// Returns the radius.
    fn radius(self) -> Self::Scalar;
    /// Returns the section for a nearest point, which is never beyond the axis: x along the axis from its start, y
    /// across, the axis in the middle. A circle of the radius is at the end of the axis.
    fn near_section(height: Self::Scalar, radius: Self::Scalar) -> Self::Section;
    /// Returns the section for a farthest point, which is across the axis.
    fn far_section(height: Self::Scalar, radius: Self::Scalar) -> Self::Section;
}

/// Returns the end of a section at a radius of either sign. Without a radius both ends are one, and tie: they have the
/// derivative of the one that counts.
#[inline(always)]
fn unless_none<S: Scalar>(end: S, that_counts: S) -> S {
    S::select(end.equals(S::zero()), that_counts, end)
}

impl<S: Scalar> Revolved for Cylinder<S> {
    type Section = Aabb2<S>;
    #[inline(always)]
    fn start(self) -> Vec3<S> {
        self.start
    }
    #[inline(always)]
    fn axis(self) -> Vec3<S> {
        self.end - self.start
    }
    #[inline(always)]
    fn radius(self) -> S {
        self.radius
    }
    #[inline(always)]
    fn near_section(height: S, radius: S) -> Aabb2<S> {
        Aabb2 {
            min: Vec2::new(S::zero(), -radius),
            max: Vec2::new(height, radius),
        }
    }
    #[inline(always)]
    fn far_section(height: S, radius: S) -> Aabb2<S> {
        Aabb2 {
            min: Vec2::new(S::zero(), -radius),
            max: Vec2::new(height, unless_none(radius, -radius)),
        }
    }
}

impl<S: Scalar> Revolved for Cone<S> {
    type Section = Triangle2<S>;
    #[inline(always)]
    fn start(self) -> Vec3<S> {
        self.apex
    }
    #[inline(always)]
    fn axis(self) -> Vec3<S> {
        self.base - self.apex
    }
    #[inline(always)]
    fn radius(self) -> S {
        self.radius
    }
    #[inline(always)]
    fn near_section(height: S, radius: S) -> Triangle2<S> {
        ends(height, unless_none(-radius, radius), radius)
    }
    #[inline(always)]
    fn far_section(height: S, radius: S) -> Triangle2<S> {
        ends(height, -radius, unless_none(radius, -radius))
    }
}

/// Returns the section of a cone whose base ends at given coordinates across the axis.
#[inline(always)]
fn ends<S: Scalar>(height: S, low: S, high: S) -> Triangle2<S> {
    Triangle2::new(
        Vec2::zero(),
        Vec2::new(height, low),
        Vec2::new(height, high),
    )
}

/// A point in the frame of an axis: along it, across it, and the directions of both.
struct AxisPoint<S> {
    at: Vec2<S>,
    along: Vec3<S>,
    across: Vec3<S>,
    height: S,
}

/// Returns a point in the frame of an axis. Its coordinate across is the length of a cross product, whose digits do not
/// depend on how far along the point is.
#[inline(always)]
fn seen<S: Scalar>(axis: Vec3<S>, arm: Vec3<S>) -> AxisPoint<S> {
    let height = axis.length();
    let along = direction(axis * scale_of::<S>(largest([axis.x, axis.y, axis.z])));
    let off = along.cross(arm).cross(along);
    AxisPoint {
        at: Vec2::new(along.dot(arm), off.length()),
        along,
        across: direction(off),
        height,
    }
}

/// Returns the relation of a point and a solid. On the axis no direction is nearest: the derivative across is zero, and
/// point and direction belong to one of the nearest points.
#[inline(always)]
pub(super) fn relate<S: Scalar, B: Revolved<Scalar = S>>(point: Vec3<S>, shape: B) -> Relation<S> {
    let start = shape.start();
    let AxisPoint {
        at,
        along,
        across,
        height,
    } = seen(shape.axis(), point - start);
    let section = B::near_section(height, shape.radius());
    let apart = distance::signed_distance(at, section);
    let found = distance::closest_points(at, section);
    let out = distance::penetration(at, section).direction;
    let axis = plain(shape.axis());
    let aside = aside::across(std::iter::once(axis * scale_of::<S::Primal>(size_of(axis))));
    let is_on_axis = across.length_squared().equals(S::zero());
    let side = Vec3::select(is_on_axis, aside, across);
    Relation {
        apart,
        square: distance::squared_distance(at, section),
        normal: along * out.x + side * out.y,
        on_a: point,
        on_b: start + along * found.on_b.x + side * found.on_b.y,
    }
}

/// Returns the longest distance of a point from points of a solid.
#[inline(always)]
pub(super) fn farthest<S: Scalar, B: Revolved<Scalar = S>>(point: Vec3<S>, shape: B) -> S {
    let AxisPoint { at, height, .. } = seen(shape.axis(), point - shape.start());
    distance::farthest_distance(at, B::far_section(height, shape.radius()))
}

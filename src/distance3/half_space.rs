//! Half-spaces against all that ends: the point of a shape that is farthest behind the plane.
use super::core::Core3;
use super::cored::InflatedCore;
use super::facing::{Patch, PatchName, face_of_core};
use super::near::Low;
use super::relation::{Relation, direction, square_of_gap};
use super::round::Revolved;
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::distance::share::Best;
use crate::scalar::{Guard, largest};
use crate::shape::{Cone, Cylinder, Plane3};
use crate::{Pack, Scalar, Vec3};

/// A shape that ends in every direction.
pub(crate) trait Bounded: Copy + Pack<Scalar: Scalar> {
    /// Returns the least of `normal · point`, given a normal of length one, and a point of the shape there. Points that
    /// tie share the derivative, and the point is their mean.
    fn lowest(self, normal: Vec3<Self::Scalar>) -> (Self::Scalar, Vec3<Self::Scalar>);
    /// Returns its face that faces a direction of length one. By default its nearest point.
    #[inline]
    fn face(self, _toward: Vec3<Self::Scalar>) -> PatchName
    where
        Self::Scalar: Scalar<Mask = bool>,
    {
        PatchName::Spot
    }
    /// Returns a face by its name, given the direction that it faces.
    #[inline]
    fn patch(self, _name: PatchName, _toward: Vec3<Self::Scalar>) -> Patch<Self::Scalar> {
        Patch::Spot
    }
    /// Returns a guard with the numbers that matter: by default with all.
    #[inline(always)]
    fn with_numbers(&self, guard: Guard<Self::Scalar>) -> Guard<Self::Scalar> {
        guard.and(self)
    }
}

impl<A: InflatedCore> Bounded for A {
    #[inline(always)]
    fn lowest(self, normal: Vec3<A::Scalar>) -> (A::Scalar, Vec3<A::Scalar>) {
        let (core, radius) = (self.core(), self.radius());
        let (height, corner) = core.support(normal);
        match A::ROUND {
            true => (height - radius, corner - normal * radius),
            false => (height, corner),
        }
    }
    #[inline]
    fn face(self, toward: Vec3<A::Scalar>) -> PatchName
    where
        A::Scalar: Scalar<Mask = bool>,
    {
        face_of_core(&self.core(), toward)
    }
    #[inline]
    fn patch(self, name: PatchName, toward: Vec3<A::Scalar>) -> Patch<A::Scalar> {
        let (corners, out) = (self.core().corners(), toward * self.radius());
        Patch::named(name, |k| corners.as_ref()[k] + out)
    }
}

/// Returns the depth of a circle's lowest point below its centre, and the vector from it to the centre. Both are zero
/// if the normal is along the circle's axis.
#[inline(always)]
pub(super) fn lowest_of_circle<S: Scalar>(
    axis: Vec3<S>,
    radius: S,
    normal: Vec3<S>,
) -> (S, Vec3<S>) {
    let axis = direction(axis * scale_of::<S>(largest([axis.x, axis.y, axis.z])));
    let slope = axis.cross(normal).cross(axis);
    (slope.length() * radius, direction(slope) * radius)
}

/// The share of a direction along the axis of a cylinder from which on an end faces it, not the side.
const STEEP: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Returns the lower of two points.
#[inline(always)]
fn lower<S: Scalar>(a: (S, Vec3<S>), b: (S, Vec3<S>)) -> (S, Vec3<S>) {
    let Low(height, point) = Best::of(a.0, Low(a.0, a.1))
        .less(Best::of(b.0, Low(b.0, b.1)))
        .mean();
    (height, point)
}

impl<S: Scalar> Bounded for Cylinder<S> {
    #[inline(always)]
    fn lowest(self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let (down, way) = lowest_of_circle(self.axis(), self.radius, normal);
        let ends = [self.start, self.end].each_as(|end| (normal.dot(end), end));
        let (height, point) = lower(ends[0], ends[1]);
        (height - down, point - way)
    }
    #[inline]
    fn face(self, toward: Vec3<S>) -> PatchName
    where
        S: Scalar<Mask = bool>,
    {
        let axis = self.axis().normalize_or_zero();
        let rise = axis.dot(toward);
        match rise.unsigned().above(S::lit(STEEP)) {
            true => PatchName::rim(u8::from(rise.above(S::zero())), axis),
            false => PatchName::Side,
        }
    }
    #[inline]
    fn patch(self, name: PatchName, toward: Vec3<S>) -> Patch<S> {
        let axis = self.axis().normalize_or_zero();
        let ends = [self.start, self.end];
        match name {
            PatchName::Rim { end, helper } => {
                Patch::rim(ends[usize::from(end)], axis, helper, self.radius)
            }
            PatchName::Side => Patch::side(ends.each_as(|end| (end, self.radius)), axis, toward),
            _ => Patch::Spot,
        }
    }
}

impl<S: Scalar> Bounded for Cone<S> {
    #[inline(always)]
    fn lowest(self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let (down, way) = lowest_of_circle(self.axis(), self.radius, normal);
        let rim = (normal.dot(self.base) - down, self.base - way);
        lower((normal.dot(self.apex), self.apex), rim)
    }
    #[inline]
    fn face(self, toward: Vec3<S>) -> PatchName
    where
        S: Scalar<Mask = bool>,
    {
        let axis = self.axis().normalize_or_zero();
        let rise = axis.dot(toward);
        // The outer normal of the side that faces the direction most, by the angle between side and axis.
        let (height, radius) = (self.axis().length(), self.radius);
        let across = (toward - axis * rise).length();
        let side = (across * height - rise * radius).over(height.hypot(radius));
        match (rise.at_least(side), rise.most(side).below(S::lit(0.5))) {
            (_, true) => PatchName::Spot,
            (true, _) => PatchName::rim(0, axis),
            (false, _) => PatchName::Side,
        }
    }
    #[inline]
    fn patch(self, name: PatchName, toward: Vec3<S>) -> Patch<S> {
        let axis = self.axis().normalize_or_zero();
        match name {
            PatchName::Rim { helper, .. } => Patch::rim(self.base, axis, helper, self.radius),
            PatchName::Side => {
                let ends = [(self.apex, S::zero()), (self.base, self.radius)];
                Patch::side(ends, axis, toward)
            }
            _ => Patch::Spot,
        }
    }
}

/// Returns the relation of a half-space and a shape.
#[inline(always)]
pub(super) fn relate<S: Scalar, B: Bounded<Scalar = S>>(plane: Plane3<S>, shape: B) -> Relation<S> {
    let n = plane.normal;
    let size = scale_of::<S>(largest([n.x, n.y, n.z]));
    let (long, offset) = (n * size, plane.offset * size);
    let length = long.length();
    let over = S::select(length.at_most(S::zero()), S::one(), length);
    let unit = Vec3::new(long.x.over(over), long.y.over(over), long.z.over(over));
    let (height, on_b) = shape.lowest(unit);
    let apart = height - offset.over(over);
    Relation {
        apart,
        square: square_of_gap(apart),
        normal: unit,
        on_a: on_b - unit * apart,
        on_b,
    }
}

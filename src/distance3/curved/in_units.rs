//! Curved shapes, and hulls of a few corners, in the units of a search.
use super::Curved;
use super::smooth_solid::{Solid, across};
use crate::arrays::Each;
use crate::distance3::core::Core3;
use crate::distance3::cored::{InflatedCore, axes};
use crate::distance3::facing::{Patch, PatchName};
use crate::distance3::half_space::{Bounded, lowest_of_circle};
use crate::distance3::relation::direction;
use crate::scalar::largest;
use crate::shape::{Cone, Cylinder, Disc, Ellipsoid};
use crate::{Scalar, Vec3};

/// Returns the largest magnitude of a vector's coordinates.
fn size_of<S: Scalar>(v: Vec3<S>) -> S::Primal {
    largest([v.x, v.y, v.z])
}

/// Returns half of a size along each axis.
pub(super) fn halves<S: Scalar>(size: Vec3<S>) -> [S; 3] {
    [size.x, size.y, size.z]
}

impl<S: Scalar> Curved for Ellipsoid<S> {
    type Placed = Solid<S>;
    fn anchor_point(&self) -> Vec3<S> {
        self.center
    }
    fn reach(&self, from: Vec3<S>) -> S::Primal {
        size_of(self.center - from).most(largest(halves(self.semi_axes)))
    }
    fn in_units(&self, from: Vec3<S>, scale: S, _: S) -> Solid<S> {
        let ball = Solid::Ball {
            center: self.center,
            ways: axes(self.rotation),
            half: halves(self.semi_axes),
        };
        ball.placed(from, scale)
    }
}

impl<S: Scalar> Curved for Disc<S> {
    type Placed = Solid<S>;
    fn anchor_point(&self) -> Vec3<S> {
        self.center
    }
    fn axis(&self) -> Option<Vec3<S>> {
        Some(self.normal)
    }
    fn reach(&self, from: Vec3<S>) -> S::Primal {
        size_of(self.center - from).most(largest([self.radius]))
    }
    fn in_units(&self, from: Vec3<S>, scale: S, by_x: S) -> Solid<S> {
        let disc = Solid::Disc {
            center: self.center,
            ways: across(self.normal, by_x),
            radius: self.radius,
        };
        disc.placed(from, scale)
    }
}

impl<S: Scalar> Curved for Cylinder<S> {
    type Placed = Solid<S>;
    fn anchor_point(&self) -> Vec3<S> {
        self.start
    }
    fn axis(&self) -> Option<Vec3<S>> {
        Some(self.end - self.start)
    }
    fn reach(&self, from: Vec3<S>) -> S::Primal {
        let axis = size_of(self.end - self.start);
        size_of(self.start - from)
            .most(axis)
            .most(largest([self.radius]))
    }
    fn in_units(&self, from: Vec3<S>, scale: S, by_x: S) -> Solid<S> {
        let axis = self.end - self.start;
        let can = Solid::Cylinder {
            start: self.start,
            axis,
            ways: across(axis, by_x),
            radius: self.radius,
        };
        can.placed(from, scale)
    }
}

impl<S: Scalar> Curved for Cone<S> {
    type Placed = Solid<S>;
    fn anchor_point(&self) -> Vec3<S> {
        self.apex
    }
    fn axis(&self) -> Option<Vec3<S>> {
        Some(self.base - self.apex)
    }
    fn reach(&self, from: Vec3<S>) -> S::Primal {
        let axis = size_of(self.base - self.apex);
        size_of(self.apex - from)
            .most(axis)
            .most(largest([self.radius]))
    }
    fn in_units(&self, from: Vec3<S>, scale: S, by_x: S) -> Solid<S> {
        let axis = self.base - self.apex;
        let hat = Solid::Cone {
            apex: self.apex,
            axis,
            ways: across(axis, by_x),
            radius: self.radius,
        };
        hat.placed(from, scale)
    }
}

impl<A: InflatedCore> Curved for A {
    type Placed = Solid<A::Scalar>;
    fn anchor_point(&self) -> Vec3<A::Scalar> {
        self.core().anchor()
    }
    fn in_units(&self, from: Vec3<A::Scalar>, scale: A::Scalar, _: A::Scalar) -> Solid<A::Scalar> {
        let core = self.core().placed(from, scale);
        if let Some(shape) = core.as_box() {
            return Solid::Box {
                center: shape.center,
                ways: shape.axes,
                half: shape.half,
            };
        }
        let corners = core.corners();
        let given = corners.as_ref();
        Solid::Simplex {
            corners: [0, 1, 2, 3].each_as(|k| *given.get(k).unwrap_or(&given[0])),
            count: given.len(),
        }
    }
    fn rounding(&self) -> Option<A::Scalar> {
        A::ROUND.then(|| self.radius())
    }
}

impl<S: Scalar> Bounded for Ellipsoid<S> {
    #[inline]
    fn lowest(self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let (ways, half) = (axes(self.rotation), halves(self.semi_axes));
        let along = [0, 1, 2].each_as(|k| half[k] * ways[k].dot(normal));
        let down = Vec3::new(along[0], along[1], along[2]);
        let unit = direction(down);
        let way = ways[0] * (half[0] * unit.x)
            + ways[1] * (half[1] * unit.y)
            + ways[2] * (half[2] * unit.z);
        (normal.dot(self.center) - down.length(), self.center - way)
    }
}

impl<S: Scalar> Bounded for Disc<S> {
    #[inline]
    fn lowest(self, normal: Vec3<S>) -> (S, Vec3<S>) {
        let (down, way) = lowest_of_circle(self.normal, self.radius, normal);
        (normal.dot(self.center) - down, self.center - way)
    }
    #[inline]
    fn face(self, toward: Vec3<S>) -> PatchName
    where
        S: Scalar<Mask = bool>,
    {
        let axis = self.normal.normalize_or_zero();
        match axis.dot(toward).unsigned().below(S::lit(0.5)) {
            true => PatchName::Spot,
            false => PatchName::rim(0, axis),
        }
    }
    #[inline]
    fn patch(self, name: PatchName, _: Vec3<S>) -> Patch<S> {
        match name {
            PatchName::Rim { helper, .. } => Patch::rim(
                self.center,
                self.normal.normalize_or_zero(),
                helper,
                self.radius,
            ),
            _ => Patch::Spot,
        }
    }
}

//! Shapes of space that lines pierce.
use super::inside::{Beam, Inside};
use crate::distance3::apart::Cored;
use crate::distance3::core::{BoxCore, Core};
use crate::scalar::largest;
use crate::shape::{Aabb3, Capsule3, Cone, Cylinder, Obb3, Plane3, Sphere, Tetrahedron, YawBox3};
use crate::{Scalar, Vec3};

/// A convex solid of space that a line enters and leaves.
#[diagnostic::on_unimplemented(
    message = "no line is known to pierce `{Self}`",
    note = "half-spaces, balls, boxes, capsules, cylinders, cones and tetrahedra are pierced"
)]
pub trait Pierced: Copy {
    /// Its numbers.
    type Scalar: Scalar;
    /// A point of it, from which it is seen.
    fn anchor(self) -> Vec3<Self::Scalar>;
    /// How far it reaches from there, as a constant.
    fn extent(self) -> <Self::Scalar as Scalar>::Primal;
    /// The range of a beam inside, both seen from the anchor in units of `1 / scale`.
    fn inside(self, beam: Beam<Self::Scalar>, scale: Self::Scalar) -> Inside<Self::Scalar>;
}

/// How long a vector is at most, as a constant.
#[inline(always)]
pub(super) fn size_of<S: Scalar>(v: Vec3<S>) -> S::Primal {
    largest([v.x, v.y, v.z])
}

impl<S: Scalar> Pierced for Plane3<S> {
    type Scalar = S;
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        let square = size_of(self.normal).binade();
        let normal = self.normal * S::from_primal(square);
        let length = normal.length_squared();
        let none = length.at_most(S::zero());
        let along = (self.offset * S::from_primal(square)).over(S::select(none, S::one(), length));
        normal * along
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        S::Primal::zero()
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, _: S) -> Inside<S> {
        let normal = self.normal.normalize_or_zero();
        Inside::everywhere().behind(beam, Vec3::zero(), normal)
    }
}

impl<S: Scalar> Pierced for Sphere<S> {
    type Scalar = S;
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.center
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        self.radius.primal()
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        Inside::ball(beam, Vec3::zero(), self.radius * scale)
    }
}

/// In a box around the origin.
#[inline(always)]
fn in_box<S: Scalar>(shape: BoxCore<S>, beam: Beam<S>, scale: S) -> Inside<S> {
    (0..3).fold(Inside::everywhere(), |inside, k| {
        let axis = shape.axes[k];
        let arm = axis * (shape.half[k] * scale);
        inside.behind(beam, arm, axis).behind(beam, -arm, -axis)
    })
}

macro_rules! boxes {
    ($($Shape:ident)*) => { $(
        impl<S: Scalar> Pierced for $Shape<S> {
            type Scalar = S;
            #[inline(always)]
            fn anchor(self) -> Vec3<S> {
                self.core().anchor()
            }
            #[inline(always)]
            fn extent(self) -> S::Primal {
                let core = self.core();
                core.extent(core.center)
            }
            #[inline(always)]
            fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
                in_box(self.core(), beam, scale)
            }
        }
    )* };
}
boxes! { Aabb3 YawBox3 Obb3 }

/// The direction of an axis and its length.
#[inline(always)]
fn axis_of<S: Scalar>(way: Vec3<S>) -> (Vec3<S>, S) {
    (way.normalize_or_zero(), way.length())
}

impl<S: Scalar> Pierced for Capsule3<S> {
    type Scalar = S;
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.start
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        size_of(self.end - self.start).most(self.radius.primal())
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        let (end, radius) = ((self.end - self.start) * scale, self.radius * scale);
        let (axis, length) = axis_of(end);
        let start = Vec3::zero();
        let side = Inside::tube(beam, start, axis, radius)
            .behind(beam, end, axis)
            .behind(beam, start, -axis)
            .unless(length.at_most(S::zero()));
        side.joined(Inside::ball(beam, start, radius))
            .joined(Inside::ball(beam, end, radius))
    }
}

impl<S: Scalar> Pierced for Cylinder<S> {
    type Scalar = S;
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.start
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        size_of(self.end - self.start).most(self.radius.primal())
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        let end = (self.end - self.start) * scale;
        let (axis, length) = axis_of(end);
        Inside::tube(beam, Vec3::zero(), axis, self.radius * scale)
            .behind(beam, end, axis)
            .behind(beam, Vec3::zero(), -axis)
            .unless(length.at_most(S::zero()))
    }
}

impl<S: Scalar> Pierced for Cone<S> {
    type Scalar = S;
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.apex
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        size_of(self.base - self.apex).most(self.radius.primal())
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        let base = (self.base - self.apex) * scale;
        let (axis, height) = axis_of(base);
        let none = height.at_most(S::zero());
        let slope = (self.radius * scale).over(S::select(none, S::one(), height));
        Inside::nappe(beam, Vec3::zero(), axis, slope)
            .behind(beam, base, axis)
            .unless(none)
    }
}

impl<S: Scalar> Pierced for Tetrahedron<S> {
    type Scalar = S;
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.a
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        let [_, b, c, d] = self.corners().map(|corner| size_of(corner - self.a));
        b.most(c).most(d)
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        let [a, b, c, d] = self.corners().map(|corner| (corner - self.a) * scale);
        let placed = Tetrahedron::new(a, b, c, d);
        let volume = b.cross(c).dot(d);
        let inwards = volume.below(S::zero());
        // Its faces say where it ends as long as its volume has digits.
        let flat = volume.magnitude().at_most(S::lit(S::EPSILON));
        let faces = placed.faces().into_iter();
        let inside = faces.fold(Inside::everywhere(), |inside, face| {
            let normal = face.twice_area_normal().normalize_or_zero();
            inside.behind(beam, face.a, Vec3::select(inwards, -normal, normal))
        });
        inside.unless(flat)
    }
}

//! Shapes of space that lines pierce.
use super::cone::in_cone;
use super::inside::{Beam, Border, Inside, Tube, sized};
use super::tetrahedron::in_tetrahedron;
use crate::arrays::Each;
use crate::distance::share::Best;
use crate::distance3::core::{BoxCore, Core3};
use crate::distance3::cored::InflatedCore;
use crate::distance3::near::size_of;
use crate::shape::{
    Aabb3, Capsule3, Cone, Cylinder, Obb3, Plane3, RoundBox3, Sphere, Tetrahedron, YawBox3,
};
use crate::{Pack, Scalar, Vec3};

/// A convex solid of space that a line enters and leaves.
#[diagnostic::on_unimplemented(
    message = "no line is known to pierce `{Self}`",
    note = "half-spaces, balls, boxes (round ones, too), capsules, cylinders, cones and tetrahedra are pierced"
)]
pub trait Pierced: Copy + Pack<Scalar: Scalar> {
    /// Returns a point of it, which is the origin of its local frame.
    fn anchor(self) -> Vec3<Self::Scalar>;
    /// Returns its extent from the anchor, as a constant.
    fn extent(self) -> <Self::Scalar as Scalar>::Primal;
    /// Returns the range of a beam inside, both relative to the anchor in units of `1 / scale`.
    fn inside(self, beam: Beam<Self::Scalar>, scale: Self::Scalar) -> Inside<Self::Scalar>;
}

impl<S: Scalar> Pierced for Plane3<S> {
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
        Inside::everywhere().behind(beam, Vec3::zero(), sized(self.normal))
    }
}

impl<S: Scalar> Pierced for Sphere<S> {
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

/// Returns the range inside a box around the origin.
#[inline(always)]
fn in_box<S: Scalar>(shape: BoxCore<S>, beam: Beam<S>, scale: S) -> Inside<S> {
    (0..3).fold(Inside::everywhere(), |inside, k| {
        let axis = shape.axes[k];
        let arm = axis * (shape.half[k] * scale);
        inside.behind(beam, arm, axis).behind(beam, -arm, -axis)
    })
}

/// Returns the range inside a box around the origin with round edges and corners.
///
/// The surface consists of six rectangles and of parts of the capsules around the twelve edges. Seams between two of
/// them have one normal.
#[inline(always)]
fn in_round_box<S: Scalar>(shape: BoxCore<S>, radius: S, beam: Beam<S>, scale: S) -> Inside<S> {
    let [from, along] = [beam.from, beam.along].each_as(|v| shape.axes.each_as(|axis| axis.dot(v)));
    let half = shape.half.each_as(|half| half * scale);
    let (zero, one, large) = (S::zero(), S::one(), S::largest());
    let local = Beam {
        from: vector(from),
        along: vector(along),
    };
    let at_side = |is_high: bool, k: usize| if is_high { half[k] } else { -half[k] };
    let balls: [Inside<S>; 8] = std::array::from_fn(|corner| {
        let center = [0, 1, 2].each_as(|k| at_side(corner >> k & 1 == 1, k));
        Inside::ball(local, vector(center), radius)
    });
    let mut all = Inside::everywhere().unless(zero.below(one));
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let rate = along[k];
        // The faces across this axis: where the line comes to the box, and where it goes.
        let parallel = rate.magnitude().at_most(S::rounding(1.0, 2));
        let safe = S::select(parallel, one, rate);
        let ahead = one.signed_as(rate);
        let face = |side: S| {
            let t = (side * (half[k] + radius) - from[k]).over(safe);
            let at = |axis: usize| {
                (from[axis] + along[axis] * t)
                    .magnitude()
                    .at_most(half[axis])
            };
            let mut normal = [zero; 3];
            normal[k] = side;
            let border = Border {
                t,
                normal: vector(normal),
            };
            (Best::of(t, border), parallel | !(at(i) & at(j)))
        };
        let ((mut enter, no_entry), (mut exit, no_exit)) = (face(-ahead), face(ahead));
        enter.value = S::select(no_entry, large, enter.value);
        exit.value = S::select(no_exit, -large, exit.value);
        all = all.joined(Inside { enter, exit });
        // The edges along it.
        let square = along[i].squared() + along[j].squared();
        for edge in 0..4 {
            let (high_i, high_j) = (edge & 1, edge >> 1);
            let arm = [
                from[i] - at_side(high_i == 1, i),
                from[j] - at_side(high_j == 1, j),
            ];
            let most = radius * radius;
            let turn = along[i] * arm[1] - along[j] * arm[0];
            let tube = Tube::new(
                square,
                along[i] * arm[0] + along[j] * arm[1],
                arm[0].squared() + arm[1].squared() - most,
                square * most - turn.squared(),
                S::rounding(1.0, 4),
            );
            let across = |t: S| {
                let mut across = [zero; 3];
                (across[i], across[j]) = (arm[0] + along[i] * t, arm[1] + along[j] * t);
                vector(across)
            };
            let low = high_i << i | high_j << j;
            let side = Inside::of_tube(tube, across, radius);
            let heights = [from[k] + half[k], rate, half[k] + half[k]];
            all = all.joined(side.rounded([balls[low], balls[low | 1 << k]], heights));
        }
    }
    let outside = |mut best: Best<S, Border<S>>| {
        let Vec3 { x, y, z } = best.sum.normal;
        let [a, b, c] = shape.axes;
        best.sum.normal = a * x + b * y + c * z;
        best
    };
    Inside {
        enter: outside(all.enter),
        exit: outside(all.exit),
    }
}

/// Returns a vector of its numbers.
#[inline(always)]
fn vector<S: Scalar>([x, y, z]: [S; 3]) -> Vec3<S> {
    Vec3::new(x, y, z)
}

impl<S: Scalar> Pierced for RoundBox3<S> {
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.core().anchor()
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        let core = self.core();
        core.extent(core.center).most(self.radius.primal())
    }
    #[inline]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        in_round_box(self.core(), self.radius * scale, beam, scale)
    }
}

macro_rules! boxes {
    ($($Shape:ident)*) => { $(
        impl<S: Scalar> Pierced for $Shape<S> {
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
boxes! { YawBox3 Obb3 }

/// Seen from a corner that is given: far from the origin the centre and the size would lose the digits of the bounds.
impl<S: Scalar> Pierced for Aabb3<S> {
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.min
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        size_of(self.size())
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        let (size, axes) = (self.size() * scale, self.core().axes);
        let ends = axes.into_iter().zip([size.x, size.y, size.z]);
        ends.fold(Inside::everywhere(), |inside, (axis, end)| {
            inside
                .behind(beam, axis * end, axis)
                .behind(beam, Vec3::zero(), -axis)
        })
    }
}

impl<S: Scalar> Pierced for Capsule3<S> {
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
        Inside::capsule(beam, Vec3::zero(), end, self.radius * scale)
    }
}

impl<S: Scalar> Pierced for Cylinder<S> {
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
        let axis = sized(end);
        Inside::tube(beam, Vec3::zero(), axis, self.radius * scale)
            .behind(beam, end, axis)
            .behind(beam, Vec3::zero(), -axis)
            .unless(axis.length_squared().at_most(S::zero()))
    }
}

impl<S: Scalar> Pierced for Cone<S> {
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
        in_cone(beam, base, self.radius * scale)
    }
}

impl<S: Scalar> Pierced for Tetrahedron<S> {
    #[inline(always)]
    fn anchor(self) -> Vec3<S> {
        self.a
    }
    #[inline(always)]
    fn extent(self) -> S::Primal {
        let [_, b, c, d] = self.corners().each_as(|corner| size_of(corner - self.a));
        b.most(c).most(d)
    }
    #[inline(always)]
    fn inside(self, beam: Beam<S>, scale: S) -> Inside<S> {
        let corners = self.corners().each_as(|corner| (corner - self.a) * scale);
        in_tetrahedron(beam, corners)
    }
}

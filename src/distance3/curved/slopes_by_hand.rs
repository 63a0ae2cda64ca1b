//! The first derivatives of a signed distance by both shapes, by hand, at the touch that a replay found.
//!
//! There the distance is stationary in its direction and in the places on the pieces. So its derivative by a shape is the
//! direction times the derivative of the point that keeps its place.
use super::curved_replay::touched;
use super::grip::Grip;
use super::hints::{CurvedRecord, HINTS, Hints};
use super::in_units::halves;
use super::{Curved, InSearch, Placed, inflated};
use crate::arrays::Each;
use crate::distance3::cored::axes;
use crate::distance3::hulls::{ByCorners, by_turn};
use crate::distance3::relation::{Relation, square_of_gap};
use crate::shape::{
    Aabb3, Capsule3, Cone, Cylinder, Disc, Ellipsoid, Obb3, RoundBox3, Segment3, Sphere,
    Tetrahedron, Triangle3, YawBox3,
};
use crate::{Hull3, Real, Scalar, Vec3};

/// A shape whose derivatives follow from that of a point which keeps its place.
pub(crate) trait Gripped: Curved {
    /// Returns the derivatives by the shape of a function whose derivative by the point is `bar`, and by the radius of the
    /// inflation less a factor, given the direction of the distance; `None` where they need a replay.
    fn by_grip(
        &self,
        grip: &Grip<Self::Scalar>,
        bar: Vec3<Self::Scalar>,
        normal: Vec3<Self::Scalar>,
        factor: Self::Scalar,
    ) -> Option<Self>;
}

impl<S: Scalar<Mask = bool>> Gripped for Ellipsoid<S> {
    fn by_grip(&self, grip: &Grip<S>, bar: Vec3<S>, _: Vec3<S>, _: S) -> Option<Self> {
        let Grip::Ball(y) = *grip else { return None };
        let (ways, half) = (axes(self.rotation), halves(self.semi_axes));
        let turn = |k: usize| ways[k].cross(bar) * (half[k] * y[k]);
        let [x, y, z] = [0, 1, 2].each_as(|k: usize| y[k] * ways[k].dot(bar));
        Some(Ellipsoid {
            center: bar,
            semi_axes: Vec3::new(x, y, z),
            rotation: by_turn(self.rotation, turn(0) + turn(1) + turn(2)),
        })
    }
}

/// Returns the derivative by an axis of a point whose vector across it, of length one times a radius, turns with it;
/// `None` for an axis of length zero.
fn by_axis<S: Scalar<Mask = bool>>(
    axis: Vec3<S>,
    arm: Vec3<S>,
    radius: S,
    bar: Vec3<S>,
) -> Option<Vec3<S>> {
    let length = axis.length();
    let over = S::one().over(length);
    let along = (axis * over).dot(bar);
    length
        .above(S::zero())
        .then(|| arm * -(radius * along * over))
}

impl<S: Scalar<Mask = bool>> Gripped for Disc<S> {
    fn by_grip(&self, grip: &Grip<S>, bar: Vec3<S>, _: Vec3<S>, _: S) -> Option<Self> {
        let Grip::Round { arm, .. } = *grip else {
            return None;
        };
        Some(Disc {
            center: bar,
            normal: by_axis(self.normal, arm, self.radius, bar)?,
            radius: arm.dot(bar),
        })
    }
}

impl<S: Scalar<Mask = bool>> Gripped for Cylinder<S> {
    fn by_grip(&self, grip: &Grip<S>, bar: Vec3<S>, _: Vec3<S>, _: S) -> Option<Self> {
        let Grip::Round { share, arm, .. } = *grip else {
            return None;
        };
        let turn = by_axis(self.end - self.start, arm, self.radius, bar)?;
        Some(Cylinder {
            start: bar * (S::one() - share) - turn,
            end: bar * share + turn,
            radius: arm.dot(bar),
        })
    }
}

impl<S: Scalar<Mask = bool>> Gripped for Cone<S> {
    fn by_grip(&self, grip: &Grip<S>, bar: Vec3<S>, _: Vec3<S>, _: S) -> Option<Self> {
        let Grip::Round { share, arm, size } = *grip else {
            return None;
        };
        let turn = by_axis(self.base - self.apex, arm, self.radius * size, bar)?;
        Some(Cone {
            apex: bar * (S::one() - share) - turn,
            base: bar * share + turn,
            radius: arm.dot(bar) * size,
        })
    }
}

macro_rules! by_corners {
    ($([$($generic:tt)*] $A:ty;)*) => { $(
        impl<S: Real, $($generic)*> Gripped for $A {
            fn by_grip(&self, grip: &Grip<S>, bar: Vec3<S>, normal: Vec3<S>, factor: S) -> Option<Self> {
                let by = match *grip {
                    Grip::Corners(all) => all.map(|(corner, share)| (corner, bar * share)).to_vec(),
                    Grip::Box(along) => {
                        let share = |corner: usize, k: usize| match corner >> k & 1 {
                            0 => (S::one() - along[k]).halved(),
                            _ => (S::one() + along[k]).halved(),
                        };
                        let share = |k: usize| share(k, 0) * share(k, 1) * share(k, 2);
                        (0..8).map(|k| (k, bar * share(k))).collect()
                    }
                    Grip::Ball(_) | Grip::Round { .. } => return None,
                };
                Some(self.by_corners(&by, normal, factor))
            }
        }
    )* };
}
by_corners! {
    [] Vec3<S>;
    [] Sphere<S>;
    [] Segment3<S>;
    [] Capsule3<S>;
    [] Triangle3<S>;
    [] Tetrahedron<S>;
    [] Obb3<S>;
    [] RoundBox3<S>;
    [const N: usize] Hull3<S, N>;
}

macro_rules! by_replay {
    ($($A:ident)*) => { $(
        impl<S: Real> Gripped for $A<S> {
            fn by_grip(&self, _: &Grip<S>, _: Vec3<S>, _: Vec3<S>, _: S) -> Option<Self> {
                None
            }
        }
    )* };
}
by_replay! { Aabb3 YawBox3 }

/// Returns the relation of two shapes without normal and points, and the derivatives of their signed distance times a
/// factor, given the decisions and hints of a search; `None` where they need a replay.
pub(crate) fn curved_slopes<S, A, B>(
    a: &A,
    b: &B,
    record: CurvedRecord,
    hints: &[S; HINTS],
    factor: impl FnOnce(&Relation<S>) -> S,
) -> Option<(Relation<S>, A, B)>
where
    S: Real,
    A: Gripped<Scalar = S>,
    B: Gripped<Scalar = S>,
{
    let [i, j] = record
        .pieces
        .filter(|_| record.settled)?
        .map(|k| k as usize);
    let hints = Hints::load(hints);
    let InSearch {
        a: of_a, b: of_b, ..
    } = InSearch::by(a, b, hints.scale, hints.by_x);
    let (touch, apart) = touched(&of_a, &of_b, record, &hints, 1.0);
    let apart = apart * S::one().over(hints.scale);
    let found = Relation {
        apart,
        square: square_of_gap(apart),
        normal: Vec3::zero(),
        on_a: Vec3::zero(),
        on_b: Vec3::zero(),
    };
    let found = inflated(a, b, found);
    let factor = factor(&found);
    let normal = touch.normal;
    let bar = normal * factor;
    let by_a = a.by_grip(&of_a.grip(i, &touch.a, normal)?, -bar, normal, factor)?;
    let by_b = b.by_grip(&of_b.grip(j, &touch.b, -normal)?, bar, normal, factor)?;
    Some((found, by_a, by_b))
}

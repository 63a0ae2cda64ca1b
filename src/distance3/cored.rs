//! Shapes of space that are a core, inflated by a radius.
use super::boxes;
use super::core::{BoxCore, Core3, PointCore};
use super::simplex::{SegmentCore, SimplexCore, TetrahedronCore, TriangleCore};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::scalar::largest;
use crate::shape::{
    Aabb3, Capsule3, Obb3, RoundBox3, Segment3, Sphere, Tetrahedron, Triangle3, YawBox3,
};
use crate::{Pack, Rotation2, Rotation3, Scalar, Vec3};

/// A convex shape of space: every point at most [`radius`](InflatedCore::radius) from its [`core`](InflatedCore::core).
///
/// Points, segments, triangles, tetrahedra, boxes, balls, capsules and boxes with round edges are. Any two of them are
/// [`Apart`](super::Apart).
pub(crate) trait InflatedCore: Copy + Pack<Scalar: Scalar> {
    /// The type of the shape that is inflated.
    type Core: Core3<Self::Scalar>;
    /// `true` if the radius may be other than zero.
    const ROUND: bool = false;
    /// Returns the shape that is inflated.
    fn core(self) -> Self::Core;
    /// Returns the radius of the inflation; not negative.
    #[inline(always)]
    fn radius(&self) -> Self::Scalar {
        Self::Scalar::zero()
    }
    /// Returns the bounds, where the core is an axis-aligned box.
    #[doc(hidden)]
    #[inline(always)]
    fn bounds(&self) -> Option<Aabb3<Self::Scalar>> {
        None
    }
    /// Returns the heights of a point over the faces, if the core is a box.
    #[doc(hidden)]
    #[inline(always)]
    fn beyond(&self, _: Vec3<Self::Scalar>) -> Option<Vec3<Self::Scalar>> {
        None
    }
}

/// Returns the axes of a rotation: quotients by the squared length of its quaternion, so that quarter turns have none
/// but zeros and ones. The zero quaternion is no rotation.
#[inline(always)]
pub(super) fn axes<S: Scalar>(q: Rotation3<S>) -> [Vec3<S>; 3] {
    let scale = scale_of::<S>(largest([q.w, q.x, q.y, q.z]));
    let [w, x, y, z] = [q.w, q.x, q.y, q.z].each_as(|part| part * scale);
    let square = (w * w + x * x) + (y * y + z * z);
    let none = square.equals(S::zero());
    let square = S::select(none, S::one(), square);
    let w = S::select(none, S::one(), w);
    let twice = |sum: S| (sum + sum).over(square);
    let whole = |own: S, others: S| (w * w + own * own - others).over(square);
    let [xx, yy, zz] = [x * x, y * y, z * z];
    [
        Vec3::new(
            whole(x, yy + zz),
            twice(x * y + w * z),
            twice(x * z - w * y),
        ),
        Vec3::new(
            twice(x * y - w * z),
            whole(y, xx + zz),
            twice(y * z + w * x),
        ),
        Vec3::new(
            twice(x * z + w * y),
            twice(y * z - w * x),
            whole(z, xx + yy),
        ),
    ]
}

/// Returns a box with axes of length one.
#[inline(always)]
fn box_core<S: Scalar>(center: Vec3<S>, size: Vec3<S>, axes: [Vec3<S>; 3]) -> BoxCore<S> {
    BoxCore {
        given: center,
        arm: Vec3::zero(),
        center,
        half: [size.x.halved(), size.y.halved(), size.z.halved()],
        flat: [S::zero(); 3],
        axes,
    }
}

macro_rules! cored {
    ($(
        $Shape:ident: $Core:ident, |$shape:ident| $core:expr
        $(, faces $beyond:ident($solid:expr))? $(, radius $radius:ident)? $(, bounds $bounds:expr)?;
    )*) => { $(
        impl<S: Scalar> InflatedCore for $Shape<S> {
            type Core = $Core<S>;
            #[inline(always)]
            fn core(self) -> $Core<S> {
                let $shape = self;
                $core
            }
            $(
                #[inline(always)]
                fn beyond(&self, point: Vec3<S>) -> Option<Vec3<S>> {
                    let $shape = self;
                    Some(boxes::$beyond($solid, point))
                }
            )?
            $(
                const ROUND: bool = true;
                #[inline(always)]
                fn radius(&self) -> S {
                    self.$radius
                }
            )?
            $(
                #[inline(always)]
                fn bounds(&self) -> Option<Aabb3<S>> {
                    let $shape = self;
                    Some($bounds)
                }
            )?
        }
    )* };
}
cored! {
    Vec3: PointCore, |point| PointCore(point);
    Sphere: PointCore, |ball| PointCore(ball.center), radius radius;
    Segment3: SegmentCore, |edge| SimplexCore([edge.start, edge.end]);
    Capsule3: SegmentCore, |link| SimplexCore([link.start, link.end]), radius radius;
    Triangle3: TriangleCore, |face| SimplexCore(face.corners());
    Tetrahedron: TetrahedronCore, |solid| SimplexCore(solid.corners());
    Aabb3: BoxCore, |shape| {
        let (zero, one) = (S::zero(), S::one());
        let axes = [
            Vec3::new(one, zero, zero),
            Vec3::new(zero, one, zero),
            Vec3::new(zero, zero, one),
        ];
        let arm = shape.size() * S::lit(0.5);
        BoxCore {
            given: shape.min,
            arm,
            ..box_core(shape.min + arm, shape.size(), axes)
        }
    }, faces beyond_aabb3(*shape), bounds *shape;
    YawBox3: BoxCore, |shape| {
        let (Rotation2 { cos, sin }, zero) = (Rotation2::from_angle(shape.heading), S::zero());
        let axes = [
            Vec3::new(cos, sin, zero),
            Vec3::new(-sin, cos, zero),
            Vec3::new(zero, zero, S::one()),
        ];
        box_core(shape.center, shape.size, axes)
    }, faces beyond_yaw(*shape);
    Obb3: BoxCore, |shape| box_core(shape.center, shape.size, axes(shape.rotation)), faces beyond_obb3(*shape);
    RoundBox3: BoxCore, |shape| {
        let inner = shape.inner;
        box_core(inner.center, inner.size, axes(inner.rotation))
    }, faces beyond_obb3(shape.inner), radius radius;
}

//! Overlap of boxes of two kinds.
use super::{
    intersection_volume_aabb3, intersection_volume_obb3, intersection_volume_yaw, iof_aabb3,
    iof_obb3, iof_yaw, iou_aabb3, iou_obb3, iou_obb3_vjp, iou_yaw,
};
use crate::scalar::guarded;
use crate::shape::{Aabb3, Obb3, Rotation3, YawBox3};
use crate::{Fixed, Pack, Scalar};

/// Boxes that overlap another kind of box: every pair of [`Aabb3`], [`YawBox3`] and [`Obb3`]. The pair is
/// measured as boxes of the more general kind.
pub trait Overlaps<B> {
    /// The number type of the boxes.
    type Scalar: Scalar;
    /// Returns the volume that both share, in cubed units of length.
    #[must_use]
    fn volume_shared_with(self, other: B) -> Self::Scalar;
    /// Returns the intersection over union, in `[0, 1]`.
    #[must_use]
    fn iou_with(self, other: B) -> Self::Scalar;
    /// Returns the share of this box that lies in the other one, in `[0, 1]`.
    #[must_use]
    fn iof_with(self, other: B) -> Self::Scalar;
}

macro_rules! overlaps {
    ($($a:ident $b:ident as $more:ident: $volume:ident $iou:ident $iof:ident;)*) => { $(
        impl<S: Scalar> Overlaps<$b<S>> for $a<S> {
            type Scalar = S;
            #[inline]
            fn volume_shared_with(self, other: $b<S>) -> S {
                $volume($more::from(self), $more::from(other))
            }
            #[inline]
            fn iou_with(self, other: $b<S>) -> S {
                $iou($more::from(self), $more::from(other))
            }
            #[inline]
            fn iof_with(self, other: $b<S>) -> S {
                $iof($more::from(self), $more::from(other))
            }
        }
    )* };
}
overlaps! {
    Aabb3 Aabb3 as Aabb3: intersection_volume_aabb3 iou_aabb3 iof_aabb3;
    Aabb3 YawBox3 as YawBox3: intersection_volume_yaw iou_yaw iof_yaw;
    Aabb3 Obb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
    YawBox3 Aabb3 as YawBox3: intersection_volume_yaw iou_yaw iof_yaw;
    YawBox3 YawBox3 as YawBox3: intersection_volume_yaw iou_yaw iof_yaw;
    YawBox3 Obb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
    Obb3 Aabb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
    Obb3 YawBox3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
    Obb3 Obb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
}

macro_rules! methods {
    ($($a:ident)*) => { $(
        impl<S: Scalar> $a<S> {
            /// Returns the intersection over union with a box of any kind, in `[0, 1]`.
            #[must_use]
            #[inline]
            pub fn iou<B>(self, other: B) -> S
            where
                Self: Overlaps<B, Scalar = S>,
                B: Fixed<Scalar = S>,
            {
                guarded((self, other), |(a, b)| a.iou_with(b))
            }
            /// Returns the share of this box that lies in a box of any kind, in `[0, 1]`.
            #[must_use]
            #[inline]
            pub fn iof<B>(self, other: B) -> S
            where
                Self: Overlaps<B, Scalar = S>,
                B: Fixed<Scalar = S>,
            {
                guarded((self, other), |(a, b)| a.iof_with(b))
            }
            /// Returns the volume shared with a box of any kind, in cubed units of length.
            #[must_use]
            #[inline]
            pub fn intersection_volume<B>(self, other: B) -> S
            where
                Self: Overlaps<B, Scalar = S>,
                B: Fixed<Scalar = S>,
            {
                guarded((self, other), |(a, b)| a.volume_shared_with(b))
            }
        }
    )* };
}
methods! { Aabb3 YawBox3 Obb3 }

/// Returns the gradient by an upright box from that by its form with any orientation: the turn about the z axis is the
/// third of its body tangents.
#[inline]
fn upright<S: Scalar>(shape: YawBox3<S>, g: Obb3<S>) -> YawBox3<S> {
    // An eighth of the gradient, so that a sum of the largest numbers is finite.
    let q = g.rotation;
    let eighth = S::lit(0.125);
    let q = Rotation3::new(q.w * eighth, q.x * eighth, q.y * eighth, q.z * eighth);
    let turn = shape.rotation().tangent_gradient(q);
    YawBox3::new(g.center, g.size, (turn.z * S::lit(8.0)).saturated())
}

/// Returns the gradient by bounds from that by the box's form with any orientation.
#[inline]
fn bounds<S: Scalar>(g: Obb3<S>) -> Aabb3<S> {
    let half = g.center * S::lit(0.5);
    Aabb3::new((half - g.size).saturated(), (half + g.size).saturated())
}

/// Returns the intersection over union of an upright box and one of any orientation, and `out_bar` times its
/// derivatives by both.
#[must_use]
#[inline]
pub fn iou_yaw_obb3_vjp<S: Scalar>(
    a: YawBox3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (YawBox3<S>, Obb3<S>)) {
    let (value, (a_bar, b_bar)) = iou_obb3_vjp(a.into(), b, out_bar);
    (value, (upright(a, a_bar), b_bar))
}

/// Returns the intersection over union of an axis-aligned box and one of any orientation, and `out_bar` times its
/// derivatives by both.
#[must_use]
#[inline]
pub fn iou_aabb3_obb3_vjp<S: Scalar>(
    a: Aabb3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (Aabb3<S>, Obb3<S>)) {
    let (value, (a_bar, b_bar)) = iou_obb3_vjp(a.into(), b, out_bar);
    (value, (bounds(a_bar), b_bar))
}

/// A box of space as one of any orientation, and its gradient from that one's.
pub(crate) trait AnyBox<S: Scalar>: Copy + Into<Obb3<S>> + Pack<Scalar = S> {
    /// Returns the gradient by this box from that by its form with any orientation.
    fn own_gradient(self, g: Obb3<S>) -> Self;
}
impl<S: Scalar> AnyBox<S> for Obb3<S> {
    #[inline]
    fn own_gradient(self, g: Obb3<S>) -> Self {
        g
    }
}
impl<S: Scalar> AnyBox<S> for YawBox3<S> {
    #[inline]
    fn own_gradient(self, g: Obb3<S>) -> Self {
        upright(self, g)
    }
}
impl<S: Scalar> AnyBox<S> for Aabb3<S> {
    #[inline]
    fn own_gradient(self, g: Obb3<S>) -> Self {
        bounds(g)
    }
}

/// Returns the result and gradients for boxes of two kinds, from those for boxes of any orientation.
#[inline]
pub(crate) fn mixed_vjp<S: Scalar, A: AnyBox<S>, B: AnyBox<S>>(
    a: A,
    b: B,
    vjp: impl FnOnce(Obb3<S>, Obb3<S>) -> (S, (Obb3<S>, Obb3<S>)),
) -> (S, (A, B)) {
    let (value, (a_bar, b_bar)) = vjp(a.into(), b.into());
    let (mut a_bar, mut b_bar) = (a.own_gradient(a_bar), b.own_gradient(b_bar));
    // Zeros have no sign, as in all results.
    a_bar.each(&mut |x| *x = x.canonical());
    b_bar.each(&mut |x| *x = x.canonical());
    (value, (a_bar, b_bar))
}

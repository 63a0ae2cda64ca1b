//! Overlap of boxes of two kinds.
use super::{
    intersection_volume_aabb3, intersection_volume_obb3, intersection_volume_yaw, iof_aabb3,
    iof_obb3, iof_yaw, iou_aabb3, iou_obb3, iou_yaw,
};
use crate::scalar::guarded;
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Fixed, Scalar};

/// Boxes that overlap another kind of box: every pair of [`Aabb3`], [`YawBox3`] and [`Obb3`]. The pair is
/// measured as boxes of the more general kind. Other bodies are those of [`overlap_solid`](crate::overlap_solid).
#[doc(hidden)]
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

/// Each kind of box, with the kinds of the other box and the kind as which both are measured.
macro_rules! overlaps {
    ($($a:ident: { $($b:ident as $more:ident: $volume:ident $iou:ident $iof:ident;)* })*) => { $(
        $(
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
        )*
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
overlaps! {
    Aabb3: {
        Aabb3 as Aabb3: intersection_volume_aabb3 iou_aabb3 iof_aabb3;
        YawBox3 as YawBox3: intersection_volume_yaw iou_yaw iof_yaw;
        Obb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
    }
    YawBox3: {
        Aabb3 as YawBox3: intersection_volume_yaw iou_yaw iof_yaw;
        YawBox3 as YawBox3: intersection_volume_yaw iou_yaw iof_yaw;
        Obb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
    }
    Obb3: {
        Aabb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
        YawBox3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
        Obb3 as Obb3: intersection_volume_obb3 iou_obb3 iof_obb3;
    }
}

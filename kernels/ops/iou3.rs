//! The family of IoU in space as operations.
//!
//! What is put around a pair is a box along the axes of the world.
use crate::iou3::{Enclosing, ciou, diou, eiou, giou};
use crate::operation;
use crate::shape::{Aabb3, YawBox3};

operation! {
    /// [`ciou`] of axis-aligned boxes.
    pub CiouAabb3 = "ciou_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { ciou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Reverse

    /// [`giou`] of upright boxes.
    pub GiouYaw = "giou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { giou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Forward

    /// [`diou`] of upright boxes.
    pub DiouYaw = "diou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { diou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Forward

    /// [`ciou`] of upright boxes.
    pub CiouYaw = "ciou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { ciou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Forward

    /// [`eiou`] of upright boxes.
    pub EiouYaw = "eiou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { eiou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Forward
}

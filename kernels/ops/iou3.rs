//! The family of IoU in space, and overlaps that have slopes for boxes apart, as operations.
//!
//! What a plain name puts around a pair is in the table of [`iou3`](crate::iou3); suffixes name other shapes.
use crate::Obb2;
use crate::ad::adjoint::iou3::score_obb3_vjp;
use crate::iou::separation_aware_obb2;
use crate::iou3::{Enclosing, Score, alpha_iou, ciou, diou, eiou, giou, separation_aware};
use crate::operation;
use crate::overlap3::{iou_aabb3, iou_yaw};
use crate::shape::{Aabb3, Obb3, YawBox3};

// Slopes of quotients of volumes lose digits backwards. By the diameter of the hull of rotated grounds the slope of
// corners that are equally far is shared by the first one's frame: exchanged boxes share it otherwise.
operation! {
    /// [`giou`] of axis-aligned boxes by the box around both.
    pub GiouAabb3 = "giou_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { giou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`diou`] of axis-aligned boxes by the box around both.
    pub DiouAabb3 = "diou_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { diou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes Reverse

    /// [`ciou`] of axis-aligned boxes by the box around both.
    pub CiouAabb3 = "ciou_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { ciou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Reverse

    /// [`eiou`] of axis-aligned boxes by the box around both.
    pub EiouAabb3 = "eiou_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { eiou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Reverse

    /// [`giou`] of upright boxes by the convex hull of their grounds times the height of both.
    pub GiouYaw = "giou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { giou(a, b, Enclosing::Hull) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`diou`] of upright boxes by the convex hull of their grounds times the height of both.
    pub DiouYaw = "diou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { diou(a, b, Enclosing::Hull) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Rotation Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`ciou`] of upright boxes by the convex hull of their grounds times the height of both.
    pub CiouYaw = "ciou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { ciou(a, b, Enclosing::Hull) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Rotation Stays]
    jumps Anywhere
    slopes Forward

    /// [`eiou`] of upright boxes by the convex hull of their grounds times the height of both.
    pub EiouYaw = "eiou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { eiou(a, b, Enclosing::Hull) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Rotation Stays]
    jumps Anywhere
    slopes Forward

    /// [`giou`] of upright boxes by the box around both along the axes of the world.
    pub GiouAabbYaw = "giou_aabb_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { giou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`diou`] of upright boxes by the box around both along the axes of the world.
    pub DiouAabbYaw = "diou_aabb_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { diou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`ciou`] of upright boxes by the box around both along the axes of the world.
    pub CiouAabbYaw = "ciou_aabb_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { ciou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Forward

    /// [`eiou`] of upright boxes by the box around both along the axes of the world.
    pub EiouAabbYaw = "eiou_aabb_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { eiou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Forward

    /// [`giou`] of upright boxes by the rectangle of least area around their grounds times the height of both.
    pub GiouRectangleYaw = "giou_rectangle_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { giou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`diou`] of upright boxes by the rectangle of least area around their grounds times the height of both.
    pub DiouRectangleYaw = "diou_rectangle_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { diou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`ciou`] of upright boxes by the rectangle of least area around their grounds times the height of both.
    pub CiouRectangleYaw = "ciou_rectangle_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { ciou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    jumps Anywhere
    slopes Forward

    /// [`eiou`] of upright boxes by the rectangle of least area around their grounds times the height of both.
    pub EiouRectangleYaw = "eiou_rectangle_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { eiou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    jumps Anywhere
    slopes Forward

    /// [`giou`] of boxes of any orientation by the smaller box around both along the axes of either.
    pub GiouObb3 = "giou_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { giou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Giou, Enclosing::Rectangle), a, b, out_bar) }

    /// [`diou`] of boxes of any orientation by the smaller box around both along the axes of either.
    pub DiouObb3 = "diou_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { diou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Diou, Enclosing::Rectangle), a, b, out_bar) }

    /// [`ciou`] of boxes of any orientation by the smaller box around both along the axes of either.
    pub CiouObb3 = "ciou_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { ciou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Ciou, Enclosing::Rectangle), a, b, out_bar) }

    /// [`eiou`] of boxes of any orientation by the smaller box around both along the axes of either.
    pub EiouObb3 = "eiou_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { eiou(a, b, Enclosing::Rectangle) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Eiou, Enclosing::Rectangle), a, b, out_bar) }

    /// [`giou`] of boxes of any orientation by the box around both along the axes of the world.
    pub GiouAabbObb3 = "giou_aabb_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { giou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Giou, Enclosing::Aabb), a, b, out_bar) }

    /// [`diou`] of boxes of any orientation by the box around both along the axes of the world.
    pub DiouAabbObb3 = "diou_aabb_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { diou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Diou, Enclosing::Aabb), a, b, out_bar) }

    /// [`ciou`] of boxes of any orientation by the box around both along the axes of the world.
    pub CiouAabbObb3 = "ciou_aabb_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { ciou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Ciou, Enclosing::Aabb), a, b, out_bar) }

    /// [`eiou`] of boxes of any orientation by the box around both along the axes of the world.
    pub EiouAabbObb3 = "eiou_aabb_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { eiou(a, b, Enclosing::Aabb) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Eiou, Enclosing::Aabb), a, b, out_bar) }

    /// [`alpha_iou`] of upright boxes with the power three, its paper's choice.
    pub AlphaIouYaw = "alpha_iou_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { alpha_iou(iou_yaw(a, b), S::lit(3.0)) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    range RATIO
    jumps FromZero
    slopes Forward

    /// [`alpha_iou`] of axis-aligned boxes with the power three, its paper's choice.
    pub AlphaIouAabb3 = "alpha_iou_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { alpha_iou(iou_aabb3(a, b), S::lit(3.0)) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range RATIO
    jumps FromZero
    slopes Reverse

    /// [`separation_aware`] of axis-aligned boxes.
    pub SeparationAwareAabb3 = "separation_aware_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { separation_aware(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes Reverse

    /// [`separation_aware`] of upright boxes.
    pub SeparationAwareYaw = "separation_aware_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { separation_aware(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    range SIGNED
    jumps Anywhere
    slopes Forward

    /// [`separation_aware`] of boxes of any orientation.
    pub SeparationAwareObb3 = "separation_aware_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { separation_aware(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    range SIGNED
    jumps Anywhere
    slopes ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Separation, Enclosing::Aabb), a, b, out_bar) }

    /// [`separation_aware_obb2`] of rotated boxes.
    pub SeparationAwareObb2 = "separation_aware_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { separation_aware_obb2(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    range SIGNED
    jumps Never
    slopes Forward
}

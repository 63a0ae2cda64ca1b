//! The family of IoU in space, and overlaps that have derivatives for boxes apart, as operations.
//!
//! The table of [`iou3`](crate::iou3) has the enclosing shape of a plain name; suffixes name other shapes.
use crate::ad::adjoint::iou3::score_obb3_vjp;
use crate::iou::separation_aware_obb2;
use crate::iou3::{Enclosing, Score, alpha_iou, ciou, diou, eiou, giou, separation_aware};
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{
    AlphaIou, Ciou, CiouAabb, CiouRectangle, Diou, DiouAabb, DiouRectangle, Eiou, EiouAabb,
    EiouRectangle, Giou, GiouAabb, GiouRectangle, SeparationAware,
};
use crate::overlap3::{iou_aabb3, iou_yaw};
use crate::{Aabb3, Obb2, Obb3, YawBox3};

// Reverse derivatives of quotients of volumes lose digits. Rows that use the diameter of the hull of rotated ground
// plans are not symmetric: equally far corners share the derivative in the frame of the first box.
table! {
    /// The [generalised IoU](crate::iou3::giou) of {}.
    Giou: (a, b) -> S { giou(a, b, Enclosing::Aabb) }
    [similar, symmetric] (range SIGNED jumps Anywhere) derivative Forward {
        /// It takes the axis-aligned box around both.
        "giou_aabb3": Aabb3, Aabb3;
        /// It takes the convex hull of the grounds times the height of both.
        "giou_yaw": YawBox3, YawBox3 { giou(a, b, Enclosing::Hull) };
        /// It takes the smaller box around both along the axes of either.
        "giou_obb3": Obb3, Obb3 { giou(a, b, Enclosing::Rectangle) }
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Giou, Enclosing::Rectangle), a, b, out_bar) };
    }
    /// The [generalised IoU](crate::iou3::giou) of {} by the box around both along the axes of the world.
    GiouAabb: (a, b) -> S { giou(a, b, Enclosing::Aabb) }
    [similar, along_axes, symmetric] (range SIGNED jumps Anywhere) derivative Forward {
        "giou_aabb_yaw": YawBox3, YawBox3;
        "giou_aabb_obb3": Obb3, Obb3
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Giou, Enclosing::Aabb), a, b, out_bar) };
    }
    /// The [generalised IoU](crate::iou3::giou) of {} by the rectangle of least area around both grounds times the
    /// height of both.
    GiouRectangle: (a, b) -> S { giou(a, b, Enclosing::Rectangle) }
    [similar, symmetric] (range SIGNED jumps Anywhere) derivative Forward {
        "giou_rectangle_yaw": YawBox3, YawBox3;
    }
    /// The [distance IoU](crate::iou3::diou) of {}.
    Diou: (a, b) -> S { diou(a, b, Enclosing::Aabb) }
    [similar, symmetric] (range SIGNED jumps Anywhere) derivative Forward {
        /// It takes the axis-aligned box around both.
        "diou_aabb3": Aabb3, Aabb3 derivative Reverse;
        /// It takes the convex hull of the grounds times the height of both.
        "diou_yaw": YawBox3, YawBox3 { diou(a, b, Enclosing::Hull) } [similar];
        /// It takes the smaller box around both along the axes of either.
        "diou_obb3": Obb3, Obb3 { diou(a, b, Enclosing::Rectangle) }
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Diou, Enclosing::Rectangle), a, b, out_bar) };
    }
    /// The [distance IoU](crate::iou3::diou) of {} by the box around both along the axes of the world.
    DiouAabb: (a, b) -> S { diou(a, b, Enclosing::Aabb) }
    [similar, along_axes, symmetric] (range SIGNED jumps Anywhere) derivative Forward {
        "diou_aabb_yaw": YawBox3, YawBox3;
        "diou_aabb_obb3": Obb3, Obb3
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Diou, Enclosing::Aabb), a, b, out_bar) };
    }
    /// The [distance IoU](crate::iou3::diou) of {} by the rectangle of least area around both grounds times the
    /// height of both.
    DiouRectangle: (a, b) -> S { diou(a, b, Enclosing::Rectangle) }
    [similar, symmetric] (range SIGNED jumps Anywhere) derivative Forward {
        "diou_rectangle_yaw": YawBox3, YawBox3;
    }
    /// The [complete IoU](crate::iou3::ciou) of {}.
    Ciou: (a, b) -> S { ciou(a, b, Enclosing::Aabb) } [similar, symmetric] (jumps Anywhere) derivative Forward {
        /// It takes the axis-aligned box around both.
        "ciou_aabb3": Aabb3, Aabb3 derivative Reverse;
        /// It takes the convex hull of the grounds times the height of both.
        "ciou_yaw": YawBox3, YawBox3 { ciou(a, b, Enclosing::Hull) } [similar];
        /// It takes the smaller box around both along the axes of either.
        "ciou_obb3": Obb3, Obb3 { ciou(a, b, Enclosing::Rectangle) }
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Ciou, Enclosing::Rectangle), a, b, out_bar) };
    }
    /// The [complete IoU](crate::iou3::ciou) of {} by the box around both along the axes of the world.
    CiouAabb: (a, b) -> S { ciou(a, b, Enclosing::Aabb) }
    [similar, along_axes, symmetric] (jumps Anywhere) derivative Forward {
        "ciou_aabb_yaw": YawBox3, YawBox3;
        "ciou_aabb_obb3": Obb3, Obb3
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Ciou, Enclosing::Aabb), a, b, out_bar) };
    }
    /// The [complete IoU](crate::iou3::ciou) of {} by the rectangle of least area around both grounds times the
    /// height of both.
    CiouRectangle: (a, b) -> S { ciou(a, b, Enclosing::Rectangle) }
    [similar, symmetric] (jumps Anywhere) derivative Forward {
        "ciou_rectangle_yaw": YawBox3, YawBox3;
    }
    /// The [efficient IoU](crate::iou3::eiou) of {}.
    Eiou: (a, b) -> S { eiou(a, b, Enclosing::Aabb) } [similar, symmetric] (jumps Anywhere) derivative Forward {
        /// It takes the axis-aligned box around both.
        "eiou_aabb3": Aabb3, Aabb3 derivative Reverse;
        /// It takes the convex hull of the grounds times the height of both.
        "eiou_yaw": YawBox3, YawBox3 { eiou(a, b, Enclosing::Hull) } [similar];
        /// It takes the smaller box around both along the axes of either.
        "eiou_obb3": Obb3, Obb3 { eiou(a, b, Enclosing::Rectangle) }
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Eiou, Enclosing::Rectangle), a, b, out_bar) };
    }
    /// The [efficient IoU](crate::iou3::eiou) of {} by the box around both along the axes of the world.
    EiouAabb: (a, b) -> S { eiou(a, b, Enclosing::Aabb) }
    [similar, along_axes, symmetric] (jumps Anywhere) derivative Forward {
        "eiou_aabb_yaw": YawBox3, YawBox3;
        "eiou_aabb_obb3": Obb3, Obb3
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Eiou, Enclosing::Aabb), a, b, out_bar) };
    }
    /// The [efficient IoU](crate::iou3::eiou) of {} by the rectangle of least area around both grounds times the
    /// height of both.
    EiouRectangle: (a, b) -> S { eiou(a, b, Enclosing::Rectangle) }
    [similar, symmetric] (jumps Anywhere) derivative Forward {
        "eiou_rectangle_yaw": YawBox3, YawBox3;
    }
    /// The [IoU](crate::iou3::alpha_iou) of {} to the power three, its paper's choice.
    AlphaIou: (a, b) -> S { alpha_iou(iou_yaw(a, b), S::lit(3.0)) }
    [similar, symmetric] (range RATIO jumps FromZero) derivative Forward {
        "alpha_iou_yaw": YawBox3, YawBox3;
        "alpha_iou_aabb3": Aabb3, Aabb3 { alpha_iou(iou_aabb3(a, b), S::lit(3.0)) } derivative Reverse;
    }
    /// The [IoU with a term for separation](crate::iou3::separation_aware) of {}.
    SeparationAware: (a, b) -> S { separation_aware(a, b) }
    [similar, symmetric] (range SIGNED jumps Anywhere) derivative Forward {
        "separation_aware_aabb3": Aabb3, Aabb3 derivative Reverse;
        "separation_aware_yaw": YawBox3, YawBox3;
        "separation_aware_obb3": Obb3, Obb3
            derivative ByHand |(a, b), out_bar| { score_obb3_vjp((Score::Separation, Enclosing::Aabb), a, b, out_bar) };
        "separation_aware_obb2": Obb2, Obb2 { separation_aware_obb2(a, b) } (jumps Never);
    }
}

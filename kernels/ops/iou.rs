//! The family of intersection over union as operations.
use crate::ad::adjoint::iou::giou_framed_vjp;
use crate::clip::frame;
use crate::iou;
use crate::iou::Exponent;
use crate::kernels::row::compiled::Compiled;
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{
    AlphaIou, Ciou, CiouAabb, CiouFixedWeight, CiouHull, Diou, DiouAabb, DiouHull, Eiou, EiouAabb,
    EiouHull, Giou, GiouAabb, GiouHull, HullArea,
};
use crate::{Aabb2, Obb2};

// Reverse derivatives of quotients of areas lose digits. CIoU jumps where a box has no size, and so no aspect; EIoU
// jumps where the box around both has no width or no height. Rows that use the diameter of the hull of rotated boxes
// are not symmetric: equally far corners share the derivative in the frame of the first box.
table! {
    /// The [generalised IoU](crate::iou::giou_obb2) of {}.
    Giou: (a, b) -> S { iou::giou_aabb2(a, b) } [similar, symmetric] (range SIGNED jumps FromZero) derivative Forward {
        /// It takes the axis-aligned box around both.
        "giou_aabb2": Aabb2, Aabb2;
        /// It takes the convex hull of both.
        "giou_obb2": Obb2, Obb2 { iou::giou_framed::<S, true>(frame(a), frame(b)) } (finite Always extremes One)
            derivative ByHand |(a, b), out_bar| { giou_framed_vjp::<S, true>(frame(a), frame(b), out_bar) }
            => compiled { Compiled::Giou };
    }
    /// The [generalised IoU](crate::iou::giou_hull_aabb2) of {} by the convex hull.
    GiouHull: (a, b) -> S { iou::giou_hull_aabb2(a, b) }
    [similar, symmetric] (range SIGNED jumps FromZero) derivative Forward {
        "giou_hull_aabb2": Aabb2, Aabb2;
    }
    /// The [generalised IoU](crate::iou::giou_aabb_obb2) of {} by the box around both.
    GiouAabb: (a, b) -> S { iou::giou_aabb_obb2(a, b) }
    [similar, along_axes, symmetric] (range SIGNED jumps FromZero) derivative Forward {
        "giou_aabb_obb2": Obb2, Obb2;
    }
    /// The [distance IoU](crate::iou::diou_obb2) of {}.
    Diou: (a, b) -> S { iou::diou_aabb2(a, b) } [similar] (range SIGNED jumps FromZero) derivative Forward {
        /// It takes the axis-aligned box around both.
        "diou_aabb2": Aabb2, Aabb2 [similar, symmetric];
        /// It takes the convex hull of both.
        "diou_obb2": Obb2, Obb2 { iou::diou_obb2(a, b) };
    }
    /// The [distance IoU](crate::iou::diou_hull_aabb2) of {} by the diameter of the convex hull.
    DiouHull: (a, b) -> S { iou::diou_hull_aabb2(a, b) }
    [similar, symmetric] (range SIGNED jumps FromZero) derivative Forward {
        "diou_hull_aabb2": Aabb2, Aabb2;
    }
    /// The [distance IoU](crate::iou::diou_aabb_obb2) of {} by the diagonal of the box around both.
    DiouAabb: (a, b) -> S { iou::diou_aabb_obb2(a, b) }
    [similar, along_axes, symmetric] (range SIGNED jumps FromZero) derivative Forward {
        "diou_aabb_obb2": Obb2, Obb2;
    }
    /// The [complete IoU](crate::iou::ciou_obb2) of {}.
    Ciou: (a, b) -> S { iou::ciou_aabb2(a, b) } [similar] (range CIOU jumps Anywhere) derivative Forward {
        /// It takes the axis-aligned box around both.
        "ciou_aabb2": Aabb2, Aabb2 [similar, symmetric];
        /// It takes the convex hull of both.
        "ciou_obb2": Obb2, Obb2 { iou::ciou_obb2(a, b) };
    }
    /// The [complete IoU](crate::iou::ciou_hull_aabb2) of {} by the diameter of the convex hull.
    CiouHull: (a, b) -> S { iou::ciou_hull_aabb2(a, b) }
    [similar, symmetric] (range CIOU jumps Anywhere) derivative Forward {
        "ciou_hull_aabb2": Aabb2, Aabb2;
    }
    /// The [complete IoU](crate::iou::ciou_aabb_obb2) of {} by the diagonal of the box around both.
    CiouAabb: (a, b) -> S { iou::ciou_aabb_obb2(a, b) }
    [similar, along_axes, symmetric] (range CIOU jumps Anywhere) derivative Forward {
        "ciou_aabb_obb2": Obb2, Obb2;
    }
    /// The [complete IoU](crate::iou::ciou_fixed_weight_obb2) of {}, its weight a constant in the gradient.
    CiouFixedWeight: (a, b) -> S { iou::ciou_fixed_weight_aabb2(a, b) }
    [similar] (range CIOU jumps Anywhere) derivative Forward {
        "ciou_fixed_weight_aabb2": Aabb2, Aabb2 [similar, symmetric];
        "ciou_fixed_weight_obb2": Obb2, Obb2 { iou::ciou_fixed_weight_obb2(a, b) };
    }
    /// The [efficient IoU](crate::iou::eiou_obb2) of {}.
    Eiou: (a, b) -> S { iou::eiou_aabb2(a, b) } [similar] (jumps Anywhere) derivative Forward {
        /// It takes the axis-aligned box around both.
        "eiou_aabb2": Aabb2, Aabb2 [similar, symmetric] (range EIOU_BOX);
        /// It takes the convex hull of both.
        "eiou_obb2": Obb2, Obb2 { iou::eiou_obb2(a, b) } (range EIOU_HULL);
    }
    /// The [efficient IoU](crate::iou::eiou_hull_aabb2) of {} by the convex hull.
    EiouHull: (a, b) -> S { iou::eiou_hull_aabb2(a, b) }
    [similar, symmetric] (range EIOU_HULL jumps Anywhere) derivative Forward {
        "eiou_hull_aabb2": Aabb2, Aabb2;
    }
    /// The [efficient IoU](crate::iou::eiou_aabb_obb2) of {} by the box around both.
    EiouAabb: (a, b) -> S { iou::eiou_aabb_obb2(a, b) }
    [similar, along_axes, symmetric] (range EIOU jumps Anywhere) derivative Forward {
        "eiou_aabb_obb2": Obb2, Obb2;
    }
    /// The [area of the convex hull](crate::iou::hull_area_obb2) of {}.
    HullArea: (a, b) -> S { iou::hull_area_aabb2(a, b) }
    [rigid(2), symmetric] (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "hull_area_aabb2": Aabb2, Aabb2;
        "hull_area_obb2": Obb2, Obb2 { iou::hull_area_obb2(a, b) };
    }
    /// A [power](crate::iou::alpha_iou_obb2) of the IoU of {}.
    AlphaIou: (a, b, power) -> S { iou::alpha_iou_aabb2(a, b, power.alpha) }
    [similar] (range RATIO jumps FromZero) derivative Forward {
        "alpha_iou_aabb2": Aabb2, Aabb2, Exponent;
        "alpha_iou_obb2": Obb2, Obb2, Exponent { iou::alpha_iou_obb2(a, b, power.alpha) };
    }
}

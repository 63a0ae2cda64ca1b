//! The family of intersection over union as operations.
use crate::ad::adjoint::iou::giou_framed_vjp;
use crate::clip::frame;
use crate::iou;
use crate::iou::Exponent;
use crate::kernels::cpu::plan::Compiled;
use crate::kernels::op::{Extremes, Finite, Jumps, Op, Promise, Range, Slopes};
use crate::kernels::ops::rows::{promises, rows_of_pairs};
use crate::operation;
use crate::{Aabb2, Obb2, Scalar};

/// [`giou_obb2`](crate::iou::giou_obb2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GiouObb2;

impl Op for GiouObb2 {
    const NAME: &'static str = "giou_obb2";
    const ARGUMENTS: &'static [&'static str] = &["a", "b"];
    const DOC: &'static str = "[`giou_obb2`](crate::iou::giou_obb2).";
    type In<S: Scalar> = (Obb2<S>, Obb2<S>);
    type Out<S: Scalar> = S;
    const PROMISES: &'static [Promise] = promises!(
        [TranslationX Stays, TranslationY Stays, Scaling Stays]
        [Rotation Stays, Exchange Stays]
    );
    const JUMPS: Jumps = Jumps::FromZero;
    const SLOPES: Slopes = Slopes::ByHand;
    const FINITE: Finite = Finite::Always;
    const RANGE: Range = Range::SIGNED;
    const EXTREMES: Extremes = Extremes::One;
    #[inline]
    fn eval<S: Scalar>((a, b): Self::In<S>) -> S {
        iou::giou_framed::<S, true>(frame(a), frame(b))
    }
    #[inline]
    fn adjoint<S: Scalar>((a, b): Self::In<S>, out_bar: S) -> Option<(S, Self::In<S>)> {
        Some(giou_framed_vjp::<S, true>(frame(a), frame(b), out_bar))
    }
    fn compiled() -> Option<Compiled> {
        Some(Compiled::Giou)
    }
}

// Slopes of quotients of areas lose digits backwards. CIoU jumps where a box has no size, and so no
// aspect, EIoU where the box around both has no width or no height. By the diameter of the hull of rotated
// boxes the slope of corners that are equally far is shared by the first one's frame: exchanged boxes
// share it otherwise.
rows_of_pairs! {
    iou::giou_aabb2 as "[`giou_aabb2`](crate::iou::giou_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range SIGNED,
    jumps FromZero, slopes Forward {
        GiouAabb2 = "giou_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::giou_hull_aabb2 as "[`giou_hull_aabb2`](crate::iou::giou_hull_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range SIGNED,
    jumps FromZero, slopes Forward {
        GiouHullAabb2 = "giou_hull_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::giou_aabb_obb2 as "[`giou_aabb_obb2`](crate::iou::giou_aabb_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range SIGNED,
    jumps FromZero, slopes Forward {
        GiouAabbObb2 = "giou_aabb_obb2": Obb2, Obb2, "two rotated boxes" [Exchange Stays];
    }
    iou::diou_aabb2 as "[`diou_aabb2`](crate::iou::diou_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range SIGNED,
    jumps FromZero, slopes Forward {
        DiouAabb2 = "diou_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::diou_hull_aabb2 as "[`diou_hull_aabb2`](crate::iou::diou_hull_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range SIGNED,
    jumps FromZero, slopes Forward {
        DiouHullAabb2 = "diou_hull_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::diou_obb2 as "[`diou_obb2`](crate::iou::diou_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range SIGNED,
    jumps FromZero, slopes Forward {
        DiouObb2 = "diou_obb2": Obb2, Obb2, "two rotated boxes" [Rotation Stays];
    }
    iou::diou_aabb_obb2 as "[`diou_aabb_obb2`](crate::iou::diou_aabb_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range SIGNED,
    jumps FromZero, slopes Forward {
        DiouAabbObb2 = "diou_aabb_obb2": Obb2, Obb2, "two rotated boxes" [Exchange Stays];
    }
    iou::ciou_aabb2 as "[`ciou_aabb2`](crate::iou::ciou_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range CIOU,
    jumps Anywhere, slopes Forward {
        CiouAabb2 = "ciou_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::ciou_hull_aabb2 as "[`ciou_hull_aabb2`](crate::iou::ciou_hull_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range CIOU,
    jumps Anywhere, slopes Forward {
        CiouHullAabb2 = "ciou_hull_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::ciou_obb2 as "[`ciou_obb2`](crate::iou::ciou_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range CIOU,
    jumps Anywhere, slopes Forward {
        CiouObb2 = "ciou_obb2": Obb2, Obb2, "two rotated boxes" [Rotation Stays];
    }
    iou::ciou_aabb_obb2 as "[`ciou_aabb_obb2`](crate::iou::ciou_aabb_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range CIOU,
    jumps Anywhere, slopes Forward {
        CiouAabbObb2 = "ciou_aabb_obb2": Obb2, Obb2, "two rotated boxes" [Exchange Stays];
    }
    iou::ciou_fixed_weight_aabb2 as "[`ciou_fixed_weight_aabb2`](crate::iou::ciou_fixed_weight_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range CIOU,
    jumps Anywhere, slopes Forward {
        CiouFixedWeightAabb2 = "ciou_fixed_weight_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::ciou_fixed_weight_obb2 as "[`ciou_fixed_weight_obb2`](crate::iou::ciou_fixed_weight_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range CIOU,
    jumps Anywhere, slopes Forward {
        CiouFixedWeightObb2 = "ciou_fixed_weight_obb2": Obb2, Obb2, "two rotated boxes" [Rotation Stays];
    }
    iou::eiou_aabb2 as "[`eiou_aabb2`](crate::iou::eiou_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range EIOU_BOX,
    jumps Anywhere, slopes Forward {
        EiouAabb2 = "eiou_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::eiou_hull_aabb2 as "[`eiou_hull_aabb2`](crate::iou::eiou_hull_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range EIOU_HULL,
    jumps Anywhere, slopes Forward {
        EiouHullAabb2 = "eiou_hull_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
    iou::eiou_obb2 as "[`eiou_obb2`](crate::iou::eiou_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range EIOU_HULL,
    jumps Anywhere, slopes Forward {
        EiouObb2 = "eiou_obb2": Obb2, Obb2, "two rotated boxes" [Rotation Stays];
    }
    iou::eiou_aabb_obb2 as "[`eiou_aabb_obb2`](crate::iou::eiou_aabb_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays],
    range EIOU,
    jumps Anywhere, slopes Forward {
        EiouAabbObb2 = "eiou_aabb_obb2": Obb2, Obb2, "two rotated boxes" [Exchange Stays];
    }
    iou::hull_area_obb2 as "[`hull_area_obb2`](crate::iou::hull_area_obb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(2)],
    range NOT_NEGATIVE,
    jumps Never, slopes Reverse {
        HullAreaObb2 = "hull_area_obb2": Obb2, Obb2, "two rotated boxes" [Rotation Stays, Exchange Stays];
    }
    iou::hull_area_aabb2 as "[`hull_area_aabb2`](crate::iou::hull_area_aabb2)" -> S,
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(2)],
    range NOT_NEGATIVE,
    jumps Never, slopes Reverse {
        HullAreaAabb2 = "hull_area_aabb2": Aabb2, Aabb2, "two axis-aligned boxes" [Exchange Stays];
    }
}

operation! {
    /// A [power](crate::iou::alpha_iou_obb2) of the IoU of two rotated boxes.
    pub AlphaIouObb2 = "alpha_iou_obb2": (a: Obb2<S>, b: Obb2<S>, power: Exponent<S>) -> S {
        iou::alpha_iou_obb2(a, b, power.alpha)
    }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Stays]
    range RATIO
    jumps FromZero
    slopes Forward

    /// A [power](crate::iou::alpha_iou_aabb2) of the IoU of two axis-aligned boxes.
    pub AlphaIouAabb2 = "alpha_iou_aabb2": (a: Aabb2<S>, b: Aabb2<S>, power: Exponent<S>) -> S {
        iou::alpha_iou_aabb2(a, b, power.alpha)
    }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays]
    range RATIO
    jumps FromZero
    slopes Forward
}

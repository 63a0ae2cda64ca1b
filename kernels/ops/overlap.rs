//! The overlap scores as operations.
use crate::ad::adjoint::overlap::{score_aabb2_vjp, score_framed_vjp};
use crate::ad::adjoint::overlap_quad::intersection_area_quads_vjp;
use crate::clip::frame;
use crate::kernels::row::compiled::Compiled;
use crate::kernels::ops::noun::Quad;
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{IntersectionArea, Iof, Iou};
use crate::overlap::{Denominator, score_aabb2, score_framed};
use crate::overlap_polygon::{check_quad, intersection_area_quads};
use crate::{Aabb2, Obb2};

table! {
    /// [Area](crate::overlap::intersection_area_obb2) that {} share.
    IntersectionArea: (a, b) -> S { score_framed::<S, true>(Denominator::None, frame(a), frame(b)) }
    [rigid(2), symmetric] (finite Always range NOT_NEGATIVE extremes Shared jumps Never) derivative ByHand {
        "intersection_area_obb2": Obb2, Obb2
            derivative ByHand |(a, b), out_bar| { score_framed_vjp::<S, true>(Denominator::None, frame(a), frame(b), out_bar) }
            => compiled { Compiled::Obb2(Denominator::None) };
        "intersection_area_aabb2": Aabb2, Aabb2 { score_aabb2(Denominator::None, a, b) }
            derivative ByHand |(a, b), out_bar| { score_aabb2_vjp(Denominator::None, a, b, out_bar) }
            => compiled { Compiled::Aabb2(Denominator::None) };
        /// Of either order, and convex.
        "intersection_area_quads": Quad, Quad { intersection_area_quads(a, b) }
            (domain { check_quad(a).is_ok() && check_quad(b).is_ok() })
            derivative ByHand |(a, b), out_bar| { intersection_area_quads_vjp(a, b, out_bar) }
            => compiled { Compiled::Quads };
    }
    /// [Intersection over union](crate::overlap::iou_obb2) of {}, 0 to 1.
    Iou: (a, b) -> S { score_framed::<S, true>(Denominator::Union, frame(a), frame(b)) }
    [similar, symmetric] (finite Always range RATIO extremes Union jumps FromZero) derivative ByHand {
        "iou_obb2": Obb2, Obb2
            derivative ByHand |(a, b), out_bar| { score_framed_vjp::<S, true>(Denominator::Union, frame(a), frame(b), out_bar) }
            => compiled { Compiled::Obb2(Denominator::Union) };
        "iou_aabb2": Aabb2, Aabb2 { score_aabb2(Denominator::Union, a, b) }
            derivative ByHand |(a, b), out_bar| { score_aabb2_vjp(Denominator::Union, a, b, out_bar) }
            => compiled { Compiled::Aabb2(Denominator::Union) };
    }
    /// The [part of the first](crate::overlap::iof_obb2) of {} that lies in the second, 0 to 1.
    Iof: (a, b) -> S { score_framed::<S, true>(Denominator::First, frame(a), frame(b)) }
    [similar] (finite Always range RATIO extremes Ratio jumps FromZero) derivative ByHand {
        "iof_obb2": Obb2, Obb2
            derivative ByHand |(a, b), out_bar| { score_framed_vjp::<S, true>(Denominator::First, frame(a), frame(b), out_bar) }
            => compiled { Compiled::Obb2(Denominator::First) };
        "iof_aabb2": Aabb2, Aabb2 { score_aabb2(Denominator::First, a, b) }
            derivative ByHand |(a, b), out_bar| { score_aabb2_vjp(Denominator::First, a, b, out_bar) }
            => compiled { Compiled::Aabb2(Denominator::First) };
    }
}

//! The family of intersection over union: scores of two shapes that also say something about shapes
//! that are apart.
//!
//! With `I` the area of intersection, `U` that of the union, `C` that of the convex hull of both, `d` the
//! distance of the centres:
//!
//! | name | score | range | source |
//! | --- | --- | --- | --- |
//! | `iou`, `iof` | `I/U`, `I/A` | `[0, 1]` | [`overlap`](crate::overlap), [`overlap_polygon`](crate::overlap_polygon) |
//! | `giou` | `I/U − (C − U)/C`, hull exact | `(−1, 1]` | Rezatofighi et al., CVPR 2019 |
//! | `giou_box` | the same, `C` the smallest axis-aligned box around both | `(−1, 1]` | same, for boxes |
//! | `diou` | `I/U − (d/D)²`, `D` the hull's diameter | `(−1, 1]` | the DGAL paper's; after Zheng et al. |
//! | `diou_box` | the same, `D` the diagonal of the smallest axis-aligned box around both | `(−1, 1]` | Zheng et al., AAAI 2020 |
//! | `ciou` | `diou_box − αv`, `v = 4/π² (Δ atan w/h)²`, `α = v/(1 − I/U + v)` | `(−2, 1]` | Zheng et al., IEEE Trans. Cybernetics 2021 |
//! | `ciou_fixed_weight` | the same, without the slope of `α` | | as published and commonly trained |
//! | `eiou` | `diou_box − (Δw/W)² − (Δh/H)²`, `W`, `H` of that box | `(−3, 1]` | Zhang et al., Focal and efficient IoU loss, 2021 |
//! | `alpha_iou` | `(I/U)^α` | `[0, 1]` | He et al., NeurIPS 2021 |
//!
//! Losses are one minus the score. Shapes that are apart have slopes in all but IoU, IoF and `alpha_iou`:
//! they are drawn together. Identical shapes of positive area have exactly 1 with slope zero. Where a
//! denominator is zero (two shapes of no area on a line; coincident points) its term is zero with slope
//! zero.
//!
//! Kinks: those of the area of intersection; `giou`: a corner passes through the border of the hull;
//! `diou`: two pairs of corners are farthest apart; `…_box`: bounds of both are equal. Exact ties share
//! the slope.
mod center;
mod giou;
mod hull;
mod polygon;
mod separation;

pub use center::{
    Exponent, alpha_iou_aabb2, alpha_iou_obb2, ciou_aabb2, ciou_fixed_weight_aabb2,
    ciou_fixed_weight_obb2, ciou_obb2, diou_aabb2, diou_box_aabb2, diou_box_obb2, diou_obb2,
    eiou_aabb2, eiou_obb2, giou_box_obb2,
};
pub(crate) use giou::score;
pub use giou::{giou_aabb2, giou_box_aabb2, giou_framed, giou_obb2};
pub(crate) use hull::hull_scale;
pub use hull::{HullOfBoxes, hull_area_aabb2, hull_area_obb2, hull_of_related};
pub use polygon::{
    FarthestCorners, diou_polygons_decided, diou_polygons_replay, giou_polygons_decided,
    giou_polygons_replay,
};
pub use separation::separation_aware_obb2;

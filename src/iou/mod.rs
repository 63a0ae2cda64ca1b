//! The family of intersection over union: scores of two shapes that also distinguish shapes that are apart.
//!
//! With `I` the area of intersection, `U` that of the union, `C` that of the enclosing shape, `d` the
//! distance of the centres (polygons: of the centroids of their areas), `D` the diameter of the enclosing
//! shape, `W`, `H` its sides and `Δw`, `Δh` the differences of the boxes' own sizes:
//!
//! | verb | score | source |
//! | --- | --- | --- |
//! | `iou`, `iof` | `I/U`, `I/A` | [`overlap`](crate::overlap), [`overlap_polygon`](crate::overlap_polygon) |
//! | `giou` | `I/U − (C − U)/C` | Rezatofighi et al., CVPR 2019 |
//! | `diou` | `I/U − (d/D)²` | Zheng et al., AAAI 2020 |
//! | `ciou` | `diou − αv`, `v = 4/π² (Δ atan w/h)²`, `α = v/(1 − I/U + v)` | Zheng et al., Distance-IoU loss, AAAI 2020 |
//! | `ciou_fixed_weight` | the same, without the derivative of `α` | as published and commonly trained |
//! | `eiou` | `diou − (Δw/W)² − (Δh/H)²`; by a hull `diou − (Δw² + Δh²)/D²` | Zhang et al., Focal and efficient IoU loss, 2021 |
//! | `alpha_iou` | `(I/U)^α` | He et al., NeurIPS 2021 |
//!
//! The enclosing shape of a plain verb is the published one for axis-aligned boxes, the smallest axis-aligned box
//! around both; there the results are torchvision's except for the 10⁻⁷ that it adds. For shapes that turn it is the
//! convex hull, so that scores are invariant under rotations. Suffixes name every other enclosing shape. `ciou` and
//! `eiou` build on the `diou` of the same row.
//!
//! | shapes | enclosing shape | `giou` | `diou` | `ciou` | `eiou` |
//! | --- | --- | --- | --- | --- | --- |
//! | range | | `[−1, 1]` | `[−1, 1]` | `[−3/2, 1]` | `[−9/4, 1]` by the box around `Aabb2`, `[−3, 1]` around `Obb2`; `[−5/2, 1]` by a hull |
//! | `Aabb2` | box around both | [`giou_aabb2`] | [`diou_aabb2`] | [`ciou_aabb2`] | [`eiou_aabb2`] |
//! | `Aabb2` | convex hull | [`giou_hull_aabb2`] | [`diou_hull_aabb2`] | [`ciou_hull_aabb2`] | [`eiou_hull_aabb2`] |
//! | `Obb2` | convex hull | [`giou_obb2`] | [`diou_obb2`] | [`ciou_obb2`] | [`eiou_obb2`] |
//! | `Obb2` | box around both along the plane's axes | [`giou_aabb_obb2`] | [`diou_aabb_obb2`] | [`ciou_aabb_obb2`] | [`eiou_aabb_obb2`] |
//! | convex polygons | convex hull | [`giou_polygons_search`] | [`diou_polygons_search`] | | |
//!
//! Zheng et al., *Enhancing geometric factors*, IEEE Trans. Cybernetics 2021, has `α = 0` where the IoU is below ½: there
//! its `ciou` is `diou`.
//!
//! `ciou_fixed_weight` has the row of each shape's plain verb. Boxes of space: [`iou3`](crate::iou3).
//!
//! Losses are one minus the score. Shapes that are apart have derivatives in all but IoU, IoF and `alpha_iou`: they are
//! drawn together. Identical shapes of positive area have exactly 1 with derivative zero (except for `giou_aabb_obb2`
//! of turned boxes). GIoU is −1 only where rounding makes it so, DIoU also for two points. A term with a denominator of
//! zero (two shapes of no area on a line; coincident points) is zero with derivative zero.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`; those of [`giou_obb2`] and its adjoint for all finite valid input, for
//! upstream derivatives of any size.
//!
//! Kinks: those of the area of intersection; by a hull, `giou`: a corner passes through the border of the
//! hull; the others: two pairs of corners are farthest apart; by a box around both: bounds of both are
//! equal. Exact ties share the derivative; where several kinks meet, each shares by itself, and the sum may lie outside
//! the slopes of both sides.
mod aabb;
mod alpha;
mod giou;
mod hull;
mod obb;
mod polygon;
mod separation;
mod terms;

pub use aabb::{
    ciou_aabb2, ciou_fixed_weight_aabb2, ciou_hull_aabb2, diou_aabb2, diou_hull_aabb2, eiou_aabb2,
    eiou_hull_aabb2, giou_aabb2, giou_hull_aabb2,
};
pub use alpha::{Exponent, alpha_iou_aabb2, alpha_iou_obb2};
pub use giou::giou_obb2;
pub(crate) use giou::{giou_framed, score};
pub(crate) use hull::{HullOfBoxes, hull_of_related, hull_scale};
pub use hull::{hull_area_aabb2, hull_area_obb2};
pub(crate) use obb::{BoxesAround, across, bounds, unit_of_pair};
pub use obb::{
    ciou_aabb_obb2, ciou_fixed_weight_obb2, ciou_obb2, diou_aabb_obb2, diou_obb2, eiou_aabb_obb2,
    eiou_obb2, giou_aabb_obb2,
};
pub use polygon::{
    FarthestCorners, diou_polygons_replay, diou_polygons_search, giou_polygons_replay,
    giou_polygons_search,
};
pub use separation::separation_aware_obb2;
pub(crate) use terms::{larger, part, share, unit, weighted};

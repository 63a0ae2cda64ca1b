//! A guide from other detection libraries to geograd: their calls, and how to reproduce their numbers.
//!
//! The tables list functions of other libraries and their equivalents; [the same numbers](#the-same-numbers) follow.
//! Verbs are values that [`Cpu::aligned`] (pair by pair), [`Cpu::all_pairs`] (every shape with every other) and its
//! reductions take; with `value_grad` they return gradients, too. Values are right to rounding for pairs that are
//! identical, nearly parallel, contained, thin or far from the origin, and no derivative is NaN. Encodings of other
//! libraries are types: [`convention`](crate::convention).
//!
//! # Rotated_IoU
//!
//! | theirs | ours |
//! | --- | --- |
//! | `cal_iou` | [`Iou`](crate::kernels::Iou) of `Obb2`, [`iou_obb2`](crate::overlap::iou_obb2) |
//! | `cal_giou`, `enclosing_type` aligned, smallest | [`GiouAabb`](crate::kernels::GiouAabb) of `Obb2`; [`Giou`](crate::kernels::Giou) of `Obb2` has the convex hull |
//! | `cal_diou` | [`DiouAabb`](crate::kernels::DiouAabb) of `Obb2`, [`Diou`](crate::kernels::Diou) of `Obb2` |
//! | `cal_iou_3d` | [`Iou`](crate::kernels::Iou) of `YawBox3`; [`Iou`](crate::kernels::Iou) of `Obb3` for boxes that turn about all axes |
//! | `cal_giou_3d`, `cal_diou_3d` | [`giou`](crate::iou3::giou), [`diou`](crate::iou3::diou) with an [`Enclosing`](crate::iou3::Enclosing) |
//! | enclosing box `pca` | none: [`Enclosing::Rectangle`](crate::iou3::Enclosing::Rectangle) is the smallest one |
//! | `box2corners_th` | [`Obb2::corners`](crate::Obb2::corners) |
//! | `oriented_box_intersection_2d` | [`IntersectionArea`](crate::kernels::IntersectionArea) of `Obb2`; the polygon itself: [`clipping`](crate::clipping) |
//!
//! # OpenPCDet
//!
//! Its boxes are [`LidarBox`](crate::convention::LidarBox), with the numbers of a [`YawBox3`](crate::shape::YawBox3).
//!
//! | theirs | ours |
//! | --- | --- |
//! | `boxes_iou_bev`, `boxes_bev_iou_cpu` | [`Cpu::all_pairs`] of [`IouBev`](crate::kernels::IouBev) of `YawBox3` |
//! | `boxes_aligned_iou_bev_cpu` | [`Cpu::aligned`] of [`IouBev`](crate::kernels::IouBev) of `YawBox3` |
//! | `boxes_overlap_bev_gpu`, `boxes_aligned_overlap_bev_gpu`, `paired_boxes_overlap_bev_gpu` | [`IntersectionArea`](crate::kernels::IntersectionArea) of `Obb2` of [`birds_eye`](crate::shape::YawBox3::birds_eye) |
//! | `boxes_iou3d_gpu` | [`Cpu::all_pairs`] of [`Iou`](crate::kernels::Iou) of `YawBox3` |
//! | `boxes_aligned_iou3d_gpu`, `paired_boxes_iou3d_gpu` | [`Cpu::aligned`] of [`Iou`](crate::kernels::Iou) of `YawBox3` |
//! | `nms_gpu` | [`Machine::suppress`](crate::kernels::Machine::suppress) of [`IouBev`](crate::kernels::IouBev) of `YawBox3`, the same places on CPU and GPU |
//! | `nms_normal_gpu` | the same with [`Iou`](crate::kernels::Iou) of `Aabb2` |
//! | `points_in_boxes_cpu`, `points_in_boxes_gpu` | [`Cpu::first_box`], [`Cpu::boxes_of_points`], [`Cpu::points_per_box`]; no margin of a centimetre |
//! | `boxes_to_corners_3d` | [`YawBox3::corners`](crate::shape::YawBox3::corners) |
//! | `boxes_iou_normal`, `boxes3d_nearest_bev_iou` | [`Iou`](crate::kernels::Iou) of `Aabb2` of [`Obb2::bounding`](crate::Obb2::bounding) |
//! | `bbox3d_overlaps_diou`, `IouRegLossSparse` | [`Diou`](crate::kernels::Diou) of `YawBox3`, which does see the heading |
//! | corner loss | the corners, and [`operation!`](crate::operation) for the sum you want |
//!
//! # d3d
//!
//! | theirs | ours |
//! | --- | --- |
//! | `box2d_iou`, methods `box`, `rbox` | [`Iou`](crate::kernels::Iou) of `Aabb2`, [`Iou`](crate::kernels::Iou) of `Obb2` |
//! | `box2d_iou`, methods `grbox`, `drbox` | [`Giou`](crate::kernels::Giou) of `Obb2`, [`Diou`](crate::kernels::Diou) of `Obb2` |
//! | `box2d_nms`, hard | [`suppression::hard`](crate::suppression::hard()) |
//! | `box2d_nms`, linear, gaussian | [`suppression::soft`](crate::suppression::soft()) with a [`Decay`](crate::suppression::Decay), and its derivatives |
//! | `box2dr_pdist` | [`SignedDistance`](crate::kernels::SignedDistance) of `Vec2` and `Obb2`, of the other sign |
//! | `box3dr_pdist` | [`distance3::signed_distance`](crate::distance3::signed_distance), of the other sign |
//! | `seg1d_pdist`, `seg1d_iou` | [`Distance`](crate::kernels::Distance) of `S` and `Interval`, [`Iou`](crate::kernels::Iou) of `Interval` |
//! | `box2dr_crop`, `box3dp_crop` | [`Cpu::boxes_of_points`] |
//! | matchers: score, nearest; Hungarian | [`assignment::greedy`](crate::assignment::greedy), [`assignment::optimal`](crate::assignment::optimal) |
//! | evaluators | [`metric`](crate::metric) |
//!
//! # mmcv
//!
//! | theirs | ours |
//! | --- | --- |
//! | `bbox_overlaps`, modes `iou`, `iof`, `giou` | [`Iou`](crate::kernels::Iou) of `Aabb2`, [`Iof`](crate::kernels::Iof) of `Aabb2`, [`Giou`](crate::kernels::Giou) of `Aabb2` |
//! | `box_iou_rotated`, modes `iou`, `iof` | [`Iou`](crate::kernels::Iou) of `Obb2`, [`Iof`](crate::kernels::Iof) of `Obb2` |
//! | `box_iou_quadri`, `convex_iou` | [`overlap_polygon`](crate::overlap_polygon) |
//! | `convex_giou` | [`giou_polygons_search`](crate::iou::giou_polygons_search) and its replay |
//! | `diff_iou_rotated_2d`, `diff_iou_rotated_3d` | [`Iou`](crate::kernels::Iou) of `Obb2`, [`Iou`](crate::kernels::Iou) of `YawBox3`, with derivatives |
//! | `boxes_overlap_bev`, `boxes_iou3d` | [`IntersectionArea`](crate::kernels::IntersectionArea) of `Obb2`, [`Iou`](crate::kernels::Iou) of `YawBox3` |
//! | `nms`, `batched_nms`, `nms_rotated`, `nms_quadri`, `nms3d`, `nms3d_normal` | [`Cpu::overlaps`] of the overlap that is meant, then [`suppression::hard`](crate::suppression::hard()) with classes |
//! | `soft_nms` | [`suppression::soft`](crate::suppression::soft()) |
//! | `points_in_boxes_part`, `points_in_boxes_all`, `points_in_boxes_cpu` | [`Cpu::first_box`], [`Cpu::boxes_of_points`] |
//! | `points_in_polygons` | [`contain`](crate::contain) |
//! | `min_area_polygons` | [`rectangle_search`](crate::measure::rectangle::rectangle_search) |
//!
//! # The same numbers
//!
//! Loss functions of other libraries are formulas of ours, with small numbers added that keep them from dividing by
//! zero. Below `p` is the predicted box, `t` the target, `A` an area, `ε` theirs; `ln1p(d)` is `ln(1 + d)`. If only ε
//! distinguishes them, results agree to ε over an area or a squared length of the boxes, in pixels.
//!
//! ## mmrotate
//!
//! Boxes are Gaussians of half their sizes as deviations, as in [`gaussian`](crate::gaussian). With `τ ≥ 1` the loss
//! of a distance d is [`saturating_loss`](crate::gaussian::saturating_loss) of d and τ (for `fun='log1p'`), else
//! `ln1p(d)`; the class `GDLoss` has τ = 0, the functions below it τ = 1.
//!
//! | theirs | the distance d by ours |
//! | --- | --- |
//! | `gwd_loss` | [`wasserstein`](crate::gaussian::wasserstein)`(p, t) / (A(p) A(t))^¼`, which is over `2 (det Σp det Σt)^⅛`; with `normalize=False` the distance itself |
//! | `kld_loss` | the root of [`kullback_leibler`](crate::gaussian::kullback_leibler)`(t, p)`: of the target from the prediction; with `sqrt=False` the divergence itself |
//! | `jd_loss` | the root of [`kullback_leibler_mean`](crate::gaussian::kullback_leibler_mean)`(p, t)` |
//! | `kld_symmax_loss`, `kld_symmin_loss` | the larger, the smaller root of both divergences |
//!
//! | `GDLoss_v1`: by default `1 − 1 / (τ + √d)` with τ = 1 | the d by ours, at least 10⁻⁶ |
//! | --- | --- |
//! | `gwd` | [`wasserstein_squared`](crate::gaussian::wasserstein_squared)`(p, t)` |
//! | `kld` | twice [`kullback_leibler`](crate::gaussian::kullback_leibler)`(p, t)`: of the prediction from the target |
//! | `bcd` | [`bhattacharyya`](crate::gaussian::bhattacharyya)`(p, t)` |
//!
//! `KFLoss` is `1 − k` with k the [`kfiou`](crate::gaussian::kfiou), so at least ⅔; `fun='ln'` is `−ln(k + ε)`,
//! `fun='exp'` `e^(1−k) − 1`. Each adds a smooth L1 loss of encoded centres. `RotatedIoULoss` is one minus
//! [`Iou`](crate::kernels::Iou) of `Obb2`, or its logarithm. `ConvexGIoULoss` and `BCConvexGIoULoss` are
//! [`giou_polygons_search`](crate::iou::giou_polygons_search), `SpatialBorderLoss` is
//! [`contain::depth_search`](crate::contain::depth_search). `KLDRepPointsLoss` has no counterpart: Gaussians are
//! computed from boxes here, not from points. All of them in space: [`gaussian::solid`](crate::gaussian::solid).
//!
//! ## ultralytics
//!
//! | theirs | ours |
//! | --- | --- |
//! | `probiou` | `1 − √((1 − q)² + ε)` with q of [`probiou`](crate::gaussian::probiou) and ε = 10⁻⁷; of equal boxes `1 − √(2ε)` = 0.99955, where ours is 1 |
//! | `bbox_iou` | [`Iou`](crate::kernels::Iou) of `Aabb2`; ε is added to heights, to the union and to what is divided by |
//! | `bbox_iou` with `GIoU`, `DIoU`, `CIoU` | [`giou_aabb2`](crate::iou::giou_aabb2), [`diou_aabb2`](crate::iou::diou_aabb2), [`ciou_aabb2`](crate::iou::ciou_aabb2) |
//! | the derivatives of `CIoU` | [`ciou_fixed_weight_aabb2`](crate::iou::ciou_fixed_weight_aabb2): α is a constant |
//!
//! ## torchvision and detectron2
//!
//! | theirs | ours |
//! | --- | --- |
//! | `box_iou`, `pairwise_iou`; `generalized_box_iou` | [`Iou`](crate::kernels::Iou) of `Aabb2`; [`giou_aabb2`](crate::iou::giou_aabb2), without any ε |
//! | `generalized_box_iou_loss`, `giou_loss` (of fvcore) | `1 −` [`giou_aabb2`](crate::iou::giou_aabb2), ε = 10⁻⁷ |
//! | `distance_box_iou_loss`, `diou_loss` | `1 −` [`diou_aabb2`](crate::iou::diou_aabb2), ε = 10⁻⁷ |
//! | `complete_box_iou_loss`, `ciou_loss` | `1 −` [`ciou_fixed_weight_aabb2`](crate::iou::ciou_fixed_weight_aabb2), ε = 10⁻⁷ |
//! | `pairwise_iou_rotated` | [`Iou`](crate::kernels::Iou) of `Obb2`; boxes by [`Detectron2Box`](crate::convention::Detectron2Box) |
//! | `nms`, `batched_nms`, `nms_rotated` | [`suppression::hard`](crate::suppression::hard()) of overlaps above the threshold; `nms_rotated` on a CPU suppresses at the threshold, too |
//!
//! ## mmcv and mmdetection
//!
//! | theirs | ours |
//! | --- | --- |
//! | `soft_nms`, linear and gaussian | [`suppression::soft`](crate::suppression::soft()); theirs begins *at* the threshold: ours above the next smaller number |
//! | `nms` | [`suppression::hard`](crate::suppression::hard()): both begin above the threshold |
//! | `GIoULoss`, `DIoULoss` | `1 −` [`giou_aabb2`](crate::iou::giou_aabb2), `1 −` [`diou_aabb2`](crate::iou::diou_aabb2), ε = 10⁻⁶ |
//! | `CIoULoss` | one minus [`ciou_fixed_weight_aabb2`](crate::iou::ciou_fixed_weight_aabb2) where the IoU is above ½, else one minus [`diou_aabb2`](crate::iou::diou_aabb2), within `[0, 2]` |
//!
//! # Functions that none of them has
//!
//! Overlap of boxes under full rotation with derivatives ([`Iou`](crate::kernels::Iou) of `Obb3`), of two kinds of
//! boxes ([`Obb3::iou`](crate::Obb3::iou)), and an overlap that continues beyond contact
//! ([`separation_aware`](crate::iou3::separation_aware)).
//!
//! [`Op::value_grad`]: crate::kernels::Op::value_grad
#[expect(unused_imports, reason = "names in the documentation")]
use crate::kernels::{Backend, Cpu};

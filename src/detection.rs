//! Where detection engineers find what they know from elsewhere: a guide without items.
//!
//! Functions of five libraries, and what does the same here. Operations are values that [`Cpu::aligned`] (pair
//! by pair), [`Cpu::all_pairs`] (every row with every column) and the reductions beside them take; with
//! [`Op::value_grad`] they give slopes, too. Values are right to rounding for pairs that are identical, nearly
//! parallel, nested, thin or far from the origin, and no slope is NaN. Other people's encodings are types:
//! [`convention`](crate::convention).
//!
//! # Rotated_IoU
//!
//! | theirs | ours |
//! | --- | --- |
//! | `cal_iou` | [`IouObb2`], [`iou_obb2`](crate::overlap::iou_obb2) |
//! | `cal_giou`, `enclosing_type` aligned, smallest | [`GiouAabbObb2`]; [`GiouObb2`] has the convex hull |
//! | `cal_diou` | [`DiouAabbObb2`], [`DiouObb2`] |
//! | `cal_iou_3d` | [`IouYaw`]; [`IouObb3`] for boxes that turn about all axes |
//! | `cal_giou_3d`, `cal_diou_3d` | [`giou`](crate::iou3::giou), [`diou`](crate::iou3::diou) with an [`Enclosing`](crate::iou3::Enclosing) |
//! | enclosing box `pca` | none: [`Enclosing::Rectangle`](crate::iou3::Enclosing::Rectangle) is the smallest one |
//! | `box2corners_th` | [`Obb2::corners`](crate::Obb2::corners) |
//! | `oriented_box_intersection_2d` | [`IntersectionAreaObb2`]; the polygon itself: [`clipping`](crate::clipping) |
//!
//! # OpenPCDet
//!
//! Its boxes are [`LidarBox`](crate::convention::LidarBox), the same numbers as a
//! [`YawBox3`](crate::shape::YawBox3).
//!
//! | theirs | ours |
//! | --- | --- |
//! | `boxes_iou_bev`, `boxes_bev_iou_cpu` | [`Cpu::all_pairs`] of [`IouBirdsEye`] |
//! | `boxes_aligned_iou_bev_cpu` | [`Cpu::aligned`] of [`IouBirdsEye`] |
//! | `boxes_overlap_bev_gpu`, `boxes_aligned_overlap_bev_gpu`, `paired_boxes_overlap_bev_gpu` | [`IntersectionAreaObb2`] of [`birds_eye`](crate::shape::YawBox3::birds_eye) |
//! | `boxes_iou3d_gpu` | [`Cpu::all_pairs`] of [`IouYaw`] |
//! | `boxes_aligned_iou3d_gpu`, `paired_boxes_iou3d_gpu` | [`Cpu::aligned`] of [`IouYaw`] |
//! | `nms_gpu` | [`Backend::suppress`] of [`IouBirdsEye`], the same places on CPU and GPU |
//! | `nms_normal_gpu` | the same with [`IouAabb2`] |
//! | `points_in_boxes_cpu`, `points_in_boxes_gpu` | [`Cpu::first_box`], [`Cpu::boxes_of_points`], [`Cpu::points_per_box`]; no margin of a centimetre |
//! | `boxes_to_corners_3d` | [`YawBox3::corners`](crate::shape::YawBox3::corners) |
//! | `boxes_iou_normal`, `boxes3d_nearest_bev_iou` | [`IouAabb2`] of [`Obb2::bounding`](crate::Obb2::bounding) |
//! | `bbox3d_overlaps_diou`, `IouRegLossSparse` | [`DiouYaw`], which does see the heading |
//! | corner loss | the corners, and [`operation!`](crate::operation) for the sum you want |
//!
//! # d3d
//!
//! | theirs | ours |
//! | --- | --- |
//! | `box2d_iou`, methods `box`, `rbox` | [`IouAabb2`], [`IouObb2`] |
//! | `box2d_iou`, methods `grbox`, `drbox` | [`GiouObb2`], [`DiouObb2`] |
//! | `box2d_nms`, hard | [`suppression::hard`](crate::suppression::hard()) |
//! | `box2d_nms`, linear, gaussian | [`suppression::soft`](crate::suppression::soft()) with a [`Decay`](crate::suppression::Decay), and its slopes |
//! | `box2dr_pdist` | [`SignedDistancePointObb2`], of the other sign |
//! | `box3dr_pdist` | [`distance3::signed_distance`](crate::distance3::signed_distance), of the other sign |
//! | `seg1d_pdist`, `seg1d_iou` | [`DistanceNumberInterval`], [`IouIntervals`] |
//! | `box2dr_crop`, `box3dp_crop` | [`Cpu::boxes_of_points`] |
//! | matchers: score, nearest; Hungarian | [`assignment::greedy`](crate::assignment::greedy), [`assignment::optimal`](crate::assignment::optimal) |
//! | evaluators | [`metric`](crate::metric) |
//!
//! # mmcv
//!
//! | theirs | ours |
//! | --- | --- |
//! | `bbox_overlaps`, modes `iou`, `iof`, `giou` | [`IouAabb2`], [`IofAabb2`], [`GiouAabb2`] |
//! | `box_iou_rotated`, modes `iou`, `iof` | [`IouObb2`], [`IofObb2`] |
//! | `box_iou_quadri`, `convex_iou` | [`overlap_polygon`](crate::overlap_polygon) |
//! | `convex_giou` | [`giou_polygons_decided`](crate::iou::giou_polygons_decided) and its replay |
//! | `diff_iou_rotated_2d`, `diff_iou_rotated_3d` | [`IouObb2`], [`IouYaw`], with slopes |
//! | `boxes_overlap_bev`, `boxes_iou3d` | [`IntersectionAreaObb2`], [`IouYaw`] |
//! | `nms`, `batched_nms`, `nms_rotated`, `nms_quadri`, `nms3d`, `nms3d_normal` | [`Cpu::overlaps`] of the overlap that is meant, then [`suppression::hard`](crate::suppression::hard()) with classes |
//! | `soft_nms` | [`suppression::soft`](crate::suppression::soft()) |
//! | `points_in_boxes_part`, `points_in_boxes_all`, `points_in_boxes_cpu` | [`Cpu::first_box`], [`Cpu::boxes_of_points`] |
//! | `points_in_polygons` | [`contain`](crate::contain) |
//! | `min_area_polygons` | [`rectangle_decided`](crate::measure::rectangle::rectangle_decided) |
//!
//! # mmrotate's losses
//!
//! Each is one minus a similarity, or a function of a distance such as
//! [`saturating_loss`](crate::gaussian::saturating_loss).
//!
//! | theirs | ours |
//! | --- | --- |
//! | `RotatedIoULoss` | [`IouObb2`] |
//! | `GDLoss`, `gwd` | [`WassersteinObb2`] |
//! | `GDLoss`, `kld` | [`kullback_leibler`](crate::gaussian::kullback_leibler) |
//! | `GDLoss`, `jd` | [`jeffreys`](crate::gaussian::jeffreys), halved: [`kullback_leibler_mean`](crate::gaussian::kullback_leibler_mean) |
//! | `GDLoss`, `kld_symmax`, `kld_symmin` | the larger or smaller one of both directions |
//! | `GDLoss_v1`, `bcd` | [`bhattacharyya`](crate::gaussian::bhattacharyya) |
//! | `KFLoss` | [`kfiou`](crate::gaussian::kfiou) and a term for the centres |
//! | ProbIoU (of ultralytics) | [`probiou`](crate::gaussian::probiou) |
//! | `ConvexGIoULoss`, `BCConvexGIoULoss` | [`giou_polygons_decided`](crate::iou::giou_polygons_decided) |
//! | `KLDRepPointsLoss` | none: Gaussians are made of boxes here, not of points |
//! | `SpatialBorderLoss` | [`contain::clearance_decided`](crate::contain::clearance_decided) |
//! | all of them in space | [`gaussian::solid`](crate::gaussian::solid) |
//!
//! # What none of them has
//!
//! Overlap of boxes under full rotation with slopes ([`IouObb3`]), of two kinds of boxes
//! ([`Overlaps`](crate::overlap3::Overlaps)), and an overlap that goes on beyond contact
//! ([`separation_aware`](crate::iou3::separation_aware)).
//!
//! [`Op::value_grad`]: crate::kernels::Op::value_grad
#[expect(unused_imports, reason = "names in the documentation")]
use crate::kernels::{
    Backend, Cpu, DiouAabbObb2, DiouObb2, DiouYaw, DistanceNumberInterval, GiouAabb2, GiouAabbObb2,
    GiouObb2, IntersectionAreaObb2, IofAabb2, IofObb2, IouAabb2, IouBirdsEye, IouIntervals,
    IouObb2, IouObb3, IouYaw, SignedDistancePointObb2, WassersteinObb2,
};

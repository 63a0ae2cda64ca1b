//! Batches: the list of operations, and the machines that run them over many shapes.
//!
//! | batch | what it takes | what it gives |
//! | --- | --- | --- |
//! | [`Cpu::aligned`] | item i of every column; [`One`] stands for all items | one result per item |
//! | [`Cpu::all_pairs`] | every row of a with every column of b | a [`Table`] |
//! | [`Cpu::row_max`], [`Cpu::column_max`] | the same | the best match of every row or column |
//! | [`Cpu::above`], [`Cpu::count_above`] | the same | the pairs above a threshold |
//! | [`Cpu::sum`], [`Cpu::mean`], [`Cpu::sum_grad`] | the same | a loss, and its gradient |
//! | [`Cpu::ragged`], [`Cpu::fold`] | paths as vertices and offsets | one result per path |
//!
//! What runs is a value: an [operation](op), such as [`IouObb2`]; an operation with its gradient
//! ([`value_grad`](Op::value_grad)); its adjoint ([`vjp`](Op::vjp)); an operation of the list with a search
//! ([`Decided`]); a [`Program`](crate::Program). Columns are slices, vectors or [`One`]. Forms that end in `_into` write to
//! what the caller has. [`operation!`](crate::operation) makes a function an operation.
//!
//! # What goes in, and what comes out
//!
//! Shapes are checked before anything is computed: one that is not valid is an error that names it. Results are not
//! checked. They are the function's, and the library's functions of finite shapes are finite; a function of one's own that
//! has a pole gives infinity or NaN there, and so does its batch, for that item alone.
//!
//! Without pairs a sum is 0, a count 0 and a list empty. The mean is 0, too, with slopes of zero, as the loss of a step
//! that matched nothing. A largest of nothing there is not: rows without columns are [`Error::Length`](crate::Error::Length).
//!
//! # Elsewhere
//!
//! The same calls run on GPUs, but for all pairs of searches: [`gpu`]. [`Backend`] is one front for both machines, and
//! [`resident`] keeps columns and results where they are between its calls.
#[forbid(unsafe_code)]
pub mod backend;
#[forbid(unsafe_code)]
pub mod check;
pub mod cpu;
#[forbid(unsafe_code)]
pub mod decided;
#[forbid(unsafe_code)]
pub mod fold;
#[forbid(unsafe_code)]
pub mod fuzz;
#[forbid(unsafe_code)]
pub mod gpu;
#[forbid(unsafe_code)]
mod of;
#[forbid(unsafe_code)]
pub mod op;
#[forbid(unsafe_code)]
mod operation;
#[forbid(unsafe_code)]
pub mod ops;
#[forbid(unsafe_code)]
pub mod points;
#[forbid(unsafe_code)]
mod program;
#[forbid(unsafe_code)]
mod promised;
#[forbid(unsafe_code)]
pub mod real;
#[forbid(unsafe_code)]
mod recorded_subject;
#[forbid(unsafe_code)]
pub mod reduce;
#[cfg(feature = "gpu")]
#[doc(hidden)]
#[forbid(unsafe_code)]
pub mod replays;
#[forbid(unsafe_code)]
pub mod resident;
#[forbid(unsafe_code)]
pub mod row;
#[forbid(unsafe_code)]
mod subject;
#[forbid(unsafe_code)]
mod suppress;
#[forbid(unsafe_code)]
mod targets;
#[forbid(unsafe_code)]
pub mod verbs;
#[forbid(unsafe_code)]
pub mod witness;

pub use backend::Backend;
pub use cpu::{Cpu, Single, Table};
pub use decided::Decided;
pub use fold::Fold;
pub use op::{Op, RingOp, Runs};
pub use ops::convention::{
    CornersOfObb2, Detectron2OfImageBox, ImageBoxOfDetectron2, KittiOfYaw, Le90OfImageBox,
    Le135OfImageBox, Obb2OfImageBox, Obb2OfXyxyr, Obb3OfNuScenes, Obb3OfYaw, OpenCvOfImageBox,
    XyxyrOfObb2, YawOfKitti, YawOfLidar,
};
pub use ops::distance::{
    ClearancePointAabb2, ClearancePointObb2, ClosestPointsAabb2, ClosestPointsCapsules,
    ClosestPointsCircleObb2, ClosestPointsObb2, ClosestPointsOfSegments, ClosestPointsPointObb2,
    ClosestPointsPointSegment, ClosestPointsPointTriangle, ClosestPointsTriangles, DistanceAabb2,
    DistanceCapsules, DistanceCircleObb2, DistanceCircles, DistanceObb2, DistancePointAabb2,
    DistancePointCapsule, DistancePointCircle, DistancePointObb2, DistancePointSegment,
    DistancePointTriangle, DistanceSegmentCircle, DistanceSegmentObb2, DistanceSegments,
    DistanceSquaredAabb2, DistanceSquaredObb2, DistanceSquaredPointSegment,
    DistanceSquaredPointTriangle, DistanceSquaredSegments, DistanceSquaredTriangles,
    DistanceTriangles, FarthestDistanceAabb2, FarthestDistanceCircleObb2, FarthestDistanceObb2,
    FarthestDistancePointObb2, FarthestDistanceTriangles, PenetrationAabb2, PenetrationCapsules,
    PenetrationCircleObb2, PenetrationCircles, PenetrationObb2, PenetrationTriangles,
    SignedDistanceAabb2, SignedDistanceCapsules, SignedDistanceCircleObb2, SignedDistanceCircles,
    SignedDistanceObb2, SignedDistancePointAabb2, SignedDistancePointCapsule,
    SignedDistancePointCircle, SignedDistancePointObb2, SignedDistancePointTriangle,
    SignedDistanceSegmentCircle, SignedDistanceSegmentObb2, SignedDistanceTriangles,
};
pub use ops::distance3::{
    DistancePointAabb3, DistancePointObb3, DistancePointYaw, SignedDistancePointAabb3,
    SignedDistancePointObb3, SignedDistancePointYaw,
};
pub use ops::extent::{
    CircleAroundPolygon, DiameterOfPolygon, RectangleAroundPolygon, WidthOfPolygon,
};
pub use ops::fold::{
    ClearancePointRing, DistancePointPolyline, DistancePointRing, LengthOfPolyline,
    SecondMomentsOfRing, SignedDistancePointRing, WindingOfRing,
};
pub use ops::gaussian::{
    BhattacharyyaObb2, BhattacharyyaObb3, JeffreysObb2, JeffreysObb3, KfiouObb2, KfiouObb3,
    KullbackLeiblerObb2, KullbackLeiblerObb3, ProbiouObb2, ProbiouObb3, WassersteinObb2,
    WassersteinObb3, WassersteinSquaredObb2, WassersteinSquaredObb3,
};
pub use ops::intersection::{
    CrossingOfLines, FirstHitRayAabb2, FirstHitRayCapsule, FirstHitRayCircle, FirstHitRayObb2,
    FirstHitRayTriangle, LengthInsideSegmentAabb2, LengthInsideSegmentCapsule,
    LengthInsideSegmentCircle, LengthInsideSegmentObb2, LengthInsideSegmentTriangle,
    MeetingOfSegments, SpanLineAabb2, SpanLineCapsule, SpanLineCircle, SpanLineObb2,
    SpanLineTriangle,
};
pub use ops::interval::{
    DistanceIntervals, DistanceNumberInterval, IntersectionLengthIntervals, IouIntervals,
    SignedDistanceIntervals,
};
pub use ops::iou::{
    AlphaIouAabb2, AlphaIouObb2, CiouAabb2, CiouAabbObb2, CiouFixedWeightAabb2,
    CiouFixedWeightObb2, CiouHullAabb2, CiouObb2, DiouAabb2, DiouAabbObb2, DiouHullAabb2, DiouObb2,
    EiouAabb2, EiouAabbObb2, EiouHullAabb2, EiouObb2, GiouAabb2, GiouAabbObb2, GiouHullAabb2,
    GiouObb2, HullAreaAabb2, HullAreaObb2,
};
pub use ops::iou3::{
    AlphaIouAabb3, AlphaIouYaw, CiouAabb3, CiouAabbObb3, CiouAabbYaw, CiouObb3, CiouRectangleYaw,
    CiouYaw, DiouAabb3, DiouAabbObb3, DiouAabbYaw, DiouObb3, DiouRectangleYaw, DiouYaw, EiouAabb3,
    EiouAabbObb3, EiouAabbYaw, EiouObb3, EiouRectangleYaw, EiouYaw, GiouAabb3, GiouAabbObb3,
    GiouAabbYaw, GiouObb3, GiouRectangleYaw, GiouYaw, SeparationAwareAabb3, SeparationAwareObb2,
    SeparationAwareObb3, SeparationAwareYaw,
};
pub use ops::overlap::{
    IntersectionAreaAabb2, IntersectionAreaObb2, IofAabb2, IofObb2, IouAabb2, IouObb2,
};
pub use ops::overlap3::{
    IntersectionVolumeAabb3, IntersectionVolumeObb3, IntersectionVolumeYaw, IofAabb3, IofObb3,
    IofYaw, IouAabb3, IouAabb3Obb3, IouAabb3Yaw, IouBirdsEye, IouObb3, IouYaw, IouYawObb3,
};
pub use ops::polygon::{
    AreaTriangle, CentroidQuad, CentroidTriangle, DiouPolygons, GiouPolygons, HullAreaPolygons,
    IntersectionAreaPolygons, IntersectionAreaQuads, IofPolygons, IouPolygons, PerimeterQuad,
    PerimeterTriangle, SignedAreaQuad, SignedAreaTriangle,
};
pub use ops::ring::{Centroid, Perimeter, SignedArea};
pub use ops::shape::{Circumcircle, Incircle, MoveSegment};
pub use row::{Column, Columns, One, Row, Target};
pub use targets::{Skip, Targets};
pub use verbs::{Binary, Function, Ternary, Unary, convert, function};

/// Every operation, one per line: a name and a type. Tests, benches and documentation walk this
/// list.
///
/// `for_each_op!(with)` calls the macro `with!` with the whole list, `pairs { … } rings { … }
/// straight { … } folds { … } decided { … } further { straight { … } folds { … } decided { … } }`: scores of two
/// boxes and measures of rings, which have kernels of their own, then all other straight
/// lines, [folds](Fold) over paths and operations with a [search](Decided). Further ones are the same
/// functions of other shapes: proofs of unoptimised builds leave them out. What the harness refuses at more than
/// some hard cases is not in the list; those inputs are named in `BENCHMARKS.md`.
#[macro_export]
macro_rules! for_each_op {
    ($with:ident) => {
        $with! {
            pairs {
                intersection_area_obb2: $crate::kernels::ops::overlap::IntersectionAreaObb2,
                iou_obb2: $crate::kernels::ops::overlap::IouObb2,
                iof_obb2: $crate::kernels::ops::overlap::IofObb2,
                intersection_area_aabb2: $crate::kernels::ops::overlap::IntersectionAreaAabb2,
                iou_aabb2: $crate::kernels::ops::overlap::IouAabb2,
                iof_aabb2: $crate::kernels::ops::overlap::IofAabb2,
            }
            rings {
                signed_area: $crate::kernels::ops::ring::SignedArea,
                perimeter: $crate::kernels::ops::ring::Perimeter,
                centroid: $crate::kernels::ops::ring::Centroid,
            }
            straight {
                distance_point_segment: $crate::kernels::ops::distance::DistancePointSegment,
                signed_distance_point_obb2: $crate::kernels::ops::distance::SignedDistancePointObb2,
                closest_points_of_segments: $crate::kernels::ops::distance::ClosestPointsOfSegments,
                distance_point_circle: $crate::kernels::ops::distance::DistancePointCircle,
                distance_point_triangle: $crate::kernels::ops::distance::DistancePointTriangle,
                distance_point_capsule: $crate::kernels::ops::distance::DistancePointCapsule,
                distance_point_aabb2: $crate::kernels::ops::distance::DistancePointAabb2,
                distance_point_obb2: $crate::kernels::ops::distance::DistancePointObb2,
                distance_segment_circle: $crate::kernels::ops::distance::DistanceSegmentCircle,
                distance_circles: $crate::kernels::ops::distance::DistanceCircles,
                signed_distance_point_circle: $crate::kernels::ops::distance::SignedDistancePointCircle,
                signed_distance_point_capsule: $crate::kernels::ops::distance::SignedDistancePointCapsule,
                signed_distance_point_aabb2: $crate::kernels::ops::distance::SignedDistancePointAabb2,
                distance_squared_point_segment: $crate::kernels::ops::distance::DistanceSquaredPointSegment,
                distance_squared_point_triangle: $crate::kernels::ops::distance::DistanceSquaredPointTriangle,
                giou_obb2: $crate::kernels::ops::iou::GiouObb2,
                giou_aabb_obb2: $crate::kernels::ops::iou::GiouAabbObb2,
                diou_obb2: $crate::kernels::ops::iou::DiouObb2,
                diou_aabb_obb2: $crate::kernels::ops::iou::DiouAabbObb2,
                ciou_obb2: $crate::kernels::ops::iou::CiouObb2,
                ciou_aabb2: $crate::kernels::ops::iou::CiouAabb2,
                eiou_aabb2: $crate::kernels::ops::iou::EiouAabb2,
                hull_area_obb2: $crate::kernels::ops::iou::HullAreaObb2,
                hull_area_aabb2: $crate::kernels::ops::iou::HullAreaAabb2,
                iou_intervals: $crate::kernels::ops::interval::IouIntervals,
                distance_intervals: $crate::kernels::ops::interval::DistanceIntervals,
                distance_number_interval: $crate::kernels::ops::interval::DistanceNumberInterval,
                circumcircle: $crate::kernels::ops::shape::Circumcircle,
                centroid_quad: $crate::kernels::ops::polygon::CentroidQuad,
                intersection_length_intervals: $crate::kernels::ops::interval::IntersectionLengthIntervals,
                signed_distance_intervals: $crate::kernels::ops::interval::SignedDistanceIntervals,
                diou_aabb2: $crate::kernels::ops::iou::DiouAabb2,
                diou_hull_aabb2: $crate::kernels::ops::iou::DiouHullAabb2,
                eiou_obb2: $crate::kernels::ops::iou::EiouObb2,
                alpha_iou_aabb2: $crate::kernels::ops::iou::AlphaIouAabb2,
                clearance_point_aabb2: $crate::kernels::ops::distance::ClearancePointAabb2,
                signed_area_triangle: $crate::kernels::ops::polygon::SignedAreaTriangle,
                area_triangle: $crate::kernels::ops::polygon::AreaTriangle,
                perimeter_triangle: $crate::kernels::ops::polygon::PerimeterTriangle,
                centroid_triangle: $crate::kernels::ops::polygon::CentroidTriangle,
                signed_area_quad: $crate::kernels::ops::polygon::SignedAreaQuad,
                perimeter_quad: $crate::kernels::ops::polygon::PerimeterQuad,
                incircle: $crate::kernels::ops::shape::Incircle,
                move_segment: $crate::kernels::ops::shape::MoveSegment,
                intersection_volume_aabb3: $crate::kernels::ops::overlap3::IntersectionVolumeAabb3,
                iou_aabb3: $crate::kernels::ops::overlap3::IouAabb3,
                iof_aabb3: $crate::kernels::ops::overlap3::IofAabb3,
                intersection_volume_yaw: $crate::kernels::ops::overlap3::IntersectionVolumeYaw,
                iou_yaw: $crate::kernels::ops::overlap3::IouYaw,
                iof_yaw: $crate::kernels::ops::overlap3::IofYaw,
                iou_birds_eye: $crate::kernels::ops::overlap3::IouBirdsEye,
                intersection_volume_obb3: $crate::kernels::ops::overlap3::IntersectionVolumeObb3,
                iou_obb3: $crate::kernels::ops::overlap3::IouObb3,
                iof_obb3: $crate::kernels::ops::overlap3::IofObb3,
                iou_aabb3_yaw: $crate::kernels::ops::overlap3::IouAabb3Yaw,
                giou_aabb3: $crate::kernels::ops::iou3::GiouAabb3,
                ciou_aabb3: $crate::kernels::ops::iou3::CiouAabb3,
                eiou_aabb3: $crate::kernels::ops::iou3::EiouAabb3,
                giou_yaw: $crate::kernels::ops::iou3::GiouYaw,
                diou_yaw: $crate::kernels::ops::iou3::DiouYaw,
                ciou_yaw: $crate::kernels::ops::iou3::CiouYaw,
                eiou_yaw: $crate::kernels::ops::iou3::EiouYaw,
                giou_aabb_yaw: $crate::kernels::ops::iou3::GiouAabbYaw,
                alpha_iou_yaw: $crate::kernels::ops::iou3::AlphaIouYaw,
                alpha_iou_aabb3: $crate::kernels::ops::iou3::AlphaIouAabb3,
                separation_aware_aabb3: $crate::kernels::ops::iou3::SeparationAwareAabb3,
                separation_aware_yaw: $crate::kernels::ops::iou3::SeparationAwareYaw,
                wasserstein_obb2: $crate::kernels::ops::gaussian::WassersteinObb2,
                wasserstein_squared_obb2: $crate::kernels::ops::gaussian::WassersteinSquaredObb2,
                kullback_leibler_obb2: $crate::kernels::ops::gaussian::KullbackLeiblerObb2,
                jeffreys_obb2: $crate::kernels::ops::gaussian::JeffreysObb2,
                bhattacharyya_obb2: $crate::kernels::ops::gaussian::BhattacharyyaObb2,
                probiou_obb2: $crate::kernels::ops::gaussian::ProbiouObb2,
                kfiou_obb2: $crate::kernels::ops::gaussian::KfiouObb2,
                wasserstein_obb3: $crate::kernels::ops::gaussian::WassersteinObb3,
                wasserstein_squared_obb3: $crate::kernels::ops::gaussian::WassersteinSquaredObb3,
                kullback_leibler_obb3: $crate::kernels::ops::gaussian::KullbackLeiblerObb3,
                jeffreys_obb3: $crate::kernels::ops::gaussian::JeffreysObb3,
                bhattacharyya_obb3: $crate::kernels::ops::gaussian::BhattacharyyaObb3,
                probiou_obb3: $crate::kernels::ops::gaussian::ProbiouObb3,
                kfiou_obb3: $crate::kernels::ops::gaussian::KfiouObb3,
                signed_distance_point_aabb3: $crate::kernels::ops::distance3::SignedDistancePointAabb3,
                signed_distance_point_yaw: $crate::kernels::ops::distance3::SignedDistancePointYaw,
                signed_distance_point_obb3: $crate::kernels::ops::distance3::SignedDistancePointObb3,
                distance_point_aabb3: $crate::kernels::ops::distance3::DistancePointAabb3,
                distance_point_yaw: $crate::kernels::ops::distance3::DistancePointYaw,
                distance_point_obb3: $crate::kernels::ops::distance3::DistancePointObb3,
                le90_of_image_box: $crate::kernels::ops::convention::Le90OfImageBox,
                le135_of_image_box: $crate::kernels::ops::convention::Le135OfImageBox,
                open_cv_of_image_box: $crate::kernels::ops::convention::OpenCvOfImageBox,
                obb2_of_xyxyr: $crate::kernels::ops::convention::Obb2OfXyxyr,
                corners_of_obb2: $crate::kernels::ops::convention::CornersOfObb2,
                yaw_of_kitti: $crate::kernels::ops::convention::YawOfKitti,
                obb3_of_yaw: $crate::kernels::ops::convention::Obb3OfYaw,
            }
            folds {
                second_moments_of_ring: $crate::kernels::ops::fold::SecondMomentsOfRing,
                length_of_polyline: $crate::kernels::ops::fold::LengthOfPolyline,
                signed_distance_point_ring: $crate::kernels::ops::fold::SignedDistancePointRing,
            }
            decided {
                diameter_of_polygon: $crate::kernels::ops::extent::DiameterOfPolygon<6>,
                width_of_polygon: $crate::kernels::ops::extent::WidthOfPolygon<6>,
            }
            further {
                straight {
                    alpha_iou_obb2: $crate::kernels::ops::iou::AlphaIouObb2,
                    ciou_aabb_obb2: $crate::kernels::ops::iou::CiouAabbObb2,
                    ciou_aabb_obb3: $crate::kernels::ops::iou3::CiouAabbObb3,
                    ciou_aabb_yaw: $crate::kernels::ops::iou3::CiouAabbYaw,
                    ciou_hull_aabb2: $crate::kernels::ops::iou::CiouHullAabb2,
                    ciou_obb3: $crate::kernels::ops::iou3::CiouObb3,
                    ciou_rectangle_yaw: $crate::kernels::ops::iou3::CiouRectangleYaw,
                    clearance_point_obb2: $crate::kernels::ops::distance::ClearancePointObb2,
                    closest_points_aabb2: $crate::kernels::ops::distance::ClosestPointsAabb2,
                    closest_points_capsules: $crate::kernels::ops::distance::ClosestPointsCapsules,
                    closest_points_circle_obb2: $crate::kernels::ops::distance::ClosestPointsCircleObb2,
                    closest_points_obb2: $crate::kernels::ops::distance::ClosestPointsObb2,
                    closest_points_point_obb2: $crate::kernels::ops::distance::ClosestPointsPointObb2,
                    closest_points_point_segment: $crate::kernels::ops::distance::ClosestPointsPointSegment,
                    closest_points_point_triangle: $crate::kernels::ops::distance::ClosestPointsPointTriangle,
                    crossing_of_lines: $crate::kernels::ops::intersection::CrossingOfLines,
                    detectron2_of_image_box: $crate::kernels::ops::convention::Detectron2OfImageBox,
                    diou_aabb_obb3: $crate::kernels::ops::iou3::DiouAabbObb3,
                    diou_aabb_yaw: $crate::kernels::ops::iou3::DiouAabbYaw,
                    diou_aabb3: $crate::kernels::ops::iou3::DiouAabb3,
                    diou_obb3: $crate::kernels::ops::iou3::DiouObb3,
                    diou_rectangle_yaw: $crate::kernels::ops::iou3::DiouRectangleYaw,
                    distance_aabb2: $crate::kernels::ops::distance::DistanceAabb2,
                    distance_capsules: $crate::kernels::ops::distance::DistanceCapsules,
                    distance_circle_obb2: $crate::kernels::ops::distance::DistanceCircleObb2,
                    distance_obb2: $crate::kernels::ops::distance::DistanceObb2,
                    distance_segment_obb2: $crate::kernels::ops::distance::DistanceSegmentObb2,
                    distance_segments: $crate::kernels::ops::distance::DistanceSegments,
                    distance_squared_aabb2: $crate::kernels::ops::distance::DistanceSquaredAabb2,
                    distance_squared_obb2: $crate::kernels::ops::distance::DistanceSquaredObb2,
                    distance_squared_segments: $crate::kernels::ops::distance::DistanceSquaredSegments,
                    distance_squared_triangles: $crate::kernels::ops::distance::DistanceSquaredTriangles,
                    distance_triangles: $crate::kernels::ops::distance::DistanceTriangles,
                    eiou_aabb_obb2: $crate::kernels::ops::iou::EiouAabbObb2,
                    eiou_aabb_obb3: $crate::kernels::ops::iou3::EiouAabbObb3,
                    eiou_aabb_yaw: $crate::kernels::ops::iou3::EiouAabbYaw,
                    eiou_hull_aabb2: $crate::kernels::ops::iou::EiouHullAabb2,
                    eiou_obb3: $crate::kernels::ops::iou3::EiouObb3,
                    eiou_rectangle_yaw: $crate::kernels::ops::iou3::EiouRectangleYaw,
                    farthest_distance_aabb2: $crate::kernels::ops::distance::FarthestDistanceAabb2,
                    farthest_distance_circle_obb2: $crate::kernels::ops::distance::FarthestDistanceCircleObb2,
                    farthest_distance_obb2: $crate::kernels::ops::distance::FarthestDistanceObb2,
                    farthest_distance_point_obb2: $crate::kernels::ops::distance::FarthestDistancePointObb2,
                    farthest_distance_triangles: $crate::kernels::ops::distance::FarthestDistanceTriangles,
                    first_hit_ray_aabb2: $crate::kernels::ops::intersection::FirstHitRayAabb2,
                    first_hit_ray_capsule: $crate::kernels::ops::intersection::FirstHitRayCapsule,
                    first_hit_ray_circle: $crate::kernels::ops::intersection::FirstHitRayCircle,
                    first_hit_ray_obb2: $crate::kernels::ops::intersection::FirstHitRayObb2,
                    first_hit_ray_triangle: $crate::kernels::ops::intersection::FirstHitRayTriangle,
                    giou_aabb2: $crate::kernels::ops::iou::GiouAabb2,
                    giou_aabb_obb3: $crate::kernels::ops::iou3::GiouAabbObb3,
                    giou_hull_aabb2: $crate::kernels::ops::iou::GiouHullAabb2,
                    giou_obb3: $crate::kernels::ops::iou3::GiouObb3,
                    giou_rectangle_yaw: $crate::kernels::ops::iou3::GiouRectangleYaw,
                    image_box_of_detectron2: $crate::kernels::ops::convention::ImageBoxOfDetectron2,
                    iou_yaw_obb3: $crate::kernels::ops::overlap3::IouYawObb3,
                    kitti_of_yaw: $crate::kernels::ops::convention::KittiOfYaw,
                    length_inside_segment_aabb2: $crate::kernels::ops::intersection::LengthInsideSegmentAabb2,
                    length_inside_segment_capsule: $crate::kernels::ops::intersection::LengthInsideSegmentCapsule,
                    length_inside_segment_circle: $crate::kernels::ops::intersection::LengthInsideSegmentCircle,
                    length_inside_segment_obb2: $crate::kernels::ops::intersection::LengthInsideSegmentObb2,
                    length_inside_segment_triangle: $crate::kernels::ops::intersection::LengthInsideSegmentTriangle,
                    meeting_of_segments: $crate::kernels::ops::intersection::MeetingOfSegments,
                    obb2_of_image_box: $crate::kernels::ops::convention::Obb2OfImageBox,
                    obb3_of_nu_scenes: $crate::kernels::ops::convention::Obb3OfNuScenes,
                    penetration_aabb2: $crate::kernels::ops::distance::PenetrationAabb2,
                    penetration_capsules: $crate::kernels::ops::distance::PenetrationCapsules,
                    penetration_circle_obb2: $crate::kernels::ops::distance::PenetrationCircleObb2,
                    penetration_circles: $crate::kernels::ops::distance::PenetrationCircles,
                    penetration_obb2: $crate::kernels::ops::distance::PenetrationObb2,
                    penetration_triangles: $crate::kernels::ops::distance::PenetrationTriangles,
                    separation_aware_obb2: $crate::kernels::ops::iou3::SeparationAwareObb2,
                    separation_aware_obb3: $crate::kernels::ops::iou3::SeparationAwareObb3,
                    signed_distance_aabb2: $crate::kernels::ops::distance::SignedDistanceAabb2,
                    signed_distance_capsules: $crate::kernels::ops::distance::SignedDistanceCapsules,
                    signed_distance_circle_obb2: $crate::kernels::ops::distance::SignedDistanceCircleObb2,
                    signed_distance_circles: $crate::kernels::ops::distance::SignedDistanceCircles,
                    signed_distance_obb2: $crate::kernels::ops::distance::SignedDistanceObb2,
                    signed_distance_point_triangle: $crate::kernels::ops::distance::SignedDistancePointTriangle,
                    signed_distance_segment_circle: $crate::kernels::ops::distance::SignedDistanceSegmentCircle,
                    signed_distance_segment_obb2: $crate::kernels::ops::distance::SignedDistanceSegmentObb2,
                    signed_distance_triangles: $crate::kernels::ops::distance::SignedDistanceTriangles,
                    span_line_aabb2: $crate::kernels::ops::intersection::SpanLineAabb2,
                    span_line_capsule: $crate::kernels::ops::intersection::SpanLineCapsule,
                    span_line_circle: $crate::kernels::ops::intersection::SpanLineCircle,
                    span_line_obb2: $crate::kernels::ops::intersection::SpanLineObb2,
                    span_line_triangle: $crate::kernels::ops::intersection::SpanLineTriangle,
                    xyxyr_of_obb2: $crate::kernels::ops::convention::XyxyrOfObb2,
                    yaw_of_lidar: $crate::kernels::ops::convention::YawOfLidar,
                }
                folds {
                    distance_point_polyline: $crate::kernels::ops::fold::DistancePointPolyline,
                    distance_point_ring: $crate::kernels::ops::fold::DistancePointRing,
                    clearance_point_ring: $crate::kernels::ops::fold::ClearancePointRing,
                    winding_of_ring: $crate::kernels::ops::fold::WindingOfRing,
                }
                decided {
                    iou_polygons: $crate::kernels::ops::polygon::IouPolygons<5>,
                    rectangle_around_polygon: $crate::kernels::ops::extent::RectangleAroundPolygon<6>,
                    circle_around_polygon: $crate::kernels::ops::extent::CircleAroundPolygon<6>,
                    intersection_area_polygons: $crate::kernels::ops::polygon::IntersectionAreaPolygons<5>,
                    iof_polygons: $crate::kernels::ops::polygon::IofPolygons<5>,
                    giou_polygons: $crate::kernels::ops::polygon::GiouPolygons<5, 10>,
                    diou_polygons: $crate::kernels::ops::polygon::DiouPolygons<5>,
                    hull_area_polygons: $crate::kernels::ops::polygon::HullAreaPolygons<5, 10>,
                }
            }
        }
    };
}

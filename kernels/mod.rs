//! Batches: functions of shapes over many items, on the CPU or a GPU.
//!
//! | batch | arguments | results |
//! | --- | --- | --- |
//! | [`Cpu::aligned`] | item i of every column; [`One`] repeats one shape | one result per item |
//! | [`Cpu::all_pairs`] | every shape of a with every shape of b | a [`Table`] |
//! | [`Cpu::row_max`], [`Cpu::column_max`] | the same | the best match of every row or column |
//! | [`Cpu::above`], [`Cpu::count_above`] | the same | the pairs above a threshold |
//! | [`Cpu::sum`], [`Cpu::mean`], [`Cpu::sum_grad`] | the same | a loss, and its gradient |
//! | [`Cpu::ragged`], [`Cpu::fold`] | paths as vertices and offsets | one result per path |
//!
//! The function is a value: a [verb](verbs) such as [`Iou`]; its gradient ([`value_grad`](Iou::value_grad)), Jacobian
//! ([`jacobian`](Iou::jacobian)) or adjoint ([`vjp`](Iou::vjp)); an [operation](op) or a search ([`Search`]); a plain
//! generic [`function`]; a [`Program`](crate::Program). Columns are slices, vectors or [`One`]. Calls that end in
//! `_into` write into the caller's memory. [`operation!`](crate::operation) makes a function an operation.
//!
//! # Inputs and results
//!
//! Shapes are checked before anything is computed: an invalid one is an error that names it. Results are not checked.
//! The library's functions of finite shapes are finite; your own function gives infinity or NaN at a pole, and so does
//! its batch, for that item alone.
//!
//! Without pairs a sum is 0, a count 0 and a list empty. The mean is 0 with a gradient of zero, as the loss of a step
//! without matches. The maximum of an empty row is an error: [`Error::Length`](crate::Error::Length).
//!
//! # GPUs
//!
//! [`gpu`] has the same calls, except all pairs of searches. [`Backend`] is one front for both machines, and
//! [`resident`] keeps columns and results on the machine between calls.
#[forbid(unsafe_code)]
pub mod backend;
#[forbid(unsafe_code)]
pub mod check;
pub mod cpu;
#[forbid(unsafe_code)]
mod declared;
#[forbid(unsafe_code)]
pub mod dynamic;
#[forbid(unsafe_code)]
pub mod fold;
#[forbid(unsafe_code)]
pub mod fuzz;
#[forbid(unsafe_code)]
pub mod gpu;
#[forbid(unsafe_code)]
pub mod item;
#[forbid(unsafe_code)]
mod of;
#[forbid(unsafe_code)]
pub mod op;
#[forbid(unsafe_code)]
mod operation;
#[forbid(unsafe_code)]
mod ops;
#[forbid(unsafe_code)]
pub mod points;
#[forbid(unsafe_code)]
mod program;
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
pub mod search;
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
pub use fold::Fold;
pub use item::{Column, Columns, Item, One, Target};
pub use op::{Op, RingOp, Runs};
pub use search::Search;
pub use targets::{Skip, Targets};
pub use verbs::*;

/// Calls a macro with the list of all operations: a name and a type each. Tests, benches and documentation use it.
///
/// `for_each_op!(with)` calls the macro `with!` with the whole list, `pairs { … } rings { … } straight { … } folds {
/// … } decided { … } further { straight { … } folds { … } decided { … } }`: scores of two boxes and measures of
/// rings, which have kernels of their own, then all other straight lines, [folds](Fold) over paths and operations
/// with a [search](Search). Further ones are the same functions of other shapes: checks in unoptimised builds leave
/// them out, because every row costs about a second to compile; `gradient_report --release` checks them, and
/// `tests/further.rs` runs them on a GPU in every form. The list leaves out what the harness refuses at more than
/// some hard cases; `BENCHMARKS.md` names those inputs.
#[macro_export]
macro_rules! for_each_op {
    ($with:ident) => {
        $with! {
            pairs {
                intersection_area_obb2: <$crate::kernels::verbs::IntersectionArea as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                iou_obb2: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                iof_obb2: <$crate::kernels::verbs::Iof as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                intersection_area_aabb2: <$crate::kernels::verbs::IntersectionArea as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                iou_aabb2: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                iof_aabb2: <$crate::kernels::verbs::Iof as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
            }
            rings {
                signed_area: $crate::kernels::verbs::SignedArea,
                perimeter: $crate::kernels::verbs::Perimeter,
                centroid: $crate::kernels::verbs::Centroid,
            }
            straight {
                distance_point_segment: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Segment2<f64>)>>::By,
                signed_distance_point_obb2: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Obb2<f64>)>>::By,
                closest_points_of_segments: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Segment2<f64>)>>::By,
                distance_point_circle: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Circle<f64>)>>::By,
                distance_point_triangle: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Triangle2<f64>)>>::By,
                distance_point_capsule: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Capsule2<f64>)>>::By,
                distance_point_aabb2: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Aabb2<f64>)>>::By,
                distance_point_obb2: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Obb2<f64>)>>::By,
                distance_segment_circle: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Circle<f64>)>>::By,
                distance_circles: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Circle<f64>)>>::By,
                signed_distance_point_circle: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Circle<f64>)>>::By,
                signed_distance_point_capsule: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Capsule2<f64>)>>::By,
                signed_distance_point_aabb2: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Aabb2<f64>)>>::By,
                squared_distance_point_segment: <$crate::kernels::verbs::SquaredDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Segment2<f64>)>>::By,
                squared_distance_point_triangle: <$crate::kernels::verbs::SquaredDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Triangle2<f64>)>>::By,
                giou_obb2: <$crate::kernels::verbs::Giou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                giou_aabb_obb2: <$crate::kernels::verbs::GiouAabb as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                diou_obb2: <$crate::kernels::verbs::Diou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                diou_aabb_obb2: <$crate::kernels::verbs::DiouAabb as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                ciou_obb2: <$crate::kernels::verbs::Ciou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                ciou_aabb2: <$crate::kernels::verbs::Ciou as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                eiou_aabb2: <$crate::kernels::verbs::Eiou as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                hull_area_obb2: <$crate::kernels::verbs::HullArea as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                hull_area_aabb2: <$crate::kernels::verbs::HullArea as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                iou_intervals: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::Interval<f64>, $crate::Interval<f64>)>>::By,
                distance_intervals: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Interval<f64>, $crate::Interval<f64>)>>::By,
                distance_number_interval: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<(f64, $crate::Interval<f64>)>>::By,
                circumcircle: <$crate::kernels::verbs::Circumcircle as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Vec2<f64>, $crate::Vec2<f64>)>>::By,
                centroid_quad: <$crate::kernels::verbs::Centroid as $crate::kernels::verbs::Takes<[$crate::Vec2<f64>; 4]>>::By,
                intersection_length_intervals: <$crate::kernels::verbs::IntersectionLength as $crate::kernels::verbs::Takes<($crate::Interval<f64>, $crate::Interval<f64>)>>::By,
                signed_distance_intervals: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Interval<f64>, $crate::Interval<f64>)>>::By,
                diou_aabb2: <$crate::kernels::verbs::Diou as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                diou_hull_aabb2: <$crate::kernels::verbs::DiouHull as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                eiou_obb2: <$crate::kernels::verbs::Eiou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                alpha_iou_aabb2: <$crate::kernels::verbs::AlphaIou as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>, $crate::iou::Exponent<f64>)>>::By,
                clearance_point_aabb2: <$crate::kernels::verbs::Clearance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Aabb2<f64>)>>::By,
                signed_area_triangle: <$crate::kernels::verbs::SignedArea as $crate::kernels::verbs::Takes<$crate::Triangle2<f64>>>::By,
                area_triangle: <$crate::kernels::verbs::Area as $crate::kernels::verbs::Takes<$crate::Triangle2<f64>>>::By,
                perimeter_triangle: <$crate::kernels::verbs::Perimeter as $crate::kernels::verbs::Takes<$crate::Triangle2<f64>>>::By,
                centroid_triangle: <$crate::kernels::verbs::Centroid as $crate::kernels::verbs::Takes<$crate::Triangle2<f64>>>::By,
                signed_area_quad: <$crate::kernels::verbs::SignedArea as $crate::kernels::verbs::Takes<[$crate::Vec2<f64>; 4]>>::By,
                perimeter_quad: <$crate::kernels::verbs::Perimeter as $crate::kernels::verbs::Takes<[$crate::Vec2<f64>; 4]>>::By,
                incircle: <$crate::kernels::verbs::Incircle as $crate::kernels::verbs::Takes<$crate::Triangle2<f64>>>::By,
                move_segment: <$crate::kernels::verbs::Move as $crate::kernels::verbs::Takes<($crate::Pose2<f64>, $crate::Segment2<f64>)>>::By,
                intersection_volume_aabb3: <$crate::kernels::verbs::IntersectionVolume as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                iou_aabb3: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                iof_aabb3: <$crate::kernels::verbs::Iof as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                intersection_volume_yaw: <$crate::kernels::verbs::IntersectionVolume as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                iou_yaw: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                iof_yaw: <$crate::kernels::verbs::Iof as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                iou_birds_eye: <$crate::kernels::verbs::IouBev as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                intersection_volume_obb3: <$crate::kernels::verbs::IntersectionVolume as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                iou_obb3: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                iof_obb3: <$crate::kernels::verbs::Iof as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                iou_aabb3_yaw: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::YawBox3<f64>)>>::By,
                giou_aabb3: <$crate::kernels::verbs::Giou as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                ciou_aabb3: <$crate::kernels::verbs::Ciou as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                eiou_aabb3: <$crate::kernels::verbs::Eiou as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                giou_yaw: <$crate::kernels::verbs::Giou as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                diou_yaw: <$crate::kernels::verbs::Diou as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                ciou_yaw: <$crate::kernels::verbs::Ciou as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                eiou_yaw: <$crate::kernels::verbs::Eiou as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                giou_aabb_yaw: <$crate::kernels::verbs::GiouAabb as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                alpha_iou_yaw: <$crate::kernels::verbs::AlphaIou as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                alpha_iou_aabb3: <$crate::kernels::verbs::AlphaIou as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                separation_aware_aabb3: <$crate::kernels::verbs::SeparationAware as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                separation_aware_yaw: <$crate::kernels::verbs::SeparationAware as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                wasserstein_obb2: <$crate::kernels::verbs::Wasserstein as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                wasserstein_squared_obb2: <$crate::kernels::verbs::SquaredWasserstein as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                kullback_leibler_obb2: <$crate::kernels::verbs::KullbackLeibler as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                jeffreys_obb2: <$crate::kernels::verbs::Jeffreys as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                bhattacharyya_obb2: <$crate::kernels::verbs::Bhattacharyya as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                probiou_obb2: <$crate::kernels::verbs::Probiou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                kfiou_obb2: <$crate::kernels::verbs::Kfiou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                wasserstein_obb3: <$crate::kernels::verbs::Wasserstein as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                wasserstein_squared_obb3: <$crate::kernels::verbs::SquaredWasserstein as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                kullback_leibler_obb3: <$crate::kernels::verbs::KullbackLeibler as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                jeffreys_obb3: <$crate::kernels::verbs::Jeffreys as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                bhattacharyya_obb3: <$crate::kernels::verbs::Bhattacharyya as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                probiou_obb3: <$crate::kernels::verbs::Probiou as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                kfiou_obb3: <$crate::kernels::verbs::Kfiou as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                signed_distance_point_aabb3: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec3<f64>, $crate::Aabb3<f64>)>>::By,
                signed_distance_point_yaw: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec3<f64>, $crate::YawBox3<f64>)>>::By,
                signed_distance_point_obb3: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec3<f64>, $crate::Obb3<f64>)>>::By,
                distance_point_aabb3: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec3<f64>, $crate::Aabb3<f64>)>>::By,
                distance_point_yaw: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec3<f64>, $crate::YawBox3<f64>)>>::By,
                distance_point_obb3: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Vec3<f64>, $crate::Obb3<f64>)>>::By,
                le90_of_image_box: <$crate::kernels::verbs::Convert<$crate::convention::Le90<f64>> as $crate::kernels::verbs::Takes<$crate::convention::ImageBox<f64>>>::By,
                le135_of_image_box: <$crate::kernels::verbs::Convert<$crate::convention::Le135<f64>> as $crate::kernels::verbs::Takes<$crate::convention::ImageBox<f64>>>::By,
                open_cv_of_image_box: <$crate::kernels::verbs::Convert<$crate::convention::OpenCvBox<f64>> as $crate::kernels::verbs::Takes<$crate::convention::ImageBox<f64>>>::By,
                obb2_of_xyxyr: <$crate::kernels::verbs::Convert<$crate::Obb2<f64>> as $crate::kernels::verbs::Takes<$crate::convention::Xyxyr<f64>>>::By,
                corners_of_obb2: <$crate::kernels::verbs::Corners as $crate::kernels::verbs::Takes<$crate::Obb2<f64>>>::By,
                yaw_of_kitti: <$crate::kernels::verbs::Convert<$crate::YawBox3<f64>> as $crate::kernels::verbs::Takes<$crate::convention::KittiBox<f64>>>::By,
                obb3_of_yaw: <$crate::kernels::verbs::Convert<$crate::Obb3<f64>> as $crate::kernels::verbs::Takes<$crate::YawBox3<f64>>>::By,
            }
            folds {
                second_moments_of_ring: <$crate::kernels::verbs::SecondMoments as $crate::kernels::verbs::OverRing>::By,
                length_of_polyline: <$crate::kernels::verbs::Length as $crate::kernels::verbs::OverPolyline>::By,
                signed_distance_point_ring: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::OverRing>::By,
            }
            decided {
                diameter_of_polygon: <$crate::kernels::verbs::Diameter as $crate::kernels::verbs::Takes<$crate::ConvexPolygon<f64, 6>>>::By,
                width_of_polygon: <$crate::kernels::verbs::Width as $crate::kernels::verbs::Takes<$crate::ConvexPolygon<f64, 6>>>::By,
            }
            further {
                straight {
                    alpha_iou_obb2: <$crate::kernels::verbs::AlphaIou as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>, $crate::iou::Exponent<f64>)>>::By,
                    ciou_aabb_obb2: <$crate::kernels::verbs::CiouAabb as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    ciou_aabb_obb3: <$crate::kernels::verbs::CiouAabb as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    ciou_aabb_yaw: <$crate::kernels::verbs::CiouAabb as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                    ciou_hull_aabb2: <$crate::kernels::verbs::CiouHull as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    ciou_obb3: <$crate::kernels::verbs::Ciou as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    ciou_rectangle_yaw: <$crate::kernels::verbs::CiouRectangle as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                    clearance_point_obb2: <$crate::kernels::verbs::Clearance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Obb2<f64>)>>::By,
                    closest_points_aabb2: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    closest_points_capsules: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Capsule2<f64>, $crate::Capsule2<f64>)>>::By,
                    closest_points_circle_obb2: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Obb2<f64>)>>::By,
                    closest_points_obb2: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    closest_points_point_obb2: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Obb2<f64>)>>::By,
                    closest_points_point_segment: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Segment2<f64>)>>::By,
                    closest_points_point_triangle: <$crate::kernels::verbs::ClosestPoints as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Triangle2<f64>)>>::By,
                    crossing_of_lines: <$crate::kernels::verbs::Crossing as $crate::kernels::verbs::Takes<($crate::Line2<f64>, $crate::Line2<f64>)>>::By,
                    detectron2_of_image_box: <$crate::kernels::verbs::Convert<$crate::convention::Detectron2Box<f64>> as $crate::kernels::verbs::Takes<$crate::convention::ImageBox<f64>>>::By,
                    diou_aabb_obb3: <$crate::kernels::verbs::DiouAabb as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    diou_aabb_yaw: <$crate::kernels::verbs::DiouAabb as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                    diou_aabb3: <$crate::kernels::verbs::Diou as $crate::kernels::verbs::Takes<($crate::Aabb3<f64>, $crate::Aabb3<f64>)>>::By,
                    diou_obb3: <$crate::kernels::verbs::Diou as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    diou_rectangle_yaw: <$crate::kernels::verbs::DiouRectangle as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                    distance_aabb2: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    distance_capsules: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Capsule2<f64>, $crate::Capsule2<f64>)>>::By,
                    distance_circle_obb2: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Obb2<f64>)>>::By,
                    distance_obb2: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    distance_segment_obb2: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Obb2<f64>)>>::By,
                    distance_segments: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Segment2<f64>)>>::By,
                    squared_distance_aabb2: <$crate::kernels::verbs::SquaredDistance as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    squared_distance_obb2: <$crate::kernels::verbs::SquaredDistance as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    squared_distance_segments: <$crate::kernels::verbs::SquaredDistance as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Segment2<f64>)>>::By,
                    squared_distance_triangles: <$crate::kernels::verbs::SquaredDistance as $crate::kernels::verbs::Takes<($crate::Triangle2<f64>, $crate::Triangle2<f64>)>>::By,
                    distance_triangles: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::Takes<($crate::Triangle2<f64>, $crate::Triangle2<f64>)>>::By,
                    eiou_aabb_obb2: <$crate::kernels::verbs::EiouAabb as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    eiou_aabb_obb3: <$crate::kernels::verbs::EiouAabb as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    eiou_aabb_yaw: <$crate::kernels::verbs::EiouAabb as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                    eiou_hull_aabb2: <$crate::kernels::verbs::EiouHull as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    eiou_obb3: <$crate::kernels::verbs::Eiou as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    eiou_rectangle_yaw: <$crate::kernels::verbs::EiouRectangle as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                    farthest_distance_aabb2: <$crate::kernels::verbs::FarthestDistance as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    farthest_distance_circle_obb2: <$crate::kernels::verbs::FarthestDistance as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Obb2<f64>)>>::By,
                    farthest_distance_obb2: <$crate::kernels::verbs::FarthestDistance as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    farthest_distance_point_obb2: <$crate::kernels::verbs::FarthestDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Obb2<f64>)>>::By,
                    farthest_distance_triangles: <$crate::kernels::verbs::FarthestDistance as $crate::kernels::verbs::Takes<($crate::Triangle2<f64>, $crate::Triangle2<f64>)>>::By,
                    first_hit_ray_aabb2: <$crate::kernels::verbs::FirstHit as $crate::kernels::verbs::Takes<($crate::Ray2<f64>, $crate::Aabb2<f64>)>>::By,
                    first_hit_ray_capsule: <$crate::kernels::verbs::FirstHit as $crate::kernels::verbs::Takes<($crate::Ray2<f64>, $crate::Capsule2<f64>)>>::By,
                    first_hit_ray_circle: <$crate::kernels::verbs::FirstHit as $crate::kernels::verbs::Takes<($crate::Ray2<f64>, $crate::Circle<f64>)>>::By,
                    first_hit_ray_obb2: <$crate::kernels::verbs::FirstHit as $crate::kernels::verbs::Takes<($crate::Ray2<f64>, $crate::Obb2<f64>)>>::By,
                    first_hit_ray_triangle: <$crate::kernels::verbs::FirstHit as $crate::kernels::verbs::Takes<($crate::Ray2<f64>, $crate::Triangle2<f64>)>>::By,
                    giou_aabb2: <$crate::kernels::verbs::Giou as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    giou_aabb_obb3: <$crate::kernels::verbs::GiouAabb as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    giou_hull_aabb2: <$crate::kernels::verbs::GiouHull as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    giou_obb3: <$crate::kernels::verbs::Giou as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    giou_rectangle_yaw: <$crate::kernels::verbs::GiouRectangle as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::YawBox3<f64>)>>::By,
                    image_box_of_detectron2: <$crate::kernels::verbs::Convert<$crate::convention::ImageBox<f64>> as $crate::kernels::verbs::Takes<$crate::convention::Detectron2Box<f64>>>::By,
                    iou_yaw_obb3: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::YawBox3<f64>, $crate::Obb3<f64>)>>::By,
                    kitti_of_yaw: <$crate::kernels::verbs::Convert<$crate::convention::KittiBox<f64>> as $crate::kernels::verbs::Takes<$crate::YawBox3<f64>>>::By,
                    length_inside_segment_aabb2: <$crate::kernels::verbs::LengthInside as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Aabb2<f64>)>>::By,
                    length_inside_segment_capsule: <$crate::kernels::verbs::LengthInside as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Capsule2<f64>)>>::By,
                    length_inside_segment_circle: <$crate::kernels::verbs::LengthInside as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Circle<f64>)>>::By,
                    length_inside_segment_obb2: <$crate::kernels::verbs::LengthInside as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Obb2<f64>)>>::By,
                    length_inside_segment_triangle: <$crate::kernels::verbs::LengthInside as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Triangle2<f64>)>>::By,
                    meeting_of_segments: <$crate::kernels::verbs::Meeting as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Segment2<f64>)>>::By,
                    obb2_of_image_box: <$crate::kernels::verbs::FlipY as $crate::kernels::verbs::Takes<($crate::convention::ImageBox<f64>, f64)>>::By,
                    obb3_of_nu_scenes: <$crate::kernels::verbs::Convert<$crate::Obb3<f64>> as $crate::kernels::verbs::Takes<$crate::convention::NuScenesBox<f64>>>::By,
                    penetration_aabb2: <$crate::kernels::verbs::Penetration as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    penetration_capsules: <$crate::kernels::verbs::Penetration as $crate::kernels::verbs::Takes<($crate::Capsule2<f64>, $crate::Capsule2<f64>)>>::By,
                    penetration_circle_obb2: <$crate::kernels::verbs::Penetration as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Obb2<f64>)>>::By,
                    penetration_circles: <$crate::kernels::verbs::Penetration as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Circle<f64>)>>::By,
                    penetration_obb2: <$crate::kernels::verbs::Penetration as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    penetration_triangles: <$crate::kernels::verbs::Penetration as $crate::kernels::verbs::Takes<($crate::Triangle2<f64>, $crate::Triangle2<f64>)>>::By,
                    separation_aware_obb2: <$crate::kernels::verbs::SeparationAware as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    separation_aware_obb3: <$crate::kernels::verbs::SeparationAware as $crate::kernels::verbs::Takes<($crate::Obb3<f64>, $crate::Obb3<f64>)>>::By,
                    signed_distance_aabb2: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Aabb2<f64>, $crate::Aabb2<f64>)>>::By,
                    signed_distance_capsules: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Capsule2<f64>, $crate::Capsule2<f64>)>>::By,
                    signed_distance_circle_obb2: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Obb2<f64>)>>::By,
                    signed_distance_circles: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Circle<f64>, $crate::Circle<f64>)>>::By,
                    signed_distance_obb2: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Obb2<f64>, $crate::Obb2<f64>)>>::By,
                    signed_distance_point_triangle: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Vec2<f64>, $crate::Triangle2<f64>)>>::By,
                    signed_distance_segment_circle: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Circle<f64>)>>::By,
                    signed_distance_segment_obb2: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Segment2<f64>, $crate::Obb2<f64>)>>::By,
                    signed_distance_triangles: <$crate::kernels::verbs::SignedDistance as $crate::kernels::verbs::Takes<($crate::Triangle2<f64>, $crate::Triangle2<f64>)>>::By,
                    span_line_aabb2: <$crate::kernels::verbs::Span as $crate::kernels::verbs::Takes<($crate::Line2<f64>, $crate::Aabb2<f64>)>>::By,
                    span_line_capsule: <$crate::kernels::verbs::Span as $crate::kernels::verbs::Takes<($crate::Line2<f64>, $crate::Capsule2<f64>)>>::By,
                    span_line_circle: <$crate::kernels::verbs::Span as $crate::kernels::verbs::Takes<($crate::Line2<f64>, $crate::Circle<f64>)>>::By,
                    span_line_obb2: <$crate::kernels::verbs::Span as $crate::kernels::verbs::Takes<($crate::Line2<f64>, $crate::Obb2<f64>)>>::By,
                    span_line_triangle: <$crate::kernels::verbs::Span as $crate::kernels::verbs::Takes<($crate::Line2<f64>, $crate::Triangle2<f64>)>>::By,
                    xyxyr_of_obb2: <$crate::kernels::verbs::Convert<$crate::convention::Xyxyr<f64>> as $crate::kernels::verbs::Takes<$crate::Obb2<f64>>>::By,
                    yaw_of_lidar: <$crate::kernels::verbs::Convert<$crate::YawBox3<f64>> as $crate::kernels::verbs::Takes<$crate::convention::LidarBox<f64>>>::By,
                }
                folds {
                    distance_point_polyline: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::OverPolyline>::By,
                    distance_point_ring: <$crate::kernels::verbs::Distance as $crate::kernels::verbs::OverRing>::By,
                    clearance_point_ring: <$crate::kernels::verbs::Clearance as $crate::kernels::verbs::OverRing>::By,
                    winding_of_ring: <$crate::kernels::verbs::Winding as $crate::kernels::verbs::OverRing>::By,
                }
                decided {
                    iou_polygons: <$crate::kernels::verbs::Iou as $crate::kernels::verbs::Takes<($crate::ConvexPolygon<f64, 5>, $crate::ConvexPolygon<f64, 5>)>>::By,
                    rectangle_around_polygon: <$crate::kernels::verbs::MinimumRectangle as $crate::kernels::verbs::Takes<$crate::ConvexPolygon<f64, 6>>>::By,
                    circle_around_polygon: <$crate::kernels::verbs::MinimumCircle as $crate::kernels::verbs::Takes<$crate::ConvexPolygon<f64, 6>>>::By,
                    intersection_area_polygons: <$crate::kernels::verbs::IntersectionArea as $crate::kernels::verbs::Takes<($crate::ConvexPolygon<f64, 5>, $crate::ConvexPolygon<f64, 5>)>>::By,
                    iof_polygons: <$crate::kernels::verbs::Iof as $crate::kernels::verbs::Takes<($crate::ConvexPolygon<f64, 5>, $crate::ConvexPolygon<f64, 5>)>>::By,
                    giou_polygons: <$crate::kernels::verbs::Giou as $crate::kernels::verbs::Takes<($crate::ConvexPolygon<f64, 5>, $crate::ConvexPolygon<f64, 5>)>>::By,
                    diou_polygons: <$crate::kernels::verbs::Diou as $crate::kernels::verbs::Takes<($crate::ConvexPolygon<f64, 5>, $crate::ConvexPolygon<f64, 5>)>>::By,
                    hull_area_polygons: <$crate::kernels::verbs::HullArea as $crate::kernels::verbs::Takes<($crate::ConvexPolygon<f64, 5>, $crate::ConvexPolygon<f64, 5>)>>::By,
                }
            }
        }
    };
}

//! Overlap of two boxes in space: volume of intersection, intersection over union, intersection over the first box; and
//! these measures seen from above.
//!
//! Pairs of different kinds are measured as the more general kind. Each kind has its own formula:
//! bounds for [`Aabb3`](crate::shape::Aabb3), the overlap in the plane times that of the heights for
//! [`YawBox3`](crate::shape::YawBox3), and for [`Obb3`](crate::shape::Obb3) the integral over the clamped [`border`].
//!
//! All results are exactly zero, with all derivatives zero, for boxes that are apart or merely touch. The ratios
//! are within `[0, 1]`; identical boxes of positive volume give exactly 1 with derivative zero. A ratio with a
//! denominator of zero is 0 with derivative zero.
//!
//! Values and derivatives are finite for all finite valid input, for upstream derivatives of any size; derivatives by
//! duals, and of an axis-aligned box with an upright one, where every length and coordinate is zero or of a magnitude
//! from 2⁻²⁰ to 2²⁰ in `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! ```
//! use geograd::{Aabb3, Obb3, Rotation3, Vec3, YawBox3};
//! let room = Aabb3::new(Vec3::new(-1.0_f64, -1.0, 0.0), Vec3::new(1.0, 1.0, 2.0));
//! let car = YawBox3::new(Vec3::new(1.0, 0.0, 1.0), Vec3::new(2.0, 2.0, 2.0), 0.0);
//! assert_eq!(room.intersection_volume(car), 4.0);
//! let tilted = Obb3 { rotation: Rotation3::new(0.9, 0.1, 0.2, 0.3), ..Obb3::from(car) };
//! assert!((car.iou(tilted) - tilted.iou(car)).abs() < 1e-15);
//! assert!(room.iof(tilted) < 1.0);
//! ```
//!
//! Kinks: faces lying in each other's planes (the derivative is the mean of both sides of the kink), and boxes
//! that begin to touch (derivative zero). A corner on a face, or an edge on an edge, is no kink.
#![expect(
    clippy::needless_range_loop,
    reason = "indices are axes and sides, shared by several arrays"
)]
mod aabb3;
pub mod border;
mod edge_clamp;
mod face_integral;
mod mixed;
mod obb3;
mod precise;
pub(crate) mod relate;
mod rename;
mod yaw;

pub(crate) use aabb3::{SharedBounds, share3};
pub use aabb3::{intersection_volume_aabb3, iof_aabb3, iou_aabb3};
pub(crate) use mixed::Overlaps;
pub(crate) use obb3::{far_apart, related, score_obb3, score_obb3_here, shared_within};
pub use obb3::{intersection_volume_obb3, iof_obb3, iou_obb3};
pub(crate) use precise::to_about_half;
pub(crate) use yaw::{Heights, Scales, heights, score_of_columns, score_yaw, upright_scales};
pub use yaw::{intersection_volume_yaw, iof_yaw, iou_birds_eye, iou_yaw};

use crate::Scalar;
use crate::overlap::{Denominator, ratio_of_first, ratio_of_union};

/// Returns the volume of a box from half its size. Doubled first, so that a volume that can be represented has no
/// unnecessary rounding.
#[inline(always)]
pub(crate) fn volume_from_half<S: Scalar>([x, y, z]: [S; 3]) -> S {
    (x + x) * (y + y) * (z + z)
}

/// Returns a score from volumes in units of `1 / scale³`, in the caller's unit.
#[inline(always)]
pub(crate) fn score<S: Scalar>(over: Denominator, shared: S, a: S, b: S, scale: S) -> S {
    match over {
        Denominator::None => shared.over(scale).over(scale).over(scale).saturated(),
        Denominator::Union => ratio_of_union(shared, a, b),
        Denominator::First => ratio_of_first(shared, a),
    }
}

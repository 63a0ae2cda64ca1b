//! Computational geometry with exact derivatives.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

pub mod aabb;
mod approximate;
pub mod clip;
pub mod dual;
#[cfg(feature = "nalgebra")]
mod dual_vector;
pub mod error;
pub mod float;
#[cfg(feature = "glam")]
mod interop;
pub mod jet;
pub mod lanes;
pub mod obb;
pub mod overlap;
pub mod pack;
pub mod pose;
pub mod ring;
pub mod scalar;
pub mod vector;

#[path = "../ad/mod.rs"]
pub mod ad;
#[path = "../kernels/mod.rs"]
pub mod kernels;

pub use aabb::Aabb2;
pub use error::{Error, Flaw, Validate};
pub use jet::Jet;
pub use lanes::Lanes;
pub use obb::Obb2;
pub use pack::{Fixed, Pack};
pub use pose::{Pose2, Rotation2};
pub use scalar::{Mask, Scalar};
pub use vector::{Vec2, Vec3};

//! Shapes: one noun a file, with its data, its validation and its own measures.
mod aabb;
mod obb;
mod pose;
mod vector;

pub use aabb::Aabb2;
pub use obb::Obb2;
pub use pose::{Pose2, Rotation2};
pub use vector::{Vec2, Vec3};

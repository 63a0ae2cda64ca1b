//! Conversions to and from glam's vectors, in both precisions.
use super::by_fields;

by_fields! {
    [] Vec2<f32> = glam::Vec2 { x, y };
    [] Vec2<f64> = glam::DVec2 { x, y };
    [] Vec3<f32> = glam::Vec3 { x, y, z };
    [] Vec3<f64> = glam::DVec3 { x, y, z };
}

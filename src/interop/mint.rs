//! mint's vectors and points.
use super::by_fields;
use crate::{Vec2, Vec3};

by_fields! {
    Vec2 = mint::Vector2<S> { x, y };
    Vec2 = mint::Point2<S> { x, y };
    Vec3 = mint::Vector3<S> { x, y, z };
    Vec3 = mint::Point3<S> { x, y, z };
}

impl<S> mint::IntoMint for Vec2<S> {
    type MintType = mint::Vector2<S>;
}
impl<S> mint::IntoMint for Vec3<S> {
    type MintType = mint::Vector3<S>;
}

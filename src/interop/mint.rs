//! mint's vectors and points.
use super::by_fields;
use crate::{Vec2, Vec3};

by_fields! {
    [S] Vec2<S> = mint::Vector2<S> { x, y };
    [S] Vec2<S> = mint::Point2<S> { x, y };
    [S] Vec3<S> = mint::Vector3<S> { x, y, z };
    [S] Vec3<S> = mint::Point3<S> { x, y, z };
}

impl<S> mint::IntoMint for Vec2<S> {
    type MintType = mint::Vector2<S>;
}
impl<S> mint::IntoMint for Vec3<S> {
    type MintType = mint::Vector3<S>;
}

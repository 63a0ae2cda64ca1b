//! Conversions to and from glam's vectors, in both precisions.
use crate::{Vec2, Vec3};

/// One pair of types; the macro lists them with their fields.
macro_rules! interop {
    ($($ours:ident<$scalar:ident> = $theirs:ident { $($field:ident),* })*) => { $(
        impl From<glam::$theirs> for $ours<$scalar> {
            #[inline]
            fn from(v: glam::$theirs) -> Self {
                $ours::new($(v.$field),*)
            }
        }
        impl From<$ours<$scalar>> for glam::$theirs {
            #[inline]
            fn from(v: $ours<$scalar>) -> Self {
                glam::$theirs::new($(v.$field),*)
            }
        }
    )* };
}

interop! {
    Vec2<f32> = Vec2 { x, y }
    Vec2<f64> = DVec2 { x, y }
    Vec3<f32> = Vec3 { x, y, z }
    Vec3<f64> = DVec3 { x, y, z }
}

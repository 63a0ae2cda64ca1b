//! nalgebra's vectors and points.
use crate::{Vec2, Vec3};
use nalgebra::{Point2, Point3, Scalar, Vector2, Vector3};

/// Pairs of types; the macro lists them with their coordinates.
macro_rules! by_list {
    ($($ours:ident = $theirs:ident [$($field:ident),*];)*) => { $(
        impl<S: Scalar> From<$theirs<S>> for $ours<S> {
            #[inline]
            fn from(v: $theirs<S>) -> Self {
                let [$($field),*] = v.into();
                $ours { $($field),* }
            }
        }
        impl<S: Scalar> From<$ours<S>> for $theirs<S> {
            #[inline]
            fn from(v: $ours<S>) -> Self {
                $theirs::new($(v.$field),*)
            }
        }
    )* };
}
by_list! {
    Vec2 = Vector2 [x, y];
    Vec2 = Point2 [x, y];
    Vec3 = Vector3 [x, y, z];
    Vec3 = Point3 [x, y, z];
}

//! Tolerant comparison of every primitive, field by field, with the traits of `approx`.
//!
//! Comparing dual numbers looks at what their own implementation looks at; those of `num-dual`
//! compare values only, so a test of derivatives must compare the parts.
use crate::{Aabb2, Obb2, Pose2, Rotation2, Vec2, Vec3};
use approx::{AbsDiffEq, RelativeEq, UlpsEq};

/// All three traits for one shape; the macro lists its fields.
macro_rules! approximate {
    ($($name:ident { $($field:ident),* })*) => { $(
        impl<S: AbsDiffEq<Epsilon: Clone>> AbsDiffEq for $name<S> {
            type Epsilon = S::Epsilon;
            fn default_epsilon() -> S::Epsilon {
                S::default_epsilon()
            }
            fn abs_diff_eq(&self, other: &Self, epsilon: S::Epsilon) -> bool {
                true $(&& self.$field.abs_diff_eq(&other.$field, epsilon.clone()))*
            }
        }
        impl<S: RelativeEq<Epsilon: Clone>> RelativeEq for $name<S> {
            fn default_max_relative() -> S::Epsilon {
                S::default_max_relative()
            }
            fn relative_eq(&self, other: &Self, epsilon: S::Epsilon, max: S::Epsilon) -> bool {
                true $(&& self.$field.relative_eq(&other.$field, epsilon.clone(), max.clone()))*
            }
        }
        impl<S: UlpsEq<Epsilon: Clone>> UlpsEq for $name<S> {
            fn default_max_ulps() -> u32 {
                S::default_max_ulps()
            }
            fn ulps_eq(&self, other: &Self, epsilon: S::Epsilon, max_ulps: u32) -> bool {
                true $(&& self.$field.ulps_eq(&other.$field, epsilon.clone(), max_ulps))*
            }
        }
    )* };
}

approximate! {
    Vec2 { x, y }
    Vec3 { x, y, z }
    Rotation2 { cos, sin }
    Pose2 { rotation, translation }
    Aabb2 { min, max }
    Obb2 { center, size, heading }
}

//! Conversions to and from points and vectors of other libraries; each a feature.
#[cfg(feature = "geo-types")]
mod geo_types;
#[cfg(feature = "glam")]
mod glam;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;

/// Pairs of types with named coordinates; the macro lists them, each after its type parameter.
#[cfg(any(feature = "geo-types", feature = "glam", feature = "mint"))]
macro_rules! by_fields {
    ($([$($generic:tt)*] $ours:ident<$scalar:ident> = $theirs:ty { $($field:ident),* };)*) => { $(
        impl<$($generic)*> From<$theirs> for crate::$ours<$scalar> {
            #[inline]
            fn from(v: $theirs) -> Self {
                crate::$ours { $($field: v.$field),* }
            }
        }
        impl<$($generic)*> From<crate::$ours<$scalar>> for $theirs {
            #[inline]
            fn from(v: crate::$ours<$scalar>) -> Self {
                Self { $($field: v.$field),* }
            }
        }
    )* };
}
#[cfg(any(feature = "geo-types", feature = "glam", feature = "mint"))]
use by_fields;

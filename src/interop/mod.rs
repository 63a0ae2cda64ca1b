//! Conversions to and from points and vectors of other libraries; each a feature.
#[cfg(feature = "geo-types")]
mod geo_types;
#[cfg(feature = "glam")]
mod glam;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;

/// Pairs of types with named coordinates; the macro lists them, with a bound where theirs have one.
#[cfg(any(feature = "geo-types", feature = "mint"))]
macro_rules! by_fields {
    ($($ours:ident = $theirs:ty { $($field:ident),* } $(where $bound:path)?;)*) => { $(
        impl<S $(: $bound)?> From<$theirs> for crate::$ours<S> {
            #[inline]
            fn from(v: $theirs) -> Self {
                crate::$ours { $($field: v.$field),* }
            }
        }
        impl<S $(: $bound)?> From<crate::$ours<S>> for $theirs {
            #[inline]
            fn from(v: crate::$ours<S>) -> Self {
                Self { $($field: v.$field),* }
            }
        }
    )* };
}
#[cfg(any(feature = "geo-types", feature = "mint"))]
use by_fields;

//! Conversions to and from points, vectors and curves of other libraries; each a feature.
#[cfg(feature = "geo-types")]
mod geo_types;
#[cfg(feature = "glam")]
mod glam;
#[cfg(feature = "kurbo")]
mod kurbo;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "nalgebra")]
mod nalgebra;

/// Pairs of types with named coordinates; the macro lists them, each after its type parameter.
#[cfg(any(
    feature = "geo-types",
    feature = "glam",
    feature = "kurbo",
    feature = "mint"
))]
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
#[cfg(any(
    feature = "geo-types",
    feature = "glam",
    feature = "kurbo",
    feature = "mint"
))]
use by_fields;

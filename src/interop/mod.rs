//! Conversions to and from points and vectors of other libraries, both ways; each a feature.
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

#[cfg(test)]
mod tests {
    use crate::{Vec2, Vec3};

    /// There and back through each of the others' types.
    #[allow(unused_macros)]
    macro_rules! there_and_back {
        ($v:expr => $($theirs:ty),*) => { $(
            let theirs = <$theirs>::from($v);
            assert_eq!(theirs.x, $v.x);
            assert_eq!($v, theirs.into());
        )* };
    }

    #[test]
    #[allow(unused_variables)]
    fn there_and_back() {
        let (flat, deep) = (Vec2::new(1.0, 2.0), Vec3::new(1.0, 2.0, 3.0));
        #[cfg(feature = "glam")]
        {
            there_and_back!(flat => glam::DVec2);
            there_and_back!(deep => glam::DVec3);
            there_and_back!(Vec3::new(1.0_f32, 2.0, 3.0) => glam::Vec3);
        }
        #[cfg(feature = "mint")]
        {
            there_and_back!(flat => mint::Vector2<f64>, mint::Point2<f64>);
            there_and_back!(deep => mint::Vector3<f64>, mint::Point3<f64>);
        }
        #[cfg(feature = "nalgebra")]
        {
            there_and_back!(flat => nalgebra::Vector2<f64>, nalgebra::Point2<f64>);
            there_and_back!(deep => nalgebra::Vector3<f64>, nalgebra::Point3<f64>);
        }
        #[cfg(feature = "geo-types")]
        {
            there_and_back!(flat => geo_types::Coord<f64>);
            assert_eq!(Vec2::from(geo_types::Point::from(flat)), flat);
        }
    }
}

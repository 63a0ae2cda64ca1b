//! Functions beside an engine's that are compiled in this library for both formats: whoever calls them compiles no more
//! than what turns shapes into numbers.
use crate::Real;
use crate::kernels::cpu::polygons::{self, Pulled, RingPairs};

/// Lists the drivers: a name, a type, and the function of a format.
macro_rules! drivers {
    ($($name:ident: fn($($type:ty),*) $(-> $out:ty)? = $function:path;)*) => {
        /// Every driver of one format.
        pub struct Drivers<T: Real> {
            $(pub(crate) $name: fn($($type),*) $(-> $out)?,)*
        }
        /// In single precision.
        pub static F32: Drivers<f32> = Drivers { $($name: $function,)* };
        /// In double precision.
        pub static F64: Drivers<f64> = Drivers { $($name: $function,)* };
    };
}

drivers! {
    ring_scores: fn(RingPairs<'_, T>) -> Vec<T> = polygons::scores;
    ring_derivatives: fn(RingPairs<'_, T>, &[T]) -> Pulled<T> = polygons::derivatives;
}

//! The drivers, compiled in this library for both formats: whoever calls a batch compiles no more
//! than what turns shapes into numbers.
use crate::kernels::cpu::desk::{self, Aligned};
use crate::kernels::cpu::pairs::{self, Pairs};
use crate::kernels::cpu::plan::{self, Plan};
use crate::kernels::cpu::reductions;
use crate::kernels::cpu::sweep::Upstream;
use crate::kernels::real::Real;
use crate::kernels::reduce::{Best, Found};
use crate::overlap::Denominator;

/// An operation that has compiled kernels.
#[derive(Clone, Copy, Debug)]
pub enum Compiled {
    /// A score of rotated boxes.
    Obb2(Denominator),
    /// A score of axis-aligned boxes.
    Aabb2(Denominator),
}

fn plan<T: Real>(compiled: Compiled) -> Plan<T> {
    match compiled {
        Compiled::Obb2(over) => plan::of_obb2(over),
        Compiled::Aabb2(over) => plan::of_aabb2(over),
    }
}

/// Lists the drivers: a name, a type, and the function of a format.
macro_rules! drivers {
    ($($name:ident: fn($($type:ty),*) $(-> $out:ty)? = $function:path;)*) => {
        /// Every driver of one format.
        pub struct Drivers<T: Clone + 'static> {
            $(pub(crate) $name: fn($($type),*) $(-> $out)?,)*
        }
        /// In single precision.
        pub static F32: Drivers<f32> = Drivers { $($name: $function,)* };
        /// In double precision.
        pub static F64: Drivers<f64> = Drivers { $($name: $function,)* };
    };
}

drivers! {
    plan: fn(Compiled) -> Plan<T> = plan;
    aligned: fn(&Plan<T>, Aligned<'_, T>) = desk::compute;
    values: fn(&Pairs<'_, T>, &mut [T]) = pairs::values;
    grads: fn(&Pairs<'_, T>, &mut [T], &mut [T]) = pairs::grads;
    pull_back: fn(&Pairs<'_, T>, Upstream<'_, T>, &mut [T], &mut [T]) = pairs::pull_back;
    row_max: fn(&Pairs<'_, T>) -> Vec<Best<T>> = reductions::row_max;
    column_max: fn(&Pairs<'_, T>) -> Vec<Best<T>> = reductions::column_max;
    above: fn(&Pairs<'_, T>, T) -> Vec<Found<T>> = reductions::above;
    count_above: fn(&Pairs<'_, T>, T) -> u64 = reductions::count_above;
    sum: fn(&Pairs<'_, T>) -> f64 = reductions::sum;
}

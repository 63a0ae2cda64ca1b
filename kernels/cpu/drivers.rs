//! The drivers, compiled in this library for both formats: whoever calls a batch compiles no more
//! than what turns shapes into numbers.
use crate::Real;
use crate::error::Error;
use crate::kernels::cpu::desk::{self, Aligned};
use crate::kernels::cpu::folds::folding::Folding;
use crate::kernels::cpu::folds::{self, Input as Paths};
use crate::kernels::cpu::greedy::{self, Greed};
use crate::kernels::cpu::grouped::{self, Spans as Groups};
use crate::kernels::cpu::pairs::{self, Pairs};
use crate::kernels::cpu::plan::{self, Face};
use crate::kernels::cpu::polygons::{self, Pulled, RingPairs};
use crate::kernels::cpu::reductions;
use crate::kernels::cpu::sweep::Upstream;
use crate::kernels::recording::Call;
use crate::kernels::reduce::{Best, Found};
use std::sync::Arc;

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
    plan: fn(&Call<T>, bool) -> Result<Arc<Face<T>>, Error> = plan::plan;
    aligned: fn(Aligned<'_, T>) -> bool = desk::compute;
    planes: fn(&Pairs<'_, T>, &mut [T]) = pairs::planes;
    pull_back: fn(&Pairs<'_, T>, Upstream<'_, T>, &mut [T], &mut [T]) = pairs::pull_back;
    most_of_rows: fn(&Pairs<'_, T>) -> Vec<Best<T>> = reductions::most_of_rows;
    most_of_columns: fn(&Pairs<'_, T>) -> Vec<Best<T>> = reductions::most_of_columns;
    above: fn(&Pairs<'_, T>, T) -> Vec<Found<T>> = reductions::above;
    count_above: fn(&Pairs<'_, T>, T) -> u64 = reductions::count_above;
    sum: fn(&Pairs<'_, T>) -> f64 = reductions::sum;
    folded: fn(&Folding<T>, &Paths<'_, T>) -> Result<Vec<T>, Error> = folds::values;
    pulled_back: fn(&Folding<T>, &Paths<'_, T>, &[T]) -> Result<(Vec<T>, Vec<T>), Error> = folds::cotangents;
    ring_scores: fn(RingPairs<'_, T>) -> Vec<T> = polygons::scores;
    ring_derivatives: fn(RingPairs<'_, T>, &[T]) -> Pulled<T> = polygons::derivatives;
    above_grouped: fn(&Pairs<'_, T>, Groups<'_>, T) -> Vec<Found<T>> = grouped::above;
    most_grouped: fn(&Pairs<'_, T>, Groups<'_>, bool) -> Vec<Option<Best<T>>> = grouped::most;
    suppress_grouped: fn(&Pairs<'_, T>, &[usize], Greed<'_, T>) -> Vec<usize> = grouped::suppress;
    suppress: fn(&Pairs<'_, T>, Greed<'_, T>) -> Vec<usize> = greedy::suppress;
}

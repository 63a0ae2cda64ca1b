//! Checks of every operation of the list, compiled here once for tests and reports.
use geograd::Error;
use geograd::ad::check::{Report, Sampling};
use geograd::kernels::Backend;
use geograd::kernels::check::{
    check_fold_with, check_on, check_pairs_on, check_ring_on, check_ring_with, check_search_with,
    check_with,
};
use geograd::kernels::gpu::Gpu;

/// One operation in one format: its name, whether that is `f64`, and what checks it, with batches
/// on a GPU as a further witness of `f32` if there is one.
pub type Judged = (&'static str, bool, Check);
pub type Check = fn(&Sampling<'_>, Option<&Gpu>) -> Result<Report, Error>;

macro_rules! checks {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        vec![
            $(
                (
                    stringify!($pair),
                    true,
                    (|plan, _| Ok(check_with::<$pair_op, f64>(plan))) as Check,
                ),
                (stringify!($pair), false, |plan, gpu| match gpu {
                    Some(gpu) => check_pairs_on::<$pair_op, _, _>(Backend::Gpu(gpu), plan),
                    None => Ok(check_with::<$pair_op, f32>(plan)),
                }),
            )*
            $(
                (stringify!($ring), true, |plan, _| Ok(check_ring_with::<$ring_op, f64>(plan))),
                (stringify!($ring), false, |plan, gpu| match gpu {
                    Some(gpu) => check_ring_on::<$ring_op>(Backend::Gpu(gpu), plan),
                    None => Ok(check_ring_with::<$ring_op, f32>(plan)),
                }),
            )*
            $(
                (stringify!($straight), true, |plan, _| Ok(check_with::<$straight_op, f64>(plan))),
                (stringify!($straight), false, |plan, gpu| match gpu {
                    Some(gpu) => check_on::<$straight_op>(Backend::Gpu(gpu), plan),
                    None => Ok(check_with::<$straight_op, f32>(plan)),
                }),
            )*
            $(
                (stringify!($fold), true, |plan, _| Ok(check_fold_with::<$fold_op, f64>(plan))),
                (stringify!($fold), false, |plan, _| Ok(check_fold_with::<$fold_op, f32>(plan))),
            )*
            $(
                (stringify!($decided), true, |plan, _| Ok(check_search_with::<$decided_op, f64>(plan))),
                (stringify!($decided), false, |plan, _| Ok(check_search_with::<$decided_op, f32>(plan))),
            )*
            // Too many to be compiled wherever examples are built and not run.
            $(
                #[cfg(not(debug_assertions))]
                (stringify!($more), true, |plan, _| Ok(check_with::<$more_op, f64>(plan))),
                #[cfg(not(debug_assertions))]
                (stringify!($more), false, |plan, gpu| match gpu {
                    Some(gpu) => check_on::<$more_op>(Backend::Gpu(gpu), plan),
                    None => Ok(check_with::<$more_op, f32>(plan)),
                }),
            )*
            $(
                #[cfg(not(debug_assertions))]
                (stringify!($more_fold), true, |plan, _| Ok(check_fold_with::<$more_fold_op, f64>(plan))),
                #[cfg(not(debug_assertions))]
                (stringify!($more_fold), false, |plan, _| Ok(check_fold_with::<$more_fold_op, f32>(plan))),
            )*
            $(
                #[cfg(not(debug_assertions))]
                (stringify!($more_search), true, |plan, _| Ok(check_search_with::<$more_decided_op, f64>(plan))),
                #[cfg(not(debug_assertions))]
                (stringify!($more_search), false, |plan, _| Ok(check_search_with::<$more_decided_op, f32>(plan))),
            )*
        ]
    };
}

/// Checks of all operations in both formats.
pub fn checks() -> Vec<Judged> {
    geograd::for_each_op!(checks)
}

//! Proofs of every operation of the list, compiled here once for tests and reports.
use geograd::Error;
use geograd::ad::check::{Plan, Report};
use geograd::kernels::Backend;
use geograd::kernels::check::{
    prove_decided_with, prove_fold_with, prove_on, prove_pairs_on, prove_ring_on, prove_ring_with,
    prove_with,
};
use geograd::kernels::gpu::Gpu;

/// One operation in one format: its name, whether that is `f64`, and what proves it, with batches
/// on a GPU as a further witness of `f32` if there is one.
pub type Proof = (&'static str, bool, Prove);
pub type Prove = fn(&Plan<'_>, Option<&Gpu>) -> Result<Report, Error>;

macro_rules! proofs {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_decided:ident: $more_decided_op:ty,)* }
     }) => {
        vec![
            $(
                (
                    stringify!($pair),
                    true,
                    (|plan, _| Ok(prove_with::<$pair_op, f64>(plan))) as Prove,
                ),
                (stringify!($pair), false, |plan, gpu| match gpu {
                    Some(gpu) => prove_pairs_on::<$pair_op, _, _>(Backend::Gpu(gpu), plan),
                    None => Ok(prove_with::<$pair_op, f32>(plan)),
                }),
            )*
            $(
                (stringify!($ring), true, |plan, _| Ok(prove_ring_with::<$ring_op, f64>(plan))),
                (stringify!($ring), false, |plan, gpu| match gpu {
                    Some(gpu) => prove_ring_on::<$ring_op>(Backend::Gpu(gpu), plan),
                    None => Ok(prove_ring_with::<$ring_op, f32>(plan)),
                }),
            )*
            $(
                (stringify!($straight), true, |plan, _| Ok(prove_with::<$straight_op, f64>(plan))),
                (stringify!($straight), false, |plan, gpu| match gpu {
                    Some(gpu) => prove_on::<$straight_op>(Backend::Gpu(gpu), plan),
                    None => Ok(prove_with::<$straight_op, f32>(plan)),
                }),
            )*
            $(
                (stringify!($fold), true, |plan, _| Ok(prove_fold_with::<$fold_op, f64>(plan))),
                (stringify!($fold), false, |plan, _| Ok(prove_fold_with::<$fold_op, f32>(plan))),
            )*
            $(
                (stringify!($decided), true, |plan, _| Ok(prove_decided_with::<$decided_op, f64>(plan))),
                (stringify!($decided), false, |plan, _| Ok(prove_decided_with::<$decided_op, f32>(plan))),
            )*
            // Too many to be compiled wherever examples are built and not run.
            $(
                #[cfg(not(debug_assertions))]
                (stringify!($more), true, |plan, _| Ok(prove_with::<$more_op, f64>(plan))),
                #[cfg(not(debug_assertions))]
                (stringify!($more), false, |plan, gpu| match gpu {
                    Some(gpu) => prove_on::<$more_op>(Backend::Gpu(gpu), plan),
                    None => Ok(prove_with::<$more_op, f32>(plan)),
                }),
            )*
            $(
                #[cfg(not(debug_assertions))]
                (stringify!($more_fold), true, |plan, _| Ok(prove_fold_with::<$more_fold_op, f64>(plan))),
                #[cfg(not(debug_assertions))]
                (stringify!($more_fold), false, |plan, _| Ok(prove_fold_with::<$more_fold_op, f32>(plan))),
            )*
            $(
                #[cfg(not(debug_assertions))]
                (stringify!($more_decided), true, |plan, _| Ok(prove_decided_with::<$more_decided_op, f64>(plan))),
                #[cfg(not(debug_assertions))]
                (stringify!($more_decided), false, |plan, _| Ok(prove_decided_with::<$more_decided_op, f32>(plan))),
            )*
        ]
    };
}

/// Proofs of all operations in both formats.
pub fn proofs() -> Vec<Proof> {
    geograd::for_each_op!(proofs)
}

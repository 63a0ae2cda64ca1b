//! Batches on the GPU against batches on the CPU, for every operation of the list.
//!
//! Without an adapter the tests say so and pass, unless `GEOGRAD_REQUIRE_GPU=1`. A driver in
//! software will do.
mod bounds;
mod committed;
mod context;
mod dynamic;
mod faults;
mod folds;
mod generated;
mod held;
mod parity;
mod program;
mod replays;
mod resident;
mod rings;
mod shapes;
mod suppress;

use geograd::kernels::gpu::{Gpu, Options, pair_sources, ring_sources};
use geograd_tests::adapter::{any_gpu, validate};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// One context for all tests, one test at a time: drivers in software use all cores anyway.
fn gpu() -> Option<(MutexGuard<'static, ()>, &'static Gpu)> {
    static TURN: Mutex<()> = Mutex::new(());
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    any_gpu().map(|gpu| (turn, gpu))
}

/// A context whose buffers are so small that everything is split.
fn small() -> Gpu {
    let mut options = Options::default();
    options.most_bytes = Some(64 * 64);
    Gpu::with(&options).unwrap()
}

macro_rules! walk {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        $(mod $pair {
            #[test]
            fn shaders_are_valid() {
                for (name, text) in super::pair_sources::<$pair_op>() {
                    super::validate(&name, &text);
                }
            }
            #[test]
            fn hard_pairs() {
                super::parity::hard_pairs_agree::<$pair_op>();
            }
            #[test]
            fn all_pairs() {
                let Some((_turn, gpu)) = super::gpu() else { return };
                super::parity::all_pairs_agree::<$pair_op>(gpu, 67, 300);
                super::parity::all_pairs_agree::<$pair_op>(gpu, 1, 1);
            }
            #[test]
            fn chains() {
                super::resident::chains_agree::<$pair_op>();
            }
            #[test]
            fn bad_input() {
                super::faults::bad_input_is_refused::<$pair_op>();
                super::faults::empty_batches_are_valid::<$pair_op>();
            }
            #[test]
            fn all_pairs_split() {
                let Some((_turn, _)) = super::gpu() else { return };
                super::parity::all_pairs_agree::<$pair_op>(&super::small(), 70, 150);
            }
        })*
        $(mod $ring {
            #[test]
            fn shaders_are_valid() {
                for (name, text) in super::ring_sources::<$ring_op>() {
                    super::validate(&name, &text);
                }
            }
            #[test]
            fn ragged() {
                let Some((_turn, gpu)) = super::gpu() else { return };
                super::rings::rings_agree::<$ring_op>(gpu);
                super::rings::rings_agree::<$ring_op>(&super::small());
            }
            #[test]
            fn moved() {
                super::rings::moved_rings_agree::<$ring_op>();
            }
            #[test]
            fn long() {
                super::rings::long_rings::<$ring_op>();
            }
        })*
        mod valid {
            $(#[test]
            fn $straight() {
                geograd_tests::adapter::shaders_are_valid::<$straight_op>();
            })*
            $(#[test]
            fn $pair() {
                geograd_tests::adapter::shaders_are_valid::<$pair_op>();
            })*
            $(#[test]
            fn $fold() {
                super::folds::shaders_are_valid(<$fold_op>::default());
            })*
            $(#[test]
            fn $more_fold() {
                super::folds::shaders_are_valid(<$more_fold_op>::default());
            })*
        }
        mod replayed {
            $(#[test]
            fn $decided() {
                super::replays::agrees::<$decided_op, _, _>();
            })*
            $(#[test]
            fn $more_search() {
                super::replays::agrees::<$more_decided_op, _, _>();
            })*
        }
        // Which implementation serves an operation is found by the references.
        #[allow(clippy::needless_borrow)]
        mod agree {
            use geograd_tests::forms::{Agree, Forms};
            $(#[test]
            fn $straight() {
                (&&&Forms::<$straight_op>::NEW).agree();
            })*
            $(#[test]
            fn $pair() {
                (&&&Forms::<$pair_op>::NEW).agree();
            })*
        }
    };
}
geograd::for_each_op!(walk);

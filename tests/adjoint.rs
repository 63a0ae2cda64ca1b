//! Every operation of the list, proved by the harness: hard cases first, then random inputs, in
//! both formats.
use geograd::ad::check::Plan;
use geograd::kernels::check::{prove_pair_with, prove_ring_with};

/// Random inputs per operation and format. Hard cases come on top.
const SAMPLES: usize = 100;
const SEED: u64 = 1;
/// Unoptimised builds take every seventh hard case, optimised ones all.
const HARD: usize = if cfg!(debug_assertions) { 7 } else { 1 };

fn plan() -> Plan<'static> {
    Plan {
        hard: HARD,
        ..Plan::new(SAMPLES, SEED)
    }
}

macro_rules! prove_all {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }) => {
        mod f64 {
            use super::*;
            $(#[test] fn $pair() {
                let report = prove_pair_with::<$pair_op, f64>(&plan());
                assert!(report.passed(), "{report}");
            })*
            $(#[test] fn $ring() {
                let report = prove_ring_with::<$ring_op, f64>(&plan());
                assert!(report.passed(), "{report}");
            })*
        }
        mod f32 {
            use super::*;
            $(#[test] fn $pair() {
                let report = prove_pair_with::<$pair_op, f32>(&plan());
                assert!(report.passed(), "{report}");
            })*
            $(#[test] fn $ring() {
                let report = prove_ring_with::<$ring_op, f32>(&plan());
                assert!(report.passed(), "{report}");
            })*
        }
    };
}
geograd::for_each_op!(prove_all);

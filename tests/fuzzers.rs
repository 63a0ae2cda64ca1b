//! Fuzzers of the operations that have one, compiled here once for tests and reports.
use geograd::kernels::fuzz::{self, Fuzzed};

/// One operation in one format: its name, whether that is `f64`, and what fuzzes it.
pub type Fuzzer = (&'static str, bool, Fuzz);
pub type Fuzz = fn(u64, u64) -> Fuzzed;

macro_rules! fuzzes {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* } $($rest:tt)*) => {
        vec![
            $(
                (stringify!($pair), true, fuzz::pairs::<$pair_op, _, f64> as Fuzz),
                (stringify!($pair), false, fuzz::pairs::<$pair_op, _, f32>),
            )*
            $(
                (stringify!($ring), true, fuzz::rings::<$ring_op, f64>),
                (stringify!($ring), false, fuzz::rings::<$ring_op, f32>),
            )*
        ]
    };
}

macro_rules! more_fuzzes {
    ($($name:ident: $op:ty,)*) => {
        [$(
            (stringify!($name), true, fuzz::pairs::<$op, _, f64> as Fuzz),
            (stringify!($name), false, fuzz::pairs::<$op, _, f32>),
        )*]
    };
}

/// Fuzzers of the operations that have one, in both formats.
pub fn fuzzers() -> Vec<Fuzzer> {
    let mut all = geograd::for_each_op!(fuzzes);
    all.extend(crate::more_fuzzed!(more_fuzzes));
    all
}

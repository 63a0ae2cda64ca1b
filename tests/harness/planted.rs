//! The function that faults are planted in.
#![allow(dead_code)]
use geograd::Scalar;
use geograd::ad::check::sample::Draw;
use geograd::ad::check::verdict::{Reason, Witness};
use geograd::ad::check::{Check, Report};

pub const BY_DUALS: Reason = Reason::Disagree(Witness::Adjoint, Witness::Dual);
pub const BY_DIFFERENCES: Reason = Reason::Disagree(Witness::Adjoint, Witness::Difference);
pub const SEED: u64 = 7;
/// Random samples per planted fault.
pub const SAMPLES: usize = 60;

/// A smooth function of two numbers with nothing special about it.
pub fn smooth<S: Scalar>([x, y]: [S; 2]) -> S {
    x * x * y.sin() + (x * y).exp() * S::lit(0.25)
}
pub fn smooth_derivatives([x, y]: [f64; 2]) -> [f64; 2] {
    let e = 0.25 * (x * y).exp();
    [2.0 * x * y.sin() + y * e, x * x * y.cos() + x * e]
}
pub fn points() -> Check<'static, [f64; 2]> {
    Check::drawn(SAMPLES, SEED, |d: &mut Draw| {
        [d.within(0.3, 1.7), d.within(0.2, 1.3)]
    })
}

#[track_caller]
pub fn refused(report: &Report, reason: Reason) {
    assert!(
        report.refused_for(reason),
        "not refused for {reason:?}:\n{report}"
    );
}

//! What cannot be recorded is refused, not proved, and does not panic.
use geograd::kernels::check::prove;
use geograd::operation;

operation! {
    /// Half of a number, with a constant in the way.
    pub Wild = "wild": (x: S) -> S {
        let never = S::lit(f64::INFINITY) * x.magnitude();
        S::select(x.above(never), never, x.halved())
    }
    promises []
    jumps Never
    slopes Reverse
}

#[test]
fn is_refused() {
    let report = prove::<Wild, f64>(5, 1);
    assert!(!report.passed(), "{report}");
    let refused = geograd::kernels::Cpu::new().aligned(Wild, &[1.0_f64]);
    assert_eq!(
        refused,
        Err(geograd::Error::Program(geograd::Unrecordable::Constant))
    );
}

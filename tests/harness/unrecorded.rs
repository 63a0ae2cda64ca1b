//! A function that cannot be recorded is refused for that, with a remedy, and does not panic. Refusals of values that
//! lose digits on purpose name the way to declare it.
use geograd::check::{Check, Reason, Witness};
use geograd::kernels::check::check;
use geograd::{Unrecordable, operation};

operation! {
    /// Half of a number, with a constant in the way.
    pub Wild = "wild": (x: S) -> S {
        let never = S::lit(f64::INFINITY) * x.magnitude();
        S::select(x.above(never), never, x.halved())
    }
    invariances []
    jumps Never
    derivative Reverse

    /// Half of a positive number, decided by a hint.
    pub Hinted = "hinted": (x: S) -> S {
        if x.above(S::zero()).any() { x.halved() } else { x }
    }
    invariances []
    jumps Never
    derivative Reverse

    /// By how much a hyperbola rises above its vertex.
    pub Rise = "rise": (x: S, y: S) -> S {
        (S::one() + x * x + y * y).root() - S::one()
    }
    invariances [Exchange Stays]
    jumps Never
    derivative Reverse

    /// The logarithm.
    pub Logarithm = "logarithm": (x: S) -> S { x.ln() }
    invariances []
    jumps Never
    derivative Reverse
}

#[test]
fn is_refused() {
    let report = check::<Wild, f64>(5, 1);
    let reason = Reason::Unrecordable(Unrecordable::Constant);
    assert!(report.refused_for(reason), "{report}");
    assert_eq!(report.failures.len(), 1, "{report}");
    let text = report.to_string();
    assert!(
        text.contains("cannot be recorded") && text.contains("remedy"),
        "{text}"
    );
    let refused = geograd::kernels::Cpu::new().aligned(Wild, &[1.0_f64]);
    assert_eq!(
        refused,
        Err(geograd::Error::Program(geograd::Unrecordable::Constant))
    );
}

#[test]
fn a_hint_that_decides_is_refused() {
    for report in Check::of(Hinted).samples(5).run() {
        let reason = Reason::Unrecordable(Unrecordable::Hint);
        assert!(report.refused_for(reason), "{report}");
        assert!(report.to_string().contains("select"), "{report}");
    }
}

#[test]
fn cancelled_digits_name_their_remedy() {
    let [single, double] = Check::of(Rise).run();
    assert!(double.passed(), "{double}");
    assert!(
        single.refused_for(Reason::ValuesDisagree(Witness::Wide)),
        "{single}"
    );
    let text = single.to_string();
    assert!(text.contains("`resolution`"), "{text}");
    Check::of(Rise).resolution(1e-7).assert();
    // A declared resolution that is far too coarse does not excuse the derivatives.
    let [single, _] = Check::of(Rise).relative_resolution(1e-9).run();
    assert!(!single.passed(), "{single}");
}

#[test]
fn an_operation_with_a_domain() {
    let [_, double] = Check::of(Logarithm).run();
    assert!(!double.passed(), "{double}");
    Check::of(Logarithm).inside(|x| *x > 1e-3).assert();
    let scales = |x: &f64| x.abs();
    Check::of(Logarithm)
        .inside(|x| *x > 0.0)
        .scales(scales)
        .assert();
}

//! Single precision against double: a formula that scatters its results is refused, although moving its inputs by
//! their last digits scatters them as much; where the function itself moves, it is accepted.
use crate::planted;

use geograd::check::{Check, Reason, Sampling, Witness};
use geograd::{Obb2, Scalar, operation};
use geograd_tests::rows::{IntersectionAreaObb2, IouObb2};
use planted::refused;

/// A number whose last digits are lost on the way.
fn scattered<S: Scalar>(x: S) -> S {
    let far = x * S::lit(65_536.3);
    (far + x) - far
}

operation! {
    /// The product of two numbers, by a formula that loses half of the digits in single precision.
    pub Value = "value": (x: S, y: S) -> S { scattered(x) * y }
    invariances []
    jumps Never
    derivative Reverse

    /// The same of its derivatives.
    pub Derivatives = "derivatives": (x: S, y: S) -> S { x * y }
    invariances []
    jumps Never
    derivative ByHand |(x, y), bar| { (x * y, (scattered(y * bar), scattered(x * bar))) }

    /// A step of which single precision cannot tell that it is not at 1.
    pub Step = "step": (x: S) -> S { x + S::select((x + S::lit(1e-9)).above(S::one()), S::one(), S::zero()) }
    invariances []
    jumps Anywhere
    derivative Reverse

    /// A step that single precision does not have.
    pub NoStep = "no_step": (x: S) -> S {
        let height = S::lit(if S::format().epsilon() > 1e-10 { 0.0 } else { 1.0 });
        x + S::select(x.above(S::one()), height, S::zero())
    }
    invariances []
    jumps Anywhere
    derivative Reverse

    /// The size of a number, whose derivative at zero each format takes from another side.
    pub Size = "size": (x: S) -> S { x.magnitude() }
    invariances []
    jumps Never
    derivative ByHand |x, bar| {
        let none = S::lit(if S::format().epsilon() > 1e-10 { 1.0 } else { -1.0 });
        let side = S::select(x.equals(S::zero()), none, S::select(x.above(S::zero()), S::one(), -S::one()));
        (x.magnitude(), side * bar)
    }
}

operation! {
    /// Nine numbers, of which one is too small for single precision, and a derivative that is wrong.
    pub Nine = "nine": (x: S, y: S) -> [S; 9] { nine(x, y) }
    invariances []
    jumps Never
    derivative ByHand |(x, y), bar| {
        (nine(x, y), (bar[1] * y, bar[1] * x + bar[2] * S::lit(2.0)))
    }
}

fn nine<S: Scalar>(x: S, y: S) -> [S; 9] {
    let none = S::zero();
    [
        x * S::lit(1e-42),
        x * y,
        y,
        none,
        none,
        none,
        none,
        none,
        none,
    ]
}

#[test]
fn an_output_off_scale_spoils_no_other() {
    for seed in 0..8 {
        let [single, _] = Check::of(Nine).samples(1).hard(0).seed(seed).run();
        refused(&single, Reason::Disagree(Witness::Adjoint, Witness::Dual));
    }
}

#[test]
fn decisions_of_single_precision_are_those_beside_an_input() {
    Check::of(Step).and(1.0).assert();
    Check::of(Size).and(0.0).assert();
    let [single, double] = Check::of(NoStep).samples(40).run();
    refused(&single, Reason::ValuesDisagree(Witness::Wide));
    assert!(double.passed(), "{double}");
}

#[test]
fn a_formula_that_scatters_is_refused() {
    let [single, _] = Check::of(Value).samples(40).run();
    refused(&single, Reason::ValuesDisagree(Witness::Wide));
    let [single, _] = Check::of(Derivatives).samples(40).run();
    refused(&single, Reason::Disagree(Witness::Adjoint, Witness::Wide));
    assert!(single.to_string().contains("remedy"), "{single}");
}

#[test]
fn thin_boxes_are_accepted() {
    // A thousandth wide, fifty long, from a hundred-millionth to a hundredth of a turn from parallel; and nested ones.
    let mut score = Check::of(IouObb2).hard(0).samples(0);
    let mut area = Check::of(IntersectionAreaObb2).hard(0).samples(0);
    let plan = Sampling::new(1, planted::SEED);
    for i in 0..40 {
        let mut d = plan.draw(i);
        let (x, y, heading) = (
            d.within(-10.0, 10.0),
            d.within(-10.0, 10.0),
            d.within(-3.0, 3.0),
        );
        let (tilt, side) = (d.magnitude(1e-8, 1e-2), d.magnitude(1e-6, 2e-3));
        let (along, (sin, cos)) = (d.within(-20.0, 20.0), heading.sin_cos());
        let (there, up) = (x + along * cos - side * sin, y + along * sin + side * cos);
        let long = Obb2::new(x, y, 50.0, 1e-3, heading);
        let other = Obb2::new(there, up, 50.0, 1e-3, heading + tilt);
        let (length, width) = (d.magnitude(1e-2, 40.0), d.magnitude(1e-4, 9e-4));
        let inner = Obb2::new(x, y, length, width, heading + d.within(-1e-6, 1e-6));
        score = score
            .and((long, other))
            .and((long, inner))
            .and((inner, long));
        area = area.and((long, other));
    }
    for report in score.run().iter().chain(&area.run()) {
        assert!(report.passed(), "{report}");
    }
}

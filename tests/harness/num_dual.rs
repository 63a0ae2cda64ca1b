//! num-dual's own numbers as a witness of derivatives by hand: a mistake that the derivative shares with our duals,
//! or that is one of the numbers themselves, is seen.
use crate::planted;

use geograd::ad::check::verdict::{PAIRS, Reason, Witness};
use geograd::check::{Check, Report};
use geograd::kernels::check::{check, check_fold_with};
use geograd::{Jet, Program, Scalar, Sym, Vec2, generic_check, operation};
use geograd_tests::rows::ring::SignedArea;
use geograd_tests::rows::{AreaTriangle, IofAabb2};
use planted::{BY_DUALS, points, refused, smooth, smooth_derivatives};
use std::any::TypeId;

const BY_NUM_DUAL: Reason = Reason::Disagree(Witness::Adjoint, Witness::NumDual);

/// How many derivatives were compared with num-dual's.
fn compared(report: &Report) -> u64 {
    let place = PAIRS.iter().position(|pair| pair.1 == Witness::NumDual);
    report.worst[place.unwrap()].count
}

/// The same value, and derivatives off by a thousandth if the scalar is of one kind.
fn spoilt<S: Scalar, T: 'static>(x: S) -> S {
    match TypeId::of::<S>() == TypeId::of::<T>() {
        true => x.damp(<S::Primal as Scalar>::lit(0.999)),
        false => x,
    }
}

#[test]
fn a_mistake_that_our_duals_share() {
    type Ours = Jet<f64, 1>;
    let wrong = |x| smooth_derivatives(x).map(|derivative| 0.999 * derivative);
    let check = || {
        let dual = |x| spoilt::<Ours, Ours>(smooth(x));
        points().value(smooth).dual(dual).gradient(wrong)
    };
    let report = check().num_dual(smooth).run();
    refused(&report, BY_NUM_DUAL);
    assert!(!report.refused_for(BY_DUALS), "{report}");
    // No other witness sees a term that changes the value by less than its rounding.
    fn little<S: Scalar>(x: S) -> S {
        S::lit(1e9) + x * x * S::lit(1e-9)
    }
    let at = || {
        let check = Check::at(0.7).value(little).gradient(|x| 0.999 * 2e-9 * x);
        check.dual(|x| spoilt::<Ours, Ours>(little(x)))
    };
    assert!(at().run().passed());
    refused(&at().num_dual(little).run(), BY_NUM_DUAL);
}

#[test]
fn macros_ask_it() {
    let report = generic_check!(smooth, at [0.7, 0.4])
        .gradient(smooth_derivatives)
        .run();
    assert!(report.passed() && compared(&report) == 2, "{report}");
    assert!(
        report.details().contains("num-dual"),
        "{}",
        report.details()
    );
    let wrong = |x| smooth_derivatives(x).map(|derivative| 1.001 * derivative);
    let report = generic_check!(smooth, at [0.7, 0.4]).gradient(wrong).run();
    refused(&report, BY_NUM_DUAL);
    assert!(
        report.to_string().contains("num-dual's numbers"),
        "{report}"
    );
}

#[test]
fn long_inputs_are_projected() {
    fn sines<S: Scalar>(x: Vec<S>) -> S {
        x.iter().fold(S::zero(), |sum, x| sum + x.sin())
    }
    let x: Vec<f64> = (0..100).map(|i| f64::from(i) / 50.0).collect();
    let check = || generic_check!(sines, at x.clone());
    let cosines = |x: Vec<f64>| x.iter().map(|x| x.cos()).collect();
    let report = check().gradient(cosines).run();
    assert!(report.passed() && compared(&report) > 0, "{report}");
    let wrong = |x: Vec<f64>| x.iter().map(|x| 1.001 * x.cos()).collect();
    refused(&check().gradient(wrong).run(), BY_NUM_DUAL);
}

operation! {
    /// The square of a number, which num-dual's numbers take to have another derivative.
    pub Spoilt = "spoilt": (x: S) -> S {
        let square = x * x;
        let square = spoilt::<S, num_dual::Dual<f32>>(square);
        spoilt::<S, num_dual::Dual<f64>>(square)
    }
    invariances []
    jumps Never
    derivative ByHand |x, bar| { (x * x, x * bar * S::lit(2.0)) }
}

operation! {
    /// The square of a number, with a derivative that differences cannot tell from the right one.
    pub Nearly = "nearly": (x: S) -> S { x * x }
    invariances []
    jumps Never
    derivative ByHand |x, bar| { (x * x, x * bar * S::lit(2.0 + 1e-11)) }
}

#[test]
fn duals_are_strict_where_nothing_ties() {
    let report = check::<Nearly, f64>(20, 1);
    refused(&report, BY_DUALS);
    refused(&report, BY_NUM_DUAL);
}

#[test]
fn a_scalar_that_differs_is_found() {
    for report in Check::of(Spoilt).samples(20).run() {
        refused(&report, BY_NUM_DUAL);
        assert!(!report.refused_for(BY_DUALS), "{report}");
    }
}

#[test]
fn derivatives_by_hand_are_asked() {
    let report = check::<IofAabb2, f64>(5, 1);
    assert!(report.passed() && compared(&report) > 0, "{report}");
    let report = check_fold_with::<SignedArea, f32>(&geograd::ad::check::Sampling::new(5, 1));
    assert!(report.passed() && compared(&report) > 0, "{report}");
    // A recorded operation has no derivative by hand.
    assert_eq!(compared(&check::<AreaTriangle, f64>(5, 1)), 0);
    let norm = Program::trace(|v: Vec2<Sym<f64>>| v.x.hypot(v.y)).unwrap();
    let check = || Check::at(Vec2::new(3.0, 4.0));
    assert_eq!(compared(&check().program(&norm).run()), 0);
    let by_hand = norm
        .with_adjoint(|v: Vec2<Sym<f64>>| {
            let length = v.x.hypot(v.y);
            Vec2::new(v.x.over(length), v.y.over(length))
        })
        .unwrap();
    let report = check().program(&by_hand).run();
    assert!(report.passed() && compared(&report) == 2, "{report}");
}

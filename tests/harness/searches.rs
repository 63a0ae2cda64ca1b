//! Derivatives of searches that may jump anywhere, whose comparisons change with roundings at every step.
use geograd::ad::check::Sampling;
use geograd::ad::check::verdict::{Reason, Witness};
use geograd::kernels::check::check_search_with;
use geograd::kernels::op::{Declared, Declares, Jumps};
use geograd::kernels::search::{HintedSearch, Search};
use geograd::{Real, Scalar, Segment3, Vec3};

/// Compares numbers that decide nothing: some whose order is that of roundings, and two equal ones.
fn idle<S: Scalar<Mask = bool>>(x: S) {
    let mut y = x;
    for _ in 0..40 {
        y = (y * S::lit(1e3)).sin();
        let _ = y.below(S::zero());
    }
    let _ = S::zero().equals(S::zero());
}

/// The direction from a point to the nearer end of a segment.
#[derive(Clone, Copy, Debug, Default)]
struct TowardEnd<const FROZEN: bool>;

impl<const FROZEN: bool> Declares for TowardEnd<FROZEN> {
    const DECLARED: Declared = Declared::new("toward_end", &[], Jumps::Anywhere);
}

impl<const FROZEN: bool> Search for TowardEnd<FROZEN> {
    type In<S: Scalar> = (Vec3<S>, Segment3<S>);
    type Out<S: Scalar> = Vec3<S>;
    type Record = bool;
    fn decide<S: Scalar<Mask = bool>>((point, segment): Self::In<S>) -> bool {
        idle(point.x);
        let [a, b] = [segment.start, segment.end].map(|end| (end - point).length_squared());
        b.below(a)
    }
    fn replay<S: Scalar>((point, segment): Self::In<S>, is_end: bool) -> Vec3<S> {
        let end = if is_end { segment.end } else { segment.start };
        let way = end - point;
        let length = way.length();
        let none = length.at_most(S::zero());
        let unit = way * S::one().over(S::select(none, S::one(), length));
        match FROZEN {
            true => Vec3::new(
                S::from_primal(unit.x.primal()),
                S::from_primal(unit.y.primal()),
                S::from_primal(unit.z.primal()),
            ),
            false => unit,
        }
    }
}

/// The square root of one and the square of a number, by Newton steps whose sign may be wrong.
#[derive(Clone, Copy, Debug, Default)]
struct Root<const TURNED: bool>;

impl<const TURNED: bool> Declares for Root<TURNED> {
    const DECLARED: Declared = Declared::new("root", &[], Jumps::Anywhere).by_roundings(true);
}

impl<const TURNED: bool> HintedSearch for Root<TURNED> {
    type In<S: Scalar> = S;
    type Out<S: Scalar> = S;
    type Record = ();
    type Hints<S: Scalar> = [S; 1];
    fn decide_with_hints<S: Scalar<Mask = bool>>(x: S) -> ((), [S; 1]) {
        idle(x);
        ((), [(x * x + S::one()).root()])
    }
    fn replay_with_hints<S: Scalar>(x: S, (): (), [root]: [S; 1]) -> S {
        // Two steps make derivatives of both orders right.
        (0..2).fold(root, |root, _| {
            let step = (root * root - (x * x + S::one())).over(root + root);
            if TURNED { root + step } else { root - step }
        })
    }
}

fn plan() -> Sampling<'static> {
    Sampling {
        hard: 3,
        ..Sampling::new(30, 7)
    }
}

/// Judges a search in a format.
fn judged<D: HintedSearch, S: Real>() -> geograd::ad::check::Report
where
    D::In<f64>: geograd::ad::check::sample::Sample,
    D::Out<f64>: geograd::ad::check::sample::Sample,
{
    check_search_with::<D, S>(&plan())
}

#[test]
fn right_derivatives_are_accepted_and_judged_by_differences() {
    for report in [
        judged::<TowardEnd<false>, f64>(),
        judged::<TowardEnd<false>, f32>(),
        judged::<Root<false>, f64>(),
        judged::<Root<false>, f32>(),
    ] {
        assert!(report.passed(), "{report}");
        let [smooth, _, undefined] = report.directions;
        assert!(smooth > 2 * undefined, "{report} {:?}", report.directions);
    }
}

#[test]
fn frozen_and_turned_derivatives_are_refused_by_differences() {
    if !geograd_tests::is_due("frozen_and_turned_derivatives_are_refused_by_differences") {
        return;
    }
    let by_differences = Reason::Disagree(Witness::Adjoint, Witness::Difference);
    for report in [
        judged::<TowardEnd<true>, f64>(),
        judged::<TowardEnd<true>, f32>(),
        judged::<Root<true>, f64>(),
    ] {
        assert!(report.refused_for(by_differences), "{report}");
    }
}

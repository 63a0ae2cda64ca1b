//! The harness itself: at an exact tie any element between the derivatives of both sides is right, and nothing else.
use crate::planted;

use geograd::ad::check::verdict::Reason;
use geograd::check::Check;
use geograd::kernels::Area;
use geograd::{Capsule2, Jet, Scalar, Triangle2, Vec2, operation};
use planted::{BY_DUALS, refused};

type Input<S> = (Vec2<S>, Capsule2<S>);

fn clearance<S: Scalar>((point, capsule): Input<S>) -> S {
    (point - capsule.segment().nearest(point)).length() - capsule.radius
}

/// Derivatives of the clearance; the foot of the point has so much of each end where these coincide.
fn derivatives<S: Scalar>((point, capsule): Input<S>, at_tie: [f64; 2], bar: S) -> Input<S> {
    let (arm, along) = (point - capsule.from, capsule.to - capsule.from);
    let square = along.dot(along);
    let tied = square.at_most(S::zero());
    let t = arm.dot(along).over(S::select(tied, S::one(), square));
    let t = t.clamp(S::zero(), S::one());
    let share = |end: usize, free: S| S::select(tied, S::lit(at_tie[end]), free);
    let (from, to) = (share(0, S::one() - t), share(1, t));
    let off = arm - along * t;
    let length = off.length();
    let none = length.at_most(S::zero());
    let inverse = S::one().over(S::select(none, S::one(), length));
    let normal = off * S::select(none, S::zero(), inverse * bar);
    let capsule = Capsule2::new(-normal * from, -normal * to, -bar);
    (normal, capsule)
}

/// A point above a capsule of length zero, and so little beside it that steps hardly see the kink.
fn above(beside: f64) -> Check<'static, Input<f64>> {
    let ends = Vec2::new(0.3, 0.7);
    let point = ends + Vec2::new(beside, 1.0);
    Check::at((point, Capsule2::new(ends, ends, 0.25))).value(clearance)
}
const BESIDE: [f64; 5] = [1e-6, 1e-5, 2e-4, 1e-3, 0.1];

#[test]
fn all_weight_to_the_first_end() {
    for beside in BESIDE {
        let check = || above(beside).dual(clearance::<Jet<f64, 1>>);
        for share in [[1.0, 0.0], [0.0, 1.0], [0.25, 0.75]] {
            check()
                .gradient(move |x| derivatives(x, share, 1.0))
                .assert();
        }
    }
}

#[test]
fn too_much_weight() {
    for beside in BESIDE {
        let check = || above(beside).dual(clearance::<Jet<f64, 1>>);
        for share in [[1.0, 1.0], [0.0, 0.0], [1.5, -0.5], [1.0, 0.01]] {
            let report = check().gradient(move |x| derivatives(x, share, 1.0)).run();
            assert!(!report.passed(), "{beside}, {share:?}\n{report}");
        }
    }
}

macro_rules! capsule {
    ($Name:ident, $share:expr) => {
        operation! {
            /// The clearance of a point from a capsule.
            pub $Name = "clearance": (point: Vec2<S>, capsule: Capsule2<S>) -> S {
                clearance((point, capsule))
            }
            invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
            jumps Never
            derivative ByHand |input, bar| { (clearance(input), derivatives(input, $share, bar)) }
        }
    };
}
capsule!(FirstEnd, [1.0, 0.0]);
capsule!(BothEnds, [1.0, 1.0]);

#[test]
fn an_operation_may_choose() {
    Check::of(FirstEnd).samples(40).assert();
    // Unless the duals' way of sharing is asked for.
    let [_, double] = Check::of(FirstEnd).samples(40).shared_ties().run();
    refused(&double, BY_DUALS);
    let [_, double] = Check::of(BothEnds).samples(40).run();
    refused(&double, BY_DUALS);
}

operation! {
    /// The larger of two numbers.
    pub First = "first": (x: S, y: S) -> S { x.most(y) }
    invariances [Exchange Stays]
    jumps Never
    derivative ByHand |(x, y), bar| {
        let first = y.at_most(x);
        let zero = S::zero();
        (x.most(y), (S::select(first, bar, zero), S::select(first, zero, bar)))
    }
    /// The same, and both at a tie.
    pub Both = "both": (x: S, y: S) -> S { x.most(y) }
    invariances [Exchange Stays]
    jumps Never
    derivative ByHand |(x, y), bar| {
        let zero = S::zero();
        (x.most(y), (S::select(y.at_most(x), bar, zero), S::select(x.at_most(y), bar, zero)))
    }
}

#[test]
fn an_element_need_not_be_the_same_exchanged() {
    Check::of(First).samples(40).assert();
    let [_, double] = Check::of(Both).samples(40).run();
    let reasons = [BY_DUALS, Reason::OutsideKink];
    assert!(
        reasons.iter().any(|&reason| double.refused_for(reason)),
        "{double}"
    );
}

/// A recorded row counts its own comparisons alone: inputs drawn at random are no ties of it.
#[test]
fn no_comparison_is_made_up() {
    let [_, double] = Check::of(Area.row::<Triangle2<f64>>()).hard(0).run();
    assert!(double.margin > 0.0 && double.margin.is_finite(), "{double}");
}

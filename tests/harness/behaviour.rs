//! The harness itself: planted faults of behaviour (seeds, purity, ties, second derivatives, invariances,
//! further witnesses) are refused for the right reason.
use crate::planted;

use geograd::Aabb2;
use geograd::Scalar;
use geograd::ad;
use geograd::ad::check::subject::Conventions;
use geograd::ad::check::symmetry::Effect;
use geograd::ad::check::symmetry::Invariance;
use geograd::ad::check::symmetry::Kind;
use geograd::ad::check::symmetry::Motion;
use geograd::ad::check::trace::Traced;
use geograd::ad::check::verdict::Reason;
use geograd::ad::check::verdict::Witness;
use geograd::ad::check::{Bent, Check};
use planted::{BY_DIFFERENCES, BY_DUALS, SEED, points, refused, smooth, smooth_derivatives};
use std::cell::Cell;

#[test]
fn squared_seed() {
    let wrong = |x: [f64; 2], s: &[f64]| smooth_derivatives(x).map(|g| g * s[0] * s[0]);
    refused(
        &points().value(smooth).adjoint(wrong).run(),
        Reason::NotLinear,
    );
}
#[test]
fn seed_forgotten() {
    let wrong = |x: [f64; 2], _: &[f64]| smooth_derivatives(x);
    refused(
        &points().value(smooth).adjoint(wrong).run(),
        Reason::NotLinear,
    );
}
#[test]
fn sign_of_the_seed_forgotten() {
    let wrong = |x: [f64; 2], s: &[f64]| smooth_derivatives(x).map(|g| g * s[0].abs());
    refused(
        &points().value(smooth).adjoint(wrong).run(),
        Reason::NotLinear,
    );
}
#[test]
fn impure_gradient() {
    let calls = Cell::new(0.0);
    let wrong = |x: [f64; 2]| {
        calls.set(calls.get() + 1e-15);
        smooth_derivatives(x).map(|g| g + calls.get())
    };
    let report = points().value(smooth).gradient(wrong).run();
    refused(&report, Reason::Impure(Witness::Adjoint));
}
#[test]
fn accumulator_not_cleared() {
    let sum = Cell::new([0.0; 2]);
    let wrong = |x: [f64; 2]| {
        let g = smooth_derivatives(x);
        sum.set([sum.get()[0] + g[0], sum.get()[1] + g[1]]);
        sum.get()
    };
    let report = points().value(smooth).gradient(wrong).run();
    refused(&report, Reason::Impure(Witness::Adjoint));
}
#[test]
fn impure_value() {
    let calls = Cell::new(0_u32);
    let value = |x: [f64; 2]| {
        calls.set(calls.get() + 1);
        smooth(x) + f64::from(calls.get() % 7) * 1e-15
    };
    let report = points().value(value).gradient(smooth_derivatives).run();
    refused(&report, Reason::Impure(Witness::Value));
}
#[test]
fn stale_decision() {
    // Which side won is remembered from the first input.
    fn larger<S: Scalar>([x, y]: [S; 2]) -> S {
        x.most(y) * x
    }
    let first: Cell<Option<bool>> = Cell::new(None);
    let wrong = |[x, y]: [f64; 2]| {
        if first.get().is_none() {
            first.set(Some(x > y));
        }
        if first.get() == Some(true) {
            [2.0 * x, 0.0]
        } else {
            [y, x]
        }
    };
    let report = points().value(larger).dual(larger).gradient(wrong).run();
    refused(&report, BY_DUALS);
    refused(&report, BY_DIFFERENCES);
}
#[test]
fn stale_decision_near_the_kink() {
    fn larger<S: Scalar>([x, y]: [S; 2]) -> S {
        x.most(y)
    }
    let check = || {
        Check::at([1.0, 1.0 - 1e-5])
            .value(larger)
            .gradient(|_| [0.0, 1.0])
    };
    refused(&check().traced(larger).run(), BY_DIFFERENCES);
    refused(&check().run(), BY_DIFFERENCES);
}
#[test]
fn wrong_tie_counts_twice() {
    fn larger<S: Scalar>([x, y]: [S; 2]) -> S {
        x.most(y)
    }
    let wrong = |[x, y]: [f64; 2]| [f64::from(x >= y), f64::from(y >= x)];
    let report = Check::at([1.0, 1.0])
        .value(larger)
        .traced(larger)
        .gradient(wrong)
        .run();
    refused(&report, Reason::OutsideKink);
}
#[test]
fn wrong_tie_counts_nowhere() {
    let wrong = |[x, y]: [f64; 2]| [f64::from(x > y), f64::from(y > x)];
    let report = Check::at([1.0, 1.0])
        .value(|[x, y]: [f64; 2]| x.max(y))
        .gradient(wrong)
        .run();
    refused(&report, Reason::OutsideKink);
}
#[test]
fn tie_of_duals_and_hand_differ() {
    // Both are between the sides, but they are two conventions.
    fn larger<S: Scalar>([x, y]: [S; 2]) -> S {
        x.most(y)
    }
    let wrong = |[x, y]: [f64; 2]| [f64::from(x >= y), f64::from(x < y)];
    let check = || {
        let at = Check::at([1.0, 1.0]).and([2.0, 1.0]);
        at.value(larger).dual(larger).gradient(wrong)
    };
    // Any convention passes, unless one is required.
    let report = check().run();
    assert!(report.passed() && report.conventions == 1, "{report}");
    let shared = Conventions {
        shared_ties: true,
        ..Conventions::default()
    };
    refused(&check().conventions(shared).run(), BY_DUALS);
}
#[test]
fn derivative_outside_at_zero() {
    let wrong = |x: f64| if x >= 0.0 { 1.0 } else { -3.0 } * if x == 0.0 { 1.5 } else { 1.0 };
    let report = Check::at(0.0).value(|x: f64| x.abs()).gradient(wrong).run();
    refused(&report, Reason::OutsideKink);
}
#[test]
fn not_a_number_at_a_tie() {
    let wrong = |[x, y]: [f64; 2]| {
        let r = (x * x + y * y).sqrt();
        [x / r, y / r]
    };
    let norm = |[x, y]: [f64; 2]| x.hypot(y);
    let report = Check::at([0.0, 0.0]).value(norm).gradient(wrong).run();
    refused(&report, Reason::NotFinite(Witness::Adjoint));
}
#[test]
fn not_a_number_in_the_value() {
    let report = Check::at(0.0)
        .value(|x: f64| x.sin() / x)
        .gradient(|_| 0.0)
        .run();
    refused(&report, Reason::NotFinite(Witness::Value));
}
#[test]
fn infinite_by_duals() {
    let root = |x: geograd::Jet<f64, 1>| geograd::Jet {
        value: x.value.sqrt(),
        derivative: [x.derivative[0] / (2.0 * x.value.sqrt())],
    };
    let report = Check::at(0.0)
        .value(|x: f64| x.sqrt())
        .dual(root)
        .gradient(|_| 0.0)
        .run();
    refused(&report, Reason::NotFinite(Witness::Dual));
}
#[test]
fn undeclared_jump() {
    let report = Check::at(1.0)
        .value(|x: f64| x.floor())
        .gradient(|_| 0.0)
        .run();
    refused(&report, Reason::Jump);
}
#[test]
fn wrong_length() {
    let report = Check::at(vec![1.0, 2.0])
        .value(|x: Vec<f64>| x[0] * x[1])
        .gradient(|x| vec![x[1]])
        .run();
    refused(&report, Reason::WrongLength(Witness::Adjoint));
}
#[test]
fn right_derivative_wrong_hessian() {
    let cube = |x: f64| x * x * x;
    let check = || {
        Check::at(1.3)
            .and(-0.4)
            .value(cube)
            .gradient(|x| 3.0 * x * x)
    };
    check().hessian_times(|x, v| 6.0 * x * v).assert();
    let report = check().hessian_times(|x, v| 3.0 * x * v).run();
    refused(&report, Reason::CurvatureDisagrees(Witness::Difference));
}
#[test]
fn right_derivative_wrong_hessian_in_single() {
    let check = || {
        Check::at([1.3_f32, 0.7])
            .and([-0.4, 1.9])
            .value(|[x, y]: [f32; 2]| x * x * x * y)
            .gradient(|[x, y]| [3.0 * x * x * y, x * x * x])
    };
    let right =
        |[x, y]: [f32; 2], [u, v]: [f32; 2]| [6.0 * x * y * u + 3.0 * x * x * v, 3.0 * x * x * u];
    check().hessian_times(right).assert();
    let report = check()
        .hessian_times(|x, [u, v]| right(x, [1.05 * u, 1.05 * v]))
        .run();
    refused(&report, Reason::CurvatureDisagrees(Witness::Difference));
}
#[test]
fn hessian_off_by_little() {
    // By a millionth: duals of duals say it to the last digits, in the own format and in double.
    let cube = |check: Check<'static, f32>, off: f32| {
        fn cube<S: Scalar>(x: S) -> S {
            x * x * x
        }
        let check = check.value(cube).gradient(|x| 3.0 * x * x);
        let check = check.hessian_times(move |x, v| 6.0 * x * v * (1.0 + off));
        (check.second_order(cube), cube::<Bent<Traced<f64>>>)
    };
    let points = || Check::among([1.3_f32, -0.4]);
    let (right, source) = cube(points(), 0.0);
    right.wide(source).assert();
    let (off, source) = cube(points(), 1e-4);
    let report = off.wide(source).run();
    refused(&report, Reason::CurvatureDisagrees(Witness::Dual));
    refused(&report, Reason::CurvatureDisagrees(Witness::Wide));
}
#[test]
fn right_in_double_wrong_in_single() {
    // The same source, but the adjoint subtracts what single precision cannot tell apart.
    fn bend<S: Scalar>([x, y]: [S; 2]) -> S {
        x * x * y + y.sin()
    }
    let points = || Check::at([1.3_f32, 0.7]).and([-0.4, 1.9]);
    let right = |[x, y]: [f32; 2]| [2.0 * x * y, x * x + y.cos()];
    let lossy = |[x, y]: [f32; 2]| {
        let far = x * x + 1e3;
        [2.0 * x * y, (far - 1e3) + y.cos()]
    };
    points().value(bend).wide(bend).gradient(right).assert();
    // Without the source in double precision single cannot see it.
    points().value(bend).gradient(lossy).assert();
    let report = points().value(bend).wide(bend).gradient(lossy).run();
    refused(&report, Reason::Disagree(Witness::Adjoint, Witness::Wide));
    assert_eq!(report.failures[0].fault.suspect, Some(Witness::Adjoint));
}
#[test]
fn another_value_in_single() {
    fn share<S: Scalar>(x: S) -> S {
        let far = S::lit(1e5);
        (x + far) - far
    }
    let report = Check::at(0.7_f32)
        .value(share)
        .wide(share)
        .gradient(|_| 1.0)
        .run();
    refused(&report, Reason::ValuesDisagree(Witness::Wide));
}
#[test]
fn hessian_not_symmetric() {
    let report = points()
        .value(|[x, y]: [f64; 2]| x * x * y)
        .gradient(|[x, y]| [2.0 * x * y, x * x])
        .hessian_times(|[x, y], [u, v]| [2.0 * y * u + 2.0 * x * v, x * u])
        .run();
    refused(&report, Reason::CurvatureNotSymmetric);
}
#[test]
fn other_path_has_another_value() {
    let other = |x: [f64; 2]| smooth(x) + 1e-9;
    let report = points()
        .value(smooth)
        .path(other)
        .gradient(smooth_derivatives)
        .run();
    refused(&report, Reason::ValuesDisagree(Witness::Further(0)));
}
#[test]
fn other_witness_disagrees() {
    let gpu = |x: [f64; 2], s: &[f64]| smooth_derivatives(x).map(|g| g * s[0] * 1.001);
    let report = points()
        .value(smooth)
        .gradient(smooth_derivatives)
        .witness(gpu)
        .run();
    refused(
        &report,
        Reason::Disagree(Witness::Adjoint, Witness::Further(0)),
    );
}
#[test]
fn broken_invariances() {
    let kinds = [Kind::X, Kind::Y];
    let invariance = [Invariance {
        motion: Motion::Rotation,
        answer: Effect::Stays,
    }];
    let round = |[x, y]: [f64; 2]| x * x + y * y;
    let square = |[x, y]: [f64; 2]| x * x + 1.01 * y * y;
    points()
        .value(round)
        .gradient(|x| x.map(|x| 2.0 * x))
        .invariances(&kinds, &invariance)
        .assert();
    let report = points()
        .value(square)
        .gradient(|[x, y]| [2.0 * x, 2.02 * y])
        .invariances(&kinds, &invariance)
        .run();
    refused(&report, Reason::MotionBroken(Motion::Rotation));
    refused(&report, Reason::MotionUnbalanced(Motion::Rotation));
}
#[test]
fn nothing_but_kinks() {
    let saw = |x: f64| x.abs();
    let report = Check::drawn(40, SEED, |_| 0.0)
        .value(saw)
        .gradient(|_| 0.0)
        .run();
    refused(&report, Reason::NothingSmooth);
}
#[test]
fn boxes_with_a_wrong_share() {
    // The whole derivative to the first of two equal boxes: only a tie shows it.
    let wrong = |(a, b): (Aabb2<f64>, Aabb2<f64>)| {
        let (mut da, mut db) = ad::adjoint::overlap::intersection_area_aabb2_vjp(a, b, 1.0);
        if a.max.x == b.max.x {
            da.max.x += db.max.x;
            db.max.x = 0.0;
        }
        (da, db)
    };
    let report = Check::random(50, SEED)
        .value(|(a, b): (Aabb2<f64>, Aabb2<f64>)| a.intersection_area(b))
        .dual(|(a, b): (Aabb2<_>, Aabb2<_>)| a.intersection_area(b))
        .conventions(Conventions {
            shared_ties: true,
            searches: false,
            ..Conventions::default()
        })
        .gradient(wrong)
        .run();
    refused(&report, BY_DUALS);
}

//! The harness itself: planted faults are refused for the right reason, difficult but correct
//! functions are accepted.
use geograd::ad::check::{Check, Plan, Report};
use geograd::ad::sample::Draw;
use geograd::ad::symmetry::{Answer, Kind, Motion, Promise};
use geograd::ad::verdict::{Reason, Witness};
use geograd::{Aabb2, Obb2, Scalar, Vec2, ad};
use std::cell::Cell;

const BY_DUALS: Reason = Reason::Disagree(Witness::Adjoint, Witness::Dual);
const BY_DIFFERENCES: Reason = Reason::Disagree(Witness::Adjoint, Witness::Difference);
const SEED: u64 = 7;
/// Random samples per planted fault.
const SAMPLES: usize = 60;

/// A smooth function of two numbers with nothing special about it.
fn smooth<S: Scalar>([x, y]: [S; 2]) -> S {
    x * x * y.sin() + (x * y).exp() * S::lit(0.25)
}
fn smooth_slopes([x, y]: [f64; 2]) -> [f64; 2] {
    let e = 0.25 * (x * y).exp();
    [2.0 * x * y.sin() + y * e, x * x * y.cos() + x * e]
}
fn points() -> Check<'static, [f64; 2]> {
    Check::drawn(SAMPLES, SEED, |d: &mut Draw| {
        [d.within(0.3, 1.7), d.within(0.2, 1.3)]
    })
}

#[track_caller]
fn refused(report: &Report, reason: Reason) {
    assert!(
        report.refused_for(reason),
        "not refused for {reason:?}:\n{report}"
    );
}

/// A planted fault in the gradient of [`smooth`], seen by duals and by differences alone.
#[track_caller]
fn planted(wrong: impl Fn([f64; 2]) -> [f64; 2]) {
    let with_duals = points()
        .value(smooth)
        .dual(smooth)
        .traced(smooth)
        .gradient(&wrong)
        .run();
    refused(&with_duals, BY_DUALS);
    refused(&with_duals, BY_DIFFERENCES);
    assert_eq!(with_duals.failures[0].fault.suspect, Some(Witness::Adjoint));
    refused(
        &points().value(smooth).gradient(&wrong).run(),
        BY_DIFFERENCES,
    );
}

#[test]
fn the_right_one_is_accepted() {
    points()
        .value(smooth)
        .dual(smooth)
        .traced(smooth)
        .gradient(smooth_slopes)
        .prove();
    points().value(smooth).gradient(smooth_slopes).prove();
}

#[test]
fn wrong_sign() {
    planted(|x| smooth_slopes(x).map(|g| -g));
}
#[test]
fn wrong_sign_of_one() {
    planted(|x| {
        let [a, b] = smooth_slopes(x);
        [a, -b]
    });
}
#[test]
fn wrong_factor() {
    planted(|x| smooth_slopes(x).map(|g| 2.0 * g));
}
#[test]
fn factor_off_by_a_millionth() {
    planted(|x| smooth_slopes(x).map(|g| g * (1.0 + 1e-6)));
}
#[test]
fn dropped_term() {
    planted(|[x, y]| {
        [
            2.0 * x * y.sin(),
            x * x * y.cos() + 0.25 * x * (x * y).exp(),
        ]
    });
}
#[test]
fn swapped_arguments() {
    planted(|x| {
        let [a, b] = smooth_slopes(x);
        [b, a]
    });
}
#[test]
fn missing_chain_factor() {
    planted(|[x, y]| {
        let e = 0.25 * (x * y).exp();
        [2.0 * x * y.sin() + e, x * x * y.cos() + e]
    });
}
#[test]
fn zero_gradient() {
    planted(|_| [0.0, 0.0]);
}
#[test]
fn sine_for_cosine() {
    planted(|[x, y]| {
        let e = 0.25 * (x * y).exp();
        [2.0 * x * y.sin() + y * e, x * x * y.sin() + x * e]
    });
}
#[test]
fn constant_added() {
    planted(|x| smooth_slopes(x).map(|g| g + 1e-5));
}
#[test]
fn wrong_point() {
    planted(|[x, y]| smooth_slopes([x + 1e-4, y]));
}
#[test]
fn differences_for_a_derivative() {
    // A derivative by differences of a fixed step is not one by hand.
    planted(|[x, y]| {
        let h = 1e-4;
        let f = |x, y| smooth([x, y]);
        [(f(x + h, y) - f(x, y)) / h, (f(x, y + h) - f(x, y)) / h]
    });
}
#[test]
fn wrong_in_a_corner_of_the_domain() {
    planted(|[x, y]| {
        let [a, b] = smooth_slopes([x, y]);
        if x > 1.4 && y > 1.0 {
            [a, 1.01 * b]
        } else {
            [a, b]
        }
    });
}
#[test]
fn rounding_times_a_thousand() {
    let wrong = |x| smooth_slopes(x).map(|g| g * (1.0 + 4e3 * f64::EPSILON));
    let report = points()
        .value(smooth)
        .dual(smooth)
        .traced(smooth)
        .gradient(wrong)
        .run();
    refused(&report, BY_DUALS);
}
#[test]
fn single_precision_inside() {
    let wrong = |x| smooth_slopes(x).map(|g| f64::from(g as f32));
    let report = points().value(smooth).dual(smooth).gradient(wrong).run();
    refused(&report, BY_DUALS);
}
#[test]
fn wrong_only_at_large_scale() {
    // Overflow handled by clamping what should not be clamped.
    fn product<S: Scalar>([x, y]: [S; 2]) -> S {
        x * x * y
    }
    let wrong = |[x, y]: [f64; 2]| [(2.0 * x * y).min(1e12), x * x];
    let small = Check::at([3.0, 2.0])
        .and([1e3, 1e3])
        .value(product)
        .gradient(wrong)
        .run();
    assert!(small.passed(), "{small}");
    let report = Check::at([1e7, 1e6])
        .value(product)
        .dual(product)
        .gradient(wrong)
        .run();
    refused(&report, BY_DUALS);
    refused(&report, BY_DIFFERENCES);
}
#[test]
fn wrong_only_at_small_scale() {
    // An absolute threshold.
    fn length<S: Scalar>([x, y]: [S; 2]) -> S {
        x.hypot(y)
    }
    let wrong = |[x, y]: [f64; 2]| {
        let r = x.hypot(y);
        if r < 1e-8 { [0.0, 0.0] } else { [x / r, y / r] }
    };
    let report = Check::at([3e-10, 4e-10])
        .value(length)
        .gradient(wrong)
        .run();
    refused(&report, BY_DIFFERENCES);
}
#[test]
fn transposed_jacobian() {
    fn f<S: Scalar>([x, y]: [S; 2]) -> [S; 2] {
        [x * x + y, x * y * y]
    }
    let right =
        |[x, y]: [f64; 2], s: &[f64]| [2.0 * x * s[0] + y * y * s[1], s[0] + 2.0 * x * y * s[1]];
    let wrong =
        |[x, y]: [f64; 2], s: &[f64]| [2.0 * x * s[0] + s[1], y * y * s[0] + 2.0 * x * y * s[1]];
    points().value(f).dual(f).adjoint(right).prove();
    let report = points().value(f).dual(f).adjoint(wrong).run();
    refused(&report, BY_DUALS);
    refused(&report, BY_DIFFERENCES);
}
#[test]
fn wrong_output_row() {
    fn f<S: Scalar>([x, y]: [S; 2]) -> [S; 2] {
        [x * y, x - y]
    }
    let wrong = |[x, y]: [f64; 2], s: &[f64]| [y * s[1] + s[0], x * s[1] - s[0]];
    refused(&points().value(f).dual(f).adjoint(wrong).run(), BY_DUALS);
}
#[test]
fn squared_seed() {
    let wrong = |x: [f64; 2], s: &[f64]| smooth_slopes(x).map(|g| g * s[0] * s[0]);
    refused(
        &points().value(smooth).adjoint(wrong).run(),
        Reason::NotLinear,
    );
}
#[test]
fn seed_forgotten() {
    let wrong = |x: [f64; 2], _: &[f64]| smooth_slopes(x);
    refused(
        &points().value(smooth).adjoint(wrong).run(),
        Reason::NotLinear,
    );
}
#[test]
fn sign_of_the_seed_forgotten() {
    let wrong = |x: [f64; 2], s: &[f64]| smooth_slopes(x).map(|g| g * s[0].abs());
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
        smooth_slopes(x).map(|g| g + calls.get())
    };
    let report = points().value(smooth).gradient(wrong).run();
    refused(&report, Reason::Impure(Witness::Adjoint));
}
#[test]
fn accumulator_not_cleared() {
    let sum = Cell::new([0.0; 2]);
    let wrong = |x: [f64; 2]| {
        let g = smooth_slopes(x);
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
    let report = points().value(value).gradient(smooth_slopes).run();
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
    refused(
        &Check::at([1.0, 1.0])
            .value(larger)
            .dual(larger)
            .gradient(wrong)
            .run(),
        BY_DUALS,
    );
}
#[test]
fn slope_outside_at_zero() {
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
        slope: [x.slope[0] / (2.0 * x.value.sqrt())],
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
fn right_slope_wrong_hessian() {
    let cube = |x: f64| x * x * x;
    let check = || {
        Check::at(1.3)
            .and(-0.4)
            .value(cube)
            .gradient(|x| 3.0 * x * x)
    };
    check().hessian_times(|x, v| 6.0 * x * v).prove();
    let report = check().hessian_times(|x, v| 3.0 * x * v).run();
    refused(&report, Reason::CurvatureDisagrees(Witness::Difference));
}
#[test]
fn right_slope_wrong_hessian_in_single() {
    let check = || {
        Check::at([1.3_f32, 0.7])
            .and([-0.4, 1.9])
            .value(|[x, y]: [f32; 2]| x * x * x * y)
            .gradient(|[x, y]| [3.0 * x * x * y, x * x * x])
    };
    let right =
        |[x, y]: [f32; 2], [u, v]: [f32; 2]| [6.0 * x * y * u + 3.0 * x * x * v, 3.0 * x * x * u];
    check().hessian_times(right).prove();
    let report = check()
        .hessian_times(|x, [u, v]| right(x, [1.05 * u, 1.05 * v]))
        .run();
    refused(&report, Reason::CurvatureDisagrees(Witness::Difference));
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
fn right_in_double_wrong_in_single() {
    // A threshold that suits 53 bits and not 24.
    let value = |[x, y]: [f32; 2]| x / y;
    let wrong = |[x, y]: [f32; 2]| [1.0 / y, -x / (y * y + 1e-3)];
    let report = Check::at([1.0_f32, 0.02])
        .value(value)
        .gradient(wrong)
        .run();
    refused(&report, BY_DIFFERENCES);
}
#[test]
fn other_path_has_another_value() {
    let other = |x: [f64; 2]| smooth(x) + 1e-9;
    let report = points()
        .value(smooth)
        .path(other)
        .gradient(smooth_slopes)
        .run();
    refused(&report, Reason::ValuesDisagree(Witness::Further(0)));
}
#[test]
fn other_witness_disagrees() {
    let gpu = |x: [f64; 2], s: &[f64]| smooth_slopes(x).map(|g| g * s[0] * 1.001);
    let report = points()
        .value(smooth)
        .gradient(smooth_slopes)
        .witness(gpu)
        .run();
    refused(
        &report,
        Reason::Disagree(Witness::Adjoint, Witness::Further(0)),
    );
}
#[test]
fn broken_promises() {
    let kinds = [Kind::X, Kind::Y];
    let promise = [Promise {
        motion: Motion::Rotation,
        answer: Answer::Stays,
    }];
    let round = |[x, y]: [f64; 2]| x * x + y * y;
    let square = |[x, y]: [f64; 2]| x * x + 1.01 * y * y;
    points()
        .value(round)
        .gradient(|x| x.map(|x| 2.0 * x))
        .promises(&kinds, &promise)
        .prove();
    let report = points()
        .value(square)
        .gradient(|[x, y]| [2.0 * x, 2.02 * y])
        .promises(&kinds, &promise)
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
fn line_distance_of_the_seed_library() {
    fn distance<S: Scalar>([a, b, c, x, y]: [S; 5]) -> S {
        (a * x + b * y + c).over((a * a + b * b).root())
    }
    let wrong = |[a, b, _, x, y]: [f64; 5]| {
        let n = a.hypot(b);
        [
            a * y * y / n.powi(3),
            b * x * x / n.powi(3),
            1.0 / n,
            a / n,
            b / n,
        ]
    };
    let lines = |d: &mut Draw| std::array::from_fn(|_| d.within(-2.0, 2.0));
    let report = Check::drawn(20, SEED, lines)
        .value(distance)
        .dual(distance)
        .gradient(wrong)
        .run();
    refused(&report, BY_DUALS);
    refused(&report, BY_DIFFERENCES);
}
#[test]
fn boxes_with_a_wrong_share() {
    // The whole slope to the first of two equal boxes: only a tie shows it.
    let wrong = |(a, b): (Aabb2<f64>, Aabb2<f64>)| {
        let (mut da, mut db) = ad::overlap::intersection_area_aabb2_vjp(a, b, 1.0);
        if a.max.x == b.max.x {
            da.max.x += db.max.x;
            db.max.x = 0.0;
        }
        (da, db)
    };
    let report = Check::random(50, SEED)
        .value(|(a, b): (Aabb2<f64>, Aabb2<f64>)| a.intersection_area(b))
        .dual(|(a, b): (Aabb2<_>, Aabb2<_>)| a.intersection_area(b))
        .gradient(wrong)
        .run();
    refused(&report, BY_DUALS);
}
#[test]
fn boxes_without_the_heading() {
    let wrong = |(a, b): (Obb2<f64>, Obb2<f64>)| {
        let (mut da, db) = ad::overlap::iou_obb2_vjp(a, b, 1.0);
        da.heading = -db.heading;
        (da, db)
    };
    let conventions = ad::subject::Conventions {
        flat: true,
        jumps: ad::subject::Jumps::FromZero,
    };
    let check = || {
        Check::random(50, SEED)
            .value(|(a, b): (Obb2<f64>, Obb2<f64>)| a.iou(b))
            .traced(|(a, b): (Obb2<_>, Obb2<_>)| a.iou(b))
            .conventions(conventions)
    };
    refused(&check().gradient(wrong).run(), BY_DIFFERENCES);
    let right = check()
        .gradient(|(a, b)| ad::overlap::iou_obb2_vjp(a, b, 1.0))
        .run();
    assert!(right.passed(), "{right}");
}
#[test]
fn a_long_input_with_one_wrong_number() {
    let value = |x: Vec<f64>| x.iter().map(|x| x.sin()).sum::<f64>();
    let right = |x: Vec<f64>| x.iter().map(|x| x.cos()).collect::<Vec<f64>>();
    let wrong = |x: Vec<f64>| {
        let mut g = right(x);
        g[137] *= 1.1;
        g
    };
    let point = || {
        (0..200)
            .map(|i| 0.3 + 0.01 * f64::from(i))
            .collect::<Vec<f64>>()
    };
    Check::at(point()).value(value).gradient(right).prove();
    refused(
        &Check::at(point()).value(value).gradient(wrong).run(),
        BY_DIFFERENCES,
    );
}

/// Correct but difficult functions.
mod difficult {
    use super::*;

    macro_rules! accepted {
        ($name:ident: $f:expr, $gradient:expr, [$($at:expr),+ $(,)?]) => {
            #[test]
            fn $name() {
                Check::among([$($at),+]).value($f).gradient($gradient).prove();
            }
        };
    }

    accepted!(high_curvature: |x: f64| (1e4 * x).sin(), |x: f64| 1e4 * (1e4 * x).cos(), [0.3, 1.7, -2.2]);
    accepted!(narrow_peak: |x: f64| (-(x / 1e-5).powi(2)).exp(),
        |x: f64| -2.0 * x / 1e-10 * (-(x / 1e-5).powi(2)).exp(), [1e-5, 3e-6, 0.0]);
    accepted!(cancellation: |x: f64| (x + 1e8) - 1e8 + x * x, |x: f64| 1.0 + 2.0 * x, [0.7, 1.9]);
    accepted!(cosine_of_little: |x: f64| 1.0 - x.cos(), |x: f64| x.sin(), [1e-6, 1e-4, 0.5]);
    accepted!(tiny_scale: |x: f64| x * x * x, |x: f64| 3.0 * x * x, [1e-50, -3e-80]);
    accepted!(huge_scale: |x: f64| x * x * x, |x: f64| 3.0 * x * x, [1e50, -3e80]);
    accepted!(mixed_scales: |[x, y]: [f64; 2]| x * y, |[x, y]: [f64; 2]| [y, x], [[1e6, 1e-6], [3e-9, 2e4]]);
    accepted!(saturating: |x: f64| x.tanh(), |x: f64| 1.0 / x.cosh().powi(2), [0.1, 5.0, 15.0, 40.0]);
    accepted!(logistic: |x: f64| 1.0 / (1.0 + (-x).exp()),
        |x: f64| { let s = 1.0 / (1.0 + (-x).exp()); s * (1.0 / (1.0 + x.exp())) }, [-30.0, -2.0, 0.0, 3.0, 30.0]);
    accepted!(kinked_at_zero: |x: f64| x.abs(), |x: f64| if x == 0.0 { 0.0 } else { x.signum() }, [0.0, 1e-9, -1e-12, 2.0]);
    accepted!(kinked_close_by: |x: f64| (x - 1.0).max(0.0), |x: f64| f64::from(x > 1.0),
        [1.0, 1.0 + 1e-3, 1.0 - 1e-3, 1.0 + 1e-6, 1.0 - 1e-6, 1.0 + 1e-10, 1.0 - 1e-13]);
    accepted!(norm_at_zero: |[x, y]: [f64; 2]| x.hypot(y),
        |[x, y]: [f64; 2]| { let r = x.hypot(y); if r == 0.0 { [0.0; 2] } else { [x / r, y / r] } },
        [[0.0, 0.0], [3e-200, 4e-200], [3.0, 4.0]]);
    accepted!(bend_without_kink: |x: f64| if x > 0.0 { x * x } else { 0.0 },
        |x: f64| if x > 0.0 { 2.0 * x } else { 0.0 }, [0.0, 1e-5, -1e-5, 1e-9, 1.0]);
    accepted!(constant: |_: f64| 3.0, |_: f64| 0.0, [0.0, 5.0]);
    accepted!(zero: |_: f64| 0.0, |_: f64| 0.0, [0.0, 5.0]);
    accepted!(single_precision: |[x, y]: [f32; 2]| (x * y).sin() / y,
        |[x, y]: [f32; 2]| [(x * y).cos(), (x * (x * y).cos() - (x * y).sin() / y) / y], [[1.0, 2.0], [0.3, 7.0]]);
    accepted!(far_from_the_origin: |[x, y]: [f64; 2]| (x - 1e5).powi(2) * (y - 1e5),
        |[x, y]: [f64; 2]| [2.0 * (x - 1e5) * (y - 1e5), (x - 1e5).powi(2)], [[1e5 + 1.0, 1e5 - 2.0]]);
    accepted!(rational_near_its_pole: |x: f64| 1.0 / x, |x: f64| -1.0 / (x * x), [1e-7, 1e-3, 1e9]);
    accepted!(oscillating: |x: f64| (1.0 / x).sin(), |x: f64| -(1.0 / x).cos() / (x * x), [0.01, 0.003]);

    #[test]
    fn infinite_slope_is_undefined() {
        let report = Check::at(0.0)
            .value(|x: f64| x.max(0.0).sqrt())
            .inside(|x| *x >= 0.0)
            .gradient(|x| if x > 0.0 { 0.5 / x.sqrt() } else { 0.0 })
            .run();
        assert!(report.passed(), "{report}");
        assert_eq!(report.places[0], 0, "{report}");
    }
    #[test]
    fn rings_of_any_length() {
        let area = |ring: Vec<Vec2<f64>>| geograd::ring::signed_area(&ring);
        Check::random(100, SEED)
            .value(area)
            .gradient(|ring: Vec<Vec2<f64>>| {
                let mut bar = vec![Vec2::zero(); ring.len()];
                ad::ring::signed_area_vjp(&ring, 1.0, &mut bar);
                bar
            })
            .prove();
    }
}

/// Sums of products of sines, exponentials and ratios with random coefficients: how often a right
/// gradient is refused, and how often one that is off by a small factor in one number is accepted.
#[test]
fn rates() {
    let (count, mut alarms, mut missed) = (1000, 0, 0);
    let plan = Plan::new(count, SEED);
    for i in 0..count {
        let mut d = plan.draw(i);
        let [a, b, c, e]: [f64; 4] = std::array::from_fn(|_| d.within(-2.0, 2.0));
        let value =
            move |[x, y]: [f64; 2]| a * (b * x * y).sin() + c * (e * x).exp() / (1.0 + y * y);
        let gradient = move |[x, y]: [f64; 2]| {
            let (cos, exp, d) = ((b * x * y).cos(), (e * x).exp(), 1.0 + y * y);
            [
                a * b * y * cos + c * e * exp / d,
                a * b * x * cos - 2.0 * y * c * exp / (d * d),
            ]
        };
        let point = [d.within(-2.0, 2.0), d.within(-2.0, 2.0)];
        let off = 1.0 + d.magnitude(1e-6, 1.0);
        let which = d.below(2);
        alarms += usize::from(
            !Check::at(point)
                .value(value)
                .gradient(gradient)
                .run()
                .passed(),
        );
        let wrong = move |x: [f64; 2]| {
            let mut g = gradient(x);
            g[which] *= off;
            g
        };
        missed += usize::from(Check::at(point).value(value).gradient(wrong).run().passed());
    }
    println!("{alarms} false alarms, {missed} missed faults in {count}");
    assert_eq!(alarms, 0);
    assert!(missed * 100 <= count, "{missed} of {count} faults missed");
}

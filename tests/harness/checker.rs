//! The harness itself: planted faults of derivatives are refused for the right reason.
use crate::planted;

use geograd::Obb2;
use geograd::Scalar;
use geograd::ad;
use geograd::ad::check::Check;
use geograd::ad::check::sample::Draw;
use geograd::ad::check::verdict::Witness;
use planted::{BY_DIFFERENCES, BY_DUALS, SEED, points, refused, smooth, smooth_derivatives};

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
        .gradient(smooth_derivatives)
        .assert();
    points().value(smooth).gradient(smooth_derivatives).assert();
}

#[test]
fn wrong_sign() {
    planted(|x| smooth_derivatives(x).map(|g| -g));
}
#[test]
fn wrong_sign_of_one() {
    planted(|x| {
        let [a, b] = smooth_derivatives(x);
        [a, -b]
    });
}
#[test]
fn wrong_factor() {
    planted(|x| smooth_derivatives(x).map(|g| 2.0 * g));
}
#[test]
fn factor_off_by_a_millionth() {
    planted(|x| smooth_derivatives(x).map(|g| g * (1.0 + 1e-6)));
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
        let [a, b] = smooth_derivatives(x);
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
    planted(|x| smooth_derivatives(x).map(|g| g + 1e-5));
}
#[test]
fn wrong_point() {
    planted(|[x, y]| smooth_derivatives([x + 1e-4, y]));
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
        let [a, b] = smooth_derivatives([x, y]);
        if x > 1.4 && y > 1.0 {
            [a, 1.01 * b]
        } else {
            [a, b]
        }
    });
}
#[test]
fn rounding_times_a_thousand() {
    let wrong = |x| smooth_derivatives(x).map(|g| g * (1.0 + 4e3 * f64::EPSILON));
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
    let wrong = |x| smooth_derivatives(x).map(|g| f64::from(g as f32));
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
    points().value(f).dual(f).adjoint(right).assert();
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
fn boxes_without_the_heading() {
    if !geograd_tests::is_due("boxes_without_the_heading") {
        return;
    }
    let wrong = |(a, b): (Obb2<f64>, Obb2<f64>)| {
        let (mut da, db) = ad::adjoint::overlap::iou_obb2_vjp(a, b, 1.0);
        da.heading = -db.heading;
        (da, db)
    };
    let conventions = ad::check::subject::Conventions {
        shared_ties: false,
        searches: false,
        flat: true,
        jumps: ad::check::subject::Jumps::FromZero,
    };
    let check = || {
        Check::random(50, SEED)
            .value(|(a, b): (Obb2<f64>, Obb2<f64>)| a.iou(b))
            .traced(|(a, b): (Obb2<_>, Obb2<_>)| a.iou(b))
            .conventions(conventions)
    };
    refused(&check().gradient(wrong).run(), BY_DIFFERENCES);
    let right = check()
        .gradient(|(a, b)| ad::adjoint::overlap::iou_obb2_vjp(a, b, 1.0))
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
    Check::at(point()).value(value).gradient(right).assert();
    refused(
        &Check::at(point()).value(value).gradient(wrong).run(),
        BY_DIFFERENCES,
    );
}

#[test]
fn refusals_say_derivatives() {
    // Without duals: differences are taken along an axis as long as the number is large, and what
    // is said is the derivative all the same.
    let report = Check::at([-0.4, 190.0])
        .value(|[x, y]: [f64; 2]| x * x * y)
        .gradient(|[x, y]| [2.0 * x * y, 1.01 * x * x])
        .run();
    let failure = &report.failures[0];
    let ([x, y], numbers) = ([failure.input[0], failure.input[1]], failure.fault.numbers);
    assert_eq!((failure.fault.input, numbers.along), (1, false), "{report}");
    assert_eq!(numbers.adjoint, Some(1.01 * x * x), "{report}");
    let difference = numbers.difference.unwrap();
    assert!(
        (difference - x * x).abs() < 1e-9 * x * x && y != 1.0,
        "{report}"
    );
    assert!(failure.fault.tolerance < 1e-6 * x * x, "{report}");
}
#[test]
fn details_say_where() {
    let report = points()
        .value(smooth)
        .dual(smooth)
        .gradient(smooth_derivatives)
        .run();
    let details = report.details();
    for part in [
        "checked at 60 inputs",
        "60 smooth, 0 on a kink",
        "adjoint and duals: 120 derivatives compared",
        "adjoint and differences: 120 derivatives compared",
        "nearest to refusal",
        "let input = [",
    ] {
        assert!(details.contains(part), "{part}\n{details}");
    }
    assert!(!details.contains("batch"), "nobody asked one\n{details}");
    // The numbers belong to the input.
    let nearest = report.worst[1].nearest;
    let [derivative, dual] = [nearest.numbers.adjoint, nearest.numbers.dual].map(Option::unwrap);
    assert!(
        (derivative - dual).abs() <= 1e-14 * derivative.abs(),
        "{details}"
    );
    let difference = nearest.numbers.difference.unwrap();
    assert!(
        (derivative - difference).abs() <= nearest.tolerance,
        "{details}"
    );
    assert!(nearest.share > 0.0 && nearest.share <= 1.0, "{details}");
}

/// Derivatives that are wrong at one input to the bit, and right a digit beside it.
mod at_one_input {
    use geograd::Scalar;
    use geograd::check::*;

    fn product<S: Scalar>([x, y]: [S; 2]) -> S {
        x * y
    }

    #[test]
    fn a_special_case_of_equal_numbers_is_refused() {
        let report = Check::at([2.0, 2.0])
            .value(product)
            .dual(product)
            .traced(product)
            .gradient(|[x, y]| if x == y { [0.0, 0.0] } else { [y, x] })
            .run();
        assert!(!report.passed(), "{report}");
    }

    #[test]
    fn a_special_case_of_one_number_is_refused() {
        let wrong = |[x, y]: [f64; 2]| if x == 1.0 { [7.0, x] } else { [y, x] };
        let with_duals = Check::at([1.0, 2.0])
            .value(product)
            .dual(product)
            .traced(product)
            .gradient(wrong)
            .run();
        assert!(!with_duals.passed(), "{with_duals}");
        let by_differences = Check::at([1.0, 2.0]).value(product).gradient(wrong).run();
        assert!(!by_differences.passed(), "{by_differences}");
    }
}

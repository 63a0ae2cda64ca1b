//! The harness itself: what a user who knows nothing of it would take for granted, and once was not
//! so. Right derivatives are accepted where they are hard to tell, wrong ones refused however well they
//! hide, and a report is about the fault it was asked about.
use geograd::Scalar;
use geograd::ad::check::verdict::{Reason, Witness};
use geograd::ad::check::{Check, Report};
use geograd::{Program, Sym, assert_gradient, generic_check};

const UNHEARD: Reason = Reason::Unjudged;
const BY_DUALS: Reason = Reason::Disagree(Witness::Adjoint, Witness::Dual);
const BY_DIFFERENCES: Reason = Reason::Disagree(Witness::Adjoint, Witness::Difference);

#[track_caller]
fn refused(report: &Report, reason: Reason) {
    assert!(report.refused_for(reason), "{report}");
}

fn sum_of_sines<S: Scalar>(x: Vec<S>) -> S {
    x.iter().fold(S::zero(), |s, x| s + x.sin())
}
fn sum_of_squares<S: Scalar>([a, b]: [S; 2]) -> S {
    a * a + b * b
}

/// Nothing judged is nothing checked.
mod unjudged {
    use super::*;

    fn product() -> Check<'static, [f64; 2]> {
        let check = Check::at([1.0, 2.0]).value(|[x, y]: [f64; 2]| x * y);
        check.gradient(|_| [7.0, -7.0])
    }

    #[test]
    fn no_point_inside() {
        refused(&product().inside(|p| p[0] > 1.0).run(), UNHEARD);
    }
    #[test]
    fn no_point() {
        let none = Check::<[f64; 2]>::among([]).value(|[x, y]| x * y);
        refused(&none.gradient(|_| [7.0, -7.0]).run(), UNHEARD);
    }
    #[test]
    fn no_derivative() {
        let none = Check::at([1.0, 2.0]).value(|[x, y]: [f64; 2]| x * y);
        refused(&none.run(), UNHEARD);
    }
    #[test]
    fn no_result() {
        let none = Check::at([1.0, 2.0]).value(|_| Vec::<f64>::new());
        refused(&none.adjoint(|_, _| [3.0, 0.0]).run(), UNHEARD);
    }
    #[test]
    fn nothing_but_noise() {
        let noise = |[x, y]: [f64; 2]| x * y + 1e-3 * (1e17 * x * y).sin();
        let report = Check::at([1.0, 2.0]).value(noise).gradient(|_| [7.0, -7.0]);
        assert!(!report.run().passed());
    }
    #[test]
    fn another_path_alone_is_enough() {
        let product = Check::at([1.0, 2.0]).value(|[x, y]: [f64; 2]| x * y);
        product.path(|[x, y]| y * x).assert();
    }
}

/// Right ones.
mod accepted {
    use super::*;

    #[test]
    fn any_share_of_a_tie() {
        fn relu<S: Scalar>(x: S) -> S {
            x.most(S::zero())
        }
        assert_gradient!(generic relu, |x| f64::from(x > 0.0), at 0.0);
        fn larger<S: Scalar>([x, y]: [S; 2]) -> S {
            x.most(y)
        }
        let first = |[x, y]: [f64; 2]| [f64::from(x >= y), f64::from(x < y)];
        assert_gradient!(generic larger, first, at [1.0, 1.0]);
    }
    #[test]
    fn a_tie_that_is_no_kink() {
        // x nearby; the duals of its source take half of a tie.
        fn f<S: Scalar>([x, y]: [S; 2]) -> S {
            let zero = S::zero();
            x.most(zero).hypot(y.most(zero)) + x.most(y).least(zero)
        }
        assert_gradient!(generic f, |_| [1.0, 0.0], at [0.0, -1.0]);
    }
    #[test]
    fn a_kink_of_the_derivative() {
        Check::at(0.0)
            .value(|x: f64| x.max(0.0).powi(2))
            .gradient(|x| 2.0 * x.max(0.0))
            .hessian_times(|x, v| if x > 0.0 { 2.0 * v } else { 0.0 })
            .assert();
    }
    #[test]
    fn derivatives_that_are_what_is_left_of_one() {
        fn loss<S: Scalar>(x: S) -> S {
            (S::one() + (-x).exp()).ln()
        }
        let derivative = |x: f64| 1.0 / (1.0 + (-x).exp()) - 1.0;
        assert_gradient!(generic loss, derivative, at 8.0, 0.5);
        let single = |x: f32| 1.0 / (1.0 + (-x).exp()) - 1.0;
        let check = Check::among([8.0_f32, 0.5]).value(loss).dual(loss);
        check.gradient(single).assert();
        // Single precision keeps too few digits of the value itself.
        let wide = Check::among([8.0_f32, 0.5]).value(loss).wide(loss);
        refused(
            &wide.gradient(single).run(),
            Reason::ValuesDisagree(Witness::Wide),
        );
    }
    #[test]
    fn a_loss_of_nothing() {
        let loss = |[a, b]: [f64; 2]| {
            let m = a.max(b);
            m + ((a - m).exp() + (b - m).exp()).ln() - a
        };
        let derivatives = |[a, b]: [f64; 2]| {
            let m = a.max(b);
            let (p, q) = ((a - m).exp(), (b - m).exp());
            [p / (p + q) - 1.0, q / (p + q)]
        };
        assert_gradient!(loss, derivatives, at [40.0, 0.0]);
    }
    #[test]
    fn derivatives_of_zero() {
        let det = |[a, b, c, d]: [f64; 4]| (a * d - b * c) * (a * d - b * c);
        let derivatives = |[a, b, c, d]: [f64; 4]| {
            let e = 2.0 * (a * d - b * c);
            [e * d, -e * c, -e * b, e * a]
        };
        assert_gradient!(det, derivatives, at [1.0, 1.0, 1.0, 1.0]);
    }
    #[test]
    fn metres_and_millimetres() {
        let f = |[a, b]: [f64; 2]| 1e-6 * a + 1.0 / b;
        let right = |[_, b]: [f64; 2]| [1e-6, -1.0 / (b * b)];
        let wrong = |[_, b]: [f64; 2]| [1e-6, 1.0 / (b * b)];
        for point in [
            [1.0, 1e-3],
            [1e6, 1e-3],
            [1e6, 1e-2],
            [1e9, 1e-3],
            [5e5, 1e-6],
        ] {
            Check::at(point).value(f).gradient(right).assert();
            refused(
                &Check::at(point).value(f).gradient(wrong).run(),
                BY_DIFFERENCES,
            );
        }
    }
    #[test]
    fn second_derivatives_of_a_saturated_softmax() {
        // The loss of a saturated logit: digits of its second derivative cancel in `p - p²`.
        fn loss<S: Scalar>([a, b]: [S; 2]) -> S {
            let m = a.most(b);
            m + ((a - m).exp() + (b - m).exp()).ln() - a
        }
        let shares = |[a, b]: [f64; 2]| {
            let m = a.max(b);
            let (p, q) = ((a - m).exp(), (b - m).exp());
            [p / (p + q), q / (p + q)]
        };
        let derivatives = move |x| {
            let [p, q] = shares(x);
            [p - 1.0, q]
        };
        let hessian = move |x, [u, v]: [f64; 2]| {
            let [p, q] = shares(x);
            [(p - p * p) * u - p * q * v, (q - q * q) * v - p * q * u]
        };
        for x in [[40.0, 0.0], [12.0, 0.0], [3.0, 1.0], [-2.0, 20.0]] {
            let check = generic_check!(loss, at x).gradient(derivatives);
            check.hessian_times(hessian).assert();
            Check::at(x)
                .value(loss)
                .gradient(derivatives)
                .hessian_times(hessian)
                .assert();
        }
        // A logit that is not saturated shows a forgotten mixed derivative.
        let wrong = move |x, [u, v]: [f64; 2]| {
            let [p, q] = shares(x);
            [(p - p * p) * u, (q - q * q) * v]
        };
        let check = generic_check!(loss, at [3.0, 1.0]).gradient(derivatives);
        let report = check.hessian_times(wrong).run();
        refused(&report, Reason::CurvatureDisagrees(Witness::Dual));
    }
    #[test]
    fn values_from_a_table() {
        // Steps of a millionth; without being told the harness sees jumps and noise.
        let rounded = |[x, y]: [f64; 2]| (x.sin() * y * 1e6).round() / 1e6;
        let derivatives = |[x, y]: [f64; 2]| [x.cos() * y, x.sin()];
        assert_gradient!(rounded, derivatives, at [0.4, 1.3], [2.0, -0.7]; resolution 1e-6);
        let wrong = |[x, y]: [f64; 2]| [x.cos() * y, 1.01 * x.sin()];
        let check = Check::at([0.4, 1.3]).value(rounded).gradient(wrong);
        assert!(!check.resolution(1e-6).run().passed());
    }
    #[test]
    fn options_of_the_macro() {
        let root = |x: f64| {
            assert!(x > 0.0, "only inside");
            x.sqrt()
        };
        let derivative = |x: f64| 0.5 / x.sqrt();
        assert_gradient!(root, derivative, at 1e-3, 2.0; inside |x| *x > 0.0; scales |x| 0.5 * x);
    }
    #[test]
    fn a_recorded_program() {
        let recorded = |v: [Sym<f64>; 3]| (v[0] * v[1]).sin() + v[2].most(v[0]);
        let program = Program::trace(recorded).unwrap();
        assert_gradient!(program &program, at [0.3, 1.2, -0.4], [1.0, 2.0, 1.0], [0.0, 0.0, 0.0]);
        let wrong = program.with_adjoint(|v: [Sym<f64>; 3]| {
            let cos = (v[0] * v[1]).cos();
            [v[1] * cos, v[0] * cos, Sym::one()]
        });
        // Right where the last number is the larger one only.
        assert_gradient!(program wrong.as_ref().unwrap(), at [0.3, 1.2, 0.4]);
        let report = Check::at([0.3, 1.2, -0.4]).program(&wrong.unwrap()).run();
        refused(&report, BY_DIFFERENCES);
        refused(&report, BY_DUALS);
    }
    #[test]
    fn numbers_whose_product_nearly_overflows() {
        assert_gradient!(|[x, y]: [f64; 2]| x * y, |[x, y]| [y, x], at [1e300, 1e-3]);
    }
    #[test]
    fn a_function_that_panics_beside_its_point() {
        let value = |[x, y]: [f64; 2]| {
            assert!(x > 0.0, "x must be positive");
            x.ln() * y
        };
        assert_gradient!(value, |[x, y]| [y / x, x.ln()], at [1e-4, 100.0]);
    }
}

/// Wrong ones that hide.
mod hidden {
    use super::*;

    #[test]
    fn behind_steps_too_small_for_single_precision() {
        let wrong = |[x, y]: [f32; 2]| {
            let r = (x * x + y * y).sqrt();
            [x / r, 1.01 * y / r]
        };
        let norm = Check::at([1.136_016_2_f32, 0.970_786_8]);
        let report = norm.value(|[x, y]: [f32; 2]| (x * x + y * y).sqrt());
        refused(&report.gradient(wrong).run(), BY_DIFFERENCES);
    }
    #[test]
    fn one_in_three_hundred() {
        let derivative = |(i, x): (usize, &f64)| {
            let off = if i == 150 { 1e-6 } else { 0.0 };
            (1.0 + off) * x.cos()
        };
        let report = Check::at(vec![0.3; 300])
            .value(sum_of_sines)
            .gradient(|x| x.iter().enumerate().map(derivative).collect())
            .run();
        refused(&report, BY_DIFFERENCES);
    }
    #[test]
    fn one_in_two_thousand_of_single_precision() {
        let derivative = |(i, x): (usize, &f32)| if i == 1000 { -x.cos() } else { x.cos() };
        let report = Check::at(vec![0.3_f32; 2000])
            .value(sum_of_sines)
            .dual(sum_of_sines)
            .gradient(|x| x.iter().enumerate().map(derivative).collect())
            .run();
        refused(&report, BY_DUALS);
    }
    #[test]
    fn beside_a_far_larger_derivative() {
        let wrong = |[a, b]: [f64; 2]| [2.0 * a, -2.0 * b];
        let check = Check::at([1e12, 1.0]).value(sum_of_squares);
        refused(&check.dual(sum_of_squares).gradient(wrong).run(), BY_DUALS);
        let off = |[a, b]: [f32; 2]| [2.0 * a, 2.02 * b];
        let check = Check::at([1e2_f32, 1.0]).value(sum_of_squares);
        refused(&check.dual(sum_of_squares).gradient(off).run(), BY_DUALS);
    }
    #[test]
    fn second_derivatives_beside_far_larger_ones() {
        let derivatives = |[a, b]: [f64; 2]| [2.0 * a, 2.0 * b];
        let check = |off: f64| {
            let check = generic_check!(sum_of_squares, at [1e12, 1.0]).gradient(derivatives);
            check.hessian_times(move |_, [u, v]| [2.0 * u, (2.0 + off) * v])
        };
        check(0.0).assert();
        refused(
            &check(1e-8).run(),
            Reason::CurvatureDisagrees(Witness::Dual),
        );
    }
    #[test]
    fn in_ties_of_many() {
        // No share of the derivative, or nine tenths: along the tie the function is smooth.
        let largest = |x: [f64; 4]| x.iter().fold(f64::MIN, |m, x| m.max(*x));
        for share in [0.0, 0.225] {
            let report = Check::at([1.0; 4]).value(largest).gradient(|_| [share; 4]);
            assert!(!report.run().passed(), "{share}");
        }
        Check::at([1.0; 4])
            .value(largest)
            .gradient(|_| [0.25; 4])
            .assert();
    }
    #[test]
    fn behind_a_tie_of_another_number() {
        // No step along x is inside, so only the duals can tell; that z ties is no excuse.
        fn f<S: Scalar>([x, z]: [S; 2]) -> S {
            x * x + z.most(S::zero())
        }
        let wrong = |[_, z]: [f64; 2]| [7.0, f64::from(z > 0.0)];
        let check = Check::at([1.0, 0.0]).value(f).dual(f).traced(f);
        let check = check.inside(|p| p[0] == 1.0).gradient(wrong);
        refused(&check.run(), BY_DUALS);
    }
    #[test]
    fn duals_of_another_function() {
        fn product<S: Scalar>([x, y]: [S; 2]) -> S {
            x * y
        }
        let shifted = |x: [geograd::Jet<f64, 1>; 2]| product(x) + Scalar::lit(5.0);
        let report = Check::at([1.0, 2.0]).value(product).dual(shifted);
        let report = report.gradient(|[x, y]| [y, x]).run();
        refused(&report, Reason::ValuesDisagree(Witness::Dual));
    }
}

/// Reports are about the fault.
mod reports {
    use super::*;

    #[test]
    fn shrinking_keeps_to_the_fault() {
        // Wrong in y; where x is zero there is a kink, at which its derivative has another share.
        fn f<S: Scalar>([x, y]: [S; 2]) -> S {
            x.most(S::zero()) * y + y * y
        }
        let wrong = |[x, y]: [f64; 2]| [if x > 0.0 { y } else { 0.0 }, x.max(0.0) + y];
        let report = Check::at([1.3, 0.7]).value(f).dual(f).gradient(wrong).run();
        for failure in &report.failures {
            assert_eq!(failure.fault.input, 1, "{report}");
            assert_eq!(failure.fault.suspect, Some(Witness::Adjoint), "{report}");
            assert!(failure.input[0] != 0.0, "{report}");
        }
    }
    #[test]
    fn lists_in_shapes_can_be_pasted() {
        let sum = |(x, a): (Vec<f64>, f64)| a * x.iter().sum::<f64>();
        let report = Check::at((vec![1.0, 2.0], 0.5))
            .value(sum)
            .gradient(|(x, a)| (vec![-a; x.len()], x.iter().sum()))
            .run();
        assert!(report.failures[0].code.starts_with("(vec!["), "{report}");
    }
    #[test]
    fn say_what_is_wrong() {
        let check = Check::at([1.0, 2.0])
            .value(sum_of_squares)
            .dual(sum_of_squares);
        let text = check
            .gradient(|[a, b]| [2.0 * a, 2.02 * b])
            .run()
            .to_string();
        for part in [
            "the tested derivative and the duals disagree",
            "derivative of output 0 with respect to input 1",
            "apart by",
            "allowed here",
            "at fault, as far as the others tell: the tested derivative",
            "let input = [",
        ] {
            assert!(text.contains(part), "{part}\n{text}");
        }
        let check = Check::at(vec![1.0, 2.0]).value(|x: Vec<f64>| x[0] * x[1]);
        let report = check.gradient(|_| vec![2.0; 3]).run();
        assert_eq!(report.failures[0].fault.numbers.lengths, Some([3, 2]));
        let text = report.to_string();
        assert!(text.contains("3 numbers where 2 are needed"), "{text}");
    }
    mod tripled {
        geograd::operation! {
            /// A product, and a derivative by the second factor three times as large.
            pub OfFactor = "of_factor": (point: geograd::Vec2<S>, factor: S) -> S { point.x * factor }
            invariances []
            jumps Never
            derivative ByHand |(point, factor), bar| {
                (point.x * factor, (geograd::Vec2::new(factor * bar, S::zero()), point.x * bar * S::lit(3.0)))
            }
            /// The same of a vertex of a ring.
            pub OfVertex = "of_vertex": (factor: S, ring: [geograd::Vec2<S>; 2]) -> S { ring[1].y * factor }
            invariances []
            jumps Never
            derivative ByHand |(factor, ring), bar| {
                let mut by_ring = [geograd::Vec2::new(S::zero(), S::zero()); 2];
                by_ring[1].y = factor * bar * S::lit(3.0);
                (ring[1].y * factor, (ring[1].y * bar, by_ring))
            }
        }
    }
    #[test]
    fn numbers_have_the_names_of_their_arguments() {
        let [_, double] = geograd::check::Check::of(tripled::OfFactor)
            .samples(20)
            .run();
        let text = double.to_string();
        assert!(text.contains("input 2, which is factor ("), "{text}");
        let [_, double] = geograd::check::Check::of(tripled::OfVertex)
            .samples(20)
            .run();
        let text = double.to_string();
        assert!(text.contains("input 4, which is ring[1].y ("), "{text}");
    }
    #[test]
    fn a_long_list_does_not_hang() {
        // Forty thousand numbers: shrinking stops before its candidates cost too much.
        let report = Check::at(vec![0.5; 40_000])
            .value(|x: Vec<f64>| x.iter().map(|x| x * x).sum::<f64>())
            .gradient(|x| x.iter().map(|x| 2.1 * x).collect())
            .run();
        assert!(!report.passed());
    }
    #[test]
    #[should_panic(expected = "one number as result")]
    fn a_hessian_of_two_results() {
        Check::at([1.0, 2.0])
            .value(|[x, y]: [f64; 2]| [x * x, y * y])
            .adjoint(|[x, y], s| [2.0 * x * s[0], 2.0 * y * s[1]])
            .hessian_times(|_, [u, v]| [2.0 * u, 2.0 * v])
            .assert();
    }
}

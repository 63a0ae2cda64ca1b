//! Every scalar on every kink, and its elementary functions against the platform's.
use super::oracle_boxes::Fixed;
use geograd::{Jet, Lanes, Mask, Scalar};
use num_dual::{Dual, Dual2, Dual3, HyperDual, HyperHyperDual, Real};

/// The kinks by value, for any scalar.
fn values<S: Scalar>() {
    let s = |x: f64| S::lit(x);
    let same = |x: S, y: f64| x.equals(s(y)).all();
    assert!(same(s(2.0).least(s(3.0)), 2.0) && same(s(3.0).least(s(2.0)), 2.0));
    assert!(same(s(2.0).most(s(3.0)), 3.0) && same(s(2.0).most(s(2.0)), 2.0));
    assert!(same(s(-2.0).magnitude(), 2.0) && same(s(0.0).magnitude(), 0.0));
    assert!(same(s(5.0).clamp(s(-1.0), s(1.0)), 1.0) && same(s(0.5).clamp(s(-1.0), s(1.0)), 0.5));
    assert!(same(s(9.0).root(), 3.0) && same(s(0.0).root(), 0.0) && same(s(-4.0).root(), 0.0));
    assert!(same(s(3.0).hypot(s(4.0)), 5.0) && same(s(0.0).hypot(s(0.0)), 0.0));
    assert!(same(s(0.0).atan2(s(0.0)), 0.0));
    assert!(same(s(-3.0).unsigned(), 3.0) && same(s(3.0).signed_as(s(-0.1)), -3.0));
    assert!(same(s(7.0).over(s(2.0)), 3.5) && same(s(2.0).powi(-3), 0.125));
    assert!(same(s(5.0).binade(), 0.5) && same(s(2.0).binade(), 1.0));
    assert!(same(s(5.0).damp(S::Primal::lit(0.25)), 5.0));
    assert!(same(s(5.0).with_primal(S::Primal::lit(2.0)), 2.0));
    assert!(s(1.0).finite().all() && !s(f64::INFINITY).finite().any());
    assert!(
        !s(f64::NAN).finite().any() && same(s(f64::INFINITY).saturated(), S::format().largest())
    );
    assert!(
        S::select(s(1.0).below(s(2.0)), s(1.0), s(f64::NAN))
            .finite()
            .all()
    );
    let (high, low) = s(std::f64::consts::PI).parts();
    assert!((high + low).equals(s(std::f64::consts::PI)).all());
    // Huge and tiny lengths neither over- nor underflow.
    let big = S::format().largest() / 4.0;
    assert!(s(big).hypot(s(big)).finite().all());
    let small = 1.0 / big;
    assert!(s(small).hypot(s(small)).above(s(small)).all());
    // A quotient that overflows is infinite, not undefined.
    let quotient = s(big).over(s(small));
    assert!(same(quotient.saturated(), S::format().largest()) && !quotient.finite().any());
}

#[test]
fn kinks_have_the_same_values_for_every_scalar() {
    values::<f32>();
    values::<f64>();
    values::<Lanes<f32, 16>>();
    values::<Lanes<f64, 8>>();
    values::<Jet<f64, 3>>();
    values::<Jet<f32, 3>>();
    values::<Jet<Jet<f64, 2>, 2>>();
    values::<Jet<Lanes<f32, 8>, 2>>();
    values::<Real<f64>>();
    values::<Dual<f64>>();
    values::<Dual<f32>>();
    values::<Dual<Dual<f64>>>();
    values::<Dual2<f64>>();
    values::<Dual3<f64>>();
    values::<HyperDual<f64>>();
    values::<HyperHyperDual<f64>>();
    values::<Jet<Dual<f64>, 2>>();
}

/// The derivatives on the kinks, for any scalar with one derivative. `x(v, d)` has value v and derivative d.
fn derivatives<S: Scalar>(x: impl Fn(f64, f64) -> S, derivative: impl Fn(S) -> f64) {
    // Ties share, half and half.
    assert_eq!(derivative(x(2.0, 1.0).least(x(2.0, 3.0))), 2.0);
    assert_eq!(derivative(x(2.0, 1.0).most(x(2.0, 3.0))), 2.0);
    assert_eq!(
        derivative(x(1.0, 1.0).clamp(x(-1.0, 0.0), x(1.0, 0.0))),
        0.5
    );
    // Otherwise the winner takes all.
    assert_eq!(derivative(x(1.0, 1.0).least(x(2.0, 3.0))), 1.0);
    assert_eq!(derivative(x(1.0, 1.0).most(x(2.0, 3.0))), 3.0);
    // A norm at zero has derivative zero, whatever the sign of the zero.
    for zero in [0.0, -0.0] {
        assert_eq!(derivative(x(zero, 1.0).magnitude()), 0.0);
        assert_eq!(derivative(x(zero, 1.0).root()), 0.0);
        assert_eq!(derivative(x(zero, 1.0).hypot(x(zero, 2.0))), 0.0);
        assert_eq!(derivative(x(zero, 1.0).atan2(x(zero, 1.0))), 0.0);
    }
    assert_eq!(derivative(x(-2.0, 1.0).magnitude()), -1.0);
    assert_eq!(derivative(x(-2.0, 1.0).root()), 0.0);
    assert_eq!(derivative(x(4.0, 1.0).root()), 0.25);
    // A choice between equal descriptions is no kink.
    assert_eq!(derivative(x(0.0, 1.0).unsigned()), 1.0);
    // At a right angle the arctangent has its true derivative.
    assert_eq!(derivative(x(2.0, 0.0).atan2(x(0.0, 1.0))), -0.5);
    assert_eq!(derivative(x(1.0, 1.0).atan2(x(0.0, 0.0))), 0.0);
    assert_eq!(derivative(x(0.0, 1.0).atan2(x(-2.0, 0.0))), -0.5);
    // The dropped side of a select has no effect.
    let dropped = S::select(
        x(0.0, 0.0).below(x(1.0, 0.0)),
        x(1.0, 2.0),
        x(f64::NAN, f64::NAN),
    );
    assert_eq!(derivative(dropped), 2.0);
    assert_eq!(derivative(x(3.0, 2.0).damp(S::Primal::lit(0.5))), 1.0);
    assert_eq!(
        derivative(x(3.0, 2.0).with_primal(S::Primal::lit(8.0))),
        2.0
    );
    assert_eq!(derivative(x(1.0, 4.0).over(x(2.0, 0.0))), 2.0);
    assert_eq!(derivative(x(1.0, 0.0).over(x(2.0, 1.0))), -0.25);
    let (high, low) = x(0.3, 2.0).parts();
    assert_eq!((derivative(high), derivative(low)), (0.0, 2.0));
    let (sin, cos) = x(0.5, 1.0).sin_cos();
    assert!(
        (derivative(sin) - 0.5f64.cos()).abs() < 1e-6
            && (derivative(cos) + 0.5f64.sin()).abs() < 1e-6
    );
    let [(sin_high, sin_low), (cos_high, cos_low)] = x(0.5, 1.0).sin_cos_parts();
    assert!((derivative(sin_low) - 0.5f64.cos()).abs() < 1e-6 && derivative(sin_high) == 0.0);
    assert!((derivative(cos_low) + 0.5f64.sin()).abs() < 1e-6 && derivative(cos_high) == 0.0);
    assert!((derivative(x(0.5, 1.0).exp()) - 0.5f64.exp()).abs() < 1e-6);
    assert_eq!(derivative(x(0.5, 1.0).ln()), 2.0);
}

#[test]
fn kinks_have_the_same_derivatives_for_every_dual() {
    derivatives(Dual::new, |y| y.eps);
    derivatives(|v, d| Dual::new(v as f32, d as f32), |y| f64::from(y.eps));
    derivatives(|v, d| Dual2::new(v, d, 0.0), |y| y.v1);
    derivatives(|v, d| Dual3::new(v, d, 0.0, 0.0), |y| y.v1);
    derivatives(|v, d| HyperDual::new(v, d, 0.0, 0.0), |y| y.eps1);
    derivatives(
        |v, d| HyperHyperDual::new(v, 0.0, d, 0.0, 0.0, 0.0, 0.0, 0.0),
        |y| y.eps2,
    );
    derivatives(
        |v, d| Dual::new(Dual::new(v, d), Dual::new(0.0, 0.0)),
        |y| y.re.eps,
    );
    derivatives(
        |v, d| Dual::new(Dual::new(v, 0.0), Dual::new(d, 0.0)),
        |y| y.eps.re,
    );
    derivatives(
        |v, d| Jet {
            value: v,
            derivative: [0.0, d],
        },
        |y| y.derivative[1],
    );
    derivatives(
        |v, d| Jet {
            value: v as f32,
            derivative: [d as f32],
        },
        |y| f64::from(y.derivative[0]),
    );
    derivatives(
        |v, d| Jet {
            value: Jet {
                value: v,
                derivative: [d],
            },
            derivative: [Jet {
                value: 0.0,
                derivative: [0.0],
            }],
        },
        |y| y.value.derivative[0],
    );
    derivatives(
        |v, d| Jet {
            value: Lanes([v; 4]),
            derivative: [Lanes([d; 4])],
        },
        |y| y.derivative[0].0[3],
    );
}

/// Second and third derivatives follow the chain rule.
#[test]
fn higher_derivatives() {
    let x = 0.7_f64;
    let cube = Dual3::new(x, 1.0, 0.0, 0.0);
    let (sin, _) = Scalar::sin_cos(cube);
    let (s, c) = (x.sin(), x.cos());
    for (got, want) in [(sin.re, s), (sin.v1, c), (sin.v2, -s), (sin.v3, -c)] {
        assert!((got - want).abs() < 1e-15);
    }
    let root = cube.root();
    let wants = [
        x.sqrt(),
        0.5 / x.sqrt(),
        -0.25 * x.powf(-1.5),
        0.375 * x.powf(-2.5),
    ];
    for (got, want) in [root.re, root.v1, root.v2, root.v3].into_iter().zip(wants) {
        assert!((got - want).abs() < 1e-14);
    }
    let angle = Scalar::atan2(cube, Dual3::from_re(1.0));
    let d = 1.0 + x * x;
    let wants = [
        x.atan(),
        1.0 / d,
        -2.0 * x / (d * d),
        (6.0 * x * x - 2.0) / (d * d * d),
    ];
    for (got, want) in [angle.re, angle.v1, angle.v2, angle.v3]
        .into_iter()
        .zip(wants)
    {
        assert!((got - want).abs() < 1e-14, "{got} {want}");
    }
}

#[test]
fn sine_and_cosine_are_right_everywhere() {
    let mut worst: f64 = 0.0;
    for i in -200_000..200_000 {
        let x = f64::from(i) * 0.000_731 + f64::from(i).powi(3) * 1e-12;
        let (sin, cos) = Scalar::sin_cos(x);
        worst = worst.max((sin - x.sin()).abs()).max((cos - x.cos()).abs());
        // A lane gives the bits of a number.
        if i % 97 == 0 {
            let lanes = Lanes::<f64, 4>::splat(x).sin_cos();
            assert_eq!((lanes.0.0[2], lanes.1.0[1]), (sin, cos));
            let parts = (x as f32).sin_cos_parts();
            let in_lanes = Lanes::<f32, 16>::splat(x as f32).sin_cos_parts();
            for (one, many) in parts.iter().zip(&in_lanes) {
                assert_eq!((one.0, one.1), (many.0.0[7], many.1.0[15]));
            }
            // High and low parts together hold eleven digits; the high one has twelve bits.
            let [(high, low), _] = parts;
            let exact = f64::from(x as f32).sin();
            assert!((f64::from(high) + f64::from(low) - exact).abs() < 8e-12);
            assert_eq!(high.to_bits() & 0xfff, 0);
        }
    }
    assert!(worst < 3e-16, "{worst}");
    for huge in [1e6, 1e9, -1e15, 1e300] {
        let (sin, cos) = Scalar::sin_cos(huge);
        // The platform's last bit need not be ours.
        assert!((sin - huge.sin()).abs() < 3e-16 && (cos - huge.cos()).abs() < 3e-16);
        let mixed = Lanes([huge, 0.5]).sin_cos();
        assert_eq!(mixed.0.0, [sin, Scalar::sin(0.5_f64)]);
    }
}

/// The value under a dual is that of the plain number, to the bit.
#[test]
fn duals_have_the_values_of_plain_numbers() {
    fn mix<S: Scalar>(x: S, y: S) -> S {
        (x.over(y) + x.hypot(y)).root() + y.atan2(x) * x.sin() - (x * y).cos()
    }
    for i in 1..2000 {
        let (x, y) = (
            f64::from(i) * 0.37 - 300.0,
            f64::from(i * i % 977) * 0.11 - 50.0,
        );
        let plain = mix(x, y + 0.01);
        let y = y + 0.01;
        assert_eq!(
            mix(Jet::<f64, 2>::variable(x, 0), Jet::variable(y, 1))
                .value
                .to_bits(),
            plain.to_bits()
        );
        assert_eq!(
            mix(Dual::new(x, 1.0), Dual::new(y, 0.5)).re.to_bits(),
            plain.to_bits()
        );
        assert_eq!(
            mix(
                HyperDual::new(x, 1.0, 0.0, 0.0),
                HyperDual::new(y, 0.5, 1.0, 0.0)
            )
            .re
            .to_bits(),
            plain.to_bits()
        );
    }
}

/// The exponential of the oracle: Taylor's series of a 1024th, squared ten times.
fn exact_exp(x: f64) -> Fixed {
    let small = Fixed(Fixed::new(x).0 >> 10);
    let (mut term, mut sum) = (Fixed::new(1.0), Fixed::new(1.0));
    for n in 1..40 {
        term = Fixed(term.mul(&small).0 / n);
        sum = sum.add(&term);
    }
    (0..10).fold(sum, |x, _| x.mul(&x))
}

#[test]
fn exponential_and_logarithm_are_within_a_unit_in_the_last_place() {
    let one = Fixed::new(1.0);
    let off = |exact: &Fixed| (exact.sub(&one)).to_f64().abs() / f64::EPSILON;
    let mut worst = [0.0_f64; 2];
    for i in -400..400 {
        let x = f64::from(i) * 0.0731 + f64::from(i).powi(3) * 1e-9;
        // e⁻ˣ times the computed eˣ is 1 but for its error.
        let exp = Scalar::exp(x);
        worst[0] = worst[0].max(off(&exact_exp(-x).mul(&Fixed::new(exp))));
        let y = exp * (1.0 + 1e-3 * f64::from(i % 7));
        let ln = Scalar::ln(y);
        let share = ln.abs().max(f64::MIN_POSITIVE);
        let error = off(&exact_exp(-ln).mul(&Fixed::new(y)));
        worst[1] = worst[1].max(error / share);
        assert_eq!(Lanes::<f64, 4>::splat(x).exp().0[2], exp);
        assert_eq!(Lanes::<f64, 4>::splat(y).ln().0[1], ln);
        let single = x as f32;
        assert_eq!(
            Scalar::exp(single),
            f64::from(single).exp() as f32,
            "{single}"
        );
        assert_eq!(
            Lanes::<f32, 8>::splat(single).exp().0[7],
            Scalar::exp(single)
        );
        let single = y as f32;
        if single.is_finite() && single > 0.0 {
            assert_eq!(
                Scalar::ln(single),
                f64::from(single).ln() as f32,
                "{single}"
            );
        }
    }
    assert!(worst[0] < 1.0 && worst[1] < 1.0, "{worst:?}");
}

#[test]
fn exponential_and_logarithm_at_their_limits() {
    let infinity = f64::INFINITY;
    for (x, want) in [
        (0.0, 1.0),
        (-0.0, 1.0),
        (709.782_712_893_384, f64::exp(709.782_712_893_384)),
        (709.79, infinity),
        (infinity, infinity),
        (f64::MAX, infinity),
        (-745.2, 0.0),
        (-infinity, 0.0),
        (-745.0, 5e-324),
    ] {
        assert_eq!(Scalar::exp(x), want, "exp {x}");
        assert_eq!(Lanes([x, 2.0]).exp().0[0], want);
    }
    for (x, want) in [
        (1.0, 0.0),
        (std::f64::consts::E, 1.0),
        (5e-324, -744.440_071_921_381_2),
        (f64::MAX, 709.782_712_893_384),
        (f64::MIN_POSITIVE, -708.396_418_532_264_1),
        (0.0, -infinity),
        (-0.0, -infinity),
        (infinity, infinity),
    ] {
        assert_eq!(Scalar::ln(x), want, "ln {x}");
        assert_eq!(Lanes([x, 2.0]).ln().0[0], want);
    }
    assert!(Scalar::ln(-1.0_f64).is_nan() && Scalar::ln(f64::NAN).is_nan());
    assert!(Scalar::exp(f64::NAN).is_nan() && Scalar::exp(f32::NAN).is_nan());
    assert_eq!(Scalar::exp(89.0_f32), f32::INFINITY);
    assert_eq!(Scalar::exp(-104.0_f32), 0.0);
    assert_eq!(Scalar::exp(-103.0_f32), f64::exp(-103.0) as f32);
    assert_eq!(Scalar::ln(1e-45_f32), f64::from(1e-45_f32).ln() as f32);
}

//! The harness itself: correct but difficult functions are accepted; how often it errs.
use crate::planted;

use geograd::Vec2;
use geograd::ad;
use geograd::ad::check::Check;
use geograd::ad::check::Sampling;
use planted::SEED;

macro_rules! accepted {
    ($name:ident: $f:expr, $gradient:expr, [$($at:expr),+ $(,)?]) => {
        #[test]
        fn $name() {
            Check::among([$($at),+]).value($f).gradient($gradient).assert();
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
fn infinite_derivative_is_undefined() {
    let report = Check::at(0.0)
        .and(2.0)
        .value(|x: f64| x.max(0.0).sqrt())
        .inside(|x| *x >= 0.0)
        .gradient(|x| if x > 0.0 { 0.5 / x.sqrt() } else { 0.0 })
        .run();
    assert!(report.passed(), "{report}");
    assert_eq!(report.places, [1, 0, 1], "{report}");
}
#[test]
fn rings_of_any_length() {
    let area = |ring: Vec<Vec2<f64>>| geograd::ring::signed_area(&ring);
    Check::random(100, SEED)
        .value(area)
        .gradient(|ring: Vec<Vec2<f64>>| {
            let mut bar = vec![Vec2::zero(); ring.len()];
            ad::adjoint::ring::signed_area_vjp(&ring, 1.0, &mut bar);
            bar
        })
        .assert();
}

/// Sums of products of sines, exponentials and ratios with random coefficients: how often a right
/// gradient is refused, and how often one that is off by a small factor in one number is accepted.
#[test]
fn rates() {
    let (count, mut alarms, mut missed) = (1000, 0, 0);
    let plan = Sampling::new(count, SEED);
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

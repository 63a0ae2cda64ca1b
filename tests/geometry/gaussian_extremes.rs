//! Boxes as Gaussians where sizes and distances are far from each other, or near the limits of the numbers.
use super::pairs::Random;
use geograd::gaussian::{self, solid};
use geograd::{Jet, Obb2, Obb3, Rotation3, Scalar, Vec3};

fn space<S: Scalar>(x: &[S]) -> Obb3<S> {
    let turn = Rotation3::new(x[6], x[7], x[8], x[9]);
    Obb3::new(
        Vec3::new(x[0], x[1], x[2]),
        Vec3::new(x[3], x[4], x[5]),
        turn,
    )
}
fn plane<S: Scalar>(x: &[S]) -> Obb2<S> {
    Obb2::new(x[0], x[1], x[2], x[3], x[4])
}
fn lifted<S: Scalar, const N: usize>(x: &[f64; N]) -> [Jet<S, N>; N] {
    std::array::from_fn(|i| Jet::variable(S::lit(x[i]), i))
}
fn upright(center: [f64; 3], size: [f64; 3]) -> [f64; 10] {
    let ([x, y, z], [u, v, w]) = (center, size);
    [x, y, z, u, v, w, 1.0, 0.0, 0.0, 0.0]
}
fn both<const N: usize, const M: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; M] {
    std::array::from_fn(|i| if i < N { a[i] } else { b[i - N] })
}

#[test]
fn sizes_have_a_unit_of_their_own() {
    let point = upright([0.0; 3], [0.0; 3]);
    for (a, b, distance, square) in [
        (
            upright([0.0, 0.0, 300.0], [1.0; 3]),
            point,
            90_000.75_f64.sqrt(),
            90_000.75,
        ),
        (
            upright([0.0; 3], [4.0, 2.0, 1.5]),
            upright([2000.0, 0.0, 0.0], [0.0; 3]),
            4_000_005.562_5_f64.sqrt(),
            4_000_005.562_5,
        ),
        (
            upright([0.0; 3], [0.01, 3.0, 1.0]),
            upright([89262.2, 0.0, 0.0], [0.01, 1.0, 1e-4]),
            89_262.200_007,
            7_967_740_350.09,
        ),
        (
            upright([0.0; 3], [1.0, 2.0, 3.0]),
            upright([1e7, 0.0, 0.0], [2.0, 1.0, 2.0]),
            1e7,
            1e14,
        ),
    ] {
        let x: [f64; 20] = both(&a, &b);
        let single = lifted::<f32, 20>(&x);
        let wide = lifted::<f64, 20>(&x);
        let (one, other) = (space(&single[..10]), space(&single[10..]));
        let found = solid::wasserstein(one, other);
        let squared = solid::wasserstein_squared(one, other);
        let truth = solid::wasserstein(space(&wide[..10]), space(&wide[10..]));
        assert!(
            (f64::from(found.value) / distance - 1.0).abs() < 1e-6,
            "{found:?}"
        );
        assert!(
            (f64::from(squared.value) / square - 1.0).abs() < 1e-6,
            "{squared:?}"
        );
        for i in 0..20 {
            // By sizes W has the derivative ¼ (a − b) / W here.
            let error = (f64::from(found.derivative[i]) - truth.derivative[i]).abs();
            assert!(
                error <= 1e-5 * truth.derivative[i].abs(),
                "{i} {found:?} {truth:?}"
            );
        }
    }
    let far = solid::wasserstein(
        space(&lifted::<f32, 10>(&upright([0.0; 3], [1.0, 2.0, 3.0]))),
        space(&upright([1e7, 0.0, 0.0], [2.0, 1.0, 2.0]).map(Scalar::lit)),
    );
    for (derivative, apart) in far.derivative[3..6].iter().zip([-1.0, 1.0, 1.0]) {
        assert!(
            (derivative / (apart * 0.25e-7) - 1.0_f32).abs() < 1e-5,
            "{far:?}"
        );
    }
}

/// A number as hard as they come: zero, ordinary, at either limit, of any power.
fn hostile(random: &mut Random, least: f64, most: f64) -> f64 {
    let power = random.between(least.log10(), most.log10());
    let x = match random.next() % 8 {
        0 => 0.0,
        1 => 1.0,
        2 => most,
        3 => least,
        4 | 5 => 10_f64.powf(power),
        6 => random.between(0.0, 10.0),
        _ => 10_f64.powf(random.between(-3.0, 3.0)),
    };
    if random.next().is_multiple_of(2) {
        x
    } else {
        -x
    }
}

fn finite<S: Scalar<Mask = bool>, const N: usize>(x: &[f64; N], values: &[Jet<S, N>]) {
    for (k, y) in values.iter().enumerate() {
        let all = y.value.finite() && y.derivative.iter().all(|s| s.finite());
        assert!(all, "{k} {x:?} {y:?}");
    }
}

fn all_finite<S: Scalar<Mask = bool>>(least: f64, most: f64) {
    let mut random = Random(77);
    for n in 0..450 {
        let mut x: [f64; 20] = std::array::from_fn(|_| hostile(&mut random, least, most));
        for k in 0..20 {
            match k % 10 {
                0..3 => {}
                3..6 => x[k] = x[k].abs(),
                _ => x[k] = random.between(-1.0, 1.0),
            }
            if n % 3 == 0 && k >= 10 && random.next().is_multiple_of(2) {
                x[k] = x[k - 10];
            }
        }
        let y = lifted::<S, 20>(&x);
        let (a, b) = (space(&y[..10]), space(&y[10..]));
        let values = [
            solid::wasserstein(a, b),
            solid::wasserstein_squared(a, b),
            solid::kullback_leibler(a, b),
            solid::jeffreys(a, b),
            solid::bhattacharyya(a, b),
            solid::probiou(a, b),
            solid::kfiou(a, b),
        ];
        finite(&x, &values);
        let mut turn = || match random.next() % 3 {
            0 => (random.next() % 4) as f64 * std::f64::consts::FRAC_PI_2,
            _ => random.between(-3.0, 3.0),
        };
        let (one, other) = (turn(), turn());
        let x = [
            x[0], x[1], x[3], x[4], one, x[10], x[11], x[13], x[14], other,
        ];
        let y = lifted::<S, 10>(&x);
        let (a, b) = (plane(&y[..5]), plane(&y[5..]));
        let values = [
            gaussian::wasserstein(a, b),
            gaussian::wasserstein_squared(a, b),
            gaussian::kullback_leibler(a, b),
            gaussian::jeffreys(a, b),
            gaussian::bhattacharyya(a, b),
            gaussian::probiou(a, b),
            gaussian::kfiou(a, b),
        ];
        finite(&x, &values);
    }
}

#[test]
fn hostile_boxes_have_finite_values_and_derivatives() {
    if !geograd_tests::is_due("hostile_boxes_have_finite_values_and_derivatives") {
        return;
    }
    all_finite::<f32>(1e-45, f64::from(f32::MAX));
    all_finite::<f64>(5e-324, f64::MAX);
    for (a, b) in [
        ([0.0, 0.0, 0.0, 1e-26, 0.0], [0.0; 5]),
        ([0.0, -1e14, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 0.0]),
    ] {
        let x: [f64; 10] = both(&a, &b);
        let y = lifted::<f32, 10>(&x);
        let (a, b) = (plane(&y[..5]), plane(&y[5..]));
        finite(
            &x,
            &[
                gaussian::kullback_leibler(a, b),
                gaussian::wasserstein(a, b),
            ],
        );
    }
}

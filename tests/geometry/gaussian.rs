//! Gaussian losses against dense linear algebra, and where that fails.
use super::pairs::{FAMILIES, Random, pair, random_rotation};
use geograd::gaussian::{self, smooth, solid};
use geograd::{Jet, Obb2, Obb3, Rotation3, Scalar, Vec3, YawBox3};

type M = [[f64; 3]; 3];

fn times(a: &M, b: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}
fn transposed(a: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}
fn plus(a: &M, b: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}
fn det(a: &M) -> f64 {
    (0..3)
        .map(|i| {
            a[0][i]
                * (a[1][(i + 1) % 3] * a[2][(i + 2) % 3] - a[1][(i + 2) % 3] * a[2][(i + 1) % 3])
        })
        .sum()
}
fn inverse(a: &M) -> M {
    let d = det(a);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let (p, q, s, t) = ((j + 1) % 3, (j + 2) % 3, (i + 1) % 3, (i + 2) % 3);
            (a[p][s] * a[q][t] - a[p][t] * a[q][s]) / d
        })
    })
}
fn trace(a: &M) -> f64 {
    a[0][0] + a[1][1] + a[2][2]
}
/// Eigenvalues of a symmetric matrix by Jacobi's rotations.
fn eigenvalues(mut a: M) -> [f64; 3] {
    for n in 0..60 {
        let (p, q) = [(0, 1), (0, 2), (1, 2)][n % 3];
        if a[p][q] == 0.0 {
            continue;
        }
        let angle = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
        let (s, c) = angle.sin_cos();
        let mut r = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        (r[p][p], r[p][q], r[q][p], r[q][q]) = (c, s, -s, c);
        a = times(&transposed(&r), &times(&a, &r));
    }
    [a[0][0], a[1][1], a[2][2]]
}
fn covariance(shape: Obb3<f64>, deviation: f64, power: f64) -> M {
    let r = shape.rotation.matrix();
    let size = [shape.size.x, shape.size.y, shape.size.z];
    let d: M = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            if i == j {
                (size[i] * deviation).powf(power)
            } else {
                0.0
            }
        })
    });
    times(&r, &times(&d, &transposed(&r)))
}
fn form(m: &M, v: Vec3<f64>) -> f64 {
    let v = [v.x, v.y, v.z];
    (0..3)
        .map(|i| (0..3).map(|j| v[i] * m[i][j] * v[j]).sum::<f64>())
        .sum()
}

/// By the textbook: Wasserstein squared, both KL, Bhattacharyya (also with even spread), KFIoU.
fn dense(a: Obb3<f64>, b: Obb3<f64>) -> [f64; 6] {
    let d = b.center - a.center;
    let (p, q) = (covariance(a, 0.5, 2.0), covariance(b, 0.5, 2.0));
    let root = covariance(a, 0.5, 1.0);
    let inner = times(&root, &times(&q, &root));
    let roots: f64 = eigenvalues(inner).iter().map(|x| x.max(0.0).sqrt()).sum();
    let wasserstein = d.length_squared() + trace(&p) + trace(&q) - 2.0 * roots;
    let kl = |p: &M, q: &M| {
        let back = inverse(q);
        0.5 * (form(&back, d) + trace(&times(&back, p)) - 3.0 - (det(p) / det(q)).ln())
    };
    let bhattacharyya = |p: &M, q: &M| {
        let mean = plus(p, q).map(|row| row.map(|x| x / 2.0));
        form(&inverse(&mean), d) / 8.0 + 0.5 * (det(&mean) / (det(p) * det(q)).sqrt()).ln()
    };
    let even = (1.0 / 12.0_f64).sqrt();
    let (r, s) = (covariance(a, even, 2.0), covariance(b, even, 2.0));
    let fused = (det(&p) * det(&q) / det(&plus(&p, &q))).sqrt();
    let kfiou = fused / (det(&p).sqrt() + det(&q).sqrt() - fused);
    [
        wasserstein,
        kl(&p, &q),
        kl(&q, &p),
        bhattacharyya(&p, &q),
        bhattacharyya(&r, &s),
        kfiou,
    ]
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-10 * (1.0 + a.abs())
}

#[test]
fn solid_forms_are_the_textbook_ones() {
    let mut random = Random(71);
    for family in [
        "random",
        "upright",
        "aligned",
        "nearly parallel",
        "touching",
        "cubes",
    ] {
        for _ in 0..60 {
            let (a, b) = pair(family, &mut random);
            let [w, forth, back, bhattacharyya, even, kfiou] = dense(a, b);
            assert!(
                close(w, solid::wasserstein_squared(a, b)),
                "{family} {a:?} {b:?}"
            );
            assert!(
                w < 1e-9 || close(w.sqrt(), solid::wasserstein(a, b)),
                "{family}"
            );
            assert!(
                close(forth, solid::kullback_leibler(a, b)),
                "{family} {a:?} {b:?}"
            );
            assert!(close(forth + back, solid::jeffreys(a, b)), "{family}");
            assert!(
                close(bhattacharyya, solid::bhattacharyya(a, b)),
                "{family} {a:?} {b:?}"
            );
            let hellinger = (1.0 - (-even).exp()).sqrt();
            assert!(
                even < 1e-9 || close(1.0 - hellinger, solid::probiou(a, b)),
                "{family}"
            );
            assert!(close(kfiou, solid::kfiou(a, b)), "{family}");
        }
    }
}

#[test]
fn plane_forms_are_those_of_space_with_equal_heights() {
    let mut random = Random(72);
    for n in 0..300 {
        let (mut one, mut other) = (random.yaw_box(), random.yaw_box());
        (one.center.z, other.center.z, one.size.z, other.size.z) = (0.0, 0.0, 1.0, 1.0);
        if n % 3 == 0 {
            one.size.y = one.size.x;
        }
        let (p, q): (Obb2<f64>, Obb2<f64>) = (one.birds_eye(), other.birds_eye());
        let (a, b) = (Obb3::from(one), Obb3::from(other));
        assert!(
            close(gaussian::wasserstein(p, q), solid::wasserstein(a, b)),
            "{p:?} {q:?}"
        );
        assert!(
            close(
                gaussian::kullback_leibler(p, q),
                solid::kullback_leibler(a, b)
            ),
            "{p:?} {q:?}"
        );
        assert!(close(gaussian::jeffreys(p, q), solid::jeffreys(a, b)));
        assert!(close(
            gaussian::bhattacharyya(p, q),
            solid::bhattacharyya(a, b)
        ));
        assert!(close(gaussian::probiou(p, q), solid::probiou(a, b)));
        // Two dimensions: fused volumes are √2 larger than with a third one that is equal.
        let (flat, deep) = (gaussian::kfiou(p, q), solid::kfiou(a, b));
        let share = |x: f64| x / (1.0 + x); // V / (Va + Vb)
        assert!(close(share(flat), share(deep) * 2_f64.sqrt()));
    }
}

#[test]
fn small_differences_keep_their_digits() {
    let a = Obb2::new(3.0_f64, 4.0, 4.0, 2.0, 0.3);
    for h in [1e-3_f64, 1e-6, 1e-9, 1e-12] {
        let wider = Obb2::new(3.0, 4.0, 4.0 + h, 2.0, 0.3);
        let h = wider.size.x - 4.0;
        assert!((gaussian::wasserstein(a, wider) / (h / 2.0) - 1.0).abs() < 1e-9);
        // KL ≈ (h/4)², Bhattacharyya ≈ (h/4)² / 4.
        assert!(
            (gaussian::kullback_leibler(a, wider) / (h / 4.0).powi(2) - 1.0).abs() < 3.0 * h + 1e-9
        );
        assert!(
            (gaussian::bhattacharyya(a, wider) / (h / 8.0).powi(2) - 1.0).abs() < 3.0 * h + 1e-9
        );
        let turned = Obb2::new(3.0, 4.0, 4.0, 2.0, 0.3 + h);
        let t = turned.heading - 0.3;
        // KL ≈ ½ t² (4 − 1)² / (4 · 1).
        let expected = 0.5 * t * t * 9.0 / 4.0;
        assert!(
            (gaussian::kullback_leibler(a, turned) / expected - 1.0).abs() < 1e-3,
            "{h}"
        );
        let (p, q) = (YawBox3::new(Vec3::zero(), Vec3::new(4.0, 2.0, 1.0), 0.3), t);
        let turned = YawBox3 {
            heading: 0.3 + q,
            ..p
        };
        let found = solid::kullback_leibler(Obb3::from(p), Obb3::from(turned));
        assert!(
            (found / expected - 1.0).abs() < 2e-2,
            "{h} {found} {expected}"
        );
        let wide = YawBox3 {
            size: Vec3::new(4.0, 2.0, 1.0 + h),
            ..p
        };
        let h = wide.size.z - 1.0;
        let found = solid::wasserstein(Obb3::from(p), Obb3::from(wide));
        assert!(
            (found / (h / 2.0) - 1.0).abs() < 1e-15 / h + 1e-9,
            "{h} {found}"
        );
    }
    for x in [1e-300_f64, 1e-16, 1e-8, 0.1, 0.2499, 0.2501, 3.0, 1e10] {
        assert!((smooth::ln_one_plus(x) / x.ln_1p() - 1.0).abs() < 1e-15);
        assert!((smooth::exp_minus_one(-x) / (-x).exp_m1() - 1.0).abs() < 1e-15);
        assert!(x > 0.9 || (smooth::ln_one_plus(-x) / (-x).ln_1p() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn identical_boxes_are_at_zero_and_nothing_is_nan() {
    if !geograd_tests::is_due("identical_boxes_are_at_zero_and_nothing_is_nan") {
        return;
    }
    let mut random = Random(73);
    for (n, family) in FAMILIES.iter().cycle().take(400).enumerate() {
        let (a, b) = pair(family, &mut random);
        let one = if n % 2 == 0 {
            a
        } else {
            Obb3 {
                size: Vec3::new(1.0, 1e-6, 1e-6),
                ..a
            }
        };
        assert_eq!(solid::wasserstein(one, one), 0.0);
        assert_eq!(solid::kullback_leibler(one, one), 0.0);
        assert_eq!(solid::bhattacharyya(one, one), 0.0);
        assert_eq!(solid::probiou(one, one), 1.0);
        assert!((solid::kfiou(one, one) - 1.0 / (8.0_f64.sqrt() * 2.0 - 1.0)).abs() < 1e-14);
        for (p, q) in [
            (a, b),
            (b, a),
            (a, a),
            (one, b),
            (
                Obb3 {
                    size: Vec3::zero(),
                    ..a
                },
                b,
            ),
        ] {
            let lift = |shape: Obb3<f64>| -> Obb3<Jet<f64, 10>> {
                let (c, s, r) = (shape.center, shape.size, shape.rotation);
                let x = [c.x, c.y, c.z, s.x, s.y, s.z, r.w, r.x, r.y, r.z];
                let x: [Jet<f64, 10>; 10] = std::array::from_fn(|i| Jet::variable(x[i], i));
                let r = Rotation3::new(x[6], x[7], x[8], x[9]);
                Obb3::new(Vec3::new(x[0], x[1], x[2]), Vec3::new(x[3], x[4], x[5]), r)
            };
            let (p, q) = (lift(p), lift(q));
            for x in [
                solid::wasserstein(p, q),
                solid::kullback_leibler(p, q),
                solid::jeffreys(p, q),
                solid::bhattacharyya(p, q),
                solid::probiou(p, q),
                solid::kfiou(p, q),
            ] {
                assert!(x.value.is_finite() && x.value >= 0.0, "{family} {x:?}");
                assert!(
                    x.derivative.iter().all(|s| s.is_finite()),
                    "{family} {x:?} {p:?} {q:?}"
                );
            }
        }
    }
    for size in [
        (0.0, 0.0),
        (1.0, 0.0),
        (1e-6, 1.0),
        (1.0, 1.0),
        (1e30, 1e-30),
    ] {
        for other in [(0.0, 0.0), (1.0, 0.0), (2.0, 2.0), (1e-30, 1e30)] {
            for at in [0.0_f32, 1.0, 1e30] {
                let lift = |x: [f32; 5], from: usize| {
                    let x: [Jet<f32, 10>; 5] =
                        std::array::from_fn(|i| Jet::variable(x[i], from + i));
                    Obb2::new(x[0], x[1], x[2], x[3], x[4])
                };
                let p = lift([0.0, 0.0, size.0, size.1, 0.2], 0);
                let q = lift([at, 0.0, other.0, other.1, 0.7], 5);
                for x in [
                    gaussian::wasserstein(p, q),
                    gaussian::kullback_leibler(p, q),
                    gaussian::jeffreys(p, q),
                    gaussian::bhattacharyya(p, q),
                    gaussian::probiou(p, q),
                    gaussian::kfiou(p, q),
                ] {
                    assert!(x.value.is_finite() && x.value >= 0.0, "{p:?} {q:?} {x:?}");
                    assert!(
                        x.derivative.iter().all(|s| !s.is_nan()),
                        "{p:?} {q:?} {x:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_the_value() {
    let mut random = Random(74);
    type Loss = (
        fn(Obb3<f64>, Obb3<f64>) -> f64,
        fn(Obb3<Jet<f64, 10>>, Obb3<Jet<f64, 10>>) -> Jet<f64, 10>,
    );
    let losses: [Loss; 6] = [
        (solid::wasserstein, solid::wasserstein),
        (solid::wasserstein_squared, solid::wasserstein_squared),
        (solid::kullback_leibler, solid::kullback_leibler),
        (solid::bhattacharyya, solid::bhattacharyya),
        (solid::probiou, solid::probiou),
        (solid::kfiou, solid::kfiou),
    ];
    for _ in 0..30 {
        let (a, b) = pair("random", &mut random);
        let _ = random_rotation(&mut random);
        let numbers = |x: Obb3<f64>| {
            let (c, s, r) = (x.center, x.size, x.rotation);
            [c.x, c.y, c.z, s.x, s.y, s.z, r.w, r.x, r.y, r.z]
        };
        fn made<S>(x: [S; 10]) -> Obb3<S> {
            let [a, b, c, d, e, f, w, x, y, z] = x;
            Obb3::new(
                Vec3::new(a, b, c),
                Vec3::new(d, e, f),
                Rotation3::new(w, x, y, z),
            )
        }
        let x = numbers(a);
        for (n, (value, derivatives)) in losses.iter().enumerate() {
            let lifted = made(std::array::from_fn(|i| Jet::variable(x[i], i)));
            let found = derivatives(lifted, made(numbers(b).map(Scalar::lit)));
            for i in 0..10 {
                let at = |h: f64| {
                    let mut x = x;
                    x[i] += h;
                    value(made(x), b)
                };
                let numeric = (at(1e-6) - at(-1e-6)) / 2e-6;
                let error = (numeric - found.derivative[i]).abs();
                assert!(
                    error < 1e-7 * (1.0 + numeric.abs()),
                    "{n} {i} {numeric} {}",
                    found.derivative[i]
                );
            }
        }
    }
}

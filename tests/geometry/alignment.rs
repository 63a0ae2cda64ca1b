//! Nearest rotations, alignments and cameras, against differences and brute force.
use super::pairs::{Random, random_rotation};
use geograd::Jet;
use geograd::camera::{BrownConrady, Fisheye, Pinhole};
use geograd::check::Check;
use geograd::prelude::*;
use geograd::procrustes::{procrustes, procrustes_rigid};

/// A matrix with singular values s (the last negative for a mirroring one), and its nearest rotation.
fn with_singular_values(random: &mut Random, s: [f64; 3]) -> ([Vec3<f64>; 3], Rotation3<f64>) {
    let (u, v) = (random_rotation(random), random_rotation(random));
    let back = v.matrix();
    let [x, y, z] = u.axes();
    let column =
        |j: usize| x * (s[0] * back[j][0]) + y * (s[1] * back[j][1]) + z * (s[2] * back[j][2]);
    ([column(0), column(1), column(2)], u * v.inverse())
}

#[test]
fn nearest_rotations_have_derivatives_at_repeated_singular_values() {
    let mut random = Random(16);
    let families = [
        [3.0, 2.0, 1.0],
        [2.0, 2.0, 2.0],
        [2.0, 2.0, 1.0],
        [3.0, 1.0, 1.0],
        [3.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [3.0, 2.0, -1.0],
        [3.0, 3.0, -1.0],
        [3.0, 2.0, -1.99],
        [1e-100, 1e-100, 1e-100],
        [1e100, 1e99, 1e99],
    ];
    for s in families {
        for _ in 0..40 {
            let (h, expected) = with_singular_values(&mut random, s);
            let found = Rotation3::nearest_to(h);
            assert!(
                found.angle_to(expected) < 1e-14 * s[0] / (s[1] + s[2]),
                "{s:?}"
            );
            let way = [
                random.vector(s[0]),
                random.vector(s[0]),
                random.vector(s[0]),
            ];
            let at = |t: f64| {
                let moved = [h[0] + way[0] * t, h[1] + way[1] * t, h[2] + way[2] * t];
                found.tangent_to(Rotation3::nearest_to(moved))
            };
            let d = if s[2] == -1.99 { 1e-6 } else { 1e-4 };
            // Differences of fourth order.
            let numeric =
                ((at(d) - at(-d)) * 8.0 - (at(2.0 * d) - at(-2.0 * d))) * (1.0 / (12.0 * d));
            let curved = (at(d) + at(-d)) * (1.0 / (d * d));
            // A second-order number by nesting.
            let t = Jet::<Jet<f64, 1>, 1>::variable(Jet::variable(0.0, 0), 0);
            let lift = |v: Vec3<f64>| v.lift::<Jet<Jet<f64, 1>, 1>>();
            let moved = [0, 1, 2].map(|i| lift(h[i]) + lift(way[i]) * t);
            let step = found.lift().tangent_to(Rotation3::nearest_to(moved));
            let first = Vec3::new(
                step.x.derivative[0].value,
                step.y.derivative[0].value,
                step.z.derivative[0].value,
            );
            let second = Vec3::new(
                step.x.derivative[0].derivative[0],
                step.y.derivative[0].derivative[0],
                step.z.derivative[0].derivative[0],
            );
            let size = 1.0 + first.length();
            assert!(
                first.distance(numeric) < 1e-9 * size * size,
                "{s:?}: {first} {numeric}"
            );
            if s[2] != -1.99 {
                assert!(
                    second.distance(curved) < 1e-5 * (1.0 + second.length()),
                    "{s:?}: {second} {curved}"
                );
            }
        }
    }
}

#[test]
fn nearest_rotations_are_nearest_and_finite_where_they_are_not_unique() {
    let mut random = Random(17);
    for s in [
        [3.0, 1.0, 0.5],
        [3.0, 2.0, -2.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, -1.0],
        [0.0; 3],
        [1.0, 1e-16, 0.0],
    ] {
        for _ in 0..40 {
            let (h, _) = with_singular_values(&mut random, s);
            let score = |q: Rotation3<f64>| {
                q.axes()
                    .into_iter()
                    .zip(h)
                    .map(|(a, b)| a.dot(b))
                    .sum::<f64>()
            };
            let found = Rotation3::nearest_to(h);
            let best = score(found);
            assert!((best - s.iter().sum::<f64>()).abs() < 1e-14, "{s:?}");
            for _ in 0..30 {
                assert!(score(random_rotation(&mut random)) <= best + 1e-15);
                assert!(score(found.retract(random.vector(1e-3))) <= best + 1e-15);
            }
            let lifted: [Vec3<Jet<f64, 9>>; 3] = {
                let mut next = 0..9;
                h.map(|v| v.remake(&mut |&x| Jet::variable(x, next.next().unwrap())))
            };
            let q = Rotation3::nearest_to(lifted);
            for x in q.scalars() {
                assert!(x.derivative.iter().all(|d| d.abs() < 1e3), "{s:?}");
            }
        }
    }
    assert_eq!(
        Rotation3::nearest_to([Vec3::zero(); 3]),
        Rotation3::<f64>::identity()
    );
    // A line turns by the smallest angle.
    let (from, to) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.6, 0.8, 0.0));
    let found: Rotation3<f64> = Rotation3::nearest_to([to * from.x, to * from.y, to * from.z]);
    assert!((found.angle() - 0.8_f64.atan2(0.6)).abs() < 1e-15);
}

#[test]
fn alignments_are_found_and_differentiated() {
    let mut random = Random(18);
    for round in 0..60 {
        let q = random_rotation(&mut random);
        let far = [0.0, 1e3, 1e6][round % 3];
        let pose = Pose3::new(random.vector(1.0 + far), q);
        let scale = random.between(0.1, 5.0);
        let points: Vec<_> = (0..7).map(|_| random.vector(1.0)).collect();
        let weights: Vec<_> = (0..7).map(|_| random.between(0.1, 1.0)).collect();
        let targets: Vec<_> = points.iter().map(|&p| pose * (p * scale)).collect();
        let found = procrustes(&points, &targets, &weights).unwrap();
        let slack = 1e-14 * (1.0 + far);
        assert!(
            (found.scale - scale).abs() < 10.0 * slack
                && found.pose.rotation.angle_to(q) < 30.0 * slack
        );
        let rigid: Vec<_> = points.iter().map(|&p| pose * p).collect();
        let found = procrustes_rigid(&points, &rigid, &weights).unwrap();
        assert!(found.translation.distance(pose.translation) < 100.0 * slack);

        // Residuals, after noise: no other similarity is better, and derivatives are those of differences.
        let noisy: Vec<_> = points.iter().map(|&p| q * p + random.vector(0.3)).collect();
        let best = procrustes(&points, &noisy, &weights).unwrap();
        let cost = |pose: Pose3<f64>, scale: f64| {
            let each =
                |i: usize| weights[i] * (pose * (points[i] * scale)).squared_distance(noisy[i]);
            (0..7).map(each).sum::<f64>()
        };
        let least = cost(best.pose, best.scale);
        for _ in 0..30 {
            let pose = best.pose.retract(random.vector(1e-3), random.vector(1e-3));
            assert!(cost(pose, best.scale * random.between(0.999, 1.001)) >= least);
        }
        let way = random.vector(1.0);
        let probe = |points: &[Vec3<f64>], weights: &[f64]| {
            let found = procrustes(points, &noisy, weights).unwrap();
            (found * Vec3::new(0.3, -0.2, 0.9)).dot(way)
        };
        let moved = |i: usize, t: f64| {
            let mut points = points.clone();
            points[i].y += t;
            probe(&points, &weights)
        };
        let weighed = |i: usize, t: f64| {
            let mut weights = weights.clone();
            weights[i] += t;
            probe(&points, &weights)
        };
        let i = round % 7;
        let lift = |all: &[Vec3<f64>]| {
            all.iter()
                .map(|p| p.lift::<Jet<f64, 2>>())
                .collect::<Vec<_>>()
        };
        let (mut lifted, targets) = (lift(&points), lift(&noisy));
        let mut weights: Vec<_> = weights.iter().map(|&w| Jet::<f64, 2>::lit(w)).collect();
        lifted[i].y = Jet::variable(points[i].y, 0);
        weights[i] = Jet::variable(weights[i].value, 1);
        let found = procrustes(&lifted, &targets, &weights).unwrap();
        let out = (found * Vec3::new(0.3, -0.2, 0.9).lift()).dot(way.lift());
        let d = 1e-5;
        for (k, numeric) in [
            (moved(i, d) - moved(i, -d)) / (2.0 * d),
            (weighed(i, d) - weighed(i, -d)) / (2.0 * d),
        ]
        .into_iter()
        .enumerate()
        {
            assert!(
                (out.derivative[k] - numeric).abs() < 1e-8,
                "{} {numeric}",
                out.derivative[k]
            );
        }
    }
    let same = [Vec3::new(1.0_f64, 2.0, 3.0); 3];
    let found = procrustes(&same, &same, &[1.0; 3]).unwrap();
    assert_eq!(
        (found.scale, found.pose.rotation),
        (1.0, Rotation3::identity())
    );
    let found = procrustes(&same, &same, &[0.0; 3]).unwrap();
    assert_eq!(found.pose, Pose3::identity());
    assert!(procrustes(&same, &same[..2], &[1.0; 3]).is_err());
    assert!(procrustes::<f64>(&[], &[], &[]).is_ok());
}

#[test]
fn cameras_follow_their_models() {
    if !geograd_tests::is_due("cameras_follow_their_models") {
        return;
    }
    let mut random = Random(19);
    for _ in 0..500 {
        let pinhole = Pinhole::new(Vec2::new(500.0, 510.0), Vec2::new(320.0, 240.0));
        let point = random.vector(1.0);
        let k = [0, 1, 2, 3].map(|_| random.between(-0.2, 0.2));
        let fisheye = Fisheye { pinhole, radial: k };
        if fisheye.sees(point) {
            let angle = (point.x.hypot(point.y)).atan2(point.z);
            let bent = angle
                + (0..4)
                    .map(|i| k[i] * angle.powi(2 * i as i32 + 3))
                    .sum::<f64>();
            let (sin, cos) = point.y.atan2(point.x).sin_cos();
            let expected = Vec2::new(320.0 + 500.0 * bent * cos, 240.0 + 510.0 * bent * sin);
            let size = 1.0 + expected.length();
            assert!((fisheye.project(point) - expected).length() < 1e-14 * size);
            for t in 0..=400 {
                let at = angle * f64::from(t) / 400.0;
                let slope = 1.0
                    + (0..4)
                        .map(|i| (2 * i + 3) as f64 * k[i] * at.powi(2 * i as i32 + 2))
                        .sum::<f64>();
                assert!(slope > 0.0);
            }
        }
        let camera = BrownConrady {
            pinhole,
            radial: [k[0], k[1], k[2]],
            tangential: [0.01, -0.02],
        };
        if camera.sees(point) {
            let (x, y) = (point.x / point.z, point.y / point.z);
            let u = x * x + y * y;
            let radial = 1.0 + k[0] * u + k[1] * u.powi(2) + k[2] * u.powi(3);
            let px = x * radial + 2.0 * 0.01 * x * y - 0.02 * (u + 2.0 * x * x);
            let py = y * radial + 0.01 * (u + 2.0 * y * y) - 2.0 * 0.02 * x * y;
            let expected = Vec2::new(320.0 + 500.0 * px, 240.0 + 510.0 * py);
            let size = 1.0 + expected.length();
            assert!((camera.project(point) - expected).length() < 1e-14 * size);
        }
    }
    let pinhole = Pinhole::new(Vec2::new(500.0, 510.0), Vec2::new(320.0, 240.0));
    let fisheye = Fisheye {
        pinhole,
        radial: [0.01, 0.0, 0.0, 0.0],
    };
    for point in [
        Vec3::zero(),
        Vec3::new(0.0, 0.0, 1.0),
        Vec3::new(0.0, 0.0, -1.0),
        Vec3::new(0.3, 0.0, 0.0),
    ] {
        let (value, by): (f64, _) =
            geograd::gradient(|p: Vec3<_>| fisheye.lift().project(p).x, point);
        assert!(value.is_finite() && by.is_finite());
        let (value, by): (f64, _) =
            geograd::gradient(|p: Vec3<_>| pinhole.lift().project(p).x, point);
        assert!(value.is_finite() && by.is_finite());
    }
    Check::of(Project.row::<(Vec3<f64>, Pinhole<f64>)>())
        .samples(200)
        .assert();
    Check::of(Project.row::<(Vec3<f64>, BrownConrady<f64>)>())
        .samples(200)
        .assert();
    Check::of(Project.row::<(Vec3<f64>, Fisheye<f64>)>())
        .samples(200)
        .assert();
}

/// How far an alignment takes a probe, a number that depends on all of its parts.
fn reach<S: Scalar>(points: [Vec3<S>; 4], targets: [Vec3<S>; 4], weights: [S; 4]) -> S {
    let probe = Vec3::new(S::lit(0.3), S::lit(-0.2), S::lit(0.9));
    match procrustes(&points, &targets, &weights) {
        Ok(found) => (found * probe).dot(Vec3::new(S::lit(0.5), S::one(), S::lit(-0.7))),
        Err(_) => S::zero(),
    }
}

#[test]
fn adjoints_of_alignments_are_those_of_duals() {
    let mut random = Random(20);
    let (corner, zero) = (Vec3::new(1.0, 1.0, 1.0), Vec3::zero());
    let flip = |v: Vec3<f64>| Vec3::new(-v.x, v.y, v.z);
    // All singular values are equal, or two of them, or the smallest is negative.
    let tetrahedron = [
        corner,
        Vec3::new(1.0, -1.0, -1.0),
        Vec3::new(-1.0, 1.0, -1.0),
        Vec3::new(-1.0, -1.0, 1.0),
    ];
    let mut lists = vec![(tetrahedron, tetrahedron)];
    lists.push((
        tetrahedron,
        tetrahedron.map(|v| flip(v) + random.vector(0.2)),
    ));
    lists.push(([zero, corner, corner * 2.0, corner * 3.0], tetrahedron));
    lists.push(([corner; 4], tetrahedron));
    for _ in 0..20 {
        lists.push((tetrahedron, [0; 4].map(|_| random.vector(1.0))));
    }
    let points: Vec<_> = lists.iter().map(|x| x.0).collect();
    let targets: Vec<_> = lists.iter().map(|x| x.1).collect();
    let columns = (&points, &targets, One([1.0, 0.5, 0.25, 2.0]));
    let run = geograd::kernels::function(reach).value_grad();
    let (values, (by_points, by_targets, by_weights)) = Cpu::new().aligned(run, columns).unwrap();
    for (i, &(p, q)) in lists.iter().enumerate() {
        let input = (p, q, [1.0, 0.5, 0.25, 2.0]);
        let (value, by) = gradient(
            |(p, q, w): ([Vec3<_>; 4], [Vec3<_>; 4], [_; 4])| reach(p, q, w),
            input,
        );
        assert!((values[i] - value).abs() < 1e-14);
        let found = (by_points[i], by_targets[i], by_weights[i]).scalars();
        for (a, b) in found.into_iter().zip(by.scalars()) {
            assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{i}: {a} {b}");
        }
    }
}

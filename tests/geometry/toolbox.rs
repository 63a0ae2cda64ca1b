//! The box toolbox: losses on hard pairs, boxes of two kinds, points and boxes.
use super::pairs::{FAMILIES, Random, pair, random_rotation};
use geograd::ad::{gradient, hessian};
use geograd::error::{Argument, Error};
use geograd::gaussian::{self, solid};
use geograd::iou::separation_aware_obb2;
use geograd::iou3::{Enclosing, diou, giou};
use geograd::kernels::Cpu;
use geograd::kernels::points::Container;
use geograd::overlap3::iou_obb3;
use geograd::{Aabb2, Aabb3, Obb2, Obb3, Pack, Plane3, Vec2, Vec3, YawBox3, distance3};

fn relative(a: f64, b: f64) -> f64 {
    (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE)
}

/// Kullback-Leibler and Bhattacharyya by sums of positive terms over squared sines and cosines.
fn by_positive_terms(a: Obb2<f64>, b: Obb2<f64>) -> [f64; 2] {
    let half = |x: Obb2<f64>| [x.size.x / 2.0, x.size.y / 2.0];
    let (p, q) = (half(a), half(b));
    let (sin, cos) = (b.heading - a.heading).sin_cos();
    let d = [[cos * cos, sin * sin], [sin * sin, cos * cos]];
    let sum = |of: &dyn Fn(usize, usize) -> f64| -> f64 {
        (0..4).map(|n| d[n / 2][n % 2] * of(n / 2, n % 2)).sum()
    };
    let trace = sum(&|i, j| (p[i] / q[j]).powi(2));
    let kl = 0.5 * (trace - 2.0 - 2.0 * ((p[0] / q[0]).ln() + (p[1] / q[1]).ln()));
    // det(Σa + Σb) over 4 √(det Σa det Σb).
    let own = p[0] * p[1] / (q[0] * q[1]);
    let mixed = sum(&|i, j| p[i] * p[i] * (q[1 - j] * q[1 - j]));
    let ratio = (own + 1.0 / own + mixed / (p[0] * p[1] * q[0] * q[1])) / 4.0;
    [kl, 0.5 * ratio.ln()]
}

#[test]
fn thin_boxes_keep_their_digits() {
    let mut random = Random(201);
    for n in 0..200 {
        let aspect = 10_f64.powf(random.between(1.0, 6.0));
        let size = Vec2::new(aspect, random.between(0.5, 2.0));
        let other = Vec2::new(
            random.between(0.5, 2.0),
            10_f64.powf(random.between(0.0, 6.0)),
        );
        let turn = if n % 2 == 0 {
            random.between(-3.0, 3.0)
        } else {
            random.between(0.0, 1e-3)
        };
        let a = Obb2 {
            center: Vec2::zero(),
            size,
            heading: 0.0,
        };
        let b = Obb2 {
            center: Vec2::zero(),
            size: other,
            heading: turn,
        };
        let [kl, distance] = by_positive_terms(a, b);
        assert!(
            relative(kl, gaussian::kullback_leibler(a, b)) < 1e-11,
            "{a:?} {b:?}"
        );
        assert!(
            relative(distance, gaussian::bhattacharyya(a, b)) < 1e-9,
            "{a:?} {b:?}"
        );
        let lift = |x: Obb2<f64>| {
            let flat = |v: Vec2<f64>, z| Vec3::new(v.x, v.y, z);
            Obb3::from(YawBox3::new(
                flat(x.center, 0.0),
                flat(x.size, 1.0),
                x.heading,
            ))
        };
        assert!(
            relative(kl, solid::kullback_leibler(lift(a), lift(b))) < 1e-8,
            "{a:?} {b:?}"
        );
    }
}

#[test]
fn zero_sizes_have_finite_losses_in_every_format() {
    let shapes = [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 2.0, 0.0, 3.0, 0.5],
        [0.0, 1.0, 4.0, 0.0, 0.3],
        [5.0, 5.0, 2.0, 2.0, 0.1],
        [1e6, 0.0, 0.0, 0.0, 2.0],
    ];
    let losses: [fn(Obb2<f64>, Obb2<f64>) -> f64; 5] = [
        gaussian::kullback_leibler,
        gaussian::jeffreys,
        gaussian::bhattacharyya,
        gaussian::probiou,
        gaussian::kfiou,
    ];
    let narrow: [fn(Obb2<f32>, Obb2<f32>) -> f32; 5] = [
        gaussian::kullback_leibler,
        gaussian::jeffreys,
        gaussian::bhattacharyya,
        gaussian::probiou,
        gaussian::kfiou,
    ];
    for p in shapes {
        for q in shapes {
            let made = |x: [f64; 5]| Obb2::new(x[0], x[1], x[2], x[3], x[4]);
            let single = |x: [f64; 5]| {
                let x = x.map(|x| x as f32);
                Obb2::new(x[0], x[1], x[2], x[3], x[4])
            };
            for (wide, narrow) in losses.iter().zip(narrow) {
                let (value, single) = (wide(made(p), made(q)), narrow(single(p), single(q)));
                assert!(value.is_finite() && single.is_finite(), "{p:?} {q:?}");
                let gap = (value - f64::from(single)).abs();
                assert!(
                    gap <= 1e-3 * value.abs() + 1e-6,
                    "{p:?} {q:?} {value} {single}"
                );
            }
        }
    }
    // A distance does not saturate before the largest number does.
    let (a, b) = (
        Obb2::new(0.0_f32, 0.0, 1.0, 1.0, 0.0),
        Obb2::new(1e20, 0.0, 1.0, 1.0, 0.0),
    );
    assert_eq!(gaussian::wasserstein(a, b), 1e20);
    // Derivatives go through the least size: it grows with the pair.
    let (a, b) = (
        Obb2::new(0.0, 0.0, 0.0, 1.0, 0.0),
        Obb2::new(0.25, 0.0, 2.0, 1.0, 0.0),
    );
    let (_, derivatives) = gradient(|b: Obb2<_>| gaussian::kullback_leibler(b, a.lift()), b);
    let step = 1e-6;
    let at = |x: f64| gaussian::kullback_leibler(Obb2::new(0.25, 0.0, x, 1.0, 0.0), a);
    let difference = (at(2.0 + step) - at(2.0 - step)) / (2.0 * step);
    assert!(relative(derivatives.size.x, difference) < 1e-6 || derivatives.size.x.abs() < 1e-3);
}

#[test]
fn second_derivatives_of_wasserstein_in_space() {
    let mut random = Random(203);
    for family in ["random", "upright", "nearly parallel"] {
        let (a, b) = pair(family, &mut random);
        let value = |x: Obb3<_>| solid::wasserstein_squared(x, b.lift());
        let (_, _, curvature) = hessian(value, a);
        let bends: Vec<f64> = curvature
            .scalars()
            .iter()
            .flat_map(|row| row.scalars())
            .collect();
        let derivatives = |x: &[f64]| {
            gradient(
                |x: Obb3<_>| solid::wasserstein_squared(x, b.lift()),
                a.refill(x),
            )
            .1
            .scalars()
        };
        let x = a.scalars();
        for i in 0..x.len() {
            let moved = |h: f64| {
                let mut there = x.clone();
                there[i] += h;
                derivatives(&there)
            };
            let (up, down) = (moved(1e-5), moved(-1e-5));
            for j in 0..x.len() {
                let difference = (up[j] - down[j]) / 2e-5;
                let bend = bends[i * x.len() + j];
                assert!(
                    (bend - difference).abs() < 1e-5 * (1.0 + bend.abs()),
                    "{family} {i} {j}: {bend} {difference}"
                );
            }
        }
    }
}

#[test]
fn enclosing_shapes_are_inside_each_other() {
    let mut random = Random(205);
    for _ in 0..100 {
        let (a, mut b) = (random.yaw_box(), random.yaw_box());
        b.center += random.vector(3.0);
        let [whole, rectangle, hull] =
            [Enclosing::Aabb, Enclosing::Rectangle, Enclosing::Hull].map(|kind| giou(a, b, kind));
        assert!(whole <= rectangle + 1e-12 && rectangle <= hull + 1e-12);
        assert!(hull <= a.iou(b) + 1e-12 && hull > -1.0);
        assert!(diou(a, b, Enclosing::Hull) <= a.iou(b));
        // Not turned, all kinds of boxes agree.
        let (p, q) = (a.bounding(), b.bounding());
        for kind in [Enclosing::Aabb, Enclosing::Rectangle, Enclosing::Hull] {
            let (flat, upright) = (
                giou(p, q, kind),
                giou(YawBox3::from(p), YawBox3::from(q), kind),
            );
            assert!((flat - upright).abs() < 1e-12, "{kind:?} {flat} {upright}");
        }
        let any = giou(Obb3::from(p), Obb3::from(q), Enclosing::Aabb);
        assert!((giou(p, q, Enclosing::Aabb) - any).abs() < 1e-12);
    }
}

#[test]
fn boxes_of_two_kinds() {
    let mut random = Random(207);
    for _ in 0..100 {
        let (upright, bounds) = (random.yaw_box(), random.yaw_box().bounding());
        let turned = Obb3::new(
            random.vector(1.0),
            random.size(),
            random_rotation(&mut random),
        );
        let (a, b) = (Obb3::from(upright), Obb3::from(bounds));
        let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{x} {y}");
        near(upright.iou(turned), iou_obb3(a, turned));
        near(turned.iou(upright), iou_obb3(turned, a));
        near(bounds.iou(turned), iou_obb3(b, turned));
        near(upright.iou(bounds), iou_obb3(a, b));
        near(
            bounds.iof(upright) * bounds.volume(),
            bounds.intersection_volume(upright),
        );
        near(bounds.iou(bounds), 1.0);
    }
}

#[test]
fn separation_of_rotated_boxes_is_that_of_columns() {
    let mut random = Random(209);
    for _ in 0..200 {
        let (mut a, mut b) = (random.yaw_box(), random.yaw_box());
        (a.center.z, b.center.z, a.size.z, b.size.z) = (0.0, 0.0, 0.5, 0.5);
        b.center += Vec3::new(random.between(-4.0, 4.0), random.between(-4.0, 4.0), 0.0);
        let flat = separation_aware_obb2(a.birds_eye(), b.birds_eye());
        let deep = geograd::iou3::separation_aware(a, b);
        // The largest size of a column may be its height.
        if a.size.x.max(a.size.y) > 0.5 && b.size.x.max(b.size.y) > 0.5 {
            assert!((flat - deep).abs() < 1e-12, "{a:?} {b:?} {flat} {deep}");
        }
        assert!((flat - separation_aware_obb2(b.birds_eye(), a.birds_eye())).abs() < 1e-13);
    }
}

#[test]
fn separation_of_parallel_boxes_has_the_mean_of_both_ways_of_turning() {
    use geograd::ad::forward::gradient;
    let mut random = Random(210);
    let mut turning = 0;
    for _ in 0..500 {
        let mut shape = |x: f64| {
            let [width, height] = [(); 2].map(|()| random.between(0.0, 3.0));
            let [x, y] = [x, 0.0].map(|x| x + random.between(-4.0, 4.0));
            geograd::Obb2::new(x, y, width, height, 0.0)
        };
        let (a, b) = (shape(0.0), shape(6.0));
        let (value, (derivatives, _)) = gradient(|(a, b)| separation_aware_obb2(a, b), (a, b));
        if value > -1e-3 {
            continue;
        }
        let turned = |by: f64| separation_aware_obb2(geograd::Obb2 { heading: by, ..a }, b);
        let step = 1e-7;
        let [left, right] = [-step, step].map(|by| (turned(by) - value) / by);
        let mean = (left + right) / 2.0;
        assert!(
            (derivatives.heading - mean).abs() < 1e-6,
            "{a:?} {b:?} {left} {right}"
        );
        turning += u32::from((left - right).abs() > 1e-3);
    }
    assert!(turning > 100, "{turning}");
}

#[test]
fn signed_distances_are_those_of_planes_and_corners() {
    let mut random = Random(211);
    for family in FAMILIES {
        let (a, _) = pair(family, &mut random);
        for _ in 0..20 {
            let reach = a.size.x.max(a.size.y).max(a.size.z);
            let point = a.center + random.vector(1.0) * reach;
            let found = distance3::signed_distance(point, a);
            let depth = a
                .planes()
                .map(|plane: Plane3<f64>| plane.normal.dot(point) - plane.offset);
            let deepest = depth.into_iter().fold(f64::MIN, f64::max);
            let tolerance = 1e-12 * (reach + a.center.length());
            if deepest <= 0.0 {
                assert!(
                    (found - deepest).abs() < tolerance,
                    "{family} {found} {deepest}"
                );
                assert_eq!(distance3::distance(point, a), 0.0);
            } else {
                // The nearest place, by moving inwards across one face after the other.
                let mut nearest = point;
                for plane in a.planes() {
                    let out = plane.normal.dot(nearest) - plane.offset;
                    if out > 0.0 {
                        nearest -= plane.normal * out;
                    }
                }
                let expected = (point - nearest).length();
                assert!(
                    (found - expected).abs() < tolerance,
                    "{family} {found} {expected}"
                );
                assert_eq!(distance3::distance(point, a), found);
            }
        }
        let upright = YawBox3::new(a.center, a.size, 0.7);
        let point = upright.center + random.vector(3.0);
        let gap = distance3::signed_distance(point, upright)
            - distance3::signed_distance(point, Obb3::from(upright));
        assert!(
            gap.abs() < 1e-12 * (3.0 + a.center.length()),
            "{family} {gap}"
        );
    }
    let bounds = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 2.0, 3.0));
    let (value, derivatives) = gradient(
        |p: Vec3<_>| distance3::signed_distance(p, bounds.lift()),
        Vec3::new(1.0, 1.0, 1.0),
    );
    // On a face the signed distance is smooth.
    assert_eq!((value, derivatives), (0.0, Vec3::new(1.0, 0.0, 0.0)));
}

/// The loop over all points and boxes.
fn looped<B: Container>(points: &[B::Point], boxes: &[B]) -> Vec<(usize, usize)> {
    let mut all = Vec::new();
    for (n, &point) in points.iter().enumerate() {
        for (i, one) in boxes.iter().enumerate() {
            if one.holds(point) {
                all.push((n, i));
            }
        }
    }
    all
}

fn same_as_loop<B: Container>(points: &[B::Point], boxes: &[B]) {
    let cpu = Cpu::new();
    let expected = looped(points, boxes);
    assert_eq!(cpu.boxes_of_points(points, boxes).unwrap(), expected);
    let first = cpu.first_box(points, boxes).unwrap();
    let counts = cpu.points_per_box(points, boxes).unwrap();
    for (n, first) in first.into_iter().enumerate() {
        assert_eq!(
            first,
            expected.iter().find(|pair| pair.0 == n).map(|pair| pair.1)
        );
    }
    for (i, count) in counts.into_iter().enumerate() {
        assert_eq!(count, expected.iter().filter(|pair| pair.1 == i).count());
    }
}

#[test]
fn points_find_the_boxes_of_the_loop() {
    let mut random = Random(213);
    for (count, far) in [(0, 0.0), (1, 0.0), (9, 1e6), (150, 0.0), (150, 1e5)] {
        let turned: Vec<Obb3<f64>> = (0..count)
            .map(|_| {
                let center = random.vector(6.0) + Vec3::new(far, -far, 0.0);
                Obb3::new(center, random.size(), random_rotation(&mut random))
            })
            .collect();
        let upright: Vec<YawBox3<f64>> = turned
            .iter()
            .map(|x| YawBox3::new(x.center, x.size, x.center.x))
            .collect();
        let bounds: Vec<Aabb3<f64>> = turned.iter().map(|x| x.bounding()).collect();
        // Corners are on the border, as far as rounding lets them be.
        let mut points: Vec<Vec3<f64>> = turned.iter().take(20).flat_map(|x| x.corners()).collect();
        points.extend((0..300).map(|_| random.vector(7.0) + Vec3::new(far, -far, 0.0)));
        same_as_loop(&points, &turned);
        same_as_loop(&points, &upright);
        same_as_loop(&points, &bounds);
        let single: Vec<Obb3<f32>> = turned
            .iter()
            .map(|x| x.remake(&mut |&x| x as f32))
            .collect();
        let places: Vec<Vec3<f32>> = points
            .iter()
            .map(|x| x.remake(&mut |&x| x as f32))
            .collect();
        same_as_loop(&places, &single);
        let flat: Vec<Obb2<f64>> = upright.iter().map(|x| x.birds_eye()).collect();
        let rectangles: Vec<Aabb2<f64>> = flat.iter().map(|x| x.bounding()).collect();
        let ground: Vec<Vec2<f64>> = points.iter().map(|p| Vec2::new(p.x, p.y)).collect();
        same_as_loop(&ground, &flat);
        same_as_loop(&ground, &rectangles);
    }
    let bad = [Vec2::new(0.0, 0.0), Vec2::new(f64::NAN, 0.0)];
    let found = Cpu::new().first_box(&bad, &[Aabb2::new(0.0, 0.0, 1.0, 1.0)]);
    assert!(matches!(
        found,
        Err(Error::Invalid {
            argument: Argument::Named("points"),
            item: 1,
            ..
        })
    ));
    let wrong = [
        Aabb2::new(0.0, 0.0, 1.0, 1.0),
        Aabb2::new(1.0, 0.0, 0.0, 1.0),
    ];
    let found = Cpu::new().points_per_box(&bad[..1], &wrong);
    assert!(matches!(
        found,
        Err(Error::Invalid {
            argument: Argument::Named("boxes"),
            item: 1,
            ..
        })
    ));
}

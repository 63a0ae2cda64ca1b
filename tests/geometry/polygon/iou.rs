//! The family of intersection over union against brute force, and its derivatives.
use super::cases::{Polygon, convex, hard};
use super::exact;
use super::overlap::variables;
use geograd::ad::adjoint::iou::{giou_obb2_grad, giou_obb2_vjp};
use geograd::iou::*;
use geograd::{Aabb2, ConvexPolygon, Fixed, Jet, Obb2, Pack, Vec2};
use geograd_tests::Dice;

fn corners(a: Obb2<f64>, b: Obb2<f64>) -> Vec<Vec2<f64>> {
    a.corners().into_iter().chain(b.corners()).collect()
}

fn special() -> Vec<(Obb2<f64>, Obb2<f64>)> {
    let quarter = std::f64::consts::FRAC_PI_2;
    let base = Obb2::new(0.5, 0.25, 4.0, 2.0, 0.0);
    let mut all = vec![];
    for (dx, dy, w, h, t) in [
        (0.0, 0.0, 4.0, 2.0, 0.0),
        (4.0, 0.0, 4.0, 2.0, 0.0),
        (4.0, 2.0, 4.0, 2.0, 0.0),
        (2.0, 0.0, 4.0, 2.0, 0.0),
        (0.0, 0.0, 2.0, 1.0, 0.0),
        (0.0, 0.0, 2.0, 4.0, 0.0),
        (0.0, 0.0, 4.0, 2.0, quarter),
        (9.0, 1.0, 4.0, 2.0, quarter),
        (9.0, 1.0, 4.0, 2.0, 1e-9),
        (0.0, 0.0, 4.0, 2.0, 1e-9),
        (0.0, 0.0, 0.0, 0.0, 0.3),
        (9.0, 0.0, 0.0, 0.0, 0.3),
        (9.0, 0.0, 5.0, 0.0, 0.3),
        (1.0, 0.0, 100.0, 0.001, 0.3),
        (0.0, 0.0, 4.0, 2.0, 2.0 * quarter),
        (3.0, 0.0, 4.0, 2.0, 0.4),
    ] {
        let other = Obb2::new(base.center.x + dx, base.center.y + dy, w, h, t);
        all.push((base, other));
        all.push((other, base));
    }
    all
}

fn pairs(seed: u64, count: usize) -> Vec<(Obb2<f64>, Obb2<f64>)> {
    let mut dice = Dice(seed);
    let random = (0..count).map(|_| (dice.obb(), dice.obb()));
    random
        .collect::<Vec<_>>()
        .into_iter()
        .chain(special())
        .collect()
}

#[test]
fn hulls_of_boxes_are_those_of_their_corners() {
    for (a, b) in pairs(31, 300) {
        let truth = exact::ring_area(&exact::hull(&corners(a, b)));
        let found = hull_area_obb2(a, b);
        assert!(
            (found - truth).abs() <= 2e-14 * truth.max(1.0),
            "{a} {b} {found} {truth}"
        );
        let (c, d) = (a.bounding(), b.bounding());
        let all: Vec<_> = c.corners().into_iter().chain(d.corners()).collect();
        let truth = exact::ring_area(&exact::hull(&all));
        assert!((hull_area_aabb2(c, d) - truth).abs() <= 2e-14 * truth.max(1.0));
    }
}

#[test]
fn scores_are_those_of_their_formulas() {
    for (a, b) in pairs(32, 300) {
        let all = corners(a, b);
        let hull = exact::ring_area(&exact::hull(&all));
        let iou: f64 = a.iou(b);
        let union = (a.area() + b.area()) / (1.0 + iou);
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{a} {b} {x} {y}");
        if hull > 0.0 {
            close(giou_obb2(a, b), iou - (hull - union) / hull);
        }
        let polygon = |x: Obb2<f64>| ConvexPolygon::from(x);
        if a.area() > 0.0 && b.area() > 0.0 {
            let (giou, _) = giou_polygons_search::<f64, 4, 4, 8>(&polygon(a), &polygon(b)).unwrap();
            close(giou_obb2(a, b), giou);
            close(
                diou_obb2(a, b),
                diou_polygons_search(&polygon(a), &polygon(b)).0,
            );
        }
        let far = all
            .iter()
            .flat_map(|p| all.iter().map(move |q| p.distance(*q)))
            .fold(0.0, f64::max);
        let way = a.center.distance(b.center);
        close(diou_obb2(a, b), iou - (way / far).powi(2));
        let diou = iou - (way / far).powi(2);
        let around = a.bounding().join(b.bounding()).size();
        let diou_aabb = iou - (way / around.length()).powi(2);
        close(diou_aabb_obb2(a, b), diou_aabb);
        close(
            giou_aabb_obb2(a, b),
            iou - (around.x * around.y - union) / (around.x * around.y),
        );
        let aspect = (a.size.x.atan2(a.size.y) - b.size.x.atan2(b.size.y)).powi(2) * 4.0
            / std::f64::consts::PI.powi(2);
        let weighted = match aspect > 0.0 {
            true => aspect * aspect / (1.0 - iou + aspect),
            false => 0.0,
        };
        close(ciou_obb2(a, b), diou - weighted);
        close(ciou_aabb_obb2(a, b), diou_aabb - weighted);
        assert_eq!(ciou_obb2(a, b), ciou_fixed_weight_obb2(a, b));
        let (wide, high) = (a.size.x - b.size.x, a.size.y - b.size.y);
        close(
            eiou_obb2(a, b),
            diou - (wide * wide + high * high) / (far * far),
        );
        // The larger of the side around both and of the sizes.
        let width = around.x.max(a.size.x).max(b.size.x);
        let height = around.y.max(a.size.y).max(b.size.y);
        let parts = (wide / width).powi(2) + (high / height).powi(2);
        close(eiou_aabb_obb2(a, b), diou_aabb - parts);
        close(alpha_iou_obb2(a, b, 3.0), iou.powi(3));
        // Axis-aligned boxes are rotated ones that are not.
        let (c, d) = (a.bounding(), b.bounding());
        let (e, f) = (Obb2::from(c), Obb2::from(d));
        close(giou_hull_aabb2(c, d), giou_obb2(e, f));
        close(diou_hull_aabb2(c, d), diou_obb2(e, f));
        close(ciou_hull_aabb2(c, d), ciou_obb2(e, f));
        close(eiou_hull_aabb2(c, d), eiou_obb2(e, f));
        close(giou_aabb2(c, d), giou_aabb_obb2(e, f));
        close(diou_aabb2(c, d), diou_aabb_obb2(e, f));
        close(ciou_aabb2(c, d), ciou_aabb_obb2(e, f));
        close(ciou_fixed_weight_aabb2(c, d), ciou_aabb_obb2(e, f));
        close(eiou_aabb2(c, d), eiou_aabb_obb2(e, f));
        close(alpha_iou_aabb2(c, d, 3.0), alpha_iou_obb2(e, f, 3.0));
    }
}

type Derivatives = Jet<f64, 10>;

fn lifted(a: Obb2<f64>, b: Obb2<f64>) -> (Obb2<Derivatives>, Obb2<Derivatives>) {
    let lift = |x: Obb2<f64>, first: usize| {
        let all = x.scalars();
        Obb2::load(&std::array::from_fn::<_, 5, _>(|k| {
            Jet::variable(all[k], first + k)
        }))
    };
    (lift(a, 0), lift(b, 5))
}

#[test]
fn the_adjoint_of_generalised_iou_has_the_derivatives() {
    let mut apart = 0;
    for (a, b) in pairs(33, 600) {
        let (x, y) = lifted(a, b);
        let value = giou_obb2(x, y);
        let (same, (by_a, by_b)) = giou_obb2_grad(a, b);
        assert_eq!(value.value, same);
        let all: Vec<f64> = by_a.scalars().into_iter().chain(by_b.scalars()).collect();
        for (k, (derivative, by_hand)) in value.derivative.iter().zip(&all).enumerate() {
            let size = 1.0 + derivative.abs();
            // A turn of 1e-9 magnifies roundings of the area of intersection.
            let slack = if (a.heading - b.heading).abs() == 1e-9 {
                1e-6
            } else {
                1e-9
            };
            assert!(
                (derivative - by_hand).abs() < slack * size,
                "{a} {b} {k} {derivative} {by_hand}"
            );
        }
        let (twice, _) = giou_obb2_vjp(a, b, 2.0);
        assert!((twice.center.x - 2.0 * by_a.center.x).abs() < 1e-9 * (1.0 + twice.center.x.abs()));
        if a.iou(b) == 0.0 && a.area() > 0.0 && b.area() > 0.0 {
            // Apart they are drawn together.
            let way = b.center - a.center;
            assert!(
                by_a.center.dot(way) > 0.0 && by_b.center.dot(way) < 0.0,
                "{a} {b}"
            );
            apart += 1;
        }
    }
    assert!(apart > 60);
}

#[test]
fn derivatives_are_those_of_differences() {
    let scores: [(
        &str,
        fn(Obb2<f64>, Obb2<f64>) -> f64,
        fn(Obb2<Derivatives>, Obb2<Derivatives>) -> Derivatives,
    ); 9] = [
        ("giou", giou_obb2, giou_obb2),
        ("giou aabb", giou_aabb_obb2, giou_aabb_obb2),
        ("diou", diou_obb2, diou_obb2),
        ("diou aabb", diou_aabb_obb2, diou_aabb_obb2),
        ("ciou", ciou_obb2, ciou_obb2),
        ("ciou aabb", ciou_aabb_obb2, ciou_aabb_obb2),
        ("eiou", eiou_obb2, eiou_obb2),
        ("eiou aabb", eiou_aabb_obb2, eiou_aabb_obb2),
        (
            "alpha",
            |a, b| alpha_iou_obb2(a, b, 3.0),
            |a, b| alpha_iou_obb2(a, b, Jet::variable(3.0, 99)),
        ),
    ];
    for (a, b) in pairs(34, 60) {
        for (name, plain, dual) in scores {
            let (x, y) = lifted(a, b);
            let value = dual(x, y);
            let all: Vec<f64> = a.scalars().into_iter().chain(b.scalars()).collect();
            for k in 0..10 {
                assert!(value.derivative[k].is_finite(), "{name} {a} {b}");
                let step = 1e-6;
                let moved = |by: f64| {
                    let mut all = all.clone();
                    all[k] += by;
                    plain(Obb2::load(&all[..5]), Obb2::load(&all[5..]))
                };
                if a.size.x.min(a.size.y).min(b.size.x).min(b.size.y) < 0.01 {
                    continue;
                }
                let (up, down) = (moved(step), moved(-step));
                let difference = (up - down) / (2.0 * step);
                let kink = (up + down - 2.0 * value.value).abs() / step;
                let size = 1.0 + difference.abs();
                assert!(
                    (value.derivative[k] - difference).abs() < 2e-5 * size + 1.01 * kink,
                    "{name} {a} {b} {k} {} {difference} {kink}",
                    value.derivative[k]
                );
            }
        }
    }
}

#[test]
fn identical_shapes_score_one_without_derivatives() {
    for (a, _) in pairs(35, 60) {
        if a.size.x.min(a.size.y) < 1e-3 {
            continue;
        }
        let (x, y) = lifted(a, a);
        for value in [
            giou_obb2(x, y),
            diou_obb2(x, y),
            diou_aabb_obb2(x, y),
            ciou_obb2(x, y),
            ciou_aabb_obb2(x, y),
            eiou_obb2(x, y),
            eiou_aabb_obb2(x, y),
        ] {
            assert_eq!(value.value, 1.0);
            assert!(
                value
                    .derivative
                    .iter()
                    .all(|s| s.abs() < 1e-12 / a.size.x.min(a.size.y).min(1.0).powi(2)),
                "{a} {value:?}"
            );
        }
        let single = Obb2::new(
            a.center.x as f32,
            a.center.y as f32,
            a.size.x as f32,
            a.size.y as f32,
            a.heading as f32,
        );
        assert_eq!(giou_obb2(single, single), 1.0);
        let bounds = a.bounding();
        for value in [
            giou_aabb2(bounds, bounds),
            giou_hull_aabb2(bounds, bounds),
            diou_aabb2(bounds, bounds),
            diou_hull_aabb2(bounds, bounds),
            ciou_aabb2(bounds, bounds),
            ciou_hull_aabb2(bounds, bounds),
            eiou_aabb2(bounds, bounds),
            eiou_hull_aabb2(bounds, bounds),
            alpha_iou_aabb2(bounds, bounds, 3.0),
        ] {
            assert_eq!(value, 1.0);
        }
    }
    let mut dice = Dice(36);
    for _ in 0..40 {
        let a = convex(&mut dice);
        let (x, y) = (variables(&a, 0), variables(&a, 24));
        let (giou, trace) = giou_polygons_search::<f64, 12, 12, 24>(&a, &a).unwrap();
        assert_eq!(giou, 1.0);
        let derivatives = giou_polygons_replay(&x, &y, &trace).derivative;
        let small = 1e-9 / a.area().min(1.0).powf(1.5);
        assert!(
            derivatives.iter().all(|s| s.abs() < small),
            "{derivatives:?}"
        );
        // B5, B7: no number and no derivative there.
        let (diou, record) = diou_polygons_search(&a, &a);
        assert_eq!(diou, 1.0);
        assert!(
            diou_polygons_replay(&x, &y, record)
                .derivative
                .iter()
                .all(|s| s.abs() < small)
        );
    }
}

#[test]
fn generalised_iou_of_polygons_is_that_of_the_oracle() {
    let mut dice = Dice(37);
    let random = (0..100).map(|_| (convex(&mut dice), convex(&mut dice)));
    let all: Vec<(Polygon, Polygon)> = random.chain(hard()).collect();
    for (a, b) in all {
        let (area_a, area_b) = (
            exact::ring_area(a.as_slice()),
            exact::ring_area(b.as_slice()),
        );
        if area_a == 0.0 || area_b == 0.0 {
            continue;
        }
        let inter = exact::area_inside(a.as_slice(), b.as_slice());
        let all: Vec<_> = a.as_slice().iter().chain(b.as_slice()).copied().collect();
        let hull = exact::ring_area(&exact::hull(&all));
        let union = area_a + area_b - inter;
        let truth = inter / union - (hull - union) / hull;
        let (found, _) = giou_polygons_search::<f64, 12, 12, 24>(&a, &b).unwrap();
        assert!((found - truth).abs() < 1e-12, "{a:?} {b:?} {found} {truth}");
    }
}

#[test]
fn scores_do_not_depend_on_place_size_and_order() {
    for (a, b) in pairs(38, 300) {
        let truth = giou_obb2(a, b);
        assert!((giou_obb2(b, a) - truth).abs() < 1e-13);
        assert!(truth > -1.0 - 1e-15 && truth <= a.iou(b) + 1e-15);
        let moved = |x: Obb2<f64>, scale: f64| {
            Obb2::new(
                x.center.x * scale,
                x.center.y * scale,
                x.size.x * scale,
                x.size.y * scale,
                x.heading,
            )
        };
        for scale in [1e-200, 1e-30, 1e30, 1e200] {
            assert!((giou_obb2(moved(a, scale), moved(b, scale)) - truth).abs() < 1e-12);
        }
        let scores: [fn(Obb2<f64>, Obb2<f64>) -> f64; 4] =
            [diou_obb2, diou_aabb_obb2, ciou_obb2, eiou_obb2];
        for score in scores {
            let truth = score(a, b);
            assert!((score(b, a) - truth).abs() < 1e-13);
            for scale in [1e-100, 1e-30, 1e30, 1e100] {
                assert!((score(moved(a, scale), moved(b, scale)) - truth).abs() < 1e-12);
            }
        }
    }
    // Nothing finite gives NaN, in single precision.
    let sizes = [0.0_f32, 1e-30, 1e-10, 1.0, 1e10, 1e30];
    for width in sizes {
        for height in sizes {
            for x in [0.0_f32, 1e-30, 1.0, 1e30] {
                let lift = |k: usize, y: f32| Jet::<f32, 10>::variable(y, k);
                let a = Obb2::new(
                    lift(0, 0.0),
                    lift(1, 0.0),
                    lift(2, width),
                    lift(3, height),
                    lift(4, 0.2),
                );
                let b = Obb2::new(
                    lift(5, x),
                    lift(6, 0.0),
                    lift(7, height),
                    lift(8, width),
                    lift(9, 0.5),
                );
                for value in [
                    giou_obb2(a, b),
                    giou_aabb_obb2(a, b),
                    diou_aabb_obb2(a, b),
                    ciou_obb2(a, b),
                    eiou_obb2(a, b),
                ] {
                    assert!(value.value.is_finite(), "{width} {height} {x} {value:?}");
                    assert!(
                        value.derivative.iter().all(|s| !s.is_nan()),
                        "{width} {height} {x} {value:?}"
                    );
                }
                let plain = |o: Obb2<Jet<f32, 10>>| o.remake(&mut |s| s.value);
                let (by_a, by_b) = giou_obb2_vjp(plain(a), plain(b), 1.0);
                assert!(
                    by_a.scalars()
                        .into_iter()
                        .chain(by_b.scalars())
                        .all(f32::is_finite)
                );
            }
        }
    }
    // B14: the farthest distance of nested boxes is not the diagonal of the larger one.
    let (a, b) = (
        Aabb2::new(0.0, 0.0, 10.0, 10.0),
        Aabb2::new(4.0, 4.0, 6.0, 6.0),
    );
    assert_eq!(diou_hull_aabb2(a, b), 0.04);
}

/// One box covers almost all of the other: the area outside both is not a difference of two large areas.
#[test]
fn generalised_iou_keeps_its_digits() {
    let large: Aabb2<f64> = Aabb2::new(-700_000.0, 0.0, 1e10, 1e10);
    let over = Aabb2::new(-700_001.0, 1.0, -400_000.0, 300_000.0);
    // Beside the large box a strip one wide remains but for the small box's share of it.
    let iou = large.iou(over);
    let rest = (1e10 - 299_999.0) / ((1e10 + 700_001.0) * 1e10);
    let found = iou - giou_aabb2(large, over);
    assert!((found / rest - 1.0).abs() < 1e-7, "{found} {rest}");
    // Against areas that small numbers give exactly.
    for x in -6..7 {
        for (y, width, height) in [
            (-5, 2, 1),
            (-2, 1, 5),
            (0, 2, 2),
            (1, 3, 1),
            (2, 0, 2),
            (3, 1, 1),
        ] {
            let a = Aabb2::new(0.0, 0.0, 3.0, 2.0);
            let (x, y) = (f64::from(x), f64::from(y));
            let b = Aabb2::new(x, y, x + f64::from(width), y + f64::from(height));
            let inter = a.intersection_area(b);
            let union = a.area() + b.area() - inter;
            let around = a.join(b).area();
            let want = inter / union - (around - union) / around;
            assert!((giou_aabb2(a, b) - want).abs() < 4e-15, "{b:?}");
            let hull = hull_area_aabb2(a, b);
            let want = inter / union - (hull - union) / hull;
            assert!((giou_hull_aabb2(a, b) - want).abs() < 4e-15, "{b:?}");
        }
    }
}

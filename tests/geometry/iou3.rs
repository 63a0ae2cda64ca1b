//! The family of IoU in space, and overlaps that know about separation.
use super::pairs::{FAMILIES, Random, pair, random_rotation};
use geograd::iou3::{
    Enclosing, alpha_iou, ciou, diou, eiou, giou, penetration_or_gap, separation_aware,
    smallest_rectangle,
};
use geograd::{Jet, Obb2, Obb3, Pose3, Scalar, Vec2, Vec3, YawBox3};

#[test]
fn ranges_and_identical_boxes() {
    let mut random = Random(81);
    for (n, family) in FAMILIES.iter().cycle().take(400).enumerate() {
        let (a, mut b) = pair(family, &mut random);
        if n % 2 == 1 {
            b.center += random.vector(8.0 * a.size.x);
        }
        let iou = a.iou(b);
        for kind in [Enclosing::Aabb, Enclosing::Rectangle] {
            let (g, d, c, e) = (
                giou(a, b, kind),
                diou(a, b, kind),
                ciou(a, b, kind),
                eiou(a, b, kind),
            );
            assert!(-1.0 < g && g <= iou, "{family} {g} {iou}");
            assert!(
                -1.0 <= d && d <= iou && c <= d && e <= d && c > -2.0 && e > -4.0,
                "{family}"
            );
            if a.volume() > 0.0 {
                assert_eq!(diou(a, a, kind), 1.0);
                assert_eq!(ciou(a, a, kind), 1.0);
                assert_eq!(eiou(a, a, kind), 1.0);
            }
        }
        assert!(
            (giou(a, a, Enclosing::Rectangle) - 1.0).abs() < 1e-9 || a.volume() == 0.0,
            "{family}"
        );
        assert!((alpha_iou(iou, 3.0) - iou.powi(3)).abs() < 1e-15);
    }
}

#[test]
fn rectangles_are_the_smallest() {
    let mut random = Random(82);
    for _ in 0..60 {
        let (a, b): (Obb2<f64>, Obb2<f64>) =
            (random.yaw_box().birds_eye(), random.yaw_box().birds_eye());
        let found = smallest_rectangle(a, b);
        let points = [a.corners(), b.corners()].concat();
        let mut least = f64::INFINITY;
        for k in 0..1000 {
            let (s, c) = (k as f64 * std::f64::consts::FRAC_PI_2 / 1000.0).sin_cos();
            let extent = |axis: Vec2<f64>| {
                let at = points.iter().map(|p| axis.dot(*p));
                let (low, high) = at.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
                high - low
            };
            least = least.min(extent(Vec2::new(c, s)) * extent(Vec2::new(-s, c)));
        }
        let area = found.x * found.y;
        assert!(
            area <= least * (1.0 + 1e-12) && area > least * 0.98,
            "{area} {least}"
        );
    }
}

#[test]
fn gaps_are_distances_and_continue_overlap() {
    let mut random = Random(83);
    let samples = |shape: Obb3<f64>| {
        let mut points = Vec::new();
        for k in 0..9 * 9 * 9 {
            let at = |n: usize| n as f64 / 8.0 - 0.5;
            let local = Vec3::new(
                at(k % 9) * shape.size.x,
                at(k / 9 % 9) * shape.size.y,
                at(k / 81) * shape.size.z,
            );
            points.push(shape.world_from_local() * local);
        }
        points
    };
    for n in 0..30 {
        let (a, mut b) = pair(FAMILIES[n % 3], &mut random);
        b.center += random.vector(4.0);
        let gap = penetration_or_gap(a, b);
        assert!((gap - penetration_or_gap(b, a)).abs() < 1e-12);
        let motion = {
            let rotation = random_rotation(&mut random);
            Pose3::new(random.vector(10.0), rotation)
        };
        assert!((gap - penetration_or_gap(motion * a, motion * b)).abs() < 1e-12);
        // It never exceeds the distance of any two points, and boxes apart are those with a gap.
        let from_b = |p: Vec3<f64>| {
            let q = b.rotation.inverse() * (p - b.center);
            let beyond = |x: f64, size: f64| (x.abs() - size / 2.0).max(0.0);
            beyond(q.x, b.size.x)
                .hypot(beyond(q.y, b.size.y))
                .hypot(beyond(q.z, b.size.z))
        };
        let nearest = samples(a).into_iter().map(from_b).fold(f64::MAX, f64::min);
        assert!(gap <= nearest + 1e-12);
        assert_eq!(gap > 1e-12, a.iou(b) == 0.0, "{gap} {a:?} {b:?}");
        // Pulled apart along the line of centres the value goes down all the way, without a jump.
        let away = (b.center - a.center).normalize_or_zero();
        let at = |t: f64| {
            separation_aware(
                a,
                Obb3 {
                    center: a.center + away * t,
                    ..b
                },
            )
        };
        let mut last = at(0.0);
        for k in 1..200 {
            let next = at(k as f64 * 0.04);
            assert!(
                next <= last + 1e-12 && next > last - 0.25,
                "{k} {next} {last} {a:?} {b:?}"
            );
            last = next;
        }
        assert!(last < -0.2 && last > -1.0);
    }
}

#[test]
fn derivatives_are_those_of_the_value() {
    let mut random = Random(84);
    type F = fn(YawBox3<Jet<f64, 10>>, YawBox3<Jet<f64, 10>>) -> Jet<f64, 10>;
    let all: [(fn(YawBox3<f64>, YawBox3<f64>) -> f64, F); 5] = [
        (
            |a, b| giou(a, b, Enclosing::Rectangle),
            |a, b| giou(a, b, Enclosing::Rectangle),
        ),
        (
            |a, b| giou(a, b, Enclosing::Aabb),
            |a, b| giou(a, b, Enclosing::Aabb),
        ),
        (
            |a, b| diou(a, b, Enclosing::Rectangle),
            |a, b| diou(a, b, Enclosing::Rectangle),
        ),
        (
            |a, b| eiou(a, b, Enclosing::Aabb),
            |a, b| eiou(a, b, Enclosing::Aabb),
        ),
        (separation_aware, separation_aware),
    ];
    let mut compared = 0;
    for n in 0..60 {
        let (one, mut other) = (random.yaw_box(), random.yaw_box());
        if n % 2 == 1 {
            other.center += random.vector(6.0);
        }
        let (c, s) = (one.center, one.size);
        let x = [c.x, c.y, c.z, s.x, s.y, s.z, one.heading];
        fn made<S>([a, b, c, d, e, f, g]: [S; 7]) -> YawBox3<S> {
            YawBox3::new(Vec3::new(a, b, c), Vec3::new(d, e, f), g)
        }
        let (c, s) = (other.center, other.size);
        let fixed = made([c.x, c.y, c.z, s.x, s.y, s.z, other.heading].map(Scalar::lit));
        for (k, (value, derivatives)) in all.iter().enumerate() {
            let found = derivatives(made(std::array::from_fn(|i| Jet::variable(x[i], i))), fixed);
            for i in 0..7 {
                let at = |h: f64| {
                    let mut x = x;
                    x[i] += h;
                    value(made(x), other)
                };
                let (low, middle, high) = (at(-1e-6), at(0.0), at(1e-6));
                let (left, right) = ((middle - low) / 1e-6, (high - middle) / 1e-6);
                if (left - right).abs() > 1e-4 {
                    continue; // A kink.
                }
                compared += 1;
                let error = ((left + right) / 2.0 - found.derivative[i]).abs();
                assert!(
                    error < 1e-6,
                    "{k} {i}: {left} {right} {} {one:?} {other:?}",
                    found.derivative[i]
                );
            }
        }
    }
    assert!(compared > 1500);
}

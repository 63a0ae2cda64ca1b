//! Scores of boxes in space by formulas on corners, which share nothing with ours; ranges and invariances.
use super::pairs::{FAMILIES, Random, pair, random_rotation};
use geograd::iou3::{Enclosing, Solid, ciou, diou, eiou, giou};
use geograd::kernels::op::Op;
use geograd::{Aabb3, Fixed, Jet, Obb3, Pack, Pose3, Scalar, Vec2, Vec3, YawBox3};
use geograd_tests::rows::{
    CiouAabbObb3, CiouObb3, CiouYaw, DiouAabbObb3, DiouObb3, DiouYaw, EiouAabbObb3, EiouObb3,
    EiouYaw, GiouAabbObb3, GiouObb3, GiouYaw,
};

/// The convex hull by Andrew's monotone chain.
fn chain(mut points: Vec<Vec2<f64>>) -> Vec<Vec2<f64>> {
    points.sort_by(|p, q| (p.x, p.y).partial_cmp(&(q.x, q.y)).unwrap());
    let half = |points: &mut dyn Iterator<Item = Vec2<f64>>| {
        let mut out: Vec<Vec2<f64>> = vec![];
        for p in points {
            while out.len() > 1 && {
                let (q, r) = (out[out.len() - 2], out[out.len() - 1]);
                (r - q).perp_dot(p - q) <= 0.0
            } {
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        out
    };
    let mut out = half(&mut points.iter().copied());
    out.extend(half(&mut points.iter().rev().copied()));
    out
}

fn extent(points: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = points.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
    high - low
}

/// The measures of an enclosing shape in scores: its volume, its diameter's square, and lengths for sizes.
type Around = (f64, f64, [f64; 3]);

/// GIoU, DIoU, CIoU and EIoU of two boxes from their IoU and what is around them.
fn scores<B: Solid<f64>>(a: B, b: B, (volume, squared, sides): Around) -> [f64; 4] {
    let (iou, p, q): (f64, Obb3<f64>, Obb3<f64>) = (a.overlap(b), a.into(), b.into());
    let union = (p.volume() + q.volume()) / (1.0 + iou);
    let way = p.center.distance(q.center);
    let diou = iou - way * way / squared;
    let (s, t) = (p.size, q.size);
    let angle = |x: f64, y: f64| (x / y).atan();
    let v = [
        (s.x, s.y, t.x, t.y),
        (s.y, s.z, t.y, t.z),
        (s.z, s.x, t.z, t.x),
    ]
    .map(|(x, y, u, w)| (angle(x, y) - angle(u, w)).powi(2))
    .iter()
    .sum::<f64>()
        * 4.0
        / 3.0
        / std::f64::consts::PI.powi(2);
    let weight = if v > 0.0 { v / (1.0 - iou + v) } else { 0.0 };
    let gaps = (((s.x - t.x) / sides[0]).powi(2) + ((s.y - t.y) / sides[1]).powi(2))
        + ((s.z - t.z) / sides[2]).powi(2);
    let giou = iou - (volume - union) / volume;
    [giou, diou, diou - weight * v, diou - gaps]
}

fn ours<B: Solid<f64>>(a: B, b: B, kind: Enclosing) -> [f64; 4] {
    [
        giou(a, b, kind),
        diou(a, b, kind),
        ciou(a, b, kind),
        eiou(a, b, kind),
    ]
}

fn close(found: [f64; 4], want: [f64; 4], slack: f64, what: &dyn std::fmt::Debug) {
    for (found, want) in found.into_iter().zip(want) {
        assert!((found - want).abs() < slack, "{found} {want} {what:?}");
    }
}

fn corners(a: Obb3<f64>, b: Obb3<f64>) -> Vec<Vec3<f64>> {
    [a.corners(), b.corners()].concat()
}

/// A box of given sides; own sizes that are longer count instead.
fn of_box(sides: [f64; 3], a: Vec3<f64>, b: Vec3<f64>) -> Around {
    let [x, y, z] = sides;
    let longer = [
        x.max(a.x).max(b.x),
        y.max(a.y).max(b.y),
        z.max(a.z).max(b.z),
    ];
    (x * y * z, x * x + y * y + z * z, longer)
}

/// The box around both along given axes.
fn along(axes: [Vec3<f64>; 3], a: Obb3<f64>, b: Obb3<f64>) -> [f64; 3] {
    axes.map(|axis| extent(corners(a, b).iter().map(|p| axis.dot(*p))))
}

const WORLD: [Vec3<f64>; 3] = [
    Vec3::new(1.0, 0.0, 0.0),
    Vec3::new(0.0, 1.0, 0.0),
    Vec3::new(0.0, 0.0, 1.0),
];

#[test]
fn scores_of_upright_boxes_are_those_of_their_corners() {
    let mut random = Random(301);
    for k in 0..400 {
        let (mut a, mut b) = (random.yaw_box(), random.yaw_box());
        b.center += random.vector([0.0, 1.0, 8.0][k % 3]);
        if k % 5 == 0 {
            a.heading = 0.0;
            b.heading = [0.0, std::f64::consts::FRAC_PI_2, 0.3][k / 5 % 3];
        }
        let all = corners(a.into(), b.into());
        let ground: Vec<_> = all.iter().map(|p| Vec2::new(p.x, p.y)).collect();
        let height = extent(all.iter().map(|p| p.z));
        let hull = chain(ground.clone());
        let n = hull.len();
        let edge = |i: usize| (hull[i], hull[(i + 1) % n]);
        let area = 0.5 * (0..n).map(|i| edge(i).0.perp_dot(edge(i).1)).sum::<f64>();
        let far = ground
            .iter()
            .flat_map(|p| ground.iter().map(|q| p.distance(*q)));
        let far = far.fold(0.0, f64::max);
        let prism = |area: f64, wide: f64| {
            (
                area * height,
                wide * wide + height * height,
                [wide, wide, height],
            )
        };
        let want = scores(a, b, prism(area, far));
        close(ours(a, b, Enclosing::Hull), want, 1e-12, &(a, b));
        let input = (a, b);
        let rows = [
            GiouYaw::eval(input),
            DiouYaw::eval(input),
            CiouYaw::eval(input),
            EiouYaw::eval(input),
        ];
        assert_eq!(rows, ours(a, b, Enclosing::Hull));
        // Along every edge of the hull.
        let best = (0..n)
            .map(|i| {
                let axis = (edge(i).1 - edge(i).0).normalize_or_zero();
                let long = extent(ground.iter().map(|p| axis.dot(*p)));
                (long, extent(ground.iter().map(|p| axis.perp_dot(*p))))
            })
            .min_by(|p, q| (p.0 * p.1).partial_cmp(&(q.0 * q.1)).unwrap())
            .unwrap();
        let want = scores(a, b, prism(best.0 * best.1, best.0.hypot(best.1)));
        close(ours(a, b, Enclosing::Rectangle), want, 1e-11, &(a, b));
        let sides = along(WORLD, a.into(), b.into());
        let want = scores(a, b, of_box(sides, a.size, b.size));
        close(ours(a, b, Enclosing::Aabb), want, 1e-12, &(a, b));
        // Axis-aligned boxes: the published formulas.
        let (p, q): (Aabb3<f64>, Aabb3<f64>) = (a.bounding(), b.bounding());
        let size = |x: Aabb3<f64>| x.max - x.min;
        let both = Vec3::new(
            p.max.x.max(q.max.x) - p.min.x.min(q.min.x),
            p.max.y.max(q.max.y) - p.min.y.min(q.min.y),
            p.max.z.max(q.max.z) - p.min.z.min(q.min.z),
        );
        let want = scores(p, q, of_box([both.x, both.y, both.z], size(p), size(q)));
        close(ours(p, q, Enclosing::Aabb), want, 1e-12, &(p, q));
        for kind in [Enclosing::Hull, Enclosing::Rectangle] {
            let upright = ours(YawBox3::from(p), YawBox3::from(q), kind);
            close(ours(p, q, kind), upright, 1e-12, &(p, q));
        }
    }
}

#[test]
fn scores_of_turned_boxes_are_those_of_their_corners_and_do_not_turn() {
    let mut random = Random(302);
    for n in 0..600 {
        let family = FAMILIES[n % FAMILIES.len()];
        let (a, mut b) = pair(family, &mut random);
        if a.volume() == 0.0 || b.volume() == 0.0 || family == "thin nearly parallel" {
            continue;
        }
        if n % 2 == 1 {
            b.center += random.vector(6.0 * a.size.x);
        }
        let by = |shape: Obb3<f64>| {
            let sides = along(shape.rotation.axes(), a, b);
            scores(a, b, of_box(sides, a.size, b.size))
        };
        let volume = |shape: Obb3<f64>| along(shape.rotation.axes(), a, b).iter().product::<f64>();
        let (of_a, of_b) = (volume(a), volume(b));
        let want = if (of_a - of_b).abs() <= 1e-13 * of_a {
            let (x, y) = (by(a), by(b));
            [0, 1, 2, 3].map(|i| 0.5 * (x[i] + y[i]))
        } else if of_a < of_b {
            by(a)
        } else {
            by(b)
        };
        // Far from the origin, and of thin boxes, corners have few digits.
        let slack = match family {
            "far away" => 1e-5,
            "thin" | "nearly identical" | "tiny" => 1e-6,
            _ => 1e-10,
        };
        let found = [
            GiouObb3::eval,
            DiouObb3::eval,
            CiouObb3::eval,
            EiouObb3::eval,
        ];
        let found = found.map(|score| score((a, b)));
        // Nearly a tie: rounding decides.
        if (of_a - of_b).abs() > 1e-12 * of_a || of_a == of_b {
            close(found, want, slack, &(family, a, b));
        }
        let want = scores(a, b, of_box(along(WORLD, a, b), a.size, b.size));
        let world = [
            GiouAabbObb3::eval,
            DiouAabbObb3::eval,
            CiouAabbObb3::eval,
            EiouAabbObb3::eval,
        ];
        close(
            world.map(|score| score((a, b))),
            want,
            slack,
            &(family, a, b),
        );
        // The whole turned and moved.
        let motion = Pose3::new(random.vector(4.0 * a.size.x), random_rotation(&mut random));
        let (c, d) = (motion * a, motion * b);
        let turned = [
            GiouObb3::eval,
            DiouObb3::eval,
            CiouObb3::eval,
            EiouObb3::eval,
        ];
        let turned = turned.map(|score| score((c, d)));
        if (of_a - of_b).abs() > 1e-9 * of_a || of_a == of_b {
            close(turned, found, slack.max(1e-9), &(family, a, b));
        }
    }
}

type Derivatives = Jet<f64, 20>;

/// Variables for the numbers of two shapes.
fn moving<P: Pack<Scalar = f64> + Fixed<Of<Derivatives> = Q>, Q: Fixed<Scalar = Derivatives>>(
    a: P,
    b: P,
) -> (Q, Q) {
    let of = |x: P, first: usize| {
        let all: Vec<_> = x
            .scalars()
            .iter()
            .enumerate()
            .map(|(k, &x)| Jet::variable(x, first + k))
            .collect();
        Q::load(&all)
    };
    (of(a, 0), of(b, 10))
}

#[test]
fn ranges_ones_and_derivatives_apart() {
    if !geograd_tests::is_due("ranges_ones_and_derivatives_apart") {
        return;
    }
    let kinds = [Enclosing::Hull, Enclosing::Rectangle, Enclosing::Aabb];
    let mut random = Random(303);
    for n in 0..90 {
        let zero = |x: f64, random: &mut Random| {
            if random.between(0.0, 1.0) < 0.2 {
                0.0
            } else {
                x
            }
        };
        let (mut a, mut b) = (random.yaw_box(), random.yaw_box());
        if n % 3 == 0 {
            a.size = Vec3::new(
                zero(a.size.x, &mut random),
                zero(a.size.y, &mut random),
                a.size.z,
            );
            b.size = Vec3::new(
                b.size.x * 1e-6,
                zero(b.size.y, &mut random),
                zero(b.size.z, &mut random),
            );
        }
        if n % 2 == 0 {
            b.center = a.center;
        }
        for kind in kinds {
            let bounds: fn([f64; 4], f64, f64) -> bool = |[g, d, c, e], iou, least| {
                (-1.0..=iou).contains(&g)
                    && (-1.0..=iou).contains(&d)
                    && (-1.5..=d).contains(&c)
                    && (least..=d).contains(&e)
            };
            let iou: f64 = a.overlap(b);
            let least = if kind == Enclosing::Aabb { -4.0 } else { -3.5 };
            assert!(bounds(ours(a, b, kind), iou, least), "{a:?} {b:?} {kind:?}");
            let (p, q) = (Obb3::from(a), Obb3::from(b));
            let iou: f64 = p.overlap(q);
            assert!(bounds(ours(p, q, kind), iou, -4.0), "{a:?} {b:?} {kind:?}");
            let (p, q) = (a.bounding(), b.bounding());
            let least = if kind == Enclosing::Aabb { -3.25 } else { -3.5 };
            assert!(bounds(ours(p, q, kind), p.overlap(q), least), "{p:?} {q:?}");
        }
        let (one, other) = (random.yaw_box(), random.yaw_box());
        for kind in [Enclosing::Hull, Enclosing::Rectangle] {
            assert_eq!(ours(one, one, kind), [1.0; 4], "{one:?} {kind:?}");
            assert_eq!(
                ours(Obb3::from(one), Obb3::from(one), kind),
                [1.0; 4],
                "{one:?}"
            );
            let all = |(a, b): (YawBox3<Derivatives>, YawBox3<Derivatives>)| {
                [
                    giou(a, b, kind),
                    diou(a, b, kind),
                    ciou(a, b, kind),
                    eiou(a, b, kind),
                ]
            };
            for score in all(moving(one, one)) {
                assert!(
                    score.derivative.iter().all(|s| s.abs() < 1e-13),
                    "{kind:?} {score:?}"
                );
            }
            let far = YawBox3 {
                center: one.center + Vec3::new(9.0, 4.0, 3.0),
                ..other
            };
            for (n, score) in all(moving(one, far)).into_iter().enumerate() {
                let by = |k: usize| {
                    Vec3::new(
                        score.derivative[k],
                        score.derivative[k + 1],
                        score.derivative[k + 2],
                    )
                };
                // DIoU may gain by a larger diameter more than it loses by the distance.
                let way = far.center - one.center;
                assert!(
                    by(0).length() > 1e-4 && by(10).length() > 1e-4,
                    "{kind:?} {score:?}"
                );
                assert!(
                    n > 0 || (by(0).dot(way) > 0.0 && by(10).dot(way) < 0.0),
                    "{kind:?} {score:?}"
                );
            }
            let turned = |x: YawBox3<f64>| Obb3::from(x);
            let (a, b) = moving(turned(one), turned(one));
            for score in [
                giou(a, b, kind),
                diou(a, b, kind),
                ciou(a, b, kind),
                eiou(a, b, kind),
            ] {
                assert!(
                    score.derivative.iter().all(|s| s.abs() < 1e-12),
                    "{kind:?} {score:?}"
                );
            }
        }
    }
}

/// Boxes with one centre: the score is the same on both sides, so its derivative by the centre is zero.
#[test]
fn ties_of_the_smallest_rectangle_are_not_left_to_rounding() {
    if !geograd_tests::is_due("ties_of_the_smallest_rectangle_are_not_left_to_rounding") {
        return;
    }
    fn derivative<S: Scalar>(
        made: fn(f64) -> S,
        x: S,
        y: S,
        sizes: [f64; 4],
        turns: [f64; 2],
    ) -> S {
        let [w, h, u, v] = sizes.map(made);
        let a = YawBox3::new(Vec3::zero(), Vec3::new(w, h, made(1.0)), made(turns[0]));
        let b = YawBox3::new(
            Vec3::new(x, y, S::zero()),
            Vec3::new(u, v, made(1.0)),
            made(turns[1]),
        );
        giou(a, b, Enclosing::Rectangle)
    }
    let by = |sizes: [f64; 4], turns: [f64; 2]| {
        type J = Jet<f64, 2>;
        derivative::<J>(
            J::lit,
            J::variable(0.0, 0),
            J::variable(0.0, 1),
            sizes,
            turns,
        )
        .derivative
    };
    assert_eq!(by([1.0, 3.0, 1.0, 3.0], [0.0, 0.3]), [0.0, 0.0]);
    let mut random = Random(304);
    for n in 0..2000 {
        let mut size = || random.between(0.2, 3.0);
        let (w, h) = (size(), size());
        let other = if n % 2 == 0 { [w, h] } else { [size(), size()] };
        let turns = [random.between(-3.0, 3.0), random.between(-3.0, 3.0)];
        let found = by([w, h, other[0], other[1]], turns);
        assert!(
            found.iter().all(|s| s.abs() < 1e-12),
            "{w} {h} {other:?} {turns:?} {found:?}"
        );
        let single = derivative::<Jet<f32, 2>>(
            Jet::lit,
            Jet::variable(0.0, 0),
            Jet::variable(0.0, 1),
            [w, h, other[0], other[1]],
            turns,
        );
        assert!(
            single.derivative.iter().all(|s| s.abs() < 1e-4),
            "{w} {h} {other:?} {turns:?} {single:?}"
        );
    }
}

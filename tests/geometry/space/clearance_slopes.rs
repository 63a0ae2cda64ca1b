//! Derivatives of least distances of moving bodies, beside differences and closed forms.
use super::draw::Random;
use geograd::motion::{Motion3, Moves as _};
use geograd::prelude::*;
use geograd::{Pack, ad};
use std::f64::consts::FRAC_PI_3;

fn rotation(random: &mut Random) -> Rotation3<f64> {
    Rotation3::from_rotation_vector(random.vector(2.0))
}
fn obb3(random: &mut Random) -> Obb3<f64> {
    let size = random.vector(0.6) + Vec3::new(1.2, 1.2, 1.2);
    Obb3::new(Vec3::zero(), size, rotation(random))
}
fn hull(random: &mut Random) -> Hull3<f64, 8> {
    let vertices: Vec<_> = (0..5 + random.below(4))
        .map(|_| random.vector(0.9))
        .collect();
    Hull3::from_vertices(&vertices)
}
fn capsule(random: &mut Random) -> Capsule3<f64> {
    let half = random.vector(0.6);
    Capsule3::new(-half, half, random.within(0.1, 0.4))
}
fn cylinder(random: &mut Random) -> Cylinder<f64> {
    let half = random.vector(0.6);
    Cylinder::new(-half, half, random.within(0.2, 0.6))
}
fn ellipsoid(random: &mut Random) -> Ellipsoid<f64> {
    let half = random.vector(0.3) + Vec3::new(0.6, 0.6, 0.6);
    Ellipsoid::new(Vec3::zero(), half, rotation(random))
}
fn point(random: &mut Random) -> Vec3<f64> {
    random.vector(0.3)
}

/// A motion past the origin: straight or with a turn, so that the body misses, hits or passes through another one.
fn motion(random: &mut Random, from: Vec3<f64>) -> Motion3<f64> {
    let way = from * -random.within(0.7, 2.0) + random.vector(0.4);
    let most = [0.0, 1.5][random.below(2)];
    let turn = random.vector(most);
    Motion3::new(from, way, turn)
}

/// A pair at random, and its least distance as a function of all numbers of both bodies and motions.
macro_rules! pairs {
    ($($name:ident: $count:literal, $first:ident $A:ty, $second:ident $B:ty;)*) => { $(
        #[test]
        fn $name() {
            if !geograd_tests::is_due(stringify!($name)) {
                return;
            }
            let mut random = Random(41);
            let (mut deep, mut inside, mut judged) = (0, 0, 0);
            for _ in 0..$count {
                let far = random.within(0.5, 2.5);
                let from = random.vector(1.0) + Vec3::new(far, 0.2, 0.1);
                let a = Pose3::new(from, Rotation3::identity()) * $first(&mut random);
                let of_a = motion(&mut random, from);
                let b = $second(&mut random);
                let of_b = Motion3::new(Vec3::zero(), random.vector(0.3), random.vector(0.5));
                let all = (a, of_a, b, of_b);
                let least = |(a, m, b, n): ($A, Motion3<_>, $B, Motion3<_>)| a.clearance(m, b, n).distance;
                let (value, by) = ad::gradient(least, all);
                let found = a.clearance(of_a, b, of_b);
                assert_eq!(value, found.distance);
                deep += usize::from(value < 0.0);
                inside += usize::from(found.time > 0.0 && found.time < 1.0);
                let (numbers, by) = (all.scalars(), by.scalars());
                for k in 0..numbers.len() {
                    let moved = |step: f64| {
                        let mut numbers = numbers.clone();
                        numbers[k] += step;
                        let (a, m, b, n) = all.refill(&numbers);
                        a.clearance(m, b, n).distance
                    };
                    let step = 1e-5;
                    let sides = [(moved(step) - value) / step, (value - moved(-step)) / step];
                    // Half of the difference of both sides is the error of each, where there is no kink.
                    let slack = 1e-7 + 1e-4 * (sides[0] - sides[1]).abs();
                    let (low, high) = (sides[0].min(sides[1]) - slack, sides[0].max(sides[1]) + slack);
                    assert!(low <= by[k] && by[k] <= high, "number {k} of {all:?} at {}: {} {sides:?}", found.time, by[k]);
                    judged += usize::from((sides[0] - sides[1]).abs() < 1e-3);
                }
            }
            assert!(deep > $count / 6 && inside > $count / 3 && judged > 5 * $count, "{deep} {inside} {judged}");
        }
    )* };
}
pairs! {
    slopes_of_points_and_boxes: 60, point Vec3<_>, obb3 Obb3<_>;
    slopes_of_boxes: 60, obb3 Obb3<_>, obb3 Obb3<_>;
    slopes_of_capsules_and_boxes: 60, capsule Capsule3<_>, obb3 Obb3<_>;
    slopes_of_hulls: 40, hull Hull3<_, 8>, hull Hull3<_, 8>;
    slopes_of_boxes_and_hulls: 40, obb3 Obb3<_>, hull Hull3<_, 8>;
    slopes_of_boxes_and_cylinders: 8, obb3 Obb3<_>, cylinder Cylinder<_>;
    slopes_of_ellipsoids: 4, ellipsoid Ellipsoid<_>, ellipsoid Ellipsoid<_>;
}

/// A point runs into a box through one face, and nears another one: the depth out of the first rises at the rate 3, that
/// out of the second falls at 0.8.
#[test]
fn a_depth_out_of_two_faces_is_shared_by_the_rates() {
    let least = |[x, y, across, along, size]: [_; 5]| {
        let sizes = Vec3::new(size, size, geograd::Scalar::lit(100.0));
        let solid = Obb3::new(Vec3::zero(), sizes, Rotation3::identity());
        let zero = geograd::Scalar::lit(0.0);
        let way = Motion3::straight(Vec3::new(across, along, zero));
        Vec3::new(x, y, zero)
            .clearance(way, solid, Motion3::still())
            .distance
    };
    let numbers: [f64; 5] = [-2.0, 0.1, 3.0, 0.8, 2.0];
    let (value, by, second) = ad::hessian(least, numbers);
    assert!((value + 0.5).abs() < 1e-14, "{value}");
    let share = 0.8 / 3.8;
    let expected = [-share, 1.0 - share, -0.5 * share, 0.5 * (1.0 - share), -0.5];
    for (k, (x, y)) in by.iter().zip(expected).enumerate() {
        assert!((x - y).abs() < 1e-12, "{k}: {x} {y}");
    }
    // −(x + u t) − s/2 = y + v t − s/2 at t = −(x + y)/(u + v), where both are (u y − v x)/(u + v) − s/2.
    let (x, y, u, v) = (-2.0, 0.1, 3.0, 0.8);
    let sum: f64 = u + v;
    let by_u = |u: f64, v: f64| v * (x + y) / (u + v).powi(2);
    assert!((by[2] - by_u(u, v)).abs() < 1e-12);
    let expected = [
        [0.0, 0.0, v / sum.powi(2), -u / sum.powi(2)],
        [0.0, 0.0, v / sum.powi(2), -u / sum.powi(2)],
        [
            v / sum.powi(2),
            v / sum.powi(2),
            -2.0 * v * (x + y) / sum.powi(3),
            (x + y) * (u - v) / sum.powi(3),
        ],
        [
            -u / sum.powi(2),
            -u / sum.powi(2),
            (x + y) * (u - v) / sum.powi(3),
            2.0 * u * (x + y) / sum.powi(3),
        ],
    ];
    for (i, row) in expected.iter().enumerate() {
        for (k, y) in row.iter().enumerate() {
            assert!(
                (second[i][k] - y).abs() < 1e-6,
                "{i} {k}: {} {y}",
                second[i][k]
            );
        }
    }
}

/// The distance of a ball's way from a post.
fn passing<S: geograd::Scalar>([x, y, across, along]: [S; 4]) -> S {
    (y * across - x * along).over(geograd::Vec2::new(across, along).length()) - S::lit(0.75)
}

/// A ball passes a post: the least distance is that of two lines, with all its derivatives by the way.
#[test]
fn a_smooth_minimum_has_derivatives_of_both_orders() {
    let least = |[x, y, across, along]: [_; 4]| {
        let lit = geograd::Scalar::lit;
        let ball = Sphere::new(Vec3::new(x, y, lit(0.3)), lit(0.5));
        let post = Capsule3::new(
            Vec3::new(lit(0.0), lit(0.0), lit(-5.0)),
            Vec3::new(lit(0.0), lit(0.0), lit(5.0)),
            lit(0.25),
        );
        let way = Motion3::straight(Vec3::new(across, along, lit(0.0)));
        ball.clearance(way, post, Motion3::still()).distance
    };
    let numbers: [f64; 4] = [-4.0, 1.5, 7.0, 1.0];
    let (value, by, second) = ad::hessian(least, numbers);
    let (expected, slopes, curves) = ad::hessian(passing, numbers);
    assert!((value - expected).abs() < 1e-14);
    for i in 0..4 {
        assert!(
            (by[i] - slopes[i]).abs() < 1e-13,
            "{i}: {} {}",
            by[i],
            slopes[i]
        );
        for k in 0..4 {
            assert!(
                (second[i][k] - curves[i][k]).abs() < 1e-6,
                "{i} {k}: {} {}",
                second[i][k],
                curves[i][k]
            );
        }
    }
}

/// A hexagonal peg sinks between two walls, parallel to its sides and as far from each: a turn brings an edge nearer,
/// whichever way it goes, and the distance from one wall has the mean of both slopes.
#[test]
fn a_peg_between_walls_has_a_mean_of_slopes() {
    let out = 0.2 / (0.5 * FRAC_PI_3).cos();
    let peg: Hull3<f64, 12> = Hull3::from(std::array::from_fn(|k| {
        let (sin, cos) = (FRAC_PI_3 * ((k / 2) as f64 + 0.5)).sin_cos();
        Vec3::new(out * cos, out * sin, if k % 2 == 0 { -0.3 } else { 0.3 })
    }));
    let sink = Vec3::new(0.0, 0.0, -0.5);
    for side in [-1.0, 1.0] {
        let wall = Obb3::new(
            Vec3::new(side * 0.352, 0.0, -0.3),
            Vec3::new(0.3, 0.46, 0.6),
            Rotation3::identity(),
        );
        let least = |[x, turn]: [_; 2]| {
            let zero = geograd::Scalar::lit(0.0);
            let start = Pose3::new(
                Vec3::new(x, zero, geograd::Scalar::lit(0.1)),
                Rotation3::from_yaw(turn),
            );
            let way = Motion3::straight(sink.lift());
            (start * peg.lift())
                .clearance(way, wall.lift(), Motion3::still())
                .distance
        };
        let (value, by) = ad::gradient(least, [0.0_f64, 0.0]);
        assert!((value - 0.002).abs() < 1e-15, "{value}");
        assert!((by[0] + side).abs() < 1e-12, "{by:?}");
        let plain = |turn: f64| {
            let start = Pose3::new(Vec3::new(0.0, 0.0, 0.1), Rotation3::from_yaw(turn));
            (start * peg)
                .clearance(Motion3::straight(sink), wall, Motion3::still())
                .distance
        };
        let (later, sooner) = ((plain(1e-6) - value) / 1e-6, (value - plain(-1e-6)) / 1e-6);
        assert!((later + 0.5 * out).abs() < 1e-6 && (sooner - 0.5 * out).abs() < 1e-6);
        assert!(by[1].abs() < 1e-12, "{by:?}: {later} {sooner}");
    }
}

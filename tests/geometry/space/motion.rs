//! Bodies in motion: times of impact and least distances against distances at many times, and their derivatives.
use super::draw::Random;
use geograd::motion::{Clearance3, Impact3, Motion3, Moves, clearance, time_of_impact};
use geograd::prelude::*;
use geograd::{Fixed, Pack, ad};

fn rotation(random: &mut Random) -> Rotation3<f64> {
    let v = random.vector(1.0);
    Rotation3::new(random.within(-1.0, 1.0), v.x, v.y, v.z)
}
/// Motions that lead one body towards another: straight, turning, about a far centre, and fast.
fn motion(random: &mut Random, from: Vec3<f64>, to: Vec3<f64>) -> Motion3<f64> {
    let way = (to - from) * random.within(0.5, 2.0) + random.vector(1.0);
    match random.below(4) {
        0 => Motion3::straight(way),
        1 => Motion3::new(from, way, random.vector(3.0)),
        2 => Motion3::new(from + random.vector(2.0), way, random.vector(6.0)),
        _ => Motion3::new(from, way * 20.0, random.vector(9.0)),
    }
}
fn solid(random: &mut Random, at: Vec3<f64>) -> Obb3<f64> {
    let size = Vec3::new(
        random.within(0.1, 2.0),
        random.within(0.1, 2.0),
        random.within(0.1, 2.0),
    );
    Obb3::new(at, size, rotation(random))
}
fn plate(random: &mut Random, at: Vec3<f64>) -> Obb3<f64> {
    Obb3::new(
        at,
        Vec3::new(random.within(0.1, 2.0), random.within(0.1, 2.0), 1e-6),
        rotation(random),
    )
}
fn ball(random: &mut Random, at: Vec3<f64>) -> Sphere<f64> {
    Sphere::new(at, random.within(0.0, 1.0))
}
fn link(random: &mut Random, at: Vec3<f64>) -> Capsule3<f64> {
    Capsule3::new(at, at + random.vector(1.0), random.within(0.0, 0.3))
}
fn wire(random: &mut Random, at: Vec3<f64>) -> Segment3<f64> {
    Segment3::new(at, at + random.vector(1.0))
}
fn face(random: &mut Random, at: Vec3<f64>) -> Triangle3<f64> {
    Triangle3::new(
        at + random.vector(1.0),
        at + random.vector(1.0),
        at + random.vector(1.0),
    )
}
fn can(random: &mut Random, at: Vec3<f64>) -> Cylinder<f64> {
    Cylinder::new(at, at + random.vector(1.0), random.within(0.1, 0.5))
}
fn tip(random: &mut Random, at: Vec3<f64>) -> Cone<f64> {
    Cone::new(at, at + random.vector(1.0), random.within(0.1, 0.5))
}

fn egg(random: &mut Random, at: Vec3<f64>) -> Ellipsoid<f64> {
    let [x, y, z] = [0; 3].map(|_| random.within(0.2, 1.0));
    Ellipsoid::new(at, Vec3::new(x, y, z), rotation(random))
}
fn stone(random: &mut Random, at: Vec3<f64>) -> Hull3<f64, 8> {
    let corners: Vec<Vec3<f64>> = (0..6).map(|_| at + random.vector(1.0)).collect();
    Hull3::from_vertices(&corners)
}

/// Judges the impact and the clearance of one pair by its distances at many times, which have an error.
fn judge(impact: Impact3<f64>, least: Clearance3<f64>, slack: f64, apart: impl Fn(f64) -> f64) {
    const TIMES: usize = 500;
    let end = if impact.kind == 0.0 { 1.0 } else { impact.time };
    assert!(impact.kind != 2.0 || impact.time == 0.0);
    assert!(impact.kind != 2.0 || apart(0.0) < slack);
    if impact.kind != 2.0 {
        for i in 0..TIMES {
            let time = end * i as f64 / TIMES as f64;
            assert!(apart(time) > -slack, "overlap at {time}: {impact:?}");
        }
    }
    if impact.kind == 1.0 {
        assert!(apart(impact.time).abs() < slack, "{impact:?}");
        assert!((impact.normal.length() - 1.0).abs() < 1e-12, "{impact:?}");
        assert!(least.distance < slack);
    }
    if impact.kind == 0.0 {
        assert!(
            impact.time == f64::MAX && least.distance > 0.0,
            "{impact:?} {least:?}"
        );
    }
    assert!((apart(least.time) - least.distance).abs() < slack);
    for i in 0..=TIMES {
        let time = i as f64 / TIMES as f64;
        assert!(apart(time) > least.distance - 1e-8, "{time}: {least:?}");
    }
}

macro_rules! pairs {
    ($($name:ident: $a:ident $b:ident, $slack:literal;)*) => { $(
        #[test]
        fn $name() {
            if !geograd_tests::is_due(concat!("moving ", stringify!($name))) {
                return;
            }
            let mut random = Random(0x1ead ^ stringify!($name).len() as u64);
            let mut kinds = [0; 3];
            for _ in 0..60 {
                let [at_a, at_b] = [random.vector(4.0), random.vector(4.0)];
                let (a, b) = ($a(&mut random, at_a), $b(&mut random, at_b));
                let (of_a, of_b) = (motion(&mut random, at_a, at_b), motion(&mut random, at_b, at_a));
                let impact = time_of_impact(a, of_a, b, of_b);
                kinds[impact.kind as usize] += 1;
                judge(impact, clearance(a, of_a, b, of_b), $slack, |t| {
                    (of_a.at(t) * a).signed_distance(of_b.at(t) * b)
                });
                let (single, double) = ((a.cast::<f32>(), b.cast::<f32>()), (a, b));
                let other = single.0.time_of_impact(of_a.cast(), single.1, of_b.cast());
                if impact.kind == 1.0 && other.kind == 1.0 {
                    let late = (of_a.at(f64::from(other.time)) * double.0)
                        .signed_distance(of_b.at(f64::from(other.time)) * double.1);
                    assert!(late.abs() < 1e-3, "{other:?} {late}");
                }
            }
            assert!(kinds[0] > 0 && kinds[1] > 0, "{kinds:?}");
        }
    )* };
}
pairs! {
    balls: ball ball, 1e-13;
    boxes: solid solid, 1e-13;
    plates: plate plate, 1e-13;
    links_and_boxes: link solid, 1e-13;
    links: link link, 1e-13;
    wires: wire wire, 1e-13;
    wires_and_faces: wire face, 1e-13;
    faces: face face, 1e-13;
    cans_and_balls: can ball, 1e-13;
    balls_and_tips: ball tip, 1e-13;
    cans_and_boxes: can solid, 1e-10;
    eggs: egg egg, 1e-10;
    stones: stone stone, 1e-13;
}

/// Derivatives against differences, and symmetric Hessians against differences of gradients.
#[test]
fn times_have_derivatives_of_both_orders() {
    if !geograd_tests::is_due("times_have_derivatives_of_both_orders") {
        return;
    }
    let mut random = Random(0x1ead);
    let mut judged = 0;
    for _ in 0..60 {
        let [at_a, at_b] = [random.vector(3.0), random.vector(3.0)];
        let (a, b) = (solid(&mut random, at_a), link(&mut random, at_b));
        let (of_a, of_b) = (
            motion(&mut random, at_a, at_b),
            motion(&mut random, at_b, at_a),
        );
        let vectors = [a.center, of_a.velocity, of_a.turn, of_b.velocity].map(|v| [v.x, v.y, v.z]);
        let mut input = [b.radius; 13];
        input[..12].copy_from_slice(vectors.as_flattened());
        macro_rules! time {
            ($x:expr) => {{
                let x = $x;
                let [center, va, wa, vb] =
                    [0, 3, 6, 9].map(|i| Vec3::new(x[i], x[i + 1], x[i + 2]));
                let radius = x[12];
                let a = Obb3::new(center, a.size.lift(), a.rotation.lift());
                let b = Capsule3::new(b.start.lift(), b.end.lift(), radius);
                let (of_a, of_b) = (
                    Motion3::new(of_a.center.lift(), va, wa),
                    Motion3::new(of_b.center.lift(), vb, of_b.turn.lift()),
                );
                a.time_of_impact(of_a, b, of_b)
            }};
        }
        let found = time!(input);
        if found.kind != 1.0 {
            continue;
        }
        let (value, gradient, hessian) = ad::hessian(|x: [_; 13]| time!(x).time, input);
        assert!((value - found.time).abs() < 1e-14);
        let moved = |i: usize, by: f64| {
            let mut numbers = input;
            numbers[i] += by;
            ad::gradient(|x: [_; 13]| time!(x).time, numbers)
        };
        let step = 1e-6;
        for i in 0..13 {
            let ((later, after), (sooner, before)) = (moved(i, step), moved(i, -step));
            let slopes = [(later - value) / step, (value - sooner) / step];
            let scale = 1.0 + gradient[i].abs();
            // Another feature touches first beside a kink.
            if (slopes[0] - slopes[1]).abs() > 1e-3 * scale {
                continue;
            }
            judged += 1;
            let slope = (later - sooner) / (2.0 * step);
            assert!(
                (slope - gradient[i]).abs() < 1e-6 * scale,
                "{i}: {slope} {}",
                gradient[i]
            );
            for (k, (x, y)) in after.iter().zip(before).enumerate() {
                let slope = (x - y) / (2.0 * step);
                let bound = 1e-4 * (1.0 + slope.abs()) * scale;
                assert!(
                    (slope - hessian[i][k]).abs() < bound,
                    "{i} {k}: {slope} {}",
                    hessian[i][k]
                );
                assert!((hessian[k][i] - hessian[i][k]).abs() < 1e-7 * (1.0 + slope.abs()) * scale);
            }
        }
    }
    assert!(judged > 150, "{judged}");
}

#[test]
fn clearances_have_the_derivative_of_the_distance_at_their_time() {
    let (post, ball) = (
        Capsule3::new(Vec3::zero(), Vec3::new(0.0, 0.0, 5.0), 0.5),
        Sphere::new(Vec3::new(-4.0, 3.0, 2.0), 1.0),
    );
    let way = Vec3::new(8.0_f64, 0.0, 0.0);
    let least = |(center, radius): (Vec3<_>, _)| {
        let ball = Sphere::new(center, radius);
        clearance(
            ball,
            Motion3::straight(way.lift()),
            post.lift(),
            Motion3::still(),
        )
        .distance
    };
    let (value, (by_center, by_radius)) = ad::gradient(least, (ball.center, ball.radius));
    assert!((value - 1.5).abs() < 1e-14);
    assert!((by_center - Vec3::new(0.0, 1.0, 0.0)).length() < 1e-7);
    assert_eq!(by_radius, -1.0);
}

/// Two balls meet where a quadratic equation says.
#[test]
fn balls_meet_at_the_root_of_a_quadratic() {
    let mut random = Random(0xba11);
    let mut hits = 0;
    for _ in 0..1000 {
        let (a, b) = (random.vector(3.0), random.vector(3.0));
        let (va, vb) = (random.vector(6.0), random.vector(6.0));
        let radii = [random.within(0.0, 1.0), random.within(0.0, 1.0)];
        let found = time_of_impact(
            Sphere::new(a, radii[0]),
            Motion3::straight(va),
            Sphere::new(b, radii[1]),
            Motion3::straight(vb),
        );
        let (way, speed, reach) = (b - a, vb - va, radii[0] + radii[1]);
        let [p, q, r] = [
            speed.length_squared(),
            way.dot(speed),
            way.length_squared() - reach * reach,
        ];
        let square = q * q - p * r;
        let root = (-q - square.max(0.0).sqrt()) / p;
        match found.kind as i32 {
            2 => assert!(r < 1e-12),
            1 => {
                hits += 1;
                assert!((found.time - root).abs() < 1e-13, "{found:?} {root}");
            }
            _ => assert!(
                square < 1e-9 || !(-1e-9..=1.0 - 1e-9).contains(&root),
                "{root} {square}"
            ),
        }
    }
    assert!(hits > 30, "{hits}");
}

#[test]
fn thin_and_fast_bodies_do_not_pass() {
    let wall = Triangle3::new(
        Vec3::new(0.0, -9.0, -9.0),
        Vec3::new(0.0, 9.0, -9.0),
        Vec3::new(0.0, 0.0, 9.0),
    );
    for speed in [1e1, 1e3, 1e6, 1e9] {
        let shot = Motion3::straight(Vec3::new(speed, 0.0, 0.0));
        let found = time_of_impact(Vec3::new(-1.0, 0.0, 0.0), shot, wall, Motion3::still());
        assert!((found.time * speed - 1.0).abs() < 1e-12, "{found:?}");
        // The wall runs into the point.
        let back = Motion3::straight(Vec3::new(-speed, 0.0, 0.0));
        let found = time_of_impact(Vec3::new(-1.0, 0.0, 0.0), Motion3::still(), wall, back);
        assert!((found.time * speed - 1.0).abs() < 1e-12, "{found:?}");
    }
    // A blade turns a hundred times and meets a post within its first turn.
    let blade = Segment3::new(Vec3::zero(), Vec3::new(2.0, 0.0, 0.0));
    let post = Segment3::new(Vec3::new(0.0, -1.0, -1.0), Vec3::new(0.0, -1.0, 1.0));
    let spin = Motion3::new(
        Vec3::zero(),
        Vec3::zero(),
        Vec3::new(0.0, 0.0, 200.0 * std::f64::consts::PI),
    );
    let found = time_of_impact(blade, spin, post, Motion3::still());
    assert!((found.time - 0.0075).abs() < 1e-13, "{found:?}");
}

#[test]
fn touches_at_the_start_and_bodies_that_part_or_stand_still() {
    let cube = |x: f64| {
        Obb3::new(
            Vec3::new(x, 0.0, 0.0),
            Vec3::new(2.0, 2.0, 2.0),
            Rotation3::identity(),
        )
    };
    let (still, push) = (
        Motion3::still(),
        Motion3::straight(Vec3::new(1.0, 0.0, 0.0)),
    );
    let touch = time_of_impact(cube(0.0), push, cube(2.0), still);
    assert_eq!((touch.time, touch.kind), (0.0, 2.0));
    assert_eq!(time_of_impact(cube(0.0), push, cube(1.0), still).kind, 2.0);
    assert_eq!(time_of_impact(cube(0.0), still, cube(2.5), push).kind, 0.0);
    assert_eq!(time_of_impact(cube(0.0), still, cube(2.5), still).kind, 0.0);
    assert_eq!(time_of_impact(cube(0.0), push, cube(2.5), push).kind, 0.0);
    let end = time_of_impact(cube(0.0), push, cube(3.0), still);
    assert!((end.time - 1.0).abs() < 1e-15 && end.kind == 1.0, "{end:?}");
    // Bodies that slide along each other at a distance of zero keep touching.
    let slide = Motion3::straight(Vec3::new(0.0, 9.0, 0.0));
    assert_eq!(time_of_impact(cube(0.0), slide, cube(2.0), still).kind, 2.0);
    assert_eq!(clearance(cube(0.0), push, cube(4.0), still).distance, 1.0);
    assert_eq!(clearance(cube(0.0), push, cube(4.0), still).time, 1.0);
}

#[test]
fn motions_between_poses_end_at_the_second_one() {
    let mut random = Random(0x9056);
    for _ in 0..200 {
        let [from, to] = [0; 2].map(|_| Pose3::new(random.vector(5.0), rotation(&mut random)));
        let body = random.vector(3.0);
        for motion in [Motion3::between(from, to), Motion3::screw(from, to)] {
            assert!((motion.at(0.0) * (from * body)).distance(from * body) < 1e-13);
            assert!((motion.at(1.0) * (from * body)).distance(to * body) < 1e-12);
        }
        let half = Motion3::between(from, to).at(0.5) * (from * body);
        assert!(half.distance(from.interpolate(to, 0.5) * body) < 1e-12);
        let screw = Motion3::screw(from, to);
        assert!(screw.velocity.cross(screw.turn).length() < 1e-12);
    }
    // Poses with one rotation have a straight way.
    let (from, to) = (
        Pose3::identity(),
        Pose3::new(Vec3::new(1.0, 2.0, 3.0), Rotation3::identity()),
    );
    assert_eq!(Motion3::screw(from, to), Motion3::<f64>::between(from, to));
}

/// Finite numbers and no panic for what has no size, is far away, or is not a number.
#[test]
fn hard_inputs_have_finite_results() {
    let far = Vec3::new(1e15, 0.0, 0.0);
    let point = Vec3::zero();
    let rod = Segment3::new(far, far);
    let gone = Motion3::straight(far * 2.0);
    let found = time_of_impact(point, gone, rod, Motion3::still());
    assert!((found.time - 0.5).abs() < 1e-13, "{found:?}");
    let same = clearance(point, Motion3::still(), point, Motion3::still());
    assert_eq!((same.distance, same.time), (0.0, 0.0));
    let none = Vec3::new(f64::NAN, 0.0, 0.0);
    assert!(
        time_of_impact(none, gone, rod, Motion3::still())
            .time
            .is_nan()
    );
    let mut random = Random(0xfa11);
    for scale in [1e-40, 1e-9, 1.0, 1e9, 1e40] {
        for _ in 0..50 {
            let [at_a, at_b] = [random.vector(3.0), random.vector(3.0)];
            let sized = |mut a: Obb3<f64>| {
                a.center = a.center * scale;
                a.size = a.size * scale;
                a
            };
            let (a, b) = (solid(&mut random, at_a), solid(&mut random, at_b));
            let (mut of_a, mut of_b) = (
                motion(&mut random, at_a, at_b),
                motion(&mut random, at_b, at_a),
            );
            let one = time_of_impact(a, of_a, b, of_b);
            for motion in [&mut of_a, &mut of_b] {
                motion.center = motion.center * scale;
                motion.velocity = motion.velocity * scale;
            }
            let scaled = time_of_impact(sized(a), of_a, sized(b), of_b);
            assert!(scaled.kind == one.kind && (scaled.time - one.time).abs() <= 1e-12 * one.time);
        }
    }
    assert_eq!(<Impact3<f64> as Fixed>::LEN, 8);
}

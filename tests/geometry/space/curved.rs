//! Distances of curved shapes are proved by what they come with: points of both, and a plane between. Nothing here is
//! the library's but what is tested.
use super::curved_draw::{Body, FAMILIES, Frame, Hull, frames};
use super::draw::Random;
use geograd::ad::hessian;
use geograd::distance3::{
    Apart, BySupport, SupportFunction, closest_points, distance, penetration, signed_distance,
    squared_distance,
};
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid, Pack, Shape};

/// The pairs of a curved shape and another one; a macro is called with every pair of types.
macro_rules! each_pair {
    ($run:ident) => {
        $run! {
            Ellipsoid Ellipsoid, Ellipsoid Cylinder, Ellipsoid Cone, Ellipsoid Disc, Ellipsoid Obb3, Ellipsoid Segment3,
            Ellipsoid Triangle3, Ellipsoid Tetrahedron, Ellipsoid Vec3, Ellipsoid Capsule3, Cylinder Cylinder,
            Cylinder Cone, Cylinder Disc, Cylinder Obb3, Cylinder Segment3, Cylinder Triangle3, Cylinder Tetrahedron,
            Cylinder Capsule3, Cone Cone, Cone Disc, Cone Obb3, Cone Segment3, Cone Triangle3, Cone Tetrahedron,
            Cone Capsule3, Disc Disc, Disc Obb3, Disc Segment3, Disc Triangle3, Disc Tetrahedron, Disc Vec3,
            Disc Capsule3, Hull Ellipsoid, Hull Cylinder, Hull Cone, Hull Disc
        }
    };
}

/// The gap of the supports along a normal, relative to a point.
fn gap<A: Body, B: Body>(a: &A, b: &B, normal: Vec3<f64>) -> f64 {
    normal.dot(b.high(-normal) - a.high(normal))
}

/// The largest gap along directions near some of the best of many random ones.
fn best_of_many<A: Body, B: Body>(random: &mut Random, a: &A, b: &B) -> f64 {
    let direction = |random: &mut Random| {
        let v = random.vector(1.0);
        v * (1.0 / v.length().max(1e-3))
    };
    let mut all: Vec<_> = (0..120)
        .map(|_| {
            let way = direction(random);
            (gap(a, b, way), way)
        })
        .collect();
    all.sort_by(|p, q| q.0.total_cmp(&p.0));
    let mut best = f64::NEG_INFINITY;
    for &(mut value, mut way) in &all[..3] {
        let mut step = 0.3;
        while step > 1e-7 {
            let mut better = false;
            for _ in 0..5 {
                let other = way + direction(random) * step;
                let other = other * (1.0 / other.length());
                let found = gap(a, b, other);
                if found > value {
                    (value, way, better) = (found, other, true);
                }
            }
            if !better {
                step *= 0.6;
            }
        }
        best = best.max(value);
    }
    best
}

fn prove<A: Body + Apart<B, Scalar = f64>, B: Body + Apart<A, Scalar = f64>>(
    count: usize,
    told: &str,
) {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for (family, name) in FAMILIES.iter().enumerate() {
        for _ in 0..count {
            let [first, second] = frames(&mut random, family);
            let (a, b) = (A::drawn(first), B::drawn(second));
            let told = || format!("{told}, {name}: {a:?} {b:?}");
            let between = (a.middle() - b.middle()).length();
            let size = a.size().max(b.size()).max(between);
            // An axis of 1e-9 has a direction of few digits.
            let share = if family == 5 { 1e-7 } else { 1e-11 };
            let bound = share * size + 1e-15 * first.at.length();
            let apart = signed_distance(a, b);
            assert!(apart.is_finite(), "{}", told());
            let points = closest_points(a, b);
            let out = penetration(a, b);
            let way = out.direction;
            assert!((way.length() - 1.0).abs() < 1e-12, "{way:?} {}", told());
            assert!(
                a.outside(points.on_a) <= bound,
                "{} {}",
                a.outside(points.on_a),
                told()
            );
            assert!(
                b.outside(points.on_b) <= bound,
                "{} {}",
                b.outside(points.on_b),
                told()
            );
            let error = ((points.on_b - points.on_a) - way * apart).length();
            let least = gap(&a, &b, way);
            let error = error.max((least - apart).abs());
            assert!(error <= bound, "error {error:e} of {size} {}", told());
            assert_eq!(out.depth, (-apart).max(0.0), "{}", told());
            assert_eq!(distance(a, b), apart.max(0.0), "{}", told());
            assert!(
                (squared_distance(a, b) - apart.max(0.0).powi(2)).abs() <= bound * size,
                "{}",
                told()
            );
            let flipped = signed_distance(b, a);
            assert!(
                (flipped - apart).abs() <= bound,
                "{flipped} {apart} {}",
                told()
            );
            if apart < 0.0 {
                // Points and plane prove a direction to be stationary, others that none is better.
                let best = best_of_many(&mut random, &a, &b);
                assert!(best <= apart + bound, "deep {best} {apart} {}", told());
            }
        }
    }
}

macro_rules! prove_all {
    ($($A:ident $B:ident),*) => { $( prove::<$A<f64>, $B<f64>>(40, stringify!($A $B)); )* };
}

#[test]
fn points_and_planes_prove_distances_of_curved_shapes() {
    if !geograd_tests::is_due("points_and_planes_prove_distances_of_curved_shapes") {
        return;
    }
    each_pair!(prove_all);
}

/// Shapes that touch: moved along their normal until their gap is given.
fn prove_touching<A, B>(told: &str)
where
    A: Body + Apart<B, Scalar = f64>,
    B: Body + Apart<A, Scalar = f64>,
{
    let mut random = Random(0x7f4a_7c15_9e37_79b9);
    for family in [0, 1, 2, 3, 7] {
        for gap in [0.0, 1e-9, -1e-9, 1e-13] {
            let [first, second] = frames(&mut random, family);
            let a = A::drawn(first);
            let before = B::drawn(second);
            let (apart, way) = (signed_distance(a, before), penetration(a, before).direction);
            let at = second.at + way * (gap - apart);
            let b = B::drawn(Frame { at, ..second });
            let found = signed_distance(a, b);
            // Edges that enter each other by a little leave along any normal between theirs, by less; flat shapes pass.
            let slack = 1e-13 * (1.0 + at.length()) + 2e-12;
            let holds = found >= gap - slack && found <= gap.abs() + slack;
            assert!(holds, "{told} {gap} {found} {a:?} {b:?}");
            assert!(
                gap < 0.0 || (found - gap).abs() < slack,
                "{told} {gap} {found} {a:?} {b:?}"
            );
        }
    }
}

macro_rules! touch_all {
    ($($A:ident $B:ident),*) => { $( prove_touching::<$A<f64>, $B<f64>>(stringify!($A $B)); )* };
}

#[test]
fn shapes_that_touch_are_no_farther_apart_than_given() {
    each_pair!(touch_all);
}

/// Numbers of 32 bits, against those of 64.
macro_rules! narrow_all {
    ($($A:ident $B:ident),*) => { $(
        let mut random = Random(0x1234_5678_9abc_def1);
        for family in 0..FAMILIES.len() {
            for _ in 0..6 {
                let [first, second] = frames(&mut random, family);
                let (a, b) = ($A::drawn(first), $B::drawn(second));
                let (narrow_a, narrow_b): ($A<f32>, $B<f32>) = (a.cast(), b.cast());
                let (a, b): ($A<f64>, $B<f64>) = (narrow_a.cast(), narrow_b.cast());
                let size = a.size().max(b.size()).max((a.middle() - b.middle()).length());
                let bound = 1e-5 * size + 2e-7 * first.at.length();
                let (narrow, wide) = (signed_distance(narrow_a, narrow_b), signed_distance(a, b));
                let error = (f64::from(narrow) - wide).abs();
                assert!(error <= bound, "{} {narrow} {wide} {a:?} {b:?}", stringify!($A $B));
                let points = closest_points(narrow_a, narrow_b);
                let between = f64::from((points.on_b - points.on_a).length());
                assert!((between - wide.abs()).abs() <= bound, "{between} {wide} {a:?} {b:?}");
            }
        }
    )* };
}

#[test]
fn narrow_numbers_have_the_digits_of_their_format() {
    each_pair!(narrow_all);
}

/// An ellipsoid that only has a support.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
struct Own<S> {
    center: Vec3<S>,
    size: Vec3<S>,
}

impl<S: Scalar> SupportFunction for Own<S> {
    fn support(&self, way: Vec3<S>) -> Vec3<S> {
        let size = self.size;
        let seen = Vec3::new(way.x * size.x, way.y * size.y, way.z * size.z).normalize_or_zero();
        self.center + Vec3::new(seen.x * size.x, seen.y * size.y, seen.z * size.z)
    }
}

#[test]
fn a_shape_by_its_support_has_the_distances_of_the_same_ellipsoid() {
    let mut random = Random(0x1357_9bdf_0246_8ace);
    for family in [0, 1] {
        for _ in 0..12 {
            let [first, second] = frames(&mut random, family);
            let own = Own {
                center: first.at,
                size: Vec3::new(first.lengths[0], first.lengths[1], first.lengths[2]),
            };
            let told = Ellipsoid::new(own.center, own.size, Rotation3::identity());
            let can = Cylinder::drawn(second);
            let (a, by, twice) = hessian(
                |(own, can): (Own<_>, Cylinder<_>)| signed_distance(BySupport(own), can),
                (own, can),
            );
            let known = |(egg, can): (Ellipsoid<_>, Cylinder<_>)| signed_distance(egg, can);
            let (b, other, again) = hessian(known, (told, can));
            assert!((a - b).abs() < 1e-11, "{a} {b} {own:?} {can:?}");
            let close = |p: Vec3<f64>, q: Vec3<f64>, bound: f64| (p - q).length() < bound;
            let same = close(by.0.center, other.0.center, 1e-6)
                && close(by.0.size, other.0.semi_axes, 1e-6);
            assert!(
                same && close(by.1.start, other.1.start, 1e-6),
                "{by:?} {other:?}"
            );
            let (p, q) = (twice.0.center.x.1.start, again.0.center.x.1.start);
            assert!(
                close(p, q, 1e-4 * (1.0 + q.length())),
                "{p:?} {q:?} {own:?} {can:?}"
            );
            let box_of = Obb3::drawn(second);
            let (p, q) = (
                signed_distance(box_of, BySupport(own)),
                signed_distance(box_of, told),
            );
            assert!((p - q).abs() < 1e-11, "{p} {q}");
        }
    }
}

#[test]
fn balls_of_both_kinds_are_equally_far() {
    let mut random = Random(0x2468_ace0_1357_9bdf);
    for family in 0..FAMILIES.len() {
        for _ in 0..20 {
            let [first, second] = frames(&mut random, family);
            let ball = Sphere::new(first.at, first.lengths[0]);
            let other = Sphere::new(second.at, second.lengths[0]);
            let known = ball.signed_distance(other);
            let found = signed_distance(Ellipsoid::from(ball), Ellipsoid::from(other));
            let size = 1.0 + (first.at - second.at).length();
            assert!(
                (known - found).abs() < 1e-13 * size,
                "{known} {found} {ball:?} {other:?}"
            );
            let can = Cylinder::drawn(second);
            let (known, found) = (
                ball.signed_distance(can),
                signed_distance(Ellipsoid::from(ball), can),
            );
            assert!(
                (known - found).abs() < 1e-12 * size,
                "{known} {found} {ball:?} {can:?}"
            );
            let (known, found) = (
                ball.signed_distance(can),
                signed_distance(can, Capsule3::new(ball.center, ball.center, ball.radius)),
            );
            assert!(
                (known - found).abs() < 1e-12 * size,
                "{known} {found} {ball:?} {can:?}"
            );
        }
    }
}

#[test]
fn half_spaces_touch_ellipsoids_and_discs_at_their_supports() {
    let mut random = Random(0x0bad_cafe_1234_5679);
    for family in 0..FAMILIES.len() {
        for _ in 0..20 {
            let [first, second] = frames(&mut random, family);
            let normal = random.vector(1.0);
            let floor = Plane3::through(second.at, normal);
            let unit = normal * (1.0 / normal.length());
            let (egg, coin) = (Ellipsoid::drawn(first), Disc::drawn(first));
            let bound = 1e-13 * (1.0 + first.at.length() + second.at.length());
            let low = |point: Vec3<f64>| unit.dot(point - second.at);
            assert!(
                (floor.signed_distance(egg) - low(egg.high(-unit))).abs() < bound,
                "{egg:?}"
            );
            assert!(
                (floor.signed_distance(coin) - low(coin.high(-unit))).abs() < bound,
                "{coin:?}"
            );
        }
    }
}

/// The shortest of several ways out that are nearly as long. The value is the gap of the supports along a direction, so none
/// is above the true one; enumeration of directions has found those below.
#[test]
fn the_shortest_way_out_is_taken_of_many_nearly_as_short() {
    let at = Vec3::new;
    let can = |start: Vec3<f64>, end: Vec3<f64>, radius: f64| Cylinder { start, end, radius };
    let crate_of = |center: Vec3<f64>, size: Vec3<f64>, [w, x, y, z]: [f64; 4]| Obb3 {
        center,
        size,
        rotation: Rotation3 { w, x, y, z },
    };
    // With one axis: a way out along it, and a ring of them across.
    let [outer, inner] = [
        can(
            at(-0.4947554900108827, 0.511780040232702, 0.5746496912485778),
            at(0.8763724176644364, 0.2082259938728672, 0.26633584648720066),
            0.769989751244929,
        ),
        can(
            at(-0.46752249161097525, 0.5057509259447297, 0.5685260390392872),
            at(0.849139419264529, 0.21425510816083945, 0.2724594986964912),
            0.6419668556545479,
        ),
    ];
    let found = [signed_distance(outer, inner), signed_distance(inner, outer)];
    assert!(
        found.iter().all(|&x| x > -1.4092173448465406 - 1e-9),
        "{found:?}"
    );
    // Two ways out less than two degrees apart.
    let cases = [
        (
            crate_of(
                Vec3::zero(),
                at(1.3757990492849168, 0.9069053721137045, 1.2637416464560536),
                [
                    0.3197691909751652,
                    1.4876073951131505,
                    -0.6326234527090396,
                    0.38309776469021306,
                ],
            ),
            can(
                at(
                    0.4406007605035309,
                    0.29409413921121413,
                    -0.16576008483456192,
                ),
                at(
                    -0.3775106367781238,
                    -0.33365797053337826,
                    0.17939431710161965,
                ),
                0.7026348989899387,
            ),
            -1.0990772745198842,
        ),
        (
            crate_of(
                at(1.2341845484739633, 0.7625233337911042, -0.5225550247295079),
                at(2.1214518985624946, 2.2764616211800157, 1.036720435996767),
                [
                    0.5716816899332675,
                    -0.6525903180230567,
                    -0.10096009435625163,
                    0.4869424828100193,
                ],
            ),
            can(
                at(0.5254292039413957, 0.5913235013776305, -1.4475968951529508),
                at(0.5520168540678503, 0.22210606629756766, 0.9105652522390426),
                0.7114763510063238,
            ),
            -0.926664421148907,
        ),
        (
            crate_of(
                at(
                    -0.7615723425394261,
                    1.4120945279890287,
                    -0.39746160380670714,
                ),
                at(1.5075032282808478, 2.1172166880617036, 1.5990696036663032),
                [
                    0.8793370787942765,
                    0.22957991114104592,
                    0.304395103315829,
                    0.28531208760822546,
                ],
            ),
            can(
                at(
                    -0.8921498061615685,
                    0.9753867229109368,
                    -0.49332472077805944,
                ),
                at(-0.8376521808518902, 0.5511721152587086, 0.06644263650316529),
                0.7665523316220053,
            ),
            -0.9316336142370342,
        ),
    ];
    for (crate_, can, known) in cases {
        let found = [signed_distance(crate_, can), signed_distance(can, crate_)];
        assert!(found.iter().all(|&x| x > known - 1e-9), "{found:?} {known}");
    }
}

/// Bodies about nearly one axis have a ring of ways out, all as good but for the square of the angle between the axes. No
/// order finds a shorter one than the other.
#[test]
fn bodies_about_nearly_one_axis_are_as_deep_in_either_order() {
    fn agree<A: Body + Apart<B, Scalar = f64>, B: Body + Apart<A, Scalar = f64>>(
        a: A,
        b: B,
        share: f64,
    ) -> bool {
        let (one, other) = (signed_distance(a, b), signed_distance(b, a));
        let agree = (one - other).abs() <= share * (1.0 + one.abs());
        if !agree {
            eprintln!("{a:?} {b:?}: {one:e} {other:e}");
        }
        agree
    }
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut failed = 0;
    for count in 0..300 {
        let (at, first, aside) = (random.vector(1.0), random.vector(1.0), random.vector(1.0));
        let (tilt, shift, share) = match count % 2 {
            0 => (1e-2, Vec3::zero(), 1e-11),
            // Rims that touch almost all around: ways are as good to 1e-9.
            _ => (1e-3, random.vector(1e-5), 1e-8),
        };
        let second = first * random.within(0.5, 1.5) + aside * tilt;
        let [r, s] = [0; 2].map(|_| random.within(0.2, 1.2));
        let end = at + shift;
        let can = |start, end, radius| Cylinder { start, end, radius };
        let cone = |apex, base, radius| Cone { apex, base, radius };
        let (a, b) = (can(at + first, at, r), can(end + second, end, s));
        let (p, q) = (cone(at + first, at, r), cone(end + second, end, s));
        let thin = Capsule3::new(at + first, at, 0.3 * r);
        failed += [
            agree(a, b, share),
            agree(p, q, share),
            agree(a, q, share),
            agree(thin, b, share),
        ]
        .iter()
        .filter(|&&agree| !agree)
        .count();
    }
    assert_eq!(failed, 0);
    // With one end in common, found by fuzzing.
    let can = |x: f64, z: f64, radius: f64| Cylinder {
        start: Vec3::new(x, 0.0, z),
        end: Vec3::new(1.2686, 0.0, -1.742371580348845),
        radius,
    };
    let a = can(5.21540641784668, 5.21540641784668, 3.1669);
    let b = can(8.28979977995914, 11.50183379650116, 3.17);
    for found in [signed_distance(a, b), signed_distance(b, a)] {
        assert!((found + 6.335610119976971).abs() <= 1e-13, "{found}");
    }
}

/// A ball that touches the end of a needle along it: places near the end are as near to 10⁻¹³, and both points are one.
#[test]
fn points_of_a_ball_and_a_needle_that_touch_are_one() {
    let at = Vec3::new;
    let turn = |y: f64| Rotation3 {
        w: 0.0,
        x: 0.0,
        y,
        z: 0.0,
    };
    let ball = Ellipsoid::new(at(0.0, 0.0, -1.0), at(1.0, 1.0, 1.0), turn(-1.0));
    let needle = Ellipsoid::new(at(0.0, -1.0, 0.0), at(0.0, 0.0, 1.0), turn(1.0));
    let [one, other] = [closest_points(ball, needle), closest_points(needle, ball)];
    for found in [one.on_a, one.on_b, other.on_a, other.on_b] {
        assert!((found - at(0.0, -1.0, -1.0)).length() <= 1e-12, "{found:?}");
    }
}

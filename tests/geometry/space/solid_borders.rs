//! What belongs to shapes of space: corners, borders, flat and empty shapes, decided by whole numbers.
use super::draw::Random;
use super::exact::{self, Whole, hull_has, minus, place, plus, segment_has};
use geograd::distance3::signed_distance;
use geograd::prelude::*;

/// A number below another, from −n to n.
fn few(random: &mut Random, n: usize) -> i128 {
    random.below(2 * n + 1) as i128 - n as i128
}

/// Corners of a hull that is solid, flat, a segment or a point, and multiples of six apart, so that halves and thirds
/// of edges are whole.
fn corners(random: &mut Random, size: usize) -> [Whole; 4] {
    let a = exact::draw(random, size);
    let [b, c, d] = [0; 3].map(|_| exact::draw(random, size));
    let at = |way: Whole, times: i128| plus(a, way, times);
    match random.below(6) {
        0..=2 => [a, at(b, 6), at(c, 6), at(d, 6)],
        3 => {
            let (m, n) = (few(random, 2), few(random, 2));
            [a, at(b, 6), at(c, 6), plus(at(b, 6 * m), c, 6 * n)]
        }
        4 => [
            a,
            at(b, 6),
            at(b, 6 * few(random, 2)),
            at(b, 6 * few(random, 3)),
        ],
        _ => [a, at(b, 6), a, at(b, 6 * few(random, 1))],
    }
}

/// Points of corners, edges, faces and the inside of a hull, and points beside those.
fn points(random: &mut Random, corners: [Whole; 4]) -> Vec<Whole> {
    let [a, b, c, d] = corners;
    let mean = |shares: [i128; 4]| {
        let mut sum = plus(plus([0; 3], a, shares[0]), b, shares[1]);
        sum = plus(plus(sum, c, shares[2]), d, shares[3]);
        sum.map(|x| x.div_euclid(6))
    };
    let mut all = corners.to_vec();
    for _ in 0..6 {
        // Shares of which some are negative are points outside, such as on the extension of an edge.
        let mut shares = [0; 4].map(|_| [0, 0, 1, 2, 3, -3][random.below(6)]);
        shares[random.below(4)] = 0;
        let rest = 6 - shares.iter().sum::<i128>();
        shares[random.below(4)] += rest;
        let at = mean(shares);
        all.push(at);
        all.push(plus(
            at,
            [few(random, 1), few(random, 1), few(random, 1)],
            1,
        ));
        all.push(plus(at, exact::draw(random, 1 << 10), 1));
    }
    all
}

macro_rules! tetrahedra {
    ($float:ident, $sizes:expr) => {
        let mut random = Random(0x51);
        let (mut inside, mut flat) = (0, 0);
        for round in 0..3000 {
            let size = $sizes[round % $sizes.len()];
            let corners = corners(&mut random, size);
            let [a, b, c, d] = corners.map(place::<$float>);
            let solid = Tetrahedron::new(a, b, c, d);
            for p in points(&mut random, corners) {
                let expected = hull_has(corners, p);
                assert_eq!(solid.contains(place(p)), expected, "{corners:?} {p:?}");
                inside += usize::from(expected);
                flat += usize::from(expected && solid.signed_volume() == 0.0);
                let mirrored = Tetrahedron::new(b, a, c, d);
                assert_eq!(mirrored.contains(place(p)), expected, "{corners:?} {p:?}");
            }
        }
        assert!(inside > 9000 && flat > 4000, "{inside} {flat}");
    };
}

#[test]
fn tetrahedra_contain_what_whole_numbers_say() {
    tetrahedra!(f64, [1, 3, 1 << 10, 1 << 21]);
    tetrahedra!(f32, [1, 3, 1 << 6, 1 << 17]);
}

macro_rules! triangles {
    ($float:ident, $sizes:expr) => {
        let mut random = Random(0x52);
        let mut inside = 0;
        for round in 0..3000 {
            let size = $sizes[round % $sizes.len()];
            let mut corners = corners(&mut random, size);
            corners.iter_mut().for_each(|corner| corner[2] = 0);
            corners[3] = corners[random.below(3)];
            let at = |p: Whole| Vec2::new(p[0] as $float, p[1] as $float);
            let shape = Triangle2::new(at(corners[0]), at(corners[1]), at(corners[2]));
            for mut p in points(&mut random, corners) {
                p[2] = 0;
                let expected = hull_has(corners, p);
                assert_eq!(shape.contains(at(p)), expected, "{corners:?} {p:?}");
                inside += usize::from(expected);
            }
        }
        assert!(inside > 9000, "{inside}");
    };
}

#[test]
fn triangles_contain_what_whole_numbers_say() {
    triangles!(f64, [1, 3, 1 << 10, 1 << 21]);
    triangles!(f32, [1, 3, 1 << 6, 1 << 17]);
}

macro_rules! axes {
    ($float:ident, $sizes:expr) => {
        let mut random = Random(0x53);
        let (mut inside, mut outside) = (0, 0);
        for round in 0..3000 {
            let size = $sizes[round % $sizes.len()];
            let (a, way) = (
                exact::draw(&mut random, size),
                exact::draw(&mut random, size),
            );
            if way == [0; 3] {
                continue;
            }
            let b = plus(a, way, 6);
            let (p, q) = (place::<$float>(a), place(b));
            let shapes = (
                Capsule3::new(p, q, 0.0),
                Cylinder::new(p, q, 0.0),
                Cone::new(p, q, 0.0),
            );
            let flat = Capsule2::new(Vec2::new(p.x, p.y), Vec2::new(q.x, q.y), 0.0);
            for share in -1..=7 {
                let at = plus(a, way, share);
                for at in [at, plus(at, exact::draw(&mut random, 1), 1)] {
                    let expected = segment_has(a, b, at);
                    let point = place(at);
                    let found = (
                        shapes.0.contains(point),
                        shapes.1.contains(point),
                        shapes.2.contains(point),
                    );
                    assert_eq!(found, (expected, expected, expected), "{a:?} {b:?} {at:?}");
                    let low = |p: Whole| [p[0], p[1], 0];
                    let expected = segment_has(low(a), low(b), low(at));
                    let found = flat.contains(Vec2::new(point.x, point.y));
                    assert_eq!(found, expected, "{a:?} {b:?} {at:?}");
                    *(if expected { &mut inside } else { &mut outside }) += 1;
                }
            }
        }
        assert!(inside > 10000 && outside > 10000, "{inside} {outside}");
    };
}

#[test]
fn solids_without_a_radius_contain_their_axis_and_nothing_else() {
    axes!(f64, [1, 3, 1 << 10, 1 << 21]);
    axes!(f32, [1, 3, 1 << 6, 1 << 17]);
}

macro_rules! round_solids {
    ($float:ident) => {
        let mut random = Random(0x54);
        let mut borders = 0;
        for _ in 0..40_000 {
            let (a, p) = (exact::draw(&mut random, 3), exact::draw(&mut random, 4));
            let b = plus(a, exact::draw(&mut random, 3), 1);
            let r = random.below(4) as i128;
            let (axis, arm) = (minus(b, a), minus(p, a));
            if axis == [0; 3] {
                continue;
            }
            let square = exact::dot(axis, axis);
            let (height, turn) = (exact::dot(axis, arm), exact::cross(axis, arm));
            let aside = exact::dot(turn, turn);
            let between = (0..=square).contains(&height);
            let in_ball = |c: Whole| exact::dot(minus(p, c), minus(p, c)) <= r * r;
            let link = in_ball(a) || in_ball(b) || between && aside <= r * r * square;
            let can = between && aside <= r * r * square;
            let hat = between && aside * square <= r * r * height * height;
            borders += usize::from(between && aside == r * r * square);
            borders += usize::from(between && aside * square == r * r * height * height);
            let ([start, end], radius) = ([place::<$float>(a), place(b)], r as $float);
            let point = place(p);
            let found = [
                Capsule3::new(start, end, radius).contains(point),
                Cylinder::new(start, end, radius).contains(point),
                Cone::new(start, end, radius).contains(point),
            ];
            assert_eq!(found, [link, can, hat], "{a:?} {b:?} {r} {p:?}");
            let round = [
                Sphere::new(start, radius).contains(point),
                Circle::new(Vec2::new(start.x, start.y), radius)
                    .contains(Vec2::new(point.x, point.y)),
            ];
            let flat = minus([p[0], p[1], 0], [a[0], a[1], 0]);
            let expected = [in_ball(a), exact::dot(flat, flat) <= r * r];
            assert_eq!(round, expected, "{a:?} {r} {p:?}");
            // A round box by the same numbers: the whole axis is half of its size.
            let solid = Obb3::new(
                start,
                place(axis.map(|x| 2 * x.abs())),
                Rotation3::identity(),
            );
            let out = [0, 1, 2].map(|k| (arm[k].abs() - axis[k].abs()).max(0));
            let expected = exact::dot(out, out) <= r * r;
            assert_eq!(
                RoundBox3::new(solid, radius).contains(point),
                expected,
                "{a:?} {b:?} {r} {p:?}"
            );
            assert_eq!(solid.contains(point), out == [0; 3]);
        }
        assert!(borders > 200, "{borders}");
    };
}

#[test]
fn round_solids_contain_their_borders() {
    round_solids!(f64);
    round_solids!(f32);
}

macro_rules! planes {
    ($float:ident, $sizes:expr) => {
        let mut random = Random(0x55);
        for round in 0..20_000 {
            let size = $sizes[round % $sizes.len()];
            let [normal, aside, other] = [0; 3].map(|_| exact::draw(&mut random, size));
            // Products that only in exact numbers cancel: the point is in a plane through the origin.
            let (p, offset) = match round % 2 {
                0 => (exact::cross(normal, aside), 0),
                _ => (aside, exact::dot(normal, aside)),
            };
            let plane = Plane3::new(place::<$float>(normal), offset as $float);
            if normal == [0; 3] || plane.offset as i128 != offset {
                continue;
            }
            let near = plus(p, other.map(i128::signum), 1);
            for at in [p, near, plus(p, other, -1), plus(p, [1, 0, -1], 1)] {
                let expected = exact::dot(normal, at) <= offset;
                assert_eq!(plane.contains(place(at)), expected, "{plane:?} {at:?}");
            }
        }
    };
}

#[test]
fn half_spaces_contain_what_whole_numbers_say() {
    planes!(f64, [3, 1 << 15, 1 << 25]);
    planes!(f32, [3, 1 << 6, 1 << 10]);
}

/// Shapes and points of a few values, so that many points are on borders, ends, corners.
#[test]
fn what_shapes_contain_agrees_with_the_sign_of_the_distance() {
    let mut random = Random(0x56);
    for round in 0..6000 {
        let step = [1.0, 0.1, 0.3][round % 3];
        let mut at = || place::<f64>(exact::draw(&mut random, 3)) * step;
        let ([a, b, c, d], point) = ([at(), at(), at(), at()], at());
        let size = Vec3::new(a.x.abs(), b.y.abs(), c.z.abs());
        let turn = Rotation3::new(1.0, c.x, d.y, 0.0);
        let (solid, radius) = (Obb3::new(d, size, turn), c.y.abs());
        macro_rules! agree {
            ($($shape:expr),*) => { $(
                let (shape, allowed) = ($shape, 1e-14);
                let depth = signed_distance(point, shape);
                let inside = shape.contains(point);
                assert!(if inside { depth < allowed } else { depth > -allowed }, "{shape:?} {point:?} {depth}");
            )* };
        }
        agree!(
            Sphere::new(a, radius),
            Aabb3::new(a.least(b), a.most(b)),
            YawBox3::new(d, size, c.x),
            solid,
            RoundBox3::new(solid, radius),
            Capsule3::new(a, b, radius),
            Tetrahedron::new(a, b, c, d)
        );
        if a != b {
            agree!(
                Cylinder::new(a, b, radius),
                Cone::new(a, b, radius),
                Plane3::new(b - a, (b - a).dot(c))
            );
        }
        // Shapes of size zero are the point that they are.
        let none = Vec3::zero();
        let point_shapes = [
            Sphere::new(a, 0.0).contains(point),
            Aabb3::new(a, a).contains(point),
            YawBox3::new(a, none, c.x).contains(point),
            Obb3::new(a, none, turn).contains(point),
            RoundBox3::new(Obb3::new(a, none, turn), 0.0).contains(point),
            Capsule3::new(a, a, 0.0).contains(point),
            Tetrahedron::new(a, a, a, a).contains(point),
            Tetrahedron::new(a, a, a, a).contains(a) == (a == point),
        ];
        let [own, rest @ ..] = point_shapes;
        assert_eq!(own, a == point);
        assert!(
            rest[..6].iter().all(|&x| x == own),
            "{a:?} {point:?} {point_shapes:?}"
        );
    }
}

//! Rays against solids of space: hits lie on surfaces, and nothing is hit before.
use super::draw::{Random, wide};
use super::oracle::{Wide, minus, plus, times};
use geograd::distance3::{self, Apart, signed_distance};
use geograd::intersection3::{
    Pierced, crossing_of_three_planes, crossing_of_two_planes, first_hit, first_hit_of_segment,
    first_hit_triangle, length_inside, span,
};
use geograd::prelude::*;

/// Shoots rays at shapes, and checks hits by signed distances of points along the ray.
fn shoot<B>(told: &str, misses_matter: bool, mut make: impl FnMut(&mut Random) -> B)
where
    B: Pierced<Scalar = f64> + std::fmt::Debug,
    Vec3<f64>: Apart<B, Scalar = f64>,
{
    let mut random = Random(0x1234_5678_9abc);
    let mut hits = 0;
    for round in 0..800 {
        let shape = make(&mut random);
        let ray = Ray3::new(random.vector(2.0), random.vector(1.0));
        let depth = |t: f64| signed_distance(ray.point_at(t), shape);
        let starts_inside = depth(0.0) < 0.0;
        let hit = first_hit(ray, shape);
        if hit.kind == 0.0 {
            assert!(
                !starts_inside || !misses_matter,
                "{told}: {ray:?} {shape:?}"
            );
            for k in 0..100 {
                assert!(
                    starts_inside || depth(f64::from(k) * 0.1) > -1e-9,
                    "{told}: {ray:?} {shape:?}"
                );
            }
            continue;
        }
        hits += 1;
        let size = 1.0 + hit.parameter;
        assert_eq!(hit.kind == 2.0, starts_inside, "{told}: {ray:?} {shape:?}");
        assert!(
            depth(hit.parameter).abs() < 1e-13 * size,
            "{told}: {} {ray:?} {shape:?}",
            depth(hit.parameter)
        );
        assert!((hit.point - ray.point_at(hit.parameter)).length() < 1e-14 * size);
        assert!(
            (hit.normal.length() - 1.0).abs() < 1e-9,
            "{told}: {ray:?} {shape:?}"
        );
        let rate = hit.normal.dot(ray.direction);
        assert!(
            if starts_inside {
                rate > 0.0
            } else {
                rate < 0.0
            },
            "{told}: {ray:?} {shape:?}"
        );
        for k in 1..50 {
            let t = hit.parameter * f64::from(k) / 50.0;
            assert_eq!(depth(t) < 0.0, starts_inside, "{told}: {ray:?} {shape:?}");
        }
        let chord = span(ray.line(), shape);
        assert!(chord.enter == hit.parameter || chord.exit == hit.parameter);
        // The length that a segment has inside: by counting, which takes long.
        if round % 10 != 0 {
            continue;
        }
        let wire = Segment3::new(ray.point, ray.point_at(3.0));
        let inside = (0..2000)
            .filter(|&k| depth((f64::from(k) + 0.5) * 0.0015) < 0.0)
            .count();
        let counted = inside as f64 / 2000.0 * wire.length();
        let found = length_inside(wire, shape);
        assert!(
            (found - counted).abs() < 2e-3 * wire.length(),
            "{told}: {found} {counted}"
        );
    }
    assert!(hits > 10, "{told}: {hits}");
}

#[test]
fn hits_are_on_surfaces_and_nothing_is_hit_before() {
    if !geograd_tests::is_due("hits_are_on_surfaces_and_nothing_is_hit_before") {
        return;
    }
    shoot("half-space", false, |r| {
        Plane3::new(r.vector(1.0), r.within(-1.0, 1.0))
    });
    shoot("ball", true, |r| {
        Sphere::new(r.vector(1.0), r.within(0.1, 1.0))
    });
    shoot("upright box", true, |r| {
        let (p, q) = (r.vector(1.0), r.vector(1.0));
        Aabb3::new(p.least(q), p.most(q))
    });
    shoot("box", true, |r| r.solid(0));
    shoot("capsule", true, |r| {
        Capsule3::new(r.vector(1.0), r.vector(1.0), r.within(0.1, 1.0))
    });
    shoot("cylinder", true, |r| {
        Cylinder::new(r.vector(1.0), r.vector(1.0), r.within(0.1, 1.0))
    });
    shoot("cone", true, |r| {
        Cone::new(r.vector(1.0), r.vector(1.0), r.within(0.1, 1.0))
    });
    shoot("round box", true, |r| {
        let radius = r.within(0.01, 0.6);
        RoundBox3::new(r.solid(0), radius)
    });
    shoot("tetrahedron", true, |r| {
        Tetrahedron::new(r.vector(1.0), r.vector(1.0), r.vector(1.0), r.vector(1.0))
    });
}

#[test]
fn rays_hit_triangles_where_their_weights_are_not_negative() {
    let mut random = Random(9);
    let mut hits = 0;
    for _ in 0..3000 {
        let face = Triangle3::new(random.vector(1.0), random.vector(1.0), random.vector(1.0));
        let weights = [random.within(-0.4, 1.0), random.within(-0.4, 1.0)];
        let at = face.a + (face.b - face.a) * weights[0] + (face.c - face.a) * weights[1];
        let inside = weights[0] > 0.0 && weights[1] > 0.0 && weights[0] + weights[1] < 1.0;
        let from = random.vector(2.0);
        let t = random.within(0.2, 3.0);
        let ray = Ray3::new(from, (at - from) * (1.0 / t));
        let hit = first_hit_triangle(ray, face);
        assert_eq!(hit.kind == 1.0, inside, "{face:?} {ray:?}");
        if inside {
            hits += 1;
            assert!(
                (hit.parameter / t - 1.0).abs() < 1e-10,
                "{} {t}",
                hit.parameter
            );
            assert!(hit.normal.dot(ray.direction) < 0.0);
        }
        let away = Ray3::new(from, ray.direction * -1.0);
        assert_eq!(first_hit_triangle(away, face).kind, 0.0);
    }
    assert!(hits > 500);
}

#[test]
fn rays_through_the_edges_of_a_mesh_hit_one_of_its_faces() {
    // A fan around a point: no ray at a point of its edges passes between two faces.
    let mut random = Random(10);
    for _ in 0..2000 {
        let (p, q) = (random.vector(1.0), random.vector(1.0));
        let (r, s) = (random.vector(1.0), random.vector(1.0));
        let (one, other) = (Triangle3::new(p, q, r), Triangle3::new(q, p, s));
        let at = p.lerp(q, random.within(0.01, 0.99));
        let from = random.vector(3.0);
        let ray = Ray3::new(from, at - from);
        let kinds = [one, other].map(|face| first_hit_triangle(ray, face).kind);
        let sides = [r, s].map(|far| (p - from).cross(q - from).dot(far - from));
        if sides[0] * sides[1] < 0.0 {
            assert!(kinds[0] + kinds[1] > 0.0, "{ray:?} {one:?} {other:?}");
        }
    }
}

/// A quadratic's roots in numbers of twice 53 bits, by bisection of its value from the vertex outwards.
fn parameters_of_ball(ray: Ray3<f64>, center: Vec3<f64>, radius: f64) -> Option<[f64; 2]> {
    let arm = minus(wide(ray.point), wide(center));
    let at = |t: Wide| {
        let p = plus(arm, times(wide(ray.direction), t));
        let square = p.iter().fold(Wide::ZERO, |sum, &x| sum + x * x);
        (square - Wide::of(radius) * Wide::of(radius)).near()
    };
    let way = ray.direction;
    let middle = -(ray.point - center).dot(way) / way.length_squared();
    if at(Wide::of(middle)) >= 0.0 {
        return None;
    }
    let reach = radius / way.length() * 2.0 + middle.abs() * 1e-10;
    Some([-1.0, 1.0].map(|side| {
        let (mut inside, mut outside) = (0.0, side * reach);
        for _ in 0..120 {
            let half = (inside + outside) / 2.0;
            let inner = at(Wide::of(middle) + Wide::of(half)) < 0.0;
            *(if inner { &mut inside } else { &mut outside }) = half;
        }
        middle + inside
    }))
}

#[test]
fn balls_are_hit_where_wide_numbers_say() {
    let mut random = Random(77);
    let mut hits = 0;
    for _ in 0..4000 {
        let ball = Sphere::new(random.vector(1.0), random.power(-3.0, 0.0));
        let offset = random.vector(1.0) * (ball.radius * random.within(0.0, 1.0));
        let ray = match random.below(3) {
            0 => Ray3::new(random.vector(5.0), random.vector(2.0)),
            1 => {
                let from = random.vector(5.0);
                Ray3::new(from, (ball.center + offset) - from)
            }
            // From the surface, but for rounding, where the nearer root cancels.
            _ => {
                let out = random.vector(1.0).normalize_or_zero();
                let from = ball.center + out * (ball.radius * (1.0 + random.power(-12.0, -3.0)));
                Ray3::new(from, (ball.center + offset) - from)
            }
        };
        let found = span(ray.line(), ball);
        let Some([enter, exit]) = parameters_of_ball(ray, ball.center, ball.radius) else {
            continue;
        };
        hits += 1;
        assert_eq!(found.found, 1.0, "{ray:?} {ball:?}");
        let chord = exit - enter;
        let unit = (1.0 + (ray.point - ball.center).length() / ball.radius) * chord.max(1e-9);
        for (found, expected) in [(found.enter, enter), (found.exit, exit)] {
            // As far as the rounding of the centre's difference lets it be known.
            let grazing = 2.0 * ball.radius / (chord * ray.direction.length());
            let allowed = 1e-14 * unit * grazing * grazing + 1e-15 * expected.abs();
            assert!(
                (found - expected).abs() < allowed,
                "{found} {expected} {ray:?} {ball:?}"
            );
        }
    }
    assert!(hits > 2000, "{hits}");
}

#[test]
fn rays_that_are_nearly_parallel_to_an_axis_leave_by_the_end() {
    let mut random = Random(5);
    for _ in 0..2000 {
        let (from, way) = (random.vector(1.0), random.vector(1.0));
        let radius = random.within(0.2, 1.0);
        let axis = way.normalize_or_zero();
        let aside =
            random.vector(1.0).cross(axis).normalize_or_zero() * (radius * random.within(0.0, 0.9));
        let start = from + way * random.within(0.1, 0.9) + aside;
        let tilt = random.vector(1.0) * random.power(-18.0, -6.0);
        let ray = Ray3::new(start, way + tilt);
        let left = (from + way - start).dot(axis) / way.length();
        let flat = first_hit(ray, Cylinder::new(from, from + way, radius));
        assert_eq!(flat.kind, 2.0);
        assert!(
            (flat.parameter - left).abs() < 1e-5,
            "{} {left}",
            flat.parameter
        );
        assert!((flat.normal - axis).length() < 1e-9);
        let round = first_hit(ray, Capsule3::new(from, from + way, radius));
        let more = (radius * radius - aside.length_squared()).sqrt() / way.length();
        assert_eq!(round.kind, 2.0);
        assert!(
            (round.parameter - (left + more)).abs() < 1e-4,
            "{} {left} {more}",
            round.parameter
        );
    }
}

#[test]
fn seams_have_the_slopes_of_one_surface() {
    // From the middle of a capsule's end across: the ray leaves where cylinder and ball meet.
    let link = Capsule3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 3.0), 1.0);
    let ray = Ray3::new(Vec3::new(-5.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    let (t, (by_ray, by_link)) = geograd::gradient(
        |(ray, link): (Ray3<_>, Capsule3<_>)| first_hit(ray, link).parameter,
        (ray, link),
    );
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
    assert!((by_ray.point - Vec3::new(-1.0, 0.0, 0.0)).length() < 1e-15);
    close(t, 4.0);
    close(by_link.radius, -1.0);
    close(by_link.start.x + by_link.end.x, 1.0);
    // Where the face of a round box ends.
    let solid = RoundBox3::new(
        Obb3::new(
            Vec3::zero(),
            Vec3::new(2.0, 2.0, 2.0),
            Rotation3::identity(),
        ),
        0.5,
    );
    let ray = Ray3::new(Vec3::new(-5.0, 1.0, 0.25), Vec3::new(1.0, 0.0, 0.0));
    let (t, (by_ray, by_solid)) = geograd::gradient(
        |(ray, solid): (Ray3<_>, RoundBox3<_>)| first_hit(ray, solid).parameter,
        (ray, solid),
    );
    assert!((by_ray.point - Vec3::new(-1.0, 0.0, 0.0)).length() < 1e-15);
    close(t, 3.5);
    close(by_solid.radius, -1.0);
    close(by_solid.inner.center.x, 1.0);
}

#[test]
fn segments_meet_triangles_where_rays_do() {
    let mut random = Random(21);
    let mut hits = 0;
    for _ in 0..3000 {
        let face = Triangle3::new(random.vector(1.0), random.vector(1.0), random.vector(1.0));
        let wire = Segment3::new(random.vector(1.5), random.vector(1.5));
        let hit = first_hit_of_segment(wire, face);
        // The ends are on both sides, and the volumes with all edges have one sign.
        let side = |p: Vec3<f64>| face.six_volume(p);
        let edge = |p: Vec3<f64>, q: Vec3<f64>| {
            (p - wire.start)
                .cross(q - wire.start)
                .dot(wire.end - wire.start)
        };
        let turns = [
            edge(face.a, face.b),
            edge(face.b, face.c),
            edge(face.c, face.a),
        ];
        let through = turns.iter().all(|&x| x > 0.0) || turns.iter().all(|&x| x < 0.0);
        let expected = through && side(wire.start) * side(wire.end) < 0.0;
        assert_eq!(hit.kind == 1.0, expected, "{face:?} {wire:?}");
        if expected {
            hits += 1;
            let t = side(wire.start) / (side(wire.start) - side(wire.end));
            assert!((hit.parameter - t).abs() < 1e-12);
            assert!(distance3::distance(hit.point, face) < 1e-14);
        } else {
            assert_eq!((hit.parameter, hit.point), (f64::MAX, wire.start));
        }
    }
    assert!(hits > 100, "{hits}");
}

#[test]
fn angles_of_vectors_are_those_of_rotations_between_them() {
    let mut random = Random(41);
    for _ in 0..1000 {
        let a = random.vector(1.0) * random.power(-100.0, 100.0);
        let axis = random.vector(1.0).cross(a).normalize_or_zero();
        let angle = random.within(0.0, std::f64::consts::PI);
        let b = Rotation3::from_axis_angle(axis, angle) * a * random.power(-50.0, 50.0);
        assert!((a.angle_to(b) - angle).abs() < 1e-14, "{a:?} {b:?} {angle}");
        assert_eq!(a.angle_to(b), b.angle_to(a));
        assert_eq!(a.angle_to(Vec3::zero()), 0.0);
    }
    // Small angles keep their digits, which an arc cosine would lose.
    let x = Vec3::new(1.0, 0.0, 0.0);
    assert_eq!(x.angle_to(Vec3::new(1.0, 1e-12, 0.0)), 1e-12);
}

#[test]
fn planes_meet_in_points_of_all_of_them() {
    let mut random = Random(22);
    for _ in 0..2000 {
        let mut plane = || {
            let size = random.power(-6.0, 6.0);
            Plane3::through(random.vector(3.0), random.vector(1.0) * size)
        };
        let planes = [plane(), plane(), plane()];
        let heights = |point: Vec3<f64>| planes.map(|plane| plane.signed_distance(point).abs());
        let unit = planes.map(|plane| plane.normal.normalize_or_zero());
        let line = crossing_of_two_planes(planes[0], planes[1]);
        assert_eq!(line.found, 1.0);
        let size = (1.0 + line.point.length()) / unit[0].cross(unit[1]).length();
        for t in [-3.0, 0.0, 2.0] {
            let [a, b, _] = heights(line.line().point_at(t));
            assert!(a.max(b) < 1e-14 * (size + 3.0), "{a} {b} {size}");
        }
        assert!(line.point.dot(line.direction).abs() < 1e-14 * size);
        let [a, b, c] = planes;
        let found = crossing_of_three_planes(a, b, c);
        let volume = unit[0].cross(unit[1]).dot(unit[2]).abs();
        assert_eq!(found.found, 1.0);
        for height in heights(found.point) {
            assert!(
                height < 1e-14 * (1.0 + found.point.length()) / volume,
                "{height}"
            );
        }
        let parallel = Plane3::new(a.normal * 4.0, 1.0);
        assert_eq!(crossing_of_two_planes(a, parallel).found, 0.0);
        // The third normal may lie between the others, too.
        let between = Plane3::new(a.normal + b.normal, 1.0);
        for planes in [[a, a, c], [a, c, a], [c, parallel, a], [a, b, between]] {
            let none = |point: Vec3<f64>, found: f64| (point, found) == (Vec3::zero(), 0.0);
            let [a, b, c] = planes;
            let found = crossing_of_three_planes(a, b, c);
            assert!(none(found.point, found.found), "{planes:?}");
            let [a, b, c] = planes.map(|plane| plane.cast::<f32>());
            let found = crossing_of_three_planes(a, b, c);
            assert!(none(found.point.cast(), found.found.into()), "{planes:?}");
        }
    }
}

/// The least distance of two ways by search over parameters: of all ends and of a grid that is refined.
fn searched(a: (Vec3<f64>, Vec3<f64>, [f64; 2]), b: (Vec3<f64>, Vec3<f64>, [f64; 2])) -> f64 {
    // For a parameter of a the nearest of b is a clamp; the distance is convex in the former.
    let of = |s: f64| {
        let p = a.0 + a.1 * s;
        let t = (p - b.0).dot(b.1) / b.1.length_squared().max(f64::MIN_POSITIVE);
        (b.0 + b.1 * t.clamp(b.2[0], b.2[1]) - p).length()
    };
    let [mut low, mut high] = a.2;
    for _ in 0..150 {
        let third = (high - low) / 3.0;
        let (s, t) = (low + third, high - third);
        if of(s) < of(t) { high = t } else { low = s }
    }
    of((low + high) / 2.0).min(of(a.2[0])).min(of(a.2[1]))
}

#[test]
fn lines_and_rays_are_as_far_as_a_search_says() {
    let far = 1e4;
    let mut random = Random(31);
    for k in 0..3000 {
        let (p, q) = (random.vector(2.0), random.vector(2.0));
        let (u, mut v) = (random.vector(1.0), random.vector(1.0));
        if u.length() < 0.1 || v.length() < 0.1 || u.cross(v).length() < 0.01 {
            continue;
        }
        if k % 5 == 0 {
            v = u * random.within(-2.0, 2.0);
        }
        let (line, ray, wire) = (Line3::new(p, u), Ray3::new(p, u), Segment3::new(q, q + v));
        let (of_line, of_ray, of_wire) =
            ((p, u, [-far, far]), (p, u, [0.0, far]), (q, v, [0.0, 1.0]));
        let (other, other_ray) = (Line3::new(q, v), Ray3::new(q, v));
        let close = |found: f64, expected: f64| {
            assert!(
                (found - expected).abs() < 2e-7,
                "{found} {expected} {p:?} {u:?} {q:?} {v:?}"
            );
        };
        close(distance3::distance(line, wire), searched(of_line, of_wire));
        close(distance3::distance(ray, wire), searched(of_ray, of_wire));
        close(distance3::distance(wire, ray), searched(of_ray, of_wire));
        close(
            distance3::distance(line, q),
            searched(of_line, (q, Vec3::zero(), [0.0; 2])),
        );
        close(
            distance3::distance(ray, q),
            searched(of_ray, (q, Vec3::zero(), [0.0; 2])),
        );
        if v.length() > 0.1 {
            close(
                distance3::distance(line, other),
                searched(of_line, (q, v, [-far, far])),
            );
            close(
                distance3::distance(ray, other_ray),
                searched(of_ray, (q, v, [0.0, far])),
            );
        }
        let ball = Sphere::new(q, 0.4);
        close(
            distance3::signed_distance(line, ball),
            searched(of_line, (q, Vec3::zero(), [0.0; 2])) - 0.4,
        );
        let pair = distance3::closest_points(ray, wire);
        assert!((pair.on_a.distance(pair.on_b) - distance3::distance(ray, wire)).abs() < 1e-13);
        assert!(ray.distance(pair.on_a) < 1e-13 && wire.distance(pair.on_b) < 1e-13);
    }
}

/// The least of a convex function.
fn least_of(mut low: f64, mut high: f64, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        match of(a) < of(b) {
            true => high = b,
            false => low = a,
        }
    }
    of(low)
}

/// A line and a ray, from anywhere in any direction; through corners, along edges and faces now and then.
fn sight(random: &mut Random, corners: &[Vec3<f64>]) -> (Vec3<f64>, Vec3<f64>) {
    let from = random.vector(3.0);
    let mut corner = || corners[random.below(corners.len())];
    let (p, q) = (corner(), corner());
    let way = random.vector(1.0) * random.power(-3.0, 3.0);
    match random.below(5) {
        0 => (from, p - from),
        1 if p != q => (from, q - p),
        2 => (p + (p - q) * 0.3, p - from),
        _ => (from, way),
    }
}

/// Lines and rays are as far from a solid as their nearest point is; inside they are as deep as a segment that goes on
/// and on, and of a line as no direction across it says less.
fn sighted<B>(told: &str, mut make: impl FnMut(&mut Random) -> (B, Vec<Vec3<f64>>, bool))
where
    B: Copy + std::fmt::Debug,
    Vec3<f64>: Apart<B, Scalar = f64>,
    Segment3<f64>: Apart<B, Scalar = f64>,
    Line3<f64>: Apart<B, Scalar = f64>,
    Ray3<f64>: Apart<B, Scalar = f64>,
{
    let mut random = Random(0x51_9417);
    let (mut apart, mut through) = (0, 0);
    for _ in 0..100 {
        let (solid, corners, is_deep) = make(&mut random);
        let (from, way) = sight(&mut random, &corners);
        if way.length() < 1e-3 {
            continue;
        }
        let (line, ray) = (Line3::new(from, way), Ray3::new(from, way));
        let about = || format!("{told}: {line:?} {solid:?}");
        let close = |found: f64, expected: f64, by: f64| {
            assert!(
                (found - expected).abs() < by,
                "{found} {expected} {}",
                about()
            );
        };
        let at = |t: f64| distance3::distance(from + way * t, solid);
        let far = 20.0 / way.length();
        close(
            distance3::distance(line, solid),
            least_of(-far, far, at),
            1e-7,
        );
        close(
            distance3::distance(ray, solid),
            least_of(0.0, far, at),
            1e-7,
        );
        // The points are there, and as far from each other.
        let found = distance3::closest_points(ray, solid);
        let off = (found.on_a - from).cross(way).length() / way.length();
        close(off, 0.0, 1e-12);
        if distance3::distance(ray, solid) > 0.0 {
            apart += 1;
            assert!((found.on_a - from).dot(way) > -1e-9, "{}", about());
            close(
                (found.on_b - found.on_a).length(),
                distance3::distance(ray, solid),
                1e-12,
            );
        }
        if !is_deep {
            continue;
        }
        let long = 1e3 / way.length();
        let wire = |a: f64| Segment3::new(from + way * a, from + way * long);
        let depth = distance3::signed_distance(line, solid);
        close(depth, distance3::signed_distance(wire(-long), solid), 1e-9);
        close(
            distance3::signed_distance(ray, solid),
            distance3::signed_distance(wire(0.0), solid),
            1e-9,
        );
        if depth < -1e-9 {
            through += 1;
            let side = way.cross(Vec3::new(0.3, -0.7, 0.2)).normalize_or_zero();
            let up = way.cross(side).normalize_or_zero();
            let gap = |k: i32| {
                let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 720.0).sin_cos();
                let normal = side * cos + up * sin;
                let lowest = corners.iter().map(|&c| normal.dot(c - from));
                lowest.fold(f64::INFINITY, f64::min)
            };
            let best = (0..720).map(gap).fold(f64::NEG_INFINITY, f64::max);
            assert!(best < depth + 1e-9, "{best} {depth} {}", about());
            close(best, depth, 0.05);
        }
    }
    assert!(apart > 30, "{told} {apart}");
    assert!(through > 5 || told == "triangle", "{told} {through}");
}

#[test]
fn lines_and_rays_are_as_far_from_solids_as_their_nearest_points() {
    if !geograd_tests::is_due("lines_and_rays_are_as_far_from_solids_as_their_nearest_points") {
        return;
    }
    sighted("triangle", |random| {
        let corners = [random.vector(1.0), random.vector(1.0), random.vector(1.0)];
        let [a, b, c] = corners;
        (Triangle3::new(a, b, c), corners.to_vec(), false)
    });
    sighted("tetrahedron", |random| {
        let corners = [(); 4].map(|()| random.vector(1.5));
        let [a, b, c, d] = corners;
        (Tetrahedron::new(a, b, c, d), corners.to_vec(), true)
    });
    sighted("box", |random| {
        let size = Vec3::new(
            random.within(0.2, 3.0),
            random.within(0.2, 3.0),
            random.within(0.2, 3.0),
        );
        let solid = Obb3::new(
            random.vector(1.0),
            size,
            Rotation3::from_rotation_vector(random.vector(2.0)),
        );
        (solid, solid.corners().to_vec(), true)
    });
    sighted("plate", |random| {
        let size = Vec3::new(4.0, 4.0, random.power(-4.0, -1.0));
        let solid = Obb3::new(
            random.vector(1.0),
            size,
            Rotation3::from_rotation_vector(random.vector(2.0)),
        );
        (solid, solid.corners().to_vec(), true)
    });
}

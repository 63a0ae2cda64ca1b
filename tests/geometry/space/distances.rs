//! Distances of space against the oracle, and what must hold of them.
use super::draw::{FAMILIES, Random, boxed, wide};
use super::oracle::{boxes, hulls};
use geograd::distance3::{
    Apart, closest_points, distance, penetration, signed_distance, squared_distance,
};
use geograd::prelude::*;

/// How far coordinates of a family are from the origin: what their differences are rounded by.
fn size(family: usize) -> f64 {
    if family == 6 { 4e6 } else { 4.0 }
}

#[test]
fn boxes_are_as_far_apart_as_the_oracle_says() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for (family, name) in FAMILIES.iter().enumerate() {
        for _ in 0..60 {
            let (a, b) = (random.solid(family), random.solid(family));
            let truth = boxes(&boxed(&a), &boxed(&b));
            let found = signed_distance(a, b);
            assert!(
                (found - truth).abs() < 4e-15,
                "{name}: {found} {truth} {a:?} {b:?}"
            );
            let (a, b): (Obb3<f32>, Obb3<f32>) = (a.cast(), b.cast());
            let truth = boxes(&boxed(&a.cast()), &boxed(&b.cast()));
            let found = f64::from(signed_distance(a, b));
            assert!(
                (found - truth).abs() < 3e-6,
                "{name}: {found} {truth} {a:?} {b:?}"
            );
        }
    }
}

/// Two hulls of corners, in both formats and both orders, against the oracle.
macro_rules! hulls_agree {
    ($($name:ident $solid:literal: |$a:ident: $m:literal| $make_a:expr, |$b:ident: $n:literal| $make_b:expr;)*) => { $(
        #[test]
        fn $name() {
            let mut random = Random(0x0bad_5eed_1234_5678);
            for (family, name) in FAMILIES.iter().enumerate() {
                for _ in 0..40 {
                    let $a: [Vec3<f64>; $m] = std::array::from_fn(|_| random.corner(family));
                    let $b: [Vec3<f64>; $n] = std::array::from_fn(|_| random.corner(family));
                    let (a, b) = ($make_a, $make_b);
                    let truth = hulls(&$a.map(wide), &$b.map(wide), $solid);
                    for found in [signed_distance(a, b), signed_distance(b, a)] {
                        assert!((found - truth).abs() < 4e-15, "{name}: {found} {truth} {a:?} {b:?}");
                    }
                    let near = |p: Vec3<f64>| wide(p.cast::<f32>().cast());
                    let truth = hulls(&$a.map(near), &$b.map(near), $solid);
                    let (a, b) = (a.cast::<f32>(), b.cast::<f32>());
                    for found in [signed_distance(a, b), signed_distance(b, a)] {
                        let error = (f64::from(found) - truth).abs();
                        assert!(error < 2e-6, "{name}: {found} {truth} {a:?} {b:?}");
                    }
                }
            }
        }
    )* };
}
hulls_agree! {
    segments_are_as_far_apart_as_the_oracle_says false:
        |p: 2| Segment3::new(p[0], p[1]), |q: 2| Segment3::new(q[0], q[1]);
    points_and_triangles_are_as_far_apart_as_the_oracle_says false:
        |p: 1| p[0], |q: 3| Triangle3::new(q[0], q[1], q[2]);
    segments_and_triangles_are_as_far_apart_as_the_oracle_says true:
        |p: 2| Segment3::new(p[0], p[1]), |q: 3| Triangle3::new(q[0], q[1], q[2]);
    triangles_are_as_far_apart_as_the_oracle_says true:
        |p: 3| Triangle3::new(p[0], p[1], p[2]), |q: 3| Triangle3::new(q[0], q[1], q[2]);
    points_and_tetrahedra_are_as_far_apart_as_the_oracle_says true:
        |p: 1| p[0], |q: 4| Tetrahedron::new(q[0], q[1], q[2], q[3]);
    segments_and_tetrahedra_are_as_far_apart_as_the_oracle_says true:
        |p: 2| Segment3::new(p[0], p[1]), |q: 4| Tetrahedron::new(q[0], q[1], q[2], q[3]);
    tetrahedra_are_as_far_apart_as_the_oracle_says true:
        |p: 4| Tetrahedron::new(p[0], p[1], p[2], p[3]), |q: 4| Tetrahedron::new(q[0], q[1], q[2], q[3]);
}

#[test]
fn boxes_and_hulls_are_as_far_apart_as_the_oracle_says() {
    let mut random = Random(0x5555_1234_9876_0001);
    for (family, name) in FAMILIES.iter().enumerate() {
        for _ in 0..6 {
            let shape = random.solid(family);
            let corners = boxed(&shape).corners();
            let p: [Vec3<f64>; 3] = std::array::from_fn(|_| random.corner(family));
            let truth = hulls(&corners, &p.map(wide), true);
            let found = shape.signed_distance(Triangle3::new(p[0], p[1], p[2]));
            assert!(
                (found - truth).abs() < 1e-14 * size(family).min(100.0),
                "{name}: {found} {truth} {shape:?} {p:?}"
            );
            let truth = hulls(&corners, &[wide(p[0]), wide(p[1])], true);
            let found = shape.signed_distance(Segment3::new(p[0], p[1]));
            assert!(
                (found - truth).abs() < 1e-14 * size(family).min(100.0),
                "{name}: {found} {truth} {shape:?} {p:?}"
            );
        }
    }
}

/// Checks what all functions of distance say of one pair; `inside` says whether a point is in either shape, up to a
/// rounding.
fn consistent<A, B>(
    a: A,
    b: B,
    scale: f64,
    outside: impl Fn(Vec3<f64>, Vec3<f64>) -> f64,
    told: &str,
) where
    A: Apart<B, Scalar = f64> + std::fmt::Debug,
    B: Copy + std::fmt::Debug,
{
    let signed = signed_distance(a, b);
    let close = |x: f64, y: f64| (x - y).abs() < 1e-14 * scale.max(1.0);
    assert!(
        close(distance(a, b), signed.max(0.0)),
        "{told}: {a:?} {b:?}"
    );
    let square = signed.max(0.0).powi(2);
    assert!(
        (squared_distance(a, b) - square).abs() < 1e-13 * scale,
        "{told}: {a:?} {b:?}"
    );
    let contact = penetration(a, b);
    assert!(
        close(contact.depth, (-signed).max(0.0)),
        "{told}: {a:?} {b:?}"
    );
    let length = contact.direction.length();
    assert!(
        length == 0.0 || (length - 1.0).abs() < 1e-14,
        "{told}: {length} {a:?} {b:?}"
    );
    // Without a direction no way is shortest.
    if length == 0.0 {
        return;
    }
    let points = closest_points(a, b);
    let way = points.on_b - points.on_a;
    assert!(
        (way.length() - signed.abs()).abs() < 1e-13 * scale,
        "{told}: {signed} {points:?} {a:?} {b:?}"
    );
    if signed.abs() > 1e-6 * scale {
        let along = way.dot(contact.direction);
        assert!(
            (along - signed).abs() < 1e-12 * scale,
            "{told}: {along} {signed} {a:?} {b:?}"
        );
    }
    if signed > 0.0 {
        // A point of each: no distance is smaller than that of two points that exist.
        let beyond = outside(points.on_a, points.on_b);
        assert!(
            beyond < 1e-13 * scale,
            "{told}: {beyond} {points:?} {a:?} {b:?}"
        );
    }
}

#[test]
fn functions_of_distance_agree() {
    let mut random = Random(77);
    for (family, told) in FAMILIES.iter().enumerate() {
        for _ in 0..100 {
            let scale = size(family);
            let (a, b) = (random.solid(family), random.solid(family));
            let beyond = |p: Vec3<f64>, q: Vec3<f64>| p.distance(a).max(q.distance(b));
            consistent(a, b, scale, beyond, told);
            let p: [Vec3<f64>; 6] = std::array::from_fn(|_| random.corner(family));
            let r = [random.within(0.0, 0.5), random.within(0.0, 0.5)];
            let (s, t) = (
                Capsule3::new(p[0], p[1], r[0]),
                Capsule3::new(p[2], p[3], r[1]),
            );
            let beyond =
                |p: Vec3<f64>, q: Vec3<f64>| p.signed_distance(s).max(q.signed_distance(t));
            consistent(s, t, scale, beyond, told);
            let beyond = |p: Vec3<f64>, q: Vec3<f64>| p.signed_distance(s).max(q.distance(b));
            consistent(s, b, scale, beyond, told);
            let ball = Sphere::new(p[4], r[1]);
            let beyond = |p: Vec3<f64>, q: Vec3<f64>| p.signed_distance(ball).max(q.distance(b));
            consistent(ball, b, scale, beyond, told);
            let (f, g) = (
                Triangle3::new(p[0], p[1], p[2]),
                Triangle3::new(p[3], p[4], p[5]),
            );
            let beyond = |p: Vec3<f64>, q: Vec3<f64>| p.distance(f).max(q.distance(g));
            consistent(f, g, scale, beyond, told);
            let (low, high) = (p[0].least(p[1]), p[0].most(p[1]));
            let (under, over) = (p[2].least(p[3]), p[2].most(p[3]));
            let (x, y) = (Aabb3::new(low, high), Aabb3::new(under, over));
            let beyond = |p: Vec3<f64>, q: Vec3<f64>| p.distance(x).max(q.distance(y));
            consistent(x, y, scale, beyond, told);
            let (x, y) = (
                x.signed_distance(y),
                Obb3::from(x).signed_distance(Obb3::from(y)),
            );
            assert!((x - y).abs() < 1e-14 * scale, "{told}: {x} {y}");
        }
    }
}

#[test]
fn radii_take_away_from_the_distance_of_cores() {
    let mut random = Random(5);
    for _ in 0..200 {
        let p: [Vec3<f64>; 4] = std::array::from_fn(|_| random.vector(1.0));
        let (r, s) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
        let inner = random.solid(0);
        let edge = Segment3::new(p[0], p[1]);
        let link = Capsule3::new(p[0], p[1], r);
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-14, "{x} {y}");
        close(link.signed_distance(inner), edge.signed_distance(inner) - r);
        let round = RoundBox3::new(inner, s);
        close(
            link.signed_distance(round),
            edge.signed_distance(inner) - r - s,
        );
        close(round.signed_distance(p[2]), inner.signed_distance(p[2]) - s);
        let ball = Sphere::new(p[2], s);
        close(ball.signed_distance(inner), p[2].signed_distance(inner) - s);
        close(ball.signed_distance(link), edge.distance(p[2]) - r - s);
        close(
            ball.farthest_distance(link),
            (p[2] - p[0]).length().max((p[2] - p[1]).length()) + r + s,
        );
    }
}

#[test]
fn shapes_without_end_are_as_far_as_numbers_go() {
    fn all<S: Scalar>() -> Vec<S> {
        let [origin, along] = [Vec3::zero(), Vec3::new(S::one(), S::zero(), S::zero())];
        let ball = Sphere::new(origin, S::one());
        let floor = Plane3::new(along, S::zero());
        let line = Line3::new(origin, along);
        let ray = Ray3::new(origin, along);
        vec![
            floor.farthest_distance(ball),
            ball.farthest_distance(floor),
            line.farthest_distance(ball),
            ball.farthest_distance(line),
            ray.farthest_distance(origin),
            ray.farthest_distance(line),
        ]
    }
    assert_eq!(all::<f64>(), [f64::MAX; 6]);
    assert_eq!(all::<f32>(), [f32::MAX; 6]);
}

/// A point at random on the surface of a solid that turns, from its section.
#[test]
fn points_are_as_far_from_cylinders_and_cones_as_from_their_surfaces() {
    let mut random = Random(41);
    for _ in 0..60 {
        let [start, end, point] = [random.vector(1.0), random.vector(1.0), random.vector(2.0)];
        let radius = random.within(0.0, 1.0);
        let axis = (end - start).normalize_or_zero();
        let off = axis.cross(Vec3::new(0.3, -0.5, 0.9)).normalize_or_zero();
        let other = axis.cross(off);
        // The nearest of points on the rim, the ends and the side, densely.
        let near = |wide_at_start: f64| {
            let mut least = f64::MAX;
            for i in 0..180 {
                let (sin, cos) = (f64::from(i) / 180.0 * std::f64::consts::TAU).sin_cos();
                let out = off * cos + other * sin;
                for k in 0..=60 {
                    let t = f64::from(k) / 60.0;
                    let wide = radius * (wide_at_start + (1.0 - wide_at_start) * t);
                    let side = start + (end - start) * t + out * wide;
                    let last = end + out * (radius * t);
                    let first = start + out * (radius * wide_at_start * t);
                    for place in [side, last, first] {
                        least = least.min((point - place).length());
                    }
                }
            }
            least
        };
        let can = Cylinder::new(start, end, radius);
        let hat = Cone::new(start, end, radius);
        for (found, inside, least) in [
            (can.signed_distance(point), can.contains(point), near(1.0)),
            (hat.signed_distance(point), hat.contains(point), near(0.0)),
        ] {
            assert_eq!(found < 0.0, inside, "{found}");
            assert!(
                found.abs() < least + 1e-12 && found.abs() > least - 0.05,
                "{found} {least}"
            );
        }
        assert!((can.signed_distance(point) - point.signed_distance(can)).abs() < 1e-15);
    }
}

#[test]
fn half_spaces_are_as_far_as_the_lowest_point() {
    let mut random = Random(42);
    for _ in 0..100 {
        let plane = Plane3::new(random.vector(2.0), random.within(-2.0, 2.0));
        let (unit, length) = (plane.normal.normalize_or_zero(), plane.normal.length());
        let height = |p: Vec3<f64>| unit.dot(p) - plane.offset / length;
        let p: [Vec3<f64>; 4] = std::array::from_fn(|_| random.vector(1.0));
        let radius = random.within(0.0, 1.0);
        let lowest =
            |points: &[Vec3<f64>]| points.iter().map(|&p| height(p)).fold(f64::MAX, f64::min);
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-14, "{x} {y}");
        close(plane.signed_distance(p[0]), height(p[0]));
        close(
            plane.signed_distance(Segment3::new(p[0], p[1])),
            lowest(&p[..2]),
        );
        close(
            plane.signed_distance(Triangle3::new(p[0], p[1], p[2])),
            lowest(&p[..3]),
        );
        close(
            plane.signed_distance(Tetrahedron::new(p[0], p[1], p[2], p[3])),
            lowest(&p),
        );
        close(
            plane.signed_distance(Capsule3::new(p[0], p[1], radius)),
            lowest(&p[..2]) - radius,
        );
        let shape = random.solid(0);
        close(plane.signed_distance(shape), lowest(&shape.corners()));
        close(
            Apart::signed_distance(shape, plane),
            lowest(&shape.corners()),
        );
        let axis = (p[1] - p[0]).normalize_or_zero();
        let down = radius * unit.cross(axis).length();
        close(
            plane.signed_distance(Cylinder::new(p[0], p[1], radius)),
            lowest(&p[..2]) - down,
        );
        let hat = Cone::new(p[0], p[1], radius);
        close(
            plane.signed_distance(hat),
            height(p[0]).min(height(p[1]) - down),
        );
        let points = plane.closest_points(hat);
        close(height(points.on_a), 0.0);
        close(height(points.on_b), plane.signed_distance(hat));
    }
}

#[test]
fn nothing_moves_distances_along() {
    let mut random = Random(43);
    for _ in 0..100 {
        let (a, b) = (random.solid(0), random.solid(0));
        let motion = Pose3::new(random.vector(3.0), random.solid(0).rotation);
        let p: [Vec3<f64>; 4] = std::array::from_fn(|_| random.vector(1.0));
        let (s, t) = (
            Capsule3::new(p[0], p[1], 0.1),
            Tetrahedron::new(p[0], p[1], p[2], p[3]),
        );
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-14, "{x} {y}");
        close(
            a.signed_distance(b),
            (motion * a).signed_distance(motion * b),
        );
        close(
            s.signed_distance(b),
            (motion * s).signed_distance(motion * b),
        );
        close(
            t.signed_distance(s),
            (motion * t).signed_distance(motion * s),
        );
        let plane = Plane3::new(p[3], 0.3);
        close(
            plane.signed_distance(s),
            (motion * plane).signed_distance(motion * s),
        );
        let hat = Cone::new(p[0], p[1], 0.4);
        close(
            hat.signed_distance(p[2]),
            (motion * hat).signed_distance(motion * p[2]),
        );
    }
}

#[test]
fn flat_boxes_of_one_plane_that_cross_touch() {
    // No corner is on the other box, and the edges that cross support neither along their normal alone.
    for (places, sizes, turns) in [
        (
            [[1.0, -0.5, -0.5], [1.0, 0.0, -0.5]],
            [[2.0, 0.0, 0.0], [0.5, 1.0, 0.0]],
            [-7.98977718015786e-11, -6.659044542329863e-5],
        ),
        (
            [[-0.5, 0.0, 0.5], [-1.0, 1.0, 0.5]],
            [[2.0, 0.0, 0.0], [2.0, 2.0, 0.0]],
            [-8.379256135795189e-14, -5.0254422851801336e-9],
        ),
        (
            [[-0.5, -1.0, 0.5], [-1.0, -0.5, 0.5]],
            [[1.0, 1.0, 0.0], [0.0, 2.0, 0.0]],
            [2.464623659101225e-6, -1.575691421926374e-8],
        ),
    ] {
        let [a, b] = [0, 1].map(|k| {
            let vector = |[x, y, z]: [f64; 3]| Vec3::new(x, y, z);
            let mut turn = Rotation3::identity();
            turn.z = turns[k];
            Obb3::new(vector(places[k]), vector(sizes[k]), turn)
        });
        for (p, q) in [(a, b), (b, a)] {
            assert!(signed_distance(p, q).abs() < 1e-15, "{p:?} {q:?}");
            assert_eq!(distance(p, q), 0.0);
        }
    }
}

#[test]
fn points_of_boxes_that_meet_along_an_edge_are_on_both() {
    // Rounding parts or joins them by a unit in the last place, whichever face or edge is said to meet.
    let mut random = Random(0x005e_ed0f_ed6e);
    for k in 0..2000 {
        let turn = random.vector(1.0);
        let turn = Rotation3::new(random.within(-1.0, 1.0), turn.x, turn.y, turn.z);
        let mut size =
            || Vec3::new(1.0, 1.0, 1.0) * 0.1 + random.vector(0.5) + Vec3::new(0.5, 0.5, 0.5);
        let (first, second) = (size(), size());
        let reach = (first + second) * 0.5;
        let beside = random.within(-1.0, 1.0) * if k % 2 == 0 { 1.0 } else { 0.0 };
        let way = match k % 3 {
            0 => Vec3::new(-reach.x, reach.y, reach.z * beside),
            1 => Vec3::new(reach.x, reach.y, -reach.z),
            _ => Vec3::new(reach.x * beside, reach.y, -reach.z),
        };
        let a = Obb3::new(random.vector(1.0), first, turn).cast::<f32>();
        let center = a.center.cast::<f64>() + a.rotation.cast::<f64>() * way;
        let b = Obb3::new(center, second, turn).cast::<f32>();
        let found = closest_points(a, b);
        for (shape, point) in [(a, found.on_a), (b, found.on_b)] {
            let beyond = signed_distance(point, shape);
            assert!(beyond < 4e-6, "{beyond}: {found:?} {a:?} {b:?}");
        }
        let way = (found.on_b - found.on_a).length();
        assert!(way < 4e-6, "{way}: {found:?} {a:?} {b:?}");
    }
}

//! Rays against solids of space: hits lie on surfaces, and nothing is hit before.
use super::draw::Random;
use geograd::distance3::{Apart, signed_distance};
use geograd::intersection3::{Pierced, first_hit, first_hit_triangle, length_inside, span};
use geograd::prelude::*;

/// Shoots rays at shapes, and checks hits by signed distances of points along the ray.
fn shoot<B>(told: &str, misses_matter: bool, mut make: impl FnMut(&mut Random) -> B)
where
    B: Pierced<Scalar = f64> + std::fmt::Debug,
    Vec3<f64>: Apart<B, Scalar = f64>,
{
    let mut random = Random(0x1234_5678_9abc);
    let mut hits = 0;
    for _ in 0..3000 {
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
        // What a segment has inside: by counting.
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
        let chord = span(ray.line(), shape);
        assert!(chord.enter == hit.parameter || chord.exit == hit.parameter);
    }
    assert!(hits > 50, "{told}: {hits}");
}

#[test]
fn hits_are_on_surfaces_and_nothing_is_hit_before() {
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

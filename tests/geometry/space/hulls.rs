//! Distances of convex hulls against the oracle, with proofs, and against shapes that have distances without a search.
use super::draw::Random;
use super::hull_draw::{FAMILIES, pair};
use super::hull_oracle::{Point, signed, size};
use geograd::distance3::{
    Apart, closest_points, distance, penetration, signed_distance, squared_distance,
};
use geograd::prelude::*;

fn hull(corners: &[Point]) -> Hull3<f64, 8> {
    let vertices: Vec<_> = corners
        .iter()
        .map(|&[x, y, z]| Vec3::new(x, y, z))
        .collect();
    Hull3::try_new(&vertices).unwrap()
}
fn corners(hull: &Hull3<f32, 8>) -> Vec<Point> {
    let wide = |v: &Vec3<f32>| [v.x, v.y, v.z].map(f64::from);
    hull.as_slice().iter().map(wide).collect()
}

/// The width of the slab across a direction between two hulls.
fn slab(a: &Hull3<f64, 8>, b: &Hull3<f64, 8>, across: Vec3<f64>) -> f64 {
    let from = a.vertices[0];
    let heights = |hull: &Hull3<f64, 8>| -> Vec<f64> {
        hull.as_slice()
            .iter()
            .map(|&v| across.dot(v - from))
            .collect()
    };
    let low = heights(b).into_iter().fold(f64::INFINITY, f64::min);
    low - heights(a).into_iter().fold(f64::NEG_INFINITY, f64::max)
}

/// The least signed distance of a point from a hull by planes through any three corners with all on one side.
fn outside(hull: &Hull3<f64, 8>, point: Vec3<f64>) -> f64 {
    signed(
        &[[point.x, point.y, point.z]],
        &hull
            .as_slice()
            .iter()
            .map(|v| [v.x, v.y, v.z])
            .collect::<Vec<_>>(),
    )
}

#[test]
fn hulls_are_as_far_apart_as_the_oracle_says() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for (family, name) in FAMILIES.iter().enumerate() {
        for _ in 0..150 {
            let [a, b] = pair(&mut random, family);
            let (truth, unit) = (signed(&a, &b), size(&a, &b).max(1e-300));
            let (a, b) = (hull(&a), hull(&b));
            // Points are as near as their coordinates allow.
            let near = 1e-11 * unit + 1e-15 * a.vertices[0].length();
            let found = signed_distance(a, b);
            let told = || format!("{name}: {found:e} {truth:e} {a:?} {b:?}");
            assert!((found - truth).abs() <= 1e-11 * unit, "{}", told());
            assert!(
                (signed_distance(b, a) - found).abs() <= 1e-12 * unit,
                "{}",
                told()
            );
            assert_eq!(distance(a, b), found.max(0.0), "{}", told());
            let square = found.max(0.0).powi(2);
            assert!(
                (squared_distance(a, b) - square).abs() <= 1e-13 * unit * unit,
                "{}",
                told()
            );

            // The proof: a plane that separates the hulls by the distance, and points that far apart on both.
            let (out, points) = (penetration(a, b), closest_points(a, b));
            assert_eq!(out.depth, (-found).max(0.0), "{}", told());
            let way = points.on_b - points.on_a;
            if out.direction == Vec3::zero() {
                assert!(found.abs() <= near && way.length() <= near, "{}", told());
                continue;
            }
            // A direction errs by a rounding of the size over the gap, down to some roundings.
            let turn = 1e-7 + 4e-15 * unit / found.abs().max(8e-15 * unit);
            assert!((out.direction.length() - 1.0).abs() < 1e-13, "{}", told());
            assert!(
                (slab(&a, &b, out.direction) - found).abs() <= turn * unit,
                "{}",
                told()
            );
            assert!((way.dot(out.direction) - found).abs() <= near, "{}", told());
            for (hull, point) in [(&a, points.on_a), (&b, points.on_b)] {
                // The first of planes that tie within rounding may be one whose foot is just beside a face.
                assert!(
                    outside(hull, point) <= near + 1e-9 * unit,
                    "{} {point:?}",
                    told()
                );
            }
        }
    }
}

#[test]
fn hulls_of_single_precision_are_as_far_apart_as_the_oracle_says() {
    if !geograd_tests::is_due("hulls_of_single_precision_are_as_far_apart_as_the_oracle_says") {
        return;
    }
    let mut random = Random(0x1234_5678_9abc_def1);
    // Their sizes are beyond the documented range of `f32`.
    let families = FAMILIES
        .iter()
        .enumerate()
        .filter(|(family, _)| ![9, 10].contains(family));
    for (family, name) in families {
        for _ in 0..150 {
            let [a, b] = pair(&mut random, family).map(|all| hull(&all).cast::<f32>());
            let (of_a, of_b) = (corners(&a), corners(&b));
            let (truth, unit) = (signed(&of_a, &of_b), size(&of_a, &of_b).max(1e-30));
            let found = f64::from(signed_distance(a, b));
            assert!(
                (found - truth).abs() <= 1e-5 * unit,
                "{name}: {found:e} {truth:e} {a:?} {b:?}"
            );
        }
    }
}

#[test]
fn hulls_of_boxes_are_as_far_apart_as_boxes() {
    let mut random = Random(0x5555_1234_9876_0001);
    for family in 0..super::draw::FAMILIES.len() {
        for _ in 0..60 {
            let (a, b) = (random.solid(family), random.solid(family));
            let truth = signed_distance(a, b);
            let unit = if family == 6 { 1e-8 } else { 1e-12 };
            for found in [
                signed_distance(Hull3::from(a), Hull3::from(b)),
                signed_distance(a, Hull3::from(b)),
                signed_distance(Hull3::from(a), b),
            ] {
                assert!((found - truth).abs() <= unit, "{found} {truth} {a:?} {b:?}");
            }
        }
    }
}

/// A shape and a hull, against a hull of the shape's corners and its radius.
fn agrees<A>(shape: A, of_corners: Hull3<f64, 8>, radius: f64, hull: Hull3<f64, 8>)
where
    A: Apart<Hull3<f64, 8>, Scalar = f64> + std::fmt::Debug,
{
    let (found, truth) = (
        shape.signed_distance(hull),
        of_corners.signed_distance(hull) - radius,
    );
    assert!(
        (found - truth).abs() < 1e-14,
        "{found} {truth} {shape:?} {hull:?}"
    );
    let (points, out) = (shape.closest_points(hull), shape.penetration(hull));
    let way = points.on_b - points.on_a;
    assert!(
        (way.dot(out.direction) - found).abs() < 1e-13,
        "{found} {points:?} {shape:?} {hull:?}"
    );
}

#[test]
fn shapes_with_corners_and_a_radius_have_distances_from_hulls() {
    let mut random = Random(0x0bad_5eed_1234_5678);
    for _ in 0..100 {
        let [_, b] = pair(&mut random, 0);
        let other = hull(&b);
        let p: [Vec3<f64>; 4] = std::array::from_fn(|_| random.vector(1.5));
        let radius = random.within(0.0, 0.5);
        let of = |vertices: &[Vec3<f64>]| Hull3::from_vertices(vertices);
        agrees(p[0], of(&p[..1]), 0.0, other);
        agrees(Sphere::new(p[0], radius), of(&p[..1]), radius, other);
        agrees(Segment3::new(p[0], p[1]), of(&p[..2]), 0.0, other);
        agrees(
            Capsule3::new(p[0], p[1], radius),
            of(&p[..2]),
            radius,
            other,
        );
        agrees(Triangle3::new(p[0], p[1], p[2]), of(&p[..3]), 0.0, other);
        agrees(Tetrahedron::new(p[0], p[1], p[2], p[3]), of(&p), 0.0, other);
        let plane = Plane3::new(p[0], 0.25);
        let truth = other
            .as_slice()
            .iter()
            .map(|&v| plane.signed_distance(v))
            .fold(f64::INFINITY, f64::min);
        assert!((plane.signed_distance(other) - truth).abs() < 1e-14);
    }
    // A ball about a point of a segment parts from it across.
    let line: Hull3<f64, 8> = Hull3::from_vertices(&[Vec3::zero(), Vec3::new(2.0, 0.0, 0.0)]);
    let ball = Sphere::new(Vec3::new(1.0, 0.0, 0.0), 0.5);
    let points = ball.closest_points(line);
    assert_eq!(ball.signed_distance(line), -0.5);
    assert_eq!((points.on_a - ball.center).x, 0.0);
    assert_eq!((points.on_a - points.on_b).length(), 0.5);
}

#[test]
fn vertices_beyond_the_count_are_not_read() {
    let corner = |k: usize| [0, 1, 2].map(|bit| f64::from(u8::from(k >> bit & 1 == 1)));
    let mut cube = hull(&[0, 1, 2, 4].map(corner));
    let far = Vec3::new(4.0, 0.0, 0.0);
    let floor = Plane3::new(Vec3::new(0.0, 0.0, 1.0), -2.0);
    let of = |cube: Hull3<f64, 8>| {
        let near = cube.signed_distance(far);
        (near, far.signed_distance(cube), floor.signed_distance(cube))
    };
    let known = of(cube);
    assert_eq!(known, (3.0, 3.0, 2.0));
    cube.vertices[4..].fill(Vec3::new(f64::NAN, f64::NAN, f64::NAN));
    assert_eq!(of(cube), known);
    cube.vertices[3].x = f64::NAN;
    let (a, b, c) = of(cube);
    assert!(a.is_nan() && b.is_nan() && c.is_nan());
}

#[test]
fn edges_along_each_other_but_for_rounding_are_nearest_beside_their_ends() {
    let hull =
        |corners: [[f32; 3]; 8]| Hull3::<f32, 8>::from(corners.map(|[x, y, z]| Vec3::new(x, y, z)));
    let tiny = 5.709_358e-17;
    let a = hull([
        [-1.5, -2.0, -1.5],
        [-0.5, -2.0, -1.5],
        [-1.5, -tiny, -1.5],
        [-0.5, tiny, -1.5],
        [-1.5, -2.0, -0.5],
        [-0.5, -2.0, -0.5],
        [-1.5, -tiny, -0.5],
        [-0.5, tiny, -0.5],
    ]);
    let b = hull([
        [-0.25, -3.887_427_6e-15, -0.75],
        [0.25, -4.106_178e-15, -0.75],
        [-0.25, 1.0, -0.75],
        [0.25, 1.0, -0.75],
        [-0.25, 4.106_178e-15, -0.25],
        [0.25, 3.887_427_6e-15, -0.25],
        [-0.25, 1.0, -0.25],
        [0.25, 1.0, -0.25],
    ]);
    assert_eq!(a.signed_distance(b), 0.25);
    assert_eq!(b.signed_distance(a), 0.25);
    let points = a.closest_points(b);
    assert!(((points.on_b - points.on_a).length() - 0.25).abs() < 1e-6);
}

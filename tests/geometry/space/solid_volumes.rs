//! Volumes that bodies with flat faces share, against an oracle and closed forms.
use super::draw::Random;
use super::hull_draw::{FAMILIES, pair};
use super::hull_oracle::Point;
use super::volume_oracle::shared;
use geograd::prelude::*;

type Hull = Hull3<f64, 8>;

fn hull(corners: &[Point]) -> Hull {
    let vertices: Vec<_> = corners
        .iter()
        .map(|&[x, y, z]| Vec3::new(x, y, z))
        .collect();
    Hull3::from_vertices(&vertices)
}

fn extent(corners: &[Point]) -> f64 {
    let along = |i: usize| {
        let all = corners.iter().map(|p| p[i]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    along(0).max(along(1)).max(along(2))
}

/// Both hulls in units of the larger one, near the origin: exactly, but for families far from it.
fn placed([a, b]: &[Vec<Point>; 2]) -> ([Vec<Point>; 2], f64) {
    let from = a[0];
    let size = extent(a).max(extent(b)).max(f64::MIN_POSITIVE);
    let unit = size.log2().floor().exp2().recip();
    let place = |all: &[Point]| -> Vec<Point> {
        let of = |p: &Point| [0, 1, 2].map(|i| (p[i] - from[i]) * unit);
        all.iter().map(of).collect()
    };
    ([place(a), place(b)], unit)
}

/// The error of a volume, in roundings of the smaller size squared times the larger.
fn error(corners: &[Vec<Point>; 2], found: f64, right: f64, epsilon: f64) -> f64 {
    let sizes = corners.each_ref().map(|all| extent(all));
    let (less, more) = (sizes[0].min(sizes[1]), sizes[0].max(sizes[1]));
    let size = less * less * more;
    if size == 0.0 {
        return if found == right { 0.0 } else { f64::INFINITY };
    }
    (found - right).abs() / (size * epsilon)
}

#[test]
fn volumes_of_hulls_are_those_of_an_oracle() {
    let mut random = Random(0x2b99_2ddf_a232_49d6);
    for (family, name) in FAMILIES.iter().enumerate() {
        let (mut worst, mut met) = (0.0_f64, 0);
        for _ in 0..25 {
            let drawn = pair(&mut random, family);
            let ([a, b], unit) = placed(&drawn);
            if a.iter().chain(&b).any(|p| p.iter().any(|x| x.abs() > 8.0)) {
                continue;
            }
            let right = shared(&a, &b);
            met += usize::from(right > 0.0);
            let found = hull(&drawn[0]).intersection_volume(hull(&drawn[1])) * unit * unit * unit;
            let other = hull(&b).intersection_volume(hull(&a));
            let here = [a, b];
            for found in [found, other] {
                let error = error(&here, found, right, f64::EPSILON);
                worst = worst.max(error);
                assert!(error < 2.0, "{name}: {found} {right} {error} {here:?}");
            }
        }
        println!("{name}: {met} with a volume, error {worst}");
    }
}

#[test]
fn volumes_of_bodies_with_common_corners_are_those_of_an_oracle() {
    let mut random = Random(0x6a09_e667_f3bc_c908);
    let mut worst: f64 = 0.0;
    for _ in 0..300 {
        let mut a: Vec<Point> = (0..4 + random.below(3))
            .map(|_| [(); 3].map(|()| random.below(9) as f64 * 0.25 - 1.0))
            .collect();
        let mut b = a.clone();
        for corner in &mut b {
            let step = [0.0, 0.0, 0.0, 0.25, 1e-9, -1e-12, 1e-6, 3e-16][random.below(8)];
            corner[random.below(3)] += step;
        }
        if random.below(2) == 0 {
            let k = random.below(a.len());
            a[k] = [(); 3].map(|()| random.below(9) as f64 * 0.25 - 1.0);
        }
        let right = shared(&a, &b);
        let found = [
            hull(&a).intersection_volume(hull(&b)),
            hull(&b).intersection_volume(hull(&a)),
        ];
        for found in found {
            worst = worst.max((found - right).abs());
            assert!((found - right).abs() < 2e-15, "{found} {right} {a:?} {b:?}");
        }
    }
    println!("{worst:e}");
}

#[test]
fn bodies_of_every_kind_agree_with_hulls_of_their_corners() {
    let mut random = Random(0x51ed_270b_9f3a_77c1);
    let mut met = 0;
    for _ in 0..100 {
        let mut vector = |size: f64| random.vector(size);
        let [a, b, c, d] = [(); 4].map(|()| vector(1.0));
        let solid = Tetrahedron::new(a, b, c, d);
        let turn = vector(1.0);
        let (center, half) = (vector(0.5), vector(0.5));
        let size = Vec3::new(1.1, 0.9, 1.3) + half;
        let turned = Obb3::new(center, size, Rotation3::new(1.0, turn.x, turn.y, turn.z));
        let upright = YawBox3::new(center, size, turn.z);
        let low = center - size * 0.5;
        let aligned = Aabb3::new(low, low + size);
        let hull: Hull3<f64, 4> = Hull3::from(solid);
        let wide: Hull = Hull3::from_vertices(hull.as_slice());
        let right = Hull3::from(turned).intersection_volume(wide);
        met += usize::from(right > 0.0);
        let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{x} {y} {solid:?} {turned:?}");
        near(solid.intersection_volume(turned), right);
        near(turned.intersection_volume(solid), right);
        near(turned.intersection_volume(wide), right);
        let other = upright.intersection_volume(wide);
        near(
            Hull3::from(Obb3::from(upright)).intersection_volume(wide),
            other,
        );
        let other = aligned.intersection_volume(wide);
        near(
            Hull3::from(Obb3::from(aligned)).intersection_volume(wide),
            other,
        );
        let (own, others) = (solid.volume(), turned.volume());
        near(solid.iou(turned), right / (own + others - right));
        near(turned.iof(wide), right / others);
        near(wide.iof(turned), right / own);
        let parts = [1.0, -1.0].map(|side| {
            let plane = Plane3::through(center, turn * side);
            wide.intersection_volume(plane)
        });
        near(parts[0] + parts[1], own);
    }
    assert!(met > 50, "{met}");
}

#[test]
fn equal_bodies_have_the_ratio_one_and_touching_ones_none() {
    let mut random = Random(0x77aa_33cc_55ee_11bb);
    for _ in 0..50 {
        let hull: Hull3<f64, 6> = Hull3::from([(); 6].map(|()| random.vector(1.0)));
        let (value, (a, b)) =
            geograd::ad::gradient(|(a, b): (Hull3<_, 6>, Hull3<_, 6>)| a.iou(b), (hull, hull));
        assert_eq!(
            (value, a.vertices, b.vertices),
            (1.0, [Vec3::zero(); 6], [Vec3::zero(); 6])
        );
        assert!((hull.intersection_volume(hull) - hull.volume()).abs() < 1e-15);
    }
    let cube = |x: f64| {
        Hull3::from(Obb3::new(
            Vec3::new(x, 0.0, 0.0),
            Vec3::new(1.0, 1.0, 1.0),
            Rotation3::identity(),
        ))
    };
    let between = |(a, b): (Hull3<_, 8>, Hull3<_, 8>)| a.intersection_volume(b);
    let (value, slopes) = geograd::ad::gradient(between, (cube(0.0), cube(1.0)));
    assert_eq!(value, 0.0);
    assert!(slopes.scalars().iter().all(|&slope| slope == 0.0));
    // Faces of both in four planes share: each has half of the slope.
    let (value, (a, _)) = geograd::ad::gradient(between, (cube(0.0), cube(0.5)));
    assert!((value - 0.5).abs() < 1e-15);
    let upwards: f64 = a
        .vertices
        .iter()
        .filter(|v| v.z != 0.0)
        .map(|v| v.z.abs())
        .sum();
    assert!((upwards - 0.5).abs() < 1e-15, "{upwards}");
}

#[test]
fn single_precision_has_the_volumes_of_double() {
    let mut random = Random(0x1234_abcd_9876_fedc);
    let mut worst: f64 = 0.0;
    for _ in 0..300 {
        let mut hull = || Hull3::from([(); 8].map(|()| random.vector(1.0)));
        let (a, b): (Hull, Hull) = (hull(), hull());
        let narrow = |hull: Hull| -> Hull3<f32, 8> {
            Hull3::from(
                hull.vertices
                    .map(|v| Vec3::new(v.x as f32, v.y as f32, v.z as f32)),
            )
        };
        let found = f64::from(narrow(a).intersection_volume(narrow(b)));
        worst = worst.max((found - a.intersection_volume(b)).abs());
    }
    assert!(worst < 1e-5, "{worst}");
}

#[test]
fn sections_are_polygons_in_their_planes() {
    let mut random = Random(0x0dd0_1234_5678_9abc);
    for _ in 0..100 {
        let hull: Hull = Hull3::from([(); 8].map(|()| random.vector(1.0)));
        let plane = Plane3::through(random.vector(0.3), random.vector(1.0));
        let ring = hull.slice(plane);
        let mut area = Vec3::zero();
        for pair in ring.get(1..).unwrap_or(&[]).windows(2) {
            area += (pair[0] - ring[0]).cross(pair[1] - ring[0]) * 0.5;
        }
        assert!((area.length() - hull.intersection_area(plane)).abs() < 1e-15);
        assert!(ring.len() < 3 || area.dot(plane.normal) > 0.0);
        assert!(ring.iter().all(|&p| plane.signed_distance(p).abs() < 1e-15));
        // The slope of the volume by the offset of a normal of length one.
        let unit = Plane3::through(
            plane.project(Vec3::zero()),
            plane.normal.normalize_or_zero(),
        );
        let (_, slope) = geograd::ad::gradient(
            |plane: Plane3<_>| hull.lift().intersection_volume(plane),
            unit,
        );
        assert!((slope.offset - area.length()).abs() < 1e-14);
    }
}

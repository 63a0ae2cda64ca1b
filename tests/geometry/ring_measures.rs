//! Measures of a ring.
use geograd::ad::check::Check;
use geograd::ad::check::strategy::ordinary;
use geograd::ring::{centroid, perimeter, signed_area};
use geograd::{Obb2, Pack, Vec2, ad};
use proptest::prelude::*;

fn v(x: f64, y: f64) -> Vec2<f64> {
    Vec2::new(x, y)
}

#[test]
fn degenerate_rings_are_valid() {
    let none: [Vec2<f64>; 0] = [];
    assert_eq!(
        (signed_area(&none), perimeter(&none), centroid(&none)),
        (0.0, 0.0, v(0.0, 0.0))
    );
    let one = [v(3.0, 4.0)];
    assert_eq!(
        (signed_area(&one), perimeter(&one), centroid(&one)),
        (0.0, 0.0, v(3.0, 4.0))
    );
    let two = [v(0.0, 0.0), v(3.0, 4.0)];
    assert_eq!(
        (signed_area(&two), perimeter(&two), centroid(&two)),
        (0.0, 10.0, v(1.5, 2.0))
    );
    // Collinear: no area, so the mean of the vertices.
    let line = [v(0.0, 0.0), v(1.0, 1.0), v(5.0, 5.0)];
    assert_eq!((signed_area(&line), centroid(&line)), (0.0, v(2.0, 2.0)));
    // Repeated vertices change nothing but the count of edges of length zero.
    let square = [v(0.0, 0.0), v(2.0, 0.0), v(2.0, 2.0), v(0.0, 2.0)];
    let repeated = [
        square[0], square[0], square[1], square[2], square[2], square[2], square[3],
    ];
    assert_eq!((signed_area(&repeated), perimeter(&repeated)), (4.0, 8.0));
    assert_eq!(centroid(&repeated), v(1.0, 1.0));
    let (_, bars) = ad::gradient(|r: Vec<Vec2<_>>| perimeter(&r), repeated.to_vec());
    assert!(bars.scalars().iter().all(|x| x.is_finite()));
    // Clockwise is negative.
    let clockwise: Vec<_> = square.into_iter().rev().collect();
    assert_eq!(signed_area(&clockwise), -4.0);
    assert_eq!(centroid(&clockwise), v(1.0, 1.0));
}

#[test]
fn extreme_rings_are_finite() {
    for size in [1e-300, 1e-160, 1e-20, 1.0, 1e20, 1e160, 1e307] {
        let ring = [
            v(0.0, 0.0),
            v(size, 0.0),
            v(size, size),
            v(0.0, size),
            v(0.0, size),
        ];
        assert!(signed_area(&ring).is_finite() && perimeter(&ring).is_finite());
        let middle = centroid(&ring);
        assert!((middle.x / size - 0.5).abs() < 1e-15 && (middle.y / size - 0.5).abs() < 1e-15);
        let mut bars = vec![v(0.0, 0.0); 5];
        ad::adjoint::ring::centroid_vjp(&ring, v(1.0, 1.0), &mut bars);
        assert!(bars.iter().all(|bar| bar.is_finite()));
        ad::adjoint::ring::signed_area_vjp(&ring, 1.0, &mut bars);
        assert!(bars.iter().all(|bar| bar.is_finite()));
    }
    // Far from the origin f32 keeps the digits that the inputs have.
    let far = [(0, 0), (2, 0), (2, 1), (0, 1)]
        .map(|(x, y)| Vec2::new(1e6_f32 + x as f32, -1e6 + y as f32));
    assert_eq!((signed_area(&far), perimeter(&far)), (2.0, 6.0));
    assert_eq!(centroid(&far), Vec2::new(1_000_001.0, -999_999.5));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    #[test]
    fn the_start_and_the_place_do_not_matter(ring in ordinary::<Vec<Vec2<f64>>>(), start in 0_usize..12, x in -50.0..50.0, turn in -3.0..3.0) {
        let mut rolled = ring.clone();
        rolled.rotate_left(start % ring.len());
        prop_assert!((signed_area(&ring) - signed_area(&rolled)).abs() < 1e-11);
        prop_assert!((perimeter(&ring) - perimeter(&rolled)).abs() < 1e-11);
        let motion = geograd::Pose2::new(v(x, -x), turn);
        let moved: Vec<_> = ring.iter().map(|&p| motion * p).collect();
        prop_assert!((signed_area(&ring) - signed_area(&moved)).abs() < 1e-9);
        prop_assert!((perimeter(&ring) - perimeter(&moved)).abs() < 1e-10);
        if signed_area(&ring).abs() > 0.1 {
            prop_assert!((motion * centroid(&ring) - centroid(&moved)).length() < 1e-8);
        }
    }

    #[test]
    fn area_and_centroid_add_up_over_a_fan(ring in ordinary::<Vec<Vec2<f64>>>()) {
        // An independent way: triangles from the origin, weighted by their areas.
        let (mut area, mut moment) = (0.0, v(0.0, 0.0));
        for i in 0..ring.len() {
            let (p, q) = (ring[i], ring[(i + 1) % ring.len()]);
            let part = (p.x * q.y - q.x * p.y) / 2.0;
            area += part;
            moment += (p + q) * (part / 3.0);
        }
        prop_assert!((signed_area(&ring) - area).abs() < 1e-10);
        if area.abs() > 0.1 {
            prop_assert!((centroid(&ring) - moment * (1.0 / area)).length() < 1e-9);
        }
    }

    #[test]
    fn a_box_is_a_ring(x in -5.0..5.0, y in -5.0..5.0, w in 0.1..5.0, h in 0.1..5.0, r in -3.0..3.0) {
        let shape: Obb2<f64> = Obb2::new(x, y, w, h, r);
        let ring = shape.corners();
        prop_assert!((signed_area(&ring) - shape.area()).abs() < 1e-12);
        prop_assert!((perimeter(&ring) - 2.0 * (w + h)).abs() < 1e-12);
        prop_assert!((centroid(&ring) - shape.center).length() < 1e-12);
        let again = Obb2::from_corners(ring);
        prop_assert!((again.iou(shape) - 1.0).abs() < 1e-12);
        prop_assert!(shape.bounding().area() >= shape.area() - 1e-12);
        for corner in ring {
            let slightly_in = corner.lerp(shape.center, 1e-9);
            prop_assert!(shape.contains(slightly_in) && shape.bounding().contains(slightly_in));
            prop_assert!(!shape.contains(corner.lerp(shape.center, -1e-9)));
        }
    }
}

/// Vertices are worked on sixteen at a time: lengths around one, two and four times that.
fn lengths() -> impl Iterator<Item = usize> {
    (1..40).chain([63, 64, 65, 66, 100])
}

/// A ring with whole numbers.
fn whole(n: usize) -> Vec<Vec2<f64>> {
    let at = |i: usize| {
        v(
            ((i * i * 7 + 3) % 41) as f64,
            ((i * 13 + i * i) % 37) as f64,
        )
    };
    (0..n).map(at).collect()
}

#[test]
fn every_length_agrees_with_plain_sums() {
    for ring in lengths().map(whole) {
        let n = ring.len();
        let next = |i: usize| ring[(i + 1) % n];
        // Exact on whole numbers.
        let twice: f64 = (0..n).map(|i| ring[i].perp_dot(next(i))).sum();
        assert_eq!(signed_area(&ring), twice / 2.0, "{n} vertices");
        let length: f64 = (0..n).map(|i| (next(i) - ring[i]).length()).sum();
        assert!((perimeter(&ring) - length).abs() <= 1e-14 * length * n as f64);
        if twice != 0.0 {
            let moment = (0..n).fold(v(0.0, 0.0), |sum, i| {
                sum + (ring[i] + next(i)) * ring[i].perp_dot(next(i))
            });
            let expected = moment * (1.0 / (3.0 * twice));
            let far = expected.length().max(40.0);
            assert!(
                centroid(&ring).distance(expected) < 1e-12 * far,
                "{n} vertices"
            );
        }
    }
}

#[test]
fn adjoints_are_right_at_every_length() {
    if !geograd_tests::is_due("adjoints_are_right_at_every_length") {
        return;
    }
    let bars = |ring: &Vec<Vec2<f64>>| ring.clone();
    Check::among(lengths().map(whole))
        .value(|ring: Vec<Vec2<f64>>| signed_area(&ring))
        .dual(|ring: Vec<Vec2<_>>| signed_area(&ring))
        .gradient(|ring| {
            let mut bar = bars(&ring);
            ad::adjoint::ring::signed_area_vjp(&ring, 1.0, &mut bar);
            bar
        })
        .assert();
    Check::among(lengths().map(whole))
        .value(|ring: Vec<Vec2<f64>>| perimeter(&ring))
        .dual(|ring: Vec<Vec2<_>>| perimeter(&ring))
        .gradient(|ring| {
            let mut bar = bars(&ring);
            ad::adjoint::ring::perimeter_vjp(&ring, 1.0, &mut bar);
            bar
        })
        .assert();
    Check::among(lengths().filter(|&n| n > 2).map(whole))
        .value(|ring: Vec<Vec2<f64>>| centroid(&ring))
        .dual(|ring: Vec<Vec2<_>>| centroid(&ring))
        .adjoint(|ring, out_bar: &[f64]| {
            let mut bar = bars(&ring);
            ad::adjoint::ring::centroid_vjp(&ring, v(out_bar[0], out_bar[1]), &mut bar);
            bar
        })
        .assert();
}

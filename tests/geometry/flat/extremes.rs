//! Specks beside giants, needles that rounding turns over, and angles below the least normal number.
use geograd::ad::{gradient, jacobian};
use geograd::distance::{Convex, closest_points, distance, penetration, signed_distance};
use geograd::iou::{eiou_aabb_obb2, hull_area_obb2};
use geograd::{Capsule2, Circle, Obb2, Pack, Scalar, Segment2, Triangle2, Vec2};

fn points<const N: usize>(numbers: [[f64; 2]; N]) -> [Vec2<f64>; N] {
    numbers.map(|[x, y]| Vec2::new(x, y))
}

fn segment(numbers: [[f64; 2]; 2]) -> Segment2<f64> {
    let [from, to] = points(numbers);
    Segment2::new(from, to)
}

fn triangle(numbers: [[f64; 2]; 3]) -> Triangle2<f64> {
    let [a, b, c] = points(numbers);
    Triangle2::new(a, b, c)
}

/// Both orders of two shapes have a distance, to a few roundings of the largest coordinate.
fn are_apart<A: Convex<f64>, B: Convex<f64>>(a: A, b: B, by: f64, largest: f64) {
    let slack = 16.0 * f64::EPSILON * largest;
    for found in [
        distance(a, b),
        distance(b, a),
        signed_distance(a, b),
        signed_distance(b, a),
    ] {
        assert!((found - by).abs() <= slack, "{found:e} is not {by:e}");
    }
}

/// The faces of a speck are too short to count, and those of the giant do not bound it lengthwise.
#[test]
fn specks_on_the_line_of_a_giant_are_apart_from_it() {
    let speck = segment([[0.0, 1.0], [0.0, 0.0]]);
    let giant = segment([[2.1267647932558652e37, 0.0], [5.316911983139663e36, 2e-19]]);
    are_apart(speck, giant, 5.316911983139663e36, giant.from.x);
    let capsule = |shape: Segment2<f64>| Capsule2 {
        from: shape.from,
        to: shape.to,
        radius: 0.0,
    };
    let giant = segment([
        [3.4e-18, -2.933487712768306e38],
        [0.0, -1.618172962370735e42],
    ]);
    let speck = segment([[1.0, 0.0], [0.0, 0.0]]);
    let by = 2.933487712768306e38;
    are_apart(capsule(giant), capsule(speck), by, giant.to.y.abs());
    let point = triangle([[0.0, 0.0]; 3]);
    let needle = triangle([
        [0.0, -2.2300745198530623e43],
        [1.0, -2.1267647932558652e37],
        [-1.0, -2.1267647932558647e37],
    ]);
    are_apart(point, needle, 2.1267647932558647e37, needle.a.y.abs());
}

/// A needle that turns clockwise when its corners are rounded keeps its short side on the outside.
#[test]
fn needles_overlap_what_they_cross() {
    let needles = [
        (
            [[0.0, 0.0], [0.0, 0.0], [-256.0, 0.0]],
            [[-256.0, 1.0], [0.0, -256.0], [-7.6e-6, -256.0]],
        ),
        (
            [[2048.0, 0.0], [1.0, 0.0], [0.0, 131072.0]],
            [[7.6e-6, 0.0], [1.0, 131072.0], [0.0, -0.015625]],
        ),
        (
            [[40960.0, 0.0], [0.0, 0.0], [0.0, 40960.0]],
            [
                [524288.0, 147456.0],
                [-1.0, -0.0234375],
                [-1.125, -0.05859375],
            ],
        ),
    ];
    for (a, b) in needles {
        let largest = a.concat().into_iter().chain(b.concat());
        let largest = largest.fold(0.0_f64, |most, x: f64| most.max(x.abs()));
        let slack = 16.0 * f64::from(f32::EPSILON) * largest;
        let single = |shape: [[f64; 2]; 3]| {
            let [a, b, c] = shape.map(|[x, y]| Vec2::new(x as f32, y as f32));
            Triangle2::new(a, b, c)
        };
        let double = |shape: Triangle2<f32>| {
            let [a, b, c] = shape.corners();
            let widen = |v: Vec2<f32>| Vec2::new(f64::from(v.x), f64::from(v.y));
            Triangle2::new(widen(a), widen(b), widen(c))
        };
        let (a, b) = (single(a), single(b));
        let depth = signed_distance(double(a), double(b));
        for (a, b) in [(a, b), (b, a)] {
            let found = f64::from(signed_distance(a, b));
            assert!((found - depth).abs() <= slack, "{found} is not {depth}");
            assert_eq!(distance(a, b), 0.0);
        }
    }
}

fn all_finite(rows: &[impl Pack<Scalar = f32>], at: &str) {
    let derivatives: Vec<f32> = rows.iter().flat_map(Pack::scalars).collect();
    assert!(
        derivatives.iter().all(|x| x.is_finite()),
        "{at}: {derivatives:?}"
    );
}

/// A length that only the sine of such an angle makes is so short that its reciprocal is not finite.
#[test]
fn derivatives_beside_angles_below_the_least_normal_number_are_finite() {
    let (disc, flat) = (
        Circle::new(Vec2::new(0.015625_f32, 0.0), 1.193028),
        Obb2::new(0.49999994_f32, 0.0, 1.486026, 0.0, -8.816208e-39),
    );
    let deep = |(a, b): (Circle<_>, Obb2<_>)| {
        let found = penetration(a, b);
        (found.depth, found.direction)
    };
    let ((depth, direction), derivatives) = jacobian(deep, (disc, flat));
    assert_eq!((depth, direction), (1.193028, Vec2::new(0.0, 1.0)));
    let (of_depth, of_direction) = derivatives;
    let (by_disc, by_flat) = of_depth;
    assert_eq!((by_disc.center.y, by_disc.radius), (1.0, 1.0));
    assert_eq!(by_flat.center.y, -1.0);
    all_finite(&[of_depth, of_direction.x, of_direction.y], "penetration");
    let near = |(a, b): (Circle<_>, Obb2<_>)| {
        let found = closest_points(a, b);
        (found.on_a, found.on_b)
    };
    let (_, (on_a, on_b)) = jacobian(near, (disc, flat));
    all_finite(&[on_a.x, on_a.y, on_b.x, on_b.y], "closest_points");

    let (a, b) = (
        Obb2::new(-131072.0_f32, 63.999996, 0.0, 0.015625, -1.1754944e-38),
        Obb2::new(-131072.0_f32, -0.0234375, 0.0, 1.5258788e-5, -1e-45),
    );
    let (_, derivatives) = gradient(|(a, b): (Obb2<_>, Obb2<_>)| eiou_aabb_obb2(a, b), (a, b));
    all_finite(&[derivatives], "eiou_aabb_obb2");
}

/// A point on the line of a flat box: terms of the square of its distance cancel.
#[test]
fn the_hull_of_flat_boxes_on_a_line_has_no_negative_area() {
    fn area<S: Scalar>(x: f64, heading: f64, width: f64) -> [S; 2] {
        let [zero, x, heading, width] = [0.0, x, heading, width].map(S::lit);
        let (a, b) = (
            Obb2::new(x, zero, zero, zero, heading),
            Obb2::new(zero, zero, width, zero, zero),
        );
        [hull_area_obb2(a, b), hull_area_obb2(b, a)]
    }
    let places = [
        (-2.64017213989243e28, 3435107238.02895, 5.202283080887259e35),
        (
            2.1267647932558652e37,
            -4.728261245373983e-5,
            1.241407211521578e45,
        ),
    ];
    for (x, heading, width) in places {
        for found in area::<f64>(x, heading, width) {
            // The area of a rounding of the way across the whole width.
            let most = 8.0 * f64::EPSILON * x.abs() * width;
            assert!((0.0..=most).contains(&found), "{found:e}");
        }
    }
}

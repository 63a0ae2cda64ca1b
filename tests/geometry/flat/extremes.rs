//! Flat boxes on a line, and needles that rounding turns over.
use geograd::distance::{distance, signed_distance};
use geograd::iou::hull_area_obb2;
use geograd::{Obb2, Scalar, Triangle2, Vec2};

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

//! Flat boxes on a line.
use geograd::iou::hull_area_obb2;
use geograd::{Obb2, Scalar};

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

//! Bugs of DGAL, a differentiable library in C++, that concern these functions, under their numbers, with the right answers.
use geograd::distance::ring::signed_distance_to_ring;
use geograd::distance::{clearance, distance, farthest_distance, signed_distance};
use geograd::{Aabb2, Interval, Jet, Line2, Segment2, Triangle2, Vec2};

fn at<S>(x: S, y: S) -> Vec2<S> {
    Vec2::new(x, y)
}

/// B1: the slopes of a point's distance from `a x + b y + c = 0` in a and b.
#[test]
fn b1_slopes_in_the_coefficients_of_a_line() {
    let x: [Jet<f64, 3>; 3] = std::array::from_fn(|k| Jet::variable([1.3, -0.7, 0.4][k], k));
    let line = Line2::from_coefficients(x[0], x[1], x[2]);
    let side = line.side(at(Jet::variable(2.1, 9), Jet::variable(0.9, 9)));
    let n = 1.3_f64.hypot(0.7);
    assert!((side.value - (1.3 * 2.1 - 0.7 * 0.9 + 0.4) / n).abs() < 1e-14);
    // Measured by finite differences of the seed's own value: (0.4126, 1.1532).
    assert!((side.slope[0] - 0.4126).abs() < 5e-5 && (side.slope[1] - 1.1532).abs() < 5e-5);
    assert!((side.slope[2] - 1.0 / n).abs() < 1e-15);
    // The unsigned distance has the same slopes here.
    let point = at(Jet::variable(2.1, 9), Jet::variable(0.9, 9));
    let unsigned = distance(point, line);
    assert!((0..3).all(|k| (unsigned.slope[k] - side.slope[k]).abs() < 1e-14));
}

/// B2: points of a vertical line.
#[test]
fn b2_a_vertical_line_is_a_line_like_any_other() {
    let line = Line2::from_coefficients(1.0, 0.0, -2.0); // x = 2
    for t in [-3.0, 0.0, 7.5] {
        assert_eq!(line.point_at(t).x, 2.0);
        assert_eq!(line.parameter_of(line.point_at(t)), t);
    }
    let other = Line2::through(at(2.0, 5.0), at(2.0, -1.0));
    assert_eq!(other.nearest(at(-4.0, 3.0)), at(2.0, 3.0));
    assert_eq!(other.side(at(-4.0, 3.0)), -6.0); // it runs downwards
}

/// B3: outside is outside on the extension of an edge, too.
#[test]
fn b3_signs_on_the_extension_of_an_edge() {
    let square = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
    for (point, want) in [
        (at(2.0, 0.0), 1.0),
        (at(2.0, 0.5), 1.0),
        (at(0.5, 0.25), -0.25),
        (at(-1.0, 1.0), 1.0),
        (at(0.5, 0.0), 0.0),
    ] {
        assert_eq!(signed_distance_to_ring(point, &square), want);
        assert_eq!(signed_distance(square, point), want);
        // The seed's sign, positive inside, by another name.
        assert_eq!(clearance(square, point), -want);
    }
    let clockwise = [square[3], square[2], square[1], square[0]];
    assert_eq!(signed_distance_to_ring(at(2.0, 0.0), &clockwise), 1.0);
    assert_eq!(signed_distance_to_ring(at(0.5, 0.25), &clockwise), -0.25);
    // A segment has no inside: its distance has no sign.
    assert_eq!(
        signed_distance(Segment2::new(square[0], square[1]), at(3.0, 0.0)),
        2.0
    );
}

/// B7: equal points.
#[test]
fn b7_equal_points_have_slope_zero() {
    let x: [Jet<f64, 4>; 4] = std::array::from_fn(|k| Jet::variable([1.5, 2.0, 1.5, 2.0][k], k));
    let (a, b) = (at(x[0], x[1]), at(x[2], x[3]));
    for d in [
        distance(a, b),
        signed_distance(a, b),
        farthest_distance(a, b),
    ] {
        assert_eq!((d.value, d.slope), (0.0, [0.0; 4]));
    }
}

/// B8: what is flat is measured, not walked around for ever.
#[test]
fn b8_flat_shapes() {
    let flat = [at(0.0, 0.0), at(4.0, 0.0), at(4.0, 0.0), at(0.0, 0.0)];
    assert_eq!(farthest_distance(flat, flat), 4.0);
    assert_eq!(distance(flat, at(2.0, 3.0)), 3.0);
    assert_eq!(signed_distance(flat, at(2.0, 0.0)), 0.0);
    assert_eq!(
        distance(
            Triangle2::new(at(0.0, 0.0), at(1.0, 1.0), at(3.0, 3.0)),
            at(4.0, 4.0)
        ),
        2f64.sqrt()
    );
}

/// B11 and B16: no tolerance with a unit.
#[test]
fn b11_b16_small_shapes_are_shapes() {
    for size in [1e-4_f64, 1e-7, 1e-30, 1e-150] {
        let square = Aabb2::new(0.0, 0.0, size, size);
        assert!((signed_distance(square, at(size / 4.0, size / 2.0)) / size + 0.25).abs() < 1e-15);
        let other = Segment2::new(at(2.0 * size, 0.0), at(3.0 * size, size));
        assert!((distance(square, other) / size - 1.0).abs() < 1e-15);
    }
}

/// B13 and B14: the farthest distance, with both of its corners, and nested boxes.
#[test]
fn b13_b14_farthest_distance() {
    let x: [Jet<f64, 8>; 8] =
        std::array::from_fn(|k| Jet::variable([0.0, 0.0, 10.0, 10.0, 4.0, 4.0, 7.0, 7.0][k], k));
    let boxes = (
        Aabb2::new(x[0], x[1], x[2], x[3]),
        Aabb2::new(x[4], x[5], x[6], x[7]),
    );
    let far = farthest_distance(boxes.0, boxes.1);
    assert_eq!(far.value, 98.0_f64.sqrt());
    let u = 0.5_f64.sqrt();
    let want = [-u, -u, 0.0, 0.0, 0.0, 0.0, u, u];
    assert!(
        (0..8).all(|k| (far.slope[k] - want[k]).abs() < 1e-15),
        "{far:?}"
    );
    let nested = farthest_distance(
        Aabb2::new(0.0, 0.0, 10.0, 10.0),
        Aabb2::new(4.0, 4.0, 6.0, 6.0),
    );
    assert_eq!(nested, 72.0_f64.sqrt());
}

/// B19: a triangle may be given in either orientation.
#[test]
fn b19_either_orientation() {
    let (a, b, c) = (at(0.0, 0.0), at(4.0, 0.0), at(0.0, 3.0));
    let p = at(1.0, 1.0);
    let (left, right) = (Triangle2::new(a, b, c), Triangle2::new(a, c, b));
    assert_eq!(signed_distance(left, p), signed_distance(right, p));
    assert!(signed_distance(left, p) < 0.0);
    assert_eq!(
        (left.area(), right.area(), right.signed_area()),
        (6.0, 6.0, -6.0)
    );
}

/// The Python face's `seg1d_iou` used one interval's width for both.
#[test]
fn intervals_of_different_length() {
    let (a, b) = (Interval::new(0.0, 4.0), Interval::new(3.0, 5.0));
    assert_eq!((a.iou(b), b.iou(a)), (0.2, 0.2));
}

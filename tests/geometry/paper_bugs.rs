//! Bugs of the library that came with the paper (DGAL, C++, as of 2021) and of its Python face: one test
//! per bug, under its number, with the right answer and why. The table in `geograd::paper` names them.
//!
//! Three bugs cannot happen here: B15 (an unqualified `abs` that binds to that of integers), B17 (a binding that
//! calls another function), B20 (gradients that the caller must zero first: gradients are results).
use geograd::ad::adjoint::overlap::iou_aabb2_grad;
use geograd::ad::adjoint::overlap_polygon::iou_polygons_vjp;
use geograd::clipping::clip;
use geograd::distance::ring::signed_distance_to_ring;
use geograd::distance::{depth, distance, farthest_distance, signed_distance};
use geograd::hull::merge;
use geograd::iou::{diou_aabb2, diou_polygons_search, giou_polygons_search};
use geograd::measure::extent::{diameter_search, width_search};
use geograd::overlap_polygon::iou_polygons;
use geograd::{
    Aabb2, ConvexPolygon, Flaw, Interval, Jet, Line2, Obb2, Pack, Segment2, Triangle2, Vec2,
    VertexFault,
};

type Quad<S> = ConvexPolygon<S, 4>;

/// A box of the plane as a polygon.
fn quad(x: f64, y: f64, w: f64, h: f64, turn: f64) -> Quad<f64> {
    ConvexPolygon::from(Obb2::new(x, y, w, h, turn))
}

/// Two boxes of four by two, `way` apart along their own heading.
fn headed(way: f64) -> [Quad<f64>; 2] {
    let turn: f64 = 0.3;
    [0.0, way].map(|x| quad(x * turn.cos(), x * turn.sin(), 4.0, 2.0, turn))
}

/// Boxes of four by two, one shifted by one and a half: they share 4.5 of 11.5. In single precision, at a
/// place and a size at which all corners are numbers.
fn shifted(far: f32, size: f32) -> [Quad<f32>; 2] {
    let corners = |x: f32, y: f32| {
        [(0., 0.), (4., 0.), (4., 2.), (0., 2.)]
            .map(|(dx, dy): (f32, f32)| Vec2::new((x + dx) * size + far, (y + dy) * size + far))
    };
    [corners(0.0, 0.0), corners(1.0, 0.5)].map(ConvexPolygon::from)
}

fn at<S>(x: S, y: S) -> Vec2<S> {
    Vec2::new(x, y)
}

/// B1: the derivatives of a point's distance from `a x + b y + c = 0` in a and b.
#[test]
fn b1_derivatives_in_the_coefficients_of_a_line() {
    let x: [Jet<f64, 3>; 3] = std::array::from_fn(|k| Jet::variable([1.3, -0.7, 0.4][k], k));
    let line = Line2::from_coefficients(x[0], x[1], x[2]);
    let side = line.side(at(Jet::variable(2.1, 9), Jet::variable(0.9, 9)));
    let n = 1.3_f64.hypot(0.7);
    assert!((side.value - (1.3 * 2.1 - 0.7 * 0.9 + 0.4) / n).abs() < 1e-14);
    // Measured by finite differences of the value: (0.4126, 1.1532).
    assert!(
        (side.derivative[0] - 0.4126).abs() < 5e-5 && (side.derivative[1] - 1.1532).abs() < 5e-5
    );
    assert!((side.derivative[2] - 1.0 / n).abs() < 1e-15);
    // The unsigned distance has the same derivatives here.
    let point = at(Jet::variable(2.1, 9), Jet::variable(0.9, 9));
    let unsigned = distance(point, line);
    assert!((0..3).all(|k| (unsigned.derivative[k] - side.derivative[k]).abs() < 1e-14));
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
        // The paper's sign, positive inside, by another name.
        assert_eq!(depth(square, point), -want);
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

/// B4: edges of the same direction ended the clipping; 0.25 and 1 there.
#[test]
fn b4_boxes_of_the_same_heading() {
    let iou = |way| {
        let [a, b] = headed(way);
        let shared: ConvexPolygon<f64, 8> = clip(&a, &b).unwrap();
        let whole = a.area() + b.area() - shared.area();
        assert!((shared.area() / whole - iou_polygons(&a, &b)).abs() < 1e-14);
        iou_polygons(&a, &b)
    };
    assert_eq!(iou(10.0), 0.0);
    assert!((iou(2.0) - 1.0 / 3.0).abs() < 1e-14);
}

/// B5: the same cause left a joint hull without vertices, an infinite GIoU and a DIoU that was no number.
#[test]
fn b5_the_hull_of_boxes_of_the_same_heading() {
    let [a, b] = headed(10.0);
    let both: ConvexPolygon<f64, 8> = merge(&a, &b).unwrap();
    assert!((both.area() - 28.0).abs() < 1e-12);
    let (giou, _) = giou_polygons_search::<f64, 4, 4, 8>(&a, &b).unwrap();
    assert!((giou + 12.0 / 28.0).abs() < 1e-14);
    assert_eq!(diou_polygons_search(&a, &a).0, 1.0);
    let (diou, _) = diou_polygons_search(&a, &b);
    assert!((diou + 100.0 / (14.0 * 14.0 + 4.0)).abs() < 1e-14);
}

/// B6: a derivative less its epsilon rounded to π, and the sweep never began; 1, 0 and 0.04 there.
#[test]
fn b6_axis_aligned_polygons() {
    let iou = |a: Quad<f64>, b: Quad<f64>| iou_polygons(&a, &b);
    let flat = quad(0.0, 0.0, 4.0, 2.0, 0.0);
    assert!((iou(flat, quad(2.0, 0.0, 4.0, 2.0, 0.0)) - 1.0 / 3.0).abs() < 1e-14);
    assert!((iou(flat, quad(0.0, 0.0, 2.0, 4.0, 0.0)) - 1.0 / 3.0).abs() < 1e-14);
    let far = quad(500.0, 0.0, 4.0, 2.0, 0.0);
    assert_eq!(iou(quad(0.0, 0.0, 100.0, 2.0, 0.0), far), 0.0);
}

/// B7: equal points.
#[test]
fn b7_equal_points_have_derivative_zero() {
    let x: [Jet<f64, 4>; 4] = std::array::from_fn(|k| Jet::variable([1.5, 2.0, 1.5, 2.0][k], k));
    let (a, b) = (at(x[0], x[1]), at(x[2], x[3]));
    for d in [
        distance(a, b),
        signed_distance(a, b),
        farthest_distance(a, b),
    ] {
        assert_eq!((d.value, d.derivative), (0.0, [0.0; 4]));
    }
    // The same of the distance IoU of equal boxes.
    let x: [Jet<f64, 8>; 8] =
        std::array::from_fn(|k| Jet::variable([1.0, 2.0, 4.0, 3.0][k % 4], k));
    let diou = diou_aabb2(
        Aabb2::new(x[0], x[1], x[2], x[3]),
        Aabb2::new(x[4], x[5], x[6], x[7]),
    );
    assert_eq!((diou.value, diou.derivative), (1.0, [0.0; 8]));
}

/// B8: what is flat is measured, not walked around for ever.
#[test]
fn b8_flat_shapes() {
    let height_zero = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 4.0, 0.0));
    assert_eq!(diameter_search(height_zero.as_slice()).unwrap().0, 4.0);
    assert!(width_search(height_zero.as_slice()).is_none());
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

/// B9: the centroid is that of the area; the mean of the vertices has a name of its own.
#[test]
fn b9_centroids() {
    let house = [(0., 0.), (2., 0.), (2., 2.), (1., 3.), (0., 2.)].map(|(x, y)| at(x, y));
    let house: ConvexPolygon<f64, 5> = ConvexPolygon::from(house);
    // A square of area 4 about (1, 1) and a triangle of area 1 about (1, 7/3).
    let want = at(1.0, (4.0 + 7.0 / 3.0) / 5.0);
    assert!(house.centroid().distance(want) < 1e-15);
    assert!(house.vertex_mean().distance(at(1.0, 1.4)) < 1e-15);
}

/// B10: coordinates far from the origin cost digits; 0.32 at 3000, −0.857 at 100 000 there.
#[test]
fn b10_far_from_the_origin_in_single_precision() {
    for far in [0.0, 1e3, 3e3, 1e4, 1e5] {
        let [a, b] = shifted(far, 1.0);
        assert_eq!((a.area(), b.area()), (8.0, 8.0));
        assert!((iou_polygons(&a, &b) - 4.5 / 11.5).abs() < 1e-6, "{far}");
    }
}

/// B11: a tolerance with a unit: crashes and areas a million times too large below a ten-thousandth there.
#[test]
fn b11_small_polygons_overlap_like_large_ones() {
    for size in [1e-4, 1e-7, 1e-15, 1e-30] {
        let [a, b] = shifted(0.0, size);
        assert!((iou_polygons(&a, &b) - 4.5 / 11.5).abs() < 1e-6, "{size}");
    }
    let tiny = [(0., 0.), (1., 0.), (0., 1.)].map(|(x, y): (f64, f64)| at(x * 1e-150, y * 1e-150));
    let tiny: ConvexPolygon<f64, 3> = ConvexPolygon::from(tiny);
    assert_eq!(iou_polygons(&tiny, &tiny), 1.0);
}

/// B12: nearly equal long boxes; 1.232 there. (detectron2's issue 2167.)
#[test]
fn b12_nearly_equal_long_boxes() {
    let long = |turn: f64| quad(0.0, 0.0, 60.0, 0.5, turn).remake(&mut |x| *x as f32);
    for turn in [0.0, 1e-7, 1e-6, 1e-5, 1e-4] {
        let found = iou_polygons(&long(0.7), &long(0.7 + turn));
        assert!(found <= 1.0 && found > 0.98, "{turn} {found}");
    }
}

/// B16: a product of two lengths was compared with an epsilon that is a length. No tolerance has a unit.
#[test]
fn b16_small_shapes_are_shapes() {
    for size in [1e-4_f64, 1e-7, 1e-30, 1e-150] {
        let square = Aabb2::new(0.0, 0.0, size, size);
        assert!((signed_distance(square, at(size / 4.0, size / 2.0)) / size + 0.25).abs() < 1e-15);
        let other = Segment2::new(at(2.0 * size, 0.0), at(3.0 * size, size));
        assert!((distance(square, other) / size - 1.0).abs() < 1e-15);
    }
}

/// B13: of the two corners of the farthest distance one was forgotten in a seventh of random pairs.
#[test]
fn b13_farthest_corners() {
    let x: [Jet<f64, 8>; 8] =
        std::array::from_fn(|k| Jet::variable([0.0, 0.0, 10.0, 10.0, 4.0, 4.0, 7.0, 7.0][k], k));
    let boxes = (
        Aabb2::new(x[0], x[1], x[2], x[3]),
        Aabb2::new(x[4], x[5], x[6], x[7]),
    );
    let far = farthest_distance(boxes.0, boxes.1);
    assert_eq!(far.value, 98.0_f64.sqrt());
    // Its derivatives are at exactly the two corners that are farthest apart.
    let u = 0.5_f64.sqrt();
    let want = [-u, -u, 0.0, 0.0, 0.0, 0.0, u, u];
    assert!(
        (0..8).all(|k| (far.derivative[k] - want[k]).abs() < 1e-15),
        "{far:?}"
    );
}

/// B14: in nested boxes no two corners are as far apart as the larger one's diagonal is long; 14.14 there.
#[test]
fn b14_farthest_distance_of_nested_boxes() {
    let nested = farthest_distance(
        Aabb2::new(0.0, 0.0, 10.0, 10.0),
        Aabb2::new(4.0, 4.0, 6.0, 6.0),
    );
    assert_eq!(nested, 72.0_f64.sqrt());
}

/// B18: equal boxes are as alike as can be: nothing pulls on them. One and minus one there.
#[test]
fn b18_equal_boxes_have_derivative_zero() {
    let square = Aabb2::new(1.0, 2.0, 5.0, 4.0);
    let (iou, (by_a, by_b)) = iou_aabb2_grad(square, square);
    assert_eq!(iou, 1.0);
    assert!(
        by_a.scalars()
            .iter()
            .chain(&by_b.scalars())
            .all(|derivative| *derivative == 0.0)
    );
    let a = quad(0.0, 0.0, 4.0, 2.0, 0.0);
    let (by_a, by_b) = iou_polygons_vjp(&a, &a, 1.0);
    assert!(
        by_a.vertices
            .iter()
            .chain(&by_b.vertices)
            .all(|v| v.length() < 1e-14)
    );
}

/// B19: orientation and convexity are checked, not assumed; clockwise input had negative areas there.
#[test]
fn b19_orientation_and_convexity() {
    let clockwise = [at(0.0, 0.0), at(0.0, 2.0), at(4.0, 2.0), at(4.0, 0.0)];
    let refused = ConvexPolygon::<f64, 4>::try_new(&clockwise);
    assert!(
        matches!(
            refused,
            Err(Flaw::Vertex {
                fault: VertexFault::Clockwise,
                ..
            })
        ),
        "{refused:?}"
    );
    let (mended, _) = ConvexPolygon::<f64, 4>::cleaned(&clockwise).unwrap();
    assert_eq!(
        (
            mended.area(),
            iou_polygons(&mended, &quad(2.0, 1.0, 4.0, 2.0, 0.0))
        ),
        (8.0, 1.0)
    );
    let notched = [at(0.0, 0.0), at(4.0, 0.0), at(1.0, 1.0), at(0.0, 4.0)];
    assert!(ConvexPolygon::<f64, 4>::try_new(&notched).is_err());
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

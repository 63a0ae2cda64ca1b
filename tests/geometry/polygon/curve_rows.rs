//! Rows of curves: batches beside the verbs of one curve, identities, and limits of other shapes.
use super::cases::at;
use super::curves::near;
use geograd::curve::{Arc2, Cubic2, CurvePiece, Quadratic2};
use geograd::distance::PointPair;
use geograd::kernels::{ClosestPoints, Cpu, Distance, SignedArea};
use geograd::{Circle, Segment2, Vec2};
use geograd_tests::Dice;

const COUNT: usize = 400;

/// Returns places on a grid of halves, which repeat often, and others.
fn place(dice: &mut Dice, k: usize) -> Vec2<f64> {
    match k % 3 {
        0 => at(dice.within(-4.0, 4.0), dice.within(-4.0, 4.0)),
        _ => at(
            dice.within(-2.0, 2.0).round() * 0.5,
            dice.within(-2.0, 2.0).round() * 0.5,
        ),
    }
}

/// Compares rows with the verbs of pieces: values, their derivatives by points and curves, and what closest points say.
macro_rules! compare {
    ($curves:expr, $points:expr, $zero:expr) => {{
        let (curves, points) = ($curves, $points);
        let cpu = Cpu::new();
        let distances: Vec<f64> = cpu.aligned(Distance, (&points, &curves)).unwrap();
        let (again, (by_point, by_curve)) = cpu
            .aligned(Distance.value_grad(), (&points, &curves))
            .unwrap();
        let pairs: Vec<PointPair<f64>> = cpu.aligned(ClosestPoints, (&points, &curves)).unwrap();
        let matrix = cpu
            .all_pairs(Distance, &points[..20], &curves[..20])
            .unwrap();
        assert_eq!(distances, again);
        for (k, (&point, &curve)) in points.iter().zip(&curves).enumerate() {
            let piece = CurvePiece::from(curve);
            let size = 1e-13 * (1.0 + piece.length());
            near(distances[k], piece.distance(point), size);
            assert_eq!(pairs[k].on_a, point);
            near(pairs[k].on_b.distance(point), distances[k], size);
            let off = piece.distance(pairs[k].on_b);
            assert!(off <= size, "{off:e}, {size:e}: {curve:?}, {point:?}");
            // A step of the point along its derivative moves it away as fast.
            let away = (point - pairs[k].on_b).normalize_or_zero();
            if distances[k] > 1e-9 {
                assert!((by_point[k] - away).length() < 1e-9, "{curve:?}, {point:?}");
            }
            // A shift of both moves nothing.
            let shift: Vec2<f64> = $zero(by_curve[k]);
            assert!(
                (shift + by_point[k]).length() < 1e-9,
                "{curve:?}, {point:?}"
            );
            if k < 20 {
                assert_eq!(matrix.at(k, k), distances[k]);
            }
        }
    }};
}

#[test]
fn rows_of_curves_are_their_verbs() {
    let mut dice = Dice(41);
    let mut all = |_| (0..COUNT).map(|k| place(&mut dice, k)).collect::<Vec<_>>();
    let [a, b, c, d, points] = [0, 1, 2, 3, 4].map(&mut all);
    let bulges: Vec<f64> = a
        .iter()
        .map(|p| if p.x == 0.5 { 0.0 } else { p.x })
        .collect();
    let quadratic = |k: usize| Quadratic2::new(a[k], b[k], c[k]);
    let cubic = |k: usize| Cubic2::new(a[k], b[k], c[k], d[k]);
    let arc = |k: usize| Arc2::new(b[k], c[k], bulges[k]);
    let sum = |all: &[Vec2<f64>]| all.iter().fold(at(0.0, 0.0), |sum, &x| sum + x);
    compare!(
        (0..COUNT).map(quadratic).collect::<Vec<_>>(),
        points.clone(),
        |by: Quadratic2<f64>| sum(&by.points)
    );
    compare!(
        (0..COUNT).map(cubic).collect::<Vec<_>>(),
        points.clone(),
        |by: Cubic2<f64>| sum(&by.points)
    );
    compare!(
        (0..COUNT).map(arc).collect::<Vec<_>>(),
        points.clone(),
        |by: Arc2<f64>| by.from + by.to
    );
}

#[test]
fn straight_curves_are_segments_and_arcs_parts_of_circles() {
    let mut dice = Dice(42);
    let cpu = Cpu::new();
    for k in 0..COUNT {
        let [from, to, point] = [k, k + 1, k + 2].map(|k| place(&mut dice, k));
        let segment = [Segment2::new(from, to)];
        let expected = cpu.aligned(Distance, (&[point], &segment)).unwrap()[0];
        let middle = from.lerp(to, 0.5);
        let third = |t: f64| from.lerp(to, t / 3.0);
        let quadratic = [Quadratic2::new(from, middle, to)];
        let cubic = [Cubic2::new(from, third(1.0), third(2.0), to)];
        let arc = [Arc2::new(from, to, 0.0)];
        near(
            cpu.aligned(Distance, (&[point], &quadratic)).unwrap()[0],
            expected,
            1e-13,
        );
        near(
            cpu.aligned(Distance, (&[point], &cubic)).unwrap()[0],
            expected,
            1e-13,
        );
        near(
            cpu.aligned(Distance, (&[point], &arc)).unwrap()[0],
            expected,
            1e-13,
        );
        // Two halves make a circle, which is as far from the point as its border.
        let halves = [Arc2::new(from, to, 1.0), Arc2::new(to, from, 1.0)];
        let both = cpu.aligned(Distance, (&[point, point], &halves)).unwrap();
        let circle = Circle::new(middle, from.distance(to) / 2.0);
        let border = (point.distance(middle) - circle.radius).abs();
        near(both[0].min(both[1]), border, 1e-13);
        let areas: Vec<f64> = cpu.aligned(SignedArea, &halves).unwrap();
        near(areas[0] + areas[1], circle.area(), 1e-13);
        let flat: Vec<f64> = cpu.aligned(SignedArea, &cubic).unwrap();
        near(flat[0], 0.0, 1e-13);
        let raised = [
            quadratic[0].elevated(),
            Quadratic2::new(from, point, to).elevated(),
        ];
        let area: Vec<f64> = cpu.aligned(SignedArea, &raised).unwrap();
        let own: Vec<f64> = cpu
            .aligned(SignedArea, &[Quadratic2::new(from, point, to)])
            .unwrap();
        near(area[1], own[0], 1e-13);
    }
}

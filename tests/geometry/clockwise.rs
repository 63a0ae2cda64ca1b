//! Corners in either order: distances, depths and shared areas of arrays and of convex polygons.
use geograd::distance::{Convex, edge_distance};
use geograd::error::Argument;
use geograd::error::{Flaw, VertexFault};
use geograd::kernels::{Cpu, IntersectionArea};
use geograd::overlap_polygon::{intersection_area_polygons, intersection_area_quads};
use geograd::prelude::*;
use geograd::{ConvexPolygon, Error, Real};

type Quad<T> = [Vec2<T>; 4];

fn corners<T: Real>(x: [[i32; 2]; 4]) -> Quad<T> {
    x.map(|[x, y]| Vec2::new(T::lit(f64::from(x)), T::lit(f64::from(y))))
}

/// Twice the turn at a corner.
fn turn(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> i32 {
    (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
}

/// All lists of four places of a grid, by the signs of their turns.
fn grid(is_wanted: impl Fn(&[i32; 4]) -> bool) -> Vec<[[i32; 2]; 4]> {
    let place = |k: usize| [k as i32 % 3, k as i32 / 3];
    let all = (0..6561).map(|k| [k % 9, k / 9 % 9, k / 81 % 9, k / 729].map(place));
    all.filter(|q| {
        is_wanted(&std::array::from_fn(|k| {
            turn(q[(k + 3) % 4], q[k], q[(k + 1) % 4])
        }))
    })
    .collect()
}
fn convex() -> Vec<[[i32; 2]; 4]> {
    grid(|turns| turns.iter().all(|&turn| turn >= 0) && turns.iter().sum::<i32>() > 0)
}
fn reversed<X: Copy>([a, b, c, d]: [X; 4]) -> [X; 4] {
    [a, d, c, b]
}

/// The signed distance of a point, from edges and integers.
fn expected(q: [[i32; 2]; 4], p: [i32; 2]) -> f64 {
    let at = |[x, y]: [i32; 2]| Vec2::new(f64::from(x), f64::from(y));
    let edges = (0..4).map(|k| [q[k], q[(k + 1) % 4]]);
    let away = edges
        .clone()
        .map(|[a, b]| edge_distance(at(p), at(a), at(b)));
    let least = away.fold(f64::MAX, f64::min);
    let inside = edges.into_iter().all(|[a, b]| turn(a, b, p) >= 0);
    if inside { -least } else { least }
}

fn points_in<T: Real + Into<f64>>() {
    let near = |a: T, b: f64| (a.into() - b).abs() <= 8.0 * T::format().epsilon();
    for (i, q) in convex().into_iter().enumerate() {
        for k in 0..49 {
            let p = [k % 7 - 2, k / 7 - 2];
            let start = (i + k as usize) % 4;
            let right = expected(q, p);
            let point = Vec2::new(T::lit(f64::from(p[0])), T::lit(f64::from(p[1])));
            let from: [[i32; 2]; 4] = std::array::from_fn(|k| q[(k + start) % 4]);
            for q in [from, reversed(from)] {
                let shape = corners::<T>(q);
                assert!(
                    near(shape.signed_distance(point), right),
                    "{q:?} {p:?} {right}"
                );
                assert!(
                    near(point.signed_distance(shape), right),
                    "{q:?} {p:?} {right}"
                );
                assert!(near(shape.distance(point), right.max(0.0)), "{q:?} {p:?}");
                assert!(
                    near(shape.penetration(point).depth, (-right).max(0.0)),
                    "{q:?} {p:?}"
                );
            }
        }
    }
}
#[test]
fn points_are_as_far_from_corners_in_either_order() {
    if !geograd_tests::is_due("points_are_as_far_from_corners_in_either_order") {
        return;
    }
    points_in::<f64>();
    points_in::<f32>();
}

#[test]
fn all_functions_of_distance_take_either_order() {
    let others = [
        Obb2::new(1.5, 1.0, 2.0, 1.0, 0.2),
        Obb2::new(4.0, 1.0, 1.0, 2.0, 0.7),
    ];
    for q in convex().into_iter().step_by(7) {
        let (forth, back) = (corners::<f64>(q), corners::<f64>(reversed(q)));
        for other in others {
            let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{q:?} {other:?} {a} {b}");
            same(forth.signed_distance(other), back.signed_distance(other));
            same(other.signed_distance(forth), other.signed_distance(back));
            same(forth.distance(other), back.distance(other));
            same(forth.squared_distance(other), back.squared_distance(other));
            same(
                forth.penetration(other).depth,
                back.penetration(other).depth,
            );
            same(
                forth.farthest_distance(other),
                back.farthest_distance(other),
            );
            let apart = |q: Quad<f64>| {
                let points = q.closest_points(other);
                points.on_a.distance(points.on_b)
            };
            same(apart(forth), apart(back));
            // The same shape by its type.
            let (polygon, _) = ConvexPolygon::<f64, 6>::cleaned(&back).unwrap();
            same(polygon.signed_distance(other), forth.signed_distance(other));
            same(
                other.penetration(polygon).depth,
                forth.penetration(other).depth,
            );
            same(
                polygon.farthest_distance(other),
                forth.farthest_distance(other),
            );
        }
    }
}

fn areas_in<T: Real + Into<f64>>() {
    let all = convex();
    for (i, &q) in all.iter().enumerate().step_by(5) {
        let r = all[(i * 37 + 11) % all.len()].map(|[x, y]| [x + 1, y]);
        let polygon = |q| ConvexPolygon::<T, 4>::cleaned(&corners(q)).unwrap().0;
        let right: f64 = intersection_area_polygons(&polygon(q), &polygon(r)).into();
        for (a, b) in [
            (q, r),
            (q, reversed(r)),
            (reversed(q), r),
            (reversed(q), reversed(r)),
        ] {
            let found: f64 = intersection_area_quads(corners::<T>(a), corners(b)).into();
            assert!(
                (found - right).abs() <= 16.0 * T::format().epsilon(),
                "{a:?} {b:?} {found} {right}"
            );
        }
    }
}
#[test]
fn quadrilaterals_share_the_same_area_in_either_order() {
    areas_in::<f64>();
    areas_in::<f32>();
}

/// The order changes nothing in batches, and derivatives stay with their corners.
#[test]
fn batches_take_either_order() {
    let all = convex();
    let a: Vec<Quad<f64>> = all.iter().map(|&q| corners(q)).collect();
    let b: Vec<Quad<f64>> = (0..a.len())
        .map(|i| a[(i * 37 + 11) % a.len()].map(|v| v * 1.3))
        .collect();
    let back =
        |list: &[Quad<f64>]| -> Vec<Quad<f64>> { list.iter().map(|&q| reversed(q)).collect() };
    let cpu = Cpu::new();
    let (areas, (by_a, by_b)) = cpu
        .aligned(IntersectionArea.value_grad(), (&a, &b))
        .unwrap();
    let (others, (by_c, by_d)) = cpu
        .aligned(IntersectionArea.value_grad(), (&back(&a), &back(&b)))
        .unwrap();
    assert_eq!(areas, others);
    assert_eq!((by_a, by_b), (back(&by_c), back(&by_d)));
    let shared = areas.iter().filter(|&&area| area > 0.0);
    assert!(shared.count() > a.len() / 2);
}

/// A corner that turns the other way is named, whatever the order and the format.
#[test]
fn concave_and_crossing_quadrilaterals_are_errors_of_batches() {
    let mixed =
        grid(|turns| turns.iter().any(|&turn| turn > 0) && turns.iter().any(|&turn| turn < 0));
    assert!(mixed.len() > 500);
    let square = corners([[0, 0], [2, 0], [2, 2], [0, 2]]);
    let cpu = Cpu::new();
    for q in mixed.into_iter().step_by(3) {
        for unit in [1.0, 1e-200, 1e200] {
            let list = [square, corners(q).map(|v| v * unit)];
            let error = cpu
                .aligned(IntersectionArea, (&list, &[square; 2]))
                .unwrap_err();
            let Error::Invalid {
                argument: Argument::A,
                item: 1,
                flaw: Flaw::Vertex { index, fault },
            } = error
            else {
                panic!("{q:?}: {error}");
            };
            assert_eq!(fault, VertexFault::NotConvex);
            let of = |k: usize| turn(q[(k + 3) % 4], q[k], q[(k + 1) % 4]);
            let unlike = (0..4)
                .filter(|&k| of(k).signum() == of(index).signum())
                .count();
            assert!(of(index) != 0 && unlike <= 2, "{q:?} {index}");
            assert!(cpu.all_pairs(IntersectionArea, &[square], &list).is_err());
        }
    }
    let dart = corners::<f64>([[0, 0], [4, 0], [1, 1], [0, 4]]);
    let error = cpu
        .aligned(IntersectionArea.value_grad(), (&[square], &[dart]))
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "`b` item 0: vertex 2 turns the other way than others: the polygon is not convex, or crosses itself"
    );
}

/// Corners of thin boxes, rounded, are no errors.
#[test]
fn rounded_corners_of_boxes_stay_convex() {
    let boxes = (0..20_000_u32).map(|k| {
        let x = f64::from(k);
        Obb2::new(
            x.sin() * 1000.0,
            100.0,
            50.0,
            10_f64.powi(-((k % 9) as i32)),
            x,
        )
    });
    let narrow = |v: Vec2<f64>| Vec2::new(v.x as f32, v.y as f32);
    let quads: Vec<Quad<f32>> = boxes.map(|shape| shape.corners().map(narrow)).collect();
    Cpu::new()
        .aligned(IntersectionArea, (&quads, &quads))
        .unwrap();
}

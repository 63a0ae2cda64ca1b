//! Distances of polygons by boxes of edges, against all pairs of edges.
use super::cases::{at, stars};
use super::rings::made;
use geograd::distance::distance as between;
use geograd::polygon::{self, DistanceRoom, EdgeBoxes, Fill, NearestEdges};
use geograd::{Polygon, Segment2, Vec2};
use geograd_tests::Dice;

fn edges(polygon: &Polygon<f64>) -> Vec<[Vec2<f64>; 2]> {
    let rings = polygon.rings().iter();
    rings
        .flat_map(|ring| (0..ring.len()).map(move |k| [ring[k], ring[(k + 1) % ring.len()]]))
        .collect()
}

/// The nearest of all pairs, the first of those that tie.
fn of_all(a: &[[Vec2<f64>; 2]], b: &[[Vec2<f64>; 2]]) -> Option<NearestEdges<f64>> {
    let mut best: Option<NearestEdges<f64>> = None;
    for (i, [from, to]) in a.iter().enumerate() {
        for (j, [start, end]) in b.iter().enumerate() {
            let distance = between(Segment2::new(*from, *to), Segment2::new(*start, *end));
            if best.is_none_or(|best| distance < best.distance) {
                best = Some(NearestEdges {
                    distance,
                    edges: [i, j],
                });
            }
        }
    }
    best
}

fn checked(a: &Polygon<f64>, b: &Polygon<f64>) {
    let expected = of_all(&edges(a), &edges(b));
    let found = EdgeBoxes::of(a.into()).nearest(&EdgeBoxes::of(b.into()));
    match (found, expected) {
        // Of edges that meet any may be named.
        (Some(found), Some(expected)) if expected.distance == 0.0 => {
            assert_eq!(found.distance, 0.0);
        }
        (found, expected) => assert_eq!(found, expected),
    }
    let holds = |own: &Polygon<f64>, other: &Polygon<f64>| {
        let mut rings = other.rings().iter();
        rings.any(|ring| polygon::Rings::from(own).contains(ring[0], Fill::EvenOdd))
    };
    let meet = expected.is_some_and(|x| x.distance == 0.0) || holds(a, b) || holds(b, a);
    let known = if meet {
        0.0
    } else {
        expected.map_or(f64::MAX, |x| x.distance)
    };
    assert_eq!(polygon::distance(a, b), known);
    // Roundings go with the order of both.
    let turned = polygon::distance(b, a);
    assert!(
        (turned - known).abs() <= 8.0 * f64::EPSILON * known,
        "{turned} {known}"
    );
}

/// A polygon, moved and grown.
fn moved(polygon: &Polygon<f64>, by: Vec2<f64>, factor: f64) -> Polygon<f64> {
    let rings: Vec<Vec<Vec2<f64>>> = polygon
        .rings()
        .iter()
        .map(|ring| ring.iter().map(|&v| v * factor + by).collect())
        .collect();
    made(&rings)
}

#[test]
fn distances_are_those_of_all_pairs_of_edges() {
    if !geograd_tests::is_due("distances_are_those_of_all_pairs_of_edges") {
        return;
    }
    let mut dice = Dice(5);
    let mut room = DistanceRoom::default();
    for round in 0..300 {
        let a = made(&stars(&mut dice));
        let far = if round % 3 == 0 { 30.0 } else { 9.0 };
        let by = at(dice.within(-far, far), dice.within(-far, far));
        let b = moved(&made(&stars(&mut dice)), by, dice.within(0.2, 2.0));
        checked(&a, &b);
        assert_eq!(room.distance(&a, &b), polygon::distance(&a, &b));
        // The same shapes far from the origin, tiny and huge.
        for factor in [1e-150, 1e-6, 1e100] {
            let (a, b) = (
                moved(&a, at(0.0, 0.0), factor),
                moved(&b, at(0.0, 0.0), factor),
            );
            checked(&a, &b);
        }
        checked(
            &moved(&a, at(1e8, -1e8), 1.0),
            &moved(&b, at(1e8, -1e8), 1.0),
        );
    }
}

#[test]
fn ties_on_a_grid_of_whole_numbers_take_the_first_edges() {
    if !geograd_tests::is_due("ties_on_a_grid_of_whole_numbers_take_the_first_edges") {
        return;
    }
    let mut dice = Dice(6);
    for _ in 0..2000 {
        let mut ring = |shift: f64| -> Polygon<f64> {
            let count = 3 + (dice.within(0.0, 6.0) as usize);
            let mut place = || {
                at(
                    dice.within(0.0, 4.0).floor() + shift,
                    dice.within(0.0, 4.0).floor(),
                )
            };
            made(&[(0..count).map(|_| place()).collect()])
        };
        let (a, b) = (ring(0.0), ring(5.0));
        checked(&a, &b);
        checked(&a, &ring(2.0));
        checked(&a, &a);
    }
}

#[test]
fn lists_of_any_length_have_the_distance_of_all_pairs() {
    if !geograd_tests::is_due("lists_of_any_length_have_the_distance_of_all_pairs") {
        return;
    }
    let mut dice = Dice(9);
    // Up to 128 edges are compared without boxes, if few of them can be nearest.
    for count in [3, 4, 5, 15, 16, 17, 40, 127, 128, 129, 200] {
        for gap in [0.3, 1.9, 2.0, 2.1, 2.5, 40.0] {
            let mut star = |x: f64| -> Polygon<f64> {
                let turn = std::f64::consts::TAU / count as f64;
                let vertex = |k: usize| {
                    let (far, angle) = (dice.within(0.5, 1.0), turn * k as f64);
                    at(x + far * angle.cos(), far * angle.sin())
                };
                made(&[(0..count).map(vertex).collect()])
            };
            let (a, b) = (star(0.0), star(gap));
            checked(&a, &b);
            checked(&b, &moved(&a, at(0.0, 3.0), 1.0));
            // Edges of no length, and edges on one line.
            let flat = moved(&a, at(gap, 0.0), 0.0);
            checked(&flat, &a);
            checked(&flat, &flat);
            let line = (0..count).map(|k| at(gap + 2.0, f64::from(k as u32)));
            checked(&made(&[line.collect()]), &a);
        }
    }
}

#[test]
fn edges_that_are_not_joined_have_the_distance_of_all_pairs() {
    let mut dice = Dice(13);
    for round in 0..4000 {
        let mut list = |x: f64| -> Vec<[Vec2<f64>; 2]> {
            let count = 1 + dice.below(12);
            let mut place = |long: f64| at(x + dice.within(-long, long), dice.within(-1.0, 1.0));
            // Starts of one list are on one side of those of the other, ends need not be.
            let edges = (0..count).map(|_| [place(0.5), place(1.5)]);
            edges.collect()
        };
        let (a, b) = (list(0.0), list([1.2, 2.0, 4.0][round % 3]));
        let found = EdgeBoxes::of_edges(a.iter().copied()).nearest(&EdgeBoxes::of_edges(b.clone()));
        let expected = of_all(&a, &b);
        match (found, expected) {
            (Some(found), Some(expected)) if expected.distance == 0.0 => {
                assert_eq!(found.distance, 0.0);
            }
            (found, expected) => assert_eq!(found, expected),
        }
    }
}

#[test]
fn single_precision_has_the_distance_of_all_pairs() {
    let mut dice = Dice(10);
    for _ in 0..500 {
        let mut ring = |x: f32| -> Vec<Vec2<f32>> {
            let mut place = || dice.within(-1.0, 1.0) as f32;
            (0..7).map(|_| Vec2::new(x + place(), place())).collect()
        };
        let (a, b) = (ring(1000.0), ring(1002.1));
        let of = |ring: &[Vec2<f32>]| geograd::shape::edges(ring).collect::<Vec<_>>();
        let found = EdgeBoxes::of_edges(of(&a)).nearest(&EdgeBoxes::of_edges(of(&b)));
        let mut best = f32::INFINITY;
        for [from, to] in of(&a) {
            for [start, end] in of(&b) {
                best = best.min(between(Segment2::new(from, to), Segment2::new(start, end)));
            }
        }
        assert_eq!(found.map(|found| found.distance), Some(best));
    }
}

#[test]
fn holes_and_nothing() {
    let square =
        |low: f64, high: f64| vec![at(low, low), at(high, low), at(high, high), at(low, high)];
    let frame = made(&[square(0.0, 9.0), square(2.0, 7.0)]);
    assert_eq!(polygon::distance(&frame, &made(&[square(3.0, 4.0)])), 1.0);
    assert_eq!(polygon::distance(&frame, &made(&[square(0.5, 1.0)])), 0.0);
    assert_eq!(polygon::distance(&frame, &made(&[square(-2.0, 11.0)])), 0.0);
    assert_eq!(polygon::distance(&frame, &made(&[square(9.0, 11.0)])), 0.0);
    assert_eq!(polygon::distance(&frame, &Polygon::new()), f64::MAX);
    assert_eq!(
        EdgeBoxes::<f64>::default().nearest(&EdgeBoxes::of((&frame).into())),
        None
    );
}

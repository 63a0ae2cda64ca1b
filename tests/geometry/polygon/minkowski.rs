//! Minkowski sums: closed forms, unions of sums of triangles, derivatives, hard inputs, errors.
use super::cases::{any_ring, at, hard_rings, ring, star};
use super::rings::{differences, made, zeros};
use super::simple::flaw;
use geograd::ad::adjoint::minkowski::{minkowski_vjp, valid_minkowski_vjp};
use geograd::ad::adjoint::ring::signed_area_vjp;
use geograd::ad::forward::First;
use geograd::boolean::union;
use geograd::error::{Argument, Field, Flaw, VertexFault};
use geograd::minkowski::{
    minkowski_replay, minkowski_search, minkowski_sum, no_fit_polygon, no_fit_search,
    valid_minkowski_replay, valid_minkowski_search,
};
use geograd::overlap_polygon::holed::intersection_area;
use geograd::polygon::{self, Fill};
use geograd::{Error, Pack, Polygon, Vec2};
use geograd_tests::Dice;

const FILL: Fill = Fill::EvenOdd;

fn near(found: f64, expected: f64, by: f64) {
    assert!(
        (found - expected).abs() <= by * (1.0 + expected.abs()),
        "{found} {expected}"
    );
}
fn total(parts: &[Polygon<f64>]) -> f64 {
    parts.iter().map(polygon::signed_area).sum()
}
fn square(x: f64, y: f64, size: f64) -> Vec<Vec2<f64>> {
    ring(&[(x, y), (x + size, y), (x + size, y + size), (x, y + size)])
}
fn area(a: &Polygon<f64>, b: &Polygon<f64>) -> f64 {
    let trace = minkowski_search(a, b, FILL).unwrap();
    let plain = polygon::signed_area(&minkowski_replay(a, b, &trace));
    let parts = minkowski_sum(a, b, FILL).unwrap();
    assert_eq!(flaw(&parts), Ok(()));
    near(total(&parts), plain, 1e-13);
    plain
}

type Triangles = Vec<[Vec2<f64>; 3]>;

/// A random star, with a hole half of the time, and triangles of it.
fn star_of_triangles(dice: &mut Dice, middle: Vec2<f64>, size: f64) -> (Polygon<f64>, Triangles) {
    let n = 3 + dice.below(6);
    let outer = star(dice, middle, n, 0.6 * size, 1.4 * size);
    let next = |k: usize| (k + 1) % n;
    if dice.below(2) == 0 {
        let fan = (0..n).map(|k| [middle, outer[k], outer[next(k)]]);
        return (made(std::slice::from_ref(&outer)), fan.collect());
    }
    let inner: Vec<_> = outer
        .iter()
        .map(|&v| middle + (v - middle) * dice.within(0.3, 0.9))
        .collect();
    let quad = |k: usize| {
        [
            [inner[k], outer[k], outer[next(k)]],
            [inner[k], outer[next(k)], inner[next(k)]],
        ]
    };
    let all = (0..n).flat_map(quad).collect();
    (made(&[outer.clone(), inner.clone()]), all)
}

/// The hull of points, counter-clockwise (monotone chains).
fn hull(mut points: Vec<Vec2<f64>>) -> Vec<Vec2<f64>> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut all: Vec<Vec2<f64>> = Vec::new();
    for pass in 0..2 {
        let from = all.len();
        for &at in &points {
            while all.len() >= from + 2 {
                let (a, b) = (all[all.len() - 2], all[all.len() - 1]);
                if (b - a).perp_dot(at - b) > 0.0 {
                    break;
                }
                all.pop();
            }
            all.push(at);
        }
        all.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    all
}

/// The union of the sums of all pairs of triangles.
fn by_triangles(a: &Triangles, b: &Triangles) -> f64 {
    let mut sums = Vec::new();
    for p in a {
        for q in b {
            let points = p.iter().flat_map(|&u| q.iter().map(move |&v| u + v));
            sums.push(hull(points.collect()));
        }
    }
    let nothing = Polygon::new();
    polygon::signed_area(&union(&made(&sums), &nothing, Fill::NonZero).unwrap())
}

#[test]
fn squares_frames_and_keys_have_closed_forms() {
    let one = |rings: &[Vec<Vec2<f64>>]| made(rings);
    let small = one(&[square(0.0, 0.0, 1.0)]);
    near(area(&one(&[square(2.0, 3.0, 4.0)]), &small), 25.0, 1e-15);
    // A hole shrinks by the other polygon, until it is gone.
    for size in [1.0, 2.5, 3.5] {
        let frame = one(&[square(0.0, 0.0, 10.0), square(3.0, 3.0, 4.0)]);
        let other = one(&[square(0.0, 0.0, size)]);
        let rest = (4.0 - size) * (4.0 - size);
        near(
            area(&frame, &other),
            (10.0 + size) * (10.0 + size) - rest,
            1e-14,
        );
    }
    // A square that is larger than the hole covers it, though it moves around all of it.
    let frame = one(&[square(0.0, 0.0, 10.0), square(3.0, 3.0, 4.0)]);
    for size in [4.0, 5.0, 9.0, 20.0] {
        let other = one(&[square(0.0, 0.0, size)]);
        near(area(&frame, &other), (10.0 + size) * (10.0 + size), 1e-14);
        near(area(&other, &frame), (10.0 + size) * (10.0 + size), 1e-14);
    }
    // Two frames whose holes match.
    let twice = area(&frame, &frame);
    near(twice, 400.0, 1e-14);
    // An ell and a square: the notch moves.
    let ell = one(&[ring(&[
        (0., 0.),
        (5., 0.),
        (5., 2.),
        (2., 2.),
        (2., 5.),
        (0., 5.),
    ])]);
    near(area(&ell, &small), 36.0 - 9.0, 1e-14);
    // Parts are summed one by one.
    let parts = one(&[square(0.0, 0.0, 1.0), square(5.0, 0.0, 1.0)]);
    near(area(&parts, &small), 8.0, 1e-14);
    near(area(&parts, &parts), 4.0 * 3.0, 1e-14);
    // A sum with itself mirrored: the hexagon of differences of a triangle.
    let triangle = one(&[ring(&[(0., 0.), (4., 0.), (1., 3.)])]);
    let moves = no_fit_polygon(&triangle, &triangle, FILL).unwrap();
    near(total(&moves), 6.0 * 6.0, 1e-14);
    near(area(&triangle, &triangle), 4.0 * 6.0, 1e-14);
    assert!(
        minkowski_sum(&triangle, &Polygon::new(), FILL)
            .unwrap()
            .is_empty()
    );
}

#[test]
fn sums_are_unions_of_sums_of_triangles() {
    if !geograd_tests::is_due("sums_are_unions_of_sums_of_triangles") {
        return;
    }
    let mut dice = Dice(170);
    for k in 0..60 {
        let (a, of_a) = star_of_triangles(&mut dice, at(1.0, -2.0), 1.0);
        let size = [0.3, 0.8, 2.0][k % 3];
        let (b, of_b) = star_of_triangles(&mut dice, at(0.3, 0.2), size);
        let expected = by_triangles(&of_a, &of_b);
        near(area(&a, &b), expected, 1e-12);
        near(area(&b, &a), expected, 1e-12);
    }
    // Whole numbers: parallel edges, corners on edges.
    for _ in 0..60 {
        let mut snapped = |size: f64| loop {
            let (polygon, triangles) = star_of_triangles(&mut dice, at(0.0, 0.0), size);
            let round = |v: Vec2<f64>| at(v.x.round(), v.y.round());
            let rings: Vec<Vec<_>> = polygon
                .rings()
                .iter()
                .map(|ring| ring.iter().map(|&v| round(v)).collect())
                .collect();
            let triangles: Triangles = triangles.iter().map(|t| t.map(round)).collect();
            // Triangles that overlap, or are flipped, are none of the polygon any more.
            let own = made(&rings);
            let signed = |t: &[Vec2<f64>; 3]| (t[1] - t[0]).perp_dot(t[2] - t[0]) / 2.0;
            let sum: f64 = triangles.iter().map(signed).sum();
            let all_left = triangles.iter().all(|t| signed(t) >= 0.0);
            if own.rings().validate().is_err() || !all_left {
                continue;
            }
            // Flat triangles are spikes, which a polygon has not.
            let triangles: Triangles = triangles.into_iter().filter(|t| signed(t) > 0.0).collect();
            let all: Vec<_> = triangles.iter().map(|t| t.to_vec()).collect();
            let united = |rings: &Polygon<f64>, fill: Fill| {
                polygon::signed_area(&union(rings, &Polygon::new(), fill).unwrap())
            };
            let [one, other] = [united(&made(&all), Fill::NonZero), united(&own, FILL)];
            if (sum - one).abs() < 1e-9 && (sum - other).abs() < 1e-9 {
                return (own, triangles);
            }
        };
        let ((a, of_a), (b, of_b)) = (snapped(4.0), snapped(2.0));
        near(area(&a, &b), by_triangles(&of_a, &of_b), 1e-12);
    }
}

#[test]
fn no_fit_polygons_hold_the_moves_that_overlap() {
    let mut dice = Dice(171);
    let mut counts = [0; 2];
    for _ in 0..20 {
        let (a, _) = star_of_triangles(&mut dice, at(0.0, 0.0), 1.5);
        let (b, _) = star_of_triangles(&mut dice, at(0.5, 0.5), 0.5);
        let trace = no_fit_search(&a, &b, FILL).unwrap();
        let moves = minkowski_replay(&a, &b, &trace);
        for _ in 0..60 {
            let by = at(dice.within(-3.0, 3.0), dice.within(-3.0, 3.0));
            if moves.rings().depth(by, FILL).abs() < 1e-3 {
                continue;
            }
            let mut moved = b.clone();
            for v in moved.vertices_mut() {
                *v += by;
            }
            let overlap = intersection_area(&a, &moved) > 1e-12;
            assert_eq!(moves.rings().contains(by, FILL), overlap);
            counts[usize::from(overlap)] += 1;
        }
    }
    assert!(counts[0] > 200 && counts[1] > 200, "{counts:?}");
}

#[test]
fn adjoints_are_duals_and_duals_are_differences() {
    type Dual = First<f64>;
    let mut dice = Dice(172);
    for k in 0..16 {
        let (a, _) = star_of_triangles(&mut dice, at(0.0, 1.0), 1.0);
        let (b, _) = star_of_triangles(&mut dice, at(0.5, 0.5), 0.6);
        let search = |a: &Polygon<f64>, b: &Polygon<f64>| match k % 2 {
            0 => minkowski_search(a, b, FILL).unwrap(),
            _ => no_fit_search(a, b, FILL).unwrap(),
        };
        let trace = search(&a, &b);
        let of = |(a, b): (Polygon<Dual>, Polygon<Dual>)| {
            polygon::signed_area(&minkowski_replay(&a, &b, &trace))
        };
        let (_, by) = geograd::gradient(of, (a.clone(), b.clone()));
        let made = minkowski_replay(&a, &b, &trace);
        let mut out_bars = vec![Vec2::zero(); made.vertices().len()];
        let mut start = 0;
        for ring in made.rings().iter() {
            signed_area_vjp(ring, 1.0, &mut out_bars[start..start + ring.len()]);
            start += ring.len();
        }
        let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
        minkowski_vjp(&a, &b, &trace, &out_bars, &mut a_bar, &mut b_bar);
        let found = [a_bar.scalars(), b_bar.scalars()].concat();
        let at = |a: &Polygon<f64>, b: &Polygon<f64>| {
            polygon::signed_area(&minkowski_replay(a, b, &search(a, b)))
        };
        let expected = differences(at, &a, &b, 1e-6);
        for ((found, dual), expected) in found.iter().zip(by.scalars()).zip(expected) {
            near(*found, dual, 1e-10);
            near(*found, expected, 1e-6);
        }
        // A move of either moves the sum, or none of its area.
        let sum = |bars: &[Vec2<f64>]| bars.iter().fold(Vec2::zero(), |sum, &bar| sum + bar);
        assert!(sum(&a_bar).length() < 1e-12 && sum(&b_bar).length() < 1e-12);
    }
    // Valid results have the same derivatives.
    let (a, _) = star_of_triangles(&mut dice, at(0.0, 1.0), 1.0);
    let (b, _) = star_of_triangles(&mut dice, at(0.5, 0.5), 0.6);
    let trace = valid_minkowski_search(&a, &b, FILL).unwrap();
    let parts = valid_minkowski_replay(&a, &b, &trace);
    let mut out_bars = Vec::new();
    for part in &parts {
        for ring in part.rings().iter() {
            let mut own = vec![Vec2::zero(); ring.len()];
            signed_area_vjp(ring, 1.0, &mut own);
            out_bars.extend(own);
        }
    }
    let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
    valid_minkowski_vjp(&a, &b, &trace, &out_bars, &mut a_bar, &mut b_bar);
    let found = [a_bar.scalars(), b_bar.scalars()].concat();
    let at = |a: &Polygon<f64>, b: &Polygon<f64>| total(&minkowski_sum(a, b, FILL).unwrap());
    for (found, expected) in found.iter().zip(differences(at, &a, &b, 1e-6)) {
        near(*found, expected, 1e-6);
    }
}

#[test]
fn hard_input_has_valid_sums() {
    let mut dice = Dice(173);
    let mut all = hard_rings();
    all.extend((0..30).map(|_| vec![any_ring(&mut dice, 7)]));
    let other = made(&[ring(&[(0., 0.), (1., 0.), (0.5, 0.25), (0., 1.)])]);
    for rings in all {
        let rings = made(&rings);
        if rings.rings().validate().is_err() {
            continue;
        }
        for fill in [Fill::EvenOdd, Fill::NonZero] {
            let parts = minkowski_sum(&rings, &other, fill).unwrap();
            assert_eq!(flaw(&parts), Ok(()), "{rings:?}");
            let trace = minkowski_search(&rings, &other, fill).unwrap();
            let plain = minkowski_replay(&rings, &other, &trace);
            near(polygon::signed_area(&plain), total(&parts), 1e-12);
            // It holds the first polygon, moved to a point of the other one.
            let trace = minkowski_search(&other, &rings, fill).unwrap();
            let turned = polygon::signed_area(&minkowski_replay(&other, &rings, &trace));
            near(turned, total(&parts), 1e-12);
        }
    }
}

#[test]
fn errors_name_the_input() {
    let plain = made(&[square(0.0, 0.0, 4.0)]);
    let nan = made(&[
        square(0.0, 0.0, 4.0),
        ring(&[(1., 1.), (2., f64::NAN), (2., 2.)]),
    ]);
    let invalid = |argument, flaw| Error::Invalid {
        argument,
        item: 0,
        flaw,
    };
    let flaw = Flaw::Ring {
        ring: 1,
        index: 1,
        fault: VertexFault::NotFinite,
    };
    let found = minkowski_sum(&nan, &plain, FILL).unwrap_err();
    assert_eq!(found, invalid(Argument::A, flaw));
    let found = minkowski_sum(&plain, &nan, FILL).unwrap_err();
    assert_eq!(found, invalid(Argument::B, flaw));
    let far = made(&[square(1.6e308, 0.0, 1e307)]);
    let rule = "moves a vertex beyond the largest number";
    let found = minkowski_sum(&far, &far, FILL).unwrap_err();
    assert_eq!(
        found,
        invalid(Argument::B, Flaw::Broken(Field::VALUE, rule))
    );
}

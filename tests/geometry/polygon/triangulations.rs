//! Delaunay triangulations: empty circles and Euler's formula in whole numbers, hard inputs, derivatives.
use super::cases::at;
use geograd::delaunay::Delaunay;
use geograd::error::{Argument, Error};
use geograd::{Scalar, Vec2, gradient, jacobian};
use geograd_tests::Dice;
use std::collections::{BTreeMap, BTreeSet};

type Spot = [i128; 2];

fn placed(all: &[Spot]) -> Vec<Vec2<f64>> {
    all.iter().map(|&[x, y]| at(x as f64, y as f64)).collect()
}
fn turn(a: Spot, b: Spot, c: Spot) -> i128 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
/// Above zero for a point inside of the circle through three others that turn left.
fn inside([a, b, c]: [Spot; 3], d: Spot) -> i128 {
    let row = |p: Spot| {
        let (x, y) = (p[0] - d[0], p[1] - d[1]);
        [x, y, x * x + y * y]
    };
    let [a, b, c] = [a, b, c].map(row);
    let minor = |p: [i128; 3], q: [i128; 3]| p[0] * q[1] - p[1] * q[0];
    a[2] * minor(b, c) + b[2] * minor(c, a) + c[2] * minor(a, b)
}
/// Twice the area of the hull, and all points on its border, by Andrew's chain.
fn hull(all: &[Spot]) -> (i128, usize) {
    let sorted: Vec<Spot> = all
        .iter()
        .copied()
        .collect::<BTreeSet<_>>()
        .into_iter()
        .collect();
    let chain = |points: &mut dyn Iterator<Item = Spot>| {
        let mut way: Vec<Spot> = Vec::new();
        for p in points {
            while way.len() > 1 && turn(way[way.len() - 2], way[way.len() - 1], p) < 0 {
                way.pop();
            }
            way.push(p);
        }
        way.pop();
        way
    };
    let mut ring = chain(&mut sorted.iter().copied());
    ring.extend(chain(&mut sorted.iter().rev().copied()));
    let twice = (0..ring.len()).map(|k| {
        let (p, q) = (ring[k], ring[(k + 1) % ring.len()]);
        p[0] * q[1] - p[1] * q[0]
    });
    (twice.sum(), ring.len())
}
fn judge(all: &[Spot], found: &Delaunay) {
    let spot = |k: u32| all[k as usize];
    let distinct: BTreeMap<Spot, u32> = all
        .iter()
        .rev()
        .zip((0..all.len() as u32).rev())
        .map(|(&p, k)| (p, k))
        .collect();
    for (k, p) in all.iter().enumerate() {
        assert_eq!(found.firsts()[k], distinct[p]);
    }
    let mut sides = BTreeMap::new();
    let mut twice = 0;
    for (number, &[a, b, c]) in found.triangles().iter().enumerate() {
        let own = turn(spot(a), spot(b), spot(c));
        assert!(own > 0);
        twice += own;
        for side in [[b, c], [c, a], [a, b]] {
            assert!(sides.insert(side, number as u32).is_none());
        }
    }
    for (triangle, neighbours) in found.triangles().iter().zip(found.neighbours()) {
        let corners = triangle.map(spot);
        for (k, &neighbour) in neighbours.iter().enumerate() {
            let side = [triangle[(k + 2) % 3], triangle[(k + 1) % 3]];
            assert_eq!(neighbour, sides.get(&side).copied());
            // By Delaunay's lemma circles are empty if those of neighbours are.
            if let Some(other) = neighbour {
                let other = found.triangles()[other as usize];
                let apex = other.into_iter().find(|k| !side.contains(k)).unwrap();
                assert!(
                    inside(corners, spot(apex)) <= 0,
                    "{corners:?} {:?}",
                    spot(apex)
                );
            }
        }
    }
    if all.len() < 60 {
        for triangle in found.triangles() {
            let corners = triangle.map(spot);
            assert!(all.iter().all(|&p| inside(corners, p) <= 0));
        }
    }
    let count = distinct.len();
    let is_flat = found.triangles().is_empty();
    let edges = found.edges();
    if is_flat {
        assert_eq!(
            (found.hull().len(), edges.len()),
            (count, count.saturating_sub(1))
        );
        let line: Vec<Spot> = found.hull().iter().map(|&k| spot(k)).collect();
        assert!(line.windows(3).all(|w| turn(w[0], w[1], w[2]) == 0) && line.is_sorted());
    } else {
        let (area, border) = hull(all);
        assert_eq!((twice, found.hull().len()), (area, border));
        assert_eq!(found.triangles().len(), 2 * count - 2 - border);
        // Vertices less edges and faces, the outer one included.
        assert_eq!(count + found.triangles().len() + 1, edges.len() + 2);
        let way = found.hull();
        assert_eq!(way[0], *way.iter().min().unwrap());
        for k in 0..way.len() {
            let [p, q, r] = [0, 1, 2].map(|i| spot(way[(k + i) % way.len()]));
            assert!(turn(p, q, r) >= 0);
            assert!(sides.contains_key(&[way[k], way[(k + 1) % way.len()]]));
        }
    }
}
fn search(all: &[Spot]) -> Delaunay {
    Delaunay::search(&placed(all)).unwrap()
}

#[test]
fn circles_are_empty_in_whole_numbers() {
    if !geograd_tests::is_due("circles_are_empty_in_whole_numbers") {
        return;
    }
    let mut dice = Dice(1);
    for round in 0..3000 {
        let (count, side) = (dice.below(40), [2, 3, 5, 9, 1000, 1 << 26][round % 6]);
        let mut one = || dice.below(side) as i128 - side as i128 / 2;
        let all: Vec<Spot> = (0..count).map(|_| [one(), one()]).collect();
        judge(&all, &search(&all));
    }
    for side in [2, 3, 10, 40] {
        let grid: Vec<Spot> = (0..side * side).map(|k| [k % side, k / side]).collect();
        judge(&grid, &search(&grid));
    }
    let mut all: Vec<Spot> = Vec::new();
    // Whole places on one circle about zero, of radius 1105, with and without its centre.
    for x in -1105_i128..=1105 {
        for y in -1105_i128..=1105 {
            if x * x + y * y == 1105 * 1105 {
                all.push([x, y]);
            }
        }
    }
    assert!(all.len() > 100);
    judge(&all, &search(&all));
    all.push([0, 0]);
    judge(&all, &search(&all));
    let many: Vec<Spot> = (0..20_000)
        .map(|_| [dice.below(3000) as i128, dice.below(3000) as i128])
        .collect();
    judge(&many, &search(&many));
}

#[test]
fn lines_and_few_points_have_no_triangles() {
    for all in [
        vec![],
        vec![[3, 4]],
        vec![[3, 4], [3, 4], [3, 4]],
        vec![[3, 4], [1, 2]],
        (0..9).map(|k| [7 * k % 9, 14 * k % 18]).collect(),
        (0..8).map(|k| [5, 3 * k % 8]).collect(),
    ] {
        let found = search(&all);
        assert!(found.triangles().is_empty());
        judge(&all, &found);
    }
    // One point beside a line.
    let mut all: Vec<Spot> = (0..50).map(|k| [k, k]).collect();
    all.push([100, 101]);
    judge(&all, &search(&all));
}

#[test]
fn points_that_nearly_coincide_are_exact() {
    // Last digits of coordinates near one: whole numbers of units of 2⁻⁵².
    let mut dice = Dice(2);
    for _ in 0..300 {
        let mut one = || (1_i128 << 52) + dice.below(6) as i128;
        let all: Vec<Spot> = (0..20).map(|_| [one(), one()]).collect();
        let unit = 0.5_f64.powi(52);
        let points: Vec<Vec2<f64>> = placed(&all).into_iter().map(|p| p * unit).collect();
        judge(&all, &Delaunay::search(&points).unwrap());
        // Sizes are only units.
        for size in [2.0_f64.powi(-900), 2.0_f64.powi(900)] {
            let scaled: Vec<_> = points.iter().map(|&p| p * size).collect();
            judge(&all, &Delaunay::search(&scaled).unwrap());
        }
    }
}

#[test]
fn both_formats_and_zeros_of_both_signs_are_one_place() {
    let all = [at(0.0, -0.0), at(-0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)];
    let found = Delaunay::search(&all).unwrap();
    assert_eq!(found.firsts(), [0, 0, 2, 3]);
    assert_eq!(found.triangles().len(), 1);
    let narrow = all.map(|p| Vec2::new(p.x as f32, p.y as f32));
    assert_eq!(Delaunay::search(&narrow).unwrap(), found);
    let error = Delaunay::search(&[at(0.0, 0.0), at(1.0, f64::INFINITY)]).unwrap_err();
    assert!(matches!(
        error,
        Error::Invalid {
            argument: Argument::Named("points"),
            item: 1,
            ..
        }
    ));
    assert_eq!(
        error.to_string(),
        "`points` item 1: y is not a finite number"
    );
}

#[test]
fn areas_and_circles_have_derivatives() {
    let mut dice = Dice(3);
    let points: Vec<Vec2<f64>> = (0..12).map(|_| at(dice.roll(), dice.roll())).collect();
    let found = Delaunay::search(&points).unwrap();
    // The sum of all areas is that of the hull, whatever is inside.
    let (sum, by) = gradient(
        |all: Vec<_>| {
            let areas = found.areas(&all);
            areas.into_iter().reduce(|sum, area| sum + area).unwrap()
        },
        points.clone(),
    );
    let way: Vec<_> = found.hull().iter().map(|&k| points[k as usize]).collect();
    assert!((sum - geograd::ring::signed_area(&way)).abs() < 1e-15);
    for (k, by) in by.iter().enumerate() {
        let is_border = found.hull().contains(&(k as u32));
        assert!(is_border || by.length() < 1e-15, "{k} {by:?}");
    }
    // The centre of a circle is as far from all corners after a step.
    let circles = |all: Vec<_>| found.circumcircles(&all)[0].center;
    let (center, slopes) = jacobian(circles, points.clone());
    let step = 1e-6;
    for &k in &found.triangles()[0] {
        let mut moved = points.clone();
        moved[k as usize].x += step;
        let after = found.circumcircles(&moved)[0].center;
        let change = (after - center) * (1.0 / step);
        let expected = at(slopes.x[k as usize].x, slopes.y[k as usize].x);
        assert!((change - expected).length() < 1e-3 * (1.0 + expected.length()));
    }
    let round = found.circumcircles(&points);
    for (circle, corners) in round.iter().zip(found.triangles()) {
        for &k in corners {
            let apart = points[k as usize].distance(circle.center);
            assert!((apart - circle.radius).abs() < 1e-12 * circle.radius);
        }
    }
}

#[test]
fn places_are_located_in_the_lowest_triangle_that_contains_them() {
    let mut dice = Dice(5);
    for round in 0..400 {
        let (count, side) = (3 + dice.below(40), [2, 3, 5, 9, 1000, 1 << 26][round % 6]);
        // Even numbers, so that middles of edges are whole.
        let mut one = |side: usize| 2 * (dice.below(side) as i128 - side as i128 / 2);
        let all: Vec<Spot> = (0..count).map(|_| [one(side), one(side)]).collect();
        let found = search(&all);
        let mut spots = all.clone();
        let middle = |[a, b]: [u32; 2]| {
            let [p, q] = [a, b].map(|k| all[k as usize]);
            [0, 1].map(|k| (p[k] + q[k]) / 2)
        };
        spots.extend(found.edges().into_iter().map(middle));
        spots.extend((0..40).map(|_| [one(2 * side) + 1, one(2 * side)]));
        let expected: Vec<Option<u32>> = spots
            .iter()
            .map(|&spot| {
                let contains = |triangle: &[u32; 3]| {
                    let [a, b, c] = triangle.map(|k| all[k as usize]);
                    [[a, b], [b, c], [c, a]]
                        .iter()
                        .all(|&[p, q]| turn(p, q, spot) >= 0)
                };
                let number = found.triangles().iter().position(contains);
                number.map(|number| number as u32)
            })
            .collect();
        // Sizes are only units.
        for size in [1.0, 2.0_f64.powi(-900), 2.0_f64.powi(900)] {
            let [points, places] = [&all, &spots].map(|own| {
                let own = placed(own).into_iter();
                own.map(|p| p * size).collect::<Vec<_>>()
            });
            assert_eq!(found.locate(&points, &places), expected, "{all:?} {size:e}");
        }
    }
    // A corner of very many triangles, and a long walk along a strip.
    let mut fan: Vec<Spot> = (0..20_000).map(|k| [k - 10_000, 1 << 20]).collect();
    fan.push([0, 0]);
    let found = search(&fan);
    assert_eq!(found.triangles().len(), 19_999);
    assert_eq!(
        found.locate(&placed(&fan), &[at(0.0, 0.0); 100]),
        [Some(0); 100]
    );
    let far = [
        at(f64::NAN, 0.0),
        at(f64::INFINITY, 0.0),
        at(-1e300, 1e300),
        at(0.0, 1.0),
    ];
    let [none, endless, away, inside] = found.locate(&placed(&fan), &far)[..] else {
        unreachable!()
    };
    assert_eq!((none, endless, away), (None, None, None));
    assert!(inside.is_some());
    // Points that have moved: a triangle that contains the place, or none.
    let moved: Vec<_> = placed(&fan).into_iter().map(|p| at(-p.x, p.y)).collect();
    assert_eq!(found.locate(&moved, &[at(3.5, 7.0)]), [None]);
    assert_eq!(
        search(&[[0, 0], [1, 1], [2, 2]]).locate(&placed(&[[0, 0]; 3]), &[at(0.0, 0.0)]),
        [None]
    );
}

/// The weights that whole numbers give, next to those of doubles, at three scales; means of corners are places.
#[test]
fn weights_of_places_are_those_of_whole_numbers() {
    let mut dice = Dice(8);
    for round in 0..300 {
        let (count, side) = (3 + dice.below(30), [3, 9, 1000, 1 << 26][round % 4]);
        let mut one = || 2 * (dice.below(side) as i128 - side as i128 / 2);
        let all: Vec<Spot> = (0..count).map(|_| [one(), one()]).collect();
        let mut spots = all.clone();
        spots.extend((0..30).map(|_| [one() + 1, one()]));
        let found = search(&all);
        for size in [1.0, 2.0_f64.powi(-900), 2.0_f64.powi(900)] {
            let [points, places] = [&all, &spots].map(|own| {
                let own = placed(own).into_iter();
                own.map(|p| p * size).collect::<Vec<_>>()
            });
            let located = found.locate(&points, &places);
            let weighted = found.barycentric(&points, &places);
            for ((own, number), &spot) in weighted.iter().zip(located).zip(&spots) {
                assert_eq!(own.map(|own| own.triangle), number);
                let Some(own) = own else { continue };
                let corners = found.triangles()[own.triangle as usize].map(|k| all[k as usize]);
                let [a, b, c] = corners;
                let whole = turn(a, b, c) as f64;
                for (weight, area) in
                    own.weights
                        .iter()
                        .zip([turn(b, c, spot), turn(c, a, spot), turn(a, b, spot)])
                {
                    let expected = area as f64 / whole;
                    assert!(
                        (weight - expected).abs() < 1e-12 && *weight >= 0.0,
                        "{corners:?} {spot:?} {own:?}"
                    );
                    assert!(area != 0 || *weight == 0.0);
                }
            }
        }
    }
}

/// A linear function is its own interpolation. Cotangents are those of duals, which differences agree with.
#[test]
fn weights_of_places_have_derivatives() {
    let mut dice = Dice(12);
    let points: Vec<Vec2<f64>> = (0..20).map(|_| at(dice.roll(), dice.roll())).collect();
    let places: Vec<Vec2<f64>> = (0..30).map(|_| at(dice.roll(), dice.roll())).collect();
    let found = Delaunay::search(&points).unwrap();
    let own = found.barycentric(&points, &places);
    assert!(own.iter().flatten().count() > 10);
    let bars: Vec<[f64; 3]> = places
        .iter()
        .map(|_| [0; 3].map(|_| dice.within(-1.0, 1.0)))
        .collect();
    let [by_points, by_places] = found.barycentric_vjp(&points, &places, &own, &bars);
    fn sum<S: Scalar<Mask = bool>>(
        found: &Delaunay,
        points: &[Vec2<S>],
        places: &[Vec2<S>],
        bars: &[[f64; 3]],
    ) -> S {
        let all = found.barycentric(points, places);
        let terms = all.iter().zip(bars).filter_map(|(own, bars)| {
            let own = own.as_ref()?;
            Some(
                own.weights
                    .iter()
                    .zip(bars)
                    .fold(S::zero(), |sum, (&w, &bar)| sum + w * S::lit(bar)),
            )
        });
        terms.fold(S::zero(), |sum, term| sum + term)
    }
    let lifted = |all: &[Vec2<f64>]| all.to_vec();
    let (_, by_dual_points) = gradient(
        |all: Vec<Vec2<_>>| {
            let still: Vec<_> = places
                .iter()
                .map(|p| Vec2::new(Scalar::lit(p.x), Scalar::lit(p.y)))
                .collect();
            sum(&found, &all, &still, &bars)
        },
        lifted(&points),
    );
    let (_, by_dual_places) = gradient(
        |all: Vec<Vec2<_>>| {
            let still: Vec<_> = points
                .iter()
                .map(|p| Vec2::new(Scalar::lit(p.x), Scalar::lit(p.y)))
                .collect();
            sum(&found, &still, &all, &bars)
        },
        lifted(&places),
    );
    for (by, dual) in by_points
        .iter()
        .chain(&by_places)
        .zip(by_dual_points.iter().chain(&by_dual_places))
    {
        assert!(
            (*by - *dual).length() < 1e-9 * (1.0 + dual.length()),
            "{by:?} {dual:?}"
        );
    }
    let step = 1e-7;
    for (k, dual) in by_dual_places.iter().enumerate() {
        let mut moved = places.clone();
        moved[k].y += step;
        let numbers = |all: &[Vec2<f64>]| found.locate(&points, all)[k];
        if numbers(&moved) == numbers(&places) {
            let slope =
                (sum(&found, &points, &moved, &bars) - sum(&found, &points, &places, &bars)) / step;
            assert!(
                (slope - dual.y).abs() < 1e-4 * (1.0 + dual.y.abs()),
                "{k} {slope} {dual:?}"
            );
        }
    }
    let height = |p: &Vec2<f64>| 3.0 * p.x - 2.0 * p.y + 0.5;
    for (own, place) in own.iter().zip(&places) {
        let Some(own) = own else { continue };
        let corners = found.triangles()[own.triangle as usize].map(|k| height(&points[k as usize]));
        let mean: f64 = corners.iter().zip(own.weights).map(|(h, w)| h * w).sum();
        assert!((mean - height(place)).abs() < 1e-12);
    }
}

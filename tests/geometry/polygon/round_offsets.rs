//! Measures of offsets with exact arcs: closed forms, derivatives, events, hard inputs.
use super::cases::{any_ring, at, convex, hard_rings, ring, stars};
use super::rings::{made, moved, zeros};
use geograd::ad::adjoint::round_offset::round_offset_vjp;
use geograd::ad::forward::First;
use geograd::error::{Argument, Field, Flaw, VertexFault};
use geograd::offset::{
    Chords, OffsetMeasures, OffsetStyle, RoundOffsetTrace, offset_replay, offset_search,
    path_offset_search, round_offset_curves, round_offset_measures, round_offset_replay,
    round_offset_search, round_path_offset_measures, round_path_offset_search,
};
use geograd::polygon::{self, Fill};
use geograd::{Error, Pack, Polygon, Scalar, Vec2};
use geograd_tests::Dice;
use std::f64::consts::{PI, TAU};

const STYLE: OffsetStyle = OffsetStyle {
    join: geograd::offset::Join::Round,
    end: geograd::offset::End::Round,
    chords: Chords::PerQuarter(16),
    fill: Fill::EvenOdd,
    is_trusted: false,
};
const AREA: OffsetMeasures<f64> = OffsetMeasures {
    area: 1.0,
    perimeter: 0.0,
};
const PERIMETER: OffsetMeasures<f64> = OffsetMeasures {
    area: 0.0,
    perimeter: 1.0,
};

fn near(found: f64, expected: f64, by: f64) {
    assert!(
        (found - expected).abs() <= by * (1.0 + expected.abs()),
        "{found} {expected}"
    );
}
/// Compares the measures of arcs with closed forms.
fn measures(polygon: &Polygon<f64>, d: f64, area: f64, perimeter: f64) {
    let trace = round_offset_search(polygon, d, &STYLE).unwrap();
    let found = round_offset_replay(polygon, d, &trace);
    assert!(trace.is_exact());
    near(found.area, area, 1e-12);
    near(found.perimeter, perimeter, 1e-12);
}
fn path_measures(paths: &Polygon<f64>, d: f64, area: f64, perimeter: f64) {
    let trace = round_path_offset_search(paths, d, &STYLE).unwrap();
    let found = round_offset_replay(paths, d, &trace);
    assert!(trace.is_exact());
    near(found.area, area, 1e-12);
    near(found.perimeter, perimeter, 1e-12);
}
fn square(x: f64, y: f64, size: f64) -> Vec<Vec2<f64>> {
    ring(&[(x, y), (x + size, y), (x + size, y + size), (x, y + size)])
}
/// The value and the slopes of one measure.
fn slopes(
    rings: &Polygon<f64>,
    d: f64,
    trace: &RoundOffsetTrace,
    bar: OffsetMeasures<f64>,
) -> (f64, Vec<f64>) {
    let mut bars = zeros(rings);
    let (value, by_d) = round_offset_vjp(rings, d, trace, bar, &mut bars);
    let mut all = bars.scalars();
    all.push(by_d);
    (value.area * bar.area + value.perimeter * bar.perimeter, all)
}

#[test]
fn polygons_have_closed_forms() {
    for d in [0.25_f64, 1.0, 3.0] {
        let squared = made(&[square(0.0, 0.0, 4.0)]);
        measures(&squared, d, 16.0 + 16.0 * d + PI * d * d, 16.0 + TAU * d);
        // Holes shrink with sharp corners and grow with round ones.
        let frame = made(&[square(0.0, 0.0, 20.0), square(6.0, 6.0, 8.0)]);
        let outer = 400.0 + 80.0 * d + PI * d * d;
        let hole = 8.0 - 2.0 * d;
        measures(&frame, d, outer - hole * hole, 80.0 + TAU * d + 4.0 * hole);
        let (inner, grown) = (20.0 - 2.0 * d, 64.0 + 32.0 * d + PI * d * d);
        if d < 3.0 {
            measures(
                &frame,
                -d,
                inner * inner - grown,
                4.0 * inner + 32.0 + TAU * d,
            );
        }
    }
    // The hole is gone, then all of it.
    let frame = made(&[square(0.0, 0.0, 20.0), square(6.0, 6.0, 8.0)]);
    measures(&frame, 5.0, 400.0 + 400.0 + PI * 25.0, 80.0 + TAU * 5.0);
    measures(&frame, -4.5, 0.0, 0.0);
    // An ell: five corners open, one closes.
    let ell = made(&[ring(&[
        (0., 0.),
        (5., 0.),
        (5., 2.),
        (2., 2.),
        (2., 5.),
        (0., 5.),
    ])]);
    measures(
        &ell,
        0.5,
        16.0 + 10.0 - 0.25 + 1.25 * PI * 0.25,
        20.0 - 1.0 + 2.5 * PI * 0.5,
    );
    measures(
        &ell,
        -0.5,
        7.0 + (1.0 - PI / 4.0) * 0.25 + 0.0,
        4.0 + 1.0 + 3.0 + 1.0 + 3.0 + 4.0 - 1.0 + PI / 4.0,
    );
    // A triangle moves inward to a similar one.
    let triangle = made(&[ring(&[(0., 0.), (4., 0.), (0., 3.)])]);
    for d in [0.2, 0.75, 0.999] {
        let scale = 1.0 - d;
        measures(&triangle, -d, 6.0 * scale * scale, 12.0 * scale);
    }
}

#[test]
fn paths_have_closed_forms() {
    let segment = ring(&[(1., 1.), (4., 5.)]);
    path_measures(
        &made(std::slice::from_ref(&segment)),
        1.5,
        15.0 + PI * 2.25,
        10.0 + 3.0 * PI,
    );
    // Back along itself: nothing new, and with a stop on the way.
    let twice = [&segment[..], &ring(&[(1., 1.)])[..]].concat();
    path_measures(&made(&[twice]), 1.5, 15.0 + PI * 2.25, 10.0 + 3.0 * PI);
    let stop = ring(&[(0., 0.), (2., 0.), (2., 0.), (5., 0.)]);
    path_measures(&made(&[stop]), 1.0, 10.0 + PI, 10.0 + TAU);
    // A right angle: the inner corner is covered twice, the outer one is a quarter disc.
    let hook = ring(&[(0., 0.), (4., 0.), (4., 3.)]);
    path_measures(
        &made(&[hook]),
        1.0,
        14.0 - 1.0 + 1.25 * PI,
        4.0 + 3.0 + 3.0 + 2.0 + 2.5 * PI,
    );
    // A cross of two paths shares a square.
    let cross = [ring(&[(-3., 0.), (3., 0.)]), ring(&[(0., -2.), (0., 2.)])];
    path_measures(
        &made(&cross),
        0.5,
        6.0 + 4.0 + 2.0 * PI * 0.25 - 1.0,
        20.0 - 4.0 + 4.0 * PI * 0.5,
    );
    // Two parallel segments share a strip and a lens at each end together.
    let (length, apart, r) = (5.0, 1.2, 1.0);
    let two = [
        ring(&[(0., 0.), (length, 0.)]),
        ring(&[(0., apart), (length, apart)]),
    ];
    let half: f64 = (apart / (2.0 * r)).acos();
    let lens = 2.0 * r * r * half - apart / 2.0 * (4.0 * r * r - apart * apart).sqrt();
    let shared = length * (2.0 * r - apart) + lens;
    path_measures(
        &made(&two),
        r,
        2.0 * (2.0 * length * r + PI * r * r) - shared,
        2.0 * length + 2.0 * TAU * r - 4.0 * r * half,
    );
    // A closed path has a hole as long as it is wide.
    let mut walk = square(0.0, 0.0, 4.0);
    walk.push(walk[0]);
    path_measures(
        &made(&[walk.clone()]),
        0.5,
        16.0 + 8.0 + PI * 0.25 - 9.0,
        16.0 + PI + 12.0,
    );
    path_measures(
        &made(&[walk]),
        2.5,
        16.0 + 40.0 + PI * 6.25,
        16.0 + 5.0 * PI,
    );
    for d in [0.0, -1.0] {
        path_measures(&made(&cross), d, 0.0, 0.0);
    }
}

#[test]
fn convex_rings_obey_steiner() {
    let mut dice = Dice(151);
    for _ in 0..200 {
        let own = convex(&mut dice);
        let rings = made(&[own.as_slice().to_vec()]);
        let d = 10f64.powf(dice.within(-4.0, 2.0));
        let (area, length) = (polygon::area(&rings), polygon::perimeter(&rings));
        measures(&rings, d, area + length * d + PI * d * d, length + TAU * d);
    }
}

fn any_path(dice: &mut Dice) -> Vec<Vec2<f64>> {
    let n = 2 + dice.below(7);
    let mut number = || dice.within(0.0, 4.0);
    (0..n).map(|_| at(number(), number())).collect()
}

/// Random polygons and paths with a distance; the last one says if it is of paths.
fn cases(seed: u64, count: usize) -> Vec<(Polygon<f64>, f64, bool)> {
    let mut dice = Dice(seed);
    let one = |k: usize| match k % 3 {
        2 => (
            made(&[any_path(&mut dice), any_path(&mut dice)]),
            dice.within(0.02, 0.8),
            true,
        ),
        _ => (made(&stars(&mut dice)), dice.within(-0.5, 0.9), false),
    };
    (0..count).map(one).collect()
}

fn search(rings: &Polygon<f64>, d: f64, is_path: bool) -> RoundOffsetTrace {
    match is_path {
        true => round_path_offset_search(rings, d, &STYLE).unwrap(),
        false => round_offset_search(rings, d, &STYLE).unwrap(),
    }
}

/// The area by the union of the raw offset, with so many chords per quarter of a turn.
fn by_chords(rings: &Polygon<f64>, d: f64, is_path: bool, quarter: u32) -> [f64; 2] {
    let style = OffsetStyle {
        chords: Chords::PerQuarter(quarter),
        ..STYLE
    };
    let trace = match is_path {
        true => path_offset_search(rings, d, &style).unwrap(),
        false => offset_search(rings, d, &style).unwrap(),
    };
    let shape = offset_replay(rings, d, &trace);
    [polygon::signed_area(&shape), polygon::perimeter(&shape)]
}

#[test]
fn arcs_are_the_limit_of_chords() {
    let mut exact = 0;
    for (rings, d, is_path) in cases(152, 150) {
        let trace = search(&rings, d, is_path);
        let found = round_offset_replay(&rings, d, &trace);
        let coarse = by_chords(&rings, d, is_path, 32);
        let fine = by_chords(&rings, d, is_path, 64);
        // The missing segments go by the square of their length.
        near(found.area, fine[0] + (fine[0] - coarse[0]) / 3.0, 3e-5);
        near(found.perimeter, fine[1] + (fine[1] - coarse[1]) / 3.0, 1e-2);
        let missing = (found.area - fine[0]) * if d < 0.0 { -1.0 } else { 1.0 };
        assert!(missing > -1e-12, "{missing}");
        exact += usize::from(trace.is_exact());
    }
    assert_eq!(exact, 150);
}

#[test]
fn adjoints_are_duals_and_duals_are_differences() {
    if !geograd_tests::is_due("adjoints_are_duals_and_duals_are_differences") {
        return;
    }
    type Dual = First<f64>;
    let mut dice = Dice(153);
    let mut compared = 0;
    for (rings, d, is_path) in cases(154, 90) {
        let trace = search(&rings, d, is_path);
        for bar in [AREA, PERIMETER] {
            let measure = |m: OffsetMeasures<f64>| m.area * bar.area + m.perimeter * bar.perimeter;
            let of = |(p, d): (Polygon<Dual>, Dual)| {
                let found = round_offset_replay(&p, d, &trace);
                if bar.area > 0.0 {
                    found.area
                } else {
                    found.perimeter
                }
            };
            let (value, by) = geograd::gradient(of, (rings.clone(), d));
            let by = by.scalars();
            let (same, found) = slopes(&rings, d, &trace, bar);
            near(same, value, 1e-14);
            let size = by.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
            for (found, expected) in found.iter().zip(&by) {
                assert!((found - expected).abs() < 1e-9 * size, "{found} {expected}");
            }
            let start = (rings.clone(), d).scalars();
            let at = |numbers: &[f64]| {
                let (rings, d) = (rings.clone(), d).refill(numbers);
                measure(round_offset_replay(&rings, d, &search(&rings, d, is_path)))
            };
            for _ in 0..6 {
                let k = dice.below(start.len());
                let moved = |by: f64| {
                    let mut numbers = start.clone();
                    numbers[k] += by;
                    at(&numbers)
                };
                let step = 1e-6;
                let (low, high) = (moved(-step), moved(step));
                // Away from kinks, and where the second derivative is small enough.
                if ((high - value) - (value - low)).abs() / step < 1e-4 {
                    near((high - low) / (2.0 * step), found[k], 1e-7);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 900, "{compared}");
}

#[test]
fn the_area_grows_by_the_perimeter_and_moves_with_its_input() {
    for (rings, d, is_path) in cases(155, 200) {
        let trace = search(&rings, d, is_path);
        let found = round_offset_replay(&rings, d, &trace);
        for bar in [AREA, PERIMETER] {
            let mut bars = zeros(&rings);
            let (_, by_d) = round_offset_vjp(&rings, d, &trace, bar, &mut bars);
            let size = bars.iter().fold(1.0, |m, bar| bar.length().max(m));
            // Moved, turned and scaled about the origin.
            let sum = bars.iter().fold(Vec2::zero(), |sum, &bar| sum + bar);
            assert!(sum.length() < 1e-11 * size, "{sum:?}");
            let pairs = bars.iter().zip(rings.vertices());
            let turn: f64 = pairs.clone().map(|(bar, v)| v.perp_dot(*bar)).sum();
            let growth: f64 = pairs.map(|(bar, v)| v.dot(*bar)).sum();
            near(turn / size, 0.0, 1e-10);
            let expected = if bar.area > 0.0 {
                near(by_d, found.perimeter, 1e-12);
                2.0 * found.area
            } else {
                found.perimeter
            };
            near((growth + d * by_d) / size, expected / size, 1e-10);
        }
    }
}

#[test]
fn duals_of_the_adjoint_are_second_derivatives() {
    if !geograd_tests::is_due("duals_of_the_adjoint_are_second_derivatives") {
        return;
    }
    type Dual = First<f64>;
    let mut dice = Dice(156);
    for (rings, d, is_path) in cases(157, 24) {
        let trace = search(&rings, d, is_path);
        let n = rings.scalars().len() + 1;
        for bar in [AREA, PERIMETER] {
            let row = |k: usize| {
                let of = |(p, d): (Polygon<Dual>, Dual)| {
                    let mut bars = vec![Vec2::zero(); p.vertices().len()];
                    let bar = OffsetMeasures {
                        area: Dual::lit(bar.area),
                        perimeter: Dual::lit(bar.perimeter),
                    };
                    let (_, by_d) = round_offset_vjp(&p, d, &trace, bar, &mut bars);
                    let of_vertex = |k: usize| {
                        if k.is_multiple_of(2) {
                            bars[k / 2].x
                        } else {
                            bars[k / 2].y
                        }
                    };
                    if k + 1 < n { of_vertex(k) } else { by_d }
                };
                geograd::gradient(of, (rings.clone(), d)).1.scalars()
            };
            let hessian: Vec<Vec<f64>> = (0..n).map(row).collect();
            let size = hessian
                .iter()
                .flatten()
                .fold(1.0_f64, |m, x| m.max(x.abs()));
            for (i, row) in hessian.iter().enumerate() {
                for (j, other) in hessian[..i].iter().enumerate() {
                    let (one, other) = (row[j], other[i]);
                    assert!((one - other).abs() < 1e-8 * size, "{one} {other} {size}");
                }
            }
            // Differences of the first derivatives along the same record.
            let (start, k) = ((rings.clone(), d).scalars(), dice.below(n));
            let at = |by: f64| {
                let mut numbers = start.clone();
                numbers[k] += by;
                let (rings, d) = (rings.clone(), d).refill(&numbers);
                slopes(&rings, d, &trace, bar).1
            };
            let step = 1e-5 / size.sqrt();
            let (low, high) = (at(-step), at(step));
            for i in 0..n {
                let found = (high[i] - low[i]) / (2.0 * step);
                assert!(
                    (found - hessian[i][k]).abs() < 1e-4 * size,
                    "{found} {} {size}",
                    hessian[i][k]
                );
            }
        }
    }
}

/// The border as lines and arcs has the measures, winds around what is near, and has the slopes of the record.
#[test]
fn contours_of_lines_and_arcs_have_the_measures() {
    type Dual = First<f64>;
    let mut dice = Dice(161);
    for (rings, d, is_path) in cases(162, 60) {
        let trace = search(&rings, d, is_path);
        let found = round_offset_replay(&rings, d, &trace);
        let Some(border) = round_offset_curves(&rings, d, &trace) else {
            assert_eq!(found, OffsetMeasures::default());
            continue;
        };
        near(border.signed_area(), found.area, 1e-12);
        near(border.length(), found.perimeter, 1e-12);
        let pieces: usize = trace.piece_counts().iter().sum();
        assert_eq!(border.pieces().count(), pieces);
        let shape = (is_path, rings.rings());
        for _ in 0..8 {
            let point = at(dice.within(-2.0, 6.0), dice.within(-2.0, 6.0));
            let inside = match shape {
                // The distance from an open path is that of its walk there and back.
                (true, rings) => {
                    let edges = rings.iter().flat_map(|path| path.windows(2));
                    let distance = |two: &[Vec2<f64>]| {
                        let way = two[1] - two[0];
                        let share = (point - two[0]).dot(way) / way.length_squared();
                        (point - two[0] - way * share.clamp(0.0, 1.0)).length()
                    };
                    edges.map(distance).fold(f64::INFINITY, f64::min) - d
                }
                (false, rings) => rings.signed_distance(point, Fill::EvenOdd) - d,
            };
            if inside.abs() > 1e-6 {
                assert_eq!(
                    border.winding_number(point),
                    i32::from(inside < 0.0),
                    "{point:?}"
                );
            }
        }
        let of = |(p, d): (Polygon<Dual>, Dual)| {
            let border = round_offset_curves(&p, d, &trace).expect("the same record");
            border.signed_area()
        };
        let (_, by) = geograd::gradient(of, (rings.clone(), d));
        let (_, expected) = slopes(&rings, d, &trace, AREA);
        for (found, expected) in by.scalars().iter().zip(expected) {
            near(*found, expected, 1e-9);
        }
    }
    // A distance that leaves nothing.
    let gone = search(&made(&[square(0.0, 0.0, 1.0)]), -1.0, false);
    assert!(round_offset_curves(&made(&[square(0.0, 0.0, 1.0)]), -1.0, &gone).is_none());
}

#[test]
fn slots_plates_and_necks_take_the_closed_branch() {
    // A slot of width one, four deep, in a plate: both sides of it meet.
    let plate = made(&[ring(&[
        (0., 0.),
        (7., 0.),
        (7., 6.),
        (4., 6.),
        (4., 2.),
        (3., 2.),
        (3., 6.),
        (0., 6.),
    ])]);
    let slope = |rings: &Polygon<f64>, d: f64| {
        let trace = search(rings, d, false);
        assert!(trace.is_exact());
        let (value, by) = slopes(rings, d, &trace, AREA);
        (value, by[by.len() - 1])
    };
    let event = |rings: &Polygon<f64>, d: f64, value: f64, expected: [f64; 3]| {
        let step = 1e-9 * d.signum();
        for (k, d) in [d - step, d, d + step].into_iter().enumerate() {
            let (found, by_d) = slope(rings, d);
            near(found, value, 1e-7);
            near(by_d, expected[k], 1e-3);
        }
        near(slope(rings, d).1, expected[1], 1e-12);
        near(slope(rings, d).0, value, 1e-12);
    };
    let closed = 25.0 + 1.5 * PI;
    // The area of the outer plate less what two arcs at the mouth leave.
    let area = 42.0 + 13.0 + PI * 0.25 - (0.5 - PI / 8.0);
    event(&plate, 0.5, area, [closed + 7.0, closed, closed]);
    let thin = made(&[ring(&[(0., 0.), (4., 0.), (4., 1.), (0., 1.)])]);
    event(&thin, -0.5, 0.0, [6.0, 0.0, 0.0]);
    // Two squares, joined by a neck of width one and length two.
    let neck = made(&[ring(&[
        (0., 0.),
        (4., 0.),
        (4., 1.5),
        (6., 1.5),
        (6., 0.),
        (10., 0.),
        (10., 4.),
        (6., 4.),
        (6., 2.5),
        (4., 2.5),
        (4., 4.),
        (0., 4.),
    ])]);
    // Each square loses a strip all around, and gains the part of it between both arcs of its mouth.
    let (side, arcs) = (3.0, 2.0 * PI * 0.5 / 2.0);
    let around = 2.0 * (3.0 * side + 2.0 * 1.0 + arcs);
    let mouth = 2.0 * (0.5 - PI * 0.25 / 2.0);
    event(
        &neck,
        -0.5,
        2.0 * side * side + mouth,
        [around + 4.0, around, around],
    );
}

#[test]
fn holes_and_touches_are_no_kinks() {
    // A hole vanishes: continuous with its slope.
    let frame = made(&[square(0.0, 0.0, 6.0), square(2.0, 2.0, 2.0)]);
    let grown = |d: f64| (36.0 + 24.0 * d + PI * d * d, 24.0 + TAU * d);
    for d in [1.0 - 1e-9, 1.0, 1.0 + 1e-9] {
        let trace = search(&frame, d, false);
        let (area, by) = slopes(&frame, d, &trace, AREA);
        near(area, grown(d).0, 1e-14);
        near(by[16], grown(d).1, 1e-8);
    }
    // A hole of twelve corners: all arcs meet in one point as it vanishes, inward from the outside.
    let corner = |k: usize| {
        let angle = TAU * k as f64 / 12.0;
        at(2.0 * angle.cos(), 2.0 * angle.sin())
    };
    let twelve = made(&[square(-5.0, -5.0, 10.0), (0..12).map(corner).collect()]);
    let vanishes = 2.0 * (PI / 12.0).cos();
    for d in [vanishes * (1.0 - 1e-6), vanishes, vanishes * (1.0 + 1e-6)] {
        let found = round_offset_measures(&twelve, d, &STYLE).unwrap();
        near(found.area, 100.0 + 40.0 * d + PI * d * d, 1e-11);
    }
    // Two corners touch: the perimeter falls as the root of the depth.
    let two = made(&[
        ring(&[(0., 0.), (2., 1.), (0., 2.)]),
        ring(&[(3., 1.), (5., 0.), (5., 2.)]),
    ]);
    let before = round_offset_measures(&two, 0.5, &STYLE).unwrap();
    for depth in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let r = 0.5 + depth;
        let after = round_offset_measures(&two, r, &STYLE).unwrap();
        // Half the angle of the lens in each disc, by its height.
        let half = ((r - 0.5) * (r + 0.5)).sqrt().atan2(0.5);
        let grown = before.perimeter + 4.0 * PI * (r - 0.5) - 4.0 * r * half;
        assert!(
            (after.perimeter - grown).abs() < 1e-3 * half + 1e-12,
            "{depth}"
        );
        assert!((after.area - before.area) < before.perimeter * depth * 1.001);
    }
    assert!(search(&two, 0.5, false).is_exact());
}

/// The first derivative by both ends of an edge of length zero: each edge has its own one, the arc both.
#[test]
fn repeated_vertices_share_their_arc() {
    let (d, quarter) = (0.5, PI / 2.0);
    let twice = made(&[ring(&[(0., 0.), (4., 0.), (4., 0.), (4., 4.), (0., 4.)])]);
    let trusted = OffsetStyle {
        is_trusted: true,
        ..STYLE
    };
    let trace = round_offset_search(&twice, d, &trusted).unwrap();
    let (area, by) = slopes(&twice, d, &trace, AREA);
    near(area, 16.0 + 16.0 * d + PI * d * d, 1e-14);
    // The lower edge moves down with its end, the right one to the right; of the arc each has half.
    let expected = [0.5 * d, -2.0 - 0.5 * d, 2.0 + 0.5 * d, -0.5 * d];
    for (found, expected) in by[2..6].iter().zip(expected) {
        near(*found, expected, 1e-13);
    }
    // Without a union first the sum is that of one vertex.
    let once = made(&[square(0.0, 0.0, 4.0)]);
    let (_, single) = slopes(&once, d, &search(&once, d, false), AREA);
    near(by[2] + by[4], single[2], 1e-13);
    near(by[3] + by[5], single[3], 1e-13);
    let (_, length) = slopes(&twice, d, &trace, PERIMETER);
    near(length[10], 4.0 * quarter, 1e-13);
}

/// Polygons of whole numbers, at distances at which many events coincide.
#[test]
fn grids_at_their_events_are_right() {
    if !geograd_tests::is_due("grids_at_their_events_are_right") {
        return;
    }
    let mut dice = Dice(158);
    let (mut exact, mut all) = (0, 0);
    for _ in 0..60 {
        let size = 2 + dice.below(4);
        let mut squares = Vec::new();
        for x in 0..size {
            for y in 0..size {
                if dice.below(2) == 0 {
                    squares.push(square(x as f64, y as f64, 1.0));
                }
            }
        }
        if squares.is_empty() {
            continue;
        }
        let pixels = made(&squares);
        for d in [0.5, 1.0, 1.5, 0.25, -0.5, -0.25, -1.0, 0.0] {
            let style = OffsetStyle {
                fill: Fill::NonZero,
                ..STYLE
            };
            let trace = round_offset_search(&pixels, d, &style).unwrap();
            let found = round_offset_replay(&pixels, d, &trace);
            let style = OffsetStyle {
                chords: Chords::PerQuarter(128),
                ..style
            };
            let union = offset_search(&pixels, d, &style).unwrap();
            let expected = polygon::signed_area(&offset_replay(&pixels, d, &union));
            near(found.area, expected, 5e-5);
            let (_, by) = slopes(&pixels, d, &trace, AREA);
            assert!(by.iter().all(|x| x.is_finite()));
            all += 1;
            exact += usize::from(trace.is_exact());
        }
    }
    assert!(all > 300 && exact * 100 > all * 99, "{exact} of {all}");
}

#[test]
fn hard_input_is_right_or_says_so() {
    if !geograd_tests::is_due("hard_input_is_right_or_says_so") {
        return;
    }
    let mut dice = Dice(159);
    let mut all = hard_rings();
    all.extend((0..80).map(|_| vec![any_ring(&mut dice, 9)]));
    let mut counts = [0; 2];
    for rings in all {
        let rings = made(&rings);
        if rings.rings().validate().is_err() {
            continue;
        }
        for fill in [Fill::EvenOdd, Fill::NonZero] {
            for d in [0.25, -0.25, 0.0, 1.0, -1.0, 1e-9, -1e-9] {
                let style = OffsetStyle { fill, ..STYLE };
                let trace = round_offset_search(&rings, d, &style).unwrap();
                let (area, by) = slopes(&rings, d, &trace, AREA);
                let chords = Chords::PerQuarter(128);
                let fine = OffsetStyle { chords, ..style };
                let union = offset_search(&rings, d, &fine).unwrap();
                let expected = polygon::signed_area(&offset_replay(&rings, d, &union));
                near(area, expected, 1e-4);
                assert!(by.iter().all(|x| x.is_finite()), "{rings:?} {d}");
                counts[usize::from(trace.is_exact())] += 1;
            }
        }
    }
    assert!(counts[1] > 1000 && counts[0] * 50 < counts[1], "{counts:?}");
}

#[test]
fn invalid_polygons_are_united_first() {
    let tie = made(&[ring(&[(0., 0.), (4., 4.), (4., 0.), (0., 4.)])]);
    let triangles = made(&[
        ring(&[(0., 0.), (2., 2.), (0., 4.)]),
        ring(&[(4., 0.), (4., 4.), (2., 2.)]),
    ]);
    let of = |rings: &Polygon<f64>, d: f64| round_offset_measures(rings, d, &STYLE).unwrap();
    for d in [0.25, -0.25] {
        near(of(&tie, d).area, of(&triangles, d).area, 1e-12);
    }
    // Orientations do not matter; two equal parts are one by the rule of odd winding numbers in turn.
    let mut turned = square(0.0, 0.0, 4.0);
    turned.reverse();
    measures(&made(&[turned.clone()]), 0.5, 24.0 + PI * 0.25, 16.0 + PI);
    let nonzero = OffsetStyle {
        fill: Fill::NonZero,
        ..STYLE
    };
    let equal = made(&[square(0.0, 0.0, 4.0), square(0.0, 0.0, 4.0)]);
    let found = round_offset_measures(&equal, 0.5, &nonzero).unwrap();
    near(found.area, 24.0 + PI * 0.25, 1e-14);
    assert_eq!(of(&equal, 0.5), OffsetMeasures::default());
    // A shared edge is none.
    let halves = made(&[square(0.0, 0.0, 4.0), square(4.0, 0.0, 4.0)]);
    measures(&halves, 0.5, 32.0 + 12.0 + PI * 0.25, 24.0 + PI);
    // A ring that crosses itself by a little keeps its corner.
    let crossed = made(&[ring(&[
        (0., 0.),
        (4., 0.),
        (4., 4.),
        (1e-8, 4.),
        (-1e-8, 4.0 + 1e-8),
        (0.0, 4.0),
    ])]);
    near(of(&crossed, 0.5).area, 24.0 + PI * 0.25, 1e-7);
}

#[test]
fn chords_stand_in_where_a_path_lies_along_itself() {
    // The second edge covers half of the first one.
    let folded = made(&[ring(&[(0., 0.), (4., 0.), (2., 0.), (2., 3.)])]);
    let trace = round_path_offset_search(&folded, 0.5, &STYLE).unwrap();
    let found = round_offset_replay(&folded, 0.5, &trace);
    let expected = 4.0 + 3.0 - 0.5 + 1.5 * PI * 0.25;
    assert_eq!((trace.is_exact(), trace.piece_counts()[1]), (false, 0));
    assert!(
        (found.area - expected).abs() < 2.6e-5 * 1.5 * PI * 0.25,
        "{} {expected}",
        found.area
    );
    let (area, by) = slopes(&folded, 0.5, &trace, AREA);
    let mut sum = by.clone();
    let (perimeter, other) = slopes(&folded, 0.5, &trace, PERIMETER);
    sum.iter_mut().zip(other).for_each(|(a, b)| *a += b);
    let both = OffsetMeasures {
        area: 1.0,
        perimeter: 1.0,
    };
    assert_eq!((area, perimeter), (found.area, found.perimeter));
    assert_eq!(slopes(&folded, 0.5, &trace, both).1, sum);
}

#[test]
fn results_follow_size_place_and_format() {
    let mut dice = Dice(160);
    for _ in 0..12 {
        let (rings, d) = (stars(&mut dice), dice.within(-0.1, 0.2));
        let expected = round_offset_measures(&made(&rings), d, &STYLE).unwrap();
        for scale in [2f64.powi(-400), 2f64.powi(400)] {
            let scaled = made(&moved(&rings, Vec2::zero(), scale));
            let found = round_offset_measures(&scaled, d * scale, &STYLE).unwrap();
            near(found.area / scale / scale, expected.area, 1e-14);
            near(found.perimeter / scale, expected.perimeter, 1e-14);
        }
        let far = made(&moved(&rings, at(1e6, -1e6), 1.0));
        let found = round_offset_measures(&far, d, &STYLE).unwrap();
        near(found.area, expected.area, 1e-8);
        let single: Polygon<f32> = made(&rings).cast();
        let found = round_offset_measures(&single, d as f32, &STYLE).unwrap();
        near(f64::from(found.area), expected.area, 1e-5);
        near(f64::from(found.perimeter), expected.perimeter, 1e-4);
    }
}

#[test]
fn errors_name_ring_and_vertex() {
    let invalid = |argument, flaw| Error::Invalid {
        argument,
        item: 0,
        flaw,
    };
    let of_ring = |ring, index, fault| invalid(Argument::A, Flaw::Ring { ring, index, fault });
    let nan = made(&[
        square(0.0, 0.0, 4.0),
        ring(&[(1., 1.), (2., 1.), (2., f64::NAN)]),
    ]);
    for is_trusted in [false, true] {
        let style = OffsetStyle {
            is_trusted,
            ..STYLE
        };
        let found = round_offset_search(&nan, 1.0, &style).unwrap_err();
        assert_eq!(found, of_ring(1, 2, VertexFault::NotFinite));
    }
    let short = round_path_offset_measures(&ring(&[(1., 1.), (1., 1.)]), 1.0, &STYLE);
    assert_eq!(short.unwrap_err(), of_ring(0, 0, VertexFault::Repeated));
    let plain = made(&[square(0.0, 0.0, 4.0)]);
    let of_distance = |flaw| invalid(Argument::Named("distance"), flaw);
    let found = round_offset_measures(&plain, f64::NAN, &STYLE).unwrap_err();
    assert_eq!(found, of_distance(Flaw::NotFinite(Field::VALUE)));
    let rule = "moves a vertex beyond the largest number";
    let found = round_offset_measures(&plain, f64::MAX, &STYLE).unwrap_err();
    assert_eq!(found, of_distance(Flaw::Broken(Field::VALUE, rule)));
    let nothing = round_offset_measures(&Polygon::<f64>::new(), 1.0, &STYLE).unwrap();
    assert_eq!(nothing, OffsetMeasures::default());
}

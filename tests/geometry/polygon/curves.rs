//! Curves and paths of them: lengths, areas, bounds, chords by closed forms, whole numbers and dense sums.
use super::cases::at;
use geograd::curve::{Arc2, Cubic2, CurveElement, CurvePath, CurvePiece, Quadratic2};
use geograd::error::Error;
use geograd::{Circle, Pack, Segment2, Vec2, ring};
use geograd_tests::Dice;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub fn near(found: f64, expected: f64, by: f64) {
    let size = 1.0 + expected.abs();
    assert!((found - expected).abs() <= by * size, "{found} {expected}");
}
fn point(dice: &mut Dice) -> Vec2<f64> {
    at(dice.within(-4.0, 4.0), dice.within(-4.0, 4.0))
}
/// A piece of each kind in turn, some of them degenerate.
pub fn drawn(dice: &mut Dice, round: usize) -> CurvePiece<f64> {
    let mut p = [(); 4].map(|()| point(dice));
    match round % 7 {
        4 => p[1] = p[0],
        5 => p = p.map(|q| p[0] + (p[1] - p[0]) * q.x),
        6 => p[2] = p[1],
        _ => {}
    }
    match dice.below(8) {
        0 => Segment2::new(p[0], p[3]).into(),
        1 | 2 => Quadratic2::new(p[0], p[1], p[3]).into(),
        3..=5 => Cubic2::new(p[0], p[1], p[2], p[3]).into(),
        _ => {
            let size = [0.0, 1e-9, 0.1, 0.25, 0.6, 1.0, 3.0, 40.0][dice.below(8)];
            Arc2::new(p[0], p[3], size * dice.within(-1.0, 1.0).signum()).into()
        }
    }
}
/// A closed path of pieces of all kinds.
pub fn loop_of(dice: &mut Dice, count: usize) -> CurvePath<f64> {
    let path = (0..count).fold(CurvePath::at(point(dice)), |path, _| {
        let [a, b, c] = [(); 3].map(|()| point(dice));
        match dice.below(4) {
            0 => path.line_to(a),
            1 => path.quad_to(a, b),
            2 => path.curve_to(a, b, c),
            _ => path.arc_to(a, dice.within(-2.0, 2.0)),
        }
    });
    path.close()
}
/// Chords of equal steps, extrapolated: errors fall as the fourth power of their number.
fn summed(piece: CurvePiece<f64>, count: usize) -> f64 {
    let of = |count| {
        let all = piece.flattened(count);
        let steps = all.windows(2).map(|ab| ab[0].distance(ab[1]));
        steps.sum::<f64>()
    };
    (4.0 * of(2 * count) - of(count)) / 3.0
}

#[test]
fn arcs_have_closed_forms() {
    for (sweep, radius) in [(0.3, 2.0), (-1.0, 0.5), (PI, 1.0), (-4.0, 3.0), (6.2, 7.0)] {
        let center = at(3.0, -1.0);
        let arc = Arc2::around(center, radius, 0.7, sweep);
        near(arc.sweep(), sweep, 1e-14);
        near(arc.radius(), radius, 1e-12);
        near(arc.center().distance(center), 0.0, 1e-12);
        near(arc.length(), radius * f64::abs(sweep), 1e-14);
        let segment = 0.5 * radius * radius * (sweep - f64::sin(sweep));
        near(arc.signed_area(), segment, 1e-14);
        for k in 0..=10 {
            let t = f64::from(k) / 10.0;
            let (sin, cos) = f64::sin_cos(0.7 + t * sweep);
            near(
                arc.point(t).distance(center + at(cos, sin) * radius),
                0.0,
                1e-12,
            );
            let along = at(-sin, cos) * (radius * sweep);
            near(arc.derivative(t).distance(along), 0.0, 1e-12);
            let bend = at(cos, sin) * (-radius * sweep * sweep);
            near(arc.second_derivative(t).distance(bend), 0.0, 1e-12);
        }
    }
    // Both sides of where series take over have one value.
    for b in [0.25_f64, -0.25] {
        let [low, high] =
            [b, b * (1.0 + 4.0 * f64::EPSILON)].map(|b| Arc2::new(at(0.0, 0.0), at(1.0, 2.0), b));
        near(low.length(), high.length(), 1e-15);
        near(low.signed_area(), high.signed_area(), 1e-15);
        near(low.point(0.3).distance(high.point(0.3)), 0.0, 1e-15);
    }
    // Flat arcs: the height over the chord, to the first order.
    let flat = Arc2::new(at(0.0, 0.0), at(2.0, 0.0), 1e-9);
    near(flat.signed_area() / 1e-9, 4.0 / 3.0, 1e-15);
    near(flat.point(0.5).y / 1e-9, -1.0, 1e-15);
    let round = CurvePath::circle(Circle::new(at(1.0, 2.0), 3.0));
    near(round.length(), 6.0 * PI, 1e-15);
    near(round.signed_area(), 9.0 * PI, 1e-15);
}

#[test]
fn arcs_in_notation_of_svg_have_its_centres() {
    // A quarter of the unit circle, in all four ways.
    let (from, to) = (at(1.0, 0.0), at(0.0, 1.0));
    for (is_large, is_left, center, sweep) in [
        (false, true, at(0.0, 0.0), FRAC_PI_2),
        (true, true, at(1.0, 1.0), 3.0 * FRAC_PI_2),
        (false, false, at(1.0, 1.0), -FRAC_PI_2),
        (true, false, at(0.0, 0.0), -3.0 * FRAC_PI_2),
    ] {
        let arc = Arc2::svg(from, -1.0, is_large, is_left, to);
        near(arc.center().distance(center), 0.0, 1e-14);
        near(arc.sweep(), sweep, 1e-14);
    }
    // Too short a radius grows, zero is straight.
    near(Arc2::svg(from, 0.1, true, true, to).sweep(), PI, 1e-15);
    assert_eq!(Arc2::svg(from, 0.0, true, true, to).bulge, 0.0);
    assert_eq!(Arc2::svg(from, 1.0, true, true, from).length(), 0.0);
    let path = CurvePath::at(from).svg_arc_to(1.0, false, true, to);
    near(path.length(), FRAC_PI_2, 1e-15);
    // Far flatter than a rounding.
    let flat = Arc2::svg(from, 1e20, false, true, to);
    near(flat.length(), 2.0_f64.sqrt(), 1e-15);
}

/// Twice the integral of `x dy − y dx` over a Bézier curve of whole numbers, times sixty.
fn exact_area(points: &[[i128; 2]]) -> i128 {
    // Coefficients of powers, from binomials.
    let power = |axis: usize| -> Vec<i128> {
        let p: Vec<i128> = points.iter().map(|p| p[axis]).collect();
        match p[..] {
            [a, b] => vec![a, b - a],
            [a, b, c] => vec![a, 2 * (b - a), a - 2 * b + c],
            [a, b, c, d] => vec![a, 3 * (b - a), 3 * (a - 2 * b + c), d - 3 * c + 3 * b - a],
            _ => unreachable!(),
        }
    };
    let (x, y) = (power(0), power(1));
    let mut sum = 0;
    for i in 0..x.len() {
        for j in 0..x.len() {
            if i + j > 0 {
                sum += 60 * (x[i] * y[j] - y[i] * x[j]) * j as i128 / (i + j) as i128;
            }
        }
    }
    sum
}

#[test]
fn areas_are_those_of_whole_numbers() {
    let mut dice = Dice(1);
    for _ in 0..2000 {
        let mut spot = || [dice.below(41) as i128 - 20, dice.below(41) as i128 - 20];
        let start = spot();
        let (mut from, mut path, mut expected) = (start, CurvePath::at(place(start)), 0);
        for k in 0..6 {
            let [a, b, c] = [spot(), spot(), spot()];
            let ends: &[[i128; 2]] = match k % 3 {
                0 => &[from, a, b, c],
                1 => &[from, a, b],
                _ => &[from, a],
            };
            path = match ends[1..] {
                [a, b, c] => path.curve_to(place(a), place(b), place(c)),
                [a, b] => path.quad_to(place(a), place(b)),
                _ => path.line_to(place(a)),
            };
            expected += exact_area(ends);
            from = ends[ends.len() - 1];
        }
        expected += exact_area(&[from, start]);
        near(path.signed_area(), expected as f64 / 120.0, 1e-13);
        assert_eq!(path.signed_area(), path.clone().close().signed_area());
        let narrow: CurvePath<f32> = path.cast();
        assert!((f64::from(narrow.signed_area()) - expected as f64 / 120.0).abs() < 1e-2);
    }
}
fn place([x, y]: [i128; 2]) -> Vec2<f64> {
    at(x as f64, y as f64)
}

#[test]
fn lengths_are_those_of_dense_chords() {
    if !geograd_tests::is_due("lengths_are_those_of_dense_chords") {
        return;
    }
    let mut dice = Dice(2);
    for round in 0..1500 {
        let piece = drawn(&mut dice, round);
        let (found, sum) = (piece.length(), summed(piece, 2000));
        // Chords of curves that turn back converge slowly.
        near(found, sum, if round % 7 == 5 { 1e-5 } else { 1e-7 });
        let narrow: CurvePiece<f32> = piece.cast();
        near(f64::from(narrow.length()), found, 3e-6);
    }
    // A parabola, and the same one as a cubic.
    let hill = Quadratic2::new(at(0.0, 0.0), at(1.0, 2.0), at(2.0, 0.0));
    let root = 5.0_f64.sqrt();
    let expected = root + 0.5 * (2.0 + root).ln();
    near(hill.length(), expected, 1e-15);
    near(hill.elevated().length(), expected, 4e-15);
    // A cusp whose speed is a polynomial: (t², t³) from −1 to 1 is 2(13√13 − 8)/27 long.
    let cusp = Cubic2::new(
        at(1.0, -1.0),
        at(-1.0 / 3.0, 1.0),
        at(-1.0 / 3.0, -1.0),
        at(1.0, 1.0),
    );
    near(
        cusp.length(),
        2.0 * (13.0 * 13.0_f64.sqrt() - 8.0) / 27.0,
        1e-14,
    );
    // There and back on a line: turns at both places where 8t² − 8t + 1 is zero.
    let line = Cubic2::new(at(0.0, 0.0), at(1.0, 0.0), at(-2.0, 0.0), at(-1.0, 0.0));
    let at_turns = [0.5 - 0.125_f64.sqrt(), 0.5 + 0.125_f64.sqrt()].map(|t| line.point(t).x);
    let sums = at_turns[0] + (at_turns[0] - at_turns[1]) + (-1.0 - at_turns[1]);
    near(line.length(), sums.abs(), 1e-14);
}

/// Quadratic curves in all proportions, by the same curve as a cubic: a closed form against Gauss' rule.
#[test]
fn both_ways_to_a_length_agree() {
    let mut dice = Dice(12);
    for round in 0..4000 {
        let flat = [1.0, 1e-3, 1e-8, 0.0][round % 4];
        let bend = [1.0, 0.6, 1e-2, 1e-9][round / 4 % 4];
        let from = point(&mut dice);
        let (mut u, w) = (point(&mut dice), point(&mut dice));
        u.y *= flat;
        let v = u + at(w.x, w.y * flat) * bend;
        let curve = Quadratic2::new(from, from + u, from + u + v);
        let (closed, ruled) = (curve.length(), curve.elevated().length());
        assert!(
            (closed - ruled).abs() <= 2e-14 * ruled.max(8.0),
            "{curve:?} {closed} {ruled}"
        );
    }
}

#[test]
fn bounds_hold_the_curve_and_touch_it() {
    if !geograd_tests::is_due("bounds_hold_the_curve_and_touch_it") {
        return;
    }
    let mut dice = Dice(3);
    for round in 0..1500 {
        let piece = drawn(&mut dice, round);
        let found = piece.bounding();
        let (mut min, mut max) = (piece.start(), piece.start());
        for point in piece.flattened(3000) {
            (min, max) = (min.least(point), max.most(point));
        }
        let size = 1.0 + max.distance(min);
        for (outer, inner) in [
            (-found.min.x, -min.x),
            (-found.min.y, -min.y),
            (found.max.x, max.x),
            (found.max.y, max.y),
        ] {
            let more = (outer - inner) / size;
            assert!((-1e-14..1e-5).contains(&more), "{piece:?} {outer} {inner}");
        }
    }
}

#[test]
fn chords_are_within_the_tolerance() {
    let mut dice = Dice(4);
    for round in 0..400 {
        let piece = drawn(&mut dice, round);
        let tolerance = [1.0, 1e-2, 1e-4][round % 3];
        let count = piece.chords(tolerance).unwrap();
        let chords = piece.flattened(count);
        assert_eq!(chords.len(), count + 1);
        let mut worst = 0.0_f64;
        for k in 0..20 * count.min(500) {
            let t = k as f64 / (20 * count.min(500)) as f64;
            let (whole, part) = ((t * count as f64).floor(), (t * count as f64).fract());
            let chord = chords[whole as usize].lerp(chords[whole as usize + 1], part);
            worst = worst.max(chord.distance(piece.point(t)));
        }
        assert!(
            worst <= tolerance * (1.0 + 1e-9),
            "{piece:?} {worst} {tolerance}"
        );
        // The bound is no waste: it is nearly reached by parabolas and arcs.
        if let (CurvePiece::Quadratic(_), true) = (piece, count > 8) {
            assert!(worst > 0.75 * tolerance, "{piece:?} {worst} {tolerance}");
        }
    }
    let path = loop_of(&mut dice, 5);
    let all = path.flatten(1e-6).unwrap();
    near(ring::signed_area(&all[0]), path.signed_area(), 1e-4);
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = path.flatten(tolerance).unwrap_err();
        assert!(error.to_string().contains("tolerance"), "{error}");
    }
    let arch = CurvePath::at(at(0.0, 0.0)).quad_to(at(1.0, 1.0), at(2.0, 0.0));
    assert_eq!(arch.flatten(1e-300), Err(Error::TooLarge));
}

#[test]
fn halves_together_are_the_whole() {
    let mut dice = Dice(5);
    for round in 0..1500 {
        let piece = drawn(&mut dice, round);
        let t = dice.within(0.05, 0.95);
        let [first, second] = piece.split(t);
        near(first.length() + second.length(), piece.length(), 3e-14);
        let (from, middle, to) = (piece.start(), first.end(), piece.end());
        near(middle.distance(piece.point(t)), 0.0, 1e-13);
        let triangle = 0.5 * (middle - from).perp_dot(to - from);
        let sum = first.signed_area() + second.signed_area() + triangle;
        near(sum, piece.signed_area(), 1e-13 * (1.0 + piece.length()));
        near(
            second.point(0.5).distance(piece.point(0.5 + 0.5 * t)),
            0.0,
            1e-12,
        );
        let back = piece.reversed();
        near(back.length(), piece.length(), 1e-14);
        near(
            back.signed_area(),
            -piece.signed_area(),
            1e-14 * (1.0 + piece.length()),
        );
        near(
            back.point(0.25).distance(piece.point(0.75)),
            0.0,
            1e-14 * (1.0 + piece.length()),
        );
        let q = point(&mut dice);
        let least = first.distance(q).min(second.distance(q));
        near(least, piece.distance(q), 1e-13);
        near(back.distance(q), piece.distance(q), 1e-13);
    }
}

#[test]
fn a_reversed_path_has_the_opposite_area() {
    let mut dice = Dice(6);
    for round in 0..300 {
        let mut path = loop_of(&mut dice, 4);
        if round % 3 == 0 {
            path = path.move_to(at(0.0, 1.0)).arc_to(at(3.0, 1.0), 0.5);
        }
        if round % 5 == 0 {
            path = path.close().line_to(at(9.0, 9.0));
        }
        let back = path.reversed();
        near(back.signed_area(), -path.signed_area(), 1e-13);
        near(back.length(), path.length(), 1e-13);
        let q = point(&mut dice);
        assert_eq!(back.winding_number(q), -path.winding_number(q));
        near(back.distance(q).unwrap(), path.distance(q).unwrap(), 1e-13);
        let twice = back.reversed();
        assert_eq!(twice.elements().len(), back.elements().len());
        near(twice.signed_area(), path.signed_area(), 1e-13);
    }
}

#[test]
fn a_path_begins_with_a_point() {
    let wrong = CurvePath::from_elements(vec![CurveElement::LineTo(at(0.0, 0.0))]);
    assert!(wrong.unwrap_err().to_string().contains("elements[0]"));
    let none = CurvePath::<f64>::from_elements(vec![]).unwrap();
    assert_eq!((none.length(), none.signed_area()), (0.0, 0.0));
    assert_eq!(none.bounding(), None);
    assert_eq!(none.distance(at(1.0, 1.0)), None);
    assert_eq!(none.winding_number(at(1.0, 1.0)), 0);
    assert!(none.flatten(0.1).unwrap().is_empty());
    let dot = CurvePath::at(at(1.0, 2.0));
    assert_eq!(dot.bounding().unwrap().max, at(1.0, 2.0));
    assert_eq!(dot.flatten(0.1).unwrap(), [vec![at(1.0, 2.0)]]);
    use geograd::Validate;
    let bad = dot.line_to(at(f64::NAN, 0.0)).validate().unwrap_err();
    assert_eq!(bad.to_string(), "elements[1] is not a finite number");
    // A closed contour goes on at its start.
    let two = CurvePath::at(at(1.0, 0.0))
        .line_to(at(1.0, 1.0))
        .close()
        .line_to(at(3.0, 0.0));
    assert_eq!(two.length(), 4.0);
    assert_eq!(two.flatten(1.0).unwrap().len(), 2);
}

#[test]
fn degenerate_curves_have_finite_results() {
    for size in [0.0, 1e-150, 1.0, 1e150] {
        let p = at(0.3, -0.7) * size;
        let q = at(-0.2, 0.5) * size;
        let shapes: [CurvePiece<f64>; 12] = [
            Segment2::new(p, p).into(),
            Quadratic2::new(p, p, p).into(),
            Quadratic2::new(p, q, p).into(),
            Cubic2::new(p, p, p, p).into(),
            Cubic2::new(p, p, p, q).into(),
            Cubic2::new(p, q, q, p).into(),
            Cubic2::new(p, q, p, q).into(),
            Arc2::new(p, p, 0.0).into(),
            Arc2::new(p, p, 1e6).into(),
            Arc2::new(p, q, if size > 1.0 { 1.0 } else { 1e6 }).into(),
            Arc2::new(p, q, 0.0).into(),
            Arc2::around(p, 0.0, 1.0, 2.0).into(),
        ];
        for piece in shapes {
            let (length, by) = geograd::gradient(CurvePiece::length, piece);
            assert!(
                length.is_finite() && by.scalars().iter().all(|x| x.is_finite()),
                "{piece:?} {by:?}"
            );
            let (area, by) = geograd::gradient(CurvePiece::signed_area, piece);
            assert!(
                area.is_finite() && by.scalars().iter().all(|x| x.is_finite()),
                "{piece:?} {by:?}"
            );
            for target in [p, q, at(0.0, 0.0), at(1.0, 1.0) * size] {
                let place = piece.closest(target);
                let (distance, (by, by_target)) = geograd::gradient(
                    |(piece, q): (CurvePiece<_>, _)| piece.distance_replay(q, place),
                    (piece, target),
                );
                let all = [by.scalars(), by_target.scalars()].concat();
                assert!(
                    distance.is_finite() && all.iter().all(|x| x.is_finite()),
                    "{piece:?} {all:?}"
                );
                if length == 0.0 {
                    assert_eq!(distance, p.distance(target));
                }
                let around = CurvePath::at(piece.start());
                let _ = around.line_to(piece.end()).winding_number(target);
            }
            assert!(piece.bounding().is_some_finite(), "{piece:?}");
            for t in [0.0, 0.5, 1.0] {
                let tangent = piece.tangent(t);
                assert!(tangent.is_finite() && (tangent.length() - 0.5).abs() <= 0.5 + 1e-12);
                assert_eq!(tangent.length() > 0.5, length > 0.0, "{piece:?} {t}");
            }
            if size <= 1.0 {
                assert!(
                    piece
                        .flattened(piece.chords(1.0).unwrap())
                        .iter()
                        .all(|v| v.is_finite())
                );
            }
        }
    }
    // Sizes are only units.
    let curve = Cubic2::new(at(0.0, 0.0), at(1.0, 3.0), at(4.0, -2.0), at(2.0, 1.0));
    let target = at(1.0, 2.0);
    for size in [2.0_f64.powi(-490), 2.0_f64.powi(490)] {
        let scaled = Cubic2 {
            points: curve.points.map(|p| p * size),
        };
        assert_eq!(scaled.length(), curve.length() * size);
        assert_eq!(
            scaled.distance(target * size),
            curve.distance(target) * size
        );
        assert_eq!(
            scaled.closest(target * size).parameter,
            curve.closest(target).parameter
        );
        assert_eq!(scaled.bounding().max, curve.bounding().max * size);
    }
    let full = CurvePath::arc(at(0.0, 0.0), 0.0, 0.0, TAU);
    assert_eq!(
        (
            full.length(),
            full.signed_area(),
            full.distance(at(3.0, 4.0))
        ),
        (0.0, 0.0, Some(5.0))
    );
}

trait Finite {
    fn is_some_finite(&self) -> bool;
}
impl Finite for geograd::Aabb2<f64> {
    fn is_some_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }
}

//! Nearest places of curves, winding numbers, and derivatives of all measures of curves.
use super::cases::at;
use super::curves::{drawn, loop_of, near};
use geograd::ad::adjoint::curve_bars;
use geograd::curve::{Arc2, Cubic2, CurveBoxes, CurveElement, CurvePath, CurvePiece, Quadratic2};
use geograd::{Circle, Fixed, Pack, Scalar, Vec2, gradient, hessian};
use geograd_tests::Dice;
use std::f64::consts::TAU;

fn target(dice: &mut Dice) -> Vec2<f64> {
    at(dice.within(-6.0, 6.0), dice.within(-6.0, 6.0))
}
/// The least distance of many points of a piece, each made nearer by thirds of the steps beside it.
fn sampled(piece: CurvePiece<f64>, q: Vec2<f64>, count: usize) -> f64 {
    let of = |t: f64| piece.point(t).distance(q);
    let values: Vec<f64> = (0..=count).map(|k| of(k as f64 / count as f64)).collect();
    let mut best = f64::INFINITY;
    for k in 0..=count {
        let is_low =
            (k == 0 || values[k] <= values[k - 1]) && (k == count || values[k] <= values[k + 1]);
        if !is_low {
            continue;
        }
        let step = 1.0 / count as f64;
        let middle = k as f64 * step;
        let (mut low, mut high) = ((middle - step).max(0.0), (middle + step).min(1.0));
        for _ in 0..80 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if of(a) <= of(b) {
                high = b;
            } else {
                low = a;
            }
        }
        best = best.min(of(low)).min(of(high)).min(values[k]);
    }
    best
}

#[test]
fn the_nearest_place_is_that_of_dense_samples() {
    let mut dice = Dice(7);
    for round in 0..3000 {
        let piece = drawn(&mut dice, round);
        let q = match round % 5 {
            // Points on the curve, and far away.
            3 => piece.point(dice.roll()),
            4 => target(&mut dice) * 1e3,
            _ => target(&mut dice),
        };
        let place = piece.closest(q);
        let (found, expected) = (piece.distance(q), sampled(piece, q, 300));
        assert!((0.0..=1.0).contains(&place.parameter));
        near(found, expected, 2e-14 * (1.0 + q.length()));
        near(found, piece.point(place.parameter).distance(q), 1e-14);
        if place.is_inside {
            let (away, along) = (
                piece.point(place.parameter) - q,
                piece.derivative(place.parameter),
            );
            let size = (1.0 + q.length()) * (1.0 + along.length());
            assert!(away.dot(along).abs() <= 1e-13 * size, "{piece:?} {q:?}");
        }
        let narrow: CurvePiece<f32> = piece.cast();
        let q = Vec2::new(q.x as f32, q.y as f32);
        let by = 1e-6 * (1.0 + found + piece.length());
        near(f64::from(narrow.distance(q)), found, by);
    }
}

#[test]
fn hard_points_have_their_nearest_place() {
    // The centre of an arc: all places are equally near.
    let arc = Arc2::around(at(1.0, 2.0), 3.0, 0.2, 4.0);
    near(arc.distance(at(1.0, 2.0)), 3.0, 1e-14);
    // Nearly the centre, of a cubic curve that is nearly a circle.
    let k = 0.5519150244935106;
    let quarter = Cubic2::new(at(1.0, 0.0), at(1.0, k), at(k, 1.0), at(0.0, 1.0));
    let center = at(0.0, 0.0);
    near(
        quarter.distance(center),
        sampled(quarter.into(), center, 1000),
        1e-15,
    );
    // A loop: its crossing, and both sides.
    let knot = Cubic2::new(at(0.0, 0.0), at(4.0, 3.0), at(-4.0, 3.0), at(0.0, 0.0));
    for q in [at(0.0, 0.0), at(0.0, 1.0), at(1e-9, 1.0), at(0.0, 9.0)] {
        near(knot.distance(q), sampled(knot.into(), q, 1000), 1e-14);
    }
    // The tip of a cusp, and points around it.
    let cusp = Cubic2::new(
        at(1.0, -1.0),
        at(-1.0 / 3.0, 1.0),
        at(-1.0 / 3.0, -1.0),
        at(1.0, 1.0),
    );
    for q in [
        at(0.0, 0.0),
        at(-1.0, 0.0),
        at(1e-8, 0.0),
        at(0.5, 0.0),
        at(-0.1, 1e-7),
    ] {
        near(cusp.distance(q), sampled(cusp.into(), q, 3001), 1e-13);
    }
    // Flat arcs of every flatness, whose centres are far away.
    for exponent in 0..40 {
        let bulge = 0.5_f64.powi(8 * exponent);
        let arc = Arc2::new(at(0.0, 0.0), at(2.0, 1.0), bulge);
        for t in [0.1, 0.37, 0.5, 0.99] {
            let normal = arc.derivative(t).perp().normalize_or_zero();
            for height in [0.0, 1e-3, -0.7] {
                let q = arc.point(t) + normal * height;
                near(arc.distance(q), f64::abs(height), 1e-14);
                near(arc.closest(q).parameter, t, 1e-14);
            }
        }
    }
    // Not a number: an end, without a panic.
    let place = quarter.closest(at(f64::NAN, 0.0));
    assert!(!place.is_inside && quarter.distance(at(f64::NAN, 0.0)).is_nan());
}

#[test]
fn a_path_is_as_near_as_its_nearest_piece() {
    let mut dice = Dice(8);
    for _ in 0..300 {
        let path = loop_of(&mut dice, 8);
        for _ in 0..10 {
            let q = target(&mut dice);
            let all = path.pieces().map(|piece| piece.distance(q));
            let least = all.fold(f64::INFINITY, f64::min);
            let place = path.closest(q).unwrap();
            assert_eq!(path.distance(q), Some(least));
            assert_eq!(path.piece(place.piece).unwrap().distance(q), least);
            let on = path.closest_replay(q, place);
            assert_eq!(on.distance(q), least);
        }
    }
}

/// The winding number of a ring of chords, by the sum of its angles.
fn turned(ring: &[Vec2<f64>], q: Vec2<f64>) -> f64 {
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    ends.map(|(&a, &b)| (a - q).angle_to(b - q)).sum::<f64>() / TAU
}

#[test]
fn winding_numbers_are_those_of_fine_chords() {
    if !geograd_tests::is_due("winding_numbers_are_those_of_fine_chords") {
        return;
    }
    let mut dice = Dice(9);
    let (mut counts, mut tried) = ([0; 3], 0);
    for round in 0..400 {
        let mut path = loop_of(&mut dice, 1 + round % 6);
        if round % 4 == 0 {
            // Open contours are closed by straight lines.
            path = path
                .move_to(target(&mut dice))
                .arc_to(target(&mut dice), 3.0);
        }
        let rings = path.flatten(1e-5).unwrap();
        for _ in 0..20 {
            let q = target(&mut dice);
            if path.distance(q).unwrap() < 1e-3 {
                continue;
            }
            let sum: f64 = rings.iter().map(|ring| turned(ring, q)).sum();
            // Chords of an open contour lack its last line's distance.
            if (sum - sum.round()).abs() > 1e-9 {
                continue;
            }
            assert_eq!(
                f64::from(path.winding_number(q)),
                sum.round(),
                "{path:?} {q:?}"
            );
            counts[sum.round().abs().min(2.0) as usize] += 1;
            tried += 1;
        }
    }
    assert!(
        tried > 6000 && counts.iter().all(|&count| count > 50),
        "{counts:?}"
    );
}

#[test]
fn points_next_to_a_circle_are_on_their_side() {
    let wheel = CurvePath::circle(Circle::new(at(0.3, -0.2), 2.0));
    let mut dice = Dice(10);
    for _ in 0..2000 {
        let (sin, cos) = f64::sin_cos(dice.within(0.0, TAU));
        let at_radius = |radius: f64| at(0.3, -0.2) + at(cos, sin) * radius;
        assert!(wheel.contains(at_radius(2.0 - 1e-14)) && !wheel.contains(at_radius(2.0 + 1e-14)));
    }
    // Level with joints and tops.
    for (q, expected) in [
        (at(-9.0, -0.2), 0),
        (at(-9.0, 1.8), 0),
        (at(0.3, -0.2), 1),
        (at(9.0, -0.2), 0),
        (at(-1.0, -0.2), 1),
    ] {
        assert_eq!(wheel.winding_number(q), expected);
    }
    assert_eq!(wheel.reversed().winding_number(at(0.3, -0.2)), -1);
}

#[test]
fn curves_of_a_few_roundings_are_soon_decided() {
    let unit = f64::EPSILON;
    let near_one = |x: f64, y: f64| at(1.0 + x * unit, 1.0 + y * unit);
    let tiny = [
        near_one(0.0, 0.0),
        near_one(1.0, 0.0),
        near_one(1.0, 1.0),
        near_one(0.0, 1.0),
    ];
    let path = CurvePath::at(tiny[0])
        .curve_to(tiny[1], tiny[2], tiny[3])
        .close();
    for x in -2..4 {
        for y in -2..4 {
            let q = near_one(f64::from(x), f64::from(y));
            assert!([0, 1].contains(&path.winding_number(q)));
            assert!(path.distance(q).unwrap() <= 8.0 * unit);
        }
    }
    // There and back over a point.
    let line = CurvePath::at(at(0.0, 0.0)).curve_to(at(3.0, 3.0), at(-2.0, -2.0), at(1.0, 1.0));
    assert_eq!(line.winding_number(at(0.5, 0.5)), 0);
    // A speed with a double zero inside, and one of nearly that.
    for shift in [0.0, 1e-9, 1e-17] {
        let cube = |u: f64, v: f64, w: f64| (u - 0.3) * (v - 0.3) * (w - 0.3);
        let blossom = |u, v, w| at(cube(u, v, w), 2.0 * cube(u, v, w) + shift * (u + v + w));
        let curve = Cubic2::new(
            blossom(0.0, 0.0, 0.0),
            blossom(0.0, 0.0, 1.0),
            blossom(0.0, 1.0, 1.0),
            blossom(1.0, 1.0, 1.0),
        );
        near(
            curve.length(),
            5.0_f64.sqrt() * (0.027 + 0.343),
            1e-8 + shift,
        );
    }
}

/// Compares a gradient with central differences, and a Hessian with those of the gradient.
fn check<X, F>(x: X, f: F, by: f64)
where
    X: Pack<Scalar = f64> + std::fmt::Debug,
    F: Fn(&X) -> (f64, X, Vec<f64>),
{
    let (_, slopes, second) = f(&x);
    let (all, step, count) = (x.scalars(), 1e-5, x.count());
    for k in 0..count {
        let moved = |by: f64| {
            let mut numbers = all.clone();
            numbers[k] += by;
            f(&x.refill(&numbers))
        };
        let (up, down) = (moved(step), moved(-step));
        let expected = (up.0 - down.0) / (2.0 * step);
        let found = slopes.scalars()[k];
        assert!(
            (found - expected).abs() <= by * (1.0 + expected.abs()),
            "{x:?} {k}: {found} {expected}"
        );
        if second.is_empty() {
            continue;
        }
        let (up, down) = (up.1.scalars(), down.1.scalars());
        for i in 0..count {
            let expected = (up[i] - down[i]) / (2.0 * step);
            let found = second[i * count + k];
            assert!(
                (found - expected).abs() <= 30.0 * by * (1.0 + expected.abs()),
                "{x:?} {i} {k}: {found} {expected}"
            );
        }
    }
}
/// A function of a piece and a point with its derivatives of both orders.
macro_rules! judged {
    ($f:expr) => {
        |x: &(CurvePiece<f64>, Vec2<f64>)| {
            let (value, slopes) = gradient($f, *x);
            let second = hessian($f, *x).2;
            let second = second
                .scalars()
                .iter()
                .flat_map(|row| row.scalars())
                .collect();
            (value, slopes, second)
        }
    };
}

fn length<S: Scalar<Mask = bool>>((piece, _): (CurvePiece<S>, Vec2<S>)) -> S {
    piece.length()
}
fn area<S: Scalar<Mask = bool>>((piece, _): (CurvePiece<S>, Vec2<S>)) -> S {
    piece.signed_area()
}
fn distance<S: Scalar<Mask = bool>>((piece, q): (CurvePiece<S>, Vec2<S>)) -> S {
    piece.distance(q)
}
fn near_x<S: Scalar<Mask = bool>>((piece, q): (CurvePiece<S>, Vec2<S>)) -> S {
    piece.closest_replay(q, piece.closest(q)).x
}
fn width<S: Scalar<Mask = bool>>((piece, _): (CurvePiece<S>, Vec2<S>)) -> S {
    let found = piece.bounding();
    found.max.x - found.min.x
}
fn spot<S: Scalar<Mask = bool>>((piece, q): (CurvePiece<S>, Vec2<S>)) -> S {
    piece.point(S::lit(0.3)).dot(q)
}

#[test]
fn derivatives_of_both_orders_are_those_of_differences() {
    if !geograd_tests::is_due("derivatives_of_both_orders_are_those_of_differences") {
        return;
    }
    let at_plane = |x, y| at(x, y);
    let pieces: [CurvePiece<f64>; 7] = [
        Quadratic2::new(at_plane(0.1, 0.0), at(1.0, 2.0), at(2.0, -0.3)).into(),
        // Its speed is nearly even.
        Quadratic2::new(at(0.1, 0.0), at(1.0, 0.2), at(2.0, 0.7)).into(),
        Cubic2::new(at(0.0, 0.1), at(0.2, 2.0), at(3.0, -1.5), at(2.0, 1.0)).into(),
        Cubic2::new(at(0.0, 0.0), at(4.0, 3.0), at(-3.0, 3.5), at(0.5, 0.0)).into(),
        Arc2::new(at(0.0, 0.1), at(2.0, 1.0), 0.1).into(),
        Arc2::new(at(0.0, 0.1), at(2.0, 1.0), -0.8).into(),
        Arc2::new(at(0.0, 0.1), at(2.0, 1.0), 2.5).into(),
    ];
    for piece in pieces {
        for q in [at(0.7, 1.1), at(1.3, -0.6), at(-2.0, 0.4)] {
            let x = (piece, q);
            check(x, judged!(length), 1e-8);
            check(x, judged!(area), 1e-8);
            check(x, judged!(distance), 1e-7);
            check(x, judged!(near_x), 1e-6);
            check(x, judged!(width), 1e-7);
            check(x, judged!(spot), 1e-8);
        }
    }
    // A straight arc has derivatives by its bulge.
    let flat = (
        CurvePiece::from(Arc2::new(at(0.0, 0.0), at(2.0, 0.0), 0.0)),
        at(0.5, 1.0),
    );
    check(flat, judged!(area), 1e-8);
    check(flat, judged!(length), 1e-8);
    check(flat, judged!(distance), 1e-7);
}

#[test]
fn a_gradient_by_a_path_is_a_path() {
    let mut dice = Dice(11);
    for _ in 0..20 {
        let path = loop_of(&mut dice, 3);
        let q = target(&mut dice);
        check(
            path.clone(),
            |path| {
                let (value, by) = gradient(|path: CurvePath<_>| path.signed_area(), path.clone());
                (value, by, vec![])
            },
            1e-8,
        );
        check(
            path.clone(),
            |path| {
                let (value, by) = gradient(|path: CurvePath<_>| path.length(), path.clone());
                (value, by, vec![])
            },
            1e-6,
        );
        let place = path.closest(q).unwrap();
        let lifted = |path: CurvePath<_>| path.distance_replay(q.lift(), place);
        let (value, by) = gradient(lifted, path.clone());
        assert_eq!(Some(value), path.distance(q));
        // Control points moved together, and the point with them, leave the distance.
        let by_point = gradient(|q| path.lift().distance_replay(q, place), q).1;
        let sum = by.elements().iter().fold(by_point, |sum, element| {
            let own = match *element {
                CurveElement::MoveTo(a) | CurveElement::LineTo(a) | CurveElement::ArcTo(a, _) => a,
                CurveElement::QuadTo(a, b) => a + b,
                CurveElement::CurveTo(a, b, c) => a + b + c,
                CurveElement::Close => Vec2::zero(),
            };
            sum + own
        });
        near(sum.length(), 0.0, 1e-12);
        near(by_point.length(), 1.0, 1e-12);
    }
}

#[test]
fn chords_have_the_derivatives_of_the_curve() {
    let wheel = |radius| CurvePath::circle(Circle::new(Vec2::zero(), radius));
    let counts = wheel(1.0_f64).chords(1e-3).unwrap();
    let (value, by_radius) = gradient(
        |radius| geograd::ring::signed_area(&wheel_of(radius).flattened(&counts)[0]),
        1.0_f64,
    );
    near(by_radius, 2.0 * value, 1e-14);
    fn wheel_of<S: Scalar<Mask = bool>>(radius: S) -> CurvePath<S> {
        CurvePath::circle(Circle::new(Vec2::zero(), radius))
    }
    assert_eq!(<Cubic2<f64> as Fixed>::name(3).as_str(), "points[1].y");
    assert_eq!(<Arc2<f64> as Fixed>::name(4).as_str(), "bulge");
}

#[test]
fn adjoints_are_the_gradients() {
    let mut dice = Dice(13);
    for round in 0..60 {
        let mut path = loop_of(&mut dice, 5);
        if round % 2 == 0 {
            path = path.line_to(target(&mut dice)).move_to(target(&mut dice));
            path = path.arc_to(target(&mut dice), -0.7);
        }
        let same = |a: &CurvePath<f64>, b: &CurvePath<f64>| {
            for (a, b) in a.scalars().into_iter().zip(b.scalars()) {
                near(a, b, 1e-12);
            }
        };
        let (length, by) = curve_bars::length_grad(&path);
        let (expected, by_duals) = gradient(|path: CurvePath<_>| path.length(), path.clone());
        near(length, expected, 1e-15);
        same(&by, &by_duals);
        let (area, by) = curve_bars::signed_area_grad(&path);
        let (expected, by_duals) = gradient(|path: CurvePath<_>| path.signed_area(), path.clone());
        near(area, expected, 1e-15);
        same(&by, &by_duals);
        let points = [(); 4].map(|()| target(&mut dice));
        let places = points.map(|point| path.closest(point).unwrap());
        let upstream = [1.0, -0.5, 2.0, 0.0];
        let (by, by_points) = curve_bars::distances_vjp(&path, &points, &places, &upstream);
        let sum = |(path, points): (CurvePath<_>, [Vec2<_>; 4])| {
            let each = (0..4)
                .map(|k| path.distance_replay(points[k], places[k]) * Scalar::lit(upstream[k]));
            each.reduce(|sum, one| sum + one).unwrap()
        };
        let (_, (by_path, by_all)) = gradient(sum, (path.clone(), points));
        same(&by, &by_path);
        for (a, b) in by_points.iter().zip(by_all) {
            near(a.distance(b), 0.0, 1e-13);
        }
    }
}

/// A path of many pieces of every kind, of several contours, some of them open.
fn long_path(dice: &mut Dice, pieces: usize, is_whole: bool) -> CurvePath<f64> {
    let mut place = at(0.0, 0.0);
    let mut next = |dice: &mut Dice| {
        let by = at(dice.within(-1.0, 1.2), dice.within(-1.0, 1.1));
        place += match is_whole {
            true => at(by.x.round(), by.y.round()),
            false => by,
        };
        place
    };
    let mut path = CurvePath::at(next(dice));
    for k in 0..pieces {
        path = match (k % 4, dice.within(0.0, 12.0) as usize) {
            (_, 0) => path.close(),
            (_, 1) => path.move_to(next(dice)),
            (0, _) => path.line_to(next(dice)),
            (1, _) => path.quad_to(next(dice), next(dice)),
            (2, _) => path.curve_to(next(dice), next(dice), next(dice)),
            _ => {
                let bulge = dice.within(-1.5, 1.5);
                path.arc_to(next(dice), if is_whole { bulge.round() } else { bulge })
            }
        };
    }
    path
}

#[test]
fn boxes_find_the_places_of_all_pieces_one_by_one() {
    let mut dice = Dice(31);
    for round in 0..60 {
        let pieces = [0, 1, 3, 4, 5, 17, 64, 300][round % 8];
        let path = long_path(&mut dice, pieces, round % 3 == 0);
        let boxes = CurveBoxes::of(&path);
        assert!(boxes.pieces().iter().copied().eq(path.pieces()));
        for k in 0..60 {
            let far = if k % 5 == 0 { 1e6 } else { 9.0 };
            let mut q = at(dice.within(-far, far), dice.within(-far, far));
            if k % 3 == 0 {
                q = at(q.x.round(), q.y.round());
            }
            let mut best: Option<(f64, usize, f64)> = None;
            for (number, piece) in path.pieces().enumerate() {
                let (place, found) = (piece.closest(q), piece.distance(q));
                if best.is_none_or(|(least, ..)| found < least) {
                    best = Some((found, number, place.parameter));
                }
            }
            let found = boxes.closest(q);
            assert_eq!(found, path.closest(q));
            // A replay may differ from the search by roundings, so that a piece nearly as near is named.
            if let (Some(place), Some((least, ..))) = (found, best) {
                near(
                    path.distance_replay(q, place),
                    least,
                    1e-14 * (1.0 + q.length()),
                );
            }
            assert_eq!(found.is_some(), best.is_some());
            assert_eq!(
                boxes.winding_number(q),
                path.winding_number(q),
                "{path:?} {q:?}"
            );
        }
    }
}

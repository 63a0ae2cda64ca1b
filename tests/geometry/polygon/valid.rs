//! Results of boolean operations that are valid by the OGC's rules, against an oracle.
use super::boolean::{OPERATIONS, cases};
use super::cases::{at, ring};
use super::rings::{made, moved, zeros};
use super::scanline::{self, Ring};
use super::simple::flaw;
use geograd::ad::adjoint::boolean::valid_vjp;
use geograd::boolean::{
    BooleanOperation, overlay_replay, overlay_search, valid, valid_replay, valid_search,
};
use geograd::polygon::{self, Fill};
use geograd::{Pack, Polygon, Scalar, Vec2};
use geograd_tests::Dice;

fn area(parts: &[Polygon<f64>]) -> f64 {
    parts.iter().map(polygon::signed_area).sum()
}

/// Every result is valid and covers what it should.
fn judge(a: &[Ring], b: &[Ring], fill: Fill, truth: [f64; 3], near: f64) {
    for (operation, kept) in OPERATIONS {
        let truth: f64 = (0..3).filter(|&i| kept[i]).map(|i| truth[i]).sum();
        let parts = valid(&made(a), &made(b), operation, fill).unwrap();
        assert_eq!(flaw(&parts), Ok(()), "{operation:?} {fill:?} {a:?} {b:?}");
        let found = area(&parts);
        assert!(
            (found - truth).abs() < near * (1.0 + truth),
            "{operation:?} {fill:?} {found} {truth} {a:?} {b:?}"
        );
    }
}

#[test]
fn results_are_valid() {
    if !geograd_tests::is_due("results_are_valid") {
        return;
    }
    let mut dice = Dice(5);
    for (k, (a, b)) in cases(&mut dice).into_iter().enumerate().skip(1).step_by(2) {
        let fill = [Fill::NonZero, Fill::EvenOdd][k / 2 % 2];
        judge(&a, &b, fill, scanline::areas(&a, &b, fill), 1e-12);
        // Turned, so that nothing is on a grid, edges along each other included; every third far away.
        let (sin, cos) = dice.within(0.0, 6.0).sin_cos();
        let turned = |rings: &[Ring]| -> Vec<Ring> {
            let place = |v: &Vec2<f64>| at(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
            rings
                .iter()
                .map(|ring| ring.iter().map(place).collect())
                .collect()
        };
        let (mut a, mut b, mut near) = (turned(&a), turned(&b), 1e-12);
        if k % 3 == 0 {
            let far = at(1e6, -1e6);
            (a, b, near) = (moved(&a, far, 1.0), moved(&b, far, 1.0), 1e-8);
        }
        judge(&a, &b, fill, scanline::areas(&a, &b, fill), near);
    }
}

/// Rings that touch each other and themselves: holes that cut a part in two, holes that touch in a corner.
#[test]
fn touching_rings_make_parts_and_holes() {
    let square = |x: f64, y: f64, size: f64| {
        ring(&[(x, y), (x + size, y), (x + size, y + size), (x, y + size)])
    };
    let parts = |a: &[Ring], b: &[Ring], operation| -> Vec<usize> {
        let parts = valid(&made(a), &made(b), operation, Fill::EvenOdd).unwrap();
        assert_eq!(flaw(&parts), Ok(()), "{parts:?}");
        parts.iter().map(|part| part.rings().count()).collect()
    };
    // The hole that is left between these touches the outer ring in two corners.
    let trapezoids = [
        ring(&[(150.0, 150.0), (410.0, 150.0), (280.0, 20.0), (20.0, 20.0)]),
        ring(&[(170.0, 120.0), (330.0, 120.0), (260.0, 50.0), (100.0, 50.0)]),
    ];
    let kite = [ring(&[
        (270.0, 90.0),
        (200.0, 50.0),
        (150.0, 80.0),
        (210.0, 120.0),
    ])];
    assert_eq!(parts(&trapezoids, &kite, BooleanOperation::Union), [2, 1]);
    // Two squares that touch in a corner, as parts and as holes.
    let both = [square(1.0, 1.0, 1.0), square(2.0, 2.0, 1.0)];
    let around = [square(0.0, 0.0, 4.0)];
    assert_eq!(parts(&both, &both, BooleanOperation::Union), [1, 1]);
    assert_eq!(parts(&around, &both, BooleanOperation::Difference), [3]);
    // Four squares around a fifth place, which is an island in the hole that they make.
    let four = [(1.0, 0.0), (0.0, 1.0), (2.0, 1.0), (1.0, 2.0)].map(|(x, y)| square(x, y, 1.0));
    let around = [square(-1.0, -1.0, 5.0)];
    assert_eq!(parts(&around, &four, BooleanOperation::Difference), [2, 1]);
    assert_eq!(parts(&four, &four, BooleanOperation::Union), [1; 4]);
    // Squares in squares.
    let nested = [5.0, 4.0, 3.0, 2.0].map(|half| square(-half, -half, 2.0 * half));
    assert_eq!(parts(&nested, &nested, BooleanOperation::Union), [2, 2]);
    // A part has an area.
    let a = [square(0.0, 0.0, 1.0)];
    assert!(parts(&a, &[square(1.0, 0.0, 1.0)], BooleanOperation::Intersection).is_empty());
    assert!(parts(&a, &a, BooleanOperation::Difference).is_empty());
}

/// In general position areas have the derivatives of the usual result, values are those of the record.
#[test]
fn derivatives_are_those_of_the_usual_result() {
    fn all<S: Scalar<Mask = bool>>(parts: &[Polygon<S>]) -> S {
        let areas = parts.iter().map(polygon::signed_area);
        areas.fold(S::zero(), |sum, area: S| sum + area)
    }
    let mut dice = Dice(6);
    let mut tried = 0;
    while tried < 20 {
        let mut star = || -> Vec<Ring> {
            let corner = |k: usize, dice: &mut Dice| {
                let (sin, cos) = (k as f64 * 0.9).sin_cos();
                at(cos, sin) * dice.within(0.5, 2.0)
            };
            vec![(0..7).map(|k| corner(k, &mut dice)).collect()]
        };
        let (a, b) = (made(&star()), made(&star()));
        for (operation, _) in OPERATIONS {
            let trace = valid_search(&a, &b, operation, Fill::NonZero).unwrap();
            let usual = overlay_search(&a, &b, operation, Fill::NonZero).unwrap();
            let both = || (a.clone(), b.clone());
            let of = |(a, b): (Polygon<_>, Polygon<_>)| all(&valid_replay(&a, &b, &trace));
            let (value, derivatives) = geograd::gradient(of, both());
            let parts = valid(&a, &b, operation, Fill::NonZero).unwrap();
            assert_eq!(value, area(&parts));
            let of = |(a, b): (Polygon<_>, Polygon<_>)| {
                polygon::signed_area(&overlay_replay(&a, &b, &usual))
            };
            let (near, expected) = geograd::gradient(of, both());
            assert!((value - near).abs() < 1e-13);
            for (found, expected) in derivatives.scalars().into_iter().zip(expected.scalars()) {
                assert!((found - expected).abs() < 1e-12, "{found} {expected}");
            }
        }
        tried += 1;
    }
}

/// Any function of the vertices of a valid result, by the adjoint and by duals.
#[test]
fn the_adjoint_is_that_of_the_replay() {
    if !geograd_tests::is_due("the_adjoint_is_that_of_the_replay") {
        return;
    }
    let mut dice = Dice(9);
    for (k, (a, b)) in cases(&mut dice).into_iter().enumerate() {
        let (a, b) = (made(&a), made(&b));
        let (operation, _) = OPERATIONS[k % 4];
        let trace = valid_search(&a, &b, operation, Fill::EvenOdd).unwrap();
        let weights: Vec<_> = (0..trace.vertex_count())
            .map(|_| at(dice.within(-1.0, 1.0), dice.within(-1.0, 1.0)))
            .collect();
        let of = |(a, b): (Polygon<_>, Polygon<_>)| {
            let parts = valid_replay(&a, &b, &trace);
            let vertices = parts.iter().flat_map(Polygon::vertices);
            vertices.zip(&weights).fold(Scalar::zero(), |sum, (v, w)| {
                sum + v.x * Scalar::lit(w.x) + v.y * Scalar::lit(w.y)
            })
        };
        let (_, expected) = geograd::gradient(of, (a.clone(), b.clone()));
        let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
        valid_vjp(&a, &b, &trace, &weights, &mut a_bar, &mut b_bar);
        let pairs = (a_bar, b_bar).scalars().into_iter().zip(expected.scalars());
        for (found, expected) in pairs {
            assert!(
                (found - expected).abs() < 1e-9 * (1.0 + expected.abs()),
                "{k} {operation:?} {found} {expected}"
            );
        }
    }
}

#[test]
fn single_precision_has_a_grid_of_its_own() {
    let mut dice = Dice(7);
    for (a, b) in cases(&mut dice).into_iter().step_by(3) {
        let narrow = |rings: &[Ring]| made(rings).remake(&mut |&x| x as f32);
        let parts = valid(
            &narrow(&a),
            &narrow(&b),
            BooleanOperation::Union,
            Fill::NonZero,
        )
        .unwrap();
        let wide: Vec<Polygon<f64>> = parts
            .iter()
            .map(|part| part.remake(&mut |&x| f64::from(x)))
            .collect();
        assert_eq!(flaw(&wide), Ok(()), "{a:?} {b:?}");
    }
}

/// Small rings near the origin beside a large one, turned, so that edges lie along each other but for many roundings.
#[test]
fn edges_along_each_other_but_for_rounding() {
    let mut dice = Dice(8);
    let large = ring(&[(3.0, 3.0), (4.0, 3.0), (4.0, 4.0), (3.0, 4.0)]);
    let mut parts_found = 0;
    for _ in 0..60 {
        let (sin, cos) = dice.within(0.0, 6.0).sin_cos();
        let size = 2f64.powi(-6 - dice.below(4) as i32);
        let turned = |ring: &[Vec2<f64>]| -> Ring {
            let place = |v: &Vec2<f64>| at(cos * v.x - sin * v.y, sin * v.x + cos * v.y) * size;
            ring.iter().map(place).collect()
        };
        let mut whole = |least: usize| -> Ring {
            let count = least + dice.below(5);
            (0..count)
                .map(|_| at(dice.below(5) as f64, dice.below(5) as f64))
                .collect()
        };
        let (first, second) = (whole(4), whole(4));
        let beside: Ring = first.iter().map(|&v| v + at(1.0, 0.0)).collect();
        let a = [turned(&first), turned(&second), large.clone()];
        let b = [turned(&beside), turned(&second)];
        if geograd::Rings::from(&a[..]).validate().is_err()
            || geograd::Rings::from(&b[..]).validate().is_err()
        {
            continue;
        }
        for (operation, _) in OPERATIONS {
            let parts = valid(&made(&a), &made(&b), operation, Fill::EvenOdd).unwrap();
            assert_eq!(flaw(&parts), Ok(()), "{operation:?} {a:?} {b:?}");
            parts_found += parts.len();
        }
    }
    assert!(parts_found > 500, "{parts_found}");
}

/// The oracle refuses polygons with flaws; the other tests rely on it.
#[test]
fn the_oracle_sees_every_kind_of_flaw() {
    let judge = |rings: &[&[(f64, f64)]]| {
        let rings: Vec<Ring> = rings.iter().map(|all| ring(all)).collect();
        flaw(&[made(&rings)])
    };
    let square: &[(f64, f64)] = &[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
    assert_eq!(judge(&[square]), Ok(()));
    let simple = Err("a ring meets itself");
    assert_eq!(
        judge(&[&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]]),
        simple
    );
    assert_eq!(
        judge(&[&[(0.0, 0.0), (4.0, 0.0), (2.0, 0.0), (1.0, 3.0)]]),
        simple
    );
    assert_eq!(
        judge(&[&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 0.0), (0.0, 4.0)]]),
        simple
    );
    let hole: &[(f64, f64)] = &[(0.0, 0.0), (1.0, 2.0), (2.0, 1.0)];
    assert_eq!(judge(&[square, hole]), Ok(()));
    let cut: &[(f64, f64)] = &[(0.0, 0.0), (1.0, 2.0), (4.0, 4.0), (2.0, 1.0)];
    assert_eq!(judge(&[square, cut]), Err("the inside is not connected"));
    let outside: &[(f64, f64)] = &[(5.0, 0.0), (6.0, 0.0), (6.0, 1.0)];
    assert_eq!(judge(&[square, outside]), Err("a hole is not inside"));
    let along: &[(f64, f64)] = &[(0.0, 1.0), (0.0, 3.0), (1.0, 2.0)];
    assert_eq!(
        judge(&[square, along]),
        Err("rings cross, or share a piece")
    );
    let one = made(&[ring(square)]);
    let other = made(&[ring(&[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0)])]);
    assert_eq!(flaw(&[one, other]), Err("parts overlap"));
}

//! First and second derivatives of distances of curved shapes, of their points and of their normal.
use super::curved_draw::{Body, Hull, frames};
use super::draw::Random;
use geograd::ad::{gradient, hessian};
use geograd::distance3::{closest_points, penetration, signed_distance};
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid, Pack};

fn inner(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// A list of a shape's numbers moved along another one.
fn moved<X: Pack<Scalar = f64>>(x: &X, along: &[f64], step: f64) -> X {
    let sum: Vec<f64> = x
        .scalars()
        .iter()
        .zip(along)
        .map(|(x, d)| x + d * step)
        .collect();
    x.refill(&sum)
}

/// Gradients against differences on both sides, second derivatives against differences of gradients.
macro_rules! slopes_all {
    ($($A:ident $B:ident),*) => { $({
        let told = stringify!($A $B);
        let mut random = Random(0x5555_1234_9e37_79b9);
        let (mut judged, mut curved) = (0, 0);
        for family in [0, 1, 7, 9] {
            for _ in 0..14 {
                let [first, second] = frames(&mut random, family);
                let x = ($A::<f64>::drawn(first), $B::<f64>::drawn(second));
                let slope = |x: ($A<f64>, $B<f64>)| gradient(|(a, b): ($A<_>, $B<_>)| signed_distance(a, b), x);
                let (here, by) = slope(x);
                let by = by.scalars();
                assert!(by.iter().all(|x| x.is_finite()), "{told} {x:?}");
                let count = by.len();
                let along: Vec<f64> = (0..count).map(|_| random.within(-1.0, 1.0)).collect();
                let found = inner(&by, &along);
                let f = |step: f64| { let (a, b) = moved(&x, &along, step); signed_distance(a, b) };
                let side = |step: f64| (f(step) - here) / step;
                let [ahead, back, ahead_less, back_less] = [1e-5, -1e-5, 2.5e-6, -2.5e-6].map(side);
                // No side of a size below zero, and no other piece within the steps.
                if family == 9 || (ahead - ahead_less).abs() + (back - back_less).abs() > 1e-3 {
                    continue;
                }
                judged += 1;
                let (low, high) = (ahead.min(back), ahead.max(back));
                assert!(found > low - 1e-3 && found < high + 1e-3, "{told} {found} {low} {high} {x:?}");
                // A small kink: the difference of both sides does not fall with the step.
                let jump = (4.0 * (ahead_less - back_less) - (ahead - back)) / 3.0;
                if (ahead - back).abs() > 1e-3 || jump.abs() > 1e-7 {
                    continue;
                }
                let central = (f(1e-5) - f(-1e-5)) / 2e-5;
                assert!((found - central).abs() < 1e-7, "{told} {found} {central} {x:?}");
                // Second derivatives along the direction.
                let (_, _, second) = hessian(|(a, b): ($A<_>, $B<_>)| signed_distance(a, b), x);
                let rows = second.scalars();
                let rows: Vec<Vec<f64>> = rows.iter().map(|row| row.scalars()).collect();
                let times: Vec<f64> = rows.iter().map(|row| inner(row, &along)).collect();
                assert!(times.iter().all(|x| x.is_finite()), "{told} {x:?}");
                let at = |step: f64| slope(moved(&x, &along, step)).1.scalars();
                let differences = |step: f64| -> Vec<f64> {
                    at(step).iter().zip(at(-step)).map(|(p, q)| (p - q) / (2.0 * step)).collect()
                };
                let (near, far) = (differences(1e-5), differences(4e-5));
                let largest = near.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                let smooth = near.iter().zip(&far).all(|(p, q)| (p - q).abs() < 1e-4 * largest);
                if !smooth || largest > 100.0 {
                    continue;
                }
                curved += 1;
                for (found, near) in times.iter().zip(&near) {
                    assert!((found - near).abs() < 2e-4 * largest, "{told} second {found} {near} {x:?}");
                }
            }
        }
        assert!(judged >= 25 && curved >= 15, "{told} {judged} {curved}");
    })* };
}

#[test]
fn first_and_second_derivatives_are_those_of_differences() {
    if !geograd_tests::is_due("first_and_second_derivatives_are_those_of_differences") {
        return;
    }
    slopes_all! {
        Ellipsoid Ellipsoid, Ellipsoid Cylinder, Ellipsoid Obb3, Ellipsoid Vec3, Cylinder Cylinder, Cylinder Cone,
        Cylinder Obb3, Cone Capsule3, Cone Disc, Disc Triangle3, Hull Ellipsoid, Hull Cylinder, Hull Cone, Hull Disc
    }
}

#[test]
fn the_normal_and_the_points_have_derivatives() {
    if !geograd_tests::is_due("the_normal_and_the_points_have_derivatives") {
        return;
    }
    let mut random = Random(0x1111_2222_3333_4445);
    let mut judged = 0;
    for family in [0, 1] {
        for _ in 0..30 {
            let [first, second] = frames(&mut random, family);
            let x = (
                Ellipsoid::<f64>::drawn(first),
                Cylinder::<f64>::drawn(second),
            );
            let weights: [f64; 9] = std::array::from_fn(|_| random.within(-1.0, 1.0));
            fn sum<S: Scalar<Mask = bool>>(
                (a, b): (Ellipsoid<S>, Cylinder<S>),
                weights: [f64; 9],
            ) -> S {
                let points = closest_points(a, b);
                let way = penetration(a, b).direction;
                let all = [points.on_a, points.on_b, way];
                let all = all.iter().flat_map(|v| [v.x, v.y, v.z]);
                all.zip(weights)
                    .fold(S::zero(), |sum, (x, w)| sum + x * S::lit(w))
            }
            let (_, by, second) = hessian(|x: (Ellipsoid<_>, Cylinder<_>)| sum(x, weights), x);
            let along: Vec<f64> = (0..by.count()).map(|_| random.within(-1.0, 1.0)).collect();
            let f = |step: f64| sum(moved(&x, &along, step), weights);
            let (near, far) = ((f(1e-5) - f(-1e-5)) / 2e-5, (f(4e-5) - f(-4e-5)) / 8e-5);
            if (near - far).abs() > 1e-6 {
                continue;
            }
            judged += 1;
            let found = inner(&by.scalars(), &along);
            assert!(
                (found - near).abs() < 1e-6 * (1.0 + near.abs()),
                "{found} {near} {x:?}"
            );
            let rows = second.scalars();
            let twice: f64 = rows
                .iter()
                .zip(&along)
                .map(|(row, d)| d * inner(&row.scalars(), &along))
                .sum();
            let second = |h: f64| (f(h) + f(-h) - 2.0 * f(0.0)) / (h * h);
            let bend = second(1e-3);
            if (bend - second(2e-3)).abs() < 1e-3 * (1.0 + bend.abs()) {
                assert!(
                    (twice - bend).abs() < 4e-3 * (1.0 + bend.abs()),
                    "{twice} {bend} {x:?}"
                );
            }
        }
    }
    assert!(judged > 30, "{judged}");
}

#[test]
fn cylinders_side_by_side_share_the_middle_of_their_overlap() {
    let up = |x: f64, low: f64, high: f64| {
        Cylinder::new(Vec3::new(x, 0.0, low), Vec3::new(x, 0.0, high), 1.0)
    };
    let (a, b) = (up(0.0, 0.0, 4.0), up(5.0, 3.0, 9.0));
    let points = closest_points(a, b);
    assert!(
        (points.on_a - Vec3::new(1.0, 0.0, 3.5)).length() < 1e-12,
        "{points:?}"
    );
    let (value, by) = gradient(
        |(a, b): (Cylinder<_>, Cylinder<_>)| signed_distance(a, b),
        (a, b),
    );
    assert!((value - 3.0).abs() < 1e-14);
    // The point at 3.5 of 0 to 4 belongs to the end by seven eighths.
    assert!(
        (by.0.end.x + 0.875).abs() < 1e-12 && (by.0.start.x + 0.125).abs() < 1e-12,
        "{by:?}"
    );
    assert!(
        (by.0.radius + 1.0).abs() < 1e-12 && (by.1.radius + 1.0).abs() < 1e-12,
        "{by:?}"
    );
}

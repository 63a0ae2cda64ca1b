//! Derivatives of distances of hulls: between one-sided differences, also where features tie, and second ones.
use super::draw::Random;
use super::hull_draw::{FAMILIES, pair};
use geograd::ad::gradient;
use geograd::distance3::{closest_points, distance, signed_distance};
use geograd::prelude::*;

type Pair<S> = (Hull3<S, 8>, Hull3<S, 8>);

fn drawn(random: &mut Random, family: usize) -> Pair<f64> {
    let [a, b] = pair(random, family).map(|all| {
        let vertices: Vec<_> = all.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect();
        Hull3::from_vertices(&vertices)
    });
    (a, b)
}

/// A random direction of all numbers, or of a move of the second hull.
fn direction(random: &mut Random, x: &Pair<f64>) -> Pair<f64> {
    let (mut a, mut b) = *x;
    match random.below(3) {
        0 => {
            a.vertices = [(); 8].map(|()| random.vector(1.0));
            b.vertices = [(); 8].map(|()| random.vector(1.0));
        }
        1 => {
            let shift = random.vector(1.0);
            a.vertices = [Vec3::zero(); 8];
            b.vertices = [shift; 8];
        }
        _ => {
            let turn = random.vector(1.0);
            a.vertices = [Vec3::zero(); 8];
            b.vertices = b.vertices.map(|v| turn.cross(v));
        }
    }
    (a, b)
}

fn moved((a, b): &Pair<f64>, along: &Pair<f64>, step: f64) -> Pair<f64> {
    let sum = |x: &Hull3<f64, 8>, d: &Hull3<f64, 8>| Hull3 {
        vertices: std::array::from_fn(|k| x.vertices[k] + d.vertices[k] * step),
        ..*x
    };
    (sum(a, &along.0), sum(b, &along.1))
}

fn inner(x: &Pair<f64>, y: &Pair<f64>) -> f64 {
    x.scalars()
        .iter()
        .zip(y.scalars())
        .map(|(x, y)| x * y)
        .sum()
}

#[test]
fn first_derivatives_are_between_one_sided_differences() {
    let mut random = Random(0x7f4a_7c15_9e37_79b9);
    // Identical ones have so many ties, some of which are left out, that slopes of both sides bound none.
    for family in [0, 1, 2, 8] {
        let (mut judged, mut rough) = (0, 0);
        for _ in 0..120 {
            let x = drawn(&mut random, family);
            let along = direction(&mut random, &x);
            let f = |(a, b): Pair<f64>| signed_distance(a, b);
            let (here, slope) = gradient(|(a, b)| signed_distance(a, b), x);
            let found = inner(&slope, &along);
            assert!(found.is_finite(), "{x:?}");
            // A kink is within the steps.
            if here != 0.0 && here.abs() < 1e-4 {
                continue;
            }
            let side = |step: f64| (f(moved(&x, &along, step)) - here) / step;
            let [ahead, back, ahead_less, back_less] = [1e-5, -1e-5, 2.5e-6, -2.5e-6].map(side);
            // Another feature within the step.
            if (ahead - ahead_less).abs() + (back - back_less).abs() > 1e-3 {
                rough += 1;
                continue;
            }
            judged += 1;
            let (low, high) = (ahead_less.min(back_less), ahead_less.max(back_less));
            assert!(
                low - 1e-3 < found && found < high + 1e-3,
                "{}: {found} {low} {high} at {here:e} {x:?} {along:?}",
                FAMILIES[family]
            );
        }
        assert!(judged > rough, "{}: {judged} {rough}", FAMILIES[family]);
    }
}

#[test]
fn second_derivatives_are_those_of_first_ones() {
    let mut random = Random(0x1357_9bdf_0246_8ace);
    let (mut judged, mut rough) = (0, 0);
    for _ in 0..150 {
        let x = drawn(&mut random, 0);
        let along = direction(&mut random, &x);
        let slope = |x: Pair<f64>| gradient(|(a, b)| signed_distance(a, b), x).1;
        let difference = |step: f64| -> Vec<f64> {
            let (ahead, back) = (
                slope(moved(&x, &along, step)),
                slope(moved(&x, &along, -step)),
            );
            let pairs = ahead.scalars().into_iter().zip(back.scalars());
            pairs
                .map(|(ahead, back)| (ahead - back) / (2.0 * step))
                .collect()
        };
        let (large, small) = (difference(2e-5), difference(5e-6));
        let size = small.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let apart = |a: &[f64], b: &[f64]| {
            let all = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            all.fold(0.0, f64::max)
        };
        if apart(&large, &small) > 1e-5 * size {
            rough += 1;
            continue;
        }
        judged += 1;
        let bend = geograd::hvp(|(a, b)| signed_distance(a, b), x, along)
            .2
            .scalars();
        assert!(
            apart(&bend, &small) < 1e-5 * size,
            "{} {x:?} {along:?}",
            apart(&bend, &small)
        );
    }
    assert!(judged > 3 * rough, "{judged} {rough}");
}

#[test]
fn a_box_on_a_table_shares_the_slope_of_the_corners_of_the_overlap() {
    let cube = |center: Vec3<f64>, size: Vec3<f64>| Obb3::new(center, size, Rotation3::identity());
    let table = cube(Vec3::zero(), Vec3::new(4.0, 4.0, 1.0));
    for height in [1.0, 1.2, 0.9] {
        let on_it = Hull3::from(cube(
            Vec3::new(0.75, 0.25, height),
            Vec3::new(1.0, 1.0, 1.0),
        ));
        let turned = |x: Vec3<f64>| {
            let turn = Pose3::new(Vec3::zero(), Rotation3::from_rotation_vector(x));
            signed_distance(turn * Hull3::from(table), on_it)
        };
        assert!((turned(Vec3::zero()) - (height - 1.0)).abs() < 1e-15);
        let slope = |x: Vec3<_>| {
            let turn = Pose3::new(Vec3::zero(), Rotation3::from_rotation_vector(x));
            signed_distance(turn * Hull3::from(table).lift(), on_it.lift())
        };
        let (_, slope) = gradient(slope, Vec3::zero());
        assert!(
            (slope - Vec3::new(-0.25, 0.75, 0.0)).length() < 1e-14,
            "{height} {slope:?}"
        );
    }
}

#[test]
fn batches_have_the_bits_of_methods() {
    let mut random = Random(0x0246_8ace_1357_9bdf);
    let (a, b): (Vec<_>, Vec<_>) = (0..60)
        .map(|k| drawn(&mut random, k % FAMILIES.len()))
        .unzip();
    let cpu = Cpu::new();
    let all = a.iter().zip(&b);
    let found = cpu.aligned(SignedDistance, (&a, &b)).unwrap();
    assert!(
        all.clone()
            .zip(found)
            .all(|((&a, &b), found)| a.signed_distance(b) == found)
    );
    let (_, slopes) = cpu.aligned(SignedDistance.value_grad(), (&a, &b)).unwrap();
    for ((&a, &b), by) in all.clone().zip(slopes.0.iter().zip(&slopes.1)) {
        let (_, slope) = gradient(|(a, b)| signed_distance(a, b), (a, b));
        let apart = slope.scalars().into_iter().zip((*by.0, *by.1).scalars());
        let most = apart.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(most < 1e-12, "{most} {slope:?} {by:?}");
    }
    let found = cpu.aligned(Distance, (&a, &b)).unwrap();
    assert!(
        all.clone()
            .zip(found)
            .all(|((&a, &b), found)| distance(a, b) == found)
    );
    let found = cpu.aligned(ClosestPoints, (&a, &b)).unwrap();
    assert!(
        all.clone()
            .zip(found)
            .all(|((&a, &b), found)| closest_points(a, b) == found)
    );
}

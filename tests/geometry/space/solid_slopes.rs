//! Derivatives of volumes that bodies share: between one-sided differences, second ones, and identities.
use super::draw::Random;
use super::hull_draw::{FAMILIES, pair};
use geograd::ad::gradient;
use geograd::prelude::*;

type Pair<S> = (Hull3<S, 8>, Hull3<S, 8>);

fn drawn(random: &mut Random, family: usize) -> Pair<f64> {
    let [a, b] = pair(random, family).map(|all| {
        let vertices: Vec<_> = all.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect();
        Hull3::from_vertices(&vertices)
    });
    (a, b)
}

/// A random direction of all vertices, or of a move or turn of the second hull.
fn direction(random: &mut Random, x: &Pair<f64>) -> Pair<f64> {
    let (mut a, mut b) = *x;
    let kind = random.below(3);
    let shift = random.vector(1.0);
    for k in 0..8 {
        let own = random.vector(1.0);
        (a.vertices[k], b.vertices[k]) = match kind {
            0 => (random.vector(1.0), own),
            1 => (Vec3::zero(), shift),
            _ => (Vec3::zero(), shift.cross(b.vertices[k])),
        };
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
    let pairs = x.scalars().into_iter().zip(y.scalars());
    pairs.map(|(x, y)| x * y).sum()
}

fn volume<S: geograd::Scalar<Mask = bool>>((a, b): Pair<S>) -> S {
    a.intersection_volume(b)
}

#[test]
fn first_derivatives_are_between_one_sided_differences() {
    let mut random = Random(0x7f4a_7c15_9e37_79b9);
    // Nearly identical ones have so many kinks at once that slopes of both sides bound no sum of shares.
    for family in [0, 1, 2] {
        let (mut judged, mut kinks) = (0, 0);
        for _ in 0..400 {
            let x = drawn(&mut random, family);
            let along = direction(&mut random, &x);
            if volume(x) == 0.0 {
                continue;
            }
            let (here, slope) = gradient(volume, x);
            let found = inner(&slope, &along);
            assert!(found.is_finite(), "{x:?}");
            let side = |step: f64| (volume(moved(&x, &along, step)) - here) / step;
            let steps = [1e-5, -1e-5, 2.5e-6, -2.5e-6];
            let [ahead, back, ahead_less, back_less] = steps.map(side);
            // Bent, or a kink within the step.
            if (ahead - ahead_less).abs() + (back - back_less).abs() > 2e-4 {
                continue;
            }
            judged += 1;
            kinks += usize::from((ahead_less - back_less).abs() > 1e-2);
            let (low, high) = (ahead_less.min(back_less), ahead_less.max(back_less));
            assert!(
                low - 3e-4 < found && found < high + 3e-4,
                "{}: {found} {low} {high} at {here:e} {x:?} {along:?}",
                FAMILIES[family]
            );
        }
        println!("{}: {judged} {kinks}", FAMILIES[family]);
        assert!(judged > 10, "{}: {judged}", FAMILIES[family]);
    }
}

#[test]
fn moves_of_both_change_nothing() {
    let mut random = Random(0x0f1e_2d3c_4b5a_6978);
    for family in [0, 1, 2, 3, 4, 5, 6, 7, 11, 12] {
        for _ in 0..60 {
            let x = drawn(&mut random, family);
            let (_, (a, b)) = gradient(volume, x);
            let (mut force, mut torque) = (Vec3::zero(), Vec3::zero());
            let all = a.vertices.iter().zip(&x.0.vertices);
            for (&slope, &at) in all.chain(b.vertices.iter().zip(&x.1.vertices)) {
                force += slope;
                torque += at.cross(slope);
            }
            assert!(
                force.length() < 1e-13 && torque.length() < 1e-12,
                "{}: {force:?} {torque:?} {x:?}",
                FAMILIES[family]
            );
        }
    }
}

#[test]
fn second_derivatives_are_those_of_first_ones() {
    if !geograd_tests::is_due("second_derivatives_are_those_of_first_ones") {
        return;
    }
    let mut random = Random(0x1357_9bdf_0246_8ace);
    let (mut judged, mut rough) = (0, 0);
    for _ in 0..200 {
        // No four vertices in a plane, where no second derivative is.
        let mut hull = || Hull3::from([(); 8].map(|()| random.vector(1.0)));
        let x = (hull(), hull());
        let along = direction(&mut random, &x);
        if volume(x) == 0.0 {
            continue;
        }
        let slope = |x: Pair<f64>| gradient(volume, x).1.scalars();
        let difference = |step: f64| -> Vec<f64> {
            let ahead = slope(moved(&x, &along, step));
            let back = slope(moved(&x, &along, -step));
            let pairs = ahead.into_iter().zip(back);
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
        let bend = geograd::hvp(volume, x, along).2.scalars();
        assert!(
            apart(&bend, &small) < 1e-5 * size,
            "{} {x:?}",
            apart(&bend, &small)
        );
    }
    println!("{judged} {rough}");
    assert!(judged > 20 && judged > 3 * rough, "{judged} {rough}");
}

#[test]
fn second_derivatives_by_poses_are_those_of_boxes() {
    let mut random = Random(0x0bad_5eed_1234_5678);
    let mut judged = 0;
    for _ in 0..60 {
        let mut cube = || {
            let [x, y, z] = [(); 3].map(|()| random.within(0.5, 1.5));
            let turn = random.vector(1.0);
            let turn = Rotation3::new(1.0, turn.x, turn.y, turn.z);
            Obb3::new(random.vector(0.4), Vec3::new(x, y, z), turn)
        };
        let (a, b) = (cube(), cube());
        let turn = random.vector(1.0);
        let turn = Rotation3::new(0.0, turn.x, turn.y, turn.z);
        let along = Obb3::new(random.vector(1.0), random.vector(0.5), turn);
        let by_box = |a: Obb3<_>| a.intersection_volume(b.lift());
        let by_hull = |a: Obb3<_>| a.intersection_volume(Hull3::from(b).lift());
        let (value, slope, bend) = geograd::hvp(by_box, a, along);
        let found = geograd::hvp(by_hull, a, along);
        judged += usize::from(value > 0.0);
        assert!((found.0 - value).abs() < 1e-14);
        let apart = |a: &Obb3<f64>, b: &Obb3<f64>| {
            let pairs = a.scalars().into_iter().zip(b.scalars());
            pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
        };
        assert!(apart(&slope, &found.1) < 1e-12, "{slope:?} {:?}", found.1);
        assert!(apart(&bend, &found.2) < 1e-9, "{bend:?} {:?}", found.2);
    }
    assert!(judged > 40, "{judged}");
}

#[test]
fn a_depth_of_immersion_has_the_slope_of_the_section() {
    let [x, y, z] = [
        Vec3::new(2.0, 0.0, 0.0),
        Vec3::new(0.0, 2.0, 0.0),
        Vec3::new(0.0, 0.0, 2.0),
    ];
    let wedge: Hull3<f64, 4> = Hull3::from_vertices(&[Vec3::zero(), x, y, z]);
    let at = |level| Plane3::new(Vec3::new(0.0, 0.0, 4.0), level);
    let of = |plane: Plane3<_>| wedge.lift().intersection_volume(plane);
    let (volume, slope) = gradient(of, at(2.0));
    // Half as high: a pyramid of an eighth is missing. The section is a triangle of sides 1.5, moved by a quarter.
    assert!((volume - 4.0 / 3.0 * (1.0 - 0.75_f64.powi(3))).abs() < 1e-15);
    assert!((slope.offset - 1.125 / 4.0).abs() < 1e-15);
    let area = wedge.intersection_area(at(2.0));
    assert!((area - 1.125).abs() < 1e-15);
    let (_, by) = gradient(
        |plane: Plane3<_>| wedge.lift().intersection_area(plane),
        at(2.0),
    );
    assert!((by.offset + 1.5 / 4.0).abs() < 1e-15, "{by:?}");
}

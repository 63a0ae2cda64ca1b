//! Unions of one polygon with nothing: rings in general position are walked, others overlaid, with one result.
use super::cases::{any_ring, at, hard_rings, ring, star, stars};
use super::rings::{made, moved, zeros};
use super::simple::flaw;
use geograd::ad::adjoint::boolean::overlay_vjp;
use geograd::ad::adjoint::ring::signed_area_vjp;
use geograd::boolean::{BooleanOperation, Origin, overlay_replay, overlay_search, valid};
use geograd::polygon::{self, Fill};
use geograd::{Pack, Polygon, Vec2};
use geograd_tests::Dice;

const UNION: BooleanOperation = BooleanOperation::Union;

fn near(found: f64, expected: f64, by: f64) {
    assert!(
        (found - expected).abs() <= by * (1.0 + expected.abs()),
        "{found} {expected}"
    );
}

/// Area, perimeter, counts of parts, rings and vertices, and the slopes of the area, of a union with a square: a far one
/// makes it an overlay, of which it has the area and the perimeter more.
fn measures(rings: &Polygon<f64>, other: &Polygon<f64>, fill: Fill) -> (Vec<f64>, Vec<f64>) {
    let trace = overlay_search(rings, other, UNION, fill).unwrap();
    let shape = overlay_replay(rings, other, &trace);
    let mut bars = Vec::new();
    for ring in shape.rings().iter() {
        let mut own = vec![Vec2::zero(); ring.len()];
        signed_area_vjp(ring, 1.0, &mut own);
        bars.extend(own);
    }
    let (mut a_bar, mut b_bar) = (zeros(rings), zeros(other));
    overlay_vjp(rings, other, &trace, &bars, &mut a_bar, &mut b_bar);
    let crossed = trace
        .origins()
        .filter(|of| matches!(of, [Origin::Cross(..)]));
    let counts = [
        trace.parts().count(),
        trace.ends().len(),
        trace.vertex_count(),
        crossed.count(),
    ];
    let mut all = vec![polygon::signed_area(&shape), polygon::perimeter(&shape)];
    all.extend(counts.map(|count| count as f64));
    (all, a_bar.scalars())
}

#[test]
fn walks_give_what_overlays_give() {
    if !geograd_tests::is_due("walks_give_what_overlays_give") {
        return;
    }
    let mut dice = Dice(180);
    let far = made(&[ring(&[(20., 0.), (21., 0.), (21., 1.), (20., 1.)])]);
    let nothing = Polygon::new();
    let mut counts = [0; 3];
    for k in 0..400 {
        let rings = match k % 4 {
            0 => stars(&mut dice),
            1 => vec![any_ring(&mut dice, 12), any_ring(&mut dice, 5)],
            // Many crossings: a star whose rays are not in order.
            2 => {
                let mut own = star(&mut dice, at(0.0, 0.0), 11, 0.5, 3.0);
                let step = 2 + dice.below(3);
                own = (0..11).map(|i| own[i * step % 11]).collect();
                vec![own]
            }
            // Rings within rings, of any orientation.
            _ => {
                let nested = |scale: f64, dice: &mut Dice| {
                    let mut own = star(dice, at(0.0, 0.0), 7, 0.8 * scale, scale);
                    if dice.below(2) == 0 {
                        own.reverse();
                    }
                    own
                };
                let mut all: Vec<_> = [1.0, 2.0, 4.0, 8.0]
                    .into_iter()
                    .map(|scale| nested(scale, &mut dice))
                    .collect();
                all.extend(moved(&[all[0].clone()], at(2.6, 2.8), 0.2));
                all
            }
        };
        let rings = made(&rings);
        if rings.rings().validate().is_err() {
            continue;
        }
        for fill in [Fill::NonZero, Fill::EvenOdd] {
            let (found, by) = measures(&rings, &nothing, fill);
            let (mut expected, expected_by) = measures(&rings, &far, fill);
            for (sum, own) in expected.iter_mut().zip([1.0, 4.0, 1.0, 1.0, 4.0, 0.0]) {
                *sum -= own;
            }
            near(found[0], expected[0], 1e-12);
            near(found[1], expected[1], 1e-11);
            assert_eq!(found[2..], expected[2..], "{rings:?}");
            for (found, expected) in by.iter().zip(expected_by) {
                near(*found, expected, 1e-9);
            }
            let parts = valid(&rings, &nothing, UNION, fill).unwrap();
            assert_eq!(flaw(&parts), Ok(()), "{rings:?}");
            let sum: f64 = parts.iter().map(polygon::signed_area).sum();
            near(sum, found[0], 1e-12);
            counts[0] += 1;
            counts[1] += usize::from(found[3] > 1.0);
            counts[2] += usize::from(found[5] > 0.0);
        }
    }
    assert!(
        counts[0] > 600 && counts[1] > 150 && counts[2] > 300,
        "{counts:?}"
    );
}

#[test]
fn hard_rings_are_left_to_the_overlay() {
    let nothing = Polygon::new();
    let far = made(&[ring(&[(40., 0.), (41., 0.), (41., 1.), (40., 1.)])]);
    for rings in hard_rings() {
        let rings = made(&rings);
        if rings.rings().validate().is_err() {
            continue;
        }
        for fill in [Fill::NonZero, Fill::EvenOdd] {
            let (found, by) = measures(&rings, &nothing, fill);
            let (expected, expected_by) = measures(&rings, &far, fill);
            near(found[0], expected[0] - 1.0, 1e-12);
            for (found, expected) in by.iter().zip(expected_by) {
                near(*found, expected, 1e-9);
            }
        }
    }
    // Corners that touch an edge from inside or outside, by less and less.
    for depth in [1e-3_f64, 1e-9, 1e-12, 1e-15, 0.0] {
        for sign in [1.0, -1.0] {
            let tip = 2.0 + sign * depth;
            let one = made(&[
                ring(&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]),
                ring(&[(tip, 1.), (3., 0.5), (3., 1.5)]),
            ]);
            let (found, _) = measures(&one, &nothing, Fill::NonZero);
            near(found[0], 4.5 - 0.5 * sign * depth, depth * depth + 1e-14);
        }
    }
}

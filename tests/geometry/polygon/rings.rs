//! Polygons with holes: what they measure, and how much they overlap.
use super::cases::{at, hard_rings, ring, stars};
use super::scanline::{self, Ring};
use geograd::ad::adjoint::overlap_rings::{
    intersection_area_vjp, iof_vjp, iou_vjp, union_area_vjp,
};
use geograd::contain::Location;
use geograd::error::{Flaw, VertexFault};
use geograd::overlap_polygon::holed::{intersection_area, iof, iou, union_area};
use geograd::polygon::{self, Fill, Sides, Slabs};
use geograd::{Aabb2, Pack, Polygon, Rings, Vec2};
use geograd_tests::Dice;

pub fn made(rings: &[Ring]) -> Polygon<f64> {
    Polygon::from_rings(rings.iter().map(Vec::as_slice))
}

pub fn moved(rings: &[Ring], by: Vec2<f64>, scale: f64) -> Vec<Ring> {
    let ring = |ring: &Ring| ring.iter().map(|&v| v * scale + by).collect();
    rings.iter().map(ring).collect()
}

/// Central differences by every coordinate of both polygons.
pub fn differences(
    f: impl Fn(&Polygon<f64>, &Polygon<f64>) -> f64,
    a: &Polygon<f64>,
    b: &Polygon<f64>,
    step: f64,
) -> Vec<f64> {
    let all = (a.clone(), b.clone());
    let start = all.scalars();
    let at = |k: usize, by: f64| {
        let mut numbers = start.clone();
        numbers[k] += by;
        let (a, b) = all.refill(&numbers);
        f(&a, &b)
    };
    (0..start.len())
        .map(|k| (at(k, step) - at(k, -step)) / (2.0 * step))
        .collect()
}

pub fn zeros(a: &Polygon<f64>) -> Vec<Vec2<f64>> {
    vec![Vec2::new(0.0, 0.0); a.vertices().len()]
}

#[test]
fn slabs_locate_as_rings_do() {
    let mut dice = Dice(3);
    let mut all = hard_rings();
    all.extend((0..40).map(|_| {
        let count = 1 + dice.below(4);
        let vertex = |dice: &mut Dice| at(dice.within(-4.0, 9.0).round(), dice.within(-4.0, 9.0));
        (0..count)
            .map(|_| (0..dice.below(60)).map(|_| vertex(&mut dice)).collect())
            .collect()
    }));
    // Flat ones, which have no height, and tall ones, of which every edge is in every slab.
    all.push(vec![ring(&[(0., 1.), (3., 1.), (1., 1.)])]);
    let zigzag = |k: usize| at(k as f64 / 8.0, if k.is_multiple_of(2) { -4.0 } else { 9.0 });
    all.push(vec![(0..100).map(zigzag).collect()]);
    all.push(vec![ring(&[(0., -1e308), (1., 1e308), (-1., 1e308)])]);
    all.push(Vec::new());
    let mut seen = [0; 3];
    for rings in &all {
        let own = made(rings);
        let slabs = Slabs::of(Rings::from(&own));
        let mut points: Vec<Vec2<f64>> = rings.concat();
        points.extend(
            rings
                .iter()
                .flat_map(|ring| ring.windows(2))
                .map(|e| (e[0] + e[1]) * 0.5),
        );
        let more = |_| at(dice.within(-5.0, 10.0), dice.within(-5.0, 10.0));
        points.extend((0..60).map(more));
        points.extend((0..40).map(|k| at(f64::from(k) * 0.5 - 5.0, 1.0)));
        for point in points {
            let known = Rings::from(&own).locate(point);
            assert_eq!(slabs.locate(point), known, "{point:?} {rings:?}");
            for fill in [Fill::NonZero, Fill::EvenOdd] {
                assert_eq!(
                    slabs.contains(point, fill),
                    Rings::from(&own).contains(point, fill)
                );
            }
            seen[match known {
                Location::Border => 0,
                Location::Off(0) => 1,
                Location::Off(_) => 2,
            }] += 1;
        }
    }
    assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
}

#[test]
fn flaws_name_ring_and_vertex() {
    let good = ring(&[(0., 0.), (4., 0.), (0., 4.)]);
    let nan = ring(&[(1., 1.), (2., 1.), (1., f64::NAN)]);
    let flat = ring(&[(1., 1.), (2., 1.), (1., 1.), (2., 1.)]);
    for (bad, index, fault, text) in [
        (
            nan,
            2,
            VertexFault::NotFinite,
            "ring 1: vertex 2 has a coordinate that is not a finite number",
        ),
        (
            flat,
            2,
            VertexFault::Coincident,
            "ring 1: vertex 2 is at the place of an earlier one, and the ring has fewer than three places",
        ),
        (
            vec![],
            0,
            VertexFault::Missing,
            "ring 1: vertex 0 is missing",
        ),
    ] {
        let flaw = Polygon::try_from_rings([&good[..], &bad]).unwrap_err();
        assert_eq!(
            flaw,
            Flaw::Ring {
                ring: 1,
                index,
                fault
            }
        );
        assert_eq!(flaw.to_string(), text);
        assert_eq!(flaw.field().as_str(), format!("rings[1][{index}]"));
    }
    assert!(Polygon::try_from_rings([&good[..], &good]).is_ok());
}

#[test]
fn views_are_the_same_whatever_they_look_at() {
    let rings = vec![
        ring(&[(0., 0.), (4., 0.), (0., 4.)]),
        ring(&[(1., 1.), (2., 1.), (1., 2.)]),
    ];
    let slices: Vec<&[Vec2<f64>]> = rings.iter().map(Vec::as_slice).collect();
    let owned = made(&rings);
    for view in [
        Rings::from(&rings[..]),
        Rings::from(&slices[..]),
        (&owned).into(),
    ] {
        assert_eq!((view.count(), view.vertex_count()), (2, 6));
        assert_eq!(
            (view.ring(0), view.ring(1), view.ring(2)),
            (&rings[0][..], &rings[1][..], &[][..])
        );
    }
    // Ends that make no sense.
    let view = Rings::flat(&rings[0], &[2, 1, 9]);
    assert_eq!(
        (view.ring(0).len(), view.ring(1).len(), view.ring(2).len()),
        (2, 0, 2)
    );
}

#[test]
fn measures_are_those_of_the_oracle() {
    let mut dice = Dice(1);
    let random = (0..60).map(|_| stars(&mut dice));
    for rings in random.chain(hard_rings()) {
        let [truth, ..] = scanline::areas(&rings, &[], Fill::EvenOdd);
        let size = 64.0 * 1e-14;
        assert!(
            (polygon::area(&rings[..]) - truth).abs() < size,
            "{rings:?}"
        );
        let parts: f64 = rings.iter().map(|r| geograd::ring::perimeter(r)).sum();
        assert!((polygon::perimeter(&rings[..]) - parts).abs() < 1e-13);
        if truth < 0.1 {
            continue;
        }
        // A measure of one ring less those of its holes: by the counter-clockwise rings they make.
        let sides = Sides::decided(&rings[..]);
        let (mut x, mut y, mut xx) = (0.0, 0.0, 0.0);
        let middle = polygon::centroid(&rings[..]);
        for (k, ring) in rings.iter().enumerate() {
            let sign = if sides.is_turned(k) { -1.0 } else { 1.0 };
            let (area, at) = (
                sign * geograd::ring::signed_area(ring),
                geograd::ring::centroid(ring),
            );
            let own = geograd::measure::moments::second_moments(&[&ring[..]]).xx * sign;
            (x, y) = (x + area * at.x, y + area * at.y);
            xx += own + area * (at.x - middle.x).powi(2);
        }
        assert!(
            middle.distance(at(x / truth, y / truth)) < 1e-12,
            "{rings:?}"
        );
        let moments = polygon::second_moments(&rings[..]);
        assert!((moments.xx - xx).abs() < 1e-11, "{} {xx}", moments.xx);
        // Far away all is the same.
        let far = moved(&rings, at(1e6, -2e6), 1.0);
        assert!((polygon::area(&far[..]) - truth).abs() < 1e-8);
        assert!((polygon::centroid(&far[..]) - at(1e6, -2e6)).distance(middle) < 1e-7);
    }
    assert_eq!(polygon::area::<f64>(&[] as &[&[Vec2<f64>]]), 0.0);
    assert_eq!(
        polygon::centroid::<f64>(&[] as &[&[Vec2<f64>]]),
        Vec2::new(0.0, 0.0)
    );
}

#[test]
fn derivatives_of_measures_are_their_differences() {
    let mut dice = Dice(2);
    let (nothing, measures): (
        _,
        [fn(&Polygon<geograd::Jet<f64, 1>>) -> geograd::Jet<f64, 1>; 5],
    ) = (
        Polygon::new(),
        [
            |p| polygon::area(p),
            |p| polygon::perimeter(p),
            |p| polygon::centroid(p).x,
            |p| polygon::second_moments(p).xy,
            |p| {
                p.rings().depth(
                    Vec2::new(
                        geograd::Jet {
                            value: 0.3,
                            derivative: [0.0],
                        },
                        geograd::Jet {
                            value: 0.1,
                            derivative: [0.0],
                        },
                    ),
                    Fill::EvenOdd,
                )
            },
        ],
    );
    for _ in 0..10 {
        let a = made(&stars(&mut dice));
        for f in measures {
            let along = |k: usize, p: &Polygon<f64>| {
                let mut next = 0;
                f(&p.remake(&mut |&value| {
                    next += 1;
                    geograd::Jet {
                        value,
                        derivative: [if next == k + 1 { 1.0 } else { 0.0 }],
                    }
                }))
            };
            let value = |p: &Polygon<f64>, _: &Polygon<f64>| along(0, p).value;
            let expected = differences(value, &a, &nothing, 1e-6);
            for (k, expected) in expected.iter().enumerate() {
                let found = along(k, &a).derivative[0];
                assert!(
                    (found - expected).abs() < 1e-6 * (1.0 + expected.abs()),
                    "{found} {expected}"
                );
            }
        }
    }
}

#[test]
fn depths_know_holes() {
    let rings = [
        ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]),
        ring(&[(1., 1.), (3., 1.), (3., 3.), (1., 3.)]),
    ];
    let rings = Rings::from(&rings[..]);
    for (x, y, even_odd, non_zero) in [
        (2.0, 2.0, -1.0, 1.0),
        (0.5, 2.0, 0.5, 0.5),
        (1.0, 2.0, 0.0, 0.0),
        (5.0, 2.0, -1.0, -1.0),
        (4.0, 4.0, 0.0, 0.0),
        (7.0, 8.0, -5.0, -5.0),
    ] {
        assert_eq!(rings.depth(at(x, y), Fill::EvenOdd), even_odd);
        assert_eq!(rings.depth(at(x, y), Fill::NonZero), non_zero);
    }
    assert!(Rings::from(&[] as &[Ring]).depth(at(0.0, 0.0), Fill::NonZero) < -1e300);
    assert_eq!(rings.bounding(), Some(Aabb2::new(0.0, 0.0, 4.0, 4.0)));
}

/// Shared area of both, and areas of a and of b, by the oracle.
fn truth(a: &[Ring], b: &[Ring]) -> [f64; 3] {
    let [only_a, both, only_b] = scanline::areas(a, b, Fill::EvenOdd);
    [both, only_a + both, both + only_b]
}

/// The larger side of the bounds, of both.
fn reach(a: &[Ring], b: &[Ring]) -> [f64; 2] {
    [a, b].map(|rings| {
        let size = Rings::from(rings).bounding().unwrap().size();
        size.x.max(size.y)
    })
}

fn pairs(dice: &mut Dice) -> Vec<(Vec<Ring>, Vec<Ring>)> {
    let mut all: Vec<_> = (0..60).map(|_| (stars(dice), stars(dice))).collect();
    let hard = hard_rings();
    for a in &hard {
        all.extend(hard.iter().map(|b| (a.clone(), b.clone())));
    }
    all
}

#[test]
fn overlaps_are_those_of_the_oracle() {
    if !geograd_tests::is_due("overlaps_are_those_of_the_oracle") {
        return;
    }
    let mut dice = Dice(3);
    for (k, (a, b)) in pairs(&mut dice).into_iter().enumerate() {
        let [inter, area_a, area_b] = truth(&a, &b);
        let [long_a, long_b] = reach(&a, &b);
        let rounding = long_a.min(long_b).powi(2) * (long_a.max(long_b) / long_a.min(long_b));
        let found = intersection_area(&a[..], &b[..]);
        assert!(
            (found - inter).abs() < 1e-14 * rounding,
            "{k}: {found} {inter} {a:?} {b:?}"
        );
        let all = area_a + area_b - inter;
        assert!(
            (union_area(&a[..], &b[..]) - all).abs() < 2e-14 * long_a.max(long_b).powi(2),
            "{k}"
        );
        assert!((iou(&a[..], &b[..]) - inter / all).abs() < 1e-12, "{k}");
        let near = 1e-14 * rounding / area_a;
        assert!((iof(&a[..], &b[..]) - inter / area_a).abs() <= near, "{k}");
        if inter == 0.0 {
            assert!(found < 1e-14, "{found}");
        }
        for (by, scale) in [
            (at(1e6, 2e6), 1.0),
            (at(0.0, 0.0), 2f64.powi(-20)),
            (at(3.0, -2.0), 1e6),
        ] {
            let (a, b) = (moved(&a, by, scale), moved(&b, by, scale));
            let near = if by.x > 100.0 { 1e-8 } else { 1e-12 };
            let found = intersection_area(&a[..], &b[..]) / scale / scale;
            assert!(
                (found - inter).abs() < near * rounding,
                "{k}: {found} {inter}"
            );
        }
        let single = |rings: &[Ring]| made(rings).cast::<f32>();
        let found = f64::from(intersection_area(&single(&a), &single(&b)));
        assert!(
            (found - inter).abs() < 4e-6 * rounding,
            "{k}: {found} {inter}"
        );
    }
}

/// One of the scores, its adjoint, and a name.
type Score = (
    fn(&Polygon<f64>, &Polygon<f64>) -> f64,
    fn(&Polygon<f64>, &Polygon<f64>, &mut [Vec2<f64>], &mut [Vec2<f64>]) -> f64,
);
const SCORES: [Score; 4] = [
    (
        |a, b| intersection_area(a, b),
        |a, b, x, y| intersection_area_vjp(a, b, 1.0, x, y),
    ),
    (
        |a, b| union_area(a, b),
        |a, b, x, y| union_area_vjp(a, b, 1.0, x, y),
    ),
    (|a, b| iou(a, b), |a, b, x, y| iou_vjp(a, b, 1.0, x, y)),
    (|a, b| iof(a, b), |a, b, x, y| iof_vjp(a, b, 1.0, x, y)),
];

#[test]
fn derivatives_of_overlaps_are_their_differences_and_those_of_duals() {
    if !geograd_tests::is_due("derivatives_of_overlaps_are_their_differences_and_those_of_duals") {
        return;
    }
    let mut dice = Dice(4);
    for round in 0..12 {
        let (a, b) = (made(&stars(&mut dice)), made(&stars(&mut dice)));
        for (f, vjp) in SCORES {
            let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
            assert_eq!(vjp(&a, &b, &mut a_bar, &mut b_bar), f(&a, &b));
            let found = (a_bar, b_bar).scalars();
            for (found, expected) in found.iter().zip(differences(f, &a, &b, 1e-6)) {
                assert!(
                    (found - expected).abs() < 2e-7,
                    "{round}: {found} {expected}"
                );
            }
        }
        let both = (a.clone(), b.clone());
        let (_, duals) = geograd::gradient(|(a, b): (Polygon<_>, Polygon<_>)| iou(&a, &b), both);
        let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
        iou_vjp(&a, &b, 1.0, &mut a_bar, &mut b_bar);
        for (found, expected) in (a_bar, b_bar).scalars().iter().zip(duals.scalars()) {
            assert!(
                (found - expected).abs() < 1e-11,
                "{round}: {found} {expected}"
            );
        }
    }
}

#[test]
fn hard_overlaps_have_finite_derivatives() {
    let hard = hard_rings();
    for a in &hard {
        for b in &hard {
            let (a, b) = (made(a), made(b));
            for (f, vjp) in SCORES {
                let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
                let value = vjp(&a, &b, &mut a_bar, &mut b_bar);
                assert_eq!(value, f(&a, &b));
                assert!(
                    (a_bar, b_bar).scalars().iter().all(|x| x.is_finite()),
                    "{a:?} {b:?}"
                );
            }
        }
    }
}

#[test]
fn the_same_polygon_twice_has_iou_one_and_no_derivative() {
    let mut dice = Dice(5);
    let random = (0..30).map(|_| stars(&mut dice));
    for rings in random.chain(hard_rings()) {
        let a = made(&rings);
        assert_eq!(iou(&a, &a), 1.0);
        let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&a));
        assert_eq!(iou_vjp(&a, &a, 1.0, &mut a_bar, &mut b_bar), 1.0);
        assert!((a_bar, b_bar).scalars().iter().all(|&x| x == 0.0));
        // Turned around, and from another vertex on.
        let mut other = rings.clone();
        for ring in &mut other {
            ring.rotate_left(1);
            ring.reverse();
        }
        let other = made(&other);
        let found = iou(&a, &other);
        assert!(found <= 1.0 && found > 1.0 - 1e-9, "{found} {rings:?}");
    }
}

#[test]
fn a_hole_does_not_share_what_fills_it() {
    let frame = [
        ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]),
        ring(&[(1., 1.), (3., 1.), (3., 3.), (1., 3.)]),
    ];
    let filling = ring(&[(1., 1.), (3., 1.), (3., 3.), (1., 3.)]);
    assert!(intersection_area(&frame[..], &filling) < 1e-15);
    assert!((union_area(&frame[..], &filling) - 16.0).abs() < 1e-14);
    let nothing: &[Ring] = &[];
    assert_eq!(intersection_area(&frame[..], nothing), 0.0);
    assert_eq!(
        (union_area(&frame[..], nothing), iou(nothing, nothing)),
        (12.0, 0.0)
    );
}

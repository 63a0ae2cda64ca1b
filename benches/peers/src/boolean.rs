//! Overlap of polygons next to other libraries: convex quadrilaterals, and 20-gons with a hole.
use super::{Dice, line};
use geo::{Area, BooleanOps, Coord, LineString, Polygon};
use geograd::ad::adjoint::overlap_polygon::intersection_area_polygons_vjp;
use geograd::ad::adjoint::overlap_rings::intersection_area_vjp;
use geograd::boolean::{BooleanOperation, overlay_replay, overlay_search};
use geograd::overlap_polygon::{holed::intersection_area, intersection_area_polygons};
use geograd::polygon::{Fill, area};
use geograd::{ConvexPolygon, Vec2};
use std::hint::black_box;

const COUNT: usize = 2000;

/// A polygon of ours: its outer ring, and a hole unless that is empty.
type Rings = Vec<Vec<Vec2<f64>>>;

/// A star-shaped ring around a place.
fn star(dice: &mut Dice, middle: Vec2<f64>, count: usize, low: f64, high: f64) -> Vec<Vec2<f64>> {
    let spoke = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
        middle + Vec2::new(cos, sin) * dice.within(low, high)
    };
    (0..count).map(spoke).collect()
}

fn for_geo(rings: &Rings) -> Polygon {
    let line =
        |ring: &Vec<Vec2<f64>>| LineString(ring.iter().map(|v| Coord { x: v.x, y: v.y }).collect());
    Polygon::new(line(&rings[0]), rings[1..].iter().map(line).collect())
}

/// Areas of intersection of aligned pairs.
pub fn polygons() {
    let mut dice = Dice(17);
    let mut quads = || -> Vec<Rings> {
        let quad = |_| {
            let middle = Vec2::new(dice.within(-0.3, 0.3), dice.within(-0.3, 0.3));
            // Corners of a circle: convex.
            let radius = dice.within(0.7, 1.3);
            let turn = dice.within(0.0, 1.0);
            let corner = |k: usize| {
                let angle =
                    std::f64::consts::FRAC_PI_2 * (k as f64 + turn + 0.6 * dice.within(0.0, 1.0));
                let (sin, cos) = angle.sin_cos();
                middle + Vec2::new(cos, sin) * radius
            };
            vec![(0..4).map(corner).collect()]
        };
        (0..COUNT).map(quad).collect()
    };
    let (a, b) = (quads(), quads());
    println!(
        "\n| {COUNT} pairs of convex quadrilaterals, f64, one thread | M pairs/s |\n| --- | ---: |"
    );
    let convex = |all: &[Rings]| -> Vec<ConvexPolygon<f64, 4>> {
        all.iter()
            .map(|rings| ConvexPolygon::from_vertices(&rings[0]))
            .collect()
    };
    let (convex_a, convex_b) = (convex(&a), convex(&b));
    line("geograd, area of intersection, call by call", COUNT, || {
        for (a, b) in convex_a.iter().zip(&convex_b) {
            black_box(intersection_area_polygons(a, b));
        }
    });
    line("geograd, with its gradient, call by call", COUNT, || {
        for (a, b) in convex_a.iter().zip(&convex_b) {
            black_box(intersection_area_polygons(a, b));
            black_box(intersection_area_polygons_vjp(a, b, 1.0));
        }
    });
    rings(&a, &b);

    let mut frames = || -> Vec<Rings> {
        let frame = |_| {
            let middle = Vec2::new(dice.within(-0.3, 0.3), dice.within(-0.3, 0.3));
            let outer = star(&mut dice, middle, 20, 0.8, 1.4);
            vec![outer, star(&mut dice, middle, 6, 0.2, 0.5)]
        };
        (0..COUNT).map(frame).collect()
    };
    let (a, b) = (frames(), frames());
    println!(
        "\n| {COUNT} pairs of 20-gons with a hole, f64, one thread | M pairs/s |\n| --- | ---: |"
    );
    rings(&a, &b);
}

fn rings(a: &[Rings], b: &[Rings]) {
    let pairs = || a.iter().zip(b);
    let found = |a: &Rings, b: &Rings| intersection_area(&a[..], &b[..]);
    line(
        "geograd, area of intersection of any polygons",
        COUNT,
        || {
            for (a, b) in pairs() {
                black_box(found(a, b));
            }
        },
    );
    let mut bars = [[Vec2::new(0.0, 0.0); 26]; 2];
    line("geograd, with its gradient, of any polygons", COUNT, || {
        for (a, b) in pairs() {
            let [a_bar, b_bar] = &mut bars;
            black_box(intersection_area_vjp(&a[..], &b[..], 1.0, a_bar, b_bar));
        }
    });
    let clipped = |a: &Rings, b: &Rings| {
        let fill = Fill::EvenOdd;
        let trace = overlay_search(&a[..], &b[..], BooleanOperation::Intersection, fill);
        overlay_replay(&a[..], &b[..], &trace.expect("valid polygons"))
    };
    line(
        "geograd, the intersection with provenance (on i_overlay)",
        COUNT,
        || {
            for (a, b) in pairs() {
                black_box(clipped(a, b));
            }
        },
    );
    let theirs: Vec<_> = pairs().map(|(a, b)| (for_geo(a), for_geo(b))).collect();
    line("geo, area of the intersection", COUNT, || {
        for (a, b) in &theirs {
            black_box(a.intersection(b).unsigned_area());
        }
    });
    for ((a, b), (p, q)) in pairs().zip(&theirs) {
        let known = p.intersection(q).unsigned_area();
        assert!((found(a, b) - known).abs() < 1e-6, "geo disagrees");
        assert!((area(&clipped(a, b)) - found(a, b)).abs() < 1e-12);
    }
}

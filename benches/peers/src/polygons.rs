//! Distances of points from rings and clipping of convex polygons.
use super::timed::Timed;
use super::{Dice, on_threads};
use geo::{Coord, Distance, Euclidean, LineString, Point, Polygon};
use geograd::clipping::clip;
use geograd::distance::ring::distance_to_ring;
use geograd::kernels::{Cpu, SignedDistance};
use geograd::{ConvexPolygon, Vec2};
use parry2d_f64::math::Vector2;
use parry2d_f64::transformation::convex_polygons_intersection_points;
use std::f64::consts::TAU;
use std::hint::black_box;

/// Vertices of a ring, and points.
const RING: usize = 1000;
const POINTS: usize = 64;
/// How often all takes its turn.
const ROUNDS: usize = 8;

/// A ring about the origin.
fn ring(dice: &mut Dice, low: f64) -> Vec<Vec2<f64>> {
    let at = |k: usize| TAU * k as f64 / RING as f64;
    (0..RING)
        .map(|k| {
            let radius = dice.within(low, 1.5);
            Vec2::new(radius * at(k).cos(), radius * at(k).sin())
        })
        .collect()
}

/// Two regular polygons that cross.
fn convex<const N: usize>(turn: f64, x: f64) -> ConvexPolygon<f64, N> {
    let at = |k: usize| turn + TAU * k as f64 / N as f64;
    let vertices = std::array::from_fn(|k| Vec2::new(x + at(k).cos(), at(k).sin()));
    ConvexPolygon { vertices, count: N }
}

/// Clipping polygons of so many vertices, ours and parry's; `K` is twice as many.
fn clipping<const N: usize, const K: usize>() -> [Timed<'static>; 2] {
    let pairs: Vec<_> = (0..32)
        .map(|i| {
            let x = 0.02 + 0.05 * f64::from(i);
            (convex::<N>(0.1, 0.0), convex::<N>(0.37 + 0.01 * x, x))
        })
        .collect();
    let points = |a: &ConvexPolygon<f64, N>| -> Vec<Vector2> {
        a.vertices.iter().map(|v| Vector2::new(v.x, v.y)).collect()
    };
    let other: Vec<_> = pairs.iter().map(|(a, b)| (points(a), points(b))).collect();
    let (count, mut scratch) = (pairs.len(), Vec::new());
    for ((a, b), (p, q)) in pairs.iter().zip(&other) {
        let shared: ConvexPolygon<f64, K> = clip(a, b).expect("there is room");
        scratch.clear();
        convex_polygons_intersection_points(p, q, &mut scratch);
        let mut twice = 0.0;
        for i in 0..scratch.len() {
            twice += scratch[i].perp_dot(scratch[(i + 1) % scratch.len()]);
        }
        let ours = geograd::ring::signed_area(shared.as_slice());
        assert!((ours - twice.abs() / 2.0).abs() < 1e-9, "parry2d disagrees");
    }
    [
        Timed::new(count, move || {
            for (a, b) in &pairs {
                let shared: Result<ConvexPolygon<f64, K>, _> = clip(a, b);
                black_box(shared).expect("there is room");
            }
        }),
        Timed::new(count, move || {
            for (a, b) in &other {
                scratch.clear();
                convex_polygons_intersection_points(a, b, &mut scratch);
                black_box(&scratch);
            }
        }),
    ]
}

/// Prints the tables.
pub fn polygons() {
    let mut dice = Dice(19);
    let (jagged, round) = (ring(&mut dice, 0.5), ring(&mut dice, 1.499));
    let points: Vec<_> = (0..POINTS)
        .map(|_| Vec2::new(dice.within(-2.0, 2.0), dice.within(-2.0, 2.0)))
        .collect();
    let cpu = Cpu::new();
    let offsets: Vec<usize> = (0..=POINTS).map(|i| i * RING).collect();
    let mut lines = Vec::new();
    for (ring, name) in [(&jagged, "jagged"), (&round, "round")] {
        let border = ring.iter().map(|v| Coord { x: v.x, y: v.y }).collect();
        let line = LineString::new(
            [
                border,
                vec![Coord {
                    x: ring[0].x,
                    y: ring[0].y,
                }],
            ]
            .concat(),
        );
        let polygon = Polygon::new(line.clone(), vec![]);
        for &point in &points {
            let theirs = Euclidean.distance(&Point::new(point.x, point.y), &line);
            let ours = distance_to_ring(point, ring);
            assert!(
                (ours - theirs).abs() < 1e-12,
                "geo disagrees: {ours} {theirs}"
            );
        }
        let points = &points;
        lines.push((
            format!("geograd, point to {name} ring, call by call"),
            Timed::new(POINTS, move || {
                for &point in points {
                    black_box(distance_to_ring(point, ring));
                }
            }),
        ));
        lines.push((
            format!("geograd, signed, points to one {name} ring, batch"),
            Timed::new(POINTS, move || {
                let found = cpu.fold_one(SignedDistance.over_ring(), &points[..], ring);
                black_box(found).expect("valid rings");
            }),
        ));
        let all: Vec<_> = points.iter().flat_map(|_| ring.iter().copied()).collect();
        let offsets = &offsets;
        lines.push((
            format!("geograd, signed, each point to a {name} ring of its own, batch"),
            Timed::new(POINTS, move || {
                let context = &points[..];
                let found = cpu.fold(SignedDistance.over_ring(), context, &all, offsets);
                black_box(found).expect("valid rings");
            }),
        ));
        lines.push((
            format!("geo, point to {name} ring (line string)"),
            Timed::new(POINTS, move || {
                for &point in points {
                    black_box(Euclidean.distance(&Point::new(point.x, point.y), &line));
                }
            }),
        ));
        lines.push((
            format!("geo, point to {name} ring (polygon: zero inside)"),
            Timed::new(POINTS, move || {
                for &point in points {
                    black_box(Euclidean.distance(&Point::new(point.x, point.y), &polygon));
                }
            }),
        ));
    }
    let mut clips = [
        (4, clipping::<4, 8>()),
        (8, clipping::<8, 16>()),
        (16, clipping::<16, 32>()),
        (32, clipping::<32, 64>()),
        (64, clipping::<64, 128>()),
        (128, clipping::<128, 256>()),
    ];
    on_threads(1, || {
        for _ in 0..ROUNDS {
            lines.iter_mut().for_each(|(_, timed)| timed.turn());
            let clips = clips.iter_mut().flat_map(|(_, both)| both);
            clips.for_each(Timed::turn);
        }
    });
    println!(
        "\n| rings of {RING} vertices, f64, one thread | microseconds a point |\n| --- | ---: |"
    );
    for (name, timed) in &lines {
        println!(
            "| {name} | {:.3} |",
            timed.microseconds() / timed.items as f64
        );
    }
    println!(
        "\n| clipping of convex polygons, f64, vertices of each | geograd, ns | a vertex | parry2d-f64, ns |\n| ---: | ---: | ---: | ---: |"
    );
    for (n, [ours, theirs]) in &clips {
        let [ours, theirs] = [ours, theirs].map(|x| x.microseconds() * 1e3 / x.items as f64);
        println!(
            "| {n} | {ours:.0} | {:.1} | {theirs:.0} |",
            ours / f64::from(2 * n)
        );
    }
}

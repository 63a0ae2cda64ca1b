//! Rotated-box IoU: geograd next to other Rust libraries, measured in one run.
//!
//! `cargo run --release -p peers` prints medians in million pairs a second and ratios. Nothing is
//! asserted but that the values agree. "Random" is the distribution of the DGAL paper's benchmark
//! (centres in [-5, 5], sizes in [0, 5], headings in [-5, 5]), all pairs; "overlapping" are aligned
//! pairs a small motion apart, as a loss sees them.
use geo::{Area, BooleanOps, Coord, LineString, Polygon};
use geograd::kernels::{IouObb2, cpu};
use geograd::{Obb2, Pack, ad};
use parry2d_f64::math::Vector2;
use parry2d_f64::transformation::convex_polygons_intersection_points;
use std::hint::black_box;
use std::time::Instant;

/// Rows and columns of the random matrix, and of the part that slow peers are given.
const N: usize = 1000;
const SLOW: usize = 60;

struct Dice(u64);

impl Dice {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51afd7ed558ccd);
        low + (high - low) * ((mixed ^ (mixed >> 29)) >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn random(&mut self) -> Obb2<f64> {
        Obb2::new(
            self.within(-5.0, 5.0),
            self.within(-5.0, 5.0),
            self.within(0.0, 5.0),
            self.within(0.0, 5.0),
            self.within(-5.0, 5.0),
        )
    }
    fn near(&mut self, x: Obb2<f64>) -> Obb2<f64> {
        Obb2::new(
            x.center.x + self.within(-0.3, 0.3),
            x.center.y + self.within(-0.3, 0.3),
            x.size.x * self.within(0.8, 1.2),
            x.size.y * self.within(0.8, 1.2),
            x.heading + self.within(-0.2, 0.2),
        )
    }
}

fn narrow(list: &[Obb2<f64>]) -> Vec<Obb2<f32>> {
    list.iter().map(|x| x.map(&mut |&x| x as f32)).collect()
}

/// Median seconds of a call: at least five runs, at least a third of a second.
fn median(mut run: impl FnMut()) -> f64 {
    run();
    let (start, mut times) = (Instant::now(), Vec::new());
    while times.len() < 5 || start.elapsed().as_secs_f64() < 0.35 && times.len() < 200 {
        let now = Instant::now();
        run();
        times.push(now.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// One line of the table: million pairs a second.
fn line(name: &str, pairs: usize, run: impl FnMut()) -> f64 {
    let rate = pairs as f64 / median(run) / 1e6;
    println!("| {name} | {rate:.3} |");
    rate
}

fn by_geo(a: &Polygon, b: &Polygon) -> f64 {
    let inter = a.intersection(b).unsigned_area();
    inter / (a.unsigned_area() + b.unsigned_area() - inter)
}

fn by_parry(a: &[Vector2], b: &[Vector2], areas: f64, points: &mut Vec<Vector2>) -> f64 {
    points.clear();
    convex_polygons_intersection_points(a, b, points);
    let mut twice = 0.0;
    for i in 0..points.len() {
        twice += points[i].perp_dot(points[(i + 1) % points.len()]);
    }
    let inter = twice.abs() / 2.0;
    inter / (areas - inter)
}

fn polygon(x: &Obb2<f64>) -> Polygon {
    Polygon::new(
        LineString(x.corners().map(|c| Coord { x: c.x, y: c.y }).to_vec()),
        vec![],
    )
}

fn points(x: &Obb2<f64>) -> [Vector2; 4] {
    x.corners().map(|c| Vector2::new(c.x, c.y))
}

fn flat(list: &[Obb2<f64>]) -> Vec<f64> {
    // powerboxes takes degrees.
    let five = |x: &Obb2<f64>| {
        [
            x.center.x,
            x.center.y,
            x.size.x,
            x.size.y,
            x.heading.to_degrees(),
        ]
    };
    list.iter().flat_map(five).collect()
}

fn main() {
    let mut dice = Dice(7);
    let (a, b): (Vec<_>, Vec<_>) = (0..N).map(|_| (dice.random(), dice.random())).unzip();
    let near: Vec<_> = a.iter().map(|&x| dice.near(x)).collect();
    let (a32, b32, near32) = (narrow(&a), narrow(&b), narrow(&near));
    let pairs = N * N;

    println!(
        "one thread (RAYON_NUM_THREADS={}), {:?}, geograd {}",
        std::env::var("RAYON_NUM_THREADS").unwrap_or("unset: all cores".into()),
        geograd::kernels::simd::Simd::current(),
        env!("CARGO_PKG_VERSION")
    );
    println!("\n| random, all pairs of {N} x {N} | M pairs/s |\n| --- | ---: |");
    let mut values = vec![0.0; pairs];
    let ours = line("geograd, f32, value", pairs, || {
        cpu::all_pairs_into::<IouObb2, f32>(&a32, &b32, &mut values).unwrap()
    });
    let mut grads = cpu::PairGrads::<IouObb2, f32>::new(N, N).unwrap();
    let ours_grad = line("geograd, f32, value + ten slopes per pair", pairs, || {
        cpu::all_pairs_grad_into(&a32, &b32, &mut grads).unwrap()
    });
    let (up, mut p, mut q) = (vec![1.0; pairs], a32.clone(), b32.clone());
    line(
        "geograd, f32, adjoint with an upstream matrix",
        pairs,
        || cpu::all_pairs_vjp_into::<IouObb2, f32>(&a32, &b32, &up, &mut p, &mut q).unwrap(),
    );
    let mut values = vec![0.0; pairs];
    let ours64 = line("geograd, f64, value", pairs, || {
        cpu::all_pairs_into::<IouObb2, f64>(&a, &b, &mut values).unwrap()
    });
    let mut grads = cpu::PairGrads::<IouObb2, f64>::new(N, N).unwrap();
    line("geograd, f64, value + ten slopes per pair", pairs, || {
        cpu::all_pairs_grad_into(&a, &b, &mut grads).unwrap()
    });
    let (up, mut p, mut q) = (vec![1.0; pairs], a.clone(), b.clone());
    line(
        "geograd, f64, adjoint with an upstream matrix",
        pairs,
        || cpu::all_pairs_vjp_into::<IouObb2, f64>(&a, &b, &up, &mut p, &mut q).unwrap(),
    );
    line(
        "geograd, f64, gradient by forward duals (ad::gradient)",
        SLOW * SLOW,
        || {
            for &a in &a[..SLOW] {
                for &b in &b[..SLOW] {
                    black_box(ad::gradient(|(a, b)| Obb2::iou(a, b), (a, b)));
                }
            }
        },
    );
    let (flat_a, flat_b) = (flat(&a), flat(&b));
    let powerboxes = line("powerboxesrs, f64, value", pairs, || {
        black_box(powerboxesrs::iou::rotated_iou_distance_slice(
            &flat_a, &flat_b, N, N,
        ));
    });
    let (polygons_a, polygons_b): (Vec<_>, Vec<_>) = (
        a[..SLOW].iter().map(polygon).collect(),
        b[..SLOW].iter().map(polygon).collect(),
    );
    let geo = line("geo, f64, value", SLOW * SLOW, || {
        for a in &polygons_a {
            for b in &polygons_b {
                black_box(by_geo(a, b));
            }
        }
    });
    let (points_a, points_b): (Vec<_>, Vec<_>) = (
        a.iter().map(points).collect(),
        b.iter().map(points).collect(),
    );
    let mut scratch = Vec::new();
    let parry = line("parry2d-f64, value", 300 * 300, || {
        for i in 0..300 {
            for j in 0..300 {
                black_box(by_parry(
                    &points_a[i],
                    &points_b[j],
                    a[i].area() + b[j].area(),
                    &mut scratch,
                ));
            }
        }
    });
    println!(
        "\ngeograd f32 over powerboxesrs {:.1}x, over geo {:.0}x, over parry2d {:.0}x; f64 over f32 {:.2}; slopes over value {:.2}",
        ours / powerboxes,
        ours / geo,
        ours / parry,
        ours64 / ours,
        ours_grad / ours
    );

    println!("\n| overlapping, {N} aligned pairs | M pairs/s |\n| --- | ---: |");
    let (mut v, mut p, mut q) = cpu::aligned_grad::<IouObb2, f32>(&a32, &near32).unwrap();
    line("geograd, f32, value, with sines and cosines", N, || {
        cpu::aligned_into::<IouObb2, f32>(&a32, &near32, &mut v).unwrap()
    });
    line(
        "geograd, f32, value + gradient, with sines and cosines",
        N,
        || cpu::aligned_grad_into::<IouObb2, f32>(&a32, &near32, &mut v, &mut p, &mut q).unwrap(),
    );
    let (mut v, mut p, mut q) = cpu::aligned_grad::<IouObb2, f64>(&a, &near).unwrap();
    line(
        "geograd, f64, value + gradient, with sines and cosines",
        N,
        || cpu::aligned_grad_into::<IouObb2, f64>(&a, &near, &mut v, &mut p, &mut q).unwrap(),
    );
    let flat_near = flat(&near);
    line(
        "powerboxesrs, f64, value (its 5 x 5 matrices of near boxes)",
        N / 5 * 25,
        || {
            for i in 0..N / 5 {
                let (a, b) = (
                    &flat_a[i * 25..i * 25 + 25],
                    &flat_near[i * 25..i * 25 + 25],
                );
                black_box(powerboxesrs::iou::rotated_iou_distance_slice(a, b, 5, 5));
            }
        },
    );
    let polygons: Vec<_> = near[..SLOW].iter().map(polygon).collect();
    line("geo, f64, value", SLOW, || {
        for (a, b) in polygons_a.iter().zip(&polygons) {
            black_box(by_geo(a, b));
        }
    });

    // A benchmark of the wrong thing would be worthless.
    let iou = cpu::all_pairs::<IouObb2, f64>(&a[..SLOW], &b[..SLOW]).unwrap();
    let theirs = powerboxesrs::iou::rotated_iou_distance_slice(&flat_a, &flat_b, SLOW, SLOW);
    for i in 0..SLOW {
        for j in 0..SLOW {
            let ours = iou[i * SLOW + j];
            assert!(
                (ours - (1.0 - theirs[i * SLOW + j])).abs() < 1e-6,
                "powerboxesrs disagrees"
            );
            assert!(
                (ours - by_geo(&polygons_a[i], &polygons_b[j])).abs() < 1e-6,
                "geo disagrees"
            );
        }
    }
}

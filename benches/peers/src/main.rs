//! Rotated-box IoU: geograd next to other Rust libraries, measured in one run.
//!
//! `cargo run --release -p peers` prints medians in million pairs a second and ratios, on one thread,
//! and then how geograd's batches scale with threads. Nothing is asserted but that the values agree.
//! "Random" is the distribution of the DGAL paper's benchmark (centres in [-5, 5], sizes in [0, 5],
//! headings in [-5, 5]), all pairs; "overlapping" are aligned pairs a small motion apart, as a loss
//! sees them.
//!
//! `-- --levels [--csv FILE]` prints a table of every level of vector instructions that the machine has, `-- --shapes
//! [--csv FILE]` one of losses, boxes in space and quadrilaterals, `-- --suppress [--csv FILE]` one of suppression;
//! `-- --space` distances in space next to parry3d, `-- --planner` an arm among boxes, `-- --meshes` queries of meshes; `-- --polygons` times distances of points from rings, and clipping;
//! `-- --boolean` the overlap of polygons of any kind; `-- --paper FILE.svg [--csv FILE] [--backend cpu|gpu|auto]` times
//! the IoU loss against the number of boxes
//! and draws it, with the GPU's curves beside the CPU's (`--features gpu`).
mod bodies;
mod boolean;
mod levels;
mod meshes;
mod meshes_checked;
mod offsets;
mod paper;
mod planner;
mod polygons;
mod programs;
mod shapes;
mod solids_beside;
mod space;
mod suppress;
mod timed;

use common::cli::{Failure, Machine, Wish, say};
use geo::{Area, BooleanOps, Centroid, Coord, Euclidean, Length, LineString, Polygon};
use geograd::kernels::{self, Cpu, Fold, Iou, Table};
use geograd::{Obb2, Pack, Vec2, ad};
use parry2d_f64::math::Vector2;
use parry2d_f64::transformation::convex_polygons_intersection_points;
use std::hint::black_box;
use std::process::ExitCode;
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
    list.iter().map(|x| x.remake(&mut |&x| x as f32)).collect()
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

/// Seconds of the fastest of many calls: what other programs take away does not count.
fn fastest(mut run: impl FnMut()) -> f64 {
    let (start, mut best) = (Instant::now(), f64::INFINITY);
    while start.elapsed().as_secs_f64() < 1.5 {
        let now = Instant::now();
        run();
        best = best.min(now.elapsed().as_secs_f64());
    }
    best
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

/// Runs on so many threads.
fn on_threads(threads: usize, run: impl FnOnce() + Send) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads").install(run);
}

const HELP: &str = "\
Usage: peers [--levels | --shapes | --suppress] [--csv FILE]
       peers --paper SVG [--csv FILE] [--backend cpu|gpu|auto]
       peers --polygons | --boolean | --meshes [--check] | --offsets
       peers --space [--pairs FILE]
       peers --bodies FILE
       peers --planner

Without arguments: rotated boxes and rings next to other libraries. --paper draws the IoU loss against the
number of boxes; --backend gpu adds a GPU's curves and needs a build with `--features gpu`, auto adds them
where there is one. --pairs writes pairs of solids for `coal.cpp`, --bodies times curved bodies and writes them for
`coal_bodies.cpp`. The environment variable GEOGRAD_GPU chooses among GPUs.
";

fn main() -> ExitCode {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments
        .iter()
        .any(|word| word == "--help" || word == "-h")
    {
        say(HELP);
        return ExitCode::SUCCESS;
    }
    match machine(&mut arguments).and_then(|machine| run(&arguments, &machine)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report("peers"),
    }
}

/// The machine beside the CPU that `--backend` names; the words are taken out.
fn machine(arguments: &mut Vec<String>) -> Result<Machine, Failure> {
    let Some(at) = arguments.iter().position(|word| word == "--backend") else {
        return Ok(Machine::Cpu);
    };
    let usage = |why: &str| Failure::Usage(why.into());
    if arguments[0] != "--paper" {
        return Err(usage("`--backend` is for `--paper`"));
    }
    let name = arguments.get(at + 1).cloned();
    let name = name.ok_or_else(|| usage("`--backend` needs a value"))?;
    arguments.drain(at..at + 2);
    Wish::from_name(&name)?.machine("peers")
}

fn write(file: &str, text: &str) -> Result<(), Failure> {
    std::fs::write(file, text).map_err(|why| Failure::Work(format!("{file}: {why}")))
}

fn run(arguments: &[String], machine: &Machine) -> Result<(), Failure> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let known = matches!(
        words[..],
        [] | ["--levels"
            | "--shapes"
            | "--suppress"
            | "--polygons"
            | "--boolean"
            | "--space"
            | "--planner"
            | "--meshes"
            | "--offsets"]
            | ["--levels" | "--shapes" | "--suppress", "--csv", _]
            | ["--meshes", "--check"]
            | ["--space", "--pairs", _]
            | ["--bodies", _]
            | ["--paper", _]
            | ["--paper", _, "--csv", _]
    );
    if !known {
        return Err(Failure::Usage(format!("`{}`", words.join(" "))));
    }
    println!(
        "{:?}, geograd {}",
        geograd::kernels::cpu::simd::Simd::current().unwrap(),
        env!("CARGO_PKG_VERSION")
    );
    match words[..] {
        ["--levels"] => {
            levels::levels();
            scaling();
        }
        ["--levels", "--csv", file] => {
            write(file, &levels::levels())?;
            scaling();
        }
        ["--shapes"] => drop(shapes::shapes()),
        ["--shapes", "--csv", file] => write(file, &shapes::shapes())?,
        ["--paper", picture, "--csv", file] => {
            let (svg, csv) = paper::paper(machine);
            write(picture, &svg)?;
            write(file, &csv)?;
        }
        ["--paper", picture] => write(picture, &paper::paper(machine).0)?,
        ["--polygons"] => polygons::polygons(),
        ["--meshes"] => meshes::run(),
        ["--meshes", "--check"] => meshes_checked::run(),
        ["--offsets"] => on_threads(1, offsets::offsets),
        ["--space"] => space::space(1_000_000),
        ["--space", "--pairs", file] => write(file, &space::pairs(10_000))?,
        ["--bodies", file] => {
            let mut pairs = String::new();
            on_threads(1, || pairs = bodies::bodies());
            write(file, &pairs)?;
        }
        ["--planner"] => planner::planner(),
        ["--boolean"] => on_threads(1, boolean::polygons),
        ["--suppress"] => drop(suppress::suppress()),
        ["--suppress", "--csv", file] => write(file, &suppress::suppress())?,
        _ => all(),
    }
    Ok(())
}

/// Boxes and rings next to other libraries, and threads.
fn all() {
    on_threads(1, peers);
    for vertices in [8, 1000] {
        on_threads(1, || rings(vertices));
    }
    scaling();
}

/// Vertices of rings, a hundred thousand in all.
fn rings(vertices: usize) {
    let count = 100_000 / vertices;
    let mut dice = Dice(13);
    let mut list: Vec<Vec2<f64>> = Vec::new();
    for _ in 0..count {
        let (x, y) = (dice.within(-5.0, 5.0), dice.within(-5.0, 5.0));
        for k in 0..vertices {
            let angle = std::f64::consts::TAU * k as f64 / vertices as f64;
            let radius = dice.within(0.5, 1.5);
            list.push(Vec2::new(
                x + radius * angle.cos(),
                y + radius * angle.sin(),
            ));
        }
    }
    let offsets: Vec<usize> = (0..=count).map(|i| i * vertices).collect();
    let of = |ring: &[Vec2<f64>]| {
        let border = ring.iter().map(|v| Coord { x: v.x, y: v.y }).collect();
        Polygon::new(LineString(border), vec![])
    };
    let polygons: Vec<Polygon> = list.chunks(vertices).map(of).collect();
    let total = list.len();
    println!(
        "\n| {count} rings of {vertices} vertices, f64, one thread | M vertices/s |\n| --- | ---: |"
    );
    ring(
        kernels::SignedArea.over_ring(),
        "signed area",
        &list,
        &offsets,
    );
    line("geo, signed area", total, || {
        black_box(polygons.iter().map(Area::signed_area).sum::<f64>());
    });
    ring(kernels::Perimeter.over_ring(), "perimeter", &list, &offsets);
    line("geo, perimeter", total, || {
        black_box(
            polygons
                .iter()
                .map(|p| Euclidean.length(p.exterior()))
                .sum::<f64>(),
        );
    });
    ring(kernels::Centroid.over_ring(), "centroid", &list, &offsets);
    line("geo, centroid", total, || {
        for polygon in &polygons {
            black_box(polygon.centroid());
        }
    });
    let ours = Cpu::new().ragged(kernels::Centroid.over_ring(), &list, &offsets);
    let ours: Vec<Vec2<f64>> = ours.unwrap();
    for (ours, theirs) in ours.iter().zip(&polygons) {
        let theirs = theirs.centroid().unwrap();
        assert!(
            ours.distance(Vec2::new(theirs.x(), theirs.y())) < 1e-12,
            "geo disagrees"
        );
    }
}

/// Our two lines of one measure of rings.
fn ring<F: Fold<Context<f64> = [f64; 0], Element<f64> = Vec2<f64>>>(
    op: F,
    name: &str,
    list: &[Vec2<f64>],
    offsets: &[usize],
) {
    let cpu = Cpu::new();
    let mut values = cpu.ragged(op, list, offsets).unwrap();
    line(&format!("geograd, {name}"), list.len(), || {
        cpu.ragged_into(op, list, offsets, &mut values).unwrap();
    });
    let mut bars = list.to_vec();
    line(&format!("geograd, {name}, adjoint"), list.len(), || {
        cpu.ragged_vjp_into(op, list, offsets, &values, &mut bars)
            .unwrap();
    });
}

/// The batches of a large matrix on one thread, two, four and so on.
fn scaling() {
    const LARGE: usize = 2000;
    let mut dice = Dice(11);
    let (a, b): (Vec<_>, Vec<_>) = (0..LARGE).map(|_| (dice.random(), dice.random())).unzip();
    let (a, b, pairs) = (narrow(&a), narrow(&b), LARGE * LARGE);
    let mut values = vec![0.0; pairs];
    let mut grads = Table::new(LARGE, LARGE).unwrap();
    let cpu = Cpu::new();
    let (up, mut p, mut q) = (vec![1.0; pairs], a.clone(), b.clone());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    println!(
        "\n| f32, all pairs of {LARGE} x {LARGE}, threads | value | value + ten derivatives per pair | adjoint |\n| ---: | ---: | ---: | ---: |"
    );
    let mut threads = 1;
    loop {
        on_threads(threads, || {
            let rate = |seconds| pairs as f64 / seconds / 1e6;
            let value = rate(fastest(|| {
                cpu.all_pairs_planes(Iou, &a, &b, &mut values).unwrap()
            }));
            let derivatives = rate(fastest(|| {
                cpu.all_pairs_into(Iou.value_grad(), &a, &b, &mut grads)
                    .unwrap()
            }));
            let adjoint = rate(fastest(|| {
                cpu.all_pairs_vjp_into(Iou, &a, &b, &up, &mut p, &mut q)
                    .unwrap()
            }));
            println!("| {threads} | {value:.0} | {derivatives:.0} | {adjoint:.0} |");
        });
        if threads >= cores {
            break;
        }
        threads = cores.min(threads * 2);
    }
}

fn peers() {
    let cpu = Cpu::new();
    let mut dice = Dice(7);
    let (a, b): (Vec<_>, Vec<_>) = (0..N).map(|_| (dice.random(), dice.random())).unzip();
    let near: Vec<_> = a.iter().map(|&x| dice.near(x)).collect();
    let (a32, b32, near32) = (narrow(&a), narrow(&b), narrow(&near));
    let pairs = N * N;

    println!("\n| random, all pairs of {N} x {N}, one thread | M pairs/s |\n| --- | ---: |");
    let mut values = vec![0.0; pairs];
    let ours = line("geograd, f32, value", pairs, || {
        cpu.all_pairs_planes(Iou, &a32, &b32, &mut values).unwrap()
    });
    let mut grads = Table::new(N, N).unwrap();
    let ours_grad = line(
        "geograd, f32, value + ten derivatives per pair",
        pairs,
        || {
            cpu.all_pairs_into(Iou.value_grad(), &a32, &b32, &mut grads)
                .unwrap()
        },
    );
    let (up, mut p, mut q) = (vec![1.0; pairs], a32.clone(), b32.clone());
    line(
        "geograd, f32, adjoint with an upstream matrix",
        pairs,
        || {
            cpu.all_pairs_vjp_into(Iou, &a32, &b32, &up, &mut p, &mut q)
                .unwrap()
        },
    );
    let mut values = vec![0.0; pairs];
    let ours64 = line("geograd, f64, value", pairs, || {
        cpu.all_pairs_planes(Iou, &a, &b, &mut values).unwrap()
    });
    let mut grads = Table::new(N, N).unwrap();
    line(
        "geograd, f64, value + ten derivatives per pair",
        pairs,
        || {
            cpu.all_pairs_into(Iou.value_grad(), &a, &b, &mut grads)
                .unwrap()
        },
    );
    let (up, mut p, mut q) = (vec![1.0; pairs], a.clone(), b.clone());
    line(
        "geograd, f64, adjoint with an upstream matrix",
        pairs,
        || {
            cpu.all_pairs_vjp_into(Iou, &a, &b, &up, &mut p, &mut q)
                .unwrap()
        },
    );
    line(
        "geograd, f64, value, call by call (Obb2::iou)",
        300 * 300,
        || {
            for &a in &a[..300] {
                for &b in &b[..300] {
                    black_box(a.iou(b));
                }
            }
        },
    );
    line(
        "geograd, f64, value + ten derivatives, call by call (iou_obb2_grad)",
        300 * 300,
        || {
            for &a in &a[..300] {
                for &b in &b[..300] {
                    black_box(ad::adjoint::overlap::iou_obb2_grad(a, b));
                }
            }
        },
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
        "\ngeograd f32 over powerboxesrs {:.1}x, over geo {:.0}x, over parry2d {:.0}x; f64 over f32 {:.2}; derivatives over value {:.2}",
        ours / powerboxes,
        ours / geo,
        ours / parry,
        ours64 / ours,
        ours_grad / ours
    );

    println!("\n| overlapping, {N} aligned pairs, one thread | M pairs/s |\n| --- | ---: |");
    let grads = cpu.aligned(Iou.value_grad(), (&a32, &near32));
    let (mut v, (mut p, mut q)) = grads.unwrap();
    line("geograd, f32, value, with sines and cosines", N, || {
        cpu.aligned_into(Iou, (&a32, &near32), &mut v[..]).unwrap()
    });
    line(
        "geograd, f32, value + gradient, with sines and cosines",
        N,
        || {
            cpu.aligned_into(
                Iou.value_grad(),
                (&a32, &near32),
                (&mut v[..], (&mut p[..], &mut q[..])),
            )
            .unwrap()
        },
    );
    let grads = cpu.aligned(Iou.value_grad(), (&a, &near));
    let (mut v, (mut p, mut q)) = grads.unwrap();
    line(
        "geograd, f64, value + gradient, with sines and cosines",
        N,
        || {
            cpu.aligned_into(
                Iou.value_grad(),
                (&a, &near),
                (&mut v[..], (&mut p[..], &mut q[..])),
            )
            .unwrap()
        },
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
    let iou = cpu.all_pairs(Iou, &a[..SLOW], &b[..SLOW]).unwrap();
    let theirs = powerboxesrs::iou::rotated_iou_distance_slice(&flat_a, &flat_b, SLOW, SLOW);
    for i in 0..SLOW {
        for j in 0..SLOW {
            let ours = iou.at(i, j);
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

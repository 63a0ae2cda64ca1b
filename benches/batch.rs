//! Every listed operation, in nanoseconds and millions of items a second: `cargo bench`.
//!
//! A plain main, no framework: medians of repeated runs, nothing asserted. For rotated boxes next
//! to other libraries see `cargo run --release -p peers`.
use geograd::ad::check::Sampling;
use geograd::kernels::dynamic::{Mode, Operation, Rows, Sort};
use geograd::kernels::tested::{Tested, rows};
use std::hint::black_box;
use std::time::Instant;

const N: usize = 512;

fn median(mut run: impl FnMut()) -> f64 {
    run();
    let (start, mut times) = (Instant::now(), Vec::new());
    while times.len() < 5 || start.elapsed().as_secs_f64() < 0.2 {
        let now = Instant::now();
        run();
        times.push(now.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn line(name: &str, form: &str, items: usize, run: impl FnMut()) {
    let seconds = median(run);
    let (each, rate) = (seconds / items as f64 * 1e9, items as f64 / seconds / 1e6);
    println!("{name:<24} {form:<22} {each:>9.2} ns {rate:>9.1} M/s");
}

fn roll(state: &mut u64) -> f32 {
    *state = state
        .wrapping_mul(6364136223846793005)
        .wrapping_add(1442695040888963407);
    (*state >> 40) as f32 / (1 << 24) as f32
}

/// Numbers of a rotated box, or of one along the axes.
fn box_of(fields: usize, s: &mut u64) -> Vec<f32> {
    let mut at = |low: f32, high: f32| low + (high - low) * roll(s);
    if fields == 5 {
        return vec![
            at(-5.0, 5.0),
            at(-5.0, 5.0),
            at(0.0, 5.0),
            at(0.0, 5.0),
            at(-5.0, 5.0),
        ];
    }
    let (x, y) = (at(0.0, 10.0), at(0.0, 10.0));
    vec![x, y, x + at(0.0, 5.0), y + at(0.0, 5.0)]
}

/// Rows of two boxes in the plane whose pairs are measured, too.
const SCORES: [&str; 6] = [
    "intersection_area_obb2",
    "iou_obb2",
    "iof_obb2",
    "intersection_area_aabb2",
    "iou_aabb2",
    "iof_aabb2",
];

fn pairs(operation: &Operation) {
    let of = |mode| operation.function::<f32>(mode).expect("is of fixed size");
    let (value, value_grad) = (of(Mode::Value), of(Mode::ValueGrad));
    let (mut state, fields) = (3, value.takes()[0].1.fields());
    let mut list = || -> Vec<f32> { (0..N).flat_map(|_| box_of(fields, &mut state)).collect() };
    let (a, b) = (list(), list());
    let (a, b) = (Rows::new(&a, fields), Rows::new(&b, fields));
    let mut values = vec![0.0; N * N];
    line(operation.name, "all pairs, value", N * N, || {
        value.all_pairs_into(a, b, &mut values).unwrap();
    });
    line(operation.name, "all pairs, adjoint", N * N, || {
        black_box(value.all_pairs_vjp(a, b, &values).unwrap());
    });
    let (mut p, mut q) = (a.numbers().to_vec(), b.numbers().to_vec());
    line(operation.name, "aligned, value + grad", N, || {
        let mut into = [Some(&mut values[..N]), Some(&mut p[..]), Some(&mut q[..])];
        value_grad.aligned_into(&[a, b], &mut into).unwrap();
    });
}

fn paths(row: &Tested) {
    let on_paths = row.operation.on_paths::<f64>().expect("takes paths");
    let wide: usize = on_paths.takes().iter().map(|x| x.1.fields()).sum();
    let plan = Sampling::new(N, 7);
    let context = |i| row.random(&mut plan.draw(i))[..wide].to_vec();
    let contexts: Vec<f64> = (0..N).flat_map(context).collect();
    let contexts: Vec<Rows<'_, f64>> = match wide {
        0 => Vec::new(),
        _ => vec![Rows::new(&contexts, wide)],
    };
    let mut state = 5;
    let vertices: Vec<f64> = (0..16 * N).map(|_| roll(&mut state).into()).collect();
    let offsets: Vec<usize> = (0..=N).map(|i| 8 * i).collect();
    line(row.name(), "octagons, value, f64", N, || {
        black_box(on_paths.values(&contexts, &vertices, &offsets).unwrap());
    });
    let ones = vec![1.0; N * on_paths.gives()];
    line(row.name(), "octagons, adjoint, f64", N, || {
        black_box(on_paths.vjp(&contexts, &vertices, &offsets, &ones).unwrap());
    });
}

fn aligned(row: &Tested) {
    let of = |mode| {
        row.operation
            .function::<f64>(mode)
            .expect("is of fixed size")
    };
    let (value, adjoint, plan) = (of(Mode::Value), of(Mode::Vjp), Sampling::new(N, 7));
    let layouts = row.operation.layouts::<f64>();
    let mut columns = vec![Vec::new(); layouts.len()];
    let mut count = 0;
    for i in 0..N {
        let item = row.random(&mut plan.draw(i));
        let mut rest = &item[..];
        let mut parts = Vec::new();
        for layout in &layouts {
            let (own, others) = rest.split_at(layout.fields());
            parts.push(own);
            rest = others;
        }
        let mut all = parts.iter().zip(&layouts);
        if all.all(|(own, layout)| layout.check(own).is_ok()) {
            let columns = columns.iter_mut().zip(parts);
            columns.for_each(|(column, own)| column.extend_from_slice(own));
            count += 1;
        }
    }
    let columns = columns.iter().zip(&layouts);
    let mut rows: Vec<_> = columns
        .map(|(x, layout)| Rows::new(x, layout.fields()))
        .collect();
    line(row.name(), "aligned, value, f64", count, || {
        black_box(value.aligned(&rows).unwrap());
    });
    let ones = vec![1.0; value.gives().iter().sum()];
    rows.push(Rows::one(&ones));
    line(row.name(), "aligned, adjoint, f64", count, || {
        black_box(adjoint.aligned(&rows).unwrap());
    });
}

fn main() {
    // `cargo test --benches` calls this too, and then only wants to know that it runs.
    if std::env::args().any(|a| a == "--test") {
        return;
    }
    println!(
        "f32 unless said otherwise, {} threads at most, {:?}",
        std::thread::available_parallelism().map_or(1, |n| n.get()),
        geograd::kernels::cpu::simd::Simd::current().unwrap()
    );
    for row in rows() {
        match row.operation.sort {
            _ if SCORES.contains(&row.name()) => pairs(&row.operation),
            Sort::Straight | Sort::Search => aligned(row),
            Sort::Fold => paths(row),
        }
    }
}

//! Every listed operation, in nanoseconds and millions of items a second: `cargo bench`.
//!
//! A plain main, no framework: medians of repeated runs, nothing asserted. For rotated boxes next
//! to other libraries see `cargo run --release -p peers`.
use geograd::ad::check::Sampling;
use geograd::ad::check::sample::{Sample, random};
use geograd::kernels::op::Vjp;
use geograd::kernels::real::Real;
use geograd::kernels::{Cpu, Fold, Item, Op, RingOp, Runs, Search, Single};
use geograd::{Aabb2, Fixed, Obb2, Vec2};
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

/// A shape to measure with.
trait Draw: Fixed {
    fn draw(state: &mut u64) -> Self;
}

impl Draw for Obb2<f32> {
    fn draw(s: &mut u64) -> Self {
        let mut at = |low: f32, high: f32| low + (high - low) * roll(s);
        Obb2::new(
            at(-5.0, 5.0),
            at(-5.0, 5.0),
            at(0.0, 5.0),
            at(0.0, 5.0),
            at(-5.0, 5.0),
        )
    }
}

impl Draw for Aabb2<f32> {
    fn draw(s: &mut u64) -> Self {
        let (x, y) = (roll(s) * 10.0, roll(s) * 10.0);
        Aabb2::new(x, y, x + roll(s) * 5.0, y + roll(s) * 5.0)
    }
}

fn pairs<O: Op<In<f32> = (P, P), Out<f32> = f32>, P: Draw + Single<Scalar = f32>>(op: O) {
    let (mut state, cpu) = (3, Cpu::new());
    let a: Vec<P> = (0..N).map(|_| Draw::draw(&mut state)).collect();
    let b: Vec<P> = (0..N).map(|_| Draw::draw(&mut state)).collect();
    let mut values = vec![0.0; N * N];
    line(O::NAME, "all pairs, value", N * N, || {
        cpu.all_pairs_planes(op, &a, &b, &mut values).unwrap();
    });
    let (mut p, mut q) = (a.clone(), b.clone());
    line(O::NAME, "all pairs, adjoint", N * N, || {
        cpu.all_pairs_vjp_into(op, &a, &b, &values, &mut p, &mut q)
            .unwrap();
    });
    line(O::NAME, "aligned, value + grad", N, || {
        let into = (&mut values[..N], (&mut p, &mut q));
        cpu.aligned_into(op.value_grad(), (&a, &b), into).unwrap();
    });
}

fn rings<O: RingOp, T: Real>(op: O) {
    let cpu = Cpu::new();
    let mut state = 5;
    let vertices: Vec<Vec2<T>> = (0..8 * N)
        .map(|_| {
            Vec2::new(
                T::lit(roll(&mut state).into()),
                T::lit(roll(&mut state).into()),
            )
        })
        .collect();
    let offsets: Vec<usize> = (0..=N).map(|i| 8 * i).collect();
    line(O::NAME, "octagons, value", N, || {
        black_box(cpu.ragged(op, &vertices, &offsets).unwrap());
    });
    let upstream = vec![O::Out::<T>::filled(T::lit(1.0)); N];
    line(O::NAME, "octagons, adjoint", N, || {
        black_box(cpu.ragged_vjp(op, &vertices, &offsets, &upstream).unwrap());
    });
}

fn straight<O, R, Y>(op: O)
where
    O: Op<In<f64> = R, Out<f64> = Y>,
    R: Sample + Item<Scalar = f64>,
    Y: Item<Scalar = f64>,
{
    let (cpu, plan) = (Cpu::new(), Sampling::new(N, 7));
    let drawn = (0..N).map(|i| random::<R>(&mut plan.draw(i)));
    let rows: Vec<R> = drawn.filter(Sample::inside).collect();
    let ones = vec![Y::filled(1.0); rows.len()];
    line(O::NAME, "aligned, value, f64", rows.len(), || {
        black_box(cpu.aligned(op, &rows).unwrap());
    });
    line(O::NAME, "aligned, adjoint, f64", rows.len(), || {
        black_box(cpu.aligned(op.vjp(), (&rows, &ones)).unwrap());
    });
}

fn folds<F: Fold>(fold: F)
where
    F::Context<f64>: Sample + Item<Scalar = f64>,
    F::Out<f64>: Item,
{
    let (cpu, plan) = (Cpu::new(), Sampling::new(N, 7));
    let contexts: Vec<F::Context<f64>> = (0..N).map(|i| random(&mut plan.draw(i))).collect();
    let mut state = 5;
    let mut roll = || f64::from(roll(&mut state));
    let vertices: Vec<Vec2<f64>> = (0..8 * N).map(|_| Vec2::new(roll(), roll())).collect();
    let offsets: Vec<usize> = (0..=N).map(|i| 8 * i).collect();
    line(F::NAME, "octagons, value, f64", N, || {
        black_box(cpu.fold(fold, &contexts, &vertices, &offsets).unwrap());
    });
    let ones = vec![F::Out::<f64>::filled(1.0); N];
    line(F::NAME, "octagons, adjoint, f64", N, || {
        black_box(
            cpu.fold_vjp(fold, &contexts, &vertices, &offsets, &ones)
                .unwrap(),
        );
    });
}

fn decided<D, R, Y>(op: D)
where
    D: Search<In<f64> = R, Out<f64> = Y> + Runs<R, Out = Y>,
    R: Sample + Item<Scalar = f64>,
    Y: Item<Scalar = f64>,
    Vjp<D>: Runs<(R, Y), Out = R>,
{
    let (cpu, plan) = (Cpu::new(), Sampling::new(N, 7));
    let drawn = (0..N).map(|i| random::<R>(&mut plan.draw(i)));
    let rows: Vec<R> = drawn.filter(Sample::inside).collect();
    let ones = vec![Y::filled(1.0); rows.len()];
    line(D::NAME, "aligned, value, f64", rows.len(), || {
        black_box(cpu.aligned(op, &rows).unwrap());
    });
    line(D::NAME, "aligned, adjoint, f64", rows.len(), || {
        black_box(cpu.aligned(Search::vjp(op), (&rows, &ones)).unwrap());
    });
}

macro_rules! measure {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        $(pairs(<$pair_op>::default());)*
        $(rings::<_, f32>(<$ring_op>::default());)*
        $(straight(<$straight_op>::default());)*
        $(folds(<$fold_op>::default());)*
        $(decided::<$decided_op, _, _>(<$decided_op>::default());)*
        $(straight(<$more_op>::default());)*
        $(folds(<$more_fold_op>::default());)*
        $(decided::<$more_decided_op, _, _>(<$more_decided_op>::default());)*
    };
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
    geograd::for_each_op!(measure);
}

//! The rates of calls on hot paths, over arrays that stay on the device.
use geograd::kernels::gpu::Gpu;
use geograd::kernels::op::ValueGrad;
use geograd::kernels::{Backend, Cpu, Distance, Function, Giou, Iou, Single};
use geograd::{Aabb2, Error, Obb2, Obb3, Rotation3, Vec2, Vec3, YawBox3};
use indicatif::ProgressBar;
use std::time::{Duration, Instant};

/// The rate of a call.
pub struct Rate {
    pub row: &'static str,
    pub call: &'static str,
    pub pairs: usize,
    /// Millions a second: by the clock of the call, and by that of the kernels where the device has one; and on the CPU.
    pub call_rate: f64,
    pub kernel_rate: Option<f64>,
    pub cpu_rate: f64,
}

/// Numbers from 0 to 1, the same at every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 24) as f32
    }
    /// A place on a square on which so many boxes of a few metres overlap about three others.
    fn place(&mut self, count: usize) -> Vec2<f32> {
        let side = (count as f32).sqrt() * 3.0;
        Vec2::new(side * self.next(), side * self.next())
    }
}

fn rotated(x: &mut Numbers, count: usize) -> Obb2<f32> {
    let at = x.place(count);
    Obb2::new(
        at.x,
        at.y,
        4.0 + x.next(),
        1.8 + 0.4 * x.next(),
        6.3 * x.next(),
    )
}
fn upright(x: &mut Numbers, count: usize) -> Aabb2<f32> {
    let at = x.place(count);
    Aabb2::new(at.x, at.y, at.x + 4.0 + x.next(), at.y + 1.8 + x.next())
}
fn car(x: &mut Numbers, count: usize) -> YawBox3<f32> {
    let at = x.place(count);
    let size = Vec3::new(4.0 + x.next(), 1.8 + 0.4 * x.next(), 1.5 + 0.2 * x.next());
    YawBox3::new(Vec3::new(at.x, at.y, 0.3 * x.next()), size, 6.3 * x.next())
}
fn turned(x: &mut Numbers, count: usize) -> Obb3<f32> {
    let at = x.place(count);
    let size = Vec3::new(4.0 + x.next(), 1.8 + 0.4 * x.next(), 1.5 + 0.2 * x.next());
    let rotation = Rotation3::new(1.0 + x.next(), 0.2 * x.next(), 0.2 * x.next(), x.next());
    Obb3::new(Vec3::new(at.x, at.y, 0.3 * x.next()), size, rotation)
}

/// The shortest of three runs, by the clock and by that of the kernels.
fn fastest(
    gpu: Option<&Gpu>,
    mut run: impl FnMut() -> Result<(), Error>,
) -> Result<[Option<Duration>; 2], Error> {
    let mut best = [None::<Duration>; 2];
    for _ in 0..3 {
        let _ = gpu.and_then(Gpu::take_kernel_time);
        let start = Instant::now();
        run()?;
        gpu.map_or(Ok(()), Gpu::wait)?;
        let kernels = gpu
            .and_then(Gpu::take_kernel_time)
            .filter(|took| !took.is_zero());
        for (best, took) in best.iter_mut().zip([Some(start.elapsed()), kernels]) {
            *best = took.map(|took| best.map_or(took, |best| best.min(took)));
        }
    }
    Ok(best)
}

/// Rates of a function of two shapes.
fn of<A, B, R>(
    gpu: &Gpu,
    all: &mut Vec<Rate>,
    (row, run): (&'static str, R),
    shapes: [&dyn Fn(&mut Numbers, usize) -> (A, B); 1],
    pairs: usize,
    progress: &ProgressBar,
) -> Result<(), Error>
where
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
    R: Function<(A, B), Out = f32> + Copy,
    ValueGrad<R>: Function<(A, B), Out = (f32, (A, B))>,
{
    progress.set_message(row);
    let side = (pairs as f64).sqrt() as usize;
    let aligned = pairs / 16;
    let draw = |count: usize| -> (Vec<A>, Vec<B>) {
        let mut x = Numbers(count as u64);
        (0..count).map(|_| shapes[0](&mut x, count)).unzip()
    };
    let (a, b) = draw(aligned);
    let (long_a, long_b) = draw(side);
    let here = Backend::Gpu(gpu);
    let (on_a, on_b) = (here.upload(&a)?, here.upload(&b)?);
    let (on_long_a, on_long_b) = (here.upload(&long_a)?, here.upload(&long_b)?);
    let mut values = here.aligned(run, (&on_a, &on_b))?;
    let mut grads = here.aligned(ValueGrad::of(run), (&on_a, &on_b))?;
    let mut matrix = here.all_pairs(run, &on_long_a, &on_long_b)?;
    here.row_max(run, &on_long_a, &on_long_b)?;
    here.mean_grad(run, &on_long_a, &on_long_b)?;
    let cpu = Cpu::new();
    let mut measured =
        |call, pairs: usize, on_gpu: [Option<Duration>; 2], on_cpu: [Option<Duration>; 2]| {
            let rate = |took: Duration| pairs as f64 / took.as_secs_f64() / 1e6;
            all.push(Rate {
                row,
                call,
                pairs,
                call_rate: on_gpu[0].map_or(0.0, rate),
                kernel_rate: on_gpu[1].map(rate),
                cpu_rate: on_cpu[0].map_or(0.0, rate),
            });
        };
    measured(
        "aligned",
        aligned,
        fastest(Some(gpu), || {
            here.aligned_into(run, (&on_a, &on_b), &mut values)
        })?,
        fastest(None, || cpu.aligned(run, (&a, &b)).map(drop))?,
    );
    measured(
        "aligned, value and gradient",
        aligned,
        fastest(Some(gpu), || {
            here.aligned_into(ValueGrad::of(run), (&on_a, &on_b), &mut grads)
        })?,
        fastest(None, || cpu.aligned(ValueGrad::of(run), (&a, &b)).map(drop))?,
    );
    measured(
        "all_pairs",
        side * side,
        fastest(Some(gpu), || {
            here.all_pairs_into(run, &on_long_a, &on_long_b, &mut matrix)
        })?,
        fastest(None, || cpu.all_pairs(run, &long_a, &long_b).map(drop))?,
    );
    measured(
        "row_max",
        side * side,
        fastest(Some(gpu), || {
            here.row_max(run, &on_long_a, &on_long_b).map(drop)
        })?,
        fastest(None, || cpu.row_max(run, &long_a, &long_b).map(drop))?,
    );
    measured(
        "mean_grad",
        side * side,
        fastest(Some(gpu), || {
            here.mean_grad(run, &on_long_a, &on_long_b).map(drop)
        })?,
        fastest(None, || cpu.mean_grad(run, &long_a, &long_b).map(drop))?,
    );
    progress.inc(1);
    Ok(())
}

/// All rates.
pub fn all(
    gpu: &Gpu,
    pairs: usize,
    bar: impl Fn(usize, &str) -> ProgressBar,
) -> Result<Vec<Rate>, Error> {
    let progress = bar(6, "rates");
    let mut all = Vec::new();
    macro_rules! rates {
        ($($name:literal: $run:expr, |$x:ident, $n:ident| $draw:expr;)*) => { $(
            of(gpu, &mut all, ($name, $run), [&|$x: &mut Numbers, $n: usize| $draw], pairs, &progress)?;
        )* };
    }
    rates! {
        "iou(obb2,obb2)": Iou, |x, n| (rotated(x, n), rotated(x, n));
        "iou(aabb2,aabb2)": Iou, |x, n| (upright(x, n), upright(x, n));
        "iou(yawbox3,yawbox3)": Iou, |x, n| (car(x, n), car(x, n));
        "iou(obb3,obb3)": Iou, |x, n| (turned(x, n), turned(x, n));
        "giou(obb2,obb2)": Giou, |x, n| (rotated(x, n), rotated(x, n));
        "distance(vec2,obb2)": Distance, |x, n| (x.place(n), rotated(x, n));
    }
    progress.finish_and_clear();
    Ok(all)
}

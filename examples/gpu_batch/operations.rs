//! Any operation of the list: values and slopes of random shapes, by kernels generated from its recording.
use crate::failure::Failure;
use geograd::ad::check::sample::{Draw, Sample};
use geograd::kernels::gpu::{Gpu, Options};
use geograd::kernels::{Cpu, Op, Row};
use geograd::{Error, Fixed, Pack};
use std::time::{Duration, Instant};

/// Items of the full size.
const ITEMS: usize = 1_000_000;

/// Runs an operation for so many items.
type Run = fn(&Gpu, usize) -> Result<(), Error>;

macro_rules! table {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* } $($rest:tt)*) => {
        const OPERATIONS: &[(&str, Run)] = &[
            $((stringify!($pair), both::<$pair_op>),)*
            $((stringify!($straight), both::<$straight_op>),)*
        ];
    };
}
geograd::for_each_op!(table);

/// The names, one to a line.
pub fn names() -> String {
    OPERATIONS.iter().map(|op| format!("{}\n", op.0)).collect()
}

/// Runs the operation of a name.
pub fn run(name: &str, size: f64) -> Result<(), Failure> {
    let found = OPERATIONS.iter().find(|op| op.0 == name);
    let Some((_, run)) = found else {
        let why = format!("`--op {name}`: no such operation (`--list` has their names)");
        return Err(Failure::Usage(why));
    };
    let mut options = Options::default();
    options.timing = true;
    let gpu = Gpu::with(&options)?;
    println!("{name} on {gpu}");
    Ok(run(&gpu, (ITEMS as f64 * size) as usize)?)
}

/// Bytes a second of a kernel that copies: what memory gives at best.
fn copying(gpu: &Gpu, numbers: usize) -> Result<Option<f64>, Error> {
    let from = gpu.upload_values(&vec![1.0; numbers])?;
    let mut to = from.duplicate()?;
    let mut best = None;
    for _ in 0..5 {
        let _ = gpu.take_kernel_time();
        from.duplicate_into(&mut to)?;
        gpu.wait()?;
        let rate = |took: Duration| 8.0 * numbers as f64 / took.as_secs_f64();
        let found = gpu.take_kernel_time().map(rate);
        best = found.map(|found: f64| best.map_or(found, |best: f64| best.max(found)));
    }
    Ok(best)
}

fn both<O: Op>(gpu: &Gpu, count: usize) -> Result<(), Error>
where
    O::In<f64>: Sample,
    O::In<f32>: Row<Scalar = f32>,
    O::Out<f32>: Row<Scalar = f32>,
{
    let mut draw = Draw::new(1);
    let shapes: Vec<O::In<f32>> = (0..count)
        .map(|_| {
            let numbers = O::In::<f64>::ordinary(&mut draw).scalars();
            let numbers: Vec<f32> = numbers.iter().map(|&x| x as f32).collect();
            O::In::<f32>::load(&numbers)
        })
        .collect();
    let ones = vec![O::Out::<f32>::filled(1.0); count];
    let (run, few) = (O::default(), count.min(64));
    let (programs, cpu) = (gpu.programs(), Cpu::new());
    let copied = copying(gpu, 1 << 24)?;
    // Numbers of an input, and of a result.
    let (taken, given) = (O::In::<f32>::LEN, O::Out::<f32>::LEN);

    // The first call compiles.
    let start = Instant::now();
    programs.aligned(run, &shapes[..few])?;
    programs.aligned(run.vjp(), (&shapes[..few], &ones[..few]))?;
    println!("  compiled in {:.3?}", start.elapsed());
    let _ = gpu.take_kernel_time();
    let start = Instant::now();
    programs.aligned(run, &shapes[..])?;
    let line = Line(count, copied, gpu.take_kernel_time());
    line.say("values", start.elapsed(), 4 * (taken + given));
    let start = Instant::now();
    programs.aligned(run.vjp(), (&shapes[..], &ones[..]))?;
    let line = Line(count, copied, gpu.take_kernel_time());
    line.say("slopes", start.elapsed(), 4 * (2 * taken + given));
    let start = Instant::now();
    cpu.aligned(run, &shapes[..])?;
    Line(count, None, None).say("values on the CPU", start.elapsed(), 0);
    let start = Instant::now();
    cpu.aligned(run.vjp(), (&shapes[..], &ones[..]))?;
    Line(count, None, None).say("slopes on the CPU", start.elapsed(), 0);
    Ok(())
}

/// How many items there were, what copying gives, and how long kernels took.
struct Line(usize, Option<f64>, Option<Duration>);

impl Line {
    fn say(&self, what: &str, took: Duration, bytes: usize) {
        let rate = |took: Duration| self.0 as f64 / took.as_secs_f64() / 1e6;
        print!("  {what}: {took:.3?}, {:.2} million a second", rate(took));
        if let (Some(copied), Some(kernels)) = (self.1, self.2) {
            let share = (self.0 * bytes) as f64 / kernels.as_secs_f64() / copied;
            print!(
                "; in kernels {kernels:.3?}, {:.2} million a second, {:.1} % of the copy bandwidth",
                rate(kernels),
                100.0 * share
            );
        }
        println!();
    }
}

//! Any operation of the list in all its forms, on a GPU and on the CPU: how long it takes, and whether both
//! say the same.
use crate::listed::parity::compare;
use crate::listed::{Form, Listed, list};
use common::cli::Failure;
use geograd::kernels::gpu::{Gpu, Options};
use geograd::kernels::{Backend, dynamic};
use geograd::{Error, Unrecordable};
use std::time::{Duration, Instant};

/// Items of the full size, and pairs of it.
const ITEMS: usize = 1_000_000;

/// Verbs and shapes, one to a line.
pub fn names() -> String {
    let listed = list();
    let all = dynamic::names().into_iter();
    let here = all.filter(|name| listed.iter().any(|op| op.name == name.row));
    here.map(|name| format!("{}\n", name.spelling)).collect()
}

/// Runs the operation of a name, or all.
pub fn run(name: &str, size: f64) -> Result<(), Failure> {
    let mut wanted = list();
    let asked = if name == "all" { "" } else { name };
    let rows = dynamic::named_rows(asked)
        .map_err(|error| Failure::Usage(format!("`--op {name}`: {error}")))?;
    wanted.retain(|op| rows.contains(&op.name));
    if wanted.is_empty() {
        let why = format!("`--op {name}`: not in this list (`--list` has its names)");
        return Err(Failure::Usage(why));
    }
    let mut options = Options::default();
    options.timing = true;
    let gpu = Gpu::with(&options)?;
    println!("{name} on {gpu}");
    let copied = copying(&gpu, 1 << 22)?;
    if let Some(copied) = copied {
        println!("copy {:.1} GB/s, read and write", copied / 1e9);
    }
    let count = (ITEMS as f64 * size) as usize;
    let mut wrong = Vec::new();
    for op in wanted {
        if !agrees(&gpu, &op, count)? {
            wrong.push(op.name);
        }
    }
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::Work(format!(
            "the GPU says something else than the CPU: {}",
            wrong.join(", ")
        ))),
    }
}

/// Bytes a second of a kernel that copies: what memory gives at best.
fn copying(gpu: &Gpu, numbers: usize) -> Result<Option<f64>, Error> {
    let here = Backend::Gpu(gpu).resident();
    let from = here.upload_matrix(1, numbers, &vec![1.0; numbers])?;
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

/// Runs every form of an operation on both machines; whether both say the same.
fn agrees(gpu: &Gpu, op: &Listed, count: usize) -> Result<bool, Error> {
    println!("{}", op.name);
    let mut agree = true;
    for form in op.forms() {
        match both(gpu, form, op, count) {
            Ok(same) => agree &= same,
            Err(Error::Program(Unrecordable::Search)) => {
                println!(
                    "  {}: searches, which GPUs do not: it is for the CPU",
                    form.title()
                );
            }
            Err(error) => return Err(error),
        }
    }
    Ok(agree)
}

/// Runs a form on both machines, tells how fast they are, and compares.
fn both(gpu: &Gpu, form: Form, op: &Listed, count: usize) -> Result<bool, Error> {
    let start = Instant::now();
    // The first call brings everything up, and compiles.
    let mut on_gpu = op.make(form, Backend::Gpu(gpu), count)?;
    gpu.wait()?;
    let ready = start.elapsed();
    let _ = gpu.take_kernel_time();
    let start = Instant::now();
    on_gpu.run()?;
    gpu.wait()?;
    let call = start.elapsed();
    let kernels = gpu.take_kernel_time();
    let mut on_cpu = op.make(form, Backend::Cpu, count)?;
    let start = Instant::now();
    on_cpu.run()?;
    let cpu = start.elapsed();
    let found = compare(&*on_cpu, &on_gpu.numbers()?)?;
    let rate = |took: Duration| count as f64 / took.as_secs_f64() / 1e6;
    let kernels = kernels.filter(|took| !took.is_zero());
    let in_kernels = kernels.map_or(String::new(), |took| {
        format!(" ({:.2} in kernels)", rate(took))
    });
    println!(
        "  {}: million a second: GPU {:.2}{in_kernels}, CPU {:.2}; ready after {ready:.2?}; \
         {} of {} numbers differ, by {:.1e} at most, {} of them without a kink or a jump nearby",
        form.title(),
        rate(call),
        rate(cpu),
        found.apart,
        found.results,
        found.worst,
        found.wrong
    );
    Ok(found.is_within())
}

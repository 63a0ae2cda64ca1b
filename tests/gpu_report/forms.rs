//! Every form of rows on a GPU and on the CPU: how fast each is, and whether both give the same results.
use geograd::kernels::Backend;
use geograd::kernels::gpu::Gpu;
use geograd::{Error, Unrecordable};
use geograd_tests::listed::parity::compare;
use geograd_tests::listed::{Form, Listed};
use std::time::{Duration, Instant};

/// Prints a line for every form of these rows; `true` if both machines give the same results.
pub fn run(gpu: &Gpu, rows: &[(Listed, &str)], items: usize) -> Result<bool, Error> {
    if let Some(copied) = copying(gpu, 1 << 22)? {
        println!("copy {:.1} GB/s, read and write", copied / 1e9);
    }
    let mut agree = true;
    for (op, spelling) in rows {
        println!("{spelling}");
        agree &= agrees(gpu, op, items)?;
    }
    Ok(agree)
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

/// Runs every form of a row on both machines; `true` if both give the same results.
fn agrees(gpu: &Gpu, op: &Listed, count: usize) -> Result<bool, Error> {
    let mut agree = true;
    for form in op.forms() {
        match both(gpu, form, op, count) {
            Ok(same) => agree &= same,
            Err(Error::Program(Unrecordable::Search)) => {
                println!("  {}: a search, which only the CPU runs", form.title());
            }
            Err(error) => return Err(error),
        }
    }
    Ok(agree)
}

/// Runs a form on both machines, prints its rates, and compares the results.
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

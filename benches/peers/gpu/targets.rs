//! Targets of a large card, measured: `cargo bench -p peers --features gpu -- targets`.
use crate::Draw;
use crate::list::Roofs;
use crate::settings::{Settings, fastest};
use geograd::Error;
use geograd::Obb2;
use geograd::kernels::gpu::{Gpu, op_sources};
use geograd::kernels::{Backend, Distance, Iou, Op, RowOf};
use geograd::{Segment2, Vec2};
use geograd_tests::listed::{Form, list};

/// Prints one line: the target's name, the wanted rate, the measured rate.
fn told(what: &str, unit: &str, wanted: f64, found: f64) {
    let verdict = if found >= wanted { "met" } else { "missed" };
    println!("| {what} | {wanted} {unit} | {found:.2} {unit} | {verdict} |");
}

/// Billions a second of a batch that is there.
fn rate(gpu: &Gpu, pairs: usize, run: impl FnMut() -> Result<(), Error>) -> Result<f64, Error> {
    let took = fastest(gpu, run)?;
    Ok(pairs as f64 / took.kernel.unwrap_or(took.wall).as_secs_f64() / 1e9)
}

/// The rate of a form of an operation of the list.
fn listed(gpu: &Gpu, name: &str, form: Form, items: usize) -> Result<f64, Error> {
    let all = list();
    let op = all.iter().find(|op| op.name == name);
    let Some(op) = op.filter(|op| op.forms().contains(&form)) else {
        return Ok(0.0);
    };
    let mut ready = op.make(form, Backend::Gpu(gpu), items)?;
    rate(gpu, items, || ready.run())
}

pub fn targets(gpu: &Gpu, settings: &Settings, roofs: Roofs) -> Result<(), Error> {
    println!(
        "\n| target on an NVIDIA H200 | wanted | measured here | |\n| --- | ---: | ---: | --- |"
    );
    // One pair in twenty overlaps.
    let n = (16_384.0 * settings.scale.sqrt()) as usize;
    let boxes = |from: usize| -> Vec<Obb2<f32>> {
        (from..from + n).map(|at| Obb2::draw(at, 12.0)).collect()
    };
    let (a, b) = (boxes(0), boxes(n));
    let here = Backend::Gpu(gpu).resident();
    let (a, b) = (here.upload(&a)?, here.upload(&b)?);
    let program = Iou.row::<(Obb2<f32>, Obb2<f32>)>().program::<f32>()?;
    let mut matrix = here.all_pairs(Iou, &a, &b)?;
    let found = rate(gpu, n * n, || here.all_pairs_into(Iou, &a, &b, &mut matrix))?;
    told("rotated IoU, all pairs", "G/s", 110.0, found);
    here.all_pairs_into(&program, &a, &b, &mut matrix)?;
    let found = rate(gpu, n * n, || {
        here.all_pairs_into(&program, &a, &b, &mut matrix)
    })?;
    told(
        "the same values by the generated kernel",
        "G/s",
        110.0,
        found,
    );
    here.all_pairs_vjp(Iou, &a, &b, &matrix)?;
    let found = rate(gpu, n * n, || {
        here.all_pairs_vjp(Iou, &a, &b, &matrix).map(drop)
    })?;
    told(
        "rotated IoU, gradients of both boxes, upstream matrix",
        "G/s",
        50.0,
        found,
    );
    here.all_pairs_vjp(&program, &a, &b, &matrix)?;
    let found = rate(gpu, n * n, || {
        here.all_pairs_vjp(&program, &a, &b, &matrix).map(drop)
    })?;
    told(
        "the same gradients by the generated kernel",
        "G/s",
        50.0,
        found,
    );
    let side = (4096.0 * settings.scale.sqrt()) as usize;
    let found = listed(gpu, "iou_obb3", Form::Pairs, side * side)?;
    told(
        "IoU of boxes under full rotation, all pairs",
        "G/s",
        4.0,
        found,
    );
    let items = ((1 << 24) as f64 * settings.scale) as usize;
    let found = listed(gpu, "distance_point_segment", Form::Gradient, items)?;
    let bytes = crate::list::bytes(
        &op_sources::<RowOf<Distance, (Vec2<f32>, Segment2<f32>)>>()?,
        "ValueGrad Aligned",
    );
    let share = 100.0 * found * 1e9 * bytes as f64 / roofs.copy;
    told(
        "point to segment, aligned, with gradient",
        "% of copy bandwidth",
        60.0,
        share,
    );
    Ok(())
}

//! Overlap of boxes and polygons, table in, table out.
//!
//! ```text
//! cargo run --release -p geograd-examples --example iou_csv -- --a A.csv --b B.csv [--all-pairs] [--grad]
//! cargo run --release -p geograd-examples --example iou_csv -- --format polygons --metric giou --a A.csv --b B.csv
//! cargo run --release -p geograd-examples --features gpu --example iou_csv -- --backend gpu --precision f32 …
//! ```
//!
//! `--help` has the rest. Both inputs are read and checked as a whole before anything is computed,
//! and a result file appears under its name only when it is complete.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `options.rs`, `metric.rs` | the command line and its words |
//! | `input.rs` | tables of shapes; `common/csv.rs` reads and writes rows, here and for `table` |
//! | `boxes/` | boxes of the plane and of space; `common/compute.rs` computes, here and for `table` |
//! | `polygon/` | polygons |
mod boxes;
mod input;
mod metric;
mod options;
mod polygon;

use boxes::{Boxes, Which};
use common::cli::{Failure, Machine, NO_F64, Wish, finish, on_the_cpu};
use common::compute::{self, BLOCK, Number};
use common::csv::Writer;
use common::file;
use common::output::Output;
use common::progress::bar;
use geograd::kernels::dynamic::Rows;
use geograd::{Obb2, Obb3, YawBox3};
use input::Shape;
use metric::Format;
use options::{HELP, Options, PROGRAM, options};
use polygon::{Derivatives, Polygon};
use std::process::ExitCode;

/// The machine asked for, as far as it has the format and computes the metric.
fn machine(options: &Options) -> Result<Machine, Failure> {
    let is_computed = options.format == Format::Obb2 && options.metric.is_on_gpus();
    let why = match options.wish {
        Wish::Auto if options.double => NO_F64,
        Wish::Auto if !is_computed => "GPUs compute iou and iof of obb2 only",
        wish => return wish.machine(PROGRAM),
    };
    Ok(on_the_cpu(PROGRAM, why))
}

/// Both files. Both are checked before either is refused: one run shows all that is wrong.
fn read<P: Shape>(options: &Options) -> Result<(Vec<P>, Vec<P>), Failure> {
    let (a, b) = (
        input::read::<P>(&options.a, "--a"),
        input::read::<P>(&options.b, "--b"),
    );
    let (a, b) = match (a, b) {
        (Ok(a), Ok(b)) => (a, b),
        (Err(why), Ok(_)) | (Ok(_), Err(why)) => return Err(Failure::Work(why)),
        (Err(why), Err(_)) if file::same(&options.a, &options.b) => {
            return Err(Failure::Work(why));
        }
        (Err(a), Err(b)) => return Err(Failure::Work(format!("{a}\n{b}"))),
    };
    if !options.all_pairs && a.len() != b.len() {
        return Err(Failure::Work(format!(
            "{} has {} rows and {} has {}; pairs need as many of each (or --all-pairs)",
            options.a.display(),
            a.len(),
            options.b.display(),
            b.len(),
        )));
    }
    Ok((a, b))
}

/// The result, with the metric's column, and those of derivatives by these numbers of a and of b.
fn result(options: &Options, by: [Vec<String>; 2]) -> Result<Writer, Failure> {
    let mut columns = vec![options.metric.name().to_string()];
    if options.grad {
        for (owner, by) in ["da", "db"].iter().zip(by) {
            columns.extend(by.iter().map(|name| format!("{owner}{name}")));
        }
    }
    Ok(Writer::new(
        Output::create(options.out.as_deref())?,
        &columns,
    ))
}

fn boxes<P: Boxes>(options: &Options) -> Result<(), Failure> {
    let (a, b) = read::<P>(options)?;
    let machine = machine(options)?;
    let names = || P::DERIVATIVE.iter().map(|name| name.to_string()).collect();
    let mut result = result(options, [names(), names()])?;
    let numbers = [&a, &b].map(|all| all.iter().flat_map(|own| own.scalars()).collect::<Vec<_>>());
    let lists = numbers.each_ref().map(|own| Rows::new(own, P::LEN));
    let blocks: Vec<Which> = match options.all_pairs {
        true => compute::blocks(0..a.len(), 0..b.len())
            .map(Which::All)
            .collect(),
        false => (0..a.len())
            .step_by(BLOCK)
            .map(|start| Which::Aligned(start..a.len().min(start + BLOCK)))
            .collect(),
    };
    let progress = bar(PROGRAM, count(options, &a, &b) as u64);
    for which in blocks {
        let scores = boxes::scores::<P>(options.metric, &machine, lists, &which, options.grad)?;
        let places = which.places();
        result.rows(scores.values.len(), |i, fields| {
            fields.number(scores.values[i]);
            let shapes = [a[places[0][i]], b[places[1][i]]];
            for (by, shape) in scores.derivatives.iter().flatten().zip(shapes) {
                let own = shape.derivatives(by[i]);
                own.into_iter().for_each(|x| fields.number(x));
            }
        })?;
        if result.is_closed() {
            break;
        }
        progress.inc(scores.values.len() as u64);
    }
    progress.finish_and_clear();
    result.finish()
}

/// How many pairs there are.
fn count<P>(options: &Options, a: &[P], b: &[P]) -> usize {
    a.len() * if options.all_pairs { b.len() } else { 1 }
}

/// Pairs of polygons computed between two looks at the progress bar.
const STRIDE: usize = 1 << 15;

fn polygons<T: Number>(options: &Options) -> Result<(), Failure> {
    let (a, b) = read::<Polygon<T>>(options)?;
    // Only to say which machine it was.
    machine(options)?;
    let longest = [&a, &b].map(|all| all.iter().map(Polygon::count).max().unwrap_or(0));
    let names = longest.map(|count| {
        let names = (1..=count).flat_map(|k| [format!("{k}x"), format!("{k}y")]);
        names.collect()
    });
    let mut result = result(options, names)?;
    let count = count(options, &a, &b);
    let pair = |i: usize| match options.all_pairs {
        true => (&a[i / b.len()], &b[i % b.len()]),
        false => (&a[i], &b[i]),
    };
    let progress = bar(PROGRAM, count as u64);
    for start in (0..count).step_by(STRIDE) {
        let stride = STRIDE.min(count - start);
        result.rows(stride, |i, fields| {
            let (a, b) = pair(start + i);
            let mut by = options.grad.then(|| Derivatives::new(a, b));
            fields.number(polygon::score(options.metric, a, b, by.as_mut()));
            let Some(by) = by else { return };
            for (by, longest) in [a.given(&by.a), b.given(&by.b)].iter().zip(longest) {
                for vertex in by {
                    fields.number(vertex.x);
                    fields.number(vertex.y);
                }
                (2 * by.len()..2 * longest).for_each(|_| fields.empty());
            }
        })?;
        progress.inc(stride as u64);
        if result.is_closed() {
            break;
        }
    }
    progress.finish_and_clear();
    result.finish()
}

/// Computes in one format, and gives the text that is left to print.
fn run<T: Number>(options: &Options) -> Result<String, Failure> {
    match options.format {
        Format::Obb2 => boxes::<Obb2<T>>(options),
        Format::Polygons => polygons::<T>(options),
        Format::Yaw3 => boxes::<YawBox3<T>>(options),
        Format::Obb3 => boxes::<Obb3<T>>(options),
    }?;
    Ok(String::new())
}

fn main() -> ExitCode {
    let done = options().and_then(|options| match options {
        None => Ok(HELP.into()),
        Some(options) if options.double => run::<f64>(&options),
        Some(options) => run::<f32>(&options),
    });
    finish(PROGRAM, done)
}

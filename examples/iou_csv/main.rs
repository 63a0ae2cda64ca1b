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
//! | `boxes/`, `number.rs` | boxes of the plane and of space, in both formats; `common/compute.rs` computes, here and for `table` |
//! | `polygon/` | polygons |
mod boxes;
mod input;
mod metric;
mod number;
mod options;
mod polygon;

use boxes::{Boxes, Pairs, Which};
use common::cli::{Failure, Machine, Wish, on_the_cpu, say};
use common::compute::{self, BLOCK};
use common::csv::Writer;
use common::file;
use common::output::Output;
use common::progress::bar;
use geograd::kernels::dynamic::Rows;
use geograd::{Obb2, Obb3, YawBox3};
use input::Shape;
use metric::Format;
use number::Number;
use options::{HELP, Options, options};
use polygon::{Derivatives, Polygon};
use std::process::ExitCode;

const PROGRAM: &str = "iou_csv";

/// The machine asked for, as far as it has the format and computes the metric.
fn machine<T: Number>(options: &Options) -> Result<Machine, Failure> {
    let wish = options.wish;
    if wish == Wish::Auto && !T::ON_GPUS {
        let why = "GPUs have no f64; `--precision f32` allows one";
        return Ok(on_the_cpu(PROGRAM, why));
    }
    if wish == Wish::Auto && !(options.format == Format::Obb2 && options.metric.is_on_gpus()) {
        let why = "GPUs compute iou and iof of obb2 only";
        return Ok(on_the_cpu(PROGRAM, why));
    }
    wish.machine(PROGRAM)
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

/// The columns of the result: the metric's, and those of derivatives by these numbers of a and of b.
fn columns(options: &Options, by: [&[String]; 2]) -> Vec<String> {
    let mut columns = vec![options.metric.name().to_string()];
    if options.grad {
        for (owner, by) in ["da", "db"].iter().zip(by) {
            columns.extend(by.iter().map(|name| format!("{owner}{name}")));
        }
    }
    columns
}

fn boxes<P: Boxes>(options: &Options) -> Result<(), Failure> {
    let (a, b) = read::<P>(options)?;
    let machine = machine::<P::Scalar>(options)?;
    let by: Vec<String> = P::DERIVATIVE.iter().map(|name| name.to_string()).collect();
    let output = Output::create(options.out.as_deref())?;
    let mut sink = Writer::new(output, &columns(options, [&by, &by]));
    let numbers = [&a, &b].map(|all| all.iter().flat_map(|own| own.scalars()).collect::<Vec<_>>());
    let lists = numbers.each_ref().map(|own| Rows::new(own, P::LEN));
    let mut block = |which: Which| {
        let pairs = Pairs { lists, which };
        let scores = P::scores(options.metric, &machine, &pairs, options.grad)?;
        let places = pairs.places();
        sink.rows(scores.values.len(), |i, fields| {
            fields.number(scores.values[i]);
            let shapes = [a[places[0][i]], b[places[1][i]]];
            for (by, shape) in scores.derivatives.iter().flatten().zip(shapes) {
                shape.derivatives(by[i], &mut |derivative| fields.number(derivative));
            }
        })?;
        Ok::<bool, Failure>(sink.is_closed())
    };
    if options.all_pairs {
        let progress = bar(PROGRAM, a.len() as u64 * b.len() as u64);
        for own in compute::blocks(0..a.len(), 0..b.len()) {
            let pairs = own[0].len() * own[1].len();
            if block(Which::All(own))? {
                break;
            }
            progress.inc(pairs as u64);
        }
        progress.finish_and_clear();
    } else {
        let progress = bar(PROGRAM, a.len() as u64);
        for start in (0..a.len()).step_by(BLOCK) {
            let rows = start..a.len().min(start + BLOCK);
            if block(Which::Aligned(rows.clone()))? {
                break;
            }
            progress.inc(rows.len() as u64);
        }
        progress.finish_and_clear();
    }
    sink.finish()
}

/// Pairs of polygons computed between two looks at the progress bar.
const STRIDE: usize = 1 << 15;

fn polygons<T: Number>(options: &Options) -> Result<(), Failure> {
    let (a, b) = read::<Polygon<T>>(options)?;
    // Only to say which machine it was.
    machine::<T>(options)?;
    let longest = |all: &[Polygon<T>]| all.iter().map(Polygon::count).max().unwrap_or(0);
    let counts = [longest(&a), longest(&b)];
    let names = counts.map(|count| {
        let names = (1..=count).flat_map(|k| [format!("{k}x"), format!("{k}y")]);
        names.collect::<Vec<_>>()
    });
    let columns = columns(options, [&names[0], &names[1]]);
    let mut sink = Writer::new(Output::create(options.out.as_deref())?, &columns);
    let all = if options.all_pairs {
        a.len() * b.len()
    } else {
        a.len()
    };
    let pair = |i: usize| match options.all_pairs {
        true => (&a[i / b.len()], &b[i % b.len()]),
        false => (&a[i], &b[i]),
    };
    let progress = bar(PROGRAM, all as u64);
    for start in (0..all).step_by(STRIDE) {
        let count = STRIDE.min(all - start);
        sink.rows(count, |i, fields| {
            let (a, b) = pair(start + i);
            if !options.grad {
                return fields.number(polygon::score(options.metric, a, b, None));
            }
            let mut derivatives = Derivatives::new(a, b);
            fields.number(polygon::score(options.metric, a, b, Some(&mut derivatives)));
            for (by, count) in [
                (a.given(&derivatives.a), counts[0]),
                (b.given(&derivatives.b), counts[1]),
            ] {
                for vertex in &by {
                    fields.number(vertex.x);
                    fields.number(vertex.y);
                }
                (2 * by.len()..2 * count).for_each(|_| fields.empty());
            }
        })?;
        progress.inc(count as u64);
        if sink.is_closed() {
            break;
        }
    }
    progress.finish_and_clear();
    sink.finish()
}

fn run<T: Number>(options: &Options) -> Result<(), Failure> {
    match options.format {
        Format::Obb2 => boxes::<Obb2<T>>(options),
        Format::Polygons => polygons::<T>(options),
        Format::Yaw3 => boxes::<YawBox3<T>>(options),
        Format::Obb3 => boxes::<Obb3<T>>(options),
    }
}

fn main() -> ExitCode {
    let done = options().and_then(|options| match options {
        None => {
            say(HELP);
            Ok(())
        }
        Some(options) if options.double => run::<f64>(&options),
        Some(options) => run::<f32>(&options),
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(PROGRAM),
    }
}

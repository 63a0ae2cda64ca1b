//! Polygons fitted to an outline by gradient descent: a convex one, and one with a hole; on the overlap
//! and on the distance of borders. `cargo run --release -p geograd-examples --example polygon_fit`; `-- --help` has the options.
mod draw;
mod fit;
mod target;

use common::cli::{Failure, finish, usage};
use common::file::write;
use common::progress::styled;
use fit::{Fit, Loss};
use lexopt::prelude::*;
use std::fmt::Write as _;
use std::path::PathBuf;
use target::{Shape, Target};

const HELP: &str = "\
Fits polygons to an outline by gradient descent, and draws them before and after.

Usage: polygon_fit [options]

  --seed N          another outline [default: 1]
  --iterations N    steps of each fit [default: 120]
  --shape NAME      only this shape: convex, or hole [default: both]
  --loss NAME       only this loss: overlap (1 - IoU), or distance (squared, between borders) [default: both]
  --svg FILE        a picture [default: polygon_fit.svg]
  --csv FILE        iteration,loss,iou of every step; with every fit iterations start again from 0
  --help            this text
";

struct Options {
    seed: u64,
    iterations: usize,
    shapes: Vec<Shape>,
    losses: Vec<Loss>,
    svg: PathBuf,
    csv: Option<PathBuf>,
}

fn options() -> Result<Option<Options>, Failure> {
    let mut options = Options {
        seed: 1,
        iterations: 120,
        shapes: vec![Shape::Convex, Shape::Hole],
        losses: vec![Loss::Overlap, Loss::Distance],
        svg: "polygon_fit.svg".into(),
        csv: None,
    };
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("seed") => options.seed = arguments.value()?.parse()?,
            Long("iterations") => options.iterations = arguments.value()?.parse()?,
            Long("shape") => options.shapes = vec![arguments.value()?.parse_with(Shape::named)?],
            Long("loss") => options.losses = vec![arguments.value()?.parse_with(Loss::named)?],
            Long("svg") => options.svg = arguments.value()?.into(),
            Long("csv") => options.csv = Some(arguments.value()?.into()),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected().into()),
        }
    }
    if options.csv.as_ref() == Some(&options.svg) {
        return usage("`--svg` and `--csv` are the same file");
    }
    Ok(Some(options))
}

fn run() -> Result<String, Failure> {
    let Some(options) = options()? else {
        return Ok(HELP.into());
    };
    let pairs = options
        .shapes
        .iter()
        .flat_map(|&shape| options.losses.iter().map(move |&loss| (shape, loss)));
    let pairs: Vec<_> = pairs.collect();
    let steps = pairs.len() * options.iterations;
    let bar = styled("{bar:30} {pos}/{len} steps ({elapsed})", steps as u64);
    let mut fits = Vec::new();
    for (shape, loss) in pairs {
        let target = Target::new(options.seed, shape);
        fits.push(Fit::run(target, loss, options.iterations, || bar.inc(1)));
    }
    bar.finish_and_clear();
    write(&options.svg, &draw::page(&fits))?;
    if let Some(file) = &options.csv {
        let mut table = String::from("iteration,loss,iou\n");
        for (k, step) in fits.iter().flat_map(|fit| fit.steps.iter().enumerate()) {
            let _ = writeln!(table, "{k},{},{}", step.loss, step.iou);
        }
        write(file, &table)?;
    }
    let mut text = String::from("shape    loss       before   after    IoU before   after\n");
    for fit in &fits {
        let (first, last) = (&fit.steps[0], &fit.steps[fit.steps.len() - 1]);
        let (shape, loss) = (fit.target.shape.name(), fit.loss.name());
        let _ = writeln!(
            text,
            "{shape:<8} {loss:<9} {:>7.4} {:>7.4} {:>13.4} {:>7.4}",
            first.loss, last.loss, first.iou, last.iou
        );
    }
    Ok(text)
}

fn main() -> std::process::ExitCode {
    finish("polygon_fit", run())
}

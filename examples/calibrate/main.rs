//! Finds the rigid motion between two sensors from the boxes that both see, by descent on the overlap of
//! these boxes in space.
//!
//! ```text
//! cargo run --release -p geograd-examples --example calibrate -- --seed 3 --svg calibrate.svg --csv calibrate.csv
//! ```
//!
//! The pairs of boxes are unknown. Some boxes are seen by one sensor only, some are
//! far off, some are false. In every step the boxes are paired anew.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `scene.rs` | what both sensors see, made from a seed |
//! | `descent.rs` | the loss, its derivatives by the motion, the steps |
//! | `picture.rs` | the picture |
mod descent;
mod picture;
mod scene;

use common::cli::{Failure, finish, say, usage};
use common::file::write;
use common::progress::styled;
use descent::State;
use scene::Scene;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

const HELP: &str = "\
The rigid motion between two sensors, from the boxes that both see: descent on the overlap of these
boxes in space over a rotation and a translation. The boxes are made from a seed, with noise, boxes
that one sensor misses, boxes that are far off, and boxes of nothing.

Usage: calibrate [options]

  --seed N       which scene [default: 1]
  --steps N      steps of descent [default: 150]
  --svg FILE     a picture: before, after, and the way
  --csv FILE     the way: iteration,loss,iou,angle_error (radians; iou is the mean of all pairs)
  --help         this text

Exit status: 0 when all went well; 1 for files that cannot be written; 2 for a wrong command line.
";

struct Options {
    seed: u64,
    steps: usize,
    svg: Option<PathBuf>,
    csv: Option<PathBuf>,
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, Failure> {
    use lexopt::prelude::*;
    let mut options = Options {
        seed: 1,
        steps: 150,
        svg: None,
        csv: None,
    };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("seed") => options.seed = parser.value()?.parse()?,
            Long("steps") => options.steps = parser.value()?.parse()?,
            Long("svg") => options.svg = Some(parser.value()?.into()),
            Long("csv") => options.csv = Some(parser.value()?.into()),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected().into()),
        }
    }
    if options.svg.is_some() && options.svg == options.csv {
        return usage("`--svg` and `--csv` are the same file");
    }
    Ok(Some(options))
}

/// A table of some of the states.
fn table(scene: &Scene, states: &[State]) -> String {
    let (a, b) = (scene.a.len(), scene.b.len());
    let mut text = format!("boxes      {a} of the first sensor, {b} of the second\n\n");
    text += "iteration   pairs  overlapping    loss  mean IoU   angle error   shift error\n";
    let last = states.len() - 1;
    let mut shown = vec![0, 5, 10, 20, 50, 100];
    shown.retain(|&i| i < last);
    shown.push(last);
    for i in shown {
        let state = &states[i];
        let overlapping = state.pairs.iter().filter(|pair| pair.overlap > 0.0).count();
        let _ = writeln!(
            text,
            "{i:9} {:7} {overlapping:12} {:7.4} {:9.4}  {:9.4} deg {:10.4} m",
            state.pairs.len(),
            state.loss,
            state.iou,
            state.angle_error.to_degrees(),
            state.shift_error,
        );
    }
    text
}

fn csv(states: &[State]) -> String {
    let mut text = String::from("iteration,loss,iou,angle_error\n");
    for (i, state) in states.iter().enumerate() {
        let _ = writeln!(
            text,
            "{i},{},{},{}",
            state.loss, state.iou, state.angle_error
        );
    }
    text
}

/// Gives the text that is left to print.
fn run(options: &Options) -> Result<String, Failure> {
    let scene = Scene::new(options.seed);
    let mut states = Vec::new();
    let steps = options.steps as u64 + 1;
    let bar = styled("descending {bar:40} {pos}/{len}", steps);
    descent::descend(&scene, options.steps, |state| {
        states.push(state);
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    say(&table(&scene, &states));
    if let Some(path) = &options.csv {
        write(path, &csv(&states))?;
    }
    if let Some(path) = &options.svg {
        write(path, &picture::picture(&scene, &states))?;
        let name = path.display();
        return Ok(format!("\nBefore and after are drawn in {name}.\n"));
    }
    Ok(String::new())
}

fn main() -> ExitCode {
    let done = options().and_then(|options| match options {
        None => Ok(HELP.into()),
        Some(options) => run(&options),
    });
    finish("calibrate", done)
}

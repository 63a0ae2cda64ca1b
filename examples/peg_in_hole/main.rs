//! A hexagonal peg finds its way into a hole that is 2 mm wider on every side: derivatives of its clearance along the
//! motion push a path out of the walls. `cargo run --release -p geograd-examples --example peg_in_hole`; `-- --help` has
//! the options.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `bodies.rs` | peg, block and motion as shapes, generic over the scalar |
//! | `insertion.rs` | clearances with derivatives in batches, and the least squares that move the path |
//! | `cutaway.rs` | the picture |
mod bodies;
mod cutaway;
mod insertion;

use bodies::{ENDS, GROUND, HALF, PLAY};
use common::cli::{Failure, finish, usage};
use common::file::write;
use common::progress::styled;
use geograd::distance3::contacts;
use geograd::motion::{Motion3, Moves as _};
use insertion::Near;
use lexopt::prelude::*;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

const HELP: &str = "\
A hexagonal peg finds its way into a hole that is 2 mm wider on every side: derivatives of its clearance along the
motion push a path out of the walls.

Usage: peg_in_hole [options]

  --points N   points of the path, 4 or more [default: 14]
  --steps N    steps of least squares, 20 or more [default: 30]
  --svg FILE   a picture: the path before and after, and the clearance along it [default: peg_in_hole.svg]
  --help       this text
";

/// Returns the pair with the least clearance.
fn least(all: &[Near]) -> &Near {
    let nearest = all
        .iter()
        .min_by(|a, b| a.clearance.total_cmp(&b.clearance));
    nearest.expect("a path has a piece at least")
}

/// Does what the command line asks for, and returns what to print.
fn run() -> Result<String, Failure> {
    let (mut points, mut steps, mut svg) = (14, 30, PathBuf::from("peg_in_hole.svg"));
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("points") => points = arguments.value()?.parse()?,
            Long("steps") => steps = arguments.value()?.parse()?,
            Long("svg") => svg = arguments.value()?.into(),
            Long("help") | Short('h') => return Ok(HELP.into()),
            other => return Err(other.unexpected().into()),
        }
    }
    if points < 4 {
        return usage("`--points` is 4 or more");
    }
    if steps < 20 {
        return usage("`--steps` is 20 or more");
    }
    let before = insertion::straight(points);
    let bar = styled("{bar:30} {pos}/{len} steps ({elapsed})", steps as u64);
    let start = Instant::now();
    let after = insertion::descend(before.clone(), steps, || bar.inc(1))?;
    let seconds = start.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let (peg, way) = (bodies::peg(ENDS[0]), bodies::moving(ENDS[0], ENDS[1], HALF));
    let hits =
        bodies::block().map(|part| peg.time_of_impact(way.motion, part, Motion3::still()).time);
    let first = hits.into_iter().fold(f64::INFINITY, f64::min);
    let [at_first, at_last] = [
        insertion::clearances(&before)?,
        insertion::clearances(&after)?,
    ];
    let (worst, tight) = (least(&at_first), least(&at_last));
    let ground = contacts(bodies::peg(ENDS[1]), bodies::block()[GROUND], 2.0 * PLAY);
    write(&svg, &cutaway::page([&before, &after], ground.points())?)?;
    Ok(format!(
        "path of {points} points, {steps} steps in {seconds:.2} s\n\
         the straight way hits the block after {:.0} % of it\n\
         least clearance  before {:.3} mm  after {:.3} mm\n\
         a peg that is 1 mm wider on every side has {:.2} mm less\n\
         the peg ends over {} points of the ground, {:.1} mm above it\n",
        100.0 * first,
        1e3 * worst.clearance,
        1e3 * tight.clearance,
        -tight.by_half,
        ground.count,
        1e3 * ground.points[0].gap,
    ))
}

fn main() -> ExitCode {
    finish("peg_in_hole", run())
}

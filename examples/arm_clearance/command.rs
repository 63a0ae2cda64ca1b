//! The command line, and the batch of random configurations.
use crate::arm::{COUNT, Joints, RADIUS, clearance};
use crate::{draw, nearest, path};
use common::cli::{Failure, usage};
use common::file::write;
use common::progress::styled;
use common::random::Draw;
use geograd::kernels::{Cpu, One, function};
use indicatif::ProgressBar;
use lexopt::prelude::*;
use std::f32::consts::TAU;
use std::path::PathBuf;
use std::time::Instant;

const HELP: &str = "\
The clearance of a UR5 among boxes, capsules and a floor, with its derivatives by six joint angles and by the radius
of the links, for random configurations; then a straight path of the joints is pushed out of collision and drawn.

Usage: arm_clearance [options]

  --count N    for so many configurations [default: 100000]
  --seed N     other configurations [default: 1]
  --points N   points of the path, at least 3 [default: 49]
  --steps N    steps of descent [default: 300]
  --svg FILE   a picture: before and after from three sides, and clearance along the path
               [default: arm_clearance.svg]
  --help       this text
";

struct Options {
    count: usize,
    seed: u64,
    points: usize,
    steps: usize,
    svg: PathBuf,
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, Failure> {
    let mut options = Options {
        count: 100_000,
        seed: 1,
        points: 49,
        steps: 300,
        svg: "arm_clearance.svg".into(),
    };
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("count") => options.count = arguments.value()?.parse()?,
            Long("seed") => options.seed = arguments.value()?.parse()?,
            Long("points") => options.points = arguments.value()?.parse()?,
            Long("steps") => options.steps = arguments.value()?.parse()?,
            Long("svg") => options.svg = arguments.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected().into()),
        }
    }
    if options.points < 3 {
        return usage("`--points` is at least 3");
    }
    Ok(Some(options))
}

/// A bar for so many of something.
fn progress(count: usize, things: &str) -> ProgressBar {
    let style = format!("{{bar:30}} {{pos}}/{{len}} {things} ({{elapsed}})");
    styled(&style, count as u64)
}

/// Does what the command line asks for, and says what to print.
pub fn run() -> Result<String, Failure> {
    let Some(options) = options()? else {
        return Ok(HELP.into());
    };
    let told = batch(options.count, options.seed)?;
    let before = path::straight(options.points);
    let bar = progress(options.steps, "steps");
    let start = Instant::now();
    let after = path::descend(before.clone(), options.steps, || bar.inc(1))?;
    let seconds = start.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let paths = [draw::Way::new(before)?, draw::Way::new(after)?];
    write(&options.svg, &draw::page(&paths))?;
    let [least, length] =
        [draw::Way::least, draw::Way::length].map(|of| [of(&paths[0]), of(&paths[1])]);
    Ok(format!(
        "{told}path of {} points, {} steps of descent in {seconds:.2} s\n\
         least clearance  before {:.4} m   after {:.4} m\n\
         length           before {:.3} rad  after {:.3} rad\n",
        options.points, options.steps, least[0], least[1], length[0], length[1]
    ))
}

/// Clearance and derivatives of random configurations, in single precision, on all cores.
fn batch(count: usize, seed: u64) -> Result<String, Failure> {
    let mut draw = Draw::new(&[seed]);
    let mut turn = || (draw.uniform() - 0.5) * TAU;
    let all: Vec<Joints<f32>> = (0..count)
        .map(|_| std::array::from_fn(|_| turn()))
        .collect();
    let (bar, piece) = (progress(count, "configurations"), 1 << 13);
    let start = Instant::now();
    let mut parts = Vec::new();
    for all in all.chunks(piece) {
        parts.push(nearest::clearances(all, RADIUS as f32)?);
        bar.inc(all.len() as u64);
    }
    let seconds = start.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let (plain, start) = (&all[..count.min(piece)], Instant::now());
    Cpu::new().aligned(
        function(clearance).value_grad(),
        (plain, One(RADIUS as f32)),
    )?;
    let plain = plain.len() as f64 / start.elapsed().as_secs_f64();
    let values = || parts.iter().flat_map(|part| &part.values);
    let by_joints = parts.iter().flat_map(|part| &part.by_joints);
    let by_radius = parts.iter().flat_map(|part| &part.by_radius);
    let steep = |by: &Joints<f32>| by.iter().map(|x| x * x).sum::<f32>().sqrt();
    let (each, hit) = (
        1.0 / count.max(1) as f64,
        values().filter(|value| **value < 0.0).count(),
    );
    let thicker = -by_radius.map(|&by| f64::from(by)).sum::<f64>() * each;
    Ok(format!(
        "{count} configurations of {COUNT} pairs with derivatives in {seconds:.3} s, {:.0} a second\n\
         all pairs recorded as one function: {plain:.0} a second\n\
         {:.1} % collide; clearance changes by at most {:.2} m per radian\n\
         links that are 1 mm thicker cost {thicker:.2} mm of clearance on average\n",
        count as f64 / seconds,
        100.0 * each * hit as f64,
        by_joints.map(steep).fold(0.0, f32::max),
    ))
}

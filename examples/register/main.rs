//! A scan of one side of a body, with noise and outliers, is brought onto the body's mesh: by two kinds of iterated
//! closest points, and by derivatives of first and second order. `cargo run --release -p geograd-examples --example
//! register`; `-- --help` has the options.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `scan.rs` | the scan by rays, and where registration starts |
//! | `fitting.rs` | the four ways, step by step |
//! | `overlay.rs` | the picture |
mod fitting;
mod overlay;
mod scan;

use common::blend::{self, Faces};
use common::cli::{Failure, finish, usage};
use common::file::write;
use common::progress::styled;
use fitting::{Course, Way};
use geograd::mesh::{Mesh, MeshTree};
use lexopt::prelude::*;
use scan::{Rules, Scan};
use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

const HELP: &str = "\
A scan of one side of a body, with noise and outliers, is brought onto the body's mesh: by closest points, by planes, by
Gauss and Newton's method and by Newton's with exact Hessians, each from the same starts.

Usage: register [options]

  --points N      points of a scan, 20 or more [default: 2000]
  --noise MM      standard deviation of depths in mm [default: 0.3]
  --outliers P    percent of points that are anywhere, below 50 [default: 10]
  --turn DEGREES  the angle by which starts are wrong [default: 25]
  --shift MM      the way by which starts are wrong [default: 15]
  --starts N      scans with a start each [default: 20]
  --steps N       steps of a registration at most [default: 200]
  --cell MM       the edge of a cell of the mesh in mm, 1 to 12 [default: 5]
  --seed N        other scans [default: 1]
  --svg FILE      a picture of the first scan: before, after, and how far each way is from its end
                  [default: register.svg]
  --help          this text
";

/// A registration is right within this angle in degrees and this way in millimetres.
const RIGHT: [f64; 2] = [2.0, 2.0];
/// The distance from the end at which steps are counted, in metres.
const NEAR: f64 = 1e-6;

struct Options {
    rules: Rules,
    turn: f64,
    shift: f64,
    starts: u64,
    steps: usize,
    cell: f64,
    svg: PathBuf,
}

/// Returns a number from the command line, between two.
fn number(option: &str, value: &OsString, [low, high]: [f64; 2]) -> Result<f64, Failure> {
    let number: f64 = value.parse()?;
    match (low..=high).contains(&number) {
        true => Ok(number),
        false => usage(format!("`{option} {number}`: {low} to {high}")),
    }
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, Failure> {
    let mut options = Options {
        rules: Rules {
            points: 2000,
            noise: 0.3e-3,
            outliers: 0.1,
            seed: 1,
        },
        turn: 25.0,
        shift: 15e-3,
        starts: 20,
        steps: 200,
        cell: 5e-3,
        svg: "register.svg".into(),
    };
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("points") => options.rules.points = arguments.value()?.parse()?,
            Long("noise") => {
                options.rules.noise = 1e-3 * number("--noise", &arguments.value()?, [0.0, 20.0])?
            }
            Long("outliers") => {
                options.rules.outliers =
                    1e-2 * number("--outliers", &arguments.value()?, [0.0, 49.0])?;
            }
            Long("turn") => options.turn = number("--turn", &arguments.value()?, [0.0, 180.0])?,
            Long("shift") => {
                options.shift = 1e-3 * number("--shift", &arguments.value()?, [0.0, 1000.0])?
            }
            Long("starts") => options.starts = arguments.value()?.parse()?,
            Long("steps") => options.steps = arguments.value()?.parse()?,
            Long("cell") => {
                options.cell = 1e-3 * number("--cell", &arguments.value()?, [1.0, 12.0])?
            }
            Long("seed") => options.rules.seed = arguments.value()?.parse()?,
            Long("svg") => options.svg = arguments.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected().into()),
        }
    }
    if options.rules.points < 20 {
        return usage("`--points` is 20 or more");
    }
    if options.starts == 0 || options.steps == 0 {
        return usage("`--starts` and `--steps` are 1 or more");
    }
    Ok(Some(options))
}

/// The middle one of some numbers; NaN of none.
fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut all: Vec<f64> = numbers.collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
}

/// A row of the table: the share that is right, and medians of those.
fn told(way: Way, scans: &[Scan], courses: &[Course]) -> String {
    let is_right = |k: &usize| {
        let [angle, shift] = scan::error(courses[*k].end(), scans[*k].truth);
        angle.to_degrees() < RIGHT[0] && 1e3 * shift < RIGHT[1]
    };
    let right: Vec<usize> = (0..scans.len()).filter(is_right).collect();
    let of = |number: &dyn Fn(usize) -> f64| median(right.iter().map(|&k| number(k)));
    let steps = |k: usize| (courses[k].poses.len() - 1) as f64;
    let error = |k: usize| scan::error(courses[k].end(), scans[k].truth);
    format!(
        "{:<14}{:>9.1}{:>8.0}{:>10.0}{:>10.2}{:>10.1}{:>11.4}{:>11.4}{:>11.4}\n",
        way.name(),
        100.0 * right.len() as f64 / scans.len() as f64,
        of(&steps),
        of(&|k| courses[k].steps_to(NEAR, &scans[k].points) as f64),
        of(&|k| 1e3 * courses[k].seconds / steps(k)),
        of(&|k| 1e3 * courses[k].seconds),
        of(&|k| error(k)[0].to_degrees()),
        of(&|k| 1e3 * error(k)[1]),
        of(&|k| 1e6 * courses[k].loss / scans[k].points.len() as f64),
    )
}

/// Does what the command line asks for, and returns what to print.
fn run() -> Result<String, Failure> {
    let Some(options) = options()? else {
        return Ok(HELP.into());
    };
    let body = blend::kettle();
    let Faces { vertices, faces } = Faces::of(&body, options.cell);
    let work = |error: geograd::mesh::MeshFault| Failure::Work(error.to_string());
    let mesh = Mesh::new(&vertices, &faces).map_err(work)?;
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).map_err(work)?;
    let rules = options.rules;
    // Noise beyond twice its deviation counts less.
    let width = (2.0 * rules.noise).max(1e-5);
    let bar = styled(
        "{bar:30} {pos}/{len} registrations ({elapsed})",
        4 * options.starts,
    );
    let mut scans = Vec::new();
    let mut courses: [Vec<Course>; 4] = Default::default();
    for k in 0..options.starts {
        let seed = rules.seed.wrapping_add(k);
        let scan = scan::taken(&surface, &Rules { seed, ..rules })?;
        let start = scan::start(scan.truth, options.turn.to_radians(), options.shift, seed);
        for (way, courses) in Way::ALL.into_iter().zip(&mut courses) {
            let points = &scan.points;
            let course = fitting::registered(way, &surface, points, start, width, options.steps)?;
            courses.push(course);
            bar.inc(1);
        }
        scans.push(scan);
    }
    bar.finish_and_clear();
    let firsts = [0, 1, 2, 3].map(|k| &courses[k][0]);
    let mesh = Faces { vertices, faces };
    write(&options.svg, &overlay::page(&mesh, &scans[0], firsts))?;
    let mut text = format!(
        "{} of {} faces; {} scans of {} points, noise {:.2} mm, {:.0} % outliers\n\
         starts are turned by {}° and shifted by {} mm; right is within {}° and {} mm; medians of those\n\
         {:<14}{:>9}{:>8}{:>10}{:>10}{:>10}{:>11}{:>11}{:>11}\n",
        body.name,
        mesh.faces.len(),
        options.starts,
        rules.points,
        1e3 * rules.noise,
        100.0 * rules.outliers,
        options.turn,
        1e3 * options.shift,
        RIGHT[0],
        RIGHT[1],
        "way",
        "right, %",
        "steps",
        "to 1 µm",
        "ms/step",
        "ms",
        "angle, °",
        "shift, mm",
        "loss, mm²",
    );
    for (way, courses) in Way::ALL.into_iter().zip(&courses) {
        let _ = write!(text, "{}", told(way, &scans, courses));
    }
    Ok(text)
}

fn main() -> ExitCode {
    finish("register", run())
}

//! A gripper with two fingers finds where to take bodies off a table: pose and opening by the derivatives of signed
//! distances from their meshes. `cargo run --release -p geograd-examples --example grasp`; `-- --help` has the options.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `gripper.rs` | fingers and palm, generic over the scalar |
//! | `closing.rs` | least squares for all starts at once, and the judgement of a grasp |
//! | `brute_force.rs` | the same judgement by comparing all faces, with formulas of its own |
//! | `gallery.rs` | the picture |
mod brute_force;
mod closing;
mod gallery;
mod gripper;

use closing::{Judged, Scene};
use common::blend::{self, Blend, Faces};
use common::cli::{Failure, finish, usage};
use common::file::write;
use common::progress::styled;
use gallery::Shown;
use geograd::mesh::{ClosedMesh, Mesh, MeshFault, MeshTree};
use gripper::Grasp;
use lexopt::prelude::*;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

const HELP: &str = "\
A gripper with two fingers finds where to take five bodies off a table. Least squares with derivatives of signed distances
move it until both fingers touch, overlap nothing, and hold by friction. A comparison of all faces checks every grasp.

Usage: grasp [options]

  --body NAME    only this one: kettle, bracket, mug, bone or hammer
  --starts N     random starts of every body [default: 256]
  --steps N      steps of least squares [default: 80]
  --cell MM      the edge of a cell of the meshes in mm, 1 to 8 [default: 5]
  --seed N       other starts [default: 1]
  --svg FILE     a picture of the best grasps and their starts [default: grasp.svg]
  --help         this text
";

struct Options {
    bodies: Vec<Blend>,
    starts: usize,
    steps: usize,
    cell: f64,
    seed: u64,
    svg: PathBuf,
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, Failure> {
    let mut options = Options {
        bodies: blend::all().into(),
        starts: 256,
        steps: 80,
        cell: 5e-3,
        seed: 1,
        svg: "grasp.svg".into(),
    };
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("body") => {
                let name = arguments.value()?.string()?;
                options.bodies.retain(|body| body.name == name);
                if options.bodies.is_empty() {
                    return usage(format!("`--body {name}`: no such body"));
                }
            }
            Long("starts") => options.starts = arguments.value()?.parse()?,
            Long("steps") => options.steps = arguments.value()?.parse()?,
            Long("cell") => options.cell = 1e-3 * arguments.value()?.parse::<f64>()?,
            Long("seed") => options.seed = arguments.value()?.parse()?,
            Long("svg") => options.svg = arguments.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected().into()),
        }
    }
    if options.starts == 0 || options.steps == 0 {
        return usage("`--starts` and `--steps` are 1 or more");
    }
    if !(1e-3..=8e-3).contains(&options.cell) {
        return usage("`--cell` is 1 to 8");
    }
    Ok(Some(options))
}

/// The grasps of a body.
struct Outcome {
    body: Faces,
    starts: Vec<Grasp<f64>>,
    /// Good grasps with the numbers of their starts, as judged with the tree and without.
    good: Vec<(usize, Grasp<f64>, [Judged; 2])>,
    seconds: f64,
}

impl Outcome {
    fn of(body: &Blend, options: &Options, told: impl Fn()) -> Result<Self, Failure> {
        let work = |fault: MeshFault| Failure::Work(fault.to_string());
        let body = Faces::of(body, options.cell);
        let mesh = Mesh::new(&body.vertices, &body.faces).map_err(work)?;
        let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).map_err(work)?);
        let scene = Scene::new(tree.on(&mesh).map_err(work)?, &closed);
        let starts = closing::starts(&scene, options.starts, options.seed);
        let clock = Instant::now();
        let found = closing::closed(&scene, starts.clone(), options.steps, told)?;
        let seconds = clock.elapsed().as_secs_f64();
        let settled = closing::settled(&scene, found)?;
        let settled = settled.into_iter().enumerate();
        let settled: Vec<_> = settled.filter_map(|(k, grasp)| Some((k, grasp?))).collect();
        let grasps: Vec<_> = settled.iter().map(|settled| settled.1).collect();
        let judged = closing::judged(&scene, &grasps)?;
        let mut good = Vec::new();
        for ((k, grasp), judged) in settled.into_iter().zip(judged) {
            if judged.is_good(grasp[6]) {
                let again = brute_force::judged(&body, gripper::parts(grasp));
                good.push((k, grasp, [judged, again]));
            }
        }
        good.sort_by(|a, b| b.2[0].score().total_cmp(&a.2[0].score()));
        Ok(Outcome {
            starts,
            good,
            seconds,
            body,
        })
    }
    /// The largest difference of a gap as judged twice, in metres.
    fn difference(&self) -> f64 {
        let gaps = self
            .good
            .iter()
            .flat_map(|(_, _, [a, b])| a.gaps.into_iter().zip(b.gaps));
        gaps.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
    fn row(&self, name: &str, steps: usize) -> String {
        let count = self.starts.len();
        let rate = (count * steps) as f64 / self.seconds;
        let head = format!(
            "{name:<9}{:>7}{:>9.1}{:>11.0}",
            self.body.faces.len(),
            100.0 * self.good.len() as f64 / count as f64,
            rate,
        );
        let Some((_, grasp, [_, again])) = self.good.first() else {
            return format!("{head}  no grasp\n");
        };
        let agreed = self
            .good
            .iter()
            .filter(|(_, grasp, [_, again])| again.is_good(grasp[6]));
        format!(
            "{head}{:>11}{:>13.1e}{:>9.1}{:>8.1}{:>8.1}{:>10.1}{:>10.2}{:>8.2}\n",
            format!("{}/{}", agreed.count(), self.good.len()),
            1e3 * self.difference(),
            1e3 * grasp[6],
            again.angles[0].to_degrees(),
            again.angles[1].to_degrees(),
            1e3 * again.lever,
            1e6 * again.gaps[0],
            1e6 * again.gaps[1],
        )
    }
}

/// Does what the command line asks for, and returns what to print.
fn run() -> Result<String, Failure> {
    let Some(options) = options()? else {
        return Ok(HELP.into());
    };
    let all = options.bodies.len() * options.steps;
    let bar = styled("{bar:30} {pos}/{len} steps ({elapsed})", all as u64);
    let mut outcomes = Vec::new();
    for body in &options.bodies {
        outcomes.push((body.name, Outcome::of(body, &options, || bar.inc(1))?));
    }
    bar.finish_and_clear();
    let mut text = format!(
        "{} starts, {} steps; a good grasp touches within {:.0} µm, overlaps nothing, and holds by friction of {:.1}°\n\
         the best one: opening, angles between the line of contacts and normals, way of the centroid from it, gaps\n\
         {:<9}{:>7}{:>9}{:>11}{:>11}{:>13}{:>9}{:>16}{:>10}{:>18}\n",
        options.starts,
        options.steps,
        1e6 * closing::TOUCHING,
        closing::cone().to_degrees(),
        "body",
        "faces",
        "good, %",
        "steps/s",
        "checked",
        "differ, mm",
        "mm",
        "angles, °",
        "lever, mm",
        "gaps, µm",
    );
    let mut shown = Vec::new();
    for (name, outcome) in &outcomes {
        text += &outcome.row(name, options.steps);
        if let Some(&(start, grasp, [judged, _])) = outcome.good.first() {
            let words = common::svg::headed(
                &format!("{:.1} mm", 1e3 * grasp[6]),
                format_args!(
                    " open; {:.1}° and {:.1}° beside the normals",
                    judged.angles[0].to_degrees(),
                    judged.angles[1].to_degrees()
                ),
            );
            shown.push(Shown {
                name,
                body: &outcome.body,
                grasps: [outcome.starts[start], grasp],
                words,
            });
        }
    }
    write(&options.svg, &gallery::page(&shown))?;
    Ok(text)
}

fn main() -> ExitCode {
    finish("grasp", run())
}

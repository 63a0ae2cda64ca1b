//! The command line, and what is told about a batch.
use crate::draw::posture;
use crate::{Arm, batch, draw, program};
use common::cli::{Failure, Wish, usage};
use common::progress::styled;
use indicatif::ProgressBar;
use lexopt::prelude::*;
use std::f32::consts::{PI, TAU};
use std::path::PathBuf;
use std::time::Duration;

const HELP: &str = "\
The clearance of a two-link arm from a wall and a post, with its derivatives, for a million postures.

Usage: custom_shape [options]

  --count N     for so many postures [default: 1000000]
  --backend B   on cpu, gpu or auto [default: cpu]
  --check       instead: check the derivatives in f64 and f32, and print the report
  --program     instead: what the clearance was recorded as, and what it costs
  --wgsl        instead: the same as a function for GPUs
  --svg FILE    instead: a picture of the clearance over both joints, with its derivatives
  --help        this text
";

/// Does what the command line asks for, and says what to print.
pub fn run() -> Result<String, Failure> {
    type Job = Box<dyn Fn() -> Result<String, Failure>>;
    let mut arguments = lexopt::Parser::from_env();
    let (mut count, mut backend, mut instead) = (None, None, None::<Job>);
    let mut is_alone = true;
    while let Some(argument) = arguments.next()? {
        let job: Job = match argument {
            Long("count") if count.is_none() && instead.is_none() => {
                count = Some(arguments.value()?.parse()?);
                continue;
            }
            Long("backend") if backend.is_none() && instead.is_none() => {
                backend = Some(Wish::from_name(&arguments.value()?.string()?)?);
                continue;
            }
            #[cfg(feature = "check")]
            Long("check") => Box::new(crate::check),
            #[cfg(not(feature = "check"))]
            Long("check") => return usage("a build with `--features check` checks derivatives"),
            Long("program") => Box::new(|| program(false)),
            Long("wgsl") => Box::new(|| program(true)),
            Long("svg") => {
                let file = PathBuf::from(arguments.value()?);
                Box::new(move || draw::write(&file))
            }
            Long("help") | Short('h') => Box::new(|| Ok(HELP.into())),
            other => return Err(other.unexpected().into()),
        };
        is_alone &= instead.is_none();
        instead = Some(job);
    }
    match instead {
        None => {
            let machine = backend.unwrap_or(Wish::Cpu).machine("custom_shape")?;
            batch(count.unwrap_or(1_000_000), &machine)
        }
        Some(job) if is_alone && count.is_none() && backend.is_none() => job(),
        Some(_) => usage("what is done instead of a batch takes no other option"),
    }
}

/// So many postures, evenly spread over both joints.
pub fn postures(count: usize) -> Vec<Arm<f32>> {
    let side = (count as f64).sqrt().ceil() as usize;
    let angle = |i: usize| TAU * i as f32 / side as f32 - PI;
    let all = (0..count).map(|k| posture(angle(k % side), angle(k / side)));
    all.collect()
}

/// A bar for so many postures.
pub fn progress(count: usize) -> ProgressBar {
    styled("{bar:30} {pos}/{len} postures ({elapsed})", count as u64)
}

/// The summary of a batch.
pub fn summary(took: Duration, values: &[f32], derivatives: &[Arm<f32>]) -> String {
    let (count, seconds) = (values.len(), took.as_secs_f64());
    let rate = count as f64 / seconds / 1e6;
    let hit = values.iter().filter(|value| **value < 0.0).count();
    let share = 100.0 * hit as f64 / count.max(1) as f64;
    let steep = derivatives.iter().map(|by| by.shoulder.hypot(by.elbow));
    let steepest = steep.fold(0.0, f32::max);
    format!(
        "{count} postures with derivatives in {seconds:.3} s, {rate:.2} million a second\n\
         {share:.1} % collide; clearance changes by at most {steepest:.2} m per radian\n"
    )
}

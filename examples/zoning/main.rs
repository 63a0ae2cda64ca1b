//! Districts of a city: each has a station and a capacity, and all have exactly their capacity of the city's area, with
//! the shortest ways to the stations. `cargo run --release -p geograd-examples --example zoning`; `-- --help` has the
//! options.
//!
//! Districts are power cells: a weight for each station says how far its district reaches. Newton's method finds the
//! weights with the sparse derivatives of areas by weights, and stations move to the centroids of their districts.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `city.rs` | the city, its stations and their capacities |
//! | `balance.rs` | weights by Newton's method, moves of stations |
//! | `draw.rs` | the picture |
mod balance;
mod city;
mod draw;

use balance::{Plan, Round};
use city::City;
use common::cli::{Failure, finish, usage};
use common::file::write;
use common::progress::styled;
use lexopt::prelude::*;
use std::fmt::Write as _;
use std::path::PathBuf;

const HELP: &str = "\
Divides a city into districts with given capacities and short ways to their stations, and draws it before and after.

Usage: zoning [options]

  --seed N       another city [default: 1]
  --districts N  districts, 2 to 2000 [default: 40]
  --rounds N     moves of the stations [default: 40]
  --svg FILE     a picture [default: zoning.svg]
  --csv FILE     round,steps,error,way of every round: steps of Newton's method, the largest error of an area
                 relative to its capacity, and the root of the mean squared way to a station, in km
  --help         this text
";

struct Options {
    seed: u64,
    districts: usize,
    rounds: usize,
    svg: PathBuf,
    csv: Option<PathBuf>,
}

fn options() -> Result<Option<Options>, Failure> {
    let mut options = Options {
        seed: 1,
        districts: 40,
        rounds: 40,
        svg: "zoning.svg".into(),
        csv: None,
    };
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("seed") => options.seed = arguments.value()?.parse()?,
            Long("districts") => options.districts = arguments.value()?.parse()?,
            Long("rounds") => options.rounds = arguments.value()?.parse()?,
            Long("svg") => options.svg = arguments.value()?.into(),
            Long("csv") => options.csv = Some(arguments.value()?.into()),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected().into()),
        }
    }
    if options.csv.as_ref() == Some(&options.svg) {
        return usage("`--svg` and `--csv` are the same file");
    }
    if !(2..=2000).contains(&options.districts) {
        return usage(format!("`--districts {}`: 2 to 2000", options.districts));
    }
    Ok(Some(options))
}

fn run() -> Result<String, Failure> {
    let Some(options) = options()? else {
        return Ok(HELP.into());
    };
    let city = City::random(options.seed, options.districts);
    let bar = styled(
        "{bar:30} {pos}/{len} rounds ({elapsed})",
        options.rounds as u64,
    );
    let plan = Plan::run(&city, options.rounds, || bar.inc(1))?;
    bar.finish_and_clear();
    write(&options.svg, &draw::page(&city, &plan)?)?;
    if let Some(file) = &options.csv {
        let mut table = String::from("round,steps,error,way\n");
        for (k, round) in plan.rounds.iter().enumerate() {
            let Round { steps, error, way } = round;
            let _ = writeln!(table, "{k},{steps},{error:e},{way}");
        }
        write(file, &table)?;
    }
    let (first, last) = (&plan.rounds[0], &plan.rounds[plan.rounds.len() - 1]);
    Ok(format!(
        "{} districts of {:.0} km²\n\
         nearest station  {:.0} % of a capacity at most, {:.0} % at least\n\
         balanced         largest error {:.1e} after {} steps of Newton's method, root mean square way {:.3} km\n\
         stations moved   largest error {:.1e}, root mean square way {:.3} km\n",
        city.stations.len(),
        city.area(),
        100.0 * plan.loads.iter().copied().fold(0.0, f64::max),
        100.0 * plan.loads.iter().copied().fold(f64::INFINITY, f64::min),
        first.error,
        first.steps,
        first.way,
        last.error,
        last.way
    ))
}

fn main() -> std::process::ExitCode {
    finish("zoning", run())
}

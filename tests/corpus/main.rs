//! How often a checker of gradients errs: thousands of planted faults in everyday functions.
//!
//! `cargo run --release -p geograd-tests --example corpus`; `-- --help` has the options.
use geograd_tests::corpus::FIELDS;
use geograd_tests::corpus::checkers::{CHECKERS, Checker};
use geograd_tests::corpus::faults::faults;
use geograd_tests::corpus::function::Function;
use geograd_tests::corpus::inputs::Inputs;
use geograd_tests::corpus::measure::measure;
use geograd_tests::corpus::record::verdict;
use geograd_tests::corpus::tables::{Run, csv, tables};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::fmt::Write;
use std::io::Write as _;
use std::process::ExitCode;

const HELP: &str = "\
Plants faults in the gradients of everyday functions and counts which of them a checker misses, and
which right gradients it refuses.

  --checker NAME  only this one (several times for several): geograd (with the function's generic
                  source), geograd-closures (value and gradient only), differences (one step, as
                  PyTorch's gradcheck), directions (random ones, as JAX's check_grads)
  --only NAME     only functions or fields whose name contains NAME
  --faults COUNT  so many faults of each function, chosen at random; all unless told
  --seed N        what inputs are drawn from, 1 unless told
  --seeds N       so many seeds, one after the other, 1 unless told
  --csv FILE      every question and every answer as a table
  --list          the functions with their numbers of inputs, faults and kinks, and nothing else
  --help          this text

The exit status is 0 when every error of geograd's harness is of a recorded kind, 1 when one is not,
2 for a wrong argument.
";

struct Options {
    checkers: Vec<(&'static str, &'static dyn Checker)>,
    only: String,
    faults: Option<usize>,
    seeds: std::ops::Range<u64>,
    csv: Option<String>,
    list: bool,
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, String> {
    let (mut seed, mut seeds) = (1_u64, 1_u64);
    let mut options = Options {
        checkers: Vec::new(),
        only: String::new(),
        faults: None,
        seeds: 0..0,
        csv: None,
        list: false,
    };
    let number = |name: &str, text: String| {
        text.parse::<u64>()
            .map_err(|_| format!("{name} needs a whole number, not {text}"))
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--checker" => {
                let name = value()?;
                let found = CHECKERS.iter().find(|(known, _)| *known == name);
                let names: Vec<&str> = CHECKERS.iter().map(|(name, _)| *name).collect();
                let found = found.ok_or(format!(
                    "no checker is named {name}; there are {}",
                    names.join(", ")
                ))?;
                options.checkers.push(*found);
            }
            "--only" => options.only = value()?,
            "--faults" => options.faults = Some(number("--faults", value()?)? as usize),
            "--seed" => seed = number("--seed", value()?)?,
            "--seeds" => seeds = number("--seeds", value()?)?,
            "--csv" => options.csv = Some(value()?),
            "--list" => options.list = true,
            "--help" | "-h" => return Ok(None),
            _ => return Err(format!("unknown argument {argument}\nTry `--help`.")),
        }
    }
    if seeds == 0 {
        return Err("--seeds needs at least one".to_owned());
    }
    options.seeds = seed..seed.saturating_add(seeds);
    if options.checkers.is_empty() {
        options.checkers = CHECKERS.to_vec();
    }
    Ok(Some(options))
}

fn list(functions: &[(&'static str, &'static Function)]) -> String {
    let mut out = String::new();
    for (field, function) in functions {
        let inputs = Inputs::new(function, 1, 1);
        let faults = faults(function, &inputs).len();
        let (inputs, kinks) = (function.domain.len(), function.kinks.len());
        let _ = writeln!(
            out,
            "{field:<10} {:<26} {inputs:>3} inputs {faults:>5} faults {kinks:>2} kinks",
            function.name
        );
    }
    out
}

fn main() -> ExitCode {
    let options = match options() {
        Ok(Some(options)) => options,
        Ok(None) => {
            print!("{HELP}");
            return ExitCode::SUCCESS;
        }
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    let wanted = |field: &str, function: &Function| {
        field.contains(&options.only) || function.name.contains(&options.only)
    };
    let functions: Vec<(&'static str, &'static Function)> = FIELDS
        .iter()
        .flat_map(|(field, functions)| functions.iter().map(move |function| (*field, function)))
        .filter(|(field, function)| wanted(field, function))
        .collect();
    if functions.is_empty() {
        eprintln!("no function and no field is named {}", options.only);
        return ExitCode::from(2);
    }
    if options.list {
        // A reader who has seen enough may go.
        let _ = std::io::stdout().write_all(list(&functions).as_bytes());
        return ExitCode::SUCCESS;
    }
    let jobs: Vec<(u64, &'static str, &'static Function)> = options
        .seeds
        .clone()
        .flat_map(|seed| {
            functions
                .iter()
                .map(move |(field, function)| (seed, *field, *function))
        })
        .collect();
    let style = ProgressStyle::with_template(
        "{bar:30} {pos}/{len} functions {msg} ({elapsed}, {eta} left)",
    );
    let bar = ProgressBar::new(jobs.len() as u64).with_style(style.expect("a valid template"));
    let checkers: Vec<&dyn Checker> = options
        .checkers
        .iter()
        .map(|(_, checker)| *checker)
        .collect();
    let runs: Vec<Run> = jobs
        .into_par_iter()
        .map(|(seed, field, function)| {
            bar.set_message(function.name);
            let findings = measure(function, &checkers, seed, options.faults, &|| bar.tick());
            bar.inc(1);
            Run {
                field,
                seed,
                findings,
            }
        })
        .collect();
    bar.finish_and_clear();
    let names: Vec<&str> = options.checkers.iter().map(|(name, _)| *name).collect();
    print!("{}", tables(&names, &runs));
    let mut unknown = 0;
    for (k, name) in names.iter().enumerate() {
        if let Some(verdict) = verdict(name, k, &runs) {
            print!("{}", verdict.text);
            unknown += verdict.unknown;
        }
    }
    if let Some(path) = &options.csv
        && let Err(error) = std::fs::write(path, csv(&names, &runs))
    {
        eprintln!("{path}: {error}");
        return ExitCode::from(2);
    }
    ExitCode::from(u8::from(unknown > 0))
}

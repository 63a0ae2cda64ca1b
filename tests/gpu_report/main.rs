//! One command that runs parity and benches on any GPU, and writes the table of BENCHMARKS.md.
//!
//! ```text
//! cargo run --release -p geograd-tests --features gpu --example gpu_report              # to read
//! cargo run --release -p geograd-tests --features gpu --example gpu_report -- --write   # into BENCHMARKS.md
//! GEOGRAD_GPU=cpu cargo run … -- --items 1000 --pairs 40000                             # a driver in software
//! ```
mod forms;
mod rates;
mod table;

use geograd::kernels::gpu::{Gpu, Options};
use geograd::kernels::{Backend, dynamic};
use geograd::{Error, Unrecordable};
use geograd_tests::listed::parity::{Compared, compare};
use geograd_tests::listed::{Form, Listed, list};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::process::ExitCode;
use std::time::Duration;
use table::{Parity, Report};

const HELP: &str = "\
Runs every row of the library on a GPU and on the CPU, and compares: values, gradients, all pairs,
their adjoints, paths. Then measures the rates of the calls that are on hot paths.

Usage: gpu_report [options]

  --write       puts the tables into BENCHMARKS.md, between its marks
  --op NAME     parity of the row NAME, or of rows whose spelling contains it, as 'iou(obb2,' [default: all rows]
  --forms       instead of the tables: rates of every form of these rows on both machines
  --list        instead: the rows, a line each
  --items N     items of a batch of parity [default: 10000]
  --pairs N     pairs of a measured batch [default: 16000000]
  --help        this text

The environment variable GEOGRAD_GPU chooses the GPU: an index, a part of a name, or `cpu`
for a driver in software. The exit status is 0; 1 if a row differs by more than its bound;
2 without a GPU or for a wrong argument.
";

/// What the command line asks for.
struct Settings {
    write: bool,
    op: String,
    forms: bool,
    list: bool,
    items: usize,
    pairs: usize,
}

/// What ends the program early.
enum Failure {
    Help,
    Usage(String),
    Gpu(Error),
    File(String),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Gpu(error)
    }
}

impl Settings {
    fn new(mut words: impl Iterator<Item = String>) -> Result<Self, Failure> {
        let mut settings = Settings {
            write: false,
            op: String::new(),
            forms: false,
            list: false,
            items: 10_000,
            pairs: 16_000_000,
        };
        while let Some(word) = words.next() {
            let mut value = || {
                let value = words.next();
                value.ok_or_else(|| Failure::Usage(format!("`{word}` needs a value")))
            };
            let number = |text: String| match text.parse() {
                Ok(number @ 64..=1_000_000_000) => Ok(number),
                _ => Err(Failure::Usage(format!(
                    "`{text}`: it is from 64 to a billion"
                ))),
            };
            match word.as_str() {
                "--write" => settings.write = true,
                "--forms" => settings.forms = true,
                "--list" => settings.list = true,
                "--op" => settings.op = value()?,
                "--items" => settings.items = number(value()?)?,
                "--pairs" => settings.pairs = number(value()?)?,
                "--help" | "-h" => return Err(Failure::Help),
                _ => return Err(Failure::Usage(format!("`{word}` is not an option"))),
            }
        }
        Ok(settings)
    }
}

/// Runs a form of a row on both machines; `None` for what a GPU refuses.
fn parity(gpu: &Gpu, op: &Listed, form: Form, items: usize) -> Result<Option<Compared>, Error> {
    let on_gpu = match op.make(form, Backend::Gpu(gpu), items) {
        Err(Error::Program(Unrecordable::Search)) => return Ok(None),
        made => made?,
    };
    let on_cpu = op.make(form, Backend::Cpu, items)?;
    compare(&*on_cpu, &on_gpu.numbers()?).map(Some)
}

/// A bar of so many steps, on the terminal alone.
fn bar(steps: usize, what: &str) -> ProgressBar {
    let style = "{prefix} {bar:32} {pos}/{len} {msg} {eta} left";
    let style = ProgressStyle::with_template(style).expect("a valid template");
    let bar = ProgressBar::new(steps as u64).with_style(style);
    bar.set_prefix(what.to_owned());
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// The row of a spelling, or else all rows whose spelling contains the text; with their spellings.
fn rows<'a>(names: &'a [dynamic::Name], asked: &str) -> Result<Vec<(Listed, &'a str)>, Failure> {
    let is_whole = names.iter().any(|x| x.spelling == asked);
    let is_asked = |x: &&dynamic::Name| match is_whole {
        true => x.spelling == asked,
        false => x.spelling.contains(asked),
    };
    let rows: Vec<(Listed, &str)> = list()
        .into_iter()
        .filter_map(|op| {
            let mut own = names.iter().filter(|x| x.row == op.name);
            let name = own.find(is_asked)?;
            Some((op, &*name.spelling))
        })
        .collect();
    match rows.is_empty() {
        true => Err(Failure::Usage(format!(
            "`--op {asked}`: no row has that name"
        ))),
        false => Ok(rows),
    }
}

fn report(gpu: &Gpu, rows: &[(Listed, &str)], settings: &Settings) -> Result<Report, Failure> {
    let progress = bar(rows.len(), "parity");
    // Drivers compile a kernel on one thread, which is most of the time: rows go side by side.
    let of_row = |(op, spelling): &(Listed, &str)| -> Result<Vec<Parity>, Error> {
        progress.set_message((*spelling).to_owned());
        let forms = op.forms().into_iter().map(|form| {
            Ok(Parity {
                row: (*spelling).to_owned(),
                form: form.title(),
                found: parity(gpu, op, form, settings.items)?,
            })
        });
        let forms = forms.collect();
        progress.inc(1);
        forms
    };
    let all: Vec<Vec<Parity>> = rows.par_iter().map(of_row).collect::<Result<_, _>>()?;
    progress.finish_and_clear();
    let rates = rates::all(gpu, settings.pairs, bar)?;
    Ok(Report {
        adapter: gpu.adapter().clone(),
        parity: all.into_iter().flatten().collect(),
        rates,
        items: settings.items,
    })
}

fn run() -> Result<bool, Failure> {
    let settings = Settings::new(std::env::args().skip(1))?;
    let names = dynamic::names();
    let rows = rows(&names, &settings.op)?;
    if settings.list {
        rows.iter().for_each(|(_, spelling)| println!("{spelling}"));
        return Ok(true);
    }
    let mut options = Options::default();
    options.timing = true;
    let gpu = Gpu::with(&options)?;
    eprintln!("{gpu}");
    if settings.forms {
        return Ok(forms::run(&gpu, &rows, settings.items)?);
    }
    let report = report(&gpu, &rows, &settings)?;
    let text = report.text();
    println!("{text}");
    if settings.write {
        table::write(&text).map_err(Failure::File)?;
    }
    for wrong in report.wrong() {
        eprintln!("beyond its bound: {wrong}");
    }
    Ok(report.wrong().is_empty())
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(Failure::Help) => {
            println!("{HELP}");
            ExitCode::SUCCESS
        }
        Err(failure) => {
            let why = match failure {
                Failure::Usage(why) | Failure::File(why) => why,
                Failure::Gpu(error) => error.to_string(),
                Failure::Help => String::new(),
            };
            eprintln!("gpu_report: {why}");
            ExitCode::from(2)
        }
    }
}

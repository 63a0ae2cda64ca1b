//! How often a checker of gradients errs: thousands of planted faults in everyday functions.
//!
//! `cargo run --release -p geograd-tests --example corpus`; `-- --help` has the options.
use geograd_tests::corpus::FIELDS;
use geograd_tests::corpus::checkers::{CHECKERS, Checker};
use geograd_tests::corpus::function::Function;
use geograd_tests::corpus::measure::{Findings, Question, measure};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::collections::BTreeMap;
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

The exit status is 0 when geograd's harness errs no more often than is recorded (in every run that
asks it), 1 when it does, 2 for a wrong argument.
";

/// What is recorded of geograd's harness: more missed faults of a relative size above [`VISIBLE`] per ten thousand, or
/// more refused right gradients per thousand, and the exit status is 1.
const RECORDED: &[(&str, [f64; 2])] = &[("geograd", [0.0, 0.0]), ("geograd-closures", [0.0, 0.0])];
/// Smaller errors of a slope, relative to its usual size, are listed by size and not held against a checker.
const VISIBLE: f64 = 1e-6;

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

/// One function with one seed.
struct Run {
    field: &'static str,
    seed: u64,
    findings: Findings,
}

/// A line of a table: what several questions have in common.
#[derive(Default)]
struct Line {
    functions: std::collections::BTreeSet<&'static str>,
    right: usize,
    faults: usize,
    equivalent: usize,
    /// Of each checker: right ones refused, faults missed, seconds.
    errors: Vec<(usize, usize, f64)>,
}

impl Line {
    fn count(&mut self, question: &Question) {
        self.errors.resize(question.accepted.len(), (0, 0, 0.0));
        match question.kind {
            None => self.right += 1,
            Some(_) => self.faults += 1,
        }
        for ((refused, missed, _), accepted) in self.errors.iter_mut().zip(&question.accepted) {
            match question.kind {
                None => *refused += usize::from(!accepted),
                Some(_) => *missed += usize::from(*accepted),
            }
        }
    }
}

fn share(part: usize, of: usize) -> String {
    match of {
        0 => "-".to_owned(),
        _ => format!("{part} ({:.2} %)", 100.0 * part as f64 / of as f64),
    }
}

/// A table of faults missed by each checker, a line for each group.
fn missed_table(title: &str, options: &Options, lines: &BTreeMap<String, Line>) -> String {
    let mut out = format!("\n{title:<26} {:>8}", "faults");
    for (name, _) in &options.checkers {
        let _ = write!(out, " {:>20}", format!("{name} misses"));
    }
    out.push('\n');
    for (name, line) in lines.iter().filter(|(_, line)| line.faults > 0) {
        let _ = write!(out, "{name:<26} {:>8}", line.faults);
        for (_, missed, _) in &line.errors {
            let _ = write!(out, " {:>20}", share(*missed, line.faults));
        }
        out.push('\n');
    }
    out
}

fn fields_table(options: &Options, lines: &BTreeMap<String, Line>) -> String {
    let mut out = String::new();
    for (k, (name, _)) in options.checkers.iter().enumerate() {
        let _ = writeln!(
            out,
            "\n{name:<18} {:>9} {:>8} {:>11} {:>18} {:>6} {:>18} {:>8}",
            "functions", "faults", "equivalent", "missed", "right", "falsely refused", "seconds"
        );
        for (field, line) in lines {
            let (refused, missed, seconds) = line.errors[k];
            let _ = writeln!(
                out,
                "{field:<18} {:>9} {:>8} {:>11} {:>18} {:>6} {:>18} {seconds:>8.1}",
                line.functions.len(),
                line.faults,
                line.equivalent,
                share(missed, line.faults),
                line.right,
                share(refused, line.right),
            );
        }
    }
    out
}

/// How large an error is, by powers of ten.
fn size(error: f64) -> String {
    if error.is_infinite() {
        return "error not finite".to_owned();
    }
    match error.log10().floor() as i32 {
        power if power >= 0 => "error above 1".to_owned(),
        power if power < -11 => "error below 1e-11".to_owned(),
        power => format!("error above 1e-{:02}", -power),
    }
}

fn csv(options: &Options, runs: &[Run]) -> String {
    let mut out = String::from("seed,field,function,kind,fault,error");
    for (name, _) in &options.checkers {
        let _ = write!(out, ",{name}");
    }
    out.push('\n');
    for run in runs {
        for question in &run.findings.questions {
            let kind = question.kind.map_or("right".to_owned(), |kind| kind.name());
            let (name, what) = (run.findings.function.name, question.what.replace('"', "'"));
            let _ = write!(
                out,
                "{},{},{name},\"{kind}\",\"{what}\",{:e}",
                run.seed, run.field, question.error
            );
            for accepted in &question.accepted {
                out.push_str(if *accepted { ",accepted" } else { ",refused" });
            }
            out.push('\n');
        }
    }
    out
}

/// Prints what a checker of ours got wrong, and says whether that is more than is recorded.
fn errs_more(options: &Options, runs: &[Run]) -> bool {
    let mut more = false;
    for (k, (name, _)) in options.checkers.iter().enumerate() {
        let Some((_, [missed_limit, refused_limit])) =
            RECORDED.iter().find(|(known, _)| known == name)
        else {
            continue;
        };
        let [mut missed, mut faults, mut refused, mut right] = [0_usize; 4];
        println!();
        for run in runs {
            for question in &run.findings.questions {
                let (kind, wrong) = match question.kind {
                    Some(kind) if question.error > VISIBLE => {
                        faults += 1;
                        missed += usize::from(question.accepted[k]);
                        (kind.name(), question.accepted[k])
                    }
                    Some(_) => continue,
                    None => {
                        right += 1;
                        refused += usize::from(!question.accepted[k]);
                        ("right, and refused".to_owned(), !question.accepted[k])
                    }
                };
                if wrong {
                    let (function, what) = (run.findings.function.name, &question.what);
                    println!(
                        "{name}: {function}, {kind}: {what} (error {:.1e}, seed {})",
                        question.error, run.seed
                    );
                }
            }
        }
        let rates = [
            1e4 * missed as f64 / faults.max(1) as f64,
            1e3 * refused as f64 / right.max(1) as f64,
        ];
        let worse = rates[0] > *missed_limit || rates[1] > *refused_limit;
        println!(
            "{name} misses {missed} of {faults} faults with an error above {VISIBLE:e} ({:.1} in ten thousand; recorded \
             {missed_limit}) and refuses {refused} of {right} right gradients ({:.1} in a thousand; recorded \
             {refused_limit}){}",
            rates[0],
            rates[1],
            if worse { ": worse than recorded" } else { "" }
        );
        more |= worse;
    }
    more
}

fn list(functions: &[(&'static str, &'static Function)]) -> String {
    let mut out = String::new();
    for (field, function) in functions {
        let inputs = geograd_tests::corpus::inputs::Inputs::new(function, 1, 1);
        let faults = geograd_tests::corpus::faults::faults(function, &inputs).len();
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
    let [mut fields, mut kinds, mut sizes]: [BTreeMap<String, Line>; 3] = Default::default();
    for run in &runs {
        for name in [run.field, "together"] {
            let line = fields.entry(name.to_owned()).or_default();
            line.functions.insert(run.findings.function.name);
            line.equivalent += run.findings.equivalent;
            run.findings
                .questions
                .iter()
                .for_each(|question| line.count(question));
            for ((_, _, all), seconds) in line.errors.iter_mut().zip(&run.findings.seconds) {
                *all += seconds;
            }
        }
        for question in &run.findings.questions {
            if let Some(kind) = question.kind {
                kinds.entry(kind.name()).or_default().count(question);
                sizes
                    .entry(size(question.error))
                    .or_default()
                    .count(question);
            }
        }
    }
    print!("{}", fields_table(&options, &fields));
    print!("{}", missed_table("kind of fault", &options, &kinds));
    print!(
        "{}",
        missed_table("size, of the usual slope", &options, &sizes)
    );
    let more = errs_more(&options, &runs);
    if let Some(path) = &options.csv
        && let Err(error) = std::fs::write(path, csv(&options, &runs))
    {
        eprintln!("{path}: {error}");
        return ExitCode::from(2);
    }
    ExitCode::from(u8::from(more))
}

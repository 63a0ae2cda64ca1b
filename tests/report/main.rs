//! Checks every operation of the library and prints the table.
//!
//! `cargo run --release -p geograd-tests --example gradient_report`; `-- --help` has the options.
use geograd::Error;
use geograd::ad::check::{Report, SEED, Sampling};
use geograd::kernels::Backend;
use geograd::kernels::dynamic::named_rows;
use geograd::kernels::gpu::Gpu;
use geograd::kernels::identities;
use geograd_tests::fuzzers::{self, Fuzzer};
use geograd_tests::list::{self, Tested};
use indicatif::{ProgressBar, ProgressStyle};
use std::collections::BTreeMap;
use std::process::ExitCode;

const HELP: &str = "\
Checks every operation of the library and prints the table.

  --op NAME       only a verb, as `iou`, or a verb of some shapes, as 'iou(obb2,obb2)'
  --quick         one row of every verb, at every seventh hard case and 60 random inputs
                  unless told: two minutes on two cores, in release
  --samples N     random inputs per operation and format, 1000 unless told; hard
                  cases come on top
  --seed N        what they are drawn from
  --f32, --f64    only one format
  --details       how far apart the witnesses are, and where they come nearest to refusal
  --json          JSON lines instead of the table
  --svg FILE      a picture of the worst case of the (last) operation in f64
  --fuzz COUNT    instead of checking derivatives: so many inputs that nobody would think of
                  (bit patterns, shared coordinates, multiples of 45 degrees, flat ones,
                  the ends of the format, all of it within one shape), shared by the
                  operations in both formats; numbers must be finite and in range as their
                  rows invariance, and all forms must give the same bits; what breaks that is
                  printed as code, as simple as it can be; identities between operations are
                  asked, too
  --identities COUNT
                  the identities alone: so many inputs on grids of few numbers, shared by all
  --gpu           batches on a GPU as a further witness of f32 (needs --features gpu)
  --help          this text

The exit status is 0 when everything is checked, 1 when something is refused, 2 for a
wrong argument, 3 when a GPU was asked for and there is none, or it failed.
";

/// Random inputs of each row in the quick form.
const QUICK: usize = 60;
/// The quick form takes every so many hard cases, of which rows have a thousand.
const QUICK_HARD: usize = 7;

/// The options of the command line.
struct Options {
    rows: Vec<&'static str>,
    quick: bool,
    samples: Option<usize>,
    seed: u64,
    formats: [bool; 2],
    details: bool,
    json: bool,
    svg: Option<String>,
    gpu: bool,
    fuzz: Option<u64>,
    identities: Option<u64>,
}

impl Options {
    fn wants(&self, name: &str, wide: bool) -> bool {
        let is_named = self.rows.is_empty() || self.rows.contains(&name);
        is_named && self.formats[usize::from(wide)]
    }
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, String> {
    let mut options = Options {
        rows: Vec::new(),
        quick: false,
        samples: None,
        seed: SEED,
        formats: [true, true],
        details: false,
        json: false,
        svg: None,
        gpu: false,
        fuzz: None,
        identities: None,
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--op" => options.rows = named_rows(&value()?).map_err(|e| e.to_string())?,
            "--quick" => options.quick = true,
            "--samples" => {
                options.samples = Some(value()?.parse().map_err(|e| format!("{e}"))?);
            }
            "--seed" => options.seed = value()?.parse().map_err(|e| format!("{e}"))?,
            "--fuzz" => options.fuzz = Some(value()?.parse().map_err(|e| format!("{e}"))?),
            "--identities" => {
                options.identities = Some(value()?.parse().map_err(|e| format!("{e}"))?);
            }
            "--svg" => options.svg = Some(value()?),
            "--details" => options.details = true,
            "--json" => options.json = true,
            "--f32" => options.formats = [true, false],
            "--f64" => options.formats = [false, true],
            "--gpu" => options.gpu = true,
            "--help" | "-h" => return Ok(None),
            _ => return Err(format!("unknown argument {argument}\nTry `--help`.")),
        }
    }
    Ok(Some(options))
}

/// Fuzzes every chosen operation and identity, or identities alone, and prints a line of each.
fn fuzz_all(options: &Options, count: u64, rows: bool) -> ExitCode {
    let rows = match rows {
        true => fuzzers::fuzzers(geograd_tests::list::rows()),
        false => Vec::new(),
    };
    let jobs: Vec<Fuzzer> = rows
        .into_iter()
        .chain(fuzzers::of_identities(identities::all()))
        .filter(|fuzzer| options.wants(fuzzer.name, fuzzer.wide))
        .collect();
    let bar = progress(jobs.len());
    let walked = fuzzers::walk(&jobs, count, options.seed, |fuzzed| {
        bar.suspend(|| println!("{fuzzed}"));
        bar.inc(1);
    });
    bar.finish_and_clear();
    let rate = walked.inputs as f64 / walked.seconds / 1e6;
    println!(
        "\n{} inputs, {rate:.2} million a second of a processor, {} fuzzers found something (seed {})",
        walked.inputs, walked.broken, options.seed
    );
    ExitCode::from(walked.status())
}

fn progress(jobs: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} ({elapsed})");
    ProgressBar::new(jobs as u64).with_style(style.expect("a valid template"))
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
    if let Some(count) = options.fuzz {
        return fuzz_all(&options, count, true);
    }
    if let Some(count) = options.identities {
        return fuzz_all(&options, count, false);
    }
    let both = |row| [true, false].map(|wide| (row, wide));
    let rows = match options.quick {
        true => list::sample(list::checked(), &[]),
        false => list::checked(),
    };
    let jobs: Vec<(&Tested, bool)> = rows
        .into_iter()
        .flat_map(both)
        .filter(|(row, wide)| options.wants(row.name(), *wide))
        .collect();
    if jobs.is_empty() {
        eprintln!("the harness is not asked about {}", options.rows.join(", "));
        return ExitCode::from(2);
    }
    let gpu = match options.gpu.then(Gpu::new).transpose() {
        Ok(gpu) => gpu,
        Err(_) if !cfg!(feature = "gpu") => {
            eprintln!("this build has no GPU witness: build it with --features gpu");
            return ExitCode::from(3);
        }
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(3);
        }
    };
    if let Some(gpu) = &gpu {
        eprintln!("batches of f32 on {gpu}");
    }
    let bar = progress(jobs.len());
    let (mut checked, mut failed, mut picture) = (0, Vec::new(), None);
    let say = |line: String| bar.suspend(|| println!("{line}"));
    if !options.json {
        say(Report::heading());
    }
    let backend = gpu.as_ref().map(Backend::Gpu);
    let samples = options.samples.unwrap_or(match options.quick {
        true => QUICK,
        false => 1000,
    });
    let check = |job: usize| {
        let (row, wide) = jobs[job];
        bar.set_message(row.name());
        let tick = || bar.tick();
        let plan = Sampling {
            draws: options.svg.is_some() && wide,
            tick: Some(&tick),
            hard: if options.quick { QUICK_HARD } else { 1 },
            shared_ties: true,
            ..Sampling::new(samples, options.seed)
        };
        match wide {
            true => row.check::<f64>(&plan, None),
            false => row.check::<f32>(&plan, backend),
        }
    };
    // Whatever the order in which they end, the table has the order of the rows.
    let (mut waiting, mut next, mut fault) = (BTreeMap::new(), 0, None);
    let done = |job: usize, report: Result<Report, Error>| {
        waiting.insert(job, report);
        while let Some(report) = waiting.remove(&next) {
            let (row, _) = jobs[next];
            next += 1;
            bar.inc(1);
            let report = match report {
                Ok(report) => report,
                Err(error) => {
                    fault.get_or_insert((row.name(), error));
                    continue;
                }
            };
            say(match options.json {
                true => report.json(),
                false => report.line(),
            });
            if options.details && !options.json {
                say(report.details());
            }
            picture = report.picture.clone().or(picture.take());
            match report.passed() {
                true => checked += 1,
                false => failed.push(report),
            }
        }
    };
    // A GPU is one.
    let threads = match &gpu {
        Some(_) => 1,
        None => std::thread::available_parallelism().map_or(1, usize::from),
    };
    fuzzers::on_threads(threads, jobs.len(), check, done);
    if let Some((name, error)) = fault {
        eprintln!("{name}: {error}");
        return ExitCode::from(3);
    }
    bar.finish_and_clear();
    if !options.json {
        println!("\n{}", Report::legend());
        for report in &failed {
            println!("\n{report}");
        }
        println!(
            "\n{checked} checked, {} refused (seed {})",
            failed.len(),
            options.seed
        );
    }
    if let (Some(path), Some(picture)) = (&options.svg, &picture)
        && let Err(error) = std::fs::write(path, picture)
    {
        eprintln!("{path}: {error}");
        return ExitCode::from(2);
    }
    ExitCode::from(u8::from(!failed.is_empty()))
}

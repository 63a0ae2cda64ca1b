//! Overlap of rotated boxes, table in, table out.
//!
//! ```text
//! cargo run --release --example iou_csv -- --a A.csv --b B.csv [--all-pairs] [--grad]
//! ```
//!
//! `--help` has the rest. Both inputs are read and checked as a whole before anything is computed,
//! and a result file appears under its name only when it is complete.
#[path = "../common/cli.rs"]
mod cli;
mod input;
mod output;

use cli::{Backend, Failure};
use geograd::Obb2;
use geograd::kernels::overlap::IouObb2;
use geograd::kernels::{cpu, real::Real};
use indicatif::{ProgressBar, ProgressStyle};
use output::Sink;
use std::fmt::Debug;
use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;

const HELP: &str = "\
Overlap (intersection over union) of rotated boxes, and its derivatives.

Usage: iou_csv --a A.csv --b B.csv [options]

  --a FILE, --b FILE       the boxes: one `x,y,w,h,r` per row; centre, size, and heading in
                           radians, counter-clockwise. A header row is optional.
  --all-pairs              every row of A with every row of B, in row-major order:
                           all of B for the first row of A, then for the second, and so on.
                           Without it row i of A goes with row i of B.
  --grad                   also the ten partial derivatives of every overlap
  --precision f32|f64      the format to compute in [default: f64]
  --backend cpu|gpu|auto   the machine to compute on [default: cpu]
  --out FILE               where the result goes [default: standard output]
  --help                   this text

The result has a header and the column `iou`, with --grad followed by
`dax,day,daw,dah,dar,dbx,dby,dbw,dbh,dbr`. Numbers are the shortest that read back as the same.

Exit status: 0 when all went well; 1 for bad rows (all input is checked first, and then nothing
is written) or a file that cannot be read or written; 2 for a wrong command line.
";

struct Options {
    a: PathBuf,
    b: PathBuf,
    all_pairs: bool,
    grad: bool,
    double: bool,
    backend: Backend,
    out: Option<PathBuf>,
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, Failure> {
    use lexopt::prelude::*;
    let (mut a, mut b, mut out) = (None, None, None);
    let (mut all_pairs, mut grad, mut double, mut backend) = (false, false, true, Backend::Cpu);
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("a") => a = Some(parser.value()?.into()),
            Long("b") => b = Some(parser.value()?.into()),
            Long("all-pairs") => all_pairs = true,
            Long("grad") => grad = true,
            Long("precision") => {
                double = match parser.value()?.string()?.as_str() {
                    "f32" => false,
                    "f64" => true,
                    other => {
                        let why = format!("`--precision {other}`: it is f32 or f64");
                        return Err(Failure::Usage(why));
                    }
                }
            }
            Long("backend") => backend = Backend::from_name(&parser.value()?.string()?)?,
            Long("out") => out = Some(parser.value()?.into()),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected().into()),
        }
    }
    let missing = |name| Failure::Usage(format!("`{name}` is missing"));
    Ok(Some(Options {
        a: a.ok_or_else(|| missing("--a"))?,
        b: b.ok_or_else(|| missing("--b"))?,
        all_pairs,
        grad,
        double,
        backend,
        out,
    }))
}

/// Results computed and written at a time: enough to keep all threads busy, few enough that memory
/// does not grow with the job.
const BLOCK: usize = 1 << 18;

fn run<T>(options: &Options) -> Result<(), Failure>
where
    T: Real + FromStr + Debug + Send + Sync,
{
    // Both files are checked before either is refused: one run shows all that is wrong.
    let (a, b) = (
        input::read::<T>(&options.a, "--a"),
        input::read::<T>(&options.b, "--b"),
    );
    let (a, b) = match (a, b) {
        (Ok(a), Ok(b)) => (a, b),
        (Err(why), Ok(_)) | (Ok(_), Err(why)) => return Err(Failure::Work(why)),
        (Err(a), Err(b)) => return Err(Failure::Work(format!("{a}\n{b}"))),
    };
    if !options.all_pairs && a.len() != b.len() {
        return Err(Failure::Work(format!(
            "{} has {} rows and {} has {}; pairs need as many of each (or --all-pairs)",
            options.a.display(),
            a.len(),
            options.b.display(),
            b.len(),
        )));
    }
    let refused = |error: geograd::Error| Failure::Work(error.to_string());
    let mut sink = Sink::create(options.out.as_deref())?;
    sink.header(options.grad)?;
    let Backend::Cpu = options.backend;
    if options.all_pairs {
        // An empty B has no pairs, but still a number of rows that fits a block.
        let rows = (BLOCK / b.len().max(1)).max(1);
        let progress = progress(a.len() as u64 * b.len() as u64);
        for a in a.chunks(rows) {
            if options.grad {
                let grads = cpu::all_pairs_grad::<IouObb2, T>(a, &b).map_err(refused)?;
                sink.rows(grads.values.len(), |pair| {
                    let (a_bar, b_bar) = grads.at(pair / b.len(), pair % b.len());
                    (grads.values[pair], Some([a_bar, b_bar]))
                })?;
            } else {
                let values = cpu::all_pairs::<IouObb2, T>(a, &b).map_err(refused)?;
                sink.rows(values.len(), |pair| (values[pair], None))?;
            }
            progress.inc((a.len() * b.len()) as u64);
            if sink.is_closed() {
                break;
            }
        }
        progress.finish_and_clear();
    } else {
        let progress = progress(a.len() as u64);
        for (a, b) in a.chunks(BLOCK).zip(b.chunks(BLOCK)) {
            if options.grad {
                let (values, a_bar, b_bar) =
                    cpu::aligned_grad::<IouObb2, T>(a, b).map_err(refused)?;
                sink.rows(a.len(), |i| (values[i], Some([a_bar[i], b_bar[i]])))?;
            } else {
                let values = cpu::aligned::<IouObb2, T>(a, b).map_err(refused)?;
                sink.rows(a.len(), |i| (values[i], None))?;
            }
            progress.inc(a.len() as u64);
            if sink.is_closed() {
                break;
            }
        }
        progress.finish_and_clear();
    }
    sink.finish()
}

/// One result: the overlap, and with `--grad` its slopes with respect to both boxes.
type Row<T> = (T, Option<[Obb2<T>; 2]>);

/// Shows itself only where stderr is a terminal.
fn progress(pairs: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {human_pos}/{human_len} pairs, {eta} left");
    ProgressBar::new(pairs).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn main() -> ExitCode {
    let done = options().and_then(|options| match options {
        None => {
            cli::say(HELP);
            Ok(())
        }
        Some(options) if options.double => run::<f64>(&options),
        Some(options) => run::<f32>(&options),
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report("iou_csv"),
    }
}

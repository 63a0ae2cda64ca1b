//! Overlap of rotated boxes, table in, table out.
//!
//! ```text
//! cargo run --release --example iou_csv -- --a A.csv --b B.csv [--all-pairs] [--grad]
//! cargo run --release --features gpu --example iou_csv -- --backend gpu --precision f32 …
//! ```
//!
//! `--help` has the rest. Both inputs are read and checked as a whole before anything is computed,
//! and a result file appears under its name only when it is complete.
#[path = "../common/cli.rs"]
mod cli;
mod input;
mod number;
mod output;

use cli::{Failure, Machine, Wish};
use geograd::Obb2;
use indicatif::{ProgressBar, ProgressStyle};
use number::Number;
use output::Sink;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const PROGRAM: &str = "iou_csv";

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
  --backend cpu|gpu|auto   the machine to compute on [default: cpu]. A GPU needs a build with
                           `--features gpu`, and --precision f32, the only format of GPUs.
                           auto takes a GPU where it can and says on stderr what it took.
                           The environment variable GEOGRAD_GPU chooses among GPUs: an index,
                           a part of a name, or `cpu` for a driver in software.
  --out FILE               where the result goes, no input [default: standard output]
  --help                   this text

The result has a header and the column `iou`, with --grad followed by
`dax,day,daw,dah,dar,dbx,dby,dbw,dbh,dbr`. Numbers are the shortest that read back as the same.

Exit status: 0 when all went well; 1 for bad rows (all input is checked first, and then nothing
is written), a file that cannot be read or written, or a GPU that fails; 2 for a wrong command
line. On failure --out is as it was; standard output may have the first rows, whole ones.
";

struct Options {
    a: PathBuf,
    b: PathBuf,
    all_pairs: bool,
    grad: bool,
    double: bool,
    wish: Wish,
    out: Option<PathBuf>,
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, Failure> {
    use lexopt::prelude::*;
    let (mut a, mut b, mut out) = (None::<PathBuf>, None::<PathBuf>, None::<PathBuf>);
    let (mut all_pairs, mut grad, mut double, mut wish) = (false, false, true, Wish::Cpu);
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
            Long("backend") => wish = Wish::from_name(&parser.value()?.string()?)?,
            Long("out") => out = Some(parser.value()?.into()),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected().into()),
        }
    }
    let missing = |name| Failure::Usage(format!("`{name}` is missing"));
    if let Some(out) = &out
        && [&a, &b]
            .into_iter()
            .flatten()
            .any(|input| same_file(input, out))
    {
        return Err(Failure::Usage("`--out` is an input as well".into()));
    }
    if double && wish == Wish::Gpu {
        let why =
            "`--backend gpu` computes in f32 only; the default is f64, so say `--precision f32`";
        return Err(Failure::Usage(why.into()));
    }
    Ok(Some(Options {
        a: a.ok_or_else(|| missing("--a"))?,
        b: b.ok_or_else(|| missing("--b"))?,
        all_pairs,
        grad,
        double,
        wish,
        out,
    }))
}

/// Whether both are names of one file that is there.
fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b && a.is_file())
}

/// Results computed and written at a time: enough to keep all threads busy, few enough that memory
/// does not grow with the job.
const BLOCK: usize = 1 << 18;

/// The machine asked for, as far as it has the format.
fn machine<T: Number>(wish: Wish) -> Result<Machine, Failure> {
    match wish {
        Wish::Auto if !T::ON_GPUS => Ok(cli::on_the_cpu(
            PROGRAM,
            "GPUs have no f64; `--precision f32` allows one",
        )),
        _ => wish.machine(PROGRAM),
    }
}

fn run<T: Number>(options: &Options) -> Result<(), Failure> {
    // Both files are checked before either is refused: one run shows all that is wrong.
    let (a, b) = (
        input::read::<T>(&options.a, "--a"),
        input::read::<T>(&options.b, "--b"),
    );
    let (a, b) = match (a, b) {
        (Ok(a), Ok(b)) => (a, b),
        (Err(why), Ok(_)) | (Ok(_), Err(why)) => return Err(Failure::Work(why)),
        (Err(why), Err(_)) if same_file(&options.a, &options.b) => {
            return Err(Failure::Work(why));
        }
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
    let machine = machine::<T>(options.wish)?;
    let backend = machine.backend();
    let mut sink = Sink::create(options.out.as_deref(), options.grad)?;
    if options.all_pairs {
        // An empty B has no pairs, but still a number of rows that fits a block.
        let rows = (BLOCK / b.len().max(1)).max(1);
        let progress = progress(a.len() as u64 * b.len() as u64);
        for a in a.chunks(rows) {
            if options.grad {
                let grads = T::all_pairs_grad(backend, a, &b)?;
                sink.rows(grads.values().len(), |pair| {
                    let (value, (a_bar, b_bar)) = grads.at(pair / b.len(), pair % b.len());
                    (value, Some([a_bar, b_bar]))
                })?;
            } else {
                let values = T::all_pairs(backend, a, &b)?;
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
                let (values, a_bar, b_bar) = T::aligned_grad(backend, a, b)?;
                sink.rows(a.len(), |i| (values[i], Some([a_bar[i], b_bar[i]])))?;
            } else {
                let values = T::aligned(backend, a, b)?;
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
        Err(failure) => failure.report(PROGRAM),
    }
}

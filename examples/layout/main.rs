//! A dozen shapes of four kinds packed into a container without overlap, by descent on how deep they are in each
//! other and in the walls. `cargo run --release -p geograd-examples --example layout`; `-- --help` has the options.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `forms.rs` | the shapes, and how far they are apart |
//! | `pack.rs` | the steps |
//! | `judge.rs` | the loss with its derivatives by every pose: recorded functions in batches, on the CPU or a GPU |
//! | `draw.rs` | the picture |
mod draw;
mod forms;
mod judge;
mod pack;

use common::cli::{Failure, Wish, finish, usage};
use common::file::write;
use common::progress::styled;
use lexopt::prelude::*;
use pack::Layout;
use std::fmt::Write as _;
use std::path::PathBuf;

const HELP: &str = "\
Packs a dozen shapes of four kinds into a container by gradient descent, and draws them before and after.

Usage: layout [options]

  --seed N          other shapes and another start [default: 1]
  --iterations N    steps [default: 600]
  --svg FILE        a picture [default: layout.svg]
  --csv FILE        iteration,loss,penetration of every step
  --backend BACKEND the machine to compute on: cpu, gpu or auto [default: cpu]. A GPU needs a build with
                    `--features gpu`; auto takes one where there is one, and says on stderr what it took.
                    A dozen shapes are few for a GPU: it shows the calls, not speed.
  --help            this text
";

struct Options {
    seed: u64,
    iterations: usize,
    svg: PathBuf,
    csv: Option<PathBuf>,
    wish: Wish,
}

fn options() -> Result<Option<Options>, Failure> {
    let mut options = Options {
        seed: 1,
        iterations: 600,
        svg: "layout.svg".into(),
        csv: None,
        wish: Wish::Cpu,
    };
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("seed") => options.seed = arguments.value()?.parse()?,
            Long("iterations") => options.iterations = arguments.value()?.parse()?,
            Long("svg") => options.svg = arguments.value()?.into(),
            Long("csv") => options.csv = Some(arguments.value()?.into()),
            Long("backend") => options.wish = Wish::from_name(&arguments.value()?.string()?)?,
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected().into()),
        }
    }
    if options.csv.as_ref() == Some(&options.svg) {
        return usage("`--svg` and `--csv` are the same file");
    }
    Ok(Some(options))
}

fn run() -> Result<String, Failure> {
    let Some(options) = options()? else {
        return Ok(HELP.into());
    };
    let machine = options.wish.machine("layout")?;
    let bar = styled(
        "{bar:30} {pos}/{len} steps ({elapsed})",
        options.iterations as u64,
    );
    let (seed, steps) = (options.seed, options.iterations);
    let layout = Layout::run(machine.backend(), seed, steps, || bar.inc(1))?;
    bar.finish_and_clear();
    write(&options.svg, &draw::page(&layout))?;
    if let Some(file) = &options.csv {
        let mut table = String::from("iteration,loss,penetration\n");
        for (k, step) in layout.steps.iter().enumerate() {
            let _ = writeln!(table, "{k},{},{}", step.loss, step.penetration);
        }
        write(file, &table)?;
    }
    let (first, last) = (layout.steps[0], layout.steps[layout.steps.len() - 1]);
    Ok(format!(
        "{} shapes fill {:.0} % of the container\n\
         deepest penetration  before {:.4}   after {:.4}\n\
         loss                 before {:.4}   after {:.6}\n",
        layout.forms.len(),
        100.0 * layout.filled(),
        first.penetration,
        last.penetration,
        first.loss,
        last.loss
    ))
}

fn main() -> std::process::ExitCode {
    finish("layout", run())
}

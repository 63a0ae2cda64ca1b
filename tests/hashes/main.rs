//! Hashes of the results of every row, to show that a change of the code changes no bit.
//!
//! `cargo run -p geograd-tests --no-default-features --features gpu,hashes --example hashes`; `-- --help` has the
//! options.
//!
//! It walks every row of the library in `f32` and `f64` at a fixed set of inputs (hard, random and extreme ones of
//! `sample`), and prints a line per form: plain numbers, duals, an adjoint by hand, aligned batches, all pairs,
//! reductions, folds, searches; and per template of a shader. `--check FILE` names each line that differs, `--names
//! FILE` maps rows that were renamed, `--write FILE` records. Only `rows.rs`, `forms.rs` and `paths.rs` call the
//! library; a change of its calls changes these files and no line of the record. Sines and exponentials are the library's own, so that
//! the lines hold on every machine. The feature `hashes` keeps the example out of other builds: on one core it
//! takes 70 s to compile and 85 s to run.
//!
//! `cargo run -p geograd-tests --no-default-features --features gpu,hashes --example hashes -- --check
//! tests/hashes/hashes.txt`
mod forms;
mod paths;
mod print;
mod rows;

use geograd_tests::lines::{self, Lines};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use rows::{Entry, WGSL};
use std::collections::BTreeMap;
use std::fs::read_to_string;
use std::process::ExitCode;

const HELP: &str = "\
Hashes the results of every row at a fixed set of inputs: a line for each row, format
and form. Formats are f32, f64, and wgsl for the text of shaders (with --features gpu).
The name of a form that is refused ends in _refused, and the message is hashed.
The same results have the same hash at every level of vector instructions and for any
number of threads. Sines and exponentials of the system's library differ between
systems, so hashes are compared on one system.

  --check FILE    compares with a file: each line that differs, and each row or form
                  that only one side has
  --write FILE    writes the file; what this run leaves out (rows by --op, shaders without
                  the feature gpu) stays as it is there
  --names FILE    with --check: an old and a new name of a row per line, for rows
                  that were renamed since the file was written
  --op NAME       only rows whose name contains NAME
  --help          this text

Without --check and --write it prints the lines. The exit status is 0, or 1 when
something differs, or 2 for a wrong argument or a file that cannot be read.
";

/// The first lines of a written file.
const HEAD: &str = "\
# Row, format, form, hash: results of every row at a fixed set of inputs, on x86-64 Linux.
# cargo run -p geograd-tests --no-default-features --features gpu,hashes --example hashes -- \\
#   --check tests/hashes/hashes.txt
";

#[derive(Default)]
struct Options {
    op: String,
    check: Option<String>,
    write: Option<String>,
    names: Option<String>,
}

impl Options {
    /// `true` if this run hashes a row in a format.
    fn wants(&self, row: &str, format: &str) -> bool {
        row.contains(&self.op) && (format != WGSL || cfg!(feature = "gpu"))
    }
}

/// `None` when only help was wanted.
fn options() -> Result<Option<Options>, String> {
    let mut options = Options::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--op" => options.op = value()?,
            "--check" => options.check = Some(value()?),
            "--write" => options.write = Some(value()?),
            "--names" => options.names = Some(value()?),
            "--help" | "-h" => return Ok(None),
            _ => return Err(format!("unknown argument {argument}\nTry `--help`.")),
        }
    }
    if options.names.is_some() && options.check.is_none() {
        return Err("--names needs --check".to_owned());
    }
    Ok(Some(options))
}

/// Reads a file by a parser, and says which file is wrong.
fn read<X>(path: &str, parse: fn(&str) -> Result<X, String>) -> Result<X, String> {
    let text = read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
    parse(&text).map_err(|error| format!("{path}: {error}"))
}

/// Hashes of all that is wanted.
fn hashed(options: &Options) -> Result<Lines, String> {
    let entries: Vec<Entry> = rows::all()
        .into_iter()
        .filter(|entry| options.wants(entry.row, entry.format))
        .collect();
    if entries.is_empty() {
        return Err(format!("no row is named {}", options.op));
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} ({elapsed})");
    let bar = ProgressBar::new(entries.len() as u64).with_style(style.expect("a valid template"));
    let one = |entry: Entry| {
        bar.set_message(entry.row);
        let forms = (entry.run)();
        bar.inc(1);
        let key = |form: String| [entry.row.to_owned(), entry.format.to_owned(), form];
        forms
            .into_iter()
            .map(|(form, hash)| (key(form), hash))
            .collect()
    };
    let all: Vec<Vec<_>> = entries.into_par_iter().map(one).collect();
    bar.finish_and_clear();
    let mut found = Lines::new();
    for (key, hash) in all.into_iter().flatten() {
        let words = key.join(" ");
        if found.insert(key, hash).is_some() {
            return Err(format!("{words} is there twice"));
        }
    }
    Ok(found)
}

/// Hashes the rows and compares them with a file or writes them; `true` if nothing differs.
fn run(options: &Options) -> Result<bool, String> {
    let expected = match &options.check {
        Some(path) => {
            let names = match &options.names {
                Some(path) => read(path, lines::parse_names)?,
                None => BTreeMap::new(),
            };
            let all = lines::rename(read(path, lines::parse)?, &names)?;
            let wanted = all.into_iter();
            Some(wanted.filter(|([row, format, _], _)| options.wants(row, format)))
        }
        None => None,
    };
    // Files that cannot be read are refused before the work.
    let mut all = match &options.write {
        Some(path) if std::path::Path::new(path).exists() => read(path, lines::parse)?,
        _ => Lines::new(),
    };
    let found = hashed(options)?;
    if let Some(path) = &options.write {
        all.retain(|[row, format, _], _| !options.wants(row, format));
        all.extend(found.clone());
        let text = format!("{HEAD}{}", lines::text(&all));
        std::fs::write(path, text).map_err(|error| format!("{path}: {error}"))?;
        eprintln!("{} hashes written to {path}", found.len());
    }
    let Some(expected) = expected else {
        if options.write.is_none() {
            print!("{}", lines::text(&found));
        }
        return Ok(true);
    };
    let expected: Lines = expected.collect();
    let differences = lines::differences(&expected, &found);
    for line in &differences {
        println!("{line}");
    }
    eprintln!("{} hashes, {} differences", found.len(), differences.len());
    Ok(differences.is_empty())
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
    match run(&options) {
        Ok(same) => ExitCode::from(u8::from(!same)),
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

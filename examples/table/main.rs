//! Any verb on tables: CSV or Parquet in, CSV or Parquet out.
//!
//! ```text
//! cargo run --release -p geograd-table -- --verb signed_distance --a obb3:A.csv --b capsule3:B.csv --grad --out C.csv
//! cargo run --release -p geograd-table -- --verb iou --a obb2:A.parquet --b obb2:B.parquet --group frame --above 0.5 --out C.parquet
//! ```
//!
//! `--help` has the rest. Files are read, computed and written block by block. A result appears under its name only when
//! it is complete.
//!
//! | file | content |
//! | --- | --- |
//! | `options.rs` | the command line, and the row of the verb that it means |
//! | `number.rs` | both formats of numbers |
//! | `csv.rs`, `source.rs`, `lists.rs`, `block.rs`, `buffer.rs` | tables as rows of numbers, block by block and group by group |
//! | `work.rs` | rows, pairs, derivatives |
//! | `sink.rs` | the result |
//!
//! `common/csv.rs` and `common/output.rs` read and write text, `common/compute.rs` computes, here and for `iou_csv`.
mod block;
mod buffer;
mod csv;
mod lists;
mod number;
mod options;
mod sink;
mod source;
mod work;

use common::cli::{Failure, Machine, NO_F64, Wish, finish, on_the_cpu, usage};
use options::{Asked, HELP, Options, list, options};
use std::process::ExitCode;

const PROGRAM: &str = "table";

/// The machine asked for, as far as it has the format.
fn machine(options: &Options) -> Result<Machine, Failure> {
    match options.wish {
        Wish::Auto if options.double => Ok(on_the_cpu(PROGRAM, NO_F64)),
        Wish::Gpu if options.double => usage(format!("`--backend gpu`: {NO_F64}")),
        wish => wish.machine(PROGRAM),
    }
}

/// Does what the command line asks for, and gives the text that is left to print.
fn run() -> Result<String, Failure> {
    let options = match options()? {
        Asked::Work(options) => options,
        Asked::Help => return Ok(HELP.into()),
        Asked::List => return Ok(list()),
    };
    let machine = machine(&options)?;
    match options.double {
        true => work::run::<f64>(&options, &machine),
        false => work::run::<f32>(&options, &machine),
    }?;
    Ok(String::new())
}

fn main() -> ExitCode {
    finish(PROGRAM, run())
}

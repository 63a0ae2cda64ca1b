//! A function of the library as C, for programs that cannot take the library along: writes `car.c` and `car.h`, which
//! `main.c` uses. `cargo run -p geograd-examples --example embedded -- FOLDER`; `README.md` has the compiler's line.
use common::cli::{Failure, finish, usage};
use common::file::write;
use geograd::distance::Convex;
use geograd::{Obb2, Program, Sym};
use std::path::PathBuf;

const HELP: &str =
    "embedded FOLDER\nWrites car.c and car.h: the clearance of a car, and its gradient.\n";

/// Returns both files: the clearance of a car from another box, less than zero where they overlap, and its gradient.
fn files() -> Result<[(&'static str, String); 2], geograd::Error> {
    let clearance =
        Program::trace(|(car, other): (Obb2<Sym<f32>>, Obb2<Sym<f32>>)| car.signed_distance(other));
    let car = clearance?.value_grad();
    Ok([("car.c", car.c("car")?), ("car.h", car.c_header("car")?)])
}

fn run() -> Result<String, Failure> {
    let folder = match &std::env::args().skip(1).collect::<Vec<_>>()[..] {
        [help] if help == "--help" => return Ok(HELP.into()),
        [folder] => PathBuf::from(folder),
        _ => return usage("it takes a folder"),
    };
    let files = files()?;
    let mut told = String::new();
    for (name, text) in files {
        let path = folder.join(name);
        write(&path, &text)?;
        told += &format!("{}: {} lines\n", path.display(), text.lines().count());
    }
    Ok(told)
}

fn main() -> std::process::ExitCode {
    finish("embedded", run())
}

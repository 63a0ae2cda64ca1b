//! The clearance of an arm with six joints among boxes, capsules and a floor, with its derivatives by the joint angles
//! and by the radius of the links; and a path that these push out of collision.
//! `cargo run --release -p geograd-examples --example arm_clearance`; `-- --help` has the options.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `arm.rs` | from joint angles to solids and clearance, generic over the scalar |
//! | `nearest.rs` | clearance and derivatives in batches, by the nearest pairs alone |
//! | `path.rs` | the path, and the descent that pushes it |
//! | `command.rs` | the command line, and the batch of random configurations |
//! | `draw.rs` | the picture |
mod arm;
mod command;
mod draw;
mod nearest;
mod path;

use common::cli::finish;
use std::process::ExitCode;

fn main() -> ExitCode {
    finish("arm_clearance", command::run())
}

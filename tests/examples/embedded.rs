//! The clearance of a car as C: compiled with all warnings, run, and compared with the library.
use crate::{folder, run, stdout};
use geograd::Obb2;
use geograd::distance::Convex;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs a compiler in a folder; `None` without one.
fn compiled(folder: &Path, arguments: &[&str]) -> Option<Output> {
    let strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"];
    let ran = Command::new("cc")
        .args(strict)
        .args(arguments)
        .current_dir(folder)
        .output();
    match ran {
        Ok(output) => Some(output),
        Err(_) => {
            eprintln!("SKIPPED: cc is not installed, so the program of C was not run");
            None
        }
    }
}

/// Writes `car.c` and `car.h` into a folder of a test's own.
fn written(test: &str) -> PathBuf {
    let folder = folder(test);
    let output = run("embedded", &folder, ".");
    assert!(output.status.success(), "{output:?}");
    assert!(stdout(&output).starts_with("./car.c: "), "{output:?}");
    folder
}

#[test]
fn the_car_of_c_finds_room() {
    let folder = written("embedded");
    let main = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/embedded/main.c");
    let Some(built) = compiled(&folder, &["-I.", "-o", "car", main, "car.c", "-lm"]) else {
        return;
    };
    assert!(built.status.success(), "{built:?}");
    let output = Command::new(folder.join("car")).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let lines: Vec<&str> = stdout(&output).lines().collect();
    assert!(lines.len() > 2, "{lines:?}");
    // The others as in `main.c`.
    let others = [
        Obb2::new(5.2_f32, 0.1, 4.4, 1.8, 0.04),
        Obb2::new(-5.3, -0.2, 4.6, 1.9, -0.02),
        Obb2::new(0.0, -1.6, 24.0, 0.6, 0.0),
    ];
    let mut clearances = Vec::new();
    for line in lines {
        let numbers = line.split([' ', ',']).filter_map(|word| word.parse().ok());
        let numbers: Vec<f32> = numbers.collect();
        let [x, y, heading, found] = numbers[..] else {
            panic!("{line}");
        };
        let own = Obb2::new(x, y, 4.2, 1.8, heading);
        let distances = others.iter().map(|&other| own.signed_distance(other));
        let expected = distances.fold(f32::MAX, f32::min);
        // The text has three digits of every number.
        assert!((found - expected).abs() < 5e-3, "{line}: {expected}");
        clearances.push(found);
    }
    assert!(clearances[0] < 0.0 && clearances[clearances.len() - 1] > 0.498);
}

#[test]
fn the_function_needs_six_of_the_c_library() {
    let folder = written("embedded_alone");
    let freestanding = [
        "-ffreestanding",
        "-fno-stack-protector",
        "-O2",
        "-c",
        "car.c",
    ];
    let Some(built) = compiled(&folder, &freestanding) else {
        return;
    };
    assert!(built.status.success(), "{built:?}");
    let Ok(listed) = Command::new("nm")
        .arg("-u")
        .arg(folder.join("car.o"))
        .output()
    else {
        eprintln!("SKIPPED: nm is not installed, so the calls of the function were not listed");
        return;
    };
    let needed: BTreeSet<&str> = stdout(&listed)
        .split_whitespace()
        .map(|name| name.trim_start_matches('_'))
        .filter(|&name| name != "U" && name != "GLOBAL_OFFSET_TABLE_")
        .collect();
    let known = ["fabs", "fabsf", "floor", "memcpy", "sqrt", "sqrtf"];
    assert!(!needed.is_empty(), "{listed:?}");
    let unknown: Vec<_> = needed.iter().filter(|name| !known.contains(name)).collect();
    assert!(unknown.is_empty(), "{unknown:?}");
}

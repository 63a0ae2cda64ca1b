//! Three generated shaders are in `kernels/gpu/wgsl/generated` as examples to read: of all pairs, of a gradient, of a
//! fold. `tests/gpu/main.rs` generates and validates all others.
//!
//! `GEOGRAD_WRITE_WGSL=1 cargo test -p geograd-tests --features gpu --test gpu committed` writes them anew.
use geograd::ad::program::WGSL;
use geograd::kernels::gpu::{fold_sources, op_sources};
use geograd::kernels::{Item, Op};
use geograd_tests::rows::{distance, fold};
use std::path::PathBuf;

/// Compares a shader with what is kept, or writes it. The functions that all of them call are left out.
fn compare(name: &str, text: &str) {
    let file = format!("{}.wgsl", name.to_lowercase().replace(' ', "_"));
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../kernels/gpu/wgsl/generated");
    let own = text
        .strip_prefix(WGSL)
        .expect("every shader starts with the functions of programs");
    let text = format!(
        "// {name}: generated from the Rust source, after `ad/program/prelude.wgsl`. To read, not to edit:\n\
         // `tests/gpu/committed.rs` says how it is written.\n\n{}",
        own.trim_start()
    );
    let path = folder.join(&file);
    if std::env::var("GEOGRAD_WRITE_WGSL").is_ok_and(|x| x == "1") {
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(&path, &text).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    let differs = kept
        .lines()
        .zip(text.lines())
        .position(|(kept, text)| kept != text);
    assert!(
        kept == text,
        "{file} is not what is generated, from line {:?} on",
        differs.map(|line| line + 1)
    );
}

/// Some shaders of an operation, by what is wanted and the form.
fn kept<O: Op>(wanted: &[&str])
where
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
{
    let all = op_sources::<O>().unwrap();
    for wanted in wanted {
        let name = format!("{} {wanted}", O::DECLARED.name);
        let found = all.iter().find(|(own, _)| *own == name);
        compare(&name, &found.unwrap_or_else(|| panic!("no {name}")).1);
    }
}

#[test]
fn examples() {
    kept::<distance::DistancePointSegment>(&["Value Pairs", "ValueGrad Aligned"]);
    let folds = fold_sources(fold::LengthOfPolyline).unwrap();
    let (form, text) = &folds[0];
    compare(&format!("length_of_polyline {form}"), text);
}

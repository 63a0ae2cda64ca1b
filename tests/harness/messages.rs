//! The compiler's messages for calls that do not compile: each file of `tests/messages` is compiled by itself, and its
//! first lines, after `//~`, are parts of the message.
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The library as it was built for this test, the newest of its builds.
fn library(deps: &Path) -> PathBuf {
    let files = fs::read_dir(deps).unwrap().map(|file| file.unwrap().path());
    let is_library = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("libgeograd-") && name.ends_with(".rlib")
    };
    let built = |path: &PathBuf| fs::metadata(path).unwrap().modified().unwrap();
    files
        .filter(is_library)
        .max_by_key(built)
        .expect("the library")
}

/// `true` if a file compiles, and the output of the compiler.
fn compiled(file: &Path) -> (bool, String) {
    let deps = env::current_exe().unwrap().parent().unwrap().to_path_buf();
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut library_of = std::ffi::OsString::from("geograd=");
    library_of.push(library(&deps));
    let name = file.file_stem().unwrap().to_string_lossy();
    let out = env::temp_dir().join(format!(
        "geograd-message-{}-{name}.rmeta",
        std::process::id()
    ));
    let said = Command::new(rustc)
        .args([
            "--edition",
            "2024",
            "--crate-type",
            "lib",
            "--emit",
            "metadata",
            "-A",
            "warnings",
        ])
        .arg("-o")
        .arg(&out)
        .arg("-L")
        .arg(format!("dependency={}", deps.display()))
        .arg("--extern")
        .arg(library_of)
        .arg(file)
        .output()
        .expect("the compiler");
    let _ = fs::remove_file(out);
    (
        said.status.success(),
        String::from_utf8_lossy(&said.stderr).into_owned(),
    )
}

#[test]
fn the_compiler_says_what_to_write() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("messages");
    let mut files: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().path())
        .collect();
    files.sort();
    assert!(files.len() > 30, "{} files", files.len());
    let said = std::thread::scope(|scope| {
        let all: Vec<_> = files
            .iter()
            .map(|file| scope.spawn(|| compiled(file)))
            .collect();
        all.into_iter()
            .map(|one| one.join().unwrap())
            .collect::<Vec<_>>()
    });
    for (file, (compiles, said)) in files.iter().zip(said) {
        let text = fs::read_to_string(file).unwrap();
        let expected: Vec<_> = text
            .lines()
            .map_while(|line| line.strip_prefix("//~ "))
            .collect();
        assert_eq!(compiles, expected.is_empty(), "{}\n{said}", file.display());
        for part in expected {
            assert!(
                said.contains(part),
                "{}: no {part:?} in\n{said}",
                file.display()
            );
        }
    }
}

//! How the examples write and compare files.
use crate::cli::Failure;
use std::path::Path;

/// Writes a text; a failure names the file.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text)
        .map_err(|error| Failure::Work(format!("{}: {error}", path.display())))
}

/// `true` if both are names of one existing file.
pub fn same(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b && a.is_file())
}

//! How the examples write a file.
use crate::cli::Failure;
use std::path::Path;

/// Writes a text; a failure names the file.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text)
        .map_err(|error| Failure::Work(format!("{}: {error}", path.display())))
}

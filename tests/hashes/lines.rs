//! Hashes of results by row, format and form: their file, and how two sets of them differ.
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// A row, a format (`f32`, `f64`, or `wgsl` for the text of shaders) and a form.
pub type Key = [String; 3];

/// The hash of every form.
pub type Lines = BTreeMap<Key, u64>;

/// Hashes from the text of a file: a line has row, format, form and hash, and `#` begins a comment.
///
/// # Errors
///
/// The number of a line that cannot be read, and the line.
pub fn parse(text: &str) -> Result<Lines, String> {
    let mut lines = Lines::new();
    for (i, line) in records(text) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [row, format, form, hash] = words[..] else {
            return Err(format!(
                "line {i}: row, format, form and hash, not {line:?}"
            ));
        };
        let Ok(hash) = u64::from_str_radix(hash, 16) else {
            return Err(format!("line {i}: {hash} is no hexadecimal number"));
        };
        let key = [row, format, form].map(str::to_owned);
        if lines.insert(key, hash).is_some() {
            return Err(format!("line {i}: {row} {format} {form} is there twice"));
        }
    }
    Ok(lines)
}

/// New names by old ones from the text of a file: a line has both, and `#` begins a comment.
///
/// # Errors
///
/// The number of a line that cannot be read, and the line.
pub fn parse_names(text: &str) -> Result<BTreeMap<String, String>, String> {
    let mut names = BTreeMap::new();
    for (i, line) in records(text) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [old, new] = words[..] else {
            return Err(format!("line {i}: an old name and a new one, not {line:?}"));
        };
        if names.insert(old.to_owned(), new.to_owned()).is_some() {
            return Err(format!("line {i}: {old} is there twice"));
        }
    }
    Ok(names)
}

fn records(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().map(str::trim).zip(1..);
    lines
        .filter(|(line, _)| !line.is_empty() && !line.starts_with('#'))
        .map(|(line, i)| (i, line))
}

/// The same hashes with rows renamed; a row without a new name keeps its own.
///
/// # Errors
///
/// A name that two rows would share.
pub fn rename(lines: Lines, names: &BTreeMap<String, String>) -> Result<Lines, String> {
    let mut renamed = Lines::new();
    for ([row, format, form], hash) in lines {
        let row = names.get(&row).cloned().unwrap_or(row);
        let clash = format!("two rows become {row}");
        if renamed.insert([row, format, form], hash).is_some() {
            return Err(clash);
        }
    }
    Ok(renamed)
}

/// One line per hash, rows in order of their names.
#[must_use]
pub fn text(lines: &Lines) -> String {
    let mut text = String::new();
    for ([row, format, form], hash) in lines {
        let _ = writeln!(text, "{row} {format} {form} {hash:016x}");
    }
    text
}

/// How found hashes differ from expected ones, a line each; a row that only one side has is one line.
#[must_use]
pub fn differences(expected: &Lines, found: &Lines) -> Vec<String> {
    let rows =
        |lines: &Lines| -> BTreeSet<String> { lines.keys().map(|[row, ..]| row.clone()).collect() };
    let (own, others) = (rows(expected), rows(found));
    let mut all: Vec<String> = Vec::new();
    all.extend(
        own.difference(&others)
            .map(|row| format!("missing row {row}")),
    );
    all.extend(
        others
            .difference(&own)
            .map(|row| format!("extra row {row}")),
    );
    for (key, hash) in expected {
        match found.get(key) {
            Some(other) if other != hash => all.push(format!(
                "differs {}: {other:016x}, expected {hash:016x}",
                key.join(" ")
            )),
            None if others.contains(&key[0]) => all.push(format!("missing {}", key.join(" "))),
            _ => (),
        }
    }
    let extra = found.keys().filter(|key| !expected.contains_key(*key));
    let extra = extra.filter(|key| own.contains(&key[0]));
    all.extend(extra.map(|key| format!("extra {}", key.join(" "))));
    all
}

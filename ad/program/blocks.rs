//! The functions that the text of a program calls: declarations, of which a text has those that it needs.
use super::graph::Id;
use super::record::{Listed, graph_of};
use super::source::{Dialect, lines};
use std::collections::BTreeSet;

/// Declarations that belong together.
pub(crate) struct Block {
    names: Vec<String>,
    text: String,
}

impl Block {
    /// Creates a block of a text; `declared` returns the name that a line of it declares.
    pub fn new(text: String, declared: fn(&str) -> Option<&str>) -> Self {
        let names = text.lines().filter_map(declared).map(str::to_owned);
        Block {
            names: names.collect(),
            text,
        }
    }
}

/// Returns the blocks that a text refers to, and those that they refer to, in the order of `all`.
pub(crate) fn needed<'a>(all: &'a [Block], code: &str) -> Vec<&'a str> {
    let mut wanted = vec![false; all.len()];
    let mut open: Vec<&str> = called(code).into_iter().collect();
    while let Some(word) = open.pop() {
        let declares = |block: &Block| block.names.iter().any(|name| name == word);
        let place = all.iter().position(declares);
        if let Some(place) = place.filter(|&place| !wanted[place]) {
            wanted[place] = true;
            open.extend(called(&all[place].text));
        }
    }
    let chosen = all.iter().zip(wanted).filter(|(_, is)| *is);
    chosen.map(|(block, _)| &*block.text).collect()
}

/// Returns the names of blocks in a text.
fn called(text: &str) -> BTreeSet<&str> {
    let name = |(at, _): (usize, &str)| {
        let rest = &text[at..];
        let is_part = |c: char| c == '_' || c.is_ascii_alphanumeric();
        &rest[..rest.find(|c| !is_part(c)).unwrap_or(rest.len())]
    };
    text.match_indices("program_").map(name).collect()
}

/// Returns the operations of a formula of the library in a language, and the names of its results.
pub(crate) fn formula<D: Dialect>(
    dialect: &D,
    inputs: usize,
    formula: Listed<'_, f64>,
) -> (String, Vec<String>) {
    let (graph, outputs) = match graph_of::<f64>(inputs, formula) {
        Ok(made) => made,
        Err(_) => unreachable!("the formulas of scalars are straight lines"),
    };
    let mut code = String::new();
    let known = lines(dialect, &graph, &mut code);
    let name = |&x: &Id| known[x as usize].clone();
    (code, outputs.iter().map(name).collect())
}

/// Returns words in lines, with commas between words.
pub(crate) fn wrapped(words: impl Iterator<Item = String>) -> Vec<String> {
    const MOST: usize = 80;
    let mut lines: Vec<String> = Vec::new();
    for word in words {
        match lines.last_mut() {
            Some(line) if line.len() + word.len() <= MOST => {
                line.push_str(", ");
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

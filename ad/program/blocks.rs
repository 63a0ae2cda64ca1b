//! The functions that the text of a program calls: declarations, of which a text has those that it needs.
use super::graph::Id;
use super::record::{Listed, graph_of};
use super::source::{Dialect, lines};

/// Declarations that belong together.
pub(crate) struct Block {
    names: Vec<String>,
    text: String,
}

impl Block {
    /// A text; `declared` returns the name that a line of it declares.
    pub fn new(text: String, declared: fn(&str) -> Option<&str>) -> Self {
        let names = text.lines().filter_map(declared).map(str::to_owned);
        Block {
            names: names.collect(),
            text,
        }
    }
    /// Returns `true` if a text refers to one of its names.
    fn is_named_in(&self, text: &str) -> bool {
        let mut words = text.split(|c: char| c != '_' && !c.is_ascii_alphanumeric());
        words.any(|word| self.names.iter().any(|name| name == word))
    }
}

/// Returns the blocks that a text refers to, and those that they refer to, in the order of `all`.
pub(crate) fn needed<'a>(all: &'a [Block], code: &str) -> Vec<&'a str> {
    let mut wanted: Vec<bool> = all.iter().map(|block| block.is_named_in(code)).collect();
    // A block is needed by an earlier or a later one.
    loop {
        let more: Vec<usize> = (0..wanted.len())
            .filter(|&i| !wanted[i])
            .filter(|&i| {
                let users = all.iter().zip(&wanted);
                users
                    .into_iter()
                    .any(|(user, &is)| is && all[i].is_named_in(&user.text))
            })
            .collect();
        if more.is_empty() {
            break;
        }
        for i in more {
            wanted[i] = true;
        }
    }
    let chosen = all.iter().zip(wanted).filter(|(_, is)| *is);
    chosen.map(|(block, _)| &*block.text).collect()
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

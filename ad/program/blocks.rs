//! The functions that the text of a program calls: declarations, of which a text has those that it needs.
use super::Sym;
use super::graph::{Format, Id, Node};
use super::record::{Listed, graph_of};
use super::source::{Dialect, lines};
use crate::scalar::arc_tangent::{atan2_single, atan2_wide};
use crate::scalar::exponential::{
    LN_SERIES, LN_SERIES_SHORT, exp_parts, exp_parts_short, ln_from, normal,
};
use crate::scalar::float::{sin_cos_reduced, sin_cos_short};
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

/// The grammar of functions of 64-bit floats in a language.
pub(crate) trait Functions {
    type Of: Dialect;
    /// Returns the language, with names for the numbers of an input.
    fn dialect(takes: &'static [&'static str]) -> Self::Of;
    /// Returns the first line of a function, from its name and the names of its numbers.
    fn head(name: &str, takes: &[&str]) -> String;
    /// Returns the lines that leave a sine (0) or cosine (1) for large angles.
    fn far(part: usize) -> String;
}

/// Returns the elementary functions of 64-bit floats, recorded from the formulas that the library computes numbers of a
/// format with. For `f32` their names have `wide`: other functions round their results.
pub(crate) fn elementary<F: Functions>(format: Format) -> Vec<String> {
    let short = format == Format::F32;
    let prefix = if short { "program_wide_" } else { "program_" };
    let own = |name: &str| format!("{prefix}{name}");
    let sin_cos = |x: Sym<f64>| match short {
        true => sin_cos_short(x),
        false => sin_cos_reduced(x),
    };
    let nan = format!(
        "    if (!({})) {{\n        return x;\n    }}\n",
        F::dialect(&[]).is_number("x")
    );
    let constant = F::dialect(&[]).defines(Node::Input(0));
    let head = F::head(&own("ln"), &["x"]);
    vec![
        function::<F>("The sine.", &own("sin"), &["x"], &F::far(0), &|x| {
            vec![sin_cos(x[0]).0]
        }),
        function::<F>("The cosine.", &own("cos"), &["x"], &F::far(1), &|x| {
            vec![sin_cos(x[0]).1]
        }),
        function::<F>(
            "The angle of the vector (x, y); of the zero vector 0.",
            &own("atan2"),
            &["y", "x"],
            "",
            &|yx| match short {
                true => vec![atan2_single(yx[0], yx[1])],
                false => vec![atan2_wide(yx[0], yx[1])],
            },
        ),
        function::<F>(
            "The exponential.",
            &own("exp"),
            &["x"],
            &nan,
            &|x| match short {
                true => exp_parts_short(x[0]).to_vec(),
                false => exp_parts(x[0]).to_vec(),
            },
        ),
        function::<F>(
            "The number, or 2^54 times it if it is subnormal.",
            "program_normal",
            &["x"],
            "",
            &|x| vec![normal(x[0])],
        ),
        function::<F>(
            "The logarithm of x, with the exponent and the significand of its normal number.",
            "program_ln_from",
            &["x", "exponent", "significand"],
            "",
            &|x| match short {
                true => vec![ln_from(x[0], x[1], x[2], LN_SERIES_SHORT)],
                false => vec![ln_from(x[0], x[1], x[2], LN_SERIES)],
            },
        ),
        format!(
            "// The natural logarithm.\n{head} {{\n    {constant} normal = program_normal(x);\n    \
             return program_ln_from(x, program_exponent(normal), program_significand(normal));\n}}"
        ),
    ]
}

/// Returns a function recorded from a formula of the library: its first result, times two to the power of each other.
fn function<F: Functions>(
    about: &str,
    name: &str,
    takes: &'static [&'static str],
    start: &str,
    formula: Listed<'_>,
) -> String {
    let (graph, outputs) = match graph_of(Format::F64, takes.len(), formula) {
        Ok(made) => made,
        Err(_) => unreachable!("the formulas of scalars are straight lines"),
    };
    let mut code = String::new();
    let known = lines(&F::dialect(takes), &graph, &mut code);
    let factor = |(i, &x): (usize, &Id)| match i {
        0 => known[x as usize].clone(),
        _ => format!("program_power_of_two({})", known[x as usize]),
    };
    let factors: Vec<String> = outputs.iter().enumerate().map(factor).collect();
    let (head, result) = (F::head(name, takes), factors.join(" * "));
    format!("// {about}\n{head} {{\n{start}{code}    return {result};\n}}")
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

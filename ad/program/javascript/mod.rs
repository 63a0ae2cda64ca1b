//! Programs as modules of JavaScript, with the bits of the library in both formats.
//!
//! JavaScript promises no bits of its own sines, exponentials, logarithms and angles. A module has the library's: the
//! formulas of `src/scalar/` recorded as programs, and printed as they are. Files beside this one have what programs do
//! not: reading and writing the bits of numbers.
use super::blocks::{Block, Functions, elementary, needed, wrapped};
use super::graph::{Format, Node};
use super::recorded::Recorded;
use super::source::{self, Dialect, lines, listed};
use crate::Unrecordable;
use crate::scalar::float::REDUCED;
use std::fmt::Write;
use std::sync::LazyLock;

/// The words that JavaScript keeps for itself in modules, and those with a meaning in the text of a program.
const RESERVED: &str = "arguments await break case catch class const continue debugger default delete do else enum \
    eval export extends false finally for function if implements import in instanceof interface let new null package \
    private protected public return static super switch this throw true try typeof var void while with yield \
    Array ArrayBuffer DataView Infinity Math NaN undefined";

/// Returns `Ok` for a name that the function of a module may have.
pub(crate) fn checked(name: &str) -> Result<(), Unrecordable> {
    source::checked(name, RESERVED.split_whitespace())
}

/// Returns the program as a module that exports a function of this name; `input` names the numbers that it takes.
pub(crate) fn module(name: &str, recorded: &Recorded, input: impl Fn(usize) -> String) -> String {
    let (count, inputs) = (recorded.value.outputs.len(), recorded.inputs);
    let format = recorded.value.graph.format;
    let dialect = JavaScript { format, takes: &[] };
    let mut code = String::new();
    let known = lines(&dialect, &recorded.value.graph, &mut code);
    let results = listed(&recorded.value.outputs, &known);
    let floats = match format {
        Format::F32 => "32-bit floats, to which inputs are rounded",
        Format::F64 => "64-bit floats",
    };
    let mut text = format!("// Written by geograd. In {floats}, with the bits of the library.\n\n");
    for block in needed(prelude(format), &code) {
        let _ = writeln!(text, "{block}\n");
    }
    let _ = writeln!(text, "/**");
    for (i, line) in wrapped((0..inputs).map(input)).iter().enumerate() {
        let start = match i {
            0 => "@param {ArrayLike<number>} x ",
            _ => "  ",
        };
        let _ = writeln!(text, " * {start}{line}");
    }
    let next = dialect.rounded("x[i]".to_owned());
    let sum = dialect.rounded(format!("sum + {next}"));
    // NaN in, NaN out, by the sum that `Guard` has.
    let _ = write!(
        text,
        " * @returns {{number[]}} {count} numbers, all NaN if a number of x is NaN\n */\n\
         export function {name}(x) {{\n\
         \x20   let sum = 0;\n\
         \x20   for (let i = 0; i < {inputs}; i += 1) {{\n\
         \x20       sum = {sum};\n\
         \x20   }}\n\
         \x20   if (sum !== sum) {{\n\
         \x20       return new Array({count}).fill(NaN);\n\
         \x20   }}\n\
         {code}    return [{results}];\n}}\n"
    );
    text
}

/// Returns the name that a line declares.
fn declared(line: &str) -> Option<&str> {
    let rest = ["function ", "const "]
        .iter()
        .find_map(|word| line.strip_prefix(word))?;
    rest.split([' ', '(']).next()
}

/// Returns all declarations that programs of a format may need: of bits, and the library's formulas.
fn prelude(format: Format) -> &'static [Block] {
    static ALL: LazyLock<[Vec<Block>; 2]> = LazyLock::new(|| {
        [Format::F32, Format::F64].map(|format| {
            let own = match format {
                Format::F32 => include_str!("float.js"),
                Format::F64 => include_str!("double.js"),
            };
            let texts = [include_str!("wide.js"), own];
            let split = |text: &'static str| text.trim_end().split("\n\n").map(str::to_owned);
            let all = texts.into_iter().flat_map(split);
            let all = all.chain(elementary::<JavaScript<'_>>(format));
            all.map(|text| Block::new(text, declared)).collect()
        })
    });
    &ALL[usize::from(format == Format::F64)]
}

impl Functions for JavaScript<'_> {
    type Of = JavaScript<'static>;
    fn dialect(takes: &'static [&'static str]) -> JavaScript<'static> {
        let format = Format::F64;
        JavaScript { format, takes }
    }
    fn head(name: &str, takes: &[&str]) -> String {
        format!("function {name}({})", takes.join(", "))
    }
    fn far(part: usize) -> String {
        format!(
            "    if (!(Math.abs(x) <= {REDUCED:?})) {{\n        return program_far(x)[{part}];\n    }}\n"
        )
    }
}

/// The language for a format, with names for the numbers of an input; without names they are those of a list `x`. Its
/// numbers have 64 bits: each result of an operation of `f32` is rounded, which gives the bits of `f32` since 53 bits
/// are more than twice 24 and two.
struct JavaScript<'a> {
    format: Format,
    takes: &'a [&'a str],
}

impl Dialect for JavaScript<'_> {
    const SIGNS: [&'static str; 3] = ["===", "&&", "||"];

    fn shares(&self) -> [&'static str; 2] {
        ["0", "0.5"]
    }
    fn defines(&self, _node: Node) -> &'static str {
        "const"
    }

    fn literal(&self, x: f64) -> String {
        match x {
            f64::INFINITY => "Infinity".to_owned(),
            f64::NEG_INFINITY => "-Infinity".to_owned(),
            x => format!("{x:?}"),
        }
    }
    fn rounded(&self, operation: String) -> String {
        match self.format {
            Format::F32 => format!("Math.fround({operation})"),
            Format::F64 => operation,
        }
    }
    fn extreme(&self, is_most: bool, a: &str, b: &str) -> String {
        // The functions of `Math` differ for NaN and for zeros of two signs.
        let sign = if is_most { '>' } else { '<' };
        format!("{a} {sign} {b} ? {a} : {b}")
    }
    fn magnitude(&self, x: &str) -> String {
        format!("Math.abs({x})")
    }
    fn select(&self, mask: &str, yes: &str, no: &str) -> String {
        format!("{mask} ? {yes} : {no}")
    }
    fn is_number(&self, x: &str) -> String {
        format!("{x} === {x}")
    }
    fn input(&self, place: u32) -> String {
        match self.takes.get(place as usize) {
            Some(&name) => name.to_owned(),
            None => self.rounded(format!("x[{place}]")),
        }
    }
}

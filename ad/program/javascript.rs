//! Programs as modules of JavaScript, in 64-bit floats, with the bits of the library.
//!
//! JavaScript promises no bits of its own sines, exponentials, logarithms and angles. A module has the library's: the
//! formulas of `src/scalar/` recorded as programs, and printed as they are. Reading and writing the bits of numbers,
//! which programs do not, is in `prelude.js`.
use super::blocks::{Block, formula, needed, wrapped};
use super::graph::Node;
use super::record::Listed;
use super::recorded::Recorded;
use super::source::{self, Dialect, lines, listed};
use crate::Unrecordable;
use crate::scalar::arc_tangent::atan2_wide;
use crate::scalar::exponential::{LN_SERIES, exp_parts, ln_from, normal};
use crate::scalar::float::{REDUCED, sin_cos_reduced};
use std::fmt::Write;
use std::sync::LazyLock;

/// The functions for bits, with an empty line between two of them.
const BITS: &str = include_str!("prelude.js");

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
    let mut code = String::new();
    let known = lines(&JavaScript(&[]), &recorded.value.graph, &mut code);
    let results = listed(&recorded.value.outputs, &known);
    let mut text =
        "// Written by geograd. In 64-bit floats, with the bits of the library.\n\n".to_owned();
    for block in needed(&PRELUDE, &code) {
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
    // NaN in, NaN out, by the sum that `Guard` has.
    let _ = write!(
        text,
        " * @returns {{number[]}} {count} numbers, all NaN if a number of x is NaN\n */\n\
         export function {name}(x) {{\n\
         \x20   let sum = 0;\n\
         \x20   for (let i = 0; i < {inputs}; i += 1) {{\n\
         \x20       sum += x[i];\n\
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

/// All declarations that programs may need: of bits, and the library's formulas.
static PRELUDE: LazyLock<Vec<Block>> = LazyLock::new(|| {
    let bits = BITS.trim_end().split("\n\n").map(str::to_owned);
    let all = bits.chain(elementary());
    all.map(|text| Block::new(text, declared)).collect()
});

/// Returns the elementary functions, recorded from the formulas that the library computes with.
fn elementary() -> Vec<String> {
    let far = |part: usize| {
        format!(
            "    if (!(Math.abs(x) <= {REDUCED:?})) {{\n        return program_far(x)[{part}];\n    }}\n"
        )
    };
    let one = |results: &[String]| results[0].clone();
    vec![
        function(
            ("The sine.", "program_sin", &["x"]),
            &far(0),
            &|x| vec![sin_cos_reduced(x[0]).0],
            &one,
        ),
        function(
            ("The cosine.", "program_cos", &["x"]),
            &far(1),
            &|x| vec![sin_cos_reduced(x[0]).1],
            &one,
        ),
        function(
            (
                "The angle of the vector (x, y); of the zero vector 0.",
                "program_atan2",
                &["y", "x"],
            ),
            "",
            &|yx| vec![atan2_wide(yx[0], yx[1])],
            &one,
        ),
        function(
            ("The exponential.", "program_exp", &["x"]),
            "",
            &|x| exp_parts(x[0]).to_vec(),
            &|results| {
                let [power, first, second] = results else {
                    unreachable!("an exponential has three factors")
                };
                format!(
                    "x === x ? {power} * program_power_of_two({first}) * program_power_of_two({second}) : x"
                )
            },
        ),
        function(
            (
                "The number, or 2^54 times it if it is subnormal.",
                "program_normal",
                &["x"],
            ),
            "",
            &|x| vec![normal(x[0])],
            &one,
        ),
        function(
            (
                "The logarithm of x, with the exponent and the significand of its normal number.",
                "program_ln_from",
                &["x", "exponent", "significand"],
            ),
            "",
            &|x| vec![ln_from(x[0], x[1], x[2], LN_SERIES)],
            &one,
        ),
        "// The natural logarithm.\n\
         function program_ln(x) {\n\
         \x20   const normal = program_normal(x);\n\
         \x20   return program_ln_from(x, program_exponent(normal), program_significand(normal));\n\
         }"
        .to_owned(),
    ]
}

/// Returns a function of numbers, recorded from a formula of the library; `result` makes its result of the formula's.
fn function(
    (about, name, takes): (&str, &str, &[&str]),
    start: &str,
    recorded: Listed<'_, f64>,
    result: &dyn Fn(&[String]) -> String,
) -> String {
    let (code, results) = formula(&JavaScript(takes), takes.len(), recorded);
    let (takes, result) = (takes.join(", "), result(&results));
    format!("// {about}\nfunction {name}({takes}) {{\n{start}{code}    return {result};\n}}")
}

/// The language, with names for the numbers of an input; without names they are those of a list `x`.
struct JavaScript<'a>(&'a [&'a str]);

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
        match self.0.get(place as usize) {
            Some(&name) => name.to_owned(),
            None => format!("x[{place}]"),
        }
    }
}

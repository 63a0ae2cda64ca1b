//! Programs as text in other languages: one printer, and a [`Dialect`] for what each language has of its own.
use super::graph::{Graph, Id, Node};
use crate::Unrecordable;
use std::fmt::Write;

/// A language, by the text of those operations that languages write differently. Operands are names.
pub(crate) trait Dialect {
    /// The signs of equality, of both truths and of either.
    const SIGNS: [&'static str; 3];

    /// Returns zero and one half.
    fn shares(&self) -> [&'static str; 2];
    /// Returns the words before the name of a new node.
    fn defines(&self, node: Node) -> &'static str;

    /// Returns a number of the format.
    fn literal(&self, x: f64) -> String;
    /// Returns a call of `least` or `most`, which [`Node::Min`] and [`Node::Max`] are.
    fn extreme(&self, is_most: bool, a: &str, b: &str) -> String;
    /// Returns the absolute value.
    fn magnitude(&self, x: &str) -> String;
    /// Returns a choice between two expressions.
    fn select(&self, mask: &str, yes: &str, no: &str) -> String;
    /// Returns the truth that a number is not NaN.
    fn is_number(&self, x: &str) -> String;

    /// Returns an expression of one operation, rounded to the format where the language computes in a wider one.
    fn rounded(&self, operation: String) -> String {
        operation
    }
    /// Returns a number of the input.
    fn input(&self, place: u32) -> String {
        format!("x[{place}]")
    }
    /// Returns the name of a node.
    fn name(&self, id: usize, _node: Node) -> String {
        format!("v{id}")
    }
    /// Returns the value of a node from the names of earlier ones.
    fn value(&self, _id: usize, node: Node, known: &[String]) -> String
    where
        Self: Sized,
    {
        expression(self, node, known)
    }
}

/// Writes the operations of a graph without grafts, and returns their names. One line per operation: deep expressions
/// overflow the stacks of compilers (gfx-rs/wgpu#5759, #9497). A constant has a line, too, so that no compiler
/// computes with it and finds an overflow where the program would go on.
pub(crate) fn lines<D: Dialect>(dialect: &D, graph: &Graph, text: &mut String) -> Vec<String> {
    let mut known: Vec<String> = Vec::with_capacity(graph.len());
    for (i, &node) in graph.nodes().iter().enumerate() {
        let own = dialect.name(i, node);
        let value = dialect.value(i, node, &known);
        // Writing to a string does not fail.
        let _ = writeln!(text, "    {} {own} = {value};", dialect.defines(node));
        known.push(own);
    }
    known
}

/// Returns the names of the results, with commas between them.
pub(crate) fn listed(outputs: &[Id], known: &[String]) -> String {
    let results: Vec<&str> = outputs.iter().map(|&x| &*known[x as usize]).collect();
    results.join(", ")
}

/// Returns `Ok` for a name that a function may have in a language with these reserved words, and beside the functions
/// that programs call.
pub(crate) fn checked<'a>(
    name: &str,
    mut reserved: impl Iterator<Item = &'a str>,
) -> Result<(), Unrecordable> {
    let letters = |c: char| c == '_' || c.is_ascii_alphanumeric();
    let identifier = name.chars().all(letters)
        && name.starts_with(|c: char| c == '_' || c.is_ascii_alphabetic())
        && name != "_"
        && !name.starts_with("__")
        && !name.starts_with("program_");
    match identifier && reserved.all(|word| word != name) {
        true => Ok(()),
        false => Err(Unrecordable::Name),
    }
}

/// Returns the code of one operation on earlier results, which have names.
pub(crate) fn expression<D: Dialect>(dialect: &D, node: Node, known: &[String]) -> String {
    use Node::*;
    let v = |x: Id| &*known[x as usize];
    let one = |f: &str, x: Id| format!("{f}({})", v(x));
    let two = |f: &str, a: Id, b: Id| format!("{f}({}, {})", v(a), v(b));
    let between = |a: Id, sign: &str, b: Id| format!("{} {sign} {}", v(a), v(b));
    let [equals, and, or] = D::SIGNS;
    match node {
        Const(bits) => dialect.literal(f64::from_bits(bits)),
        Bool(truth) => truth.to_string(),
        Input(place) => dialect.input(place),
        Neg(x) => format!("-{}", v(x)),
        Canonical(x) => format!("{} + 0.0", v(x)),
        Add(a, b) => dialect.rounded(between(a, "+", b)),
        Sub(a, b) => dialect.rounded(between(a, "-", b)),
        Mul(a, b) => dialect.rounded(between(a, "*", b)),
        Div(a, b) => dialect.rounded(between(a, "/", b)),
        Min(a, b) => dialect.extreme(false, v(a), v(b)),
        Max(a, b) => dialect.extreme(true, v(a), v(b)),
        Magnitude(x) | Unsigned(x) => dialect.magnitude(v(x)),
        Root(x) => one("program_root", x),
        Sin(x) => one("program_sin", x),
        Cos(x) => one("program_cos", x),
        SinHigh(x) => one("program_sin_high", x),
        SinLow(x) => one("program_sin_low", x),
        CosHigh(x) => one("program_cos_high", x),
        CosLow(x) => one("program_cos_low", x),
        Atan2(y, x) => two("program_atan2", y, x),
        Exp(x) => one("program_exp", x),
        Ln(x) => one("program_ln", x),
        Binade(x) => one("program_binade", x),
        High(x) => one("program_high", x),
        Graft { value, .. } => v(value).to_owned(),
        // Derivatives have thousands of these, and drivers move all that follows whenever they inline a call.
        Split(a, b, bar) => shared(dialect, v(a), v(b), (dialect.shares()[0], v(bar)), v(bar)),
        Rest(a, b, bar) => shared(dialect, v(a), v(b), (v(bar), dialect.shares()[0]), v(bar)),
        Lt(a, b) => between(a, "<", b),
        Le(a, b) => between(a, "<=", b),
        Eq(a, b) if a == b => dialect.is_number(v(a)),
        Eq(a, b) => between(a, equals, b),
        And(a, b) => between(a, and, b),
        Or(a, b) => between(a, or, b),
        Not(x) => format!("!{}", v(x)),
        Select(mask, yes, no) => dialect.select(v(mask), v(yes), v(no)),
    }
}

/// Returns the share of one of two numbers in the cotangent of their minimum: `less` if a is less, `more` if it is
/// more, half of the cotangent in a tie.
fn shared<D: Dialect>(
    dialect: &D,
    a: &str,
    b: &str,
    (more, less): (&str, &str),
    bar: &str,
) -> String {
    let (equals, half) = (D::SIGNS[0], dialect.shares()[1]);
    let tied = dialect.select(
        &format!("{a} {equals} {b}"),
        &dialect.rounded(format!("{bar} * {half}")),
        more,
    );
    dialect.select(&format!("{a} < {b}"), less, &tied)
}

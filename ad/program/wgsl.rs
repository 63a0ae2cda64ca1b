//! Programs as functions of the shading language WGSL.
//!
//! A driver may assume that no number is infinite or NaN, so guards stand before the operations that need them: see
//! [`program`](super).
use super::graph::{Graph, Id, Node};
use super::recorded::Recorded;
use crate::Unrecordable;
use std::fmt::Write;

/// The functions that programs call in [WGSL](https://www.w3.org/TR/WGSL/). They belong, once, into
/// every shader with functions from [`Program::wgsl`](super::Program::wgsl).
pub const WGSL: &str = include_str!("prelude.wgsl");

/// The words that WGSL keeps for itself, in the order of its standard.
const RESERVED: &str = include_str!("reserved.txt");

/// The words with a meaning in the text of a program.
const USED: &str =
    "f32 i32 u32 bool array vec2f select bitcast abs min max floor clamp log sqrt round";

/// Returns `Ok` for a name that a function of a shader with [`WGSL`] may have.
pub(crate) fn checked(name: &str) -> Result<(), Unrecordable> {
    let letters = |c: char| c == '_' || c.is_ascii_alphanumeric();
    let identifier = name.chars().all(letters)
        && name.starts_with(|c: char| c == '_' || c.is_ascii_alphabetic())
        && name != "_"
        && !name.starts_with("__")
        && !name.starts_with("program_");
    let kept = || RESERVED.split_whitespace().chain(USED.split_whitespace());
    match identifier && kept().all(|word| word != name) {
        true => Ok(()),
        false => Err(Unrecordable::Name),
    }
}

/// Returns the program as a function. One `let` per operation: deep expressions overflow the stacks of
/// compilers (gfx-rs/wgpu#5759, #9497). A constant is a `let`, too, so that no compiler computes
/// with it and finds an overflow where the program would go on.
pub(crate) fn function(name: &str, recorded: &Recorded) -> String {
    function_of(
        name,
        &recorded.value.graph,
        &recorded.value.outputs,
        recorded.inputs,
        &[],
    )
}

/// A number that a function takes.
pub(crate) struct Taken {
    /// Its name.
    pub name: String,
    /// `true` if it is [exact](exact).
    pub is_exact: bool,
}

/// Returns the code of a graph without grafts as a function of `inputs` numbers; `taken` describes the first ones.
pub(crate) fn function_of(
    name: &str,
    graph: &Graph,
    outputs: &[Id],
    inputs: usize,
    taken: &[Taken],
) -> String {
    let count = outputs.len();
    let mut text = format!("fn {name}(x: array<f32, {inputs}>) -> array<f32, {count}> {{\n");
    let mut known: Vec<String> = Vec::with_capacity(graph.len());
    let kept = kept(graph, taken);
    // Writing to a string does not fail.
    for (i, &node) in graph.nodes().iter().enumerate() {
        let own = match node {
            Node::Input(place) => taken.get(place as usize).map(|x| x.name.clone()),
            _ => None,
        };
        let own = own.unwrap_or_else(|| format!("v{i}"));
        let value = match rounded(graph, node) {
            Some(x) => format!("round({})", known[x as usize]),
            None if kept[i] => format!("program_kept({})", expression(node, &known)),
            None => expression(node, &known),
        };
        let _ = writeln!(text, "    let {own} = {value};");
        known.push(own);
    }
    let results: Vec<&str> = outputs.iter().map(|&x| &*known[x as usize]).collect();
    let _ = writeln!(
        text,
        "    return array<f32, {count}>({});\n}}",
        results.join(", ")
    );
    text
}

/// Returns the number that a node rounds to a whole one by adding and subtracting a large one. Drivers may remove both
/// steps (Mesa's do); WGSL has a function for it, which rounds alike.
fn rounded(graph: &Graph, node: Node) -> Option<Id> {
    const SHIFT: f64 = 1.5 * (1 << 23) as f64;
    let is_shift = |x: Id| graph.constant(x) == Some(SHIFT);
    let Node::Sub(sum, shift) = node else {
        return None;
    };
    match graph.at(sum) {
        Node::Add(x, y) if is_shift(shift) && is_shift(y) => Some(x),
        Node::Add(y, x) if is_shift(shift) && is_shift(y) => Some(x),
        _ => None,
    }
}

/// Returns which sums and differences a driver must compute as they are written. WGSL lets it reorder a sum of several
/// terms, and Mesa's do. Rounding errors then become zero, and parts that cancel exactly are rounded first.
///
/// These are sums from which a number that is in them is taken away again, as in the error of a difference,
/// `b - (r - (r - b)) - (a + (r - b))` with `r = b - a`, and [exact](exact) ones to which others are added.
fn kept(graph: &Graph, taken: &[Taken]) -> Vec<bool> {
    /// Sums of more terms count as one number.
    const MOST: usize = 8;
    let taken: Vec<bool> = taken.iter().map(|x| x.is_exact).collect();
    let exact = exact(graph, &taken);
    let mut kept = vec![false; graph.len()];
    // Every number as a sum: its terms, and whether each is negative.
    let mut terms: Vec<Vec<(Id, bool)>> = Vec::with_capacity(graph.len());
    for (i, &node) in graph.nodes().iter().enumerate() {
        let (x, y, negative) = match node {
            Node::Add(x, y) => (x, y, false),
            Node::Sub(x, y) if rounded(graph, node).is_none() => (x, y, true),
            _ => {
                terms.push(vec![(i as Id, false)]);
                continue;
            }
        };
        let of = |terms: &[Vec<(Id, bool)>]| {
            let second = terms[y as usize].iter();
            let second = second.map(|&(term, sign)| (term, sign != negative));
            (terms[x as usize].clone(), second.collect::<Vec<_>>())
        };
        let (mut first, mut second) = of(&terms);
        let recurs = first.iter().any(|&(x, sign)| second.contains(&(x, !sign)));
        for (sum, other) in [(x as usize, y as usize), (y as usize, x as usize)] {
            if terms[sum].len() > 1 && (recurs || exact[sum] && !exact[other]) {
                kept[sum] = true;
                terms[sum] = vec![(sum as Id, false)];
            }
        }
        (first, second) = of(&terms);
        first.append(&mut second);
        if first.len() > MOST {
            first = vec![(i as Id, false)];
        }
        terms.push(first);
    }
    kept
}

/// Returns which numbers of a graph are products and sums of constants and high halves of significands alone. Products
/// of two halves are exact, and so are their sums where they cancel.
pub(crate) fn exact(graph: &Graph, taken: &[bool]) -> Vec<bool> {
    use Node::*;
    let is_shift = |sum: Id, shift: Id| {
        let same =
            |x: Id| graph.constant(x).is_some() && graph.constant(x) == graph.constant(shift);
        matches!(graph.at(sum), Add(x, y) if same(x) || same(y))
    };
    let (mut exact, mut constant) = (vec![false; graph.len()], vec![false; graph.len()]);
    for (i, &node) in graph.nodes().iter().enumerate() {
        let all = |x: Id, y: Id| {
            let is = |x: Id| exact[x as usize] || constant[x as usize];
            let constant = constant[x as usize] && constant[y as usize];
            (is(x) && is(y) && !constant, constant)
        };
        (exact[i], constant[i]) = match node {
            High(_) | SinHigh(_) | CosHigh(_) => (true, false),
            // Rounded by adding a large number and taking it away again.
            Sub(x, y) if is_shift(x, y) => (true, false),
            Const(_) => (false, true),
            Input(place) => (taken.get(place as usize).is_some_and(|&is| is), false),
            Neg(x) => (exact[x as usize], constant[x as usize]),
            Mul(x, y) | Add(x, y) | Sub(x, y) | Select(_, x, y) => all(x, y),
            _ => (false, false),
        };
    }
    exact
}

/// Returns the code of one operation on earlier results, which have names.
fn expression(node: Node, known: &[String]) -> String {
    use Node::*;
    let v = |x: Id| &*known[x as usize];
    let one = |f: &str, x: Id| format!("{f}({})", v(x));
    let two = |f: &str, a: Id, b: Id| format!("{f}({}, {})", v(a), v(b));
    let three = |f: &str, a: Id, b: Id, c: Id| format!("{f}({}, {}, {})", v(a), v(b), v(c));
    let between = |a: Id, sign: &str, b: Id| format!("{} {sign} {}", v(a), v(b));
    match node {
        Const(bits) => literal(f64::from_bits(bits) as f32),
        Bool(truth) => truth.to_string(),
        Input(place) => format!("x[{place}]"),
        Neg(x) => format!("-{}", v(x)),
        Canonical(x) => format!("{} + 0.0", v(x)),
        Add(a, b) => between(a, "+", b),
        Sub(a, b) => between(a, "-", b),
        Mul(a, b) => between(a, "*", b),
        Div(a, b) => between(a, "/", b),
        Min(a, b) => two("min", a, b),
        Max(a, b) => two("max", a, b),
        Magnitude(x) | Unsigned(x) => one("abs", x),
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
        Split(a, b, bar) => shared(v(a), v(b), ("0f", v(bar)), v(bar)),
        Rest(a, b, bar) => shared(v(a), v(b), (v(bar), "0f"), v(bar)),
        Lt(a, b) => between(a, "<", b),
        Le(a, b) => between(a, "<=", b),
        // The test for NaN is by bits, since a driver may assume that no number is NaN.
        Eq(a, b) if a == b => format!("((bitcast<u32>({}) & 0x7fffffffu) <= 0x7f800000u)", v(a)),
        Eq(a, b) => between(a, "==", b),
        And(a, b) => between(a, "&", b),
        Or(a, b) => between(a, "|", b),
        Not(x) => format!("!{}", v(x)),
        Select(mask, yes, no) => three("select", no, yes, mask),
    }
}

/// Returns the share of one of two numbers in the cotangent of their minimum: `less` if a is less, `more` if it is
/// more, half of the cotangent in a tie.
fn shared(a: &str, b: &str, (more, less): (&str, &str), bar: &str) -> String {
    format!("select(select({more}, {bar} * 0.5f, {a} == {b}), {less}, {a} < {b})")
}

/// Returns a finite number. Numbers below the smallest normal one are given by their bits.
fn literal(x: f32) -> String {
    if x == 0.0 || x.is_normal() {
        format!("{x:e}f")
    } else {
        format!("bitcast<f32>({:#x}u)", x.to_bits())
    }
}

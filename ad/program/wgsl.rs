//! Programs as functions of the shading language WGSL.
//!
//! A driver may assume that no number is infinite or NaN, so guards stand before the operations that need them: see
//! [`program`](super).
use super::graph::{Graph, Id, Node};
use super::recorded::Recorded;
use super::source::{self, Dialect, expression, lines, listed};
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
    let words = RESERVED.split_whitespace().chain(USED.split_whitespace());
    source::checked(name, words)
}

/// Returns the program as a function.
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
    let kept = kept(graph, taken);
    let wgsl = Wgsl { graph, kept, taken };
    let known = lines(&wgsl, graph, &mut text);
    let results = listed(outputs, &known);
    // Writing to a string does not fail.
    let _ = writeln!(text, "    return array<f32, {count}>({results});\n}}");
    text
}

/// The language, for one graph.
struct Wgsl<'a> {
    graph: &'a Graph,
    /// `true` for the numbers that a driver must compute as they are written.
    kept: Vec<bool>,
    taken: &'a [Taken],
}

impl Dialect for Wgsl<'_> {
    const SIGNS: [&'static str; 3] = ["==", "&", "|"];

    fn shares(&self) -> [&'static str; 2] {
        ["0f", "0.5f"]
    }
    fn defines(&self, _node: Node) -> &'static str {
        "let"
    }

    fn literal(&self, x: f64) -> String {
        literal(x as f32)
    }
    fn extreme(&self, is_most: bool, a: &str, b: &str) -> String {
        let name = if is_most { "max" } else { "min" };
        format!("{name}({a}, {b})")
    }
    fn magnitude(&self, x: &str) -> String {
        format!("abs({x})")
    }
    fn select(&self, mask: &str, yes: &str, no: &str) -> String {
        format!("select({no}, {yes}, {mask})")
    }
    fn is_number(&self, x: &str) -> String {
        // By bits, since a driver may assume that no number is NaN.
        format!("((bitcast<u32>({x}) & 0x7fffffffu) <= 0x7f800000u)")
    }
    fn name(&self, id: usize, node: Node) -> String {
        let own = match node {
            Node::Input(place) => self.taken.get(place as usize).map(|x| x.name.clone()),
            _ => None,
        };
        own.unwrap_or_else(|| format!("v{id}"))
    }
    fn value(&self, id: usize, node: Node, known: &[String]) -> String {
        match rounded(self.graph, node) {
            Some(x) => format!("round({})", known[x as usize]),
            None if self.kept[id] => format!("program_kept({})", expression(self, node, known)),
            None => expression(self, node, known),
        }
    }
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

/// Returns a finite number. Numbers below the smallest normal one are given by their bits. The shortest digits of the
/// largest number are those of a larger one, which Tint, the compiler of Chromium, refuses.
pub(crate) fn literal(x: f32) -> String {
    match x {
        _ if x.abs() == f32::MAX => format!("{:e}f", f64::from(x)),
        _ if x == 0.0 || x.is_normal() => format!("{x:e}f"),
        _ => format!("bitcast<f32>({:#x}u)", x.to_bits()),
    }
}

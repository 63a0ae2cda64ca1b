//! Programs as text for people.
use super::graph::{Id, Node};
use super::recorded::Recorded;
use std::fmt;

/// Writes a line per operation, numbered, and at last the results.
pub(crate) fn print(
    f: &mut fmt::Formatter<'_>,
    recorded: &Recorded,
    input: impl Fn(usize) -> String,
    output: impl Fn(usize) -> String,
) -> fmt::Result {
    use Node::*;
    let graph = &recorded.value.graph;
    // Constants and inputs are written at their uses.
    let name = |x: Id| match graph.at(x) {
        Const(bits) => format!("{:?}", f64::from_bits(bits)),
        Bool(truth) => truth.to_string(),
        Input(place) => input(place as usize),
        _ => format!("v{x}"),
    };
    for (i, &node) in graph.nodes().iter().enumerate() {
        let n = |x| name(x);
        let text = match node {
            Const(_) | Input(_) | Bool(_) => continue,
            Neg(x) => format!("−{}", n(x)),
            Canonical(x) => format!("{} + 0", n(x)),
            Add(a, b) => format!("{} + {}", n(a), n(b)),
            Sub(a, b) => format!("{} − {}", n(a), n(b)),
            Mul(a, b) => format!("{} · {}", n(a), n(b)),
            Div(a, b) => format!("{} / {}", n(a), n(b)),
            Min(a, b) => format!("least({}, {})", n(a), n(b)),
            Max(a, b) => format!("most({}, {})", n(a), n(b)),
            Magnitude(x) | Unsigned(x) => format!("magnitude({})", n(x)),
            Root(x) => format!("root({})", n(x)),
            Sin(x) => format!("sin({})", n(x)),
            Cos(x) => format!("cos({})", n(x)),
            SinHigh(x) => format!("sin_high({})", n(x)),
            SinLow(x) => format!("sin_low({})", n(x)),
            CosHigh(x) => format!("cos_high({})", n(x)),
            CosLow(x) => format!("cos_low({})", n(x)),
            Atan2(y, x) => format!("atan2({}, {})", n(y), n(x)),
            Exp(x) => format!("exp({})", n(x)),
            Ln(x) => format!("ln({})", n(x)),
            Binade(x) => format!("binade({})", n(x)),
            High(x) => format!("high({})", n(x)),
            Graft { value, .. } => n(value),
            Split(a, b, bar) => format!("split({}, {}, {})", n(a), n(b), n(bar)),
            Rest(a, b, bar) => format!("rest({}, {}, {})", n(a), n(b), n(bar)),
            Lt(a, b) => format!("{} < {}", n(a), n(b)),
            Le(a, b) => format!("{} ≤ {}", n(a), n(b)),
            Eq(a, b) => format!("{} = {}", n(a), n(b)),
            And(a, b) => format!("{} and {}", n(a), n(b)),
            Or(a, b) => format!("{} or {}", n(a), n(b)),
            Not(x) => format!("not {}", n(x)),
            Select(mask, yes, no) => format!("{} if {} else {}", n(yes), n(mask), n(no)),
        };
        writeln!(f, "v{i} = {text}")?;
    }
    for (i, &x) in recorded.value.outputs.iter().enumerate() {
        writeln!(f, "result {}: {}", output(i), name(x))?;
    }
    Ok(())
}

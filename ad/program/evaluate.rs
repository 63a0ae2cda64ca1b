//! The evaluation of nodes, on any scalar.
use super::graph::{Graph, Id, Node};
use crate::Scalar;

/// The result of a node. A truth is never compared with a number, since a traced scalar counts every comparison.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Slot<S: Scalar> {
    Number(S),
    Mask(S::Mask),
}

impl<S: Scalar> Slot<S> {
    fn number(self) -> S {
        match self {
            Slot::Number(number) => number,
            Slot::Mask(_) => unreachable!("an operand of numbers is no truth"),
        }
    }
    fn mask(self) -> S::Mask {
        match self {
            Slot::Mask(mask) => mask,
            Slot::Number(_) => unreachable!("an operand of truths is no number"),
        }
    }
}

/// Returns the result of a node, from the results of its operands.
///
/// Derivatives follow the scalar's own rules, so that a program evaluated on dual numbers has the derivatives
/// that the recorded function has on them.
pub(crate) fn apply<S: Scalar>(node: Node, inputs: &[S], slot: impl Fn(Id) -> Slot<S>) -> Slot<S> {
    use Node::*;
    let n = |x| slot(x).number();
    let m = |x| slot(x).mask();
    Slot::Number(match node {
        Bool(truth) => {
            let no = S::zero().below(S::zero());
            return Slot::Mask(if truth { !no } else { no });
        }
        Lt(a, b) => return Slot::Mask(n(a).below(n(b))),
        Le(a, b) => return Slot::Mask(n(a).at_most(n(b))),
        Eq(a, b) => return Slot::Mask(n(a).equals(n(b))),
        And(a, b) => return Slot::Mask(m(a) & m(b)),
        Or(a, b) => return Slot::Mask(m(a) | m(b)),
        Not(a) => return Slot::Mask(!m(a)),
        Const(bits) => S::lit(f64::from_bits(bits)),
        Input(place) => inputs[place as usize],
        Neg(x) => -n(x),
        Canonical(x) => n(x).canonical(),
        Add(a, b) => n(a) + n(b),
        Sub(a, b) => n(a) - n(b),
        Mul(a, b) => n(a) * n(b),
        Div(a, b) => n(a).over(n(b)),
        Min(a, b) => n(a).least(n(b)),
        Max(a, b) => n(a).most(n(b)),
        Magnitude(x) => n(x).magnitude(),
        Unsigned(x) => n(x).unsigned(),
        Root(x) => n(x).root(),
        Sin(x) => n(x).sin(),
        Cos(x) => n(x).cos(),
        SinHigh(x) => n(x).sin_cos_parts()[0].0,
        SinLow(x) => n(x).sin_cos_parts()[0].1,
        CosHigh(x) => n(x).sin_cos_parts()[1].0,
        CosLow(x) => n(x).sin_cos_parts()[1].1,
        Atan2(y, x) => n(y).atan2(n(x)),
        Exp(x) => n(x).exp(),
        Ln(x) => n(x).ln(),
        Binade(x) => n(x).binade(),
        High(x) => n(x).parts().0,
        Graft {
            value,
            derivative,
            share,
        } => {
            let value = n(value).primal();
            match (derivative, share) {
                (None, _) => S::from_primal(value),
                (Some(derivative), None) => n(derivative).with_primal(value),
                (Some(derivative), Some(share)) => {
                    n(derivative).damp(n(share).primal()).with_primal(value)
                }
            }
        }
        Split(a, b, bar) => {
            let tie = S::select(n(a).equals(n(b)), n(bar).halved(), S::zero());
            S::select(n(a).below(n(b)), n(bar), tie)
        }
        Rest(a, b, bar) => {
            let tie = S::select(n(a).equals(n(b)), n(bar).halved(), n(bar));
            S::select(n(a).below(n(b)), S::zero(), tie)
        }
        Select(mask, yes, no) => S::select(m(mask), n(yes), n(no)),
    })
}

/// Returns the outputs of a graph at an input, which must have every number that the graph uses.
pub(crate) fn evaluate<S: Scalar>(graph: &Graph, outputs: &[Id], inputs: &[S]) -> Vec<S> {
    evaluate_needed(graph, |_| true, outputs, inputs)
}

/// Returns the outputs of a graph at an input, without evaluating nodes that no output needs.
pub(crate) fn evaluate_needed<S: Scalar>(
    graph: &Graph,
    needed: impl Fn(usize) -> bool,
    outputs: &[Id],
    inputs: &[S],
) -> Vec<S> {
    let mut slots: Vec<Slot<S>> = Vec::with_capacity(graph.len());
    for (i, &node) in graph.nodes().iter().enumerate() {
        let slot = match needed(i) {
            true => apply(node, inputs, |x| slots[x as usize]),
            false => Slot::Number(S::zero()),
        };
        slots.push(slot);
    }
    let number = |&x: &Id| slots[x as usize].number();
    outputs.iter().map(number).collect()
}

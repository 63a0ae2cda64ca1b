//! Simplification of nodes as they are created, by rules that do not change the result.
//!
//! Every rule is exact except for the signs of zeros, which no output shows: outputs end in [`Node::Canonical`]. There
//! is no `0 x = 0` and no `x − x = 0` (wrong for infinite and NaN), no re-association and no fused rounding.
use super::evaluate::{Slot, apply};
use super::graph::{Format, Graph, Id, Node};

impl Graph {
    /// Adds a node, or a simpler one with equal value, and returns its index.
    pub(crate) fn make(&mut self, node: Node) -> Id {
        use Node::*;
        if let Some(known) = self.folded(node) {
            return self.push(known);
        }
        match node {
            Neg(x) => match self.at(x) {
                Neg(y) => y,
                _ => self.push(node),
            },
            Canonical(x) => match self.at(x) {
                Canonical(_) => x,
                _ => self.push(node),
            },
            Add(a, b) => self.sum(a, b),
            Sub(a, b) => self.difference(a, b),
            Mul(a, b) => self.product(a, b),
            Div(a, b) => self.quotient(a, b),
            Min(a, b) | Max(a, b) if a == b => a,
            // Nothing is below itself. (NaN does not equal itself, though.)
            Lt(a, b) if a == b => self.push(Bool(false)),
            Eq(a, b) if a == b && self.is_number(a) => self.push(Bool(true)),
            Eq(a, b) => self.push(Eq(a.min(b), a.max(b))),
            And(a, b) => match (self.truth(a), self.truth(b)) {
                (Some(true), _) | (_, Some(false)) => b,
                (_, Some(true)) | (Some(false), _) => a,
                _ if a == b => a,
                _ if self.opposite(a, b) => self.push(Bool(false)),
                _ => self.push(And(a.min(b), a.max(b))),
            },
            Or(a, b) => match (self.truth(a), self.truth(b)) {
                (Some(false), _) | (_, Some(true)) => b,
                (_, Some(false)) | (Some(true), _) => a,
                _ if a == b => a,
                _ if self.opposite(a, b) => self.push(Bool(true)),
                _ => self.push(Or(a.min(b), a.max(b))),
            },
            Not(x) => match self.at(x) {
                Not(y) => y,
                _ => self.push(node),
            },
            Select(mask, yes, no) => self.choice(mask, yes, no),
            Split(a, b, bar) => match self.at(bar) {
                Neg(x) => {
                    let split = self.make(Split(a, b, x));
                    self.make(Neg(split))
                }
                _ if self.constant(bar) == Some(0.0) => bar,
                _ => self.push(node),
            },
            Rest(a, b, bar) => match self.at(bar) {
                Neg(x) => {
                    let rest = self.make(Rest(a, b, x));
                    self.make(Neg(rest))
                }
                _ if self.constant(bar) == Some(0.0) => bar,
                _ => self.push(node),
            },
            // A constant has no derivatives to lose.
            Graft {
                value,
                derivative: None,
                ..
            } if matches!(
                self.at(value),
                Const(_)
                    | Graft {
                        derivative: None,
                        ..
                    }
            ) =>
            {
                value
            }
            _ => self.push(node),
        }
    }

    /// Returns the constant that an operation on constants gives, in the format of the program; nothing if
    /// it is infinite or NaN, which programs do not write down (unless run on plain numbers).
    fn folded(&self, node: Node) -> Option<Node> {
        let operands = node.operands();
        let known = |x: &Id| self.constant(*x).is_some() || self.truth(*x).is_some();
        if operands.is_empty() || !operands.iter().all(known) {
            return None;
        }
        let number = match self.format {
            Format::F32 => match self.outcome::<f32>(node) {
                Slot::Number(number) => f64::from(number),
                Slot::Mask(truth) => return Some(Node::Bool(truth)),
            },
            Format::F64 => match self.outcome::<f64>(node) {
                Slot::Number(number) => number,
                Slot::Mask(truth) => return Some(Node::Bool(truth)),
            },
        };
        (self.plain || number.is_finite()).then(|| Node::Const(number.to_bits()))
    }

    /// Returns `true` if one is the negation of the other.
    fn opposite(&self, a: Id, b: Id) -> bool {
        self.at(a) == Node::Not(b) || self.at(b) == Node::Not(a)
    }

    /// Returns the result of an operation on constants.
    fn outcome<T: crate::Scalar<Mask = bool>>(&self, node: Node) -> Slot<T> {
        apply::<T>(node, &[], |x| match self.at(x) {
            Node::Bool(truth) => Slot::Mask(truth),
            _ => Slot::Number(T::lit(self.constant(x).unwrap_or(f64::NAN))),
        })
    }

    fn sum(&mut self, a: Id, b: Id) -> Id {
        use Node::*;
        match (self.at(a), self.at(b)) {
            _ if self.constant(a) == Some(0.0) => b,
            _ if self.constant(b) == Some(0.0) => a,
            (Neg(x), Neg(y)) => {
                let sum = self.make(Add(x, y));
                self.make(Neg(sum))
            }
            (_, Neg(y)) => self.make(Sub(a, y)),
            (Neg(x), _) => self.make(Sub(b, x)),
            _ => self.push(Add(a.min(b), a.max(b))),
        }
    }

    fn difference(&mut self, a: Id, b: Id) -> Id {
        use Node::*;
        match (self.at(a), self.at(b)) {
            _ if self.constant(b) == Some(0.0) => a,
            _ if self.constant(a) == Some(0.0) => self.make(Neg(b)),
            (_, Neg(y)) => self.make(Add(a, y)),
            (Neg(x), _) => {
                let sum = self.make(Add(x, b));
                self.make(Neg(sum))
            }
            _ => self.push(Sub(a, b)),
        }
    }

    fn product(&mut self, a: Id, b: Id) -> Id {
        use Node::*;
        match (self.at(a), self.at(b)) {
            _ if self.constant(a) == Some(1.0) => b,
            _ if self.constant(b) == Some(1.0) => a,
            _ if self.constant(a) == Some(-1.0) => self.make(Neg(b)),
            _ if self.constant(b) == Some(-1.0) => self.make(Neg(a)),
            (Neg(x), Neg(y)) => self.make(Mul(x, y)),
            (Neg(x), _) => {
                let product = self.make(Mul(x, b));
                self.make(Neg(product))
            }
            (_, Neg(y)) => {
                let product = self.make(Mul(a, y));
                self.make(Neg(product))
            }
            _ => self.push(Mul(a.min(b), a.max(b))),
        }
    }

    fn quotient(&mut self, a: Id, b: Id) -> Id {
        use Node::*;
        match (self.at(a), self.at(b)) {
            _ if self.constant(b) == Some(1.0) => a,
            (Neg(x), Neg(y)) => self.make(Div(x, y)),
            (Neg(x), _) => {
                let quotient = self.make(Div(x, b));
                self.make(Neg(quotient))
            }
            (_, Neg(y)) => {
                let quotient = self.make(Div(a, y));
                self.make(Neg(quotient))
            }
            _ => self.push(Div(a, b)),
        }
    }

    fn choice(&mut self, mask: Id, yes: Id, no: Id) -> Id {
        use Node::*;
        match self.at(mask) {
            Bool(true) => return yes,
            Bool(false) => return no,
            Not(other) => return self.make(Select(other, no, yes)),
            _ => {}
        }
        // The outer choice decides a choice inside it by the same mask.
        let yes = match self.at(yes) {
            Select(same, inner, _) if same == mask => inner,
            _ => yes,
        };
        let no = match self.at(no) {
            Select(same, _, inner) if same == mask => inner,
            _ => no,
        };
        match (self.at(yes), self.at(no)) {
            _ if yes == no => yes,
            (Neg(x), Neg(y)) => {
                let choice = self.make(Select(mask, x, y));
                self.make(Neg(choice))
            }
            _ => self.push(Select(mask, yes, no)),
        }
    }
}

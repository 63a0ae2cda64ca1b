//! Programs as lists of operations, for translation to other languages.
use crate::ad::program::graph::Node;
use crate::ad::program::recorded::Recorded;

/// A program as a list of operations, each after its operands.
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes {
    /// The number of inputs.
    pub inputs: usize,
    /// The operations in order.
    pub nodes: Vec<Step>,
    /// The indices of the results in `nodes`.
    pub outputs: Vec<u32>,
}

/// An operation of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The elementary operation.
    pub operation: Elementary,
    /// The indices of its operands in `nodes`.
    pub operands: Vec<u32>,
}

/// Defines elementary operations: documentation, name, and the name for emitters.
macro_rules! elementary {
    ($($(#[$doc:meta])* $Name:ident = $name:literal: $node:pat,)*) => {
        /// An elementary operation: a method of [`Scalar`](crate::Scalar) on plain numbers.
        ///
        /// A product in a sum is rounded before the sum (no fused operation). `least` and `most` are selections: if an
        /// operand is NaN they return the second one.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Elementary {
            /// A number of the format.
            Constant(f64),
            /// The number at this index of the input, from zero.
            Input(u32),
            /// A constant truth.
            Bool(bool),
            $($(#[$doc])* $Name,)*
        }

        impl Elementary {
            /// Returns its name in lower case.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    Elementary::Constant(_) => "constant",
                    Elementary::Input(_) => "input",
                    Elementary::Bool(_) => "bool",
                    $(Elementary::$Name => $name,)*
                }
            }
            /// Returns `true` if its result is a truth, not a number.
            #[must_use]
            pub const fn is_truth(self) -> bool {
                use Elementary::*;
                matches!(self, Bool(_) | Lt | Le | Eq | And | Or | Not)
            }
            fn of(node: Node) -> Self {
                match node {
                    Node::Const(bits) => Elementary::Constant(f64::from_bits(bits)),
                    Node::Input(place) => Elementary::Input(place),
                    Node::Bool(truth) => Elementary::Bool(truth),
                    // A graph of values has no grafts.
                    Node::Graft { .. } => Elementary::Canonical,
                    $($node => Elementary::$Name,)*
                }
            }
        }
    };
}

elementary! {
    /// `−x`.
    Neg = "neg": Node::Neg(_),
    /// `x + 0`, which takes its sign from a zero.
    Canonical = "canonical": Node::Canonical(_),
    /// `a + b`.
    Add = "add": Node::Add(..),
    /// `a − b`.
    Sub = "sub": Node::Sub(..),
    /// `a b`.
    Mul = "mul": Node::Mul(..),
    /// `a / b`.
    Div = "div": Node::Div(..),
    /// `a` if `a < b`, else `b`.
    Least = "least": Node::Min(..),
    /// `a` if `a > b`, else `b`.
    Most = "most": Node::Max(..),
    /// `|x|`.
    Magnitude = "magnitude": Node::Magnitude(_) | Node::Unsigned(_),
    /// `√x` for `x > 0`, else 0.
    Root = "root": Node::Root(_),
    /// The sine.
    Sin = "sin": Node::Sin(_),
    /// The cosine.
    Cos = "cos": Node::Cos(_),
    /// The high half of the sine: 12 bits of the significand in `f32`.
    SinHigh = "sin_high": Node::SinHigh(_),
    /// The sine less its high half.
    SinLow = "sin_low": Node::SinLow(_),
    /// The high half of the cosine.
    CosHigh = "cos_high": Node::CosHigh(_),
    /// The cosine less its high half.
    CosLow = "cos_low": Node::CosLow(_),
    /// The angle of the vector with ordinate `a` and abscissa `b`, of the zero vector 0.
    Atan2 = "atan2": Node::Atan2(..),
    /// The exponential.
    Exp = "exp": Node::Exp(_),
    /// The natural logarithm.
    Ln = "ln": Node::Ln(_),
    /// The power of two that brings `x > 0` into `[2, 4)`.
    Binade = "binade": Node::Binade(_),
    /// The high half of the significand.
    High = "high": Node::High(_),
    /// `c` if `a < b`, `c / 2` if `a = b`, else 0.
    Split = "split": Node::Split(..),
    /// 0 if `a < b`, `c / 2` if `a = b`, else `c`.
    Rest = "rest": Node::Rest(..),
    /// `a < b`.
    Lt = "lt": Node::Lt(..),
    /// `a ≤ b`.
    Le = "le": Node::Le(..),
    /// `a = b`.
    Eq = "eq": Node::Eq(..),
    /// Both truths.
    And = "and": Node::And(..),
    /// Either truth.
    Or = "or": Node::Or(..),
    /// The other truth.
    Not = "not": Node::Not(_),
    /// `b` where the truth `a` holds, else `c`.
    Select = "select": Node::Select(..),
}

/// Returns the operations of a program as a list.
pub(super) fn nodes(recorded: &Recorded) -> Nodes {
    let lowered = &recorded.value;
    let step = |&node: &Node| Step {
        operation: Elementary::of(node),
        operands: node.operands().to_vec(),
    };
    Nodes {
        inputs: recorded.inputs,
        nodes: lowered.graph.nodes().iter().map(step).collect(),
        outputs: lowered.outputs.clone(),
    }
}

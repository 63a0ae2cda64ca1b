//! What a program costs.
use super::graph::{Graph, Node};

/// How many operations a program has, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Cost {
    /// Sums and differences.
    pub additions: usize,
    /// Products.
    pub multiplications: usize,
    /// Quotients.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
    /// Sines and cosines or halves of them, angles, exponentials and logarithms.
    pub elementary: usize,
    /// Choices between numbers: selections, minima, maxima, and what their slopes are.
    pub choices: usize,
    /// Comparisons, and what connects their outcomes.
    pub comparisons: usize,
    /// Signs, magnitudes, powers of two and high halves: operations on bits.
    pub bits: usize,
}

impl Cost {
    /// All operations together.
    #[must_use]
    pub fn total(&self) -> usize {
        self.additions
            + self.multiplications
            + self.divisions
            + self.roots
            + self.elementary
            + self.choices
            + self.comparisons
            + self.bits
    }

    pub(super) fn of(graph: &Graph) -> Self {
        use Node::*;
        let mut cost = Cost::default();
        for node in graph.nodes() {
            *match node {
                Const(_) | Input(_) | Bool(_) | Graft { .. } => continue,
                Add(..) | Sub(..) | Canonical(_) => &mut cost.additions,
                Mul(..) => &mut cost.multiplications,
                Div(..) => &mut cost.divisions,
                Root(_) => &mut cost.roots,
                Sin(_) | Cos(_) | SinHigh(_) | SinLow(_) | CosHigh(_) | CosLow(_) | Atan2(..)
                | Exp(_) | Ln(_) => &mut cost.elementary,
                Min(..) | Max(..) | Split(..) | Rest(..) | Select(..) => &mut cost.choices,
                Lt(..) | Le(..) | Eq(..) | And(..) | Or(..) | Not(_) => &mut cost.comparisons,
                Neg(_) | Magnitude(_) | Unsigned(_) | Binade(_) | High(_) => &mut cost.bits,
            } += 1;
        }
        cost
    }
}

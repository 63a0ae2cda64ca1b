//! The cost of a program.
use super::graph::{Graph, Node};
use std::fmt;

/// The numbers of operations of a program, by kind.
///
/// ```
/// use geograd::{Program, Sym, Vec2};
/// // The second addition takes the sign off a zero.
/// let norm = Program::trace(|v: Vec2<Sym<f64>>| v.length_squared()).unwrap();
/// assert_eq!(norm.cost().to_string(), "4 operations: 2 additions, 2 multiplications");
/// ```
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
    /// Choices between numbers: selections, minima, maxima, and what their derivatives are.
    pub choices: usize,
    /// Comparisons, and what connects their outcomes.
    pub comparisons: usize,
    /// Signs, magnitudes, powers of two and high halves: operations on bits.
    pub bits: usize,
}

impl Cost {
    /// Returns all operations together.
    #[must_use]
    pub fn total(&self) -> usize {
        self.kinds().iter().map(|kind| kind.1).sum()
    }

    /// Returns every kind with its name in the plural.
    fn kinds(&self) -> [(&'static str, usize); 8] {
        [
            ("additions", self.additions),
            ("multiplications", self.multiplications),
            ("divisions", self.divisions),
            ("roots", self.roots),
            ("elementary functions", self.elementary),
            ("choices", self.choices),
            ("comparisons", self.comparisons),
            ("operations on bits", self.bits),
        ]
    }

    pub(crate) fn of(graph: &Graph) -> Self {
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

/// The sum, and the kinds that there are: `5 operations: 2 additions, 2 multiplications, 1 roots`.
impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} operations", self.total())?;
        let mut between = ": ";
        for (name, count) in self.kinds().into_iter().filter(|kind| kind.1 > 0) {
            write!(f, "{between}{count} {name}")?;
            between = ", ";
        }
        Ok(())
    }
}

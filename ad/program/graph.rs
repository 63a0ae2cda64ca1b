//! The graph of a program: a list of operations on numbers and truths, each written once.
//!
//! A [`Graph`] is a list of [`Node`]s in an order in which every node comes after its operands.
//! Equal nodes are one node. Nodes are made through [`Graph::make`], which simplifies exactly.
pub use crate::scalar::Format;
use rustc_hash::FxBuildHasher;
use std::collections::HashMap;

/// The index of a node in its graph.
pub(crate) type Id = u32;

/// One operation on numbers or truths.
///
/// A node has, bit for bit, the value of the method of [`Scalar`](crate::Scalar) of that name for `f32` or `f64`,
/// except for the signs of zeros.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Node {
    /// A number: the bits of an `f64` that holds it, rounded to the format of the program.
    Const(u64),
    /// The number at this index of the input.
    Input(u32),
    /// `−x`.
    Neg(Id),
    /// `x + 0`, which takes its sign from a zero and is never simplified away.
    Canonical(Id),
    /// `a + b`.
    Add(Id, Id),
    /// `a − b`.
    Sub(Id, Id),
    /// `a b`.
    Mul(Id, Id),
    /// `a / b`.
    Div(Id, Id),
    /// `a` if `a < b`, else `b`; derivatives are shared at a tie.
    Min(Id, Id),
    /// `a` if `a > b`, else `b`; derivatives are shared at a tie.
    Max(Id, Id),
    /// `|x|`, with derivative 0 at 0.
    Magnitude(Id),
    /// `|x|`, with derivative 1 at 0.
    Unsigned(Id),
    /// `√x` for `x > 0`, 0 with derivative 0 for zero and below, NaN for NaN.
    Root(Id),
    /// `sin x`.
    Sin(Id),
    /// `cos x`.
    Cos(Id),
    /// The high half of `sin x`: twelve bits of the significand in `f32`, a constant to derivatives.
    SinHigh(Id),
    /// The low half of `sin x`: the rest beyond its high half.
    SinLow(Id),
    /// The high half of `cos x`, a constant to derivatives.
    CosHigh(Id),
    /// The low half of `cos x`: the rest beyond its high half.
    CosLow(Id),
    /// The angle of the vector with ordinate `.0` and abscissa `.1`; of the zero vector 0, with
    /// derivative 0.
    Atan2(Id, Id),
    /// `eˣ`.
    Exp(Id),
    /// `ln x`.
    Ln(Id),
    /// The power of two that brings `x > 0` into `[2, 4)`, a constant to derivatives.
    Binade(Id),
    /// The high half of the significand, a constant to derivatives.
    High(Id),
    /// The value of `value` with the derivatives of `derivative`, multiplied by `share`.
    /// [`primal`](crate::Scalar::primal), [`with_primal`](crate::Scalar::with_primal),
    /// [`damp`](crate::Scalar::damp) and adjoints by hand make it. A
    /// [lowered](Graph::lowered) graph has none.
    Graft {
        /// The node of the value.
        value: Id,
        /// The node of the derivatives; without it, there are none.
        derivative: Option<Id>,
        /// The factor of the derivatives; without it, 1. Its own derivatives count for second
        /// derivatives.
        share: Option<Id>,
    },
    /// `Split(a, b, bar)`: `bar` if `a < b`, `bar / 2` if `a = b`, else 0. It is the share of `a` in the
    /// cotangent of [`Min(a, b)`](Node::Min).
    Split(Id, Id, Id),
    /// `Rest(a, b, bar)`: 0 if `a < b`, `bar / 2` if `a = b`, else `bar`. It is the share of `b` in the
    /// cotangent of [`Min(a, b)`](Node::Min). (That is not `Split(b, a, bar)` where one is NaN.)
    Rest(Id, Id, Id),
    /// A truth.
    Bool(bool),
    /// `a < b`.
    Lt(Id, Id),
    /// `a ≤ b`.
    Le(Id, Id),
    /// `a = b`.
    Eq(Id, Id),
    /// Both truths.
    And(Id, Id),
    /// Either truth.
    Or(Id, Id),
    /// The other truth.
    Not(Id),
    /// `Select(mask, yes, no)`: `yes` where the mask is true, else `no`.
    Select(Id, Id, Id),
}

/// The operands of a node, at most three.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Operands {
    ids: [Id; 3],
    len: usize,
}

impl std::ops::Deref for Operands {
    type Target = [Id];
    fn deref(&self) -> &[Id] {
        &self.ids[..self.len]
    }
}

impl Node {
    /// Returns the node with its operands replaced, first operand first.
    pub(crate) fn renamed(self, mut name: impl FnMut(Id) -> Id) -> Node {
        use Node::*;
        let mut r = |x| name(x);
        match self {
            Const(_) | Input(_) | Bool(_) => self,
            Neg(x) => Neg(r(x)),
            Canonical(x) => Canonical(r(x)),
            Magnitude(x) => Magnitude(r(x)),
            Unsigned(x) => Unsigned(r(x)),
            Root(x) => Root(r(x)),
            Sin(x) => Sin(r(x)),
            Cos(x) => Cos(r(x)),
            SinHigh(x) => SinHigh(r(x)),
            SinLow(x) => SinLow(r(x)),
            CosHigh(x) => CosHigh(r(x)),
            CosLow(x) => CosLow(r(x)),
            Exp(x) => Exp(r(x)),
            Ln(x) => Ln(r(x)),
            Binade(x) => Binade(r(x)),
            High(x) => High(r(x)),
            Not(x) => Not(r(x)),
            Add(a, b) => Add(r(a), r(b)),
            Sub(a, b) => Sub(r(a), r(b)),
            Mul(a, b) => Mul(r(a), r(b)),
            Div(a, b) => Div(r(a), r(b)),
            Min(a, b) => Min(r(a), r(b)),
            Max(a, b) => Max(r(a), r(b)),
            Atan2(a, b) => Atan2(r(a), r(b)),
            Lt(a, b) => Lt(r(a), r(b)),
            Le(a, b) => Le(r(a), r(b)),
            Eq(a, b) => Eq(r(a), r(b)),
            And(a, b) => And(r(a), r(b)),
            Or(a, b) => Or(r(a), r(b)),
            Split(a, b, bar) => Split(r(a), r(b), r(bar)),
            Rest(a, b, bar) => Rest(r(a), r(b), r(bar)),
            Select(mask, yes, no) => Select(r(mask), r(yes), r(no)),
            Graft {
                value,
                derivative,
                share,
            } => Graft {
                value: r(value),
                derivative: derivative.map(&mut r),
                share: share.map(&mut r),
            },
        }
    }

    /// Returns the operands of the node.
    pub(crate) fn operands(self) -> Operands {
        let mut found = Operands::default();
        self.renamed(|x| {
            found.ids[found.len] = x;
            found.len += 1;
            x
        });
        found
    }

    /// Returns `true` if the node is a truth, not a number.
    pub(crate) fn is_mask(self) -> bool {
        use Node::*;
        matches!(
            self,
            Bool(_) | Lt(..) | Le(..) | Eq(..) | And(..) | Or(..) | Not(_)
        )
    }
}

/// The number of operations that [`Graph::is_number`] follows back.
const DEPTH: usize = 6;

/// The knowledge of a number's size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Size {
    /// Nothing.
    Any,
    /// It is no NaN.
    Number,
    /// It is neither infinite nor NaN.
    Finite,
}

/// A list of nodes, each after its operands, each written once.
#[derive(Clone, Debug)]
pub(crate) struct Graph {
    /// The format of the numbers.
    pub(crate) format: Format,
    /// `true` if infinite and NaN results of operations on constants become constants, too: where a
    /// function is run on plain numbers.
    pub(crate) plain: bool,
    /// The operations, in an order in which they can be carried out.
    nodes: Vec<Node>,
    known: HashMap<Node, Id, FxBuildHasher>,
}

impl Graph {
    /// Returns a graph without nodes.
    pub(crate) fn new(format: Format) -> Self {
        Graph {
            format,
            plain: false,
            nodes: Vec::new(),
            known: HashMap::default(),
        }
    }

    /// Returns the operations, each after its operands.
    pub(crate) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Returns the number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the node at an index.
    pub(crate) fn at(&self, x: Id) -> Node {
        self.nodes[x as usize]
    }

    /// Returns the index of a node as it is, without simplification: that of an equal node if there is one.
    pub(crate) fn push(&mut self, node: Node) -> Id {
        let next = self.nodes.len() as Id;
        let id = *self.known.entry(node).or_insert(next);
        if id == next {
            self.nodes.push(node);
        }
        id
    }

    /// Returns a number, rounded to the format.
    pub(crate) fn lit(&mut self, x: f64) -> Id {
        let rounded = self.format.round(x);
        self.push(Node::Const(rounded.to_bits()))
    }

    /// Returns the number, if the node is one.
    pub(crate) fn constant(&self, x: Id) -> Option<f64> {
        match self.at(x) {
            Node::Const(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// Returns the truth, if the node is a known one.
    pub(crate) fn truth(&self, x: Id) -> Option<bool> {
        match self.at(x) {
            Node::Bool(truth) => Some(truth),
            _ => None,
        }
    }

    /// Returns `true` if the number is known to be no NaN: inputs are finite, as columns are checked.
    pub(crate) fn is_number(&self, x: Id) -> bool {
        self.known_size(x, DEPTH) >= Size::Number
    }

    /// Returns bounds of a number's size, from up to `depth` operations before it.
    fn known_size(&self, x: Id, depth: usize) -> Size {
        use Node::*;
        let Some(depth) = depth.checked_sub(1) else {
            return Size::Any;
        };
        let of = |x: Id| self.known_size(x, depth);
        // One overflow is infinite; a second one may be the difference of infinite numbers.
        let once = |size: Size| match size {
            Size::Finite => Size::Number,
            Size::Number | Size::Any => Size::Any,
        };
        let constant = |x: Id| self.constant(x).filter(|x| x.is_finite() && *x != 0.0);
        match self.at(x) {
            Input(_) => Size::Finite,
            Const(bits) if f64::from_bits(bits).is_finite() => Size::Finite,
            Neg(x) | Canonical(x) | Magnitude(x) | Unsigned(x) | Root(x) => of(x),
            Graft { value, .. } => of(value),
            Min(a, b) | Max(a, b) | Select(_, a, b) => of(a).min(of(b)),
            Add(a, b) | Sub(a, b) => once(of(a).min(of(b))),
            // A product with a constant is infinite at most.
            Mul(a, b) if constant(a).is_some() => of(b).min(Size::Number),
            Mul(a, b) | Div(a, b) if constant(b).is_some() => of(a).min(Size::Number),
            Mul(a, b) => once(of(a).min(of(b))),
            Sin(x) | Cos(x) | SinHigh(x) | SinLow(x) | CosHigh(x) | CosLow(x)
                if of(x) == Size::Finite =>
            {
                Size::Finite
            }
            Exp(x) => of(x).min(Size::Number),
            Atan2(y, x) if of(y).min(of(x)) == Size::Finite => Size::Finite,
            _ => Size::Any,
        }
    }

    /// Returns the nodes that the outputs need, for derivatives (grafts included) or for values only.
    pub(crate) fn live(&self, outputs: &[Id], with_derivatives: bool) -> Vec<bool> {
        let mut live = vec![false; self.nodes.len()];
        let mut open = outputs.to_vec();
        while let Some(x) = open.pop() {
            if std::mem::replace(&mut live[x as usize], true) {
                continue;
            }
            match self.at(x) {
                Node::Graft { value, .. } if !with_derivatives => open.push(value),
                node => open.extend_from_slice(&node.operands()),
            }
        }
        live
    }

    /// Returns the graph of the values alone, and its outputs: without grafts and dead code, simplified
    /// once more, [`Node::Unsigned`] and [`Node::Magnitude`] one operation (the latter), in
    /// depth-first order from the first output, which keeps few numbers alive at a time.
    pub(crate) fn lowered(&self, outputs: &[Id]) -> (Graph, Vec<Id>) {
        let live = self.live(outputs, false);
        let mut graph = Graph::new(self.format);
        let mut names = vec![0; self.nodes.len()];
        let mut vanish = vec![false; self.nodes.len()];
        for (i, &node) in self.nodes.iter().enumerate().filter(|(i, _)| live[*i]) {
            vanish[i] = self.vanishes(node, &vanish);
            names[i] = match node.renamed(|x| names[x as usize]) {
                _ if vanish[i] => graph.lit(0.0),
                Node::Graft { value, .. } => value,
                Node::Unsigned(x) => graph.make(Node::Magnitude(x)),
                node => graph.make(node),
            };
        }
        let outputs: Vec<Id> = outputs.iter().map(|&x| names[x as usize]).collect();
        graph.depth_first(&outputs)
    }

    /// Returns `true` if a function set the value to zero and kept the derivatives
    /// ([`with_primal`](crate::Scalar::with_primal)). Its products are then zero, too.
    fn vanishes(&self, node: Node, vanish: &[bool]) -> bool {
        use Node::*;
        let zero = |x: Id| vanish[x as usize];
        let none = |x: Id| zero(x) || self.constant(x) == Some(0.0);
        match node {
            Graft {
                value,
                derivative: Some(_),
                ..
            } => none(value),
            Neg(x) | Div(x, _) | Canonical(x) => zero(x),
            Mul(x, y) => zero(x) || zero(y),
            Add(x, y) | Sub(x, y) | Select(_, x, y) => none(x) && none(y) && (zero(x) || zero(y)),
            _ => false,
        }
    }

    /// Returns the live nodes, ordered depth-first from the first output.
    fn depth_first(&self, outputs: &[Id]) -> (Graph, Vec<Id>) {
        let mut graph = Graph::new(self.format);
        let mut names = vec![None; self.nodes.len()];
        // A node is visited twice: first its operands are pushed, then, once they are written, the node is.
        let mut open: Vec<(Id, bool)> = outputs.iter().rev().map(|&x| (x, false)).collect();
        while let Some((x, ready)) = open.pop() {
            if names[x as usize].is_some() {
                continue;
            }
            let node = self.at(x);
            if ready {
                let node = node.renamed(|y| names[y as usize].unwrap_or(y));
                names[x as usize] = Some(graph.push(node));
            } else {
                open.push((x, true));
                open.extend(node.operands().iter().rev().map(|&y| (y, false)));
            }
        }
        let outputs = outputs.iter().filter_map(|&x| names[x as usize]).collect();
        (graph, outputs)
    }
}

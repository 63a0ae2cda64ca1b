//! Which nodes an instruction computes: a node with those of its operands that nobody else needs.
use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::program::instructions::Op;

/// What an instruction costs beside its operands, in units of an operand.
const CHOICE: u32 = 3;

/// An instruction on nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) op: Op,
    from: [Id; 4],
    count: usize,
    /// Nodes that it computes besides its own.
    inner: [Option<Id>; 2],
}

impl Step {
    fn new(op: Op, operands: &[Id], inner: [Option<Id>; 2]) -> Self {
        let mut from = [0; 4];
        from[..operands.len()].copy_from_slice(operands);
        Step {
            op,
            from,
            count: operands.len(),
            inner,
        }
    }
    /// The operands.
    pub(crate) fn operands(&self) -> &[Id] {
        &self.from[..self.count]
    }
}

/// The instruction of a node alone; `None` for what is no instruction, and for sines.
fn alone(node: Node) -> Option<Step> {
    use Node as N;
    let op = match node {
        N::Const(_) | N::Input(_) => return None,
        N::Bool(true) => Op::Always,
        N::Bool(false) => Op::Never,
        N::Sin(_) | N::Cos(_) => return None,
        N::SinHigh(_) | N::SinLow(_) | N::CosHigh(_) | N::CosLow(_) => return None,
        N::Graft { value, .. } => return Some(Step::new(Op::Copy, &[value], [None; 2])),
        N::Neg(_) => Op::Neg,
        N::Canonical(_) => Op::Canonical,
        N::Add(..) => Op::Add,
        N::Sub(..) => Op::Sub,
        N::Mul(..) => Op::Mul,
        N::Div(..) => Op::Div,
        N::Min(..) => Op::Min,
        N::Max(..) => Op::Max,
        N::Magnitude(_) | N::Unsigned(_) => Op::Magnitude,
        N::Root(_) => Op::Root,
        N::Atan2(..) => Op::Atan2,
        N::Exp(_) => Op::Exp,
        N::Ln(_) => Op::Ln,
        N::Binade(_) => Op::Binade,
        N::High(_) => Op::High,
        N::Split(..) => Op::Split,
        N::Rest(..) => Op::Rest,
        N::Lt(..) => Op::Lt,
        N::Le(..) => Op::Le,
        N::Eq(..) => Op::Eq,
        N::And(..) => Op::And,
        N::Or(..) => Op::Or,
        N::Not(_) => Op::Not,
        N::Select(..) => Op::Select,
    };
    Some(Step::new(op, &node.operands(), [None; 2]))
}

/// Every instruction that can compute a node. `of` gives an operand's node if nobody else needs it.
fn candidates(node: Node, of: impl Fn(Id) -> Option<Node>, found: &mut Vec<Step>) {
    use Node as N;
    found.extend(alone(node));
    let mut add = |op: Op, operands: &[Id], inner: &[Id]| {
        let inner = [inner.first().copied(), inner.get(1).copied()];
        found.push(Step::new(op, operands, inner));
    };
    match node {
        N::Add(a, b) => {
            if let (Some(N::Mul(x, y)), Some(N::Mul(z, w)), true) = (of(a), of(b), a != b) {
                add(Op::Dot, &[x, y, z, w], &[a, b]);
            }
            for (x, z) in [(a, b), (b, a)] {
                match of(x) {
                    Some(N::Mul(p, q)) => add(Op::MulAdd, &[p, q, z], &[x]),
                    Some(N::Add(p, q)) => add(Op::AddAdd, &[p, q, z], &[x]),
                    Some(N::Sub(p, q)) => add(Op::SubAdd, &[p, q, z], &[x]),
                    Some(N::Select(m, p, q)) => add(Op::SelectAdd, &[m, p, q, z], &[x]),
                    _ => {}
                }
            }
        }
        N::Sub(a, b) => {
            if let (Some(N::Mul(x, y)), Some(N::Mul(z, w)), true) = (of(a), of(b), a != b) {
                add(Op::Cross, &[x, y, z, w], &[a, b]);
            }
            match of(a) {
                Some(N::Mul(p, q)) => add(Op::MulSub, &[p, q, b], &[a]),
                Some(N::Add(p, q)) => add(Op::AddSub, &[p, q, b], &[a]),
                Some(N::Sub(p, q)) => add(Op::SubSub, &[p, q, b], &[a]),
                _ => {}
            }
            match of(b) {
                Some(N::Mul(p, q)) => add(Op::FromMul, &[p, q, a], &[b]),
                Some(N::Add(p, q)) => add(Op::FromAdd, &[p, q, a], &[b]),
                Some(N::Sub(p, q)) => add(Op::FromSub, &[p, q, a], &[b]),
                _ => {}
            }
        }
        N::Mul(a, b) => {
            for (x, z) in [(a, b), (b, a)] {
                match of(x) {
                    Some(N::Mul(p, q)) => add(Op::MulMul, &[p, q, z], &[x]),
                    Some(N::Add(p, q)) => add(Op::AddMul, &[p, q, z], &[x]),
                    Some(N::Sub(p, q)) => add(Op::SubMul, &[p, q, z], &[x]),
                    _ => {}
                }
            }
        }
        N::Min(a, b) => {
            if let Some(N::Max(p, q)) = of(a) {
                add(Op::MaxMin, &[p, q, b], &[a]);
            }
            if let Some(N::Max(p, q)) = of(b) {
                add(Op::MinFrom, &[p, q, a], &[b]);
            }
        }
        N::Max(a, b) => {
            if let Some(N::Min(p, q)) = of(a) {
                add(Op::MinMax, &[p, q, b], &[a]);
            }
            if let Some(N::Min(p, q)) = of(b) {
                add(Op::MaxFrom, &[p, q, a], &[b]);
            }
            if let Some(N::Magnitude(x) | N::Unsigned(x)) = of(a) {
                add(Op::MagnitudeMax, &[x, b], &[a]);
            }
            if let Some(N::Magnitude(x) | N::Unsigned(x)) = of(b) {
                add(Op::MaxMagnitude, &[a, x], &[b]);
            }
        }
        N::Select(m, x, y) => {
            if let Some(N::Neg(p)) = of(x) {
                add(Op::SelectNeg, &[m, p, y], &[x]);
            }
            if let Some(N::Mul(p, q)) = of(x) {
                add(Op::SelectMul, &[m, p, q, y], &[x]);
            }
            if let Some(N::Mul(p, q)) = of(y) {
                add(Op::ElseMul, &[m, x, p, q], &[y]);
            }
            match of(m) {
                Some(N::Lt(p, q)) => add(Op::SelectLt, &[p, q, x, y], &[m]),
                Some(N::Le(p, q)) => add(Op::SelectLe, &[p, q, x, y], &[m]),
                Some(N::Eq(p, q)) => add(Op::SelectEq, &[p, q, x, y], &[m]),
                _ => {}
            }
        }
        N::And(a, b) | N::Or(a, b) => {
            let and = matches!(node, N::And(..));
            for (x, m) in [(a, b), (b, a)] {
                if let (Some(N::Not(n)), true) = (of(x), and) {
                    add(Op::AndNot, &[m, n], &[x]);
                }
                let (op, p, q) = match (of(x), and) {
                    (Some(N::Lt(p, q)), true) => (Op::LtAnd, p, q),
                    (Some(N::Le(p, q)), true) => (Op::LeAnd, p, q),
                    (Some(N::Eq(p, q)), true) => (Op::EqAnd, p, q),
                    (Some(N::Lt(p, q)), false) => (Op::LtOr, p, q),
                    (Some(N::Le(p, q)), false) => (Op::LeOr, p, q),
                    (Some(N::Eq(p, q)), false) => (Op::EqOr, p, q),
                    _ => continue,
                };
                add(op, &[p, q, m], &[x]);
            }
        }
        _ => {}
    }
}

/// The angle, and whether it is its parts that are asked for, and which result.
pub(crate) fn sine_of(node: Node) -> Option<(Id, bool, usize)> {
    match node {
        Node::SinHigh(x) => Some((x, true, 0)),
        Node::SinLow(x) => Some((x, true, 1)),
        Node::CosHigh(x) => Some((x, true, 2)),
        Node::CosLow(x) => Some((x, true, 3)),
        Node::Sin(x) => Some((x, false, 0)),
        Node::Cos(x) => Some((x, false, 1)),
        _ => None,
    }
}

/// How often each node is needed, by live nodes and by `needed`.
pub(crate) fn uses(graph: &Graph, live: &[bool], needed: &[Id]) -> Vec<u32> {
    let mut uses = vec![0; graph.len()];
    for (_, node) in graph.nodes().iter().enumerate().filter(|(i, _)| live[*i]) {
        for &x in node.operands().iter() {
            uses[x as usize] += 1;
        }
    }
    for &x in needed {
        uses[x as usize] += 1;
    }
    uses
}

/// The instruction of every node that is not inside another one's: the cheapest cover of each tree of
/// nodes that are needed once. Numbers, inputs and sines have none.
pub(crate) fn cover(graph: &Graph, uses: &[u32]) -> Vec<Option<Step>> {
    let mut steps: Vec<Option<Step>> = vec![None; graph.len()];
    let mut costs = vec![0; graph.len()];
    let mut found = Vec::new();
    for (i, &node) in graph.nodes().iter().enumerate() {
        found.clear();
        let of = |x: Id| (uses[x as usize] == 1).then(|| graph.at(x));
        candidates(node, of, &mut found);
        // What is needed elsewhere, too, has been paid for.
        let own = |&x: &Id| {
            if uses[x as usize] == 1 {
                costs[x as usize]
            } else {
                0
            }
        };
        let cost = |step: &Step| {
            let below: u32 = step.operands().iter().map(own).sum();
            CHOICE + step.count as u32 + below
        };
        steps[i] = found.iter().copied().min_by_key(cost);
        costs[i] = steps[i].as_ref().map_or(0, cost);
    }
    for i in (0..steps.len()).rev() {
        for x in steps[i]
            .iter()
            .flat_map(|step| step.inner)
            .flatten()
            .collect::<Vec<_>>()
        {
            steps[x as usize] = None;
        }
    }
    steps
}

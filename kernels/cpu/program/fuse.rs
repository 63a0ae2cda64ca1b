//! The cover of a graph by instructions: each computes a node, together with operands that no other node needs.
use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::program::instructions::Op;
use std::collections::HashMap;

/// The cost of choosing an instruction, in units of one operand.
const CHOICE: u32 = 3;

/// An instruction on nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) op: Op,
    from: [Id; 4],
    count: usize,
    /// The nodes that it computes besides its own.
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
    /// Returns the operands.
    pub(crate) fn operands(&self) -> &[Id] {
        &self.from[..self.count]
    }
}

/// Returns the instruction of a single node; `None` for a node that is no instruction, and for sines.
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

/// Returns every instruction that can compute a node. `of` gives an operand's node if no other node needs it.
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
            if let (Some(N::Sub(x, y)), Some(N::Sub(z, w)), true) = (of(a), of(b), a != b) {
                add(Op::SubAndSub, &[x, y, z, w], &[a, b]);
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
                    Some(N::Sub(p, q)) => {
                        add(Op::SubMul, &[p, q, z], &[x]);
                        if let Some(N::Add(r, s)) = of(z) {
                            add(Op::SubByAdd, &[p, q, r, s], &[x, z]);
                        }
                    }
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
            match of(b) {
                Some(N::Min(p, q)) => {
                    add(Op::MaxFrom, &[p, q, a], &[b]);
                    match of(q) {
                        Some(N::Mul(r, s)) => add(Op::MaxFromMul, &[r, s, p, a], &[b, q]),
                        Some(N::Neg(r)) => add(Op::MaxFromNeg, &[r, p, a], &[b, q]),
                        _ => {}
                    }
                }
                Some(N::Add(p, q)) => {
                    for (product, rest) in [(p, q), (q, p)] {
                        if let Some(N::Mul(r, s)) = of(product) {
                            add(Op::MaxMulAdd, &[r, s, rest, a], &[b, product]);
                        }
                    }
                }
                _ => {}
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
            if let (Some(N::Lt(p, q)), Some(N::Neg(r))) = (of(m), of(x)) {
                add(Op::SelectNegLt, &[p, q, r, y], &[m, x]);
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

/// Nodes that one instruction computes together, from common operands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    pub(crate) op: Op,
    from: [Id; 4],
    count: usize,
    results: [Option<Id>; 4],
    made: usize,
}

impl Group {
    /// Returns the operands.
    pub(crate) fn operands(&self) -> &[Id] {
        &self.from[..self.count]
    }
    /// Returns the nodes, in the order of the instruction's results; `None` for a result that is not needed.
    pub(crate) fn results(&self) -> &[Option<Id>] {
        &self.results[..self.made]
    }
}

/// Returns groups by node: all sines and cosines of an angle, and pairs of instructions on common operands. `apart` has
/// to agree on both nodes of a pair.
pub(crate) fn groups(
    graph: &Graph,
    live: &[bool],
    steps: &[Option<Step>],
    apart: impl Fn(Id) -> bool,
) -> HashMap<Id, Group> {
    let live = || (0..graph.len() as Id).filter(|&x| live[x as usize]);
    let mut groups = HashMap::new();
    let mut sines: HashMap<(Id, bool), Group> = HashMap::new();
    for x in live() {
        let Some((angle, parts, k)) = sine_of(graph.at(x)) else {
            continue;
        };
        let group = sines.entry((angle, parts)).or_insert(Group {
            op: if parts { Op::Parts } else { Op::SinCos },
            from: [angle, 0, 0, 0],
            count: 1,
            results: [None; 4],
            made: if parts { 4 } else { 2 },
        });
        group.results[k] = Some(x);
    }
    for group in sines.into_values() {
        let nodes = group.results.into_iter().flatten();
        groups.extend(nodes.map(|x| (x, group)));
    }
    let steps = || live().filter_map(|x| Some((x, steps[x as usize].as_ref()?)));
    // Sums by their operands in any order.
    let mut sums: HashMap<[Id; 4], (Id, &Step)> = HashMap::new();
    for (x, step) in steps().filter(|(_, step)| matches!(step.op, Op::Add | Op::Dot)) {
        sums.entry(sorted(step)).or_insert((x, step));
    }
    for (x, step) in steps() {
        let Some(&(sum, of)) = sums.get(&sorted(step)) else {
            continue;
        };
        let found = match (step.op, of.op) {
            (Op::Sub, Op::Add) => Some((Op::SumSub, step.from)),
            (Op::Cross, Op::Dot) => turn(step.from, of.from).map(|from| (Op::Turn, from)),
            _ => None,
        };
        let Some((op, from)) = found else { continue };
        if apart(x) == apart(sum) && !groups.contains_key(&sum) {
            let group = Group {
                op,
                from,
                count: step.count,
                results: [Some(sum), Some(x), None, None],
                made: 2,
            };
            groups.extend([(sum, group), (x, group)]);
        }
    }
    groups
}

/// Returns the operands of [`Op::Turn`], whose results are a difference of two products and the sum of two others.
fn turn([a, b, c, d]: [Id; 4], [p, q, r, s]: [Id; 4]) -> Option<[Id; 4]> {
    let are = |x: [Id; 2], [y, z]: [Id; 2]| x == [y, z] || x == [z, y];
    let both = |x, y| are([p, q], x) && are([r, s], y) || are([p, q], y) && are([r, s], x);
    if both([b, c], [a, d]) {
        Some([c, a, b, d])
    } else if both([a, c], [b, d]) {
        Some([d, a, b, c])
    } else {
        None
    }
}

/// Returns the operands of an instruction, sorted.
fn sorted(step: &Step) -> [Id; 4] {
    // Unused operands come last.
    let mut from = [Id::MAX; 4];
    from[..step.count].copy_from_slice(step.operands());
    from.sort_unstable();
    from
}

/// Returns the angle of a sine or cosine, whether the node wants it in two parts, and the index of the result.
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

/// Returns the number of uses of each node, by live nodes and by `needed`.
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

/// Returns the instruction of every node that is not inside another instruction: the cheapest cover of each tree of
/// nodes with one use. Constants, inputs and sines have none.
pub(crate) fn cover(graph: &Graph, uses: &[u32]) -> Vec<Option<Step>> {
    let mut steps: Vec<Option<Step>> = vec![None; graph.len()];
    let mut costs = vec![0; graph.len()];
    let mut found = Vec::new();
    for (i, &node) in graph.nodes().iter().enumerate() {
        found.clear();
        let of = |x: Id| (uses[x as usize] == 1).then(|| graph.at(x));
        candidates(node, of, &mut found);
        // A node with other uses costs nothing here: it is computed anyway.
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

//! The cover of a graph by instructions: each computes a node, together with operands that no other node needs.
use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::program::instructions::Opcode;
use std::collections::HashMap;

/// The cost of choosing an instruction, in units of one operand.
const CHOICE: u32 = 3;

/// An instruction on nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeInstruction {
    pub(crate) op: Opcode,
    from: [Id; 4],
    count: usize,
    /// The nodes that it computes besides its own.
    inner: [Option<Id>; 2],
}

impl NodeInstruction {
    fn new(op: Opcode, operands: &[Id], inner: [Option<Id>; 2]) -> Self {
        let mut from = [0; 4];
        from[..operands.len()].copy_from_slice(operands);
        NodeInstruction {
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
fn alone(node: Node) -> Option<NodeInstruction> {
    use Node as N;
    let op = match node {
        N::Const(_) | N::Input(_) => return None,
        N::Bool(true) => Opcode::Always,
        N::Bool(false) => Opcode::Never,
        N::Sin(_) | N::Cos(_) => return None,
        N::SinHigh(_) | N::SinLow(_) | N::CosHigh(_) | N::CosLow(_) => return None,
        N::Graft { value, .. } => {
            return Some(NodeInstruction::new(Opcode::Copy, &[value], [None; 2]));
        }
        N::Neg(_) => Opcode::Neg,
        N::Canonical(_) => Opcode::Canonical,
        N::Add(..) => Opcode::Add,
        N::Sub(..) => Opcode::Sub,
        N::Mul(..) => Opcode::Mul,
        N::Div(..) => Opcode::Div,
        N::Min(..) => Opcode::Min,
        N::Max(..) => Opcode::Max,
        N::Magnitude(_) | N::Unsigned(_) => Opcode::Magnitude,
        N::Root(_) => Opcode::Root,
        N::Atan2(..) => Opcode::Atan2,
        N::Exp(_) => Opcode::Exp,
        N::Ln(_) => Opcode::Ln,
        N::Binade(_) => Opcode::Binade,
        N::High(_) => Opcode::High,
        N::Split(..) => Opcode::Split,
        N::Rest(..) => Opcode::Rest,
        N::Lt(..) => Opcode::Lt,
        N::Le(..) => Opcode::Le,
        N::Eq(..) => Opcode::Eq,
        N::And(..) => Opcode::And,
        N::Or(..) => Opcode::Or,
        N::Not(_) => Opcode::Not,
        N::Select(..) => Opcode::Select,
    };
    Some(NodeInstruction::new(op, &node.operands(), [None; 2]))
}

/// Returns every instruction that can compute a node. `of` gives an operand's node if no other node needs it.
fn candidates(node: Node, of: impl Fn(Id) -> Option<Node>, found: &mut Vec<NodeInstruction>) {
    use Node as N;
    found.extend(alone(node));
    let mut add = |op: Opcode, operands: &[Id], inner: &[Id]| {
        let inner = [inner.first().copied(), inner.get(1).copied()];
        found.push(NodeInstruction::new(op, operands, inner));
    };
    match node {
        N::Add(a, b) => {
            if let (Some(N::Mul(x, y)), Some(N::Mul(z, w)), true) = (of(a), of(b), a != b) {
                add(Opcode::Dot, &[x, y, z, w], &[a, b]);
            }
            if let (Some(N::Sub(x, y)), Some(N::Sub(z, w)), true) = (of(a), of(b), a != b) {
                add(Opcode::SubAndSub, &[x, y, z, w], &[a, b]);
            }
            for (x, z) in [(a, b), (b, a)] {
                match of(x) {
                    Some(N::Mul(p, q)) => add(Opcode::MulAdd, &[p, q, z], &[x]),
                    Some(N::Add(p, q)) => add(Opcode::AddAdd, &[p, q, z], &[x]),
                    Some(N::Sub(p, q)) => add(Opcode::SubAdd, &[p, q, z], &[x]),
                    Some(N::Select(m, p, q)) => add(Opcode::SelectAdd, &[m, p, q, z], &[x]),
                    _ => {}
                }
            }
        }
        N::Sub(a, b) => {
            if let (Some(N::Mul(x, y)), Some(N::Mul(z, w)), true) = (of(a), of(b), a != b) {
                add(Opcode::Cross, &[x, y, z, w], &[a, b]);
            }
            match of(a) {
                Some(N::Mul(p, q)) => add(Opcode::MulSub, &[p, q, b], &[a]),
                Some(N::Add(p, q)) => add(Opcode::AddSub, &[p, q, b], &[a]),
                Some(N::Sub(p, q)) => add(Opcode::SubSub, &[p, q, b], &[a]),
                _ => {}
            }
            match of(b) {
                Some(N::Mul(p, q)) => add(Opcode::FromMul, &[p, q, a], &[b]),
                Some(N::Add(p, q)) => add(Opcode::FromAdd, &[p, q, a], &[b]),
                Some(N::Sub(p, q)) => add(Opcode::FromSub, &[p, q, a], &[b]),
                _ => {}
            }
        }
        N::Mul(a, b) => {
            for (x, z) in [(a, b), (b, a)] {
                match of(x) {
                    Some(N::Mul(p, q)) => add(Opcode::MulMul, &[p, q, z], &[x]),
                    Some(N::Add(p, q)) => add(Opcode::AddMul, &[p, q, z], &[x]),
                    Some(N::Sub(p, q)) => {
                        add(Opcode::SubMul, &[p, q, z], &[x]);
                        if let Some(N::Add(r, s)) = of(z) {
                            add(Opcode::SubByAdd, &[p, q, r, s], &[x, z]);
                        }
                    }
                    _ => {}
                }
            }
        }
        N::Min(a, b) => {
            if let Some(N::Max(p, q)) = of(a) {
                add(Opcode::MaxMin, &[p, q, b], &[a]);
            }
            if let Some(N::Max(p, q)) = of(b) {
                add(Opcode::MinFrom, &[p, q, a], &[b]);
            }
        }
        N::Max(a, b) => {
            if let Some(N::Min(p, q)) = of(a) {
                add(Opcode::MinMax, &[p, q, b], &[a]);
            }
            match of(b) {
                Some(N::Min(p, q)) => {
                    add(Opcode::MaxFrom, &[p, q, a], &[b]);
                    match of(q) {
                        Some(N::Mul(r, s)) => add(Opcode::MaxFromMul, &[r, s, p, a], &[b, q]),
                        Some(N::Neg(r)) => add(Opcode::MaxFromNeg, &[r, p, a], &[b, q]),
                        _ => {}
                    }
                }
                Some(N::Add(p, q)) => {
                    for (product, rest) in [(p, q), (q, p)] {
                        if let Some(N::Mul(r, s)) = of(product) {
                            add(Opcode::MaxMulAdd, &[r, s, rest, a], &[b, product]);
                        }
                    }
                }
                _ => {}
            }
            if let Some(N::Magnitude(x) | N::Unsigned(x)) = of(a) {
                add(Opcode::MagnitudeMax, &[x, b], &[a]);
            }
            if let Some(N::Magnitude(x) | N::Unsigned(x)) = of(b) {
                add(Opcode::MaxMagnitude, &[a, x], &[b]);
            }
        }
        N::Select(m, x, y) => {
            if let Some(N::Neg(p)) = of(x) {
                add(Opcode::SelectNeg, &[m, p, y], &[x]);
            }
            if let Some(N::Mul(p, q)) = of(x) {
                add(Opcode::SelectMul, &[m, p, q, y], &[x]);
            }
            if let Some(N::Mul(p, q)) = of(y) {
                add(Opcode::ElseMul, &[m, x, p, q], &[y]);
            }
            if let (Some(N::Lt(p, q)), Some(N::Neg(r))) = (of(m), of(x)) {
                add(Opcode::SelectNegLt, &[p, q, r, y], &[m, x]);
            }
            match of(m) {
                Some(N::Lt(p, q)) => add(Opcode::SelectLt, &[p, q, x, y], &[m]),
                Some(N::Le(p, q)) => add(Opcode::SelectLe, &[p, q, x, y], &[m]),
                Some(N::Eq(p, q)) => add(Opcode::SelectEq, &[p, q, x, y], &[m]),
                _ => {}
            }
        }
        N::And(a, b) | N::Or(a, b) => {
            let and = matches!(node, N::And(..));
            for (x, m) in [(a, b), (b, a)] {
                if let (Some(N::Not(n)), true) = (of(x), and) {
                    add(Opcode::AndNot, &[m, n], &[x]);
                }
                let (op, p, q) = match (of(x), and) {
                    (Some(N::Lt(p, q)), true) => (Opcode::LtAnd, p, q),
                    (Some(N::Le(p, q)), true) => (Opcode::LeAnd, p, q),
                    (Some(N::Eq(p, q)), true) => (Opcode::EqAnd, p, q),
                    (Some(N::Lt(p, q)), false) => (Opcode::LtOr, p, q),
                    (Some(N::Le(p, q)), false) => (Opcode::LeOr, p, q),
                    (Some(N::Eq(p, q)), false) => (Opcode::EqOr, p, q),
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
pub(crate) struct NodeGroup {
    pub(crate) op: Opcode,
    from: [Id; 4],
    count: usize,
    results: [Option<Id>; 4],
    made: usize,
}

impl NodeGroup {
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
    steps: &[Option<NodeInstruction>],
    region: impl Fn(Id) -> Option<usize>,
) -> HashMap<Id, NodeGroup> {
    let live = || (0..graph.len() as Id).filter(|&x| live[x as usize]);
    let mut groups = HashMap::new();
    let mut sines: HashMap<(Id, bool), NodeGroup> = HashMap::new();
    for x in live() {
        let Some((angle, parts, k)) = sine_of(graph.at(x)) else {
            continue;
        };
        let group = sines.entry((angle, parts)).or_insert(NodeGroup {
            op: if parts { Opcode::Parts } else { Opcode::SinCos },
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
    let mut sums: HashMap<[Id; 4], (Id, &NodeInstruction)> = HashMap::new();
    for (x, step) in steps().filter(|(_, step)| matches!(step.op, Opcode::Add | Opcode::Dot)) {
        sums.entry(sorted(step)).or_insert((x, step));
    }
    for (x, step) in steps() {
        let Some(&(sum, of)) = sums.get(&sorted(step)) else {
            continue;
        };
        let found = match (step.op, of.op) {
            (Opcode::Sub, Opcode::Add) => Some((Opcode::SumSub, step.from)),
            (Opcode::Cross, Opcode::Dot) => {
                turn(step.from, of.from).map(|from| (Opcode::Turn, from))
            }
            _ => None,
        };
        let Some((op, from)) = found else { continue };
        if region(x) == region(sum) && !groups.contains_key(&sum) {
            let group = NodeGroup {
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

/// Returns the operands of [`Opcode::Turn`], whose results are a difference of two products and the sum of two others.
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
fn sorted(step: &NodeInstruction) -> [Id; 4] {
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
pub(crate) fn cover(graph: &Graph, uses: &[u32]) -> Vec<Option<NodeInstruction>> {
    let mut steps: Vec<Option<NodeInstruction>> = vec![None; graph.len()];
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
        let cost = |step: &NodeInstruction| {
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

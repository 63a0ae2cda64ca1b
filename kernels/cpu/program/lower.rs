//! The translation of a graph to a tape: instructions in order, operands and results in slots.
use crate::Unrecordable;
use crate::ad::program::graph::{Graph, Id, Node};
use crate::arrays::sort_few;
use crate::kernels::cpu::program::fuse::{NodeGroup, NodeInstruction, cover, groups, uses};
use crate::kernels::cpu::program::instructions::{Instruction, Opcode};
use crate::kernels::cpu::program::skip;
use crate::kernels::cpu::program::slots::Slots;
use std::collections::HashMap;

/// A program as a list of instructions.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    /// The instructions in order.
    pub(crate) code: Vec<Instruction>,
    /// The number of slots; constants have the last ones.
    pub(crate) slots: usize,
    /// The slots of constants, with their values, which no instruction changes.
    pub(crate) constants: Vec<(u16, f64)>,
    /// The slot of each input; `None` for an unused one.
    pub(crate) inputs: Vec<Option<u16>>,
    /// The slot of each output.
    pub(crate) outputs: Vec<u16>,
}

/// The place of a node: a slot, or a constant.
#[derive(Clone, Copy)]
enum Location {
    Slot(u32),
    Constant(u32),
}

/// The most conditions under which a block skips nodes.
const REGIONS: usize = 3;

/// The number of nodes from which on a condition of aligned items is worth it, if it makes an eighth superfluous. Between
/// shorter parts numbers would go through memory that stay in registers.
const LONG: usize = 256;

struct Lowering<'a> {
    graph: &'a Graph,
    steps: Vec<Option<NodeInstruction>>,
    /// The group of each node that is computed together with others.
    groups: HashMap<Id, NodeGroup>,
    /// The number of slots that each node needs for its computation if every node has one use (Sethi and Ullman).
    room: Vec<u32>,
    /// Nodes in the order of their instructions.
    order: Vec<Id>,
    done: Vec<bool>,
}

impl Lowering<'_> {
    /// Returns the nodes that must be computed before a node.
    fn operands(&self, x: Id) -> Vec<Id> {
        match (self.groups.get(&x), &self.steps[x as usize]) {
            (Some(group), _) => group.operands().to_vec(),
            (None, Some(step)) => step.operands().to_vec(),
            (None, None) => Vec::new(),
        }
    }
    /// Returns `true` if a node is the result of an instruction.
    fn is_computed(&self, x: Id) -> bool {
        self.steps[x as usize].is_some() || self.groups.contains_key(&x)
    }
    /// Appends a node after its operands to the order, unless `idle` excludes it.
    fn visit(&mut self, root: Id, idle: &[bool]) {
        let mut open = vec![(root, false)];
        while let Some((x, ready)) = open.pop() {
            if self.done[x as usize] || idle[x as usize] {
                continue;
            }
            if !ready {
                open.push((x, true));
                let mut operands = self.operands(x);
                // The operand that needs most slots comes first, while few others occupy any.
                sort_few(&mut operands, |&x, &y| {
                    self.room[x as usize] < self.room[y as usize]
                });
                open.extend(operands.into_iter().map(|y| (y, false)));
                continue;
            }
            self.done[x as usize] = true;
            // A group is placed at the first of its nodes.
            if let Some(group) = self.groups.get(&x) {
                for &y in group.results().iter().flatten() {
                    self.done[y as usize] = true;
                }
            }
            if self.is_computed(x) {
                self.order.push(x);
            }
        }
    }
}

/// The condition under which a block may skip nodes that none of its items needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Skipping {
    #[default]
    Never,
    /// If three quarters of all nodes can be skipped, an eighth of a long program, or a tenth that few items need. Aligned
    /// items seldom agree in what they need, and the test has a cost.
    Much,
    /// If any node can be skipped, by further conditions an eighth of all.
    Any,
}

impl Tape {
    /// Lowers a graph without grafts. `skipping` says when blocks may skip nodes.
    ///
    /// # Errors
    ///
    /// If the program has more slots than an instruction can name.
    pub(crate) fn new(
        graph: &Graph,
        inputs: usize,
        outputs: &[Id],
        skipping: Skipping,
    ) -> Result<Tape, Unrecordable> {
        let (graph, outputs) = &polished(graph, outputs);
        let live = graph.live(outputs, false);
        let count = |nodes: &[bool]| nodes.iter().filter(|x| **x).count();
        let whole = count(&live);
        // Each truth costs a test of every vector.
        let skips = match skipping {
            Skipping::Never => Vec::new(),
            Skipping::Much => skip::find(graph, &live, outputs, REGIONS, |idle, is_usual, _| {
                4 * idle >= 3 * whole
                    || idle >= LONG && 8 * idle >= whole
                    || is_usual && 10 * idle >= whole
            }),
            Skipping::Any => skip::find(graph, &live, outputs, REGIONS, |idle, _, place| {
                place == 0 || 8 * idle >= whole
            }),
        };
        let mut needed = outputs.to_vec();
        needed.extend(skips.iter().map(|skip| skip.mask));
        let uses = uses(graph, &live, &needed);
        let steps = cover(graph, &uses);
        let region = |x: Id| skips.iter().position(|skip| skip.idle[x as usize]);
        let mut lowering = Lowering {
            graph,
            groups: groups(graph, &live, &steps, region),
            steps,
            room: Vec::new(),
            order: Vec::new(),
            done: vec![false; graph.len()],
        };
        for x in 0..graph.len() as Id {
            let below = lowering.operands(x);
            let mut below: Vec<u32> = below.iter().map(|&y| lowering.room[y as usize]).collect();
            sort_few(&mut below, |a, b| a > b);
            let room = below.iter().zip(0..).map(|(room, held)| room + held).max();
            lowering.room.push(room.unwrap_or(1).max(1));
        }
        let nothing = vec![false; graph.len()];
        // Regions mostly need numbers of earlier ones.
        let first = |skip: &&skip::SkipCondition| skip.idle.iter().position(|&idle| idle);
        let mut ordered: Vec<_> = skips.iter().collect();
        ordered.sort_by_key(first);
        let mut regions = Vec::new();
        for skip in ordered {
            lowering.visit(skip.mask, &nothing);
            let idle = (0..graph.len() as Id).filter(|&x| skip.idle[x as usize]);
            // Nodes inside other instructions are computed with those.
            let idle: Vec<Id> = idle.filter(|&x| lowering.is_computed(x)).collect();
            for &x in &idle {
                for y in lowering.operands(x) {
                    lowering.visit(y, &skip.idle);
                }
            }
            let first = lowering.order.len();
            for &x in &idle {
                lowering.visit(x, &nothing);
            }
            if first < lowering.order.len() {
                regions.push((first, lowering.order.len(), skip));
            }
        }
        for &x in outputs {
            lowering.visit(x, &nothing);
        }
        assign(lowering, inputs, outputs, &regions)
    }
}

/// Assigns slots to nodes in order.
fn assign(
    lowering: Lowering<'_>,
    inputs: usize,
    outputs: &[Id],
    regions: &[(usize, usize, &skip::SkipCondition)],
) -> Result<Tape, Unrecordable> {
    let graph = lowering.graph;
    let mut left = vec![0; graph.len()];
    for &x in &lowering.order {
        for y in lowering.operands(x) {
            left[y as usize] += 1;
        }
    }
    // Outputs are read after all instructions, so their slots are never freed.
    for &x in outputs {
        left[x as usize] += 1;
    }
    for (_, _, skip) in regions {
        left[skip.mask as usize] += 1;
    }
    let mut slots = Slots::new(left.clone());
    let mut places = vec![None; inputs];
    for (x, node) in graph.nodes().iter().enumerate() {
        if let (&Node::Input(k), 1..) = (node, left[x]) {
            places[k as usize] = Some(slots.take(x as Id));
        }
    }
    let mut constants: Vec<f64> = Vec::new();
    let mut place = |slots: &Slots, x: Id| {
        let Some(number) = graph.constant(x) else {
            // Operands precede their nodes, so this default is unused.
            return Location::Slot(slots.at(x).unwrap_or_default());
        };
        let known = constants
            .iter()
            .position(|known| known.to_bits() == number.to_bits());
        Location::Constant(known.unwrap_or_else(|| {
            constants.push(number);
            constants.len() - 1
        }) as u32)
    };
    // One slot serves all unused results.
    let mut waste = None;
    let mut code: Vec<(Opcode, [Location; 4], [Location; 4])> = Vec::new();
    let mut jump: Option<usize> = None;
    let zero = Location::Slot(0);
    for at in 0..=lowering.order.len() {
        for &(first, end, skip) in regions {
            if at == end
                && let Some(jump) = jump.take()
            {
                let count: usize = code.len() - jump - 1;
                code[jump].1[0] = Location::Slot(count as u32);
            }
            if at == first {
                let op = if skip.all {
                    Opcode::SkipIfAll
                } else {
                    Opcode::SkipIfNone
                };
                let mask = place(&slots, skip.mask);
                slots.read(skip.mask);
                jump = Some(code.len());
                code.push((op, [zero; 4], [mask, zero, zero, zero]));
            }
        }
        let Some(&x) = lowering.order.get(at) else {
            break;
        };
        let operands = lowering.operands(x);
        let mut from = [zero; 4];
        for (from, &y) in from.iter_mut().zip(&operands) {
            *from = place(&slots, y);
        }
        for &y in &operands {
            slots.read(y);
        }
        let mut to = [zero; 4];
        let op = match (lowering.groups.get(&x), &lowering.steps[x as usize]) {
            (Some(group), _) => {
                for (to, result) in to.iter_mut().zip(group.results()) {
                    *to = Location::Slot(match result {
                        &Some(y) => slots.take(y),
                        None => *waste.get_or_insert_with(|| slots.any()),
                    });
                }
                group.op
            }
            (None, Some(step)) => {
                to[0] = Location::Slot(slots.take(x));
                step.op
            }
            // The order has no other nodes.
            (None, None) => continue,
        };
        code.push((op, to, from));
    }
    let outputs: Vec<Location> = outputs.iter().map(|&x| place(&slots, x)).collect();
    let count = slots.count;
    let name = |place: Location| {
        u16::try_from(match place {
            Location::Slot(slot) => slot,
            Location::Constant(k) => count + k,
        })
        .map_err(|_| Unrecordable::TooLong)
    };
    let names = |places: [Location; 4]| -> Result<[u16; 4], Unrecordable> {
        let [a, b, c, d] = places;
        Ok([name(a)?, name(b)?, name(c)?, name(d)?])
    };
    let mut tape = Tape {
        code: Vec::with_capacity(code.len()),
        slots: count as usize + constants.len(),
        constants: Vec::new(),
        inputs: Vec::new(),
        outputs: Vec::new(),
    };
    for (op, to, from) in code {
        let (to, from) = (names(to)?, names(from)?);
        tape.code.push(Instruction { op, to, from });
    }
    for (k, &constant) in constants.iter().enumerate() {
        tape.constants
            .push((name(Location::Constant(k as u32))?, constant));
    }
    for slot in places {
        tape.inputs
            .push(slot.map(|slot| name(Location::Slot(slot))).transpose()?);
    }
    for place in outputs {
        tape.outputs.push(name(place)?);
    }
    Ok(tape)
}

/// Returns the graph with selections of the smaller or larger of two numbers, and unsigned numbers, as one node each.
/// Values keep their bits, also of NaN; only derivatives would change.
fn polished(graph: &Graph, outputs: &[Id]) -> (Graph, Vec<Id>) {
    let mut polished = Graph::new(graph.format);
    let mut names: Vec<Id> = Vec::with_capacity(graph.len());
    for &node in graph.nodes() {
        let node = node.renamed(|x| names[x as usize]);
        let lesser = |m: Id, yes: Id, no: Id| match polished.at(m) {
            Node::Lt(a, b) if (a, b) == (yes, no) => Some(Node::Min(yes, no)),
            Node::Lt(a, b) if (b, a) == (yes, no) => Some(Node::Max(yes, no)),
            _ => None,
        };
        let node = match node {
            Node::Select(m, yes, no) => lesser(m, yes, no).unwrap_or(node),
            // Both operations remove the sign.
            Node::Magnitude(x) | Node::Unsigned(x) => Node::Magnitude(match polished.at(x) {
                Node::Neg(negated) => negated,
                _ => x,
            }),
            node => node,
        };
        names.push(polished.push(node));
    }
    let outputs = outputs.iter().map(|&x| names[x as usize]).collect();
    (polished, outputs)
}

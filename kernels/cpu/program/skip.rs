//! The nodes that a block can leave out: those that matter only where a truth does not hold, or only where it
//! does.
//!
//! Boxes that are apart share nothing, whatever the clipping of their sides gives: where all items of a block are
//! apart, nothing needs to be clipped. Such truths are found in the graph. Every choice by the truth (or by one
//! that follows from it) loses the side that is never taken. A node that then reaches no output need not be
//! computed: its slot holds some number that is not chosen.
//!
//! A truth is judged by what it cuts off, not by a walk of the whole graph: uses are counted once, and a node whose
//! uses are all cut off cuts off its operands. All truths together visit a bounded number of nodes per node.
use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::program::fuse::sine_of;
use std::collections::HashMap;

/// With fewer nodes than this the test of the truth costs more than it saves.
const FEW: usize = 12;

/// So many nodes are visited at most, per node of the graph. Scores and distances of boxes, with gradients, visit up to
/// 23.
const VISITS: usize = 256;

/// Something to leave out.
#[derive(Clone, Debug)]
pub(crate) struct Skip {
    /// The truth.
    pub(crate) mask: Id,
    /// `true` if it is to hold for all items, or for none.
    pub(crate) all: bool,
    /// The nodes that do not matter then.
    pub(crate) idle: Vec<bool>,
}

/// A comparison with less than this, or with so small a part of a number, asks for the roundings of a number: few items
/// have it.
const SMALL: f64 = 1.0 / 256.0;

/// How many operations back a truth is looked at.
const DEPTH: usize = 8;

/// Returns `true` if few items have a truth: it asks whether a size is as small as a rounding.
fn is_seldom(graph: &Graph, mask: Id, depth: usize) -> bool {
    let Some(depth) = depth.checked_sub(1) else {
        return false;
    };
    let is_small = |x: Id| graph.constant(x).is_some_and(|x| 0.0 < x && x <= SMALL);
    match graph.at(mask) {
        Node::Lt(a, b) | Node::Le(a, b) => {
            let is_part = match graph.at(b) {
                Node::Mul(x, y) => is_small(x) || is_small(y),
                _ => is_small(b),
            };
            is_part && is_size(graph, a, DEPTH)
        }
        Node::And(a, b) => is_seldom(graph, a, depth) || is_seldom(graph, b, depth),
        Node::Or(a, b) => is_seldom(graph, a, depth) && is_seldom(graph, b, depth),
        _ => false,
    }
}

/// Returns `true` if a number is known not to be negative.
fn is_size(graph: &Graph, x: Id, depth: usize) -> bool {
    let Some(depth) = depth.checked_sub(1) else {
        return false;
    };
    let of = |x: Id| is_size(graph, x, depth);
    match graph.at(x) {
        Node::Magnitude(_) | Node::Unsigned(_) | Node::Root(_) => true,
        Node::Mul(a, b) => a == b || of(a) && of(b),
        Node::Add(a, b) | Node::Min(a, b) | Node::Div(a, b) | Node::Select(_, a, b) => {
            of(a) && of(b)
        }
        Node::Max(a, b) => of(a) || of(b),
        _ => graph.constant(x).is_some_and(|x| x >= 0.0),
    }
}

/// Returns the truth that allows to leave out most if no item has it, and that few items have.
pub(crate) fn find_seldom(graph: &Graph, live: &[bool], outputs: &[Id]) -> Option<Skip> {
    find_by(graph, live, outputs, |mask, all| {
        !all && is_seldom(graph, mask, DEPTH)
    })
}

/// Returns the truth that allows to leave out most; of equals the first one.
pub(crate) fn find(graph: &Graph, live: &[bool], outputs: &[Id]) -> Option<Skip> {
    find_by(graph, live, outputs, |_, _| true)
}

fn find_by(
    graph: &Graph,
    live: &[bool],
    outputs: &[Id],
    is_wanted: impl Fn(Id, bool) -> bool,
) -> Option<Skip> {
    let mut search = Search::new(graph, live, outputs);
    let mut best: Option<(usize, Id, bool, Vec<Id>)> = None;
    // From the last truth on, which cuts off most.
    for mask in (0..graph.len() as Id).rev() {
        if !search.is_judged[mask as usize] {
            continue;
        }
        for all in [false, true] {
            let least = best.as_ref().map_or(FEW, |best| best.0);
            if search.visits < VISITS * graph.len()
                && is_wanted(mask, all)
                && let Some((count, nodes)) = search.idle(mask, all, least)
            {
                best = Some((count, mask, all, nodes));
            }
        }
    }
    let (_, mask, all, nodes) = best?;
    let mut idle = vec![false; graph.len()];
    for x in nodes {
        idle[x as usize] = true;
    }
    Some(Skip { mask, all, idle })
}

/// The judge of one truth after another.
struct Search<'a> {
    graph: &'a Graph,
    live: &'a [bool],
    /// Truths that a choice or another truth reads.
    is_judged: Vec<bool>,
    /// The choices and truths that read each truth.
    readers: HashMap<Id, Vec<Id>>,
    /// How often live nodes and outputs read each node.
    uses: Vec<u32>,
    /// Live sines and cosines of one angle, which are computed together.
    sines: HashMap<(Id, bool), Vec<Id>>,
    /// The truths that are known; empty between two judgements, as the next three are.
    known: HashMap<Id, bool>,
    /// Uses that are cut off.
    lost: Vec<u32>,
    idle: Vec<bool>,
    after: Vec<bool>,
    /// How many nodes have been visited.
    visits: usize,
}

impl<'a> Search<'a> {
    fn new(graph: &'a Graph, live: &'a [bool], outputs: &[Id]) -> Self {
        let mut search = Search {
            graph,
            live,
            is_judged: vec![false; graph.len()],
            readers: HashMap::new(),
            uses: vec![0; graph.len()],
            sines: HashMap::new(),
            known: HashMap::new(),
            lost: vec![0; graph.len()],
            idle: vec![false; graph.len()],
            after: vec![false; graph.len()],
            visits: 0,
        };
        for &x in outputs {
            search.uses[x as usize] += 1;
        }
        for (x, &node) in (0..).zip(graph.nodes()).filter(|(x, _)| live[*x as usize]) {
            for &y in node.operands().iter() {
                search.uses[y as usize] += 1;
            }
            let (masks, is_judged) = match node {
                Node::Select(m, ..) => (vec![m], true),
                Node::And(a, b) | Node::Or(a, b) => (vec![a, b], true),
                Node::Not(a) => (vec![a], false),
                _ => (Vec::new(), false),
            };
            for m in masks {
                search.is_judged[m as usize] |= is_judged;
                search.readers.entry(m).or_default().push(x);
            }
            if let Some((angle, parts, _)) = sine_of(node) {
                search.sines.entry((angle, parts)).or_default().push(x);
            }
        }
        search
    }
    /// Returns the nodes that do not matter if a truth is known, and how many of them are computed, if those are so
    /// many at least: none that the truth itself or a node that matters and comes later needs.
    fn idle(&mut self, mask: Id, truth: bool, least: usize) -> Option<(usize, Vec<Id>)> {
        self.consequences(mask, truth);
        let (mut nodes, read) = self.cut_off(mask);
        let mut found = None;
        if self.count(&nodes) >= least {
            self.keep_sines(&nodes);
            self.keep_late(&nodes);
            let count = self.count(&nodes);
            found = (count >= least).then_some(count);
        }
        for x in read {
            self.lost[x as usize] = 0;
        }
        nodes.retain(|&x| std::mem::take(&mut self.idle[x as usize]));
        self.known.clear();
        found.map(|count| (count, nodes))
    }
    /// Idle nodes that are computed: no constants and inputs.
    fn count(&self, nodes: &[Id]) -> usize {
        let computed = |x: &&Id| !self.graph.at(**x).operands().is_empty();
        let idle = nodes.iter().filter(|&&x| self.idle[x as usize]);
        idle.filter(computed).count()
    }
    /// Finds the truths that are known if one of them is.
    fn consequences(&mut self, mask: Id, truth: bool) {
        let mut open = vec![(mask, truth)];
        while let Some((m, truth)) = open.pop() {
            if self.known.insert(m, truth).is_some() {
                continue;
            }
            for &x in self.readers.get(&m).into_iter().flatten() {
                self.visits += 1;
                match self.graph.at(x) {
                    Node::And(..) if !truth => open.push((x, false)),
                    Node::Or(..) if truth => open.push((x, true)),
                    Node::Not(_) => open.push((x, !truth)),
                    _ => {}
                }
            }
        }
    }
    /// Operand `y` number `k` of a node is not needed, by what is known. Choices and truths themselves are still
    /// computed; what is idle does not change them.
    fn is_cut(&self, x: Id, k: usize, y: Id, mask: Id) -> bool {
        match self.graph.at(x) {
            Node::Select(m, ..) => match self.known.get(&m) {
                Some(&truth) => k == if truth { 2 } else { 1 },
                None => false,
            },
            Node::And(..) | Node::Or(..) if x != mask => {
                let own = self.known.get(&x);
                own.is_some() && self.known.get(&y) != own
            }
            _ => false,
        }
    }
    /// Marks what no output needs any more, and returns it, with all nodes that have lost a use.
    fn cut_off(&mut self, mask: Id) -> (Vec<Id>, Vec<Id>) {
        let mut choosing: Vec<Id> = Vec::new();
        for m in self.known.keys() {
            choosing.push(*m);
            choosing.extend(self.readers.get(m).into_iter().flatten());
        }
        choosing.sort_unstable();
        choosing.dedup();
        let (mut nodes, mut read) = (Vec::new(), Vec::new());
        let mut open: Vec<(Id, bool)> = choosing.into_iter().map(|x| (x, true)).collect();
        while let Some((x, is_cut)) = open.pop() {
            self.visits += 1;
            // First the operands that are cut off, and of an idle node all others.
            for (k, &y) in self.graph.at(x).operands().iter().enumerate() {
                if !self.live[x as usize] || self.is_cut(x, k, y, mask) != is_cut {
                    continue;
                }
                read.push(y);
                self.lost[y as usize] += 1;
                if self.lost[y as usize] == self.uses[y as usize] && y != mask {
                    self.idle[y as usize] = true;
                    nodes.push(y);
                    open.push((y, false));
                }
            }
        }
        (nodes, read)
    }
    /// Sine and cosine of an angle are computed together: one that matters keeps the other.
    fn keep_sines(&mut self, nodes: &[Id]) {
        let mut kept = Vec::new();
        for &x in nodes {
            if let Some((angle, parts, _)) = sine_of(self.graph.at(x))
                && self
                    .sines
                    .get(&(angle, parts))
                    .into_iter()
                    .flatten()
                    .any(|&y| !self.idle[y as usize])
            {
                kept.push(x);
            }
        }
        for x in kept {
            self.idle[x as usize] = false;
        }
    }
    /// A node that needs a number computed after the idle ones cannot be idle.
    fn keep_late(&mut self, nodes: &[Id]) {
        let (Some(&first), Some(&last)) = (nodes.iter().min(), nodes.iter().max()) else {
            return;
        };
        for x in first..=last {
            if !self.live[x as usize] {
                continue;
            }
            let operands = self.graph.at(x).operands();
            let late = operands.iter().any(|&y| self.after[y as usize]);
            if late {
                self.idle[x as usize] = false;
            }
            let reads = |y: &Id| self.idle[*y as usize];
            self.after[x as usize] = late || !self.idle[x as usize] && operands.iter().any(reads);
        }
        self.after[first as usize..=last as usize].fill(false);
        self.visits += (last - first) as usize;
    }
}

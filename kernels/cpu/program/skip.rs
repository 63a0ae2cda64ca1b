//! The nodes that a block can skip: those that matter only if a truth holds, or only if it does not.
//!
//! Boxes that are apart have intersection zero without any clipping: a block of such pairs can skip it. Such truths are
//! found in the graph. Every selection by the truth, or by one that it implies, loses the operand that is never
//! selected. A node that then reaches no output need not be computed: its slot holds an arbitrary number that is never
//! selected.
//!
//! The gain of a truth is found without a walk of the whole graph. Uses are counted once, and a node without remaining
//! uses removes the uses of its operands. All truths together visit a bounded number of nodes per node.
use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::program::fuse::sine_of;
use std::collections::HashMap;

/// The number of nodes below which testing the truth costs more than it saves.
const FEW: usize = 12;

/// The largest number of visits per node of the graph. Scores and distances of boxes, with gradients, need up to 23.
const VISITS: usize = 256;

/// A truth and the nodes that it makes superfluous.
#[derive(Clone, Debug)]
pub(crate) struct SkipCondition {
    /// The truth.
    pub(crate) mask: Id,
    /// `true` if it must hold for all items, `false` if for none.
    pub(crate) all: bool,
    /// For each node: `true` if it is then superfluous.
    pub(crate) idle: Vec<bool>,
}

/// The factor below which a comparison concerns the roundings of a number, which few items have.
const SMALL: f64 = 1.0 / 256.0;

/// The number of operations behind a truth that are examined.
const DEPTH: usize = 8;

/// Returns `true` if few items satisfy a truth: it asks whether a size is as small as a rounding error.
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

/// Returns the truth that few items satisfy and whose absence makes most nodes superfluous.
pub(crate) fn find_seldom(graph: &Graph, live: &[bool], outputs: &[Id]) -> Option<SkipCondition> {
    find_by(graph, live, outputs, |mask, all| {
        !all && is_seldom(graph, mask, DEPTH)
    })
}

/// Returns the truth that makes most nodes superfluous; the first of equal ones.
pub(crate) fn find(graph: &Graph, live: &[bool], outputs: &[Id]) -> Option<SkipCondition> {
    find_by(graph, live, outputs, |_, _| true)
}

fn find_by(
    graph: &Graph,
    live: &[bool],
    outputs: &[Id],
    is_wanted: impl Fn(Id, bool) -> bool,
) -> Option<SkipCondition> {
    let mut search = SkipSearch::new(graph, live, outputs);
    let mut best: Option<(usize, Id, bool, Vec<Id>)> = None;
    // Later truths make more nodes superfluous.
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
    Some(SkipCondition { mask, all, idle })
}

/// The search among all truths, one after another.
struct SkipSearch<'a> {
    graph: &'a Graph,
    live: &'a [bool],
    /// For each node: `true` for a truth that a selection or another truth reads.
    is_judged: Vec<bool>,
    /// The selections and truths that read each truth.
    readers: HashMap<Id, Vec<Id>>,
    /// The number of reads of each node, by live nodes and outputs.
    uses: Vec<u32>,
    /// Live sines and cosines of one angle, which are computed together.
    sines: HashMap<(Id, bool), Vec<Id>>,
    /// The known truths. Like the next three fields it is empty between two searches.
    known: HashMap<Id, bool>,
    /// The number of removed uses of each node.
    lost: Vec<u32>,
    idle: Vec<bool>,
    after: Vec<bool>,
    /// The number of visited nodes.
    visits: usize,
}

impl<'a> SkipSearch<'a> {
    fn new(graph: &'a Graph, live: &'a [bool], outputs: &[Id]) -> Self {
        let mut search = SkipSearch {
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
    /// Returns the nodes that are superfluous if a truth is known, and how many of them are computed, if there are at
    /// least `least`. It excludes nodes that the truth itself needs, or a later node that matters.
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
    /// Returns how many superfluous nodes are computed, without constants and inputs.
    fn count(&self, nodes: &[Id]) -> usize {
        let computed = |x: &&Id| !self.graph.at(**x).operands().is_empty();
        let idle = nodes.iter().filter(|&&x| self.idle[x as usize]);
        idle.filter(computed).count()
    }
    /// Finds the truths that follow from a known one.
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
    /// Returns `true` if node `x` does not need operand number `k`, node `y`, by what is known. Selections and truths
    /// themselves are still computed; superfluous nodes do not change them.
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
    /// Marks the nodes that no output needs any more. Returns them, and all nodes that have lost a use.
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
            // First the unneeded operands, then all operands of superfluous nodes.
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
    /// Keeps both sine and cosine of an angle if one of them matters, since they are computed together.
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
    /// Keeps nodes that need a number computed after the superfluous ones.
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

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

/// The least of numbers that only saturated ones are compared with.
const HUGE: f64 = 1e30;

/// The number of operations behind a truth that are examined.
const DEPTH: usize = 8;

/// Returns the value that a truth has for almost all items, if its form says so. Few numbers are as small as a rounding
/// error, or saturated, and few of several equal ones are equally good.
fn usual(graph: &Graph, mask: Id, depth: usize) -> Option<bool> {
    let depth = depth.checked_sub(1)?;
    let of = |x: Id| usual(graph, x, depth);
    let (is_small, is_huge) = (
        |x: Id| graph.constant(x).is_some_and(|x| 0.0 < x && x <= SMALL),
        |x: Id, sign: f64| graph.constant(x).is_some_and(|x| sign * x >= HUGE),
    );
    match graph.at(mask) {
        Node::Lt(a, b) | Node::Le(a, b) => {
            let is_part = match graph.at(b) {
                Node::Mul(x, y) => is_small(x) || is_small(y),
                _ => is_small(b),
            };
            let is_tie = graph.constant(a) == Some(1.0) && is_number_of_items(graph, b, DEPTH);
            let is_rare = is_part && is_size(graph, a, DEPTH)
                || is_huge(a, 1.0)
                || is_huge(b, -1.0)
                || is_tie;
            match is_huge(a, -1.0) || is_huge(b, 1.0) {
                true => Some(true),
                false => is_rare.then_some(false),
            }
        }
        Node::And(a, b) => match (of(a), of(b)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        },
        Node::Or(a, b) => match (of(a), of(b)) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (Some(false), Some(false)) => Some(false),
            _ => None,
        },
        Node::Not(a) => of(a).map(|truth| !truth),
        Node::Bool(truth) => Some(truth),
        _ => None,
    }
}

/// Returns `true` if a number counts items: a sum of choices between whole numbers.
fn is_number_of_items(graph: &Graph, x: Id, depth: usize) -> bool {
    let Some(depth) = depth.checked_sub(1) else {
        return false;
    };
    let of = |x: Id| is_number_of_items(graph, x, depth);
    match graph.at(x) {
        Node::Add(a, b) | Node::Select(_, a, b) => of(a) && of(b),
        _ => graph.constant(x).is_some_and(|x| x == x.round()),
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

/// Returns truths each of which makes nodes superfluous that no earlier one does: up to `most`, first those in which almost
/// all items agree. `is_worth` decides by the number of these nodes, whether items agree, and the number of earlier truths.
pub(crate) fn find(
    graph: &Graph,
    live: &[bool],
    outputs: &[Id],
    most: usize,
    is_worth: impl Fn(usize, bool, usize) -> bool,
) -> Vec<SkipCondition> {
    let mut search = SkipSearch::new(graph, live, outputs);
    let mut found = Vec::new();
    for seldom in [true, false] {
        while found.len() < most
            && let Some((count, skip)) = search.best(seldom)
            && is_worth(count, seldom, found.len())
        {
            for (taken, &idle) in search.taken.iter_mut().zip(&skip.idle) {
                *taken |= idle;
            }
            found.push(skip);
        }
    }
    found
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
    /// The nodes that an earlier condition skips.
    taken: Vec<bool>,
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
            taken: vec![false; graph.len()],
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
    /// Returns the truth that makes most nodes superfluous, the first of equal ones, and how many of them are computed: of
    /// all truths, or of those that almost all items agree in.
    fn best(&mut self, seldom: bool) -> Option<(usize, SkipCondition)> {
        self.visits = 0;
        let mut best: Option<(usize, Id, bool, Vec<Id>)> = None;
        // Later truths make more nodes superfluous.
        for mask in (0..self.graph.len() as Id).rev() {
            // A truth that is skipped itself decides nothing.
            if !self.is_judged[mask as usize] || self.taken[mask as usize] {
                continue;
            }
            let usual = usual(self.graph, mask, DEPTH);
            for all in [false, true] {
                let least = best.as_ref().map_or(FEW, |best| best.0);
                if self.visits < VISITS * self.graph.len()
                    // A condition that almost no block meets gains nothing.
                    && usual != Some(!all)
                    && (!seldom || usual == Some(all))
                    && let Some((count, nodes)) = self.idle(mask, all, least)
                {
                    best = Some((count, mask, all, nodes));
                }
            }
        }
        let (count, mask, all, nodes) = best?;
        let mut idle = vec![false; self.graph.len()];
        for x in nodes {
            idle[x as usize] = true;
        }
        Some((count, SkipCondition { mask, all, idle }))
    }
    /// Returns the nodes that are superfluous if a truth is known, and how many of them are computed, if there are at
    /// least `least`. It excludes nodes that the truth itself needs, or a later node that matters, and those of earlier
    /// conditions.
    fn idle(&mut self, mask: Id, truth: bool, least: usize) -> Option<(usize, Vec<Id>)> {
        self.consequences(mask, truth);
        let (mut nodes, read) = self.cut_off(mask);
        for &x in &nodes {
            self.idle[x as usize] &= !self.taken[x as usize];
        }
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
            match self.graph.at(m) {
                Node::And(a, b) if truth => open.extend([(a, true), (b, true)]),
                Node::Or(a, b) if !truth => open.extend([(a, false), (b, false)]),
                Node::Not(a) => open.push((a, !truth)),
                _ => {}
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
            // The other operand decides, if it is known to.
            Node::And(a, b) | Node::Or(a, b) if x != mask => {
                let decides = matches!(self.graph.at(x), Node::Or(..));
                let known = |y: Id| self.known.get(&y) == Some(&decides);
                known(x) && known(if k == 0 { b } else { a }) && !known(y)
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

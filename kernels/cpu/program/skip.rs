//! The nodes that a block can leave out: those that matter only where a truth does not hold, or only where it
//! does.
//!
//! Boxes that are apart share nothing, whatever the clipping of their sides gives: where all items of a block are
//! apart, nothing needs to be clipped. Such truths are found in the graph. Every choice by the truth (or by one
//! that follows from it) loses the side that is never taken. A node that then reaches no output need not be
//! computed: its slot holds some number that is not chosen.
use crate::ad::program::graph::{Graph, Id, Node};
use crate::kernels::cpu::program::fuse::sine_of;

/// With fewer nodes than this the test of the truth costs more than it saves.
const FEW: usize = 12;

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

/// The truths that are known if one of them is.
fn consequences(graph: &Graph, mask: Id, truth: bool) -> Vec<Option<bool>> {
    let mut known = vec![None; graph.len()];
    known[mask as usize] = Some(truth);
    for (i, &node) in graph.nodes().iter().enumerate().skip(mask as usize + 1) {
        let of = |x: Id| known[x as usize];
        known[i] = match node {
            Node::And(a, b) if of(a) == Some(false) || of(b) == Some(false) => Some(false),
            Node::Or(a, b) if of(a) == Some(true) || of(b) == Some(true) => Some(true),
            Node::Not(a) => of(a).map(|truth| !truth),
            _ => None,
        };
    }
    known
}

/// Which nodes do not matter if a truth is known: none that the truth itself or a node that matters
/// and comes later needs.
fn idle(graph: &Graph, live: &[bool], outputs: &[Id], mask: Id, truth: bool) -> Vec<bool> {
    let known = consequences(graph, mask, truth);
    let mut matters = vec![false; graph.len()];
    let mut open = outputs.to_vec();
    open.push(mask);
    while let Some(x) = open.pop() {
        if std::mem::replace(&mut matters[x as usize], true) {
            continue;
        }
        // Choices and truths themselves are still computed; what is idle does not change them.
        match graph.at(x) {
            Node::Select(m, yes, no) => match known[m as usize] {
                Some(truth) => open.extend([m, if truth { yes } else { no }]),
                None => open.extend([m, yes, no]),
            },
            Node::And(a, b) | Node::Or(a, b) if x != mask && known[x as usize].is_some() => {
                let decides = |y: &Id| known[*y as usize] == known[x as usize];
                open.extend([a, b].into_iter().filter(decides));
            }
            node => open.extend_from_slice(&node.operands()),
        }
    }
    let mut idle: Vec<bool> = live.iter().zip(&matters).map(|(l, m)| *l && !*m).collect();
    // Sine and cosine of an angle are computed together.
    let nodes = || graph.nodes().iter().enumerate();
    let kept: Vec<(Id, bool)> = nodes()
        .filter(|(i, _)| matters[*i])
        .filter_map(|(_, &node)| sine_of(node).map(|(angle, parts, _)| (angle, parts)))
        .collect();
    for (i, &node) in nodes() {
        if let Some((angle, parts, _)) = sine_of(node) {
            idle[i] &= !kept.contains(&(angle, parts));
        }
    }
    // A node that needs a number computed after the idle ones cannot be idle.
    let mut after = vec![false; graph.len()];
    for (i, node) in graph.nodes().iter().enumerate() {
        let operands = node.operands();
        let late = operands.iter().any(|&x| after[x as usize]);
        if late {
            idle[i] = false;
        }
        after[i] = late || !idle[i] && operands.iter().any(|&x| idle[x as usize]);
    }
    idle
}

/// The truth that allows to leave out most.
pub(crate) fn find(graph: &Graph, live: &[bool], outputs: &[Id]) -> Option<Skip> {
    let mut masks: Vec<Id> = Vec::new();
    for (_, node) in graph.nodes().iter().enumerate().filter(|(i, _)| live[*i]) {
        match *node {
            Node::Select(m, ..) => masks.push(m),
            Node::And(a, b) | Node::Or(a, b) => masks.extend([a, b]),
            _ => {}
        }
    }
    masks.sort_unstable();
    masks.dedup();
    let mut best: Option<(usize, Skip)> = None;
    for mask in masks {
        for all in [true, false] {
            let idle = idle(graph, live, outputs, mask, all);
            let nodes = graph.nodes().iter().zip(&idle);
            let count = nodes.filter(|(node, idle)| **idle && !node.operands().is_empty());
            let count = count.count();
            if count >= FEW && best.as_ref().is_none_or(|best| best.0 < count) {
                best = Some((count, Skip { mask, all, idle }));
            }
        }
    }
    best.map(|best| best.1)
}

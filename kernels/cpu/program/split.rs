//! What depends on one argument alone: found in the graph, computed once per item of that argument.
//!
//! In a batch of all pairs every argument meets many others. What is made of it alone, its sines for
//! one, is the same each time.
use crate::ad::program::graph::{Graph, Id, Node};

/// A graph with its inputs and outputs.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// The operations.
    pub(crate) graph: Graph,
    /// The results.
    pub(crate) outputs: Vec<Id>,
}

/// A program in parts: what is made of each argument, and the rest.
#[derive(Clone, Debug)]
pub(crate) struct Split {
    /// Of each argument its frame: numbers that depend on no other one.
    pub(crate) frames: Vec<Piece>,
    /// The results from all frames, one frame after another.
    pub(crate) body: Piece,
}

/// What a node depends on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Origin {
    Nothing,
    One(usize),
    Several,
}

impl Origin {
    fn and(self, other: Origin) -> Origin {
        match (self, other) {
            (Origin::Nothing, x) | (x, Origin::Nothing) => x,
            (x, y) if x == y => x,
            _ => Origin::Several,
        }
    }
}

/// Splits a graph without grafts by arguments, of so many numbers each.
pub(crate) fn split(graph: &Graph, fields: &[usize], outputs: &[Id]) -> Split {
    let live = graph.live(outputs, false);
    let argument_of: Vec<usize> = fields
        .iter()
        .enumerate()
        .flat_map(|(argument, &count)| std::iter::repeat_n(argument, count))
        .collect();
    let mut origins: Vec<Origin> = Vec::with_capacity(graph.len());
    for &node in graph.nodes() {
        origins.push(match node {
            Node::Input(k) => Origin::One(argument_of[k as usize]),
            node => node.operands().iter().fold(Origin::Nothing, |origin, &x| {
                origin.and(origins[x as usize])
            }),
        });
    }
    // A number of one argument that the body needs. Truths are decided again: a frame holds numbers.
    let mut asked = vec![false; graph.len()];
    let mut in_body = vec![false; graph.len()];
    for &x in outputs {
        asked[x as usize] = true;
    }
    let mut picked = vec![Vec::new(); fields.len()];
    for x in (0..graph.len()).rev().filter(|&x| live[x]) {
        if !asked[x] {
            continue;
        }
        let node = graph.at(x as Id);
        match origins[x] {
            Origin::One(argument) if !node.is_mask() => picked[argument].push(x as Id),
            _ => {
                in_body[x] = true;
                for &y in node.operands().iter() {
                    asked[y as usize] = true;
                }
            }
        }
    }
    let mut body = Graph::new(graph.format);
    let mut names = vec![0; graph.len()];
    let mut count = 0;
    let mut frames = Vec::new();
    let mut first = 0;
    for (picked, &fields) in picked.iter_mut().zip(fields) {
        picked.reverse();
        for &x in picked.iter() {
            names[x as usize] = body.push(Node::Input(count));
            count += 1;
        }
        frames.push(frame(graph, picked, first));
        first += fields as u32;
    }
    for x in (0..graph.len()).filter(|&x| in_body[x]) {
        let node = graph.at(x as Id).renamed(|y| names[y as usize]);
        names[x] = body.push(node);
    }
    Split {
        frames,
        body: Piece {
            graph: body,
            outputs: outputs.iter().map(|&x| names[x as usize]).collect(),
        },
    }
}

/// The part of a graph that some nodes need, its inputs counted from the first one of an argument.
fn frame(graph: &Graph, outputs: &[Id], first: u32) -> Piece {
    let live = graph.live(outputs, false);
    let mut piece = Graph::new(graph.format);
    let mut names = vec![0; graph.len()];
    for x in (0..graph.len()).filter(|&x| live[x]) {
        names[x] = piece.push(match graph.at(x as Id) {
            Node::Input(k) => Node::Input(k - first),
            node => node.renamed(|y| names[y as usize]),
        });
    }
    Piece {
        graph: piece,
        outputs: outputs.iter().map(|&x| names[x as usize]).collect(),
    }
}

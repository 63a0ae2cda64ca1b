//! The numbers that depend on one argument alone: found in the graph, and computed once per item of that argument.
//!
//! In a batch of all pairs every item meets many others. A number that depends on it alone, such as its sine, does not
//! change from pair to pair.
use crate::ad::program::graph::{Graph, Id, Node};

/// A graph with its inputs and outputs.
#[derive(Clone, Debug)]
pub(crate) struct Subgraph {
    /// The operations.
    pub(crate) graph: Graph,
    /// The results.
    pub(crate) outputs: Vec<Id>,
}

/// A program split in two stages: the numbers that depend on one argument each, and the rest.
#[derive(Clone, Debug)]
pub(crate) struct Split {
    /// The frame of each argument: numbers that depend on no other one.
    pub(crate) frames: Vec<Subgraph>,
    /// The results from all frames, one frame after another, and then from the arguments without a frame.
    pub(crate) body: Subgraph,
    /// The number of inputs of the body from each of them.
    pub(crate) widths: Vec<usize>,
}

/// The arguments that a node depends on.
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

/// Splits a graph without grafts by its arguments, of `fields` numbers each. The first `framed` of them have frames,
/// which consist of nodes that `is_framed` accepts (it must accept inputs). The others, cotangents, have none.
pub(crate) fn split(
    graph: &Graph,
    fields: &[usize],
    framed: usize,
    outputs: &[Id],
    is_framed: impl Fn(Node) -> bool,
) -> Split {
    let live = graph.live(outputs, false);
    let argument_of: Vec<usize> = fields
        .iter()
        .enumerate()
        .flat_map(|(argument, &count)| std::iter::repeat_n(argument, count))
        .collect();
    let mut origins: Vec<Origin> = Vec::with_capacity(graph.len());
    for &node in graph.nodes() {
        origins.push(match node {
            Node::Input(k) => match argument_of[k as usize] {
                argument if argument < framed => Origin::One(argument),
                _ => Origin::Several,
            },
            node => node.operands().iter().fold(Origin::Nothing, |origin, &x| {
                origin.and(origins[x as usize])
            }),
        });
    }
    // A number of one argument that the body needs. Truths are computed again in the body, since a frame holds numbers.
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
            Origin::One(argument) if !node.is_mask() && is_framed(node) => {
                picked[argument].push(x as Id)
            }
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
    let mut widths = Vec::new();
    let mut count = 0;
    let mut frames = Vec::new();
    let mut first = 0;
    for (picked, &fields) in picked.iter_mut().zip(fields).take(framed) {
        picked.reverse();
        for &x in picked.iter() {
            names[x as usize] = body.push(Node::Input(count));
            count += 1;
        }
        frames.push(frame(graph, picked, first));
        widths.push(picked.len());
        first += fields as u32;
    }
    widths.extend(fields.iter().skip(framed));
    let shift = |k: u32| k - first + count;
    for x in (0..graph.len()).filter(|&x| in_body[x]) {
        names[x] = body.push(match graph.at(x as Id) {
            Node::Input(k) => Node::Input(shift(k)),
            node => node.renamed(|y| names[y as usize]),
        });
    }
    Split {
        frames,
        body: Subgraph {
            graph: body,
            outputs: outputs.iter().map(|&x| names[x as usize]).collect(),
        },
        widths,
    }
}

/// Extracts the subgraph that `outputs` need, and numbers its inputs from `first`.
fn frame(graph: &Graph, outputs: &[Id], first: u32) -> Subgraph {
    let live = graph.live(outputs, false);
    let mut piece = Graph::new(graph.format);
    let mut names = vec![0; graph.len()];
    for x in (0..graph.len()).filter(|&x| live[x]) {
        names[x] = piece.push(match graph.at(x as Id) {
            Node::Input(k) => Node::Input(k - first),
            node => node.renamed(|y| names[y as usize]),
        });
    }
    Subgraph {
        graph: piece,
        outputs: outputs.iter().map(|&x| names[x as usize]).collect(),
    }
}

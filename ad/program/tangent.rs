//! Forward mode: tangents of outputs from tangents of inputs, as more nodes of the same graph.
use super::derivative::{active, along, carriers};
use super::graph::{Graph, Id, Node};

/// Returns the derivative of every output along a direction, of which each number is a node.
pub(super) fn forward(graph: &mut Graph, outputs: &[Id], direction: &[Id]) -> Vec<Id> {
    let active = active(graph, direction.len());
    let live = graph.live(outputs, true);
    let mut tangents: Vec<Option<Id>> = vec![None; graph.len()];
    for i in 0..tangents.len() {
        if !active[i] || !live[i] {
            continue;
        }
        let me = i as Id;
        let node = graph.at(me);
        let operands = node.operands();
        tangents[i] = match node {
            // A direction's zeros are known: the factors of products with them are left out.
            Node::Input(place) => {
                Some(direction[place as usize]).filter(|&t| graph.constant(t) != Some(0.0))
            }
            // One choice, not the sum of two.
            Node::Select(mask, yes, no) => match (tangents[yes as usize], tangents[no as usize]) {
                (None, None) => None,
                (yes, no) => {
                    let zero = graph.lit(0.0);
                    let (yes, no) = (yes.unwrap_or(zero), no.unwrap_or(zero));
                    Some(graph.make(Node::Select(mask, yes, no)))
                }
            },
            node => {
                let mut sum = None;
                for &place in carriers(node) {
                    let Some(t) = tangents[operands[place] as usize] else {
                        continue;
                    };
                    let t = along(graph, me, place, t);
                    sum = Some(match sum {
                        None => t,
                        Some(sum) => graph.make(Node::Add(sum, t)),
                    });
                }
                sum
            }
        };
    }
    let zero = graph.lit(0.0);
    outputs
        .iter()
        .map(|&x| tangents[x as usize].unwrap_or(zero))
        .collect()
}

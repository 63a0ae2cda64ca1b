//! Reverse mode: cotangents of inputs from cotangents of outputs, as more nodes of the same graph.
//!
//! A choice passes its cotangent to the side that was taken. If the other side received a zero at once, that zero could
//! meet an infinite derivative further down, and zero times infinity is NaN. Both sides therefore receive the cotangent
//! as it is, with a *path*: the choices under which it counts. It is selected where paths meet again, or at the inputs.
use super::derivative::{active, along, carriers, keeps_zero, taken};
use super::graph::{Graph, Id, Node};

/// A condition under which a cotangent counts.
#[derive(Clone, Copy, Debug)]
struct Guard {
    mask: Id,
    /// The required value of the mask.
    side: bool,
    /// `true` if the cotangent is zero already where the condition does not hold.
    zero: bool,
}

/// A cotangent, with the conditions under which it counts, outermost first.
#[derive(Clone, Debug)]
struct Bar {
    value: Id,
    path: Vec<Guard>,
}

/// The cotangents during the backward pass.
struct Sweep<'a> {
    graph: &'a mut Graph,
    active: Vec<bool>,
    bars: Vec<Option<Bar>>,
}

/// Returns the cotangents of the first `inputs` numbers of the input, from those of the outputs, which are nodes of the
/// graph.
pub(super) fn reverse(graph: &mut Graph, outputs: &[Id], seeds: &[Id], inputs: usize) -> Vec<Id> {
    let count = graph.len();
    let mut sweep = Sweep {
        active: active(graph, inputs),
        bars: vec![None; count],
        graph,
    };
    for (&output, &value) in outputs.iter().zip(seeds) {
        let path = Vec::new();
        sweep.give(output, Bar { value, path });
    }
    for me in (0..count).rev() {
        if let Some(bar) = sweep.bars[me].clone() {
            sweep.pull(me as Id, &bar);
        }
    }
    let zero = sweep.graph.lit(0.0);
    (0..inputs)
        .map(|place| {
            let input = sweep.graph.push(Node::Input(place as u32));
            match sweep.bars.get_mut(input as usize).and_then(Option::take) {
                Some(bar) => sweep.chosen(&bar, 0),
                None => zero,
            }
        })
        .collect()
}

impl Sweep<'_> {
    /// Hands the cotangent of a node to its operands.
    fn pull(&mut self, me: Id, bar: &Bar) {
        let node = self.graph.at(me);
        let operands = node.operands();
        for &place in carriers(node) {
            let to = operands[place];
            if !self.active[to as usize] {
                continue;
            }
            let mut path = bar.path.clone();
            if let Some((mask, side)) = taken(self.graph, node, place) {
                // A `Select` gives its cotangent as it is; all others give zero to the operand that they do not take.
                let zero = !matches!(node, Node::Select(..));
                let guard = Guard { mask, side, zero };
                match path.iter().find(|known| known.mask == guard.mask) {
                    Some(known) if known.side != guard.side => continue,
                    Some(_) => {}
                    None => path.push(guard),
                }
            }
            let value = match node {
                Node::Select(..) => bar.value,
                _ => along(self.graph, me, place, bar.value),
            };
            if !keeps_zero(self.graph, node, place) {
                for guard in &mut path {
                    guard.zero = false;
                }
            }
            self.give(to, Bar { value, path });
        }
    }

    /// Adds to the cotangent of a node.
    fn give(&mut self, to: Id, new: Bar) {
        if !self.active[to as usize] {
            return;
        }
        let merged = match self.bars[to as usize].take() {
            None => new,
            Some(old) => self.merged(&old, &new),
        };
        self.bars[to as usize] = Some(merged);
    }

    /// Returns the sum of two cotangents, each where it counts.
    fn merged(&mut self, old: &Bar, new: &Bar) -> Bar {
        let mut path: Vec<Guard> = old
            .path
            .iter()
            .zip(&new.path)
            .take_while(|(a, b)| a.mask == b.mask && a.side == b.side)
            .map(|(a, b)| Guard {
                zero: a.zero && b.zero,
                ..*a
            })
            .collect();
        let common = path.len();
        let value = match (&old.path[common..], &new.path[common..]) {
            // Both sides of one choice.
            ([a], [b]) if a.mask == b.mask => {
                let (yes, no) = if a.side { (old, new) } else { (new, old) };
                self.graph.make(Node::Select(a.mask, yes.value, no.value))
            }
            _ => {
                let (a, b) = (self.chosen(old, common), self.chosen(new, common));
                self.graph.make(Node::Add(a, b))
            }
        };
        // If neither counts, the sum is zero, and its product with an infinite derivative must not count, either.
        let either = {
            let (a, b) = (
                self.hold(&old.path[common..]),
                self.hold(&new.path[common..]),
            );
            self.graph.make(Node::Or(a, b))
        };
        if self.graph.truth(either).is_none() {
            path.push(Guard {
                mask: either,
                side: true,
                zero: true,
            });
        }
        Bar { value, path }
    }

    /// Returns the node that is true if all conditions hold.
    fn hold<'a>(&mut self, path: impl IntoIterator<Item = &'a Guard>) -> Id {
        let mut all = self.graph.push(Node::Bool(true));
        for guard in path {
            let mask = match guard.side {
                true => guard.mask,
                false => self.graph.make(Node::Not(guard.mask)),
            };
            all = self.graph.make(Node::And(all, mask));
        }
        all
    }

    /// Returns the cotangent where the conditions from this one on hold, else zero.
    fn chosen(&mut self, bar: &Bar, from: usize) -> Id {
        let counts = self.hold(bar.path[from..].iter().filter(|guard| !guard.zero));
        let zero = self.graph.lit(0.0);
        self.graph.make(Node::Select(counts, bar.value, zero))
    }
}

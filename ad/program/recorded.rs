//! Programs without their shapes: from a list of numbers to a list of numbers. [`Program`](super::Program) adds the shapes.
use super::evaluate::{evaluate, evaluate_needed};
use super::graph::{Format, Graph, Id, Node};
use super::reverse::reverse;
use super::tangent::forward;
use crate::{Scalar, Unrecordable};

/// A recorded function of a list of numbers with a list of numbers as result.
#[derive(Clone, Debug)]
pub(crate) struct Recorded {
    /// The recorded graph, with the nodes that only derivatives need.
    graph: Graph,
    /// `true` for the nodes that results and their derivatives need.
    needed: Vec<bool>,
    /// The number of input numbers.
    pub(crate) inputs: usize,
    /// The results, each a [`Node::Canonical`]: zeros have no sign.
    outputs: Vec<Id>,
    /// The gradient of the only result, where it was written by hand.
    by_hand: Option<Vec<Id>>,
    /// The graph without the nodes that only derivatives need.
    pub(crate) value: ValueGraph,
}

/// The graph of the values alone, as machines run it.
#[derive(Clone, Debug)]
pub(crate) struct ValueGraph {
    pub(crate) graph: Graph,
    pub(crate) outputs: Vec<Id>,
}

impl Recorded {
    /// Returns a program with these results.
    pub(crate) fn new(mut graph: Graph, inputs: usize, outputs: &[Id]) -> Self {
        let outputs: Vec<Id> = outputs
            .iter()
            .map(|&x| graph.make(Node::Canonical(x)))
            .collect();
        let (lowered, results) = graph.lowered(&outputs);
        Recorded {
            value: ValueGraph {
                graph: lowered,
                outputs: results,
            },
            needed: graph.live(&outputs, true),
            graph,
            inputs,
            outputs,
            by_hand: None,
        }
    }

    /// Returns the format of its numbers.
    pub(crate) fn format(&self) -> Format {
        self.graph.format
    }

    /// Checks that no result depends on an infinite or NaN constant.
    pub(crate) fn checked_constants(self) -> Result<Self, Unrecordable> {
        let needed = (0..self.graph.len()).filter(|&x| self.needed[x]);
        let mut constants = needed.filter_map(|x| self.graph.constant(x as Id));
        let wild = constants.any(|x| !x.is_finite());
        match wild {
            true => Err(Unrecordable::Constant),
            false => Ok(self),
        }
    }

    /// Returns the results for an input, on plain numbers.
    pub(crate) fn run<T: Scalar>(&self, inputs: &[T]) -> Vec<T> {
        evaluate(&self.value.graph, &self.value.outputs, inputs)
    }

    /// Returns the results for an input on any scalar, with its derivatives.
    pub(crate) fn run_on<S: Scalar>(&self, inputs: &[S]) -> Vec<S> {
        // Nodes that came later belong to a gradient.
        let needed = |i| self.needed.get(i) == Some(&true);
        evaluate_needed(&self.graph, needed, &self.outputs, inputs)
    }

    /// Returns the function with every result negated.
    pub(crate) fn negated(&self) -> Self {
        let mut graph = self.graph.clone();
        let outputs: Vec<Id> = self
            .outputs
            .iter()
            .map(|&x| graph.make(Node::Neg(x)))
            .collect();
        Recorded::new(graph, self.inputs, &outputs)
    }

    /// Returns `true` if derivatives in it are multiplied by a share: by a gradient by hand, or by `damp`. Duals of
    /// duals do not include the derivatives of a share.
    #[cfg(feature = "check")]
    pub(crate) fn has_shares(&self) -> bool {
        let is_part = |node: &Node| matches!(node, Node::Graft { share: Some(_), .. });
        self.graph.nodes().iter().any(is_part)
    }

    /// Returns a copy of the graph with the gradient added, and the nodes of the gradient's numbers.
    fn gradient(&self) -> (Graph, Vec<Id>) {
        let mut graph = self.graph.clone();
        let gradient = match &self.by_hand {
            Some(gradient) => gradient.clone(),
            None => {
                let seed = graph.lit(1.0);
                reverse(&mut graph, &self.outputs[..1], &[seed], self.inputs)
            }
        };
        (graph, gradient)
    }

    /// Returns the result, one number, and its gradient.
    pub(crate) fn value_grad(&self) -> Recorded {
        self.value_jacobian()
    }

    /// Returns the pull-back: from an input and a cotangent of the result to the cotangent of the input.
    pub(crate) fn vjp(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let seeds = places(&mut graph, self.inputs, self.outputs.len());
        let bars = match &self.by_hand {
            Some(gradient) => gradient
                .iter()
                .map(|&derivative| graph.make(Node::Mul(seeds[0], derivative)))
                .collect(),
            None => reverse(&mut graph, &self.outputs, &seeds, self.inputs),
        };
        Recorded::new(graph, self.inputs + seeds.len(), &bars)
    }

    /// Returns the result and the pull-back: from an input and a cotangent of the result to the result and the
    /// cotangent of the input.
    pub(crate) fn value_vjp(&self) -> Recorded {
        self.after_result(self.vjp())
    }

    /// Returns [`value_vjp`](Self::value_vjp) by derivatives along one axis of the input after the other.
    pub(crate) fn value_vjp_forwards(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let seeds = places(&mut graph, self.inputs, self.outputs.len());
        let mut bars = Vec::with_capacity(self.inputs);
        for axis in 0..self.inputs {
            let mut sum = graph.lit(0.0);
            for (derivative, &seed) in self
                .along(&mut graph, &self.outputs, axis)
                .into_iter()
                .zip(&seeds)
            {
                let term = graph.make(Node::Mul(seed, derivative));
                sum = graph.make(Node::Add(sum, term));
            }
            bars.push(sum);
        }
        let outputs: Vec<Id> = self.outputs.iter().copied().chain(bars).collect();
        Recorded::new(graph, self.inputs + seeds.len(), &outputs)
    }

    /// Returns the results, and then the gradient of each.
    pub(crate) fn value_jacobian(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let mut outputs = self.outputs.clone();
        match &self.by_hand {
            Some(gradient) => outputs.extend(gradient),
            None => {
                let one = graph.lit(1.0);
                for result in self.outputs.chunks(1) {
                    outputs.extend(reverse(&mut graph, result, &[one], self.inputs));
                }
            }
        }
        Recorded::new(graph, self.inputs, &outputs)
    }

    /// Returns [`value_jacobian`](Self::value_jacobian) by derivatives along one axis of the input after the other.
    pub(crate) fn value_jacobian_forwards(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let columns: Vec<Vec<Id>> = (0..self.inputs)
            .map(|axis| self.along(&mut graph, &self.outputs, axis))
            .collect();
        let rows = (0..self.outputs.len()).flat_map(|k| columns.iter().map(move |own| own[k]));
        let outputs: Vec<Id> = self.outputs.iter().copied().chain(rows).collect();
        Recorded::new(graph, self.inputs, &outputs)
    }

    /// Returns the results, and then the gradient of each, of a program that gives `results` numbers and their
    /// pull-back: the pull-back is repeated with every unit cotangent.
    pub(crate) fn value_jacobian_of_vjp(&self, results: usize) -> Recorded {
        let inputs = self.inputs - results;
        let mut graph = Graph::new(self.format());
        let (mut outputs, mut rows) = (Vec::new(), Vec::new());
        for axis in 0..results {
            let mut ids: Vec<Id> = Vec::with_capacity(self.graph.len());
            for &node in self.graph.nodes() {
                ids.push(match node {
                    Node::Input(place) if place as usize >= inputs => {
                        let is_axis = place as usize == inputs + axis;
                        graph.lit(f64::from(u8::from(is_axis)))
                    }
                    node => graph.make(node.renamed(|x| ids[x as usize])),
                });
            }
            let renamed = |&x: &Id| ids[x as usize];
            if axis == 0 {
                outputs.extend(self.outputs[..results].iter().map(renamed));
            }
            rows.extend(self.outputs[results..].iter().map(renamed));
        }
        Recorded::new(graph, inputs, &[outputs, rows].concat())
    }

    /// Returns the derivatives of some nodes along an axis of the input.
    fn along(&self, graph: &mut Graph, nodes: &[Id], axis: usize) -> Vec<Id> {
        let (zero, one) = (graph.lit(0.0), graph.lit(1.0));
        let mut direction = vec![zero; self.inputs];
        direction[axis] = one;
        forward(graph, nodes, &direction)
    }

    /// Returns the result, followed by the results of a program whose graph begins with this one's; it may take more
    /// inputs.
    fn after_result(&self, other: Recorded) -> Recorded {
        let outputs: Vec<Id> = self.outputs.iter().chain(&other.outputs).copied().collect();
        Recorded::new(other.graph, other.inputs, &outputs)
    }

    /// Returns the result, and its derivative along a direction, which follows the input.
    pub(crate) fn jvp(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let direction = places(&mut graph, self.inputs, self.inputs);
        let tangents = match &self.by_hand {
            Some(gradient) => {
                let mut sum = graph.lit(0.0);
                for (&derivative, &t) in gradient.iter().zip(&direction) {
                    let term = graph.make(Node::Mul(derivative, t));
                    sum = graph.make(Node::Add(sum, term));
                }
                vec![sum]
            }
            None => forward(&mut graph, &self.outputs, &direction),
        };
        let outputs: Vec<Id> = self.outputs.iter().copied().chain(tangents).collect();
        Recorded::new(graph, 2 * self.inputs, &outputs)
    }

    /// Returns the derivative of the gradient along a direction, which follows the input.
    pub(crate) fn hvp(&self) -> Recorded {
        let (mut graph, gradient) = self.gradient();
        let direction = places(&mut graph, self.inputs, self.inputs);
        let curved = forward(&mut graph, &gradient, &direction);
        Recorded::new(graph, 2 * self.inputs, &curved)
    }

    /// Returns the derivative of the gradient along every axis, one after the other.
    pub(crate) fn hessian(&self) -> Recorded {
        let (mut graph, gradient) = self.gradient();
        let mut rows = Vec::with_capacity(self.inputs * self.inputs);
        for axis in 0..self.inputs {
            rows.extend(self.along(&mut graph, &gradient, axis));
        }
        Recorded::new(graph, self.inputs, &rows)
    }

    /// Returns the derivatives of all results by all numbers of the input: of the first result first.
    pub(crate) fn jacobian(&self) -> Recorded {
        // Backwards by results or forwards by inputs, whichever are fewer.
        let is_backwards = self.by_hand.is_some() || self.outputs.len() <= self.inputs;
        let both = match is_backwards {
            true => self.value_jacobian(),
            false => self.value_jacobian_forwards(),
        };
        both.without_first(self.outputs.len())
    }

    /// Returns the program without its first `count` results.
    pub(crate) fn without_first(&self, count: usize) -> Recorded {
        self.chosen(&(count..self.outputs.len()).collect::<Vec<_>>())
    }

    /// Returns the program with some of its results, by their places.
    pub(crate) fn chosen(&self, places: &[usize]) -> Recorded {
        let outputs: Vec<Id> = places.iter().map(|&place| self.outputs[place]).collect();
        Recorded::new(self.graph.clone(), self.inputs, &outputs)
    }

    /// Returns this program with a gradient by hand, a program with the same input.
    pub(crate) fn with_gradient(&self, gradient: &Recorded) -> Recorded {
        let mut made = self.clone();
        let mut ids: Vec<Id> = Vec::with_capacity(gradient.graph.len());
        for &node in gradient.graph.nodes() {
            let node = node.renamed(|x| ids[x as usize]);
            ids.push(made.graph.make(node));
        }
        let gradient = gradient.outputs.iter().map(|&x| ids[x as usize]);
        made.by_hand = Some(gradient.collect());
        made
    }

    /// Returns this program with a gradient by hand: the outputs after the result of another program with the same
    /// input.
    pub(crate) fn with_gradient_after_result(&self, value_grad: &Recorded) -> Recorded {
        let derivatives = &value_grad.outputs[self.outputs.len()..];
        let gradient = Recorded::new(value_grad.graph.clone(), self.inputs, derivatives);
        self.with_gradient(&gradient)
    }

    /// Returns a program of this graph with the gradient by hand as result.
    pub(crate) fn gradient_by_hand(&self) -> Option<Recorded> {
        let gradient = self.by_hand.as_ref()?;
        Some(Recorded::new(self.graph.clone(), self.inputs, gradient))
    }
}

/// Adds `count` further numbers of the input to a graph, and returns their indices.
fn places(graph: &mut Graph, from: usize, count: usize) -> Vec<Id> {
    (from..from + count)
        .map(|place| graph.push(Node::Input(place as u32)))
        .collect()
}

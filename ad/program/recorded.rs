//! Programs without the shapes of what goes in and out: lists of numbers.
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
    /// Which of its nodes results and their derivatives need.
    needed: Vec<bool>,
    /// How many numbers go in.
    pub(crate) inputs: usize,
    /// The results, none a zero with a sign.
    outputs: Vec<Id>,
    /// The gradient of the only result, where it was written by hand.
    by_hand: Option<Vec<Id>>,
    /// The graph without the nodes that only derivatives need.
    pub(crate) value: Lowered,
}

/// Operations in an order in which they can be carried out, without anything that values do not need.
#[derive(Clone, Debug)]
pub(crate) struct Lowered {
    pub(crate) graph: Graph,
    pub(crate) outputs: Vec<Id>,
}

impl Recorded {
    /// A program with these results.
    pub(crate) fn new(mut graph: Graph, inputs: usize, outputs: &[Id]) -> Self {
        let outputs: Vec<Id> = outputs
            .iter()
            .map(|&x| graph.make(Node::Canonical(x)))
            .collect();
        let (lowered, results) = graph.lowered(&outputs);
        Recorded {
            value: Lowered {
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

    /// The format of its numbers.
    pub(crate) fn format(&self) -> Format {
        self.graph.format
    }

    /// An error if a result depends on an infinite or NaN constant.
    pub(crate) fn finite(self) -> Result<Self, Unrecordable> {
        let live = self.graph.live(&self.outputs, true);
        let wild = (0..self.graph.len() as Id)
            .filter(|&x| live[x as usize])
            .any(|x| self.graph.constant(x).is_some_and(|x| !x.is_finite()));
        match wild {
            true => Err(Unrecordable::Constant),
            false => Ok(self),
        }
    }

    /// The results for an input, on plain numbers.
    pub(crate) fn run<T: Scalar>(&self, inputs: &[T]) -> Vec<T> {
        evaluate(&self.value.graph, &self.value.outputs, inputs)
    }

    /// The results for an input on any scalar, with its derivatives.
    pub(crate) fn run_on<S: Scalar>(&self, inputs: &[S]) -> Vec<S> {
        // Nodes that came later belong to a gradient.
        let needed = |i| self.needed.get(i) == Some(&true);
        evaluate_needed(&self.graph, needed, &self.outputs, inputs)
    }

    /// `true` if gradients by hand are parts of it, whose own derivatives duals of duals do not see.
    #[cfg(feature = "check")]
    pub(crate) fn has_parts_by_hand(&self) -> bool {
        let is_part = |node: &Node| matches!(node, Node::Graft { share: Some(_), .. });
        self.graph.nodes().iter().any(is_part)
    }

    /// A copy of the graph with the gradient added, and the nodes of the gradient's numbers.
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

    /// The result, a number, and its gradient.
    pub(crate) fn value_grad(&self) -> Recorded {
        let (graph, gradient) = self.gradient();
        let outputs: Vec<Id> = self.outputs.iter().copied().chain(gradient).collect();
        Recorded::new(graph, self.inputs, &outputs)
    }

    /// The pull-back: from an input and a cotangent of the result to the cotangent of the input.
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

    /// The result and the pull-back: from an input and a cotangent of the result to the result and the
    /// cotangent of the input.
    pub(crate) fn value_vjp(&self) -> Recorded {
        self.after_result(self.vjp())
    }

    /// The same with derivatives taken forwards, along one axis of the input after the other.
    pub(crate) fn value_vjp_forwards(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let seeds = places(&mut graph, self.inputs, self.outputs.len());
        let mut bars = Vec::with_capacity(self.inputs);
        for axis in 0..self.inputs {
            let mut sum = graph.lit(0.0);
            for (derivative, &seed) in self.along(&mut graph, axis).into_iter().zip(&seeds) {
                let term = graph.make(Node::Mul(seed, derivative));
                sum = graph.make(Node::Add(sum, term));
            }
            bars.push(sum);
        }
        let outputs: Vec<Id> = self.outputs.iter().copied().chain(bars).collect();
        Recorded::new(graph, self.inputs + seeds.len(), &outputs)
    }

    /// The result, a number, and its gradient, taken forwards.
    pub(crate) fn value_grad_forwards(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let mut outputs = self.outputs.clone();
        for axis in 0..self.inputs {
            let derivatives = self.along(&mut graph, axis);
            outputs.extend(derivatives);
        }
        Recorded::new(graph, self.inputs, &outputs)
    }

    /// The results, and then the gradient of each.
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

    /// The same with derivatives taken forwards, along one axis of the input after the other.
    pub(crate) fn value_jacobian_forwards(&self) -> Recorded {
        let mut graph = self.graph.clone();
        let columns: Vec<Vec<Id>> = (0..self.inputs)
            .map(|axis| self.along(&mut graph, axis))
            .collect();
        let rows = (0..self.outputs.len()).flat_map(|k| columns.iter().map(move |own| own[k]));
        let outputs: Vec<Id> = self.outputs.iter().copied().chain(rows).collect();
        Recorded::new(graph, self.inputs, &outputs)
    }

    /// The same of a program that is a result and its pull-back, of so many results: the pull-back of every axis of the
    /// result.
    pub(crate) fn value_jacobian_of_vjp(&self, results: usize) -> Recorded {
        let inputs = self.inputs - results;
        let mut graph = Graph::new(self.format());
        let (mut outputs, mut rows) = (Vec::new(), Vec::new());
        for axis in 0..results {
            let mut names: Vec<Id> = Vec::with_capacity(self.graph.len());
            for &node in self.graph.nodes() {
                names.push(match node {
                    Node::Input(place) if place as usize >= inputs => {
                        let is_axis = place as usize == inputs + axis;
                        graph.lit(f64::from(u8::from(is_axis)))
                    }
                    node => graph.make(node.renamed(|x| names[x as usize])),
                });
            }
            let renamed = |&x: &Id| names[x as usize];
            if axis == 0 {
                outputs.extend(self.outputs[..results].iter().map(renamed));
            }
            rows.extend(self.outputs[results..].iter().map(renamed));
        }
        Recorded::new(graph, inputs, &[outputs, rows].concat())
    }

    /// The derivatives of all results along an axis of the input.
    fn along(&self, graph: &mut Graph, axis: usize) -> Vec<Id> {
        let (zero, one) = (graph.lit(0.0), graph.lit(1.0));
        let mut direction = vec![zero; self.inputs];
        direction[axis] = one;
        forward(graph, &self.outputs, &direction)
    }

    /// The result, followed by the results of another program of the same input.
    fn after_result(&self, other: Recorded) -> Recorded {
        let outputs: Vec<Id> = self.outputs.iter().chain(&other.outputs).copied().collect();
        Recorded::new(other.graph, other.inputs, &outputs)
    }

    /// The result, and its derivative along a direction, which follows the input.
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

    /// The derivative of the gradient along a direction, which follows the input.
    pub(crate) fn hvp(&self) -> Recorded {
        let (mut graph, gradient) = self.gradient();
        let direction = places(&mut graph, self.inputs, self.inputs);
        let curved = forward(&mut graph, &gradient, &direction);
        Recorded::new(graph, 2 * self.inputs, &curved)
    }

    /// The derivative of the gradient along every axis, one after the other.
    pub(crate) fn hessian(&self) -> Recorded {
        let (mut graph, gradient) = self.gradient();
        let mut rows = Vec::with_capacity(self.inputs * self.inputs);
        for axis in 0..self.inputs {
            let (zero, one) = (graph.lit(0.0), graph.lit(1.0));
            let mut direction = vec![zero; self.inputs];
            direction[axis] = one;
            rows.extend(forward(&mut graph, &gradient, &direction));
        }
        Recorded::new(graph, self.inputs, &rows)
    }

    /// The derivatives of all results by all numbers of the input: of the first result first.
    pub(crate) fn jacobian(&self) -> Recorded {
        if self.by_hand.is_some() {
            let (graph, gradient) = self.gradient();
            return Recorded::new(graph, self.inputs, &gradient);
        }
        let mut graph = self.graph.clone();
        let mut rows = Vec::with_capacity(self.outputs.len() * self.inputs);
        if self.outputs.len() <= self.inputs {
            let one = graph.lit(1.0);
            for output in &self.outputs {
                rows.extend(reverse(
                    &mut graph,
                    std::slice::from_ref(output),
                    &[one],
                    self.inputs,
                ));
            }
        } else {
            let axes = (0..self.inputs).map(|axis| self.along(&mut graph, axis));
            let columns: Vec<Vec<Id>> = axes.collect();
            for k in 0..self.outputs.len() {
                rows.extend(columns.iter().map(|column| column[k]));
            }
        }
        Recorded::new(graph, self.inputs, &rows)
    }

    /// The same without the first so many results.
    pub(crate) fn without_first(&self, count: usize) -> Recorded {
        Recorded::new(self.graph.clone(), self.inputs, &self.outputs[count..])
    }

    /// The same with a gradient by hand, a program with the same input.
    pub(crate) fn with_gradient(&self, gradient: &Recorded) -> Recorded {
        let mut made = self.clone();
        let mut names: Vec<Id> = Vec::with_capacity(gradient.graph.len());
        for &node in gradient.graph.nodes() {
            let node = node.renamed(|x| names[x as usize]);
            names.push(made.graph.make(node));
        }
        let gradient = gradient.outputs.iter().map(|&x| names[x as usize]);
        made.by_hand = Some(gradient.collect());
        made
    }

    /// The same with a gradient by hand that another program of the same input gives after the result.
    pub(crate) fn with_gradient_after_result(&self, value_grad: &Recorded) -> Recorded {
        let derivatives = &value_grad.outputs[self.outputs.len()..];
        let gradient = Recorded::new(value_grad.graph.clone(), self.inputs, derivatives);
        self.with_gradient(&gradient)
    }

    /// The same graph with the gradient by hand as result.
    pub(crate) fn gradient_by_hand(&self) -> Option<Recorded> {
        let gradient = self.by_hand.as_ref()?;
        Some(Recorded::new(self.graph.clone(), self.inputs, gradient))
    }
}

/// So many further places of the input.
fn places(graph: &mut Graph, from: usize, count: usize) -> Vec<Id> {
    (from..from + count)
        .map(|place| graph.push(Node::Input(place as u32)))
        .collect()
}

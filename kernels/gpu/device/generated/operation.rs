//! What a GPU is given of an operation or a program: a function in WGSL, and what the processor prepares.
use crate::Error;
use crate::ad::program::graph::{Graph, Id, Node};
use crate::ad::program::recorded::Recorded;
use crate::ad::program::wgsl::function_of;
use crate::kernels::cpu::plan::{List, Preparation, Want, prepared};
use crate::kernels::cpu::program::split::{Piece, split};
use crate::kernels::real::Real;
use crate::kernels::row::Leaf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// An operation, or a program, for GPUs: made once, compiled once per context.
pub struct Generated<T> {
    pub(super) name: Name,
    /// For every shape that it takes, how it is checked and prepared.
    pub(super) arguments: Vec<Preparation<T>>,
    /// Numbers per item that the function takes of every argument and then of every cotangent.
    pub(super) widths: Vec<usize>,
    /// Numbers of every shape that it gives.
    pub(super) gives: Vec<usize>,
    /// Functions in WGSL: the whole, and for all pairs the slopes with respect to each argument.
    pub(super) bodies: Vec<Body>,
}

/// A function in WGSL, called `body`.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub text: String,
    /// How many operations it has.
    pub operations: usize,
    /// How many numbers it gives.
    pub gives: usize,
}

/// Sines of an angle: what the processor computes at upload, in double precision, for the same numbers as
/// its own batches start from.
fn is_sine(node: Node) -> bool {
    use Node::*;
    matches!(
        node,
        Sin(_) | Cos(_) | SinHigh(_) | SinLow(_) | CosHigh(_) | CosLow(_)
    )
}

/// A piece as a function of so many numbers. It takes one at least: there are no arrays of none.
pub(super) fn body_of(name: &str, piece: &Piece, inputs: usize) -> Body {
    Body {
        text: function_of(name, &piece.graph, &piece.outputs, inputs.max(1)),
        operations: piece.graph.len(),
        gives: piece.outputs.len(),
    }
}

/// The part of a piece that some of its results need.
pub(super) fn part(piece: &Piece, outputs: &[Id]) -> Piece {
    let live = piece.graph.live(outputs, false);
    let mut graph = Graph::new(piece.graph.format);
    let mut names = vec![0; piece.graph.len()];
    for x in (0..piece.graph.len()).filter(|&x| live[x]) {
        names[x] = graph.push(piece.graph.at(x as Id).renamed(|y| names[y as usize]));
    }
    Piece {
        outputs: outputs.iter().map(|&x| names[x as usize]).collect(),
        graph,
    }
}

/// A name that nothing else has, by which pipelines are kept as long as there is somebody of that name.
#[derive(Clone, Debug)]
pub(super) struct Name(pub Arc<u64>);

impl Default for Name {
    fn default() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        Name(Arc::new(NEXT.fetch_add(1, Ordering::Relaxed)))
    }
}

impl<T: Real> Generated<T> {
    /// Of a recorded function. `framed` says that it is for all pairs, where what depends on one shape
    /// alone is computed once per shape.
    pub(crate) fn new(
        want: Want,
        leaves: Vec<Leaf<T>>,
        outputs: Vec<usize>,
        recorded: &Recorded,
        framed: bool,
    ) -> Result<Self, Error> {
        let fields: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
        let mut arguments: Vec<_> = leaves.into_iter().map(Preparation::plain).collect();
        let mut all = fields.clone();
        if want == Want::Vjp {
            all.extend(&outputs);
        }
        let (graph, results) = (&recorded.value.graph, &recorded.value.outputs);
        // Of slopes the result comes first, which nobody asks for.
        let skipped = match want {
            Want::Value | Want::ValueGrad => 0,
            Want::Vjp => outputs.iter().sum(),
        };
        let results = &results[skipped..];
        let is_prepared = |node| framed || matches!(node, Node::Input(_)) || is_sine(node);
        let parts = split(graph, &all, arguments.len(), results, is_prepared);
        for ((argument, frame), &own) in arguments.iter_mut().zip(&parts.frames).zip(&fields) {
            argument.frame = match is_whole(frame, own) {
                true => None,
                false if frame.outputs.is_empty() => Some((0, Arc::new(|_, _| ()))),
                false => Some(prepared(frame, own)?),
            };
        }
        let (widths, body) = (parts.widths, parts.body);
        let inputs = widths.iter().sum();
        let mut bodies = vec![body_of("body", &body, inputs)];
        if framed && want == Want::Vjp {
            let mut first = 0;
            for own in &fields {
                let own = &body.outputs[first..first + own];
                bodies.push(body_of("body", &part(&body, own), inputs));
                first += own.len();
            }
        }
        let gives = match want {
            Want::Value => outputs,
            Want::ValueGrad => [outputs, fields].concat(),
            Want::Vjp => fields,
        };
        Ok(Generated {
            name: Name::default(),
            arguments,
            widths,
            gives,
            bodies,
        })
    }

    /// The prepared numbers of some shapes of an argument or cotangent, in tiles.
    pub(super) fn prepare(&self, k: usize, numbers: &[T]) -> Vec<T> {
        let plain;
        let plan = match self.arguments.get(k) {
            Some(plan) => plan,
            None => {
                plain = Preparation::plain(Leaf {
                    fields: self.widths[k],
                    check: |_| Ok(()),
                });
                &plain
            }
        };
        crate::kernels::cpu::arch::flat(&List::new(plan, numbers, false, false).frames).to_vec()
    }
}

/// Whether a frame is all numbers of a shape, as they are.
fn is_whole(frame: &Piece, fields: usize) -> bool {
    let input = |(k, &x): (usize, &Id)| frame.graph.at(x) == Node::Input(k as u32);
    frame.outputs.len() == fields && frame.outputs.iter().enumerate().all(input)
}

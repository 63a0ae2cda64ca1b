//! An operation or a program for a GPU: a function in WGSL, and the shapes as the processor prepares them.
use crate::ad::program::WGSL;
use crate::ad::program::graph::{Graph, Id, Node};
use crate::ad::program::recorded::Recorded;
use crate::ad::program::wgsl::{Taken, exact, function_of};
use crate::error::Field;
use crate::kernels::cpu::plan::makers::prepared;
use crate::kernels::cpu::plan::{List, Preparation, Shapes, name};
use crate::kernels::cpu::program::split::{Piece, split};
use crate::kernels::machine::Column;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::{Leaf, Quick};
use crate::{Error, Real};
use std::iter::repeat;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock};

/// Boxes that have bodies by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    /// [`Obb2`](crate::Obb2).
    Rotated,
    /// [`Aabb2`](crate::Aabb2).
    AxisAligned,
}

impl Kind {
    /// Returns the name of its prepared boxes, whatever the score.
    fn prepared(self) -> Name {
        static NAMES: LazyLock<[Name; 2]> = LazyLock::new(Default::default);
        NAMES[self as usize].clone()
    }
}

/// An operation, or a program, for GPUs: made once, compiled once per context.
pub struct Generated<T> {
    pub(super) name: Name,
    /// The boxes of a body by hand.
    pub(super) kind: Option<Kind>,
    /// The WGSL functions that its bodies call.
    pub(super) head: String,
    /// For every shape that it takes, how it is checked and prepared.
    pub(super) arguments: Vec<Preparation<T>>,
    /// Numbers per item that the function takes of every argument and then of every cotangent.
    pub(super) widths: Vec<usize>,
    /// Numbers of every shape that it gives.
    pub(super) gives: Vec<usize>,
    /// Functions in WGSL: the whole, and for all pairs the derivatives with respect to each argument.
    pub(super) bodies: Vec<Body>,
    /// The same for shapes plain products of whose numbers over- or underflow; `None` where one body serves all.
    pub(super) extreme: Option<Arc<Self>>,
}

/// A function in WGSL.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// Its name.
    pub entry: &'static str,
    pub text: String,
    /// How many operations it has.
    pub operations: usize,
    /// How many numbers it gives.
    pub gives: usize,
}

/// Returns `true` for sines of an angle. The processor computes them at upload, in double precision, for the same
/// numbers as its own batches start from.
fn is_sine(node: Node) -> bool {
    use Node::*;
    matches!(
        node,
        Sin(_) | Cos(_) | SinHigh(_) | SinLow(_) | CosHigh(_) | CosLow(_)
    )
}

/// Returns a piece as a function of so many numbers. It takes one at least: there are no arrays of none.
pub(super) fn body_of(name: &'static str, piece: &Piece, inputs: usize, taken: &[Taken]) -> Body {
    Body {
        entry: name,
        text: function_of(name, &piece.graph, &piece.outputs, inputs.max(1), taken),
        operations: piece.graph.len(),
        gives: piece.outputs.len(),
    }
}

/// Returns the part of a piece that some of its results need.
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

/// A name that nothing else has; pipelines are kept as long as it lives.
#[derive(Clone, Debug)]
pub(super) struct Name(pub Arc<u64>);

impl Default for Name {
    fn default() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        Name(Arc::new(NEXT.fetch_add(1, Ordering::Relaxed)))
    }
}

impl<T: Real> Generated<T> {
    /// With the names that an operation has for its arguments.
    pub(crate) fn named(mut self, names: &[&'static str]) -> Self {
        name(&mut self.arguments, names);
        self
    }
    /// Returns the code of a recorded function. If `framed` is set it is for all pairs: numbers that depend on one
    /// shape alone are computed once per shape.
    pub(crate) fn new(
        mode: Mode,
        leaves: Vec<Leaf<T>>,
        outputs: Vec<usize>,
        recorded: &Recorded,
        framed: bool,
    ) -> Result<Self, Error> {
        let fields: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
        let fields_named = leaves.iter().zip(LETTERS.chars()).map(|(leaf, letter)| {
            let name = |i: usize| format!("{letter}.{}", (leaf.name)(i));
            (0..leaf.fields).map(name).collect::<Vec<_>>()
        });
        let fields_named: Vec<Vec<String>> = fields_named.collect();
        let mut arguments: Vec<_> = leaves.into_iter().map(Preparation::plain).collect();
        let mut all = fields.clone();
        if mode == Mode::Vjp {
            all.extend(&outputs);
        }
        let (graph, results) = (&recorded.value.graph, &recorded.value.outputs);
        // The result comes before its derivatives; the adjoint leaves it out.
        let skipped = mode.skipped(&outputs);
        let results = &results[skipped..];
        let is_prepared = |node| framed || matches!(node, Node::Input(_)) || is_sine(node);
        let parts = split(graph, &all, arguments.len(), results, is_prepared);
        let prepared_named = parts
            .frames
            .iter()
            .zip(&fields_named)
            .flat_map(|(frame, fields)| {
                let name = |&x: &Id| described(&frame.graph, x, fields);
                frame.outputs.iter().map(name).collect::<Vec<_>>()
            });
        let bars = (0..outputs.iter().sum()).map(|k| format!("out_bar.{k}"));
        let names = unlike(prepared_named.chain(bars));
        let is_exact = parts.frames.iter().flat_map(|frame| {
            let exact = exact(&frame.graph, &[]);
            let is = |&x: &Id| exact[x as usize];
            frame.outputs.iter().map(is).collect::<Vec<_>>()
        });
        let taken = names.into_iter().zip(is_exact.chain(repeat(false)));
        let taken: Vec<_> = taken
            .map(|(name, is_exact)| Taken { name, is_exact })
            .collect();
        for ((argument, frame), &own) in arguments.iter_mut().zip(&parts.frames).zip(&fields) {
            argument.frame = match is_whole(frame, own) {
                true => None,
                false if frame.outputs.is_empty() => Some((0, Arc::new(|_, _| ()))),
                false => Some(prepared(frame, own)?),
            };
        }
        let (widths, body) = (parts.widths, parts.body);
        let inputs = widths.iter().sum();
        let mut bodies = vec![body_of("body", &body, inputs, &taken)];
        if framed && mode == Mode::Vjp {
            let mut first = 0;
            for own in &fields {
                let own = &body.outputs[first..first + own];
                bodies.push(body_of("body", &part(&body, own), inputs, &taken));
                first += own.len();
            }
        }
        let gives = mode.gives(&fields, &outputs);
        Ok(Generated {
            name: Name::default(),
            kind: None,
            head: format!("{WGSL}\n"),
            arguments,
            widths,
            gives,
            bodies,
            extreme: None,
        })
    }

    /// Returns the key of prepared shapes of an argument, and whose they are. Bodies by hand of the same boxes share
    /// them.
    pub(super) fn prepared(&self, k: usize) -> ((u64, usize), Name) {
        let (name, k) = match self.kind {
            Some(kind) => (kind.prepared(), 0),
            None => (self.name.clone(), k),
        };
        ((*name.0, k), name)
    }

    /// Returns `true` if plain products of numbers of these shapes may over- or underflow, and a body knows of it.
    pub(super) fn is_extreme(&self, k: usize, numbers: &[T]) -> bool {
        let preparation = &self.arguments[k];
        self.extreme.is_some()
            && !(preparation.all_ordinary)(numbers)
            && numbers
                .chunks_exact(preparation.fields)
                .any(preparation.is_rare)
    }

    /// Returns the prepared numbers of some shapes of an argument, shape by shape, each a multiple of four.
    pub(super) fn prepare_rows(&self, k: usize, numbers: &[T]) -> Vec<T> {
        let preparation = &self.arguments[k];
        let count = numbers.len().checked_div(preparation.fields).unwrap_or(0);
        let column = Column::lent(numbers, preparation.fields, Some(count));
        let list = List::new(preparation, Shapes::of(&column), false, false);
        crate::kernels::cpu::arch::flat(&list.picking()).to_vec()
    }

    /// Returns the prepared numbers of some shapes of an argument or cotangent, in tiles.
    pub(super) fn prepare(&self, k: usize, numbers: &[T]) -> Vec<T> {
        let plain;
        let preparation = match self.arguments.get(k) {
            Some(preparation) => preparation,
            None => {
                plain = Preparation::plain(Leaf {
                    shape: || "",
                    fields: self.widths[k],
                    codes: 0,
                    name: |_| Field::VALUE,
                    check: |_| Ok(()),
                    quick: Quick::Always,
                    rules: &[],
                });
                &plain
            }
        };
        let count = numbers.len().checked_div(preparation.fields).unwrap_or(0);
        let column = Column::lent(numbers, preparation.fields, Some(count));
        let list = List::new(preparation, Shapes::of(&column), false, false);
        crate::kernels::cpu::arch::flat(&list.frames).to_vec()
    }
}

/// The letters of arguments.
const LETTERS: &str = "abcdefghijklmnopqrstuvwxyz";

/// Returns the description of a prepared number, if it is short.
fn described(graph: &Graph, x: Id, fields: &[String]) -> String {
    let of = |what: &str, x: Id| format!("{} {what}", described(graph, x, fields));
    let made = || {
        let letter = fields.first().map_or("", |field| &field[..1]);
        format!("{letter} made")
    };
    match graph.at(x) {
        Node::Input(k) => fields.get(k as usize).cloned().unwrap_or_default(),
        Node::Sin(x) => of("sin", x),
        Node::Cos(x) => of("cos", x),
        Node::SinHigh(x) => of("sin high", x),
        Node::SinLow(x) => of("sin low", x),
        Node::CosHigh(x) => of("cos high", x),
        Node::CosLow(x) => of("cos low", x),
        Node::Neg(x) => of("negative", x),
        Node::Mul(x, half) if graph.constant(half) == Some(0.5) => of("halved", x),
        Node::Mul(half, x) if graph.constant(half) == Some(0.5) => of("halved", x),
        _ => made(),
    }
}

/// Descriptions as names that WGSL accepts, no two of them the same.
fn unlike(all: impl Iterator<Item = String>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for described in all {
        let parts = described.split(|c: char| !c.is_ascii_alphanumeric());
        let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
        let name = parts.join("_");
        let is_taken = |name: &String| names.contains(name) || !name.contains('_');
        let mut own = name.clone();
        let mut count = 1;
        while is_taken(&own) {
            count += 1;
            own = format!("{name}_{count}");
        }
        names.push(own);
    }
    names
}

/// Returns `true` if a frame is all numbers of a shape, as they are.
fn is_whole(frame: &Piece, fields: usize) -> bool {
    let input = |(k, &x): (usize, &Id)| frame.graph.at(x) == Node::Input(k as u32);
    frame.outputs.len() == fields && frame.outputs.iter().enumerate().all(input)
}

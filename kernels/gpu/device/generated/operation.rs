//! An operation or a program for a GPU: a function in WGSL, and the preparation of shapes on the CPU.
use crate::ad::program::WGSL;
use crate::ad::program::graph::{Graph, Id, Node};
use crate::ad::program::recorded::Recorded;
use crate::ad::program::wgsl::{Taken, exact, function_of};
use crate::error::Field;
use crate::kernels::cpu::plan::makers::prepared;
use crate::kernels::cpu::plan::{List, Preparation, Shapes, name};
use crate::kernels::cpu::program::split::{Subgraph, split};
use crate::kernels::machine::Column;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::{Leaf, Quick};
use crate::{Error, Real};
use std::iter::repeat;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock};

/// The kinds of boxes that have bodies by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum BoxKind {
    /// [`Obb2`](crate::Obb2).
    Rotated,
    /// [`Aabb2`](crate::Aabb2).
    AxisAligned,
}

impl BoxKind {
    /// Returns the name of the prepared boxes, which all scores share.
    fn prepared(self) -> ProgramName {
        static NAMES: LazyLock<[ProgramName; 2]> = LazyLock::new(Default::default);
        NAMES[self as usize].clone()
    }
}

/// An operation, or a program, for GPUs: made once, compiled once per context.
pub struct Generated<T> {
    pub(super) name: ProgramName,
    /// The kind of boxes of a body by hand.
    pub(super) kind: Option<BoxKind>,
    /// The WGSL functions that its bodies call.
    pub(super) head: String,
    /// For every argument, its checks and its preparation.
    pub(super) arguments: Vec<Preparation<T>>,
    /// The number of scalars that the function takes of every argument and then of every cotangent, per item.
    pub(super) widths: Vec<usize>,
    /// The number of scalars of every shape in a result.
    pub(super) gives: Vec<usize>,
    /// The WGSL functions: one for the whole result, and for all pairs one for the derivatives with respect to each
    /// argument.
    pub(super) bodies: Vec<ShaderBody>,
    /// The code for shapes whose plain products overflow or underflow; `None` if one body serves all.
    pub(super) extreme: Option<Arc<Self>>,
}

/// A function in WGSL.
#[derive(Clone, Debug)]
pub(super) struct ShaderBody {
    /// The name of the function.
    pub entry: &'static str,
    pub text: String,
    /// The number of operations.
    pub operations: usize,
    /// The number of scalars of the result.
    pub gives: usize,
}

/// Returns `true` for sines of an angle. The CPU computes them at upload, in double precision, from the numbers that
/// its own batches use.
fn is_sine(node: Node) -> bool {
    use Node::*;
    matches!(
        node,
        Sin(_) | Cos(_) | SinHigh(_) | SinLow(_) | CosHigh(_) | CosLow(_)
    )
}

/// Writes a piece as a function of `inputs` numbers. It has at least one, since WGSL has no empty arrays.
pub(super) fn body_of(
    name: &'static str,
    piece: &Subgraph,
    inputs: usize,
    taken: &[Taken],
) -> ShaderBody {
    ShaderBody {
        entry: name,
        text: function_of(name, &piece.graph, &piece.outputs, inputs.max(1), taken),
        operations: piece.graph.len(),
        gives: piece.outputs.len(),
    }
}

/// Returns the part of a piece that `outputs` need.
pub(super) fn part(piece: &Subgraph, outputs: &[Id]) -> Subgraph {
    let live = piece.graph.live(outputs, false);
    let mut graph = Graph::new(piece.graph.format);
    let mut names = vec![0; piece.graph.len()];
    for x in (0..piece.graph.len()).filter(|&x| live[x]) {
        names[x] = graph.push(piece.graph.at(x as Id).renamed(|y| names[y as usize]));
    }
    Subgraph {
        outputs: outputs.iter().map(|&x| names[x as usize]).collect(),
        graph,
    }
}

/// A unique name; pipelines are kept as long as it lives.
#[derive(Clone, Debug)]
pub(super) struct ProgramName(pub Arc<u64>);

impl Default for ProgramName {
    fn default() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        ProgramName(Arc::new(NEXT.fetch_add(1, Ordering::Relaxed)))
    }
}

impl<T: Real> Generated<T> {
    /// Sets the names that an operation has for its arguments.
    pub(crate) fn named(mut self, names: &[&'static str]) -> Self {
        name(&mut self.arguments, names);
        self
    }
    /// Writes the code of a recorded function. If `framed`, it is for all pairs: numbers that depend on one shape alone
    /// are computed once per shape.
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
        // In outputs the value comes before its derivatives; the adjoint omits it.
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
            name: ProgramName::default(),
            kind: None,
            head: format!("{WGSL}\n"),
            arguments,
            widths,
            gives,
            bodies,
            extreme: None,
        })
    }

    /// Returns the key of the prepared shapes of an argument, and the name that owns them. Bodies by hand of one kind
    /// of boxes share them.
    pub(super) fn prepared(&self, k: usize) -> ((u64, usize), ProgramName) {
        let (name, k) = match self.kind {
            Some(kind) => (kind.prepared(), 0),
            None => (self.name.clone(), k),
        };
        ((*name.0, k), name)
    }

    /// Returns `true` if plain products of these shapes may overflow or underflow, and there is a body for this case.
    pub(super) fn is_extreme(&self, k: usize, numbers: &[T]) -> bool {
        let preparation = &self.arguments[k];
        self.extreme.is_some()
            && !preparation.are_ordinary(numbers)
            && numbers
                .chunks_exact(preparation.fields)
                .any(preparation.is_rare)
    }

    /// Returns the prepared numbers of some shapes of an argument, shape by shape, each padded to a multiple of four.
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
                    axis_bounds: |_| Vec::new(),
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

/// The letters that name arguments.
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

/// Turns descriptions into unique WGSL identifiers.
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

/// Returns `true` if a frame consists of all numbers of a shape, unchanged.
fn is_whole(frame: &Subgraph, fields: usize) -> bool {
    let input = |(k, &x): (usize, &Id)| frame.graph.at(x) == Node::Input(k as u32);
    frame.outputs.len() == fields && frame.outputs.iter().enumerate().all(input)
}

//! Recorded programs, and functions that are computed item by item, as makers of blocks.
use super::computation::{Face, Maker, Preparation, Prepare};
use crate::Real;
use crate::ad::program::graph::{Graph, Id};
use crate::ad::program::recorded::Recorded;
use crate::error::Error;
use crate::kernels::cpu::lane::{Lane, Results, TILE, Tiles};
use crate::kernels::cpu::program::Interpreted;
use crate::kernels::cpu::program::split::{Piece, split};
use crate::kernels::derivation::{Mode, Replays};
use crate::kernels::item::Leaf;
use crate::kernels::recording::{Recording, Searched};
use std::sync::Arc;

/// How a recorded program is computed. Its inputs are the numbers of its arguments and then those of
/// cotangents. For all pairs what is made of one argument alone is made once per shape.
pub(crate) fn of_recorded<T: Real>(
    mode: Mode,
    leaves: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    recorded: &Recorded,
    framed: bool,
) -> Result<Face<T>, Error> {
    let mut fields: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
    let mut arguments: Vec<_> = leaves.into_iter().map(Preparation::plain).collect();
    if mode == Mode::Vjp {
        fields.extend(&outputs);
    }
    let value = &recorded.value;
    let maker = |graph: &Graph, fields: &[usize], outputs: &[Id], skipping| {
        Interpreted::new(graph, fields, outputs, skipping).map_err(Error::Program)
    };
    let body = match framed {
        false => maker(&value.graph, &fields, &value.outputs, false)?,
        true => {
            // Cotangents come as they are.
            let (graph, own) = (&value.graph, arguments.len());
            let parts = split(graph, &fields, own, &value.outputs, |_| true);
            for ((argument, frame), &own) in arguments.iter_mut().zip(&parts.frames).zip(&fields) {
                argument.frame = Some(prepared(frame, own)?);
            }
            maker(&parts.body.graph, &parts.widths, &parts.body.outputs, true)?
        }
    };
    Ok(Face::new(mode, arguments, outputs, Box::new(body)))
}

/// How frames are made of shapes of so many numbers, and how many numbers those have.
pub(crate) fn prepared<T: Real>(
    frame: &Piece,
    fields: usize,
) -> Result<(usize, Prepare<T>), Error> {
    let made = Interpreted::new(&frame.graph, &[fields], &frame.outputs, false);
    let made = made.map_err(Error::Program)?;
    let prepare = move |shapes: Tiles<'_, T>, frames: &mut [Lane<T>]| {
        made.prepare(&[shapes], frames);
    };
    Ok((frame.outputs.len(), Arc::new(prepare)))
}

/// Something that computes one item: its numbers, the cotangent of its result or nothing, and room for
/// a result, or for a result and derivatives.
pub type Each<T> = fn(&[T], Option<&[T]>, &mut [T]);

/// Computes item by item.
struct Items<T> {
    each: Each<T>,
    /// Numbers of every shape that it takes, of all of them, of every cotangent, and put down per item.
    arguments: Vec<usize>,
    taken: usize,
    cotangents: Vec<usize>,
    made: usize,
}

/// Numbers of an item of a tile.
fn item<T: Copy>(input: &Tiles<'_, T>, t: usize, i: usize, fields: usize, numbers: &mut Vec<T>) {
    let tile = input.lanes[t * input.step..].iter().take(fields);
    numbers.extend(tile.map(|lane| lane.0[i]));
}

impl<T: Real> Maker<T> for Items<T> {
    fn make(&self, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        let (shapes, cotangents) = inputs.split_at(self.arguments.len());
        let (mut numbers, mut seed) = (Vec::with_capacity(self.taken), Vec::new());
        let mut one = vec![T::default(); self.made];
        for t in 0..out.tiles {
            for i in 0..TILE {
                numbers.clear();
                seed.clear();
                for (shape, &fields) in shapes.iter().zip(&self.arguments) {
                    item(shape, t, i, fields, &mut numbers);
                }
                for (cotangent, &fields) in cotangents.iter().zip(&self.cotangents) {
                    item(cotangent, t, i, fields, &mut seed);
                }
                (self.each)(&numbers, (!seed.is_empty()).then_some(&seed), &mut one);
                for (k, &x) in one.iter().enumerate() {
                    if let Some(lane) = out.lane(t, k) {
                        lane.0[i] = x.canonical();
                    }
                }
            }
        }
    }
}

/// How an operation is computed item by item.
pub(crate) fn of_items<T: Real>(
    mode: Mode,
    leaves: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    each: Each<T>,
) -> Face<T> {
    let arguments: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
    let (taken, result): (usize, usize) = (arguments.iter().sum(), outputs.iter().sum());
    let made = match mode {
        Mode::Value => result,
        Mode::ValueGrad | Mode::Vjp => result + taken,
        Mode::Jacobian => result + result * taken,
    };
    let items = Items {
        each,
        arguments,
        taken,
        cotangents: outputs.clone(),
        made,
    };
    let plans = leaves.into_iter().map(Preparation::plain).collect();
    Face::new(mode, plans, outputs, Box::new(items))
}

/// Decides item by item, and computes the program of the record.
struct ReplayedItems<T> {
    replays: Arc<dyn Replays<T>>,
    /// Numbers of every shape, direction and cotangent that it takes, and put down per item.
    fields: Vec<usize>,
    made: usize,
}

impl<T: Real> Maker<T> for ReplayedItems<T> {
    fn make(&self, inputs: &[Tiles<'_, T>], mut out: Results<'_, T>) {
        let (mut numbers, mut taken) = (Vec::new(), Vec::new());
        let mut one = vec![T::default(); self.made];
        for t in 0..out.tiles {
            for i in 0..TILE {
                numbers.clear();
                taken.clear();
                for (input, &fields) in inputs.iter().zip(&self.fields) {
                    item(input, t, i, fields, &mut numbers);
                }
                match self.replays.decide(&numbers, &mut taken) {
                    Ok(recorded) => self
                        .replays
                        .put(&numbers, &recorded.run_on(&taken), &mut one),
                    // A replay too long to record has no derivatives.
                    Err(_) => one.fill(T::lit(f64::NAN)),
                }
                for (k, &x) in one.iter().enumerate() {
                    if let Some(lane) = out.lane(t, k) {
                        lane.0[i] = x.canonical();
                    }
                }
            }
        }
    }
}

/// How a derivative of a search is computed: by the replays, which give no result before derivatives.
pub(crate) fn of_replays<T: Real>(
    mode: Mode,
    recording: &Recording<T>,
    search: &Searched<T>,
) -> Face<T> {
    let (takes, outputs) = (&recording.takes, &recording.outputs);
    let mut fields: Vec<usize> = takes.iter().map(|leaf| leaf.fields).collect();
    let gives = search.gives(mode, &fields, outputs);
    if mode == Mode::Vjp {
        fields.extend(outputs);
    }
    let items = ReplayedItems {
        replays: search.replays(mode),
        fields,
        made: gives.iter().sum(),
    };
    let plans = takes.iter().cloned().map(Preparation::plain).collect();
    Face {
        skipped: 0,
        gives,
        ..Face::new(mode, plans, outputs.clone(), Box::new(items))
    }
}

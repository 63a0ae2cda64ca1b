//! Recorded programs, and functions that are computed item by item, as makers of blocks.
use super::computation::{Plan, Preparation, Prepare};
use crate::Real;
use crate::ad::program::graph::{Graph, Id};
use crate::ad::program::recorded::Recorded;
use crate::error::Error;
use crate::kernels::call::recording::{Each, Recording, Searched};
use crate::kernels::cpu::lane::{Lane, Results, TILE, Tiles};
use crate::kernels::cpu::maker::Maker;
use crate::kernels::cpu::program::split::{Piece, split};
use crate::kernels::cpu::program::{Interpreted, Skipping};
use crate::kernels::row::derivation::{Mode, Replays};
use crate::kernels::row::item::Leaf;
use std::sync::Arc;

/// How a recorded program is computed. Its inputs are the numbers of its arguments and then those of
/// cotangents. For all pairs what is made of one argument alone is made once per shape.
pub(crate) fn of_recorded<T: Real>(
    mode: Mode,
    leaves: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    recorded: &Recorded,
    framed: bool,
) -> Result<Plan<T>, Error> {
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
        false => maker(&value.graph, &fields, &value.outputs, Skipping::Much)?,
        true => {
            // Cotangents come as they are.
            let (graph, own) = (&value.graph, arguments.len());
            let parts = split(graph, &fields, own, &value.outputs, |_| true);
            for ((argument, frame), &own) in arguments.iter_mut().zip(&parts.frames).zip(&fields) {
                argument.frame = Some(prepared(frame, own)?);
            }
            let body = &parts.body;
            maker(&body.graph, &parts.widths, &body.outputs, Skipping::Any)?
        }
    };
    Ok(Plan::new(mode, arguments, outputs, Box::new(body)))
}

/// How frames are made of shapes of so many numbers, and how many numbers those have.
pub(crate) fn prepared<T: Real>(
    frame: &Piece,
    fields: usize,
) -> Result<(usize, Prepare<T>), Error> {
    let made = Interpreted::new(&frame.graph, &[fields], &frame.outputs, Skipping::Never);
    let made = made.map_err(Error::Program)?;
    let prepare = move |shapes: Tiles<'_, T>, frames: &mut [Lane<T>]| {
        made.prepare(&[shapes], frames);
    };
    Ok((frame.outputs.len(), Arc::new(prepare)))
}

/// Computes item by item.
struct Items<T> {
    each: Each<T>,
    /// Numbers of every shape, then of every cotangent.
    fields: Vec<usize>,
    /// Numbers of all shapes.
    taken: usize,
    /// Numbers of results per item.
    made: usize,
}

/// Computes tiles of results item by item, each from its numbers, input after input.
///
/// An item that is the one before has its results: what fills up a last tile repeats the last item.
fn by_item<T: Real>(
    inputs: &[Tiles<'_, T>],
    fields: &[usize],
    made: usize,
    mut out: Results<'_, T>,
    mut each: impl FnMut(&[T], &mut [T]),
) {
    let (mut numbers, mut last) = (Vec::new(), Vec::new());
    let mut one = vec![T::default(); made];
    let bits = |x: &T| x.widen().to_bits();
    for (t, i) in (0..out.tiles).flat_map(|t| (0..TILE).map(move |i| (t, i))) {
        numbers.clear();
        for (input, &fields) in inputs.iter().zip(fields) {
            let tile = input.lanes[t * input.step..].iter().take(fields);
            numbers.extend(tile.map(|lane| lane.0[i]));
        }
        if (t, i) == (0, 0) || !numbers.iter().map(bits).eq(last.iter().map(bits)) {
            each(&numbers, &mut one);
            std::mem::swap(&mut numbers, &mut last);
        }
        for (k, &x) in one.iter().enumerate() {
            if let Some(lane) = out.lane(t, k) {
                lane.0[i] = x.canonical();
            }
        }
    }
}

impl<T: Real> Maker<T> for Items<T> {
    fn make(&self, inputs: &[Tiles<'_, T>], out: Results<'_, T>) {
        by_item(inputs, &self.fields, self.made, out, |numbers, one| {
            let (shapes, seed) = numbers.split_at(self.taken);
            (self.each)(shapes, (!seed.is_empty()).then_some(seed), one);
        });
    }
}

/// How an operation is computed item by item.
pub(crate) fn of_items<T: Real>(
    mode: Mode,
    leaves: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    each: Each<T>,
) -> Plan<T> {
    let arguments: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
    let made = mode.skipped(&outputs) + mode.gives(&arguments, &outputs).iter().sum::<usize>();
    let items = Items {
        each,
        taken: arguments.iter().sum(),
        fields: [arguments, outputs.clone()].concat(),
        made,
    };
    let plans = leaves.into_iter().map(Preparation::plain).collect();
    Plan::new(mode, plans, outputs, Box::new(items))
}

/// Decides item by item, and computes the program of the record.
struct ReplayedItems<T> {
    replays: Arc<dyn Replays<T>>,
    /// Numbers of every shape, direction and cotangent.
    fields: Vec<usize>,
    /// Numbers of results per item.
    made: usize,
}

impl<T: Real> Maker<T> for ReplayedItems<T> {
    fn make(&self, inputs: &[Tiles<'_, T>], out: Results<'_, T>) {
        let mut taken = Vec::new();
        by_item(inputs, &self.fields, self.made, out, |numbers, one| {
            taken.clear();
            match self.replays.decide(numbers, &mut taken) {
                Ok(recorded) => self.replays.put(numbers, &recorded.run_on(&taken), one),
                // A replay that cannot be recorded, because it is too long, has no derivatives: NaN stands for them.
                Err(_) => one.fill(T::lit(f64::NAN)),
            }
        });
    }
}

/// How a mode of a derived search is computed: by replays. Those of a VJP give cotangents alone, so nothing is skipped.
pub(crate) fn of_replays<T: Real>(
    mode: Mode,
    recording: &Recording<T>,
    search: &Searched<T>,
) -> Plan<T> {
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
    Plan {
        skipped: 0,
        gives,
        ..Plan::new(mode, plans, outputs.clone(), Box::new(items))
    }
}

//! Makers from recorded programs, and from functions of one item.
use super::computation::{Plan, Preparation, Prepare};
use crate::Real;
use crate::ad::program::graph::{Graph, Id};
use crate::ad::program::recorded::Recorded;
use crate::error::Error;
use crate::kernels::call::recording::{Recording, UntypedSearch};
use crate::kernels::call::searched::{Decide, compute};
use crate::kernels::cpu::lane::{Lane, ResultTiles, TILE, Tiles};
use crate::kernels::cpu::maker::{Maker, OverRows};
use crate::kernels::cpu::program::rowwise::{ArgumentRows, ResultRows};
use crate::kernels::cpu::program::split::{Subgraph, split};
use crate::kernels::cpu::program::{Interpreter, Skipping};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::Leaf;
use std::sync::Arc;

/// Returns the plan of a recorded program. Its inputs are the numbers of the arguments, then of cotangents. If
/// `framed`, numbers that depend on one argument alone are computed once per shape.
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
        Interpreter::new(graph, fields, outputs, skipping).map_err(Error::Program)
    };
    let body = match framed {
        false => maker(&value.graph, &fields, &value.outputs, Skipping::Much)?,
        true => {
            // Cotangents have no frame.
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

/// Returns the number of scalars of the frames that a program makes of shapes with `fields` numbers, and that
/// preparation.
pub(crate) fn prepared<T: Real>(
    frame: &Subgraph,
    fields: usize,
) -> Result<(usize, Prepare<T>), Error> {
    let made = Interpreter::new(&frame.graph, &[fields], &frame.outputs, Skipping::Never);
    let made = made.map_err(Error::Program)?;
    let prepare = move |shapes: Tiles<'_, T>, frames: &mut [Lane<T>]| {
        made.prepare(&[shapes], frames);
    };
    Ok((frame.outputs.len(), Arc::new(prepare)))
}

/// A maker that computes item by item, by a function from the numbers of an item to a result, with room for others.
struct ItemMaker<F> {
    each: F,
    /// The number of scalars of every argument: shapes, directions, cotangents.
    fields: Vec<usize>,
    /// The number of scalars of a result.
    made: usize,
}

/// The items of a maker, one after another. An item equal to the one before has its result: padding repeats the last item.
struct Items<'a, T, F> {
    each: &'a F,
    /// The numbers of an item, and of the one before; none before the first.
    numbers: Vec<T>,
    last: Vec<T>,
    room: Vec<T>,
    result: Vec<T>,
}

impl<'a, T: Real, F: Fn(&[T], &mut Vec<T>, &mut [T])> Items<'a, T, F> {
    fn of(maker: &'a ItemMaker<F>) -> Self {
        Items {
            each: &maker.each,
            numbers: Vec::new(),
            last: Vec::new(),
            room: Vec::new(),
            result: vec![T::default(); maker.made],
        }
    }
    /// Returns the result of the item whose numbers a function writes.
    fn next(&mut self, write: impl FnOnce(&mut Vec<T>)) -> &[T] {
        self.numbers.clear();
        write(&mut self.numbers);
        let bits = |x: &T| x.widen().to_bits();
        let is_new = !self.numbers.iter().map(bits).eq(self.last.iter().map(bits));
        if is_new || self.numbers.is_empty() {
            (self.each)(&self.numbers, &mut self.room, &mut self.result);
            std::mem::swap(&mut self.numbers, &mut self.last);
        }
        &self.result
    }
}

impl<T: Real, F: Fn(&[T], &mut Vec<T>, &mut [T]) + Send + Sync> Maker<T> for ItemMaker<F> {
    fn make(&self, inputs: &[Tiles<'_, T>], mut out: ResultTiles<'_, T>) {
        let mut items = Items::of(self);
        for (t, i) in (0..out.tiles).flat_map(|t| (0..TILE).map(move |i| (t, i))) {
            let result = items.next(|numbers| {
                for (input, &fields) in inputs.iter().zip(&self.fields) {
                    let tile = input.lanes[t * input.step..].iter().take(fields);
                    numbers.extend(tile.map(|lane| lane.0[i]));
                }
            });
            for (k, &x) in result.iter().enumerate() {
                if let Some(lane) = out.lane(t, k) {
                    lane.0[i] = x.canonical();
                }
            }
        }
    }
    fn rows(&self) -> Option<&dyn OverRows<T>> {
        Some(self)
    }
}

impl<T: Real, F: Fn(&[T], &mut Vec<T>, &mut [T])> OverRows<T> for ItemMaker<F> {
    fn over_rows(
        &self,
        given: &[ArgumentRows<'_, T>],
        items: usize,
        skipped: usize,
        wanted: &mut [ResultRows<'_, T>],
        _far: bool,
    ) {
        let mut all = Items::of(self);
        for i in 0..items {
            let result = all.next(|numbers| {
                for argument in given {
                    let first = if argument.is_one { 0 } else { i };
                    let from = first * argument.fields;
                    numbers.extend_from_slice(&argument.rows[from..from + argument.fields]);
                }
            });
            let mut results = &result[skipped..];
            for (rows, fields) in &mut *wanted {
                let (own, others) = results.split_at(*fields);
                results = others;
                if let Some(rows) = rows {
                    for (x, own) in rows[i * *fields..].iter_mut().zip(own) {
                        *x = own.canonical();
                    }
                }
            }
        }
    }
    fn is_brief(&self) -> bool {
        false
    }
}

/// Returns the plan of a search, which is computed item by item.
pub(crate) fn of_items<T: Real>(
    mode: Mode,
    leaves: Vec<Leaf<T>>,
    outputs: Vec<usize>,
    decide: Decide<T>,
) -> Plan<T> {
    let arguments: Vec<usize> = leaves.iter().map(|leaf| leaf.fields).collect();
    let made = mode.skipped(&outputs) + mode.gives(&arguments, &outputs).iter().sum::<usize>();
    let taken = arguments.iter().sum();
    let items = ItemMaker {
        each: move |numbers: &[T], _: &mut Vec<T>, one: &mut [T]| {
            let (shapes, seed) = numbers.split_at(taken);
            let seed = (!seed.is_empty()).then_some(seed);
            compute(decide, mode, shapes, seed, one);
        },
        fields: [arguments, outputs.clone()].concat(),
        made,
    };
    let plans = leaves.into_iter().map(Preparation::plain).collect();
    Plan::new(mode, plans, outputs, Box::new(items))
}

/// Returns the plan of a mode of a derived search, computed by replays. Replays of a VJP return cotangents alone, so
/// nothing is skipped.
pub(crate) fn of_replays<T: Real>(
    mode: Mode,
    recording: &Recording<T>,
    search: &UntypedSearch<T>,
) -> Plan<T> {
    let (takes, outputs) = (&recording.takes, &recording.outputs);
    let mut fields: Vec<usize> = takes.iter().map(|leaf| leaf.fields).collect();
    let gives = search.gives(mode, &fields, outputs);
    if mode == Mode::Vjp {
        fields.extend(outputs);
    }
    let replays = search.replays(mode);
    let items = ItemMaker {
        each: move |numbers: &[T], taken: &mut Vec<T>, one: &mut [T]| {
            taken.clear();
            match replays.decide(numbers, taken) {
                Ok(recorded) => replays.put(numbers, &recorded.run_on(taken), one),
                // A replay too long to record has no derivatives: they are NaN.
                Err(_) => one.fill(T::lit(f64::NAN)),
            }
        },
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

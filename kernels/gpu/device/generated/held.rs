//! Columns that stay on the GPU between calls of any operation.
//!
//! A column is kept as it was given and, from its first use on, as every operation wants it prepared: what
//! an operation asks of the processor (sines, frames) is computed once per column, not once per call.
//! Results are columns, too. They are read where they are by whatever prepares nothing; an operation that
//! has something computed of them beforehand has them brought to the processor once.
use super::Programs;
use super::adjoint::Seed;
use super::aligned::tiles;
use super::operation::Generated;
use super::pairs::{Side, Sides};
use super::text::{Form, GROUP, MOST_GROUPS};
use crate::error::Argument;
use crate::kernels::cpu::aligned::name_of;
use crate::kernels::cpu::checked::{check, check_upstream, expect};
use crate::kernels::cpu::lane::TILE;
use crate::kernels::gpu::device::work::Work;
use crate::kernels::gpu::device::{Gpu, Inner, Matrix, Pending, locked};
use crate::kernels::row::Column;
use crate::{Error, GpuFault};
use std::collections::HashMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, Weak};

/// Numbers of one shape of every item, which stay on the GPU.
#[doc(hidden)]
#[derive(Debug)]
pub struct HeldColumn {
    gpu: Gpu,
    fields: usize,
    count: usize,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// Grows whenever other numbers come.
    version: u64,
    /// The numbers, shape by shape, where the processor has them.
    rows: Option<Arc<Vec<f32>>>,
    /// As they are, in tiles.
    plain: Option<(u64, Windows)>,
    /// As operations want them, by whose they are and which argument: for all items, and for all pairs.
    aligned: HashMap<(u64, usize), (Weak<u64>, u64, Windows)>,
    pairs: HashMap<(u64, usize), (Weak<u64>, u64, Side)>,
}

/// Items in tiles, cut into buffers.
#[derive(Clone, Debug)]
struct Windows {
    /// Items per buffer.
    window: usize,
    /// Each buffer, and the number in it that they begin with.
    parts: Vec<(wgpu::Buffer, usize)>,
}

impl Windows {
    /// Where items from this one on are: the buffer, the number in it, and the first item that is in
    /// another one.
    fn at(&self, item: usize, width: usize) -> (&wgpu::Buffer, usize, usize) {
        let k = item / self.window;
        let (buffer, start) = &self.parts[k];
        (
            buffer,
            start + (item - k * self.window) * width,
            (k + 1) * self.window,
        )
    }
}

/// How many items of so many numbers a buffer takes, and a dispatch.
fn window(inner: &Inner, width: usize) -> Result<usize, Error> {
    let most = inner.most_bytes as usize / 4 / width.max(1);
    match most.min(MOST_GROUPS * GROUP) / TILE * TILE {
        0 => Err(Error::Gpu(GpuFault::TooLarge)),
        window => Ok(window),
    }
}

/// Brings prepared numbers up, into buffers that are there where they are.
fn brought_up(
    inner: &Inner,
    there: Option<&Windows>,
    width: usize,
    count: usize,
    prepare: impl Fn(Range<usize>) -> Vec<f32>,
) -> Result<Windows, Error> {
    let window = match there {
        Some(there) => there.window,
        None => window(inner, width)?,
    };
    let mut parts = Vec::new();
    for (k, start) in (0..count).step_by(window).enumerate() {
        let numbers = prepare(start..count.min(start + window));
        let buffer = inner.guarded(|| match there {
            Some(there) => {
                let (buffer, start) = &there.parts[k];
                inner.write_at(buffer, 4 * *start as u64, &numbers);
                Ok((buffer.clone(), *start))
            }
            None => Ok((inner.stored(&numbers), 0)),
        })?;
        parts.push(buffer);
    }
    Ok(Windows { window, parts })
}

/// A column of a call: one that is held, or the numbers of one shape that stands for all.
#[doc(hidden)]
#[derive(Debug)]
pub enum Given<'a> {
    Held(&'a HeldColumn),
    One(&'a [f32]),
}

impl HeldColumn {
    /// Numbers that were checked, of so many fields per shape.
    pub(crate) fn new(gpu: &Gpu, fields: usize, rows: Vec<f32>) -> Result<Self, Error> {
        gpu.inner.alive()?;
        let count = rows.len() / fields.max(1);
        let state = State {
            rows: Some(Arc::new(rows)),
            ..State::default()
        };
        Ok(Self::of(gpu, fields, count, state))
    }

    fn of(gpu: &Gpu, fields: usize, count: usize, state: State) -> Self {
        HeldColumn {
            gpu: gpu.clone(),
            fields,
            count,
            state: Mutex::new(state),
        }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Other numbers, checked, for as many shapes. They go up when they are next used.
    pub(crate) fn update(&self, rows: Vec<f32>) {
        let mut state = locked(&self.state);
        state.version += 1;
        state.rows = Some(Arc::new(rows));
    }

    /// The numbers on the processor, where they are kept.
    fn rows(&self, state: &mut State) -> Result<Arc<Vec<f32>>, Error> {
        if let Some(rows) = &state.rows {
            return Ok(Arc::clone(rows));
        }
        let mut rows = vec![0.0; self.count * self.fields];
        let parts = self.parts(state);
        let bytes: Vec<_> = parts.iter().map(|(x, at, n)| (x, *at, *n)).collect();
        let mut rest = &mut rows[..];
        let arrival = self.gpu.inner.bring_parts(&self.gpu, &bytes)?;
        arrival.finish(|_, numbers| {
            let own = (numbers.len() / self.fields.max(1) * self.fields).min(rest.len());
            let (to, left) = std::mem::take(&mut rest).split_at_mut(own);
            untile(bytemuck::cast_slice(numbers), self.fields, to);
            rest = left;
        })?;
        let rows = Arc::new(rows);
        state.rows = Some(Arc::clone(&rows));
        Ok(rows)
    }

    /// What to bring back: buffer by buffer the first byte, and how many, of whole tiles.
    fn parts(&self, state: &State) -> Vec<(wgpu::Buffer, u64, u64)> {
        let Some((_, plain)) = &state.plain else {
            return Vec::new();
        };
        let buffers = plain.parts.iter().enumerate();
        let parts = buffers.map(|(k, (buffer, start))| {
            let items = plain.window.min(self.count - k * plain.window);
            let numbers = items.next_multiple_of(TILE) * self.fields;
            (buffer.clone(), 4 * *start as u64, 4 * numbers as u64)
        });
        parts.collect()
    }

    /// The column as an argument of an operation wants it.
    fn for_all(&self, made: &Generated<f32>, k: usize) -> Result<Windows, Error> {
        let inner = &self.gpu.inner;
        let mut state = locked(&self.state);
        let version = state.version;
        let width = made.widths[k];
        let is_plain = made.arguments.get(k).is_none_or(|x| x.frame.is_none());
        if is_plain {
            match &state.plain {
                Some((own, plain)) if *own == version => return Ok(plain.clone()),
                _ => (),
            }
        }
        let key = (*made.name.0, k);
        if let Some((_, own, windows)) = state.aligned.get(&key)
            && *own == version
        {
            return Ok(windows.clone());
        }
        let rows = self.rows(&mut state)?;
        let column = Column::lent(&rows, self.fields, Some(self.count));
        let there = match is_plain {
            true => state.plain.as_ref().map(|(_, there)| there),
            false => state.aligned.get(&key).map(|(_, _, there)| there),
        };
        let windows = brought_up(inner, there, width, self.count, |items| {
            tiles(made, k, &column, items)
        })?;
        let found = windows.clone();
        match is_plain {
            true => state.plain = Some((version, windows)),
            false => {
                state
                    .aligned
                    .retain(|_, (owner, ..)| owner.strong_count() > 0);
                let owner = Arc::downgrade(&made.name.0);
                state.aligned.insert(key, (owner, version, windows));
            }
        }
        Ok(found)
    }

    /// The column as a list of all pairs wants it.
    fn for_pairs(&self, made: &Generated<f32>, k: usize) -> Result<Side, Error> {
        let inner = &self.gpu.inner;
        let mut state = locked(&self.state);
        let version = state.version;
        let key = (*made.name.0, k);
        if let Some((_, own, side)) = state.pairs.get(&key)
            && *own == version
        {
            return Ok(side.clone());
        }
        let rows = self.rows(&mut state)?;
        let column = Column::lent(&rows, self.fields, Some(self.count));
        let side = match state.pairs.get(&key) {
            Some((_, _, side)) => {
                side.rewrite(inner, made, k, &column)?;
                side.clone()
            }
            None => Side::new(inner, made, k, &column)?,
        };
        state
            .pairs
            .retain(|_, (owner, ..)| owner.strong_count() > 0);
        let owner = Arc::downgrade(&made.name.0);
        state.pairs.insert(key, (owner, version, side.clone()));
        Ok(side)
    }

    /// Where results may go that are computed over these ones: whole columns of one buffer, `None` if they
    /// lie in another way or are lent to others.
    fn results(&self) -> Option<Windows> {
        let state = locked(&self.state);
        state.plain.as_ref().map(|(_, plain)| plain.clone())
    }
}

/// Shapes out of tiles of single fields.
fn untile(lanes: &[f32], fields: usize, rows: &mut [f32]) {
    for (i, row) in rows.chunks_exact_mut(fields.max(1)).enumerate() {
        let at = i / TILE * TILE * fields + i % TILE;
        for (k, x) in row.iter_mut().enumerate() {
            *x = lanes[at + k * TILE];
        }
    }
}

/// Starts bringing columns back: the numbers of each, shape by shape.
pub(crate) fn start_download(columns: &[HeldColumn]) -> Result<Pending<Vec<Vec<f32>>>, Error> {
    let Some(first) = columns.first() else {
        return Err(Error::Gpu(GpuFault::ForeignBuffer));
    };
    // What the processor has already, or which parts of what arrives it is made of.
    let mut known = Vec::new();
    let mut parts = Vec::new();
    for column in columns {
        let state = locked(&column.state);
        let rows = state.rows.clone();
        let own = match rows {
            Some(_) => Vec::new(),
            None => column.parts(&state),
        };
        known.push((
            rows,
            column.fields,
            column.count,
            parts.len()..parts.len() + own.len(),
        ));
        parts.extend(own);
    }
    let bytes: Vec<_> = parts.iter().map(|(x, at, n)| (x, *at, *n)).collect();
    let arrival = first.gpu.inner.bring_parts(&first.gpu, &bytes)?;
    Ok(Pending::new(arrival, move |arrival| {
        let mut all: Vec<(Vec<f32>, usize)> = known
            .iter()
            .map(|(rows, fields, count, _)| match rows {
                Some(rows) => (rows.to_vec(), rows.len()),
                None => (vec![0.0; fields * count], 0),
            })
            .collect();
        arrival.read(|part, numbers| {
            let of = known.iter().position(|(.., own)| own.contains(&part));
            if let Some(of) = of {
                let (fields, (rows, done)) = (known[of].1, &mut all[of]);
                let own = (rows.len() - *done).min(numbers.len());
                untile(
                    bytemuck::cast_slice(numbers),
                    fields,
                    &mut rows[*done..*done + own],
                );
                *done += own;
            }
        })?;
        Ok(all.into_iter().map(|(rows, _)| rows).collect())
    }))
}

impl Programs<'_> {
    /// Item i of columns that stay, one result per item, which stays. `over` are results that are there
    /// already and may be written over.
    pub(crate) fn held_aligned(
        &self,
        made: &Arc<Generated<f32>>,
        columns: &[Given<'_>],
        over: &[HeldColumn],
    ) -> Result<Vec<HeldColumn>, Error> {
        let inner = &self.gpu.inner;
        inner.alive()?;
        let count = self.sound(made, columns)?;
        for held in over {
            self.gpu.owns(&held.gpu)?;
        }
        let mut lists = Vec::with_capacity(columns.len());
        for (k, column) in columns.iter().enumerate() {
            lists.push(match column {
                Given::Held(held) => (held.for_all(made, k)?, true),
                Given::One(numbers) => {
                    let column = Column::lent(numbers, numbers.len(), None);
                    let numbers = tiles(made, k, &column, 0..1);
                    let buffer = inner.guarded(|| Ok(inner.stored(&numbers)))?;
                    let windows = Windows {
                        window: usize::MAX,
                        parts: vec![(buffer, 0)],
                    };
                    (windows, false)
                }
            });
        }
        let room = self.room(made, count, over, &lists)?;
        let mut start = 0;
        while start < count {
            let mut end = count.min(start + MOST_GROUPS * GROUP);
            let mut params = vec![[0; 4]];
            let mut inputs = Vec::new();
            for ((windows, is_many), &width) in lists.iter().zip(&made.widths) {
                let item = if *is_many { start } else { 0 };
                let (buffer, at, until) = windows.at(item, width);
                if *is_many {
                    end = end.min(until);
                }
                params.push([at as u32, u32::from(*is_many), 0, 0]);
                inputs.push((buffer, at, width, *is_many));
            }
            let mut outputs = None;
            for (windows, &fields) in room.iter().zip(&made.gives) {
                let (buffer, at, until) = windows.at(start, fields);
                end = end.min(until);
                params.push([at as u32, 0, 0, 0]);
                outputs = Some(buffer);
            }
            params[0][0] = (end - start) as u32;
            if let Some(outputs) = outputs {
                self.dispatch(made, &mut params, &inputs, outputs, end - start)?;
            }
            start = end;
        }
        let results = room.into_iter().zip(&made.gives).map(|(windows, &fields)| {
            let state = State {
                plain: Some((0, windows)),
                ..State::default()
            };
            HeldColumn::of(self.gpu, fields, count, state)
        });
        Ok(results.collect())
    }

    /// One dispatch. Columns beyond what one kernel may bind are copied together first.
    fn dispatch(
        &self,
        made: &Arc<Generated<f32>>,
        params: &mut [[u32; 4]],
        inputs: &[(&wgpu::Buffer, usize, usize, bool)],
        outputs: &wgpu::Buffer,
        items: usize,
    ) -> Result<(), Error> {
        let inner = &self.gpu.inner;
        let groups = [items.div_ceil(GROUP) as u32, 1];
        let read: Vec<_> = inputs
            .iter()
            .filter(|(_, _, width, _)| *width > 0)
            .collect();
        inner.guarded(|| {
            let mut work = Work::new(inner);
            if !read.is_empty() && read.len() < MOST_BOUND {
                let form = Form::Columns;
                let pipeline = inner.generated(&made.name, form, || form.text(made));
                let mut buffers: Vec<(u32, &wgpu::Buffer)> = Vec::new();
                for (buffer, ..) in &read {
                    buffers.push((buffers.len() as u32 + 1, buffer));
                }
                buffers.push((buffers.len() as u32 + 1, outputs));
                work.dispatch_with(&pipeline, params, &buffers, groups);
                return work.submit().map(drop);
            }
            let form = Form::Aligned;
            let pipeline = inner.generated(&made.name, form, || form.text(made));
            let sizes = inputs.iter().map(|(_, _, width, is_many)| {
                let items = if *is_many { items } else { 1 };
                items.next_multiple_of(TILE) * width
            });
            let sizes: Vec<usize> = sizes.collect();
            let all = inner.storage(sizes.iter().sum());
            let mut first = 0;
            for (k, ((buffer, at, ..), size)) in inputs.iter().zip(sizes).enumerate() {
                work.copy_to(
                    buffer,
                    4 * *at as u64,
                    &all,
                    4 * first as u64,
                    4 * size as u64,
                );
                params[1 + k][0] = first as u32;
                first += size;
            }
            work.dispatch_with(&pipeline, params, &[(1, &all), (2, outputs)], groups);
            work.submit().map(drop)
        })
    }

    /// How many items columns have.
    pub(crate) fn held_count(
        &self,
        made: &Generated<f32>,
        columns: &[Given<'_>],
    ) -> Result<usize, Error> {
        self.sound(made, columns)
    }

    /// Checks columns: whose they are, how many items there are, what stands for all.
    fn sound(&self, made: &Generated<f32>, columns: &[Given<'_>]) -> Result<usize, Error> {
        let arguments = made.arguments.len();
        let mut count = None;
        for (k, column) in columns.iter().enumerate() {
            let argument = name_of(arguments, k);
            match column {
                Given::Held(held) => {
                    self.gpu.owns(&held.gpu)?;
                    expect(argument, *count.get_or_insert(held.count), held.count)?;
                }
                Given::One(numbers) => match made.arguments.get(k) {
                    Some(plan) => {
                        check(argument, plan, &Column::lent(numbers, plan.fields, None))?;
                    }
                    None => check_upstream(numbers, numbers.len().max(1))?,
                },
            }
        }
        Ok(count.unwrap_or(1))
    }

    /// Where results go: over those that are there, if they lie side by side and nothing is read from
    /// them, or into new buffers.
    fn room(
        &self,
        made: &Generated<f32>,
        count: usize,
        over: &[HeldColumn],
        read: &[(Windows, bool)],
    ) -> Result<Vec<Windows>, Error> {
        let inner = &self.gpu.inner;
        let all: usize = made.gives.iter().sum();
        let window = window(inner, all)?;
        let there: Option<Vec<Windows>> = over.iter().map(HeldColumn::results).collect();
        if let Some(there) = there.filter(|there| there.len() == made.gives.len()) {
            let buffers = |windows: &Windows| -> Vec<wgpu::Buffer> {
                windows
                    .parts
                    .iter()
                    .map(|(buffer, _)| buffer.clone())
                    .collect()
            };
            let own = there.first().map(&buffers).unwrap_or_default();
            let is_read = |buffer: &wgpu::Buffer| {
                let lists = read.iter().flat_map(|(list, _)| &list.parts);
                lists.into_iter().any(|(other, _)| other == buffer)
            };
            let lies_so = |x: &Windows| x.window == window && buffers(x) == own;
            if there.iter().all(lies_so) && !own.iter().any(is_read) {
                return Ok(there);
            }
        }
        let mut room: Vec<Windows> = made
            .gives
            .iter()
            .map(|_| Windows {
                window,
                parts: Vec::new(),
            })
            .collect();
        for start in (0..count).step_by(window) {
            let items = window.min(count - start).next_multiple_of(TILE);
            let buffer = inner.guarded(|| Ok(inner.storage(items * all)))?;
            let mut first = 0;
            for (windows, &fields) in room.iter_mut().zip(&made.gives) {
                windows.parts.push((buffer.clone(), first));
                first += items * fields;
            }
        }
        Ok(room)
    }

    /// Two columns as the lists of all pairs.
    pub(super) fn held_sides(
        &self,
        made: &Generated<f32>,
        a: &HeldColumn,
        b: &HeldColumn,
    ) -> Result<Sides, Error> {
        self.gpu.inner.alive()?;
        self.gpu.owns(&a.gpu)?;
        self.gpu.owns(&b.gpu)?;
        Ok(Sides {
            a: a.for_pairs(made, 0)?,
            b: b.for_pairs(made, 1)?,
        })
    }

    /// Every row of `a` with every row of `b`, for results of one number.
    pub(crate) fn held_matrix(
        &self,
        made: &Arc<Generated<f32>>,
        a: &HeldColumn,
        b: &HeldColumn,
    ) -> Result<Matrix, Error> {
        let sides = self.held_sides(made, a, b)?;
        self.matrix_of(made, &sides)
    }

    /// The same over a matrix that is there already.
    pub(crate) fn held_matrix_into(
        &self,
        made: &Arc<Generated<f32>>,
        a: &HeldColumn,
        b: &HeldColumn,
        matrix: &Matrix,
    ) -> Result<(), Error> {
        self.gpu.owns(&matrix.gpu)?;
        expect(Argument::Values, a.count, matrix.rows)?;
        expect(Argument::Values, b.count, matrix.columns)?;
        let sides = self.held_sides(made, a, b)?;
        for (block, values) in &matrix.blocks {
            sides.compute(&self.gpu.inner, made, block, values)?;
        }
        Ok(())
    }

    /// Slopes of both lists times a matrix, or times one number.
    pub(crate) fn held_slopes(
        &self,
        made: &Arc<Generated<f32>>,
        a: &HeldColumn,
        b: &HeldColumn,
        upstream: Result<&Matrix, f32>,
    ) -> Result<[HeldColumn; 2], Error> {
        let seed = match upstream {
            Ok(matrix) => {
                self.gpu.owns(&matrix.gpu)?;
                expect(Argument::Upstream, a.count, matrix.rows)?;
                expect(Argument::Upstream, b.count, matrix.columns)?;
                Seed::Matrix(matrix)
            }
            Err(factor) => Seed::Factor(factor),
        };
        let sides = self.held_sides(made, a, b)?;
        let [by_a, by_b] = self.slopes(made, &sides, &seed)?;
        Ok([
            HeldColumn::new(self.gpu, a.fields, by_a)?,
            HeldColumn::new(self.gpu, b.fields, by_b)?,
        ])
    }
}

/// Buffers that a kernel binds at most, the results among them: as many as WebGPU promises of every device.
const MOST_BOUND: usize = 8;

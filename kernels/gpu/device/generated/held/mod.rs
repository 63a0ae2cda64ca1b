//! Columns that stay on the GPU between calls.
//!
//! A column is stored as given and, from its first use by an operation on, as this operation prepares it. So numbers
//! that the CPU prepares (sines, frames) are computed once per column, not once per call. Results are columns, too. An
//! operation without preparation reads them in place; for others they are downloaded and prepared once.
use crate::Error;
use crate::error::Argument;
use crate::kernels::cpu::checked::check_numbers;
use crate::kernels::cpu::lane::TILE;
use crate::kernels::gpu::device::context::{Device, SharedContext, locked};
use crate::kernels::gpu::device::download::DevicePending;
use crate::kernels::gpu::device::generated::aligned::tiles;
use crate::kernels::gpu::device::generated::operation::Generated;
use crate::kernels::gpu::device::generated::side::UploadedList;
use crate::kernels::gpu::device::generated::text::{GROUP, MOST_GROUPS};
use crate::kernels::machine::Column;
use crate::kernels::machine::found::Best;
use crate::kernels::machine::{self, FOREIGN, MachineColumn};
use crate::kernels::row::item::Leaf;
use std::any::Any;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, Weak};

mod calls;

/// The numbers of one shape of every item, on the GPU.
#[doc(hidden)]
#[derive(Debug)]
pub struct HeldColumn {
    gpu: Device,
    fields: usize,
    count: usize,
    state: Mutex<ColumnState>,
}

#[derive(Debug, Default)]
struct ColumnState {
    /// The version of the numbers, which grows with every update.
    version: u64,
    /// The numbers, shape by shape, if the CPU has them.
    rows: Option<Arc<Vec<f32>>>,
    /// The numbers in tiles, unprepared.
    plain: Option<(u64, Windows)>,
    /// The numbers as operations prepare them, by the key of the preparation: for aligned batches, and for all pairs.
    aligned: HashMap<(u64, usize), (Weak<u64>, u64, Windows)>,
    pairs: HashMap<(u64, usize), (Weak<u64>, u64, UploadedList)>,
}

/// Items in tiles, split over buffers.
#[derive(Clone, Debug)]
struct Windows {
    /// The number of items per buffer.
    window: usize,
    /// Each buffer, and the index of the first number in it.
    parts: Vec<(wgpu::Buffer, usize)>,
}

impl Windows {
    /// Returns the location of an item: the buffer, the index in it, and the first later item in another buffer.
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

/// Returns the number of items of `width` numbers that fit a buffer and a dispatch.
fn window(inner: &SharedContext, width: usize) -> Result<usize, Error> {
    let most = inner.most_bytes as usize / 4 / width.max(1);
    match most.min(MOST_GROUPS * GROUP) / TILE * TILE {
        0 => Err(inner.too_large(TILE * width)),
        window => Ok(window),
    }
}

/// Uploads prepared numbers, into the buffers `there` if given.
fn brought_up(
    inner: &SharedContext,
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

/// Returns the column of a call that is on this GPU; `None` for one on the CPU.
pub(in crate::kernels::gpu::device) fn held<'a>(
    gpu: &Device,
    column: &Column<'a, f32>,
) -> Result<Option<&'a HeldColumn>, Error> {
    let Some(own) = column.held else {
        return Ok(None);
    };
    let own: &HeldColumn = own.any().downcast_ref().ok_or(FOREIGN)?;
    gpu.owns(&own.gpu)?;
    Ok(Some(own))
}

impl MachineColumn<f32> for HeldColumn {
    fn fields(&self) -> usize {
        self.fields
    }
    fn here(&self) -> Option<&[f32]> {
        None
    }
    fn check(&self, leaf: Leaf<f32>, numbers: &[f32]) -> Result<(), Error> {
        check_numbers(Argument::Shape, leaf, numbers)
    }
    fn update(&mut self, rows: Vec<f32>) {
        let mut state = locked(&self.state);
        state.version += 1;
        state.rows = Some(Arc::new(rows));
    }
    fn started(
        &self,
        all: &[Box<dyn MachineColumn<f32>>],
    ) -> Result<machine::Pending<Vec<Vec<f32>>>, Error> {
        let all = all.iter().map(|own| own.any().downcast_ref());
        let all: Vec<&HeldColumn> = all.collect::<Option<_>>().ok_or(FOREIGN)?;
        Ok(machine::Pending::later(start_download(&self.gpu, &all)?))
    }
    fn any(&self) -> &dyn Any {
        self
    }
}

impl HeldColumn {
    /// Creates a column from checked numbers, with `fields` scalars per shape.
    pub(crate) fn new(gpu: &Device, fields: usize, rows: Vec<f32>) -> Result<Self, Error> {
        gpu.inner.alive()?;
        let count = rows.len() / fields.max(1);
        let state = ColumnState {
            rows: Some(Arc::new(rows)),
            ..ColumnState::default()
        };
        Ok(Self::of(gpu, fields, count, state))
    }

    fn of(gpu: &Device, fields: usize, count: usize, state: ColumnState) -> Self {
        HeldColumn {
            gpu: gpu.clone(),
            fields,
            count,
            state: Mutex::new(state),
        }
    }

    /// Returns the shapes with the indices in `bests`, in that order. They are gathered on the CPU, which prepares
    /// shapes.
    pub(crate) fn picked(&self, bests: &[Best]) -> Result<Self, Error> {
        let rows = self.rows(&mut locked(&self.state))?;
        let own = |best: &Best| &rows[best.index * self.fields..][..self.fields];
        HeldColumn::new(
            &self.gpu,
            self.fields,
            bests.iter().flat_map(own).copied().collect(),
        )
    }

    /// Checks that the column belongs to this context.
    pub(in crate::kernels::gpu::device) fn is_of(&self, gpu: &Device) -> Result<(), Error> {
        gpu.owns(&self.gpu)
    }

    /// Returns the numbers, shape by shape.
    pub(in crate::kernels::gpu::device) fn numbers(&self) -> Result<Arc<Vec<f32>>, Error> {
        self.rows(&mut locked(&self.state))
    }

    /// Returns the numbers on the CPU, where they are kept.
    fn rows(&self, state: &mut ColumnState) -> Result<Arc<Vec<f32>>, Error> {
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

    /// Returns the parts to download: for every buffer the first byte and the number of bytes, of whole tiles.
    fn parts(&self, state: &ColumnState) -> Vec<(wgpu::Buffer, u64, u64)> {
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

    /// Returns the column as an argument of an aligned operation, prepared.
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

    /// Returns the column as a list of all pairs, prepared.
    pub(in crate::kernels::gpu::device) fn for_pairs(
        &self,
        made: &Generated<f32>,
        k: usize,
    ) -> Result<UploadedList, Error> {
        let inner = &self.gpu.inner;
        let mut state = locked(&self.state);
        let version = state.version;
        let (key, owner) = made.prepared(k);
        if let Some((_, own, side)) = state.pairs.get(&key)
            && *own == version
        {
            return Ok(side.clone());
        }
        let rows = self.rows(&mut state)?;
        let column = Column::lent(&rows, self.fields, Some(self.count));
        let there = state.pairs.get(&key).map(|(_, _, side)| side.clone());
        let side = match there {
            Some(mut side) => {
                side.rewrite(inner, made, k, &column)?;
                side
            }
            None => UploadedList::new(inner, made, k, &column)?,
        };
        state
            .pairs
            .retain(|_, (owner, ..)| owner.strong_count() > 0);
        let owner = Arc::downgrade(&owner.0);
        state.pairs.insert(key, (owner, version, side.clone()));
        Ok(side)
    }

    /// Returns the buffers that new results may overwrite: whole columns in one buffer. `None` for another layout, or
    /// for buffers that others use.
    fn results(&self) -> Option<Windows> {
        let state = locked(&self.state);
        state.plain.as_ref().map(|(_, plain)| plain.clone())
    }
}

/// Converts tiles of single fields to rows.
fn untile(lanes: &[f32], fields: usize, rows: &mut [f32]) {
    for (i, row) in rows.chunks_exact_mut(fields.max(1)).enumerate() {
        let at = i / TILE * TILE * fields + i % TILE;
        for (k, x) in row.iter_mut().enumerate() {
            *x = lanes[at + k * TILE];
        }
    }
}

/// Starts the download of columns: the numbers of each, shape by shape.
fn start_download(
    gpu: &Device,
    columns: &[&HeldColumn],
) -> Result<DevicePending<Vec<Vec<f32>>>, Error> {
    // Rows that the CPU has already; for the others the range of their parts.
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
    let arrival = gpu.inner.bring_parts(gpu, &bytes)?;
    Ok(DevicePending::new(arrival, move |arrival| {
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

//! Calls over columns on the GPU.
use super::{ColumnState, HeldColumn, Windows, held, window};
use crate::Error;
use crate::kernels::cpu::aligned::items;
use crate::kernels::cpu::checked::{check, check_upstream};
use crate::kernels::cpu::lane::TILE;
use crate::kernels::gpu::device::context::Device;
use crate::kernels::gpu::device::generated::aligned::tiles;
use crate::kernels::gpu::device::generated::operation::Generated;
use crate::kernels::gpu::device::generated::text::{GROUP, KernelForm, MOST_GROUPS};
use crate::kernels::gpu::device::work::Commands;
use crate::kernels::machine::Column;
use std::sync::Arc;

impl Device {
    /// Computes item i of columns on the GPU. Returns one result per item, on the GPU. `over` are earlier results that
    /// may be overwritten.
    pub(in crate::kernels::gpu::device) fn held_aligned(
        &self,
        made: &Arc<Generated<f32>>,
        columns: &[Column<'_, f32>],
        over: &[&HeldColumn],
    ) -> Result<Vec<HeldColumn>, Error> {
        let inner = &self.inner;
        inner.alive()?;
        let count = items(&made.arguments, columns)?;
        for held in over {
            self.owns(&held.gpu)?;
        }
        let mut lists = Vec::with_capacity(columns.len());
        for (k, column) in columns.iter().enumerate() {
            if let Some(held) = held(self, column)? {
                lists.push((held.for_all(made, k)?, true));
                continue;
            }
            match made.arguments.get(k) {
                Some(own) => check(own.argument(k), own, column).map(drop)?,
                None => check_upstream(&column.all(), column.fields.max(1))?,
            }
            lists.push(match column.count {
                // A slice next to columns on the GPU is uploaded for this call.
                Some(_) => {
                    let own = HeldColumn::new(self, column.fields, column.all().into_owned())?;
                    (own.for_all(made, k)?, true)
                }
                None => {
                    let numbers = tiles(made, k, column, 0..1);
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
            let state = ColumnState {
                plain: Some((0, windows)),
                ..ColumnState::default()
            };
            HeldColumn::of(self, fields, count, state)
        });
        Ok(results.collect())
    }

    /// Runs one dispatch. If a kernel cannot bind all columns, some are copied into one buffer first.
    fn dispatch(
        &self,
        made: &Arc<Generated<f32>>,
        params: &mut [[u32; 4]],
        inputs: &[(&wgpu::Buffer, usize, usize, bool)],
        outputs: &wgpu::Buffer,
        items: usize,
    ) -> Result<(), Error> {
        let inner = &self.inner;
        let groups = [items.div_ceil(GROUP) as u32, 1];
        let read: Vec<_> = inputs
            .iter()
            .filter(|(_, _, width, _)| *width > 0)
            .collect();
        inner.guarded(|| {
            let mut work = Commands::new(inner);
            if !read.is_empty() && read.len() < MOST_BOUND {
                let form = KernelForm::Columns;
                let pipeline = inner.generated(&made.name, form, || form.text(made));
                let mut buffers: Vec<(u32, &wgpu::Buffer)> = Vec::new();
                for (buffer, ..) in &read {
                    buffers.push((buffers.len() as u32 + 1, buffer));
                }
                buffers.push((buffers.len() as u32 + 1, outputs));
                work.dispatch_with(&pipeline, params, &buffers, groups);
                return work.submit().map(drop);
            }
            let form = KernelForm::Aligned;
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

    /// Returns the buffers of results: the buffers of `over`, if they are contiguous and the call reads nothing from
    /// them, or new ones.
    fn room(
        &self,
        made: &Generated<f32>,
        count: usize,
        over: &[&HeldColumn],
        read: &[(Windows, bool)],
    ) -> Result<Vec<Windows>, Error> {
        let inner = &self.inner;
        let all: usize = made.gives.iter().sum();
        let window = window(inner, all)?;
        let there: Option<Vec<Windows>> = over.iter().map(|own| own.results()).collect();
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
}

/// The largest number of buffers that a kernel binds, results included: as many as WebGPU guarantees on every device.
const MOST_BOUND: usize = 8;

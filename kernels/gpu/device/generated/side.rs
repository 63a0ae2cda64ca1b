//! A list of shapes on a GPU, prepared for all pairs.
use super::operation::Generated;
use super::text::{MOST_GROUPS, ROWS};
use crate::Error;
use crate::kernels::cpu::lane::TILE;
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::gpu::device::context::SharedContext;
use crate::kernels::machine::Column;
use crate::kernels::row::item::STRETCH;
use std::ops::Range;

/// An uploaded list: prepared shapes, in buffers that fit one binding each.
#[derive(Clone, Debug)]
pub(in crate::kernels::gpu::device) struct UploadedList {
    /// The number of shapes per buffer.
    pub(super) window: usize,
    pub(super) buffers: Vec<wgpu::Buffer>,
    pub(super) count: usize,
    /// `true` if its shapes need a body for extreme shapes.
    pub(super) is_extreme: bool,
}

impl UploadedList {
    /// Uploads a checked list.
    pub fn new(
        inner: &SharedContext,
        made: &Generated<f32>,
        k: usize,
        column: &Column<'_, f32>,
    ) -> Result<Self, Error> {
        let count = column.len();
        // Sums of derivatives, which have a shape's number of scalars, must fit a binding, too.
        let width = made.widths[k]
            .next_multiple_of(4)
            .max(made.arguments[k].fields)
            .max(1);
        let window = inner.most_bytes as usize / 4 / width;
        // This keeps the workgroups of a dispatch within their limit.
        let window = window.min(MOST_GROUPS * ROWS) / TILE * TILE;
        if window == 0 {
            return Err(inner.too_large(TILE * width));
        }
        let (mut buffers, mut is_extreme) = (Vec::new(), false);
        for start in (0..count).step_by(window) {
            let (numbers, is_so) = frames(made, k, column, start..count.min(start + window));
            buffers.push(inner.guarded(|| Ok(inner.stored(&numbers)))?);
            is_extreme |= is_so;
        }
        Ok(UploadedList {
            window,
            buffers,
            count,
            is_extreme,
        })
    }
    /// Replaces the shapes by as many others, in place.
    pub fn rewrite(
        &mut self,
        inner: &SharedContext,
        made: &Generated<f32>,
        k: usize,
        column: &Column<'_, f32>,
    ) -> Result<(), Error> {
        self.is_extreme = false;
        for (start, buffer) in (0..self.count).step_by(self.window).zip(&self.buffers) {
            let items = start..self.count.min(start + self.window);
            let (numbers, is_extreme) = frames(made, k, column, items);
            self.is_extreme |= is_extreme;
            inner.guarded(|| {
                inner.write(buffer, &numbers);
                Ok(())
            })?;
        }
        Ok(())
    }
    /// Returns the parts of a range of shapes, each in one buffer: the buffer, the index in it, and the shapes.
    pub(super) fn parts(
        &self,
        range: Range<usize>,
    ) -> impl Iterator<Item = (&wgpu::Buffer, usize, Range<usize>)> {
        let buffers = self.buffers.iter().enumerate();
        buffers.filter_map(move |(i, buffer)| {
            let first = i * self.window;
            let own = range.start.max(first)..range.end.min(first + self.window);
            (!own.is_empty()).then(|| (buffer, own.start - first, own))
        })
    }
}

/// Returns the prepared numbers of some shapes, and `true` if any of them is extreme.
fn frames(
    made: &Generated<f32>,
    k: usize,
    column: &Column<'_, f32>,
    items: Range<usize>,
) -> (Vec<f32>, bool) {
    let starts = items.clone().step_by(STRETCH);
    let mut parts = vec![(Vec::new(), false); starts.len()];
    let work = starts.zip(&mut parts).collect();
    in_parallel(work, |(start, part): (usize, &mut (Vec<f32>, bool))| {
        let mut room = Vec::new();
        let numbers = column.numbers(start..items.end.min(start + STRETCH), &mut room);
        *part = (made.prepare_rows(k, numbers), made.is_extreme(k, numbers));
    });
    let is_extreme = parts.iter().any(|part| part.1);
    let numbers: Vec<_> = parts.into_iter().map(|part| part.0).collect();
    (numbers.concat(), is_extreme)
}

//! Uploaded lists of all pairs, and kernels that compute blocks of results: one thread per column and some rows.
use super::held::held;
use super::operation::Generated;
use super::side::UploadedList;
use super::template::Size;
use super::text::{KernelForm, ROWS};
use crate::Error;
use crate::kernels::cpu::checked::check_argument;
use crate::kernels::gpu::device::block::Block;
use crate::kernels::gpu::device::context::{Device, SharedContext};
use crate::kernels::gpu::device::work::{Commands, Params};
use crate::kernels::machine::Column;
use std::ops::Range;
use std::sync::Arc;

/// The largest number of operations in a dispatch: an operating system resets a GPU after seconds of one dispatch.
pub(super) const MOST_OPERATIONS: usize = 1 << 42;

/// Both lists, checked and uploaded.
pub(in crate::kernels::gpu::device) struct UploadedLists {
    a: UploadedList,
    b: UploadedList,
}

/// One dispatch: the location of both lists, their ranges, and the place of the results in a block.
pub(super) struct PairDispatch<'a> {
    pub buffers: [&'a wgpu::Buffer; 2],
    /// The numbers of rows and columns, and the first of each in its buffer and in its list.
    pub counts: [usize; 2],
    starts: [usize; 2],
    pub firsts: [usize; 2],
    /// The index of the first result in the block, and the numbers of results of a row and of the block.
    out_start: usize,
    stride: usize,
    plane: usize,
}

impl PairDispatch<'_> {
    /// Returns the parameters of a kernel with one thread per shape of list `own`.
    pub fn params(&self, own: usize) -> Params {
        Params {
            own_count: self.counts[own] as u32,
            own_start: self.starts[own] as u32,
            loop_count: self.counts[1 - own] as u32,
            loop_start: self.starts[1 - own] as u32,
            out_start: self.out_start as u32,
            stride: self.stride as u32,
            plane: self.plane as u32,
            ..Params::default()
        }
    }
    /// Returns the workgroups of such a kernel.
    pub fn groups(&self, own: usize, size: Size) -> [usize; 2] {
        [
            self.counts[own].div_ceil(size.own),
            self.counts[1 - own].div_ceil(size.strip),
        ]
    }
}

impl UploadedLists {
    /// Checks and prepares two lists; those that stay on the GPU are prepared once.
    pub fn of(
        gpu: &Device,
        made: &Generated<f32>,
        lists: &[Column<'_, f32>; 2],
    ) -> Result<Self, Error> {
        gpu.inner.alive()?;
        let side = |k: usize| match held(gpu, &lists[k])? {
            Some(column) => column.for_pairs(made, k),
            None => {
                check_argument(k, &made.arguments, &lists[k])?;
                UploadedList::new(&gpu.inner, made, k, &lists[k])
            }
        };
        Ok(UploadedLists {
            a: side(0)?,
            b: side(1)?,
        })
    }
    /// Returns the kernels for these lists: those for extreme shapes if there are any.
    pub fn body_for(&self, made: Arc<Generated<f32>>) -> Arc<Generated<f32>> {
        match &made.extreme {
            Some(extreme) if self.a.is_extreme || self.b.is_extreme => Arc::clone(extreme),
            _ => made,
        }
    }
    /// Returns the numbers of rows and columns.
    pub fn counts(&self) -> [usize; 2] {
        [self.a.count, self.b.count]
    }
    /// Returns the parts of some shapes of a list: the buffer, the index in it, and the shapes.
    pub fn parts(
        &self,
        k: usize,
        range: Range<usize>,
    ) -> impl Iterator<Item = (&wgpu::Buffer, usize, Range<usize>)> {
        let side = if k == 0 { &self.a } else { &self.b };
        side.parts(range)
    }
    /// Returns the dispatches of a block of results, for a function with `operations` operations.
    pub(super) fn pieces(&self, block: &Block, operations: usize) -> Vec<PairDispatch<'_>> {
        let mut pieces = Vec::new();
        let rows = block.row_base..block.row_base + block.rows;
        let columns = block.column_base..block.column_base + block.columns;
        for (b, b_at, columns) in self.b.parts(columns) {
            let most = MOST_OPERATIONS / operations.max(1) / columns.len();
            let most = most.max(ROWS).next_multiple_of(ROWS);
            for (a, a_at, rows) in self.a.parts(rows.clone()) {
                for start in rows.clone().step_by(most) {
                    let own = start..rows.end.min(start + most);
                    let (row, column) = (
                        own.start - block.row_base,
                        columns.start - block.column_base,
                    );
                    pieces.push(PairDispatch {
                        buffers: [a, b],
                        counts: [own.len(), columns.len()],
                        starts: [a_at + own.start - rows.start, b_at],
                        firsts: [own.start, columns.start],
                        out_start: row * block.columns + column,
                        stride: block.columns,
                        plane: block.rows * block.columns,
                    });
                }
            }
        }
        pieces
    }
    /// Computes a block of results.
    pub fn compute(
        &self,
        inner: &SharedContext,
        made: &Arc<Generated<f32>>,
        block: &Block,
        to: &wgpu::Buffer,
    ) -> Result<(), Error> {
        inner.guarded(|| {
            let (pipeline, size) = (
                made.pipeline(inner, KernelForm::Pairs),
                made.size(KernelForm::Pairs),
            );
            let mut work = Commands::new(inner);
            for piece in self.pieces(block, made.bodies[0].operations) {
                let [a, b] = piece.buffers;
                let [wide, tall] = piece.groups(1, size);
                let groups = [wide as u32, tall as u32];
                work.dispatch(
                    &pipeline,
                    piece.params(1),
                    &[(1, a), (2, b), (4, to)],
                    groups,
                );
            }
            work.submit().map(drop)
        })
    }
}

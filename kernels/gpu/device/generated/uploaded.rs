//! Lists of all pairs on a GPU, and the blocks of results that they give: a thread per column and some rows.
use super::held::held;
use super::operation::Generated;
use super::text::{Form, GROUP, MOST_GROUPS, ROWS};
use crate::Error;
use crate::kernels::cpu::checked::check_argument;
use crate::kernels::cpu::lane::TILE;
use crate::kernels::cpu::work::spread;
use crate::kernels::gpu::device::block::Block;
use crate::kernels::gpu::device::work::Work;
use crate::kernels::gpu::device::{Device, Inner};
use crate::kernels::item::{Column, STRETCH};
use std::ops::Range;
use std::sync::Arc;

/// Operations that a dispatch does at most: drivers reset a GPU that is busy with one for seconds.
pub(super) const MOST_OPERATIONS: usize = 1 << 42;

/// A list that went up: prepared shapes, in buffers that fit a binding each.
#[derive(Clone, Debug)]
pub(super) struct Side {
    /// Shapes per buffer.
    window: usize,
    buffers: Vec<wgpu::Buffer>,
    count: usize,
}

impl Side {
    /// Brings a list up that was checked.
    pub fn new(
        inner: &Inner,
        made: &Generated<f32>,
        k: usize,
        column: &Column<'_, f32>,
    ) -> Result<Self, Error> {
        let count = column.len();
        // Sums of derivatives, which have the numbers of a shape, must fit a binding, too.
        let width = made.widths[k].max(made.arguments[k].fields).max(1);
        let window = inner.most_bytes as usize / 4 / width;
        // So that no dispatch has more workgroups than it may have.
        let window = window.min(MOST_GROUPS * ROWS) / TILE * TILE;
        if window == 0 {
            return Err(inner.too_large(TILE * width));
        }
        let mut buffers = Vec::new();
        for start in (0..count).step_by(window) {
            let numbers = frames(made, k, column, start..count.min(start + window));
            buffers.push(inner.guarded(|| Ok(inner.stored(&numbers)))?);
        }
        Ok(Side {
            window,
            buffers,
            count,
        })
    }
    /// Puts as many other shapes in their place, without a new buffer.
    pub fn rewrite(
        &self,
        inner: &Inner,
        made: &Generated<f32>,
        k: usize,
        column: &Column<'_, f32>,
    ) -> Result<(), Error> {
        for (start, buffer) in (0..self.count).step_by(self.window).zip(&self.buffers) {
            let items = start..self.count.min(start + self.window);
            let numbers = frames(made, k, column, items);
            inner.guarded(|| {
                inner.write(buffer, &numbers);
                Ok(())
            })?;
        }
        Ok(())
    }
    /// The parts of a range of shapes, each in one buffer: the buffer, where in it, which shapes.
    fn parts(
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

/// The prepared numbers of some shapes, in tiles.
fn frames(
    made: &Generated<f32>,
    k: usize,
    column: &Column<'_, f32>,
    items: Range<usize>,
) -> Vec<f32> {
    let starts = items.clone().step_by(STRETCH);
    let mut parts = vec![Vec::new(); starts.len()];
    let work = starts.zip(&mut parts).collect();
    spread(work, |(start, part): (usize, &mut Vec<f32>)| {
        let mut room = Vec::new();
        let own = start..items.end.min(start + STRETCH);
        *part = made.prepare(k, column.numbers(own, &mut room));
    });
    parts.concat()
}

/// Both lists, checked and brought up.
pub(in crate::kernels::gpu::device) struct Sides {
    a: Side,
    b: Side,
}

/// One dispatch: where both lists are, what of them, and their place in a block of results.
pub(super) struct Piece<'a> {
    pub buffers: [&'a wgpu::Buffer; 2],
    pub rows: usize,
    pub columns: usize,
    /// The kernel's parameters.
    pub params: Vec<[u32; 4]>,
}

impl Sides {
    /// Two lists, checked and prepared; those that stay are prepared once.
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
                Side::new(&gpu.inner, made, k, &lists[k])
            }
        };
        Ok(Sides {
            a: side(0)?,
            b: side(1)?,
        })
    }
    /// How many rows and columns there are.
    pub fn counts(&self) -> [usize; 2] {
        [self.a.count, self.b.count]
    }
    /// The parts of some shapes of a list: the buffer, where in it, and which shapes.
    pub fn parts(
        &self,
        k: usize,
        range: Range<usize>,
    ) -> impl Iterator<Item = (&wgpu::Buffer, usize, Range<usize>)> {
        let side = if k == 0 { &self.a } else { &self.b };
        side.parts(range)
    }
    /// The dispatches of a block of results, for a function of so many operations.
    pub(super) fn pieces(&self, block: &Block, operations: usize) -> Vec<Piece<'_>> {
        let mut pieces = Vec::new();
        let rows = block.row_base..block.row_base + block.rows;
        let columns = block.column_base..block.column_base + block.columns;
        for (b, b_at, columns) in self.b.parts(columns) {
            let most = MOST_OPERATIONS / operations.max(1) / columns.len();
            let most = most.max(ROWS).next_multiple_of(ROWS);
            for (a, a_at, rows) in self.a.parts(rows.clone()) {
                for start in rows.clone().step_by(most) {
                    let own = start..rows.end.min(start + most);
                    pieces.push(Piece {
                        buffers: [a, b],
                        rows: own.len(),
                        columns: columns.len(),
                        params: vec![
                            [
                                own.len() as u32,
                                columns.len() as u32,
                                block.columns as u32,
                                (block.rows * block.columns) as u32,
                            ],
                            [
                                (a_at + own.start - rows.start) as u32,
                                b_at as u32,
                                (own.start - block.row_base) as u32,
                                (columns.start - block.column_base) as u32,
                            ],
                        ],
                    });
                }
            }
        }
        pieces
    }
    /// Computes a block of results.
    pub fn compute(
        &self,
        inner: &Inner,
        made: &Arc<Generated<f32>>,
        block: &Block,
        to: &wgpu::Buffer,
    ) -> Result<(), Error> {
        inner.guarded(|| {
            let pipeline = inner.generated(&made.name, Form::Pairs, || Form::Pairs.text(made));
            let mut work = Work::new(inner);
            for piece in self.pieces(block, made.bodies[0].operations) {
                let [a, b] = piece.buffers;
                let groups = [
                    piece.columns.div_ceil(GROUP) as u32,
                    piece.rows.div_ceil(ROWS) as u32,
                ];
                let buffers = [(1, a), (2, b), (3, to)];
                work.dispatch_with(&pipeline, &piece.params, &buffers, groups);
            }
            work.submit().map(drop)
        })
    }
}

//! Every row with every column: a thread per column and some rows.
use super::held::HeldColumn;
use super::operation::Generated;
use super::text::{Form, GROUP, MOST_GROUPS, ROWS};
use crate::Error;
use crate::kernels::cpu::checked::check_argument;
use crate::kernels::cpu::lane::TILE;
use crate::kernels::cpu::work::spread;
use crate::kernels::gpu::device::block::{Block, place_block};
use crate::kernels::gpu::device::lists::Lists;
use crate::kernels::gpu::device::work::Work;
use crate::kernels::gpu::device::{Gpu, Inner};
use crate::kernels::item::{Column, STRETCH};
use crate::kernels::op::Runs;
use crate::kernels::recording::Call;
use crate::kernels::reduce::{Best, Found};
use crate::kernels::{Single, Table};
use crate::suppression::Pair;
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
    pub fn new(
        inner: &Inner,
        made: &Generated<f32>,
        a: &Column<'_, f32>,
        b: &Column<'_, f32>,
    ) -> Result<Self, Error> {
        inner.alive()?;
        check_argument(0, &made.arguments, a)?;
        check_argument(1, &made.arguments, b)?;
        Ok(Sides {
            a: Side::new(inner, made, 0, a)?,
            b: Side::new(inner, made, 1, b)?,
        })
    }
    /// Two columns that stay.
    pub fn of_held(made: &Generated<f32>, a: &HeldColumn, b: &HeldColumn) -> Result<Self, Error> {
        Ok(Sides {
            a: a.for_pairs(made, 0)?,
            b: b.for_pairs(made, 1)?,
        })
    }
    /// How many rows and columns there are.
    pub fn counts(&self) -> [usize; 2] {
        [self.a.count, self.b.count]
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

impl Gpu {
    /// Every row of `a` with every row of `b`, as [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs).
    ///
    /// # Errors
    ///
    /// As on the processor; [`Error::Program`] for what searches, [`Error::Gpu`] for what the device says.
    pub fn all_pairs<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R: Runs<(A, B)>>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<Table<R::Out>, Error> {
        let mut table = Table::<R::Out>::new(a.len(), b.len())?;
        let columns = [Column::of(a), Column::of(b)];
        self.planes(&run.call()?, &columns, table.planes_mut())?;
        Ok(table)
    }

    /// Every row with every row of columns of numbers, plane after plane.
    pub(crate) fn planes(
        &self,
        call: &Call<f32>,
        lists: &[Column<'_, f32>; 2],
        planes: &mut [f32],
    ) -> Result<(), Error> {
        let inner = &self.inner;
        if call.mirror().is_some() {
            let matrix = Lists::of_columns(self, call, lists)?.matrix()?;
            planes.copy_from_slice(&matrix.download()?);
            return Ok(());
        }
        let made = call.generated(true)?;
        let [a, b] = lists;
        let sides = Sides::new(inner, &made, a, b)?;
        let [rows, columns] = [a.len(), b.len()];
        let fields = made.bodies[0].gives;
        let size = rows * columns;
        for block in inner.cut(rows, columns, 4 * fields.max(1) as u64) {
            let numbers = block.rows * block.columns * fields;
            let results = inner.guarded(|| Ok(inner.storage(numbers)))?;
            sides.compute(inner, &made, &block, &results)?;
            let arrival = inner.bring(self, &[(&results, 4 * numbers as u64)])?;
            arrival.finish(|_, numbers| {
                let numbers: &[f32] = bytemuck::cast_slice(numbers);
                let found = numbers.chunks_exact(block.rows * block.columns);
                for (from, to) in found.zip(planes.chunks_exact_mut(size)) {
                    place_block(&block, columns, from, to);
                }
            })?;
        }
        Ok(())
    }

    /// Every two shapes of a list whose result is above the threshold, each two once, as
    /// [`Cpu::overlaps`](crate::kernels::Cpu::overlaps): what [`suppression`](crate::suppression) starts
    /// from.
    ///
    /// # Errors
    ///
    /// As [`above`](Gpu::above).
    pub fn overlaps<A: Single<Scalar = f32>, R>(
        &self,
        run: R,
        shapes: &[A],
        threshold: f32,
    ) -> Result<Vec<Pair<f32>>, Error>
    where
        R: Runs<(A, A), Out = f32>,
    {
        let found = self.above(run, shapes, shapes, threshold)?;
        let ascending = found.into_iter().filter(|pair| pair.row < pair.column);
        Ok(ascending.map(Pair::from).collect())
    }
}

/// Reductions of all pairs, without the matrix.
macro_rules! reductions {
    ($($(#[$doc:meta])* $name:ident($($more:ident: $type:ty)?) -> $out:ty = |$found:ident| $after:expr;)*) => {
        impl Gpu { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// As on the processor; [`Error::Program`] for what searches, [`Error::Gpu`] for what the
            /// device says.
            pub fn $name<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
                &self,
                run: R,
                a: &[A],
                b: &[B],
                $($more: $type,)?
            ) -> Result<$out, Error>
            where
                R: Runs<(A, B), Out = f32>,
            {
                let $found = Lists::of_slices(self, &run, a, b)?.$name($($more)?)?;
                $after
            }
        )* }
    };
}

reductions! {
    /// The largest result of every row and its column, of several the first, as
    /// [`Cpu::row_max`](crate::kernels::Cpu::row_max).
    row_max() -> Vec<Best> = |found| found.download();
    /// The largest result of every column and its row, of several the first, as
    /// [`Cpu::column_max`](crate::kernels::Cpu::column_max).
    column_max() -> Vec<Best> = |found| found.download();
    /// Every pair whose result is above the threshold, row by row, as
    /// [`Cpu::above`](crate::kernels::Cpu::above).
    above(threshold: f32) -> Vec<Found> = |found| found.download();
    /// How many pairs have a result above the threshold, as
    /// [`Cpu::count_above`](crate::kernels::Cpu::count_above).
    count_above(threshold: f32) -> u64 = |found| Ok(found);
    /// The sum of all results, as [`Cpu::sum`](crate::kernels::Cpu::sum): up to 1024 are added in `f32`,
    /// those sums in `f64`, always in the same order.
    sum() -> f64 = |found| Ok(found);
    /// The mean of all results, zero where there are none, as [`Cpu::mean`](crate::kernels::Cpu::mean).
    mean() -> f64 = |found| Ok(found);
}

//! Matrices in GPU memory.
use super::block::{Block, block_of, place_block};
use super::context::Device;
use super::download::DevicePending;
use super::reducer::{MATRIX, ReduceDispatch, Reducer};
use super::work::{Commands, MOST_GROUPS, Params, groups};
use super::written::{GROUP, Kernel, STRIP};
use crate::error::{Argument, Error};
use crate::kernels::machine::{self, Matrices};
use crate::kernels::machine::{Reduced, Reduction};
use crate::kernels::row::item::counts::{entries, expect};
use std::any::Any;

/// A matrix on the GPU: one number per row of one list and row of another. Clones share the memory.
#[derive(Clone, Debug)]
pub struct DeviceMatrix {
    pub(super) gpu: Device,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) blocks: Vec<(Block, wgpu::Buffer)>,
}

impl DeviceMatrix {
    /// Allocates a matrix.
    pub(super) fn room(gpu: &Device, rows: usize, columns: usize) -> Result<Self, Error> {
        entries(rows, columns, 1)?;
        let blocks = gpu.inner.cut(rows, columns, 4).into_iter().map(|block| {
            let values = gpu.inner.storage(block.rows * block.columns);
            (block, values)
        });
        Ok(DeviceMatrix {
            gpu: gpu.clone(),
            rows,
            columns,
            blocks: blocks.collect(),
        })
    }

    /// Writes checked numbers to the matrix.
    fn write(&self, values: &[f32]) {
        for (block, buffer) in &self.blocks {
            let inner = &self.gpu.inner;
            inner.write(buffer, &block_of(block, self.columns, values));
        }
    }

    /// Returns a copy in new buffers, made by a kernel.
    fn copied(&self) -> Result<DeviceMatrix, Error> {
        let made = || DeviceMatrix::room(&self.gpu, self.rows, self.columns);
        let to = self.gpu.inner.guarded(made)?;
        self.copied_into(&to)?;
        Ok(to)
    }

    /// Copies the numbers into another matrix.
    fn copied_into(&self, to: &DeviceMatrix) -> Result<(), Error> {
        self.gpu
            .fits(to, self.rows, self.columns, Argument::Values)?;
        let inner = &self.gpu.inner;
        inner.guarded(|| {
            let pipeline = inner.written(Kernel::Gather, "copy_main");
            let mut work = Commands::new(inner);
            for ((block, from), (_, to)) in self.blocks.iter().zip(&to.blocks) {
                let count = block.rows * block.columns;
                for start in (0..count).step_by(MOST_COPIED) {
                    let own = MOST_COPIED.min(count - start);
                    let params = Params {
                        own_count: own as u32,
                        own_start: start as u32,
                        ..Params::default()
                    };
                    work.dispatch(&pipeline, params, &[(3, from), (4, to)], [groups(own), 1]);
                }
            }
            work.submit().map(drop)
        })
    }

    /// Starts the download of the matrix in row-major order.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<DevicePending<Vec<f32>>, Error> {
        let (rows, columns) = (self.rows, self.columns);
        let blocks: Vec<Block> = self.blocks.iter().map(|&(block, _)| block).collect();
        let parts: Vec<_> = self
            .blocks
            .iter()
            .map(|(block, buffer)| (buffer, 4 * (block.rows * block.columns) as u64))
            .collect();
        let arrival = self.gpu.inner.bring(&self.gpu, &parts)?;
        Ok(DevicePending::new(arrival, move |arrival| {
            let mut all = vec![0.0; rows * columns];
            arrival.read(|part, numbers| {
                let numbers = bytemuck::cast_slice(numbers);
                place_block(&blocks[part], columns, numbers, &mut all);
            })?;
            Ok(all)
        }))
    }
}

impl Matrices<f32> for DeviceMatrix {
    fn size(&self) -> [usize; 2] {
        [self.rows, self.columns]
    }
    fn update(&mut self, values: &[f32]) -> Result<(), Error> {
        self.gpu.inner.guarded(|| {
            self.write(values);
            Ok(())
        })
    }
    fn started(&self) -> Result<machine::Pending<Vec<f32>>, Error> {
        Ok(machine::Pending::later(self.start_download()?))
    }
    fn reduce(&self, reduction: Reduction<f32>) -> Result<Reduced<f32>, Error> {
        let own_rows = reduction != Reduction::Best { of_rows: false };
        self.reducer(own_rows).reduced(reduction)
    }
    fn duplicate(&self) -> Result<machine::Matrix, Error> {
        Ok(self.copied()?.boxed())
    }
    fn duplicate_into(&self, to: &mut machine::Matrix) -> Result<(), Error> {
        self.copied_into(to.own()?)
    }
    fn boxed(&self) -> machine::Matrix {
        machine::Matrix(Box::new(self.clone()))
    }
    fn any(&self) -> &dyn Any {
        self
    }
    fn any_mut(&mut self) -> &mut dyn Any {
        self
    }
}

/// The largest number of scalars that a dispatch copies.
const MOST_COPIED: usize = MOST_GROUPS * GROUP;

impl Device {
    /// Checks that a matrix has this context and this size.
    pub(super) fn fits(
        &self,
        matrix: &DeviceMatrix,
        rows: usize,
        columns: usize,
        argument: Argument,
    ) -> Result<(), Error> {
        self.owns(&matrix.gpu)?;
        expect(argument, rows, matrix.rows)?;
        expect(argument, columns, matrix.columns)
    }
}

impl DeviceMatrix {
    /// Returns the reducer of the matrix.
    pub(super) fn reducer(&self, own_rows: bool) -> Reducer<'_> {
        let sweep = |(block, buffer): &(Block, wgpu::Buffer)| {
            let rows = (block.row_piece, block.row_start, block.row_base, block.rows);
            let columns = (block.column_piece, 0, block.column_base, block.columns);
            let (own, walked) = match own_rows {
                true => (rows, columns),
                false => (columns, rows),
            };
            ReduceDispatch {
                own_start: 0,
                out_piece: own.0,
                out_start: own.1,
                own_base: own.2,
                own: own.3,
                walked_start: 0,
                walked_base: walked.2,
                walked: walked.3,
                strips: walked.3.div_ceil(STRIP),
                more: walked.2 > 0,
                bound: vec![(MATRIX, buffer.clone())],
            }
        };
        let counts = match own_rows {
            true => [self.rows, self.columns],
            false => [self.columns, self.rows],
        };
        let sweeps = self.blocks.iter().map(sweep).collect();
        Reducer::of_scores(&self.gpu, counts, own_rows, sweeps)
    }
}

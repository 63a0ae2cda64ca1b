//! Matrices that stay on the GPU.
use super::block::{Block, block_of, place_block};
use super::download::download;
use super::work::{MOST_GROUPS, Params, Work, groups};
use super::written::GROUP;
use super::{Gpu, Pending};
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::{check_upstream, entries, expect};

/// A matrix on the GPU: one number per row of one list and row of another. Clones of a handle are
/// the same numbers.
#[derive(Clone, Debug)]
pub struct Matrix {
    pub(super) gpu: Gpu,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) blocks: Vec<(Block, wgpu::Buffer)>,
}

impl Gpu {
    /// Brings a matrix to the GPU, such as the upstream gradient of all pairs of two lists.
    ///
    /// # Errors
    ///
    /// The input's for a number that is not finite or a slice of another length than
    /// rows times columns, or what the device says.
    pub fn upload_matrix(
        &self,
        rows: usize,
        columns: usize,
        values: &[f32],
    ) -> Result<Matrix, Error> {
        let expected = rows.checked_mul(columns).ok_or(Error::TooLarge)?;
        expect(Argument::Upstream, expected, values.len())?;
        check_upstream(values, 1)?;
        self.inner.guarded(|| {
            let made = Matrix::room(self, rows, columns)?;
            made.write(values);
            Ok(made)
        })
    }
}

impl Matrix {
    /// Room for a matrix.
    pub(super) fn room(gpu: &Gpu, rows: usize, columns: usize) -> Result<Self, Error> {
        entries(rows, columns, 1)?;
        let blocks = gpu.inner.cut(rows, columns, 4).into_iter().map(|block| {
            let values = gpu.inner.storage(block.rows * block.columns);
            (block, values)
        });
        Ok(Matrix {
            gpu: gpu.clone(),
            rows,
            columns,
            blocks: blocks.collect(),
        })
    }

    fn write(&self, values: &[f32]) {
        for (block, buffer) in &self.blocks {
            let inner = &self.gpu.inner;
            inner.write(buffer, &block_of(block, self.columns, values));
        }
    }

    /// The same numbers in other buffers, copied by a kernel: also how fast memory can be had.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn duplicate(&self) -> Result<Matrix, Error> {
        let made = || Matrix::room(&self.gpu, self.rows, self.columns);
        let mut to = self.gpu.inner.guarded(made)?;
        self.duplicate_into(&mut to)?;
        Ok(to)
    }

    /// [`duplicate`](Matrix::duplicate) over numbers that are there already.
    ///
    /// # Errors
    ///
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer), [`Error::Length`] for a matrix of another size, or what
    /// the device says.
    pub fn duplicate_into(&self, to: &mut Matrix) -> Result<(), Error> {
        self.gpu
            .fits(to, self.rows, self.columns, Argument::Values)?;
        let inner = &self.gpu.inner;
        inner.guarded(|| {
            let pipeline = inner.gather_pipeline("copy_main");
            let mut work = Work::new(inner);
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

    /// Puts another matrix of the same size in its place, without a new buffer.
    ///
    /// # Errors
    ///
    /// The input's for another size or a number that is not finite, or what the device
    /// says.
    pub fn update(&mut self, values: &[f32]) -> Result<(), Error> {
        expect(Argument::Upstream, self.rows * self.columns, values.len())?;
        check_upstream(values, 1)?;
        self.gpu.inner.guarded(|| {
            self.write(values);
            Ok(())
        })
    }

    /// How many rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }
    /// How many columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Starts bringing the matrix back, row by row.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<Pending<Vec<f32>>, Error> {
        let (rows, columns) = (self.rows, self.columns);
        let blocks: Vec<Block> = self.blocks.iter().map(|&(block, _)| block).collect();
        let parts: Vec<_> = self
            .blocks
            .iter()
            .map(|(block, buffer)| (buffer, 4 * (block.rows * block.columns) as u64))
            .collect();
        let arrival = self.gpu.inner.bring(&self.gpu, &parts)?;
        Ok(Pending::new(arrival, move |arrival| {
            let mut all = vec![0.0; rows * columns];
            arrival.read(|part, numbers| {
                let numbers = bytemuck::cast_slice(numbers);
                place_block(&blocks[part], columns, numbers, &mut all);
            })?;
            Ok(all)
        }))
    }
}

/// Numbers that a dispatch copies at most.
const MOST_COPIED: usize = MOST_GROUPS * GROUP;

impl Gpu {
    /// Refuses a matrix of another context or another size.
    pub(super) fn fits(
        &self,
        matrix: &Matrix,
        rows: usize,
        columns: usize,
        argument: Argument,
    ) -> Result<(), Error> {
        self.owns(&matrix.gpu)?;
        expect(argument, rows, matrix.rows)?;
        expect(argument, columns, matrix.columns)
    }
}

download! {
    [] Matrix => Vec<f32>;
}

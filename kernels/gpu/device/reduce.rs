//! Reductions on the GPU, of all pairs of two lists or of a stored matrix.
//!
//! The matrix of two lists is never stored as a whole, which bounds the memory.
use super::context::Device;
use super::data::BufferPiece;
use super::download::DevicePending;
use super::download::{downloads, parts};
use super::reducer::Reducer;
use super::seed::sum_of;
use super::work::{Commands, groups};
use super::written::{Kernel, Take};
use crate::Error;
use crate::kernels::machine::found::Best;
use crate::kernels::machine::{self, Downloads};
use crate::kernels::machine::{Reduced, Reduction};

/// The largest score of every row (or column) and its index, on the GPU.
#[derive(Clone, Debug)]
pub struct DeviceBests {
    gpu: Device,
    values: Vec<BufferPiece>,
    indices: Vec<BufferPiece>,
}

impl DeviceBests {
    /// Checks that the results belong to a context.
    pub(crate) fn is_of(&self, gpu: &Device) -> Result<(), Error> {
        gpu.owns(&self.gpu)
    }

    /// Starts the download of the scores, in the order of the rows (or columns).
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<DevicePending<Vec<Best>>, Error> {
        let mut all = parts(&self.values, |n| n);
        all.extend(parts(&self.indices, |n| n));
        let arrival = self.gpu.inner.bring(&self.gpu, &all)?;
        let half = self.values.len();
        Ok(DevicePending::new(arrival, move |arrival| {
            let (mut values, mut indices): (Vec<f32>, Vec<u32>) = (Vec::new(), Vec::new());
            arrival.read(|part, numbers| {
                if part < half {
                    values.extend_from_slice(bytemuck::cast_slice(numbers));
                } else {
                    indices.extend_from_slice(numbers);
                }
            })?;
            let pairs = values.iter().zip(&indices);
            Ok(pairs
                .map(|(&value, &index)| Best {
                    value,
                    index: index as usize,
                })
                .collect())
        }))
    }
}

impl Downloads<Vec<Best>> for DeviceBests {
    downloads!(Vec<Best>);
}

impl Reducer<'_> {
    /// Returns the largest score of every own row (or column).
    pub fn best(self) -> Result<DeviceBests, Error> {
        let inner = &self.gpu.inner;
        inner.guarded(|| {
            let pipeline = self.pipeline(Take::Best);
            let gather = inner.written(Kernel::Gather, "best_of_strips_main");
            let values = inner.pieces(self.own);
            let indices = inner.pieces(self.own);
            for sweep in &self.sweeps {
                let part_values = inner.storage(sweep.room());
                let part_indices = inner.storage(sweep.room());
                let mut work = Commands::new(inner);
                let buffers = sweep.buffers(&[(4, &part_values), (7, &part_indices)]);
                work.dispatch(&pipeline, sweep.params(0.0), &buffers, self.size(sweep));
                let buffers = [
                    (3, &part_values),
                    (8, &part_indices),
                    (4, &values[sweep.out_piece].buffer),
                    (7, &indices[sweep.out_piece].buffer),
                ];
                let size = [groups(sweep.own), 1];
                work.dispatch(&gather, sweep.params(0.0), &buffers, size);
                work.submit()?;
            }
            Ok(DeviceBests {
                gpu: self.gpu.clone(),
                values,
                indices,
            })
        })
    }

    /// Downloads one number per own row and strip, and passes them to `each`.
    fn totals(self, take: Take, threshold: f32, mut each: impl FnMut(&[u32])) -> Result<(), Error> {
        let inner = &self.gpu.inner;
        let binding = if take == Take::Count { 7 } else { 4 };
        for sweep in &self.sweeps {
            let totals = inner.guarded(|| {
                let pipeline = self.pipeline(take);
                let totals = inner.storage(sweep.room());
                let mut work = Commands::new(inner);
                let buffers = sweep.buffers(&[(binding, &totals)]);
                work.dispatch(
                    &pipeline,
                    sweep.params(threshold),
                    &buffers,
                    self.size(sweep),
                );
                work.submit()?;
                Ok(totals)
            })?;
            inner
                .bring(self.gpu, &[(&totals, 4 * sweep.room() as u64)])?
                .finish(|_, numbers| each(numbers))?;
        }
        Ok(())
    }

    pub fn count_above(self, threshold: f32) -> Result<u64, Error> {
        let mut count = 0;
        self.totals(Take::Count, threshold, |numbers| {
            count += numbers.iter().map(|&n| u64::from(n)).sum::<u64>();
        })?;
        Ok(count)
    }

    pub fn sum(self) -> Result<f64, Error> {
        let mut sum = 0.0;
        self.totals(Take::Sum, 0.0, |numbers| sum += sum_of(numbers))?;
        Ok(sum)
    }
}

impl Reducer<'_> {
    /// Computes a reduction.
    pub fn reduced(self, reduction: Reduction<f32>) -> Result<Reduced<f32>, Error> {
        Ok(match reduction {
            Reduction::Best { .. } => {
                let among = self.walked;
                Reduced::Bests(machine::Bests::new(self.best()?, among))
            }
            Reduction::Above(threshold) => {
                Reduced::Founds(machine::Founds::new(self.above(threshold)?))
            }
            Reduction::Count(threshold) => Reduced::Count(self.count_above(threshold)?),
            Reduction::Sum => Reduced::Sum(self.sum()?),
        })
    }
}

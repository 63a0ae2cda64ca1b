//! Two lists on the GPU and the kernels of their pairs.
use super::context::Device;
use super::generated::operation::Generated;
use super::generated::uploaded::UploadedLists;
use super::matrix::DeviceMatrix;
use super::reducer::{LISTS, ListPart, Reducer};
use super::seed::PairSeed;
use crate::Error;
use crate::error::Argument;
use crate::kernels::call::recording::Call;
use crate::kernels::machine::Column;
use crate::kernels::machine::Founds;
use crate::kernels::machine::GroupSpans;
use crate::kernels::machine::found::Best;
use crate::kernels::machine::{GroupedReduction, Reduced, Reduction};
use std::sync::Arc;

/// Two lists on the GPU and the kernels of their pairs.
pub(crate) struct DeviceLists<'a> {
    gpu: &'a Device,
    made: Arc<Generated<f32>>,
    sides: UploadedLists,
}

impl<'a> DeviceLists<'a> {
    /// Checks and uploads two lists; those that stay on the GPU are prepared once.
    pub fn new(
        gpu: &'a Device,
        call: &Call<f32>,
        columns: &[Column<'_, f32>; 2],
    ) -> Result<Self, Error> {
        let made = call.generated(true)?;
        let sides = UploadedLists::of(gpu, &made, columns)?;
        let made = sides.body_for(made);
        Ok(DeviceLists { gpu, made, sides })
    }

    /// Writes results of one number to a matrix.
    pub fn matrix_into(&self, matrix: &mut DeviceMatrix) -> Result<(), Error> {
        let [rows, columns] = self.sides.counts();
        self.gpu.fits(matrix, rows, columns, Argument::Values)?;
        for (block, values) in &matrix.blocks {
            self.sides
                .compute(&self.gpu.inner, &self.made, block, values)?;
        }
        Ok(())
    }

    /// Reduces all results.
    pub fn reduce(&self, reduction: Reduction<f32>) -> Result<Reduced<f32>, Error> {
        let own_rows = reduction != Reduction::Best { of_rows: false };
        let reducer = Reducer::of_lists(self.gpu, &self.made, &self.sides, own_rows);
        reducer.reduced(reduction)
    }

    /// Returns the runs of a list that lie in one buffer each, with their results in one buffer, too.
    fn parts(&self, k: usize) -> Vec<ListPart> {
        let (chunk, count) = (self.gpu.inner.chunk, self.sides.counts()[k]);
        let pieces = (0..count)
            .step_by(chunk)
            .map(|base| base..count.min(base + chunk));
        let all = pieces.flat_map(|piece| self.sides.parts(k, piece));
        let part = |(buffer, at, shapes): (&wgpu::Buffer, usize, _)| ListPart {
            buffer: buffer.clone(),
            binding: LISTS[k],
            at,
            shapes,
        };
        all.map(part).collect()
    }

    /// Returns the reducer of the pairs within groups.
    fn grouped(&self, groups: GroupSpans<'_>, own_rows: bool) -> Result<Reducer<'_>, Error> {
        let [a, b] = [self.parts(0), self.parts(1)];
        let (parts, offsets) = match own_rows {
            true => ([&a[..], &b[..]], [groups.a, groups.b]),
            false => ([&b[..], &a[..]], [groups.b, groups.a]),
        };
        Reducer::of_groups(self.gpu, &self.made, parts, offsets, own_rows)
    }

    /// Reduces the pairs within groups.
    pub fn reduce_grouped(
        &self,
        groups: GroupSpans<'_>,
        reduction: GroupedReduction<f32>,
    ) -> Result<Reduced<f32>, Error> {
        Ok(match reduction {
            GroupedReduction::Best { of_rows } => {
                Reduced::BestsGrouped(self.most_grouped(groups, of_rows)?)
            }
            GroupedReduction::Above(threshold) => {
                let found = self.grouped(groups, true)?.above(threshold)?;
                Reduced::Founds(Founds::new(found))
            }
        })
    }

    /// Returns the largest score of every row, or of every column, within its group; `None` for one without pairs.
    fn most_grouped(
        &self,
        groups: GroupSpans<'_>,
        of_rows: bool,
    ) -> Result<Vec<Option<Best>>, Error> {
        let found = self.grouped(groups, of_rows)?.best()?;
        let mut best: Vec<_> = found
            .start_download()?
            .wait()?
            .into_iter()
            .map(Some)
            .collect();
        let (own, others) = match of_rows {
            true => (groups.a, groups.b),
            false => (groups.b, groups.a),
        };
        for (own, others) in own.windows(2).zip(others.windows(2)) {
            if others[0] == others[1] {
                best[own[0]..own[1]].fill(None);
            }
        }
        Ok(best)
    }

    /// Returns the summed derivatives of both lists. If one factor is the seed of all pairs, bodies that compute
    /// results with derivatives also return the sum of the results.
    pub fn derivatives(&self, seed: &PairSeed<'_>) -> Result<([Vec<f32>; 2], Option<f64>), Error> {
        if let PairSeed::Matrix(matrix) = seed {
            let [rows, columns] = self.sides.counts();
            self.gpu.fits(matrix, rows, columns, Argument::Upstream)?;
        }
        self.gpu.derivatives(&self.made, &self.sides, seed)
    }
}

//! Two lists on the GPU and the kernels of their pairs.
use super::generated::operation::Generated;
use super::generated::uploaded::Sides;
use super::seed::Seed;
use super::table::Table;
use super::{Device, Matrix};
use crate::Error;
use crate::error::Argument;
use crate::kernels::item::Column;
use crate::kernels::machine::{Reduced, Reduction};
use crate::kernels::recording::Call;
use std::sync::Arc;

/// Two lists on the GPU and the kernels of their pairs.
pub(crate) struct Lists<'a> {
    gpu: &'a Device,
    made: Arc<Generated<f32>>,
    sides: Sides,
}

impl<'a> Lists<'a> {
    /// Two lists, checked; those that stay are prepared once.
    pub fn new(
        gpu: &'a Device,
        call: &Call<f32>,
        columns: &[Column<'_, f32>; 2],
    ) -> Result<Self, Error> {
        let made = call.generated(true)?;
        let sides = Sides::of(gpu, &made, columns)?;
        let made = sides.body_for(made);
        Ok(Lists { gpu, made, sides })
    }

    /// Results of one number over a matrix.
    pub fn matrix_into(&self, matrix: &mut Matrix) -> Result<(), Error> {
        let [rows, columns] = self.sides.counts();
        self.gpu.fits(matrix, rows, columns, Argument::Values)?;
        for (block, values) in &matrix.blocks {
            self.sides
                .compute(&self.gpu.inner, &self.made, block, values)?;
        }
        Ok(())
    }

    /// A reduction of all results.
    pub fn reduce(&self, reduction: Reduction<f32>) -> Result<Reduced<f32>, Error> {
        let own_rows = reduction != Reduction::Best { of_rows: false };
        Table::of_lists(self.gpu, &self.made, &self.sides, own_rows).reduced(reduction)
    }

    /// The numbers of the derivatives of both lists, of lists that were made for adjoints.
    /// With one factor for all, bodies that give results beside derivatives also add these up.
    pub fn derivatives(&self, seed: &Seed<'_>) -> Result<([Vec<f32>; 2], Option<f64>), Error> {
        if let Seed::Matrix(matrix) = seed {
            let [rows, columns] = self.sides.counts();
            self.gpu.fits(matrix, rows, columns, Argument::Upstream)?;
        }
        self.gpu.derivatives(&self.made, &self.sides, seed)
    }
}

//! Two lists on the GPU, whatever computes their pairs: one front for kernels by hand and generated ones.
//!
//! Scores of boxes in the plane have kernels by hand, everything else has generated ones. Which of them run is
//! decided here and nowhere else.
use super::generated::held::held;
use super::generated::operation::Generated;
use super::generated::uploaded::Sides;
use super::mirrored::Mirrored;
use super::seed::Seed;
use super::table::Table;
use super::{Device, Matrix};
use crate::Error;
use crate::error::Argument;
use crate::kernels::cpu::checked::check_argument;
use crate::kernels::item::Column;
use crate::kernels::machine::{Reduced, Reduction};
use crate::kernels::recording::Call;
use std::sync::Arc;

/// The kernels of all pairs, and the lists as they want them.
enum Kernels {
    ByHand(Mirrored),
    Generated(Arc<Generated<f32>>, Sides),
}

/// Two lists on the GPU and the kernels of their pairs.
pub(crate) struct Lists<'a> {
    gpu: &'a Device,
    counts: [usize; 2],
    kernels: Kernels,
}

impl<'a> Lists<'a> {
    /// Two lists, checked; those that stay are prepared once.
    pub fn new(
        gpu: &'a Device,
        call: &Call<f32>,
        columns: &[Column<'_, f32>; 2],
    ) -> Result<Self, Error> {
        let inner = &gpu.inner;
        let kernels = match call.mirror() {
            Some(mirror) => {
                inner.alive()?;
                let face = call.plan(true)?;
                let boxes = |k: usize| match held(gpu, &columns[k])? {
                    Some(column) => column.boxes(mirror.kind),
                    None => {
                        check_argument(k, &face.arguments, &columns[k])?;
                        let numbers = columns[k].all();
                        inner.guarded(|| Ok(inner.boxes(mirror.kind, &numbers, None)))
                    }
                };
                let (a, b) = (boxes(0)?, boxes(1)?);
                Kernels::ByHand(Mirrored { mirror, a, b })
            }
            None => {
                let made = call.generated(true)?;
                let sides = Sides::of(gpu, &made, columns)?;
                Kernels::Generated(made, sides)
            }
        };
        Ok(Lists {
            gpu,
            counts: columns.each_ref().map(Column::len),
            kernels,
        })
    }

    /// Results of one number as a matrix.
    pub fn matrix(&self) -> Result<Matrix, Error> {
        let [rows, columns] = self.counts;
        let made = || Matrix::room(self.gpu, rows, columns);
        let mut matrix = self.gpu.inner.guarded(made)?;
        self.matrix_into(&mut matrix)?;
        Ok(matrix)
    }

    /// The same over a matrix that is there already.
    pub fn matrix_into(&self, matrix: &mut Matrix) -> Result<(), Error> {
        let [rows, columns] = self.counts;
        self.gpu.fits(matrix, rows, columns, Argument::Values)?;
        match &self.kernels {
            Kernels::ByHand(lists) => lists.fill(matrix),
            Kernels::Generated(made, sides) => {
                for (block, values) in &matrix.blocks {
                    sides.compute(&self.gpu.inner, made, block, values)?;
                }
                Ok(())
            }
        }
    }

    /// All pairs as a reduction sees them.
    fn table(&self, own_rows: bool) -> Table<'_> {
        match &self.kernels {
            Kernels::ByHand(lists) => Table::of_lists(self.gpu, lists, own_rows),
            Kernels::Generated(made, sides) => Table::of_generated(self.gpu, made, sides, own_rows),
        }
    }

    /// A reduction of all results.
    pub fn reduce(&self, reduction: Reduction<f32>) -> Result<Reduced<f32>, Error> {
        let own_rows = reduction != Reduction::Best { of_rows: false };
        self.table(own_rows).reduced(reduction)
    }

    /// The numbers of the derivatives of both lists, of lists that were made for adjoints.
    /// With one factor for all kernels by hand also add up the results.
    pub fn derivatives(&self, seed: &Seed<'_>) -> Result<([Vec<f32>; 2], Option<f64>), Error> {
        if let Seed::Matrix(matrix) = seed {
            let [rows, columns] = self.counts;
            self.gpu.fits(matrix, rows, columns, Argument::Upstream)?;
        }
        match &self.kernels {
            Kernels::ByHand(lists) => {
                let (derivatives, sum) = lists.derivatives(self.gpu, seed)?;
                Ok((derivatives, Some(sum)))
            }
            Kernels::Generated(made, sides) => Ok((self.gpu.derivatives(made, sides, seed)?, None)),
        }
    }
}

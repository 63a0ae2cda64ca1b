//! Two lists on the GPU, whatever computes their pairs: one front for kernels by hand and generated ones.
//!
//! Scores of boxes in the plane have kernels by hand, everything else has generated ones. Which of them run is
//! decided here and nowhere else.
use super::data::Boxes;
use super::generated::held::HeldColumn;
use super::generated::operation::Generated;
use super::generated::uploaded::Sides;
use super::mirrored::Mirrored;
use super::seed::Seed;
use super::table::Table;
use super::{Bests, Founds, Gpu, Matrix};
use crate::Error;
use crate::error::Argument;
use crate::kernels::Single;
use crate::kernels::cpu::checked::check_argument;
use crate::kernels::item::Column;
use crate::kernels::op::Runs;
use crate::kernels::recording::{Call, Mode};
use crate::kernels::reduce::{Loss, check_sides, check_threshold};
use std::sync::Arc;

/// The kernels of all pairs, and the lists as they want them.
enum Kernels {
    ByHand(Mirrored),
    Generated(Arc<Generated<f32>>, Sides),
}

/// Two lists on the GPU and the kernels of their pairs.
pub(crate) struct Lists<'a> {
    gpu: &'a Gpu,
    counts: [usize; 2],
    kernels: Kernels,
}

impl<'a> Lists<'a> {
    /// The lists of slices, which are checked and brought up.
    pub fn of_slices<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R: Runs<(A, B)>>(
        gpu: &'a Gpu,
        run: &R,
        a: &[A],
        b: &[B],
    ) -> Result<Self, Error> {
        let columns = [Column::of(a), Column::of(b)];
        Self::of_columns(gpu, &run.call()?, &columns)
    }

    /// The same of columns of numbers.
    pub fn of_columns(
        gpu: &'a Gpu,
        call: &Call<f32>,
        columns: &[Column<'_, f32>; 2],
    ) -> Result<Self, Error> {
        let [a, b] = columns;
        let counts = [a.len(), b.len()];
        let inner = &gpu.inner;
        let kernels = match call.mirror() {
            Some(mirror) => {
                inner.alive()?;
                let face = call.plan(true)?;
                check_argument(0, &face.arguments, a)?;
                check_argument(1, &face.arguments, b)?;
                let boxes = |column: &Column<'_, f32>| -> Result<Boxes, Error> {
                    let numbers = column.all();
                    inner.guarded(|| Ok(inner.boxes(mirror.kind, &numbers, None)))
                };
                let (a, b) = (boxes(a)?, boxes(b)?);
                Kernels::ByHand(Mirrored { mirror, a, b })
            }
            None => {
                let made = call.generated(true)?;
                let sides = Sides::new(inner, &made, a, b)?;
                Kernels::Generated(made, sides)
            }
        };
        Ok(Lists {
            gpu,
            counts,
            kernels,
        })
    }

    /// The lists of columns that stay on the GPU.
    pub fn of_held<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R: Runs<(A, B)>>(
        gpu: &'a Gpu,
        run: &R,
        a: &HeldColumn,
        b: &HeldColumn,
    ) -> Result<Self, Error> {
        Lists::of_held_numbers(gpu, &run.call()?, a, b)
    }

    /// The same of a function without the types of its shapes.
    pub fn of_held_numbers(
        gpu: &'a Gpu,
        call: &Call<f32>,
        a: &HeldColumn,
        b: &HeldColumn,
    ) -> Result<Self, Error> {
        gpu.inner.alive()?;
        a.is_of(gpu)?;
        b.is_of(gpu)?;
        let kernels = match call.mirror() {
            Some(mirror) => Kernels::ByHand(Mirrored {
                mirror,
                a: a.boxes(mirror.kind)?,
                b: b.boxes(mirror.kind)?,
            }),
            None => {
                let made = call.generated(true)?;
                let sides = Sides::of_held(&made, a, b)?;
                Kernels::Generated(made, sides)
            }
        };
        Ok(Lists {
            gpu,
            counts: [a.count(), b.count()],
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
    fn table(&self, own_rows: bool) -> Result<Table<'_>, Error> {
        match &self.kernels {
            Kernels::ByHand(lists) => Ok(Table::of_lists(self.gpu, lists, own_rows)),
            Kernels::Generated(made, sides) => {
                Table::of_generated(self.gpu, made, sides, self.counts, own_rows)
            }
        }
    }

    /// The largest of every row and its column, of several the first.
    pub fn row_max(&self) -> Result<Bests, Error> {
        check_sides(self.counts[0], self.counts[1], true)?;
        self.table(true)?.best()
    }
    /// The largest of every column and its row, of several the first.
    pub fn column_max(&self) -> Result<Bests, Error> {
        check_sides(self.counts[0], self.counts[1], false)?;
        self.table(false)?.best()
    }
    /// Every pair above the threshold.
    pub fn above(&self, threshold: f32) -> Result<Founds, Error> {
        check_threshold(threshold)?;
        self.table(true)?.above(threshold)
    }
    /// How many pairs are above the threshold.
    pub fn count_above(&self, threshold: f32) -> Result<u64, Error> {
        check_threshold(threshold)?;
        self.table(true)?.count_above(threshold)
    }
    /// The sum of all results: up to 1024 are added in `f32`, those sums in `f64`, always in the same order.
    pub fn sum(&self) -> Result<f64, Error> {
        self.table(true)?.sum()
    }
    /// The mean of all results; zero where there are none.
    pub fn mean(&self) -> Result<f64, Error> {
        let [rows, columns] = self.counts.map(|n| n as f64);
        Ok(self.sum()? / (rows * columns).max(1.0))
    }

    /// The numbers of the derivatives of both lists, of lists that were made for adjoints.
    pub fn derivatives(&self, seed: &Seed<'_>) -> Result<[Vec<f32>; 2], Error> {
        if let Seed::Matrix(matrix) = seed {
            let [rows, columns] = self.counts;
            self.gpu.fits(matrix, rows, columns, Argument::Upstream)?;
        }
        match &self.kernels {
            Kernels::ByHand(lists) => Ok(lists.derivatives(self.gpu, seed)?.0),
            Kernels::Generated(made, sides) => self.gpu.derivatives(made, sides, seed),
        }
    }
}

/// The sum or mean of all results, and the numbers of its derivatives for both lists. `make` makes the lists of a
/// call.
pub(crate) fn loss<'a>(
    call: Call<f32>,
    make: impl Fn(&Call<f32>) -> Result<Lists<'a>, Error>,
    loss: Loss,
) -> Result<(f64, [Vec<f32>; 2]), Error> {
    let lists = make(&call.clone().derived(Mode::Vjp)?)?;
    let [rows, columns] = lists.counts.map(|n| n as f64);
    let factor = match loss {
        Loss::Sum => 1.0,
        Loss::Mean => 1.0 / (rows * columns).max(1.0),
    };
    let seed = Seed::Factor(factor as f32);
    let (derivatives, sum) = match &lists.kernels {
        Kernels::ByHand(own) => own.derivatives(lists.gpu, &seed)?,
        Kernels::Generated(..) => (lists.derivatives(&seed)?, make(&call)?.sum()?),
    };
    Ok((sum * factor, derivatives))
}

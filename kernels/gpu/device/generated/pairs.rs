//! Every row with every column.
use super::uploaded::Sides;
use crate::Error;
use crate::kernels::gpu::device::Gpu;
use crate::kernels::gpu::device::block::place_block;
use crate::kernels::gpu::device::lists::Lists;
use crate::kernels::item::Column;
use crate::kernels::op::Runs;
use crate::kernels::recording::Call;
use crate::kernels::reduce::{Best, Found};
use crate::kernels::{Single, Table};
use crate::suppression::Pair;

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

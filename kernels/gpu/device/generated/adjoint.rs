//! The adjoint of all pairs: derivatives summed for every shape, in a fixed order.
use super::operation::Generated;
use super::text::{Form, GROUP, STRIP};
use super::uploaded::Sides;
use crate::Error;
use crate::error::Argument;
use crate::kernels::Single;
use crate::kernels::cpu::checked::{check_upstream, entries, expect};
use crate::kernels::gpu::device::Gpu;
use crate::kernels::gpu::device::block::block_of;
use crate::kernels::gpu::device::lists::{Lists, loss};
use crate::kernels::gpu::device::seed::Seed;
use crate::kernels::gpu::device::work::Work;
use crate::kernels::item::Column;
use crate::kernels::op::Runs;
use crate::kernels::recording::{Call, Mode};
use crate::kernels::reduce::Loss;
use std::sync::Arc;

impl Gpu {
    /// The adjoint of [`all_pairs`](Gpu::all_pairs) for one number as result, as
    /// [`Cpu::all_pairs_vjp`](crate::kernels::Cpu::all_pairs_vjp).
    ///
    /// # Errors
    ///
    /// As on the processor; [`Error::Program`] for what searches, [`Error::Gpu`] for what the device says.
    pub fn all_pairs_vjp<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        upstream: &[f32],
    ) -> Result<(Vec<A>, Vec<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        let lists = [Column::of(a), Column::of(b)];
        Ok(shapes(self.pulled(&run.call()?, &lists, upstream)?))
    }

    /// The adjoint of all pairs of columns of numbers.
    pub(crate) fn pulled(
        &self,
        call: &Call<f32>,
        columns: &[Column<'_, f32>; 2],
        upstream: &[f32],
    ) -> Result<[Vec<f32>; 2], Error> {
        let [a, b] = columns;
        expect(
            Argument::Upstream,
            entries(a.len(), b.len(), 1)?,
            upstream.len(),
        )?;
        check_upstream(upstream, 1)?;
        let lists = Lists::of_columns(self, &call.clone().derived(Mode::Vjp)?, columns)?;
        lists.derivatives(&Seed::Numbers(upstream))
    }

    /// The sum or the mean of all pairs of columns of numbers, and its derivatives.
    pub(crate) fn loss_of(
        &self,
        call: &Call<f32>,
        columns: &[Column<'_, f32>; 2],
        of: Loss,
    ) -> Result<(f64, [Vec<f32>; 2]), Error> {
        loss(
            call.clone(),
            |call| Lists::of_columns(self, call, columns),
            of,
        )
    }

    /// The sum of all results and its derivatives with respect to every shape of both lists, as
    /// [`Cpu::sum_grad`](crate::kernels::Cpu::sum_grad).
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Gpu::all_pairs_vjp).
    pub fn sum_grad<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<(f64, Vec<A>, Vec<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        self.loss(run, a, b, Loss::Sum)
    }

    /// The mean of all results and its derivatives, zeros where there are no pairs, as
    /// [`Cpu::mean_grad`](crate::kernels::Cpu::mean_grad).
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Gpu::all_pairs_vjp).
    pub fn mean_grad<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<(f64, Vec<A>, Vec<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        self.loss(run, a, b, Loss::Mean)
    }

    fn loss<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        of: Loss,
    ) -> Result<(f64, Vec<A>, Vec<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        let columns = [Column::of(a), Column::of(b)];
        let (value, derivatives) = self.loss_of(&run.call()?, &columns, of)?;
        let (a_bar, b_bar) = shapes(derivatives);
        Ok((value, a_bar, b_bar))
    }

    /// The numbers of the derivatives of both lists: strips of pairs are added in `f32`, those sums in `f64`, always
    /// in the same order.
    pub(in crate::kernels::gpu::device) fn derivatives(
        &self,
        made: &Arc<Generated<f32>>,
        sides: &Sides,
        seed: &Seed<'_>,
    ) -> Result<[Vec<f32>; 2], Error> {
        let [rows, columns] = sides.counts();
        let a = self.sums(made, sides, seed, Form::RowDerivatives, rows)?;
        let b = self.sums(made, sides, seed, Form::ColumnDerivatives, columns)?;
        Ok([a, b].map(|sums| sums.iter().map(|&x| x as f32 + 0.0).collect()))
    }

    /// The sums of derivatives of one list, shape by shape.
    fn sums(
        &self,
        made: &Arc<Generated<f32>>,
        sides: &Sides,
        seed: &Seed<'_>,
        form: Form,
        count: usize,
    ) -> Result<Vec<f64>, Error> {
        let inner = &self.inner;
        let [rows, columns] = sides.counts();
        let body = form.body(made);
        let fields = body.gives;
        let mut sums = vec![0.0; count * fields];
        for (k, block) in inner.cut(rows, columns, 4).into_iter().enumerate() {
            let stored = |numbers: &[f32]| inner.guarded(|| Ok(inner.stored(numbers)));
            let (upstream, params) = match seed {
                Seed::Numbers(numbers) => {
                    (stored(&block_of(&block, columns, numbers))?, [0, 0, 0, 0])
                }
                // A matrix is cut as the pairs are.
                Seed::Matrix(matrix) => (matrix.blocks[k].1.clone(), [0, 0, 0, 0]),
                Seed::Factor(factor) => (stored(&[])?, [factor.to_bits(), 1, 0, 0]),
            };
            for mut piece in sides.pieces(&block, body.operations) {
                piece.params.push(params);
                let (own, walked, first) = match form {
                    Form::RowDerivatives => (
                        piece.rows,
                        piece.columns,
                        block.row_base + piece.params[1][2] as usize,
                    ),
                    _ => (
                        piece.columns,
                        piece.rows,
                        block.column_base + piece.params[1][3] as usize,
                    ),
                };
                let strips = walked.div_ceil(STRIP);
                let numbers = strips * fields * own;
                let partial = inner.guarded(|| {
                    let pipeline = inner.generated(&made.name, form, || form.text(made));
                    let partial = inner.storage(numbers);
                    let mut work = Work::new(inner);
                    let [a, b] = piece.buffers;
                    let buffers = [(1, a), (2, b), (3, &upstream), (4, &partial)];
                    let groups = [own.div_ceil(GROUP) as u32, strips as u32];
                    work.dispatch_with(&pipeline, &piece.params, &buffers, groups);
                    work.submit()?;
                    Ok(partial)
                })?;
                let arrival = inner.bring(self, &[(&partial, 4 * numbers as u64)])?;
                arrival.finish(|_, numbers| {
                    let numbers: &[f32] = bytemuck::cast_slice(numbers);
                    for strip in numbers.chunks_exact(fields * own) {
                        for (k, plane) in strip.chunks_exact(own).enumerate() {
                            for (i, &x) in plane.iter().enumerate() {
                                sums[(first + i) * fields + k] += f64::from(x);
                            }
                        }
                    }
                })?;
            }
        }
        Ok(sums)
    }
}

/// Shapes from their numbers.
fn shapes<A: Single<Scalar = f32>, B: Single<Scalar = f32>>(
    [a, b]: [Vec<f32>; 2],
) -> (Vec<A>, Vec<B>) {
    (
        a.chunks_exact(A::LEN.max(1)).map(A::load).collect(),
        b.chunks_exact(B::LEN.max(1)).map(B::load).collect(),
    )
}

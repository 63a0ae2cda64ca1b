//! The adjoint of all pairs: derivatives summed for every shape, in a fixed order.
use super::operation::Generated;
use super::text::{Form, GROUP, STRIP};
use super::uploaded::Sides;
use crate::Error;
use crate::kernels::gpu::device::Device;
use crate::kernels::gpu::device::block::block_of;
use crate::kernels::gpu::device::seed::Seed;
use crate::kernels::gpu::device::work::Work;
use std::sync::Arc;

impl Device {
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

//! All pairs: every row with every column.
use super::uploaded::UploadedLists;
use crate::Error;
use crate::kernels::call::recording::Call;
use crate::kernels::gpu::device::block::place_block;
use crate::kernels::gpu::device::context::Device;
use crate::kernels::machine::Column;

impl Device {
    /// Writes the results of every row with every column of plain lists, plane after plane.
    pub(in crate::kernels::gpu::device) fn planes(
        &self,
        call: &Call<f32>,
        lists: &[Column<'_, f32>; 2],
        planes: &mut [f32],
    ) -> Result<(), Error> {
        let inner = &self.inner;
        let made = call.generated(true)?;
        let sides = UploadedLists::of(self, &made, lists)?;
        let made = sides.body_for(made);
        let [rows, columns] = sides.counts();
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
}

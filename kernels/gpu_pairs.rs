//! Batches of pairs on the GPU.
use super::data::{block_of, place_block};
use super::source::{GpuPair, Kernel, STEP, STRIP_VJP, Source, pair_source};
use super::work::{Params, Work, groups};
use super::{Bars, Gpu, Inner, Matrix, Shapes, Values};
use crate::Fixed;
use crate::error::{Argument, Error};
use crate::kernels::GpuError;
use crate::kernels::cpu::PairGrads;
use crate::kernels::tile::{check_upstream, expect};

/// Shapes of an operation on the GPU.
pub type ShapesOf<O> = Shapes<<O as GpuPair>::Shape>;
/// Slopes with respect to them.
pub type BarsOf<O> = Bars<<O as GpuPair>::Shape>;

impl Inner {
    /// A pipeline of an operation of pairs.
    pub fn pair_pipeline<O: GpuPair>(
        &self,
        source: Source,
        entry: &'static str,
    ) -> wgpu::ComputePipeline {
        self.pipeline(source, entry, || pair_source::<O>(source))
    }

    /// The pipeline that copies numbers; the operation does not matter.
    pub fn copy_pipeline(&self) -> wgpu::ComputePipeline {
        let source = Source::of(Kernel::Gather, "any");
        self.pair_pipeline::<crate::kernels::overlap::IouAabb2>(source, "copy_main")
    }
}

/// The shader of an operation for two lists.
pub(super) fn source_for<O: GpuPair>(kernel: Kernel, a: &ShapesOf<O>, b: &ShapesOf<O>) -> Source {
    Source {
        extreme: !(a.is_ordinary && b.is_ordinary),
        ..Source::of(kernel, O::NAME)
    }
}

impl Gpu {
    fn aligned_lists<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<Source, GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        expect(Argument::B, a.len, b.len)?;
        Ok(source_for::<O>(Kernel::Aligned, a, b))
    }

    /// Row i of `a` with row i of `b`: one result per row.
    ///
    /// # Errors
    ///
    /// [`GpuError::Input`] when the lists differ in length, [`GpuError::ForeignBuffer`], or what
    /// the device says.
    pub fn aligned<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<Values, GpuError> {
        let source = self.aligned_lists::<O>(a, b)?;
        let inner = &self.inner;
        inner.guarded(|| {
            let pipeline = inner.pair_pipeline::<O>(source, "aligned_main");
            let values = Values {
                gpu: self.clone(),
                pieces: inner.pieces(a.len, 1),
                len: a.len,
            };
            let mut work = Work::new(inner);
            for ((a, b), out) in a.pieces.iter().zip(&b.pieces).zip(&values.pieces) {
                let buffers = [(1, &a.buffer), (2, &b.buffer), (4, &out.buffer)];
                work.dispatch(
                    &pipeline,
                    aligned_params(a.items),
                    &buffers,
                    [groups(a.items), 1],
                );
            }
            work.submit()?;
            Ok(values)
        })
    }

    /// [`aligned`](Gpu::aligned) with the slopes of every result with respect to both shapes.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Gpu::aligned).
    pub fn aligned_grad<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<(Values, BarsOf<O>, BarsOf<O>), GpuError> {
        let source = self.aligned_lists::<O>(a, b)?;
        let inner = &self.inner;
        inner.guarded(|| {
            let pipeline = inner.pair_pipeline::<O>(source, "aligned_grad_main");
            let values = Values {
                gpu: self.clone(),
                pieces: inner.pieces(a.len, 1),
                len: a.len,
            };
            let (a_bars, b_bars) = (Bars::new(self, a.len), Bars::new(self, a.len));
            let mut work = Work::new(inner);
            for (i, (a, b)) in a.pieces.iter().zip(&b.pieces).enumerate() {
                let buffers = [
                    (1, &a.buffer),
                    (2, &b.buffer),
                    (4, &values.pieces[i].buffer),
                    (5, &a_bars.pieces[i].buffer),
                    (6, &b_bars.pieces[i].buffer),
                ];
                work.dispatch(
                    &pipeline,
                    aligned_params(a.items),
                    &buffers,
                    [groups(a.items), 1],
                );
            }
            work.submit()?;
            Ok((values, a_bars, b_bars))
        })
    }

    /// The adjoint of [`aligned`](Gpu::aligned): `upstream[i]` times the slopes of result i.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Gpu::aligned), and for an upstream of another length.
    pub fn aligned_vjp<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &Values,
    ) -> Result<(BarsOf<O>, BarsOf<O>), GpuError> {
        let source = self.aligned_lists::<O>(a, b)?;
        self.owns(&upstream.gpu)?;
        expect(Argument::Upstream, a.len, upstream.len)?;
        let inner = &self.inner;
        inner.guarded(|| {
            let pipeline = inner.pair_pipeline::<O>(source, "aligned_vjp_main");
            let (a_bars, b_bars) = (Bars::new(self, a.len), Bars::new(self, a.len));
            let mut work = Work::new(inner);
            for (i, (a, b)) in a.pieces.iter().zip(&b.pieces).enumerate() {
                let buffers = [
                    (1, &a.buffer),
                    (2, &b.buffer),
                    (3, &upstream.pieces[i].buffer),
                    (5, &a_bars.pieces[i].buffer),
                    (6, &b_bars.pieces[i].buffer),
                ];
                work.dispatch(
                    &pipeline,
                    aligned_params(a.items),
                    &buffers,
                    [groups(a.items), 1],
                );
            }
            work.submit()?;
            Ok((a_bars, b_bars))
        })
    }

    /// Every row of `a` with every row of `b`: a matrix that stays on the GPU.
    ///
    /// # Errors
    ///
    /// [`GpuError::ForeignBuffer`], or what the device says.
    pub fn all_pairs<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<Matrix, GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        a.len
            .checked_mul(b.len)
            .filter(|&n| n <= isize::MAX as usize / 8)
            .ok_or(Error::TooLarge)?;
        let inner = &self.inner;
        let matrix = inner.guarded(|| {
            let blocks = inner.cut(a.len, b.len, 4).into_iter().map(|block| {
                let values = inner.storage(block.rows * block.columns);
                (block, values)
            });
            Ok(Matrix {
                gpu: self.clone(),
                rows: a.len,
                columns: b.len,
                blocks: blocks.collect(),
            })
        })?;
        self.all_pairs_into::<O>(a, b, &matrix)?;
        Ok(matrix)
    }

    /// [`all_pairs`](Gpu::all_pairs) over a matrix that is there already: a loop that needs no new
    /// one each time saves clearing it.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs), and [`GpuError::Input`] for a matrix of another size.
    pub fn all_pairs_into<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        matrix: &Matrix,
    ) -> Result<(), GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        self.owns(&matrix.gpu)?;
        expect(Argument::Values, a.len, matrix.rows)?;
        expect(Argument::Values, b.len, matrix.columns)?;
        let inner = &self.inner;
        let source = source_for::<O>(Kernel::Pairs, a, b);
        inner.guarded(|| {
            let pipeline = inner.pair_pipeline::<O>(source, "pairs_main");
            for (block, values) in &matrix.blocks {
                let mut work = Work::new(inner);
                let buffers = [
                    (1, &a.pieces[block.row_piece].buffer),
                    (2, &b.pieces[block.column_piece].buffer),
                    (4, values),
                ];
                let size = [groups(block.columns), block.rows.div_ceil(STEP) as u32];
                work.dispatch(&pipeline, block_params(block), &buffers, size);
                work.submit()?;
            }
            Ok(())
        })
    }

    /// [`all_pairs`](Gpu::all_pairs) with the slopes of every result, brought back block by block.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs).
    pub fn all_pairs_grad<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<PairGrads<O, f32>, GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        let fields = 2 * O::Shape::LEN;
        let mut grads = PairGrads::new(a.len, b.len)?;
        let inner = &self.inner;
        let source = source_for::<O>(Kernel::Pairs, a, b);
        for block in inner.cut(a.len, b.len, 4 * fields as u64) {
            let pairs = block.rows * block.columns;
            let (values, planes) = inner.guarded(|| {
                let pipeline = inner.pair_pipeline::<O>(source, "pairs_grad_main");
                let (values, planes) = (inner.storage(pairs), inner.storage(pairs * fields));
                let mut work = Work::new(inner);
                let buffers = [
                    (1, &a.pieces[block.row_piece].buffer),
                    (2, &b.pieces[block.column_piece].buffer),
                    (4, &values),
                    (5, &planes),
                ];
                let size = [groups(block.columns), block.rows.div_ceil(STEP) as u32];
                work.dispatch(&pipeline, block_params(&block), &buffers, size);
                work.submit()?;
                Ok((values, planes))
            })?;
            let sizes = [
                (&values, 4 * pairs as u64),
                (&planes, 4 * (pairs * fields) as u64),
            ];
            inner.bring(self, &sizes)?.finish(|part, numbers| {
                let numbers = bytemuck::cast_slice(numbers);
                if part == 0 {
                    return place_block(&block, b.len, numbers, &mut grads.values);
                }
                let planes = grads.planes.chunks_exact_mut(a.len * b.len);
                for (from, to) in numbers.chunks_exact(pairs).zip(planes) {
                    place_block(&block, b.len, from, to);
                }
            })?;
        }
        Ok(grads)
    }

    /// The adjoint of [`all_pairs`](Gpu::all_pairs): slopes of `Σ upstream[i, j] · result[i, j]`
    /// with respect to every shape of both lists.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs), and for an upstream of another size.
    pub fn all_pairs_vjp<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &Matrix,
    ) -> Result<(BarsOf<O>, BarsOf<O>), GpuError> {
        self.owns(&upstream.gpu)?;
        expect(Argument::Upstream, a.len, upstream.rows)?;
        expect(Argument::Upstream, b.len, upstream.columns)?;
        let mut blocks = upstream.blocks.iter();
        self.sweep::<O>(a, b, |_| Ok(blocks.next().expect("cut alike").1.clone()))
    }

    /// [`all_pairs_vjp`](Gpu::all_pairs_vjp) with an upstream matrix that is brought to the GPU
    /// block by block.
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Gpu::all_pairs_vjp), and for an upstream that is not finite.
    pub fn all_pairs_vjp_from<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &[f32],
    ) -> Result<(BarsOf<O>, BarsOf<O>), GpuError> {
        let expected = a.len.checked_mul(b.len).ok_or(Error::TooLarge)?;
        expect(Argument::Upstream, expected, upstream.len())?;
        check_upstream(upstream)?;
        self.sweep::<O>(a, b, |block| {
            Ok(self.inner.stored(&block_of(block, b.len, upstream)))
        })
    }

    /// Runs the adjoint over every block of the upstream matrix.
    ///
    /// What a kernel leaves are partial sums: per strip of rows for columns, per workgroup of
    /// columns for rows. They are added block by block, in order.
    fn sweep<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        mut upstream: impl FnMut(&super::data::Block) -> Result<wgpu::Buffer, GpuError>,
    ) -> Result<(BarsOf<O>, BarsOf<O>), GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        let inner = &self.inner;
        let source = Source {
            slots: inner.slots,
            ..source_for::<O>(Kernel::Vjp, a, b)
        };
        inner.guarded(|| {
            let pipeline = inner.pair_pipeline::<O>(source, "pairs_vjp_main");
            let fold = inner.pair_pipeline::<O>(Source::of(Kernel::Fold, "any"), "fold_main");
            let (a_bars, b_bars) = (Bars::new(self, a.len), Bars::new(self, b.len));
            let fields = O::Shape::LEN;
            let cut = inner.cut(a.len, b.len, 4);
            if cut.is_empty() {
                // Sums of nothing: new buffers hold zeros.
                return Ok((a_bars, b_bars));
            }
            for block in cut {
                let upstream = upstream(&block)?;
                let wide = groups(block.columns) as usize;
                let tall = block.rows.div_ceil(STRIP_VJP);
                let row_parts = inner.storage(wide * fields * block.rows);
                let column_parts = inner.storage(tall * fields * block.columns);
                let mut work = Work::new(inner);
                let buffers = [
                    (1, &a.pieces[block.row_piece].buffer),
                    (2, &b.pieces[block.column_piece].buffer),
                    (3, &upstream),
                    (5, &row_parts),
                    (6, &column_parts),
                ];
                let size = [wide as u32, tall as u32];
                work.dispatch(&pipeline, block_params(&block), &buffers, size);
                let a_bar = &a_bars.pieces[block.row_piece].buffer;
                let b_bar = &b_bars.pieces[block.column_piece].buffer;
                let rows = Params {
                    own_count: block.rows as u32,
                    own_start: block.row_start as u32,
                    parts: wide as u32,
                    more: u32::from(block.column_base > 0),
                    fields: fields as u32,
                    ..Params::default()
                };
                let columns = Params {
                    own_count: block.columns as u32,
                    parts: tall as u32,
                    more: u32::from(block.row_base > 0),
                    fields: fields as u32,
                    ..Params::default()
                };
                for (params, from, to) in
                    [(rows, &row_parts, a_bar), (columns, &column_parts, b_bar)]
                {
                    let size = [groups(params.own_count as usize), fields as u32];
                    work.dispatch(&fold, params, &[(3, from), (5, to)], size);
                }
                work.submit()?;
            }
            Ok((a_bars, b_bars))
        })
    }
}

fn aligned_params(items: usize) -> Params {
    Params {
        own_count: items as u32,
        ..Params::default()
    }
}

/// Threads stand for columns and walk through rows.
fn block_params(block: &super::data::Block) -> Params {
    Params {
        own_count: block.columns as u32,
        loop_count: block.rows as u32,
        loop_start: block.row_start as u32,
        ..Params::default()
    }
}

//! All pairs on the GPU: the matrix, its slopes, and the adjoint.
use super::block::{Block, block_of, place_block};
use super::download::download;
use super::source::{GpuPair, Kernel, STEP, STRIP_VJP, Seed, Source, pair_source};
use super::work::{Params, Work, groups};
use super::{Bars, Gpu, Inner, Matrix, Pending, Shapes};
use crate::Fixed;
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::{check_upstream, entries, expect};
use crate::kernels::on_cpu::PairGrads;
use std::marker::PhantomData;

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

    /// A pipeline that moves and gathers numbers; the operation does not matter.
    pub fn gather_pipeline(&self, entry: &'static str) -> wgpu::ComputePipeline {
        self.pair_pipeline::<Any>(Source::of(Kernel::Gather, "any"), entry)
    }
}

/// An operation for shaders in which it does not matter.
pub(super) type Any = crate::kernels::ops::overlap::IouAabb2;

/// The shader of an operation for two lists.
pub(super) fn source_for<O: GpuPair>(kernel: Kernel, a: &ShapesOf<O>, b: &ShapesOf<O>) -> Source {
    Source {
        extreme: !(a.is_ordinary() && b.is_ordinary()),
        ..Source::of(kernel, O::NAME)
    }
}

/// The results of all pairs and their slopes, on the GPU.
#[derive(Clone, Debug)]
pub struct PairBars<O> {
    values: Matrix,
    /// The planes of slopes of every block of the matrix.
    planes: Vec<wgpu::Buffer>,
    operation: PhantomData<fn() -> O>,
}

impl<O: GpuPair> PairBars<O> {
    /// The results alone.
    #[must_use]
    pub fn values(&self) -> &Matrix {
        &self.values
    }

    /// Starts bringing results and slopes back.
    ///
    /// # Errors
    ///
    /// The input's when there are more than memory has addresses, or what the device says.
    pub fn start_download(&self) -> Result<Pending<PairGrads<O>>, Error> {
        let (rows, columns) = (self.values.rows, self.values.columns);
        let fields = 2 * O::Shape::LEN;
        entries(rows, columns, fields)?;
        let mut parts = Vec::new();
        for ((block, values), planes) in self.values.blocks.iter().zip(&self.planes) {
            let bytes = 4 * (block.rows * block.columns) as u64;
            parts.extend([(values, bytes), (planes, bytes * fields as u64)]);
        }
        let gpu = &self.values.gpu;
        let arrival = gpu.inner.bring(gpu, &parts)?;
        let blocks: Vec<Block> = self.values.blocks.iter().map(|part| part.0).collect();
        Ok(Pending::new(arrival, move |arrival| {
            let mut grads = PairGrads::<O>::new(rows, columns)?;
            arrival.read(|part, numbers| {
                let (block, numbers) = (&blocks[part / 2], bytemuck::cast_slice(numbers));
                let (values, slopes) = grads.planes_mut().split_at_mut(rows * columns);
                if part % 2 == 0 {
                    return place_block(block, columns, numbers, values);
                }
                let planes = slopes.chunks_exact_mut(rows * columns);
                let from = numbers.chunks_exact(block.rows * block.columns);
                for (from, to) in from.zip(planes) {
                    place_block(block, columns, from, to);
                }
            })?;
            Ok(grads)
        }))
    }
}

download! {
    [O: GpuPair] PairBars<O> => PairGrads<O>;
}

impl Gpu {
    /// Every row of `a` with every row of `b`: a matrix that stays on the GPU.
    ///
    /// # Errors
    ///
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer), or what the device says.
    pub fn all_pairs<O: GpuPair>(
        &self,
        op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<Matrix, Error> {
        self.own_lists(a, b)?;
        let room = || Matrix::room(self, a.len, b.len);
        let mut matrix = self.inner.guarded(room)?;
        self.all_pairs_into(op, a, b, &mut matrix)?;
        Ok(matrix)
    }

    /// [`all_pairs`](Gpu::all_pairs) over a matrix that is there already: a loop that needs no new
    /// one each time saves clearing it.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs), and The input's for a matrix of another size.
    pub fn all_pairs_into<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        matrix: &mut Matrix,
    ) -> Result<(), Error> {
        self.own_lists(a, b)?;
        self.fits(&matrix.gpu, Argument::Values, a.len, matrix.rows)?;
        expect(Argument::Values, b.len, matrix.columns)?;
        for (block, values) in &matrix.blocks {
            self.run_pairs::<O>(Kernel::Pairs, a, b, block, &[(4, values)])?;
        }
        Ok(())
    }

    /// [`all_pairs`](Gpu::all_pairs) with the slopes of every result, which take eleven times the
    /// memory for rotated boxes. [`all_pairs_vjp`](Gpu::all_pairs_vjp) sums slopes without keeping
    /// them.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs).
    pub fn all_pairs_grad<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<PairBars<O>, Error> {
        self.own_lists(a, b)?;
        let fields = 2 * O::Shape::LEN;
        entries(a.len, b.len, fields)?;
        let mut grads = PairBars {
            values: Matrix {
                gpu: self.clone(),
                rows: a.len,
                columns: b.len,
                blocks: Vec::new(),
            },
            planes: Vec::new(),
            operation: PhantomData,
        };
        let inner = &self.inner;
        for block in inner.cut(a.len, b.len, 4 * fields as u64) {
            let pairs = block.rows * block.columns;
            let (values, planes) =
                inner.guarded(|| Ok((inner.storage(pairs), inner.storage(pairs * fields))))?;
            let bound = [(4, &values), (5, &planes)];
            self.run_pairs::<O>(Kernel::PairsGrad, a, b, &block, &bound)?;
            grads.values.blocks.push((block, values));
            grads.planes.push(planes);
        }
        Ok(grads)
    }

    /// Runs a kernel over one block of all pairs.
    fn run_pairs<O: GpuPair>(
        &self,
        kernel: Kernel,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        block: &Block,
        bound: &[(u32, &wgpu::Buffer)],
    ) -> Result<(), Error> {
        let inner = &self.inner;
        inner.guarded(|| {
            let pipeline = inner.pair_pipeline::<O>(source_for::<O>(kernel, a, b), "pairs_main");
            let mut work = Work::new(inner);
            let mut buffers = vec![
                (1, &a.pieces[block.row_piece].buffer),
                (2, &b.pieces[block.column_piece].buffer),
            ];
            buffers.extend(bound);
            let size = [groups(block.columns), block.rows.div_ceil(STEP) as u32];
            work.dispatch(&pipeline, block_params(block), &buffers, size);
            work.submit().map(drop)
        })
    }

    /// The adjoint of [`all_pairs`](Gpu::all_pairs): slopes of `Σ upstream[i, j] · result[i, j]`
    /// with respect to every shape of both lists.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs), and for an upstream of another size.
    pub fn all_pairs_vjp<O: GpuPair>(
        &self,
        op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &Matrix,
    ) -> Result<(BarsOf<O>, BarsOf<O>), Error> {
        let (mut a_bar, mut b_bar) = self.bars_for::<O>(a, b)?;
        self.all_pairs_vjp_into(op, a, b, upstream, &mut a_bar, &mut b_bar)?;
        Ok((a_bar, b_bar))
    }

    /// [`all_pairs_vjp`](Gpu::all_pairs_vjp) over slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Gpu::all_pairs_vjp), and for slopes of another length.
    pub fn all_pairs_vjp_into<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &Matrix,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), Error> {
        self.own_lists(a, b)?;
        self.fits(&upstream.gpu, Argument::Upstream, a.len, upstream.rows)?;
        expect(Argument::Upstream, b.len, upstream.columns)?;
        self.fit_bars::<O>(a, b, a_bar, b_bar)?;
        let sweep = VjpSweep::new::<O>(self, Seed::Matrix, a, b, a_bar, b_bar)?;
        for (block, upstream) in &upstream.blocks {
            sweep.run(block, 0.0, &[(3, upstream)])?;
        }
        Ok(())
    }

    /// [`all_pairs_vjp`](Gpu::all_pairs_vjp) with an upstream matrix that is brought to the GPU
    /// block by block.
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Gpu::all_pairs_vjp), and for an upstream that is not finite.
    pub fn all_pairs_vjp_from<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &[f32],
    ) -> Result<(BarsOf<O>, BarsOf<O>), Error> {
        let expected = a.len.checked_mul(b.len).ok_or(Error::TooLarge)?;
        expect(Argument::Upstream, expected, upstream.len())?;
        check_upstream(upstream, 1)?;
        let (a_bar, b_bar) = self.bars_for::<O>(a, b)?;
        let sweep = VjpSweep::new::<O>(self, Seed::Matrix, a, b, &a_bar, &b_bar)?;
        let inner = &self.inner;
        for block in inner.cut(a.len, b.len, 4) {
            let own = block_of(&block, b.len, upstream);
            let upstream = inner.guarded(|| Ok(inner.stored(&own)))?;
            sweep.run(&block, 0.0, &[(3, &upstream)])?;
        }
        Ok((a_bar, b_bar))
    }

    /// The sum of all results and its slopes with respect to every shape of both lists: a loss and
    /// its gradient in one pass, without a matrix of results or of upstream slopes. It comes with
    /// the sum as [`sum`](Gpu::sum) gives it.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs).
    pub fn sum_grad<O: GpuPair>(
        &self,
        op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<(f64, BarsOf<O>, BarsOf<O>), Error> {
        let (mut a_bar, mut b_bar) = self.bars_for::<O>(a, b)?;
        let sum = self.sum_grad_into(op, a, b, 1.0, &mut a_bar, &mut b_bar)?;
        Ok((sum, a_bar, b_bar))
    }

    /// The mean of all results and its slopes, as [`sum_grad`](Gpu::sum_grad); zeros where there
    /// are no pairs.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs).
    pub fn mean_grad<O: GpuPair>(
        &self,
        op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<(f64, BarsOf<O>, BarsOf<O>), Error> {
        let (mut a_bar, mut b_bar) = self.bars_for::<O>(a, b)?;
        let factor = 1.0 / (a.len as f64 * b.len as f64).max(1.0);
        let sum = self.sum_grad_into(op, a, b, factor as f32, &mut a_bar, &mut b_bar)?;
        Ok((sum * factor, a_bar, b_bar))
    }

    /// The sum of all results; over slopes that are there already those of the sum times `factor`.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Gpu::all_pairs), and The input's for slopes of another length or a
    /// factor that is not finite.
    pub fn sum_grad_into<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        factor: f32,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<f64, Error> {
        self.own_lists(a, b)?;
        self.fit_bars::<O>(a, b, a_bar, b_bar)?;
        check_upstream(&[factor], 1)?;
        let sweep = VjpSweep::new::<O>(self, Seed::Factor, a, b, a_bar, b_bar)?;
        let inner = &self.inner;
        let mut totals = Vec::new();
        for block in inner.cut(a.len, b.len, 4) {
            let numbers = block.rows.div_ceil(STRIP_VJP) * block.columns;
            let own = inner.guarded(|| Ok(inner.storage(numbers)))?;
            sweep.run(&block, factor, &[(4, &own)])?;
            totals.push((own, 4 * numbers as u64));
        }
        let mut sum = 0.0;
        for (totals, bytes) in &totals {
            inner
                .bring(self, &[(totals, *bytes)])?
                .finish(|_, numbers| sum += super::reduce::sum_of(numbers))?;
        }
        Ok(sum)
    }

    /// Refuses lists of other contexts.
    pub(super) fn own_lists<P>(&self, a: &Shapes<P>, b: &Shapes<P>) -> Result<(), Error> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)
    }

    /// Room for slopes of both lists.
    fn bars_for<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<(BarsOf<O>, BarsOf<O>), Error> {
        self.own_lists(a, b)?;
        self.inner
            .guarded(|| Ok((Bars::room(self, a.len), Bars::room(self, b.len))))
    }
}

/// The adjoint of all pairs, block by block.
///
/// What a kernel leaves are partial sums: per strip of rows for columns, per workgroup of columns
/// for rows. They are added block by block, in order.
struct VjpSweep<'a> {
    inner: &'a Inner,
    pipeline: wgpu::ComputePipeline,
    fold: wgpu::ComputePipeline,
    fields: usize,
    lists: [&'a [super::data::Piece]; 4],
}

impl<'a> VjpSweep<'a> {
    fn new<O: GpuPair>(
        gpu: &'a Gpu,
        seed: Seed,
        a: &'a ShapesOf<O>,
        b: &'a ShapesOf<O>,
        a_bar: &'a BarsOf<O>,
        b_bar: &'a BarsOf<O>,
    ) -> Result<Self, Error> {
        let inner = &*gpu.inner;
        let source = Source {
            slots: inner.slots,
            ..source_for::<O>(Kernel::Vjp(seed), a, b)
        };
        inner.guarded(|| {
            let lists = [&a.pieces[..], &b.pieces, &a_bar.pieces, &b_bar.pieces];
            if a.len == 0 || b.len == 0 {
                // Sums of nothing.
                inner.clear(lists[2].iter().chain(lists[3]).map(|piece| &piece.buffer));
            }
            Ok(VjpSweep {
                inner,
                pipeline: inner.pair_pipeline::<O>(source, "pairs_vjp_main"),
                fold: inner.pair_pipeline::<Any>(Source::of(Kernel::Fold, "any"), "fold_main"),
                fields: O::Shape::LEN,
                lists,
            })
        })
    }

    /// One block; `bound` says what else the kernel is given.
    fn run(&self, block: &Block, factor: f32, bound: &[(u32, &wgpu::Buffer)]) -> Result<(), Error> {
        let VjpSweep { inner, fields, .. } = *self;
        let [a, b, a_bar, b_bar] = self.lists;
        inner.guarded(|| {
            let wide = groups(block.columns) as usize;
            let tall = block.rows.div_ceil(STRIP_VJP);
            let row_parts = inner.storage(wide * fields * block.rows);
            let column_parts = inner.storage(tall * fields * block.columns);
            let mut work = Work::new(inner);
            let mut buffers = vec![
                (1, &a[block.row_piece].buffer),
                (2, &b[block.column_piece].buffer),
                (5, &row_parts),
                (6, &column_parts),
            ];
            buffers.extend(bound);
            let params = Params {
                factor,
                ..block_params(block)
            };
            work.dispatch(&self.pipeline, params, &buffers, [wide as u32, tall as u32]);
            let rows = Params {
                own_count: block.rows as u32,
                out_start: block.row_start as u32,
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
            let a_bar = &a_bar[block.row_piece].buffer;
            let b_bar = &b_bar[block.column_piece].buffer;
            for (params, from, to) in [(rows, &row_parts, a_bar), (columns, &column_parts, b_bar)] {
                let size = [groups(params.own_count as usize), fields as u32];
                work.dispatch(&self.fold, params, &[(3, from), (5, to)], size);
            }
            work.submit().map(drop)
        })
    }
}

/// Threads stand for columns and walk through rows.
fn block_params(block: &Block) -> Params {
    Params {
        own_count: block.columns as u32,
        loop_count: block.rows as u32,
        loop_start: block.row_start as u32,
        ..Params::default()
    }
}

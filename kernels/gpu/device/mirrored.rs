//! All pairs by kernels by hand: the matrix, and derivatives summed for every box.
use super::block::{Block, block_of};
use super::data::{Boxes, Piece};
use super::download::parts;
use super::seed::{Seed, sum_of};
use super::work::{Params, Work, groups};
use super::written::{ANY, Kernel, Mirror, STEP, STRIP_VJP, Source, TILE, pair_source};
use super::{Device, Inner, Matrix, written};
use crate::Error;

impl Inner {
    /// A pipeline of all pairs.
    pub fn pair_pipeline(&self, source: Source, entry: &'static str) -> wgpu::ComputePipeline {
        self.pipeline(source, entry, || pair_source(source))
    }

    /// A pipeline that moves and gathers numbers.
    pub fn gather_pipeline(&self, entry: &'static str) -> wgpu::ComputePipeline {
        self.pair_pipeline(Source::of(Kernel::Gather, ANY), entry)
    }
}

/// Two lists of boxes and the score of their pairs.
#[derive(Clone, Debug)]
pub(super) struct Mirrored {
    pub mirror: Mirror,
    pub a: Boxes,
    pub b: Boxes,
}

impl Mirrored {
    /// The shader for these lists.
    pub fn source(&self, kernel: Kernel) -> Source {
        Source {
            extreme: !(self.a.is_ordinary && self.b.is_ordinary),
            ..Source::of(kernel, self.mirror)
        }
    }

    /// Every row with every column, over a matrix.
    pub fn fill(&self, matrix: &Matrix) -> Result<(), Error> {
        let inner = &matrix.gpu.inner;
        for (block, values) in &matrix.blocks {
            inner.guarded(|| {
                let pipeline = inner.pair_pipeline(self.source(Kernel::Pairs), "pairs_main");
                let mut work = Work::new(inner);
                let buffers = [
                    (1, &self.a.pieces[block.row_piece].buffer),
                    (2, &self.b.pieces[block.column_piece].buffer),
                    (4, values),
                ];
                let size = [groups(block.columns), block.rows.div_ceil(STEP) as u32];
                work.dispatch(&pipeline, block_params(block), &buffers, size);
                work.submit().map(drop)
            })?;
        }
        Ok(())
    }

    /// The numbers of the derivatives of both lists, and the sum of all results where one factor is the seed of
    /// all.
    pub fn derivatives(
        &self,
        gpu: &Device,
        seed: &Seed<'_>,
    ) -> Result<([Vec<f32>; 2], f64), Error> {
        let inner = &gpu.inner;
        let sweep = Sweep::new(inner, self, seed)?;
        let mut totals = Vec::new();
        let blocks = inner.cut(self.a.len, self.b.len, 4);
        for (k, block) in blocks.iter().enumerate() {
            match seed {
                Seed::Numbers(numbers) => {
                    let own = block_of(block, self.b.len, numbers);
                    let upstream = inner.guarded(|| Ok(inner.stored(&own)))?;
                    sweep.run(block, 0.0, (3, &upstream))?;
                }
                // A matrix is cut as the pairs are.
                Seed::Matrix(matrix) => sweep.run(block, 0.0, (3, &matrix.blocks[k].1))?,
                Seed::Factor(factor) => {
                    let numbers = block.rows.div_ceil(STRIP_VJP) * block.columns;
                    let own = inner.guarded(|| Ok(inner.storage(numbers)))?;
                    sweep.run(block, *factor, (4, &own))?;
                    totals.push((own, 4 * numbers as u64));
                }
            }
        }
        let mut sum = 0.0;
        for (totals, bytes) in &totals {
            let arrival = inner.bring(gpu, &[(totals, *bytes)])?;
            arrival.finish(|_, numbers| sum += sum_of(numbers))?;
        }
        Ok((sweep.bring(gpu)?, sum))
    }
}

/// The adjoint of all pairs, block by block.
///
/// A kernel leaves partial sums: per strip of rows for columns, per workgroup of columns for rows. They are added
/// block by block, in order.
struct Sweep<'a> {
    inner: &'a Inner,
    pipeline: wgpu::ComputePipeline,
    fold: wgpu::ComputePipeline,
    fields: usize,
    lists: [&'a Boxes; 2],
    derivatives: [Vec<Piece>; 2],
}

impl<'a> Sweep<'a> {
    fn new(inner: &'a Inner, of: &'a Mirrored, seed: &Seed<'_>) -> Result<Self, Error> {
        let seed = match seed {
            Seed::Numbers(_) | Seed::Matrix(_) => written::Seed::Matrix,
            Seed::Factor(_) => written::Seed::Factor,
        };
        let source = Source {
            slots: inner.slots,
            ..of.source(Kernel::Vjp(seed))
        };
        let lists = [&of.a, &of.b];
        let fields = of.mirror.kind.fields();
        inner.guarded(|| {
            let derivatives = lists.map(|list| inner.pieces(list.len, fields));
            if of.a.len == 0 || of.b.len == 0 {
                // Sums of nothing.
                inner.clear(derivatives.iter().flatten().map(|piece| &piece.buffer));
            }
            Ok(Sweep {
                inner,
                pipeline: inner.pair_pipeline(source, "pairs_vjp_main"),
                fold: inner.pair_pipeline(Source::of(Kernel::Fold, ANY), "fold_main"),
                fields,
                lists,
                derivatives,
            })
        })
    }

    /// One block; `bound` says what else the kernel is given.
    fn run(&self, block: &Block, factor: f32, bound: (u32, &wgpu::Buffer)) -> Result<(), Error> {
        let Sweep { inner, fields, .. } = *self;
        inner.guarded(|| {
            let wide = groups(block.columns) as usize;
            let tall = block.rows.div_ceil(STRIP_VJP);
            let row_parts = inner.storage(wide * fields * block.rows);
            let column_parts = inner.storage(tall * fields * block.columns);
            let mut work = Work::new(inner);
            let buffers = [
                (1, &self.lists[0].pieces[block.row_piece].buffer),
                (2, &self.lists[1].pieces[block.column_piece].buffer),
                (5, &row_parts),
                (6, &column_parts),
                bound,
            ];
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
            let by_a = &self.derivatives[0][block.row_piece].buffer;
            let by_b = &self.derivatives[1][block.column_piece].buffer;
            for (params, from, to) in [(rows, &row_parts, by_a), (columns, &column_parts, by_b)] {
                let size = [groups(params.own_count as usize), fields as u32];
                work.dispatch(&self.fold, params, &[(3, from), (5, to)], size);
            }
            work.submit().map(drop)
        })
    }

    /// Brings the derivatives of both lists back, box by box.
    fn bring(&self, gpu: &Device) -> Result<[Vec<f32>; 2], Error> {
        let whole = |items: usize| items.next_multiple_of(TILE) * self.fields;
        let [a, b] = &self.derivatives;
        let both = [parts(a, whole), parts(b, whole)].concat();
        let mut numbers = self
            .lists
            .map(|list| Vec::with_capacity(list.len * self.fields));
        self.inner.bring(gpu, &both)?.finish(|part, lanes| {
            let (list, piece) = match part.checked_sub(a.len()) {
                None => (0, &a[part]),
                Some(part) => (1, &b[part]),
            };
            let lanes: &[f32] = bytemuck::cast_slice(lanes);
            for i in 0..piece.items {
                let at = i / TILE * TILE * self.fields + i % TILE;
                numbers[list].extend((0..self.fields).map(|k| lanes[at + k * TILE]));
            }
        })?;
        Ok(numbers)
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

//! All pairs as a reduction on the GPU sees them: two lists, blocks of results that are computed one after the
//! other into the same buffer, or a matrix that is there already.
use super::block::Block;
use super::data::Piece;
use super::generated::operation::Generated;
use super::generated::uploaded::Sides;
use super::mirrored::Mirrored;
use super::work::{Params, groups};
use super::written::{ANY, Kernel, STRIP, Source, Take};
use super::{Device, Inner, Matrix};
use crate::Error;
use std::sync::Arc;

/// One dispatch of a reduction: a run of own rows (or columns) by a run of walked ones.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    /// The index of the first own one in its buffer.
    own_start: usize,
    /// The piece of their results.
    pub out_piece: usize,
    out_start: usize,
    /// The first one's index in the whole list.
    own_base: usize,
    pub own: usize,
    pub walked_base: usize,
    walked: usize,
    /// Two lists of shapes or a block of a matrix, and where they are bound.
    pub bound: Vec<(u32, wgpu::Buffer)>,
    /// Which block of a matrix, where it is one.
    block: usize,
}

impl Sweep {
    pub fn strips(&self) -> usize {
        self.walked.div_ceil(STRIP)
    }

    /// Partial results: one per own row (or column) and strip.
    pub fn room(&self) -> usize {
        self.own * self.strips()
    }

    /// Workgroups.
    pub fn size(&self) -> [u32; 2] {
        [groups(self.own), self.strips() as u32]
    }

    /// The same in two, for own rows that found more than a buffer holds.
    pub fn halves(self) -> [Sweep; 2] {
        let half = self.own / 2;
        let second = Sweep {
            own_start: self.own_start + half,
            out_start: self.out_start + half,
            own_base: self.own_base + half,
            own: self.own - half,
            ..self.clone()
        };
        [Sweep { own: half, ..self }, second]
    }

    pub fn params(&self, threshold: f32) -> Params {
        Params {
            own_count: self.own as u32,
            own_start: self.own_start as u32,
            out_start: self.out_start as u32,
            own_base: self.own_base as u32,
            loop_count: self.walked as u32,
            loop_base: self.walked_base as u32,
            parts: self.strips() as u32,
            more: u32::from(self.walked_base > 0),
            factor: threshold,
            ..Params::default()
        }
    }

    /// Everything a kernel is given, with what else is bound.
    pub fn buffers<'a>(&'a self, more: &[(u32, &'a wgpu::Buffer)]) -> Vec<(u32, &'a wgpu::Buffer)> {
        let own = self.bound.iter().map(|(at, buffer)| (*at, buffer));
        own.chain(more.iter().copied()).collect()
    }
}

/// All pairs as a reduction sees them: own rows (or columns) by walked columns (or rows).
pub(super) struct Table<'a> {
    pub gpu: &'a Device,
    pub own: usize,
    pub walked: usize,
    /// The shader but for what it takes of the scores.
    source: Source,
    pub sweeps: Vec<Sweep>,
    results: Option<Results<'a>>,
}

/// Results that are computed block by block, when a reduction comes to them.
struct Results<'a> {
    made: &'a Arc<Generated<f32>>,
    sides: &'a Sides,
    blocks: Vec<Block>,
    buffer: wgpu::Buffer,
}

impl<'a> Table<'a> {
    /// The table of two lists: the kernels compute the results that they reduce.
    pub fn of_lists(gpu: &'a Device, lists: &Mirrored, own_rows: bool) -> Self {
        let (a, b) = (&lists.a, &lists.b);
        let (own, walked) = if own_rows { (a, b) } else { (b, a) };
        let bound = |own: &Piece, walked: &Piece| {
            let (at_own, at_walked) = if own_rows { (1, 2) } else { (2, 1) };
            vec![
                (at_own, own.buffer.clone()),
                (at_walked, walked.buffer.clone()),
            ]
        };
        Table {
            gpu,
            own: own.len,
            walked: walked.len,
            source: Source {
                own_rows,
                ..lists.source(Kernel::Reduce(Take::Best))
            },
            sweeps: gpu.inner.sweeps(&own.pieces, &walked.pieces, bound),
            results: None,
        }
    }

    /// The table of a matrix that is there already.
    pub fn of_matrix(matrix: &'a Matrix, own_rows: bool) -> Self {
        let blocks = matrix.blocks.iter().map(|(block, buffer)| (*block, buffer));
        let counts = [matrix.rows, matrix.columns];
        Self::of_blocks(&matrix.gpu, blocks, counts, own_rows)
    }

    /// The table of all pairs of two lists of so many shapes: never more than a block of their results exists.
    pub fn of_generated(
        gpu: &'a Device,
        made: &'a Arc<Generated<f32>>,
        sides: &'a Sides,
        counts: [usize; 2],
        own_rows: bool,
    ) -> Result<Self, Error> {
        let inner = &gpu.inner;
        let blocks = inner.cut(
            counts[0],
            counts[1],
            (inner.most_bytes / MOST_ENTRIES).max(4),
        );
        let sizes = blocks.iter().map(|block| block.rows * block.columns);
        let room = sizes.max().unwrap_or(0);
        let buffer = inner.guarded(|| Ok(inner.storage(room)))?;
        let own = blocks.iter().map(|block| (*block, &buffer));
        let mut table = Self::of_blocks(gpu, own, counts, own_rows);
        table.results = Some(Results {
            made,
            sides,
            blocks,
            buffer,
        });
        Ok(table)
    }

    fn of_blocks<'b>(
        gpu: &'a Device,
        blocks: impl Iterator<Item = (Block, &'b wgpu::Buffer)>,
        [rows, columns]: [usize; 2],
        own_rows: bool,
    ) -> Self {
        let (own, walked) = match own_rows {
            true => (rows, columns),
            false => (columns, rows),
        };
        let sweep = |(k, (block, buffer)): (usize, (Block, &wgpu::Buffer))| match own_rows {
            true => Sweep {
                own_start: 0,
                out_piece: block.row_piece,
                out_start: block.row_start,
                own_base: block.row_base,
                own: block.rows,
                walked_base: block.column_base,
                walked: block.columns,
                bound: vec![(3, buffer.clone())],
                block: k,
            },
            false => Sweep {
                own_start: 0,
                out_piece: block.column_piece,
                out_start: 0,
                own_base: block.column_base,
                own: block.columns,
                walked_base: block.row_base,
                walked: block.rows,
                bound: vec![(3, buffer.clone())],
                block: k,
            },
        };
        Table {
            gpu,
            own,
            walked,
            source: Source {
                own_rows,
                ..Source::of(Kernel::ReduceMatrix(Take::Best), ANY)
            },
            sweeps: blocks.enumerate().map(sweep).collect(),
            results: None,
        }
    }

    /// Computes what a sweep reduces, where that is not there already.
    pub fn compute(&self, sweep: &Sweep) -> Result<(), Error> {
        let Some(results) = &self.results else {
            return Ok(());
        };
        let block = &results.blocks[sweep.block];
        let inner = &self.gpu.inner;
        results
            .sides
            .compute(inner, results.made, block, &results.buffer)
    }

    /// The shader that takes this of the scores.
    pub fn pipeline(&self, take: Take) -> wgpu::ComputePipeline {
        let kernel = match self.source.kernel {
            Kernel::ReduceMatrix(_) => Kernel::ReduceMatrix(take),
            _ => Kernel::Reduce(take),
        };
        let source = Source {
            kernel,
            ..self.source
        };
        let inner = &self.gpu.inner;
        inner.pair_pipeline(source, "reduce_main")
    }
}

/// Results that exist at a time where a matrix would be too large: 256 MB of them.
const MOST_ENTRIES: u64 = 1 << 26;

impl Inner {
    /// How a reduction of two lists is cut: own shapes so that partial results fit a buffer.
    fn sweeps(
        &self,
        own: &[Piece],
        walked: &[Piece],
        bound: impl Fn(&Piece, &Piece) -> Vec<(u32, wgpu::Buffer)>,
    ) -> Vec<Sweep> {
        // As a matrix with one column per strip and four numbers per entry; whole workgroups.
        let widest = walked.first().map_or(1, |piece| piece.items);
        let pairs =
            (self.most_bytes as usize / 16 / widest.div_ceil(STRIP)).min((1 << 30) / widest);
        let most = pairs.max(1);
        let mut sweeps = Vec::new();
        for (out_piece, own) in own.iter().enumerate() {
            for own_start in (0..own.items).step_by(most) {
                for (i, walked) in walked.iter().enumerate() {
                    sweeps.push(Sweep {
                        own_start,
                        out_piece,
                        out_start: own_start,
                        own_base: out_piece * self.chunk + own_start,
                        own: most.min(own.items - own_start),
                        walked_base: i * self.chunk,
                        walked: walked.items,
                        bound: bound(own, walked),
                        block: 0,
                    });
                }
            }
        }
        sweeps
    }
}

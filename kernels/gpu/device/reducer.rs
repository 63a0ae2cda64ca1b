//! The dispatches of a reduction on the GPU: over two lists, over blocks of results that are computed one after the other
//! into the same buffer, or over a matrix that is there already.
use super::context::Device;
use super::generated::operation::Generated;
use super::generated::text::Form;
use super::generated::uploaded::Sides;
use super::work::Params;
use super::written::{GROUP, Kernel, STRIP, Take};
use crate::Error;
use std::ops::Range;
use std::sync::Arc;

/// The bindings of both lists, and of a block of a matrix, as the shaders declare them.
pub(super) const LISTS: [u32; 2] = [1, 2];
pub(super) const MATRIX: u32 = 3;

/// One dispatch of a reduction: a run of own rows (or columns) by a run of walked ones.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    /// The start of the own rows (or columns) in their buffer.
    pub own_start: usize,
    /// The buffer of their results.
    pub out_piece: usize,
    /// The start of their results in it.
    pub out_start: usize,
    /// Their start in the whole list.
    pub own_base: usize,
    /// How many they are.
    pub own: usize,
    /// The start of the walked columns (or rows) in their buffer.
    pub walked_start: usize,
    /// Their start in the whole list.
    pub walked_base: usize,
    /// How many they are.
    pub walked: usize,
    /// Strips of walked columns (or rows).
    pub strips: usize,
    /// `true` if earlier sweeps have results of the same own rows, with which these are joined.
    pub more: bool,
    /// The bindings and buffers of what is read: two lists (and the ranges of groups), or a block of a matrix.
    pub bound: Vec<(u32, wgpu::Buffer)>,
}

impl Sweep {
    /// Partial results: one per own row (or column) and strip.
    pub fn room(&self) -> usize {
        self.own * self.strips
    }

    /// Returns both halves of the own rows, where the pairs found need more than one buffer. It has at least two.
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
            loop_start: self.walked_start as u32,
            loop_base: self.walked_base as u32,
            parts: self.strips as u32,
            more: u32::from(self.more),
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

/// A run of a list in one buffer.
pub(super) struct Part {
    pub buffer: wgpu::Buffer,
    /// The binding of its list.
    pub binding: u32,
    /// The index of its first shape in the buffer.
    pub at: usize,
    /// Its shapes, by their places in the list.
    pub shapes: Range<usize>,
}

/// The dispatches of a reduction over all pairs. A thread stands for an own row (or column) and walks through columns (or
/// rows).
pub(super) struct Reducer<'a> {
    pub gpu: &'a Device,
    pub own: usize,
    pub walked: usize,
    /// `true` if threads stand for rows.
    own_rows: bool,
    kernels: Kernels<'a>,
    /// `true` if every own row walks through a range of its own.
    is_grouped: bool,
    pub sweeps: Vec<Sweep>,
}

/// The source of scores.
enum Kernels<'a> {
    /// Scores out of a matrix.
    Matrix,
    /// Scores that a body computes.
    Lists(&'a Arc<Generated<f32>>),
}

impl<'a> Reducer<'a> {
    /// Returns the reduction of scores that are there already, of so many own shapes with so many others.
    pub fn of_scores(
        gpu: &'a Device,
        counts: [usize; 2],
        own_rows: bool,
        sweeps: Vec<Sweep>,
    ) -> Self {
        Reducer::new(gpu, Kernels::Matrix, counts, own_rows, sweeps)
    }

    fn new(
        gpu: &'a Device,
        kernels: Kernels<'a>,
        [own, walked]: [usize; 2],
        own_rows: bool,
        sweeps: Vec<Sweep>,
    ) -> Self {
        Reducer {
            gpu,
            own,
            walked,
            own_rows,
            kernels,
            is_grouped: false,
            sweeps,
        }
    }

    /// Returns the reduction of two lists within groups, given by the offsets of both: dispatches over the parts of
    /// both, of at most as many pairs as a dispatch of the kernels may have.
    pub fn of_groups(
        gpu: &'a Device,
        made: &'a Arc<Generated<f32>>,
        [own, walked]: [&[Part]; 2],
        offsets: [&[usize]; 2],
        own_rows: bool,
    ) -> Result<Self, Error> {
        let (inner, most) = (&gpu.inner, made.most_pairs());
        let sweeps = inner.guarded(|| Ok(inner.group_sweeps(own, walked, offsets, most)))?;
        let counts = offsets.map(|all| all.last().copied().unwrap_or(0));
        Ok(Reducer {
            is_grouped: true,
            ..Reducer::new(gpu, Kernels::Lists(made), counts, own_rows, sweeps)
        })
    }

    /// Returns the reduction of two lists: kernels compute the results that they reduce.
    pub fn of_lists(
        gpu: &'a Device,
        made: &'a Arc<Generated<f32>>,
        sides: &Sides,
        own_rows: bool,
    ) -> Self {
        let (k, inner, counts) = (usize::from(!own_rows), &gpu.inner, sides.counts());
        let walked: Vec<_> = sides.parts(1 - k, 0..counts[1 - k]).collect();
        let widest = walked.iter().map(|part| part.2.len()).max().unwrap_or(1);
        // Partial results fit a buffer, at 16 bytes per row and strip, and a dispatch ends before a driver resets the GPU.
        let most = (inner.most_bytes as usize / 16 / widest.div_ceil(STRIP))
            .min(made.most_pairs() / widest)
            .max(1);
        let mut sweeps = Vec::new();
        for (out_piece, base) in (0..counts[k]).step_by(inner.chunk).enumerate() {
            let whole = base..counts[k].min(base + inner.chunk);
            for (buffer, at, own) in sides.parts(k, whole) {
                for start in own.clone().step_by(most) {
                    sweeps.extend(walked.iter().map(|(other, other_at, range)| Sweep {
                        own_start: at + start - own.start,
                        out_piece,
                        out_start: start - base,
                        own_base: start,
                        own: most.min(own.end - start),
                        walked_start: *other_at,
                        walked_base: range.start,
                        walked: range.len(),
                        strips: range.len().div_ceil(STRIP),
                        more: range.start > 0,
                        bound: vec![(LISTS[k], buffer.clone()), (LISTS[1 - k], (*other).clone())],
                    }));
                }
            }
        }
        let counts = [counts[k], counts[1 - k]];
        Reducer::new(gpu, Kernels::Lists(made), counts, own_rows, sweeps)
    }

    /// Returns the pipeline that reduces scores by `take`.
    pub fn pipeline(&self, take: Take) -> wgpu::ComputePipeline {
        let (inner, own_rows) = (&self.gpu.inner, self.own_rows);
        match self.kernels {
            Kernels::Matrix => inner.written(Kernel::ReduceMatrix(take, own_rows), "reduce_main"),
            Kernels::Lists(made) => {
                let form = match self.is_grouped {
                    true => Form::ReduceGroups(take, own_rows),
                    false => Form::Reduce(take, own_rows),
                };
                made.pipeline(inner, form)
            }
        }
    }

    /// Workgroups of a sweep.
    pub fn size(&self, sweep: &Sweep) -> [u32; 2] {
        let group = match self.kernels {
            Kernels::Matrix => GROUP,
            Kernels::Lists(made) => made.size(Form::Reduce(Take::Best, self.own_rows)).own,
        };
        [sweep.own.div_ceil(group) as u32, sweep.strips as u32]
    }
}

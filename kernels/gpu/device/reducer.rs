//! The dispatches of a reduction on the GPU: over two lists, over blocks of results computed in turn into one buffer,
//! or over a stored matrix.
use super::context::Device;
use super::generated::operation::Generated;
use super::generated::text::KernelForm;
use super::generated::uploaded::UploadedLists;
use super::work::Params;
use super::written::{GROUP, Kernel, STRIP, Take};
use crate::Error;
use std::ops::Range;
use std::sync::Arc;

/// The bindings of both lists, and of a block of a matrix, as the shaders declare them.
pub(super) const LISTS: [u32; 2] = [1, 2];
pub(super) const MATRIX: u32 = 3;

/// One dispatch of a reduction: a run of own rows (or columns) with a run of walked columns (or rows).
#[derive(Clone, Debug)]
pub(super) struct ReduceDispatch {
    /// The index of the first own row (or column) in its buffer.
    pub own_start: usize,
    /// The index of the buffer of their results.
    pub out_piece: usize,
    /// The index of their first result in it.
    pub out_start: usize,
    /// The index of the first own row in the whole list.
    pub own_base: usize,
    /// The number of own rows.
    pub own: usize,
    /// The index of the first walked column (or row) in its buffer.
    pub walked_start: usize,
    /// The index of the first walked column in the whole list.
    pub walked_base: usize,
    /// The number of walked columns.
    pub walked: usize,
    /// The number of strips of walked columns (or rows).
    pub strips: usize,
    /// `true` if earlier sweeps have results of these own rows, to combine with.
    pub more: bool,
    /// The bindings and buffers to read: two lists (and the ranges of groups), or a block of a matrix.
    pub bound: Vec<(u32, wgpu::Buffer)>,
}

impl ReduceDispatch {
    /// Returns the number of partial results: one per own row (or column) and strip.
    pub fn room(&self) -> usize {
        self.own * self.strips
    }

    /// Splits the own rows in halves, if their pairs need more than one buffer. There must be at least two.
    pub fn halves(self) -> [ReduceDispatch; 2] {
        let half = self.own / 2;
        let second = ReduceDispatch {
            own_start: self.own_start + half,
            out_start: self.out_start + half,
            own_base: self.own_base + half,
            own: self.own - half,
            ..self.clone()
        };
        [ReduceDispatch { own: half, ..self }, second]
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

    /// Returns the bindings and buffers of a kernel, with `more` appended.
    pub fn buffers<'a>(&'a self, more: &[(u32, &'a wgpu::Buffer)]) -> Vec<(u32, &'a wgpu::Buffer)> {
        let own = self.bound.iter().map(|(at, buffer)| (*at, buffer));
        own.chain(more.iter().copied()).collect()
    }
}

/// A run of a list in one buffer.
pub(super) struct ListPart {
    pub buffer: wgpu::Buffer,
    /// The binding of the list.
    pub binding: u32,
    /// The index of the first shape in the buffer.
    pub at: usize,
    /// The shapes, as indices in the list.
    pub shapes: Range<usize>,
}

/// The dispatches of a reduction over all pairs. A thread computes an own row (or column) and walks through columns (or
/// rows).
pub(super) struct Reducer<'a> {
    pub gpu: &'a Device,
    pub own: usize,
    pub walked: usize,
    /// `true` if threads compute rows.
    own_rows: bool,
    kernels: ScoreSource<'a>,
    /// `true` if every own row walks a range of its own.
    is_grouped: bool,
    pub sweeps: Vec<ReduceDispatch>,
}

/// The source of scores.
enum ScoreSource<'a> {
    /// Scores stored in a matrix.
    Matrix,
    /// Scores that a body computes.
    Lists(&'a Arc<Generated<f32>>),
}

impl<'a> Reducer<'a> {
    /// Returns the reducer of stored scores; `counts` are the numbers of own and of walked shapes.
    pub fn of_scores(
        gpu: &'a Device,
        counts: [usize; 2],
        own_rows: bool,
        sweeps: Vec<ReduceDispatch>,
    ) -> Self {
        Reducer::new(gpu, ScoreSource::Matrix, counts, own_rows, sweeps)
    }

    fn new(
        gpu: &'a Device,
        kernels: ScoreSource<'a>,
        [own, walked]: [usize; 2],
        own_rows: bool,
        sweeps: Vec<ReduceDispatch>,
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

    /// Returns the reducer of two lists within groups, given by the offsets of both. A dispatch has at most the
    /// kernel's limit of pairs.
    pub fn of_groups(
        gpu: &'a Device,
        made: &'a Arc<Generated<f32>>,
        [own, walked]: [&[ListPart]; 2],
        offsets: [&[usize]; 2],
        own_rows: bool,
    ) -> Result<Self, Error> {
        let (inner, most) = (&gpu.inner, made.most_pairs());
        let sweeps = inner.guarded(|| Ok(inner.group_sweeps(own, walked, offsets, most)))?;
        let counts = offsets.map(|all| all.last().copied().unwrap_or(0));
        Ok(Reducer {
            is_grouped: true,
            ..Reducer::new(gpu, ScoreSource::Lists(made), counts, own_rows, sweeps)
        })
    }

    /// Returns the reducer of two lists, whose scores the kernels compute.
    pub fn of_lists(
        gpu: &'a Device,
        made: &'a Arc<Generated<f32>>,
        sides: &UploadedLists,
        own_rows: bool,
    ) -> Self {
        let (k, inner, counts) = (usize::from(!own_rows), &gpu.inner, sides.counts());
        let walked: Vec<_> = sides.parts(1 - k, 0..counts[1 - k]).collect();
        let widest = walked.iter().map(|part| part.2.len()).max().unwrap_or(1);
        // Partial results, at 16 bytes per row and strip, must fit a buffer, and a dispatch must end before the system
        // resets the GPU.
        let most = (inner.most_bytes as usize / 16 / widest.div_ceil(STRIP))
            .min(made.most_pairs() / widest)
            .max(1);
        let mut sweeps = Vec::new();
        for (out_piece, base) in (0..counts[k]).step_by(inner.chunk).enumerate() {
            let whole = base..counts[k].min(base + inner.chunk);
            for (buffer, at, own) in sides.parts(k, whole) {
                for start in own.clone().step_by(most) {
                    sweeps.extend(
                        walked
                            .iter()
                            .map(|(other, other_at, range)| ReduceDispatch {
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
                                bound: vec![
                                    (LISTS[k], buffer.clone()),
                                    (LISTS[1 - k], (*other).clone()),
                                ],
                            }),
                    );
                }
            }
        }
        let counts = [counts[k], counts[1 - k]];
        Reducer::new(gpu, ScoreSource::Lists(made), counts, own_rows, sweeps)
    }

    /// Returns the pipeline of a reduction.
    pub fn pipeline(&self, take: Take) -> wgpu::ComputePipeline {
        let (inner, own_rows) = (&self.gpu.inner, self.own_rows);
        match self.kernels {
            ScoreSource::Matrix => {
                inner.written(Kernel::ReduceMatrix(take, own_rows), "reduce_main")
            }
            ScoreSource::Lists(made) => {
                let form = match self.is_grouped {
                    true => KernelForm::ReduceGroups(take, own_rows),
                    false => KernelForm::Reduce(take, own_rows),
                };
                made.pipeline(inner, form)
            }
        }
    }

    /// Returns the workgroups of a sweep.
    pub fn size(&self, sweep: &ReduceDispatch) -> [u32; 2] {
        let group = match self.kernels {
            ScoreSource::Matrix => GROUP,
            ScoreSource::Lists(made) => {
                made.size(KernelForm::Reduce(Take::Best, self.own_rows)).own
            }
        };
        [sweep.own.div_ceil(group) as u32, sweep.strips as u32]
    }
}

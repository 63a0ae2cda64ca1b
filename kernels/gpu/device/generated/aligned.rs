//! Aligned batches on the GPU: one thread per item.
use super::operation::Generated;
use super::replays::SearchReplays;
use super::text::{GROUP, KernelForm, MOST_GROUPS};
use crate::Error;
use crate::kernels::call::recording::Call;
use crate::kernels::cpu::aligned::{items, sound};
use crate::kernels::cpu::lane::TILE;
use crate::kernels::cpu::plan::{Plan, plan};
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::gpu::device::context::Device;
use crate::kernels::gpu::device::context::SharedContext;
use crate::kernels::gpu::device::download::BufferDownload;
use crate::kernels::gpu::device::work::Commands;
use crate::kernels::machine::Column;
use crate::kernels::row::item::{STRETCH, Target, TargetPiece};
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

impl Device {
    /// Computes item i of every column, into targets of the right length.
    pub(in crate::kernels::gpu::device) fn aligned(
        &self,
        call: &Call<f32>,
        columns: &[Column<'_, f32>],
        targets: Vec<Option<Target<'_, f32>>>,
    ) -> Result<(), Error> {
        let made = ItemCode::of(call)?;
        let count = made.checked(columns)?;
        self.run(&made, columns, count, targets)
    }

    fn run(
        &self,
        made: &ItemCode,
        columns: &[Column<'_, f32>],
        count: usize,
        targets: Vec<Option<Target<'_, f32>>>,
    ) -> Result<(), Error> {
        match made {
            ItemCode::Kernel(made) => self.compute(made, columns, count, targets),
            ItemCode::Replays(replays, plan) => {
                self.replayed(replays, &plan.gives, columns, count, targets)
            }
        }
    }

    /// Computes chunk by chunk: while one is computed, the one before is downloaded.
    fn compute(
        &self,
        made: &Arc<Generated<f32>>,
        columns: &[Column<'_, f32>],
        count: usize,
        targets: Vec<Option<Target<'_, f32>>>,
    ) -> Result<(), Error> {
        let inner = &self.inner;
        inner.alive()?;
        let mut targets: Vec<Vec<TargetPiece<'_, f32>>> = targets
            .into_iter()
            .map(|target| target.map_or_else(Vec::new, Target::pieces))
            .collect();
        let chunk = chunk(inner, made)?;
        // Shapes that stand for all are uploaded again with every chunk, since they are few bytes.
        let mut open: VecDeque<(BufferDownload, Chunk)> = VecDeque::new();
        for start in (0..count).step_by(chunk) {
            let items = start..count.min(start + chunk);
            open.push_back(self.start(made, columns, items)?);
            if open.len() > 1
                && let Some((arrival, chunk)) = open.pop_front()
            {
                chunk.finish(made, arrival, &mut targets)?;
            }
        }
        for (arrival, chunk) in open {
            chunk.finish(made, arrival, &mut targets)?;
        }
        targets.iter_mut().flatten().for_each(TargetPiece::finish);
        Ok(())
    }

    /// Uploads some items, computes them and starts their download.
    fn start(
        &self,
        made: &Arc<Generated<f32>>,
        columns: &[Column<'_, f32>],
        items: Range<usize>,
    ) -> Result<(BufferDownload, Chunk), Error> {
        let inner = &self.inner;
        let own = items.len();
        let parts: Vec<Vec<f32>> = columns
            .iter()
            .enumerate()
            .map(|(k, column)| tiles(made, k, column, items.clone()))
            .collect();
        let mut params = vec![[own as u32, 0, 0, 0]];
        let mut first = 0;
        for (column, part) in columns.iter().zip(&parts) {
            params.push([first as u32, u32::from(column.count.is_some()), 0, 0]);
            first += part.len();
        }
        let inputs = first;
        let chunk = Chunk::new(made, items);
        params.extend(chunk.starts.iter().map(|&start| [start as u32, 0, 0, 0]));
        let outputs = inner.guarded(|| {
            let pipeline = inner.generated(&made.name, KernelForm::Aligned, || {
                KernelForm::Aligned.text(made)
            });
            let (from, to) = (inner.storage(inputs), inner.storage(chunk.numbers));
            let mut first = 0;
            for part in &parts {
                inner.write_at(&from, 4 * first as u64, part);
                first += part.len();
            }
            let mut work = Commands::new(inner);
            let groups = [own.div_ceil(GROUP) as u32, 1];
            work.dispatch_with(&pipeline, &params, &[(1, &from), (2, &to)], groups);
            work.submit()?;
            Ok(to)
        })?;
        let arrival = inner.bring(self, &[(&outputs, 4 * chunk.numbers as u64)])?;
        Ok((arrival, chunk))
    }
}

/// The code that computes items: a kernel, or replays of decisions made on the CPU.
enum ItemCode {
    Kernel(Arc<Generated<f32>>),
    Replays(Arc<SearchReplays>, Arc<Plan<f32>>),
}

impl ItemCode {
    fn of(call: &Call<f32>) -> Result<Self, Error> {
        Ok(match call.replays() {
            Some(replays) => ItemCode::Replays(replays, plan(call, false)?),
            None => ItemCode::Kernel(call.generated(false)?),
        })
    }
    /// Checks columns. Returns the number of items.
    fn checked(&self, columns: &[Column<'_, f32>]) -> Result<usize, Error> {
        let arguments = match self {
            ItemCode::Kernel(made) => &made.arguments,
            ItemCode::Replays(_, plan) => &plan.arguments,
        };
        let count = items(arguments, columns)?;
        sound(arguments, f64::INFINITY, columns)?;
        Ok(count)
    }
}

/// Returns the number of items of a dispatch whose inputs and outputs fit one binding each.
fn chunk(inner: &SharedContext, made: &Generated<f32>) -> Result<usize, Error> {
    let fields = |numbers: &[usize]| numbers.iter().sum::<usize>().max(1);
    let widest = fields(&made.widths).max(fields(&made.gives));
    // The last tile may be incomplete.
    let most = inner.most_bytes as usize / 4 / widest;
    let threads = MOST_GROUPS * GROUP;
    match most.min(threads) / TILE * TILE {
        0 => Err(inner.too_large(TILE * widest)),
        // Whole pieces of targets, if there are any.
        chunk if chunk > STRETCH => Ok(chunk / STRETCH * STRETCH),
        chunk => Ok(chunk),
    }
}

/// Returns the prepared numbers of some items of a column, in tiles.
pub(super) fn tiles(
    made: &Generated<f32>,
    k: usize,
    column: &Column<'_, f32>,
    items: Range<usize>,
) -> Vec<f32> {
    let items = match column.count {
        Some(_) => items,
        None => 0..1,
    };
    let stretches: Vec<Range<usize>> = items
        .clone()
        .step_by(STRETCH)
        .map(|start| start..items.end.min(start + STRETCH))
        .collect();
    let mut parts = vec![Vec::new(); stretches.len()];
    let work = stretches.into_iter().zip(&mut parts).collect();
    in_parallel(work, |(items, part): (Range<usize>, &mut Vec<f32>)| {
        let mut room = Vec::new();
        *part = made.prepare(k, column.numbers(items, &mut room));
    });
    parts.concat()
}

/// Items that are being downloaded.
struct Chunk {
    items: Range<usize>,
    /// The first number of every shape of a result, and the count of all numbers.
    starts: Vec<usize>,
    numbers: usize,
}

impl Chunk {
    fn new(made: &Generated<f32>, items: Range<usize>) -> Self {
        let (mut starts, mut numbers) = (Vec::new(), 0);
        for &fields in &made.gives {
            starts.push(numbers);
            numbers += items.len().next_multiple_of(TILE) * fields;
        }
        Chunk {
            items,
            starts,
            numbers,
        }
    }
    /// Copies downloaded results to the targets.
    fn finish(
        self,
        made: &Generated<f32>,
        arrival: BufferDownload,
        targets: &mut [Vec<TargetPiece<'_, f32>>],
    ) -> Result<(), Error> {
        arrival.finish(|_, numbers| {
            let numbers: &[f32] = bytemuck::cast_slice(numbers);
            for ((target, &fields), &start) in targets.iter_mut().zip(&made.gives).zip(&self.starts)
            {
                let own = target.iter_mut().enumerate();
                let work = own
                    .filter(|(i, _)| {
                        let first = i * STRETCH;
                        first < self.items.end && first + STRETCH > self.items.start
                    })
                    .collect();
                in_parallel(work, |(i, piece): (usize, &mut TargetPiece<'_, f32>)| {
                    let first = i * STRETCH;
                    let rows = piece.numbers();
                    let from = self.items.start.max(first);
                    let end = self.items.end.min(first + STRETCH);
                    for item in from..end {
                        let at = item - self.items.start;
                        let at = start + at / TILE * TILE * fields + at % TILE;
                        let row = &mut rows[(item - first) * fields..][..fields];
                        for (k, x) in row.iter_mut().enumerate() {
                            *x = numbers[at + k * TILE];
                        }
                    }
                });
            }
        })
    }
}

//! Aligned batches of searches: decided on the CPU, replayed on the GPU.
//!
//! A replay is a list of instructions, and one kernel executes the lists of all operations. A thread's work is data, so
//! no record needs a pipeline of its own.
use super::instructions::{Replay, instructions, numbers};
use super::operation::ProgramName;
use super::text::{GROUP, KernelForm, MOST_GROUPS};
use crate::Error;
use crate::ad::program::WGSL;
use crate::ad::program::recorded::Recorded;
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::gpu::device::context::Device;
use crate::kernels::gpu::device::work::Commands;
use crate::kernels::machine::Column;
use crate::kernels::row::derivation::Replays;
use crate::kernels::row::item::{STRETCH, Target, TargetPiece};
use std::collections::HashMap;
use std::fmt::Write;
use std::ops::Range;
use std::sync::{Arc, OnceLock, PoisonError, RwLock};

/// The size in bytes of the slots of all items of a dispatch.
const MOST_SLOTS: usize = 1 << 28;

/// The number of items that are decided at a time.
const CHUNK: usize = 32 * STRETCH;

/// Returns the WGSL of the kernel.
pub(super) fn text() -> String {
    let mut text = String::from(WGSL);
    for (name, number) in numbers() {
        let _ = writeln!(text, "const {name} = {number}u;");
    }
    text + include_str!("../../wgsl/replay.wgsl")
}

/// Returns the name of its pipeline, which lives as long as the process.
fn name() -> &'static ProgramName {
    static NAME: OnceLock<ProgramName> = OnceLock::new();
    NAME.get_or_init(ProgramName::default)
}

/// The number of replays that are kept as instructions. One more drops all, which bounds the memory.
const MOST_KEPT: usize = 1 << 14;

/// Recorded replays by their addresses, which stay unique while the replays are kept, with their instructions.
type ReplayCache = HashMap<usize, (Arc<Recorded>, Arc<Replay>)>;

/// The replays of a search, with the instructions of those that have occurred.
pub(crate) struct SearchReplays {
    replays: Arc<dyn Replays<f32>>,
    known: RwLock<ReplayCache>,
}

impl SearchReplays {
    /// Returns the replays of a search.
    pub(crate) fn new(replays: Arc<dyn Replays<f32>>) -> Self {
        SearchReplays {
            replays,
            known: RwLock::default(),
        }
    }
    /// Decides an item. Returns the instructions of its record, and appends the numbers that they take to `taken`.
    fn instructions(&self, numbers: &[f32], taken: &mut Vec<f32>) -> Result<Arc<Replay>, Error> {
        let recorded = self.replays.decide(numbers, taken)?;
        let address = Arc::as_ptr(&recorded) as usize;
        let known = self.known.read().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, replay)) = known.get(&address) {
            return Ok(Arc::clone(replay));
        }
        drop(known);
        let value = &recorded.value;
        let made = Arc::new(instructions(&value.graph, recorded.inputs, &value.outputs)?);
        let mut known = self.known.write().unwrap_or_else(PoisonError::into_inner);
        if known.len() >= MOST_KEPT {
            known.clear();
        }
        let kept = known.entry(address).or_insert((recorded, made));
        Ok(Arc::clone(&kept.1))
    }
}

/// A stretch of items: their numbers, shape by shape, the numbers that replays take, and the index of each replay.
#[derive(Default)]
struct Stretch {
    items: Range<usize>,
    numbers: Vec<f32>,
    taken: Vec<f32>,
    replays: Vec<Arc<Replay>>,
    found: Vec<f32>,
    rows: Vec<f32>,
    failed: Option<Error>,
}

impl Stretch {
    /// Decides the items of the stretch.
    fn decide(&mut self, replayed: &SearchReplays, columns: &[Column<'_, f32>]) {
        let mut rooms = vec![Vec::new(); columns.len()];
        let parts: Vec<&[f32]> = columns
            .iter()
            .zip(&mut rooms)
            .map(|(column, room)| column.numbers(self.items.clone(), room))
            .collect();
        for i in 0..self.items.len() {
            let first = self.numbers.len();
            for (column, part) in columns.iter().zip(&parts) {
                let at = if column.count.is_some() { i } else { 0 };
                let own = &part[at * column.fields..][..column.fields];
                self.numbers.extend_from_slice(own);
            }
            match replayed.instructions(&self.numbers[first..], &mut self.taken) {
                Ok(replay) => self.replays.push(replay),
                Err(error) => return self.failed = Some(error),
            }
        }
    }
    /// Converts replayed numbers to rows of results.
    fn finish(&mut self, replays: &dyn Replays<f32>, width: usize) {
        let [_, gives] = replays.sizes();
        let own = self.numbers.len() / self.items.len();
        self.rows.resize(width * self.items.len(), 0.0);
        let found = self.found.chunks_exact(gives);
        let items = self.numbers.chunks_exact(own).zip(found);
        for ((numbers, found), row) in items.zip(self.rows.chunks_exact_mut(width)) {
            replays.put(numbers, found, row);
            row.iter_mut().for_each(|x| *x += 0.0);
        }
    }
}

/// Items that are uploaded together: indices in the chunk, and their programs.
#[derive(Default)]
struct ReplayLoad {
    items: Vec<u32>,
    codes: Vec<u32>,
    programs: Vec<[u32; 2]>,
    instructions: Vec<[u32; 4]>,
    slots: usize,
}

impl ReplayLoad {
    /// Returns the numbers of instructions and of slots with one more item, and with its program if that `is_new`.
    fn numbers(&self, replay: &Replay, is_new: bool, sizes: [usize; 2]) -> [usize; 2] {
        let slots = self.slots.max(replay.slots);
        let items = self.items.len() + 1;
        let code = self.instructions.len() + if is_new { replay.code.len() } else { 0 };
        let widest = slots.max(sizes[0]).max(sizes[1]);
        [4 * code, items * widest]
    }
    /// Returns `true` if the load fits the buffers with one more item.
    fn fits(&self, replay: &Replay, is_new: bool, sizes: [usize; 2], most_bytes: usize) -> bool {
        let [code, slots] = self.numbers(replay, is_new, sizes);
        4 * code <= most_bytes
            && 4 * slots <= most_bytes.min(MOST_SLOTS)
            && self.items.len() < MOST_GROUPS * GROUP
    }
    fn add(&mut self, item: usize, replay: &Replay, is_new: bool) {
        if is_new {
            let first = self.instructions.len() as u32;
            self.instructions.extend_from_slice(&replay.code);
            self.programs.push([first, self.instructions.len() as u32]);
            self.slots = self.slots.max(replay.slots);
        }
        self.items.push(item as u32);
        self.codes.push(self.programs.len() as u32 - 1);
    }
}

impl Device {
    /// Decides and replays all items.
    pub(super) fn replayed(
        &self,
        replayed: &SearchReplays,
        gives: &[usize],
        columns: &[Column<'_, f32>],
        count: usize,
        targets: Vec<Option<Target<'_, f32>>>,
    ) -> Result<(), Error> {
        self.inner.alive()?;
        let replays = &*replayed.replays;
        let mut targets: Vec<Vec<TargetPiece<'_, f32>>> = targets
            .into_iter()
            .map(|target| target.map_or_else(Vec::new, Target::pieces))
            .collect();
        let width: usize = gives.iter().sum();
        for start in (0..count).step_by(CHUNK) {
            let end = count.min(start + CHUNK);
            let stretches = (start..end).step_by(STRETCH).map(|first| Stretch {
                items: first..end.min(first + STRETCH),
                ..Stretch::default()
            });
            let mut stretches: Vec<Stretch> = stretches.collect();
            let each = |stretches: &mut Vec<Stretch>, run: &(dyn Fn(&mut Stretch) + Sync)| {
                in_parallel(stretches.iter_mut().collect(), run);
            };
            each(&mut stretches, &|stretch| stretch.decide(replayed, columns));
            if let Some(error) = stretches.iter().find_map(|stretch| stretch.failed) {
                return Err(error);
            }
            self.replay(replays.sizes(), &mut stretches)?;
            each(&mut stretches, &|stretch| stretch.finish(replays, width));
            for stretch in &stretches {
                let mut first = 0;
                for (target, &fields) in targets.iter_mut().zip(gives) {
                    if let Some(piece) = target.get_mut(stretch.items.start / STRETCH) {
                        let rows = stretch.rows.chunks_exact(width);
                        for (to, row) in piece.numbers().chunks_exact_mut(fields).zip(rows) {
                            to.copy_from_slice(&row[first..first + fields]);
                        }
                    }
                    first += fields;
                }
            }
        }
        targets.iter_mut().flatten().for_each(TargetPiece::finish);
        Ok(())
    }

    /// Replays decided items; items of one program are adjacent.
    fn replay(&self, sizes: [usize; 2], stretches: &mut [Stretch]) -> Result<(), Error> {
        let all: Vec<&Arc<Replay>> = stretches.iter().flat_map(|x| &x.replays).collect();
        let mut ranks = HashMap::new();
        let rank_of = all.iter().map(|replay| {
            let next = ranks.len();
            *ranks.entry(Arc::as_ptr(replay)).or_insert(next)
        });
        let rank_of: Vec<usize> = rank_of.collect();
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by_key(|&item| rank_of[item]);
        let most_bytes = self.inner.most_bytes as usize;
        let mut loads = vec![ReplayLoad::default()];
        let mut last = None;
        for item in order {
            let replay = all[item];
            let mut is_new = last != Some(rank_of[item]);
            let mut load = loads.len() - 1;
            if !loads[load].fits(replay, is_new, sizes, most_bytes) {
                (is_new, load) = (true, load + 1);
                loads.push(ReplayLoad::default());
                if !loads[load].fits(replay, true, sizes, most_bytes) {
                    let [code, slots] = loads[load].numbers(replay, true, sizes);
                    return Err(self.inner.too_large(code.max(slots)));
                }
            }
            loads[load].add(item, replay, is_new);
            last = Some(rank_of[item]);
        }
        drop(all);
        for stretch in stretches.iter_mut() {
            stretch.found.resize(sizes[1] * stretch.items.len(), 0.0);
        }
        loads
            .iter()
            .filter(|load| !load.items.is_empty())
            .try_for_each(|load| self.carry_out(sizes, load, stretches))
    }

    fn carry_out(
        &self,
        [takes, gives]: [usize; 2],
        load: &ReplayLoad,
        stretches: &mut [Stretch],
    ) -> Result<(), Error> {
        let inner = &self.inner;
        let count = load.items.len();
        let mut taken = vec![0.0; takes * count];
        for (i, &item) in load.items.iter().enumerate() {
            let (stretch, at) = (&stretches[item as usize / STRETCH], item as usize % STRETCH);
            for (k, &x) in stretch.taken[at * takes..][..takes].iter().enumerate() {
                taken[k * count + i] = x;
            }
        }
        let outputs = inner.guarded(|| {
            let pipeline = inner.generated(name(), KernelForm::Replay, text);
            let buffers = [
                inner.stored(&load.codes),
                inner.stored(&load.programs),
                inner.stored(&load.instructions),
                inner.stored(&taken),
                inner.storage(load.slots * count),
                inner.storage(gives * count),
            ];
            let bound = buffers.iter().zip(1..).map(|(buffer, k)| (k, buffer));
            let mut work = Commands::new(inner);
            let params = [[count as u32, 0, 0, 0]];
            let groups = [count.div_ceil(GROUP) as u32, 1];
            work.dispatch_with(&pipeline, &params, &bound.collect::<Vec<_>>(), groups);
            work.submit()?;
            let [.., outputs] = buffers;
            Ok(outputs)
        })?;
        let arrival = inner.bring(self, &[(&outputs, 4 * (gives * count) as u64)])?;
        arrival.finish(|_, numbers| {
            let numbers: &[f32] = bytemuck::cast_slice(numbers);
            for (i, &item) in load.items.iter().enumerate() {
                let (stretch, at) = (
                    &mut stretches[item as usize / STRETCH],
                    item as usize % STRETCH,
                );
                for (k, x) in stretch.found[at * gives..][..gives].iter_mut().enumerate() {
                    *x = numbers[k * count + i];
                }
            }
        })
    }
}

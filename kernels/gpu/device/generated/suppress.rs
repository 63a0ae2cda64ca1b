//! Suppression by bit masks: the GPU decides the clear pairs, the CPU the others.
//!
//! Shapes are uploaded best first. Block by block, the GPU compares some remaining rows with all later columns and
//! writes two bits per pair: the result is certainly above the threshold, or so near to it that rounding may decide.
//! The CPU walks through the rows in order. It computes a near pair itself when the outcome depends on it, with the
//! bits of a batch on the CPU.
use super::operation::{Generated, ShaderBody};
use super::text::{GROUP, KernelForm, MOST_GROUPS, both, bound, call};
use super::uploaded::MOST_OPERATIONS;
use crate::error::Argument;
use crate::kernels::call::recording::Call;
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::arch::flat;
use crate::kernels::cpu::checked::check;
use crate::kernels::cpu::lane::{Planes, TILE};
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::plan::{List, plan};
use crate::kernels::cpu::sweep::{RowChoice, Sweep};
use crate::kernels::gpu::device::context::Device;
use crate::kernels::gpu::device::work::Commands;
use crate::kernels::machine::Column;
use crate::kernels::machine::suppress::Greed;
use crate::kernels::machine::suppress::RankedShapes;
use crate::suppression::{Rules, order};
use crate::{Error, Scalar};
use std::fmt::Write;
use std::ops::Range;
use std::sync::Arc;

/// The distance from the threshold below which the processor computes a result.
///
/// On thin, nearly parallel boxes, the worst known case, a software driver's IoU was wrong by 3.3·10⁻⁴; the distance is
/// ten times that. About one in a hundred overlapping pairs is so near.
const NEAR: f32 = 1.0 / 256.0;

/// The number of columns in a word of bits.
const WORD: usize = 32;
/// The number of rows of the first block, which suppresses most of the rest.
const FIRST_ROWS: usize = 256;
/// The size in bytes of masks that are downloaded at a time.
const MOST_MASKS: usize = 1 << 26;

impl Device {
    /// Returns the shapes that no better kept shape overlaps by more than the threshold: their indices, best first, as
    /// [`Machine::suppress`](crate::kernels::Machine::suppress).
    pub(in crate::kernels::gpu::device) fn kept(
        &self,
        call: &Call<f32>,
        shapes: &Column<'_, f32>,
        scores: &[f32],
        rules: Rules<'_, f32>,
    ) -> Result<Vec<usize>, Error> {
        let (plan, made) = (plan(call, true)?, call.generated(true)?);
        // All shapes are checked, so that errors name the caller's rows.
        check(Argument::A, &plan.arguments[0], shapes)?;
        let ranked = RankedShapes::of(order(scores, rules.score)?, shapes, &rules);
        self.inner.alive()?;
        let lists = ranked.lists();
        let pairs = Cpu::new().engine.lists(&plan, &lists)?;
        let kept = suppressed(self, &made, &pairs, ranked.greed(&rules))?;
        Ok(kept.into_iter().map(|place| ranked.order[place]).collect())
    }
}

/// Returns the kept shapes of a list that is given best first.
fn suppressed(
    gpu: &Device,
    made: &Arc<Generated<f32>>,
    pairs: &Pairs<'_, f32>,
    greed: Greed<'_, f32>,
) -> Result<Vec<usize>, Error> {
    let [a, b] = pairs.lists();
    if a.count == 0 {
        return Ok(Vec::new());
    }
    let masks = Masks::new(gpu, made, greed, [&a, &b])?;
    let mut kept = MaskedSuppression {
        rows: masks.first_rows(),
        masks,
        greed,
        gone: vec![0; a.count.div_ceil(WORD)],
        kept: Vec::new(),
        block: MaskBlock::default(),
        at: 0,
        next: 0,
        near: Vec::new(),
        failed: None,
    };
    Sweep::new(pairs.plan, None, &a, &b).run_chosen(&mut kept);
    match kept.failed {
        None => Ok(kept.kept),
        Some(error) => Err(error),
    }
}

/// The masks of some rows.
#[derive(Default)]
struct MaskBlock {
    /// The rows, ascending.
    rows: Vec<u32>,
    /// The first word of columns.
    first: usize,
    /// The bits for certain pairs and for near ones: word by word, and within a word row by row.
    masks: Vec<[u32; 2]>,
}

/// The state of a suppression: which shapes are kept, and which are suppressed.
struct MaskedSuppression<'a> {
    masks: Masks<'a>,
    greed: Greed<'a, f32>,
    /// One bit per shape: set if it is suppressed.
    gone: Vec<u32>,
    kept: Vec<usize>,
    block: MaskBlock,
    /// The next row of the block, and the first shape after its rows.
    at: usize,
    next: usize,
    /// The number of rows of the next block.
    rows: usize,
    /// The columns of the row whose results are near the threshold.
    near: Vec<u32>,
    failed: Option<Error>,
}

fn has(bits: &[u32], place: usize) -> bool {
    bits[place / WORD] >> (place % WORD) & 1 != 0
}

impl MaskedSuppression<'_> {
    /// Computes the masks of the next remaining rows. Returns `false` if there are none.
    fn advance(&mut self) -> bool {
        let count = self.masks.count;
        let rest = (self.next..count).filter(|&row| !has(&self.gone, row));
        let rows: Vec<u32> = rest.take(self.rows).map(|row| row as u32).collect();
        let Some(&last) = rows.last() else {
            return false;
        };
        self.next = last as usize + 1;
        self.at = 0;
        self.rows = (2 * self.rows).min(self.masks.most_rows);
        match self.masks.of(rows) {
            Ok(block) => self.block = block,
            Err(error) => self.failed = Some(error),
        }
        self.failed.is_none()
    }
}

impl RowChoice<f32> for MaskedSuppression<'_> {
    fn next(&mut self) -> Option<usize> {
        if self.kept.len() == self.greed.most {
            return None;
        }
        loop {
            let Some(&row) = self.block.rows.get(self.at) else {
                match self.advance() {
                    true => continue,
                    false => return None,
                }
            };
            self.at += 1;
            if has(&self.gone, row as usize) {
                continue;
            }
            self.kept.push(row as usize);
            let MaskBlock { rows, first, masks } = &self.block;
            let words = masks.iter().skip(self.at - 1).step_by(rows.len());
            self.near.clear();
            for (word, &[certain, near]) in (*first..).zip(words) {
                let gone = &mut self.gone[word];
                *gone |= certain;
                let mut open = near & !*gone;
                while open != 0 {
                    self.near
                        .push(WORD as u32 * word as u32 + open.trailing_zeros());
                    open &= open - 1;
                }
            }
            return Some(row as usize);
        }
    }
    fn wanted(&mut self, columns: &mut Vec<u32>) -> bool {
        columns.clone_from(&self.near);
        true
    }
    fn take(&mut self, columns: &[u32], results: Planes<'_, f32>) {
        for (&column, value) in columns.iter().zip(flat(results.field(0))) {
            if value.above(self.greed.threshold) {
                self.gone[column as usize / WORD] |= 1 << (column as usize % WORD);
            }
        }
    }
}

/// Columns that were uploaded together.
struct Window {
    columns: Range<usize>,
    numbers: wgpu::Buffer,
    bounds: wgpu::Buffer,
    ids: wgpu::Buffer,
}

/// The shapes on the GPU, and the kernel that computes their masks.
struct Masks<'a> {
    gpu: &'a Device,
    made: &'a Arc<Generated<f32>>,
    greed: Greed<'a, f32>,
    /// Both lists: one list of shapes, prepared as either argument.
    rows: &'a List<'a, f32>,
    count: usize,
    windows: Vec<Window>,
    most_rows: usize,
}

impl<'a> Masks<'a> {
    fn new(
        gpu: &'a Device,
        made: &'a Arc<Generated<f32>>,
        greed: Greed<'a, f32>,
        [rows, columns]: [&'a List<'a, f32>; 2],
    ) -> Result<Self, Error> {
        let (inner, count) = (&gpu.inner, rows.count);
        let numbers = inner.most_bytes as usize / 4;
        // Bounds add four numbers to a shape.
        let window = numbers / made.widths[1].max(4);
        let window = window.min(MOST_GROUPS * WORD) / WORD * WORD;
        let widest = window.min(count.next_multiple_of(WORD));
        let most_rows = (numbers / made.widths[0].max(4) / TILE * TILE)
            .min(numbers * WORD / 2 / widest.max(1))
            .min(MOST_MASKS / 8 / count.div_ceil(WORD))
            .min(MOST_OPERATIONS / made.bodies[0].operations.max(1) / widest.max(1))
            .min(MOST_GROUPS * GROUP);
        if window == 0 || most_rows == 0 {
            let [a, b] = [made.widths[0].max(4), made.widths[1].max(4)];
            return Err(inner.too_large((TILE * a).max(WORD * b)));
        }
        let mut masks = Masks {
            gpu,
            made,
            greed,
            rows,
            count,
            windows: Vec::new(),
            most_rows,
        };
        let mut room = Vec::new();
        for start in (0..count).step_by(window) {
            let own = start..count.min(start + window);
            let prepared = made.prepare(1, columns.shapes.numbers(own.clone(), &mut room));
            let bounds: Vec<[f32; 4]> = own.clone().map(|j| bounds_of(columns, j)).collect();
            let ids: Vec<[u32; 2]> = own.clone().map(|j| masks.ids(columns, j)).collect();
            masks.windows.push(inner.guarded(|| {
                Ok(Window {
                    columns: own,
                    numbers: inner.stored(&prepared),
                    bounds: inner.stored(&bounds),
                    ids: inner.stored(&ids),
                })
            })?);
        }
        Ok(masks)
    }
    fn first_rows(&self) -> usize {
        FIRST_ROWS.min(self.most_rows)
    }
    /// Returns a shape's class, and 1 if the CPU computes its results.
    fn ids(&self, list: &List<'_, f32>, i: usize) -> [u32; 2] {
        let class = self.greed.classes.map_or(0, |classes| classes[i]);
        [class, u32::from(list.is_rare(i))]
    }
    /// Computes the masks of some rows, with all columns behind the first row.
    fn of(&self, rows: Vec<u32>) -> Result<MaskBlock, Error> {
        let (inner, made, list) = (&self.gpu.inner, self.made, self.rows);
        let first = rows[0] as usize / WORD;
        let (mut shapes, mut room) = (Vec::new(), Vec::new());
        for &row in &rows {
            shapes.extend_from_slice(list.shape(row as usize, &mut room));
        }
        let numbers = made.prepare(0, &shapes);
        let bounds: Vec<[f32; 4]> = rows.iter().map(|&i| bounds_of(list, i as usize)).collect();
        let ids = rows.iter().map(|&row| {
            let [class, rare] = self.ids(list, row as usize);
            [row, class, rare, 0]
        });
        let ids: Vec<[u32; 4]> = ids.collect();
        let threshold = self.greed.threshold;
        let mut masks = Vec::new();
        inner.guarded(|| {
            let pipeline = inner.generated(&made.name, KernelForm::Masks, || {
                KernelForm::Masks.text(made)
            });
            let own = [
                inner.stored(&numbers),
                inner.stored(&bounds),
                inner.stored(&ids),
            ];
            let mut work = Commands::new(inner);
            for window in &self.windows {
                let words = window.columns.start / WORD..window.columns.end.div_ceil(WORD);
                let words = words.start.max(first)..words.end;
                if words.is_empty() {
                    continue;
                }
                let room = inner.storage(2 * rows.len() * words.len());
                let params = [
                    [
                        rows.len() as u32,
                        window.columns.len() as u32,
                        window.columns.start as u32,
                        (words.start - window.columns.start / WORD) as u32,
                    ],
                    [0; 4],
                    [
                        (threshold - NEAR).to_bits(),
                        (threshold + NEAR).to_bits(),
                        0,
                        0,
                    ],
                ];
                let buffers = [
                    (1, &own[0]),
                    (2, &window.numbers),
                    (3, &own[1]),
                    (4, &window.bounds),
                    (5, &own[2]),
                    (6, &window.ids),
                    (7, &room),
                ];
                let groups = [rows.len().div_ceil(GROUP) as u32, words.len() as u32];
                work.dispatch_with(&pipeline, &params, &buffers, groups);
                masks.push((room, 8 * (rows.len() * words.len()) as u64));
            }
            work.submit().map(drop)
        })?;
        let parts: Vec<_> = masks.iter().map(|(room, bytes)| (room, *bytes)).collect();
        let mut block = MaskBlock {
            rows,
            first,
            masks: Vec::new(),
        };
        inner.bring(self.gpu, &parts)?.finish(|_, numbers| {
            block.masks.extend_from_slice(bytemuck::cast_slice(numbers));
        })?;
        Ok(block)
    }
}

/// Returns a shape's bounds as finite numbers; the whole plane without bounds.
fn bounds_of(list: &List<'_, f32>, i: usize) -> [f32; 4] {
    let all = [-f32::MAX, -f32::MAX, f32::MAX, f32::MAX];
    let bounds = list.bounds_of(i).unwrap_or(all);
    bounds.map(|x| x.clamp(-f32::MAX, f32::MAX))
}

/// Returns the kernel: one thread per row and word of columns. Parameters are the numbers of rows and columns; the
/// first column's index in the list and the first wanted word; the starts of both lists; the limits between which
/// results are near the threshold.
pub(super) fn masks(made: &Generated<f32>, body: &ShaderBody) -> String {
    let mut text = String::from("@group(0) @binding(0) var<uniform> params: array<vec4u, 3>;\n");
    for (k, (access, name, of)) in [
        ("read", "a_numbers", "f32"),
        ("read", "b_numbers", "f32"),
        ("read", "a_bounds", "vec4f"),
        ("read", "b_bounds", "vec4f"),
        ("read", "a_ids", "vec4u"),
        ("read", "b_ids", "vec2u"),
        ("read_write", "masks", "vec2u"),
    ]
    .into_iter()
    .enumerate()
    {
        let _ = writeln!(
            text,
            "@group(0) @binding({}) var<storage, {access}> {name}: array<{of}>;",
            k + 1
        );
    }
    let (outside, inside, inputs) = both(made, 0);
    let (result, unread) = (
        call(body.entry, inputs),
        bound(made, "a_numbers", "b_numbers"),
    );
    let _ = write!(
        text,
        "
@compute @workgroup_size({GROUP})
fn masks_main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) here: u32,
) {{
    let own = group.x * {GROUP}u + here;
    if own >= params[0].x {{
        return;
    }}
    let first = (params[0].w + group.y) * {WORD}u;
    let end = min(first + {WORD}u, params[0].y);
    let id = a_ids[own];
    let own_bounds = a_bounds[own];
    let low = bitcast<f32>(params[2].x);
    let high = bitcast<f32>(params[2].y);
    var certain = 0u;
    var near = 0u;
{unread}{outside}    for (var walked = first; walked < end; walked++) {{
        let other = b_ids[walked];
        let bounds = b_bounds[walked];
        let apart = own_bounds.x > bounds.z | bounds.x > own_bounds.z
            | own_bounds.y > bounds.w | bounds.y > own_bounds.w;
        if params[0].z + walked <= id.x | other.x != id.y | apart {{
            continue;
        }}
{inside}        let y = {result};
        let bit = 1u << (walked - first);
        let is_rare = (id.z | other.y) != 0u;
        // NaN is neither above nor below.
        let is_open = is_rare | !(y[0] < low | y[0] > high);
        near |= select(0u, bit, is_open);
        certain |= select(0u, bit, !is_open & y[0] > high);
    }}
    masks[group.y * params[0].x + own] = vec2u(certain, near);
}}
"
    );
    text
}

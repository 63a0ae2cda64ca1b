//! Results of all pairs of two prepared lists, row by row; pairs that are certainly zero are skipped.
//!
//! Here a *row* is a shape of the first list, a *column* one of the second, a *stretch* a run of columns. A column is
//! *near* a row if their bounds meet. A filter skips all other pairs, whose result is certainly zero; near columns are
//! *picked* and computed tile by tile. *Rare* shapes are too extreme for kernels; the scalar code computes them. A
//! consumer receives results with their columns, whether or not other pairs were skipped.
use crate::Real;
use crate::kernels::cpu::arch::flat;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{
    BLOCK, Lane, LaneBuffer, PLANE, Planes, ResultTiles, TILE, Tiles, planes, tiles, with_lanes,
};
use crate::kernels::cpu::maker::Maker;
use crate::kernels::cpu::overlaps::BOUNDS;
use crate::kernels::cpu::plan::{List, Plan, Rare};
use crate::kernels::cpu::tree::Tree;
use crate::kernels::cpu::work::Interruption;
use std::ops::Range;

/// The smallest number of columns for which a tree is built, and the largest share of near pairs.
pub const LEAST_OF_TREE: usize = 512;
const SPARSE: f64 = 1.0 / 24.0;

/// The share of near pairs above which sums over lists are computed without bounds.
const DENSE: f64 = 0.6;

/// The number of rows from which the share of near pairs is estimated.
const SAMPLED: usize = 16;

/// The number of rows between two questions whether a batch is interrupted, so few that even slow pairs of a row and a
/// stretch take less than a tenth of a second.
const ROWS_UNASKED: usize = 16;

/// The number of tiles that one call of a kernel computes for rows with few columns: the processor overlaps their
/// latencies.
const GROUP: usize = 8;

/// An upstream matrix: row `i` starts at `i * step`. With a step of zero row 0 is every row.
#[derive(Clone, Copy, Debug)]
pub struct Upstream<'a, T> {
    /// The numbers.
    pub derivatives: &'a [T],
    /// The distance from one row to the next.
    pub step: usize,
}

/// Results of a row with some columns.
///
/// The results of a row come stretch by stretch. A long stretch may come in several parts.
pub struct RowPart<'a, T> {
    /// The row.
    pub row: usize,
    /// The columns of this part's stretch. Columns of it that are in no part have zeros.
    pub stretch: Range<usize>,
    /// `true` for the first part of a stretch.
    pub is_first: bool,
    /// The columns of this part.
    pub columns: PartColumns<'a>,
    /// Their results.
    pub results: Planes<'a, T>,
}

/// Columns of a part.
pub enum PartColumns<'a> {
    /// The whole stretch, which begins at a multiple of sixteen.
    Run(Range<usize>),
    /// Some columns, ascending.
    Picked(&'a [u32]),
}

/// A choice of rows, and of the later columns to compute with each.
pub(crate) trait RowChoice<T> {
    /// Returns the next row.
    fn next(&mut self) -> Option<usize>;
    /// Returns `true` if the row's result with a column is wanted.
    fn wants(&self, _column: usize) -> bool {
        true
    }
    /// Replaces `columns` by the wanted ones and returns `true`; returns `false` if they must be searched for.
    fn wanted(&mut self, _columns: &mut Vec<u32>) -> bool {
        false
    }
    /// Receives the results of the row with some wanted columns.
    fn take(&mut self, columns: &[u32], results: Planes<'_, T>);
}

/// A computation of all pairs.
pub struct Sweep<'a, T: Real> {
    a: &'a List<'a, T>,
    b: &'a List<'a, T>,
    maker: &'a dyn Maker<T>,
    /// The number of scalars per result.
    fields: usize,
    rare: Option<&'a Rare<T>>,
    /// Columns as rows of numbers, to gather from, and the length of such a row.
    picking: LaneBuffer<T>,
    stride: usize,
    tree: Option<Tree<T>>,
    /// The factors of derivatives.
    upstream: Option<Upstream<'a, T>>,
    /// In quarters of a stretch: the share of near columns up to which these are picked; beyond it all are computed.
    quarters: usize,
}

impl<'a, T: Real> Sweep<'a, T> {
    /// Prepares a sweep over results, or with an `upstream` over results with derivatives. Bounds are compared if both
    /// lists have them.
    pub fn new(
        plan: &'a Plan<T>,
        upstream: Option<Upstream<'a, T>>,
        a: &'a List<'a, T>,
        b: &'a List<'a, T>,
    ) -> Self {
        let mut sweep = Sweep {
            a,
            b,
            maker: &*plan.maker,
            fields: plan.made(),
            rare: plan.rare.as_ref(),
            picking: LaneBuffer::new(0),
            stride: b.stride(),
            tree: None,
            // Derivatives are always picked.
            quarters: upstream.map_or(3, |_| 4),
            upstream,
        };
        if let (Some(_), Some(bounds)) = (&a.bounds, &b.bounds) {
            let near = match b.count >= LEAST_OF_TREE || upstream.is_some() {
                true => sweep.share_of_near(),
                false => 1.0,
            };
            if upstream.is_some() && near > DENSE {
                return sweep;
            }
            sweep.picking = b.picking();
            if b.count >= LEAST_OF_TREE && near <= SPARSE {
                sweep.tree = Some(Tree::new(bounds, b.count));
            }
        }
        sweep
    }

    /// Computes the rows of a choice, each with the later columns that are wanted and, with bounds, near.
    pub fn run_chosen(mut self, choice: &mut impl RowChoice<T>) {
        if self.picking.is_empty() {
            self.picking = self.b.picking();
        }
        let lanes = SweepBuffers::lanes(&self).iter().sum();
        with_lanes(lanes, |lanes| {
            let mut buffers = SweepBuffers::new(&self, lanes);
            let count = self.b.count;
            let (mut room, mut hits) = (Vec::new(), Vec::new());
            let interruption = Interruption::current();
            while let Some(row) = choice.next() {
                if row % ROWS_UNASKED == 0 && interruption.is_due() {
                    return;
                }
                if !choice.wanted(&mut hits) {
                    let near = self.near(row, &mut room);
                    hits.clear();
                    hits.extend(near.iter().filter(|&&column| choice.wants(column as usize)));
                }
                if !hits.is_empty() {
                    buffers.choose(row);
                    buffers.some(0..count, &hits, &mut |part: RowPart<'_, T>| {
                        if let PartColumns::Picked(columns) = part.columns {
                            choice.take(columns, part.results);
                        }
                    });
                }
            }
        });
    }

    /// Returns the columns whose bounds meet the row's, ascending; without bounds all columns from the row's own index
    /// on. Earlier ones may be among them: [`RowChoice::wants`] rejects these.
    fn near<'r>(&self, row: usize, room: &'r mut Vec<u32>) -> &'r [u32] {
        let count = self.b.count;
        match (&self.tree, &self.b.bounds, self.a.bounds_of(row)) {
            (Some(tree), _, Some(own)) => tree.near(&own, room),
            (None, Some(bounds), Some(own)) => {
                let first = row / TILE;
                let rest = Tiles::new(&bounds[first * BOUNDS..], BOUNDS);
                // The kernel writes sixteen places at a time.
                room.resize((tiles(count) + 1) * TILE, 0);
                let near = (kernels_in::<T>().near)(&own, rest, (first * TILE) as u32, room);
                &room[..near]
            }
            _ => {
                room.clear();
                room.extend(row as u32..count as u32);
                room
            }
        }
    }

    /// Returns `true` if pairs whose bounds do not meet are left out.
    pub fn is_filtered(&self) -> bool {
        !self.picking.is_empty()
    }

    /// Returns the share of pairs whose bounds meet, estimated from some rows.
    fn share_of_near(&self) -> f64 {
        let Some(bounds) = &self.b.bounds else {
            return 1.0;
        };
        let mut hits = vec![0; (tiles(self.b.count) + 1) * TILE];
        let step = self.a.count.div_ceil(SAMPLED).max(1);
        let (mut near, mut pairs) = (0, 0);
        for i in (0..self.a.count).step_by(step) {
            if let Some(row) = self.a.bounds_of(i) {
                let bounds = Tiles::new(bounds, BOUNDS);
                near += (kernels_in::<T>().near)(&row, bounds, 0, &mut hits);
                pairs += self.b.count;
            }
        }
        near as f64 / pairs.max(1) as f64
    }

    /// Computes some rows and calls `consume` with their results. Columns come in order within each row, rows in order
    /// within each column.
    pub fn run(&self, rows: Range<usize>, consume: impl FnMut(RowPart<'_, T>)) {
        let lanes = SweepBuffers::lanes(self).iter().sum();
        with_lanes(lanes, |lanes| self.run_on(lanes, rows, consume));
    }

    fn run_on(
        &self,
        lanes: &mut [Lane<T>],
        rows: Range<usize>,
        mut consume: impl FnMut(RowPart<'_, T>),
    ) {
        let mut buffers = SweepBuffers::new(self, lanes);
        let interruption = Interruption::current();
        if let Some(tree) = &self.tree {
            let mut room = Vec::new();
            let mut group = RowGroup::default();
            let is_plain =
                self.upstream.is_none() && self.a.rare.is_empty() && self.b.rare.is_empty();
            for row in rows {
                if row % ROWS_UNASKED == 0 && interruption.is_due() {
                    return;
                }
                let Some(bounds) = self.a.bounds_of(row) else {
                    continue;
                };
                let hits = tree.near(&bounds, &mut room);
                if is_plain && tiles(hits.len()) <= GROUP {
                    if group.tiles + tiles(hits.len()) > GROUP {
                        buffers.finish(&mut group, &mut consume);
                    }
                    buffers.add(&mut group, row, hits);
                } else {
                    buffers.finish(&mut group, &mut consume);
                    buffers.choose(row);
                    buffers.some(0..self.b.count, hits, &mut consume);
                }
            }
            return buffers.finish(&mut group, &mut consume);
        }
        let mut hits = [0; (BLOCK + 1) * TILE];
        let step = BLOCK * TILE;
        for first in (0..self.b.count).step_by(step) {
            let stretch = first..self.b.count.min(first + step);
            let bounds = match &self.b.bounds {
                Some(bounds) if self.is_filtered() => {
                    let bounds = &bounds[first / TILE * BOUNDS..];
                    Some(Tiles::new(&bounds[..tiles(stretch.len()) * BOUNDS], BOUNDS))
                }
                _ => None,
            };
            for row in rows.clone() {
                if row % ROWS_UNASKED == 0 && interruption.is_due() {
                    return;
                }
                buffers.choose(row);
                if let (Some(bounds), Some(own)) = (bounds, self.a.bounds_of(row)) {
                    let near = (kernels_in::<T>().near)(&own, bounds, first as u32, &mut hits);
                    if 4 * near <= self.quarters * stretch.len() {
                        buffers.some(stretch.clone(), &hits[..near], &mut consume);
                        continue;
                    }
                }
                buffers.all(stretch.clone(), &mut consume);
            }
        }
    }
}

/// Rows with few columns that one call of a kernel computes together.
#[derive(Default)]
struct RowGroup {
    /// The number of tiles in use.
    tiles: usize,
    /// Each row, its first tile, and the end of its columns in `columns`.
    rows: Vec<(usize, usize, usize)>,
    columns: Vec<u32>,
}

/// The lanes and numbers that one thread computes with.
struct SweepBuffers<'a, T: Real> {
    sweep: &'a Sweep<'a, T>,
    row: usize,
    row_is_rare: bool,
    /// The row's shape broadcast to a tile; for a group, one such tile after another.
    own: &'a mut [Lane<T>],
    /// Gathered columns.
    picked: &'a mut [Lane<T>],
    /// Upstream derivatives.
    seeds: &'a mut [Lane<T>],
    results: &'a mut [Lane<T>],
    /// The numbers of one result.
    one: Vec<T>,
}

impl<'a, T: Real> SweepBuffers<'a, T> {
    /// Returns the numbers of lanes of the buffers: for the row, gathered columns, upstream derivatives and results.
    fn lanes(sweep: &Sweep<'_, T>) -> [usize; 4] {
        [
            GROUP * sweep.a.frame_fields,
            BLOCK * sweep.b.frame_fields,
            BLOCK,
            planes(sweep.fields),
        ]
    }
    /// Creates buffers on some lanes with arbitrary contents.
    fn new(sweep: &'a Sweep<'a, T>, lanes: &'a mut [Lane<T>]) -> Self {
        let [own, picked, seeds, _] = Self::lanes(sweep);
        let (own, lanes) = lanes.split_at_mut(own);
        let (picked, lanes) = lanes.split_at_mut(picked);
        let (seeds, results) = lanes.split_at_mut(seeds);
        SweepBuffers {
            sweep,
            row: usize::MAX,
            row_is_rare: false,
            own,
            picked,
            seeds,
            results,
            one: vec![T::default(); sweep.fields],
        }
    }
    /// Makes `row` the current row.
    #[inline]
    fn choose(&mut self, row: usize) {
        if row != self.row {
            self.row = row;
            let own = &mut self.own[..self.sweep.a.frame_fields];
            self.sweep.a.broadcast(row, own);
            self.row_is_rare = !self.sweep.a.rare.is_empty() && self.sweep.a.is_rare(row);
        }
    }
    /// Returns the row's upstream derivatives.
    fn upstream(&self) -> Option<&'a [T]> {
        let Upstream { derivatives, step } = self.sweep.upstream?;
        Some(&derivatives[self.row * step..][..self.sweep.b.count])
    }
    /// Computes the row with some columns into the buffer of results.
    fn make(&mut self, columns: Tiles<'_, T>, count: usize) {
        let inputs = [Tiles::one(self.own), columns, Tiles::new(self.seeds, 1)];
        let used = if self.sweep.upstream.is_some() { 3 } else { 2 };
        let out = ResultTiles {
            lanes: self.results,
            tiles: tiles(count),
        };
        self.sweep.maker.make(&inputs[..used], out);
    }
    fn results(&self) -> Planes<'_, T> {
        Planes(self.results)
    }
    /// Adds a row with few columns to the group, which has enough free tiles.
    fn add(&mut self, group: &mut RowGroup, row: usize, columns: &[u32]) {
        let Sweep { a, b, stride, .. } = *self.sweep;
        let first = group.tiles;
        group.tiles += tiles(columns.len());
        for t in first..group.tiles {
            let own = &mut self.own[t * a.frame_fields..][..a.frame_fields];
            a.broadcast(row, own);
        }
        let picked = &mut self.picked[first * b.frame_fields..group.tiles * b.frame_fields];
        (kernels_in::<T>().gather)(
            flat(&self.sweep.picking),
            stride,
            columns,
            b.frame_fields,
            picked,
        );
        group.columns.extend_from_slice(columns);
        group.rows.push((row, first, group.columns.len()));
    }
    /// Computes the group and passes on its results.
    fn finish(&mut self, group: &mut RowGroup, consume: &mut impl FnMut(RowPart<'_, T>)) {
        let Sweep { a, b, .. } = *self.sweep;
        if group.tiles > 0 {
            let own = Tiles::new(self.own, a.frame_fields);
            let picked = Tiles::new(self.picked, b.frame_fields);
            let out = ResultTiles {
                lanes: self.results,
                tiles: group.tiles,
            };
            self.sweep.maker.make(&[own, picked], out);
            // The row's lanes hold the rows of the group, so the next row must be broadcast again.
            self.row = usize::MAX;
        }
        let mut start = 0;
        for &(row, tile, end) in &group.rows {
            consume(RowPart {
                row,
                stretch: 0..b.count,
                is_first: true,
                columns: PartColumns::Picked(&group.columns[start..end]),
                results: Planes(&self.results[tile..]),
            });
            start = end;
        }
        group.tiles = 0;
        group.rows.clear();
        group.columns.clear();
    }
    /// Computes the row with all columns of a stretch.
    fn all(&mut self, stretch: Range<usize>, consume: &mut impl FnMut(RowPart<'_, T>)) {
        let b = self.sweep.b;
        let first = stretch.start;
        let columns = &b.frames[first / TILE * b.frame_fields..];
        if let Some(upstream) = self.upstream() {
            (kernels_in::<T>().bring)(&upstream[stretch.clone()], 1, self.seeds);
        }
        self.make(Tiles::new(columns, b.frame_fields), stretch.len());
        if self.row_is_rare {
            for j in stretch.clone() {
                self.mend(j, j - first);
            }
        } else if !b.rare.is_empty() {
            let from = b.rare.partition_point(|&j| (j as usize) < first);
            let rare = b.rare[from..].iter().map(|&j| j as usize);
            for j in rare.take_while(|&j| j < stretch.end) {
                self.mend(j, j - first);
            }
        }
        consume(RowPart {
            row: self.row,
            stretch: stretch.clone(),
            is_first: true,
            columns: PartColumns::Run(stretch),
            results: self.results(),
        });
    }
    /// Computes the row with some columns of a stretch; the others have zeros.
    fn some(
        &mut self,
        stretch: Range<usize>,
        hits: &[u32],
        consume: &mut impl FnMut(RowPart<'_, T>),
    ) {
        let Sweep { b, stride, .. } = *self.sweep;
        let picked = std::mem::take(&mut self.picked);
        let parts = hits.chunks(BLOCK * TILE);
        // Without hits an empty part makes the consumer write the stretch's zeros.
        let none = hits.is_empty().then_some(hits);
        for (i, columns) in parts.chain(none).enumerate() {
            let tiles = &mut picked[..tiles(columns.len()) * b.frame_fields];
            (kernels_in::<T>().gather)(
                flat(&self.sweep.picking),
                stride,
                columns,
                b.frame_fields,
                tiles,
            );
            if let Some(upstream) = self.upstream() {
                for (seeds, columns) in self.seeds.iter_mut().zip(columns.chunks(TILE)) {
                    for (seed, &j) in seeds.0.iter_mut().zip(columns) {
                        *seed = upstream[j as usize];
                    }
                }
            }
            self.make(Tiles::new(tiles, b.frame_fields), columns.len());
            if self.row_is_rare || !b.rare.is_empty() {
                for (k, &j) in columns.iter().enumerate() {
                    if self.row_is_rare || b.is_rare(j as usize) {
                        self.mend(j as usize, k);
                    }
                }
            }
            consume(RowPart {
                row: self.row,
                stretch: stretch.clone(),
                is_first: i == 0,
                columns: PartColumns::Picked(columns),
                results: self.results(),
            });
        }
        self.picked = picked;
    }
    /// Replaces the result of a rare pair by that of the scalar code.
    fn mend(&mut self, column: usize, place: usize) {
        let Sweep { a, b, rare, .. } = *self.sweep;
        if let Some(rare) = rare {
            let out_bar = self
                .upstream()
                .map_or(T::one(), |upstream| upstream[column]);
            let (mut own, mut other) = (Vec::new(), Vec::new());
            let shapes = [a.shape(self.row, &mut own), b.shape(column, &mut other)];
            rare(&shapes, &[out_bar], &mut self.one);
            for (k, &x) in self.one.iter().enumerate() {
                self.results[k * PLANE + place / TILE].0[place % TILE] = x;
            }
        }
    }
}

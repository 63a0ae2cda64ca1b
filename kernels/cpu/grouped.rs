//! All pairs within groups of two lists, such as the detections and truths of every frame, over plain numbers.
//!
//! Small groups are computed together, since one group would leave the lanes of a tile partly empty. A group that is
//! large enough for a tree of bounds, or for threads of its own, runs like two lists without groups. Both ways give equal
//! bits.
use crate::Real;
use crate::kernels::cpu::arch::flat;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::greedy;
use crate::kernels::cpu::lane::{
    BLOCK, Lane, LaneBuffer, PLANE, Planes, ResultTiles, TILE, Tiles, planes, tiles, with_lanes,
};
use crate::kernels::cpu::overlaps::BOUNDS;
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::plan::{List, Plan};
use crate::kernels::cpu::reductions::{self, initial, raise};
use crate::kernels::cpu::sweep::LEAST_OF_TREE;
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::GroupSpans;
use crate::kernels::machine::found::{Best, Found};
use crate::kernels::machine::suppress::Greed;
use std::ops::Range;

/// The work of a piece of groups that one thread takes, in pairs: a millisecond or less. A larger group is a piece of
/// its own.
const PIECE: usize = 1 << 18;

/// Cuts the groups into pieces of about equal work, which are ranges of groups. The cuts depend on the offsets alone.
fn pieces(spans: &GroupSpans<'_>) -> Vec<Range<usize>> {
    let (mut pieces, mut first, mut work) = (Vec::new(), 0, 0);
    for group in 0..spans.count() {
        let own = cost(spans, group);
        if group > first && (work >= PIECE || is_alone(spans, group)) {
            pieces.push(first..group);
            (first, work) = (group, 0);
        }
        work += own;
        if is_alone(spans, group) {
            // The next group begins a piece.
            work = PIECE;
        }
    }
    pieces.extend((first < spans.count()).then(|| first..spans.count()));
    pieces
}

/// Returns the cost of a group, in pairs. A row adds about `TILE` pairs for its preparation and the comparison of its
/// bounds; a column adds one.
fn cost(spans: &GroupSpans<'_>, group: usize) -> usize {
    let (rows, columns) = (spans.rows(group).len(), spans.columns(group).len());
    rows.saturating_mul(columns + TILE).saturating_add(columns)
}

/// Returns `true` if a group is large enough to be a piece of its own. The first group of a piece therefore tells if the
/// piece is one large group.
fn is_alone(spans: &GroupSpans<'_>, group: usize) -> bool {
    spans.columns(group).len() >= LEAST_OF_TREE || cost(spans, group) >= PIECE
}

/// Returns the pairs of a range of rows with a range of columns.
fn part<'p, T: Real>(pairs: &'p Pairs<'_, T>, spans: &[Range<usize>; 2]) -> Pairs<'p, T> {
    Pairs {
        plan: pairs.plan,
        shapes: [0, 1].map(|k| pairs.shapes[k].part(&spans[k])),
        rare: pairs.rare,
        filter: pairs.filter,
    }
}

/// The results of some pairs, ordered by row and then by column.
struct PairScores<'a, T> {
    rows: &'a [u32],
    columns: &'a [u32],
    values: &'a [T],
}

impl<T: Copy> PairScores<'_, T> {
    fn each(&self) -> impl Iterator<Item = (usize, usize, T)> + '_ {
        let places = self.rows.iter().zip(self.columns).zip(self.values);
        places.map(|((&row, &column), &value)| (row as usize, column as usize, value))
    }
}

/// Pairs of two lists that are buffered until they fill a block.
struct PairBuffer<'a, T: Real> {
    plan: &'a Plan<T>,
    lists: &'a [List<'a, T>; 2],
    /// The prepared shapes of each list as rows of numbers, from which `picked` is gathered.
    picking: [LaneBuffer<T>; 2],
    /// The row of each buffered pair.
    rows: Vec<u32>,
    /// The column of each buffered pair.
    columns: Vec<u32>,
    /// The prepared shapes of the buffered pairs, in tiles.
    picked: [&'a mut [Lane<T>]; 2],
    results: &'a mut [Lane<T>],
    /// The numbers of one result of the scalar code.
    one: Vec<T>,
}

impl<T: Real> PairBuffer<'_, T> {
    /// Adds the pairs of a row with some columns to the buffer. A full buffer is computed and passed to `consume`.
    fn add(
        &mut self,
        row: usize,
        mut columns: &[u32],
        consume: &mut impl FnMut(PairScores<'_, T>),
    ) {
        while !columns.is_empty() {
            let room = BLOCK * TILE - self.columns.len();
            let (now, rest) = columns.split_at(room.min(columns.len()));
            self.columns.extend_from_slice(now);
            self.rows.resize(self.columns.len(), row as u32);
            if self.columns.len() == BLOCK * TILE {
                self.finish(consume);
            }
            columns = rest;
        }
    }
    /// Computes the buffered pairs, passes their results to `consume` and empties the buffer.
    fn finish(&mut self, consume: &mut impl FnMut(PairScores<'_, T>)) {
        let count = self.columns.len();
        if count == 0 {
            return;
        }
        for (k, places) in [&self.rows, &self.columns].into_iter().enumerate() {
            let (list, numbers) = (&self.lists[k], flat(&self.picking[k]));
            let picked = &mut self.picked[k][..tiles(count) * list.frame_fields];
            (kernels_in::<T>().gather)(numbers, list.stride(), places, list.frame_fields, picked);
        }
        let inputs = [0, 1].map(|k| Tiles::new(&*self.picked[k], self.lists[k].frame_fields));
        let out = ResultTiles {
            lanes: &mut *self.results,
            tiles: tiles(count),
        };
        self.plan.maker.make(&inputs, out);
        self.mend();
        consume(PairScores {
            rows: &self.rows,
            columns: &self.columns,
            values: &flat(Planes(&*self.results).field(0))[..count],
        });
        self.rows.clear();
        self.columns.clear();
    }
    /// Replaces the results of pairs with a rare shape, too extreme for the kernel, by those of the scalar code.
    fn mend(&mut self) {
        let [a, b] = self.lists;
        let Some(rare) = &self.plan.rare else { return };
        if a.rare.is_empty() && b.rare.is_empty() {
            return;
        }
        let (mut own, mut other) = (Vec::new(), Vec::new());
        for (place, (&row, &column)) in self.rows.iter().zip(&self.columns).enumerate() {
            let (row, column) = (row as usize, column as usize);
            if a.is_rare(row) || b.is_rare(column) {
                let shapes = [a.shape(row, &mut own), b.shape(column, &mut other)];
                rare(&shapes, &[T::one()], &mut self.one);
                for (k, &x) in self.one.iter().enumerate() {
                    self.results[k * PLANE + place / TILE].0[place % TILE] = x;
                }
            }
        }
    }
}

/// Computes the pairs of small groups for which `wants` returns `true`. Each group is given by its rows and columns. If
/// shapes have bounds, pairs whose bounds do not meet are left out.
fn sweep_small<T: Real>(
    pairs: &Pairs<'_, T>,
    groups: impl Iterator<Item = [Range<usize>; 2]>,
    wants: impl Fn(usize, usize) -> bool,
    mut consume: impl FnMut(PairScores<'_, T>),
) {
    let lists = pairs.lists();
    let [a, b] = &lists;
    let lanes = [a.frame_fields, b.frame_fields].map(|fields| BLOCK * fields);
    let fields = pairs.plan.made();
    with_lanes(lanes[0] + lanes[1] + planes(fields), |all| {
        let (own, all) = all.split_at_mut(lanes[0]);
        let (others, results) = all.split_at_mut(lanes[1]);
        let mut buffer = PairBuffer {
            plan: pairs.plan,
            lists: &lists,
            picking: [a.picking(), b.picking()],
            rows: Vec::with_capacity(BLOCK * TILE),
            columns: Vec::with_capacity(BLOCK * TILE),
            picked: [own, others],
            results,
            one: vec![T::default(); fields],
        };
        let (mut room, mut hits) = (Vec::new(), Vec::new());
        for [rows, columns] in groups {
            let first = columns.start / TILE;
            let bounds = b.bounds.as_ref();
            let bounds = bounds.map(|all| &all[first * BOUNDS..tiles(columns.end) * BOUNDS]);
            room.resize((tiles(columns.end) - first + 1) * TILE, 0);
            for row in rows {
                let near = match (bounds, a.bounds_of(row)) {
                    (Some(bounds), Some(own)) => {
                        let bounds = Tiles::new(bounds, BOUNDS);
                        let near = (kernels_in::<T>().near)(
                            &own,
                            bounds,
                            (first * TILE) as u32,
                            &mut room,
                        );
                        // The first and the last tile have columns of other groups.
                        let near = &room[..near];
                        let from = near.partition_point(|&j| (j as usize) < columns.start);
                        let to = near.partition_point(|&j| (j as usize) < columns.end);
                        &near[from..to]
                    }
                    _ => {
                        room.clear();
                        room.extend(columns.start as u32..columns.end as u32);
                        &room
                    }
                };
                hits.clear();
                hits.extend(near.iter().filter(|&&column| wants(row, column as usize)));
                buffer.add(row, &hits, &mut consume);
            }
        }
        buffer.finish(&mut consume);
    });
}

/// A piece of work: some groups, the pairs of their rows and columns, and the first row and column in the whole lists.
struct GroupPiece<'p, T> {
    groups: Range<usize>,
    pairs: Pairs<'p, T>,
    from: [usize; 2],
}

impl<T: Real> GroupPiece<'_, T> {
    /// Returns the groups, with rows and columns counted from the piece's first ones.
    fn groups<'s>(
        &self,
        spans: &'s GroupSpans<'s>,
    ) -> impl Iterator<Item = [Range<usize>; 2]> + 's {
        let [a, b] = self.from;
        let shifted = |span: Range<usize>, by: usize| span.start - by..span.end - by;
        self.groups
            .clone()
            .map(move |g| [shifted(spans.rows(g), a), shifted(spans.columns(g), b)])
    }
}

/// Calls `run` for every piece with the entry of `work` that belongs to it, on all threads.
fn each_piece<T: Real, W: Send>(
    pairs: &Pairs<'_, T>,
    spans: &GroupSpans<'_>,
    work: Vec<(Range<usize>, W)>,
    run: impl Fn(GroupPiece<'_, T>, W) + Send + Sync,
) {
    in_parallel(work, |(groups, work): (Range<usize>, W)| {
        let own = spans.of(&groups);
        let piece = GroupPiece {
            groups,
            from: [own[0].start, own[1].start],
            pairs: part(pairs, &own),
        };
        run(piece, work);
    });
}

/// Returns every pair within a group whose score is above the threshold, ordered by row and then by column.
pub fn above<T: Real>(pairs: &Pairs<'_, T>, spans: GroupSpans<'_>, threshold: T) -> Vec<Found<T>> {
    let pieces = pieces(&spans);
    let mut found = vec![Vec::new(); pieces.len()];
    let work = pieces.into_iter().zip(&mut found).collect();
    each_piece(pairs, &spans, work, |piece, found: &mut Vec<Found<T>>| {
        let [a, b] = piece.from;
        if is_alone(&spans, piece.groups.start) {
            *found = reductions::above(&piece.pairs, threshold);
            for pair in found {
                (pair.row, pair.column) = (pair.row + a, pair.column + b);
            }
            return;
        }
        let groups = piece.groups(&spans);
        sweep_small(
            &piece.pairs,
            groups,
            |_, _| true,
            |batch| {
                let all = batch.each().filter(|(_, _, value)| value.above(threshold));
                found.extend(all.map(|(row, column, value)| Found {
                    row: row + a,
                    column: column + b,
                    value,
                }));
            },
        );
    });
    found.concat()
}

/// Returns the largest score of every row, or of every column, within its group; of equal ones the first. The entry is
/// `None` for a row whose group has no columns, and for a column whose group has no rows.
pub fn most<T: Real>(
    pairs: &Pairs<'_, T>,
    spans: GroupSpans<'_>,
    of_rows: bool,
) -> Vec<Option<Best<T>>> {
    let side = usize::from(!of_rows);
    let mut best = vec![None; pairs.counts()[side]];
    let (mut work, mut rest) = (Vec::new(), &mut best[..]);
    for piece in pieces(&spans) {
        let own = spans.of(&piece)[side].len();
        let (now, later) = rest.split_at_mut(own);
        work.push((piece, now));
        rest = later;
    }
    type Entries<'a, T> = &'a mut [Option<Best<T>>];
    each_piece(pairs, &spans, work, |piece, best: Entries<'_, T>| {
        let from = piece.from[1 - side];
        if is_alone(&spans, piece.groups.start) {
            if piece.pairs.counts().contains(&0) {
                return;
            }
            let all = match of_rows {
                true => reductions::most_of_rows(&piece.pairs),
                false => reductions::most_of_columns(&piece.pairs),
            };
            for (entry, Best { value, index }) in best.iter_mut().zip(all) {
                let index = index + from;
                *entry = Some(Best { value, index });
            }
            return;
        }
        for spans in piece.groups(&spans) {
            let (own, other) = (&spans[side], &spans[1 - side]);
            if !other.is_empty() {
                let first = initial(piece.pairs.is_filtered(), other.start + from);
                best[own.clone()].fill(Some(first));
            }
        }
        let groups = piece.groups(&spans);
        sweep_small(
            &piece.pairs,
            groups,
            |_, _| true,
            |batch| {
                for (row, column, value) in batch.each() {
                    let (own, other) = match of_rows {
                        true => (row, column),
                        false => (column, row),
                    };
                    if let Some(best) = &mut best[own] {
                        raise(best, value, other + from);
                    }
                }
            },
        );
    });
    best
}

/// Returns the indices of the kept shapes. The list is given group by group, each group best first. A kept shape
/// suppresses later ones of its group and class that it overlaps enough. The rules limit the number of kept shapes of a
/// group.
pub fn suppress<T: Real>(
    pairs: &Pairs<'_, T>,
    offsets: &[usize],
    rules: Greed<'_, T>,
) -> Vec<usize> {
    let spans = GroupSpans {
        a: offsets,
        b: offsets,
    };
    let pieces = pieces(&spans);
    let mut kept = vec![Vec::new(); pieces.len()];
    let work = pieces.into_iter().zip(&mut kept).collect();
    each_piece(pairs, &spans, work, |piece, kept: &mut Vec<usize>| {
        let from = piece.from[0];
        let classes = rules.classes.map(|classes| &classes[from..]);
        if is_alone(&spans, piece.groups.start) {
            *kept = greedy::suppress(&piece.pairs, Greed { classes, ..rules });
            kept.iter_mut().for_each(|place| *place += from);
            return;
        }
        let mut found: Vec<(usize, usize)> = Vec::new();
        let groups = piece.groups(&spans);
        let is_later = |row: usize, column: usize| {
            column > row && classes.is_none_or(|classes| classes[column] == classes[row])
        };
        sweep_small(&piece.pairs, groups, is_later, |batch| {
            let all = batch.each().filter(|(_, _, x)| x.above(rules.threshold));
            found.extend(all.map(|(row, column, _)| (row, column)));
        });
        let mut suppressed = vec![false; piece.pairs.counts()[0]];
        let mut found = found.into_iter().peekable();
        for [rows, _] in piece.groups(&spans) {
            let mut left = rules.most;
            for row in rows {
                let is_kept = !suppressed[row] && left > 0;
                if is_kept {
                    kept.push(row + from);
                    left -= 1;
                }
                while let Some((_, column)) = found.next_if(|pair| pair.0 == row) {
                    suppressed[column] |= is_kept;
                }
            }
        }
    });
    kept.concat()
}

//! The least results of the pairs within groups, over plain numbers.
//!
//! Here an *own* item is one of which the nearest *other* is searched for: a row, or a column. Boxes around both give a
//! lower bound of their result. Two others of the least bounds are computed first, then some with a bound below the
//! result, then all that are left. Pairs of several own items share tiles.
use crate::Real;
use crate::kernels::cpu::arch::flat;
use crate::kernels::cpu::blocks::reach;
use crate::kernels::cpu::lane::{
    BLOCK, LaneBuffer, Planes, ResultTiles, TILE, Tiles, planes, tiles, with_kept,
};
use crate::kernels::cpu::lower_bounds::{Boxes, Open};
use crate::kernels::cpu::plan::Plan;
use crate::kernels::cpu::work::{in_parallel, rows_per_piece};
use crate::kernels::machine::found::Found;
use crate::kernels::machine::{Column, GroupSpans, Least, LeastPairs};
use std::ops::Range;

/// The number of own items whose pairs are computed together.
const TOGETHER: usize = 32;
/// The number of others up to which all are computed next, and the number of those that are, of more.
const FEW: usize = 24;
const SOME: usize = 8;

/// Pairs that are computed together, in tiles.
struct PairTiles<'a, T: Real> {
    plan: &'a Plan<T>,
    lists: &'a [Column<'a, T>; 2],
    pairs: Vec<[u32; 2]>,
    shapes: [LaneBuffer<T>; 2],
    frames: [LaneBuffer<T>; 2],
    results: LaneBuffer<T>,
    room: Vec<T>,
}

impl<'a, T: Real> PairTiles<'a, T> {
    fn new(plan: &'a Plan<T>, lists: &'a [Column<'a, T>; 2]) -> Self {
        let of = |k: usize| &plan.arguments[k];
        let frame = |k: usize| of(k).frame.as_ref().map_or(0, |frame| frame.0);
        PairTiles {
            plan,
            lists,
            pairs: Vec::new(),
            shapes: [0, 1].map(|k| LaneBuffer::new(BLOCK * of(k).fields)),
            frames: [0, 1].map(|k| LaneBuffer::new(BLOCK * frame(k))),
            results: LaneBuffer::new(planes(plan.made())),
            room: Vec::new(),
        }
    }
    /// Adds a pair of a row and a column. A full block is computed and passed to `take`.
    fn add(&mut self, pair: [u32; 2], take: &mut impl FnMut([u32; 2], T)) {
        self.pairs.push(pair);
        if self.pairs.len() == BLOCK * TILE {
            self.finish(take);
        }
    }
    /// Computes the pairs, passes their results to `take` and empties the list.
    fn finish(&mut self, take: &mut impl FnMut([u32; 2], T)) {
        let count = self.pairs.len();
        if count == 0 {
            return;
        }
        for k in [0, 1] {
            let (list, fields) = (&self.lists[k], self.plan.arguments[k].fields);
            for i in 0..tiles(count) * TILE {
                // The last pair pads the last tile.
                let item = self.pairs[i.min(count - 1)][k] as usize;
                let numbers = list.numbers(item..item + 1, &mut self.room);
                let tile = &mut self.shapes[k][i / TILE * fields..][..fields];
                for (lane, &x) in tile.iter_mut().zip(numbers) {
                    lane.0[i % TILE] = x;
                }
            }
            if let Some((wide, make)) = &self.plan.arguments[k].frame {
                let shapes = &self.shapes[k][..tiles(count) * fields];
                let frames = &mut self.frames[k][..tiles(count) * wide];
                make(Tiles::new(shapes, fields), frames);
            }
        }
        let inputs = [0, 1].map(|k| match &self.plan.arguments[k].frame {
            Some((wide, _)) => Tiles::new(&self.frames[k][..], *wide),
            None => Tiles::new(&self.shapes[k][..], self.plan.arguments[k].fields),
        });
        let out = ResultTiles {
            lanes: &mut self.results,
            tiles: tiles(count),
        };
        self.plan.maker.make(&inputs, out);
        let values = flat(Planes(&self.results).field(0));
        for (&pair, &value) in self.pairs.iter().zip(values) {
            let value = self.rare(pair).unwrap_or(value);
            take(pair, value);
        }
        self.pairs.clear();
    }
    /// Returns the result of the scalar code if a shape is too extreme for the kernel.
    fn rare(&self, pair: [u32; 2]) -> Option<T> {
        let rare = self.plan.rare.as_ref()?;
        let (mut own, mut other) = (Vec::new(), Vec::new());
        let [row, column] = pair.map(|i| i as usize);
        let shapes = [
            self.lists[0].numbers(row..row + 1, &mut own),
            self.lists[1].numbers(column..column + 1, &mut other),
        ];
        let is_rare = |k: usize| (self.plan.arguments[k].is_rare)(shapes[k]);
        let mut one = [T::default()];
        (is_rare(0) || is_rare(1)).then(|| {
            rare(&shapes, &[T::one()], &mut one);
            one[0]
        })
    }
}

/// A search for the least results.
pub(crate) struct Search<'a, T: Real> {
    /// The plan by which a pair is computed, from shapes that are not prepared.
    pub plan: &'a Plan<T>,
    /// The shapes of both lists, checked.
    pub lists: &'a [Column<'a, T>; 2],
    /// The boxes around the shapes of both lists, if they bound results.
    pub boxes: Option<[&'a Boxes<T>; 2]>,
    /// `true` if results are squares of distances.
    pub squared: bool,
    pub groups: GroupSpans<'a>,
    pub wanted: Least<T>,
    /// `true` if all pairs with a least result are wanted.
    pub ties: bool,
}

/// The part of a search that one thread takes: some own items.
struct Piece<'a, T: Real> {
    search: &'a Search<'a, T>,
    /// The first row, column or group with a result of its own.
    first: usize,
    best: Vec<Option<Found<T>>>,
    pairs: Vec<Found<T>>,
}

/// Returns `true` if a pair comes before another in the order of results, rows and columns.
fn comes_first<T: Real>(a: Found<T>, b: Found<T>) -> bool {
    a.value.below(b.value) || a.value.equals(b.value) && (a.row, a.column) < (b.row, b.column)
}

impl<T: Real> Search<'_, T> {
    /// Returns the list of own items: 0 or 1.
    fn side(&self) -> usize {
        usize::from(matches!(self.wanted, Least::Columns(_)))
    }
    /// Returns the offsets of the groups among own items, and among others.
    fn offsets(&self) -> [&[usize]; 2] {
        match self.side() {
            0 => [self.groups.a, self.groups.b],
            _ => [self.groups.b, self.groups.a],
        }
    }
    /// Returns the group of an own item.
    fn group(&self, own: usize) -> usize {
        self.offsets()[0].partition_point(|&start| start <= own) - 1
    }
    /// Returns the place of an own item's result: its own, or that of its group.
    fn slot(&self, own: usize) -> usize {
        match self.wanted {
            Least::Groups(_) => self.group(own),
            _ => own,
        }
    }

    /// Runs the search on all threads.
    pub(crate) fn run(&self) -> LeastPairs<T> {
        let count = self.lists[self.side()].len();
        let piece = rows_per_piece(count);
        let mut pieces: Vec<_> = (0..count.div_ceil(piece))
            .map(|i| i * piece..count.min((i + 1) * piece))
            .map(|own| {
                let slots = self.slot(own.start)..self.slot(own.end - 1) + 1;
                let piece = Piece {
                    search: self,
                    first: slots.start,
                    best: match self.wanted {
                        Least::Below(_) => Vec::new(),
                        _ => vec![None; slots.len()],
                    },
                    pairs: Vec::new(),
                };
                (own, piece)
            })
            .collect();
        in_parallel(
            pieces.iter_mut().collect(),
            |(own, piece): &mut (Range<usize>, Piece<'_, T>)| {
                piece.run(own.clone());
            },
        );
        let slots = match self.wanted {
            Least::Groups(_) => self.groups.count(),
            Least::Below(_) => 0,
            _ => count,
        };
        let mut found = LeastPairs {
            best: vec![None; slots],
            pairs: Vec::new(),
        };
        for (_, piece) in pieces {
            for (slot, own) in found.best[piece.first.min(slots)..]
                .iter_mut()
                .zip(piece.best)
            {
                let (Some(pair), kept) = (own, *slot) else {
                    continue;
                };
                if kept.is_none_or(|kept| comes_first(pair, kept)) {
                    *slot = own;
                }
            }
            found.pairs.extend(piece.pairs);
        }
        if !matches!(self.wanted, Least::Below(_)) {
            let least = |pair: &Found<T>| {
                let own = if self.side() == 0 {
                    pair.row
                } else {
                    pair.column
                };
                found.best[self.slot(own)].is_some_and(|best| best.value.equals(pair.value))
            };
            found.pairs.retain(least);
        }
        found
            .pairs
            .sort_unstable_by_key(|pair| (pair.row, pair.column));
        found
    }
}

impl<T: Real> Piece<'_, T> {
    /// Returns the largest result that still counts for an own item.
    fn limit(&self, own: usize) -> T {
        let cap = self.search.wanted.cap();
        let best = match self.search.wanted {
            Least::Below(_) => None,
            _ => self.best[self.search.slot(own) - self.first],
        };
        best.map_or(cap, |best| best.value)
    }
    /// Returns the largest bound of pairs whose result may count for an own item.
    fn reach(&self, own: usize) -> T {
        reach(self.limit(own), self.search.squared)
    }
    /// Receives the result of a pair.
    fn take(&mut self, [row, column]: [u32; 2], value: T) {
        let (row, column) = (row as usize, column as usize);
        let pair = Found { row, column, value };
        if let Least::Below(limit) = self.search.wanted {
            if value.below(limit) {
                self.pairs.push(pair);
            }
            return;
        }
        let own = if self.search.side() == 0 { row } else { column };
        if !value.at_most(self.limit(own)) || !value.below(T::lit(f64::INFINITY)) {
            return;
        }
        let slot = &mut self.best[self.search.slot(own) - self.first];
        if slot.is_none_or(|kept| comes_first(pair, kept)) {
            *slot = Some(pair);
        }
        if self.search.ties {
            self.pairs.push(pair);
        }
    }
    /// Computes some own items.
    fn run(&mut self, own: Range<usize>) {
        let search = self.search;
        let mut pairs = PairTiles::new(search.plan, search.lists);
        let Some(boxes) = &search.boxes else {
            let offsets = search.offsets()[1];
            for own in own {
                let group = search.group(own);
                for other in offsets[group]..offsets[group + 1] {
                    self.add(&mut pairs, own, other as u32);
                }
            }
            return pairs.finish(&mut |pair, value| self.take(pair, value));
        };
        with_kept(|open: &mut Vec<Open<T>>| {
            if open.len() < TOGETHER.min(own.len()) {
                open.resize_with(TOGETHER.min(own.len()), Open::default);
            }
            for start in own.clone().step_by(TOGETHER) {
                let now = start..own.end.min(start + TOGETHER);
                self.run_together(boxes, now, open, &mut pairs);
            }
            open.retain(Open::is_short);
        });
    }
    /// Adds a pair to those that are computed together.
    fn add(&mut self, pairs: &mut PairTiles<'_, T>, own: usize, other: u32) {
        let pair = match self.search.side() {
            0 => [own as u32, other],
            _ => [other, own as u32],
        };
        pairs.add(pair, &mut |pair, value| self.take(pair, value));
    }
    /// Computes own items whose pairs share tiles.
    fn run_together(
        &mut self,
        boxes: &[&Boxes<T>; 2],
        now: Range<usize>,
        open: &mut [Open<T>],
        pairs: &mut PairTiles<'_, T>,
    ) {
        let search = self.search;
        let side = search.side();
        let (mine, others) = (boxes[side], boxes[1 - side]);
        let offsets = search.offsets()[1];
        let is_least = !matches!(search.wanted, Least::Below(_));
        for (own, open) in now.clone().zip(&mut *open) {
            let group = search.group(own);
            let range = offsets[group]..offsets[group + 1];
            others.begin(&mine.around(own), range, open);
        }
        if is_least {
            for (own, open) in now.clone().zip(&mut *open) {
                open.first(self.reach(own), |place| {
                    self.add(pairs, own, others.item(place));
                });
            }
            pairs.finish(&mut |pair, value| self.take(pair, value));
        }
        for (own, open) in now.clone().zip(&mut *open) {
            let limit = self.reach(own);
            others.open_rest(&mine.around(own), limit, open);
            open.gather(limit);
        }
        if is_least {
            for (own, open) in now.clone().zip(&mut *open) {
                open.some(FEW, SOME, |place| {
                    self.add(pairs, own, others.item(place));
                });
            }
            pairs.finish(&mut |pair, value| self.take(pair, value));
        }
        for (own, open) in now.zip(open) {
            let limit = self.reach(own);
            open.rest(limit, |place| {
                self.add(pairs, own, others.item(place));
            });
        }
        pairs.finish(&mut |pair, value| self.take(pair, value));
    }
}

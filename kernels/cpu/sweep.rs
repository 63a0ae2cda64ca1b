//! All pairs of two prepared lists, row by row, as far as they need to be computed.
//!
//! A filter by bounds leaves out pairs whose result is zero for certain. What is left over closes
//! ranks, is computed tile by tile, and goes to a consumer with the columns it belongs to; nothing
//! depends on which pairs were left out.
use crate::kernels::cpu::boxes::BOUNDS;
use crate::kernels::cpu::lane::{Lane, TILE, Tiles, tiles};
use crate::kernels::cpu::plan::{List, Maker, Plan, Rare, Room};
use crate::kernels::cpu::tree::Tree;
use crate::kernels::real::Real;
use std::ops::Range;

/// Tiles of columns that a kernel is given at once: with their results few enough for the innermost
/// cache, and enough that starting costs nothing.
pub const BLOCK: usize = 32;

/// Of at least so many columns, and at most so small a share of near pairs, a tree finds them.
const LONG: usize = 512;
const SPARSE: f64 = 1.0 / 24.0;

/// Where more than this share of pairs is near, sums leave none out.
const DENSE: f64 = 0.6;

/// Rows that are asked for the share of near pairs.
const ASKED: usize = 16;

/// What is computed of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The score.
    Values,
    /// The score and its slopes.
    Slopes,
    /// The same, to be added up: then either all parts are runs, or none is.
    Sums,
}

/// Results of one row with some columns, in tiles.
pub enum Part<'a, T> {
    /// With one column after another.
    Run {
        /// The first column, a multiple of sixteen.
        first: usize,
        /// How many.
        count: usize,
        /// Their results.
        results: &'a [Lane<T>],
    },
    /// With those of a stretch of columns that need not be zero; all others of the stretch are.
    Picked {
        /// Which columns have not been spoken of before.
        stretch: Range<usize>,
        /// Ascending.
        columns: &'a [u32],
        /// Their results.
        results: &'a [Lane<T>],
    },
}

/// What is computed of all pairs.
pub struct Sweep<'a, T> {
    a: &'a List<'a, T>,
    b: &'a List<'a, T>,
    maker: &'a dyn Maker<T>,
    /// Numbers per result.
    fields: usize,
    rare: Option<&'a Rare<T>>,
    /// Columns as rows of numbers, for picking some, and how many numbers each has.
    picking: Vec<T>,
    stride: usize,
    tree: Option<Tree<T>>,
    /// Four times the most near columns of a block, per column, that are still picked.
    most: usize,
}

impl<'a, T: Real> Sweep<'a, T> {
    /// Scores, or scores with slopes. A filter is used where both lists have bounds.
    pub fn new(plan: &'a Plan<T>, form: Form, a: &'a List<'a, T>, b: &'a List<'a, T>) -> Self {
        let (maker, fields) = match form {
            Form::Values => (&plan.scores, 1),
            Form::Slopes | Form::Sums => (&plan.slopes, plan.slope_fields()),
        };
        let mut sweep = Sweep {
            a,
            b,
            maker: &**maker,
            fields,
            rare: plan.rare.as_ref(),
            picking: Vec::new(),
            stride: b.frame_fields.next_multiple_of(4),
            tree: None,
            most: if form == Form::Sums { 4 } else { 3 },
        };
        if let (Some(_), Some(bounds)) = (&a.bounds, &b.bounds) {
            let near = match b.count >= LONG || form == Form::Sums {
                true => sweep.share_of_near(),
                false => 1.0,
            };
            if form == Form::Sums && near > DENSE {
                return sweep;
            }
            sweep.picking = vec![T::default(); tiles(b.count) * TILE * sweep.stride];
            let take = T::kernels().take;
            take(
                &b.frames,
                b.frame_fields,
                b.frame_fields,
                &mut sweep.picking,
                sweep.stride,
            );
            if b.count >= LONG && near <= SPARSE {
                sweep.tree = Some(Tree::new(bounds, b.count));
            }
        }
        sweep
    }

    /// Whether pairs whose bounds do not meet are left out.
    pub fn is_filtered(&self) -> bool {
        !self.picking.is_empty()
    }

    /// The share of pairs whose bounds meet, of some rows.
    fn share_of_near(&self) -> f64 {
        let Some(bounds) = &self.b.bounds else {
            return 1.0;
        };
        let mut hits = vec![0; (tiles(self.b.count) + 1) * TILE];
        let step = self.a.count.div_ceil(ASKED).max(1);
        let (mut near, mut asked) = (0, 0);
        for i in (0..self.a.count).step_by(step) {
            if let Some(row) = self.a.bounds_of(i) {
                let bounds = Tiles::new(bounds, BOUNDS);
                near += (T::kernels().near)(&row, bounds, 0, &mut hits);
                asked += self.b.count;
            }
        }
        near as f64 / asked.max(1) as f64
    }

    /// Computes some rows and hands over what they give. Of each row columns come in order; rows come
    /// in order for each column.
    pub fn run(&self, rows: Range<usize>, mut consume: impl FnMut(usize, Part<'_, T>)) {
        let mut desk = Desk::new(self);
        if let Some(tree) = &self.tree {
            let mut hits = Vec::new();
            for row in rows {
                let Some(bounds) = self.a.bounds_of(row) else {
                    return;
                };
                desk.choose(row);
                tree.near(&bounds, &mut hits);
                let mut stretch = 0..self.b.count;
                for hits in hits.chunks(BLOCK * TILE) {
                    let results = desk.picked(hits);
                    consume(
                        row,
                        Part::Picked {
                            stretch,
                            columns: hits,
                            results,
                        },
                    );
                    stretch = 0..0;
                }
                if hits.is_empty() {
                    consume(
                        row,
                        Part::Picked {
                            stretch,
                            columns: &[],
                            results: &[],
                        },
                    );
                }
            }
            return;
        }
        let mut hits = [0; (BLOCK + 1) * TILE];
        for first in (0..self.b.count).step_by(BLOCK * TILE) {
            let count = (self.b.count - first).min(BLOCK * TILE);
            let bounds = match &self.b.bounds {
                Some(bounds) if self.is_filtered() => {
                    let from = first / TILE * BOUNDS;
                    Some(Tiles::new(&bounds[from..][..tiles(count) * BOUNDS], BOUNDS))
                }
                _ => None,
            };
            for row in rows.clone() {
                desk.choose(row);
                if let (Some(bounds), Some(own)) = (bounds, self.a.bounds_of(row)) {
                    let near = (T::kernels().near)(&own, bounds, first as u32, &mut hits);
                    if 4 * near <= self.most * count {
                        let columns = &hits[..near];
                        let results = desk.picked(columns);
                        let stretch = first..first + count;
                        consume(
                            row,
                            Part::Picked {
                                stretch,
                                columns,
                                results,
                            },
                        );
                        continue;
                    }
                }
                let results = desk.run(first, count);
                consume(
                    row,
                    Part::Run {
                        first,
                        count,
                        results,
                    },
                );
            }
        }
    }
}

/// What one thread computes with.
struct Desk<'a, T> {
    sweep: &'a Sweep<'a, T>,
    row: usize,
    row_is_rare: bool,
    /// The row's shape in every place of a tile.
    own: Vec<Lane<T>>,
    /// Columns that were picked.
    picked: Vec<Lane<T>>,
    results: Vec<Lane<T>>,
    room: Room<T>,
    /// Numbers of one result.
    one: Vec<T>,
}

impl<'a, T: Real> Desk<'a, T> {
    fn new(sweep: &'a Sweep<'a, T>) -> Self {
        let lanes = |count: usize| vec![Lane::default(); count];
        Desk {
            sweep,
            row: usize::MAX,
            row_is_rare: false,
            own: lanes(sweep.a.frame_fields),
            picked: lanes(BLOCK * sweep.b.frame_fields),
            results: lanes(BLOCK * sweep.fields),
            room: Room::new(),
            one: vec![T::default(); sweep.fields],
        }
    }
    /// Takes a row.
    #[inline]
    fn choose(&mut self, row: usize) {
        if row != self.row {
            self.row = row;
            self.sweep.a.spread(row, &mut self.own);
            self.row_is_rare = !self.sweep.a.rare.is_empty() && self.sweep.a.is_rare(row);
        }
    }
    /// Results of the row with a run of columns.
    fn run(&mut self, first: usize, count: usize) -> &[Lane<T>] {
        let Sweep { b, fields, .. } = *self.sweep;
        let from = first / TILE * b.frame_fields;
        let columns = &b.frames[from..][..tiles(count) * b.frame_fields];
        let inputs = [Tiles::one(&self.own), Tiles::new(columns, b.frame_fields)];
        let results = &mut self.results[..tiles(count) * fields];
        self.sweep.maker.make(&mut self.room, &inputs, results);
        if self.row_is_rare {
            for k in 0..count {
                self.mend(first + k, k);
            }
        } else if !b.rare.is_empty() {
            let from = b.rare.partition_point(|&j| (j as usize) < first);
            let rare = b.rare[from..].iter().map(|&j| j as usize);
            for j in rare.take_while(|&j| j < first + count) {
                self.mend(j, j - first);
            }
        }
        &self.results[..tiles(count) * fields]
    }
    /// Results of the row with some columns.
    fn picked(&mut self, columns: &[u32]) -> &[Lane<T>] {
        let Sweep {
            b, fields, stride, ..
        } = *self.sweep;
        let width = tiles(columns.len());
        let picked = &mut self.picked[..width * b.frame_fields];
        let gather = T::kernels().gather;
        gather(&self.sweep.picking, stride, columns, b.frame_fields, picked);
        let inputs = [Tiles::one(&self.own), Tiles::new(picked, b.frame_fields)];
        let results = &mut self.results[..width * fields];
        self.sweep.maker.make(&mut self.room, &inputs, results);
        if self.row_is_rare || !b.rare.is_empty() {
            for (k, &j) in columns.iter().enumerate() {
                if self.row_is_rare || b.is_rare(j as usize) {
                    self.mend(j as usize, k);
                }
            }
        }
        &self.results[..width * fields]
    }
    /// Puts the right result of a rare pair in its place.
    fn mend(&mut self, column: usize, place: usize) {
        let Sweep {
            a, b, fields, rare, ..
        } = *self.sweep;
        if let Some(rare) = rare {
            rare(a.shape(self.row), b.shape(column), &mut self.one);
            let tile = &mut self.results[place / TILE * fields..];
            for (lane, &x) in tile.iter_mut().zip(&self.one) {
                lane.0[place % TILE] = x;
            }
        }
    }
}

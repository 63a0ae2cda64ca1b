//! Aligned items over plain numbers, block by block, for every operation.
use crate::Real;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{
    Lane, Planes, ResultTiles, TILE, Tiles, planes, tiles, with_lanes,
};
use crate::kernels::cpu::maker::OverRows;
use crate::kernels::cpu::plan::{Plan, Preparation};
use crate::kernels::cpu::program::rowwise::{ArgumentRows, NEAR, ResultRows};
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::Column;
use crate::kernels::row::item::{STRETCH, Target, TargetPiece};
use smallvec::SmallVec;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// One of every argument or result, of which few calls have more.
type Few<X> = SmallVec<[X; 4]>;

/// The number of items in a block, few enough for the innermost cache together with their results.
const ITEMS: usize = 256;

/// Aligned items as checked numbers, and the targets of their results.
pub struct Aligned<'a, T> {
    /// The plan by which the items are computed.
    pub plan: &'a Plan<T>,
    /// The shapes, then the cotangents.
    pub columns: &'a [Column<'a, T>],
    /// `true` if some items may have shapes too extreme, or cotangents too large, for kernels.
    pub rare: bool,
    /// The number of items.
    pub count: usize,
    /// `true` if numbers were not checked before. Each stretch is then tested just before it is computed, so memory is
    /// read once.
    pub unchecked: bool,
    /// The targets of the results, for every shape of a result.
    pub targets: Vec<Option<Target<'a, T>>>,
}

/// Computes aligned items on all threads. Returns `false` if `unchecked` numbers fail a quick test: the results are
/// then incomplete, and the caller checks and computes again.
pub fn compute<T: Real>(work: Aligned<'_, T>) -> bool {
    let mut pieces: Vec<Few<Option<TargetPiece<'_, T>>>> = Vec::new();
    pieces.resize_with(work.count.div_ceil(STRETCH), Few::new);
    for target in work.targets {
        match target {
            Some(target) => {
                for (piece, part) in pieces.iter_mut().zip(target.pieces()) {
                    piece.push(Some(part));
                }
            }
            None => pieces.iter_mut().for_each(|piece| piece.push(None)),
        }
    }
    let (plan, columns, rare, count) = (work.plan, work.columns, work.rare, work.count);
    let given: usize = columns.iter().map(|x| x.fields * x.len()).sum();
    let made = plan.gives.iter().sum::<usize>() * count;
    let far = (given + made) * size_of::<T>() > NEAR;
    let (unchecked, has_failed) = (work.unchecked, AtomicBool::new(false));
    let work = pieces.into_iter().enumerate().collect();
    in_parallel(
        work,
        |(i, mut pieces): (usize, Few<Option<TargetPiece<'_, T>>>)| {
            let items = i * STRETCH..count.min((i + 1) * STRETCH);
            let mut rooms: Few<Vec<T>> = columns.iter().map(|_| Vec::new()).collect();
            let group = columns.iter().map(Column::group).min().unwrap_or(STRETCH);
            for first in items.clone().step_by(group) {
                let items = first..items.end.min(first + group);
                let columns_with_rooms = columns.iter().zip(&mut rooms);
                let numbers: Few<&[T]> = columns_with_rooms
                    .map(|(column, room)| column.numbers(items.clone(), room))
                    .collect();
                let from = first % STRETCH;
                let mut places: Few<Option<&mut [T]>> = pieces
                    .iter_mut()
                    .zip(&plan.gives)
                    .map(|(piece, fields)| {
                        let own = from..from + items.len();
                        Some(piece.as_mut()?.numbers_of(own, *fields))
                    })
                    .collect();
                let stretch = Stretch {
                    plan,
                    ones: columns
                        .iter()
                        .map(|column| column.count.is_none())
                        .collect(),
                    fields: columns.iter().map(|column| column.fields).collect(),
                    numbers,
                    rare,
                    far,
                };
                if unchecked && !stretch.is_sound() {
                    has_failed.store(true, Ordering::Relaxed);
                    return;
                }
                stretch.compute(items.len(), &mut places);
                drop(places);
                pieces.iter_mut().flatten().for_each(TargetPiece::finish);
            }
        },
    );
    !has_failed.into_inner()
}

/// Items that one thread computes.
struct Stretch<'a, T> {
    plan: &'a Plan<T>,
    /// For each column: `true` if one item stands for all.
    ones: Few<bool>,
    /// For each column: the number of scalars per item.
    fields: Few<usize>,
    /// For each column: its numbers.
    numbers: Few<&'a [T]>,
    rare: bool,
    /// `true` if rows are prefetched.
    far: bool,
}

impl<T: Real> Stretch<'_, T> {
    /// Returns `true` if quick tests find all numbers valid. They may reject valid numbers, too.
    fn is_sound(&self) -> bool {
        self.numbers
            .iter()
            .enumerate()
            .all(|(k, numbers)| match self.plan.arguments.get(k) {
                Some(own) => own.are_ordinary(numbers),
                None => (kernels_in::<T>().all_finite)(numbers),
            })
    }
    fn compute(&self, count: usize, places: &mut [Option<&mut [T]>]) {
        let plan = self.plan;
        let is_plain = !self.rare && plan.arguments.iter().all(|x| x.frame.is_none());
        if let (Some(program), true) = (plan.maker.rows(), is_plain) {
            return self.compute_rows(program, count, places);
        }
        let most = tiles(count.min(ITEMS));
        let frame = |k: usize| plan.arguments.get(k).map_or(0, |x| x.frame_fields());
        let wide: Vec<[usize; 2]> = (0..self.fields.len())
            .map(|k| [most * self.fields[k], most * frame(k)])
            .collect();
        let lanes = wide.iter().flatten().sum::<usize>() + planes(plan.made());
        with_lanes(lanes, |mut lanes| {
            let mut rooms = Vec::with_capacity(wide.len());
            for [own, frames] in wide {
                let (own, rest) = lanes.split_at_mut(own);
                let (frames, rest) = rest.split_at_mut(frames);
                rooms.push((own, frames));
                lanes = rest;
            }
            let results = lanes;
            for first in (0..count).step_by(ITEMS) {
                let items = first..count.min(first + ITEMS);
                let inputs: Vec<Tiles<'_, T>> = rooms
                    .iter_mut()
                    .enumerate()
                    .map(|(k, (own, frames))| self.prepared(k, items.clone(), own, frames))
                    .collect();
                let mut out = ResultTiles {
                    lanes: &mut *results,
                    tiles: tiles(items.len()),
                };
                plan.maker.make(&inputs, out.again());
                if self.rare {
                    self.mend(items.clone(), out);
                }
                let results = Planes(&*results);
                let mut from = plan.skipped;
                for (place, &fields) in places.iter_mut().zip(&plan.gives) {
                    if let Some(place) = place {
                        let rows = &mut place[items.start * fields..items.end * fields];
                        (kernels_in::<T>().take)(results.from(from), fields, rows, fields);
                    }
                    from += fields;
                }
            }
        });
    }
    /// Computes a program from rows to rows.
    fn compute_rows(
        &self,
        program: &dyn OverRows<T>,
        count: usize,
        places: &mut [Option<&mut [T]>],
    ) {
        let columns = self.numbers.iter().zip(&self.fields).zip(&self.ones);
        let given: Few<ArgumentRows<'_, T>> = columns
            .map(|((&rows, &fields), &is_one)| ArgumentRows {
                rows,
                fields,
                is_one,
            })
            .collect();
        let places = places.iter_mut().zip(&self.plan.gives);
        let mut wanted: Few<ResultRows<'_, T>> = places
            .map(|(place, &fields)| (place.as_deref_mut(), fields))
            .collect();
        program.over_rows(&given, count, self.plan.skipped, &mut wanted, self.far);
    }
    /// Returns the numbers of a column for some items.
    fn of(&self, k: usize, items: &Range<usize>) -> &[T] {
        let fields = self.fields[k];
        match self.ones[k] {
            true => self.numbers[k],
            false => &self.numbers[k][items.start * fields..items.end * fields],
        }
    }
    /// Returns the prepared shapes of a block in tiles. A shape that stands for all is prepared once.
    fn prepared<'r>(
        &self,
        k: usize,
        items: Range<usize>,
        own: &'r mut [Lane<T>],
        frames: &'r mut [Lane<T>],
    ) -> Tiles<'r, T> {
        let fields = self.fields[k];
        let step = |fields| if self.ones[k] { 0 } else { fields };
        let numbers = self.of(k, &items);
        let width = tiles(numbers.len() / fields);
        let is_new = !self.ones[k] || items.start == 0;
        if is_new {
            (kernels_in::<T>().bring)(numbers, fields, &mut own[..width * fields]);
        }
        let frame = self.plan.arguments.get(k).and_then(|x| x.frame.as_ref());
        match frame {
            None => Tiles {
                lanes: own,
                step: step(fields),
            },
            Some(&(fields, ref make)) => {
                if is_new {
                    let own = Tiles::new(own, self.fields[k]);
                    make(own, &mut frames[..width * fields]);
                }
                Tiles {
                    lanes: frames,
                    step: step(fields),
                }
            }
        }
    }
    /// Replaces the results of extreme items by the scalar code's.
    fn mend(&self, items: Range<usize>, mut out: ResultTiles<'_, T>) {
        let plan = self.plan;
        let Some(rare) = &plan.rare else { return };
        let mut one = vec![T::default(); self.plan.made()];
        let (mut shapes, mut seed) = (Vec::new(), Vec::new());
        for (place, item) in items.enumerate() {
            let of = |k: usize| self.of(k, &(item..item + 1));
            shapes.clear();
            shapes.extend((0..plan.arguments.len()).map(of));
            seed.clear();
            for k in plan.arguments.len()..self.fields.len() {
                seed.extend_from_slice(of(k));
            }
            let is_rare = |(x, numbers): (&Preparation<T>, &&[T])| (x.is_rare)(numbers);
            let steep = T::lit(plan.steepest);
            if !plan.arguments.iter().zip(&shapes).any(is_rare)
                && seed.iter().all(|x| x.unsigned() <= steep)
            {
                continue;
            }
            rare(&shapes, &seed, &mut one);
            for (k, &x) in one.iter().enumerate() {
                if let Some(lane) = out.lane(place / TILE, k) {
                    lane.0[place % TILE] = x;
                }
            }
        }
    }
}
